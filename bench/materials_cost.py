#!/usr/bin/env python3
"""Cost of every material law: microseconds per element and cycle of one-point hexahedra and of shells with three
points, one thread; written to docs/results/materials_cost.md.

    python3 bench/materials_cost.py [--only MAT_024]

Each law has a block of 20 x 20 x 20 hexahedra (viscous hourglass control) or a plate of 90 x 90 shells (ELFORM 2) that
is pressed and sheared by its initial velocities so that most points flow, for some 300 cycles. Times are those
of the element term alone, as summary.json gives them; the better of three runs.
"""
import json
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PLASH = os.environ.get("PLASH", os.path.join(TOP, "build/release/plash"))
PAGE = os.path.join(TOP, "docs/results/materials_cost.md")
CYCLES = 300

# kg, mm, ms, GPa. Curves 1: flow stress, 2: foam, 3: soil, 4: honeycomb.
CURVES = """*DEFINE_CURVE
1
0.0,0.3
0.02,0.35
0.05,0.4
0.1,0.45
0.3,0.55
1.0,0.7
*DEFINE_CURVE
2
0.0,0.0
0.05,0.001
0.5,0.002
0.7,0.005
0.8,0.02
0.9,0.2
*DEFINE_CURVE
4
0.0,0.002
0.5,0.003
0.8,0.006
"""
STEEL = "7.85e-6,210.0,0.3"
GRUNEISEN = "*EOS_GRUNEISEN\n1,1480.0,1.92,0.0,0.0,0.1,0.0,0.0\n1.0\n"
METAL = "*EOS_GRUNEISEN\n1,4500.0,1.49,0.0,0.0,2.0,0.47,0.0\n1.0\n"
JWL = "*EOS_JWL\n1,371.2,3.231,4.15,0.95,0.30,7.0,1.0\n"
FLOW = "*MAT_PIECEWISE_LINEAR_PLASTICITY\n1,%s,0.3,1.0\n" % STEEL

# name: (card, equation of state, hexahedra, shells, strain rate over that of steel)
LAWS = {
    "001": ("*MAT_ELASTIC\n1,%s\n" % STEEL, "", 1, 1, 1),
    "001_FLUID": ("*MAT_ELASTIC_FLUID\n1,1.0e-6,0.0,0.0,0.0,0.0,2.2\n0.1,1e20\n", "", 1, 0, 1),
    "003, isotropic": ("*MAT_PLASTIC_KINEMATIC\n1,%s,0.3,1.0,1.0\n\n" % STEEL, "", 1, 1, 1),
    "003, kinematic": ("*MAT_PLASTIC_KINEMATIC\n1,%s,0.3,1.0,0.0\n\n" % STEEL, "", 1, 1, 1),
    "003, rates, VP = 1": ("*MAT_PLASTIC_KINEMATIC\n1,%s,0.3,1.0,1.0\n0.04,5.0,0.0,1\n" % STEEL, "", 1, 1, 1),
    "005": ("*MAT_SOIL_AND_FOAM\n1,1.6e-6,0.05,0.5,1e-6,1e-3,0.3,-1e-4\n0,0,0\n0.0,-0.05,-0.15\n\n0.0,0.01,0.05\n\n",
            "", 1, 0, 1),
    "006": ("*MAT_VISCOELASTIC\n1,1.0e-6,2.0,0.5,0.1,1.0\n", "", 1, 0, 1),
    "007": ("*MAT_BLATZ-KO_RUBBER\n1,1.0e-6,0.01\n", "", 1, 0, 1),
    "008, JWL": ("*MAT_HIGH_EXPLOSIVE_BURN\n1,1.63e-6,6930.0,21.0,0\n", JWL, 1, 0, 1),
    "009, Gruneisen": ("*MAT_NULL\n1,1.0e-6,0.0,1e-6\n", GRUNEISEN, 1, 0, 1),
    "010, Gruneisen": ("*MAT_ELASTIC_PLASTIC_HYDRO\n1,8.9e-6,46.0,0.1,0.5\n\n\n\n\n", METAL, 1, 0, 1),
    "014": ("*MAT_SOIL_AND_FOAM_FAILURE\n1,1.6e-6,0.05,0.5,1e-6,1e-3,0.3,-1e-4\n0,0,0\n0.0,-0.05,-0.15\n\n"
            "0.0,0.01,0.05\n\n", "", 1, 0, 1),
    "015": ("*MAT_JOHNSON_COOK\n1,7.85e-6,80.0,210.0,0.3\n0.3,0.4,0.3,0.02,1.0,1800.0,300.0,1e-3\n460.0\n\n", "", 1, 1, 1),
    "018": ("*MAT_POWER_LAW_PLASTICITY\n1,%s,0.5,0.2,0.04,5.0\n" % STEEL, "", 1, 1, 1),
    "024, line": (FLOW + "\n\n\n", "", 1, 1, 1),
    "024, curve": (FLOW + "0,0,1\n\n\n", "", 1, 1, 1),
    "024, curve, VP = 1": (FLOW + "0.04,5.0,1,0,1\n\n\n", "", 1, 1, 1),
    "025": ("*MAT_GEOLOGIC_CAP_MODEL\n1,2e-6,2.1,1.7,0.0642,0.11,0.0576,5.4\n4.2,6.0,0.066,0.19\n1,1,0,-0.0055\n",
            "", 1, 0, 1),
    "026": ("*MAT_HONEYCOMB\n1,5e-8,69.0,0.33,0.3,0.2\n4,4,4,4\n1.0,0.2,0.2,0.4,0.1,0.3\n\n\n", "", 1, 0, 1),
    "027": ("*MAT_MOONEY-RIVLIN_RUBBER\n1,1.0e-6,0.49,0.003,0.001\n\n", "", 1, 0, 1),
    "057": ("*MAT_LOW_DENSITY_FOAM\n1,1.0e-7,0.02,2,1e20,0.1\n5.0\n", "", 1, 0, 1),
    "063": ("*MAT_CRUSHABLE_FOAM\n1,1.0e-7,0.02,0.0,2,0.001\n", "", 1, 0, 1),
    "073, 2 elements": ("*MAT_LOW_DENSITY_VISCOUS_FOAM\n1,1.0e-7,0.02,2,1e20,0.1\n5.0\n0.02,1.0\n0.01,10.0\n", "", 1, 0, 1),
    "077_O": ("*MAT_OGDEN_RUBBER\n1,1.0e-6,0.495,0\n0.0063,-0.0001\n1.3,-2.0\n", "", 1, 0, 1),
    "081": ("*MAT_PLASTICITY_WITH_DAMAGE\n1,%s,0.3,1.0,0.05\n0,0,0,0,0.5\n\n\n" % STEEL, "", 1, 1, 1),
    "098": ("*MAT_SIMPLIFIED_JOHNSON_COOK\n1,%s\n0.3,0.4,0.3,0.02\n" % STEEL, "", 1, 1, 1),
    "124": ("*MAT_PLASTICITY_COMPRESSION_TENSION\n1,%s\n1,1\n\n\n" % STEEL, "", 1, 1, 1),
}


def velocity(x, y, z, rate):
    """A field that presses along z, stretches across and shears, with a wave so that strains are not uniform."""
    return rate * (0.3 * x + 0.4 * y), rate * 0.2 * y, -rate * z


def hexahedra(rate, n=20):
    lines = ["*SECTION_SOLID", "1,1", "*NODE"]
    nid = lambda i, j, k: 1 + i + (n + 1) * (j + (n + 1) * k)
    velocities = ["*INITIAL_VELOCITY_NODE"]
    for k in range(n + 1):
        for j in range(n + 1):
            for i in range(n + 1):
                x, y, z = i - n / 2, j - n / 2, k - n / 2
                lines.append("%d,%g,%g,%g" % (nid(i, j, k), x, y, z))
                velocities.append("%d,%g,%g,%g" % ((nid(i, j, k),) + velocity(x, y, z, rate)))
    lines.append("*ELEMENT_SOLID")
    for k in range(n):
        for j in range(n):
            for i in range(n):
                corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
                lines.append(",".join(map(str, [1 + i + n * (j + n * k), 1] +
                                          [nid(i + a, j + b, k + c) for a, b, c in corners])))
    return lines + velocities


def shells(rate, n=90):
    lines = ["*SECTION_SHELL", "1,2,0.8333,3", "0.5,0.5,0.5,0.5", "*NODE"]
    nid = lambda i, j: 1 + i + (n + 1) * j
    velocities = ["*INITIAL_VELOCITY_NODE"]
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = i - n / 2, j - n / 2
            lines.append("%d,%g,%g,0.0" % (nid(i, j), x, y))
            velocities.append("%d,%g,%g,0.0" % (nid(i, j), rate * (x + 0.3 * y), -rate * 0.5 * y))
    lines.append("*ELEMENT_SHELL")
    for j in range(n):
        for i in range(n):
            lines.append("%d,1,%d,%d,%d,%d" % (1 + i + n * j, nid(i, j), nid(i + 1, j), nid(i + 1, j + 1), nid(i, j + 1)))
    return lines + velocities


def cost(name, law, mesh):
    """Microseconds per element and cycle of the best of three runs, and what share of them; or the reason."""
    card, eos, _, _, rate = law
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "deck.k")
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(["*KEYWORD", "*CONTROL_TERMINATION", "1e9,%d" % CYCLES, "*PART", name,
                                  "1,1,1,%d" % (1 if eos else 0)] + mesh(0.5 * rate)) + "\n" + card + eos + CURVES + "*END\n")
        best, ended = None, ""
        for _ in range(3):
            out = os.path.join(folder, "out")
            done = subprocess.run([PLASH, "run", path, "-j", "1", "-o", out], capture_output=True, text=True)
            try:
                with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
                    summary = json.load(file)
            except OSError:
                return None, (done.stdout + done.stderr).strip().splitlines()[-1:]
            term = next(t for t in summary["terms"] if t["name"].startswith(("solids", "shells")))
            if summary["termination"] != "normal":
                ended = summary["message"]
            micro = 1e6 * term["seconds"] / max(term["item_steps"], 1)
            best = micro if best is None else min(best, micro)
        return best, ended


def main():
    only = sys.argv[sys.argv.index("--only") + 1] if "--only" in sys.argv else ""
    rows = []
    for name, law in LAWS.items():
        if only and only not in name:
            continue
        cells = []
        for wanted, mesh in ((law[2], hexahedra), (law[3], shells)):
            if not wanted:
                cells.append("")
                continue
            micro, ended = cost(name, law, mesh)
            cells.append("%.3f" % micro if micro is not None else "-")
            if ended or micro is None:
                print(name, mesh.__name__, ended, file=sys.stderr)
        rows.append("| %s | %s |" % (name, " | ".join(cells)))
        print(rows[-1], flush=True)
    if only:
        return
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write("# What the material laws cost\n\nMicroseconds per element and cycle of the element term, one thread; "
                   "written by `python3 bench/materials_cost.py`\n(the decks stand in it). Most points flow, curves "
                   "have six points.\n\n| MAT | one-point hexahedron | shell, 3 points |\n|---|---|---|\n")
        file.write("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
