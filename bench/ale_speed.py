#!/usr/bin/env python3
"""Cell-cycles per second of the Eulerian fluid in whole runs of decks, as a table.

Usage: ale_speed.py [REPEATS] [THREADS...]      (default: 3 repeats, 1 and 2 threads)
Counted: all cells of the mesh, and those that hold fluid at the start. Best of the repeats, wall seconds of the fluid's
term (Lagrangian step, interface, van Leer remap); the loop adds what the last column says.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

top = pathlib.Path(__file__).resolve().parent.parent
plash = top / "build" / "release" / "plash"
repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 3
thread_counts = [int(word) for word in sys.argv[2:]] or [1, 2]

WATER = """*PART
water
1,1,1,1
*SECTION_SOLID
1,11
*MAT_NULL
1,998,-1e4
*EOS_GRUNEISEN
1,1480,1.979,,,0.11,3,0
1
"""


def mesh(cells, size):
    text = "*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n"
    for axis in range(3):
        text += f"*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{axis + 1}\n1,0\n{cells[axis] + 1},{size[axis]}\n"
    return text


def hexahedra(n):
    """The unit cube with nodes inside moved by up to 0.02, so that no cell is a box."""
    def node(i, j, k):
        return 1 + i + (n + 1) * (j + (n + 1) * k)

    wave = [math.sin(math.pi * i / n) for i in range(n + 1)]
    span = range(n + 1)
    text = ["*PART\nmesh\n10,1,1\n*NODE\n"]
    text += [f"{node(i, j, k)},{i / n + 0.02 * (bulge := wave[i] * wave[j] * wave[k]):.9g},{j / n + bulge * 0.02:.9g},"
             f"{k / n - bulge * 0.02:.9g}\n" for k in span for j in span for i in span]
    text.append("*ELEMENT_SOLID\n")
    for k in range(n):
        for j in range(n):
            for i in range(n):
                corners = [node(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                text.append(f"{i + n * (j + n * k) + 1},10,{','.join(map(str, corners))}\n")
    return "".join(text)


def deck(cells, filled, cycles, general):
    """A cube of 1 m with water up to the share `filled` of its length and height; moving at the start."""
    text = "*KEYWORD\n" + (hexahedra(cells) if general else mesh((cells,) * 3, (1, 1, 1))) + WATER
    text += "*ALE_MULTI-MATERIAL_GROUP\n1,1\n"
    if filled < 1:
        text += f"2,1\n*PART\nempty\n2,1,2\n*MAT_VACUUM\n2,0\n*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,2,3\n" \
                f"5,0,1,1,0,0.5\n0,0,0,{filled},1,{filled}\n"
    else:
        text += "*INITIAL_VOLUME_FRACTION_GEOMETRY\n10,1,1,3\n6,0,1,10,5,3\n0.5,0.5,0.5,0.3\n"
    text += "*LOAD_BODY_Z\n1,9.81\n*DEFINE_CURVE\n1\n0,1\n1e9,1\n"
    return text + f"*CONTROL_ALE\n-1,1,2,-1\n,,,,,2\n*CONTROL_TERMINATION\n1e9,{cycles}\n*CONTROL_TIMESTEP\n0,0.67\n*END\n"


def seconds(text, threads):
    """Wall seconds of the fluid's term in one run, the step count, and the whole run's."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "deck.k"
        path.write_text(text)
        subprocess.run([plash, "run", path, "-o", folder + "/out", "-j", str(threads)], check=True,
                       stdout=subprocess.DEVNULL)
        summary = json.loads((pathlib.Path(folder) / "out" / "summary.json").read_text())
        fluid = next(term for term in summary["terms"] if term["name"] == "Eulerian fluid")
        return fluid["seconds"], summary["cycles"], summary["wall_seconds"], summary["peak_memory_bytes"]


cases = [("one material, 64^3", 64, 1.0, 60, False), ("water and void, 64^3, a quarter wet", 64, 0.5, 100, False),
         ("water and void, 96^3, a quarter wet", 96, 0.5, 40, False), ("one material, 96^3", 96, 1.0, 25, False),
         ("nearly empty, 96^3, 1 % wet", 96, 0.1, 200, False),
         ("general hexahedra, one material, 40^3", 40, 1.0, 40, True),
         ("general hexahedra, water and void, 40^3, a quarter wet", 40, 0.5, 80, True)]
print("| case | threads | M cell-cycles/s, all cells | M cell-cycles/s, wet cells | rest of the run |")
print("|---|---|---|---|---|")
for name, cells, filled, cycles, general in cases:
    for threads in thread_counts:
        best = min((seconds(deck(cells, filled, cycles, general), threads) for _ in range(repeats)))
        spent, done, whole, _ = best
        every = cells**3 * done / spent / 1e6
        wet = every * filled**2
        print(f"| {name} | {threads} | {every:.2f} | {wet:.2f} | {100 * (whole - spent) / whole:.0f} % |", flush=True)
