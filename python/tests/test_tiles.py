"""Tiles give the answer of one cloud, wherever they are asked."""

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from hidden_point_removal import HprError, PointCloud, tiles
from hidden_point_removal.tiles import visible_from_tiles

EYES = [[100.0, 100.0, 1.7], [-50.0, -80.0, 60.0], [60.0, 100.0, 300.0], [10.0, 10.0, 0.0]]
OCTREE = Path(__file__).parents[2] / "tests" / "browser" / "fixtures" / "octree.copc.laz"


def town(count, seed=1):
    """Ground and the sides of houses on a square of 200 m."""
    random = np.random.default_rng(seed)
    ground = np.column_stack([random.uniform(0, 200, (count // 2, 2)), np.zeros(count // 2)])
    corners = np.random.default_rng(7).uniform(10, 180, (40, 2))[random.integers(0, 40, count - count // 2)]
    along, across = random.uniform(0, 9, len(corners)), random.choice([0.0, 9.0], len(corners))
    turned = random.random(len(corners)) < 0.5
    sides = np.column_stack([np.where(turned, along, across), np.where(turned, across, along)])
    walls = np.column_stack([corners + sides, random.uniform(0, 12, len(corners))])
    return np.concatenate([ground, walls])


def saved(folder, points, how="squares"):
    """The points in files, the middle of which share points with others."""
    random = np.random.default_rng(3).integers(0, 9, len(points))
    key = random if how == "random" else (points[:, 0] // 50).astype(int) * 9 + (points[:, 1] // 50).astype(int)
    parts = [points[key == number] for number in np.unique(key)]
    parts[3:3] = [np.concatenate([parts[0][::3], parts[1][::5]]), np.empty((0, 3), points.dtype)]
    for number, part in enumerate(parts):
        np.save(folder / f"{number:02}.npy", part)
    return sorted(folder.glob("*.npy")), PointCloud(np.concatenate(parts))


def same(answers, whole, eyes=EYES):
    assert len(answers) == len(eyes) and all(answer.dtype == np.uint64 for answer in answers)
    expected = [whole.visible_from(eye, **answers.options).indices for eye in eyes]
    return all(np.array_equal(*pair) for pair in zip(answers, expected, strict=True))


@pytest.mark.parametrize(("how", "dtype", "options"), [
    ("squares", np.float32, {}),
    ("random", np.float64, {}),
    ("random", np.float32, {"radius": np.float32(40_000)}),
    ("squares", np.float64, {"inversion": {"power": 1.01}, "radius": 1000.0}),
])
def test_tiles_answer_as_one_cloud(tmp_path, monkeypatch, how, dtype, options):
    monkeypatch.setattr(tiles, "CHUNK", 700)
    paths, whole = saved(tmp_path, town(8000).astype(dtype), how)
    told = []
    answers = visible_from_tiles(paths, np.array(EYES), on_progress=told.append, **options)
    assert same(answers, whole) and 0 < len(answers[0]) < 8000
    assert answers.options == (options or answers.options) and told[-1] == 1 and told == sorted(told)
    with ThreadPoolExecutor(2) as pool:
        for client in (pool, map):
            assert all(np.array_equal(*pair) for pair in zip(visible_from_tiles(paths, EYES, client, **options), answers))


def test_the_scale_is_that_of_the_cloud(tmp_path, monkeypatch):
    paths, whole = saved(tmp_path, town(30_000))
    scale = whole.visible_from(EYES[0], inversion={"exponential": "auto"}).inversion["exponential"]
    assert visible_from_tiles(paths, []).options["inversion"]["exponential"] == pytest.approx(scale, rel=1e-12)
    monkeypatch.setattr(tiles, "FEW", 10)
    assert visible_from_tiles(paths, []).options["inversion"]["exponential"] == pytest.approx(scale, rel=0.15)


def test_a_hidden_tile_is_read_once(tmp_path, monkeypatch):
    wall = np.random.default_rng(2).uniform([210, 0, 0], [210, 200, 80], (20_000, 3))
    behind = np.random.default_rng(1).uniform([400, 100, 0], [420, 120, 0.5], (2000, 3))
    for name, points in (("wall", wall), ("behind", behind)):
        np.save(tmp_path / f"{name}.npy", points)
    reads, load = [], np.load
    monkeypatch.setattr(np, "load", lambda path, **more: reads.append(path.stem) or load(path, **more))
    monkeypatch.setattr(tiles, "SHARE", 0.2)
    answers = visible_from_tiles([tmp_path / "behind.npy", tmp_path / "wall.npy"], [[205.0, 110.0, 1.0]], inversion={"exponential": 2.0})
    assert reads == ["behind", "wall", "wall"] and same(answers, PointCloud(np.concatenate([behind, wall])), [[205.0, 110.0, 1.0]])


def test_files_of_each_kind(tmp_path):
    laspy, parquet = pytest.importorskip("laspy"), pytest.importorskip("pyarrow.parquet")
    import pyarrow

    points = town(9000).astype(np.float32)
    np.save(tmp_path / "a.npy", points[:3000])
    parquet.write_table(pyarrow.table({axis: points[3000:6000, k] for k, axis in enumerate("xyz")}), tmp_path / "b.parquet")
    las = laspy.LasData(laspy.LasHeader(point_format=6, version="1.4"))
    las.header.scales, las.header.offsets = [0.001] * 3, [0.0] * 3
    las.x, las.y, las.z = points[6000:].T.astype(np.float64)
    las.write(tmp_path / "c.laz")
    paths = [*sorted(tmp_path.glob("*.*")), OCTREE]
    parts = [points[:6000], laspy.read(paths[2]).xyz, laspy.read(OCTREE).xyz]
    eyes = [EYES[2], [512345.0, 5403250.0, 431.6]]
    assert same(visible_from_tiles(paths, eyes), PointCloud(np.concatenate(parts)), eyes)
    for name, length in (("c.laz", 900), ("c.laz", 50), ("a.npy", 60), ("b.parquet", 2000)):
        broken = tmp_path / f"broken{Path(name).suffix}"
        broken.write_bytes((tmp_path / name).read_bytes()[:length])
        with pytest.raises(HprError, match="cannot be read") as refused:
            visible_from_tiles([broken], eyes)
        assert refused.value.code == "load"


def test_few_points(tmp_path):
    for points in (np.empty((0, 3)), np.ones((1, 3)), np.ones((4, 3), np.int16)):
        np.save(tmp_path / "a.npy", points)
        assert visible_from_tiles([tmp_path / "a.npy"], EYES[:1])[0].tolist() == list(range(len(points)))
    assert visible_from_tiles([], EYES[:1])[0].tolist() == [] and list(visible_from_tiles([tmp_path / "a.npy"], [])) == []


@pytest.mark.parametrize(("code", "words", "changes"), [
    *(("option", name, {name: 3}) for name in ("looks", "exponent", "within", "colour")),
    ("option", "radius", {"radius": "auto"}),
    ("option", "exponential", {"inversion": {"exponential": "auto"}}),
    ("radius", "radius", {"radius": 0.1}),
    ("option", "paths must be a list", {"paths": "a.npy"}),
    ("option", "paths must be a list", {"paths": Path("a.npy")}),
    ("viewpoint", "viewpoints must be a list", {"viewpoints": 5}),
    ("viewpoint", "3 finite numbers, got 0", {"viewpoints": [0, 0, 5]}),
    ("viewpoint", "3 finite numbers", {"viewpoints": [[0, 0, 5], [0, 0, np.nan]]}),
    ("option", "client", {"client": 7}),
    ("option", "tile.xyz", {"paths": ["tile.xyz"]}),
    ("load", "nowhere.npy", {"paths": ["nowhere.npy"]}),
    ("load", "nowhere.npy", {"paths": ["nowhere.npy"], "out": "seen"}),
    ("non-finite", "first at index 7", {"points": np.where(np.arange(30) == 22, np.nan, 1.0).reshape(10, 3)}),
    ("load", "shape", {"points": np.ones((3, 2))}),
    ("load", "complex", {"points": np.ones((3, 3), complex)}),
])
def test_bad_input_is_refused(tmp_path, monkeypatch, code, words, changes):
    monkeypatch.chdir(tmp_path)
    np.save("a.npy", changes.pop("points", town(10)))
    with pytest.raises(HprError, match=words) as refused:
        visible_from_tiles(**{"paths": ["a.npy"], "viewpoints": [[9.0, 9, 9]], **changes})
    assert refused.value.code == code, str(refused.value)


def test_what_is_done_is_not_done_again(tmp_path, monkeypatch):
    paths, whole = saved(tmp_path, town(6000))
    out, done = tmp_path / "out", len(paths) // 2

    def stop(share):
        if share > 0.75:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        visible_from_tiles(paths, EYES, on_progress=stop, out=out, radius=40_000.0)
    kept = sorted(out.iterdir(), key=os.path.getmtime)
    assert len(paths) < len(kept) < 2 * len(paths)
    # A file that was not written to its end is not trusted.
    kept[-1].write_bytes(kept[-1].read_bytes()[:100])
    reads, chunks = [], tiles.chunks
    monkeypatch.setattr(tiles, "chunks", lambda path: reads.append(path) or chunks(path))
    answers = visible_from_tiles(paths, EYES, out=out, radius=40_000.0)
    assert same(answers, whole) and 0 < len(reads) <= 2 * len(paths) - len(kept) + 1
    reads.clear()
    assert same(visible_from_tiles(paths, EYES, out=out, radius=40_000.0), whole) and reads == []
    # Nothing of another question, and nothing that another tile has hidden, is used.
    assert same(visible_from_tiles(paths, EYES[:2], out=out), whole, EYES[:2])
    np.save(paths[0], np.load(paths[0])[::2])
    again = PointCloud(np.concatenate([np.load(path) for path in paths]))
    assert same(visible_from_tiles(paths, EYES, out=out, radius=40_000.0), again) and done


def test_a_cluster_answers_alike_and_a_lost_one_ends(tmp_path, monkeypatch):
    distributed = pytest.importorskip("dask.distributed")
    paths, whole = saved(tmp_path, town(6000))
    monkeypatch.setattr(tiles, "PATIENCE", 2)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, distributed.Client(cluster) as client:
        pids = client.run(os.getpid)
        killed = threading.Timer(0.1, lambda: os.kill(next(iter(pids.values())), signal.SIGKILL))
        killed.start()
        assert same(visible_from_tiles(paths, EYES, client, out=tmp_path / "out"), whole)
        np.save(paths[-1], np.full((1, 3), np.nan))
        with pytest.raises(HprError, match="not finite") as refused:
            visible_from_tiles(paths, EYES[:1], client)
        assert refused.value.code == "non-finite"
        cluster.scale(0)
        while client.nthreads():
            time.sleep(0.05)
        started = time.monotonic()
        with pytest.raises(ConnectionError, match="the cluster is lost"):
            visible_from_tiles(paths[:1], EYES[:1], client)
        assert time.monotonic() - started < 60


def test_a_killed_process_goes_on(tmp_path):
    paths, whole = saved(tmp_path, town(40_000))
    # It ends when a result of the second round is written, and not yet in its place.
    code = f"""
        import os
        from pathlib import Path
        from hidden_point_removal.tiles import visible_from_tiles
        replace = os.replace
        def last(part, file):
            if len([*Path("out").glob("*.npz")]) == {len(paths) + 3}:
                os._exit(9)
            replace(part, file)
        os.replace = last
        visible_from_tiles({[*map(str, paths)]}, {EYES}, out="out", radius=4e4)
    """
    assert subprocess.run([sys.executable, "-c", textwrap.dedent(code)], cwd=tmp_path).returncode == 9
    assert same(visible_from_tiles(paths, EYES, out=tmp_path / "out", radius=4e4), whole)
