#!/usr/bin/env python3
"""All cases of the five papers in their coarse form: how wrong, and how costly.

    papers.py FOLDER [--threads 2] [--only wedge fuselage ditching bird barrier cavity]

Runs what FOLDER does not hold yet (some ten minutes of one core in all), judges each run by the script of its example, and ends with a table
of costs. docs/results/papers.md holds the figures beside those of the papers.
"""
import argparse
import pathlib
import subprocess
import sys
import time

top = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(top / "examples"))
import curves  # noqa: E402

PLASH, EXAMPLES = top / "build/release/plash", top / "examples"
# Name of a run: deck in examples/ and further arguments. By case, with the judge that gets its runs' folders.
RUNS = {
    "fuselage": ({"fuselage_rigid": ["fuselage_section/fuselage.k"],
                  "fuselage_soil": ["fuselage_section/fuselage.k", "--set", "GROUND=soil"],
                  "fuselage_water": ["fuselage_section/fuselage.k", "--set", "GROUND=water"],
                  "fuselage_mesh": ["fuselage_section/fuselage.k", "--set", "GROUND=water", "--fluid", "ale"]},
                 ["fuselage_section/judge.py"]),
    "ditching": ({"ditching": ["guided_ditching/ditching.k"],
                  "ditching_trolley": ["guided_ditching/ditching.k", "--set", "GUIDE=trolley"]}, None),
    "bird": ({"plate": ["bird_strike/plate.k"], "plate_constraint": ["bird_strike/plate.k", "--set", "CONTACT=constraint"]},
             ["bird_strike/judge.py", "plate"]),
    "bird_tapered": ({"tapered_0": ["bird_strike/tapered_0.k"], "tapered_30": ["bird_strike/tapered_30.k"]},
                     ["bird_strike/judge.py", "tapered"]),
    "bird_beam": ({"beam": ["bird_strike/beam.k"], "beam_solid": ["bird_strike/beam_solid.k"]}, ["bird_strike/judge.py", "beam"]),
    "barrier": ({f"barrier_FILL={fill}": ["water_barrier/barrier.k", "--set", f"FILL={fill}"] for fill in (0, 30, 50, 80, 100)}
                | {"barrier_fast_FILL=50": ["water_barrier/barrier.k", "--set", "SPEED=10e3", "--set", "END=0.005"]},
                ["water_barrier/judge.py", "barrier"]),
    "barrier_drop": ({"tank_drop": ["water_barrier/tank_drop.k"]}, ["water_barrier/judge.py", "drop"]),
    "cavity_sph": ({"cavity_sph": ["lid_driven_cavity/sph.k"]}, ["lid_driven_cavity/judge.py", str(EXAMPLES / "lid_driven_cavity/sph.k")]),
    "cavity_ale": ({"cavity_ale": ["lid_driven_cavity/ale.k"]}, ["lid_driven_cavity/judge.py", str(EXAMPLES / "lid_driven_cavity/ale.k")]),
}


def execute(name, words, folder, threads):
    place = folder / name
    if (place / "summary.json").exists():
        return place
    started = time.time()
    deck = EXAMPLES / words[0]
    subprocess.run([PLASH, "run", deck, *words[1:], "-o", place, "-j", str(threads)], check=False, stdout=subprocess.DEVNULL)
    print(f"{name}: {curves.cost(place)}, {time.time() - started:.0f} s", flush=True)
    return place


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--only", nargs="*", default=["wedge", "fuselage", "ditching", "bird", "barrier", "cavity"])
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    places = []
    for case, (runs, judge) in RUNS.items():
        if case.split("_")[0] not in args.only:
            continue
        done = [execute(name, words, args.folder, args.threads) for name, words in runs.items()]
        places += done
        if judge:
            subprocess.run([sys.executable, EXAMPLES / judge[0], *judge[1:], *done], check=True)
    if "ditching" in args.only:
        driven, trolley = (args.folder / name for name in RUNS["ditching"][0])
        subprocess.run([PLASH, "compare", trolley, "-r", driven, "-s", "rcforc/1/slave_z", "-o", args.folder / "ditching_compare"], check=True)
    if "wedge" in args.only:
        for script in ("wedge_cost.py", "wedge_sweep.py"):
            subprocess.run([sys.executable, top / "bench" / script, args.folder / script[:-3], "--threads", str(args.threads)], check=True)
    print("\n" + "\n".join(f"{place.name:24s}{curves.cost(place)}" for place in places))


main()
