#!/usr/bin/env python3
"""Compares a run of wedge.k with what is known: section force, velocity, energy.

    python3 compare.py results/wedge [--csv estimate.csv] [--slice 3] [--deadrise 30] [--velocity 1046] [--mass 1.6394]

Two known answers, both from the similarity solution of a wedge that enters at constant speed, whose force is
f rho V^2 s at the penetration s (f by deadrise, from an independent solution of that problem):
- similarity: that force at the run's own speed and penetration, too high by the braking of the added mass later on;
- estimate: the motion of a wedge on which that added mass grows, d/dt ((m + f/2 rho s^2) V) = m g, with m its mass
  by depth and g its acceleration of free fall in the rig.
Both hold until the water reaches the edge of the wedge.
"""
import argparse
import json
import os

# Force of the whole wedge over rho V^3 t at constant speed, by deadrise [degree].
FORCE = {20: 42.2801, 26: 21.1624, 30: 14.023, 45: 3.44858}
DENSITY = 998e-12  # [t/mm^3]
DEPTH = 333.0      # [mm] of the real wedge
WINDOW = 1e-3      # [s] of the running mean of forces: particles meet the wedge one by one


def estimate(mass, velocity, deadrise, fall, end, steps=200000):
    """Time [s], force of the whole wedge by depth [N/mm], velocity [mm/s]."""
    m = 1e-3 * mass / DEPTH
    added = 0.5 * FORCE[deadrise] * DENSITY
    s, v, step, rows = 0.0, velocity, end / steps, []
    for i in range(steps):
        acceleration = (m * fall - 2 * added * s * v * v) / (m + added * s * s)
        if i % (steps // 300) == 0:
            rows.append((i * step, m * (fall - acceleration), v))
        v += step * acceleration
        s += step * v
    return rows


def contact_force(path, contact=1):
    """(time, |y| force) of the master side of a contact in rcforc."""
    rows = []
    with open(path) as file:
        for line in file:
            words = line.split()
            if len(words) > 3 and words[0] == "master" and int(words[1]) == contact:
                values = line.replace("time", " ").replace("x", " ").replace("y", " ").replace("z", " ").split()
                rows.append((float(values[2]), abs(float(values[4]))))
    return rows


def motion(path):
    """(time, penetration, downward velocity) of node 1 in nodout: columns of 12 behind a number of 10."""
    rows, time = [], None
    with open(path) as file:
        for line in file:
            if "at time" in line:
                time = float(line.split("at time")[1].split(")")[0])
            elif time is not None and line[:10].strip() == "1":
                rows.append((time, -float(line[22:34]), -float(line[58:70])))
                time = None
    return rows


def smooth(rows, window):
    """Running mean over `window` of time."""
    result = []
    for t, _ in rows:
        near = [f for u, f in rows if abs(u - t) <= window / 2]
        result.append((t, sum(near) / len(near)))
    return result


def at(rows, time, column=1):
    return min(rows, key=lambda row: abs(row[0] - time))[column]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("--slice", type=float, default=3.0, help="depth of the model; 1 if it is plane [mm]")
    parser.add_argument("--deadrise", type=int, default=30)
    parser.add_argument("--velocity", type=float, default=1046.0)
    parser.add_argument("--mass", type=float, default=1.6394)
    parser.add_argument("--fall", type=float, default=5474.0)
    parser.add_argument("--csv", help="writes the estimate for the model, for plash compare: time, force up, velocity up")
    args = parser.parse_args()
    with open(os.path.join(args.folder, "summary.json")) as file:
        summary = json.load(file)
    exact = estimate(args.mass, args.velocity, args.deadrise, args.fall, summary["time"])
    if args.csv:
        with open(args.csv, "w") as file:
            file.write("time,force,velocity\n")
            file.writelines(f"{t:.6e},{f * args.slice / 2:.6e},{-v:.6e}\n" for t, f, v in exact)
    # The model is half of a slice.
    force = [(t, 2 * f / args.slice) for t, f in contact_force(os.path.join(args.folder, "rcforc"))]
    force = smooth(force, WINDOW)
    wedge = motion(os.path.join(args.folder, "nodout"))
    print("           section force [N/mm]                                     velocity [mm/s]")
    print("time [ms]      run  estimate              similarity                run   estimate")
    for millisecond in range(2, int(1000 * summary["time"] - 1e3 * WINDOW / 2) + 1, 2):
        time = millisecond / 1000
        run, wanted = at(force, time), at(exact, time)
        similar = FORCE[args.deadrise] * DENSITY * at(wedge, time, 1) * at(wedge, time, 2) ** 2
        print(f"{millisecond:9d} {run:8.4f}  {wanted:8.4f} {100 * (run / wanted - 1):+7.1f} %  {similar:8.4f} "
              f"{100 * (run / similar - 1):+7.1f} %   {at(wedge, time, 2):8.1f} {at(exact, time, 2):8.1f}")
    peak = max(exact, key=lambda row: row[1])
    largest = max(force, key=lambda row: row[1])
    print(f"largest force: {largest[1]:.4f} N/mm at {1000 * largest[0]:.1f} ms; estimate {peak[1]:.4f} N/mm at "
          f"{1000 * peak[0]:.1f} ms")
    lost = args.velocity + args.fall * summary["time"]
    taken, wanted = (lost - v for v in (wedge[-1][2], exact[-1][2]))
    print(f"momentum given to the water: {100 * (taken / wanted - 1):+.1f} % against the estimate")
    print(f"energy balance error {100 * summary['energy']['balance_error_max']:.3f} %, {summary['cycles']} cycles, "
          f"{summary['wall_seconds']:.1f} s")


main()
