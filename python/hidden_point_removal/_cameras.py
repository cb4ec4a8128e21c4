"""Files of cameras, read as `readCameras` of the npm package reads them. The core checks the cameras."""

from __future__ import annotations

import json
import math
import os
import re
import struct
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from ._arguments import refusal
from ._native import HprError, PointCloud
from .types import Camera

PROBE = PointCloud(np.empty((0, 3)))


class CameraOfImage(NamedTuple):
    """A camera, and the image that it has taken."""

    camera: Camera
    """As `PointCloud.visible_from_camera` takes it."""
    image: str
    """The name of the image as the file gives it."""


Size = tuple["float | None", "float | None"]
"""The width and the height of the images, as the caller gives them."""
Read = TypeVar("Read")


class Problem(Exception):
    """A file breaks the rules of its format. The words follow "FILE cannot be read: "."""


def is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


ROUNDED = 1e-3
"""How far a matrix of a file may be from a rotation: single precision, written as text, is up to 1.5e-4 away."""


def checked(camera: Any, where: str) -> Camera:
    for name in POSES.values():
        if name in camera:
            camera = {**camera, name: with_rotation(camera[name])}
    try:
        PROBE.visible_from_camera(camera)
    except HprError as problem:
        raise Problem(f"{where}: {problem}") from problem
    read: Camera = camera
    return read


def with_rotation(pose: Any) -> Any:
    """The pose with the nearest rotation, where its numbers were rounded to fewer digits than cameras take."""
    try:
        rows = np.array(pose, dtype=float)
    except (TypeError, ValueError):
        return pose
    if rows.shape == (16,):
        rows = rows.reshape(4, 4).T
    if rows.shape not in ((4, 4), (3, 4)):
        return pose
    off = np.abs(rows[:3, :3] @ rows[:3, :3].T - np.eye(3)).max()
    if not 2e-6 < off <= ROUNDED:
        return pose
    left, _, right = np.linalg.svd(rows[:3, :3])
    rows[:3, :3] = left @ right
    return rows


def looks_binary(data: bytes) -> bool:
    return any(byte < 9 or 13 < byte < 32 for byte in data[:4096])


def lines(data: bytes) -> Iterator[tuple[str, str]]:
    """(place, text) of each line."""
    if looks_binary(data):
        raise Problem("it is not text")
    lines = re.split(r"\r\n|\r|\n", data.decode("utf-8-sig", "replace"))
    return ((f"line {number}", line) for number, line in enumerate(lines, 1))


def floats(words: list[str], where: str, field: str, *counts: int) -> list[float]:
    try:
        numbers = [float(word.replace("_", "?")) for word in words]
    except ValueError:
        numbers = [math.nan]
    if not all(map(math.isfinite, numbers)):
        raise Problem(f"{where} has no finite number for {field}: {' '.join(words)[:60]!r}")
    if len(numbers) not in counts:
        raise Problem(f"{where} has {len(numbers)} numbers for {field}, not {' or '.join(map(str, counts))}")
    return numbers


# COLMAP, in text and in binary.

#: How many coefficients COLMAP's models have, in the order of COLMAP's numbers for them.
MODELS = {"SIMPLE_PINHOLE": 0, "PINHOLE": 0, "SIMPLE_RADIAL": 1, "RADIAL": 2, "OPENCV": 4, "OPENCV_FISHEYE": 4, "FULL_OPENCV": 8,
          "FOV": 1, "SIMPLE_RADIAL_FISHEYE": 1, "RADIAL_FISHEYE": 2, "THIN_PRISM_FISHEYE": 8}


class Lines:
    """COLMAP's text, as `Bytes` reads the same in binary."""

    def __init__(self, data: bytes) -> None:
        self.lines = lines(data)

    def entries(self, _name: str, _least: int) -> Iterator[None]:
        for self.where, self.text in self.lines:
            self.words = self.text.split()
            if self.words and not self.words[0].startswith("#"):
                yield
                if self.words:
                    raise Problem(f"{self.where} goes on after its last field: {self.text[:60]!r}")

    def integer(self, field: str) -> int:
        word = self.words.pop(0) if self.words else ""
        if not re.fullmatch(r"\d{1,15}", word, re.ASCII):
            raise Problem(f"{self.where} has no number for {field}: {self.text[:60]!r}")
        return int(word)

    long = integer

    def model(self) -> str:
        return self.words.pop(0) if self.words else ""

    def floats(self, count: int, field: str) -> list[float]:
        words, self.words = self.words[:count], self.words[count:]
        return floats(words, self.where, field, count)

    def name(self) -> str:
        self.words, words = [], self.words
        if not words:
            raise Problem(f"{self.where} has no NAME: {self.text[:60]!r}")
        return self.text.strip().split(None, 9)[9]

    def skip_points(self) -> None:
        where, text = next(self.lines, ("", ""))
        words = text.split()
        # A file without these lines would otherwise lose every other image.
        if len(words) % 3:
            raise Problem(f"{where} does not hold POINTS2D, as every line below an image does: {text[:60]!r}")
        floats(words[-1:], where, "POINTS2D", 0, 1)


class Bytes:
    """COLMAP's binary files: little-endian numbers one after another."""

    def __init__(self, data: bytes) -> None:
        self.data, self.at = data, 0

    def entries(self, name: str, least: int) -> Iterator[None]:
        count = self.count(f"the number of {name}s", least)
        for number in range(1, count + 1):
            self.where = f"{name} {number} of {count}, at byte {self.at},"
            yield
        if self.at < len(self.data):
            raise Problem(f"it goes on at byte {self.at}, after its last entry")

    def take(self, kind: str, field: str) -> tuple[Any, ...]:
        return struct.unpack_from(kind, self.data, self.skip(struct.calcsize(kind), field))

    def skip(self, length: int, field: str) -> int:
        if length > len(self.data) - self.at:
            raise Problem(f"it ends at byte {len(self.data)}, in {field}")
        self.at += length
        return self.at - length

    def count(self, field: str, least: int) -> int:
        at, count = self.at, self.long(field)
        if count * least > len(self.data) - self.at:
            raise Problem(f"byte {at} has {count} for {field}, more than the file holds")
        return count

    def integer(self, field: str) -> int:
        return int(self.take("<I", field)[0])

    def long(self, field: str) -> int:
        return int(self.take("<Q", field)[0])

    def model(self) -> str:
        number = self.integer("MODEL_ID")
        return [*MODELS][number] if number < len(MODELS) else f"MODEL_ID {number}"

    def floats(self, count: int, field: str) -> list[float]:
        return list(self.take(f"<{count}d", field))

    def name(self) -> str:
        end = self.data.find(b"\0", self.at)
        if end < 0:
            raise Problem(f"byte {self.at} begins a text for NAME that does not end")
        return self.data[self.skip(end + 1 - self.at, "NAME") : end].decode("utf-8", "replace")

    def skip_points(self) -> None:
        self.skip(24 * self.count("the number of POINTS2D", 24), "POINTS2D")


def read_lenses(reader: Lines | Bytes) -> dict[int, dict[str, Any]]:
    """The lens of each CAMERA_ID."""
    lenses = {}
    for _ in reader.entries("camera", 24):
        identifier, model = reader.integer("CAMERA_ID"), reader.model()
        if identifier in lenses:
            raise Problem(f"{reader.where} has a CAMERA_ID a second time")
        if model not in MODELS:
            raise Problem(f"{reader.where} has a MODEL that is not read: {model[:60]!r}")
        lens = {"width": reader.long("WIDTH"), "height": reader.long("HEIGHT"), "model": model}
        focals = 1 if model.startswith(("SIMPLE_", "RADIAL")) else 2
        numbers = reader.floats(focals + 2 + MODELS[model], "PARAMS")
        lens["fx"], lens["fy"], lens["cx"], lens["cy"], *lens["distortion"] = numbers[: 2 - focals] + numbers
        checked({**lens, "camera_to_world": np.eye(4)}, reader.where)
        lenses[identifier] = lens
    return lenses


def read_images(reader: Lines | Bytes, lenses: dict[int, dict[str, Any]]) -> list[CameraOfImage]:
    images = []
    for _ in reader.entries("image", 73):
        reader.integer("IMAGE_ID")
        *turn, tx, ty, tz = reader.floats(7, "the pose")
        identifier, name = reader.integer("CAMERA_ID"), reader.name()
        if identifier not in lenses:
            raise Problem(f"{reader.where} has a CAMERA_ID that the file of cameras does not have")
        length = math.hypot(*turn) or math.nan
        w, x, y, z = (number / length for number in turn)
        pose = np.array([
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), tx],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), ty],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), tz],
            [0, 0, 0, 1],
        ])
        images.append(CameraOfImage(checked({**lenses[identifier], "world_to_camera": pose}, reader.where), name))
        reader.skip_points()
    return images


# Files of one kind: nerfstudio's, KITTI's, OpenCV's, and JSON of this package.

#: nerfstudio's names. Lenses without a bend get the distortion from k1 to p2 all the same.
PLAIN = ("SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV")
FISHEYE = ("OPENCV_FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE")
#: KITTI's matrices. `Tr` is the odometry's name of `Tr_velo_to_cam`.
MATRICES = {"P0": 12, "P1": 12, "P2": 12, "P3": 12, "R0_rect": 9, "R_rect": 9, "Tr_velo_to_cam": 12, "Tr_velo_cam": 12, "Tr": 12}
#: A camera's poses in JavaScript.
POSES = {"cameraToWorld": "camera_to_world", "worldToCamera": "world_to_camera"}


def read_json(data: bytes, size: Size) -> list[CameraOfImage]:
    """nerfstudio's `transforms.json`, the `cameras.json` of Gaussian splats, or cameras of this package."""
    try:
        found = json.loads(data.decode("utf-8-sig", "replace"), parse_constant=lambda name: name)
    except (ValueError, RecursionError) as problem:
        raise Problem(f"it is not JSON: {problem}") from problem
    if isinstance(found, list) or {"fx", "convention", *POSES, *POSES.values()} & found.keys():
        cameras = found if isinstance(found, list) else [found]
        return [_own(_of_splats(camera), f"camera [{number}]") for number, camera in enumerate(cameras)]
    frames = found.get("frames")
    if not isinstance(frames, list):
        raise Problem("frames must be an array")
    return [_frame(found, frame, f"frames[{number}]", size) for number, frame in enumerate(frames)]


def _of_splats(given: Any) -> Any:
    """An entry of the `cameras.json` of Gaussian splats, as a camera of this package."""
    if not isinstance(given, dict) or "img_name" not in given:
        return given
    values: list[Any] = [given.get(name) for name in ("width", "height", "rotation", "position")]
    width, height, rotation, position = values
    rows = isinstance(rotation, list) and isinstance(position, list) and [
        [*row, x] for row, x in zip(rotation, position) if isinstance(row, list)
    ]
    if not rows or not all(is_number(x) for x in (*sum(rows, []), width, height)):
        raise Problem("a camera of splats must have width, height, a rotation of 3 rows, and a position")
    lens = {"fx": given.get("fx"), "fy": given.get("fy"), "cx": width / 2, "cy": height / 2, "width": width, "height": height}
    return {**lens, "image": given["img_name"], "camera_to_world": [*rows, [0, 0, 0, 1]]}


def _own(given: Any, where: str) -> CameraOfImage:
    """A camera as the methods take it, here or in JavaScript."""
    if not isinstance(given, dict) or not isinstance(given.get("image", ""), str):
        raise Problem(f"{where} must be an object, and its image a text")
    camera = {POSES.get(name, name): value for name, value in given.items() if name != "image"}
    return CameraOfImage(checked(camera, where), given.get("image", ""))


def _frame(file: dict[str, Any], frame: Any, where: str, size: Size) -> CameraOfImage:
    """A frame's own numbers go before those of the file."""
    if not isinstance(frame, dict) or not isinstance(frame.get("file_path"), str):
        raise Problem(f"{where} must be an object, and its file_path a text")
    fields = {**file, **{name: value for name, value in frame.items() if value is not None}}

    def number(name: str, usual: float | None) -> Any:
        value = usual if fields.get(name) is None else fields[name]
        if not is_number(value):
            raise Problem(f"{where}.{name} must be a finite number, got {value!r}")
        return value

    def focal(name: str, angle: str, length: float, usual: float | None) -> Any:
        opening = math.tan(number(angle, 0) / 2)
        return number(name, length / 2 / opening if opening else usual)

    width, height = number("w", size[0]), number("h", size[1])
    fx = focal("fl_x", "camera_angle_x", width, None)
    model = "OPENCV" if fields.get("camera_model") is None else fields["camera_model"]
    is_fisheye = model in FISHEYE or fields.get("is_fisheye") is True
    if not is_fisheye and model not in PLAIN:
        raise Problem(f"{where}.camera_model must be one of {', '.join(PLAIN + FISHEYE)}")
    k1, k2, k3, k4, p1, p2 = (number(name, 0) for name in ("k1", "k2", "k3", "k4", "p1", "p2"))
    if not is_fisheye and k4 != 0:
        raise Problem(f"{where}.k4 must be 0 for a lens that is no fisheye")
    camera = {
        "fx": fx, "fy": focal("fl_y", "camera_angle_y", height, fx), "cx": number("cx", width / 2), "cy": number("cy", height / 2),
        "width": width, "height": height, "model": "OPENCV_FISHEYE" if is_fisheye else "OPENCV",
        "distortion": [k1, k2, k3, k4] if is_fisheye else [k1, k2, p1, p2, k3],
        "camera_to_world": frame.get("transform_matrix"), "convention": "opengl",
    }
    rows = camera["camera_to_world"]
    if not isinstance(rows, list) or not all(isinstance(row, list) and all(map(is_number, row)) for row in rows):
        raise Problem(f"{where}.transform_matrix must be 4 rows of 4 finite numbers")
    return CameraOfImage(checked(camera, where), frame["file_path"])


def read_kitti(data: bytes, size: Size) -> list[CameraOfImage]:
    """The cloud is in the coordinates of the lidar; without `Tr_velo_to_cam`, in those of camera 0."""
    found, cameras = {}, []
    for where, text in lines(data):
        match = re.match(r"(\w+):?[ \t]+(.*)", text.strip(), re.ASCII)
        if match is None or match[1] not in MATRICES:
            continue
        name, rest = match.groups()
        if name in found:
            raise Problem(f"{where} has {name} a second time")
        numbers = floats(rest.split(), where, name, MATRICES[name])
        found[name] = np.array(numbers).reshape(3, -1), where
    rectified = np.eye(4)
    for names in (("Tr_velo_to_cam", "Tr_velo_cam", "Tr"), ("R0_rect", "R_rect")):
        for matrix, _ in [found[name] for name in names if name in found][:1]:
            step = np.eye(4)
            step[:3, : matrix.shape[1]] = matrix
            rectified = step @ rectified
    width, height = (usual if own is None else own for own, usual in zip(size, (1242, 375)))
    for name in sorted(found.keys() & {"P0", "P1", "P2", "P3"}):
        matrix, where = found[name]
        (fx, skew, u, x), (left, fy, v, y), (*third, z) = matrix.tolist()
        if skew != 0 or left != 0 or third != [0, 0, 1]:
            raise Problem(f"{where} has a {name} with a skew, or a third row that is not 0 0 1, which is not read")
        moved = np.eye(4)
        moved[:3, 3] = (x - u * z) / (fx or 1), (y - v * z) / (fy or 1), z
        # The first pixel's center is at 0 there.
        lens = {"fx": fx, "fy": fy, "cx": u + 0.5, "cy": v + 0.5, "width": width, "height": height}
        cameras.append(CameraOfImage(checked({**lens, "world_to_camera": moved @ rectified}, where), f"image_{name[1]}"))
    if not cameras:
        raise Problem("it has none of P0 to P3")
    return cameras


def read_opencv(data: bytes, size: Size) -> list[CameraOfImage]:
    """A calibration that OpenCV or ROS has written as YAML. It has no pose: the camera is at the origin."""
    fields, last = {}, ["", ""]
    for where, text in lines(data):
        match = re.match(r"([A-Za-z_]\w*)\s*:(.*)", text, re.ASCII)
        if match is None:
            last[1] += "" if text.strip().startswith("#") else f" {text.strip()}"
            continue
        name, last = match[1].lower(), [where, match[2].strip()]
        if name in fields:
            raise Problem(f"{where} has {match[1]} a second time")
        fields[name] = last

    def numbers(name: str, *counts: int) -> list[float] | None:
        """The numbers of a field: alone, as a list, or as the data of a matrix. None without it."""
        if name not in fields:
            return None
        where, text = fields[name]
        found = re.search(r"\[([^\]]*)\]", text)
        if found is None and ("[" in text or counts[0] != 1):
            raise Problem(f"{where} has no list for {name}")
        rows, cols = (re.search(rf"\b{key}: *(\d{{1,9}})", text) for key in ("rows", "cols"))
        promised = {int(rows[1]) * int(cols[1])} & {*counts} if rows and cols else counts
        return floats(re.findall(r"[^\s,]+", found[1] if found else text), where, name, *promised)

    matrix = numbers("camera_matrix", 9)
    if matrix is None:
        raise Problem("it has no camera_matrix")
    where, (fx, skew, cx, left, fy, cy, *third) = fields["camera_matrix"][0], matrix
    if skew != 0 or left != 0:
        raise Problem(f"{where} has {skew or left:g} for the skew of camera_matrix, which must be 0")
    if third != [0, 0, 1]:
        row = " ".join(f"{x:g}" for x in third)
        raise Problem(f"{where} has {row} for the third row of camera_matrix, which must be 0 0 1")
    width, height = (own[0] if (own := numbers(name, 1)) else usual for name, usual in zip(("image_width", "image_height"), size))
    if width is None or height is None:
        raise Problem("it has no image_width and image_height; give width and height")
    lens = {"fx": fx, "fy": fy, "cx": cx + 0.5, "cy": cy + 0.5, "width": width, "height": height, "world_to_camera": np.eye(4)}
    of_model, model = fields.get("distortion_model", ("", "plumb_bob"))
    is_fisheye = re.search("equidistant|fisheye", model) is not None or numbers("fisheye_model", 1) == [1]
    if not is_fisheye and not re.search("plumb_bob|rational_polynomial", model):
        raise Problem(f"{of_model} has a distortion_model that is not read: {model[:60]!r}")
    bent = numbers("distortion_coefficients", *((4,) if is_fisheye else (0, 4, 5, 8, 12, 14)))
    if bent and any(bent[8:]):
        raise Problem(f"{fields['distortion_coefficients'][0]} has distortion_coefficients of a thin prism or a tilted sensor, which are not read")
    if bent:
        lens["model"] = "OPENCV_FISHEYE" if is_fisheye else "FULL_OPENCV" if len(bent) > 5 else "OPENCV"
        lens["distortion"] = bent[:8]
    return [CameraOfImage(checked(lens, where), "")]


#: What is taken of a folder.
FOLDERS = (("cameras.bin", "images.bin"), ("cameras.txt", "images.txt"), ("transforms.json",), ("calib.txt",))


def read_cameras(
    source: str | os.PathLike[str] | Iterable[str | os.PathLike[str]], width: float | None = None, height: float | None = None
) -> list[CameraOfImage]:
    """Reads the cameras of images: COLMAP's `cameras` and `images` (.bin or .txt), nerfstudio's `transforms.json`, JSON of
    cameras (each with its `image`), KITTI's `calib.txt`, and the YAML of OpenCV and ROS.

    source: path of a file or a folder, or COLMAP's two paths. Of a folder, COLMAP's files are taken, else
        `transforms.json`, else `calib.txt`.
    width, height: float, the size of the images in pixels, for files that do not say it. Default for KITTI: 1242 and 375.

    u = 0 is the left edge of the first pixel, so cx and cy of OpenCV and KITTI get 0.5 more.
    Returns a list of (`camera`, `image`), in the order of the file. KITTI's images are image_0 to image_3; OpenCV's has no
    name, and its camera stands at the origin. Raises `HprError` with the code "load", which names the line or the byte, and
    the field; or "option".
    """
    size = (width, height)
    if size != (None, None) and not all(is_number(value) and (value or 0) > 0 for value in size):
        raise refusal("option", f"width and height must both be finite and positive numbers, got {width!r} and {height!r}")
    first, *second = _files(source)
    if not second:
        return _reading(first, lambda data: _one(data, size))
    reader = Lines if first.suffix.lower() == ".txt" else Bytes
    lenses = _reading(first, lambda data: read_lenses(reader(data)))
    return _reading(second[0], lambda data: read_images(reader(data), lenses))


def _files(source: str | os.PathLike[str] | Iterable[str | os.PathLike[str]]) -> list[Path]:
    """One file, or COLMAP's two, cameras first."""
    try:
        paths = [Path(path) for path in ([source] if isinstance(source, (str, os.PathLike)) else source)]
        if len(paths) == 1 and not paths[0].is_dir():
            return paths
        paths = list(paths[0].iterdir()) if len(paths) == 1 else paths
    except TypeError:
        raise refusal("option", f"source must be a path, or the paths of COLMAP's two files, got {source!r}") from None
    except OSError as problem:
        raise refusal("load", f"{source} cannot be read: {problem.strerror}") from problem
    by_name = {path.name.lower(): path for path in paths}
    for names in FOLDERS:
        if by_name.keys() >= set(names):
            return [by_name[name] for name in names]
    if len(paths) == 1:
        return paths
    raise refusal("load", f"{source} must hold cameras and images (.bin or .txt), transforms.json or calib.txt")


def _reading(path: Path, read: Callable[[bytes], Read]) -> Read:
    try:
        return read(path.read_bytes())
    except Problem as problem:
        raise refusal("load", f"{path} cannot be read: {problem}") from problem
    except (OSError, ValueError) as problem:
        raise refusal("load", f"{path} cannot be read: {getattr(problem, 'strerror', None) or problem}") from problem


def _one(data: bytes, size: Size) -> list[CameraOfImage]:
    """One file that holds everything."""
    start = data[: 1 << 16].decode("utf-8-sig", "replace")
    if re.match(r"\s*[\[{]", start):
        return read_json(data, size)
    if re.search(r"^(%YAML|camera_matrix\s*:)", start, re.IGNORECASE | re.MULTILINE):
        return read_opencv(data, size)
    if re.search(r"^P[0-3]:?[ \t]", start, re.MULTILINE):
        return read_kitti(data, size)
    if looks_binary(data) or re.search(r"^# (Camera|Image) list", start, re.IGNORECASE | re.MULTILINE):
        raise Problem("COLMAP keeps cameras and images in two files; give both, or their folder")
    raise Problem("it is none of the files of cameras that are read (COLMAP, nerfstudio, KITTI, OpenCV)")
