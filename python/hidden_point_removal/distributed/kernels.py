"""The stages as plain functions of arrays. They run on any engine: each depends on its arguments alone.

    manifest.facts      what is known of a tile                          (reads the tile, or its manifest)
    neighbors           what a tile adds to the spacing of the cloud     (reads the tile)
    horizon_points      the visible points of samples
    screen              the points of a tile that may be visible         (reads the tile, unless its box is hidden)
    merge               the visible points of several parts
"""

from __future__ import annotations

import hashlib
import json
import threading
from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hidden_point_removal import Horizon, PointCloud, merge_visible

from . import statistics
from .manifest import load_arrays, save_arrays
from .tiles import read_tile


@dataclass(frozen=True)
class Part:
    """Points that may be visible, with their ids."""

    positions: np.ndarray
    ids: np.ndarray
    #: Whether the tile's box was hidden, so that its points were not needed.
    skipped: bool = False


def neighbors(tile, queries, wanted):
    """The nearest other points of the wanted queries in a tile: (wanted, points)."""
    return wanted, statistics.nearest(read_tile(tile), queries[wanted])


def horizon_points(viewpoint, options, samples):
    """The points of the horizon of all samples, as seen from a viewpoint. Only they are sent to the tiles."""
    horizon = Horizon(viewpoint, **options)
    samples = [sample for sample in samples if len(sample) > 0]
    if samples:
        horizon.add(np.concatenate(samples))
    return horizon.visible()


def screen(tile, first_id, box, viewpoints, horizons, options, store=None):
    """The points of a tile that may be visible, for each viewpoint: a list of `Part`.

    They are the points that neither the horizon nor the tile itself hides. The tile is read once, and not at all if
    its box is hidden from every viewpoint. With `store`, the path of a file, they are kept there; if the file is
    there already, it is the answer.
    """
    parts = None if store is None else _kept(Path(store), len(viewpoints))
    if parts is None:
        parts = _screened(tile, box, viewpoints, horizons, options)
        if store is not None:
            _keep(Path(store), parts)
    return [Part(part.positions, part.ids + np.uint64(first_id), part.skipped) for part in parts]


def _screened(tile, box, viewpoints, horizons, options):
    """The parts with indices of the tile as ids."""
    words = json.dumps(options, sort_keys=True)
    built = [_horizon(tuple(at), words, points) for at, points in zip(viewpoints, horizons, strict=True)]
    hidden = [box is None or horizon.hides_box(*box) for horizon in built]
    if all(hidden):
        return [_nothing(skipped=box is not None) for _ in built]
    positions = read_tile(tile)
    parts = []
    for viewpoint, horizon, is_hidden in zip(viewpoints, built, hidden, strict=True):
        if is_hidden:
            parts.append(_nothing(skipped=True))
            continue
        ids = horizon.screen(positions)
        own = positions[ids]
        if len(own) > 0:
            seen = PointCloud(own).visible_from(viewpoint, **options).indices
            own, ids = own[seen], ids[seen]
        parts.append(Part(own, ids.astype(np.uint64)))
    return parts


def merge(parts, viewpoint, options):
    """The visible points of several parts together."""
    parts = [part for part in parts if len(part.ids) > 0]
    if len(parts) < 2:
        return parts[0] if parts else _nothing()
    ids = merge_visible([(part.positions, part.ids) for part in parts], viewpoint, **options)
    kept = [_are_among(part.ids, ids) for part in parts]
    positions = np.concatenate([part.positions[keep] for part, keep in zip(parts, kept, strict=True)])
    numbers = np.concatenate([part.ids[keep] for part, keep in zip(parts, kept, strict=True)])
    order = np.argsort(numbers, kind="stable")
    return Part(positions[order], numbers[order])


def _are_among(some, ids):
    """Whether each of some numbers is among the ids, which ascend. `np.isin` would sort the ids again for each part."""
    places = np.searchsorted(ids, some)
    found = places < len(ids)
    found[found] = ids[places[found]] == some[found]
    return found


def some_of(parts, number, most):
    """At most so many of the points that a tile kept for one viewpoint, spread over the tile."""
    positions = parts[number].positions
    return positions[:: max(1, -(-len(positions) // max(1, most)))]


def _nothing(skipped=False):
    return Part(np.empty((0, 3), np.float32), np.empty(0, np.uint64), skipped)


def _kept(path, viewpoints):
    stored = load_arrays(path)
    if stored is None or len(stored) != 3 * viewpoints:
        return None
    return [
        Part(stored[f"positions_{number}"], stored[f"ids_{number}"], bool(stored[f"skipped_{number}"]))
        for number in range(viewpoints)
    ]


def _keep(path, parts):
    arrays = {}
    for number, part in enumerate(parts):
        arrays[f"positions_{number}"] = part.positions
        arrays[f"ids_{number}"] = part.ids
        arrays[f"skipped_{number}"] = np.bool_(part.skipped)
    path.parent.mkdir(parents=True, exist_ok=True)
    save_arrays(path, **arrays)


#: A process keeps horizons of about this many points together. Each point takes some 200 bytes in a hull.
KEPT_POINTS = 1_000_000
_horizons: OrderedDict[tuple, tuple[int, Horizon]] = OrderedDict()
_lock = threading.Lock()


def _horizon(viewpoint, options, points):
    """A horizon. A process that screens many tiles builds it once."""
    key = (viewpoint, options, hashlib.blake2b(np.ascontiguousarray(points)).digest())
    with _lock:
        if key in _horizons:
            _horizons.move_to_end(key)
            return _horizons[key][1]
    horizon = Horizon(viewpoint, **json.loads(options))
    horizon.add(points)
    with _lock:
        _horizons[key] = (len(points), horizon)
        while len(_horizons) > 1 and sum(size for size, _ in _horizons.values()) > KEPT_POINTS:
            _horizons.popitem(last=False)
    return horizon
