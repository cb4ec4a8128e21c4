"""Answers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from ._arguments import array, refusal

if TYPE_CHECKING:
    from scipy.sparse import csr_array

    from ._native import PointCloud


@dataclass(frozen=True, eq=False, repr=False)
class Visibility:
    """Which points are visible. It is an index: `points[visible]` are the visible ones, `points[~visible]` the hidden ones.

    indices: the indices of the visible points, ascending.
    scores: a score from 0 to 1 for each index. None unless it was asked for.
    radius: R of the flipping sphere; 0 where the inversion has none.
    exponent: log10(R / farthest distance); 0 where the inversion has none.
    evaluations: how many hulls the choice of R took.
    exact: True: the answer is final.
    inversion: the inversion that was used, with numbers only.
    """

    indices: NDArray[np.uint32]
    scores: NDArray[np.float32] | None
    radius: float
    exponent: float
    evaluations: int
    exact: bool
    inversion: str | dict[str, float | list[float]]
    _length: int
    _cloud: PointCloud | None

    @property
    def count(self) -> int:
        """How many points are visible."""
        return len(self.indices)

    @property
    def points(self) -> NDArray[Any]:
        """The positions of the visible points: shape (count, 3), in the precision of the cloud. NaN for points that were
        removed since. An answer that came from a file or another process has no cloud; there, `points[visible]` of the
        positions does."""
        if self._cloud is None:
            raise refusal("option", "this answer was copied without its cloud; index the positions by it, as in points[visible]")
        return self._cloud.positions[self.indices]

    def mask(self) -> NDArray[np.bool_]:
        """One truth value for each index: True where the point is visible. Polars filters by it."""
        mask = np.zeros(self._length, bool)
        mask[self.indices] = True
        return mask

    def __invert__(self) -> NDArray[np.bool_]:
        """One truth value for each index: True where the point is hidden."""
        return ~self.mask()

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> NDArray[Any]:
        """The indices: int64, unless another type is asked for. Of bool, the mask."""
        if dtype is not None and np.dtype(dtype) == bool:
            return self.mask()
        return self.indices.astype(np.int64 if dtype is None else dtype)

    def __len__(self) -> int:
        return self.count

    def __call__(self, _: object) -> NDArray[np.bool_]:
        # pandas asks an index that it can call for the rows.
        return self.mask()

    def __getitem__(self, number: Any) -> Any:
        # So this is a sequence, which torch takes as an index: an int, or a list for a slice.
        return self.indices[number].tolist()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_cloud": None}

    def _how(self) -> str:
        used = {"radius": self.radius or None, **(self.inversion if isinstance(self.inversion, dict) else {})}
        # Of looks, their number.
        return "".join(f", {name}={len(value) if isinstance(value, list) else f'{value:.6g}'}" for name, value in used.items() if value)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.count} of {self._length} points{self._how()})"

    def _repr_html_(self) -> str:
        share = self.count / max(1, self._length)
        bar = f"<progress max='1' value='{share:.4f}'></progress>"
        return f"<p>{bar} <b>{self.count:,}</b> of {self._length:,} points are visible ({share:.1%}){self._how()}</p>"


@dataclass(frozen=True, eq=False, repr=False)
class CameraView(Visibility):
    """Which points a camera sees: a `Visibility`, and where its image shows them.

    pixels: where each visible point is in the image, x and y: shape (count, 2).
    depths: the depth of each visible point along the optical axis.
    """

    pixels: NDArray[np.float32]
    depths: NDArray[np.float32]


class Panorama(NamedTuple):
    """What stands in each direction around a viewpoint. Row 0 is up, column 0 looks along +x."""

    ranges: NDArray[np.float32]
    """The distance to the surface in each direction: (height, width). Infinity for the sky."""
    indices: NDArray[np.uint32]
    """The visible point that is nearest by angle: (height, width). 2**32 - 1 for the sky."""
    sky_view_factor: float
    """The share of the sky in the upper half of the sphere, weighted by the cosine from up: 0 to 1."""
    solid_angle: float
    """How much of the sphere is surface, in steradians."""


class Placement(NamedTuple):
    """Viewpoints that were chosen among candidates."""

    chosen: list[int]
    """The numbers of the chosen candidates, in the order of their choice."""
    gains: list[float]
    """The weight that each of them adds to those before it."""
    seen: NDArray[np.uint32]
    """The indices that at least one of them sees, ascending."""
    unseen: NDArray[np.uint32]
    """The indices that no candidate sees, ascending."""


class Calibration(NamedTuple):
    """How a cloud is to be asked, so that its scanners see the points that they measured."""

    thickness: float
    """The thickness that was found, in the cloud's units."""
    recall: list[float]
    """For each station, the share of its own points that `options` see, from 0 to 1."""
    shown: float
    """Of the points that would otherwise be hidden, the share that `options` show."""
    options: dict[str, Any]
    """The given options with `looks` and this `thickness`."""


class SeenBy(NamedTuple):
    """Which cameras see each point: the rows of a sparse matrix. The cameras of point i are
    `cameras[offsets[i]:offsets[i + 1]]`, ascending."""

    offsets: NDArray[np.uint32]
    """One number more than the cloud has indices."""
    cameras: NDArray[np.uint32]
    """The number of the camera of each entry."""
    pixels: NDArray[np.float32]
    """Where the camera shows the point, x and y: shape (entries, 2)."""
    towards: NDArray[np.float32]
    """The direction of length 1 from the point to the camera: shape (entries, 3)."""
    shape: tuple[int, int]
    """How many points and how many cameras there are, those that see nothing included."""

    def matrix(self, values: ArrayLike | None = None) -> csr_array:
        """The matrix of points and cameras: `scipy.sparse.csr_array`. `values` has one for each entry; default 1."""
        from scipy.sparse import csr_array

        ones = np.ones(len(self.cameras), np.int32)
        given = ones if values is None else array(values, "values", "biufc", "a list of numbers")
        if given.shape != self.cameras.shape:
            raise refusal("option", f"values must hold one number for each of {len(self.cameras)} entries, got the shape {given.shape}")
        return csr_array((given, self.cameras, self.offsets), self.shape)


def seen_by(length: int, views: list[tuple[CameraView, NDArray[np.float32]]]) -> SeenBy:
    """The `SeenBy` of views of a cloud of so many indices: of each, the `CameraView` and the directions to the camera."""
    indices = np.concatenate([np.empty(0, np.uint32), *(view.indices for view, _ in views)])
    if len(indices) >= 2**32:
        raise refusal("too-large", f"{len(indices)} entries exceed the limit of {2**32 - 1}")
    order, offsets = np.argsort(indices, kind="stable"), np.zeros(length + 1, np.uint32)
    np.cumsum(np.bincount(indices, minlength=length), out=offsets[1:])
    cameras = np.repeat(np.arange(len(views), dtype=np.uint32), [view.count for view, _ in views])[order]
    pixels = np.concatenate([np.empty((0, 2), np.float32), *(view.pixels for view, _ in views)])[order]
    towards = np.concatenate([np.empty((0, 3), np.float32), *(towards for _, towards in views)])[order]
    return SeenBy(offsets, cameras, pixels, towards, (length, len(views)))


def orient_normals(normals: ArrayLike, seen_by: SeenBy) -> NDArray[Any]:
    """Turns normals towards the cameras that see their points: the side that most of them look at.

    In a tie, the sum of the cosines decides. What no camera sees stays as it is, and so does a normal of zeros.

    normals: array of float32 or float64, shape (n, 3), one for each index of the cloud.
    seen_by: what `PointCloud.seen_by` answers.

    Returns new normals of the same type. Raises `HprError` with the code "option".
    """
    offsets = offsets_of(seen_by, "orient_normals", "towards")
    count = len(offsets) - 1
    normals = array(normals, "normals", "fiu", f"numbers of the shape ({count}, 3)")
    if normals.shape != (count, 3):
        raise refusal("option", f"normals must be numbers of the shape ({count}, 3), got {normals.dtype} of {normals.shape}")
    normals = normals.astype(np.float32 if normals.dtype == np.float32 else np.float64)
    rows = np.repeat(np.arange(count), np.diff(offsets))
    x, y, z = (normals[rows, axis].astype(float) * seen_by.towards[:, axis] for axis in range(3))
    cosines = x + y + z
    votes, sums = (np.bincount(rows, weights, count) for weights in (np.sign(cosines), cosines))
    return np.where(((votes < 0) | ((votes == 0) & (sums < 0)))[:, None], -normals, normals)


def colmap_vis(seen_by: SeenBy) -> bytes:
    """What COLMAP's `fused.ply.vis` says: which cameras see each point. `seen_by` is the answer of `PointCloud.seen_by`.

    Returns bytes: little-endian, the number of points in 64 bits, then for each point how many cameras see it, and their
    numbers from 0, in 32 bits each. Raises `HprError` with the code "option".
    """
    offsets = offsets_of(seen_by, "colmap_vis", "cameras")
    rows = np.insert(seen_by.cameras, offsets[:-1], np.diff(offsets))
    return np.array([len(offsets) - 1], "<u8").tobytes() + rows.astype("<u4").tobytes()


def offsets_of(seen_by: SeenBy, asked: str, entries: str) -> NDArray[np.int64]:
    """The offsets of a `SeenBy`, which rise from 0 to the number of its entries."""
    offsets = np.asarray(seen_by.offsets, np.int64) if isinstance(seen_by, SeenBy) else np.empty(0)
    if not len(offsets) or offsets[0] != 0 or offsets[-1] != len(getattr(seen_by, entries)) or (np.diff(offsets) < 0).any():
        raise refusal("option", f"{asked} needs what seen_by of a cloud answers")
    return offsets
