"""Exact visibility for clouds that are stored in many tiles, on one machine or on a Dask cluster.

    >>> from hidden_point_removal.distributed import visible_from_tiles
    >>> seen = visible_from_tiles(["a.laz", "b.laz"], [[x, y, z]])          # doctest: +SKIP

The answer is the one of all tiles in one cloud. `kernels` holds the plain functions of the stages, which run on any
engine.
"""

from __future__ import annotations

from .plan import Answers, visible_from_tiles
from .results import write_copc, write_laz, write_parquet
from .tiles import read_tile

__all__ = ["Answers", "read_tile", "visible_from_tiles", "write_copc", "write_laz", "write_parquet"]
