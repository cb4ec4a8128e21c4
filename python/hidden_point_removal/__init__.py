"""Which points of a point cloud can be seen from a viewpoint?

Exact hidden-point removal: the HPR operator of S. Katz, A. Tal and R. Basri, "Direct Visibility of Point Sets",
ACM Transactions on Graphics 26(3), 2007. No surface, no normals, no screen: points are flipped on a sphere around the
viewpoint, and those on the convex hull of the flipped cloud and the viewpoint are visible.

    >>> import numpy as np
    >>> from hidden_point_removal import PointCloud
    >>> cloud = PointCloud(np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 2.0]]))
    >>> cloud.visible_from([0.0, 0.0, 5.0]).indices
    array([1], dtype=uint32)
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._native import Horizon, HprError, PointCloud, VisibilityMap, merge_visible
from ._answers import Calibration, CameraView, Panorama, Placement, SeenBy, Visibility, colmap_vis, orient_normals
from ._cameras import CameraOfImage, read_cameras
from ._show import show
from ._transfer import name_options, transfer
from .types import Camera, MergeOptions, Options, OtherOptions, Positions, Station, Unpack, Within

__all__ = [
    "Camera",
    "Calibration",
    "CameraOfImage",
    "CameraView",
    "Horizon",
    "HprError",
    "MergeOptions",
    "Options",
    "Panorama",
    "Placement",
    "PointCloud",
    "SeenBy",
    "Station",
    "Visibility",
    "VisibilityMap",
    "Within",
    "colmap_vis",
    "hidden_point_removal",
    "merge_visible",
    "orient_normals",
    "read_cameras",
    "show",
    "transfer",
]
__version__ = "0.1.0"


def hidden_point_removal(
    points: Positions, camera_location: ArrayLike, radius: float | None = None, **options: Unpack[OtherOptions]
) -> NDArray[np.uint32]:
    """The indices of the visible points, ascending: uint32.

    points: array of shape (n, 3), or an Open3D point cloud: whatever `PointCloud` takes.
    camera_location: 3 numbers, in the units of the points.
    radius: float, the radius of the flipping sphere in the same units, at least the distance of the farthest point.
        None (default): chosen automatically.
    Options: those of `PointCloud.visible_from`, such as looks=3.

    The first arguments are those of Open3D's method of the same name.
    """
    return PointCloud(points).visible_from(camera_location, radius=radius, **options).indices


name_options(hidden_point_removal)
