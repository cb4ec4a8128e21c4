"""Which points of a sphere can be seen from above? With NumPy arrays."""

import numpy as np
from hidden_point_removal import HprError, PointCloud

i = np.arange(10_000)
z = 1 - (2 * i + 1) / 10_000
r, turn = np.sqrt(1 - z * z), 2.399963 * i
points = np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1)

cloud = PointCloud(points)
seen = cloud.visible_from([0, 0, 5])
print(seen.count, "of", len(points))  # → 4118 of 10000
print(points[seen.indices, 2].min() > 0)  # → True

# Only the points closer than 4.5 take part.
near = cloud.visible_from([0, 0, 5], within={"distance": 4.5})
print(near.count < seen.count)  # → True

try:
    cloud.visible_from([0, 0, float("nan")])
except HprError as error:
    print(error.code)  # → viewpoint
