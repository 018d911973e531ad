#!/usr/bin/env python3
"""Lid-driven cavity on the Eulerian mesh against reference columns of the centreline velocities.

Usage: cavity.py RE CELLS [TURNS] [THREADS] [FOLDER]
FOLDER holds u_vertical_centreline.csv and v_horizontal_centreline.csv (default: ../shared/reference/cavity beside
the tree; columns y or x, then pairs ghia/here for Re 100, 400, 1000, 3200). Lid speed 1, side 1, density 1, speed of
sound 10; TURNS is the time in sides over lid speed (default 30).
"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

top = pathlib.Path(__file__).resolve().parent.parent
reynolds, cells = int(sys.argv[1]), int(sys.argv[2])
turns = float(sys.argv[3]) if len(sys.argv) > 3 else 30.0
threads = sys.argv[4] if len(sys.argv) > 4 else "1"
folder = pathlib.Path(sys.argv[5]) if len(sys.argv) > 5 else top.parent / "shared/reference/cavity"


def node(i, k):
    return 1 + i + (cells + 1) * 2 * k


middle = cells // 2
wanted = [node(middle, k) for k in range(cells + 1)] + [node(i, middle) for i in range(cells + 1)]
text = "*KEYWORD\n*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n"
for axis, (count, size) in enumerate(((cells, 1), (1, 1 / cells), (cells, 1))):
    text += f"*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{axis + 1}\n1,0\n{count + 1},{size}\n"
text += f"""*ALE_MULTI-MATERIAL_GROUP
1,1
*PART
fluid
1,1,1,1
*SECTION_SOLID
1,11
*MAT_NULL
1,1,-1e9,{1 / reynolds}
*EOS_LINEAR_POLYNOMIAL
1,0,100

*CONTROL_BULK_VISCOSITY
1e-9,1e-9
*CONTROL_ALE
-1,1,2,-1
,,,,,2
*DEFINE_BOX
1,-1,0.0001,-1,1,-1,2
*DEFINE_BOX
2,0.9999,2,-1,1,-1,2
*DEFINE_BOX
3,-1,2,-1,1,-1,0.0001
*DEFINE_BOX
4,-1,2,-1,1,0.9999,2
*SET_NODE_GENERAL
1
BOX,1,2,3
*SET_NODE_GENERAL
2
BOX,4
*BOUNDARY_SPC_SET
1,0,1,1,1
*BOUNDARY_PRESCRIBED_MOTION_SET
2,1,0,1
*DEFINE_CURVE
1
0,1
1e9,1
*CONTROL_TERMINATION
{turns}
*CONTROL_TIMESTEP
0,0.67
*DATABASE_NODOUT
{turns}
*SET_NODE_LIST
9
"""
for start in range(0, len(wanted), 8):
    text += ",".join(map(str, wanted[start:start + 8])) + "\n"
text += "*DATABASE_HISTORY_NODE_SET\n9\n*END\n"

with tempfile.TemporaryDirectory() as place:
    deck = pathlib.Path(place) / "cavity.k"
    deck.write_text(text)
    run = subprocess.run([top / "build/release/plash", "run", deck, "-o", place + "/out", "-j", threads],
                         stdout=subprocess.PIPE, text=True, check=True)
    last = (pathlib.Path(place) / "out/nodout").read_text().split("x-disp")[-1]
velocity = {}
for line in last.splitlines():
    numbers = re.findall(r"[-+]?\d+\.\d+E[-+]\d+", line)
    words = line.split()
    if len(numbers) >= 6 and words and words[0].isdigit() and int(words[0]) not in velocity:
        velocity[int(words[0])] = [float(number) for number in numbers]


def at(profile, place):
    """Linear between nodes."""
    cell = min(int(place * cells), cells - 1)
    part = place * cells - cell
    return (1 - part) * profile[cell] + part * profile[cell + 1]


worst = 0.0
for name, line, component in (("u_vertical_centreline.csv", [node(middle, k) for k in range(cells + 1)], 3),
                              ("v_horizontal_centreline.csv", [node(i, middle) for i in range(cells + 1)], 5)):
    profile = [velocity[number][component] for number in line]
    rows = list(csv.reader(row for row in (folder / name).read_text().splitlines() if not row.startswith("#")))
    column = next(i for i, head in enumerate(rows[0]) if head.endswith(f"_here_Re{reynolds}"))
    largest = 0.0
    for row in rows[1:]:
        place, reference = float(row[0]), float(row[column])
        largest = max(largest, abs(at(profile, place) - reference))
    print(f"Re {reynolds}, {cells} x {cells}, t = {turns:g}: {name[0]} along the {name.split('_')[1]} centreline within "
          f"{100 * largest:.2f} % of the lid speed")
    worst = max(worst, largest)
print(run.stdout.splitlines()[-1])
