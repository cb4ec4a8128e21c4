"""Writing answers to files."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import numpy as np

from .tiles import optional, reading


def write_parquet(path, answers):
    """Writes one row for each point that any viewpoint sees: `id` (uint64) and one column `seen_k` for viewpoint k."""
    arrow = optional("pyarrow", path)
    parquet = optional("pyarrow.parquet", path)
    ids = np.unique(np.concatenate(answers)) if len(answers) > 0 else np.empty(0, np.uint64)
    columns = {"id": ids}
    for number, answer in enumerate(answers):
        columns[f"seen_{number}"] = np.isin(ids, answer)
    _replace(path, lambda partial: parquet.write_table(arrow.table(columns), partial))


def write_laz(source, path, first_id, answers):
    """Copies a LAS or LAZ tile, with an extra dimension `visible`: bit k says that viewpoint k sees the point.

    There is room for 64 viewpoints.
    """
    laspy = optional("laspy", path)
    if len(answers) > 64:
        raise ValueError(f"a LAZ file has room for 64 viewpoints, got {len(answers)}")
    with reading(source), laspy.open(source) as file:
        points = file.read()
    count = len(points.points)
    bits = np.zeros(count, np.uint64)
    for number, answer in enumerate(answers):
        low, high = np.searchsorted(answer, [np.uint64(first_id), np.uint64(first_id + count)])
        own = (answer[low:high] - np.uint64(first_id)).astype(np.int64)
        bits[own] |= np.uint64(1) << np.uint64(number)
    # The list of a COPC file's nodes does not suit the copy: laspy writes its points in chunks of another size.
    for records in (points.header.vlrs, points.header.evlrs or []):
        records[:] = [record for record in records if record.user_id != "copc"]
    width = next(width for width in (8, 16, 32, 64) if len(answers) <= width)
    dtype = np.dtype(f"u{width // 8}")
    points.add_extra_dim(laspy.ExtraBytesParams(name="visible", type=dtype, description="bit k: viewpoint k"))
    points["visible"] = bits.astype(dtype)
    _replace(path, lambda partial: points.write(partial))


def write_copc(copy, path):
    """Makes a COPC file of a LAZ file with the program `pdal`, with all dimensions, and deletes the LAZ file.

    PDAL sorts the points into an octree of its own. Returns whether there is a `pdal`; without it nothing changes.
    Raises `OSError` if `pdal` fails.
    """
    pdal = shutil.which("pdal")
    if pdal is None:
        return False

    def translate(partial):
        command = [pdal, "translate", str(copy), partial, "--writer", "writers.copc", "--writers.copc.forward=all"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise OSError(f"pdal could not make {path} of {copy}: {done.stderr.strip()}")

    _replace(path, translate)
    Path(copy).unlink()
    return True


def _replace(path, write):
    """Writes under another name first, so that the file is whole or missing."""
    path = Path(path)
    partial = path.with_name(f".part-{os.getpid()}-{path.name}")
    try:
        write(str(partial))
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)
