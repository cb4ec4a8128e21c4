"""The types of arguments."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from typing import Any, Literal, Protocol, TypedDict, Union

from numpy.typing import ArrayLike

if sys.version_info >= (3, 11):
    from typing import Unpack as Unpack
else:
    from typing_extensions import Unpack as Unpack

Rule = Literal["auto", "opposite"]


class Power(TypedDict):
    power: float


class Exponential(TypedDict):
    exponential: float | Literal["auto"]


Inversion = Union[Literal["spherical"], Power, Exponential]


class Within(TypedDict, total=False):
    """A point takes part if all entries choose it. An entry that is None counts as left out."""

    distance: float | None
    """The points at most this far from the viewpoint."""
    box: tuple[ArrayLike, ArrayLike] | ArrayLike | None
    """The points between these two corners, the lowest and the highest coordinates, borders included."""
    mask: ArrayLike | None
    """One truth value for each index."""


class MergeOptions(TypedDict, total=False):
    """The options of clouds in parts: one of the two, as numbers."""

    radius: float | None
    """R of the flipping sphere for the whole cloud, in its units."""
    inversion: Inversion | None
    """{"power": number} or {"exponential": number}."""


class Threads(TypedDict, total=False):
    threads: int | None
    """How many threads compute, from 1 to 256; they change no answer. Default: all cores from 200,000 points on, else 1."""


# Options of a view, from src/options.json.
class OtherOptions(Threads, total=False):
    """The options of a view besides the radius."""

    exponent: float | None
    """R = farthest distance · 10^exponent, instead of `radius`; at least 0."""
    inversion: Inversion | None
    """`"spherical"` (the default); `{"power": γ}`, 1 < γ ≤ 16; `{"exponential": c}`, exp(c/d): one c, or `"auto"`,
    serves every viewpoint."""
    looks: Literal[2, 3] | None
    """2 or 3 hulls; each decides only the points that it is sure of (docs/LOOKS.md). Excludes the three options
    above."""
    scores: bool | None
    """With `looks`, for one viewpoint: also an estimate for each index of how likely it is visible."""
    thickness: float | Literal["auto"] | None
    """With `looks`: how far behind the surface before it a point may lie and still be seen; `"auto"` (the default):
    by the cloud's noise."""
    surface: Literal["auto", "clean", "noisy", "layered"] | None
    """With `looks`: what the cloud is, if `cloud.surface` (`"auto"`, the default) finds it wrongly: `"clean"`,
    `"noisy"`, `"layered"`."""
    within: Within | None
    """`{"distance", "box": [min, max], "mask"}`: only these points take part, as a cloud of these alone."""


class Options(OtherOptions, total=False):
    """The options of a view. An option that is None counts as left out."""

    radius: float | Literal["auto", "opposite"] | None
    """R of the flipping sphere in the cloud's units, or how R is chosen: `"auto"` (the default), `"opposite"` (the
    paper's rule, about 40 hulls)."""
# End of options.


class Cone(TypedDict):
    """A cone of directions."""

    direction: ArrayLike
    angle: float
    """Its full opening in degrees, above 0 and at most 360."""


class Camera(TypedDict, total=False):
    """A camera: u = fx * x / z + cx, with x to the right, y down and z forward. u = 0 is the left edge of the first pixel.

    Exactly one pose, the size, and either fx, fy, cx and cy or K are needed.
    """

    camera_to_world: ArrayLike | None
    """From the camera's space to the cloud's, rigid: an array of shape (4, 4) or (3, 4), or 16 numbers column by column."""
    world_to_camera: ArrayLike | None
    """The inverse, as COLMAP and OpenCV keep it."""
    convention: Literal["opencv", "opengl"]
    """The axes of the camera's space. Default "opencv"."""
    fx: float
    fy: float
    cx: float
    cy: float
    K: ArrayLike | None
    """[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]."""
    width: float
    """In pixels."""
    height: float
    model: str | None
    """COLMAP's name of the model of the lens. Default "OPENCV"."""
    distortion: ArrayLike | None
    """The coefficients as COLMAP lists them for the model; k1, k2, p1, p2 for "OPENCV", and k3 where there is one."""
    near: float
    """The least depth along the optical axis, in the cloud's units. Default 0."""
    far: float


class Station(TypedDict, total=False):
    """Where a scanner stood, and the points that it measured, by exactly one of `indices` and `mask`."""

    viewpoint: ArrayLike
    indices: ArrayLike | None
    mask: ArrayLike | None


class HasPoints(Protocol):
    """A cloud of Open3D or PyVista."""

    @property
    def points(self) -> Any: ...


class HasPoint(Protocol):
    """A cloud of open3d.t."""

    @property
    def point(self) -> Any: ...


class HasVertices(Protocol):
    """A mesh or a cloud of trimesh."""

    @property
    def vertices(self) -> Any: ...


class HasXyz(Protocol):
    """A file that laspy has read."""

    @property
    def xyz(self) -> Any: ...


class HasPose(Protocol):
    """An image of pycolmap."""

    @property
    def cam_from_world(self) -> Any: ...


Positions = Union[ArrayLike, HasPoints, HasPoint, HasVertices, HasXyz, Mapping[str, ArrayLike], "os.PathLike[str]", str]
"""An array of shape (n, 3), or what holds one."""
CameraLike = Union[Camera, "tuple[Camera, str]", HasPose]
"""A camera, what `read_cameras` gives of one, or an image of pycolmap."""
Seat = Union[ArrayLike, CameraLike]
"""A viewpoint, or a camera, which sees only what is in its image."""
