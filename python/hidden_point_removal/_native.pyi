from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import Calibration, CameraView, Panorama, Placement, SeenBy, Visibility
from .types import CameraLike, Cone, MergeOptions, Options, Positions, Rule, Seat, Station, Unpack

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
    def __reduce__(self) -> tuple[Any, ...]: ...
    def hides(self, positions: Positions) -> NDArray[np.bool_]:
        """Which places are certainly hidden."""

class PointCloud:
    """A point cloud, prepared for visibility queries.

    `positions` is an array or tensor of shape (n, 3), a cloud or a table of another library, columns by name, or the path of
    a file: `help(PointCloud)` lists them. With `non_finite="skip"`, points that are not finite are never visible.
    """

    def __new__(cls, positions: Positions, non_finite: Literal["error", "skip"] = "error") -> PointCloud: ...
    def __len__(self) -> int: ...
    @property
    def positions(self) -> NDArray[Any]:
        """The positions: (n, 3), in the cloud's precision. NaN where a point was removed or left out."""
    @property
    def skipped(self) -> int:
        """How many points were left out because they are not finite."""
    @property
    def spacing(self) -> float:
        """The mean distance of a point to its 6 nearest points."""
    @property
    def noise(self) -> float:
        """How far measured points lie off their surface: one standard deviation; 0 where nothing tells of noise."""
    @property
    def surface(self) -> Literal["clean", "noisy", "layered"]:
        """What the survey found: an even sample of a surface, a sensor's noise everywhere, or layers as of registered scans."""
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
    def visible_from_camera(self, camera: CameraLike, **options: Unpack[Options]) -> CameraView:
        """The points that a camera sees: `visible_from` its place, cut to its image, with `pixels` and `depths`."""
    def sees(self, viewpoint: ArrayLike, positions: Positions, **options: Unpack[Options]) -> NDArray[np.bool_]:
        """For points that are not in the cloud: whether each would be visible if it were added alone."""
    def visible_from_each(
        self,
        viewpoints: Iterable[Seat],
        *,
        on_progress: Callable[[float], object] | None = None,
        **options: Unpack[Options],
    ) -> NDArray[np.bool_]:
        """What each of several viewpoints sees: (viewpoints, indices)."""
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
        cameras: Iterable[CameraLike],
        *,
        on_progress: Callable[[float], object] | None = None,
        **options: Unpack[Options],
    ) -> SeenBy:
        """Which cameras see each point, and where: the rows of a sparse matrix (`matrix()`)."""
    def calibrate(self, stations: Iterable[Station], **options: Unpack[Options]) -> Calibration:
        """The thickness at which each station of a scan sees most of the points that it measured, and few hidden ones."""
    def visibility_map(
        self,
        viewpoint: ArrayLike,
        *,
        points: int | None = 750_000,
        towards: CameraLike | Cone | None = None,
        origin: ArrayLike | None = None,
        **options: Unpack[Options],
    ) -> VisibilityMap:
        """A map of directions, which tells for any number of places whether they are certainly hidden."""
    def panorama(
        self, viewpoint: ArrayLike, width: int, height: int, up: ArrayLike = (0, 0, 1), **options: Unpack[Options]
    ) -> Panorama:
        """The surface of the visible points as an equirectangular image of ranges, and how much sky is left."""
    def auto_radius(self, viewpoint: ArrayLike, rule: Rule | None = "auto") -> tuple[float, float, int]:
        """(radius, exponent, evaluations) as the rule chooses them."""
    def reconstruct(
        self, viewpoint: ArrayLike, max_edge: float | None = None, **options: Unpack[Options]
    ) -> tuple[Visibility, NDArray[np.uint32]]:
        """The visible points, and the triangles between them: (m, 3), counter-clockwise seen from the viewpoint."""
    def illuminate(
        self,
        lights: Iterable[ArrayLike],
        triangles: ArrayLike | None = None,
        smoothing: int | None = 1,
        ambient: float | None = 0.0,
        **options: Unpack[Options],
    ) -> NDArray[np.float32]:
        """The brightness of each index, from 0 to 1."""
    def append(self, positions: Positions) -> None:
        """Adds points, which take the next indices."""
    def remove(self, indices: ArrayLike) -> None:
        """Removes points, by their indices or by a mask. Their indices are never given again."""
    def _transfer(
        self,
        cameras: Iterable[CameraLike],
        images: Iterator[NDArray[Any]],
        how: list[int],
        on_progress: Callable[[float], object] | None = None,
        **options: Unpack[Options],
    ) -> tuple[NDArray[Any], NDArray[np.uint32]]: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def __setstate__(self, removed: ArrayLike) -> None: ...

class Horizon:
    """The hull of some points of a cloud, as seen from one viewpoint. What it hides is hidden in the whole cloud.

    The radius or the inversion is a number, the same for the whole cloud.
    """

    def __new__(cls, viewpoint: ArrayLike, **options: Unpack[MergeOptions]) -> Horizon: ...
    def __getnewargs_ex__(self) -> tuple[tuple[tuple[float, float, float]], dict[str, Any]]: ...
    def __getstate__(self) -> NDArray[np.float64]: ...
    def __setstate__(self, points: ArrayLike) -> None: ...
    def add(self, positions: Positions) -> None:
        """Adds points."""
    def screen(self, positions: Positions) -> NDArray[np.uint32]:
        """The numbers of the points that the horizon does not hide, ascending."""
    def hides_box(self, min: ArrayLike, max: ArrayLike) -> bool:
        """Whether every point in a box is certainly hidden."""
    def visible(self) -> NDArray[np.float64]:
        """The points that were added and are visible among them: (m, 3)."""

def merge_visible(
    parts: Sequence[tuple[Positions, ArrayLike]], viewpoint: ArrayLike, **options: Unpack[MergeOptions]
) -> NDArray[np.uint64]:
    """The ids of the points that are visible in a whole cloud, ascending.

    Each part is (positions, ids): the visible points of one part of the cloud, with the caller's number of each.
    The answer is exact: visible(A + B) = visible(visible(A) + visible(B)).
    """

def _map(
    viewpoint: Sequence[float], origin: Sequence[float], numbers: Sequence[float], data: NDArray[np.float32]
) -> VisibilityMap: ...
def _lenses(given: Iterable[CameraLike]) -> list[list[float]]: ...
