"""The spacing of a cloud in tiles. It depends on the set of points, and not on how they are cut into tiles.

It is measured at the points with the smallest hashes, which are the same in every division.
"""

from __future__ import annotations

import numpy as np

from hidden_point_removal import PointCloud

#: The spacing is measured at this many points.
QUERIES = 8192
#: The spacing of a point is its mean distance to this many nearest points, as in `PointCloud.spacing`.
NEIGHBORS = 6


def hashes(positions):
    """A number for each position that depends on its coordinates alone: uint64."""
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


def bound_of(share):
    """The hash below which about this share of all points lies."""
    return np.uint64(min(int(share * 2**64), 2**64 - 1))


def smallest(samples, count=QUERIES):
    """The `count` distinct positions with the smallest hashes, in a fixed order: float64."""
    if not samples:
        return np.empty((0, 3))
    positions = np.concatenate([np.asarray(sample, np.float64) for sample in samples]) + 0.0
    numbers = hashes(positions)
    # Equal positions count once. They have equal hashes.
    return positions[np.unique(numbers, return_index=True)[1][:count]]


def nearest(positions, queries):
    """The nearest other points of each query among positions: (queries, NEIGHBORS, 3), filled up with infinity."""
    from scipy.spatial import cKDTree

    found = np.full((len(queries), NEIGHBORS, 3), np.inf)
    positions = np.asarray(positions[np.unique(hashes(positions), return_index=True)[1]], np.float64)
    if len(positions) == 0 or len(queries) == 0:
        return found
    # One more, because a query may be a point of the tile.
    count = min(len(positions), NEIGHBORS + 1)
    distances, indices = cKDTree(positions).query(queries, k=count)
    distances, indices = distances.reshape(len(queries), count), indices.reshape(len(queries), count)
    for row, (near, which) in enumerate(zip(distances, indices, strict=True)):
        others = which[near > 0][:NEIGHBORS]
        found[row, : len(others)] = positions[others]
    return found


def nearer(queries, shares):
    """The nearest of the points that several tiles found. Each share is (numbers of queries, points of each)."""
    every = [[] for _ in queries]
    for wanted, found in shares:
        for number, points in zip(wanted, found, strict=True):
            every[number].append(points[np.isfinite(points[:, 0])])
    nearest = np.full((len(queries), NEIGHBORS, 3), np.inf)
    for row, (query, own) in enumerate(zip(queries, every, strict=True)):
        if own:
            points = np.unique(np.concatenate(own), axis=0)
            order = np.argsort(((points - query) ** 2).sum(axis=1), kind="stable")[:NEIGHBORS]
            nearest[row, : len(order)] = points[order]
    return np.arange(len(queries)), nearest


def spacing(queries, found):
    """The mean distance of the queries to their nearest points; 0 for fewer than two points."""
    means = []
    for query, points in zip(queries, found, strict=True):
        points = points[np.isfinite(points[:, 0])]
        if len(points) > 0:
            means.append(np.sort(np.sqrt(((points - query) ** 2).sum(axis=1))).mean())
    return float(np.mean(means)) if means else 0.0


def joined(samples):
    """Several samples as one."""
    return np.concatenate(samples) if samples else np.empty((0, 3))


def reaches(queries, sample):
    """How far the nearest points of each query can be. The sample holds some points of the cloud."""
    distances = np.sqrt(((nearest(sample, queries) - queries[:, None, :]) ** 2).sum(axis=2))
    return distances.max(axis=1, initial=0.0)


def touching(box, queries, reach):
    """The numbers of the queries whose nearest points may be in a box."""
    low, high = box
    gap = np.maximum(np.maximum(low - queries, queries - high), 0.0)
    return np.flatnonzero(np.sqrt((gap**2).sum(axis=1)) <= reach * (1 + 1e-12))


def automatic_inversion(spacing):
    """The exponential inversion of a cloud with this spacing, with its scale as a number."""
    # The rule is the core's own: it is asked for a cloud whose spacing is known.
    cloud = PointCloud(np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]))
    seen = cloud.visible_from([0.0, 0.0, 3.0], inversion={"exponential": "auto"})
    scale = seen.inversion["exponential"] / cloud.spacing * spacing
    return {"exponential": max(scale, np.finfo(float).tiny) if spacing > 0 else 1.0}
