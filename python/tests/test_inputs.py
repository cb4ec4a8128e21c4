"""Arguments are read as other libraries hold them, or refused: never misread."""

import importlib.util
import inspect
import signal
import subprocess
import sys
import textwrap

import numpy as np
import pytest

from hidden_point_removal import Horizon, HprError, PointCloud, hidden_point_removal, merge_visible, orient_normals, transfer

VIEWPOINT = [0.0, 0.0, 4.0]
POINTS = np.random.default_rng(1).normal(size=(500, 3))
SEEN = PointCloud(POINTS).visible_from(VIEWPOINT)

# Whole numbers, which each type holds. 40 points.
pytestmark = pytest.mark.filterwarnings("ignore:the stations see less", "ignore:next to no points")
WHOLE = np.random.default_rng(2).integers(-9, 10, (40, 3))
EYE = [3, 5, 40]
MASK = np.arange(40) % 3 == 0
POSE = [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 60], [0, 0, 0, 1]]
LENS = {"fx": 50, "fy": 50, "cx": 20, "cy": 15, "width": 40, "height": 30}
CAMERA = {"camera_to_world": POSE, **LENS}


def cloud():
    return PointCloud(WHOLE)


def removed(given):
    own = cloud()
    own.remove(given)
    return own.visible_from(EYE).indices


def grown(given):
    own = cloud()
    own.append(given)
    return own.visible_from(EYE).indices


def screened(given):
    horizon = Horizon(EYE, radius=900)
    horizon.add(given)
    return horizon.screen(given)


def seen_by(camera):
    return cloud().seen_by([camera]).offsets


#: Each argument that is an array: what it holds, an answer that depends on it, and a good value.
ARGUMENTS = {
    "positions": ("real", lambda v: PointCloud(v).visible_from(EYE).indices, WHOLE),
    "append": ("real", grown, WHOLE[::-1] + 1),
    "sees": ("real", lambda v: cloud().sees(EYE, v), WHOLE * 2),
    "hides": ("real", lambda v: cloud().visibility_map(EYE).hides(v), WHOLE),
    "horizon": ("real", screened, WHOLE),
    "merge": ("real", lambda v: merge_visible([(v, range(40))], EYE, radius=900), WHOLE),
    "viewpoint": ("real", lambda v: cloud().visible_from(v).indices, EYE),
    "viewpoint (3, 1)": ("real", lambda v: cloud().visible_from(v).indices, np.reshape(EYE, (3, 1))),
    "viewpoints": ("real", lambda v: cloud().coverage(v), [EYE, [0, 50, 0]]),
    "candidates": ("real", lambda v: cloud().place_viewpoints(v).seen, [EYE, [0, 50, 0]]),
    "any": ("real", lambda v: cloud().visible_from_any(v).indices, [EYE, [0, 50, 0]]),
    "direction": ("real", lambda v: cloud().visible_from_direction(v).indices, [0, 1, -2]),
    "up": ("real", lambda v: cloud().panorama(EYE, 8, 4, up=v).ranges, [0, 1, 2]),
    "origin": ("real", lambda v: cloud().visibility_map(EYE, origin=v).uniforms["hprViewpoint"], [1, 2, 3]),
    "lights": ("real", lambda v: cloud().illuminate(v), [EYE, [0, 50, 0]]),
    "box": ("real", lambda v: cloud().visible_from(EYE, within={"box": v}).indices, [[-9, -9, 0], [9, 9, 9]]),
    "hides_box": ("real", lambda v: Horizon(EYE, radius=900).hides_box(v, [9, 9, 9]), [-9, -9, -9]),
    "pose": ("real", lambda v: seen_by({"camera_to_world": v, **LENS}), POSE),
    "pose (3, 4)": ("real", lambda v: seen_by({"camera_to_world": v, **LENS}), POSE[:3]),
    "K": ("real", lambda v: seen_by({"camera_to_world": POSE, "K": v, "width": 40, "height": 30}), [[50, 0, 20], [0, 50, 15], [0, 0, 1]]),
    "distortion": ("real", lambda v: seen_by({**CAMERA, "distortion": v}), [1, 0, 0, 0]),
    "distortion (1, 4)": ("real", lambda v: seen_by({**CAMERA, "distortion": v}), [[1, 0, 0, 0]]),
    "normals": ("real", lambda v: orient_normals(v, cloud().seen_by([CAMERA])), WHOLE),
    "indices": ("index", removed, [1, 2, 7, 39]),
    "station": ("index", lambda v: cloud().calibrate([{"viewpoint": EYE, "indices": v}]).recall, [1, 2, 7, 39]),
    "ids": ("whole", lambda v: merge_visible([(WHOLE[:4], v)], EYE, radius=900), [1, 2, 7, 39]),
    "triangles": ("whole", lambda v: cloud().illuminate([EYE], triangles=v), [[1, 2, 7], [3, 4, 39]]),
    "mask": ("mask", lambda v: cloud().visible_from(EYE, within={"mask": v}).indices, MASK),
    "station's mask": ("mask", lambda v: cloud().calibrate([{"viewpoint": EYE, "mask": v}]).recall, MASK),
    "weights": ("weight", lambda v: cloud().place_viewpoints([EYE, [0, 50, 0]], weights=v).gains, MASK),
    "images": ("weight", lambda v: transfer(cloud(), [CAMERA], [v])[0], np.arange(1200).reshape(30, 40) % 2),
}
NUMBERS = [bool, *(f"{kind}{bits}" for kind in ("int", "uint") for bits in (8, 16, 32, 64)), "float16", "float32", "float64", ">f8"]
TAKEN = {"real": "iuf", "index": "iub", "whole": "iu", "mask": "biu", "weight": "biuf"}


def forms(array):
    """The same array as others hold it."""
    yield array
    yield np.asfortranarray(array)
    yield np.ma.array(array, mask=False)
    yield Tensor(array)
    if array.dtype.str[0] != ">":
        yield memoryview(array)
        yield from (array.tolist(), tuple(array.tolist())) if array.dtype != bool else ()
        for library, make in LIBRARIES.items():
            try:
                yield make(importlib.import_module(library), np.array(array))
            except (ImportError, TypeError):
                pass


class Tensor:
    """As in torch: `values` is something else, and so are `points`. Torch says what to do with tensors elsewhere."""

    points = "none"

    def __init__(self, array, hint=None):
        self.array, self.hint = array, hint

    def values(self):
        raise NotImplementedError

    def __len__(self):
        return len(self.array)

    def __getitem__(self, number):
        return Tensor(self.array[number])

    def __iter__(self):
        return map(Tensor, self.array)

    def __array__(self, dtype=None, copy=None):
        if self.hint:
            raise TypeError(self.hint)
        return self.array if dtype is None else self.array.astype(dtype)


def table(library, array):
    return (library.DataFrame if array.ndim == 2 else library.Series)(array)


LIBRARIES = {"torch": lambda torch, array: torch.from_numpy(array), "pandas": table, "polars": table}


@pytest.mark.parametrize("number", NUMBERS)
@pytest.mark.parametrize("name", ARGUMENTS)
def test_each_array_is_read_or_refused(name, number):
    kind, ask, good = ARGUMENTS[name]
    good = np.asarray(good)
    expected, dtype = ask(good), np.dtype(number)
    if dtype.kind == "u" and good.min() < 0:
        return
    given = good.astype(dtype)
    # Truth values are a mask where indices are wanted; of another length than the cloud, they are refused.
    taken = dtype.kind in TAKEN[kind] and not (kind == "index" and dtype.kind == "b")
    for form in forms(given):
        if taken:
            assert np.array_equal(ask(form), expected, equal_nan=name == "images"), form
        else:
            with pytest.raises(HprError):
                ask(form)
    if kind == "index" and dtype.kind == "b":
        assert np.array_equal(ask(np.isin(np.arange(40), good)), expected)


@pytest.mark.parametrize("name", ARGUMENTS)
def test_masked_and_structured_arrays_are_refused(name):
    kind, ask, good = ARGUMENTS[name]
    good = np.asarray(good)
    masked = np.ma.array(good, mask=np.arange(good.size).reshape(good.shape) == 1)
    structured = np.zeros(len(good), [("a", "f8"), ("b", "f8")])
    for given in (masked, structured, np.full(good.shape, "1"), good.astype(complex), np.full(good.shape, None), "text", b"bytes", object()):
        if given is masked and name == "hides":
            # A coordinate that is not known is not finite, and so not hidden.
            continue
        with pytest.raises(HprError):
            ask(given)


#: A good value of each parameter of a question, by its name.
VALUES = {
    **dict.fromkeys(("viewpoints", "candidates", "lights"), [EYE, [0, 50, 0]]), "viewpoint": EYE, "direction": [0, 1, -2], "positions": WHOLE.tolist(),
    "camera": CAMERA, "cameras": [CAMERA, CAMERA], "stations": [{"viewpoint": EYE, "indices": [1, 2, 7, 39]}], "indices": [1, 2, 7, 39], "k": 1, "width": 8, "height": 4,
}  # fmt: skip
QUESTIONS = {name: own for name, own in vars(PointCloud).items() if not name.startswith("_") and callable(own)}
WRONG = [
    object(), "text", b"bytes", 5, np.array(5), np.array("text"), [], {}, {5: 1}, {"x": [1, 2], "y": [1], "z": 3}, {1, 2}, [[1], [1, 2]], [None], [object()],
    Tensor(np.array(["a"])), Tensor(WHOLE, "hint"), np.zeros((2, 2, 2)), np.array([None, "a"]), np.zeros(0), iter([EYE]), range(3), -1, float("nan"), 10**30, [10**400] * 3,
]  # fmt: skip


def told(answer):
    """An answer as lists."""
    if hasattr(answer, "data") and hasattr(answer, "uniforms"):
        return answer.data.tolist()
    return [told(part) for part in answer] if type(answer).__mro__[1] is tuple or type(answer) is tuple else np.asarray(answer).tolist()


@pytest.mark.parametrize("name", QUESTIONS)
def test_each_question_takes_what_other_libraries_hold(name):
    needed = [own.name for own in inspect.signature(QUESTIONS[name]).parameters.values() if own.default is own.empty and own.name != "self"]
    good = {parameter: VALUES[parameter] for parameter in needed}

    def ask(given):
        own = cloud()
        answer = QUESTIONS[name](own, *given.values())
        return told(own.visible_from(EYE) if answer is None else answer)

    expected = ask(good)
    for parameter, value in good.items():
        is_array = isinstance(value, list) and not isinstance(value[0], dict)
        for form in forms(np.array(value)) if is_array else (tuple(value), np.array(value, object)) if isinstance(value, list) else ():
            assert ask({**good, parameter: form}) == expected, (parameter, form)
        for form in WRONG:
            try:
                ask({**good, parameter: form})
            except HprError as refused:
                assert refused.code, form


def test_columns_are_read_by_their_names():
    columns = {"label": np.arange(500), "z": POINTS[:, 2], "x": POINTS[:, 0].astype(np.float32), "y": POINTS[:, 1]}
    expected = np.stack([columns[axis] for axis in "xyz"], axis=1)
    seen, counts = PointCloud(expected).visible_from(VIEWPOINT), cloud().coverage(expected[:4])
    tables = [columns, np.rec.fromarrays([*columns.values()], names=[*columns])]
    for library, make in (("pandas", "DataFrame"), ("polars", "DataFrame"), ("pyarrow", "table")):
        if importlib.util.find_spec(library):
            tables.append(getattr(importlib.import_module(library), make)(columns))
    for given in tables:
        assert np.array_equal(PointCloud(given).visible_from(VIEWPOINT), seen), type(given)
        few = given[:4] if given is not columns else {name: column[:4] for name, column in columns.items()}
        assert np.array_equal(cloud().coverage(few), counts), type(given)


def test_an_answer_is_an_index_of_pandas():
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    frame = pandas.DataFrame(POINTS, columns=[*"xyz"], index=np.arange(500)[::-1])
    for part in (frame[SEEN], frame.loc[SEEN], frame.iloc[SEEN], frame.loc[SEEN, [*"xyz"]], frame[SEEN.mask()]):
        assert np.array_equal(part, SEEN.points)
    assert np.array_equal(frame.x[SEEN], SEEN.points[:, 0]) and len(frame[~SEEN]) == 500 - len(SEEN)
    frame.loc[SEEN, "seen"] = 1
    assert frame.seen.sum() == len(SEEN)


class Cloud:
    """As in Open3D: the points are a sequence that NumPy can read."""

    def __init__(self, points, name="points"):
        setattr(self, name, points)


class Lazy:
    def numpy(self):
        return POINTS


def fields(names):
    table = np.zeros(500, [(name, "f8") for name in names])
    for name, column in zip(names, POINTS.T):
        table[name] = column
    return table


@pytest.mark.parametrize(
    "given",
    [
        np.column_stack([POINTS, np.full(500, np.nan)]),
        np.column_stack([POINTS, np.ones((500, 200))]),
        [[*point, 7, 8] for point in POINTS.tolist()],
        Cloud(POINTS),
        Cloud(POINTS.tolist()),
        Cloud(POINTS, "xyz"),
        Cloud(POINTS, "vertices"),
        Cloud({"positions": Lazy()}, "point"),
        Tensor(POINTS),
        Lazy(),
        fields(["x", "y", "z", "intensity"]),
        fields(["X", "Y", "Z"]),
        fields(["x", "y", "z", "intensity"]).view(np.recarray),
        {f"cartesian{axis}": column for axis, column in zip("XYZ", POINTS.T)},
    ],
    ids=["columns", "features", "lists", "cloud", "lists", "laspy", "trimesh", "open3d.t", "tensor", "numpy()", "fields", "FIELDS", "records", "pye57"],
)
def test_points_are_read_as_they_are(given):
    assert np.array_equal(PointCloud(given).visible_from(VIEWPOINT).indices, SEEN.indices)
    cloud = PointCloud(POINTS[:1])
    cloud.append(given)
    assert len(cloud) == 501
    assert np.array_equal(hidden_point_removal(given, VIEWPOINT, SEEN.radius), SEEN.indices)
    assert np.array_equal(hidden_point_removal(given, VIEWPOINT), SEEN.indices)


def test_the_function_takes_all_options():
    seen = PointCloud(POINTS).visible_from(VIEWPOINT, looks=3, thickness=0.1).indices
    assert np.array_equal(hidden_point_removal(POINTS, VIEWPOINT, looks=3, thickness=0.1), seen)
    assert not np.array_equal(seen, SEEN.indices)


def test_surface_overrides_what_a_cloud_is():
    cloud = PointCloud(POINTS)
    assert cloud.surface == "clean"
    found, clean, noisy = (
        cloud.visible_from(VIEWPOINT, looks=3, surface=surface).indices for surface in ("auto", "clean", "noisy")
    )
    assert np.array_equal(found, clean) and not np.array_equal(noisy, clean)
    with pytest.raises(HprError, match="surface.*rough"):
        cloud.visible_from(VIEWPOINT, looks=3, surface="rough")


def test_a_file_is_read(tmp_path):
    np.save(tmp_path / "points.npy", POINTS.astype(np.float32))
    assert len(PointCloud(tmp_path / "points.npy")) == len(PointCloud(str(tmp_path / "points.npy"))) == 500


def test_clouds_of_laspy_are_read(tmp_path):
    laspy = pytest.importorskip("laspy")
    las = laspy.create()
    las.header.scales = [0.001] * 3
    las.xyz = POINTS
    las.write(tmp_path / "cloud.las")
    rounded = PointCloud(las.xyz).visible_from(VIEWPOINT).indices
    with laspy.open(tmp_path / "cloud.las") as file:
        for given in (las, las.points, tmp_path / "cloud.las", next(file.chunk_iterator(500))):
            assert np.array_equal(PointCloud(given).visible_from(VIEWPOINT).indices, rounded), given


def test_clouds_of_trimesh_are_read():
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(3)
    for given in (ball, trimesh.PointCloud(ball.vertices), trimesh.Scene([ball])):
        assert PointCloud(given).visible_from(VIEWPOINT).count == PointCloud(ball.vertices).visible_from(VIEWPOINT).count


class Reconstruction:
    """As in pycolmap: images by their ids, of which some have a pose."""

    class Image:
        class cam_from_world:
            @staticmethod
            def matrix():
                return np.linalg.inv(POSE)[:3]

        class camera:
            model, model_name, params, width, height = 2, "SIMPLE_RADIAL", [50, 20, 15, 0], 40, 30

    class Images:
        def values(self):
            return [Reconstruction.Image(), Reconstruction.Image()]

        def __getitem__(self, number):
            return Reconstruction.Image()

    images = Images()

    def reg_image_ids(self):
        return [4, 7]


def reconstruction():
    pycolmap = pytest.importorskip("pycolmap")
    made = pycolmap.Reconstruction()
    made.add_camera_with_trivial_rig(pycolmap.Camera(model="SIMPLE_RADIAL", width=40, height=30, params=[50, 20, 15, 0], camera_id=1))
    pose = pycolmap.Rigid3d(np.linalg.inv(POSE)[:3])
    for number in (4, 7):
        made.add_image_with_trivial_frame(pycolmap.Image(name=f"{number}.jpg", camera_id=1, image_id=number), pose)
    return made


@pytest.mark.parametrize("make", [Reconstruction, reconstruction])
def test_a_reconstruction_of_pycolmap_is_a_list_of_cameras(make):
    made, expected = make(), cloud().seen_by([CAMERA, CAMERA])
    for given in (made, made.images, list(made.images.values())):
        assert np.array_equal(cloud().seen_by(given).cameras, expected.cameras)
        assert cloud().coverage(given).tolist() == np.diff(expected.offsets).tolist()
    assert cloud().visible_from_camera(made.images[4]).count == len(expected.cameras) / 2


def test_what_torch_says_is_passed_on():
    hint = "can't convert cuda:0 device type tensor to numpy. Use Tensor.cpu() to copy the tensor to host memory first."
    for ask in (PointCloud, cloud().visible_from, cloud().remove, lambda v: seen_by({"camera_to_world": v, **LENS})):
        with pytest.raises(HprError, match=r"Use Tensor\.cpu\(\)"):
            ask(Tensor(POINTS, hint))


def test_torch():
    torch = pytest.importorskip("torch")
    tensor = torch.from_numpy(POINTS)
    seen = PointCloud(tensor).visible_from(torch.tensor(VIEWPOINT))
    assert np.array_equal(seen.indices, SEEN.indices)
    assert torch.equal(tensor[seen], tensor[torch.from_numpy(seen.mask())]) and torch.equal(tensor[~seen], tensor[~torch.from_numpy(seen.mask())])
    with pytest.raises(HprError, match="detach"):
        PointCloud(tensor.requires_grad_())


def test_columns_keep_their_precision_and_their_masks():
    single = np.column_stack([POINTS, POINTS]).astype(np.float32)
    expected = PointCloud(single[:, :3].copy()).visible_from(VIEWPOINT)
    seen = PointCloud(single).visible_from(VIEWPOINT)
    assert np.array_equal(seen.indices, expected.indices) and seen.radius == expected.radius
    masked = np.ma.array(single, mask=False)
    masked[3, 1] = masked[4, 5] = np.ma.masked
    assert PointCloud(masked, non_finite="skip").skipped == 1


@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("positions-length", POINTS.T),
        ("positions-length", Cloud(POINTS[:, :2])),
        ("positions-type", Cloud("points")),
        ("positions-type", Cloud(None)),
        ("positions-type", object()),
        ("positions-type", fields(["x", "y", "w"])),
        ("positions-type", "points.xyz"),
        ("load", "nowhere.npy"),
    ],
)
def test_other_things_are_refused(code, given):
    with pytest.raises(HprError) as refused:
        PointCloud(given)
    assert refused.value.code == code, str(refused.value)


def test_a_mask_removes_what_it_marks():
    own = cloud()
    with pytest.raises(HprError, match=r"mask of the shape \(2,\), but there are 40 points"):
        own.remove([True, False])
    own.remove(own.visible_from(EYE))
    assert own.visible_from(EYE).count > 0 and not np.isin(own.visible_from(EYE), cloud().visible_from(EYE)).any()


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="this system has no timers")
@pytest.mark.parametrize("ask", [
    "PointCloud(points).visible_from_any(np.random.default_rng(1).normal(size=(3000, 3)) * 9)",
    "PointCloud(points).visible_from_any(np.random.default_rng(1).normal(size=(3000, 3)) * 9, threads=2)",
    "PointCloud(points).coverage([[0, 0, 9 + i] for i in range(3000)], looks=3)",
    "PointCloud(points).seen_by([dict(camera, fx=5 + i) for i in range(3000)], looks=3, threads=2)",
    "PointCloud(points[:3000]).illuminate(np.random.default_rng(1).normal(size=(300_000, 3)) * 9)",
    "[PointCloud(points) for _ in range(100_000)]",
    "places = np.tile(points, (90, 1)); signal.setitimer(signal.ITIMER_REAL, 1); PointCloud(points[::-1]).sees([0, 0, 9], places)",
])
def test_ctrl_c_ends_a_question(ask):
    """The question would take minutes. The signal comes in its middle."""
    code = f"""
        import signal
        import numpy as np
        from hidden_point_removal import PointCloud
        points = np.random.default_rng(0).normal(size=(100_000, 3))
        points /= np.linalg.norm(points, axis=1)[:, None]
        camera = dict(world_to_camera=np.eye(4), fy=5, cx=9, cy=9, width=18, height=18)
        signal.signal(signal.SIGALRM, signal.default_int_handler)
        try:
            signal.setitimer(signal.ITIMER_REAL, 1)
            {ask}
        except KeyboardInterrupt:
            print("ended")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], check=True, capture_output=True, text=True, timeout=300)
    assert done.stdout == "ended\n", done.stderr
