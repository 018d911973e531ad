#!/usr/bin/env python3
"""Judges a cavity: python3 judge.py DECK DIRECTORY. Largest and mean errors on the centre lines, in lid speeds.

reference.csv: an own finite-difference solution (129^2 and 257^2, extrapolated), which confirms Ghia, Ghia & Shin (1982) up to
their own error near the walls. Particles: mean over the last 30 % of the run.
"""
import csv
import math
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, ".."))
import curves  # noqa: E402


def at_nodes(rows, side, axis):
    """Profiles of the Eulerian mesh: u(y) and v(x) by linear interpolation between nodes."""
    middle = side // 2

    def profile(numbers, component):
        values = [rows[n][-1][component] for n in numbers]

        def value(place):
            cell = min(int(place * side), side - 1)
            return values[cell] + (place * side - cell) * (values[cell + 1] - values[cell])
        return value
    number = lambda i, k: 1 + i + (side + 1) * 2 * k  # noqa: E731
    if axis == "u":
        return profile([number(middle, k) for k in range(side + 1)], 4)
    return profile([number(i, middle) for i in range(side + 1)], 6)


def states_of(rows, places):
    """What particles and their images behind the walls do in the last 30 % of a run: (x, y, u, v) each."""
    count = len(next(iter(rows.values())))
    found = []
    for step in range(int(0.7 * count), count):
        for number, row in rows.items():
            x, y = places[number][0] + row[step][1], places[number][1] + row[step][2]
            u, v = row[step][4], row[step][5]
            found += [(x, y, u, v), (x, -y, -u, -v), (x, 2 - y, 2 - u, -v), (-x, y, -u, -v), (2 - x, y, -u, -v)]
    return found


def solve(matrix, right):
    """Gauss elimination with pivots."""
    rows = [row + [value] for row, value in zip(matrix, right)]
    size = len(rows)
    for k in range(size):
        pivot = max(range(k, size), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, size):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    result = [0.0] * size
    for k in reversed(range(size)):
        result[k] = (rows[k][size] - sum(rows[k][i] * result[i] for i in range(k + 1, size))) / rows[k][k]
    return result


def of_particles(states, side, axis):
    """Velocity on a centre line by a quadratic fit over two spacings around each place: a weighted mean would cut peaks."""
    reach, component = 2.0 / side, 2 if axis == "u" else 3
    along, across = (1, 0) if axis == "u" else (0, 1)
    near = [s for s in states if abs(s[across] - 0.5) < reach]

    def value(place):
        matrix, right = [[0.0] * 6 for _ in range(6)], [0.0] * 6
        for state in near:
            a, b = (state[along] - place) / reach, (state[across] - 0.5) / reach
            q = math.hypot(a, b)
            if q >= 1:
                continue
            weight, terms = (1 - q) ** 4 * (1 + 4 * q), (1, a, b, a * a, b * b, a * b)
            for i in range(6):
                right[i] += weight * terms[i] * state[component]
                for k in range(6):
                    matrix[i][k] += weight * terms[i] * terms[k]
        return solve(matrix, right)[0]
    return value


def grid_of(states, side):
    """Mean velocities at the nodes of a grid, weighted by a kernel of 1.5 spacings of the particles."""
    cells = min(side, 64)
    reach = 1.5 / side
    total = [[[0.0, 0.0, 0.0] for _ in range(cells + 1)] for _ in range(cells + 1)]
    for x, y, u, v in states:
        for i in range(max(0, math.ceil((x - reach) * cells)), min(cells, math.floor((x + reach) * cells)) + 1):
            for k in range(max(0, math.ceil((y - reach) * cells)), min(cells, math.floor((y + reach) * cells)) + 1):
                q = math.hypot(x - i / cells, y - k / cells) / reach
                if q < 1:
                    weight, sums = (1 - q) ** 4 * (1 + 4 * q), total[i][k]
                    sums[0] += weight
                    sums[1] += weight * u
                    sums[2] += weight * v
    return [[(s[1] / s[0], s[2] / s[0]) for s in column] for column in total]


def stream_of_grid(grid):
    """Stream function that is zero on the walls and has the vorticity of the grid (over-relaxation)."""
    n = len(grid) - 1
    stream = [[0.0] * (n + 1) for _ in range(n + 1)]
    source = [[0.0] * (n + 1) for _ in range(n + 1)]
    for i in range(1, n):
        for k in range(1, n):
            curl = (grid[i + 1][k][1] - grid[i - 1][k][1] - grid[i][k + 1][0] + grid[i][k - 1][0]) * n / 2
            source[i][k] = curl / n ** 2
    faster = 2 / (1 + math.sin(math.pi / n))
    for _ in range(6 * n):
        for i in range(1, n):
            for k in range(1, n):
                around = stream[i - 1][k] + stream[i + 1][k] + stream[i][k - 1] + stream[i][k + 1]
                stream[i][k] += faster * ((around + source[i][k]) / 4 - stream[i][k])
    return stream


def stream_of_mesh(rows, side):
    at = lambda i, k: rows[1 + i + (side + 1) * 2 * k][-1]  # noqa: E731
    stream = [[0.0] * (side + 1) for _ in range(side + 1)]
    for i in range(side + 1):
        for k in range(1, side + 1):
            stream[i][k] = stream[i][k - 1] + 0.5 * (at(i, k - 1)[4] + at(i, k)[4]) / side
    return stream


def vortices(stream):
    """Centres of all vortices: (x, z, stream function), where that has an extremum."""
    n, found = len(stream) - 1, []
    for i in range(1, n):
        for k in range(1, n):
            around = [stream[a][b] for a in range(i - 1, i + 2) for b in range(k - 1, k + 2) if (a, b) != (i, k)]
            here = stream[i][k]
            if abs(here) > 1e-7 and (here > max(around) or here < min(around)):
                found.append((i / n, k / n, here))
    return sorted(found, key=lambda vortex: -abs(vortex[2]))


def main():
    deck, folder = sys.argv[1:3]
    title, places, keyword = "", {}, ""
    with open(deck) as file:
        for line in file:
            if line.startswith("*"):
                keyword = line.strip()
            elif keyword == "*TITLE":
                title, keyword = line.strip(), ""
            elif keyword == "*NODE":
                words = line.split(",")
                places[int(words[0])] = (float(words[1]), float(words[2]))
    reynolds, side = re.search(r"Re (\d+), (\d+)", title).groups()
    side, rows = int(side), curves.nodes(folder)
    print(f"{title}: {curves.cost(folder)}")
    with open(os.path.join(HERE, "reference.csv")) as file:
        reference = list(csv.DictReader(row for row in file if not row.startswith("#")))
    states = states_of(rows, places) if places else []
    for axis, name in (("u", "vertical"), ("v", "horizontal")):
        value = of_particles(states, side, axis) if places else at_nodes(rows, side, axis)
        wanted = [(float(row["place"]), float(row[f"Re{reynolds}"])) for row in reference if row["line"] == axis]
        wanted = [(place, w) for place, w in wanted if 0 < place < 1]
        errors = [abs(value(place) - w) for place, w in wanted]
        worst = max(range(len(errors)), key=lambda i: errors[i])
        print(f"  {axis} on the {name} centre line: largest error {100 * errors[worst]:.2f} % of the lid's speed (at "
              f"{wanted[worst][0]:.4f}), mean {100 * sum(errors) / len(errors):.2f} %")
    if places or len(rows) == 2 * (side + 1) ** 2:
        stream = stream_of_grid(grid_of(states, side)) if places else stream_of_mesh(rows, side)
        print("  vortices (x, z, stream function): "
              + "; ".join(f"{x:.4f} {z:.4f} {value:.3g}" for x, z, value in vortices(stream)))


main()
