"""Times a Python peer on one view.

    python3 peers.py scipy|open3d CLOUD f32|f64 X,Y,Z RADIUS RUNS OUT

CLOUD holds little-endian x y z. OUT receives the numbers of the hull's vertices as
little-endian u32. SciPy's ConvexHull gets the flipped points and the viewpoint. Only its
hull is timed. Open3D's hidden_point_removal flips by itself.
Prints the milliseconds of each run as JSON.
"""

import json
import sys
import time

import numpy as np


def scipy(points, viewpoint, radius):
    from scipy.spatial import ConvexHull

    v = points - viewpoint
    x, y, z = v.T
    d = np.sqrt(x * x + y * y + z * z)
    q = v * ((2.0 * radius - d) / d)[:, None]
    with_viewpoint = np.vstack([q, np.zeros(3)])
    return lambda: ConvexHull(with_viewpoint).vertices


def open3d(points, viewpoint, radius):
    import open3d

    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    return lambda: cloud.hidden_point_removal(viewpoint, radius)[1]


def main():
    peer, cloud, precision, viewpoint, radius, runs, out = sys.argv[1:]
    points = np.fromfile(cloud, {"f32": "<f4", "f64": "<f8"}[precision]).reshape(-1, 3).astype(float)
    viewpoint = np.array([float(x) for x in viewpoint.split(",")])
    work = {"scipy": scipy, "open3d": open3d}[peer](points, viewpoint, float(radius))
    milliseconds = []
    for _ in range(int(runs)):
        start = time.perf_counter()
        vertices = work()
        milliseconds.append((time.perf_counter() - start) * 1e3)
    np.asarray(vertices, "<u4").tofile(out)
    print(json.dumps(milliseconds))


main()
