"""Tiles give the answer of one cloud, on any engine."""

import json
import os
import subprocess
import sys
import threading

import numpy as np
import pytest

pytest.importorskip("scipy", reason="the distributed extra is not installed")

from hidden_point_removal import HprError, PointCloud
from hidden_point_removal.distributed import kernels, read_tile, statistics, visible_from_tiles, write_parquet
from hidden_point_removal.distributed.waves import waves_of


def town(count, seed=1, offset=(0.0, 0.0, 0.0)):
    """Ground and the sides of houses on a square of 200 m."""
    random = np.random.default_rng(seed)
    ground = np.column_stack([random.uniform(0, 200, (count // 2, 2)), np.zeros(count // 2)])
    house = random.integers(0, 40, count - count // 2)
    corners = np.random.default_rng(7).uniform(10, 180, (40, 2))
    side = random.integers(0, 4, len(house))
    along = random.uniform(0, 9, len(house))
    x = np.choose(side, [along, along, np.zeros_like(along), np.full_like(along, 9)])
    y = np.choose(side, [np.zeros_like(along), np.full_like(along, 9), along, along])
    walls = np.column_stack([corners[house] + np.column_stack([x, y]), random.uniform(0, 12, len(house))])
    return np.concatenate([ground, walls]) + offset


VIEWPOINTS = [[100.0, 100.0, 1.7], [-50.0, -80.0, 60.0], [60.0, 100.0, 300.0], [10.0, 10.0, 0.0]]


def cut(points, how, seed=3):
    if how == "squares":
        key = (points[:, 0] // 50).astype(int) * 100 + (points[:, 1] // 50).astype(int)
    else:
        key = np.random.default_rng(seed).integers(0, 9, len(points))
    order = np.argsort(key, kind="stable")
    bounds = np.flatnonzero(np.diff(key[order])) + 1
    return np.split(points[order], bounds)


def test_chunks_of_dask_arrays_are_tiles():
    arrays = pytest.importorskip("dask.array")
    points = town(5000)
    lazy = arrays.from_array(points, chunks=(1700, 2))
    answers = visible_from_tiles(lazy, VIEWPOINTS[:2])
    for one, other in zip(answers, visible_from_tiles(np.array_split(points, 4), VIEWPOINTS[:2])):
        assert np.array_equal(one, other)
    with pytest.raises(HprError, match=r"shape \(n, 3\)") as refusal:
        visible_from_tiles(lazy[:, :2], VIEWPOINTS)
    assert refusal.value.code == "positions-length"


@pytest.fixture(autouse=True)
def few_queries(monkeypatch):
    """The spacing of a small cloud needs fewer queries. All of them take 3 s, however few points there are."""
    monkeypatch.setattr(statistics, "QUERIES", 800)
    monkeypatch.setattr(statistics.smallest, "__defaults__", (800,))


#: Each cut, each precision and each flip at least once.
CASES = pytest.mark.parametrize(
    ("how", "dtype", "options"),
    [
        ("squares", np.float32, {}),
        ("random", np.float64, {}),
        ("random", np.float32, {"radius": 40_000.0}),
        ("squares", np.float64, {"inversion": {"power": 1.01}, "radius": 1000.0}),
    ],
)


@CASES
def test_tiles_answer_as_one_cloud(how, dtype, options):
    tiles = cut(town(8000).astype(dtype), how)
    whole = PointCloud(np.concatenate(tiles))
    answers = visible_from_tiles(tiles, VIEWPOINTS, **options)
    assert len(answers) == len(VIEWPOINTS)
    for viewpoint, answer in zip(VIEWPOINTS, answers, strict=True):
        assert answer.dtype == np.uint64
        expected = whole.visible_from(viewpoint, **answers.options).indices
        assert np.array_equal(answer, expected)


def test_far_coordinates_and_points_in_several_tiles():
    points = town(8000, offset=(636_000.0, 849_000.0, 400.0))
    tiles = [points[:5000], np.empty((0, 3)), points[3000:], points[:1]]
    viewpoint = [636_100.0, 849_100.0, 401.7]
    answers = visible_from_tiles(tiles, [viewpoint])
    whole = PointCloud(np.concatenate(tiles))
    assert np.array_equal(answers[0], whole.visible_from(viewpoint, **answers.options).indices)


def test_the_scale_is_the_same_for_every_cut():
    points = town(10_000)
    scales = {
        visible_from_tiles(cut(points, how, seed), [])
        .options["inversion"]["exponential"]
        for how, seed in (("squares", 0), ("random", 1), ("random", 2))
    }
    whole = PointCloud(points).visible_from(VIEWPOINTS[0], inversion={"exponential": "auto"})
    assert max(scales) - min(scales) < 1e-12 * max(scales)
    assert max(scales) == pytest.approx(whole.inversion["exponential"], rel=0.05)


def test_hidden_tiles_are_not_read():
    points = town(40_000)
    reads = []

    def tile(number, own):
        def read():
            reads.append(number)
            return own

        return read

    behind = np.random.default_rng(1).uniform([400, 400, 0], [420, 420, 0.5], (2000, 3))
    wall = np.random.default_rng(2).uniform([210, 100, 0], [210, 700, 80], (20_000, 3))
    tiles = [tile(0, points), tile(1, wall), tile(2, behind)]
    answers = visible_from_tiles(tiles, [[205.0, 150.0, 1.0]], inversion={"exponential": 2.0}, share=0.2)
    assert answers.skipped == [1]
    assert reads.count(2) == 1, "only when it is measured"
    assert len(answers[0]) > 0 and answers[0].max() < 60_000


def test_empty_input():
    assert visible_from_tiles([], VIEWPOINTS[:1])[0].tolist() == []
    assert visible_from_tiles([np.empty((0, 3))], VIEWPOINTS[:1])[0].tolist() == []
    assert list(visible_from_tiles([town(10)], [])) == []
    assert visible_from_tiles([np.ones((1, 3))], VIEWPOINTS[:1])[0].tolist() == [0]


@pytest.mark.parametrize("name", ["looks", "draft", "sample", "denoise", "vote", "exponent", "colour"])
def test_other_options_are_refused(name):
    with pytest.raises(HprError) as refused:
        visible_from_tiles([town(10)], VIEWPOINTS, **{name: 3})
    assert refused.value.code == "option" and name in str(refused.value)


@pytest.mark.parametrize(
    ("code", "tiles", "viewpoints", "options"),
    [
        ("option", [town(10)], VIEWPOINTS, {"radius": "search"}),
        ("option", [town(10)], VIEWPOINTS, {"radius": "opposite"}),
        ("option", [town(10)], VIEWPOINTS, {"inversion": {"exponential": "auto"}}),
        ("radius", [town(10)], VIEWPOINTS, {"radius": 3.0}),
        ("viewpoint", [town(10)], [[0.0, 0.0]], {}),
        ("viewpoint", [town(10)], [[0.0, 0.0, np.nan]], {}),
        ("non-finite", [town(10), np.full((2, 3), np.nan)], VIEWPOINTS, {}),
        ("positions-length", [np.zeros((3, 2))], VIEWPOINTS, {}),
        ("positions-type", [np.zeros((3, 3), complex)], VIEWPOINTS, {}),
        ("option", ["tile.xyz"], VIEWPOINTS, {}),
        ("option", [town(10)], VIEWPOINTS, {"share": 0.0}),
        ("option", [town(10)], VIEWPOINTS, {"client": 7}),
    ],
)
def test_bad_input_is_refused(code, tiles, viewpoints, options):
    with pytest.raises(HprError) as refused:
        visible_from_tiles(tiles, viewpoints, **options)
    assert refused.value.code == code, str(refused.value)


def test_files_and_their_cache(tmp_path):
    laspy = pytest.importorskip("laspy")
    parquet = pytest.importorskip("pyarrow.parquet")
    import pyarrow

    points = town(9000).astype(np.float32)
    np.save(tmp_path / "a.npy", points[:3000])
    table = pyarrow.table({axis: points[3000:6000, k] for k, axis in enumerate("xyz")})
    parquet.write_table(table, tmp_path / "b.parquet")
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales = [0.001] * 3
    las = laspy.LasData(header)
    las.x, las.y, las.z = points[6000:].T.astype(np.float64)
    las.write(tmp_path / "c.laz")
    cameras = tmp_path / "cameras.csv"
    cameras.write_text("name,x,y,z\nstreet,100,100,1.7\nabove,60,100,300\n")
    command = [sys.executable, "-m", "hidden_point_removal.command", str(tmp_path), "--from", str(cameras)]
    for output in ("first", "second"):
        subprocess.run([*command, "-o", str(tmp_path / output), "--laz"], check=True, capture_output=True)
    kept = os.listdir(tmp_path / ".hpr-manifest")
    assert len(kept) == 4, "three tiles and the spacing"
    first = parquet.read_table(tmp_path / "first" / "visible.parquet")
    assert first.equals(parquet.read_table(tmp_path / "second" / "visible.parquet"))
    report = json.loads((tmp_path / "first" / "report.json").read_text())
    tiles = [read_tile(tmp_path / name) for name in report["tiles"]]
    whole = PointCloud(np.concatenate([tile.astype(np.float64) for tile in tiles]))
    for number, viewpoint in enumerate(report["viewpoints"]):
        seen = first["id"].to_numpy()[first[f"seen_{number}"].to_numpy()]
        assert np.array_equal(seen, whole.visible_from(viewpoint, **report["options"]).indices)
    copied = laspy.read(tmp_path / "first" / "c.laz")
    bits = np.asarray(copied["visible"])
    for number in range(2):
        seen = first["id"].to_numpy()[first[f"seen_{number}"].to_numpy()]
        assert np.array_equal(np.flatnonzero(bits >> number & 1), seen[seen >= 6000].astype(int) - 6000)


def test_a_bad_command_says_why(tmp_path):
    run = lambda *words: subprocess.run(  # noqa: E731
        [sys.executable, "-m", "hidden_point_removal.command", *words], capture_output=True, text=True
    )
    missing = run(str(tmp_path), "--from", str(tmp_path / "none.csv"), "-o", str(tmp_path / "out"))
    assert missing.returncode != 0 and "no tiles" in missing.stderr
    np.save(tmp_path / "a.npy", town(10))
    (tmp_path / "bad.csv").write_text("x,y,z\n1,2,th\x1b[2Jree\n")
    bad = run(str(tmp_path), "--from", str(tmp_path / "bad.csv"), "-o", str(tmp_path / "out"))
    assert bad.returncode != 0 and "row 1" in bad.stderr and "\x1b" not in bad.stderr


def test_a_cluster_answers_alike(tmp_path):
    distributed = pytest.importorskip("dask.distributed")
    tiles = cut(town(12_000), "squares")
    alone = visible_from_tiles(tiles, VIEWPOINTS[:2])
    stages = []
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        together = visible_from_tiles(
            tiles, VIEWPOINTS[:2], client=client, progress=lambda stage, done, every: stages.append(stage)
        )
        assert together.options == alone.options
        assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))
        assert {"measure", "spacing", "horizon", "screen", "merge"} <= set(stages)
        with pytest.raises(HprError) as refused:
            visible_from_tiles([np.full((1, 3), np.nan)], VIEWPOINTS[:1], client=client)
        assert refused.value.code == "non-finite"


def test_hashes_do_not_depend_on_the_precision_or_the_sign_of_zero():
    points = np.array([[0.0, 1.5, -2.0], [-0.0, 1.5, -2.0]])
    assert len(set(statistics.hashes(points).tolist())) == 1
    assert np.array_equal(statistics.hashes(points.astype(np.float32)), statistics.hashes(points))


def test_a_parquet_of_no_answers(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    write_parquet(tmp_path / "none.parquet", [])
    assert parquet.read_table(tmp_path / "none.parquet").num_rows == 0


def test_the_spacing_needs_no_sample():
    points = np.concatenate([town(1500), town(1500)])
    expected = visible_from_tiles([points], []).options["inversion"]["exponential"]
    for tiles in (cut(points, "squares"), [points[::2], points[1::2], points[:500]]):
        assert visible_from_tiles(tiles, [], share=0.001).options["inversion"]["exponential"] == expected


def test_waves_hold_each_tile_once_and_the_nearest_first():
    boxes = [(np.full(3, float(number)), np.full(3, number + 1.0)) for number in range(100)]
    boxes[7] = None
    waves = waves_of(boxes, [[0.0, 0.0, 0.0], [101.0, 101.0, 101.0]])
    assert sorted(tile for wave in waves for tile in wave) == list(range(100))
    assert waves[0] == [0, 1, 2, 3, 4, 5, 6, 8, *range(92, 100)]
    assert 7 in waves[-1]
    assert waves_of([], [[0.0, 0.0, 0.0]]) == []
    assert waves_of([None, None], []) == [[0, 1]]


def test_a_question_goes_on_from_finished_tiles(tmp_path, monkeypatch):
    paths = []
    for number, tile in enumerate(cut(town(6000), "squares")):
        paths.append(tmp_path / f"{number}.npy")
        np.save(paths[-1], tile)
    expected = visible_from_tiles(paths, VIEWPOINTS)
    work = tmp_path / "work"

    def stop(stage, done, every):
        if stage == "screen" and done == 10:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        visible_from_tiles(paths, VIEWPOINTS, work=work, progress=stop)
    kept = sorted(work.glob("*/*.npz"))
    assert len(kept) == 10
    # A file that was not written to its end is not trusted.
    kept[0].write_bytes(kept[0].read_bytes()[:100])
    reads = []
    monkeypatch.setattr(kernels, "read_tile", lambda tile: reads.append(tile) or read_tile(tile))
    again = visible_from_tiles(paths, VIEWPOINTS, work=work)
    assert len(reads) == len(paths) - 9
    assert all(np.array_equal(a, b) for a, b in zip(again, expected, strict=True))
    assert list(work.iterdir()) == []
    with pytest.raises(HprError) as refused:
        visible_from_tiles([town(10)], VIEWPOINTS, work=work)
    assert refused.value.code == "option"


def test_what_is_kept_belongs_to_these_tiles(tmp_path):
    path = tmp_path / "a.npy"
    np.save(path, town(2000))
    other = tmp_path / "b.npy"
    np.save(other, town(100, seed=9))

    def stop(stage, done, every):
        if stage == "merge":
            raise KeyboardInterrupt

    def ask(progress=None, **options):
        return visible_from_tiles([path, other], VIEWPOINTS, work=tmp_path / "work", progress=progress, **options)

    with pytest.raises(KeyboardInterrupt):
        ask(stop)
    np.save(other, town(1000, seed=10))
    for options in ({}, {"radius": 50_000.0}):
        answers = ask(**options)
        whole = PointCloud(np.concatenate([np.load(path), np.load(other)]))
        for viewpoint, answer in zip(VIEWPOINTS, answers, strict=True):
            assert np.array_equal(answer, whole.visible_from(viewpoint, **answers.options).indices)


def test_numpy_numbers_are_options():
    plain = visible_from_tiles([town(500)], VIEWPOINTS[:1], radius=50_000.0)
    assert np.array_equal(visible_from_tiles([town(500)], VIEWPOINTS[:1], radius=np.float32(50_000))[0], plain[0])
    scale = {"exponential": np.float64(0.5)}
    assert visible_from_tiles([town(500)], np.array(VIEWPOINTS), inversion=scale).options == {
        "inversion": {"exponential": 0.5}
    }


@pytest.mark.parametrize("dtype", [np.float16, np.int32, np.uint8, np.int64, ">f8", np.longdouble])
def test_tiles_of_other_numbers(dtype):
    tile = np.abs(town(400)).astype(dtype)
    answers = visible_from_tiles([tile, tile[:5]], [[0.5, 0.5, 400.0]])
    whole = PointCloud(np.concatenate([tile, tile[:5]]).astype(np.float64))
    assert np.array_equal(answers[0], whole.visible_from([0.5, 0.5, 400.0], **answers.options).indices)


def test_a_tile_that_cannot_be_sent_is_refused():
    distributed = pytest.importorskip("dask.distributed")
    lock = threading.Lock()

    def tile():
        with lock:
            return town(10)

    with distributed.Client(n_workers=1, threads_per_worker=1, dashboard_address=None) as client:
        with pytest.raises(HprError) as refused:
            visible_from_tiles([tile], VIEWPOINTS[:1], client=client)
        assert refused.value.code == "option" and "pickle" in str(refused.value)
