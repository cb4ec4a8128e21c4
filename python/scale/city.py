"""A generated city: ground, walls and roofs on a square of 1 km, and five viewpoints."""

from __future__ import annotations

from pathlib import Path

import numpy as np

SIDE = 1000.0
#: Map coordinates (UTM), as surveys have them.
UTM = np.array([636_000.0, 849_000.0, 400.0])
#: Tiles on each side of the square.
TILES = 16
#: This share of each tile is also in the next one.
SHARED = 0.01

VIEWPOINTS = {
    "street": [500.0, 502.0, 1.7],
    "inside a house": [445.0, 445.0, 3.0],
    "oblique": [-300.0, -400.0, 350.0],
    "nadir": [500.0, 500.0, 1500.0],
    "in a wall's plane": [430.0, 500.0, 1.7],
}


def city(count, seed=1):
    """Points with whole millimetres: (count, 3)."""
    random = np.random.default_rng(seed)
    # Two by two houses of 30 m in each block of 100 m, with streets of 20 m around the blocks.
    starts = np.array([block + at for block in range(0, 1000, 100) for at in (10.0, 30.0 + 30.0)])
    x, y = np.meshgrid(starts, starts, indexing="ij")
    houses = np.column_stack([x.ravel(), y.ravel()])
    heights = np.random.default_rng(5).uniform(8, 60, len(houses))
    parts = (random.multinomial(count, [0.4, 0.45, 0.15])).tolist()
    ground = np.column_stack([random.uniform(0, SIDE, (parts[0], 2)), random.normal(0, 0.02, parts[0])])
    house = random.integers(0, len(houses), parts[1])
    along, side = random.uniform(0, 30, parts[1]), random.integers(0, 4, parts[1])
    offsets = [[along, 0 * along], [along, 0 * along + 30], [0 * along, along], [0 * along + 30, along]]
    wall = np.column_stack([
        houses[house, 0] + np.choose(side, [x for x, _ in offsets]),
        houses[house, 1] + np.choose(side, [y for _, y in offsets]),
        random.uniform(0, 1, parts[1]) * heights[house],
    ])
    house = random.integers(0, len(houses), parts[2])
    roof = np.column_stack([houses[house] + random.uniform(0, 30, (parts[2], 2)), heights[house]])
    return np.round(np.concatenate([ground, wall, roof]), 3)


def cut(points, how):
    """The points in tiles: by squares of the ground, or at random. Neighbors share some points."""
    if how == "spatial":
        column, row = (np.clip(points[:, axis] * TILES / SIDE, 0, TILES - 1).astype(int) for axis in (0, 1))
        key = row * TILES + column
    else:
        key = np.random.default_rng(2).integers(0, TILES * TILES // 4, len(points))
    order = np.argsort(key, kind="stable")
    tiles = np.split(points[order], np.flatnonzero(np.diff(key[order])) + 1)
    return [np.concatenate([tile, after[: int(len(after) * SHARED)]]) for tile, after in zip(tiles, tiles[1:] + tiles[:1])]


def write(folder, tiles, kind):
    """Writes tiles as LAZ or NumPy files and returns their paths."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for number, tile in enumerate(tiles):
        path = folder / f"{number:04}.{'laz' if kind == 'LAZ' else 'npy'}"
        if kind == "LAZ":
            _write_laz(path, tile)
        else:
            np.save(path, tile)
        paths.append(path)
    return paths


def _write_laz(path, tile):
    import laspy

    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = [0.001] * 3, UTM
    las = laspy.LasData(header)
    las.x, las.y, las.z = tile.T
    las.write(path)
