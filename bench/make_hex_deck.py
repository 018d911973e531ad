#!/usr/bin/env python3
"""Writes a copper bar of hexes, tetrahedra or thick shells (MAT_003) that hits a rigid wall (units: kg, m, s).

    python3 bench/make_hex_deck.py [--cells 40 40 64] [--hourglass 4] [--formulation 1] [--thick POINTS] [--time 6e-6] > deck.k

40 x 40 x 64 = 102,400 elements, six times as many with --formulation 10, 13, 16 or 17 (tetrahedra); the bar is Taylor's: 6.4 mm square, 32.4 mm long, 227 m/s.
"""
import argparse
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--cells", type=int, nargs=3, default=(40, 40, 64))
parser.add_argument("--hourglass", type=int, default=4)
parser.add_argument("--formulation", type=int, default=1)
parser.add_argument("--thick", type=int, default=0, help="thick shells across the bar, so many points each")
parser.add_argument("--time", type=float, default=6e-6)
arguments = parser.parse_args()
nx, ny, nz = arguments.cells
side, length = 6.4e-3, 32.4e-3
tetrahedra = arguments.formulation in (10, 13, 16, 17)
fine = 2 if arguments.formulation in (16, 17) else 1  # ten-node tetrahedra have nodes half-way, too
rx, ry, rz = fine * nx + 1, fine * ny + 1, fine * nz + 1
number = lambda i, j, k: 1 + i + rx * (j + ry * k)
out = sys.stdout.write
section = f"*SECTION_SOLID\n{1:10d}{arguments.formulation:10d}"
if arguments.thick:
    section = f"*SECTION_TSHELL\n{1:10d}{arguments.formulation:10d}{0.8333:10.4f}{arguments.thick:10d}"

out(f"""*KEYWORD
*TITLE
Copper bar, {nx * ny * nz} cells
*CONTROL_TERMINATION
{arguments.time:10.3g}
*CONTROL_ENERGY
         2         2
*DATABASE_GLSTAT
{arguments.time / 10:10.3g}
*PART
bar
         1         1         1         0         1
{section}
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
for k in range(rz):
    for j in range(ry):
        for i in range(rx):
            out(f"{number(i, j, k):8d}{side * i / (rx - 1):16.8e}{side * j / (ry - 1):16.8e}{length * k / (rz - 1):16.8e}\n")
out("*ELEMENT_TSHELL\n" if arguments.thick else "*ELEMENT_SOLID\n")
element = 0
for k in range(nz):
    for j in range(ny):
        for i in range(nx):
            corners = [number(fine * (i + a), fine * (j + b), fine * (k + c)) for a, b, c in
                       ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]
            if tetrahedra:
                # Six tetrahedra about the diagonal from corner 0 to corner 6 (Kuhn 1960).
                shapes = [[corners[n] for n in (0, p, q, 6)] for p, q in
                          ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))]
            else:
                shapes = [corners]
            for shape in shapes:
                element += 1
                if fine == 2:
                    shape += [(shape[p] + shape[q]) // 2 for p, q in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
                    out(f"{element:8d}{1:8d}\n" + "".join(f"{node:8d}" for node in shape) + "\n")
                    continue
                nodes = list(shape) + [shape[-1]] * (8 - len(shape))
                out(f"{element:8d}{1:8d}" + "".join(f"{node:8d}" for node in nodes) + "\n")
out("*END\n")
