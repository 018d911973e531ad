#!/usr/bin/env python3
"""What the mesh and its coupling points alone make of the added mass of the box of bobbing_box.py.

Usage: bobbing_mesh.py [CELLS_IN_HALF_A_TANK ...]     (default: 16)

Of all velocities of the mesh's nodes that keep the volume of every wet cell and follow the box at every coupling point, those
that the box gives to the water at rest have the least kinetic energy (Kelvin); twice that energy is the added mass. No step in
time, no springs, no remap: what is left is the error of the coupling's constraints. Prints it over potential theory's, by where
the box's side stands in its cell (rows) and where its floor stands in its own (columns): with the weights that the coupling
uses, with those of floor points beyond the last node under the floor taken from the cell beside it, so that nodes of the
water beyond the edge are left out, and without any points, where cells that the box cuts keep the volume of their part outside
the box: what flows through the open parts of their faces is what the box makes room for (cut cells, Noh 1964).
"""
import math
import operator
import sys

from bobbing_box import depth, draught, half_tank, theory


def overlap(low, high, a, b):
    return max(0.0, min(high, b) - max(low, a))


class Water:
    """Rows of cells and nodes of half the tank, the box cut out; masses by area."""

    def __init__(self, cells, half_box, floor):
        self.cells, self.size, self.half_box, self.floor = cells, half_tank / cells, half_box, floor
        self.surface = floor + draught
        self.layers = math.ceil(self.surface / self.size - 1e-9)
        self.mass = {}
        self.wet = []
        h = self.size
        for k in range(self.layers):
            for i in range(cells):
                left, low = i * h, k * h
                water = h * overlap(low, low + h, 0, self.surface)
                water -= overlap(left, left + h, 0, half_box) * overlap(low, low + h, floor, self.surface)
                if water < 1e-9 * h * h:
                    continue
                if low + h < self.surface + 1e-9 * h:  # cells of the free surface keep no volume
                    self.wet.append((i, k))
                for node in ((i, k), (i + 1, k), (i, k + 1), (i + 1, k + 1)):
                    self.mass[node] = self.mass.get(node, 0.0) + 0.25 * water

    def held(self, node, axis):
        return node[0] in (0, self.cells) if axis == 0 else node[1] == 0

    def volume(self, cell):
        """Rate of the cell's volume over its width: coefficients by (node, axis)."""
        i, k = cell
        row = {}
        for a in (0, 1):
            for b in (0, 1):
                row[(i + a, k + b), 0] = a - 0.5
                row[(i + a, k + b), 1] = b - 0.5
        return row, 0.0

    def point(self, x, z, axis, speed, cell):
        """Velocity along an axis at a point, by the weights of a cell."""
        s, t = x / self.size - cell[0], z / self.size - cell[1]
        row = {}
        for a in (0, 1):
            for b in (0, 1):
                node = (cell[0] + a, cell[1] + b)
                if self.mass.get(node, 0.0) > 0:
                    row[node, axis] = (s if a else 1 - s) * (t if b else 1 - t)
        total = sum(row.values())
        return {key: weight / total for key, weight in row.items()}, speed

    def points(self, length):
        shells = 2 * round(length / self.size)
        count = shells * math.ceil(length / shells / (0.5 * self.size) - 1e-9)
        return [length * (p + 0.5) / count for p in range(count)]

    def cut_volume(self, cell):
        """Rate of the volume of a cell's part outside the box, over its width, and what the box makes of it at unit speed."""
        h, (i, k) = self.size, cell
        left, low = i * h, k * h
        row = {}

        def pass_face(axis, nodes, start, open_from, open_to, sign):
            length = open_to - open_from
            if length < 1e-9 * h:
                return
            part = (0.5 * (open_from + open_to) - start) / h  # of the middle of the open part
            for node, weight in zip(nodes, (1 - part, part)):
                row[node, axis] = row.get((node, axis), 0.0) + sign * length / h * weight

        for side in (0, 1):
            x, z, sign = left + side * h, low + side * h, 2 * side - 1
            beside = x < self.half_box + 1e-9 * h
            pass_face(0, ((i + side, k), (i + side, k + 1)), low, low, min(low + h, self.floor) if beside else low + h, sign)
            within = z > self.floor - 1e-9 * h
            pass_face(1, ((i, k + side), (i + 1, k + side)), left, max(left, self.half_box) if within else left, left + h, sign)
        holds_floor = low < self.floor - 1e-9 * h and low + h > self.floor - 1e-9 * h
        room = max(0.0, min(self.half_box, left + h) - left) / h if holds_floor else 0.0
        return row, -room

    def cut_conditions(self):
        return [self.cut_volume(cell) for cell in self.wet]

    def conditions(self, within_edges):
        h = self.size
        rows = [self.volume(cell) for cell in self.wet]
        edge, layer = int(self.half_box / h + 1e-9), int(self.floor / h + 1e-9)
        for x in self.points(self.half_box):
            column = int(x / h)
            rows.append(self.point(x, self.floor, 1, 1.0, (column - (within_edges and column == edge), layer)))
        for up in self.points(0.225):
            z = self.floor + up
            if z < self.surface:
                rows.append(self.point(self.half_box, z, 0, 0.0, (edge, int(z / h))))
        return rows


def added_mass(water, rows):
    """Twice the least kinetic energy at unit speed of the box: b . S^-1 b, S the conditions' flexibility."""
    count = len(rows)
    users = {}
    for r, (row, _) in enumerate(rows):
        for key, weight in row.items():
            if not water.held(*key):
                users.setdefault(key, []).append((r, weight))
    matrix = [[0.0] * (r + 1) for r in range(count)]
    for (node, _), entries in users.items():
        for r, a in entries:
            for q, b in entries:
                if q <= r:
                    matrix[r][q] += a * b / water.mass[node]
    # Points that say the same are made distinct by a trace of softness.
    soft = 1e-9 * sum(matrix[r][r] for r in range(count)) / count
    energy, x = 0.0, []
    for r in range(count):  # Cholesky, and the forward half of the solution
        row = matrix[r]
        row[r] += soft
        for q in range(r):
            row[q] = (row[q] - sum(map(operator.mul, row[:q], matrix[q]))) / matrix[q][q]
        row[r] = math.sqrt(row[r] - sum(map(operator.mul, row[:r], row)))
        x.append((rows[r][1] - sum(map(operator.mul, row, x))) / row[r])
        energy += x[-1] * x[-1]
    return energy


if __name__ == "__main__":
    heights = (0.05, 0.35, 0.65, 0.85)
    for cells in [int(word) for word in sys.argv[1:]] or [16]:
        size = half_tank / cells
        print(f"{cells} cells; the floor stands at {', '.join(map(str, heights))} of its cell: as it is; within edges; cut cells")
        for part in (0.0, 0.2, 0.4, 0.6, 0.8):
            half_box = (int(0.0785 / size) + part) * size
            step = 0.0025 if abs(half_box / 0.0025 - round(half_box / 0.0025)) < 1e-6 else 0.00125
            expected = theory(round(half_box / step) * step, step, end=1.0)[1] * draught * half_box
            waters = [Water(cells, half_box, (int((depth - draught) / size) + height) * size) for height in heights]
            kinds = (lambda w: w.conditions(False), lambda w: w.conditions(True), Water.cut_conditions)
            found = [" ".join(f"{added_mass(water, rows(water)) / expected:.3f}" for water in waters) for rows in kinds]
            print(f"  side at {part:.1f}: {';  '.join(found)}", flush=True)
