#!/usr/bin/env python3
"""Error against cost of the wedge of 30 degrees by particles, an Eulerian mesh, and solids that go with the water.

    wedge_cost.py FOLDER [--sph 3 2 1.5 1] [--ale 4 3 2 1.5] [--lagrange 3]

Runs what FOLDER does not hold yet (sizes of particles and cells in mm), judges each section force as it is written, without a
mean, against the estimate of examples/wedge_drop/compare.py, and says what the mesh would cost at the error of each run by
particles (straight lines between its runs in the logarithms). Writes FOLDER/wedge_cost.png.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

top = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(top / "bench"))
from wedge_sweep import LABELS, SOUND, curves  # noqa: E402

PLASH = top / "build/release/plash"
WEDGE = top / "examples/wedge_drop"
# Of each kind of water: what make_deck.py and the run take, and the depth [mm] that the model's forces stand for.
DECKS = {"sph": (lambda size: ["--plane", "--spacing", size, "--damping", 50], [], 1.0),
         "ale": (lambda size: ["--cell", size], ["--fluid", "ale"], 3.0),
         "lagrange": (lambda size: ["--spacing", size], ["--fluid", "lagrange"], 3.0)}


def judged(folder, water, size, threads):
    """CPU seconds, errors and balance of one run."""
    options, run_options, depth = DECKS[water]
    place = folder / f"{water}_{size:g}"
    if not (place / "summary.json").exists():
        place.mkdir(parents=True, exist_ok=True)
        deck = subprocess.run([sys.executable, WEDGE / "make_deck.py", *map(str, options(size)), "--sound", str(SOUND)],
                              check=True, capture_output=True, text=True).stdout
        (place / "wedge.k").write_text(deck)
        subprocess.run([PLASH, "run", place / "wedge.k", "-o", place, "-j", str(threads), *run_options], check=False,
                       stdout=subprocess.DEVNULL)
    subprocess.run([sys.executable, WEDGE / "compare.py", place, "--slice", str(depth), "--csv", place / "estimate.csv"],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run([PLASH, "compare", place, "-s", "rcforc/1/master_y", "-r", f"{place}/estimate.csv:force", "-o", place / "compare"],
                   check=True, stdout=subprocess.DEVNULL)
    errors = json.loads((place / "compare/compare.json").read_text())[0]["runs"][-1]["errors"]
    summary = curves.summary(place)
    return {"water": water, "size": size, "cpu": summary["cpu_seconds"], "cycles": summary["cycles"],
            "balance": 100 * summary["energy"]["balance_error_max"], "memory": 1e-6 * summary["peak_memory_bytes"],
            "error": 100 * errors["sprague_geers"]["comprehensive"], "impulse": 100 * errors["impulse"],
            "rms": 100 * errors["rms"], "end": summary["termination"]}


def cost_at(error, rows):
    """CPU seconds that a method needs for an error, between its runs; None outside."""
    rows = sorted(rows, key=lambda row: row["error"])
    for low, high in zip(rows, rows[1:]):
        if low["error"] <= error <= high["error"]:
            share = math.log(error / low["error"]) / math.log(high["error"] / low["error"])
            return math.exp((1 - share) * math.log(low["cpu"]) + share * math.log(high["cpu"]))
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--sph", type=float, nargs="*", default=[3, 2, 1.5, 1])
    parser.add_argument("--ale", type=float, nargs="*", default=[4, 3, 2, 1.5])
    parser.add_argument("--lagrange", type=float, nargs="*", default=[3])
    parser.add_argument("--threads", type=int, default=1)
    args = parser.parse_args()
    rows = [judged(args.folder, water, size, args.threads) for water in DECKS for size in getattr(args, water)]
    print("water     size [mm]  CPU [s]  cycles  error [%]  impulse [%]  rms [%]  memory [MB]  balance [%]")
    for row in rows:
        print(f"{row['water']:10s}{row['size']:9g}{row['cpu']:9.2f}{row['cycles']:8d}{row['error']:11.2f}{row['impulse']:+13.1f}"
              f"{row['rms']:9.1f}{row['memory']:13.0f}{row['balance']:13.4f}" + ("" if row["end"] == "normal" else f"  {row['end']}"))
    mesh = [row for row in rows if row["water"] == "ale"]
    for row in rows:
        wanted = cost_at(row["error"], mesh) if row["water"] == "sph" else None
        if wanted:
            print(f"particles of {row['size']:g} mm cost {row['cpu'] / wanted:.2f} times the mesh of equal error")
    text = "plot\tWedge of 30 degrees\tCPU seconds\tcomprehensive error of the force [%]\n"
    for water in DECKS:
        points = "".join(f"{row['cpu']:.4g}\t{row['error']:.4g}\n" for row in rows if row["water"] == water)
        if not points:
            continue
        text += f"line\t{LABELS[water]}\tmarkers\n{points}"
        if points.count("\n") > 1:
            text += f"line\t{LABELS[water]}, between\n{points}"
    (args.folder / "wedge_cost.txt").write_text(text)
    subprocess.run([PLASH.parent / "plash-picture", "--diagrams", args.folder / "wedge_cost.txt", "-o", args.folder / "wedge_cost.png"],
                   check=True)


main()
