"""Files of one kind: nerfstudio's, KITTI's, OpenCV's, and JSON of this package."""

from __future__ import annotations

import json
import math
import re

import numpy as np

from .files import CameraOfImage, Problem, checked, floats, is_number, lines

#: nerfstudio's names. Lenses without a bend get the distortion from k1 to p2 all the same.
PLAIN = ("SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV")
FISHEYE = ("OPENCV_FISHEYE", "RADIAL_FISHEYE", "SIMPLE_RADIAL_FISHEYE")
#: KITTI's matrices. `Tr` is the odometry's name of `Tr_velo_to_cam`.
MATRICES = {"P0": 12, "P1": 12, "P2": 12, "P3": 12, "R0_rect": 9, "R_rect": 9, "Tr_velo_to_cam": 12, "Tr_velo_cam": 12, "Tr": 12}
#: A camera's poses in JavaScript.
POSES = {"cameraToWorld": "camera_to_world", "worldToCamera": "world_to_camera"}


def read_json(data, size):
    """nerfstudio's `transforms.json`, or cameras of this package."""
    try:
        found = json.loads(data.decode("utf-8-sig", "replace"), parse_constant=lambda name: name)
    except (ValueError, RecursionError) as problem:
        raise Problem(f"it is not JSON: {problem}") from problem
    if isinstance(found, list) or {"fx", "convention", *POSES, *POSES.values()} & found.keys():
        cameras = found if isinstance(found, list) else [found]
        return [_own(camera, f"camera [{number}]") for number, camera in enumerate(cameras)]
    frames = found.get("frames")
    if not isinstance(frames, list):
        raise Problem("frames must be an array")
    return [_frame(found, frame, f"frames[{number}]", size) for number, frame in enumerate(frames)]


def _own(given, where):
    """A camera as the methods take it, here or in JavaScript."""
    if not isinstance(given, dict) or not isinstance(given.get("image", ""), str):
        raise Problem(f"{where} must be an object, and its image a text")
    camera = {POSES.get(name, name): value for name, value in given.items() if name != "image"}
    return CameraOfImage(checked(camera, where), given.get("image", ""))


def _frame(file, frame, where, size):
    """A frame's own numbers go before those of the file."""
    if not isinstance(frame, dict) or not isinstance(frame.get("file_path"), str):
        raise Problem(f"{where} must be an object, and its file_path a text")
    fields = {**file, **{name: value for name, value in frame.items() if value is not None}}

    def number(name, usual):
        value = usual if fields.get(name) is None else fields[name]
        if not is_number(value):
            raise Problem(f"{where}.{name} must be a finite number, got {value!r}")
        return value

    def focal(name, angle, length, usual):
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


def read_kitti(data, size):
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
        (fx, _, u, x), (_, fy, v, y), (*_, z) = matrix.tolist()
        moved = np.eye(4)
        moved[:3, 3] = (x - u * z) / (fx or 1), (y - v * z) / (fy or 1), z
        # The first pixel's center is at 0 there.
        lens = {"fx": fx, "fy": fy, "cx": u + 0.5, "cy": v + 0.5, "width": width, "height": height}
        cameras.append(CameraOfImage(checked({**lens, "world_to_camera": moved @ rectified}, where), f"image_{name[1]}"))
    if not cameras:
        raise Problem("it has none of P0 to P3")
    return cameras


def read_opencv(data, size):
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

    def numbers(name, *counts):
        """The numbers of a field: alone, as a list, or as the data of a matrix. None without it."""
        if name not in fields:
            return None
        where, text = fields[name]
        found = re.search(r"\[([^\]]*)\]", text)
        if found is None and ("[" in text or counts[0] != 1):
            raise Problem(f"{where} has no list for {name}")
        sizes = [re.search(rf"\b{key}: *(\d{{1,9}})", text) for key in ("rows", "cols")]
        promised = counts if None in sizes else {int(sizes[0][1]) * int(sizes[1][1])} & {*counts}
        return floats(re.findall(r"[^\s,]+", found[1] if found else text), where, name, *promised)

    matrix = numbers("camera_matrix", 9)
    if matrix is None:
        raise Problem("it has no camera_matrix")
    where, (fx, skew, cx, _, fy, cy, *_) = fields["camera_matrix"][0], matrix
    if skew != 0:
        raise Problem(f"{where} has {skew:g} for the skew of camera_matrix, which must be 0")
    width, height = ((numbers(name, 1) or [usual])[0] for name, usual in zip(("image_width", "image_height"), size))
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
