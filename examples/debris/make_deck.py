#!/usr/bin/env python3
"""Writes debris.k: a steel rod through an aluminium plate whose failing solids become particles
(units: g, mm, ms, N, MPa).

    python3 make_deck.py [cells through the plate, default 4] > debris.k
"""
import sys

PLATE = (32.0, 32.0, 4.0)   # [mm]
ROD = (6.0, 6.0, 18.0)      # [mm]
SPEED = 500.0               # [mm/ms], downwards
END_TIME = 0.08             # [ms]


def block(part, low, size, cells, nodes, solids):
    """A block of hexahedra; returns the numbers of its nodes by their place (i, j, k)."""
    number = {}
    for k in range(cells[2] + 1):
        for j in range(cells[1] + 1):
            for i in range(cells[0] + 1):
                number[i, j, k] = len(nodes) + 1
                nodes.append([low[a] + size[a] * n / cells[a] for a, n in enumerate((i, j, k))])
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                face = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                solids.append((part, [number[a, b, k] for a, b in face] + [number[a, b, k + 1] for a, b in face]))
    return number


def main():
    through = int(sys.argv[1]) if len(sys.argv) > 1 else 4
    cell = PLATE[2] / through
    cells = lambda size: [max(1, round(length / cell)) for length in size]
    nodes, solids = [], []
    plate = block(1, (-PLATE[0] / 2, -PLATE[1] / 2, -PLATE[2]), PLATE, cells(PLATE), nodes, solids)
    rod_start = len(nodes)
    block(2, (-ROD[0] / 2, -ROD[1] / 2, 0.05), ROD, cells(ROD), nodes, solids)
    count = cells(PLATE)
    held = [n for (i, j, k), n in plate.items() if i in (0, count[0]) or j in (0, count[1])]
    print(f"""*KEYWORD
*TITLE
A steel rod through a plate: its debris
$ units: g, mm, ms, N, MPa; written by make_deck.py
*PARAMETER
$     ICPL 0: debris, 1: bonded with the plate
I     ICPL         1
*CONTROL_TERMINATION
{END_TIME:10.4g}
*CONTROL_ENERGY
         2         2         1         2
*CONTROL_SPH
$     ncbs     boxid        dt      idim   nmneigh      form
         0         0         0         3         0        12
*DATABASE_GLSTAT
 5.000e-04
*DATABASE_MATSUM
 5.000e-04
*DATABASE_BINARY_D3PLOT
 4.000e-03
*PART
plate
         1         1         1
*PART
rod
         2         1         2
*PART
debris
         3         3         3
*SECTION_SOLID
         1         1
*SECTION_SPH
         3
*MAT_PLASTIC_KINEMATIC
$      mid        ro         e        pr      sigy      etan      beta
         1   2.7E-03   70000.0      0.33     300.0     500.0       1.0
$      src       srp        fs
         0         0       0.5
*MAT_PLASTIC_KINEMATIC
         2  7.85E-03  210000.0       0.3    1200.0    1000.0       1.0
         0         0         0
$ of the debris: as the plate, but it does not fail again
*MAT_PLASTIC_KINEMATIC
         3   2.7E-03   70000.0      0.33     300.0     500.0       1.0
         0         0         0
*DEFINE_ADAPTIVE_SOLID_TO_SPH
$     ipid     itype        nq     ipsph     issph      icpl      iopt
         1         0         1         3         3     &ICPL         1
*CONTACT_ERODING_SURFACE_TO_SURFACE
$     ssid      msid     sstyp     mstyp
         2         1         3         3
$       fs        fd
      0.10      0.10
         0         0
$     isym    erosop      iadj
         0         1         1
*CONTACT_AUTOMATIC_NODES_TO_SURFACE
$ debris on the rod
         3         2         3         3
         0         0
         0         0
*INITIAL_VELOCITY_GENERATION
$       id      styp     omega        vx        vy        vz
         2         2         0         0         0{-SPEED:10.4g}
         0         0
*BOUNDARY_SPC_SET
         1         0         1         1         1
*SET_NODE_LIST
         1""")
    for first in range(0, len(held), 8):
        print("".join(f"{n:10d}" for n in held[first:first + 8]))
    print("*NODE")
    for n, (x, y, z) in enumerate(nodes):
        print(f"{n + 1:8d}{x:16.7g}{y:16.7g}{z:16.7g}")
    print("*ELEMENT_SOLID")
    for n, (part, corners) in enumerate(solids):
        print(f"{n + 1:8d}{part:8d}" + "".join(f"{c:8d}" for c in corners))
    print("*END")


main()
