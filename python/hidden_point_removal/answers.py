"""Answers of several parts."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._native import HprError, Visibility


class Calibration(NamedTuple):
    """How a cloud is to be asked, so that its scanners see the points that they measured."""

    thickness: float
    """The smallest thickness that was found, in the cloud's units."""
    recall: list[float]
    """For each station, the share of its own points that `options` see, from 0 to 1."""
    options: dict[str, Any]
    """The given options with `looks` and this `thickness`."""


class SeenBy(NamedTuple):
    """Which cameras see each point: the rows of a sparse matrix. The cameras of point i are
    `cameras[offsets[i]:offsets[i + 1]]`, ascending.

    `scipy.sparse.csr_array((values, seen.cameras, seen.offsets))` with one value for each entry is the matrix of points
    and cameras.
    """

    offsets: NDArray[np.uint32]
    """One number more than the cloud has indices."""
    cameras: NDArray[np.uint32]
    """The number of the camera of each entry."""
    pixels: NDArray[np.float32]
    """Where the camera shows the point, x and y: shape (entries, 2)."""
    towards: NDArray[np.float32]
    """The direction of length 1 from the point to the camera: shape (entries, 3)."""


def colmap_vis(seen_by):
    """What COLMAP's `fused.ply.vis` says: which cameras see each point. `seen_by` is the answer of `PointCloud.seen_by`.

    Returns bytes: little-endian, the number of points in 64 bits, then for each point how many cameras see it, and their
    numbers from 0, in 32 bits each. Raises `HprError` with the code "option".
    """
    if not isinstance(seen_by, SeenBy) or list(seen_by.offsets[:1]) != [0] or seen_by.offsets[-1] != len(seen_by.cameras):
        error = HprError("colmap_vis needs what seen_by of a cloud answers")
        error.code = "option"
        raise error
    offsets = seen_by.offsets.astype(np.int64)
    rows = np.insert(seen_by.cameras, offsets[:-1], np.diff(offsets))
    return np.array([len(offsets) - 1], "<u8").tobytes() + rows.astype("<u4").tobytes()


def restored(*state):
    """A `Visibility` that was pickled."""
    return Visibility._restored(*state)
