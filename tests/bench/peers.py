"""Times SciPy's ConvexHull of one view's flipped points and the viewpoint.

    python3 peers.py CLOUD f32|f64 X,Y,Z RADIUS RUNS OUT

CLOUD holds little-endian x y z. OUT receives the numbers of the hull's vertices as
little-endian u32. Only the hull is timed. Prints the milliseconds of each run as JSON.
"""

import json
import sys
import time

import numpy as np
from scipy.spatial import ConvexHull

cloud, precision, viewpoint, radius, runs, out = sys.argv[1:]
points = np.fromfile(cloud, {"f32": "<f4", "f64": "<f8"}[precision]).reshape(-1, 3).astype(float)
v = points - np.array([float(x) for x in viewpoint.split(",")])
x, y, z = v.T
d = np.sqrt(x * x + y * y + z * z)
q = np.vstack([v * ((2.0 * float(radius) - d) / d)[:, None], np.zeros(3)])
milliseconds = []
for _ in range(int(runs)):
    start = time.perf_counter()
    vertices = ConvexHull(q).vertices
    milliseconds.append((time.perf_counter() - start) * 1e3)
np.asarray(vertices, "<u4").tofile(out)
print(json.dumps(milliseconds))
