"""Pictures of answers, in a notebook or as a file."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from ._answers import Visibility
from ._arguments import indices, refusal, word_number
from ._native import PointCloud

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from .types import Positions

#: A drawing of more points takes long and shows no more.
MOST = 100_000
LOW, HIGH, HIDDEN = np.array([[0.1, 0.3, 0.8], [1.0, 0.75, 0.1], [0.8, 0.8, 0.8]])
UPS = ("z", "y", "-y")
#: Loads the element, and hands it the cloud as a file.
SCRIPT = """export default { async render({ model, el }) {
  await import(model.get("element"));
  const view = document.createElement("hidden-point-cloud");
  view.hiddenPoints = "shown";
  view.up = model.get("up");
  view.src = URL.createObjectURL(new Blob([model.get("file")]));
  el.append(view);
  return () => URL.revokeObjectURL(view.src);
} };"""


def show(
    cloud: PointCloud | Positions,
    visible: Visibility | ArrayLike | None = None,
    element: str | None = None,
    up: Literal["y", "z", "-y"] = "z",
) -> Any:
    """A picture of a cloud for a notebook: visible points colored by height, hidden ones grey.

    cloud: `PointCloud`, or what it takes.
    visible: a `Visibility`, indices, or a mask. None (default): all points.
    element: the address of `hidden-point-cloud.js` (docs/EMBED.md), with which the picture can be turned. Needs anywidget.
    up: "y", "z" (default) or "-y": which way is up.

    Returns a `matplotlib.figure.Figure` of at most 100,000 points, whose `savefig("view.png")` keeps it; with `element`, an
    `anywidget.AnyWidget` of all points. Raises `ImportError` without matplotlib or anywidget, and `HprError` with the code
    "option" for indices that the cloud does not have.
    """
    axis = UPS[word_number("up", up, UPS)]
    cloud = cloud if isinstance(cloud, PointCloud) else PointCloud(cloud)
    positions = cloud.positions
    is_seen = np.full(len(positions), visible is None)
    if visible is not None:
        own = indices(visible, "visible", len(positions))
        if own.size and own.max() >= len(positions):
            raise refusal("option", f"visible has index {own.max()}, which must be below {len(positions)}")
        is_seen[own] = True
    # Points that were removed have no place.
    there = np.isfinite(positions).all(axis=1)
    positions, is_seen = positions[there], is_seen[there, None]
    height = positions[:, [2]] if axis == "z" else positions[:, [1]] * (-1 if axis == "-y" else 1)
    height = height - height.min(initial=np.inf)
    share = height / (height.max(initial=0) or 1)
    colors = np.where(is_seen, LOW * (1 - share) + HIGH * share, HIDDEN)
    return _figure(positions, colors, axis) if element is None else _widget(positions, colors, element, axis)


def _figure(positions: NDArray[Any], colors: NDArray[Any], up: str) -> Any:
    try:
        from matplotlib.figure import Figure
    except ImportError as missing:
        raise ImportError(f"{missing}; install hidden-point-removal[show]") from missing
    if len(positions) > MOST:
        drawn = np.random.default_rng(0).choice(len(positions), MOST, replace=False)
        positions, colors = positions[drawn], colors[drawn]
    figure = Figure(figsize=(6, 6), layout="constrained")
    axes: Any = figure.add_subplot(projection="3d")
    axes.scatter(*positions.T, c=colors, s=2000 / (len(positions) + 500), depthshade=False)
    # From above, which is below for an axis that points down.
    axes.view_init(elev=30 if up != "-y" else -30, roll=0 if up != "-y" else 180, vertical_axis=up[-1])
    axes.set(xlabel="x", ylabel="y", zlabel="z", aspect="equal")

    def png() -> bytes:
        file = io.BytesIO()
        figure.savefig(file, format="png")
        return file.getvalue()

    # Notebooks know figures only after pyplot was imported.
    setattr(figure, "_repr_png_", png)
    return figure


def _widget(positions: NDArray[Any], colors: NDArray[Any], element: str, up: str) -> Any:
    try:
        import anywidget
        import traitlets
    except ImportError as missing:
        raise ImportError(f"{missing}; install hidden-point-removal[show]") from missing

    # Where anywidget is not installed, its types are unknown.
    class Picture(anywidget.AnyWidget):  # type: ignore[misc, unused-ignore]
        _esm = SCRIPT
        element = traitlets.Unicode().tag(sync=True)
        up = traitlets.Unicode().tag(sync=True)
        file = traitlets.Bytes().tag(sync=True)

    return Picture(element=element, up=up, file=_ply(positions, colors))


def _ply(positions: NDArray[Any], colors: NDArray[Any]) -> bytes:
    rows = np.empty(len(positions), [("at", "<f8", 3), ("color", "u1", 3)])
    rows["at"], rows["color"] = positions, 255 * colors
    fields = [*(f"double {axis}" for axis in "xyz"), *(f"uchar {name}" for name in ("red", "green", "blue"))]
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(rows)}", *(f"property {field}" for field in fields)]
    return "\n".join([*header, "end_header", ""]).encode() + rows.tobytes()
