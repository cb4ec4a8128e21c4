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

from ._native import Horizon, HprError, PointCloud, VisibilityMap, merge_visible
from .answers import Calibration, Panorama, Placement, SeenBy, Visibility, colmap_vis, orient_normals
from .cameras import CameraOfImage, read_cameras
from .transfer import transfer

__all__ = [
    "Calibration",
    "CameraOfImage",
    "Horizon",
    "HprError",
    "Panorama",
    "Placement",
    "PointCloud",
    "SeenBy",
    "Visibility",
    "VisibilityMap",
    "colmap_vis",
    "hidden_point_removal",
    "merge_visible",
    "orient_normals",
    "read_cameras",
    "transfer",
]
__version__ = "0.1.0"


def hidden_point_removal(points, camera_location, radius=None):
    """The indices of the visible points, ascending: uint32.

    points: array of shape (n, 3), or an Open3D point cloud: whatever `PointCloud` takes.
    camera_location: 3 numbers, in the units of the points.
    radius: float, the radius of the flipping sphere in the same units, at least the distance of the farthest point.
        None (default): chosen automatically.

    The arguments are those of Open3D's method of the same name.
    """
    return PointCloud(points).visible_from(camera_location, radius=radius).indices
