#!/usr/bin/env python3
"""A rigid box without a lid, half as heavy as the water it can hold out, on an Eulerian mesh: Archimedes' draught.

Usage: floating_box.py [CELLS_ALONG_THE_TANK] [COUPLING]     (default: 16, the text of the coupling's cards below)
Tank 0.4 m, box 0.15 m, cards of the coupling separated by /; prints the draught over the last third of 3 s beside 0.075 m.
"""
import sys

from floating_decks import rigid_box, under_gravity, water_and_void, way_along_z

cells = int(sys.argv[1]) if len(sys.argv) > 1 else 16
coupling = sys.argv[2].replace("/", "\n") if len(sys.argv) > 2 else "2,4,1,1\n0,0,0.1,0,0.3,0,0,0.2\n,,,2,0.1"
side, low, level, end = 0.15, 0.1275, 0.2625, 3.0
cell = 0.4 / cells
start = level - 0.5 * side + 0.015
per_edge = max(2, round(side / cell))


def patch(first, corner, a, b):
    """Nodes and shells of a square with its normal along a x b."""
    n = per_edge
    nodes, shells = "", ""
    for j in range(n + 1):
        for i in range(n + 1):
            x = [corner[d] + (a[d] * i + b[d] * j) * side / n for d in range(3)]
            number = first + i + (n + 1) * j
            nodes += f"{number},{x[0]:.9g},{x[1]:.9g},{x[2]:.9g}\n"
            if i < n and j < n:
                shells += f"{number},20,{number},{number + 1},{number + n + 2},{number + n + 1}\n"
    return nodes, shells


x, y, z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
origin, far_x, far_y = (low, low, start), (low + side, low, start), (low, low + side, start)
walls = [(origin, y, x), (origin, z, y), (far_x, y, z), (origin, x, z), (far_y, z, x)]
parts = [patch(100000 + 10000 * number, *wall) for number, wall in enumerate(walls)]
text = "*KEYWORD\n*ALE_STRUCTURED_MESH\n1,10,1,1\n1,2,3\n"
for axis in (1, 2, 3):
    text += f"*ALE_STRUCTURED_MESH_CONTROL_POINTS\n{axis}\n1,0\n{cells + 1},0.4\n"
text += f"""{water_and_void(4e5)}*INITIAL_VOLUME_FRACTION_GEOMETRY
10,1,2,3
5,0,1
0,0,0,1,1,{level}
5,0,2
{low},{low},{start},{low + side},{low + side},1
{rigid_box(1500, coupling)}{under_gravity(end, 0.01)}*NODE
{''.join(nodes for nodes, _ in parts)}*ELEMENT_SHELL
{''.join(shells for _, shells in parts)}*END
"""
heights = [(time, start + way) for time, way in zip(*way_along_z(text))]
late = [height for when, height in heights if when > 2 * end / 3]
floor = sum(late) / len(late)
area = 0.16 - side * side
surface = (level * area + start * side * side - floor * side * side) / area
print(f"draught {surface - floor:.4f} m, wanted {0.5 * side:.4f} m: {(surface - floor - 0.5 * side) / cell:+.2f} cells of "
      f"{cell:.4f} m; lowest {min(h for _, h in heights):.4f}, highest {max(h for _, h in heights):.4f}")
