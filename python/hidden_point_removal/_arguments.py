"""Reads arguments: what a user holds of NumPy, torch, Open3D, pycolmap and others, as the core takes it."""

from __future__ import annotations

import math
import os
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._native import HprError

#: The entries of a camera, besides its pose.
LENS = ("fx", "fy", "cx", "cy", "width", "height", "near", "far")
POSES = ("camera_to_world", "world_to_camera")
ENTRIES = (*LENS, *POSES, "K", "convention", "model", "distortion")


def refusal(code: str, message: str) -> HprError:
    """An `HprError` with a code."""
    error = HprError(message)
    error.code = code  # type: ignore[assignment]
    return error


def array(given: Any, name: str, kinds: str, words: str, code: str = "option") -> NDArray[Any]:
    """An array of numbers of these kinds, as NumPy letters them. A masked entry is no number."""
    try:
        is_foreign = not hasattr(given, "__array__") and hasattr(given, "numpy")
        read = np.asarray(given.numpy() if is_foreign else given)
    except Exception as problem:  # What torch says of its tensors is passed on.
        raise refusal(code, f"{name} must be {words}: {problem}") from problem
    if np.ma.is_masked(given):
        raise refusal(code, f"{name} must not have masked entries")
    # An empty list is one of float.
    if read.dtype.kind not in kinds and read.shape != (0,):
        raise refusal(code, f"{name} must be {words}, got {_shown(given, read)}")
    return read


def _shown(given: Any, read: NDArray[Any]) -> str:
    return f"{read.dtype} of the shape {read.shape}" if read.size > 4 else f"{given!r:.60}"


def positions(given: Any, name: str) -> NDArray[Any]:
    """Positions: (n, 3) of float32 or float64, row after row in memory. Of more columns, the first three count."""
    given = _points_of(given, name)
    mask = np.ma.getmaskarray(given) if np.ma.is_masked(given) else None
    read = array(np.ma.getdata(given) if np.ma.isMaskedArray(given) else given, name, "fiu", "real numbers", "positions-type")
    if mask is not None:
        # So its point is skipped or refused.
        read = np.where(mask, np.nan, read)
    if read.shape == (0,):
        read = np.empty((0, 3))
    # So many columns are points side by side, and not columns of a scan.
    if read.ndim != 2 or read.shape[1] < 3 or (read.shape[1] > 3 and read.shape[1] > max(len(read), 64)):
        raise refusal("positions-length", f"{name} must have the shape (n, 3) or more columns, got {read.shape}")
    is_single = read.dtype.kind == "f" and read.dtype.itemsize == 4
    return np.require(read[:, :3], np.float32 if is_single else np.float64, ["C", "ALIGNED"])


def _points_of(given: Any, name: str) -> Any:
    """The array of a cloud of another library."""
    if isinstance(given, (str, os.PathLike)):
        from .tiles import KINDS, chunks

        path = Path(given)
        if path.suffix.lower() not in KINDS:
            raise refusal("positions-type", f"{name} must be an array of numbers, or a {', '.join(KINDS)} file, got {given!r:.60}")
        return np.concatenate([np.empty((0, 3), np.float32), *chunks(path)])
    given = _by_name(given, name, "positions-type")
    if hasattr(given, "__array__"):
        return given
    if hasattr(given, "to_mesh"):
        # Scenes of trimesh.
        given = given.to_mesh()
    # laspy's, Open3D's and PyVista's, and trimesh's.
    for attribute in ("xyz", "points", "vertices"):
        if hasattr(given, attribute):
            return getattr(given, attribute)
    if hasattr(given, "point"):
        # Clouds of open3d.t.
        given = given.point["positions"]
    return given


def _by_name(given: Any, name: str, code: str) -> Any:
    """x, y and z side by side, if they have names: columns of tables, fields, entries of dictionaries, attributes."""
    if all(hasattr(given, axis) for axis in "xyz") and not hasattr(given, "points"):
        # Records of laspy, and tables of pandas.
        given = {axis: getattr(given, axis) for axis in "xyz"}
    fields = getattr(getattr(given, "dtype", None), "names", None)
    names: Any = given if isinstance(given, dict) else fields or getattr(given, "column_names", getattr(given, "columns", None))
    # pye57 writes cartesianX.
    keys = {str(key).lower().removeprefix("cartesian"): key for key in (names if is_list(names) else ())}
    if not {"x", "y", "z"} <= keys.keys():
        return given
    columns = [array(given[keys[axis]], name, "fiu", "real numbers", code) for axis in "xyz"]
    if len({column.shape for column in columns}) > 1:
        raise refusal(code, f"{name} must have as many x as y and z")
    return np.stack(columns, axis=-1)


def place(given: Any, name: str) -> tuple[float, float, float]:
    """Three finite numbers."""
    code, words = "viewpoint", "3 finite numbers"
    read = array(_by_name(given, name, code), name, "fiuO", words, code)
    try:
        x, y, z = (float(number) for number in (read.ravel() if read.shape in ((3, 1), (1, 3)) else read))
    except (TypeError, ValueError, OverflowError):
        x = y = z = math.nan
    if not all(map(math.isfinite, (x, y, z))):
        several = "; several viewpoints are for visible_from_each and visible_from_any" if read.ndim > 1 and name == "viewpoint" else ""
        raise refusal(code, f"{name} must be {words}, got {_shown(given, read)}{several}")
    return x, y, z


def is_list(given: Any) -> bool:
    return hasattr(given, "__iter__") and not isinstance(given, (str, bytes, os.PathLike)) and getattr(given, "shape", None) != ()


def listed(given: Any, name: str, code: str = "viewpoint") -> list[Any]:
    """The entries of a list, or the rows of a table. One of the images of pycolmap's reconstruction is that of a camera."""
    if hasattr(given, "reg_image_ids"):
        return [given.images[number] for number in given.reg_image_ids()]
    words = "a list with an entry for each of them"
    given = _by_name(given, name, code)
    if isinstance(given, memoryview) or hasattr(given, "__array__") or hasattr(given, "numpy"):
        # A tensor is not read row by row, and a table would be a list of its columns.
        given = array(given, name, "fiuO", words, code)
    elif callable(getattr(given, "values", None)) and not isinstance(given, dict):
        # Those images themselves, by their ids.
        given = given.values()
    # A camera is also a list, of its names.
    if not is_list(given) or isinstance(given, dict) or hasattr(given, "cam_from_world"):
        raise refusal(code, f"{name} must be {words}, got {given!r:.60}")
    return list(given)


def seats(given: Any, name: str) -> list[Any]:
    """Viewpoints, or cameras in their places."""
    entries = enumerate(listed(given, name))
    return [(camera if _is_camera(entry) else place)(entry, f"{name}[{number}]") for number, entry in entries]


def cameras(given: Any, name: str) -> list[Any]:
    return [camera(entry, f"{name}[{number}]") for number, entry in enumerate(listed(given, name))]


def _is_camera(given: Any) -> bool:
    return isinstance(given, dict) or hasattr(given, "cam_from_world") or _is_pair(given)


def _is_pair(given: Any) -> bool:
    """Whether this is what `read_cameras` gives: a camera, and the name of its image."""
    return isinstance(given, tuple) and len(given) == 2 and isinstance(given[0], dict)


def camera(given: Any, name: str) -> tuple[bool, list[float], bool, str, list[float] | None, list[float]]:
    """A camera: whether the pose is world_to_camera, the pose column by column, whether its axes are those of OpenGL, the model
    of the lens, its distortion, and the numbers of `LENS`."""

    def wrong(message: str) -> HprError:
        return refusal("viewpoint", f"{name}: {message}")

    if _is_pair(given):
        given = given[0]
    elif hasattr(given, "cam_from_world"):
        given = _of_pycolmap(given)
    if not isinstance(given, dict):
        raise wrong("must be a dictionary, as for visible_from_camera, or an image of pycolmap")
    for entry in given:
        if not isinstance(entry, str):
            raise refusal("option", f"an argument must not be {entry!r:.60}")
        if entry not in ENTRIES:
            raise wrong(f"unknown entry {entry}")
    found = {entry: value for entry, value in given.items() if value is not None}
    if "K" in found:
        matrix = _matrix(found.pop("K"), wrong, ((3, 3),), "K must be an array of shape (3, 3)")
        (fx, skew, cx), (left, fy, cy), last = matrix.tolist()
        if found.keys() & {"fx", "fy", "cx", "cy"} or (skew, left, last) != (0, 0, [0, 0, 1]):
            raise wrong("K must be [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], in place of fx, fy, cx and cy")
        found.update(fx=fx, fy=fy, cx=cx, cy=cy)
    poses = [entry for entry in POSES if entry in found]
    shapes = "exactly one of camera_to_world and world_to_camera must hold a pose: an array of shape (4, 4) or (3, 4), or 16 numbers, column by column"
    if len(poses) != 1:
        raise wrong(shapes)
    pose = _matrix(found[poses[0]], wrong, ((4, 4), (3, 4), (16,)), shapes)
    if pose.ndim == 1:
        pose = pose.reshape(4, 4).T
    elif len(pose) == 3:
        pose = np.vstack([pose, [0.0, 0.0, 0.0, 1.0]])
    convention = found.get("convention", "opencv")
    if not isinstance(convention, str) or convention not in ("opencv", "opengl"):
        raise wrong(f'convention must be "opencv" or "opengl", got {convention!r:.60}')
    found = {"near": 0.0, "far": math.inf, **found}
    missing = [entry for entry in LENS if entry not in found]
    if missing:
        raise wrong(f"{missing[0]} is missing{' (or K)' if missing[0] in LENS[:4] else ''}")
    lens = [_number(found[entry], entry, wrong) for entry in LENS]
    distortion = found.get("distortion")
    if distortion is not None:
        distortion = _matrix(distortion, wrong, (), "distortion must be a list of numbers").ravel().tolist()
    model = found.get("model", "OPENCV")
    return poses[0] == "world_to_camera", pose.T.ravel().tolist(), convention == "opengl", str(model), distortion, lens


def _matrix(given: Any, wrong: Any, shapes: tuple[tuple[int, ...], ...], words: str) -> NDArray[np.float64]:
    """Numbers of one of these shapes; without a shape, a list."""
    try:
        read = array(given, "it", "fiu", "numbers").astype(np.float64)
    except HprError as problem:
        # What torch says of its tensors is passed on.
        raise wrong(f"{words}: {problem}" if problem.__cause__ else words) from None
    # OpenCV's distortion is a row or a column.
    if read.shape not in shapes if shapes else read.ndim == 0 or max(read.shape) != read.size:
        raise wrong(f"{words}, got the shape {read.shape}")
    return read


def _number(given: Any, entry: str, wrong: Any) -> float:
    if isinstance(given, (str, bytes, bool, np.bool_)):
        raise wrong(f"{entry} must be a number, got {given!r:.60}")
    try:
        return float(given)
    except (TypeError, ValueError, OverflowError):
        raise wrong(f"{entry} must be a number, got {given!r:.60}") from None


def _of_pycolmap(image: Any) -> dict[str, Any]:
    lens, pose = image.camera, image.cam_from_world
    model = lens.model.name if hasattr(lens.model, "name") else str(lens.model_name)
    params = list(lens.params)
    focals = 1 if model.startswith(("SIMPLE_", "RADIAL")) else 2
    fx, fy, cx, cy, *distortion = params[: 2 - focals] + params
    return {
        "world_to_camera": (pose() if callable(pose) else pose).matrix(), "fx": fx, "fy": fy, "cx": cx, "cy": cy,
        "width": lens.width, "height": lens.height, "model": model, "distortion": distortion or None,
    }  # fmt: skip


def indices(given: Any, name: str, length: int) -> NDArray[np.uint32]:
    """Indices of a cloud of so many. Truth values are a mask, one for each index."""
    read = array(given, name, "iub", f"integers from 0 to {2**32 - 1}, or a mask of {length} truth values")
    if read.dtype.kind == "b":
        if read.shape != (length,):
            raise refusal("option", f"{name} is a mask of the shape {read.shape}, but there are {length} points")
        read = np.flatnonzero(read)
    elif read.shape == (length,) and length > 2 and 0 <= read.min() and read.max() <= 1:
        # As indices, they would name the points 0 and 1 alone.
        raise refusal("option", f"{name} must be indices or truth values, got a mask of ones and zeros: make it bool")
    if read.ndim != 1 or (read.size and (read.min() < 0 or read.max() >= 2**32)):
        raise refusal("option", f"{name} must be integers from 0 to {2**32 - 1}, got {_shown(given, read)}")
    return read.astype(np.uint32)


def stations(given: Any, name: str, length: int) -> list[tuple[tuple[float, float, float], NDArray[np.uint32]]]:
    """Where scanners stood, and the indices of the points that they measured, in a cloud of so many."""
    entries = listed(given, name, "option")
    if not entries:
        raise refusal("option", f"{name} must be a list of at least one station, got {given!r:.60}")
    return [_station(entry, f"{name}[{number}]", length) for number, entry in enumerate(entries)]


def _station(given: Any, name: str, length: int) -> tuple[tuple[float, float, float], NDArray[np.uint32]]:
    if not isinstance(given, dict):
        raise refusal("option", f"{name} must be a dictionary of viewpoint, and of indices or mask")
    viewpoint, own, marks = (given.get(entry) for entry in ("viewpoint", "indices", "mask"))
    if viewpoint is None:
        raise refusal("option", f"{name} has no viewpoint")
    if (own is None) == (marks is None):
        raise refusal("option", f"{name} must have one of indices and mask")
    eye = place(viewpoint, f"the viewpoint of {name}")
    if marks is not None:
        own = mask(marks, f"the mask of {name}")
    own = indices(own, f"the indices of {name}" if marks is None else f"the mask of {name}", length)
    if not own.size:
        raise refusal("option", f"{name} has no points")
    if own.max() >= length:
        raise refusal("option", f"{name} has index {own[own >= length][0]}, which must be below {length}")
    return eye, own


def mask(given: Any, name: str) -> NDArray[np.bool_]:
    """Truth values, or integers of which 0 is false."""
    words = f"{name} must be a list of truth values, one for each index"
    read = array(given, name, "biu", "a list of truth values, one for each index")
    if read.ndim != 1:
        raise refusal("option", f"{words}, got the shape {read.shape}")
    return read.astype(bool)


def numbers(given: Any, name: str, shape: tuple[int, ...] | None = None) -> NDArray[np.float64]:
    """Real numbers, one after another, or of this shape. A truth value counts as 0 or 1."""
    words = "a list of numbers" if shape is None else f"numbers of the shape {shape}"
    read = array(given, name, "fiub" if shape is None else "fiu", words)
    if read.ndim != 1 if shape is None else read.shape != shape:
        raise refusal("option", f"{name} must be {words}, got the shape {read.shape}")
    return np.ascontiguousarray(read, np.float64)


def ids(given: Any, name: str) -> NDArray[np.uint64]:
    """Integers from 0 to 2**64 - 1."""
    # NumPy makes float of a list of small and of large integers.
    is_list = isinstance(given, (list, tuple))
    read = array(np.array(given, object) if is_list else given, name, "iuO", "integers from 0 to 2**64 - 1")
    is_whole = read.dtype.kind in "iu" or all(isinstance(number, (int, np.integer)) and not isinstance(number, bool) for number in read.flat)
    if not is_whole or read.ndim != 1 or (read.size and not 0 <= min(read.tolist()) <= max(read.tolist()) < 2**64):
        raise refusal("option", f"{name} must be integers from 0 to 2**64 - 1, got {_shown(given, read)}")
    return np.ascontiguousarray(read, np.uint64)


def triangles(given: Any, name: str, length: int) -> NDArray[np.uint32]:
    """Three indices for each triangle."""
    words = f"an (n, 3) array of indices below {length}"
    read = array(given, name, "iu", words)
    if read.shape == (0,):
        read = np.empty((0, 3), np.uint32)
    if read.ndim != 2 or read.shape[1] != 3 or (read.size and not (0 <= read.min() and read.max() < length)):
        raise refusal("option", f"{name} must be {words}, got {_shown(given, read)}")
    return np.ascontiguousarray(read, np.uint32)


def word_number(name: str, given: Any, words: tuple[str, ...]) -> int:
    """The place of a word. The first one is the usual one."""
    word = words[0] if given is None else given
    if not isinstance(word, str) or word not in words:
        raise refusal("option", f"{name} must be one of {', '.join(words)}, got {given!r:.60}")
    return words.index(word)
