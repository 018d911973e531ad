#!/usr/bin/env python3
"""Writes a copper bar of one-point hexes (MAT_003) that hits a rigid wall (units: kg, m, s).

    python3 bench/make_hex_deck.py [--cells 40 40 64] [--hourglass 4] [--time 6e-6] > deck.k

40 x 40 x 64 = 102,400 elements; the bar is Taylor's: 6.4 mm square, 32.4 mm long, 227 m/s.
"""
import argparse
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--cells", type=int, nargs=3, default=(40, 40, 64))
parser.add_argument("--hourglass", type=int, default=4)
parser.add_argument("--time", type=float, default=6e-6)
arguments = parser.parse_args()
nx, ny, nz = arguments.cells
side, length = 6.4e-3, 32.4e-3
number = lambda i, j, k: 1 + i + (nx + 1) * (j + (ny + 1) * k)
out = sys.stdout.write

out(f"""*KEYWORD
*TITLE
Copper bar, {nx * ny * nz} one-point hexes
*CONTROL_TERMINATION
{arguments.time:10.3g}
*CONTROL_ENERGY
         2         2
*DATABASE_GLSTAT
{arguments.time / 10:10.3g}
*PART
bar
         1         1         1         0         1
*SECTION_SOLID
         1         1
*MAT_PLASTIC_KINEMATIC
         1      8930   1.17e11      0.35     4.0e8     1.0e8       1.0
         0.0
*HOURGLASS
         1{arguments.hourglass:10d}      0.05
*INITIAL_VELOCITY
         0
       0.0       0.0    -227.0
*RIGIDWALL_PLANAR
         0
       0.0       0.0       0.0       0.0       0.0       1.0
*NODE
""")
for k in range(nz + 1):
    for j in range(ny + 1):
        for i in range(nx + 1):
            out(f"{number(i, j, k):8d}{side * i / nx:16.8e}{side * j / ny:16.8e}{length * k / nz:16.8e}\n")
out("*ELEMENT_SOLID\n")
element = 0
for k in range(nz):
    for j in range(ny):
        for i in range(nx):
            element += 1
            a, b = number(i, j, k), number(i, j, k + 1)
            corners = (a, a + 1, a + nx + 2, a + nx + 1, b, b + 1, b + nx + 2, b + nx + 1)
            out(f"{element:8d}{1:8d}" + "".join(f"{node:8d}" for node in corners) + "\n")
out("*END\n")
