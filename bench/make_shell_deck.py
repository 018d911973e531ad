#!/usr/bin/env python3
"""Writes a square steel tube of shells (MAT_024) that hits a rigid wall (units: t, mm, s).

    python3 bench/make_shell_deck.py [--cells 80 320] [--points 3] [--formulation 2] [--time 1e-4] > deck.k

Four sides of 80 x 320 shells = 102,400 elements; 400 mm long, 100 mm wide, 1.5 mm thick, 10 m/s.
"""
import argparse
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--cells", type=int, nargs=2, default=(80, 320))
parser.add_argument("--points", type=int, default=3)
parser.add_argument("--formulation", type=int, default=2)
parser.add_argument("--time", type=float, default=5e-5)
arguments = parser.parse_args()
across, along = arguments.cells
width, length = 100.0, 400.0
around = 4 * across
number = lambda i, k: 1 + i % around + around * k
out = sys.stdout.write


def outline(i):
    side, step = divmod(i, across)
    s = width * step / across
    return ((s, 0.0), (width, s), (width - s, width), (0.0, width - s))[side]


out(f"""*KEYWORD
*TITLE
Square tube, {around * along} shells with {arguments.points} points
*CONTROL_TERMINATION
{arguments.time:10.3g}
*CONTROL_ENERGY
         2         2
*DATABASE_GLSTAT
{arguments.time / 10:10.3g}
*PART
tube
         1         1         1
*SECTION_SHELL
         1{arguments.formulation:10d}     0.833{arguments.points:10d}
       1.5       1.5       1.5       1.5
*MAT_PIECEWISE_LINEAR_PLASTICITY
         1   7.85e-9     2.1e5       0.3     250.0

       0.0      0.05       0.2       1.0
     250.0     320.0     400.0     500.0
*INITIAL_VELOCITY
         0
       0.0       0.0   -1.0e4
*RIGIDWALL_PLANAR
         0
       0.0       0.0       0.0       0.0       0.0       1.0
*NODE
""")
for k in range(along + 1):
    for i in range(around):
        x, y = outline(i)
        # A faint wave in the walls decides where they fold.
        z = length * k / along
        wave = 1.0 + 0.002 * (1 if (k * 8 // along) % 2 else -1)
        out(f"{number(i, k):8d}{width / 2 + (x - width / 2) * wave:16.8f}{width / 2 + (y - width / 2) * wave:16.8f}{z:16.8f}\n")
out("*ELEMENT_SHELL\n")
element = 0
for k in range(along):
    for i in range(around):
        element += 1
        out(f"{element:8d}{1:8d}{number(i, k):8d}{number(i + 1, k):8d}{number(i + 1, k + 1):8d}{number(i, k + 1):8d}\n")
out("*END\n")
