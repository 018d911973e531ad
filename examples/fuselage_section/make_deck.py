#!/usr/bin/env python3
"""Writes the drop of a fuselage section on rigid ground, water or soil into this folder (units: t, mm, s, N, MPa).

    python3 make_deck.py [--around 80] [--along 12] [--spacing 175]

A section like that of a B-737, after Song, Horton & Bayandor ('Verified fuselage section water impact modeling') and the drop
tests that it models: 4.09 m high, 3.76 m wide, 3.05 m long; skin, frames, stringers, passenger floor on beams, a cargo door,
a fuel tank hung from two rails; 9.14 m/s. Masses are the paper's, gauges are typical ones (README.md). x runs aft, z up.
"""
import argparse
import math
import os

FOLDER = os.path.dirname(os.path.abspath(__file__))
HEIGHT, WIDTH, LENGTH, SPEED = 4090.0, 3760.0, 3050.0, 9140.0  # [mm], [mm/s]
# Masses [t]: the whole section; passenger floor with dummies and seats; tank empty and with its fuel.
TOTAL, FLOOR_MASS, TANK_EMPTY, TANK_FULL = 3.909, 1.640, 0.168, 1.694
FRAMES, FRAME_DEPTH = 7, 90.0
SKIN_T, DOOR_T, FRAME_T, FLOOR_T = 1.6, 2.5, 1.6, 3.0  # [mm]
FLOOR_ANGLE = 81.0            # [degree] from the keel: where the floor meets the skin
FLOOR_CELLS = 16              # across
TANK_HALF, TANK_GAP, TANK_HEIGHT = 3, 250.0, 900.0  # half width [cells of the floor], [mm] below the floor, [mm]
RAIL = 2                      # cells of the floor from the middle
SKIN, DOOR, FRAME, FLOOR, TANK, STRINGER, FLOOR_BEAM, RAILS, WATER, SOIL = range(1, 11)
ALLOYS = {  # name: density, modulus, Poisson's ratio, yield stress, hardening
    "2024-T3": (2.78e-9, 73.1e3, 0.33, 345.0, 770.0),
    "7075-T6": (2.81e-9, 71.7e3, 0.33, 503.0, 630.0),
}


def write(name, text):
    with open(os.path.join(FOLDER, name), "w") as file:
        file.write(text)


class Section:
    def __init__(self, around, along):
        self.around, self.along = around, along
        self.nodes, self.shells, self.beams, self.masses = [], {}, {}, {}
        self.mass = 0.0  # of shells and beams
        self.skin_nodes = {}
        self.build()

    def node(self, x, y, z):
        self.nodes.append((x, y, z))
        return len(self.nodes)

    def place(self, i, j, inward=0.0):
        """Ring node j (0 at the keel, to +y) at station i, pulled in along the ellipse's normal."""
        angle = 2 * math.pi * j / self.around
        a, b = 0.5 * WIDTH, 0.5 * HEIGHT
        y, z = a * math.sin(angle), -b * math.cos(angle)
        normal = (y / a ** 2, z / b ** 2)
        size = math.hypot(*normal)
        return (LENGTH * i / self.along, y - inward * normal[0] / size, z - inward * normal[1] / size)

    def shell(self, part, corners, thickness, density):
        self.shells.setdefault(part, []).append(corners)
        a, b, c, d = (self.nodes[n - 1] for n in corners)
        u, v = [p - q for p, q in zip(c, a)], [p - q for p, q in zip(d, b)]
        cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        self.mass += 0.5 * math.sqrt(sum(x * x for x in cross)) * thickness * density

    def beam(self, part, first, second, third, area):
        self.beams.setdefault(part, []).append((first, second, third))
        self.mass += math.dist(self.nodes[first - 1], self.nodes[second - 1]) * area * ALLOYS["7075-T6"][0]

    def build(self):
        skin, stiff = ALLOYS["2024-T3"][0], ALLOYS["7075-T6"][0]
        ring = [[self.node(*self.place(i, j)) for j in range(self.around)] for i in range(self.along + 1)]
        axis = self.node(-1000.0, 0.0, 0.0)  # turns the beams' axes; far from everything, without mass
        self.skin_nodes = ring
        door_j = range(round(30 / 360 * self.around), round(65 / 360 * self.around))
        door_i = range(self.along // 3, self.along - self.along // 3)
        for i in range(self.along):
            for j in range(self.around):
                corners = [ring[i][j], ring[i + 1][j], ring[i + 1][(j + 1) % self.around], ring[i][(j + 1) % self.around]]
                door = i in door_i and j in door_j
                self.shell(DOOR if door else SKIN, corners, DOOR_T if door else SKIN_T, skin)
        stations = [round(n * self.along / (FRAMES - 1)) for n in range(FRAMES)]
        upper = []  # nodes above the floor that carry what is left of the mass
        floor_j = round(FLOOR_ANGLE / 360 * self.around)
        for i in stations:
            inner = [self.node(*self.place(i, j, FRAME_DEPTH)) for j in range(self.around)]
            for j in range(self.around):
                k = (j + 1) % self.around
                self.shell(FRAME, [ring[i][j], ring[i][k], inner[k], inner[j]], FRAME_T, stiff)
                if floor_j < j < self.around - floor_j:
                    upper.append(inner[j])
        for j in range(0, self.around, 2):
            for i in range(self.along):
                self.beam(STRINGER, ring[i][j], ring[i + 1][j], axis, 120.0)
        self.build_floor(ring, stations, floor_j, stiff, axis)
        # What the structure lacks of the section's mass hangs on the frames above the floor.
        rest = TOTAL - self.mass - sum(self.masses.values())
        for number in upper:
            self.masses[number] = rest / len(upper)

    def build_floor(self, ring, stations, floor_j, density, axis):
        left, right = -floor_j % self.around, floor_j
        y0, z = self.place(0, right)[1:]
        grid = []
        for i in range(self.along + 1):
            row = [ring[i][left]]
            row += [self.node(LENGTH * i / self.along, y0 * (2 * j / FLOOR_CELLS - 1), z) for j in range(1, FLOOR_CELLS)]
            grid.append(row + [ring[i][right]])
        before = self.mass
        for i in range(self.along):
            for j in range(FLOOR_CELLS):
                self.shell(FLOOR, [grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1]], FLOOR_T, density)
        inside = [n for row in grid for n in row[1:-1]]
        for number in inside:
            self.masses[number] = (FLOOR_MASS - (self.mass - before)) / len(inside)
        for i in stations:
            for j in range(FLOOR_CELLS):
                self.beam(FLOOR_BEAM, grid[i][j], grid[i][j + 1], axis, 450.0)
        self.build_tank(grid, z, y0, axis)
        middle = FLOOR_CELLS // 2
        # Beside the tank, on the door's side.
        self.gauges = [grid[i][j] for i in range(self.along // 3, self.along - self.along // 3 + 1)
                       for j in (middle + 4, middle + 5)]

    def build_tank(self, grid, floor, y0, axis):
        middle, cell = FLOOR_CELLS // 2, 2 * y0 / FLOOR_CELLS
        first, last = self.along // 4, self.along - self.along // 4
        layers = 4
        numbers = {}

        def node(i, j, k):
            if (i, j, k) not in numbers:
                numbers[i, j, k] = self.node(LENGTH * i / self.along, cell * j,
                                             floor - TANK_GAP - TANK_HEIGHT * (1 - k / layers))
            return numbers[i, j, k]

        faces = []
        for i in range(first, last):
            for j in range(-TANK_HALF, TANK_HALF):
                faces.append([node(i, j, layers), node(i + 1, j, layers), node(i + 1, j + 1, layers), node(i, j + 1, layers)])
                faces.append([node(i, j + 1, 0), node(i + 1, j + 1, 0), node(i + 1, j, 0), node(i, j, 0)])
            for k in range(layers):
                for j in (-TANK_HALF, TANK_HALF):
                    faces.append([node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)])
        for j in range(-TANK_HALF, TANK_HALF):
            for k in range(layers):
                for i in (first, last):
                    faces.append([node(i, j, k), node(i, j + 1, k), node(i, j + 1, k + 1), node(i, j, k + 1)])
        area = 0.0
        for corners in faces:
            a, b, c, d = (self.nodes[n - 1] for n in corners)
            area += math.dist(a, b) * math.dist(b, c)
        density = ALLOYS["2024-T3"][0]
        self.tank_thickness = TANK_EMPTY / area / density
        for corners in faces:
            self.shell(TANK, corners, self.tank_thickness, density)
        for number in numbers.values():
            self.masses[number] = (TANK_FULL - TANK_EMPTY) / len(numbers)
        for side in (-RAIL, RAIL):
            for i in range(self.along):
                self.beam(RAILS, grid[i][middle + side], grid[i + 1][middle + side], axis, 1200.0)
            for i in range(first, last + 1, 2):
                self.beam(RAILS, grid[i][middle + side], node(i, side, layers), axis, 1200.0)


def grounds(args):
    bottom = -0.5 * HEIGHT - 2.0
    write("ground_rigid.k", f"""*RIGIDWALL_PLANAR
         0
       0.0       0.0{bottom:10.1f}       0.0       0.0{bottom + 1:10.1f}       0.3
""")
    x0, x1, half, depth, s = -475.0, LENGTH + 475.0, 2600.0, 1400.0, args.spacing
    counts = [round((x1 - x0) / s), round(2 * half / s), round(depth / s)]
    steps = [(x1 - x0) / counts[0], 2 * half / counts[1], depth / counts[2]]
    top = bottom - 0.5 * s
    text = f"""$ {counts[0] * counts[1] * counts[2]} particles; sound slower than water's: ten times as fast as anything here
*PART
water
{WATER:10d}{WATER:10d}{WATER:10d}{WATER:10d}
*SECTION_SPH
{WATER:10d}       1.5       0.2         2
*MAT_NULL
{WATER:10d}  1.00e-09    -1e-06     1e-09
*EOS_GRUNEISEN
{WATER:10d}   150.0e3     1.979         0         0      0.11

*CONTROL_SPH
         1         0     1e+20         3
*PLASH_SPH_FORMULATION
         4       0.1
*BOUNDARY_SPH_SYMMETRY_PLANE
{x0:10.1f}         0         0         0         0         0
{x1:10.1f}         0         0         0         0         0
         0{-half:10.1f}         0         0         0         0
         0{half:10.1f}         0         0         0         0
         0         0{top - depth:10.1f}         0         0         0
*CONTACT_AUTOMATIC_NODES_TO_SURFACE_ID
         2water on section
{WATER:10d}         1         3         2
         0         0         0         0        20
         1         1{s:10.4g}
         1       0.1
*NODE
"""
    nodes = [(x0 + (i + 0.5) * steps[0], -half + (j + 0.5) * steps[1], top - (k + 0.5) * steps[2])
             for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2])]
    text += "".join(f"{100001 + n},{x:.7g},{y:.7g},{z:.7g}\n" for n, (x, y, z) in enumerate(nodes))
    mass = 1e-9 * steps[0] * steps[1] * steps[2]
    write("ground_water.k", text + "*ELEMENT_SPH\n"
          + "".join(f"{100001 + n},{WATER},{mass:.7g}\n" for n in range(len(nodes))))
    cells = [16, 20, 6]
    text = f"""$ soil: a loose sand (*MAT_005), assumed: friction by a2, crushing by the curve of volume strain and pressure
*PART
soil
{SOIL:10d}{SOIL:10d}{SOIL:10d}         0{SOIL:10d}
*SECTION_SOLID
{SOIL:10d}         1
*HOURGLASS
{SOIL:10d}         4      0.05
*MAT_SOIL_AND_FOAM
$      mid        ro         g      bulk        a0        a1        a2        pc
{SOIL:10d}   1.5e-09       5.0      50.0       0.0       0.0       0.3    -0.001
$      vcr       ref
         0         0
       0.0     -0.01     -0.03     -0.06     -0.10     -0.15     -0.20     -0.25
     -0.30      -0.4
       0.0      0.03      0.08       0.2      0.45       0.9       2.0       5.0
      10.0      40.0
*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE_ID
         2soil under section
         1{SOIL:10d}         2         3
       0.3       0.3
         1         1
         1       0.1
*BOUNDARY_SPC_SET
         9         0         1         1         1
*NODE
"""
    numbers, held, solids = {}, [], []
    for i in range(cells[0] + 1):
        for j in range(cells[1] + 1):
            for k in range(cells[2] + 1):
                numbers[i, j, k] = 100001 + len(numbers)
                x, y = x0 + (x1 - x0) * i / cells[0], half * (2 * j / cells[1] - 1)
                text += f"{numbers[i, j, k]},{x:.7g},{y:.7g},{bottom - depth * (1 - k / cells[2]):.7g}\n"
                if k == 0 or i in (0, cells[0]) or j in (0, cells[1]):
                    held.append(numbers[i, j, k])
    for i in range(cells[0]):
        for j in range(cells[1]):
            for k in range(cells[2]):
                ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                solids.append([numbers[a, b, c] for c in (k, k + 1) for a, b in ring])
    text += "*ELEMENT_SOLID\n" + "".join(f"{n},{SOIL},{','.join(map(str, s))}\n" for n, s in enumerate(solids, 100001))
    text += "*SET_NODE_LIST\n         9\n"
    text += "".join(",".join(map(str, held[n:n + 8])) + "\n" for n in range(0, len(held), 8))
    write("ground_soil.k", text)


def material(number, alloy):
    density, young, poisson, strength, hardening = ALLOYS[alloy]
    return f"""*MAT_PIECEWISE_LINEAR_PLASTICITY
{number:10d}{density:10.3g}{young:10.4g}{poisson:10.4g}{strength:10.4g}{hardening:10.4g}



"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--around", type=int, default=80, help="cells around the skin; a multiple of 8")
    parser.add_argument("--along", type=int, default=12, help="cells along the section; a multiple of 12")
    parser.add_argument("--spacing", type=float, default=175.0, help="of the water's particles [mm]")
    args = parser.parse_args()
    section = Section(args.around, args.along)
    grounds(args)
    text = f"""*KEYWORD
*TITLE
Drop of a fuselage section
$ units: t, mm, s, N, MPa; written by make_deck.py
*PARAMETER
$ rigid, water or soil
C   GROUND     rigidR    SPEED{SPEED:10.4g}R      END      0.12
*PARAMETER_EXPRESSION
R   STATES &END/24
*CONTROL_TERMINATION
      &END
*CONTROL_ENERGY
         2         2         2
*CONTROL_SHELL
$   wrpang     esort     irnxx    istupd    theory
        20         1
*DATABASE_GLSTAT
     2e-04
*DATABASE_MATSUM
     2e-04
*DATABASE_RCFORC
     2e-04
*DATABASE_RWFORC
     2e-04
*DATABASE_NODOUT
     2e-04
*DATABASE_BINARY_D3PLOT
   &STATES
*INCLUDE
ground_&GROUND.k
*LOAD_BODY_Z
         1    9810.0
*DEFINE_CURVE
         1
                 0.0                 1.0
               100.0                 1.0
*SET_PART_LIST
         1
{SKIN:10d}{DOOR:10d}{FRAME:10d}{FLOOR:10d}{TANK:10d}
*CONTACT_AUTOMATIC_SINGLE_SURFACE_ID
         1section in itself
         1         0         2         0
       0.2       0.2


"""
    for number, name in ((SKIN, "skin"), (DOOR, "cargo door"), (FRAME, "frames"), (FLOOR, "floor"), (TANK, "tank"),
                         (STRINGER, "stringers"), (FLOOR_BEAM, "floor beams"), (RAILS, "rails")):
        text += f"*PART\n{name}\n{number:10d}{number:10d}{1 if number in (SKIN, DOOR, TANK) else 2:10d}\n"
    text += material(1, "2024-T3") + material(2, "7075-T6")
    for number, thickness in ((SKIN, SKIN_T), (DOOR, DOOR_T), (FRAME, FRAME_T), (FLOOR, FLOOR_T),
                              (TANK, section.tank_thickness)):
        text += f"*SECTION_SHELL\n{number:10d}         2         0         3\n{thickness:10.4g}\n"
    # Beams of rectangular section, Hughes-Liu: height, width.
    for number, height, width in ((STRINGER, 20.0, 6.0), (FLOOR_BEAM, 3.0, 150.0), (RAILS, 30.0, 40.0)):
        text += f"*SECTION_BEAM\n{number:10d}         1         0         2         0\n"
        text += f"{height:10g}{height:10g}{width:10g}{width:10g}\n"
    text += "*NODE\n" + "".join(f"{n},{x:.7g},{y:.7g},{z:.7g}\n" for n, (x, y, z) in enumerate(section.nodes, 1))
    number = 1
    text += "*ELEMENT_SHELL\n"
    for part, elements in section.shells.items():
        for corners in elements:
            text += f"{number},{part},{','.join(map(str, corners))}\n"
            number += 1
    text += "*ELEMENT_BEAM\n"
    for part, elements in section.beams.items():
        for ends in elements:
            text += f"{number},{part},{','.join(map(str, ends))}\n"
            number += 1
    text += "*ELEMENT_MASS\n"
    for node, mass in section.masses.items():
        text += f"{number},{node},{mass:.8g}\n"
        number += 1
    everyone = section.nodes
    text += "*SET_NODE_GENERAL\n         2\n" + "PART      " + "".join(f"{p:10d}" for p in range(1, 8)) + f"\nPART      {RAILS:10d}\n"
    text += f"*INITIAL_VELOCITY\n         2\n       0.0       0.0   -&SPEED\n*DATABASE_HISTORY_NODE\n"
    for start in range(0, len(section.gauges), 8):
        text += "".join(f"{n:10d}" for n in section.gauges[start:start + 8]) + "\n"
    write("fuselage.k", text + "*END\n")
    print(f"{len(everyone)} nodes, {sum(map(len, section.shells.values()))} shells, {sum(map(len, section.beams.values()))} beams, "
          f"{1e3 * (section.mass + sum(section.masses.values())):.0f} kg, structure {1e3 * section.mass:.0f} kg")


main()
