"""From images to points: colors, labels or features."""

from __future__ import annotations

import inspect
import os
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ._native import PointCloud, _lenses
from ._answers import by_point, joined
from ._arguments import array as read_array
from ._arguments import listed, refusal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

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
) -> tuple[NDArray[np.float32], NDArray[np.uint32]]:
    """Takes values from images to the points of a cloud: colors, labels or features.

    A point has a value from each camera that sees it. Three looks decide what it sees, unless looks, radius, exponent or
    inversion is given.

    cloud: `PointCloud`.
    cameras: list of cameras, as for `visible_from_camera`.
    images: list of arrays of shape (height, width) or (height, width, channels), one for each camera and of its size; also
        images of Pillow, or paths, which Pillow opens. A pixel with a NaN gives no value, nor one with alpha 0 in an image
        of 4 uint8 a pixel.
    merge: "mean" (default) or "median" of each channel, weighted; "vote": the pixel with the most weight among equal
        ones, for labels; "best": that of the camera with the highest weight.
    weights: None (all the same; for "best", "distance"), "distance" (1 / depth**2), "angle" (the cosine between the ray
        and the optical axis) or "score" (the view's, with looks).
    sampling: "nearest" (default) or "bilinear", between four pixels; not with "vote".
    on_progress: is called with the share of the cameras that is done. It must not change the cloud. An exception in it
        ends the question.
    Options: those of `PointCloud.visible_from`. Not with scores.

    Returns (values, seen): float32 of shape (n,) or (n, channels) in the images' own scale, NaN where nothing is seen;
    and uint32, how many cameras gave a value to each index.
    """
    merge = _word("merge", merge, MERGES) or "mean"
    weigh = _word("weights", weights, ("distance", "angle", "score")) or ("distance" if merge == "best" else None)
    sampling = _word("sampling", sampling, SAMPLINGS) or "nearest"
    if sampling == "bilinear" and merge == "vote":
        raise refusal("option", "sampling bilinear cannot be combined with merge vote")
    if not isinstance(cloud, PointCloud):
        raise refusal("option", f"an argument must not be {cloud!r:.60}")
    if options.get("scores") is not None and options["scores"] is not False:
        raise refusal("option", "scores cannot be combined with transfer")
    if all(options.get(name) is None for name in ("looks", "radius", "exponent", "inversion")):
        options["looks"] = 3
    options["scores"] = weigh == "score"
    cameras = listed(cameras, "cameras")
    lenses = _lenses(cameras)
    pictures, pixel = _pictures(images, lenses)
    views = cloud._camera_views(cameras, on_progress, **options)
    with np.errstate(all="ignore"):
        try:
            values, seen = _merged(len(cloud), views, lenses, pictures, (merge, weigh, SAMPLINGS[sampling or "nearest"]))
        except MemoryError:
            message = f"there is no memory for {len(cloud)} values of {np.prod(pixel, dtype=int)} channels"
            raise refusal("too-large", message) from None
    return values.reshape(len(cloud), *pixel), seen


def name_options(function: Callable[..., Any]) -> None:
    """In place of **options, help() shows each of them."""
    own = inspect.signature(function)
    options = inspect.signature(PointCloud.visible_from).parameters.values()
    named = [one for one in options if one.kind == one.KEYWORD_ONLY and one.name not in own.parameters]
    function.__signature__ = own.replace(parameters=[*list(own.parameters.values())[:-1], *named])  # type: ignore[attr-defined]


name_options(transfer)


def _merged(length, views, lenses, pictures, how):
    """The values, and how many cameras gave one, of each point."""
    merge, weigh, sample = how
    channels = pictures[0].shape[2] if pictures else 1
    indices, found, weights = [], [], []
    for (view, _), lens, picture in zip(views, lenses, pictures):
        own, is_given = sample(picture, view.pixels.astype(float))
        indices.append(view.indices[is_given])
        found.append(own[is_given])
        weights.append(_weights(weigh, view, lens)[is_given])
    order, offsets = by_point(length, indices)
    values = np.full((length, channels), np.nan, np.float32)
    counts = np.diff(offsets)
    own = MERGES[merge](joined(found, (0, channels))[order], joined(weights, 0)[order].astype(float), counts[counts > 0])
    values[counts > 0] = own
    return values, counts


def _weights(weigh, view, lens):
    """How much each point of a view counts, in single precision."""
    if weigh == "distance":
        depth = view.depths.astype(float)
        return (1 / (depth * depth)).astype(np.float32)
    if weigh == "angle":
        fx, fy, cx, cy = lens[:4]
        x, y = (view.pixels.astype(float) - (cx, cy)).T / [[fx], [fy]]
        return (1 / np.sqrt(1 + x * x + y * y)).astype(np.float32)
    return view.scores[view.indices] if weigh == "score" and view.count else np.ones(view.count, np.float32)


# Entries are merged that lie side by side: so many for each point.


def _mean(values, weights, counts):
    points = np.repeat(np.arange(len(counts)), counts)
    total = np.bincount(points, weights, len(counts))
    first = values[_starts(counts)]
    sums = [np.bincount(points, weights * values[:, channel], len(counts)) for channel in range(values.shape[1])]
    # All scores may be 0.
    return np.where(total[:, None] > 0, np.transpose(sums) / total[:, None], first)


def _median(values, weights, counts):
    """The value at which half of the weight is reached; between two values if it is reached exactly there."""
    medians = np.empty((len(counts), values.shape[1]))
    starts = _starts(counts)
    for count in np.unique(counts):
        at = starts[counts == count, None] + np.arange(count)
        own = values[at].astype(float)
        order = np.argsort(own, axis=1, kind="stable")
        own = np.take_along_axis(own, order, 1)
        sums = np.cumsum(weights[at[:, 0, None, None] + order], axis=1)
        half = sums[:, -1:] / 2
        first = np.argmax(sums >= half, axis=1)[:, None]
        after = np.where(np.take_along_axis(sums, first, 1) == half, np.minimum(first + 1, count - 1), first)
        low, high = (np.take_along_axis(own, place, 1)[:, 0] for place in (first, after))
        medians[counts == count] = np.where(first[:, 0] == after[:, 0], low, (low + high) / 2)
    return medians


def _vote(values, weights, counts):
    points = np.repeat(np.arange(len(counts)), counts)
    groups = points
    for channel in values.T:
        distinct, labels = np.unique(channel, return_inverse=True)
        _, firsts, groups = np.unique(groups * len(distinct) + labels, return_index=True, return_inverse=True)
    # The votes of equal values count at the first of them.
    votes = np.full(len(values), -np.inf)
    votes[firsts] = np.bincount(groups, weights, len(firsts))
    return _best(values, votes, counts)


def _best(values, weights, counts):
    """The first value of the highest weight."""
    if not len(counts):
        return values
    points, highest = np.repeat(np.arange(len(counts)), counts), np.maximum.reduceat(weights, _starts(counts))
    best = np.flatnonzero(weights == highest[points])
    return values[best[np.diff(points[best], prepend=-1) > 0]]


def _starts(counts):
    return np.cumsum(counts, dtype=np.int64) - counts


MERGES = {"median": _median, "mean": _mean, "vote": _vote, "best": _best}


def _nearest(image, at):
    """The pixels at these places, or the nearest ones of the image, and whether each has a value."""
    height, width, channels = image.shape
    x, y = np.floor(at).T
    found = image[y.clip(0, height - 1).astype(int), x.clip(0, width - 1).astype(int)]
    if image.dtype == np.uint8:
        # In images of 4 bytes a pixel, alpha 0 gives no value.
        return found, found[:, 3] != 0 if channels == 4 else np.ones(len(at), bool)
    return found, ~np.isnan(found).any(axis=1)


def _bilinear(image, at):
    """Between the centers of four pixels. Those without a value do not count."""
    low = np.floor(at - 0.5)
    right, down = (at - 0.5 - low).T
    sums, total = np.zeros((len(at), image.shape[2])), np.zeros(len(at))
    for i, j in ((0, 0), (1, 0), (0, 1), (1, 1)):
        found, is_given = _nearest(image, low + (i, j))
        weight = np.where(is_given, (right if i else 1 - right) * (down if j else 1 - down), 0)
        sums += weight[:, None] * np.where(weight[:, None] > 0, found, 0)
        total += weight
    return sums / total[:, None], total > 0


SAMPLINGS = {"nearest": _nearest, "bilinear": _bilinear}


def _pictures(images, lenses):
    """The images as arrays of three dimensions, and the shape of a pixel of each."""
    try:
        images = [_picture(image, f"images[{number}]") for number, image in enumerate(images)]
    except TypeError:
        raise refusal("option", "images must be a list with an entry for each of them") from None
    if len(images) != len(lenses):
        raise refusal("option", f"images must hold one image for each of {len(lenses)} cameras, got {len(images)}")
    for number, (image, (*_, width, height)) in enumerate(zip(images, lenses)):
        if image.shape[:2] != (height, width):
            got = f"{image.shape[1]} x {image.shape[0]}"
            message = f"must have the size of its camera's image, {width:g} x {height:g}, got {got}"
            raise refusal("option", f"images[{number}] {message}")
        channels, first = (np.prod(one.shape[2:], dtype=int) for one in (image, images[0]))
        if channels != first or channels == 0:
            raise refusal("option", f"images[{number}] must have {max(first, 1)} channels, got {channels}")
    return [image.reshape(*image.shape[:2], -1) for image in images], images[0].shape[2:] if images else ()


def _picture(given, name):
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
    return array.astype(np.float32 if is_single else np.float64)


def _word(name: str, given: Any, words: Any) -> Any:
    if given is not None and (not isinstance(given, str) or given not in words):
        raise refusal("option", f"{name} must be one of {', '.join(words)}, got {given!r:.60}")
    return given
