#!/usr/bin/env python3
"""Writes the guided ditching of a flat or curved panel (units: t, mm, s, N, MPa).

    python3 make_deck.py                     ditching.k with its moving basin and its panels, into this folder
    python3 make_deck.py --full              water_full.k: a tank as long as the run, to compare with
    python3 make_deck.py --radius 1500       a convex panel (-1500: concave)
    python3 make_deck.py --graded 20 80      water_graded.k: particles of 20 mm near the panel, 80 mm far away;
                                             prints the command that makes them
    python3 make_deck.py --spacing 25 ...    other sizes; see --help

The tests that Siemann & Groenenboom model ('Modeling and validation of guided ditching tests using a coupled SPH-FE
approach'): a panel of 1000 x 500 mm on a frame, pitched nose up, meets the water at 30 to 46 m/s and sinks at 1.5 m/s.
Half model. The water is a basin with periodic planes that go along with the panel and calm the wake before it comes in
again ahead of it. README.md says what is left away.
"""
import argparse
import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))
LENGTH, HALF_WIDTH, CELL, FRAME_CELLS = 1000.0, 250.0, 50.0, 1  # [mm]; the outer ring of cells is the frame
PANEL, FRAME, WATER = 1, 2, 3
DENSITY, SOUND = 1000e-12, 400e3  # [t/mm^3], [mm/s]: ten times the panel's speed
BEHIND, AHEAD, WIDTH, DEPTH = 600.0, 1640.0, 960.0, 640.0  # [mm] of water from the panel's rear edge, of half the basin
CALM = 200.0  # [mm]
GAUGE = 250.0  # [mm] from the rear edge: the middle of the pressure gauge


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spacing", type=float, default=40.0, help="of the particles [mm]")
    parser.add_argument("--pitch", type=float, default=6.0, help="[degree]")
    parser.add_argument("--speed", type=float, default=40e3, help="[mm/s]; the deck's parameter, and the full tank's length")
    parser.add_argument("--end", type=float, default=0.045, help="[s]")
    parser.add_argument("--radius", type=float, default=math.inf,
                        help="of the panel across its length; positive: convex, negative: concave [mm]")
    parser.add_argument("--full", action="store_true", help="the full tank instead of deck and basin")
    parser.add_argument("--graded", type=float, nargs=2, metavar=("FINE", "COARSE"), help="spacings of a graded basin [mm]")
    return parser.parse_args()


def write(name, text):
    with open(os.path.join(FOLDER, name), "w") as file:
        file.write(text)


def walls(spacing, begin, end, moving, graded):
    """Walls and planes of a basin, and what the deck wants to know of its particles."""
    text = f"""*BOUNDARY_SPH_SYMMETRY_PLANE
$ middle, side, floor
         0         0         0         0         1         0
         0{WIDTH:10.4g}         0         0         0         0
         0         0{-DEPTH:10.4g}         0         0         0
"""
    if moving:
        text += f"""*PLASH_SPH_MOVING_PERIODIC
$     vid1      vid2       nid      calm
         1         2         1{CALM:10.4g}
*DEFINE_VECTOR
         1{begin:10.4g}         0         0{begin + 1:10.4g}         0         0
*DEFINE_VECTOR
         2{end:10.4g}         0         0{end - 1:10.4g}         0         0
"""
    else:
        text += f"""*BOUNDARY_SPH_SYMMETRY_PLANE
{begin:10.4g}         0         0         0         0         0
{end:10.4g}         0         0         0         0         0
"""
    return text + f"*PARAMETER\nR  SPACING{spacing:10.4g}I   GRADED{graded:10d}\n"


def water(name, spacing, begin, end, moving):
    counts = [round((end - begin) / spacing), round(WIDTH / spacing), round(DEPTH / spacing)]
    text = f"$ {counts[0] * counts[1] * counts[2]} particles\n" + walls(spacing, begin, end, moving, 0) + "*NODE\n"
    number, particles, mass = 20001, "*ELEMENT_SPH\n", DENSITY * spacing ** 3
    for i in range(counts[0]):
        for j in range(counts[1]):
            for k in range(counts[2]):
                text += f"{number},{begin + (i + 0.5) * spacing:.8g},{(j + 0.5) * spacing:.8g},{-(k + 0.5) * spacing:.8g}\n"
                particles += f"{number},{WATER},{mass:.8g}\n"
                number += 1
    write(name, text + particles)
    return counts[0] * counts[1] * counts[2]


def graded_water(fine, coarse):
    """The moving basin with particles that plash fill makes, alike along the run: the basin comes in again as it leaves."""
    write("water_graded.k", walls(fine, -BEHIND, AHEAD, True, 1) + "*INCLUDE\nparticles_graded.k\n")
    box = f"{-BEHIND:g} 0 {-DEPTH:g} {AHEAD:g} {WIDTH:g} 0"
    fine_box = f"{-BEHIND:g} 0 {-3 * fine:g} {AHEAD:g} {HALF_WIDTH + 3 * fine:g} 0"
    print(f"plash fill particles_graded.k --box {box} --fine-box {fine_box} --fine {fine:g} --coarse {coarse:g} "
          f"--density {DENSITY:g} --part {WATER} --first-node 20001")


def panels():
    # Plates of the frame and the panel have nodes in common: rigid ones are one body.
    write("panel_rigid.k", f"""*PART
panel
{PANEL:10d}{PANEL:10d}{PANEL:10d}
*SECTION_SHELL
{PANEL:10d}         2
      15.0
*MAT_RIGID
{PANEL:10d}   2.7e-09   70000.0      0.33
       0.0

*CONSTRAINED_RIGID_BODIES
{FRAME:10d}{PANEL:10d}
""")
    for name, thickness in (("15", 15.0), ("3", 3.0), ("08", 0.8)):
        write(f"panel_{name}mm.k", f"""*PART
panel
{PANEL:10d}{PANEL:10d}{PANEL:10d}
*SECTION_SHELL
{PANEL:10d}        16         0         5
{thickness:10g}
*MAT_PIECEWISE_LINEAR_PLASTICITY
$ 2024-T3, assumed: yield and hardening modulus
{PANEL:10d}  2.78e-09   73100.0      0.33     345.0     770.0



""")


def height_across(y, radius):
    """How far a curved panel stands above its lowest line, at y from the middle."""
    def sagitta(y):
        return 0.0 if math.isinf(radius) else abs(radius) - math.sqrt(radius * radius - y * y)

    return sagitta(y) if radius > 0 else sagitta(HALF_WIDTH) - sagitta(y)


GRAVITY = 9810.0  # [mm/s^2]


def gravities():
    """With or without gravity, which the water carries from the start."""
    write("gravity_off.k", "$ no gravity\n")
    write("gravity_on.k", f"""$ on everything; the water starts with the pressure of its depth
*LOAD_BODY_Z
         2{GRAVITY:10.4g}
*DEFINE_CURVE
         2
                 0.0                 1.0
              1000.0                 1.0
*INITIAL_STRESS_DEPTH
$      pid      ro_g    zdatum     kfact
{WATER:10d}{DENSITY * GRAVITY:10.4g}         0         1
""")


TROLLEY = 0.837  # [t], recalled and unverified (no printed source at hand)


def guides():
    """How the frame goes: driven at constant speed, or free along the guide with half of the trolley's mass on it."""
    rigid = f"*MAT_RIGID\n{FRAME:10d}   7.8e-09  210000.0       0.3\n"
    write("guide_driven.k", f"""{rigid}$ guided: along the tank and down
       1.0         2         7

*BOUNDARY_PRESCRIBED_MOTION_RIGID
{FRAME:10d}         1         0         1    &SPEED
{FRAME:10d}         3         0         1    -&SINK
*DEFINE_CURVE
         1
                 0.0                 1.0
              1000.0                 1.0
""")
    write("guide_trolley.k", f"""{rigid}$ free along the x axis of system 1, the guide, alone
      -1.0         1    011111

*DEFINE_COORDINATE_SYSTEM
$      cid        xo        yo        zo        xl        yl        zl
         1         0         0         0    &SPEED         0    -&SINK
         0         1         0
*ELEMENT_MASS
$ half of the trolley, for half of the panel
 1000001       1{0.5 * TROLLEY:16.8g}
""")


def deck(args):
    c, s = math.cos(math.radians(args.pitch)), math.sin(math.radians(args.pitch))
    text = f"""*KEYWORD
*TITLE
Guided ditching, pitch {args.pitch:g} degrees{"" if math.isinf(args.radius) else f", radius {args.radius:g} mm"}
$ units: t, mm, s, N, MPa; written by make_deck.py
*PARAMETER
$ speed along the tank and down [mm/s], end [s]; panel rigid, 15mm, 3mm, 08mm; water moving, full or graded
$ guide driven or trolley; gravity on or off
R    SPEED{args.speed:10.4g}R     SINK    1500.0R      END{args.end:10.4g}
C    PANEL     rigidC    WATER    movingC    GUIDE    driven
C  GRAVITY        on
*PARAMETER_EXPRESSION
R    EVERY &END/450
R   STATES &END/15
*INCLUDE
panel_&PANEL.k
*INCLUDE
water_&WATER.k
*INCLUDE
gravity_&GRAVITY.k
*CONTROL_TERMINATION
      &END
*CONTROL_ENERGY
         2         2         2
*CONTROL_SPH
         1         0     1e+20         3
*PLASH_SPH_FORMULATION
$   kernel     delta
         4       0.1
$   graded
   &GRADED
*DATABASE_GLSTAT
    &EVERY
*DATABASE_MATSUM
    &EVERY
*DATABASE_RCFORC
    &EVERY
*DATABASE_NODOUT
    &EVERY
*DATABASE_BINARY_D3PLOT
   &STATES
*PART
frame
{FRAME:10d}{FRAME:10d}{FRAME:10d}
*SECTION_SHELL
{FRAME:10d}         2
      15.0
*INCLUDE
guide_&GUIDE.k
*INITIAL_VELOCITY_GENERATION
{FRAME:10d}         2         0    &SPEED         0    -&SINK

*INITIAL_VELOCITY_GENERATION
{PANEL:10d}         2         0    &SPEED         0    -&SINK

*PART
water
{WATER:10d}{WATER:10d}{WATER:10d}{WATER:10d}
*SECTION_SPH
{WATER:10d}       1.5       0.2         2
*MAT_NULL
$ cut off in tension: the water may part from the panel
{WATER:10d}{DENSITY:10.3g}    -1e-06     1e-09
*EOS_MURNAGHAN
$ Tait: gamma, k0 = rho c^2 / gamma
{WATER:10d}       7.0{DENSITY * SOUND ** 2 / 7:10.6g}
*SET_PART_LIST
         1
{PANEL:10d}{FRAME:10d}
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
         1water on panel and frame
{WATER:10d}         1         3         2
         0         0         0         0        20
         1         1  &SPACING
         1       0.1
*CONTACT_FORCE_TRANSDUCER_PENALTY_ID
         2pressure gauge
         1         0         0         0


"""
    nodes, numbers, elements, gauge = "*NODE\n", {}, "*ELEMENT_SHELL\n", []
    columns, rows = round(LENGTH / CELL), round(HALF_WIDTH / CELL)
    # The panel's middle plane lies half its thickness and half a spacing above the water's top particles.
    for j in range(rows + 1):
        for i in range(columns + 1):
            numbers[i, j] = len(numbers) + 1
            x, y, z = CELL * i, CELL * j, height_across(CELL * j, args.radius)  # before it is pitched
            nodes += f"{numbers[i, j]},{c * x - s * z:.8g},{y:.8g},{7.5 + s * x + c * z:.8g}\n"
    for j in range(rows):
        for i in range(columns):
            part = FRAME if i < FRAME_CELLS or i >= columns - FRAME_CELLS or j >= rows - FRAME_CELLS else PANEL
            corners = [numbers[i, j], numbers[i + 1, j], numbers[i + 1, j + 1], numbers[i, j + 1]]
            elements += f"{1 + i + columns * j},{part},{','.join(map(str, corners))}\n"
            if j == 0 and i in (round(GAUGE / CELL) - 1, round(GAUGE / CELL)):
                gauge.append(corners)
    text += "*SET_SEGMENT\n         1\n" + "".join("".join(f"{n:10d}" for n in corners) + "\n" for corners in gauge)
    text += f"*DATABASE_HISTORY_NODE\n$ the middle of the panel, the rear edge\n{numbers[columns // 2, 0]:10d}{numbers[0, 0]:10d}\n"
    middle = [numbers[i, 0] for i in range(FRAME_CELLS + 1, columns - FRAME_CELLS)]
    text += "*SET_NODE_LIST\n         5\n"
    for start in range(0, len(middle), 8):
        text += "".join(f"{n:10d}" for n in middle[start:start + 8]) + "\n"
    text += "*INCLUDE\nsymmetry_&PANEL.k\n"
    for name in ("15mm", "3mm", "08mm"):
        write(f"symmetry_{name}.k", "*BOUNDARY_SPC_SET\n         5         0         0         1         0         1         0         1\n")
    write("symmetry_rigid.k", "$ a rigid panel is held by its frame\n")
    write("ditching.k", text + nodes + elements + "*END\n")


def main():
    args = arguments()
    if args.graded:
        graded_water(*args.graded)
    elif args.full:
        print(water("water_full.k", args.spacing, -BEHIND, -BEHIND + args.spacing * round(
            (BEHIND + AHEAD + args.speed * args.end) / args.spacing), False), "particles")
    else:
        panels()
        guides()
        gravities()
        print(water("water_moving.k", args.spacing, -BEHIND, AHEAD, True), "particles")
        deck(args)


main()
