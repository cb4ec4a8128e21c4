"""Asks Open3D and this package the same question in one process, and compares visible points and processor time.

pip install open3d-cpu; python open3d_compare.py [CLOUD.ply …]

A cloud of a file is seen from its side, 2.5 radii from its middle, at R = 1000 times the farthest distance, as the others.
"""

import sys
import time

import numpy as np

from hidden_point_removal import PointCloud

RUNS = 5
random = np.random.default_rng(0)


def bumpy(count):
    unit = random.normal(size=(count, 3))
    unit /= np.linalg.norm(unit, axis=1)[:, None]
    return unit * (1 + 0.1 * np.sin(5 * unit[:, :1]) * np.sin(7 * unit[:, 1:2]))


def room(count):
    half = np.array([3, 2, 1.3])
    points = random.uniform(-1, 1, (count, 3)) * half
    wall = random.integers(0, 3, count)
    points[np.arange(count), wall] = half[wall] * random.choice([-1, 1], count)
    return points


def seconds(call):
    """The answer, and the least processor time."""
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        answer = call()
        times.append(time.process_time() - start)
    return answer, min(times)


def main():
    try:
        import open3d
    except ImportError as missing:
        print(f"Left out: {missing}")
        return
    clouds = [
        ("bumpy sphere", bumpy(100_000), [0, 0, 5.0]),
        ("normally distributed", random.normal(size=(100_000, 3)), [0, 0, 10.0]),
        ("room from inside", room(200_000), [0.3, 0.2, 0.1]),
    ]
    for path in sys.argv[1:]:
        points = np.asarray(open3d.io.read_point_cloud(path).points)
        low, high = points.min(axis=0), points.max(axis=0)
        clouds.append((path, points, (low + high) / 2 + [0, 0, 1.25 * np.linalg.norm(high - low)]))
    for name, points, eye in clouds:
        radius = 1000 * np.linalg.norm(points - eye, axis=1).max()
        other = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
        (_, indices), theirs = seconds(lambda: other.hidden_point_removal(eye, radius))
        cloud, building = seconds(lambda: PointCloud(points))
        seen, view = seconds(lambda: cloud.visible_from(eye, radius=radius, threads=1))
        # Of points in the same place, Open3D names one.
        assert np.array_equal(np.unique(points[indices], axis=0), np.unique(points[seen], axis=0))
        print(f"{name}, {len(points):,}: Open3D {1e3 * theirs:.0f} ms; building {1e3 * building:.1f}, view {1e3 * view:.1f} ms; "
              f"ratio {theirs / (building + view):.1f}, of the view alone {theirs / view:.1f}")


if __name__ == "__main__":
    main()
