#!/usr/bin/env python3
"""Writes the decks of the bird strikes into this folder (units: t, mm, s, N, MPa).

    python3 make_deck.py                 all decks, with their coarse birds
    python3 make_deck.py plate 8 10      further birds for plate.k, with so many particles across the transducer
    python3 make_deck.py tapered 18 26   further birds for tapered_..k, with so many particles across the bird

The cases of Goyal, Huertas & Vasko (2013), Am. Trans. Eng. Appl. Sci. 2(2):83: a beam hit by a projectile, a bird on
a rigid plate with a transducer, a bird on the edge of a tapered plate. A deck takes its bird, its contact and the
rest from its *PARAMETERs, so `plash run --set` and `plash study --vary` change them. README.md says what is known.
"""
import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
BIRD_DENSITY = 950e-12  # [t/mm^3]
BIRD, PLATE, TRANSDUCER = 3, 1, 2

# Water with 10 % of air by volume (Wilbeck 1978): V = (1 - z)(p/A + 1)^(-1/B) + z (p/p0 + 1)^(-1/1.4), with
# A = rho c^2 / B, B = 4 k - 1 of water's shock line c + k u, c = 1482.9 m/s, k = 2.
AIR, ATMOSPHERE = 0.1, 0.101325
STIFF, POWER = 1000e-12 * 1482.9e3 ** 2 / 7, 7
PRESSURES = (0, 1, 5, 20, 50, 90, 150, 250, 400, 800)  # [MPa] of the table


def volume(pressure):
    return ((1 - AIR) * (pressure / STIFF + 1) ** (-1 / POWER)
            + AIR * (pressure / ATMOSPHERE + 1) ** (-1 / 1.4))


def lines_of_five(values):
    return "\n".join("".join(f"{v:16.8g}" for v in values[i:i + 5]) for i in range(0, len(values), 5))


PART = """*PART
bird
$      pid     secid       mid     eosid
"""
# Sound in it is that of water, also at rest; VC, the viscosity, is LS-DYNA's usual 0.1.
ELASTIC_FLUID = f"""{PART}{BIRD:10d}{BIRD:10d}{BIRD:10d}         0
*MAT_ELASTIC_FLUID
$      mid        ro         e        pr        da        db         k
{BIRD:10d}{BIRD_DENSITY:10.3g}         0         0         0         0{BIRD_DENSITY * 1482.9e3 ** 2:10.5g}
$       vc        cp
       0.1     0.001
"""
WATER_AND_AIR = f"""{PART}{BIRD:10d}{BIRD:10d}{BIRD:10d}{BIRD:10d}
*MAT_NULL
$      mid        ro        pc
{BIRD:10d}{BIRD_DENSITY:10.3g}    -0.001
*EOS_TABULATED
$    eosid      gama        e0        v0
{BIRD:10d}       0.0       0.0       1.0
$ ev1 ... ev10, c1 ... c10: water with {100 * AIR:g} % of air
{lines_of_five([math.log(volume(p)) for p in PRESSURES])}
{lines_of_five(PRESSURES)}
{lines_of_five([0.0] * 10)}
"""


def write(name, text):
    with open(os.path.join(FOLDER, name), "w") as file:
        file.write(text)


def mesh_text(nodes, first, particles=(), mass=0.0):
    """Nodes are numbered from `first` on; `particles` names some by their place in `nodes`."""
    text = "*NODE\n" + "".join(f"{first + i},{x:.8g},{y:.8g},{z:.8g}\n" for i, (x, y, z) in enumerate(nodes))
    if particles:
        text += "*ELEMENT_SPH\n" + "".join(f"{first + i},{BIRD},{mass:.8g}\n" for i in particles)
    return text


def lattice(inside, box, spacing):
    """Points in the middles of cubes whose middle is inside; `box` = ((from, to) along x, y, z)."""
    counts = [max(1, round((high - low) / spacing)) for low, high in box]
    steps = [(high - low) / count for (low, high), count in zip(box, counts)]
    points = []
    for i in range(counts[0]):
        for j in range(counts[1]):
            for k in range(counts[2]):
                point = tuple(low + (n + 0.5) * step
                              for (low, _), n, step in zip(box, (i, j, k), steps))
                if inside(*point):
                    points.append(point)
    return points


DAMPING = 20  # of the contacts [% of critical]
CONTACTS = {  # name of the parameter's value: keyword, further cards
    "nodes": ("AUTOMATIC_NODES_TO_SURFACE", ""),
    "eroding": ("ERODING_NODES_TO_SURFACE", "$     isym    erosop      iadj\n         0         0         0\n"),
    "constraint": ("CONSTRAINT_NODES_TO_SURFACE", "$      kpf\n         0\n"),
}


METHODS = {  # name of the parameter's value: FORM, smoothing length over spacing, further keyword
    "water": (0, 1.5, "$ Wendland C2, density diffusion: docs/sph.md\n*PLASH_SPH_FORMULATION\n$   kernel     delta\n"
                      "         4       0.1\n"),
    "form0": (0, 1.2, ""),
    "form1": (1, 1.2, ""),
}


def include_files():
    for name, text in (("null", WATER_AND_AIR), ("elastic", ELASTIC_FLUID)):
        write(f"fluid_{name}.k", text)
    for name, (form, smoothing, extra) in METHODS.items():
        write(f"particles_{name}.k", f"""*CONTROL_SPH
$     ncbs     boxid        dt      idim   nmneigh      form
         1         0     1e+20         3         0{form:10d}
*SECTION_SPH
$    secid      cslh      hmin      hmax
{BIRD:10d}{smoothing:10.4g}       0.2         2
{extra}""")
    for name, (keyword, extra) in CONTACTS.items():
        # Particles as thick as they are apart. A constraint has no stiffness to soften.
        soft = "" if name == "constraint" else "$     soft    sofscl\n         1       0.1\n"
        # The first layer of particles rings between plate and bird: a fifth of critical damping, as is usual.
        damping = "" if name == "constraint" else f"         0         0         0         0{DAMPING:10g}"
        write(f"contact_{name}.k", f"""*CONTACT_{keyword}_ID
         1bird on plate
$    surfa     surfb  surfatyp  surfbtyp
{BIRD:10d}         1         3         2
{damping}
$     sfsa      sfsb      sast
         1         1  &SPACING
{extra}{soft}""")


HEAD = """*KEYWORD
*TITLE
{title}
$ units: t, mm, s, N, MPa; written by make_deck.py
*PARAMETER
$ speed [mm/s]; particles across the {what}; water, form0 or form1; nodes, eroding or constraint; null, elastic
R    SPEED{speed:10.4g}I   ACROSS{across:10d}C   METHOD     waterC  CONTACT{contact:>10s}
C    FLUID      null
*PARAMETER_EXPRESSION
R  SPACING {width:.8g}/&ACROSS
R      END {end}
R    EVERY &END/600
R   STATES &END/12
R  LARGEST 0.3*&SPACING/1.5e6
*CONTROL_TERMINATION
$   endtim
      &END
*CONTROL_ENERGY
$     hgen      rwen    slnten
         2         2         2
$ A table that stiffens with the shock: no step longer than sound in the compressed bird allows.
*CONTROL_TIMESTEP
$   dtinit    tssfac      isdo    tslimt     dt2ms      lctm
         0       0.9         0         0         0         9
*DEFINE_CURVE
         9
                 0.0            &LARGEST
                 1.0            &LARGEST
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
*INCLUDE
fluid_&FLUID.k
*INCLUDE
{stem}_bird_&ACROSS.k
*INCLUDE
particles_&METHOD.k
*INCLUDE
contact_&CONTACT.k
"""

# -- a bird on a rigid plate ----------------------------------------------------------------------------------------
DIAMETER, LENGTH = 29.56, 60.0       # [mm] of the bird of shot 5126A
THICKNESS, CELL, CELLS = 1.0, 6.0, 26  # [mm], cells along the plate's side; the transducer has 2 x 2 in the middle


def plate_bird(across):
    """Columns of particles stand evenly on the transducer, whose edges lie between two of them."""
    spacing, radius, half = 2 * CELL / across, DIAMETER / 2, 2 * CELL * 2
    bottom = 0.5 * THICKNESS
    box = ((-half, half), (-half, half), (bottom, bottom + LENGTH))
    points = lattice(lambda x, y, z: x * x + y * y < radius * radius, box, spacing)
    mass = BIRD_DENSITY * math.pi * radius ** 2 * LENGTH / len(points)
    write(f"plate_bird_{across}.k", f"$ {len(points)} particles, {1e6 * mass * len(points):.2f} g\n"
          + mesh_text(points, 10001, range(len(points)), mass=mass))
    return len(points)


def plate(across=6):
    plate_bird(across)
    text = HEAD.format(title="Bird on a rigid plate: shot 5126A", speed=116e3, across=across, what="transducer",
                       contact="nodes", width=2 * CELL, end=f"1.2*{LENGTH:g}/&SPEED", stem="plate")
    text += f"""*CONTACT_FORCE_TRANSDUCER_PENALTY_ID
         2transducer
$    surfa     surfb  surfatyp  surfbtyp
{TRANSDUCER:10d}         0         3         0


*SET_PART_LIST
         1
{PLATE:10d}{TRANSDUCER:10d}
*INITIAL_VELOCITY_GENERATION
$ nsid/pid      styp     omega        vx        vy        vz
{BIRD:10d}         2         0         0         0   -&SPEED

"""
    for part, name in ((PLATE, "plate"), (TRANSDUCER, "transducer")):
        text += f"""*PART
{name}
{part:10d}         1{part:10d}
*MAT_RIGID
$      mid        ro         e        pr
{part:10d} 7.85e-09    205000       0.3
$ stands still
       1.0         7         7

"""
    text += f"*SECTION_SHELL\n         1         2\n{THICKNESS:10g}{THICKNESS:10g}{THICKNESS:10g}{THICKNESS:10g}\n"
    # Two rigid parts have no nodes in common: the transducer has nodes of its own.
    numbers, nodes, shells = {}, [], []
    for j in range(CELLS):
        for i in range(CELLS):
            middle = CELLS // 2
            part = TRANSDUCER if i in (middle - 1, middle) and j in (middle - 1, middle) else PLATE
            corners = []
            for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                if (part, a, b) not in numbers:
                    nodes.append((CELL * (a - middle), CELL * (b - middle), 0.0))
                    numbers[part, a, b] = len(nodes)
                corners.append(numbers[part, a, b])
            shells.append((part, corners))
    text += mesh_text(nodes, 1)
    text += "*ELEMENT_SHELL\n" + "".join(f"{i},{part},{','.join(map(str, corners))}\n"
                                         for i, (part, corners) in enumerate(shells, 1))
    write("plate.k", text + "*END\n")


# -- a bird on the edge of a tapered plate ---------------------------------------------------------------------------
BIG_DIAMETER, BIG_LENGTH = 76.2, 152.4    # [mm], over the half spheres of its ends
CHORD, SPAN = 76.2, 228.6                 # [mm] of the plate
EDGE, FULL, TAPER = 0.51, 1.60, 4.0       # [mm] thickness at the edge and behind the taper, [degree]
CHORD_CELLS, HALF_SPAN_CELLS = 19, 28


def tapered_bird(across):
    """Half of the bird (y > 0), upright: its nose at z = 0, its axis along z; the deck turns it."""
    spacing, radius = BIG_DIAMETER / across, BIG_DIAMETER / 2

    def inside(x, y, z):
        end = max(radius - z, 0.0, z - (BIG_LENGTH - radius))
        return x * x + y * y + end * end < radius * radius

    points = lattice(inside, ((-radius, radius), (0.0, radius), (0.0, BIG_LENGTH)), spacing)
    half = 0.5 * BIRD_DENSITY * math.pi * (radius ** 2 * (BIG_LENGTH - BIG_DIAMETER) + 4 / 3 * radius ** 3)
    for angle in (0, 30):
        write(f"tapered_{angle}_bird_{across}.k",
              f"$ half a bird: {len(points)} particles, {1e6 * half:.1f} g; comes in at {angle} degrees\n"
              + mesh_text([turned(p, angle, spacing) for p in points], 10001, range(len(points)),
                          mass=half / len(points)))
    return len(points)


def turned(point, angle, spacing):
    """From upright to flying along (cos, 0, -sin), nose clear of the plate's edge at the origin."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x, y, z = point
    back = z + 0.5 * (EDGE + spacing)  # behind the edge, against the flight
    return (-c * back + s * x, y, s * back + c * x)


def tapered(angle, across=14):
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    text = HEAD.format(title=f"Bird on a tapered plate, {angle} degrees", speed=100e3, across=across,
                       what="bird", contact="eroding", width=BIG_DIAMETER, end=f"{1.3 * BIG_LENGTH:g}/&SPEED",
                       stem=f"tapered_{angle}")
    text += f"""*PARAMETER_EXPRESSION
R       VX {c:.8g}*&SPEED
R       VZ {-s:.8g}*&SPEED
*SET_PART_LIST
         1
{PLATE:10d}
$ half of plate and bird: the plane y = 0
*BOUNDARY_SPH_SYMMETRY_PLANE
         0         0         0         0         1         0
*INITIAL_VELOCITY_GENERATION
$ nsid/pid      styp     omega        vx        vy        vz
{BIRD:10d}         2         0       &VX         0       &VZ

*PART
plate
{PLATE:10d}         1         1
*SECTION_SHELL
$    secid    elform      shrf       nip
         1        16         1         5
$ each element has its own
{FULL:10g}
*MAT_PIECEWISE_LINEAR_PLASTICITY
$ Ti-6Al-4V: assumed, the text that is at hand names no metal
         1  4.43e-09    113800      0.34       880       800

                                                        
                                                        
*DATABASE_HISTORY_NODE
$ the middle of the edge
         1
"""
    nodes, numbers = [], {}
    for j in range(HALF_SPAN_CELLS + 1):
        for i in range(CHORD_CELLS + 1):
            nodes.append((CHORD * i / CHORD_CELLS, 0.5 * SPAN * j / HALF_SPAN_CELLS, 0.0))
            numbers[i, j] = len(nodes)
    text += mesh_text(nodes, 1)

    def thickness(node):
        return min(FULL, EDGE + nodes[node - 1][0] * math.tan(math.radians(TAPER)))

    text += "*ELEMENT_SHELL_THICKNESS\n"
    for j in range(HALF_SPAN_CELLS):
        for i in range(CHORD_CELLS):
            corners = [numbers[i, j], numbers[i + 1, j], numbers[i + 1, j + 1], numbers[i, j + 1]]
            number = 1 + i + CHORD_CELLS * j
            text += f"{number},{PLATE},{','.join(map(str, corners))}\n"
            text += ",".join(f"{thickness(corner):.6g}" for corner in corners) + "\n"
    text += "*BOUNDARY_SPC_NODE\n"
    for i in range(CHORD_CELLS + 1):
        text += f"{numbers[i, 0]},0,0,1,0,1,0,1\n"
        text += f"{numbers[i, HALF_SPAN_CELLS]},0,1,1,1,1,1,1\n"
    write(f"tapered_{angle}.k", text + "*END\n")


# -- the beam --------------------------------------------------------------------------------------------------------
BEAM_LENGTH, BEAM_SIDE = 100.0, 4.0                  # [mm]
SHOT_MASS, SHOT_SIDE, SHOT_SPEED = 2.233e-6, 4.95, 100e3  # [t], [mm], [mm/s]; 24.5 mm^2 = 27.2 kN / 1.11 GPa
STEEL_DENSITY, STEEL_YOUNG = 7.85e-9, 205e3


def hexahedra(nodes, solids, part, counts, corner, sizes):
    first = len(nodes)
    for k in range(counts[2] + 1):
        for j in range(counts[1] + 1):
            for i in range(counts[0] + 1):
                nodes.append(tuple(c + s * n / count for c, s, n, count in zip(corner, sizes, (i, j, k), counts)))

    def number(i, j, k):
        return first + 1 + i + (counts[0] + 1) * (j + (counts[1] + 1) * k)

    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                solids.append((part, [number(a, b, c) for c in (k, k + 1) for a, b in ring]))


def beam(across=7):
    """The projectile is particles (beam.k) or solids (beam_solid.k); z is the direction of the blow."""
    length = SHOT_MASS / STEEL_DENSITY / SHOT_SIDE ** 2
    spacing = SHOT_SIDE / across
    bottom = BEAM_SIDE + 0.02
    for kind in ("particles", "solid"):
        nodes, solids = [], []
        hexahedra(nodes, solids, PLATE, (100, 4, 4), (-BEAM_LENGTH / 2, -BEAM_SIDE / 2, 0.0),
                  (BEAM_LENGTH, BEAM_SIDE, BEAM_SIDE))
        ends = [i for i, p in enumerate(nodes, 1) if abs(p[0]) > BEAM_LENGTH / 2 - 1e-6 and p[2] == 0.0]
        corner, sizes = (-SHOT_SIDE / 2, -SHOT_SIDE / 2, bottom), (SHOT_SIDE, SHOT_SIDE, length)
        if kind == "solid":
            hexahedra(nodes, solids, BIRD, (across, across, round(length / spacing)), corner, sizes)
            text_of_shot = ""
        else:
            # The surface of particles lies half of their spacing out.
            box = tuple((low, low + size) for low, size in zip(corner, sizes))
            points = lattice(lambda *_: True, box, spacing)
            text_of_shot = mesh_text(points, 10001, range(len(points)), mass=SHOT_MASS / len(points))
        text = f"""*KEYWORD
*TITLE
Beam hit in its middle by a projectile of {kind}
$ units: t, mm, s, N, MPa; written by make_deck.py
*CONTROL_TERMINATION
     40e-6
*CONTROL_ENERGY
         2         2         2
*CONTROL_SPH
$ total gradients are corrected (FORM 1), as solids need it
         1         0     1e+20         3         0         1
*DATABASE_GLSTAT
     1e-07
*DATABASE_MATSUM
     1e-07
*DATABASE_RCFORC
     5e-08
*DATABASE_BINARY_D3PLOT
     4e-06
*PART
beam
{PLATE:10d}         1         1         0         1
*SECTION_SOLID
         1         1
*MAT_ELASTIC
         1{STEEL_DENSITY:10.3g}{STEEL_YOUNG:10.4g}       0.3
*HOURGLASS
         1         6       0.1
*PART
projectile
{BIRD:10d}{BIRD:10d}         {2 if kind == "particles" else 2}         0         {0 if kind == "particles" else 1}
*MAT_ELASTIC
$ a hundred times as stiff as the beam, as the paper's rigid object
         2{STEEL_DENSITY:10.3g}{100 * STEEL_YOUNG:10.4g}       0.3
{"*SECTION_SPH" if kind == "particles" else "*SECTION_SOLID"}
{BIRD:10d}{"       1.2       0.2         2" if kind == "particles" else "         1"}
*CONTACT_AUTOMATIC_{"NODES_TO_SURFACE" if kind == "particles" else "SURFACE_TO_SURFACE"}_ID
         1projectile on beam
{BIRD:10d}{PLATE:10d}         3         3

         1         1{spacing if kind == "particles" else 0.0:10.4g}
         1       0.1
*INITIAL_VELOCITY_GENERATION
{BIRD:10d}         2         0         0         0{-SHOT_SPEED:10.4g}

*BOUNDARY_SPC_SET
         1         0         0         0         1
*SET_NODE_LIST
         1
"""
        for start in range(0, len(ends), 8):
            text += "".join(f"{n:10d}" for n in ends[start:start + 8]) + "\n"
        text += mesh_text(nodes, 1) + text_of_shot + "*ELEMENT_SOLID\n"
        text += "".join(f"{i},{part},{','.join(map(str, corners))}\n" for i, (part, corners) in enumerate(solids, 1))
        write("beam.k" if kind == "particles" else "beam_solid.k", text + "*END\n")


def main():
    counts = [int(word) for word in sys.argv[2:]]
    if len(sys.argv) == 1:
        include_files()
        plate()
        tapered_bird(14)
        tapered(0)
        tapered(30)
        beam()
    elif sys.argv[1] == "plate":
        for across in counts:
            print(f"{across} across: {plate_bird(across)} particles")
    elif sys.argv[1] == "tapered":
        for across in counts:
            print(f"{across} across: {tapered_bird(across)} particles in the half")
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
