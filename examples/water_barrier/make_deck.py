#!/usr/bin/env python3
"""Writes the decks of the water-filled barrier and of the tank drop into this folder (units: t, mm, s, N, MPa).

    python3 make_deck.py             all decks, with water of 6 layers at full height
    python3 make_deck.py water 12    the barrier's water with 12 layers at full height (8,640 particles, as in the paper)

The barrier of a paper from Queensland University of Technology (portable water-filled road barriers, coupled SPH and
FEM), at 1:10: a tank of HDPE, filled to 0, 30, 50, 80 or 100 %, hit by a rigid block at 20 degrees; and the tank drop
with which that paper checks its coupling. README.md says what is assumed.
"""
import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
BLOCK, TANK, WATER = 1, 2, 3
WATER_DENSITY = 1000e-12  # [t/mm^3]


def write(name, text):
    with open(os.path.join(FOLDER, name), "w") as file:
        file.write(text)


def box_shell(sizes, cells, corner):
    """Nodes and shells of a closed box, normals outwards; nodes counted from 0."""
    numbers, nodes, shells = {}, [], []

    def node(i, j, k):
        if (i, j, k) not in numbers:
            numbers[i, j, k] = len(nodes)
            nodes.append(tuple(c + s * n / count for c, s, n, count in zip(corner, sizes, (i, j, k), cells)))
        return numbers[i, j, k]

    for axis in range(3):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, cells[axis]):
            for p in range(cells[a]):
                for q in range(cells[b]):
                    ring = [(p, q), (p + 1, q), (p + 1, q + 1), (p, q + 1)]
                    corners = []
                    for u, v in ring if side else ring[::-1]:
                        place = [0, 0, 0]
                        place[axis], place[a], place[b] = side, u, v
                        corners.append(node(*place))
                    shells.append(corners)
    return nodes, shells


def mesh(nodes, first, keyword, part, elements, first_element=1):
    text = "*NODE\n" + "".join(f"{first + i},{x:.8g},{y:.8g},{z:.8g}\n" for i, (x, y, z) in enumerate(nodes))
    text += f"*{keyword}\n"
    for i, corners in enumerate(elements, first_element):
        text += f"{i},{part},{','.join(str(first + corner) for corner in corners)}\n"
    return text


def water_file(name, inner, corner, layers, fill, contact=2):
    """The lower `fill` of the inner box; layers as thick as those of the full box, as nearly as may be."""
    if fill == 0:
        write(name, "$ empty\n")
        return 0
    spacing = inner[2] / layers
    height = fill * inner[2]
    counts = [round(inner[0] / spacing), round(inner[1] / spacing), max(1, round(height / spacing))]
    steps = [inner[0] / counts[0], inner[1] / counts[1], height / counts[2]]
    nodes = [tuple(c + (n + 0.5) * s for c, n, s in zip(corner, (i, j, k), steps))
             for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])]
    mass = WATER_DENSITY * steps[0] * steps[1] * steps[2]
    text = f"""$ {len(nodes)} particles
*PART
water
{WATER:10d}{WATER:10d}{WATER:10d}{WATER:10d}
*SECTION_SPH
$    secid      cslh      hmin      hmax
{WATER:10d}       1.5       0.2         2
*MAT_NULL
$ cut off in tension: the water may part from the wall
{WATER:10d}{WATER_DENSITY:10.3g}    -1e-06     1e-09
*EOS_GRUNEISEN
$    eosid         c        s1
{WATER:10d}    &SOUND     1.979

*CONTROL_SPH
         1         0     1e+20         3
*PLASH_SPH_FORMULATION
$   kernel     delta
         4       0.1
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
{contact:10d}water in tank
{WATER:10d}{TANK:10d}         3         3

         1         1{spacing:10.4g}
         1       0.1
*NODE
"""
    text += "".join(f"{20001 + i},{x:.8g},{y:.8g},{z:.8g}\n" for i, (x, y, z) in enumerate(nodes))
    text += "*ELEMENT_SPH\n" + "".join(f"{20001 + i},{WATER},{mass:.8g}\n" for i in range(len(nodes)))
    write(name, text)
    return len(nodes)


HEAD = """*KEYWORD
*TITLE
{title}
$ units: t, mm, s, N, MPa; written by make_deck.py
*PARAMETER
$ speed [mm/s], sound in the water [mm/s], fill level [%], layers of particles in a full tank, end [s]
R    SPEED{speed:10.4g}R    SOUND{sound:10.4g}I     FILL{fill:10d}I   LAYERS{layers:10d}
R      END{end:10.4g}
*PARAMETER_EXPRESSION
R    EVERY &END/600
R   STATES &END/20
*CONTROL_TERMINATION
      &END
*CONTROL_ENERGY
         2         2         2
*DATABASE_GLSTAT
    &EVERY
*DATABASE_MATSUM
    &EVERY
*DATABASE_RCFORC
    &EVERY
*DATABASE_RWFORC
    &EVERY
*DATABASE_NODOUT
   &STATES
*DATABASE_HISTORY_NODE_SET
$ all nodes: tells whether a particle is outside
         9
*SET_NODE_GENERAL
         9
       ALL
*DATABASE_BINARY_D3PLOT
   &STATES
*LOAD_BODY_Z
         1    9810.0
*DEFINE_CURVE
         1
                 0.0                 1.0
                 1.0                 1.0
*RIGIDWALL_PLANAR
$ the ground, without friction
         0
       0.0       0.0{ground:10.4g}       0.0       0.0{above:10.4g}       0.0
*INCLUDE
{water}
"""

# -- the barrier -----------------------------------------------------------------------------------------------------
INNER, THICKNESS, CELLS = (120.0, 55.0, 37.5), 12.0, (12, 6, 4)  # [mm]; 288 shells
ANGLE, SPEED = 20.0, 500.0                 # [degree] between the block's way and the long face, [mm/s]
PLACE = (20.0, 30.0)                       # [mm] of the blow from the tank's end and its bottom
BLOCK_SIZE, BLOCK_CELLS, ROUND = (40.0, 30.0, 15.0), (10, 10, 4), 15.0  # [mm] along its way, across, up; radius of its front
STEEL_DENSITY, BLOCK_MASS = 7850e-12, 1.0e-3  # the mass [t] is assumed
GAP = 1.0                                  # [mm]


def barrier_water(layers):
    return [water_file(f"water_{fill}-{layers}.k", INNER, (0.0, 0.0, 0.0), layers, fill / 100)
            for fill in (0, 30, 50, 80, 100)]


def block():
    """Front on the circle at x = 0, way along +x; turned and moved to the tank's long face y = 0."""
    nodes, solids, numbers = [], [], {}
    c, s = math.cos(math.radians(ANGLE)), math.sin(math.radians(ANGLE))
    # The foremost point of a front with a normal across the face: the circle's centre is ROUND away from the face.
    outside = 0.5 * THICKNESS * 2 + GAP
    centre = (PLACE[0], -outside - ROUND)
    for k in range(BLOCK_CELLS[2] + 1):
        for j in range(BLOCK_CELLS[1] + 1):
            for i in range(BLOCK_CELLS[0] + 1):
                across = BLOCK_SIZE[1] * (j / BLOCK_CELLS[1] - 0.5)
                front = math.sqrt(max(0.0, ROUND ** 2 - across ** 2))
                along = front - (BLOCK_SIZE[0] - ROUND + front) * i / BLOCK_CELLS[0]
                numbers[i, j, k] = len(nodes)
                up = PLACE[1] + BLOCK_SIZE[2] * (k / BLOCK_CELLS[2] - 0.5)
                # Unit vectors: along (c, s) in the plan, across (-s, c).
                nodes.append((centre[0] + c * along - s * across, centre[1] + s * along + c * across, up))
    for k in range(BLOCK_CELLS[2]):
        for j in range(BLOCK_CELLS[1]):
            for i in range(BLOCK_CELLS[0]):
                ring = [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)]
                solids.append([numbers[a, b, d] for d in (k, k + 1) for a, b in ring])
    volume = 0.0  # of the prism, by its plan
    for j in range(BLOCK_CELLS[1]):
        a, b = (BLOCK_SIZE[1] * (n / BLOCK_CELLS[1] - 0.5) for n in (j, j + 1))
        depth = [BLOCK_SIZE[0] - ROUND + math.sqrt(max(0.0, ROUND ** 2 - w * w)) for w in (a, b)]
        volume += 0.5 * (depth[0] + depth[1]) * (b - a) * BLOCK_SIZE[2]
    return nodes, solids, volume


def barrier():
    barrier_water(6)
    half = 0.5 * THICKNESS
    tank_nodes, shells = box_shell([side + THICKNESS for side in INNER], CELLS, (-half, -half, -half))
    block_nodes, solids, volume = block()
    c, s = math.cos(math.radians(ANGLE)), math.sin(math.radians(ANGLE))
    text = HEAD.format(title="Block on a water-filled barrier", speed=SPEED, sound=1484e3, fill=50, layers=6, end=0.03,
                       ground=-half, above=1.0 - half, water="water_&FILL-&LAYERS.k")
    text += f"""*PARAMETER_EXPRESSION
R       VX {c:.8g}*&SPEED
R       VY {s:.8g}*&SPEED
*PART
block
{BLOCK:10d}{BLOCK:10d}{BLOCK:10d}
*SECTION_SOLID
{BLOCK:10d}         1
*MAT_RIGID
$ on its way in the plane, without turning
{BLOCK:10d}{BLOCK_MASS / volume:10.4g}    210000      0.28
       1.0         3         7

*PART
tank
{TANK:10d}{TANK:10d}{TANK:10d}
*SECTION_SHELL
{TANK:10d}        16         0         5
{THICKNESS:10g}
*MAT_PIECEWISE_LINEAR_PLASTICITY
$ HDPE
{TANK:10d}   9.4e-10    1100.0       0.4      22.0



*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID
         1block on tank
{BLOCK:10d}{TANK:10d}         3         3


         1       0.1
*INITIAL_VELOCITY_RIGID_BODY
{BLOCK:10d}       &VX       &VY
"""
    text += mesh(block_nodes, 1, "ELEMENT_SOLID", BLOCK, solids) + mesh(tank_nodes, 10001, "ELEMENT_SHELL", TANK, shells)
    write("barrier.k", text + "*END\n")


# -- the tank drop ---------------------------------------------------------------------------------------------------
DROP_INNER, DROP_THICKNESS, DROP_CELLS = (750.0, 718.0, 300.0), 2.0, (20, 19, 8)  # [mm]


def tank_drop():
    half = 0.5 * DROP_THICKNESS
    water_file("tank_water_80-8.k", DROP_INNER, (0.0, 0.0, 0.0), 8, 0.8)
    nodes, shells = box_shell([side + DROP_THICKNESS for side in DROP_INNER], DROP_CELLS, (-half, -half, -half))
    text = HEAD.format(title="Drop of a fuel tank", speed=10e3, sound=1484e3, fill=80, layers=8, end=0.02,
                       ground=-half - 1.0, above=0.0, water="tank_water_&FILL-&LAYERS.k")
    text += f"""*PART
tank
{TANK:10d}{TANK:10d}{TANK:10d}
*SECTION_SHELL
{TANK:10d}        16         0         5
{DROP_THICKNESS:10g}
*MAT_PIECEWISE_LINEAR_PLASTICITY
$ an aluminium alloy, assumed
{TANK:10d}   2.7e-09   70000.0      0.33     120.0     700.0



*INITIAL_VELOCITY_GENERATION
{TANK:10d}         2         0         0         0   -&SPEED

*INITIAL_VELOCITY_GENERATION
{WATER:10d}         2         0         0         0   -&SPEED

"""
    write("tank_drop.k", text + mesh(nodes, 10001, "ELEMENT_SHELL", TANK, shells) + "*END\n")


def main():
    if len(sys.argv) == 1:
        barrier()
        tank_drop()
    elif sys.argv[1] == "water":
        for layers in map(int, sys.argv[2:]):
            print(f"{layers} layers: {barrier_water(layers)} particles")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
