"""What 16 scanners around a cloud would see of it, to train with: partial_views.py CLOUD.laz VIEWS.npz"""

import sys

import numpy as np

from hidden_point_removal import PointCloud

file, out = sys.argv[1:]
cloud = PointCloud(file)
points = cloud.positions
directions = np.random.default_rng(0).normal(size=(16, 3))
directions /= np.linalg.norm(directions, axis=1, keepdims=True)
eyes = points.mean(axis=0) + 1.5 * np.ptp(points, axis=0).max() * directions
masks = cloud.visible_from_each(eyes, looks=3)
np.savez(out, *(points[mask] for mask in masks))
print(f"{len(masks)} views of {masks.mean():.0%} of the points")
