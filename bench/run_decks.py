#!/usr/bin/env python3
"""Runs every deck in a folder of decks from elsewhere that Plash takes, written to docs/results/deck_runs.md.

    python3 bench/run_decks.py [folder, default ../shared/decks] [seconds a deck may take, default 120]

A deck is run when `plash check` says that it will run and it has elements. One thread; a run that is not done within
its seconds is stopped by the file D3KIL, so that its energies up to there still count.
"""
import datetime
import json
import os
import re
import subprocess
import sys
import tempfile
import time

TOP = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PLASH = os.environ.get("PLASH", os.path.join(TOP, "build/release/plash"))
PAGE = os.path.join(TOP, "docs/results/deck_runs.md")


def decks_of(folder):
    with open(os.path.join(folder, "INDEX.md"), encoding="utf-8") as file:
        for line in file:
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if len(cells) >= 8 and re.match(r"(targets|corpus)/", cells[0]):
                yield cells[0]


def elements_to_run(path):
    """How many elements a deck has that will run; 0 when it will not."""
    done = subprocess.run([PLASH, "check", path], capture_output=True, text=True, errors="replace")
    if not re.search(r"^The deck will run ", done.stdout, re.M):
        return 0
    report = json.loads(subprocess.run([PLASH, "check", "--json", path], capture_output=True, text=True).stdout)
    return sum(report["elements"].values())


def run(path, seconds, folder):
    """The summary of a run, or the last line that it wrote."""
    results = os.path.join(folder, "results")
    process = subprocess.Popen([PLASH, "run", path, "-j", "1", "-o", results], stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace")
    end = time.time() + seconds
    while process.poll() is None and time.time() < end:
        time.sleep(0.1)
    if process.poll() is None:
        with open(os.path.join(results, "D3KIL"), "w", encoding="utf-8") as file:
            file.write("sw1\n")
    lines = process.communicate(timeout=600)[0].strip().splitlines()
    summary = os.path.join(results, "summary.json")
    if os.path.exists(summary):
        with open(summary, encoding="utf-8") as file:
            return json.load(file)
    return lines[-1] if lines else f"ended with {process.returncode}"


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(TOP, "../shared/decks")
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 120
    rows = []
    for deck in decks_of(folder):
        path = os.path.join(folder, deck)
        elements = elements_to_run(path)
        if elements == 0:
            continue
        with tempfile.TemporaryDirectory() as place:
            result = run(path, seconds, place)
        if isinstance(result, str):
            row = f"| {deck} | {elements} | | | | | {result} |"
        else:
            ending = (result["message"] or result["termination"]).split("; goes on with")[0]  # in a folder that goes
            row = (f"| {deck} | {elements} | {result['cycles']} | {result['time']:.4g} of {result['end_time']:.4g} | "
                   f"{result['wall_seconds']:.1f} | {100 * result['energy']['balance_error_max']:.3f} % | {ending} |")
        print(row, flush=True)
        rows.append(row)
    with open(PAGE, "w", encoding="utf-8") as page:
        page.write("# Runs of real decks\n\n"
                   f"Every deck of a folder of foreign decks that `plash check` lets run, untouched, one thread, at most "
                   f"{seconds:g} seconds each; written by\n`python3 bench/run_decks.py` on {datetime.date.today()}.\n\n"
                   "| deck | elements | cycles | time | wall seconds | energy balance error | how it ended |\n"
                   "|---|---|---|---|---|---|---|\n" + "\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
