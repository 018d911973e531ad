#!/usr/bin/env python3
"""Writes a lid-driven cavity: side 1, lid speed 1, density 1, speed of sound 10 (any consistent units).

    python3 make_deck.py sph --reynolds 100 --side 32 --turns 12 > sph.k
    python3 make_deck.py ale --reynolds 100 --side 32 --turns 20 > ale.k
    python3 make_deck.py ale --reynolds 3200 --side 128 --turns 30 --start 64 results/of_64_with_all > finer.k
    python3 make_deck.py sph --reynolds 1000 --side 128 --turns 15 --start 64 results/of_64 > finer_sph.k

sph: walls are planes that the fluid sticks to (*PLASH_SPH_WALL). ale: the Eulerian fluid, nodes of the walls held, the
lid's corners among them (a corner that moves with the lid drives fluid through the wall beside it). Turns: time in sides over the
lid's speed. A fine mesh comes to its steady state sooner from a coarser one's: --all lets a run write the velocities of all nodes,
--start SIDE DIRECTORY begins with them. judge.py compares the velocities on the centre lines with reference.csv.
"""
import argparse
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import curves  # noqa: E402

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
         4       0.0       0.0{args.shift:10.1f}       0.0         0       0.1         1
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
    text += velocities_of_particles(side, *args.start) if args.start else ""
    return text + text_of_nodes + text_of_particles + "*END\n"


def velocities_of_particles(side, coarse_side, folder):
    """Initial velocities: means of the particles of the last three states of a run with other ones, by a kernel."""
    coarse_side = int(coarse_side)
    reach, sums = 2.0 / coarse_side, [[0.0, 0.0, 0.0] for _ in range(side * side)]
    for number, rows in curves.nodes(folder).items():
        for row in rows[-3:]:
            x = ((number - 1) % coarse_side + 0.5) / coarse_side + row[1]
            y = ((number - 1) // coarse_side + 0.5) / coarse_side + row[2]
            for i in range(max(0, int((x - reach) * side)), min(side, int((x + reach) * side) + 1)):
                for j in range(max(0, int((y - reach) * side)), min(side, int((y + reach) * side) + 1)):
                    q = math.hypot((i + 0.5) / side - x, (j + 0.5) / side - y) / reach
                    if q < 1:
                        weight, at = (1 - q) ** 4 * (1 + 4 * q), sums[i + side * j]
                        at[0] += weight
                        at[1] += weight * row[4]
                        at[2] += weight * row[5]
    return "*INITIAL_VELOCITY_NODE\n" + "".join(
        f"{number},{u / weight:.6g},{v / weight:.6g},0\n" for number, (weight, u, v) in enumerate(sums, 1))


def velocities(cells, coarse_cells, folder):
    """Initial velocities: those at the end of a run on another mesh, linear between its nodes."""
    coarse_cells = int(coarse_cells)
    end = {number: (rows[-1][4], rows[-1][6]) for number, rows in curves.nodes(folder).items()}
    text = "*INITIAL_VELOCITY_NODE\n"
    for k in range(1, cells):
        row = min(k * coarse_cells // cells, coarse_cells - 1)
        z = k * coarse_cells / cells - row
        for i in range(1, cells):
            column = min(i * coarse_cells // cells, coarse_cells - 1)
            x = i * coarse_cells / cells - column
            corners = [end[1 + column + dx + (coarse_cells + 1) * 2 * (row + dz)] for dz in (0, 1) for dx in (0, 1)]
            weights = [(1 - x) * (1 - z), x * (1 - z), (1 - x) * z, x * z]
            u, w = (sum(weight * corner[axis] for weight, corner in zip(weights, corners)) for axis in (0, 1))
            for j in (0, 1):
                text += f"{1 + i + (cells + 1) * (j + 2 * k)},{u:.6g},0,{w:.6g}\n"
    return text


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
*PLASH_ALE_FORMULATION
$   smooth: slopes of the velocity are not limited where its jumps are below this share of the speed of sound
{args.smooth:10.4g}
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
4,0.0001,0.9999,-1,1,0.9999,2
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
"""
    text += velocities(cells, *args.start) if args.start else ""
    text += "*SET_NODE_LIST\n9\n"
    if args.all:
        return text + lines_of_eight(range(1, 2 * (cells + 1) ** 2 + 1)) + "*END\n"
    middle = cells // 2
    lines = [(middle, k) for k in range(cells + 1)] + [(i, middle) for i in range(cells + 1) if i != middle]
    return text + lines_of_eight([1 + i + (cells + 1) * 2 * k for i, k in lines]) + "*END\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("fluid", choices=("sph", "ale"))
    parser.add_argument("--reynolds", type=float, default=100)
    parser.add_argument("--side", type=int, default=32, help="particles or cells along a side; even")
    parser.add_argument("--turns", type=float, default=12)
    parser.add_argument("--shift", type=float, default=1, help="sph: strength of particle shifting, docs/sph.md")
    parser.add_argument("--smooth", type=float, default=0.2, help="ale: docs/eulerian.md; 0: plain van Leer")
    parser.add_argument("--all", action="store_true", help="ale: write the velocities of all nodes at the end")
    parser.add_argument("--start", nargs=2, metavar=("SIDE", "DIRECTORY"),
                        help="begin with the end of a run of SIDE x SIDE particles, or cells (made with --all)")
    args = parser.parse_args()
    print({"sph": sph, "ale": ale}[args.fluid](args), end="")


if __name__ == "__main__":
    main()
