#!/usr/bin/env python3
"""Writes wedge.k: half of a rigid wedge that drops into a trough of water (units: t, mm, s, N, MPa).

    python3 make_deck.py [--spacing 1.5] [--deadrise 30] [--velocity 1046] [--mass 1.6394] ... > wedge.k

The set-up of Shah, Orifici & Watmuff (2015): a slice of 3 mm; the water around the wedge is particles, the rest of
the trough one-point solids on which the particles rest by contact; the left half is left away by symmetry. Gravity
acts on the wedge alone, as in the paper. The water's sound is slower than the paper's 1484 m/s: README.md says why.
"""
import argparse
import math

DENSITY = 998e-12       # [t/mm^3] of water
VISCOSITY = 1.002e-9    # [MPa s]
DEPTH = 333.0           # [mm] of the real wedge, across the slice
SLICE = 3.0             # [mm]; a plane model has 1
TROUGH = (360.0, 216.0) # [mm] half width, height
BASIN = (120.0, 60.0)   # [mm] half width, height of the region of particles
CELL = 12.0             # [mm] edge of the trough's solids
REACH = 100.0           # [mm] half width of the wedge
PLATE = 8.0             # [mm] height of the wedge's plate
DAMPING = 0.0           # VDC
LINEAR = 0.06           # linear artificial viscosity, LS-DYNA's default
# Numbers of parts, which are also those of sections and, but for the water, materials.
WEDGE, SOLIDS, WATER = 1, 2, 3


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spacing", type=float, default=1.5, help="of the particles; divides 3 [mm]")
    parser.add_argument("--deadrise", type=float, default=30.0, help="[degree]")
    parser.add_argument("--velocity", type=float, default=1046.0, help="at the first touch [mm/s]")
    parser.add_argument("--mass", type=float, default=1.6394, help="of the whole wedge [kg]")
    parser.add_argument("--fall", type=float, default=5474.0, help="acceleration of free fall in the rig [mm/s^2]")
    parser.add_argument("--end", type=float, default=0.015, help="[s]")
    parser.add_argument("--sound", type=float, default=150e3, help="speed of sound in the water [mm/s]")
    parser.add_argument("--linear", type=float, default=LINEAR, help="artificial viscosity Q2")
    parser.add_argument("--basin", type=float, nargs=2, default=BASIN, help="half width, height of the particles [mm]")
    parser.add_argument("--cell", type=float, help="of the mesh with --fluid ale, if not as the particles [mm]")
    parser.add_argument("--damping", type=float, default=DAMPING, help="of the contact of wedge and water, per cent of critical")
    parser.add_argument("--plane", action="store_true", help="plane strain: one layer of particles")
    parser.add_argument("--plain", action="store_true", help="LS-DYNA's default particles, without *PLASH_ keywords")
    return parser.parse_args()


class Deck:
    """Nodes and elements that are collected before they are written."""

    def __init__(self):
        self.nodes, self.solids, self.particles = [], [], []

    def node(self, x, y, z, constraint=0):
        self.nodes.append((x, y, z, constraint))
        return len(self.nodes)

    def write_mesh(self, particle_mass):
        print("*NODE")
        for i, (x, y, z, constraint) in enumerate(self.nodes, 1):
            print(f"{i},{x:.8g},{y:.8g},{z:.8g}" + (f",{constraint}" if constraint else ""))
        print("*ELEMENT_SPH")
        for node in self.particles:
            print(f"{node},{WATER},{particle_mass:.8g}")
        print("*ELEMENT_SOLID")
        for i, (part, corners) in enumerate(self.solids, 1):
            print(",".join(map(str, (i, part, *corners))))


def add_wedge(deck, spacing, deadrise):
    """A plate along the inclined face, one piece beyond the symmetry plane; it touches the water's surface at y = 0."""
    pieces = max(1, round(REACH / (2 * spacing)))
    rise = math.tan(math.radians(deadrise))

    def column(i, z):
        x = REACH * i / pieces
        return [deck.node(x, rise * x + height, z) for height in (0.0, PLATE)]

    columns = [[column(i, z) for z in (0.0, SLICE)] for i in range(-1, pieces + 1)]
    for left, right in zip(columns, columns[1:]):
        corners = [corner for (l, r) in zip(left, right) for corner in (l[0], r[0], r[1], l[1])]
        deck.solids.append((WEDGE, corners))
    return (pieces + 1) * (REACH / pieces) * PLATE * SLICE  # its volume


def add_trough(deck, basin):
    """One layer of solids around the basin, nodes held across the slice, at the walls and at the symmetry plane."""
    columns, rows = round(TROUGH[0] / CELL), round(TROUGH[1] / CELL)
    inner_column, inner_row = round(basin[0] / CELL), round(basin[1] / CELL)
    numbers = {}

    def number(i, j, k):
        if (i, j, k) not in numbers:
            on_wall = i in (0, columns)
            bottom = j == rows
            code = 7 if (on_wall and bottom) else 6 if on_wall else 5 if bottom else 3
            numbers[i, j, k] = deck.node(CELL * i, -CELL * j, SLICE * k, code)
        return numbers[i, j, k]

    for j in range(rows):
        for i in range(columns):
            if i < inner_column and j < inner_row:
                continue
            ring = [(i, j + 1), (i + 1, j + 1), (i + 1, j), (i, j)]
            corners = [number(a, b, k) for k in (0, 1) for a, b in ring]
            deck.solids.append((SOLIDS, corners))


def add_water(deck, spacing, basin, layers):
    columns, rows = round(basin[0] / spacing), round(basin[1] / spacing)
    for j in range(rows):
        for i in range(columns):
            for k in range(layers):
                z = (k + 0.5) * SLICE / layers
                deck.particles.append(deck.node((i + 0.5) * spacing, -(j + 0.5) * spacing, z))


FLUID_CARD = """$ the cells of --fluid ale
*PARAMETER
RCELL     {:10.4g}
*PLASH_FLUID
$    fluid      size
               &CELL
"""

FORMULATION = """$ Wendland C2, density diffusion: docs/sph.md
*PLASH_SPH_FORMULATION
$   kernel     delta
         4       0.1
"""


VISCOSITY_CARD = """*HOURGLASS
$     hgid       ihq        qm       ibq        q1        q2
         3         1       0.1         0       1.5{:10.4g}
"""

THIN = """*MAT_NULL
$ particles of a plane model stand for a depth of 1 mm, the solids are three times as deep: their step is as much longer
         4{:10.4g}    -1e+20{:10.4g}
"""

# The two sides of the slice, as *BOUNDARY_SPH_SYMMETRY_PLANE has them.
SIDES = f"""         0         0         0         0         0         1
         0         0{SLICE:10.4g}         0         0         0
"""


def main():
    args = arguments()
    depth = 1.0 if args.plane else SLICE  # that the particles and the forces stand for
    deck = Deck()
    wedge_volume = add_wedge(deck, args.spacing, args.deadrise)
    add_trough(deck, args.basin)
    add_water(deck, args.spacing, args.basin, 1 if args.plane else max(1, round(SLICE / args.spacing)))
    # The slice carries its share of half of the wedge.
    wedge_density = 1e-3 * args.mass / DEPTH * depth / 2 / wedge_volume
    viscosity = "" if args.linear == LINEAR else VISCOSITY_CARD.format(args.linear)
    smoothing = 1.2 if args.plain else 1.5
    print(f"""*KEYWORD
*TITLE
Wedge {args.deadrise:g} deg, {args.mass:.3g} kg, {1e-3 * args.velocity:.3g} m/s, dx {args.spacing:g} mm
$ units: t, mm, s, N, MPa; written by make_deck.py
*CONTROL_TERMINATION
$   endtim
{args.end:10.4g}
*CONTROL_ENERGY
$     hgen      rwen    slnten
         2         2         2
*CONTROL_SPH
$     ncbs     boxid        dt      idim
         1         0     1e+20{2 if args.plane else 3:10d}
{"" if args.plain else FORMULATION}{FLUID_CARD.format(args.cell or args.spacing)}*DATABASE_GLSTAT
$       dt
 1.000e-04
*DATABASE_MATSUM
 1.000e-04
*DATABASE_RCFORC
 5.000e-05
*DATABASE_NODOUT
 1.000e-04
*DATABASE_HISTORY_NODE
         1
*DATABASE_BINARY_D3PLOT
 1.000e-03
*PART
wedge
$      pid     secid       mid
{WEDGE:10d}         1         1
*SECTION_SOLID
$    secid    elform
         1         1
*MAT_RIGID
$      mid        ro         e        pr
         1{wedge_density:10.4e}   2.0e+05       0.3
$ moves along y alone
$      cmo      con1      con2
       1.0         6         7

*PART
trough
$      pid     secid       mid     eosid      hgid
{SOLIDS:10d}         2{4 if args.plane else 2:10d}         2         2
*SECTION_SOLID
         2         1
{THIN.format(DENSITY / SLICE, VISCOSITY / SLICE) if args.plane else ""}*MAT_NULL
$      mid        ro        pc        mu
         2{DENSITY:10.4g}    -1e+20{VISCOSITY:10.4g}
*EOS_GRUNEISEN
$    eosid         c        s1        s2        s3    gamma0
         2{args.sound:10.4g}     1.979         0         0      0.11

*HOURGLASS
$     hgid       ihq        qm
         2         1      1e-3
{viscosity}*PART
water
{WATER:10d}         3         2         2{0 if viscosity == "" else 3:10d}
*SECTION_SPH
$    secid      cslh      hmin      hmax
         3{smoothing:10.4g}       0.2         2
$ the middle of the wedge, and the two sides of the slice
*BOUNDARY_SPH_SYMMETRY_PLANE
$      vtx       vty       vtz       vhx       vhy       vhz
         0         0         0         1         0         0
{"" if args.plane else SIDES}*SET_PART_LIST
         1
{WEDGE:10d}
$ particles as thick as they are apart, soft penalty as in the paper
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
         1wedge
$    surfa     surfb  surfatyp  surfbtyp
{WATER:10d}{WEDGE:10d}         3         3
$       fs        fd        dc        vc       vdc
         0         0         0         0{args.damping:10.4g}
$     sfsa      sfsb      sast
         1         1{args.spacing:10.4g}
$     soft    sofscl
         1       0.1
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
         2trough
{WATER:10d}{SOLIDS:10d}         3         3

         1         1{args.spacing:10.4g}
         1       0.1
*INITIAL_VELOCITY_RIGID_BODY
{WEDGE:10d}         0{-args.velocity:10.4g}
*LOAD_BODY_PARTS
         1
*LOAD_BODY_Y
         1{args.fall:10.4g}
*DEFINE_CURVE
         1
                 0.0                 1.0
                 1.0                 1.0""")
    deck.write_mesh(DENSITY * args.spacing ** 2 * (depth if args.plane else args.spacing))
    print("*END")


main()
