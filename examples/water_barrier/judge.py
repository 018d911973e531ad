#!/usr/bin/env python3
"""Judges runs of the water-filled barrier, with water of that many layers: judge.py barrier|drop DIRECTORY... [--layers 6]"""
import argparse
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import curves  # noqa: E402
import make_deck as deck  # noqa: E402


def places(deck_nodes, displacements):
    """Places of nodes at the last state of nodout."""
    return {n: tuple(x + u for x, u in zip(deck_nodes[n], rows[-1][1:4])) for n, rows in displacements.items()
            if n in deck_nodes}


def read_mesh(path, parameters):
    """Nodes and shells of a deck of this folder with its water."""
    nodes, shells, keyword = {}, [], ""
    with open(path) as file:
        for line in file:
            line = line.strip()
            if line.startswith("*"):
                keyword = line
            elif line.startswith("$"):
                continue
            elif keyword == "*NODE":
                words = line.split(",")
                nodes[int(words[0])] = tuple(map(float, words[1:4]))
            elif keyword == "*ELEMENT_SHELL":
                shells.append(tuple(map(int, line.split(",")[2:])))
            elif keyword == "*INCLUDE":
                for name, value in parameters.items():
                    line = line.replace("&" + name, str(value))
                nodes.update(read_mesh(os.path.join(os.path.dirname(path), line), {})[0])
    return nodes, shells


def outside(place, shells):
    """Particles (nodes from 20001 on) that the closed surface of the tank does not go around, by solid angles."""
    triangles = [tuple(place[n] for n in (a, b, c)) for a, b, c, d in shells]
    triangles += [tuple(place[n] for n in (a, c, d)) for a, b, c, d in shells]
    count = 0
    for node, p in place.items():
        if node <= 20000:
            continue
        angle = 0.0
        for triangle in triangles:
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = ([x - y for x, y in zip(corner, p)] for corner in triangle)
            a, b, c = math.sqrt(ax * ax + ay * ay + az * az), math.sqrt(bx * bx + by * by + bz * bz), \
                math.sqrt(cx * cx + cy * cy + cz * cz)
            volume = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
            angle += 2 * math.atan2(volume, a * b * c + (ax * bx + ay * by + az * bz) * c
                                    + (bx * cx + by * cy + bz * cz) * a + (cx * ax + cy * ay + cz * az) * b)
        count += angle < 2 * math.pi
    return count


def fill_of(folder, default):
    for word in os.path.basename(os.path.normpath(folder)).replace("_", "=").split("="):
        if word.isdigit():
            default = int(word)
    return default


def leaks(folder, name, fill, layers):
    nodes, shells = read_mesh(os.path.join(deck.FOLDER, name), {"FILL": fill, "LAYERS": layers})
    place = places(nodes, curves.nodes(folder))
    water = sum(node > 20000 for node in place)
    return f"{outside(place, shells)} of {water} particles outside the tank" if water else "no water"


def barrier(folder, layers):
    parts = curves.parts(folder)
    first = parts[deck.BLOCK][0][2]
    shares = {part: 100 * (rows[-1][1] + rows[-1][2]) / first for part, rows in parts.items()}
    force = [(row[0], math.hypot(row[1], row[2])) for row in curves.contact(folder, 1)]
    hit = next(time for time, f in force if f > 0)
    water = [(row[0], math.hypot(row[1], row[2])) for row in curves.contact(folder, 2)]
    peak = curves.largest(force)
    line = f"{folder}: block's energy {1e-3 * first * 1e3:.1f} mJ\n  block on tank {peak[1]:.1f} N at {1e3 * peak[0]:.2f} ms " \
           f"(touch {1e3 * hit:.2f} ms)"
    if water:
        second = curves.largest([row for row in curves.smooth(water, 2e-4)])
        line += f", water on tank {second[1]:.1f} N at {1e3 * second[0]:.2f} ms"
    water_part = parts.get(deck.WATER)
    kinetic = max(100 * row[2] / first for row in water_part) if water_part else 0.0
    print(f"{line}\n  energy at the end: block {shares[deck.BLOCK]:.1f} %, tank {shares[deck.TANK]:.1f} % (kinetic "
          f"{100 * parts[deck.TANK][-1][2] / first:.1f} %), water {shares.get(deck.WATER, 0):.1f} % (kinetic at most {kinetic:.1f} %)\n"
          f"  {leaks(folder, 'barrier.k', fill_of(folder, 50), layers)}\n  {curves.cost(folder)}")


def drop(folder, layers):
    parts = curves.parts(folder)
    print(folder)
    for part, name in ((deck.TANK, "tank"), (deck.WATER, "water")):
        rows = parts[part]
        print(f"  {name}: {rows[0][2] * 1e-3:.0f} J at first, at the end {rows[-1][2] * 1e-3:.0f} J of motion, "
              f"{rows[-1][1] * 1e-3:.0f} J inside")
    momentum = [(row[0], sum(parts[p][i][5] for p in (deck.TANK, deck.WATER)))
                for i, row in enumerate(parts[deck.TANK])]
    print(f"  momentum {momentum[0][1]:.1f} to {momentum[-1][1]:.1f} N s\n"
          f"  {leaks(folder, 'tank_drop.k', 80, layers)}\n  {curves.cost(folder)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("case", choices=("barrier", "drop"))
    parser.add_argument("folders", nargs="+", metavar="DIRECTORY")
    parser.add_argument("--layers", type=int, help="of the run's water at full height (default: 6, of the drop 8)")
    args = parser.parse_args()
    judge, layers = {"barrier": (barrier, 6), "drop": (drop, 8)}[args.case]
    for folder in args.folders:
        judge(folder, args.layers or layers)


if __name__ == "__main__":
    main()
