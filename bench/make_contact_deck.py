#!/usr/bin/env python3
"""Writes four sheets of shells that are pressed together and slide on one another (units: t, mm, s).

    python3 bench/make_contact_deck.py [--cells 224] [--sheets 4] [--contact 0|1] [--time 1e-5] > deck.k

4 x 224 x 224 = 200,704 shells of 1 mm, 0.4 mm apart, so that with the contact thickness of 0.4 mm every node touches
the sheet above and the sheet below: as much contact as a single surface can have.
"""
import argparse
import math
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--cells", type=int, default=224)
parser.add_argument("--sheets", type=int, default=4)
parser.add_argument("--contact", type=int, default=1)
parser.add_argument("--time", type=float, default=2e-5)
arguments = parser.parse_args()
cells, sheets = arguments.cells, arguments.sheets
out = sys.stdout.write

out(f"""*KEYWORD
*TITLE
{sheets} sheets of {cells} x {cells} shells sliding on one another
*CONTROL_TERMINATION
{arguments.time:10.3g}
*CONTROL_ENERGY
         2         2         2
*DATABASE_GLSTAT
{arguments.time / 10:10.3g}
*SECTION_SHELL
         1         2     0.833         3
       1.0       1.0       1.0       1.0
*MAT_PIECEWISE_LINEAR_PLASTICITY
         1   7.85e-9     2.1e5       0.3     250.0

       0.0      0.05       0.2       1.0
     250.0     320.0     400.0     500.0
""")
for sheet in range(sheets):
    out(f"*PART\nsheet\n{sheet + 1:10d}         1         1\n")
if arguments.contact:
    out("""*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID
         1sheets
         0
       0.1       0.1

""")
out("*NODE\n")
number = lambda sheet, i, j: 1 + i + (cells + 1) * (j + (cells + 1) * sheet)
for sheet in range(sheets):
    turn = 0.1 * sheet
    for j in range(cells + 1):
        for i in range(cells + 1):
            # Each sheet is turned a little, so that meshes do not match.
            u, v = i - cells / 2, j - cells / 2
            x, y = u * math.cos(turn) - v * math.sin(turn), u * math.sin(turn) + v * math.cos(turn)
            out(f"{number(sheet, i, j):8d}{x:16.9f}{y:16.9f}{0.39 * sheet:16.9f}\n")
out("*ELEMENT_SHELL\n")
element = 0
for sheet in range(sheets):
    for j in range(cells):
        for i in range(cells):
            element += 1
            corners = (number(sheet, i, j), number(sheet, i + 1, j), number(sheet, i + 1, j + 1), number(sheet, i, j + 1))
            out(f"{element:8d}{sheet + 1:8d}" + "".join(f"{c:8d}" for c in corners) + "\n")
for sheet in range(sheets):
    first, last = number(sheet, 0, 0), number(sheet, cells, cells)
    out(f"*SET_NODE_LIST_GENERATE\n{sheet + 1:10d}\n{first:10d}{last:10d}\n")
    out(f"*INITIAL_VELOCITY\n{sheet + 1:10d}\n{2000.0 * (-1) ** sheet:10.1f}{0.0:10.1f}"
        f"{-1000.0 * (2 * sheet / max(sheets - 1, 1) - 1):10.1f}\n")
out("*END\n")
