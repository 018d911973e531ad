#!/usr/bin/env python3
"""Reference values of the cap model (*MAT_025) for tests/unit/test_geologic_cap.cpp.

The rate equations of Sandler & Rubin's cap model, integrated along strain paths by the explicit midpoint rule in
small steps: elastic rates, and on a surface the plastic multiplier from its consistency condition. No return
mapping, so nothing in common with materials/geologic_cap.cpp but the equations of the model.

Stress state by invariants and one direction: every path here keeps the direction of the deviator.
"""
import math

K, G = 2.1, 1.7                                  # GPa
ALPHA, THETA, GAMMA, BETA = 0.0642, 0.11, 0.0576, 5.4
R, D, W, X0 = 4.2, 6.0, 0.066, 0.19


def envelope(j1):
    return ALPHA + THETA * j1 - GAMMA * math.exp(-BETA * j1)


def envelope_slope(j1):
    return THETA + GAMMA * BETA * math.exp(-BETA * j1)


def cap_end(k):
    return k + R * envelope(k)


def start_kappa():
    low, high = X0 - 5, X0
    for _ in range(200):
        middle = 0.5 * (low + high)
        if cap_end(middle) < X0:
            low = middle
        else:
            high = middle
    return low


def rates(j1, r, k, volume_rate, shear_rate, contracts):
    """Rates of (J1, r, kappa). volume_rate: compaction; shear_rate: of g with r = G g when elastic."""
    elastic = (3 * K * volume_rate, G * shear_rate)
    centre = max(k, 0.0)
    slope = 1 + R * envelope_slope(k)            # dX/dk
    hardening = W * D * math.exp(-D * (cap_end(k) - X0)) * slope  # plastic compaction per kappa
    if j1 > centre:
        f = (j1 - centre) ** 2 + R * R * r * r - (cap_end(k) - centre) ** 2
        a, b = 2 * (j1 - centre), 2 * R * R * r  # df/dJ1, df/dr
        moves = 1.0 if k > 0 else 0.0            # dL/dk
        by_k = -a * moves - 2 * (cap_end(k) - centre) * (slope - moves)
        drive = a * elastic[0] + b * elastic[1]
        if f < -1e-12 or drive <= 0:
            return elastic + (0.0,)
        # J1' = e1 - 9 K m a, r' = e2 - G m b, k' = 3 m a / hardening; f' = 0
        m = drive / (9 * K * a * a + G * b * b - by_k * 3 * a / hardening)
        return elastic[0] - 9 * K * m * a, elastic[1] - G * m * b, 3 * m * a / hardening
    f = r - envelope(j1)
    drive = elastic[1] - envelope_slope(j1) * elastic[0]
    if f < -1e-12 or drive <= 0:
        return elastic + (0.0,)
    s = envelope_slope(j1)
    m = drive / (9 * K * s * s + G)
    dilation = 3 * m * s
    kappa = -dilation / hardening if contracts and k > max(j1, 0.0) else 0.0
    return elastic[0] + 9 * K * m * s, elastic[1] - G * m, kappa


def path(state, volume, shear, steps, contracts=True):
    """A straight way in strain: compaction and engineering-like shear g (elastic r = G g)."""
    j1, r, k = state
    for _ in range(steps):
        v, g = volume / steps, shear / steps
        a = rates(j1, r, k, v, g, contracts)
        middle = [x + 0.5 * y for x, y in zip((j1, r, k), a)]
        b = rates(*middle, v, g, contracts)
        j1, r, k = j1 + b[0], r + b[1], k + b[2]
    return j1, r, k


if __name__ == "__main__":
    start = (0.0, 0.0, start_kappa())
    print("kappa at the start", start[2])
    for steps in (200000, 400000):
        # Uniaxial strain e: compaction e, deviator (2/3, -1/3, -1/3) 2 G e, so r = G g with g = 2 e / sqrt(3).
        e = 0.06
        up = path(start, e, 2 * e / math.sqrt(3), steps)
        print(steps, "uniaxial 0.06: J1 %.7f r %.7f kappa %.7f" % up)
        # Shear after hydrostatic compaction of 0.05: on the cap, then along the envelope.
        squeezed = path(start, 0.05, 0.0, steps)
        print(steps, "hydrostatic 0.05: J1 %.7f r %.7f kappa %.7f" % squeezed)
        print(steps, "then shear 0.2: J1 %.7f r %.7f kappa %.7f" % path(squeezed, 0.0, 0.2, steps))
        # Shear at little pressure: the envelope dilates, the cap comes back.
        small = path(start, 0.005, 0.0, steps)
        print(steps, "0.005, then shear 0.05: J1 %.7f r %.7f kappa %.7f" % path(small, 0.0, 0.05, steps))
