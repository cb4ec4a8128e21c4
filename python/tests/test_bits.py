"""The answers are, to the bit, those of the npm package."""

import hashlib
import itertools
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hidden_point_removal import PointCloud

HERE = Path(__file__).parent
PACKAGE = HERE.parents[1] / "dist" / "index.js"


def clouds():
    random = np.random.default_rng(11)
    bumpy = random.normal(size=(2500, 3))
    bumpy /= np.linalg.norm(bumpy, axis=1)[:, None]
    bumpy *= 1 + 0.2 * np.sin(5 * bumpy[:, :1]) * np.cos(4 * bumpy[:, 1:2])
    lattice = random.integers(-4, 5, (1500, 3)).astype(np.float64)
    plane = np.column_stack([random.uniform(-2, 2, (900, 2)), np.zeros(900)])
    twice = np.concatenate([bumpy[:700], bumpy[300:1000]])
    return {
        "bumpy, single": (bumpy.astype(np.float32), [0.3, 0.2, 4.0]),
        "bumpy, from within": (bumpy, [0.1, -0.2, 0.05]),
        "map coordinates": (bumpy * 40 + [636_000, 849_000, 400], [636_090.0, 849_000.0, 430.0]),
        "lattice, with equal points": (lattice, [6.0, 0.0, 0.0]),
        "in a plane with the viewpoint": (plane, [3.0, 1.0, 0.0]),
        "points twice, single": (twice.astype(np.float32), [0.0, 3.0, 0.0]),
    }


OPTIONS = [
    {},
    {"exponent": 2.5},
    {"inversion": {"power": 1.7}},
    {"inversion": {"exponential": "auto"}},
    {"looks": 3, "scores": True},
    {"denoise": 8},
    {"vote": 6},
    {"draft": True},
    {"sample": 400},
]


def digest(*arrays):
    return hashlib.sha256(b"".join(np.ascontiguousarray(array).tobytes() for array in arrays)).hexdigest()


def of_view(seen, triangles=()):
    scores = np.empty(0, np.float32) if seen.scores is None else seen.scores
    return digest(seen.indices, np.array([seen.radius, seen.exponent]), scores, np.array(triangles, np.uint32))


def cases(cloud, viewpoint):
    """(call in JavaScript, arguments, answer in Python)"""
    for options in OPTIONS:
        yield "visibleFrom", [viewpoint, options], of_view(cloud.visible_from(viewpoint, **options))
    for options in ({}, {"inversion": {"exponential": "auto"}}):
        along = [0.3, -0.7, 0.2]
        yield "visibleFromDirection", [along, options], of_view(cloud.visible_from_direction(along, **options))
    ring = [viewpoint, [viewpoint[0] + 1, viewpoint[1], viewpoint[2] + 0.5]]
    yield "visibleFromAny", [ring], of_view(cloud.visible_from_any(ring))
    yield "reconstruct", [viewpoint], of_view(*cloud.reconstruct(viewpoint))
    yield "illuminate", [ring], digest(cloud.illuminate(ring))


@pytest.mark.skipif(shutil.which("node") is None or not PACKAGE.exists(), reason="the npm package is not built")
def test_the_same_bits_as_the_npm_package(tmp_path):
    asked, expected = [], []
    for (name, (points, viewpoint)), number in zip(clouds().items(), itertools.count()):
        file = tmp_path / f"{number}.bin"
        points.tofile(file)
        precision = "single" if points.dtype == np.float32 else "double"
        for call, arguments, answer in cases(PointCloud(points), viewpoint):
            asked.append({"name": name, "file": str(file), "precision": precision, "call": call, "arguments": arguments})
            expected.append(answer)
    (tmp_path / "cases.json").write_text(json.dumps(asked))
    command = ["node", HERE / "answers.mjs", PACKAGE, tmp_path / "cases.json"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answers = done.stdout.split()
    assert len(answers) == len(asked) > 60
    wrong = [f"{case['name']}: {case['call']} {case['arguments']}"
             for case, answer, own in zip(asked, answers, expected, strict=True) if answer != own]
    assert wrong == []
