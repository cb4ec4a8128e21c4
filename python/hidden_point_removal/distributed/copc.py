"""The nodes of a COPC file as tiles (copc.io). Each node is one part of the file, and is read alone."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .tiles import broken, optional, reading

#: One entry of the list of nodes. An entry with -1 points is another page of the list.
_ENTRY = np.dtype([("key", "<i4", 4), ("offset", "<u8"), ("size", "<i4"), ("points", "<i4")])


@dataclass(frozen=True)
class CopcNode:
    """A node of a COPC file. Call it to read the positions of its points. No other points are read."""

    path: Path
    #: Depth, x, y and z of the node's cell.
    key: str
    offset: int
    size: int
    points: int

    def __call__(self):
        lazrs = optional("lazrs", self.path)
        with open(self.path, "rb") as file:
            header = _header(file, self.path)
            file.seek(self.offset)
            chunk = file.read(self.size)
        row = header.point_format.size
        # After its first point, a chunk holds the number of its points.
        if len(chunk) < self.size or int.from_bytes(chunk[row : row + 4], "little") != self.points:
            broken(self.path, f"node {self.key} does not hold the {self.points} points that are listed")
        [layout] = header.vlrs.get("LasZipVlr")
        rows = np.zeros(self.points * row, np.uint8)
        wanted = lazrs.SELECTIVE_DECOMPRESS_XY_RETURNS_CHANNEL | lazrs.SELECTIVE_DECOMPRESS_Z
        with reading(self.path):
            lazrs.decompress_points_with_chunk_table(
                chunk, layout.record_data, rows, [(self.points, self.size)], lazrs.DecompressionSelection(wanted)
            )
        integers = rows.view(header.point_format.dtype())
        axes = zip("XYZ", header.scales, header.offsets, strict=True)
        return np.stack([integers[axis] * scale + offset for axis, scale, offset in axes], axis=1)

    def __str__(self):
        return f"node {self.key} of {self.path}"


def is_copc(tile):
    return isinstance(tile, (str, Path)) and Path(tile).name.lower().endswith(".copc.laz")


def nodes_of(path):
    """The nodes of a COPC file that hold points, in the order of the file. So their points are in the file's order."""
    path = Path(path)
    length = path.stat().st_size
    nodes, known = [], set()
    with open(path, "rb") as file:
        header = _header(file, path)
        info = header.vlrs[0]
        pages = [(info.hierarchy_root_offset, info.hierarchy_root_size)]
        while pages:
            start, size = pages.pop()
            if start in known or not 0 < size <= length - start or size % _ENTRY.itemsize > 0:
                broken(path, f"its list of nodes has a page of {size} bytes at byte {start}")
            known.add(start)
            file.seek(start)
            for entry in np.frombuffer(file.read(size), _ENTRY):
                place = int(entry["offset"]), int(entry["size"])
                if entry["points"] == -1:
                    pages.append(place)
                elif entry["points"] != 0:
                    nodes.append(CopcNode(path, "-".join(map(str, entry["key"])), *place, int(entry["points"])))
    nodes.sort(key=lambda node: node.offset)
    for node, end in zip(nodes, [node.offset for node in nodes[1:]] + [length], strict=True):
        if node.points < 0 or not 0 < node.size <= end - node.offset:
            broken(path, f"node {node.key} is listed with {node.points} points and {node.size} bytes")
    listed = sum(node.points for node in nodes)
    if listed != header.point_count:
        broken(path, f"its nodes have {listed} points, but its header says {header.point_count}")
    return nodes


def _header(file, path):
    laspy = optional("laspy", path)
    with reading(path):
        header = laspy.LasHeader.read_from(file)
    if not header.vlrs or not isinstance(header.vlrs[0], laspy.copc.CopcInfoVlr):
        broken(path, "it has no list of nodes, so it is not a COPC file")
    return header
