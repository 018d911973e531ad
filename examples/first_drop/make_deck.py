#!/usr/bin/env python3
"""Writes first_drop.k: a rubber ball that hits a rigid wall and bounces (units: t, mm, s, N, MPa).

    python3 make_deck.py [cells across the ball, default 10] > first_drop.k
"""
import sys

RADIUS = 50.0       # [mm]
DENSITY = 1.1e-9    # [t/mm^3]
YOUNG = 10.0        # [MPa]
POISSON = 0.45
SPEED = 8000.0      # [mm/s], downwards
GAP = 1.0           # [mm] between ball and wall at the start
END_TIME = 6.0e-3   # [s]


def ball_point(i, j, k, cells):
    """A point of the cube [-1, 1]^3 moved into the ball: shells of the cube become spheres near the surface."""
    a, b, c = (2.0 * n / cells - 1.0 for n in (i, j, k))
    shell = max(abs(a), abs(b), abs(c))
    if shell == 0.0:
        return 0.0, 0.0, RADIUS + GAP
    length = (a * a + b * b + c * c) ** 0.5
    round_share = shell            # 0 in the centre (cube), 1 on the surface (sphere)
    stretch = RADIUS * ((1.0 - round_share) * 0.6 + round_share * shell / length)
    return a * stretch, b * stretch, c * stretch + RADIUS + GAP


def main():
    cells = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    side = cells + 1
    number = lambda i, j, k: 1 + i + side * (j + side * k)
    print(f"""*KEYWORD
*TITLE
A rubber ball on a rigid wall
$ units: t, mm, s, N, MPa; written by make_deck.py
*CONTROL_TERMINATION
$   endtim
{END_TIME:10.4g}
*CONTROL_ENERGY
$     hgen      rwen
         2         2
*DATABASE_GLSTAT
$       dt
 5.000e-05
*DATABASE_MATSUM
 5.000e-05
*DATABASE_BINARY_D3PLOT
 2.500e-04
*PART
ball
$      pid     secid       mid     eosid      hgid
         1         1         1         0         1
*SECTION_SOLID
$    secid    elform
         1         1
*MAT_ELASTIC
$      mid        ro         e        pr
         1{DENSITY:10.3g}{YOUNG:10.4g}{POISSON:10.4g}
*HOURGLASS
$     hgid       ihq        qm
         1         6       1.0
*INITIAL_VELOCITY
$     nsid    nsidex
         0
$       vx        vy        vz
       0.0       0.0{-SPEED:10.4g}
*RIGIDWALL_PLANAR
$     nsid
         0
$       xt        yt        zt        xh        yh        zh      fric
       0.0       0.0       0.0       0.0       0.0       1.0       0.0
*NODE""")
    for k in range(side):
        for j in range(side):
            for i in range(side):
                x, y, z = ball_point(i, j, k, cells)
                print(f"{number(i, j, k):8d}{x:16.6f}{y:16.6f}{z:16.6f}")
    print("*ELEMENT_SOLID")
    element = 0
    for k in range(cells):
        for j in range(cells):
            for i in range(cells):
                element += 1
                lower = (number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k))
                corners = lower + tuple(node + side * side for node in lower)
                print(f"{element:8d}{1:8d}" + "".join(f"{node:8d}" for node in corners))
    print("*END")


main()
