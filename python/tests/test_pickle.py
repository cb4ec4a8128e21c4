"""Clouds and answers are pickled and copied."""

import copy
import pickle

import numpy as np
import pytest

from hidden_point_removal import Horizon, HprError, PointCloud

VIEWPOINT = [0.0, 0.0, 4.0]


def points(dtype):
    found = np.random.default_rng(1).normal(size=(3000, 3))
    found[100:120] = found[0]
    return (found / np.linalg.norm(found, axis=1)[:, None]).astype(dtype)


WAYS = [copy.copy, copy.deepcopy, *(lambda whole, p=p: pickle.loads(pickle.dumps(whole, p)) for p in range(2, 6))]


def same(one, other):
    for name in ("indices", "scores", "pixels", "depths"):
        a, b = getattr(one, name, None), getattr(other, name, None)
        assert (a is None and b is None) or (a.dtype == b.dtype and np.array_equal(a, b)), name
    for name in ("radius", "exponent", "evaluations", "exact", "inversion", "count"):
        assert getattr(one, name) == getattr(other, name), name
    assert np.array_equal(one.mask(), other.mask())


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_clouds_come_back_with_all_that_happened(way, dtype):
    given = points(dtype)
    given[[5, 7]] = np.nan
    cloud = PointCloud(given, non_finite="skip")
    cloud.append(2 * given[:50])
    cloud.remove([7, 10, 11, 100, 3020])
    again = way(cloud)
    assert (len(again), again.skipped, again.spacing) == (3050, cloud.skipped, cloud.spacing) and cloud.skipped == 4
    for options in ({}, {"looks": 3, "scores": True}):
        same(cloud.visible_from(VIEWPOINT, **options), again.visible_from(VIEWPOINT, **options))
    # The precision decides about the origin of a map.
    assert again.visibility_map(VIEWPOINT).origin == cloud.visibility_map(VIEWPOINT).origin
    for one in (cloud, again):
        one.append([[np.inf, 0, 0], [0, 0, 3]])
    assert again.skipped == 5
    same(cloud.visible_from(VIEWPOINT), again.visible_from(VIEWPOINT))


@pytest.mark.parametrize("way", WAYS)
def test_answers_come_back(way):
    cloud = PointCloud(points(np.float64))
    camera = {"world_to_camera": np.eye(4), "fx": 9, "fy": 9, "cx": 9, "cy": 9, "width": 18, "height": 18}
    for seen in (
        cloud.visible_from(VIEWPOINT),
        cloud.visible_from(VIEWPOINT, looks=2, scores=True),
        cloud.visible_from(VIEWPOINT, inversion={"power": 2}),
        cloud.visible_from(VIEWPOINT, inversion={"exponential": "auto"}),
        cloud.visible_from_camera(camera, exponent=3),
        cloud.visible_from_any([]),
    ):
        same(seen, way(seen))
    rows = cloud.seen_by([camera])
    assert all(np.array_equal(a, b) for a, b in zip(rows, way(rows)))
    empty = PointCloud([])
    empty.append([[0.0, 0, 0]])
    empty.remove([0])
    assert len(way(empty)) == 1 and way(empty).visible_from(VIEWPOINT).count == 0


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("options", [{"radius": 40.0}, {"inversion": {"exponential": 0.01}}, {"inversion": {"power": 2}, "radius": 9.0}])
def test_horizons_come_back(way, options):
    given = points(np.float64)
    horizon = Horizon(VIEWPOINT, **options)
    horizon.add(given[:1000])
    again = way(horizon)
    assert np.array_equal(again.screen(given), horizon.screen(given)) and len(horizon.screen(given)) < len(given)
    assert np.array_equal(np.sort(again.visible(), axis=0), np.sort(horizon.visible(), axis=0))
    assert len(way(Horizon(VIEWPOINT, **options)).screen(given)) == len(given)


def test_an_answer_leaves_its_cloud_behind():
    cloud = PointCloud(points(np.float64))
    seen = cloud.visible_from(VIEWPOINT)
    assert len(pickle.dumps(seen)) < len(pickle.dumps(cloud)) / 3
    with pytest.raises(HprError, match="copied without its cloud"):
        pickle.loads(pickle.dumps(seen)).points


@pytest.mark.parametrize("way", WAYS)
def test_maps_come_back(way):
    given = points(np.float64)
    map = PointCloud(given).visibility_map(VIEWPOINT, origin=[1, 2, 3])
    again = way(map)
    assert (again.viewpoint, again.origin, again.uniforms) == (map.viewpoint, map.origin, map.uniforms)
    assert np.array_equal(again.data, map.data) and np.array_equal(again.hides(given), map.hides(given)) and map.hides(given).any()
