"""The stages as plain functions of arrays. They run on any engine: each depends on its arguments alone.

    measure   -> Facts of one tile                                 (reads the tile)
    neighbors -> what a tile adds to the spacing of the cloud      (reads the tile)
    screen    -> the points of a tile that may be visible          (reads the tile, unless its box is hidden)
    merge     -> the visible points of several parts
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from hidden_point_removal import Horizon, PointCloud, merge_visible

from .tiles import read_tile, refuse

#: The spacing is measured at this many points.
QUERIES = 8192
#: The spacing of a point is its mean distance to this many nearest points, as in `PointCloud.spacing`.
NEIGHBORS = 6


@dataclass(frozen=True)
class Facts:
    """What is known of a tile before its points are asked."""

    count: int
    #: The tight box of its points; None for an empty tile.
    box: tuple[np.ndarray, np.ndarray] | None
    #: Points for the horizon: float64, (m, 3).
    sample: np.ndarray
    #: Its points with the smallest hashes: float64, (at most QUERIES, 3).
    queries: np.ndarray


@dataclass(frozen=True)
class Part:
    """Points that may be visible, with their ids."""

    positions: np.ndarray
    ids: np.ndarray
    #: Whether the tile's box was hidden, so that it was not read.
    skipped: bool = False


def hashes(positions):
    """A number for each position that depends on its coordinates alone: uint64.

    So the same points have the smallest hashes in every division of a cloud into tiles.
    """
    bits = np.asarray(positions, np.float64) + 0.0  # -0 becomes 0
    mixed = np.zeros(len(bits), np.uint64)
    with np.errstate(over="ignore"):
        for axis in range(3):
            mixed ^= np.ascontiguousarray(bits[:, axis]).view(np.uint64)
            mixed += np.uint64(0x9E3779B97F4A7C15)
            mixed = (mixed ^ (mixed >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
            mixed = (mixed ^ (mixed >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
            mixed ^= mixed >> np.uint64(31)
    return mixed


def smallest(positions, count):
    """The `count` distinct positions with the smallest hashes, in a fixed order."""
    positions = np.unique(np.asarray(positions, np.float64) + 0.0, axis=0)
    order = np.lexsort((*positions.T[::-1], hashes(positions)))
    return positions[order[:count]]


def measure(tile, share):
    """The facts of a tile. About `share` of its points become the sample."""
    positions = read_tile(tile)
    count = len(positions)
    if count == 0:
        nothing = np.empty((0, 3))
        return Facts(0, None, nothing, nothing)
    finite = np.isfinite(positions).all(axis=1)
    if not finite.all():
        bad = np.flatnonzero(~finite)
        refuse("non-finite", f"{len(bad)} point(s) of {_name(tile)} are not finite, the first at index {bad[0]}")
    numbers = hashes(positions)
    sample = positions[numbers <= np.uint64(int(share * (2**64 - 1)))]
    # Enough candidates for the smallest hashes of distinct points, without sorting all of them.
    bound = np.sort(np.partition(numbers, min(count, 4 * QUERIES) - 1)[: 4 * QUERIES])[-1]
    return Facts(
        count,
        (positions.min(axis=0).astype(np.float64), positions.max(axis=0).astype(np.float64)),
        np.asarray(sample, np.float64),
        smallest(positions[numbers <= bound], QUERIES),
    )


def neighbors(tile, queries):
    """The nearest other points of each query in this tile: (queries, NEIGHBORS, 3), filled up with infinity."""
    from scipy.spatial import cKDTree

    found = np.full((len(queries), NEIGHBORS, 3), np.inf)
    positions = np.unique(read_tile(tile).astype(np.float64), axis=0)
    if len(positions) > 0:
        # One more, because a query may be a point of the tile.
        count = min(len(positions), NEIGHBORS + 1)
        distances, indices = cKDTree(positions).query(queries, k=count)
        distances, indices = distances.reshape(len(queries), count), indices.reshape(len(queries), count)
        for row, (near, which) in enumerate(zip(distances, indices, strict=True)):
            others = which[near > 0][:NEIGHBORS]
            found[row, : len(others)] = positions[others]
    return found


def spacing(queries, shares):
    """The mean distance of the queries to their nearest points in all tiles; 0 for fewer than two points."""
    every = np.concatenate(shares, axis=1)
    means = []
    for query, points in zip(queries, every, strict=True):
        points = np.unique(points[np.isfinite(points[:, 0])], axis=0)
        if len(points) > 0:
            distances = np.sort(np.sqrt(((points - query) ** 2).sum(axis=1)))
            means.append(distances[:NEIGHBORS].mean())
    return float(np.mean(means)) if means else 0.0


def automatic_inversion(spacing):
    """The exponential inversion of a cloud with this spacing, with its scale as a number."""
    # The rule is the core's own: it is asked for a cloud whose spacing is known.
    cloud = PointCloud(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    seen = cloud.visible_from([0.0, 0.0, 3.0], inversion={"exponential": "auto"})
    scale = seen.inversion["exponential"] / cloud.spacing * spacing
    return {"exponential": max(scale, np.finfo(float).tiny) if spacing > 0 else 1.0}


def horizon_points(viewpoint, options, samples):
    """The points of the horizon of all samples, as seen from a viewpoint. Only they are sent to the tiles."""
    horizon = Horizon(viewpoint, **options)
    for sample in samples:
        horizon.add(sample)
    return horizon.visible()


def screen(tile, first_id, box, viewpoints, horizons, options):
    """The points of a tile that may be visible, for each viewpoint: a list of `Part`.

    They are the points that neither the horizon nor the tile itself hides. The tile is read once, and not at all if
    its box is hidden from every viewpoint.
    """
    words = json.dumps(options, sort_keys=True)
    built = [_horizon(tuple(at), words, _Key(points)) for at, points in zip(viewpoints, horizons, strict=True)]
    hidden = [box is None or horizon.hides_box(*box) for horizon in built]
    if all(hidden):
        return [_nothing(skipped=box is not None) for _ in built]
    positions = read_tile(tile)
    parts = []
    for viewpoint, horizon, is_hidden in zip(viewpoints, built, hidden, strict=True):
        if is_hidden:
            parts.append(_nothing(skipped=True))
            continue
        left = horizon.screen(positions)
        own = positions[left]
        ids = left.astype(np.uint64) + np.uint64(first_id)
        if len(own) > 0:
            seen = PointCloud(own).visible_from(viewpoint, **options).indices
            own, ids = own[seen], ids[seen]
        parts.append(Part(own, ids))
    return parts


def merge(parts, viewpoint, options):
    """The visible points of several parts together."""
    parts = [part for part in parts if len(part.ids) > 0]
    if len(parts) < 2:
        return parts[0] if parts else _nothing()
    ids = merge_visible([(part.positions, part.ids) for part in parts], viewpoint, **options)
    kept = [np.isin(part.ids, ids) for part in parts]
    positions = np.concatenate([part.positions[keep] for part, keep in zip(parts, kept, strict=True)])
    numbers = np.concatenate([part.ids[keep] for part, keep in zip(parts, kept, strict=True)])
    numbers, first = np.unique(numbers, return_index=True)
    return Part(np.ascontiguousarray(positions[first]), numbers)


def _nothing(skipped=False):
    return Part(np.empty((0, 3), np.float32), np.empty(0, np.uint64), skipped)


def _name(tile):
    return "a tile" if isinstance(tile, np.ndarray) or callable(tile) else str(tile)


class _Key:
    """An array that can be a key of a cache."""

    def __init__(self, points):
        self.points = points
        self._bytes = points.tobytes()

    def __hash__(self):
        return hash(self._bytes)

    def __eq__(self, other):
        return self._bytes == other._bytes


@lru_cache(maxsize=64)
def _horizon(viewpoint, options, key):
    """A horizon. A process that screens many tiles builds it once."""
    horizon = Horizon(viewpoint, **json.loads(options))
    horizon.add(key.points)
    return horizon
