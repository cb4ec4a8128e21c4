"""Files of cameras, read as `readCameras` of the npm package reads them. The core checks the cameras."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ..arguments import refusal
from .colmap import Bytes, Lines, read_images, read_lenses
from .files import CameraOfImage, Problem, is_number, looks_binary
from .others import read_json, read_kitti, read_opencv

__all__ = ["CameraOfImage", "read_cameras"]

#: What is taken of a folder.
FOLDERS = (("cameras.bin", "images.bin"), ("cameras.txt", "images.txt"), ("transforms.json",), ("calib.txt",))


def read_cameras(source, width=None, height=None):
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
    if size != (None, None) and not all(is_number(value) and value > 0 for value in size):
        raise refusal("option", f"width and height must both be finite and positive numbers, got {width!r} and {height!r}")
    first, *second = _files(source)
    if not second:
        return _reading(first, _one, size)
    reader = Lines if first.suffix.lower() == ".txt" else Bytes
    lenses = _reading(first, lambda data: read_lenses(reader(data)))
    return _reading(second[0], lambda data: read_images(reader(data), lenses))


def _files(source):
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


def _reading(path, read, *more):
    try:
        return read(path.read_bytes(), *more)
    except Problem as problem:
        raise refusal("load", f"{path} cannot be read: {problem}") from problem
    except (OSError, ValueError) as problem:
        raise refusal("load", f"{path} cannot be read: {getattr(problem, 'strerror', None) or problem}") from problem


def _one(data, size):
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
