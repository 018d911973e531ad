"""Reads what a run of Plash (or LS-DYNA) wrote: for the scripts that judge the examples. No package needed."""
import json
import os
import re

NUMBER = re.compile(r"[-+]?\d+\.\d+E[-+]\d+")


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)


def contact(folder, number, side="master"):
    """Forces of one side of a contact or transducer in rcforc: rows of (time, x, y, z)."""
    rows = []
    with open(os.path.join(folder, "rcforc")) as file:
        for line in file:
            words = line.split()
            if len(words) > 3 and words[0] == side and int(words[1]) == number:
                rows.append(tuple(float(n) for n in NUMBER.findall(line)[:4]))
    return rows


def nodes(folder):
    """nodout as {node: rows of (time, x y z displacements, velocities, accelerations)}."""
    result, time, inside = {}, None, False
    with open(os.path.join(folder, "nodout")) as file:
        for line in file:
            if "at time" in line:
                time = float(line.split("at time")[1].split(")")[0])
            elif "x-disp" in line:
                inside = True
            elif "x-rot" in line:
                inside = False
            elif inside and line[:10].strip().isdigit():
                values = [float(line[10 + 12 * i:22 + 12 * i]) for i in range(9)]
                result.setdefault(int(line[:10]), []).append((time, *values))
    return result


def parts(folder):
    """matsum as {part: rows of [time, internal energy, kinetic energy, x, y, z momentum]}."""
    result, time, row = {}, None, None
    pattern = re.compile(r"mat\.#=\s*(\d+)\s+inten=\s*(\S+)\s+kinen=\s*(\S+)")
    with open(os.path.join(folder, "matsum")) as file:
        for line in file:
            found = pattern.search(line)
            if line.startswith(" time ="):
                time = float(line.split("=")[1])
            elif found:
                row = [time, float(found.group(2)), float(found.group(3))]
                result.setdefault(int(found.group(1)), []).append(row)
            elif "x-mom=" in line:
                row += [float(n) for n in NUMBER.findall(line)]
    return result


def smooth(rows, window):
    """Running mean of (time, value) over `window` of time."""
    result, first, last, total = [], 0, 0, 0.0
    for time, _ in rows:
        while last < len(rows) and rows[last][0] <= time + window / 2:
            total += rows[last][1]
            last += 1
        while rows[first][0] < time - window / 2:
            total -= rows[first][1]
            first += 1
        result.append((time, total / (last - first)))
    return result


def largest(rows):
    """(time, value) where the value is largest in size."""
    return max(rows, key=lambda row: abs(row[1]))


def impulse(rows):
    """Integral over time by the trapezoidal rule."""
    return sum(0.5 * (a[1] + b[1]) * (b[0] - a[0]) for a, b in zip(rows, rows[1:]))


def cost(folder):
    """One line: balance, cycles, CPU seconds."""
    run = summary(folder)
    return (f"{run['termination']} end, balance error {100 * run['energy']['balance_error_max']:.3g} %, "
            f"{run['cycles']} cycles, {run['cpu_seconds']:.1f} CPU s")
