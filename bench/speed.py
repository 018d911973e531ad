#!/usr/bin/env python3
"""Speed of whole runs: microseconds per element-cycle on 1 and 2 threads, written to docs/results/speed.md.

    python3 bench/speed.py [repetitions, default 3]

Each case is a deck that a script beside this one writes; the time is that of the explicit loop with its
recorders (summary.json, wall_seconds). The best of the repetitions counts, because other work on the machine
only ever makes a run slower; the spread is shown.
"""
import datetime
import json
import os
import platform
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# name, command that writes the deck, elements it has, peer's microseconds per element-cycle on one thread
CASES = [
    ("shell ELFORM 2, MAT_024, 3 points", ["make_shell_deck.py", "--points", "3"], 0.34),
    ("shell ELFORM 2, MAT_024, 5 points", ["make_shell_deck.py", "--points", "5"], 0.32),
    ("shell ELFORM 16, MAT_024, 5 points", ["make_shell_deck.py", "--points", "5", "--formulation", "16",
                                            "--time", "2e-5"], 2.05),
    ("hex ELFORM 2, MAT_003", ["make_hex_deck.py", "--formulation", "2", "--time", "3e-6"], None),
    ("hex ELFORM -1, MAT_003", ["make_hex_deck.py", "--formulation", "-1", "--time", "3e-6"], None),
    ("tetrahedron ELFORM 10, MAT_003", ["make_hex_deck.py", "--formulation", "10", "--cells", "24", "24", "32",
                                        "--time", "3e-6"], None),
    ("tetrahedron ELFORM 13, MAT_003", ["make_hex_deck.py", "--formulation", "13", "--cells", "24", "24", "32",
                                        "--time", "3e-6"], None),
    ("ten-node tetrahedron ELFORM 16, MAT_003", ["make_hex_deck.py", "--formulation", "16", "--cells", "12", "12",
                                                 "16", "--time", "3e-6"], None),
    ("ten-node tetrahedron ELFORM 17, MAT_003", ["make_hex_deck.py", "--formulation", "17", "--cells", "12", "12",
                                                 "16", "--time", "3e-6"], None),
    ("thick shell ELFORM 1, MAT_003, 3 points", ["make_hex_deck.py", "--thick", "3", "--time", "3e-6"], None),
    ("thick shell ELFORM 2, MAT_003, 3 points", ["make_hex_deck.py", "--thick", "3", "--formulation", "2",
                                                 "--time", "2e-6"], None),
    ("thick shell ELFORM 5, MAT_003, 3 points", ["make_hex_deck.py", "--thick", "3", "--formulation", "5",
                                                 "--time", "3e-6"], None),
    ("beam ELFORM 1, MAT_024, 4 points", ["make_beam_deck.py", "--formulation", "1"], None),
    ("beam ELFORM 2, MAT_001", ["make_beam_deck.py", "--formulation", "2"], None),
    ("hex ELFORM 1, MAT_003, hourglass 4", ["make_hex_deck.py", "--hourglass", "4"], 0.32),
    ("hex ELFORM 1, MAT_003, hourglass 6", ["make_hex_deck.py", "--hourglass", "6"], 0.32),
]


def run(deck, threads, folder):
    output = os.path.join(folder, "results")
    subprocess.run([os.path.join(TOP, "plash"), "run", deck, "-j", str(threads), "-o", output], check=True,
                   stdout=subprocess.DEVNULL)
    with open(os.path.join(output, "summary.json")) as file:
        return json.load(file)


def elements_of(deck):
    check = subprocess.run([os.path.join(TOP, "plash"), "check", deck, "--json"], capture_output=True, text=True)
    return sum(json.loads(check.stdout)["elements"].values())


def processor():
    with open("/proc/cpuinfo") as file:
        for line in file:
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return platform.processor()


def main():
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    rows = []
    for name, writer, peer in CASES:
        with tempfile.TemporaryDirectory() as folder:
            deck = os.path.join(folder, "deck.k")
            with open(deck, "w") as file:
                subprocess.run([sys.executable, os.path.join(TOP, "bench", writer[0]), *writer[1:]], check=True,
                               stdout=file)
            elements = elements_of(deck)
            row = {"name": name, "elements": elements, "peer": peer}
            for threads in (1, 2):
                runs = [run(deck, threads, folder) for _ in range(repetitions)]
                times = [1e6 * r["wall_seconds"] / (elements * (r["cycles"] + 1)) for r in runs]
                row[threads] = (min(times), max(times))
                row["cycles"] = runs[0]["cycles"]
                row["balance"] = runs[0]["energy"]["balance_error_max"]
                row["bytes"] = runs[0]["peak_memory_bytes"] / elements
            rows.append(row)
            print(row)
    write(rows, repetitions)


def write(rows, repetitions):
    page = os.path.join(TOP, "docs", "results", "speed.md")
    with open(page) as file:
        others = file.read().partition("\n## ")  # what other commands have measured stays
    with open(page, "w") as file:
        print("# Speed of whole runs\n", file=file)
        print(f"`python3 bench/speed.py {repetitions}` on {datetime.date.today()}, {processor()}, "
              f"{os.cpu_count()} cores; best (worst) of {repetitions} runs each, double precision, the whole loop "
              "with output.\n", file=file)
        print("| case | elements | cycles | us per element-cycle, 1 thread | 2 threads (wall) | gain of 2 threads | "
              "open peer, 1 thread | balance error | bytes per element |", file=file)
        print("|---|---|---|---|---|---|---|---|---|", file=file)
        for row in rows:
            one, two = row[1], row[2]
            peer = "-" if row["peer"] is None else f"{row['peer']:.2f}"
            print(f"| {row['name']} | {row['elements']} | {row['cycles']} | **{one[0]:.3f}** ({one[1]:.3f}) | "
                  f"{two[0]:.3f} ({two[1]:.3f}) | {one[0] / two[0]:.2f} | {peer} | "
                  f"{100 * row['balance']:.2f} % | {row['bytes']:.0f} |", file=file)
        print("\nThe peer is OpenRadioss 2026 with native vectors, measured on the same kind of machine: 20,480 to "
              "102,400\nquads with MAT_024 and 64,512 one-point hexes with MAT_003.", file=file)
        print(others[1] + others[2], end="", file=file)


main()
