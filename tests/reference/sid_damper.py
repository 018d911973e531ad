#!/usr/bin/env python3
"""Reference values for tests/unit/test_discrete_beam_laws.cpp: the damper of side impact dummies (*MAT_069).

The open area of the orifices is a sum over fine strips, not the arcs of materials/: of an orifice that is open which
lies nearer to the fixed end than the piston and outside the segment of height H. The force is the formula
of the keyword manual, written out again.
"""
import math

D, H, K, C, RHOF, C1, C2, S0, SF = 4.0, 0.15, 2.0, 0.6, 1.2, 0.3, 0.5, 0.1, 1.5
ORIFICES = [(2.0, 0.4), (4.0, 0.5), (4.6, 0.4)]
LENGTH = 6.0
PISTON = math.pi * D * D / 4
POINTS = 200000


def open_area(length):
    total = 0.0
    for place, r in ORIFICES:
        end = min(length - place, r)
        if end <= -r:
            continue
        width = (end + r) / POINTS
        for i in range(POINTS):
            u = -r + (i + 0.5) * width
            half = math.sqrt(r * r - u * u)
            total += max(half - max(-half, H - r), 0.0) * width
    return total


def force(length, rate):
    s = LENGTH - length + S0
    curve = 3.0 * s if s < 1 else 3.0 + 5.0 * (s - 1)  # points (0, 0), (1, 3), (2, 8), continued
    damper = 0.2 + 0.1 * s                             # points (0, 0.2), (1, 0.3), continued
    whole = open_area(100.0)
    area = max(open_area(length), 0.01 * whole)
    fluid = K * PISTON * rate * (C1 / area + C2 * abs(rate) * RHOF * ((PISTON / (C * area)) ** 2 - 1))
    return SF * (fluid - curve + rate * damper)


for length, rate in [(6.0, -0.5), (4.7, -0.5), (4.1, 0.7), (2.3, -0.2), (1.95, -0.2), (1.62, -0.01)]:
    print(f"length {length} rate {rate}: area {open_area(length):.6f} force {force(length, rate):.5f}")
