from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, Protocol, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import NotRequired, Unpack

from .answers import Calibration, Panorama, Placement, SeenBy, Visibility

Rule = Literal["auto", "opposite"]
Inversion = Literal["spherical"] | dict[str, float | str]

class Within(TypedDict):
    """A point takes part if all entries choose it. An entry that is None counts as left out."""

    distance: NotRequired[float | None]
    """The points at most this far from the viewpoint."""
    box: NotRequired[tuple[ArrayLike, ArrayLike] | ArrayLike | None]
    """The points between these two corners, the lowest and the highest coordinates, borders included."""
    mask: NotRequired[ArrayLike | None]
    """One truth value for each index."""

class Options(TypedDict):
    """The options of a view. An option that is None counts as left out."""

    radius: NotRequired[float | Rule | None]
    """R of the flipping sphere in the cloud's units, or the rule that chooses it. Default "auto"."""
    exponent: NotRequired[float | None]
    """R = farthest distance * 10**exponent, the paper's parameter. Excludes `radius`."""
    inversion: NotRequired[Inversion | None]
    """ "spherical", {"power": number} or {"exponential": number or "auto"}."""
    looks: NotRequired[Literal[2, 3] | None]
    """Two or three hulls, each trusted where it is sure. Excludes radius, exponent and inversion."""
    scores: NotRequired[bool | None]
    """With `looks` only: the answer then has a score for each index."""
    thickness: NotRequired[float | Literal["auto"] | None]
    """With `looks` only: how far behind the surface before it a point may be seen. Default "auto", by the noise."""
    within: NotRequired[Within | None]
    """Only these points take part, as if the cloud held no others."""
    threads: NotRequired[int | None]
    """How many threads compute, from 1 to 256; they change no answer. Default: all cores from 200,000 points on, else 1."""

class Cone(TypedDict):
    """A cone of directions."""

    direction: ArrayLike
    angle: float
    """Its full opening in degrees, above 0 and at most 360."""

class Station(TypedDict):
    """Where a scanner stood, and the points that it measured, by exactly one of `indices` and `mask`."""

    viewpoint: ArrayLike
    indices: NotRequired[ArrayLike | None]
    mask: NotRequired[ArrayLike | None]

class MergeOptions(TypedDict):
    radius: NotRequired[float | None]
    inversion: NotRequired[Inversion | None]

class Camera(TypedDict):
    """A pinhole camera: u = fx * x / z + cx, with x to the right, y down and z forward. u = 0 is the left edge of the first pixel."""

    camera_to_world: NotRequired[ArrayLike | None]
    """From the camera's space to the cloud's, rigid: 4 rows of 4, or 16 numbers column by column."""
    world_to_camera: NotRequired[ArrayLike | None]
    """The inverse, as COLMAP and OpenCV keep it. Exactly one of the two is given."""
    convention: NotRequired[Literal["opencv", "opengl"]]
    """The axes of the camera's space. Default "opencv"."""
    fx: float
    fy: float
    cx: float
    cy: float
    width: float
    height: float
    model: NotRequired[str | None]
    """COLMAP's name of the model of the lens. Default "OPENCV"."""
    distortion: NotRequired[ArrayLike | None]
    """The coefficients as COLMAP lists them for the model; k1, k2, p1, p2 for "OPENCV", and k3 where there is one."""
    near: NotRequired[float]
    far: NotRequired[float]

Seat = ArrayLike | Camera
"""A viewpoint, or a camera, which sees only what is in its image."""

class HprError(ValueError):
    """Bad input."""

    code: Literal["positions-length", "positions-type", "non-finite", "viewpoint", "radius", "option", "too-large", "load"]

class VisibilityMap:
    """A map of directions around a viewpoint. It never hides a visible point, except a few with looks."""

    @property
    def viewpoint(self) -> tuple[float, float, float]: ...
    @property
    def origin(self) -> tuple[float, float, float]:
        """The place that positions in a shader are relative to."""
    @property
    def data(self) -> NDArray[np.float32]:
        """The shader's texture `hprDepths`: rows of 256 numbers. It is empty where nothing is hidden."""
    @property
    def uniforms(self) -> dict[str, tuple[float, ...]]:
        """The numbers of the shader: `hprViewpoint` and `hprMargins`."""
    def hides(self, positions: Positions) -> NDArray[np.bool_]:
        """Which places are certainly hidden."""

class HasPoints(Protocol):
    """A cloud of another library, such as Open3D's."""

    @property
    def points(self) -> Any: ...

Positions = ArrayLike | HasPoints

class PointCloud:
    """A point cloud, prepared for visibility queries.

    `positions` has the shape (n, 3), in any units; of more columns, the first three count. It may also be a tensor, or
    a cloud with its array as `points`. Arrays of float32 and float64 are read without a copy. Other
    numbers are converted to float64. With `non_finite="skip"`, points that are not finite keep their index and are
    never visible. A masked coordinate of a masked array counts as not finite.
    """

    def __init__(self, positions: Positions, non_finite: Literal["error", "skip"] = "error") -> None: ...
    def __len__(self) -> int: ...
    @property
    def skipped(self) -> int:
        """How many points were left out because they are not finite."""
    @property
    def spacing(self) -> float:
        """The mean distance of a point to its 6 nearest points."""
    @property
    def noise(self) -> float:
        """How far measured points lie off their surface: one standard deviation; 0 where nothing tells of noise."""
    def visible_from(self, viewpoint: ArrayLike, **options: Unpack[Options]) -> Visibility:
        """The points that can be seen from a viewpoint (paper, section 3, algorithm 1)."""
    def visible_from_direction(self, direction: ArrayLike, **options: Unpack[Options]) -> Visibility:
        """The points that can be seen along a direction, from infinitely far away."""
    def visible_from_any(self, viewpoints: Iterable[Seat], **options: Unpack[Options]) -> Visibility:
        """The points that at least one viewpoint sees."""
    def visible_from_at_least(
        self, k: int, viewpoints: Iterable[Seat], **options: Unpack[Options]
    ) -> Visibility:
        """The points that at least `k` of the viewpoints see."""
    def visible_from_camera(self, camera: Camera, **options: Unpack[Options]) -> Visibility:
        """The points that a camera sees: `visible_from` its place, cut to its image, with `pixels` and `depths`."""
    def sees(self, viewpoint: ArrayLike, positions: Positions, **options: Unpack[Options]) -> NDArray[np.bool_]:
        """For points that are not in the cloud: whether each would be visible if it were added alone."""
    def coverage(
        self,
        viewpoints: Iterable[Seat],
        *,
        on_progress: Callable[[float], object] | None = None,
        **options: Unpack[Options],
    ) -> NDArray[np.uint32]:
        """How many of the viewpoints see each index."""
    def place_viewpoints(
        self,
        candidates: Iterable[Seat],
        count: int | None = None,
        share: float | None = None,
        weights: ArrayLike | None = None,
        *,
        on_progress: Callable[[float], object] | None = None,
        **options: Unpack[Options],
    ) -> Placement:
        """Chooses viewpoints that together see much: always the one that adds most weight, ties to the lowest number.

        At most `count` are chosen, and no more than see `share` of the weight that some candidate sees. `weights` has
        a number of at least 0 for each index.
        """
    def seen_by(
        self,
        cameras: Iterable[Camera],
        *,
        on_progress: Callable[[float], object] | None = None,
        **options: Unpack[Options],
    ) -> SeenBy:
        """Which cameras see each point, and where: the rows of a sparse matrix."""
    def calibrate(self, stations: Iterable[Station], **options: Unpack[Options]) -> Calibration:
        """The smallest thickness at which each station of a scan sees the points that it measured."""
    def visibility_map(
        self,
        viewpoint: ArrayLike,
        *,
        points: int | None = 32_768,
        corners: int | None = 131_072,
        towards: Camera | Cone | None = None,
        origin: ArrayLike | None = None,
        **options: Unpack[Options],
    ) -> VisibilityMap:
        """A map of directions, which tells for any number of places whether they are certainly hidden."""
    def panorama(
        self, viewpoint: ArrayLike, width: int, height: int, up: ArrayLike = (0, 0, 1), **options: Unpack[Options]
    ) -> Panorama:
        """The surface of the visible points as an equirectangular image of ranges, and how much sky is left."""
    def auto_radius(self, viewpoint: ArrayLike, rule: Rule = "auto") -> tuple[float, float, int]:
        """(radius, exponent, evaluations) as the rule chooses them."""
    def reconstruct(
        self, viewpoint: ArrayLike, max_edge: float | None = None, **options: Unpack[Options]
    ) -> tuple[Visibility, NDArray[np.uint32]]:
        """The visible points, and the triangles between them: (m, 3), counter-clockwise seen from the viewpoint."""
    def illuminate(
        self,
        lights: Iterable[ArrayLike],
        triangles: ArrayLike | None = None,
        smoothing: int = 1,
        ambient: float = 0.0,
        **options: Unpack[Options],
    ) -> NDArray[np.float32]:
        """The brightness of each index, from 0 to 1."""
    def append(self, positions: Positions) -> None:
        """Adds points, which take the next indices."""
    def remove(self, indices: ArrayLike) -> None:
        """Removes points. Their indices are never given again."""

class Horizon:
    """The hull of some points of a cloud, as seen from one viewpoint. What it hides is hidden in the whole cloud.

    The radius or the inversion is a number, the same for the whole cloud.
    """

    def __init__(self, viewpoint: ArrayLike, **options: Unpack[MergeOptions]) -> None: ...
    def add(self, positions: Positions) -> None:
        """Adds points."""
    def screen(self, positions: Positions) -> NDArray[np.uint32]:
        """The numbers of the points that the horizon does not hide, ascending."""
    def hides_box(self, min: ArrayLike, max: ArrayLike) -> bool:
        """Whether every point in a box is certainly hidden."""
    def visible(self) -> NDArray[np.float64]:
        """The points that were added and are visible among them: (m, 3)."""

def merge_visible(
    parts: Sequence[tuple[ArrayLike, ArrayLike]], viewpoint: ArrayLike, **options: Unpack[MergeOptions]
) -> NDArray[np.uint64]:
    """The ids of the points that are visible in a whole cloud, ascending.

    Each part is (positions, ids): the visible points of one part of the cloud, with the caller's number of each.
    The answer is exact: visible(A + B) = visible(visible(A) + visible(B)).
    """
