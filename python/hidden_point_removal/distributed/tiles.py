"""Reading tiles: arrays, functions and files."""

from __future__ import annotations

import importlib
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np

from hidden_point_removal.errors import refusal

#: The suffixes of files that can be read, longest first.
SUFFIXES = (".copc.laz", ".parquet", ".laz", ".las", ".npy")


def refuse(code, message):
    """Raises an `HprError` with a code."""
    raise refusal(code, message)


def broken(path, why):
    refuse("load", f"{path} cannot be read: {why}")


@contextmanager
def reading(path):
    """Refuses a LAS, LAZ or COPC file that its library cannot read."""
    errors = [optional("laspy", path).errors.LaspyException]
    try:
        # Files that are not compressed need no decoder.
        errors.append(importlib.import_module("lazrs").LazrsError)
    except ImportError:
        pass
    try:
        yield
    except tuple(errors) as problem:
        broken(path, problem)


def tiles_of(given):
    """The tiles of a list, or the chunks of rows of a `dask.array`, each of which is computed where it is read."""
    if not hasattr(given, "to_delayed"):
        return list(given)
    if given.ndim != 2 or given.shape[1] != 3:
        refuse("positions-length", f"tiles must have the shape (n, 3), got {given.shape}")
    blocks = given.rechunk({1: 3}).to_delayed()[:, 0]
    return [partial(block.compute, scheduler="synchronous") for block in blocks]


def read_tile(tile):
    """The positions of a tile: (n, 3), float32 or float64.

    A tile is an array, a function that returns one, or the path of a LAS, LAZ, COPC, Parquet (columns x, y, z) or
    NumPy file. LAS coordinates are float64, as their scale and offset give them.
    """
    if callable(tile):
        tile = tile()
    if isinstance(tile, (str, Path)):
        tile = _read_file(Path(tile))
    positions = np.asarray(tile)
    if positions.dtype != np.float32:
        if positions.dtype.kind not in "fiu":
            refuse("positions-type", f"a tile must hold real numbers, got {positions.dtype}")
        positions = positions.astype(np.float64, copy=False)
    if positions.ndim != 2 or positions.shape[1] != 3:
        refuse("positions-length", f"a tile must have the shape (n, 3), got {positions.shape}")
    return np.ascontiguousarray(positions)


def _read_file(path):
    name = path.name.lower()
    if name.endswith((".laz", ".las")):
        return _read_las(path)
    if name.endswith(".parquet"):
        return _read_parquet(path)
    if name.endswith(".npy"):
        # Not mapped: a file that changes during a view would change the points under it.
        return np.load(path, allow_pickle=False)
    return refuse("option", f"{path}: tiles must be one of {', '.join(SUFFIXES)}")


def _read_las(path):
    laspy = optional("laspy", path)
    with reading(path), laspy.open(path) as file:
        points = file.read()
    return np.stack([np.asarray(points.x), np.asarray(points.y), np.asarray(points.z)], axis=1)


def _read_parquet(path):
    parquet = optional("pyarrow.parquet", path)
    table = parquet.read_table(path, columns=["x", "y", "z"])
    columns = [table.column(axis).to_numpy() for axis in "xyz"]
    dtype = np.float32 if all(column.dtype == np.float32 for column in columns) else np.float64
    return np.stack([column.astype(dtype, copy=False) for column in columns], axis=1)


def optional(module, path):
    """A library that only some tiles need."""
    try:
        return importlib.import_module(module)
    except ImportError as missing:
        package = module.partition(".")[0]
        message = f"{path}: reading it needs {package}; install hidden-point-removal[distributed]"
        raise ImportError(message) from missing


def tiles_in(folder):
    """The paths of all tiles in a folder, in the order of their names."""
    folder = Path(folder)
    if not folder.is_dir():
        refuse("option", f"{folder} is not a folder")
    found = sorted(path for path in folder.iterdir() if path.name.lower().endswith(SUFFIXES))
    if not found:
        refuse("option", f"{folder} holds no tiles ({', '.join(SUFFIXES)})")
    return found
