#!/usr/bin/env python3
"""Writes a cubic lattice of steel beams that hits a rigid wall (units: t, mm, s).

    python3 bench/make_beam_deck.py [--cells 32] [--formulation 1] [--time 1e-4] > deck.k

32 x 32 x 32 joints, 5 mm apart, with beams of 1 mm along all three axes: 95,232 elements at 10 m/s.
"""
import argparse
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--cells", type=int, default=32, help="joints along an edge")
parser.add_argument("--formulation", type=int, default=1)
parser.add_argument("--time", type=float, default=1e-4)
arguments = parser.parse_args()
n, spacing = arguments.cells, 5.0
number = lambda i, j, k: 1 + i + n * (j + n * k)
out = sys.stdout.write
if arguments.formulation == 2:
    section = "       1.0    0.0833    0.0833    0.1667     0.833\n"
    material = "*MAT_ELASTIC\n         1   7.85e-9     2.1e5       0.3\n"
else:
    section = "       1.0       1.0       1.0       1.0\n"
    material = ("*MAT_PIECEWISE_LINEAR_PLASTICITY\n         1   7.85e-9     2.1e5       0.3     250.0    1000.0\n"
                "\n\n\n")

out(f"""*KEYWORD
*TITLE
Lattice of beams, ELFORM {arguments.formulation}
*CONTROL_TERMINATION
{arguments.time:10.3g}
*DATABASE_GLSTAT
{arguments.time / 10:10.3g}
*PART
lattice
         1         1         1
*SECTION_BEAM
         1{arguments.formulation:10d}     0.833
{section}{material}*INITIAL_VELOCITY
         0
       0.0       0.0   -1.0e4
*RIGIDWALL_PLANAR
         0
       0.0       0.0       0.0       0.0       0.0       1.0
*NODE
""")
for k in range(n):
    for j in range(n):
        for i in range(n):
            out(f"{number(i, j, k):8d}{spacing * i:16.8e}{spacing * j:16.8e}{spacing * k:16.8e}\n")
third = n ** 3 + 1  # three nodes far away turn the sections
for axis in range(3):
    place = [0.0, 0.0, 0.0]
    place[axis] = 1e4
    out(f"{third + axis:8d}" + "".join(f"{value:16.8e}" for value in place) + "\n")
out("*ELEMENT_BEAM\n")
element = 0
for k in range(n):
    for j in range(n):
        for i in range(n):
            for axis, step in enumerate(((1, 0, 0), (0, 1, 0), (0, 0, 1))):
                other = (i + step[0], j + step[1], k + step[2])
                if max(other) >= n:
                    continue
                element += 1
                out(f"{element:8d}{1:8d}{number(i, j, k):8d}{number(*other):8d}{third + (axis + 1) % 3:8d}\n")
out("*END\n")
