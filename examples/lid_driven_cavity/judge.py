#!/usr/bin/env python3
"""Judges a cavity: python3 judge.py DECK DIRECTORY. Largest and mean errors on the centre lines, in lid speeds.

reference.csv: an own finite-difference solution (129^2 and 257^2, extrapolated), which confirms Ghia, Ghia & Shin (1982) up to
their own error near the walls. Particles: mean over the last 30 % of the run, weighted by a kernel of 1.3 spacings.
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


def of_particles(rows, places, side, axis):
    reach, states = 2 * 1.3 / side, []
    for step in range(len(next(iter(rows.values())))):
        states.append([(places[n][0] + r[step][1], places[n][1] + r[step][2], r[step][4], r[step][5])
                       for n, r in rows.items()])
    states = states[int(0.7 * len(states)):]

    def value(place):
        x0, y0 = (0.5, place) if axis == "u" else (place, 0.5)
        weight = total = 0.0
        for state in states:
            for x, y, u, v in state:
                # The particle, and what it looks like behind the walls: the lid has speed 1.
                for px, py, pu, pv in ((x, y, u, v), (x, -y, -u, -v), (x, 2 - y, 2 - u, -v), (-x, y, -u, -v),
                                       (2 - x, y, -u, -v)):
                    distance = math.hypot(px - x0, py - y0)
                    if distance < reach:
                        w = (1 - distance / reach) ** 4 * (1 + 4 * distance / reach)
                        weight += w
                        total += w * (pu if axis == "u" else pv)
        return total / weight
    return value


def vortices(rows, side):
    """Centres of all vortices of the Eulerian mesh: (x, z, stream function), where that has an extremum."""
    at = lambda i, k: rows[1 + i + (side + 1) * 2 * k][-1]  # noqa: E731
    stream = [[0.0] * (side + 1) for _ in range(side + 1)]
    for i in range(side + 1):
        for k in range(1, side + 1):
            stream[i][k] = stream[i][k - 1] + 0.5 * (at(i, k - 1)[4] + at(i, k)[4]) / side
    found = []
    for i in range(1, side):
        for k in range(1, side):
            around = [stream[a][b] for a in range(i - 1, i + 2) for b in range(k - 1, k + 2) if (a, b) != (i, k)]
            here = stream[i][k]
            if abs(here) > 1e-7 and (here > max(around) or here < min(around)):
                found.append((i / side, k / side, here))
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
    for axis, name in (("u", "vertical"), ("v", "horizontal")):
        value = of_particles(rows, places, side, axis) if places else at_nodes(rows, side, axis)
        wanted = [(float(row["place"]), float(row[f"Re{reynolds}"])) for row in reference if row["line"] == axis]
        wanted = [(place, w) for place, w in wanted if 0 < place < 1]
        errors = [abs(value(place) - w) for place, w in wanted]
        worst = max(range(len(errors)), key=lambda i: errors[i])
        print(f"  {axis} on the {name} centre line: largest error {100 * errors[worst]:.2f} % of the lid's speed (at "
              f"{wanted[worst][0]:.4f}), mean {100 * sum(errors) / len(errors):.2f} %")
    if not places and len(rows) == 2 * (side + 1) ** 2:
        print("  vortices (x, z, stream function): "
              + "; ".join(f"{x:.4f} {z:.4f} {value:.3g}" for x, z, value in vortices(rows, side)))


main()
