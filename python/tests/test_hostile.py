"""Input and surroundings that nobody should trust: arrays that change, threads, forks, extreme numbers."""

import multiprocessing
import os
import threading

import numpy as np
import pytest

from hidden_point_removal import Horizon, HprError, PointCloud, merge_visible, transfer

VIEWPOINT = [0.0, 0.0, 4.0]


def ball(count, seed=1):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


@pytest.mark.parametrize("mapped", [False, True])
def test_arrays_that_change_during_a_call(tmp_path, mapped):
    points = ball(20_000)
    if mapped:
        np.save(tmp_path / "points.npy", points)
        points = np.load(tmp_path / "points.npy", mmap_mode="r+")
    original = np.array(points)
    horizon = Horizon(VIEWPOINT, radius=100.0)
    horizon.add(original[::3])
    ended = threading.Event()

    def spoil():
        values = [np.nan, np.inf, 1e300, -1e-300, 0.0]
        random = np.random.default_rng(2)
        while not ended.is_set():
            points[random.integers(0, len(points), 50)] = values[random.integers(0, len(values))]
            points[:] = original

    thread = threading.Thread(target=spoil)
    thread.start()
    try:
        for _ in range(30):
            for ask in (
                lambda: PointCloud(points).visible_from(VIEWPOINT, radius=100.0).indices,
                lambda: horizon.screen(points),
                lambda: merge_visible([(points, np.arange(len(points)))], VIEWPOINT, radius=100.0),
            ):
                try:
                    assert (ask() < len(points)).all()
                except HprError as refused:
                    assert refused.code in ("non-finite", "radius")
    finally:
        ended.set()
        thread.join()
    points[:] = original
    again = PointCloud(points).visible_from(VIEWPOINT, radius=100.0).indices
    assert np.array_equal(again, PointCloud(original).visible_from(VIEWPOINT, radius=100.0).indices)


def test_read_only_and_strange_arrays():
    points = ball(300)
    expected = PointCloud(points).visible_from(VIEWPOINT).indices
    fixed = points.copy()
    fixed.flags.writeable = False
    shapes = [fixed, points[::-1][::-1], points.astype(">f8"), np.ma.array(points), np.array(points, object).astype(float)]
    for other in shapes:
        assert np.array_equal(PointCloud(other).visible_from(VIEWPOINT).indices, expected)
    unaligned = np.frombuffer(b"\0" + points.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3)
    assert not unaligned.flags.aligned
    assert np.array_equal(PointCloud(unaligned).visible_from(VIEWPOINT).indices, expected)
    assert PointCloud(np.empty((0, 3))).visible_from(VIEWPOINT).count == 0
    assert PointCloud([]).visible_from(VIEWPOINT).indices.dtype == np.uint32


def test_ids_at_the_end_of_their_range():
    last = 2**64 - 1
    ids = merge_visible([(ball(3), [0, 2**63, last])], VIEWPOINT, radius=100.0)
    assert ids.dtype == np.uint64 and ids.max() == last
    for bad in ([0, 1, 2**64], [0.5, 1, 2], [-1, 0, 1], ["a", "b", "c"], None):
        with pytest.raises(HprError) as refused:
            merge_visible([(ball(3), bad)], VIEWPOINT, radius=100.0)
        assert refused.value.code == "option"
    assert merge_visible([], VIEWPOINT, radius=100.0).tolist() == []
    assert PointCloud(ball(9)).visible_from_any([]).count == 0


@pytest.mark.parametrize("points", [np.full((2, 3), 1e308), np.full((2, 3), 1e-320), np.array([[0, 0, 4.0]] * 3)])
def test_extreme_points(points):
    """An answer or a refusal with a code, and nothing else."""
    for ask in (
        lambda: PointCloud(points).visible_from(VIEWPOINT).indices,
        lambda: PointCloud(points).visible_from(VIEWPOINT, inversion={"exponential": 1e-300}).indices,
        lambda: PointCloud(points).visible_from([1e308, -1e308, 0], looks=3).indices,
    ):
        try:
            ask()
        except HprError as refused:
            assert refused.code in ("radius", "viewpoint", "option", "non-finite", "too-large")


def _in_child(cloud, queue):
    queue.put(cloud.visible_from(VIEWPOINT, radius=100.0).indices.tolist())


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_forked_process_answers():
    cloud = PointCloud(ball(3000))
    expected = cloud.visible_from(VIEWPOINT, radius=100.0).indices.tolist()
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=_in_child, args=(cloud, queue))
    child.start()
    assert queue.get(timeout=300) == expected
    child.join()
    assert child.exitcode == 0


@pytest.mark.parametrize(("says", "ask"), [
    (r"non_finite must be .*, got 5", lambda cloud: PointCloud([[0.0, 0, 1]], non_finite=5)),
    (r"rule must be .*, got 5", lambda cloud: cloud.auto_radius(VIEWPOINT, 5)),
    (r"max_edge must be .*, got 'wide'", lambda cloud: cloud.reconstruct(VIEWPOINT, max_edge="wide")),
    (r"max_edge must be .*, got True", lambda cloud: cloud.reconstruct(VIEWPOINT, max_edge=True)),
    (r"smoothing must be .*, got -1", lambda cloud: cloud.illuminate([VIEWPOINT], smoothing=-1)),
    (r"ambient must be .*, got 'dim'", lambda cloud: cloud.illuminate([VIEWPOINT], ambient="dim")),
    (r"parts must be .*, got 5", lambda cloud: merge_visible(5, VIEWPOINT, radius=9)),
    (r"parts must be .*, got None", lambda cloud: merge_visible(None, VIEWPOINT, radius=9)),
    (r"cloud must be .*, got array", lambda cloud: transfer(ball(5), [], [])),
    (r"a mask of ones and zeros", lambda cloud: cloud.remove(cloud.visible_from(VIEWPOINT).mask().astype(int))),
    (r"a mask of ones and zeros", lambda cloud: cloud.calibrate([{"viewpoint": VIEWPOINT, "indices": [0, 1] * 25}])),
    ("must not be 5", lambda cloud: cloud.visible_from_camera({5: 1})),
    ("must not be 5", lambda cloud: cloud.visible_from(VIEWPOINT, within={5: 1})),
    ("must not be 5", lambda cloud: cloud.visible_from(VIEWPOINT, inversion={5: 1})),
])
def test_an_argument_of_another_type_is_refused(says, ask):
    with pytest.raises(HprError, match=says) as refused:
        ask(PointCloud(ball(50)))
    assert refused.value.code == "option"


def test_none_counts_as_left_out():
    cloud = PointCloud(ball(50), None)
    assert cloud.auto_radius(VIEWPOINT, None) == cloud.auto_radius(VIEWPOINT)
    assert np.array_equal(cloud.illuminate([VIEWPOINT], smoothing=None, ambient=None), cloud.illuminate([VIEWPOINT]))
    assert np.array_equal(cloud.reconstruct(VIEWPOINT, None)[1], cloud.reconstruct(VIEWPOINT)[1])


def test_an_answer_is_a_sequence_and_a_mask():
    visible = PointCloud(ball(50)).visible_from(VIEWPOINT)
    assert (visible[-1], visible[1:3]) == (visible.indices[-1], visible.indices[1:3].tolist())
    assert np.array_equal(np.asarray(visible, bool), visible.mask())
