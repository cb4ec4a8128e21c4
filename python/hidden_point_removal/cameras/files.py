"""What the readers of cameras share."""

from __future__ import annotations

import math
import re
from typing import Any, NamedTuple

import numpy as np

from .._native import HprError, PointCloud

PROBE = PointCloud(np.empty((0, 3)))


class CameraOfImage(NamedTuple):
    """A camera, and the image that it has taken."""

    camera: dict[str, Any]
    """As `PointCloud.visible_from_camera` takes it."""
    image: str
    """The name of the image as the file gives it."""


class Problem(Exception):
    """A file breaks the rules of its format. The words follow "FILE cannot be read: "."""


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def checked(camera, where):
    try:
        PROBE.visible_from_camera(camera)
    except HprError as problem:
        raise Problem(f"{where}: {problem}") from problem
    return camera


def looks_binary(data):
    return any(byte < 9 or 13 < byte < 32 for byte in data[:4096])


def lines(data):
    """(place, text) of each line."""
    if looks_binary(data):
        raise Problem("it is not text")
    lines = re.split(r"\r\n|\r|\n", data.decode("utf-8-sig", "replace"))
    return ((f"line {number}", line) for number, line in enumerate(lines, 1))


def floats(words, where, field, *counts):
    try:
        numbers = [float(word.replace("_", "?")) for word in words]
    except ValueError:
        numbers = [math.nan]
    if not all(map(math.isfinite, numbers)):
        raise Problem(f"{where} has no finite number for {field}: {' '.join(words)[:60]!r}")
    if len(numbers) not in counts:
        raise Problem(f"{where} has {len(numbers)} numbers for {field}, not {' or '.join(map(str, counts))}")
    return numbers
