"""From images to points: colors, labels or features."""

from __future__ import annotations

import inspect
import math
import os
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ._native import PointCloud, _lenses
from ._arguments import array as read_array
from ._arguments import is_list, listed, refusal, word_number

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import ArrayLike, NDArray

    from .types import CameraLike, Options, Unpack


def transfer(
    cloud: PointCloud,
    cameras: Iterable[CameraLike],
    images: Iterable[ArrayLike | str | os.PathLike[str]],
    *,
    merge: Literal["median", "mean", "vote", "best"] | None = "mean",
    weights: Literal["distance", "angle", "score"] | None = None,
    sampling: Literal["nearest", "bilinear"] | None = "nearest",
    on_progress: Callable[[float], object] | None = None,
    **options: Unpack[Options],
) -> tuple[NDArray[Any], NDArray[np.uint32]]:
    """Takes values from images to the points of a cloud: colors, labels or features.

    A point has a value from each camera that sees it. Three looks decide what it sees, unless looks, radius, exponent or
    inversion is given.

    cloud: `PointCloud`.
    cameras: list of cameras, as for `visible_from_camera`.
    images: list or iterator of arrays of shape (height, width) or (height, width, channels), one for each camera and of its
        size; also images of Pillow, or paths, which Pillow opens. Each is read when its camera was asked, and not kept. A pixel with a NaN gives no value, nor one with alpha 0 in an image
        of 4 uint8 a pixel.
    merge: "mean" (default) or "median" of each channel, weighted; "vote": the pixel with the most weight among equal
        ones, for labels; "best": that of the camera with the highest weight.
    weights: None (all the same; for "best", "distance"), "distance" (1 / depth**2), "angle" (the cosine between the ray
        and the optical axis) or "score" (the view's, with looks).
    sampling: "nearest" (default) or "bilinear", between four pixels; not with "vote".
    on_progress: is called with the share of the cameras that is done. It must not change the cloud. An exception in it
        ends the question.
    Options: those of `PointCloud.visible_from`. Not with scores.

    Returns (values, seen): an array of shape (n,) or (n, channels) in the images' own scale, NaN where nothing is seen: float32,
    or float64 for images of float64 and of integers of 32 bits and more, so that labels up to 2**53 stay whole; and uint32, how
    many cameras gave a value to each index.
    """
    how = [
        word_number("merge", merge, ("mean", "median", "vote", "best")),
        0 if weights is None and merge != "best" else 1 + word_number("weights", weights, ("distance", "angle", "score")),
        word_number("sampling", sampling, ("nearest", "bilinear")),
    ]
    if not isinstance(cloud, PointCloud):
        raise refusal("option", f"cloud must be a PointCloud, got {cloud!r:.60}")
    if options.get("scores") is not None and options["scores"] is not False:
        raise refusal("option", "scores cannot be combined with transfer")
    options.pop("scores", None)
    if all(options.get(name) is None for name in ("looks", "radius", "exponent", "inversion")):
        options["looks"] = 3
    cameras = listed(cameras, "cameras")
    pictures = _Pictures(images, _lenses(cameras))
    values, seen = cloud._transfer(cameras, iter(pictures), how, on_progress, **options)
    if not cameras:
        values = np.full(len(cloud), np.nan, np.float32)
    return values.reshape(len(cloud), *pictures.pixel), seen


def name_options(function: Callable[..., Any]) -> None:
    """In place of **options, help() shows each of them."""
    own = inspect.signature(function)
    options = inspect.signature(PointCloud.visible_from).parameters.values()
    named = [one for one in options if one.kind == one.KEYWORD_ONLY and one.name not in own.parameters]
    function.__signature__ = own.replace(parameters=[*list(own.parameters.values())[:-1], *named])  # type: ignore[attr-defined]


name_options(transfer)


class _Pictures:
    """The images as arrays of three dimensions. Each is read when it is wanted, and not kept."""

    def __init__(self, images: Any, lenses: list[list[float]]) -> None:
        if not is_list(images):
            raise refusal("option", f"images must be a list with an entry for each camera, got {images!r:.60}")
        if hasattr(images, "__len__") and len(images) != len(lenses):
            raise refusal("option", f"images must hold one image for each of {len(lenses)} cameras, got {len(images)}")
        self.images, self.lenses = images, lenses
        #: The shape of a pixel of the first image.
        self.pixel: tuple[int, ...] = ()

    def __iter__(self) -> Iterator[NDArray[Any]]:
        number = 0
        for image in self.images:
            yield self._read(image, number)
            number += 1
            # It is given up before the next one comes.
            del image

    def _read(self, image: Any, number: int) -> NDArray[Any]:
        name = f"images[{number}]"
        picture = _picture(image, name)
        if number < len(self.lenses) and list(picture.shape[1::-1]) != self.lenses[number][4:]:
            width, height = self.lenses[number][4:]
            got = f"{picture.shape[1]} x {picture.shape[0]}"
            raise refusal("option", f"{name} must have the size of its camera's image, {width:g} x {height:g}, got {got}")
        if number == 0:
            self.pixel = picture.shape[2:]
        if picture.shape[2:3] != self.pixel[:1] or 0 in picture.shape[2:]:
            channels = [max(1, math.prod(shape)) for shape in (self.pixel, picture.shape[2:])]
            raise refusal("option", f"{name} must have {channels[0]} channels, got {math.prod(picture.shape[2:])}")
        return np.ascontiguousarray(picture.reshape(*picture.shape[:2], -1))


def _picture(given: Any, name: str) -> NDArray[Any]:
    """An image: bytes, or numbers in single or double precision, whichever holds them all."""
    if isinstance(given, (str, os.PathLike)):
        try:
            from PIL import Image

            given = np.asarray(Image.open(given))
        except Exception as problem:
            raise refusal("load", f"{name} cannot be read: {problem}") from problem
    words = "an array of numbers, (height, width) or (height, width, channels)"
    array = read_array(given, name, "fiub", words)
    kind, size = array.dtype.kind, array.dtype.itemsize
    if array.ndim not in (2, 3):
        raise refusal("option", f"{name} must be {words}, got the shape {array.shape}")
    if kind == "u" and size == 1:
        return array
    is_single = size <= 2 or (kind == "f" and size == 4)
    return array.astype(np.float32 if is_single else np.float64, copy=False)
