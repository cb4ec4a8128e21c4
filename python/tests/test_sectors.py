"""Sectors of the directions give the answer of one cloud, where there are too many points for one merge."""

import numpy as np
import pytest

pytest.importorskip("scipy", reason="the distributed extra is not installed")

from hidden_point_removal import HprError, PointCloud, share_visible
from hidden_point_removal.distributed import plan, sectors, visible_from_tiles

from test_distributed import CASES, VIEWPOINTS, cut, few_queries, town  # noqa: F401


@pytest.fixture
def small(monkeypatch):
    """Merges, sectors and horizons that a small cloud does not fit in."""
    monkeypatch.setattr(plan, "MERGED_POINTS", 1500)
    monkeypatch.setattr(plan, "HORIZON_POINTS", 300)
    monkeypatch.setattr(sectors, "SECTOR_POINTS", 1000)


@CASES
def test_sectors_answer_as_one_cloud(small, how, dtype, options):
    tiles = cut(town(20_000).astype(dtype), how)
    # Points that are in several tiles, and at a viewpoint.
    tiles.append(np.concatenate([tiles[0][::3], np.array(VIEWPOINTS[:1], dtype), tiles[1][::5]]))
    whole = PointCloud(np.concatenate(tiles))
    viewpoints = [*VIEWPOINTS, tiles[2][7].tolist()]
    answers = visible_from_tiles(tiles, viewpoints, **options)
    divided = 0
    for viewpoint, answer, reports in zip(viewpoints, answers, answers.sectors, strict=True):
        expected = whole.visible_from(viewpoint, **answers.options).indices
        assert np.array_equal(answer, expected)
        every = sum(report.own for report in reports)
        for report in reports:
            divided += 1
            assert report.own <= 1.5 / len(reports) * every
            assert 1 <= report.rounds <= 4
    assert divided > 6


def test_a_sector_holds_a_part_of_the_points(monkeypatch):
    monkeypatch.setattr(plan, "MERGED_POINTS", 6000)
    monkeypatch.setattr(plan, "HORIZON_POINTS", 600)
    monkeypatch.setattr(sectors, "SECTOR_POINTS", 4000)
    [answer] = [visible_from_tiles(cut(town(40_000), "squares"), [VIEWPOINTS[2]])]
    [reports] = answer.sectors
    every = sum(report.own for report in reports)
    assert len(reports) >= 6
    assert max(report.held for report in reports) < every / 2


def test_flat_clouds_and_far_coordinates(small):
    """A plane through the viewpoint: no box is known to be harmless, and each sector gets all."""
    random = np.random.default_rng(1)
    flat = np.column_stack([random.uniform(-50, 50, (9000, 2)), np.zeros(9000)])
    flat[:, :2] = np.sign(flat[:, :2]) * np.maximum(np.abs(flat[:, :2]), 40)
    far = town(9000, offset=(636_000.0, 849_000.0, 400.0))
    for points, viewpoint in ((flat, [0.0, 0.0, 0.0]), (far, [636_060.0, 849_100.0, 700.0])):
        tiles = np.array_split(points, 12)
        answers = visible_from_tiles(tiles, [viewpoint], radius=1000.0)
        assert np.array_equal(answers[0], PointCloud(points).visible_from(viewpoint, radius=1000.0).indices)


def test_dask_gives_the_same_answer(small):
    distributed = pytest.importorskip("dask.distributed")
    tiles = cut(town(12_000), "squares")
    alone = visible_from_tiles(tiles, VIEWPOINTS[1:3])
    stages = set()
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        progress = lambda stage, done, every: stages.add(stage)
        together = visible_from_tiles(tiles, VIEWPOINTS[1:3], client=client, progress=progress)
    assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))
    assert together.sectors == alone.sectors
    assert {"divide", "sectors"} <= stages


def test_cells_hold_each_direction_once():
    sample = np.random.default_rng(2).normal(size=(5000, 3))
    sample /= np.linalg.norm(sample, axis=1)[:, None]
    for count in (2, 3, 7, 16):
        cuts = sectors.cuts_of(count, sample)
        held = []
        for number in range(count):
            low, high = sectors.cell_of(cuts, number)
            held.append(((sample >= low) & (sample < high)).all(axis=1))
        assert (np.sum(held, axis=0) == 1).all()
        assert max(own.sum() for own in held) <= 1.5 / count * len(sample)


def test_one_question_and_its_answer():
    points = town(4000)
    viewpoint, options = [60.0, 100.0, 300.0], {"radius": 40_000.0}
    expected = PointCloud(points).visible_from(viewpoint, **options).indices
    own, others = points[:3000], points[3000:]
    whole = share_visible(own, others, np.empty((0, 2, 3)), viewpoint, **options)
    assert whole.visible.dtype == np.uint32
    assert np.array_equal(whole.visible, expected[expected < 3000])
    assert np.array_equal(whole.needed, expected)
    assert len(whole.undecided) == len(whole.missing) == 0
    boxes = [[others.min(axis=0), others.max(axis=0)]]
    part = share_visible(own, np.empty((0, 3)), boxes, viewpoint, **options)
    assert part.missing.tolist() == [0]
    known = np.concatenate([part.visible, part.undecided])
    assert set(whole.visible) <= set(known) and set(part.visible) <= set(whole.visible)
    single = share_visible(own.astype(np.float32), others, boxes, viewpoint, **options)
    double = share_visible(own.astype(np.float32).astype(np.float64), others, boxes, viewpoint, **options)
    assert np.array_equal(single.visible, double.visible)


@pytest.mark.parametrize(
    ("code", "changes"),
    [
        ("option", {"boxes": [[0.0, 1.0]]}),
        ("option", {"boxes": "near"}),
        ("option", {"boxes": [[[0, 0, 2], [1, 1, 1]]]}),
        ("option", {"boxes": [[[0, 0, np.nan], [1, 1, 1]]]}),
        ("option", {"vote": 3}),
        ("option", {"within": {"mask": [True]}}),
        ("option", {"radius": None}),
        ("radius", {"radius": 1.0}),
        ("viewpoint", {"viewpoint": [0, 0]}),
        ("non-finite", {"own": [[np.inf, 0, 0]]}),
        ("positions-length", {"others": [[0.0, 0.0]]}),
    ],
)
def test_bad_input_is_refused_with_a_code(code, changes):
    given = {"own": town(9), "others": town(9), "boxes": [], "viewpoint": [0, 0, 5], "radius": 1000.0, **changes}
    with pytest.raises(HprError) as refused:
        share_visible(**given)
    assert refused.value.code == code, str(refused.value)
