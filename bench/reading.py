#!/usr/bin/env python3
"""Speed and memory of the reader on blocks of bricks from 1e4 to 5e6 nodes; writes the table of
docs/results/reading.md.

    cmake --preset release -DPLASH_BENCH=ON && cmake --build --preset release --target plash_read_bench
    python3 bench/reading.py [largest number of bricks along an edge, default 171]

Each deck is read three times by a process of its own and the fastest counts; time is processor time of one thread, so
that other work on the machine counts as little as may be. `wc -l` counts the lines of the same file in the same run.
"""
import datetime
import os
import subprocess
import sys
import tempfile

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BENCH = os.path.join(TOP, "build/release/bench/plash_read_bench")
PAGE = os.path.join(TOP, "docs/results/reading.md")
BEGIN, END = "<!-- table: written by bench/reading.py -->", "<!-- end of table -->"


def processor():
    with open("/proc/cpuinfo") as file:
        return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))


def main():
    largest = int(sys.argv[1]) if len(sys.argv) > 1 else 171
    rows = []
    for edge in (22, 46, 100, 171):
        if edge > largest:
            continue
        with tempfile.TemporaryDirectory() as folder:
            deck = os.path.join(folder, "bricks.k")
            subprocess.run([sys.executable, os.path.join(TOP, "bench/make_brick_deck.py"), str(edge), deck], check=True)
            row = subprocess.run([BENCH, deck, "3"], check=True, capture_output=True, text=True).stdout
        print(row, end="", flush=True)
        rows.append(row)
    table = (f"{BEGIN}\n{datetime.date.today()}, {processor()}, one thread, warm file cache.\n\n"
             "| nodes | solids | MB | seconds | MB/s | ns per node | times `wc -l` | peak memory, MB | times the mesh "
             "arrays |\n|---|---|---|---|---|---|---|---|---|\n" + "".join(rows) + END)
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page[:page.index(BEGIN)] + table + page[page.index(END) + len(END):])


if __name__ == "__main__":
    main()
