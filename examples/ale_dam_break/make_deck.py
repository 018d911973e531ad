#!/usr/bin/env python3
"""Writes dam_break.k: a column of water collapses in a closed tank, on a structured Eulerian mesh.

Tank 0.6 x 0.05 x 0.4 m, water 0.15 x 0.05 x 0.25 m, empty space above; see README.md for the reference.
Usage: make_deck.py [CELLS_ALONG_X]   (default 60: cells of 10 mm)
"""
import pathlib
import sys

along_x = int(sys.argv[1]) if len(sys.argv) > 1 else 60
cells = (along_x, max(1, along_x // 12), along_x * 2 // 3)
size = (0.6, 0.05, 0.4)


def card(*values, width=10):
    return "".join(f"{value:>{width}}" for value in values)


lines = ["*KEYWORD", "*TITLE", "Dam break on a structured Eulerian mesh (kg, m, s)",
         "*CONTROL_TERMINATION", card(0.3),
         "*CONTROL_TIMESTEP", card(0, 0.67),
         "*CONTROL_ENERGY", card(2, 2, 2, 2),
         "*CONTROL_ALE", "$ DCT NADV METH AFAC", card(-1, 1, 2, -1.0),
         "$ START END AAFAC VFACT PRIT EBC (2: no flow through the outer faces)",
         card("", "", "", "", 0, 2),
         "*DATABASE_GLSTAT", card(0.001), "*DATABASE_MATSUM", card(0.001),
         "*DATABASE_BINARY_D3PLOT", card(0.01),
         "*LOAD_BODY_Z", card(1, 9.81),
         "*DEFINE_CURVE", card(1), card(0.0, 1.0, width=20), card(1.0, 1.0, width=20),
         "*ALE_STRUCTURED_MESH", "$ MSHID DPID NBID EBID", card(1, 10, 1, 1), card(1, 2, 3)]
for axis in range(3):
    lines += ["*ALE_STRUCTURED_MESH_CONTROL_POINTS", card(axis + 1), card(1, 0.0, width=20),
              card(cells[axis] + 1, size[axis], width=20)]
lines += ["*ALE_MULTI-MATERIAL_GROUP", card(1, 1), card(2, 1),
          "*INITIAL_VOLUME_FRACTION_GEOMETRY", "$ mesh part, background: group 2", card(10, 1, 2, 3),
          "$ a box filled with group 1", card(5, 0, 1), card(0.0, 0.0, 0.0, 0.15, 0.05, 0.25),
          "*PART", "water", card(1, 1, 1, 1, 1), "*PART", "empty space", card(2, 1, 2, 0, 1),
          "*SECTION_SOLID", card(1, 11),
          "*HOURGLASS", card(1, 1, 1e-7),
          "*MAT_NULL", card(1, 998.0, -1e4, 1e-3),
          "*EOS_GRUNEISEN", "$ C S1 S2 S3 GAMMA0 A E0", card(1, 1480.0, 1.979, 0, 0, 0.11, 3.0, 0.0), card(1.0),
          "*MAT_VACUUM", card(2, 1e-9),
          "*END"]
pathlib.Path(__file__).with_name("dam_break.k").write_text("\n".join(lines) + "\n")
