#!/usr/bin/env python3
"""Judges runs of the bird strikes: python3 judge.py plate|tapered|beam DIRECTORY..."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import curves  # noqa: E402
import make_deck as deck  # noqa: E402


def hugoniot(speed):
    """Pressure [MPa] behind the shock in a bird that hits a rigid plate with `speed` [mm/s]."""
    low, high = deck.PRESSURES[1], deck.PRESSURES[-1]
    for _ in range(60):
        pressure = 0.5 * (low + high)
        low, high = ((pressure, high) if pressure < deck.BIRD_DENSITY * speed ** 2 / (1 - deck.volume(pressure))
                     else (low, pressure))
    return low


def mean(rows, begin, end):
    values = [value for time, value in rows if begin <= time <= end]
    return sum(values) / len(values)


def speed_of(folder, part):
    """From momentum and kinetic energy of the part at the start: E = m v^2 / 2, p = m v."""
    row = curves.parts(folder)[part][0]
    momentum = math.sqrt(sum(p * p for p in row[3:6]))
    return 2 * row[2] / momentum, momentum


def plate(folder):
    speed, momentum = speed_of(folder, deck.BIRD)
    total = [(row[0], -row[3]) for row in curves.contact(folder, 1)]
    pressure = [(row[0], -row[3] / (2 * deck.CELL) ** 2) for row in curves.contact(folder, 2, "slave")]
    crossing = deck.LENGTH / speed
    shock, flow = hugoniot(speed), 0.5 * deck.BIRD_DENSITY * speed ** 2
    raw = curves.largest(pressure)
    steady = mean(pressure, 0.5 * crossing, 0.85 * crossing)
    first = curves.largest(curves.smooth(pressure, 5e-6))
    print(f"{folder}: {1e-3 * speed:.0f} m/s\n"
          f"  transducer: peak {raw[1]:.1f}, over 5 us {first[1]:.1f} MPa at {1e6 * first[0]:.1f} us; shock "
          f"{shock:.1f} MPa ({100 * (first[1] / shock - 1):+.0f} %); steady {steady:.2f}, flow {flow:.2f} MPa "
          f"({100 * (steady / flow - 1):+.0f} %)\n"
          f"  largest force {1e-3 * curves.largest(total)[1]:.1f} kN; impulse {curves.impulse(total):.3f} N s, the bird's "
          f"momentum {momentum:.3f} N s ({100 * (curves.impulse(total) / momentum - 1):+.1f} %)\n"
          f"  {curves.cost(folder)}")


def tapered(folder):
    speed, _ = speed_of(folder, deck.BIRD)
    force = [(row[0], 2 * math.sqrt(sum(f * f for f in row[1:4]))) for row in curves.contact(folder, 1)]
    edge = [(row[0], row[3]) for row in curves.nodes(folder)[1]]
    time, deflection = curves.largest(edge)
    energy = curves.parts(folder)[deck.PLATE][-1]
    print(f"{folder}: {1e-3 * speed:.0f} m/s\n"
          f"  edge: largest normal deflection {deflection:.2f} mm ({deflection / 25.4:.3f} in) at {1e3 * time:.2f} ms, at the "
          f"end {edge[-1][1]:.2f} mm\n"
          f"  largest force (both halves) {1e-3 * curves.largest(force)[1]:.2f} kN; plate takes {2e-3 * energy[1]:.2f} J\n"
          f"  {curves.cost(folder)}")


def beam(folder):
    """The theorem of impulse and momentum for the projectile, over the time of contact."""
    force = [(row[0], abs(row[3])) for row in curves.contact(folder, 1)]
    impulse = curves.impulse(force)
    begin = next(time for time, f in force if f > 0)
    # The first contact ends when the force has gone for a microsecond.
    end = next(time for time, f in force if time > begin and f == 0
               and all(g == 0 for t, g in force if time <= t <= time + 1e-6))
    first = [row for row in force if row[0] <= end]
    rows = [row for row in curves.parts(folder)[deck.BIRD] if row[0] <= end + 2e-7]
    change = rows[-1][5] - rows[0][5]
    average = curves.impulse(first) / (end - begin)
    print(f"{folder}\n"
          f"  in all {1e3 * impulse:.2f} N ms in {1e6 * force[-1][0]:.0f} us; first contact {1e6 * (end - begin):.2f} us; impulse {1e3 * curves.impulse(first):.2f} N ms, momentum that the projectile "
          f"lost {1e3 * change:.2f} N ms ({100 * (curves.impulse(first) / change - 1):+.2f} %)\n"
          f"  largest force {1e-3 * curves.largest(force)[1]:.2f} kN, mean over the contact {1e-3 * average:.2f} kN; over 24.5 mm^2 "
          f"{1e-3 * curves.largest(force)[1] / 24.5:.2f} GPa\n"
          f"  {curves.cost(folder)}")


def main():
    cases = {"plate": plate, "tapered": tapered, "beam": beam}
    if len(sys.argv) < 3 or sys.argv[1] not in cases:
        sys.exit(__doc__)
    for folder in sys.argv[2:]:
        cases[sys.argv[1]](folder)


if __name__ == "__main__":
    main()
