"""The order in which tiles are read.

A tile near the viewpoint hides more than a far one. So tiles are screened in waves, the nearest ones first. What a
wave leaves joins the horizon of the next wave, which then skips more tiles.
"""

from __future__ import annotations

import numpy as np

#: The tiles of the first wave, and how much larger each following wave is.
FIRST = 8
GROWTH = 3


def waves_of(boxes, viewpoints):
    """The numbers of the tiles, wave by wave. A tile is in the earliest wave in which any viewpoint wants it.

    So each tile is read once for all viewpoints. Tiles without a box (empty ones) are in the last wave.
    """
    count = len(boxes)
    if count == 0:
        return []
    bounds = [0]
    while bounds[-1] < count:
        bounds.append(bounds[-1] + FIRST * GROWTH ** (len(bounds) - 1))
    wave = np.full(count, len(bounds) - 2)
    full = np.array([number for number, box in enumerate(boxes) if box is not None], int)
    if len(full) > 0:
        lows = np.array([boxes[number][0] for number in full])
        highs = np.array([boxes[number][1] for number in full])
        for viewpoint in np.asarray(viewpoints, np.float64).reshape(-1, 3):
            gap = np.maximum(np.maximum(lows - viewpoint, viewpoint - highs), 0.0)
            order = np.argsort((gap**2).sum(axis=1), kind="stable")
            wanted = np.searchsorted(bounds, np.arange(len(full)), side="right") - 1
            wave[full[order]] = np.minimum(wave[full[order]], wanted)
    return [np.flatnonzero(wave == number).tolist() for number in range(len(bounds) - 1) if (wave == number).any()]
