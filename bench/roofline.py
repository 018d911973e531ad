#!/usr/bin/env python3
"""How much of what one core allows the element loops reach, written to docs/results/roofline.md.

    cmake -DPLASH_BENCH=ON build/release && ninja -C build/release plash plash_roofline
    python3 bench/roofline.py [repetitions, default 3]

plash_roofline (bench/roofline.cpp) counts operations and bytes of an element-cycle and measures the core's rates.
The time of an element-cycle is the processor time that a run takes more than one of a quarter of its length: reading
and setting up drop out, and other work on the machine counts little.
"""
import datetime
import json
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.path.join(TOP, "build", "release", "plash")

# Name of the kernel in plash_roofline, deck of speed.py, its end time.
CASES = [
    ("shell ELFORM 2, MAT_024, 3 points", ["make_shell_deck.py", "--points", "3"]),
    ("shell ELFORM 2, MAT_024, 5 points", ["make_shell_deck.py", "--points", "5"]),
    ("shell ELFORM 16, MAT_024, 5 points", ["make_shell_deck.py", "--points", "5", "--formulation", "16", "--time",
                                            "2e-5"]),
    ("hex ELFORM 1, MAT_003, hourglass 4", ["make_hex_deck.py", "--hourglass", "4"]),
    ("hex ELFORM 1, MAT_003, hourglass 6", ["make_hex_deck.py", "--hourglass", "6"]),
]


def run(deck, folder, until=None):
    """Summary of a run on one thread."""
    output = os.path.join(folder, "results")
    command = [PROGRAM, "run", deck, "-j", "1", "-o", output] + (["--until", str(until)] if until else [])
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(output, "summary.json")) as file:
        return json.load(file)


def microseconds(writer, repetitions):
    """Processor time of an element-cycle, and the number of elements."""
    with tempfile.TemporaryDirectory() as folder:
        deck = os.path.join(folder, "deck.k")
        with open(deck, "w") as file:
            subprocess.run([sys.executable, os.path.join(TOP, "bench", writer[0]), *writer[1:]], check=True, stdout=file)
        check = subprocess.run([PROGRAM, "check", deck, "--json"], capture_output=True, text=True)
        elements = sum(json.loads(check.stdout)["elements"].values())
        whole = [run(deck, folder) for _ in range(repetitions)]
        part = [run(deck, folder, whole[0]["time"] / 4) for _ in range(repetitions)]
        seconds = min(r["cpu_seconds"] for r in whole) - min(r["cpu_seconds"] for r in part)
        return 1e6 * seconds / (whole[0]["cycles"] - part[0]["cycles"]) / elements, elements


def main():
    load = f"load average of the machine at the start: {os.getloadavg()[0]:.0f} on {os.cpu_count()} cores"
    repetitions = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    limits = json.loads(subprocess.run([os.path.join(TOP, "build", "release", "bench", "plash_roofline"), "--json"],
                                       check=True, capture_output=True, text=True).stdout)
    operations, memory = limits["operations_per_second"], limits["bytes_per_second"]
    kernels = {kernel["name"]: kernel for kernel in limits["kernels"]}
    lines = []
    for name, writer in CASES:
        time, elements = microseconds(writer, repetitions)
        kernel = kernels[name]
        count = kernel["elastic"] + kernel["elastic_slow"]
        by_count, by_bytes = 1e6 * count / operations, 1e6 * kernel["bytes"] / memory
        lines.append(f"| {name} | {elements} | {kernel['elastic']} + {kernel['elastic_slow']} | {kernel['yielding']} + "
                     f"{kernel['yielding_slow']} | {kernel['bytes']} | {count / kernel['bytes']:.1f} | {by_count:.3f} | "
                     f"{by_bytes:.3f} | **{time:.3f}** | {100 * max(by_count, by_bytes) / time:.0f} % |")
        print(lines[-1], flush=True)
    with open(os.path.join(TOP, "docs", "results", "roofline.md"), "w") as page:
        print(f"""# What one core allows

`python3 bench/roofline.py {repetitions}` on {datetime.date.today()}. One core of this machine makes {1e-9 * operations:.1f} G operations (fused
multiplications and additions, two each, eight lanes) and moves {1e-9 * memory:.0f} GB a second (a = b + s c on arrays that no cache holds).

Operations are counted by running the kernels with a number that counts what is done with it: sums and products + quotients and
roots, for an element whose points stay elastic and for one whose points all yield. Bytes are those that a cycle has to move where no
cache holds the mesh: the elements' records both ways, their constants and corner numbers, the nodes of the patches and those of the
loop. Bounds and times are microseconds of an element-cycle; times are processor time of the whole loop on one thread, output included
({load}).
The share is the larger bound, with elastic operations, over the time. Copying nodes to patches and back takes a fifth of a run of one-point
hexahedra (perf); the bounds count quotients and roots as one operation each, and every operation as half of a fused pair.

| case | elements | operations, elastic | yielding | bytes | operations a byte | bound by operations | bound by bytes | time | share |
|---|---|---|---|---|---|---|---|---|---|""", file=page)
        print("\n".join(lines), file=page)


main()
