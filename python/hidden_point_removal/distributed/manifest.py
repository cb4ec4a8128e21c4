"""What is known of each tile before its points are asked. For files it is kept beside the data."""

from __future__ import annotations

import hashlib
import os
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import statistics
from .copc import CopcNode
from .tiles import read_tile, refuse

FOLDER = ".hpr-manifest"
VERSION = 2


@dataclass(frozen=True)
class Facts:
    """What is known of a tile."""

    count: int
    #: The tight box of its points; None for an empty tile.
    box: tuple[np.ndarray, np.ndarray] | None
    #: The points with the smallest hashes, in the order of their hashes: (m, 3), as precise as the tile.
    sample: np.ndarray


def facts(tile, share, cache):
    """The facts of a tile, from the cache or measured. About `share` of its points become the sample."""
    path = _cache_path(tile, share) if cache else None
    known = None if path is None else _load(path)
    if known is None:
        known = measure(tile, share)
        if path is not None:
            _save(path, known)
    return known


def measure(tile, share):
    """The facts of a tile, from its points."""
    positions = read_tile(tile)
    if len(positions) == 0:
        return Facts(0, None, positions)
    finite = np.isfinite(positions).all(axis=1)
    if not finite.all():
        bad = np.flatnonzero(~finite)
        refuse("non-finite", f"{len(bad)} point(s) of {_name_of(tile)} are not finite, the first at index {bad[0]}")
    numbers = statistics.hashes(positions)
    chosen = np.flatnonzero(numbers <= statistics.bound_of(share))
    sample = positions[chosen[np.argsort(numbers[chosen], kind="stable")]]
    box = (positions.min(axis=0).astype(np.float64), positions.max(axis=0).astype(np.float64))
    return Facts(len(positions), box, sample)


def summary(known):
    """The facts without the sample, which can be large: (count, box, size of the sample)."""
    return known.count, known.box, len(known.sample)


def thinned(known, share):
    """The part of the sample that is a sample of a smaller share."""
    within = np.searchsorted(statistics.hashes(known.sample), statistics.bound_of(share), side="right")
    return known.sample[:within]


def file_of(tile):
    """The file that holds a tile. None for arrays and functions."""
    if isinstance(tile, CopcNode):
        return tile.path
    return Path(tile) if isinstance(tile, (str, Path)) else None


def identity(tile):
    """The name, size and time of a tile's file: text that changes with its points. None for other tiles."""
    path = file_of(tile)
    if path is None:
        return None
    try:
        status = path.stat()
    except OSError:
        return None
    node = f" {tile.offset}" if isinstance(tile, CopcNode) else ""
    return f"{path.name} {status.st_size} {status.st_mtime_ns}{node}"


def _name_of(tile):
    """A tile in a message."""
    return "a tile" if file_of(tile) is None else str(tile)


def digest_of(*texts):
    return hashlib.sha256("\n".join(texts).encode()).hexdigest()[:24]


def _cache_path(tile, share):
    """Where the facts of a file are kept. The name changes with the file's size and time."""
    known = identity(tile)
    if known is None:
        return None
    path = file_of(tile)
    return path.parent / FOLDER / f"{path.name}.{digest_of(str(VERSION), known, repr(share))}.npz"


def _load(path):
    stored = load_arrays(path)
    if stored is None or not {"count", "low", "high", "sample"} <= set(stored):
        return None
    count = int(stored["count"])
    return Facts(count, (stored["low"], stored["high"]) if count > 0 else None, stored["sample"])


def _save(path, known):
    low, high = known.box if known.box is not None else (np.zeros(3), np.zeros(3))
    try:
        path.parent.mkdir(exist_ok=True)
        save_arrays(path, count=known.count, low=low, high=high, sample=known.sample)
    except OSError:
        # A folder without the right to write has no cache.
        pass


def load_arrays(path):
    """The arrays of a file. None if it is missing or damaged."""
    try:
        with np.load(path, allow_pickle=False) as stored:
            return dict(stored)
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


def save_arrays(path, **arrays):
    """Writes a file under another name first, so that it is whole or missing."""
    partial = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        with open(partial, "wb") as file:
            np.savez(file, **arrays)
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)
