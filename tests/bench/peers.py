"""Times SciPy's Qhull on the flipped points of one view.

    python3 peers.py POSITIONS.f32 X,Y,Z RADIUS INDICES.u32 RUNS

POSITIONS.f32 holds little-endian f32 x y z, INDICES.u32 the answer to compare.
Prints one JSON line: the milliseconds of each run, and how many labels differ
(points equal to a hull vertex count as vertices).
"""

import json
import sys
import time

import numpy as np
from scipy.spatial import ConvexHull

positions, viewpoint, radius, indices, runs = sys.argv[1:]
p = np.fromfile(positions, "<f4").reshape(-1, 3).astype(float)
v = p - np.array([float(x) for x in viewpoint.split(",")])
d = np.sqrt(v[:, 0] * v[:, 0] + v[:, 1] * v[:, 1] + v[:, 2] * v[:, 2])
q = v * ((2.0 * float(radius) - d) / d)[:, None]
with_viewpoint = np.vstack([q, np.zeros(3)])

milliseconds = []
for _ in range(int(runs)):
    start = time.perf_counter()
    hull = ConvexHull(with_viewpoint)
    milliseconds.append((time.perf_counter() - start) * 1e3)

_, group = np.unique(q, axis=0, return_inverse=True)
group = group.ravel()
theirs = np.isin(group, group[hull.vertices[hull.vertices < len(q)]])
ours = np.zeros(len(q), bool)
ours[np.fromfile(indices, "<u4")] = True
print(json.dumps({"milliseconds": milliseconds, "differences": int((ours != theirs).sum())}))
