"""Files of cameras. They give what the npm package reads in the same files."""

import json
import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hidden_point_removal import HprError, PointCloud, colmap_vis, read_cameras

PACKAGE = Path(__file__).parents[2] / "dist" / "files.js"
#: COLMAP's models by its numbers, with parameters.
MODELS = [
    ("SIMPLE_PINHOLE", [500, 320, 240]),
    ("PINHOLE", [500, 510, 320.5, 240.25]),
    ("SIMPLE_RADIAL", [500, 320, 240, 0.1]),
    ("RADIAL", [500, 320, 240, 0.1, -0.02]),
    ("OPENCV", [500, 510, 320, 240, 0.1, -0.02, 0.001, 0.002]),
    ("OPENCV_FISHEYE", [500, 510, 320, 240, 0.1, -0.02, 0.003, 0.004]),
    ("FULL_OPENCV", [500, 510, 320, 240, 0.1, -0.02, 0.001, 0.002, 0.03, 0.04, 0.05, 0.06]),
    ("FOV", [500, 510, 320, 240, 0.9]),
    ("SIMPLE_RADIAL_FISHEYE", [500, 320, 240, 0.1]),
    ("RADIAL_FISHEYE", [500, 320, 240, 0.1, -0.02]),
    ("THIN_PRISM_FISHEYE", [500, 510, 320, 240, 0.1, -0.02, 0.001, 0.002, 0.03, 0.04, 0.05, 0.06]),
]
POSES = np.random.default_rng(4).normal(size=(len(MODELS), 7))
NAMES = [f"left/photo {number} ä.jpg" for number in range(len(MODELS))]
CAMERAS_TXT = "# Camera list\n" + "\n".join(
    f"{number + 1} {model} 640 480 {' '.join(map(str, numbers))}" for number, (model, numbers) in enumerate(MODELS))
IMAGES_TXT = "# Image list\r\n" + "\r\n".join(
    f"{number} {' '.join(map(repr, map(float, pose)))} {number + 1} {name}\r\n{'1.5 2.25 -1 ' * (number % 3)}"
    for number, (pose, name) in enumerate(zip(POSES, NAMES)))
CAMERAS_BIN = struct.pack("<Q", len(MODELS)) + b"".join(
    struct.pack(f"<IIQQ{len(numbers)}d", number + 1, number, 640, 480, *numbers) for number, (_, numbers) in enumerate(MODELS))
IMAGES_BIN = struct.pack("<Q", len(MODELS)) + b"".join(
    struct.pack("<I7dI", number, *pose, number + 1) + name.encode() + b"\0" + struct.pack("<Q", number % 3) + bytes(24 * (number % 3))
    for number, (pose, name) in enumerate(zip(POSES, NAMES)))
ROUNDED = {"file_path": "b.png", "transform_matrix": [[0.8, -0.6, 0, 2], [0.6001, 0.8, 0, 3], [0, 0, 1, 4], [0, 0, 0, 1]]}
FRAME = {"file_path": "images/a.png", "transform_matrix": [[0, 0, 1, 2], [1, 0, 0, 3], [0, 1, 0, 4], [0, 0, 0, 1]]}
NERF = {"w": 640, "h": 480, "fl_x": 500, "fl_y": 510.5, "k1": 0.1, "p2": 0.02, "k3": 0.3,
        "frames": [FRAME, {**FRAME, "fl_x": 400, "w": 320, "k1": 0.5}]}
BLENDER = {"w": 800, "h": 600, "camera_angle_x": 1.5, "camera_model": "OPENCV_FISHEYE", "k4": 0.4, "frames": [FRAME]}
OWN = [{"cameraToWorld": np.eye(4).ravel().tolist(), "fx": 5, "fy": 5, "cx": 2, "cy": 2, "width": 4, "height": 4, "image": "a.png"}]
SPLATS = [{"id": 0, "img_name": "a.png", "width": 640, "height": 480, "position": [1, 2, 3],
           "rotation": [[0, 0, 1], [1, 0, 0], [0, 1, 0]], "fy": 510.5, "fx": 500}]
KITTI = """P0: 700 0 600 0 0 710 180 0 0 0 1 0
P2: 700 0 600 35 0 710 180 -7.1 0 0 1 0.002
R0_rect: 0.8 -0.6 0 0.6 0.8 0 0 0 1
Tr_velo_to_cam: 0 -1 0 0.1 0 0 -1 0.2 1 0 0 -0.3
Tr_imu_to_velo: 1 0 0"""
YAML = """%YAML:1.0
---
calibration_time: "today"
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.0e+02, 0., 3.195e+02, 0., 510., 239.5,
       0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ 0.1, -0.2, 0.001, 0.002, 0.05 ]
"""
ROS = ("image_width: 640\nimage_height: 480\ncamera_matrix:\n  data: [500, 0, 320, 0, 500, 240, 0, 0, 1]\n"
       "distortion_model: equidistant\ndistortion_coefficients: { rows: 1, cols: 4, data: [1, 2, 3, 4] }")
GOOD = {
    "colmap text": {"cameras.txt": CAMERAS_TXT, "images.txt": IMAGES_TXT},
    "colmap binary": {"cameras.bin": CAMERAS_BIN, "images.bin": IMAGES_BIN, "images.txt": ""},
    "nerfstudio": {"transforms.json": json.dumps(NERF)},
    "blender": {"transforms.json": "\ufeff" + json.dumps(BLENDER)},
    "own": {"calib.txt": json.dumps(OWN)},
    "splats": {"transforms.json": json.dumps(SPLATS)},
    "kitti": {"calib.txt": KITTI},
    "odometry": {"calib.txt": KITTI.replace("Tr_velo_to_cam", "Tr").replace("R0", "Q")},
    "opencv": {"camera.yml": YAML},
    "ros": {"camera.yaml": ROS},
    "rounded": {"transforms.json": json.dumps({**NERF, "frames": [ROUNDED]})},
}


def folder(path, files):
    path.mkdir()
    for name, content in files.items():
        (path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


def listed(read):
    """Cameras as JavaScript lists them."""
    names = {"camera_to_world": "cameraToWorld", "world_to_camera": "worldToCamera"}
    flat = lambda value: np.transpose(value).ravel().tolist() if np.ndim(value) == 2 else value
    return [{"image": image, "camera": {names.get(name, name): flat(value) for name, value in camera.items()}} for camera, image in read]


def outcome(path):
    try:
        return listed(read_cameras(path))
    except HprError as refused:
        assert refused.code == "load" and " cannot be read: " in str(refused), refused
        return str(refused)


SCRIPT = """
const { readCameras } = await import(process.argv[1]);
for (const path of process.argv.slice(2)) {
  const flat = ({ image, camera }) => ({ image, camera: Object.fromEntries(Object.entries(camera).map(([k, v]) => [k, v.length > 0 && typeof v !== "string" ? [...v] : v])) });
  console.log(JSON.stringify(await readCameras(path).then((all) => all.map(flat), (error) => error.message)));
}
"""


def in_javascript(paths):
    command = ["node", "--input-type=module", "-e", SCRIPT, PACKAGE.as_uri(), *paths]
    done = subprocess.run(command, check=False, capture_output=True, text=True, encoding="utf-8")
    assert done.returncode == 0, done.stderr
    return [json.loads(line) for line in done.stdout.splitlines()]


def same(own, other):
    if isinstance(own, (list, dict)):
        keys = own.keys() if isinstance(own, dict) else range(len(own))
        return type(own) is type(other) and len(own) == len(other) and all(same(own[key], other[key]) for key in keys)
    return own == (other if isinstance(own, str) else pytest.approx(other, rel=1e-14, abs=1e-15))


needs_node = pytest.mark.skipif(shutil.which("node") is None or not PACKAGE.exists(), reason="the npm package is not built")


@needs_node
def test_the_same_cameras_as_the_npm_package(tmp_path):
    paths = [folder(tmp_path / name, files) for name, files in GOOD.items()]
    for path, other in zip(paths, in_javascript(paths), strict=True):
        assert same(listed(read_cameras(path)), other), path
    text, binary = (read_cameras(path) for path in paths[:2])
    assert listed(text) == listed(binary) and [image for _, image in text] == NAMES
    assert listed(read_cameras([paths[0] / "images.txt", str(paths[0] / "cameras.txt")])) == listed(text)
    assert read_cameras(tmp_path / "kitti", 1224, 370)[0].camera["width"] == 1224
    for camera, _ in text:
        assert PointCloud([[0, 0, 9.0]]).visible_from_camera(camera).count <= 1


@needs_node
def test_damaged_files_are_refused_where_the_npm_package_refuses_them(tmp_path):
    random, paths = np.random.default_rng(16), []
    for number in range(300):
        files = dict(list(GOOD.values())[number % len(GOOD)])
        name = list(files)[random.integers(min(len(files), 2))]
        content = files[name]
        content = bytearray(content if isinstance(content, bytes) else content.encode())
        for at in random.integers(len(content), size=random.integers(1, 3)):
            content[at] = random.integers(256)
        files[name] = bytes(content[: random.integers(len(content))] if random.integers(8) == 0 else content)
        paths.append(folder(tmp_path / str(number), files))
    differ, refused = [], 0
    for path, other in zip(paths, in_javascript(paths), strict=True):
        own = outcome(path)
        refused += isinstance(own, str)
        # Python asks the core at once whether a camera is sound; JavaScript when it is used.
        if isinstance(own, str) and ": the camera" in own:
            continue
        if isinstance(own, str) != isinstance(other, str) or not (isinstance(own, str) or same(own, other)):
            differ.append((path.name, own if isinstance(own, str) else "read", other if isinstance(other, str) else "read"))
    assert differ == [] and 75 < refused < 275


CAMERA, IMAGE = "1 PINHOLE 640 480 500 500 320 240", "1 1 0 0 0 0 0 0 1 a.jpg"


@pytest.mark.parametrize(("files", "words"), [
    ({"cameras.txt": CAMERA + " 5", "images.txt": IMAGE}, r"cameras.txt cannot be read: line 1 goes on"),
    ({"cameras.txt": CAMERA.replace("PINHOLE", "DIVISION"), "images.txt": IMAGE}, "line 1 has a MODEL that is not read: 'DIVISION'"),
    ({"cameras.txt": f"{CAMERA}\n{CAMERA}", "images.txt": IMAGE}, "line 2 has a CAMERA_ID a second time"),
    ({"cameras.txt": CAMERA.replace("320", "x"), "images.txt": IMAGE}, "line 1 has no finite number for PARAMS"),
    ({"cameras.txt": CAMERA.replace("500", "-5"), "images.txt": IMAGE}, "line 1: .*fx"),
    ({"cameras.txt": CAMERA, "images.txt": IMAGE.replace("1 a", "2 a")}, "images.txt cannot be read: line 1 has a CAMERA_ID that"),
    ({"cameras.txt": CAMERA, "images.txt": IMAGE.replace("1 1 0", "1 0 0")}, "line 1: .*rigid|line 1: .*finite"),
    ({"cameras.txt": CAMERA, "images.txt": f"{IMAGE}\n{IMAGE}"}, "line 2 does not hold POINTS2D"),
    ({"cameras.txt": CAMERA, "images.txt": "\0\1"}, "it is not text"),
    ({"cameras.bin": CAMERAS_BIN[:30], "images.bin": IMAGES_BIN}, "byte 0 has 11 for the number of cameras"),
    ({"cameras.bin": CAMERAS_BIN, "images.bin": IMAGES_BIN + b"\0"}, f"it goes on at byte {len(IMAGES_BIN)}"),
    ({"images.bin": IMAGES_BIN}, "give both, or their folder"),
    ({"calib.txt": KITTI.replace("P0: 700 0", "P0: 700 2")}, "line 1 has a P0 with a skew"),
    ({"calib.txt": KITTI.replace("180 0 0 0 1 0", "180 0 0 3 1 0")}, "line 1 has a P0 with a skew, or a third row"),
    ({"transforms.json": "{ frames"}, "it is not JSON"),
    ({"transforms.json": json.dumps({**NERF, "fl_x": "500"})}, r"frames\[0\].fl_x must be a finite number, got '500'"),
    ({"transforms.json": json.dumps({**NERF, "fl_x": float("nan")})}, r"frames\[0\].fl_x must be a finite number, got 'NaN'"),
    ({"transforms.json": json.dumps({**NERF, "frames": [FRAME, 5]})}, r"frames\[1\] must be an object"),
    ({"calib.txt": KITTI.replace(" 0.002", "")}, "line 2 has 11 numbers for P2, not 12"),
    ({"calib.txt": KITTI.replace("P0: 700", "P0: 0")}, "line 1: .*fx"),
    ({"camera.yml": YAML.replace("rows: 5", "rows: 6")}, "line 12 has 5 numbers for distortion_coefficients"),
    ({"camera.yml": YAML.replace("image_width: 640", "")}, "it has no image_width and image_height"),
    ({"a.txt": "1 2 3"}, "it is none of the files of cameras"),
    ({}, "must hold cameras and images"),
    ({"a.txt": "", "b.txt": ""}, "must hold cameras and images"),
])
def test_files_that_are_wrong_are_refused(tmp_path, files, words):
    path = folder(tmp_path / "files", files)
    with pytest.raises(HprError, match=words) as refused:
        read_cameras(path / next(iter(files)) if len(files) == 1 else path)
    assert refused.value.code == "load"


@pytest.mark.parametrize(("source", "code"), [(None, "option"), (7, "option"), ([7], "option"), ("nothing", "load"), ("a\0b", "load"), ([], "load")])
def test_sources_that_are_none_are_refused(source, code):
    with pytest.raises(HprError) as refused:
        read_cameras(source)
    assert refused.value.code == code
    with pytest.raises(HprError, match="width") as refused:
        read_cameras(".", width=5)
    assert refused.value.code == "option"


def test_colmap_vis():
    cloud = PointCloud([[0, 0, 1.0], [0, 0, 2.0], [1, 0, 0]])
    lens = {"fx": 1, "fy": 1, "cx": 500, "cy": 500, "width": 1000, "height": 1000}
    poses = [np.diag([1.0, -1, -1, 1]), np.eye(4)]
    poses[0][2, 3], poses[1][2, 3] = 5, -5
    seen = cloud.seen_by([{"camera_to_world": pose, **lens} for pose in poses], exponent=3)
    numbers = [[int(camera) for camera in seen.cameras[a:b]] for a, b in zip(seen.offsets, seen.offsets[1:])]
    expected = struct.pack("<Q", 3) + b"".join(struct.pack(f"<{len(row) + 1}I", len(row), *row) for row in numbers)
    assert colmap_vis(seen) == expected and {len(row) for row in numbers} == {1, 2}
    for wrong in (None, seen._replace(cameras=seen.cameras[1:])):
        with pytest.raises(HprError, match="what seen_by of a cloud answers"):
            colmap_vis(wrong)
