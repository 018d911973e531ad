#!/usr/bin/env python3
"""Judges drops of the fuselage section: python3 judge.py DIRECTORY...

The floor's acceleration beside the tank on the door's side: mean over its gauges, over 5 ms (difference of velocities). Peaks, what the
parts have taken up, the balance.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import curves  # noqa: E402

GRAVITY, WINDOW = 9810.0, 5e-3  # [mm/s^2], [s]
NAMES = {1: "skin", 2: "door", 3: "frames", 4: "floor", 5: "tank", 6: "stringers", 7: "floor beams", 8: "rails"}


def floor_load(folder):
    """(time, acceleration [g]) of the mean of the gauges."""
    gauges = list(curves.nodes(folder).values())
    speed = [(rows[0][0], sum(row[6] for row in rows) / len(rows)) for rows in zip(*gauges)]
    half = round(0.5 * WINDOW / (speed[1][0] - speed[0][0]))
    return [(0.5 * (a[0] + b[0]), (b[1] - a[1]) / (b[0] - a[0]) / GRAVITY) for a, b in zip(speed, speed[2 * half:])]


def peaks(rows, apart=8e-3):
    """The largest values that no larger one is near to, above 3 g, in their order."""
    found = []
    for time, load in sorted(rows, key=lambda row: -row[1]):
        if load > 3 and all(abs(time - other) > apart for other, _ in found):
            found.append((time, load))
    return sorted(found[:5])


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for folder in sys.argv[1:]:
        parts = curves.parts(folder)
        print(f"{folder}\n  floor: " + ", ".join(f"{load:.1f} g at {1e3 * time:.0f} ms" for time, load in peaks(floor_load(folder))))
        taken = {name: 1e-6 * parts[number][-1][1] for number, name in NAMES.items()}
        print("  kJ taken up: " + ", ".join(f"{name} {energy:.1f}" for name, energy in taken.items() if energy > 0.05))
        print(f"  {curves.cost(folder)}")


main()
