"""Exact visibility for clouds that are stored in many files, on one machine or on a Dask cluster."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import Horizon, PointCloud, merge_visible
from ._arguments import listed, place, refusal
from .types import MergeOptions, Unpack

KINDS = (".laz", ".las", ".parquet", ".npy")
#: So many points of a file are in memory at once.
CHUNK = 1_000_000
#: This share of all points makes the sample: for the scale not fewer than so many, for the horizon not more.
SHARE, FEW, MOST = 0.02, 10_000, 250_000
#: A cluster that has no worker for so many seconds is lost.
PATIENCE = 60
NOTHING = np.empty((0, 3), np.float32), np.empty(0, np.uint64)
Arrays = list[NDArray[Any]]


class Answers(list[NDArray[np.uint64]]):
    """The ids of the points that each viewpoint sees, ascending. One cloud that is asked with `options` answers alike."""

    def __init__(self, seen: Iterable[NDArray[np.uint64]], options: dict[str, Any]) -> None:
        super().__init__(seen)
        self.options = options


def visible_from_tiles(
    paths: Iterable[str | os.PathLike[str]],
    viewpoints: Iterable[ArrayLike],
    client: Any = None,
    on_progress: Callable[[float], object] | None = None,
    out: str | os.PathLike[str] | None = None,
    **options: Unpack[MergeOptions],
) -> Answers:
    """The points of all tiles that are visible from each viewpoint: a list of uint64 arrays, ascending.

    The answers are exactly those of one cloud of all points. The id of a point is its running number over the tiles.

    paths: list of files: LAS, LAZ, COPC, Parquet with the columns x, y and z, or NumPy arrays of shape (n, 3).
    viewpoints: list of 3 numbers each, or array of shape (m, 3).
    client: a `dask.distributed.Client`, whose workers can read the paths; or an executor, a pool, or any `map`.
    on_progress: is called with the share that is done. An exception in it ends the question.
    out: a folder. It gets two files for each tile: what is known of it, and what is left of it. A question that was ended
        goes on from them when it is asked again. What belongs to a tile that has changed since is not used.
    options: `radius` or `inversion`, as numbers. Without them the inversion is exponential. Its scale comes from the
        spacing of a sample of all tiles; `options` of the answer records it.

    Raises `HprError` with the code "option", "viewpoint", "radius", "non-finite", or "load" for a file that cannot be read;
    `ConnectionError` if the cluster is lost.
    """
    tiles = [Path(path) for path in listed(paths, "paths", "option")]
    eyes = [[*place(eye, f"viewpoints[{number}]")] for number, eye in enumerate(listed(viewpoints, "viewpoints"))]
    asked: dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    # What is wrong is refused before a tile is read.
    Horizon([0.0, 0.0, 0.0], **(asked or {"radius": 1.0}))

    def tell(before: int, done: int) -> None:
        if on_progress is not None:
            on_progress((before + done) / (2 * len(tiles)))

    files = _files(out, tiles, SHARE)
    known = _run(client, partial(tell, 0), _measured, [(*each, SHARE) for each in enumerate(tiles)], files)
    if not asked and sum(int(count) for count, _, _ in known) * SHARE < FEW:
        # So few points do not tell their spacing. A small cloud is its own sample.
        files = _files(out, tiles, 1.0)
        known = _run(client, lambda _: None, _measured, [(*each, 1.0) for each in enumerate(tiles)], files)
    counts = [int(count) for count, _, _ in known]
    sample = np.concatenate([NOTHING[0], *(sample for _, _, sample in known)])
    if not asked:
        asked = {"inversion": {"exponential": _scale(sample, sum(counts))}}
    sample = sample[np.random.default_rng(0).random(len(sample)) * len(sample) < MOST]
    horizons = [Horizon(eye, **asked) for eye in eyes]
    for horizon in horizons:
        horizon.add(sample)

    jobs = [(path, sum(counts[:number]), known[number][1]) for number, path in enumerate(tiles)]
    files = _files(out, tiles, eyes, asked, hashlib.sha256(repr(files).encode()).digest())
    del known, sample
    parts = _run(client, partial(tell, len(tiles)), _screened, jobs, files, eyes=eyes, options=asked, horizons=horizons)
    seen = [merge_visible([(part[2 * k], part[2 * k + 1]) for part in parts], eye, **asked) for k, eye in enumerate(eyes)]
    return Answers(seen, asked)


def _scale(sample: NDArray[Any], count: int) -> float:
    """The scale of the exponential inversion for so many points, of which the sample is a random part."""
    # Points of a surface lie apart as one over the root of their number.
    seen: Any = PointCloud(sample).visible_from([0.0, 0.0, 0.0], inversion={"exponential": "auto"})
    return float(seen.inversion["exponential"]) * (len(sample) / max(count, 1)) ** 0.5 or 1.0


# What is done for a tile. Each task depends on its arguments alone.


def _measured(job: tuple[int, Path, float]) -> Arrays:
    """The number of the points of a tile, their box, and a sample."""
    number, path, share = job
    random = np.random.default_rng(number)
    count, low, high, samples = 0, np.full(3, np.inf), np.full(3, -np.inf), [NOTHING[0]]
    for points in chunks(path):
        is_finite = np.isfinite(points).all(axis=1)
        if not is_finite.all():
            raise refusal("non-finite", f"{path} has points that are not finite, the first at index {count + is_finite.argmin()}")
        low = np.minimum(low, points.min(axis=0, initial=np.inf))
        high = np.maximum(high, points.max(axis=0, initial=-np.inf))
        samples.append(points[random.random(len(points)) < share])
        count += len(points)
    return [np.array(count), np.array([low, high]), np.concatenate(samples)]


def _screened(job: tuple[Path, int, NDArray[Any]], eyes: list[Any], options: dict[str, Any], horizons: list[Horizon]) -> Arrays:
    """The points of a tile that neither the horizon nor the tile hides, and their ids, for one viewpoint after another."""
    path, first, (low, high) = job
    found = [[NOTHING] for _ in eyes]
    # A tile whose box is hidden is not read.
    wanted = [k for k, horizon in enumerate(horizons) if low[0] <= high[0] and not horizon.hides_box(low, high)]
    for points in chunks(path) if wanted else ():
        for k in wanted:
            left = horizons[k].screen(points)
            left = left[PointCloud(points[left]).visible_from(eyes[k], **options).indices]
            found[k].append((points[left], left + np.uint64(first)))
        first += len(points)
    return [np.concatenate(column) for parts in found for column in zip(*parts)]


def chunks(path: Path) -> Iterator[NDArray[Any]]:
    """The positions in a file, float32 or float64, one part after another."""
    kind = path.suffix.lower()
    if kind not in KINDS:
        raise refusal("option", f"{path}: tiles must be {', '.join(KINDS)} files")
    try:
        for points in _read(path, kind):
            if points.shape[1:] != (3,) or points.dtype.kind not in "fiu":
                raise ValueError(f"it holds {points.dtype} of the shape {points.shape}, not numbers of the shape (n, 3)")
            yield np.ascontiguousarray(points, np.float32 if points.dtype == np.float32 else np.float64)
    except ImportError as missing:
        raise ImportError(f"{path}: {missing}; install hidden-point-removal[tiles]") from missing
    except Exception as problem:  # Each library has its own.
        raise refusal("load", f"{path} cannot be read: {problem}") from problem


def _read(path: Path, kind: str) -> Iterator[NDArray[Any]]:
    if kind == ".npy":
        points = np.load(path, mmap_mode="r", allow_pickle=False)
        # Copied: a file that changes during a view would change the points under it.
        yield from (np.array(points[start : start + CHUNK]) for start in range(0, max(len(points), 1), CHUNK))
    elif kind == ".parquet":
        from pyarrow.parquet import ParquetFile

        with ParquetFile(path) as file:
            for rows in file.iter_batches(CHUNK, columns=["x", "y", "z"]):
                yield np.stack([rows.column(axis).to_numpy(zero_copy_only=False) for axis in "xyz"], axis=1)
    else:
        import laspy

        with laspy.open(path) as file:
            for rows in file.chunk_iterator(CHUNK):
                yield np.stack([np.asarray(axis) for axis in (rows.x, rows.y, rows.z)], axis=1)


def _run(client: Any, tell: Any, task: Any, jobs: list[Any], files: list[Path | None], **shared: Any) -> list[Arrays]:
    """The results of a task for each job, from the files of an earlier run or from the client."""
    results = {number: kept for number, file in enumerate(files) if file is not None and (kept := _load(file))}
    missing = [number for number in range(len(jobs)) if number not in results]
    if results:
        tell(len(results))
    for number, result in zip(missing, _mapped(client, task, [jobs[number] for number in missing], shared)):
        results[number] = result
        file = files[number]
        if file is not None:
            # Under another name first, so that a file is whole or missing.
            started = file.with_name(f"{file.name}.{os.getpid()}.part")
            with open(started, "wb") as stream:
                np.savez(stream, *result)
            os.replace(started, file)
        tell(len(results))
    return [results[number] for number in range(len(jobs))]


def _mapped(client: Any, task: Any, jobs: list[Any], shared: dict[str, Any]) -> Iterable[Arrays]:
    """The results, in order, as they come."""
    if hasattr(client, "scatter") and hasattr(client, "gather"):
        return _on_dask(client, task, jobs, shared)
    spread = map if client is None else getattr(client, "map", client)
    if not callable(spread):
        raise refusal("option", f"client must be a dask.distributed.Client or have a map, got {client!r:.60}")
    return spread(partial(task, **shared), jobs)


def _on_dask(client: Any, task: Any, jobs: list[Any], shared: dict[str, Any]) -> Iterator[Arrays]:
    from dask.distributed import CancelledError, TimeoutError, wait

    wait_for: Any = wait
    held = {name: client.scatter([value], hash=False)[0] for name, value in shared.items()}
    idle = 0
    try:
        futures = client.map(task, jobs, pure=False, **held)[::-1]
        while futures:
            # What has been told is not held any more.
            future = futures.pop()
            while not future.done():
                try:
                    wait_for([future], timeout=1)
                except TimeoutError:
                    idle = 0 if client.status == "running" and client.nthreads() else idle + 1
                if idle > PATIENCE:
                    raise ConnectionError(f"it has had no worker for {PATIENCE} s")
            yield future.result()
    except (CancelledError, ConnectionError) as lost:
        raise ConnectionError(f"the cluster is lost: {lost}. What is in `out` is kept") from lost


def _files(out: str | os.PathLike[str] | None, tiles: list[Path], *key: Any) -> list[Path | None]:
    """The files of the results of tiles. Their names change with all that they depend on."""
    if out is None:
        return [None] * len(tiles)
    Path(out).mkdir(parents=True, exist_ok=True)
    files: list[Path | None] = []
    for number, tile in enumerate(tiles):
        # A file that is missing is refused where it is read.
        status = tile.stat() if tile.exists() else None
        text = repr((number, tile.resolve(), status and (status.st_size, status.st_mtime_ns), *key))
        files.append(Path(out) / f"{tile.stem}.{hashlib.sha256(text.encode()).hexdigest()[:16]}.npz")
    return files


def _load(file: Path) -> Arrays | None:
    try:
        with np.load(file, allow_pickle=False) as stored:
            return [*stored.values()]
    except Exception:  # It is missing or damaged.
        return None
