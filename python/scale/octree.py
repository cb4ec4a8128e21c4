"""python octree.py FILE.copc.laz POINTS: the city of city.py as one COPC file, with colors. Needs copclib from PyPI."""

from __future__ import annotations

import sys

import copclib
import numpy as np

from city import SIDE, UTM, city

SCALE = 0.001
#: A node keeps one point for each cell of a grid with so many cells along each axis. The others go to its children.
GRID = 96
#: Nodes at this depth keep all of their points.
DEEPEST = 5


def levels_of(places):
    """The depth of each point's node. `places` are from 0 to 1 within the cube of the root."""
    depths = np.full(len(places), DEEPEST)
    left = np.arange(len(places))
    for depth in range(DEEPEST):
        cells = (places[left] * (GRID << depth)).astype(np.int64)
        key = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
        first = np.unique(key, return_index=True)[1]
        depths[left[first]] = depth
        left = np.delete(left, first)
    return depths


def main(path, count):
    points = city(int(count)) + UTM
    low, half = UTM - [0, 0, 10], SIDE / 2 + 5
    integers = np.round((points - UTM) / SCALE).astype(np.int32)
    places = (points - low) / (2 * half)
    depths = levels_of(places)
    cells = (places * (1 << depths)[:, None]).astype(np.int64)
    order = np.lexsort((cells[:, 2], cells[:, 1], cells[:, 0], depths))
    keys = np.column_stack([depths, cells])[order]
    ends = np.append(np.flatnonzero((np.diff(keys, axis=0) != 0).any(axis=1)) + 1, len(keys))

    # Format 7: 30 bytes with x, y, z first, and red, green, blue.
    rows = np.zeros(len(points), np.dtype({"names": ["xyz", "returns", "rgb"], "formats": [("<i4", 3), "u1", ("<u2", 3)],
                                           "offsets": [0, 14, 30], "itemsize": 36}))
    rows["xyz"], rows["returns"] = integers[order], 0x11
    rows["rgb"] = np.clip(places[order] * [65535, 65535, 65535 * 15], 0, 65535).astype(np.uint16)

    config = copclib.CopcConfigWriter(7, copclib.Vector3(*[SCALE] * 3), copclib.Vector3(*UTM.tolist()))
    config.las_header.min = copclib.Vector3(*points.min(axis=0).tolist())
    config.las_header.max = copclib.Vector3(*points.max(axis=0).tolist())
    center = (low + half).tolist()
    config.copc_info.center_x, config.copc_info.center_y, config.copc_info.center_z = center
    config.copc_info.halfsize, config.copc_info.spacing = half, 2 * half / GRID
    writer = copclib.FileWriter(path, config)
    start = 0
    for end in ends.tolist():
        depth, *cell = keys[start].tolist()
        # The list of nodes has a page for each cell of the second level.
        page = (2, *(value >> depth - 2 for value in cell)) if depth > 2 else (0, 0, 0, 0)
        data = copclib.VectorChar(np.frombuffer(rows[start:end].tobytes(), np.int8))
        writer.AddNode(copclib.VoxelKey(depth, *cell), data, copclib.VoxelKey(*page))
        start = end
    writer.Close()
    print(f"{len(points):,} points in {len(ends):,} nodes")


main(*sys.argv[1:])
