"""Reads the d3plot and binout of a run with lasso-python, a reader that is not Plash's, and compares what it finds
with the ASCII files of the same run.

    python3 bench/check_readers.py RESULTS LASSO

RESULTS: directory of a run whose deck asks for d3plot, for nodout, glstat, matsum and elout, and for them in binout as
well (BINARY = 3). LASSO: a checkout of github.com/open-lasso-python/lasso-python (its folder src). Needs numpy,
h5py, pandas, psutil and rich. Prints, for each quantity, how many numbers were compared and the largest difference
over the largest number; nothing of lasso-python is part of Plash.
"""

import logging
import re
import sys
import types

import numpy as np


def load_lasso(source):
    """Its drawing module wants files that no reader needs."""
    sys.path.insert(0, source)
    plotting = types.ModuleType("lasso.plotting")
    plotting.plot_shell_mesh = None
    sys.modules["lasso.plotting"] = plotting
    logging.disable(logging.CRITICAL)
    from lasso.dyna.binout import Binout
    from lasso.dyna.d3plot import D3plot

    return Binout, D3plot


NUMBER = r"[-+]?\d+\.\d+(?:E?[-+]\d+)?"


def number(text):
    """Fortran leaves the E out before three figures."""
    return float(re.sub(r"(?<=\d)([-+]\d+)$", r"E\1", text) if "E" not in text.upper() else text)


def blocks(path, heading):
    """[(time, lines)] of an ASCII file; the heading's group is the time."""
    found = []
    for line in open(path, encoding="latin-1"):
        match = re.search(heading, line)
        if match:
            found.append((number(match.group(1)), []))
        elif found:
            found[-1][1].append(line.rstrip("\n"))
    return found


def read_nodout(path):
    """{time: {node: 12 numbers}}: displacements, velocities, accelerations, coordinates."""
    result = {}
    for time, lines in blocks(path, rf"at time\s+({NUMBER})"):
        rows = {}
        for line in lines:
            match = re.match(r"\s*(\d+)\s*-?\s*((?:\s*" + NUMBER + r"){12})\s*$", line)
            if match:
                rows[int(match.group(1))] = [number(x) for x in re.findall(NUMBER, match.group(2))]
        if rows and time not in result:
            result[time] = rows
    return result


def read_glstat(path):
    names = {"kinetic energy": "kinetic", "internal energy": "internal", "total energy": "total"}
    result, time = {}, None
    for line in open(path, encoding="latin-1"):
        match = re.match(rf"\s(time|kinetic energy|internal energy|total energy)\.+\s*({NUMBER})", line)
        if not match:
            continue
        if match.group(1) == "time":
            time = number(match.group(2))
            result[time] = {}
        else:
            result[time][names[match.group(1)]] = number(match.group(2))
    return result


def read_matsum(path):
    result = {}
    for time, lines in blocks(path, rf"time =\s*({NUMBER})"):
        result[time] = {}
        for line in lines:
            match = re.search(rf"mat\.#=\s*(\d+).*inten=\s*({NUMBER}).*kinen=\s*({NUMBER})", line)
            if match:
                result[time][int(match.group(1))] = (number(match.group(2)), number(match.group(3)))
    return result


class Table:
    def __init__(self):
        self.rows = []

    def add(self, name, ours, theirs):
        ours, theirs = np.asarray(ours, float).ravel(), np.asarray(theirs, float).ravel()
        if ours.size != theirs.size:
            self.rows.append((name, ours.size, theirs.size, float("inf")))
            return
        size = np.max(np.abs(ours)) if ours.size else 0
        error = np.max(np.abs(ours - theirs)) / size if size > 0 else 0
        self.rows.append((name, ours.size, theirs.size, error))

    def show(self):
        print("| quantity | numbers | largest difference / largest number |\n|---|---|---|")
        for name, ours, theirs, error in self.rows:
            count = str(ours) if ours == theirs else f"{ours} against {theirs}"
            print(f"| {name} | {count} | {error:.1e} |")


def nearest(times, time):
    index = int(np.argmin(np.abs(np.asarray(times) - time)))
    return index if abs(times[index] - time) <= 2e-5 * max(abs(time), 1e-30) else None


def compare_d3plot(plot, directory, table):
    arrays = plot.arrays
    times = arrays["timesteps"]
    ids = {int(i): k for k, i in enumerate(arrays["node_ids"])}
    ours, theirs = {k: [] for k in "xva"}, {k: [] for k in "xva"}
    for time, rows in read_nodout(f"{directory}/nodout").items():
        state = nearest(times, time)
        if state is None:
            continue
        for node, values in rows.items():
            for key, name, part in (("x", "node_displacement", values[9:12]), ("v", "node_velocity", values[3:6]),
                                    ("a", "node_acceleration", values[6:9])):
                ours[key].append(part)
                theirs[key].append(arrays[name][state, ids[node]])
    table.add("d3plot: places of nodout's nodes", ours["x"], theirs["x"])
    table.add("d3plot: velocities", ours["v"], theirs["v"])
    table.add("d3plot: accelerations", ours["a"], theirs["a"])
    for name, key in (("kinetic", "global_kinetic_energy"), ("internal", "global_internal_energy"),
                      ("total", "global_total_energy")):
        pairs = [(row[name], arrays[key][nearest(times, time)])
                 for time, row in read_glstat(f"{directory}/glstat").items() if nearest(times, time) is not None]
        table.add(f"d3plot: {name} energy of glstat", [a for a, _ in pairs], [b for _, b in pairs])
    parts = {int(i): k for k, i in enumerate(arrays["part_ids"])}
    internal, kinetic = ([], []), ([], [])
    for time, rows in read_matsum(f"{directory}/matsum").items():
        state = nearest(times, time)
        for part, values in rows.items() if state is not None else ():
            internal[0].append(values[0])
            internal[1].append(arrays["part_internal_energy"][state, parts[part]])
            kinetic[0].append(values[1])
            kinetic[1].append(arrays["part_kinetic_energy"][state, parts[part]])
    table.add("d3plot: internal energies of matsum's parts", *internal)
    table.add("d3plot: kinetic energies of matsum's parts", *kinetic)


def compare_binout(binout, directory, table):
    ids = [int(i) for i in binout.read("nodout", "ids")]
    times = binout.read("nodout", "time")
    columns = [f"{axis}_{what}" for what in ("displacement", "velocity", "acceleration", "coordinate")
               for axis in "xyz"]
    data = [binout.read("nodout", name) for name in columns]
    ours, theirs = [], []
    for time, rows in read_nodout(f"{directory}/nodout").items():
        state = nearest(times, time)
        for node, values in rows.items() if state is not None else ():
            ours.append(values)
            theirs.append([column[state, ids.index(node)] for column in data])
    for group, what in enumerate(("displacements", "velocities", "accelerations", "coordinates")):
        part = slice(3 * group, 3 * group + 3)
        table.add(f"binout: {what} of nodout", [row[part] for row in ours], [row[part] for row in theirs])
    times = binout.read("glstat", "time")
    for name in ("kinetic", "internal", "total"):
        column = binout.read("glstat", f"{name}_energy")
        pairs = [(row[name], column[nearest(times, time)])
                 for time, row in read_glstat(f"{directory}/glstat").items() if nearest(times, time) is not None]
        table.add(f"binout: {name} energy of glstat", [a for a, _ in pairs], [b for _, b in pairs])
    times = binout.read("matsum", "time")
    parts = [int(i) for i in binout.read("matsum", "ids")]
    column = binout.read("matsum", "internal_energy")
    pairs = [(values[0], column[nearest(times, time), parts.index(part)])
             for time, rows in read_matsum(f"{directory}/matsum").items() if nearest(times, time) is not None
             for part, values in rows.items()]
    table.add("binout: internal energies of matsum's parts", [a for a, _ in pairs], [b for _, b in pairs])


def main():
    directory, source = sys.argv[1:3]
    Binout, D3plot = load_lasso(source)
    table = Table()
    compare_d3plot(D3plot(f"{directory}/d3plot"), directory, table)
    binout = Binout(f"{directory}/binout0000")
    print("folders of binout:", ", ".join(sorted(binout.read())))
    compare_binout(binout, directory, table)
    table.show()


if __name__ == "__main__":
    main()
