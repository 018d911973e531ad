#!/usr/bin/env python3
"""Reference values for tests/unit/test_rates.cpp: rate-dependent von Mises laws sheared at a constant rate.

Simple shear at the engineering rate g', with a volume rate v' beside it: the von Mises stress obeys
q' = 3 G (g' / sqrt(3) - p') while q = flow stress. In the continuous equations p' is what the flow stress of the
keyword manual says; here it is found by bisection in steps so small that halving them changes the last digit
printed. The flow stresses are written out again from the manual, not taken from materials/.
"""
import math

E, NU = 210.0, 0.3
G = E / (2 * (1 + NU))
ROOT3 = math.sqrt(3)


def drive(flow, total, gdot, heat=0.0, steps=8000):
    """q and p after the engineering shear strain `total`; flow(p, p', T) [stress]; heat: RO CP."""
    dt = total / gdot / steps
    q, p, temperature = 0.0, 0.0, 0.0
    for _ in range(steps):
        trial = q + 3 * G * gdot / ROOT3 * dt
        if trial <= flow(p, 0.0, temperature):
            q = trial
            continue
        low, high = 0.0, trial / (3 * G)
        for _ in range(60):
            middle = 0.5 * (low + high)
            if trial - 3 * G * middle > flow(p + middle, middle / dt, temperature):
                low = middle
            else:
                high = middle
        q, p = trial - 3 * G * low, p + low
        if heat:
            temperature += q * low / heat
    return q, p


def cowper_symonds(rate, c, p):
    return (rate / c) ** (1 / p)


def logarithm(rate, c, reference):
    return 1 + c * math.log(max(1.0, rate / reference))


if __name__ == "__main__":
    GDOT, VDOT, TOTAL = 0.5, 0.4, 0.2
    shear = GDOT / math.sqrt(2)                            # sqrt(e':e') of the shear
    whole = math.sqrt(shear ** 2 + VDOT ** 2 / 3)          # with the volume
    std = math.sqrt(2 / 3)
    C, P = 0.04, 5.0
    SIGY, EP = 0.3, E * 1.0 / (E - 1.0)
    static = lambda p: SIGY + EP * p
    K, N = 0.5, 0.2
    E0 = (E / K) ** (1 / (N - 1))
    power = lambda p: K * (E0 + p) ** N
    A, B, M, CJ, EPSO = 0.3, 0.4, 0.3, 0.02, 1e-3
    johnson = lambda p: A + B * p ** M
    hot = lambda t: 1 - min(max(t / 1500.0, 0), 1)         # TM - TR = 1500, exponent 1
    RHOCP = 7.85e-6 * 460
    cases = {
        "003 VP 0, total rate": drive(lambda p, r, t: (1 + cowper_symonds(whole, C, P)) * static(p), TOTAL, GDOT),
        "003 VP 0 in shells": drive(lambda p, r, t: (1 + cowper_symonds(shear, C, P)) * static(p), TOTAL, GDOT),
        "003 VP 1": drive(lambda p, r, t: (1 + cowper_symonds(r, C, P)) * static(p), TOTAL, GDOT),
        "024 123 081 VP 0, total rate": drive(
            lambda p, r, t: (1 + cowper_symonds(std * whole, C, P)) * static(p), TOTAL, GDOT),
        "024 123 081 VP -1; VP 0 in shells": drive(
            lambda p, r, t: (1 + cowper_symonds(std * shear, C, P)) * static(p), TOTAL, GDOT),
        "024 123 081 VP 1": drive(lambda p, r, t: static(p) + SIGY * cowper_symonds(r, C, P), TOTAL, GDOT),
        "018 VP 0, total rate": drive(lambda p, r, t: (1 + cowper_symonds(std * whole, C, P)) * power(p), TOTAL, GDOT),
        "018 VP 0 in shells": drive(lambda p, r, t: (1 + cowper_symonds(std * shear, C, P)) * power(p), TOTAL, GDOT),
        "018 VP 1": drive(lambda p, r, t: (1 + cowper_symonds(r, C, P)) * power(p), TOTAL, GDOT),
        "098 VP 0, total rate": drive(lambda p, r, t: logarithm(std * whole, CJ, EPSO) * johnson(p), TOTAL, GDOT),
        "098 VP 0 in shells": drive(lambda p, r, t: logarithm(std * shear, CJ, EPSO) * johnson(p), TOTAL, GDOT),
        "098 VP 1": drive(lambda p, r, t: logarithm(r, CJ, EPSO) * johnson(p), TOTAL, GDOT),
        "015 VP 0": drive(lambda p, r, t: logarithm(std * shear, CJ, EPSO) * johnson(p) * hot(t), TOTAL, GDOT, RHOCP),
        "015 VP 1": drive(lambda p, r, t: logarithm(r, CJ, EPSO) * johnson(p) * hot(t), TOTAL, GDOT, RHOCP),
        "124, total rate": drive(lambda p, r, t: (1 + cowper_symonds(std * whole, C, P)) * static(p), TOTAL, GDOT),
        "124 in shells": drive(lambda p, r, t: (1 + cowper_symonds(std * shear, C, P)) * static(p), TOTAL, GDOT),
    }
    for name, (q, p) in cases.items():
        print("%-36s q %.6f p %.6f" % (name, q, p))
