"""The Python package gives the crate's answers, and refuses what the crate refuses."""

import sys
import threading

import numpy as np
import pytest

import hidden_point_removal as hpr
from hidden_point_removal import Horizon, HprError, PointCloud, merge_visible


def bumpy(count, seed=1, dtype=np.float64):
    random = np.random.default_rng(seed)
    direction = random.normal(size=(count, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    x, y, z = direction.T
    return (direction * (1 + 1.5 * x * y * z)[:, None]).astype(dtype)


VIEWPOINT = [0.0, 0.5, 4.0]


def test_one_ray_and_the_shape_of_an_answer():
    cloud = PointCloud([[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]])
    seen = cloud.visible_from([0, 0, 5])
    assert seen.indices.dtype == np.uint32
    assert seen.indices.tolist() == [1]
    assert seen.mask().tolist() == [False, True]
    assert (seen.count, len(seen), len(cloud)) == (1, 1, 2)
    assert seen.inversion == "spherical" and seen.exact and seen.scores is None


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_answer_does_not_depend_on_the_layout(dtype):
    points = bumpy(3000, dtype=dtype)
    expected = PointCloud(points).visible_from(VIEWPOINT).indices
    padded = np.zeros((3000, 7), dtype)
    padded[:, 2:5] = points
    for other in (np.asfortranarray(points), padded[:, 2:5], points.tolist() if dtype == np.float64 else points):
        assert np.array_equal(PointCloud(other).visible_from(VIEWPOINT).indices, expected)
    assert np.array_equal(
        hpr.hidden_point_removal(points, VIEWPOINT, 400.0),
        PointCloud(points).visible_from(VIEWPOINT, radius=400.0).indices,
    )


def test_integers_are_read_as_doubles():
    points = np.array([[0, 0, 1], [0, 0, 2], [3, 0, 0]], np.int16)
    assert PointCloud(points).visible_from([0, 0, 5]).indices.tolist() == [1, 2]


def test_what_an_answer_holds():
    cloud = PointCloud(bumpy(1500))
    seen, triangles = cloud.reconstruct(VIEWPOINT)
    assert triangles.shape[1] == 3 and set(triangles.ravel()) <= set(seen.indices.tolist())
    smooth = cloud.illuminate([VIEWPOINT], triangles=triangles, ambient=0.25)
    assert smooth.dtype == np.float32 and smooth.min() == 0.25
    looks = cloud.visible_from(VIEWPOINT, looks=3, scores=True)
    assert looks.scores.shape == (1500,) and len(looks.inversion["looks"]) == 3
    exponential = cloud.visible_from(VIEWPOINT, inversion={"exponential": "auto"})
    again = cloud.visible_from(VIEWPOINT, inversion=exponential.inversion)
    assert np.array_equal(again.indices, exponential.indices)
    assert cloud.auto_radius(VIEWPOINT)[0] == cloud.visible_from(VIEWPOINT).radius


def test_points_come_and_go():
    points = bumpy(900)
    cloud = PointCloud(points[:500])
    cloud.append(points[500:])
    cloud.remove(np.arange(100))
    cloud.remove([100])
    rest = PointCloud(points[101:]).visible_from(VIEWPOINT)
    assert np.array_equal(cloud.visible_from(VIEWPOINT).indices, rest.indices + 101)
    assert len(cloud) == 900


def test_skipped_points():
    points = bumpy(300)
    points[7, 1] = np.nan
    cloud = PointCloud(points, non_finite="skip")
    assert cloud.skipped == 1
    assert 7 not in cloud.visible_from(VIEWPOINT).indices


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int32])
def test_masked_points_do_not_take_part(dtype):
    points = (100 * bumpy(300)).astype(dtype)
    viewpoint = [300, 0, 0]
    masked = np.ma.array(points, mask=False)
    masked[7, 1] = np.ma.masked
    masked[20] = np.ma.masked
    with pytest.raises(HprError) as error:
        PointCloud(masked)
    assert error.value.code == "non-finite"
    cloud = PointCloud(masked, non_finite="skip")
    assert cloud.skipped == 2
    kept = np.delete(np.arange(300), [7, 20])
    rest = PointCloud(points[kept]).visible_from(viewpoint)
    assert np.array_equal(cloud.visible_from(viewpoint).indices, kept[rest.indices])
    cloud.append(masked)
    assert cloud.skipped == 4


def test_parts_and_horizons_give_the_answer_of_the_whole():
    points = bumpy(6000, dtype=np.float32)
    options = {"inversion": {"exponential": 0.004}}
    whole = PointCloud(points).visible_from(VIEWPOINT, **options).indices
    horizon = Horizon(VIEWPOINT, **options)
    horizon.add(points[::10])
    assert len(horizon.visible()) < 600
    parts = []
    for start in range(0, 6000, 1500):
        tile = points[start : start + 1500]
        left = horizon.screen(tile)
        assert len(left) < 1500
        parts.append((tile[left], left.astype(np.uint64) + np.uint64(2**40 + start)))
    merged = merge_visible(parts, VIEWPOINT, **options)
    assert merged.dtype == np.uint64
    assert np.array_equal(merged, whole.astype(np.uint64) + np.uint64(2**40))


@pytest.mark.parametrize(
    ("code", "call"),
    [
        ("positions-length", lambda: PointCloud(np.zeros((4, 2)))),
        ("positions-length", lambda: PointCloud(np.zeros(3))),
        ("positions-type", lambda: PointCloud("points")),
        ("positions-type", lambda: PointCloud(np.zeros((2, 3), complex))),
        ("positions-type", lambda: PointCloud(np.zeros((2, 3), bool))),
        ("non-finite", lambda: PointCloud([[0, 0, np.inf]])),
        ("option", lambda: PointCloud([[0, 0, 1]], non_finite="maybe")),
        ("viewpoint", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0])),
        ("viewpoint", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, np.nan])),
        ("viewpoint", lambda: PointCloud([[0, 0, 1]]).visible_from(None)),
        ("viewpoint", lambda: PointCloud([[0, 0, 1]]).visible_from_any([[0, 0, 1], [0, 0]])),
        ("viewpoint", lambda: PointCloud([[0, 0, 1]]).visible_from_any(7)),
        ("radius", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], radius=1.0)),
        ("radius", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], radius=-1)),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], radius="best")),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], radius=True)),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], colour=1)),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], radius=9, exponent=2)),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], looks=4)),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], scores=True)),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], inversion={"power": 1})),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], inversion="round")),
        ("option", lambda: PointCloud([[0, 0, 1]]).visible_from([0, 0, 5], looks=1.5)),
        ("option", lambda: PointCloud([[0, 0, 1]]).remove([1])),
        ("option", lambda: PointCloud([[0, 0, 1]]).remove([-1])),
        ("option", lambda: PointCloud([[0, 0, 1]]).illuminate([[0, 0, 5]], triangles=[[0, 0, 1]])),
        ("option", lambda: merge_visible([([[0, 0, 1]], [0])], [0, 0, 5])),
        ("option", lambda: merge_visible([([[0, 0, 1]], [-1])], [0, 0, 5], radius=9)),
        ("positions-length", lambda: merge_visible([([[0, 0, 1]], [0, 1])], [0, 0, 5], radius=9)),
        ("option", lambda: Horizon([0, 0, 5])),
        ("option", lambda: Horizon([0, 0, 5], radius=9).hides_box([1, 0, 0], [0, 1, 1])),
    ],
)
def test_bad_input_is_refused_with_a_code(code, call):
    with pytest.raises(HprError) as refused:
        call()
    assert refused.value.code == code, str(refused.value)
    assert isinstance(refused.value, ValueError)


def test_none_leaves_an_option_out():
    cloud = PointCloud(bumpy(200))
    plain = cloud.visible_from(VIEWPOINT)
    assert np.array_equal(cloud.visible_from(VIEWPOINT, radius=None, looks=None).indices, plain.indices)


def test_threads_run_at_the_same_time():
    """Python takes the lock from no thread here, so another one runs beside a question only if the question leaves the lock."""
    cloud = PointCloud(bumpy(60_000))
    expected = cloud.visible_from(VIEWPOINT).indices
    answers = []

    def ask():
        answers.append(cloud.visible_from(VIEWPOINT).indices)

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)
    try:
        # A busy machine may let this thread wait for as long as a question takes.
        for number in range(100):
            thread = threading.Thread(target=ask)
            thread.start()
            is_beside = len(answers) == number
            thread.join()
            if is_beside:
                break
    finally:
        sys.setswitchinterval(interval)
    assert is_beside, "the lock was held all the time"
    assert all(np.array_equal(answer, expected) for answer in answers)


def camera(**entries):
    return {"camera_to_world": np.eye(4), "fx": 400, "fy": 400, "cx": 320, "cy": 240, "width": 640, "height": 480, **entries}


def test_poses_come_in_many_forms_and_the_wrong_one_is_said():
    points = bumpy(4000)
    turned = np.array([[1.0, 0, 0, 0.2], [0, -1, 0, 0.1], [0, 0, -1, 5], [0, 0, 0, 1]])
    cloud = PointCloud(points)
    seen = cloud.visible_from_camera(camera(camera_to_world=turned), exponent=3)
    assert seen.pixels.dtype == seen.depths.dtype == np.float32 and seen.pixels.shape == (seen.count, 2)
    flat = cloud.visible_from_camera(camera(camera_to_world=turned.T.ravel().tolist(), distortion=[0] * 5, far=np.inf), exponent=3)
    assert np.array_equal(flat.indices, seen.indices)
    inverse = np.linalg.inv(turned)
    other = cloud.visible_from_camera(camera(camera_to_world=None, world_to_camera=inverse), exponent=3)
    assert np.array_equal(other.indices, seen.indices)
    away = np.array([30, 0, 0])
    turned[:3, 3] += away
    swapped, moved = camera(camera_to_world=np.linalg.inv(turned)), PointCloud(points + away)
    with pytest.warns(UserWarning, match="inverse pose"):
        wrong = moved.visible_from_camera(swapped, exponent=3)
    assert wrong.count == 0
    seats = [[40.0, 0, 0], swapped]
    for ask in (
        lambda: moved.coverage(seats),
        lambda: moved.place_viewpoints(seats),
        lambda: moved.visible_from_any(seats),
        lambda: moved.visible_from_at_least(2, seats),
    ):
        with pytest.warns(UserWarning, match="inverse pose"):
            ask()
    turned[:3, 3] -= away
    upright = cloud.visible_from_camera(camera(camera_to_world=turned @ np.diag([1, -1, -1, 1]), convention="opengl"), exponent=3)
    assert np.array_equal(upright.indices, seen.indices)
    assert not hasattr(cloud.visible_from(turned[:3, 3]), "pixels") and isinstance(seen, hpr.CameraView)
    for list in ([0.1, 0.2, 0, 0], [0.1, 0.2, 0, 0, 0]):
        assert cloud.visible_from_camera(camera(camera_to_world=turned, model="OPENCV", distortion=list), exponent=3).count > 100


def test_each_viewpoint_has_a_mask_and_weights_choose():
    cloud = PointCloud(bumpy(1500))
    places = [VIEWPOINT, [4, 0, 0], VIEWPOINT, [0, 0, -4]]
    masks = [cloud.visible_from(place).mask() for place in places]
    for threads in (None, 1, 3):
        each = cloud.visible_from_each(np.array(places), threads=threads)
        assert each.dtype == bool and np.array_equal(each, masks)
    assert cloud.visible_from_each([]).shape == (0, 1500)
    heavy = np.zeros(1500)
    heavy[masks[3]] = 1.0
    assert cloud.place_viewpoints(places, weights=heavy, share=1.0, radius=None).chosen[0] == 3


@pytest.mark.parametrize(
    ("code", "call"),
    [
        ("viewpoint", lambda cloud: cloud.visible_from_camera(7)),
        ("viewpoint", lambda cloud: cloud.visible_from_camera({})),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(world_to_camera=np.eye(4)))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(camera_to_world=np.eye(3)))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(camera_to_world=2 * np.eye(4)))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(width=0))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(fx="wide"))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(fx=np.nan))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(convention="maya"))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(distortion=[1, 2]))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(model="RADIAL", distortion=[1]))),
        ("option", lambda cloud: cloud.visible_from_camera(camera(model="FISHEYE"))),
        ("viewpoint", lambda cloud: cloud.visible_from_camera(camera(zoom=2))),
        ("non-finite", lambda cloud: cloud.sees(VIEWPOINT, [[0, 0, np.nan]])),
        ("positions-length", lambda cloud: cloud.sees(VIEWPOINT, [[0, 0]])),
        ("option", lambda cloud: cloud.sees(VIEWPOINT, [[0, 0, 0]], looks=3, scores=True)),
        ("option", lambda cloud: cloud.coverage([VIEWPOINT], looks=3, scores=True)),
        ("viewpoint", lambda cloud: cloud.coverage([[0, 0]])),
        ("viewpoint", lambda cloud: cloud.visible_from_each([[0, 0]])),
        ("option", lambda cloud: cloud.visible_from_each([VIEWPOINT], looks=3, scores=True)),
        ("option", lambda cloud: cloud.place_viewpoints([VIEWPOINT], count=0)),
        ("option", lambda cloud: cloud.place_viewpoints([VIEWPOINT], share=1.5)),
        ("option", lambda cloud: cloud.place_viewpoints([VIEWPOINT], share="all")),
        ("option", lambda cloud: cloud.place_viewpoints([VIEWPOINT], weights=[1.0])),
        ("option", lambda cloud: cloud.place_viewpoints([VIEWPOINT], weights="heavy")),
        ("option", lambda cloud: cloud.place_viewpoints([VIEWPOINT], weights=[-1.0, 1.0, 1.0])),
    ],
)
def test_bad_cameras_and_placements_are_refused(code, call):
    with pytest.raises(HprError) as refused:
        call(PointCloud([[0.0, 0, 1], [1, 0, 0], [0, 1, 0]]))
    assert refused.value.code == code, str(refused.value)


def test_only_some_points_take_part():
    points = bumpy(3000)
    cloud = PointCloud(points)
    mask = np.arange(3000) % 3 != 0
    low, high = [-1.0, -1.0, 0.0], [1.0, 0.3, 1.0]
    near = np.sqrt(((points - VIEWPOINT) ** 2).sum(axis=1)) <= 3.8
    inside = ((points >= low) & (points <= high)).all(axis=1)
    for within, chosen in (
        ({"mask": mask}, mask),
        ({"mask": mask.astype(np.uint8)}, mask),
        ({"box": (low, high)}, inside),
        ({"box": np.array([low, high]), "distance": None}, inside),
        ({"distance": 3.8}, near),
        ({"distance": 3.8, "box": (low, high), "mask": mask}, near & inside & mask),
    ):
        numbers = np.flatnonzero(chosen)
        alone = PointCloud(points[chosen])
        seen = cloud.visible_from(VIEWPOINT, within=within)
        expected = alone.visible_from(VIEWPOINT)
        assert 0 < len(expected) < len(numbers)
        assert np.array_equal(seen.indices, numbers[expected.indices]) and seen.radius == expected.radius
        assert len(seen.mask()) == 3000
        counts = cloud.coverage([VIEWPOINT], within=within)
        assert np.array_equal(np.flatnonzero(counts), seen.indices)
    every = cloud.visible_from(VIEWPOINT, within={}).indices
    assert np.array_equal(every, cloud.visible_from(VIEWPOINT).indices)


@pytest.mark.parametrize(
    "within",
    [
        {"mask": [True]},
        {"mask": np.ones(50)},
        {"mask": "all"},
        {"distance": -1.0},
        {"distance": "far"},
        {"distance": True},
        {"box": [0.0, 1.0]},
        {"box": ([0, 0, 2], [1, 1, 1])},
        {"box": ([0, 0, np.nan], [1, 1, 1])},
        {"sphere": 3},
        7,
    ],
)
def test_bad_choices_of_points_are_refused(within):
    with pytest.raises(HprError) as refused:
        PointCloud(bumpy(50)).visible_from(VIEWPOINT, within=within)
    assert refused.value.code == "option", str(refused.value)


@pytest.mark.parametrize("within", [{"mask": [True]}, {"distance": 3.0}])
def test_parts_of_points_are_refused_where_there_is_no_cloud(within):
    for call in (
        lambda: Horizon(VIEWPOINT, radius=100.0, within=within),
        lambda: merge_visible([(bumpy(1), [0])], VIEWPOINT, radius=100.0, within=within),
    ):
        with pytest.raises(HprError) as refused:
            call()
        assert refused.value.code == "option" and "within" in str(refused.value)


def test_panorama():
    dome = PointCloud(bumpy(900))
    seen = dome.panorama([0, 0, 0], 64, 32)
    assert (seen.ranges.shape, seen.indices.shape) == ((32, 64), (32, 64))
    for wrong in ({"width": 0}, {"height": 16_385}, {"draft": True}, {"sample": 9}, {"denoise": 9}, {"vote": 9}, {"radius": "search"}):
        with pytest.raises(HprError) as refused:
            dome.panorama([0, 0, 0], **{"width": 8, "height": 8, **wrong})
        assert refused.value.code == "option"
    with pytest.raises(HprError) as refused:
        dome.panorama([0, 0, 0], 8, 8, up=[0, 0, 0])
    assert refused.value.code == "viewpoint"


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_an_answer_is_an_index(dtype):
    points = bumpy(900, dtype=dtype)
    cloud = PointCloud(points)
    seen = cloud.visible_from(VIEWPOINT)
    assert np.array_equal(points[seen], points[seen.indices]) and np.array_equal(points[~seen], points[~seen.mask()])
    assert np.asarray(seen).dtype == np.int64 and np.asarray(seen, np.uint8).dtype == np.uint8
    assert list(seen) == seen.indices.tolist() and seen[-1] == seen.indices[-1]
    assert seen.points.dtype == dtype and np.array_equal(seen.points, points[seen])
    assert cloud.positions.dtype == dtype and np.array_equal(cloud.positions, points)
    cloud.remove([seen[3]])
    assert np.isnan(cloud.positions).all(axis=1).tolist() == [number == seen[3] for number in range(900)]
    assert np.isnan(seen.points).any(axis=1).tolist() == [number == 3 for number in range(len(seen))]
    assert PointCloud(points).visible_from([0, 0, 0], within={"distance": 0.0}).points.shape == (0, 3)
    shown = seen._repr_html_()
    assert f"<b>{seen.count}</b> of 900" in shown and f"{seen.radius:.6g}" in shown
    looks = cloud.visible_from(VIEWPOINT, looks=2)
    assert "looks=2" in looks._repr_html_() and repr(looks) == f"Visibility({looks.count} of 900 points, looks=2)"
    assert repr(seen) == f"Visibility({seen.count} of 900 points, radius={seen.radius:.6g})"
    power = cloud.visible_from(VIEWPOINT, inversion={"power": 2})
    assert repr(power).endswith(f"radius={power.radius:.6g}, power=2)") and repr(PointCloud([]).visible_from(VIEWPOINT)) == "Visibility(0 of 0 points)"
