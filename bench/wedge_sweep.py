#!/usr/bin/env python3
"""The 35 wedge drops of Shah, Orifici & Watmuff (2015) and the wedge of Zhao et al. (1996), by three kinds of water.

    wedge_sweep.py FOLDER [--water sph ale lagrange] [--threads 1] [--mass 1.6394] [--zhao]

sph: particles 1.5 mm apart in plane flow, contact damped by half; ale: Eulerian mesh of 3 mm; lagrange: solids of 3 mm
that go with the water. Runs what FOLDER does not hold yet, writes FOLDER/sweep.csv and one picture for each mass (largest
section force by deadrise, as the paper's figures 7 to 9) beside two theories:
- similarity: momentum with the added mass of the exact similarity solution (tests compare it with other work);
- Wagner (1932): the same with the added mass of a flat plate as wide as the wetted wedge.
The paper's measured forces stand in figures that are not at hand.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys

top = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(top / "examples"))
import curves  # noqa: E402

# Table 1 of the paper: mass [kg], fall in the rig [mm/s^2], drop [mm]: speed at the first touch [mm/s].
RIGS = {1.6394: (5474.0, {50: 740.0, 100: 1046.0, 150: 1281.0}),
        1.8519: (5757.0, {50: 757.0, 100: 1073.0}),
        2.0722: (6230.0, {50: 789.0, 100: 1116.0})}
DEADRISE = (20, 25, 30, 35, 40)
DENSITY, DEPTH = 998e-12, 333.0  # [t/mm^3], [mm]
SOUND = 75e3               # [mm/s] of the water: 14 times the fastest jet
WINDOW = 4e-3              # [s] running mean of runs and theories alike: so far apart are the points of the measured motion
# Of each kind of water: what make_deck.py and the run take, and the depth [mm] that the model's forces stand for.
WATERS = {"sph": (["--plane", "--spacing", 1.5, "--damping", 50], [], 1.0),
          "ale": (["--cell", 3], ["--fluid", "ale"], 3.0),
          "lagrange": (["--spacing", 3], ["--fluid", "lagrange"], 3.0)}
LABELS = {"sph": "particles", "ale": "Eulerian mesh", "lagrange": "solids"}
# Force over rho V^3 t of the constant-speed wedge, from an independent solution of the similarity problem.
SIMILARITY = {20: 42.2801, 23: 29.4901, 26: 21.1624, 30: 14.023, 32: 11.524, 38: 6.54734, 45: 3.44858}


def similarity(deadrise):
    """Between the table's angles: log of the force, linear in the log of the tangent."""
    if deadrise in SIMILARITY:
        return SIMILARITY[deadrise]
    low = max(angle for angle in SIMILARITY if angle < deadrise)
    high = min(angle for angle in SIMILARITY if angle > deadrise)
    place = [math.log(math.tan(math.radians(angle))) for angle in (low, deadrise, high)]
    share = (place[1] - place[0]) / (place[2] - place[0])
    return math.exp((1 - share) * math.log(SIMILARITY[low]) + share * math.log(SIMILARITY[high]))


def wagner(deadrise):
    """Added mass pi/2 rho c^2 with half the wetted width c = pi/2 s / tan(deadrise): the same coefficient."""
    return math.pi ** 3 / (4 * math.tan(math.radians(deadrise)) ** 2)


def estimate(coefficient, mass, velocity, fall, end, steps=20000):
    """Largest section force [N/mm] and its time [s], without and with the running mean: d/dt ((m + f/2 rho s^2) V) = m g."""
    m, added = 1e-3 * mass / DEPTH, 0.5 * coefficient * DENSITY
    s, v, step, rows = 0.0, velocity, end / steps, []
    for i in range(steps):
        acceleration = (m * fall - 2 * added * s * v * v) / (m + added * s * s)
        rows.append((i * step, m * (fall - acceleration)))
        v += step * acceleration
        s += step * v
    return curves.largest(rows)[::-1], curves.largest(curves.smooth(rows, WINDOW))[::-1]


def section_force(folder, depth):
    rows = [(row[0], 2 * abs(row[2]) / depth) for row in curves.contact(folder, 1)]
    return curves.smooth(rows, WINDOW)


def run(folder, water, options, threads):
    """The summary of the run in `folder`; runs the deck if it is not there yet. A run that breaks off says so."""
    if not (folder / "summary.json").exists():
        folder.mkdir(parents=True, exist_ok=True)
        deck = subprocess.run([sys.executable, top / "examples/wedge_drop/make_deck.py", *map(str, WATERS[water][0] + options)],
                              check=True, capture_output=True, text=True).stdout
        (folder / "wedge.k").write_text(deck)
        subprocess.run([top / "build/release/plash", "run", folder / "wedge.k", "-o", folder, "-j", str(threads),
                        *WATERS[water][1]], check=False, stdout=subprocess.DEVNULL)
    return curves.summary(folder)


def draw(path, title, rows):
    """Points of the runs and lines of the theories, by Plash's drawing program."""
    text = f"plot\t{title}\tdeadrise [degree]\tlargest section force [N/mm]\n"
    for drop in sorted({row["drop"] for row in rows}):
        drops = [row for row in rows if row["drop"] == drop]
        for water in WATERS:
            points = [row for row in drops if row["water"] == water]
            if points and water != "lagrange":
                text += f"line\t{LABELS[water]}, {drop} mm\tmarkers\n"
                text += "".join(f"{row['deadrise']}\t{row['force']:.6g}\n" for row in points)
        for key, name in (("similarity", "similarity"), ("wagner", "Wagner")):
            text += f"line\t{name}, {drop} mm\n"
            text += "".join(f"{row['deadrise']}\t{row[key]:.6g}\n" for row in drops if row["water"] == drops[0]["water"])
    diagrams = path.with_suffix(".txt")
    diagrams.write_text(text)
    subprocess.run([top / "build/release/plash-picture", "--diagrams", diagrams, "-o", path], check=True)


def statistics(water, table):
    errors = [row["error_percent"] for row in table]
    text = (f"{water}: {len(table)} runs: mean error {sum(errors) / len(errors):+.1f} %, root mean square "
            f"{math.sqrt(sum(e * e for e in errors) / len(errors)):.1f} %, worst {max(errors, key=abs):+.1f} %; worst balance "
            f"{max(row['balance_percent'] for row in table):.4f} %; {sum(row['cpu_seconds'] for row in table):.0f} CPU s")
    early = [row for row in table if row["termination"] != "normal"]
    return text + (f"; {len(early)} ended early" if early else "")


def shah(folder, args):
    table = []
    cases = [(mass, fall, drop, velocity, deadrise) for mass, (fall, drops) in RIGS.items() if not args.mass or mass in args.mass
             for drop, velocity in drops.items() for deadrise in DEADRISE]
    for water in args.water:
        for mass, fall, drop, velocity, deadrise in cases:
            (_, when), (exact, _) = estimate(similarity(deadrise), mass, velocity, fall, 0.06)
            flat = estimate(wagner(deadrise), mass, velocity, fall, 0.06)[1][0]
            end = 1.25 * when + 1e-3
            place = folder / f"{water}_m{mass}_h{drop}_b{deadrise}"
            summary = run(place, water, ["--sound", SOUND, "--deadrise", deadrise, "--velocity", velocity, "--mass", mass,
                                         "--fall", fall, "--end", f"{end:.4f}"], args.threads)
            time, force = curves.largest(section_force(place, WATERS[water][2]))
            table.append({"water": water, "mass": mass, "drop": drop, "velocity": velocity, "deadrise": deadrise, "force": force,
                          "time": time, "similarity": exact, "similarity_time": when, "wagner": flat,
                          "error_percent": 100 * (force / exact - 1),
                          "balance_percent": 100 * summary["energy"]["balance_error_max"],
                          "cycles": summary["cycles"], "cpu_seconds": summary["cpu_seconds"],
                          "termination": summary["termination"]})
            print(f"{water}, {mass} kg, {drop} mm, {deadrise} deg: {force:.4f} N/mm at {1e3 * time:.1f} ms, similarity "
                  f"{exact:.4f} at {1e3 * when:.1f} ms ({100 * (force / exact - 1):+.1f} %), Wagner {flat:.4f}; balance "
                  f"{table[-1]['balance_percent']:.4f} %, {summary['cpu_seconds']:.1f} CPU s", flush=True)
    for water in args.water:
        print(statistics(water, [row for row in table if row["water"] == water]))
    with open(folder / "sweep.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, table[0].keys())
        writer.writeheader()
        writer.writerows({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()}
                         for row in table)
    for mass in {row["mass"] for row in table}:
        draw(folder / f"wedge_sweep_{mass}.png", f"Wedges of {mass} kg", [row for row in table if row["mass"] == mass])


# Zhao, Faltinsen & Aarsnes (1996): 30 degrees, 0.5 m wide, 241 kg by 1 m, 6.15 m/s. Measured on 0.2 m in the middle of
# 1 m, and their solution of plane flow with separation, read off a figure to about 250 N: time [s], forces [N].
ZHAO = [(0.0025, 1400, 1400), (0.005, 2800, 2850), (0.0075, 3900, 4200), (0.01, 4500, 5500), (0.0125, 4900, 6200),
        (0.0155, 5100, 6650), (0.0175, 3700, 5000), (0.02, 2600, 3500), (0.0225, 2300, 3100)]
SCALE = 2.5  # of its lengths over those of make_deck.py, at the same speed: times and forces by length scale likewise


def zhao(folder, args):
    mass = 241 / SCALE ** 2 * DEPTH / 1000
    results = {}
    for water in args.water:
        place = folder / f"zhao_{water}"
        summary = run(place, water, ["--deadrise", 30, "--velocity", 6150, "--mass", f"{mass:.6g}", "--fall", 9810 * SCALE,
                                     "--end", 0.010, "--sound", 300e3, "--basin", 180, 120], args.threads)
        # Of a section of 0.2 m, in the times of the test. The running mean is over 0.6 ms of the test.
        rows = [(row[0] * SCALE, 200 * SCALE * 2 * abs(row[2]) / WATERS[water][2]) for row in curves.contact(place, 1)]
        results[water] = curves.smooth(rows, 6e-4)
        time, largest = curves.largest(results[water])
        print(f"Zhao's wedge, {water}: largest {largest:.0f} N at {1e3 * time:.1f} ms, plane flow 6650 N at 15.5 ms "
              f"({100 * (largest / 6650 - 1):+.1f} %); balance {100 * summary['energy']['balance_error_max']:.4f} %, "
              f"{summary['cycles']} cycles, {summary['cpu_seconds']:.1f} CPU s, {summary['termination']} end")
    print("time [ms]  plane flow  measured  " + "  ".join(f"{water:>16s}" for water in results))
    errors = {water: 0.0 for water in results}
    for time, measured, plane in ZHAO:
        line = f"{1e3 * time:9.1f} {plane:11d} {measured:9d}"
        for water, force in results.items():
            value = min(force, key=lambda row: abs(row[0] - time))[1]
            errors[water] += (value - plane) ** 2 / len(ZHAO)
            line += f"  {value:7.0f} {100 * (value / plane - 1):+6.0f} %"
        print(line)
    print("root mean square over the largest: " + ", ".join(f"{water} {100 * math.sqrt(error) / 6650:.1f} %"
                                                            for water, error in errors.items()))
    text = "plot\tZhao's wedge of 241 kg: force on 0.2 m\ttime [ms]\tforce [N]\n"
    text += "line\tZhao et al., plane flow\n" + "".join(f"{1e3 * t}\t{plane}\n" for t, _, plane in ZHAO)
    text += "line\tZhao et al., measured (three-dimensional)\tmarkers\n" + "".join(f"{1e3 * t}\t{m}\n" for t, m, _ in ZHAO)
    for water, force in results.items():
        text += f"line\t{LABELS[water]}\n" + "".join(f"{1e3 * t:.6g}\t{f:.6g}\n" for t, f in force)
    (folder / "zhao.txt").write_text(text)
    subprocess.run([top / "build/release/plash-picture", "--diagrams", folder / "zhao.txt", "-o", folder / "zhao.png"], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--water", nargs="*", choices=WATERS, default=["sph", "ale"])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--mass", type=float, nargs="*", help="only these of Shah's wedges [kg]")
    parser.add_argument("--zhao", action="store_true", help="only Zhao's wedge")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    if not args.zhao:
        shah(args.folder, args)
    if args.zhao or not args.mass:
        zhao(args.folder, args)


if __name__ == "__main__":
    main()
