"""Tiles give the answer of one cloud, on any engine."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

pytest.importorskip("scipy", reason="the distributed extra is not installed")

from hidden_point_removal import HprError, PointCloud
from hidden_point_removal.distributed import kernels, read_tile, visible_from_tiles, write_parquet


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


@pytest.mark.parametrize("how", ["squares", "random"])
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("options", [{}, {"radius": 40_000.0}, {"inversion": {"power": 2}, "radius": 1000.0}])
def test_tiles_answer_as_one_cloud(how, dtype, options):
    tiles = cut(town(20_000).astype(dtype), how)
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
    points = town(30_000)
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
    command = [sys.executable, "-m", "hidden_point_removal.command", "tiles", str(tmp_path), "--from", str(cameras)]
    for output in ("first", "second"):
        subprocess.run([*command, "-o", str(tmp_path / output), "--laz"], check=True, capture_output=True)
    assert len(os.listdir(tmp_path / ".hpr-manifest")) == 3
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
        [sys.executable, "-m", "hidden_point_removal.command", "tiles", *words], capture_output=True, text=True
    )
    missing = run(str(tmp_path), "--from", str(tmp_path / "none.csv"), "-o", str(tmp_path / "out"))
    assert missing.returncode != 0 and "no tiles" in missing.stderr
    np.save(tmp_path / "a.npy", town(10))
    (tmp_path / "bad.csv").write_text("x,y,z\n1,2,three\n")
    bad = run(str(tmp_path), "--from", str(tmp_path / "bad.csv"), "-o", str(tmp_path / "out"))
    assert bad.returncode != 0 and "row 1" in bad.stderr


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
    assert len(set(kernels.hashes(points).tolist())) == 1
    assert np.array_equal(kernels.hashes(points.astype(np.float32)), kernels.hashes(points))


def test_a_parquet_of_no_answers(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    write_parquet(tmp_path / "none.parquet", [])
    assert parquet.read_table(tmp_path / "none.parquet").num_rows == 0
