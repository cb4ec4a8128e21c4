"""The whole question: which points of all tiles are visible from each viewpoint?"""

from __future__ import annotations

import numpy as np

from hidden_point_removal import Horizon

from . import kernels
from .engines import engine_for
from .manifest import cached_facts
from .tiles import refuse

#: A merge takes parts with about this many points together.
MERGED_POINTS = 20_000_000
#: Options that one hull of the whole cloud can answer part by part.
MERGEABLE = ("radius", "inversion")


class Answers(list):
    """The visible ids for each viewpoint: uint64, ascending.

    `options` are the numbers that were used. The whole cloud asked with them gives the same answer.
    `skipped` is the number of tiles, for each viewpoint, that were not needed because their box is hidden.
    `survivors` is the number of points, for each viewpoint, that were merged.
    """

    def __init__(self, answers, options, skipped, survivors):
        super().__init__(answers)
        self.options = options
        self.skipped = skipped
        self.survivors = survivors


def visible_from_tiles(tiles, viewpoints, client=None, *, share=0.02, cache=True, progress=None, **options):
    """The ids of the points of all tiles that are visible from each viewpoint: a list of uint64 arrays, ascending.

    The id of a point is its running number over the tiles in the order given. The answers are exactly those of one
    cloud with all points.

    tiles: arrays of shape (n, 3), functions that return one, or paths of LAS, LAZ, COPC, Parquet or NumPy files.
    client: a `dask.distributed.Client`. Without one, this process does the work.
    share: the share of the points that makes the horizon.
    cache: whether the facts of files are kept beside them, in `.hpr-manifest`.
    progress: is called with (stage, done, all) after each task.
    options: `radius` or `inversion`, as numbers. Without them the inversion is exponential, and its scale comes from
    the spacing of all tiles. `Answers.options` records it.

    Raises `HprError`: `option` for other options, and the codes of `PointCloud` for bad tiles and viewpoints.
    """
    given = {name: value for name, value in options.items() if value is not None}
    for name in given:
        if name not in MERGEABLE:
            refuse("option", f"{name} cannot be combined with tiles; the options are {', '.join(MERGEABLE)}")
    tiles = list(tiles)
    viewpoints = [_place(viewpoint) for viewpoint in viewpoints]
    if not 0 < share <= 1:
        refuse("option", f"share must be above 0 and at most 1, got {share}")
    if given:
        _check(viewpoints, given)
    with engine_for(client) as engine:
        return _answers(engine, tiles, viewpoints, given, share, cache, progress)


def _answers(engine, tiles, viewpoints, options, share, cache, progress):
    facts = cached_facts(engine, tiles, share, cache, progress)
    if not options:
        options = {"inversion": kernels.automatic_inversion(_spacing(engine, tiles, facts, progress))}
        _check(viewpoints, options)
    samples = [fact.sample for fact in facts if len(fact.sample) > 0]
    horizons = engine.map(
        kernels.horizon_points,
        [(viewpoint, options, samples) for viewpoint in viewpoints],
        "horizon",
        progress,
        keep=True,
    )
    first_ids = np.concatenate([[0], np.cumsum([fact.count for fact in facts])]).tolist()
    asked = [
        (tile, first, fact.box, viewpoints, horizons, options)
        for tile, first, fact in zip(tiles, first_ids, facts, strict=False)
    ]
    screened = engine.map(kernels.screen, asked, "screen", progress, keep=True)
    skipped, survivors, answers = [], [], []
    sizes = engine.map(_sizes, [(parts,) for parts in screened], "count", None)
    for number, viewpoint in enumerate(viewpoints):
        own = [size[number] for size in sizes]
        skipped.append(sum(is_skipped for _, is_skipped in own))
        survivors.append(sum(count for count, _ in own))
        parts = engine.map(_pick, [(parts, number) for parts in screened], "pick", None, keep=True)
        answers.append(_reduce(engine, parts, [count for count, _ in own], viewpoint, options, progress))
    return Answers(answers, options, skipped, survivors)


def _reduce(engine, parts, sizes, viewpoint, options, progress):
    """Merges parts in a tree until one is left."""
    while len(parts) > 1:
        groups = _groups(sizes)
        merged = engine.map(
            _merge, [([parts[k] for k in group], viewpoint, options) for group in groups], "merge", progress, keep=True
        )
        sizes = [count for (count, _), in engine.map(_sizes, [([part],) for part in merged], "count", None)]
        parts = merged
    return engine.result(parts[0]).ids if parts else np.empty(0, np.uint64)


def _groups(sizes):
    """Runs of parts that are merged together: at least two, and not more points than fit in one merge."""
    groups, points = [[]], 0
    for number, size in enumerate(sizes):
        if len(groups[-1]) >= 2 and points + size > MERGED_POINTS:
            groups.append([])
            points = 0
        groups[-1].append(number)
        points += size
    return groups


def _merge(parts, viewpoint, options):
    return kernels.merge(parts, viewpoint, options)


def _sizes(parts):
    return [(len(part.ids), part.skipped) for part in parts]


def _pick(parts, number):
    return parts[number]


def _spacing(engine, tiles, facts, progress):
    queries = [fact.queries for fact in facts if len(fact.queries) > 0]
    if not queries:
        return 0.0
    queries = kernels.smallest(np.concatenate(queries), kernels.QUERIES)
    shares = engine.map(kernels.neighbors, [(tile, queries) for tile in tiles], "spacing", progress)
    return kernels.spacing(queries, shares)


def _place(viewpoint):
    numbers = np.asarray(viewpoint, np.float64)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        refuse("viewpoint", f"each viewpoint must be 3 finite numbers, got {viewpoint!r}")
    return tuple(numbers.tolist())


def _check(viewpoints, options):
    """Refuses options before any tile is read."""
    Horizon(viewpoints[0] if viewpoints else (0.0, 0.0, 0.0), **options)

