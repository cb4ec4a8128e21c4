"""Cameras in bulk, maps of directions and stations. That the answers are those of JavaScript is tested in test_bits."""

import weakref

import numpy as np
import pytest

from hidden_point_removal import HprError, PointCloud, orient_normals, transfer

VIEWPOINT = [0.0, 0.5, 4.0]


def ball(count=2000, seed=3):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


def camera(place, **more):
    """A camera at `place` that looks at the origin."""
    ahead = -np.array(place) / np.linalg.norm(place)
    right = np.cross(ahead, [0.3, 1, 0.2])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.column_stack([right, np.cross(ahead, right), ahead])
    pose[:3, 3] = place
    return {"camera_to_world": pose, "fx": 80, "fy": 80, "cx": 32, "cy": 24, "width": 64, "height": 48, **more}


PLACES = [[0, 0, 3.0], [3.0, 0.2, 0], [2.0, 0, 2.0]]
CAMERAS = [camera(place) for place in PLACES]
CLOUD = PointCloud(ball())
MASKS = [CLOUD.visible_from_camera(one).mask() for one in CAMERAS]


def test_seen_by_is_a_sparse_matrix():
    seen = CLOUD.seen_by(CAMERAS)
    assert [array.dtype.name for array in seen[:4]] == ["uint32", "uint32", "float32", "float32"]
    count = sum(mask.sum() for mask in MASKS)
    assert len(seen.offsets) == 2001 and seen.offsets[-1] == count
    assert seen.pixels.shape == (count, 2) and seen.towards.shape == (count, 3)
    assert CLOUD.seen_by([]).offsets.tolist() == [0] * 2001
    pytest.importorskip("scipy")
    assert np.array_equal(seen.matrix().toarray(), np.transpose(MASKS))
    # A camera that sees nothing has a column, too.
    away = {**CAMERAS[0], "far": 0.01}
    assert CLOUD.seen_by([*CAMERAS, away]).matrix(seen.cameras + 0.5).toarray()[:, 2:].max(axis=0).tolist() == [2.5, 0]
    with pytest.raises(HprError, match="values must hold one number for each"):
        seen.matrix([1.0])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_normals_keep_their_type(dtype):
    seen = CLOUD.seen_by(CAMERAS)
    normals = -ball().astype(dtype)
    before = normals.copy()
    turned = orient_normals(normals, seen)
    assert turned.dtype == dtype and np.array_equal(normals, before)


def test_colors_go_from_images_to_points():
    images = [np.full((48, 64, 3), 10 * (number + 1), np.uint8) for number in range(3)]
    values, seen = transfer(CLOUD, CAMERAS, images, merge="mean")
    assert values.dtype == np.float32 and values.shape == (2000, 3) and seen.dtype == np.uint32
    for kind in (bool, np.uint16, np.float16, np.int64, ">f4"):
        ones, _ = transfer(CLOUD, CAMERAS, [np.ones((48, 64), kind)] * 3, weights="angle", looks=2)
        assert ones.shape == (2000,) and set(ones[~np.isnan(ones)]) == {1.0}
    values, seen = transfer(PointCloud(np.empty((0, 3))), CAMERAS, images, weights="score")
    assert values.shape == (0, 3) and seen.shape == (0,)


@pytest.mark.parametrize("kind", [np.int32, np.uint32, np.int64, np.float64])
@pytest.mark.parametrize("merge", ["mean", "median", "vote", "best"])
def test_labels_stay_whole(merge, kind):
    labels = np.full((48, 64), 2**24 + 1, kind)
    values, seen = transfer(CLOUD, CAMERAS, [labels] * 3, merge=merge)
    assert values.dtype == np.float64 and set(values[seen > 0]) == {2**24 + 1} and np.isnan(values[seen == 0]).all()


def test_images_are_taken_one_at_a_time():
    alive = []

    def images():
        for number in range(3):
            image = np.full((48, 64), number, np.float32)
            alive.append(weakref.ref(image))
            yield image
            del image
            assert sum(kept() is not None for kept in alive) <= 1

    values, _ = transfer(CLOUD, CAMERAS, images(), threads=1)
    expected, _ = transfer(CLOUD, CAMERAS, [np.full((48, 64), number, np.float32) for number in range(3)])
    assert np.array_equal(values, expected, equal_nan=True) and len(alive) == 3
    for count in (2, 4):
        with pytest.raises(HprError, match=f"one image for each of 3 cameras, got {count}"):
            transfer(CLOUD, CAMERAS, (IMAGE for _ in range(count)))
    assert transfer(CLOUD, [], [])[0].shape == (2000,)


def test_images_may_be_files(tmp_path):
    image = pytest.importorskip("PIL.Image")
    photos = [np.random.default_rng(number).integers(0, 256, (48, 64, 3), np.uint8) for number in range(3)]
    for number, photo in enumerate(photos):
        image.fromarray(photo).save(tmp_path / f"{number}.png")
    paths = [tmp_path / "0.png", str(tmp_path / "1.png"), image.open(tmp_path / "2.png")]
    for one, other in zip(transfer(CLOUD, CAMERAS, paths), transfer(CLOUD, CAMERAS, photos)):
        assert np.array_equal(one, other, equal_nan=True)
    with pytest.raises(HprError, match=r"images\[1\] cannot be read: .*nothing.png") as refusal:
        transfer(CLOUD, CAMERAS, [paths[0], tmp_path / "nothing.png", paths[2]])
    assert refusal.value.code == "load"


def placement(placed):
    return np.array([placed.chosen, placed.gains]), placed.seen, placed.unseen


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_progress_is_told_and_can_end_a_question(threads):
    photos = [np.full((48, 64), number, np.uint8) for number in range(3)]
    options = {"looks": 2, "threads": threads}
    for ask in (
        lambda **more: CLOUD.seen_by(CAMERAS, **options, **more),
        lambda **more: (CLOUD.coverage(CAMERAS, **options, **more),),
        lambda **more: transfer(CLOUD, CAMERAS, photos, **options, **more),
        lambda **more: placement(CLOUD.place_viewpoints(CAMERAS, **options, **more)),
    ):
        told = []
        for one, other in zip(ask()[:4], ask(on_progress=told.append)):
            assert np.array_equal(one, other, equal_nan=other.dtype.kind == "f")
        assert told == [min(done / 3, 1) for done in {1: (1, 2, 3), 2: (2, 3), 5: (3,)}[threads]]
        with pytest.raises(ZeroDivisionError):
            ask(on_progress=lambda share: 1 / 0)
        with pytest.raises(HprError, match="on_progress must be callable"):
            ask(on_progress=5)


def test_a_listener_must_not_change_the_cloud():
    cloud = PointCloud(ball())
    changes = (lambda share: cloud.append(ball(50, seed=8))), (lambda share: cloud.remove([int(100 * share)]))
    for question in (cloud.coverage, cloud.seen_by, cloud.place_viewpoints):
        for change in changes:
            with pytest.raises(HprError, match="on_progress must not change the cloud") as refused:
                question(CAMERAS, threads=1, on_progress=change)
            assert refused.value.code == "option"


def test_a_map_says_what_it_hides():
    found = PointCloud(ball(20_000)).visibility_map(VIEWPOINT, points=6000)
    assert found.viewpoint == tuple(VIEWPOINT) and len(found.data) % 256 == 0
    assert {name: len(numbers) for name, numbers in found.uniforms.items()} == {"hprViewpoint": 3, "hprMargins": 4}
    assert found.hides([[0, 0, 0], VIEWPOINT, [np.nan, 0, 0]]).tolist() == [True, False, False]


@pytest.mark.filterwarnings("ignore:the stations see less")
def test_a_station_may_hold_a_mask():
    cloud, station = PointCloud(ball()), {"viewpoint": [0, 0, 5]}
    found = cloud.calibrate([{**station, "indices": np.arange(1000)}])
    assert found.options == {"looks": 3, "thickness": found.thickness} and 0 <= found.shown <= 1
    assert cloud.calibrate([{**station, "mask": (np.arange(2000) < 1000).astype(np.uint8)}]) == found


IMAGE = np.zeros((48, 64))


@pytest.mark.parametrize(
    ("code", "words", "call"),
    [
        ("viewpoint", "cameras", lambda: CLOUD.seen_by(7)),
        ("viewpoint", "cameras", lambda: CLOUD.seen_by(CAMERAS[0])),
        ("viewpoint", r"cameras\[1\]", lambda: CLOUD.seen_by([CAMERAS[0], VIEWPOINT])),
        ("viewpoint", r"viewpoints\[1\].*exactly one", lambda: CLOUD.coverage([VIEWPOINT, {"fx": 3}])),
        ("viewpoint", "finite and positive", lambda: CLOUD.visible_from_any([camera(VIEWPOINT, fx=0)])),
        ("viewpoint", "fx is missing", lambda: CLOUD.seen_by([{**camera(VIEWPOINT), "fx": None}])),
        ("viewpoint", "width is missing", lambda: CLOUD.seen_by([{**camera(VIEWPOINT), "width": None}])),
        ("viewpoint", "width must be a number, got 1000", lambda: CLOUD.seen_by([camera(VIEWPOINT, width=10**400)])),
        ("viewpoint", "convention must be .*, got array", lambda: CLOUD.seen_by([camera(VIEWPOINT, convention=np.array(["opencv"] * 2))])),
        ("option", "scores.*seen_by", lambda: CLOUD.seen_by(CAMERAS, looks=3, scores=True)),
        ("option", "normals", lambda: orient_normals(ball(3), CLOUD.seen_by(CAMERAS))),
        ("option", "normals", lambda: orient_normals("up", CLOUD.seen_by(CAMERAS))),
        ("option", "seen_by", lambda: orient_normals(ball(), CAMERAS)),
        ("option", "seen_by", lambda: orient_normals(ball(), CLOUD.seen_by(CAMERAS)._replace(towards=np.zeros((1, 3), "f4")))),
        ("option", "one image for each of 3", lambda: transfer(CLOUD, CAMERAS, [IMAGE])),
        ("option", "images", lambda: transfer(CLOUD, CAMERAS, 7)),
        ("option", r"images\[1\].*array", lambda: transfer(CLOUD, CAMERAS, [IMAGE, object(), IMAGE])),
        ("option", r"images\[1\].*array", lambda: transfer(CLOUD, CAMERAS, [IMAGE, IMAGE[0], IMAGE])),
        ("option", r"images\[2\].*64 x 48", lambda: transfer(CLOUD, CAMERAS, [IMAGE, IMAGE, IMAGE.T])),
        ("option", r"images\[2\].*1 channels", lambda: transfer(CLOUD, CAMERAS, [IMAGE, IMAGE, np.zeros((48, 64, 3))])),
        ("option", "channels", lambda: transfer(CLOUD, CAMERAS[:1], [np.zeros((48, 64, 0))])),
        ("option", "merge must be one of", lambda: transfer(CLOUD, CAMERAS, [IMAGE] * 3, merge="max")),
        ("option", "weights must be one of", lambda: transfer(CLOUD, CAMERAS, [IMAGE] * 3, weights=1)),
        ("option", "cannot be combined", lambda: transfer(CLOUD, CAMERAS, [IMAGE] * 3, merge="vote", sampling="bilinear")),
        ("option", "scores.*transfer", lambda: transfer(CLOUD, CAMERAS, [IMAGE] * 3, looks=3, scores=True)),
        ("option", "looks", lambda: transfer(CLOUD, CAMERAS, [IMAGE] * 3, weights="score", exponent=3)),
        ("option", "unknown option", lambda: transfer(CLOUD, CAMERAS, [IMAGE] * 3, colour=1)),
        ("option", "points", lambda: CLOUD.visibility_map(VIEWPOINT, points=3)),
        ("option", "towards", lambda: CLOUD.visibility_map(VIEWPOINT, towards=7)),
        ("option", "towards", lambda: CLOUD.visibility_map(VIEWPOINT, towards={"direction": [0, 0, 1]})),
        ("viewpoint", "fx", lambda: CLOUD.visibility_map(VIEWPOINT, towards={**camera(VIEWPOINT), "fx": 0.0})),
        ("viewpoint", "finite", lambda: CLOUD.visibility_map(VIEWPOINT, origin=[0, 0, np.inf])),
        ("positions-length", "positions", lambda: CLOUD.visibility_map(VIEWPOINT).hides([[0, 0]])),
        ("option", "at least one station", lambda: CLOUD.calibrate([])),
        ("option", "stations must be a list", lambda: CLOUD.calibrate(7)),
        ("option", r"stations\[0\]", lambda: CLOUD.calibrate([7])),
        ("option", "integers", lambda: CLOUD.calibrate([{"viewpoint": VIEWPOINT, "indices": [[1], [2, 3]]}])),
        ("option", "viewpoint", lambda: CLOUD.calibrate([{"indices": [1]}])),
        ("option", "one of indices and mask", lambda: CLOUD.calibrate([{"viewpoint": VIEWPOINT}])),
        ("option", "no points", lambda: CLOUD.calibrate([{"viewpoint": VIEWPOINT, "indices": []}])),
        ("option", "index 2000", lambda: CLOUD.calibrate([{"viewpoint": VIEWPOINT, "indices": [2000]}])),
        ("option", "mask", lambda: CLOUD.calibrate([{"viewpoint": VIEWPOINT, "mask": [True]}])),
        ("viewpoint", r"stations\[0\]", lambda: CLOUD.calibrate([{"viewpoint": [0], "indices": [1]}])),
    ],
)
def test_bad_input_is_refused(code, words, call):
    with pytest.raises(HprError, match=words) as refused:
        call()
    assert refused.value.code == code, str(refused.value)
