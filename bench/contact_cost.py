#!/usr/bin/env python3
"""Cost of self-contact on top of the same run without it: python3 bench/contact_cost.py [THREADS] [CYCLES].

Decks of some 200,000 shells (ELFORM 2, MAT_024, 5 points; t, mm, s) with *CONTACT_AUTOMATIC_SINGLE_SURFACE over all:
  tube    a square tube that a wall crushes: few touches, the search and the test of pairs cost
  bellows a sheet folded to zigzag whose folds stand within the contact thickness of one another and are pressed
          together: most nodes touch all the time
and the tube at a sixteenth and a quarter of the size, which shows how the cost grows.
"""
import json
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEAD = """*KEYWORD
*CONTROL_TERMINATION
1.0,{cycles}
*PART
sheet
1,1,1
*SECTION_SHELL
1,2,0.8333,5
{t},{t},{t},{t}
*MAT_PIECEWISE_LINEAR_PLASTICITY
1,7.85e-9,2.1e5,0.3,300.0,1000.0
"""
CONTACT = "*CONTACT_AUTOMATIC_SINGLE_SURFACE\n0\n0.2,0.2\n\n{soft}\n\n0,1\n"  # IGNORE = 1: the folds stay where they are


def strip(place, columns, rows, closed):
    """Nodes by place(i, j) and shells of columns x rows; closed: the last column meets the first."""
    wide = columns if closed else columns + 1
    text = ["*NODE"]
    for j in range(rows + 1):
        for i in range(wide):
            x, y, z = place(i, j)
            text.append(f"{j * wide + i + 1},{x:.8g},{y:.8g},{z:.8g}")
    text.append("*ELEMENT_SHELL")
    for j in range(rows):
        for i in range(columns):
            a, b = j * wide + i + 1, j * wide + (i + 1) % wide + 1
            text.append(f"{j * columns + i + 1},1,{a},{b},{b + wide},{a + wide}")
    return "\n".join(text) + "\n"


def tube(side, rows, cycles):
    h, edge = 80.0 / side, 80.0

    def place(i, j):
        along, face = (i % side) * h, i // side
        # A slight dent of every side starts the folds.
        dent = 0.3 * (1 if face % 2 == 0 else -1) * (1 if (j * h // 40) % 2 else -1) * min(along, edge - along) / edge
        x, y = [(along, -dent), (edge + dent, along), (edge - along, edge + dent), (-dent, edge - along)][face]
        return x, y, j * h
    return (HEAD.format(cycles=cycles, t=1.5) + strip(place, 4 * side, rows, True) +
            "*RIGIDWALL_PLANAR\n0\n0,0,-0.01,0,0,1.0,0.2\n*INITIAL_VELOCITY\n0\n0,0,-15000.0\n")


def bellows(columns, rows, folds, cycles):
    per = rows // folds

    def place(i, j):
        fold, step = divmod(j, per)
        y = step if fold % 2 == 0 else per - step
        # Folds 1.02 apart in z, their thickness is 1 (0.4 of the edge of 2.5 is the limit).
        return 2.5 * i, 2.5 * y, 1.02 * (fold + step / per)
    velocity = "*INITIAL_VELOCITY_NODE\n"
    return HEAD.format(cycles=cycles, t=1.0) + strip(place, columns, rows, False) + velocity + "".join(
        f"{j * (columns + 1) + i + 1},0,0,{-400.0 * (j / rows - 0.5)}\n" for j in range(rows + 1)
        for i in range(columns + 1))


def run(deck, threads, folder):
    path = os.path.join(folder, "deck.k")
    with open(path, "w") as file:
        file.write(deck + "*END\n")
    out = os.path.join(folder, "out")
    subprocess.run([os.path.join(ROOT, "build/release/plash"), "run", path, "-j", str(threads), "-o", out],
                   check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(out, "summary.json")) as file:
        return json.load(file)


def main():
    threads = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    cycles = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    cases = [("tube", 12544, tube(56, 56, cycles)), ("tube", 50176, tube(112, 112, cycles)),
             ("tube", 200704, tube(224, 224, cycles)), ("bellows", 204800, bellows(400, 512, 16, cycles))]
    print("| case | shells | SOFT | cycles | us per cycle and shell without | with contact | on top | balance error |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for name, shells, deck in cases:
            plain = run(deck, threads, folder)
            for soft in (0, 1):
                with_contact = run(deck + CONTACT.format(soft=soft), threads, folder)
                cost = [1e6 * r["wall_seconds"] / (r["cycles"] * shells) for r in (plain, with_contact)]
                print(f"| {name} | {shells} | {soft} | {with_contact['cycles']} | {cost[0]:.4f} | {cost[1]:.4f} | "
                      f"{100 * (cost[1] / cost[0] - 1):.0f} % | {100 * with_contact['energy']['balance_error_max']:.2f} % |",
                      flush=True)


main()
