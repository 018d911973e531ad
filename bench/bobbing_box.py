#!/usr/bin/env python3
"""A rigid box that bobs in a plane tank of Eulerian water, beside linear potential flow in the same tank.

Usage: bobbing_box.py [cut] [stiff] [CELLS_IN_HALF_A_TANK ...]     (default: 16 32)
cut: cells that the box cuts (CUTCELLS of *PLASH_ALE_FORMULATION) in place of springs; stiff: sound of 63 m/s in place of 20

Half a tank of 0.4 m, water 0.26 m deep, a box with a draught of 0.075 m and a half width of 0.075 m (on a plane of the mesh)
or 0.0775, 0.08, 0.0825 m (between planes); it starts 10 mm too high. Prints by how much its mean half period exceeds theory's.
"""
import math
import sys

from floating_decks import rigid_box, under_gravity, water_and_void, way_along_z

half_tank, depth, draught, rise, gravity = 0.2, 0.26, 0.075, 0.01, 9.81
coupling = "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.2"
cut = "cut" in sys.argv
stiffness = 4e6 if "stiff" in sys.argv else 4e5


def solver(columns, layers, wet):
    """Laplace's equation in cells of one size: no flow through walls, the potential given half a cell above the highest cells
    of free columns. Returns the numbers of the cells and what solves for the potentials of all sources."""
    number = {}
    for k in range(layers):
        for i in range(columns):
            if wet(i, k):
                number[i, k] = len(number)
    count, width = len(number), columns + 1
    rows = [[0.0] * (width + 1) for _ in range(count)]  # lower band: entry (r, r - d)
    for (i, k), r in number.items():
        for other in ((i + 1, k), (i - 1, k), (i, k + 1), (i, k - 1)):
            q = number.get(other)
            if q is not None:
                rows[r][0] += 1
                if q < r:
                    rows[r][r - q] -= 1
        if k == layers - 1:
            rows[r][0] += 2
    for p in range(count):  # L D L^T
        pivot = rows[p][0]
        below = [(r, rows[r][r - p] / pivot) for r in range(p + 1, min(count, p + width + 1)) if rows[r][r - p] != 0.0]
        for a, (r, l) in enumerate(below):
            for q, m in below[:a + 1]:
                rows[r][r - q] -= l * m * pivot
        for r, l in below:
            rows[r][r - p] = l

    def solve(sources):
        x = sources[:]
        for r in range(count):
            x[r] -= sum(rows[r][d] * x[r - d] for d in range(1, min(width, r) + 1))
        for r in range(count):
            x[r] /= rows[r][0]
        for r in range(count - 1, -1, -1):
            for d in range(1, min(width, r) + 1):
                x[r - d] -= rows[r][d] * x[r]
        return x
    return number, solve


def passages(times, heights, level):
    """Times at which the height passes the level."""
    found = []
    for t, y, t_next, y_next in zip(times, heights, times[1:], heights[1:]):
        y, y_next = y - level, y_next - level
        # Passages that follow at once are a wavering about it.
        if y * y_next < 0 and not (found and t - found[-1] < 0.1):
            found.append(t + (t_next - t) * y / (y - y_next))
    return found


def mean_half_period(times, heights):
    """Between the first and the last passage through the mean level of whole periods. The water is pressed together by its
    weight, more the softer it is, and the box bobs about a level lower by this: through the level of the start a motion that
    fades would seem to take longer where it ends upward."""
    level = 0.0
    for _ in range(10):
        through = passages(times, heights, level)
        end = through[(len(through) - 1) // 2 * 2]
        whole = [y for t, y in zip(times, heights) if through[0] <= t < end]
        level = sum(whole) / len(whole)
    through = passages(times, heights, level)
    return (through[-1] - through[0]) / (len(through) - 1)


def theory(half_box, cell=0.0025, end=2.0, step=5e-4):
    """Half period of the box with the linear waves in the tank; also its added mass over its mass where the surface is free
    of pressure (motions that are quick against gravity)."""
    columns, layers = round(half_tank / cell), round(depth / cell)
    beneath, deep = round(half_box / cell), round(draught / cell)
    number, solve = solver(columns, layers, lambda i, k: i >= beneath or k < layers - deep)
    floor, top_layer = layers - deep - 1, layers - 1
    surface = range(beneath, columns)
    zero = [0.0] * len(number)
    rates, on_floor = [[0.0] * len(surface) for _ in surface], []
    for c, i in enumerate(surface):  # the response to the potential at one place of the surface
        sources = zero[:]
        sources[number[i, top_layer]] = 2.0
        x = solve(sources)
        for r, j in enumerate(surface):
            rates[r][c] = 2 * ((1.0 if r == c else 0.0) - x[number[j, top_layer]]) / cell
        on_floor.append(sum(x[number[j, floor]] for j in range(beneath)) * cell)
    sources = zero[:]
    for i in range(beneath):
        sources[number[i, floor]] = cell
    x = solve(sources)  # to the box's own motion
    by_box = [-2 * x[number[i, top_layer]] / cell for i in surface]
    added = sum(x[number[i, floor]] + 0.5 * cell for i in range(beneath)) * cell
    mass, y, v = draught * half_box, rise, 0.0
    potential, level = [0.0] * len(surface), [-rise * half_box / (half_tank - half_box)] * len(surface)
    times, heights = [], []
    for n in range(round(end / step)):
        times.append(n * step)
        heights.append(y)
        change = [-gravity * e for e in level]
        v += step * (-gravity * half_box * y - sum(a * b for a, b in zip(on_floor, change))) / (mass + added)
        potential = [p + step * c for p, c in zip(potential, change)]
        y += step * v
        level = [e + step * (sum(a * b for a, b in zip(row, potential)) + u * v) for e, row, u in zip(level, rates, by_box)]
    return mean_half_period(times, heights), added / mass


def deck(cells, half_box, end=2.0):
    cell, height, above = half_tank / cells, 0.4, 0.15
    layers = math.ceil(height / cell - 1e-9)
    floor, level = depth - draught + rise, depth - rise * half_box / (half_tank - half_box)
    nodes, shells, first = "", "", 100000
    sides = (((0, 0, floor), (0, cell, 0), (half_box, 0, 0), 2 * round(half_box / cell)),
             ((half_box, 0, floor), (0, cell, 0), (0, 0, draught + above), 2 * round((draught + above) / cell)))
    for corner, a, b, count in sides:
        for j in range(count + 1):
            for i in range(2):
                number = first + i + 2 * j
                x = [corner[d] + a[d] * i + b[d] * j / count for d in range(3)]
                nodes += f"{number},{x[0]:.12g},{x[1]:.12g},{x[2]:.12g}\n"
                if i == 0 and j < count:
                    shells += f"{number},20,{number},{number + 1},{number + 3},{number + 2}\n"
        first += 2 * (count + 1)
    density = 1000 * draught * half_box / (half_box + draught + above) / 0.01
    axes = "".join(f"*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{axis}\n1,0\n{count + 1},{length}\n"
                   for axis, count, length in ((1, cells, half_tank), (2, 1, cell), (3, layers, layers * cell)))
    formulation = "*PLASH_ALE_FORMULATION\n0,1\n" if cut else ""
    return f"""*KEYWORD
*ALE_STRUCTURED_MESH
1,10,1,1
1,2,3
{axes}{water_and_void(stiffness)}*INITIAL_VOLUME_FRACTION_GEOMETRY
10,1,2,3
5,0,1
0,-1,0,1,1,{level:.9g}
5,0,2
-1,-1,{floor:.9g},{half_box},1,1
{rigid_box(density, coupling)}{formulation}{under_gravity(end, 0.002)}*NODE
{nodes}*ELEMENT_SHELL
{shells}*END
"""


def measured(cells, half_box):
    times, ways = way_along_z(deck(cells, half_box))
    return mean_half_period(times, [way + rise for way in ways])


if __name__ == "__main__":
    for half_box in (0.075, 0.0775, 0.08, 0.0825):
        expected, added = theory(half_box)
        print(f"half width {half_box} m: half period of theory {expected:.4f} s, added mass {added:.3f} of the box's")
        for cells in [int(word) for word in sys.argv[1:] if word.isdigit()] or [16, 32]:
            found = measured(cells, half_box)
            print(f"  {cells} cells: {found:.4f} s, {100 * (found / expected - 1):+.1f} %", flush=True)
