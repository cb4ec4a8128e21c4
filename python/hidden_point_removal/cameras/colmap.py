"""COLMAP's `cameras` and `images`, in text and in binary."""

from __future__ import annotations

import math
import re
import struct

import numpy as np

from .files import CameraOfImage, Problem, checked, floats, lines

#: How many coefficients COLMAP's models have, in the order of COLMAP's numbers for them.
MODELS = {"SIMPLE_PINHOLE": 0, "PINHOLE": 0, "SIMPLE_RADIAL": 1, "RADIAL": 2, "OPENCV": 4, "OPENCV_FISHEYE": 4, "FULL_OPENCV": 8,
          "FOV": 1, "SIMPLE_RADIAL_FISHEYE": 1, "RADIAL_FISHEYE": 2, "THIN_PRISM_FISHEYE": 8}


class Lines:
    """COLMAP's text, as `Bytes` reads the same in binary."""

    def __init__(self, data):
        self.lines = lines(data)

    def entries(self, _name, _least):
        for self.where, self.text in self.lines:
            self.words = self.text.split()
            if self.words and not self.words[0].startswith("#"):
                yield
                if self.words:
                    raise Problem(f"{self.where} goes on after its last field: {self.text[:60]!r}")

    def integer(self, field):
        word = self.words.pop(0) if self.words else ""
        if not re.fullmatch(r"\d{1,15}", word, re.ASCII):
            raise Problem(f"{self.where} has no number for {field}: {self.text[:60]!r}")
        return int(word)

    long = integer

    def model(self):
        return self.words.pop(0) if self.words else ""

    def floats(self, count, field):
        words, self.words = self.words[:count], self.words[count:]
        return floats(words, self.where, field, count)

    def name(self):
        self.words, words = [], self.words
        if not words:
            raise Problem(f"{self.where} has no NAME: {self.text[:60]!r}")
        return self.text.strip().split(None, 9)[9]

    def skip_points(self):
        where, text = next(self.lines, ("", ""))
        words = text.split()
        # A file without these lines would otherwise lose every other image.
        if len(words) % 3:
            raise Problem(f"{where} does not hold POINTS2D, as every line below an image does: {text[:60]!r}")
        floats(words[-1:], where, "POINTS2D", 0, 1)


class Bytes:
    """COLMAP's binary files: little-endian numbers one after another."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def entries(self, name, least):
        count = self.count(f"the number of {name}s", least)
        for number in range(1, count + 1):
            self.where = f"{name} {number} of {count}, at byte {self.at},"
            yield
        if self.at < len(self.data):
            raise Problem(f"it goes on at byte {self.at}, after its last entry")

    def take(self, kind, field):
        return struct.unpack_from(kind, self.data, self.skip(struct.calcsize(kind), field))

    def skip(self, length, field):
        if length > len(self.data) - self.at:
            raise Problem(f"it ends at byte {len(self.data)}, in {field}")
        self.at += length
        return self.at - length

    def count(self, field, least):
        at, count = self.at, self.long(field)
        if count * least > len(self.data) - self.at:
            raise Problem(f"byte {at} has {count} for {field}, more than the file holds")
        return count

    def integer(self, field):
        return self.take("<I", field)[0]

    def long(self, field):
        return self.take("<Q", field)[0]

    def model(self):
        number = self.integer("MODEL_ID")
        return [*MODELS][number] if number < len(MODELS) else f"MODEL_ID {number}"

    def floats(self, count, field):
        return list(self.take(f"<{count}d", field))

    def name(self):
        end = self.data.find(b"\0", self.at)
        if end < 0:
            raise Problem(f"byte {self.at} begins a text for NAME that does not end")
        return self.data[self.skip(end + 1 - self.at, "NAME") : end].decode("utf-8", "replace")

    def skip_points(self):
        self.skip(24 * self.count("the number of POINTS2D", 24), "POINTS2D")


def read_lenses(reader):
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


def read_images(reader, lenses):
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
