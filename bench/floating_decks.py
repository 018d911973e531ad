"""What the floating boxes of the benches share: water below void as deck text, and the run of a deck."""
import pathlib
import subprocess
import tempfile

plash = pathlib.Path(__file__).resolve().parent.parent / "build" / "release" / "plash"


def water_and_void(bulk_modulus):
    """Groups 1 and 2 of *ALE_MULTI-MATERIAL_GROUP: water of parts 1 with this stiffness, and empty space."""
    return f"""*ALE_MULTI-MATERIAL_GROUP
1,1
2,1
*PART
water
1,1,1,1
*PART
empty
2,1,2
*SECTION_SOLID
1,11
*MAT_NULL
1,1000,-1e4
*EOS_LINEAR_POLYNOMIAL
1,0,{bulk_modulus:g}

*MAT_VACUUM
2,0
"""


def rigid_box(density, coupling):
    """Part 20, free along z, on shells of 10 mm, and its coupling."""
    return f"""*PART
box
20,20,20
*SECTION_SHELL
20,2
0.01,0.01,0.01,0.01
*MAT_RIGID
20,{density:.9g},2e11,0.3
1,4,7

*CONSTRAINED_LAGRANGE_IN_SOLID
20,10,1,1,{coupling}
"""


def under_gravity(end, interval):
    """Gravity along z, slip walls, the end of the run, and node 100000 in nodout."""
    return f"""*LOAD_BODY_Z
1,9.81
*DEFINE_CURVE
1
0,1
1e9,1
*CONTROL_ALE
-1,1,2,-1
,,,,,2
*CONTROL_TERMINATION
{end}
*CONTROL_TIMESTEP
0,0.67
*DATABASE_HISTORY_NODE
100000
*DATABASE_NODOUT
{interval}
"""


def way_along_z(text):
    """Runs a deck; times, and how far node 100000 has gone along z."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "deck.k").write_text(text)
        subprocess.run([plash, "run", path / "deck.k", "-o", path / "out", "-j", "1"], check=True, stdout=subprocess.DEVNULL)
        times, ways, time = [], [], 0.0
        for line in (path / "out" / "nodout").read_text().splitlines():
            if "at time" in line:
                time = float(line.split("at time")[1].split(")")[0])
            elif line.split()[:1] == ["100000"] and len(line) > 150:  # displacements to coordinates
                times.append(time)
                ways.append(float(line[34:46]))
    return times, ways
