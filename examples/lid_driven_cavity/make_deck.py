#!/usr/bin/env python3
"""Writes a lid-driven cavity: side 1, lid speed 1, density 1, speed of sound 10 (any consistent units).

    python3 make_deck.py sph --reynolds 100 --side 32 --turns 12 > sph.k
    python3 make_deck.py ale --reynolds 100 --side 32 --turns 20 > ale.k

sph: walls are planes that the fluid sticks to (*PLASH_SPH_WALL). ale: the Eulerian fluid, nodes of the walls held. Turns:
time in sides over the lid's speed. judge.py compares the velocities on the centre lines with reference.csv.
"""
import argparse

SOUND = 10.0


def lines_of_eight(numbers):
    return "".join(",".join(map(str, numbers[i:i + 8])) + "\n" for i in range(0, len(numbers), 8))


def sph(args):
    side, spacing = args.side, 1.0 / args.side
    text = f"""*KEYWORD
*TITLE
Cavity by particles, Re {args.reynolds:g}, {side} x {side}
$ written by make_deck.py
*CONTROL_TERMINATION
{args.turns:10.4g}
*CONTROL_TIMESTEP
         0       0.8
*CONTROL_SPH
$ plane; FORM 6: volumes as weights, corrected gradients
         1         0     1e+20         2         0         6
*PLASH_SPH_FORMULATION
$   kernel     delta      xsph     shift   tensile    filter      skin      visc
         4       0.0       0.0       1.0       0.0         0       0.1         1
*CONTROL_BULK_VISCOSITY
     1e-09     1e-09
$ floor, sides, lid: a point, a point further in, then the velocity
*PLASH_SPH_WALL
         0         0         0         0         1         0
         0         0         0
*PLASH_SPH_WALL
         0         0         0         1         0         0
         0         0         0
*PLASH_SPH_WALL
         1         0         0         0         0         0
         0         0         0
*PLASH_SPH_WALL
         0         1         0         0         0         0
         1         0         0
*DATABASE_GLSTAT
{args.turns / 100:10.4g}
*DATABASE_BINARY_D3PLOT
{args.turns / 10:10.4g}
*DATABASE_NODOUT
{args.turns / 40:10.4g}
*DATABASE_HISTORY_NODE_SET
         1
*MAT_NULL
$ no cut-off: all is under tension somewhere
         1       1.0    -1e+20{1 / args.reynolds:10.4g}
*EOS_LINEAR_POLYNOMIAL
$    eosid        c0        c1
         1       0.0{SOUND ** 2:10.4g}

*SECTION_SPH
         1       1.5       0.2         2
"""
    text += "*PART\nfluid\n         1         1         1         1\n*SET_NODE_LIST\n         1\n"
    text += lines_of_eight(range(1, side * side + 1))
    text_of_nodes, text_of_particles = "*NODE\n", "*ELEMENT_SPH\n"
    for j in range(side):
        for i in range(side):
            number = 1 + i + side * j
            text_of_nodes += f"{number},{(i + 0.5) * spacing:.8g},{(j + 0.5) * spacing:.8g},0\n"
            text_of_particles += f"{number},1,{spacing ** 2:.8g}\n"
    # The plane's other direction is held.
    text += "*BOUNDARY_SPC_SET\n         1         0         0         0         1\n"
    return text + text_of_nodes + text_of_particles + "*END\n"


def ale(args):
    cells, size = args.side, 1.0 / args.side
    text = f"""*KEYWORD
*TITLE
Cavity by the Eulerian fluid, Re {args.reynolds:g}, {cells} x {cells}
$ written by make_deck.py; the cavity lies in x and z
*CONTROL_TERMINATION
{args.turns:10.4g}
*CONTROL_TIMESTEP
         0      0.67
*CONTROL_BULK_VISCOSITY
     1e-09     1e-09
*CONTROL_ALE
        -1         1         2        -1
,,,,,2
*ALE_STRUCTURED_MESH
1,10,1,1
1,2,3
"""
    for axis, (count, length) in enumerate(((cells, 1.0), (1, size), (cells, 1.0)), 1):
        text += f"*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{axis}\n1,0\n{count + 1},{length}\n"
    text += f"""*ALE_MULTI-MATERIAL_GROUP
1,1
*PART
fluid
1,1,1,1
*SECTION_SOLID
1,11
*MAT_NULL
1,1.0,-1e9,{1 / args.reynolds}
*EOS_LINEAR_POLYNOMIAL
1,0,{SOUND ** 2}

*DEFINE_BOX
1,-1,0.0001,-1,1,-1,2
*DEFINE_BOX
2,0.9999,2,-1,1,-1,2
*DEFINE_BOX
3,-1,2,-1,1,-1,0.0001
*DEFINE_BOX
4,-1,2,-1,1,0.9999,2
*SET_NODE_GENERAL
1
BOX,1,2,3
*SET_NODE_GENERAL
2
BOX,4
*BOUNDARY_SPC_SET
1,0,1,1,1
*BOUNDARY_PRESCRIBED_MOTION_SET
2,1,0,1
*DEFINE_CURVE
1
0,1
1e5,1
*DATABASE_GLSTAT
{args.turns / 100:10.4g}
*DATABASE_BINARY_D3PLOT
{args.turns / 10:10.4g}
*DATABASE_NODOUT
{args.turns:10.4g}
*DATABASE_HISTORY_NODE_SET
9
*SET_NODE_LIST
9
"""
    middle = cells // 2
    lines = [(middle, k) for k in range(cells + 1)] + [(i, middle) for i in range(cells + 1) if i != middle]
    return text + lines_of_eight([1 + i + (cells + 1) * 2 * k for i, k in lines]) + "*END\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fluid", choices=("sph", "ale"))
    parser.add_argument("--reynolds", type=float, default=100)
    parser.add_argument("--side", type=int, default=32, help="particles or cells along a side; even")
    parser.add_argument("--turns", type=float, default=12)
    args = parser.parse_args()
    print({"sph": sph, "ale": ale}[args.fluid](args), end="")


if __name__ == "__main__":
    main()
