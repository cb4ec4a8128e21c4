"""The whole question: which points of all tiles are visible from each viewpoint?"""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np

from hidden_point_removal import Horizon

from . import kernels, manifest, statistics
from .copc import is_copc, nodes_of
from .engines import engine_for, tree
from .manifest import digest_of, file_of, identity
from .sectors import visible_in_sectors
from .tiles import refuse, tiles_of
from .waves import waves_of

#: A merge takes parts with about this many points together.
MERGED_POINTS = 20_000_000
#: A horizon is made of at most about this many points of the samples, and of as many of each wave of tiles.
HORIZON_POINTS = 250_000
#: Options that one hull of the whole cloud can answer part by part.
MERGEABLE = ("radius", "inversion")


class Answers(list):
    """The visible ids for each viewpoint: uint64, ascending.

    `options` are the numbers that were used. The whole cloud asked with them gives the same answer.
    `skipped` is the number of tiles, for each viewpoint, that were not needed because their box is hidden.
    `survivors` is the number of points, for each viewpoint, that were merged.
    `skipped_tiles` are the numbers of these tiles, for each viewpoint.
    `tiles` is the number of tiles. Each node of a COPC file is one.
    `sectors` tells for each viewpoint how many points each sector had; empty lists where one merge was enough.
    """

    def __init__(self, answers, options, tiles, skipped_tiles, survivors, sectors):
        super().__init__(answers)
        self.tiles = tiles
        self.sectors = sectors
        self.options = options
        self.skipped_tiles = skipped_tiles
        self.skipped = [len(tiles) for tiles in skipped_tiles]
        self.survivors = survivors


def visible_from_tiles(tiles, viewpoints, client=None, *, share=0.02, cache=True, work=None, progress=None, **options):
    """The ids of the points of all tiles that are visible from each viewpoint: a list of uint64 arrays, ascending.

    The id of a point is its running number over the tiles in the order given. The answers are exactly those of one
    cloud with all points.

    tiles: arrays of shape (n, 3), functions that return one, or paths of LAS, LAZ, COPC, Parquet or NumPy files. Each
    node of a COPC file is a tile of its own; its points keep their order in the file. Or one `dask.array` of shape (n, 3),
    whose chunks are the tiles.
    client: a `dask.distributed.Client`. Without one, this process does the work.
    share: the share of the points that is kept in the manifest and makes the first horizon.
    cache: whether the facts of files are kept beside them, in `.hpr-manifest`.
    work: a folder for the points that are left of finished tiles. The same question asked again after it was ended
    goes on from there. The tiles must be files. What is kept is deleted when the answers are complete.
    progress: is called with (stage, done, all) after each task.
    options: `radius` or `inversion`, as numbers. Without them the inversion is exponential, and its scale comes from
    the spacing of all tiles. `Answers.options` records it.

    Raises `HprError`: `option` for other options, `load` for a broken LAS, LAZ or COPC file, and the codes of `PointCloud` for
    bad tiles and viewpoints.
    """
    given = {name: _plain(value) for name, value in options.items() if value is not None}
    for name in given:
        if name not in MERGEABLE:
            refuse("option", f"{name} cannot be combined with tiles; the options are {', '.join(MERGEABLE)}")
    tiles = tiles_of(tiles)
    viewpoints = [_place(viewpoint) for viewpoint in viewpoints]
    if isinstance(share, bool) or not isinstance(share, (int, float)) or not 0 < share <= 1:
        refuse("option", f"share must be above 0 and at most 1, got {share!r}")
    if work is not None and any(identity(tile) is None for tile in tiles):
        refuse("option", "work needs tiles in files; arrays and functions cannot be recognized later")
    if given:
        _check(viewpoints, given)
    with engine_for(client) as engine:
        return _Question(engine, tiles, share, cache, progress).answers(viewpoints, given, work)


class _Question:
    def __init__(self, engine, tiles, share, cache, progress):
        self._engine = engine
        self._cache = cache
        self._progress = progress
        self._tiles = self._nodes(tiles)
        # The samples stay where they were made. Only counts and boxes come here.
        self._facts = self._map(manifest.facts, [(tile, share, cache) for tile in self._tiles], "measure", keep=True)
        known = self._map(manifest.summary, [(fact,) for fact in self._facts], None)
        self._boxes = [box for _, box, _ in known]
        counts = [count for count, _, _ in known]
        self._first_ids = [0, *np.cumsum(counts, dtype=np.uint64).tolist()]
        self._sampled = sum(size for _, _, size in known)
        self._share = share

    def answers(self, viewpoints, options, work):
        if not options:
            options = {"inversion": statistics.automatic_inversion(self._spacing())}
            _check(viewpoints, options)
        job = None if work is None else self._job(Path(work), viewpoints, options)
        screened = self._screened(viewpoints, options, job)
        sizes = self._map(_sizes, [(parts,) for parts in screened], None)
        skipped = [[tile for tile, own in enumerate(sizes) if own[number][1]] for number in range(len(viewpoints))]
        survivors = [sum(own[number][0] for own in sizes) for number in range(len(viewpoints))]
        answers, sectors = [], []
        for number, viewpoint in enumerate(viewpoints):
            parts = self._map(_pick, [(parts, number) for parts in screened], None, keep=True)
            ids, own = self._reduce(parts, [own[number][0] for own in sizes], number, viewpoint, options)
            answers.append(ids)
            sectors.append(own)
        if job is not None:
            shutil.rmtree(job, ignore_errors=True)
        return Answers(answers, options, len(self._tiles), skipped, survivors, sectors)

    def _nodes(self, tiles):
        """The tiles. The nodes of a COPC file take its place."""
        files = [number for number, tile in enumerate(tiles) if is_copc(tile)]
        listed = dict(zip(files, self._map(nodes_of, [(tiles[number],) for number in files], None), strict=True))
        return [each for number, tile in enumerate(tiles) for each in listed.get(number, [tile])]

    def _map(self, kernel, calls, stage, keep=False):
        return self._engine.map(kernel, calls, stage, self._progress if stage else None, keep=keep)

    def _thinned(self, most):
        """The samples, thinned to about `most` points together."""
        share = self._share * min(1.0, most / max(1, self._sampled))
        return self._map(manifest.thinned, [(fact, share) for fact in self._facts], None, keep=True)

    def _screened(self, viewpoints, options, job):
        """What is left of each tile, in the order of the tiles: a list of `Part`, one for each viewpoint."""
        if not viewpoints:
            return []
        samples = self._thinned(HORIZON_POINTS)
        horizons = [
            tree(self._engine, kernels.horizon_points, (viewpoint, options), samples, "horizon", self._progress)
            for viewpoint in viewpoints
        ]
        waves = waves_of(self._boxes, viewpoints)
        screened = [None] * len(self._tiles)
        done = 0
        for wave in waves:
            calls = [
                (
                    self._tiles[tile],
                    self._first_ids[tile],
                    self._boxes[tile],
                    viewpoints,
                    horizons,
                    options,
                    None if job is None else str(job / f"{tile}.npz"),
                )
                for tile in wave
            ]
            own = self._engine.map(kernels.screen, calls, "screen", self._from(done), keep=True)
            for tile, parts in zip(wave, own, strict=True):
                screened[tile] = parts
            done += len(wave)
            if done < len(self._tiles):
                horizons = self._grown(viewpoints, options, horizons, own)
        self._horizons = horizons
        return screened

    def _grown(self, viewpoints, options, horizons, screened):
        """The horizons together with what a wave of tiles left."""
        most = max(1, HORIZON_POINTS // len(screened))
        grown = []
        for number, viewpoint in enumerate(viewpoints):
            left = self._map(kernels.some_of, [(parts, number, most) for parts in screened], None, keep=True)
            given = [horizons[number], *left]
            grown.append(tree(self._engine, kernels.horizon_points, (viewpoint, options), given, None, None))
        return grown

    def _from(self, done):
        """The progress of a wave as progress of all tiles."""
        if self._progress is None:
            return None
        return lambda stage, number, _: self._progress(stage, done + number, len(self._tiles))

    def _reduce(self, parts, sizes, number, viewpoint, options):
        """The visible ids of all parts, and a report of each sector if there are too many points for one merge."""
        while len(parts) > 1:
            groups = _groups(sizes)
            if len(groups) == len(parts):
                horizon = self._horizons[number]
                return visible_in_sectors(self._engine, parts, sum(sizes), horizon, viewpoint, options, self._progress)
            calls = [([parts[k] for k in group], viewpoint, options) for group in groups if len(group) > 1]
            merged = iter(self._map(kernels.merge, calls, "merge", keep=True))
            parts = [parts[group[0]] if len(group) == 1 else next(merged) for group in groups]
            sizes = self._map(_size, [(part,) for part in parts], None)
        return (self._engine.result(parts[0]).ids if parts else np.empty(0, np.uint64)), []

    def _spacing(self):
        queries = self._engine.result(
            tree(self._engine, statistics.smallest, (), self._thinned(16 * statistics.QUERIES), None, None)
        )
        if len(queries) < statistics.QUERIES:
            # A small cloud: the samples do not hold enough points, and reading it whole is cheap.
            every = self._map(manifest.measure, [(tile, 1.0) for tile in self._tiles], "spacing", keep=True)
            samples = self._map(manifest.thinned, [(fact, 1.0) for fact in every], None, keep=True)
            queries = self._engine.result(tree(self._engine, statistics.smallest, (), samples, None, None))
        if len(queries) == 0:
            return 0.0
        stored = self._spacing_file(queries)
        known = None if stored is None else manifest.load_arrays(stored)
        if known is not None and "spacing" in known:
            return float(known["spacing"])
        # The samples bound how far the nearest points can be. So most tiles are asked for few queries.
        sample = tree(self._engine, statistics.joined, (), self._thinned(HORIZON_POINTS), None, None)
        reach = self._engine.result(self._map(statistics.reaches, [(queries, sample)], None, keep=True)[0])
        calls = []
        for tile, box in zip(self._tiles, self._boxes, strict=True):
            wanted = [] if box is None else statistics.touching(box, queries, reach)
            if len(wanted) > 0:
                calls.append((tile, queries, wanted))
        shares = self._map(kernels.neighbors, calls, "spacing", keep=True)
        _, found = self._engine.result(tree(self._engine, statistics.nearer, (queries,), shares, None, None))
        spacing = statistics.spacing(queries, found)
        if stored is not None:
            try:
                manifest.save_arrays(stored, spacing=spacing)
            except OSError:
                pass
        return spacing

    def _spacing_file(self, queries):
        """Where the spacing is kept, beside the facts of the first tile."""
        known = [identity(tile) for tile in self._tiles]
        if not self._cache or not known or None in known:
            return None
        folder = file_of(self._tiles[0]).parent / manifest.FOLDER
        name = digest_of(str(manifest.VERSION), *sorted(known), queries.tobytes().hex())
        return folder / f"spacing.{name}.npz" if folder.is_dir() else None

    def _job(self, work, viewpoints, options):
        """The folder of this question. What is left of a tile depends on all tiles, viewpoints and options."""
        files = [f"{file_of(tile).resolve()} {identity(tile)}" for tile in self._tiles]
        return work / digest_of(str(manifest.VERSION), *files, json.dumps([viewpoints, options], sort_keys=True))


def _groups(sizes):
    """Runs of parts that are merged together: not more points than fit in one merge."""
    groups, points = [[]], 0
    for number, size in enumerate(sizes):
        if groups[-1] and points + size > MERGED_POINTS:
            groups.append([])
            points = 0
        groups[-1].append(number)
        points += size
    return groups


def _sizes(parts):
    return [(len(part.ids), part.skipped) for part in parts]


def _size(part):
    return len(part.ids)


def _pick(parts, number):
    return parts[number]


def _plain(value):
    """NumPy numbers as Python's, so that an option can be written as text."""
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, dict):
        return {name: _plain(entry) for name, entry in value.items()}
    return value


def _place(viewpoint):
    numbers = np.asarray(viewpoint, np.float64)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        refuse("viewpoint", f"each viewpoint must be 3 finite numbers, got {viewpoint!r}")
    return tuple(numbers.tolist())


def _check(viewpoints, options):
    """Refuses options before any tile is read."""
    Horizon(viewpoints[0] if viewpoints else (0.0, 0.0, 0.0), **options)
