"""Static answer of the one-point quadrilateral of Belytschko, Lin & Tsay (1984) for the pinched cylinder of
test_shell_known_answers.cpp: one linear system of its strains and hourglass stiffnesses, without any of
Plash. Prints the displacement under the load over that of the series, 1.8248e-5.

    python3 tests/verification/pinched_cylinder.py [WARPING [CONSISTENT]]

WARPING: QW (0.03 without). CONSISTENT: 1 takes the twist of the rotations out of the checkerboard of the
deflections, so that plates are not stiffened whatever QW is.
"""
import math
import sys

R, LENGTH, T, E, NU, SHRF, Q = 300.0, 300.0, 3.0, 3e6, 0.3, 5 / 6, 0.03
G = E / (2 * (1 + NU))


def stiffness(a, b, warping, consistent):
    """Of a rectangle a x b in its frame, 6 freedoms a corner."""
    area, signs = a * b, (1, -1, 1, -1)
    by_x = [s / (2 * a) for s in (-1, 1, 1, -1)]
    by_y = [s / (2 * b) for s in (-1, -1, 1, 1)]
    rows = []  # (factor, row): each adds factor row^T row to the energy

    def row(entries):
        line = [0.0] * 24
        for corner in range(4):
            for freedom, value in entries(corner):
                line[6 * corner + freedom] += value
        return line

    exx, eyy = row(lambda i: [(0, by_x[i])]), row(lambda i: [(1, by_y[i])])
    exy = row(lambda i: [(0, by_y[i]), (1, by_x[i])])
    kxx, kyy = row(lambda i: [(4, by_x[i])]), row(lambda i: [(3, -by_y[i])])
    kxy = row(lambda i: [(4, by_y[i]), (3, -by_x[i])])
    plane = E / (1 - NU * NU)
    for xx, yy, xy, weight in ((exx, eyy, exy, T * area), (kxx, kyy, kxy, T**3 / 12 * area)):
        both = [p + q for p, q in zip(xx, yy)]
        rows += [(plane * NU * weight, both), (plane * (1 - NU) * weight, xx), (plane * (1 - NU) * weight, yy)]
        rows.append((G * weight, xy))
    rows.append((SHRF * G * T * area, row(lambda i: [(2, by_x[i]), (4, 0.25)])))
    rows.append((SHRF * G * T * area, row(lambda i: [(2, by_y[i]), (3, -0.25)])))
    gradient = sum(x * x for x in by_x + by_y)
    for freedom, factor in ((0, E * T * area / 8), (1, E * T * area / 8), (3, E * T**3 * area / 192),
                            (4, E * T**3 * area / 192)):
        rows.append((Q * factor * gradient, row(lambda i: [(freedom, signs[i])])))
    checkerboard = row(lambda i: [(2, signs[i])])
    if consistent:
        checkerboard = [p + 0.5 * area * q for p, q in zip(checkerboard, kxy)]
    rows.append((warping * SHRF * G * T**3 / 12 * gradient, checkerboard))
    k = [[0.0] * 24 for _ in range(24)]
    for factor, line in rows:
        for i, p in enumerate(line):
            if p:
                for j, q in enumerate(line):
                    k[i][j] += factor * p * q
    for corner in range(4):
        k[6 * corner + 5][6 * corner + 5] += 1e-7 * E * T**3  # against turning about the normal
    return k


def displacement(n, warping, consistent):
    local = stiffness(2 * R * math.sin(math.pi / 4 / n), LENGTH / n, warping, consistent)
    width, size = 6 * (n + 2) + 6, 6 * (n + 1) ** 2
    node = lambda i, j: j * (n + 1) + i
    held = [False] * size
    for k in range(n + 1):
        for i, j, freedoms in ((0, k, (0, 4, 5)), (n, k, (1, 3, 5)), (k, 0, (2, 3, 4)), (k, n, (0, 1, 5))):
            for freedom in freedoms:
                held[6 * node(i, j) + freedom] = True
    band = [[0.0] * width for _ in range(size)]  # band[r][d] = entry (r, r - d)
    for i in range(n):
        angle = math.pi / 2 * (i + 0.5) / n
        c, s = math.cos(angle), math.sin(angle)
        frame = ((c, -s, 0), (0, 0, 1), (-s, -c, 0))
        turned = [[0.0] * 24 for _ in range(24)]
        for p in range(8):
            for q in range(8):
                for r in range(3):
                    for u in range(3):
                        turned[3 * p + r][3 * q + u] = sum(
                            frame[k][r] * local[3 * p + k][3 * q + l] * frame[l][u] for k in range(3) for l in range(3))
        for j in range(n):
            place = [6 * node(x, y) + f for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)) for f in range(6)]
            for p, r in enumerate(place):
                for q, u in enumerate(place):
                    if u <= r and not held[r] and not held[u]:
                        band[r][r - u] += turned[p][q]
    for r in range(size):
        if held[r]:
            band[r][0] = 1.0
    force = [0.0] * size
    force[1] = -0.25
    for r in range(size):  # L D L^T, a row at a time
        low, line = max(0, r - width + 1), band[r]
        for u in range(low, r):
            other, start = band[u], max(low, u - width + 1)
            line[r - u] -= sum(line[r - k] * other[u - k] for k in range(start, u) if line[r - k])
        for u in range(low, r):
            factor = line[r - u] / band[u][0]
            line[0] -= factor * line[r - u]
            line[r - u] = factor
        force[r] -= sum(line[r - k] * force[k] for k in range(low, r))
    for r in range(size - 1, -1, -1):
        force[r] /= band[r][0]
    for r in range(size - 1, -1, -1):
        for k in range(max(0, r - width + 1), r):
            force[k] -= band[r][r - k] * force[r]
    return -force[1] / 1.8248e-5


if __name__ == "__main__":
    qw = float(sys.argv[1]) if len(sys.argv) > 1 else Q
    for count in (8, 16):
        print(f"{count} x {count}: {displacement(count, qw, sys.argv[2:] == ['1']):.4f}", flush=True)
