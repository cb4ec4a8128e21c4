"""The facts of all tiles. For files they are kept beside the data, so that a later question reads less."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import numpy as np

from . import kernels

FOLDER = ".hpr-manifest"
VERSION = 1


def cached_facts(engine, tiles, share, cache, progress):
    """The facts of each tile, from the cache or measured."""
    paths = [_cache_path(tile, share) if cache else None for tile in tiles]
    facts = [None if path is None else _load(path) for path in paths]
    missing = [number for number, fact in enumerate(facts) if fact is None]
    measured = engine.map(kernels.measure, [(tiles[number], share) for number in missing], "measure", progress)
    for number, fact in zip(missing, measured, strict=True):
        facts[number] = fact
        if paths[number] is not None:
            _save(paths[number], fact)
    return facts


def _cache_path(tile, share):
    """Where the facts of a file are kept. The name changes with the file's size and time."""
    if not isinstance(tile, (str, Path)):
        return None
    path = Path(tile)
    try:
        status = path.stat()
    except OSError:
        return None
    key = f"{VERSION} {path.name} {status.st_size} {status.st_mtime_ns} {share} {kernels.QUERIES}"
    return path.parent / FOLDER / f"{path.name}.{hashlib.sha256(key.encode()).hexdigest()[:16]}.npz"


def _load(path):
    try:
        with np.load(path, allow_pickle=False) as stored:
            count = int(stored["count"])
            box = (stored["low"], stored["high"]) if count > 0 else None
            return kernels.Facts(count, box, stored["sample"], stored["queries"])
    except (OSError, ValueError, KeyError, EOFError):
        # A file that is missing, or was not written to its end, is measured again.
        return None


def _save(path, facts):
    """Writes a file under another name first, so that it is whole or missing."""
    low, high = facts.box if facts.box is not None else (np.zeros(3), np.zeros(3))
    partial = path.with_name(f"{path.name}.{os.getpid()}.part.npz")
    try:
        path.parent.mkdir(exist_ok=True)
        with open(partial, "wb") as file:
            np.savez(file, count=facts.count, low=low, high=high, sample=facts.sample, queries=facts.queries)
        os.replace(partial, path)
    except OSError:
        # A folder without the right to write has no cache.
        partial.unlink(missing_ok=True)
