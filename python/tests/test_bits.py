"""The answers are, to the bit, those of the npm package."""

import hashlib
import itertools
import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from hidden_point_removal import Horizon, PointCloud, merge_visible, orient_normals, transfer

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
    {"looks": 2, "thickness": 0.3},
    {"looks": 3, "surface": "noisy"},
]
#: A lens of each model with coefficients.
LENSES = [
    ("PINHOLE", []),
    ("SIMPLE_RADIAL", [0.1]),
    ("RADIAL", [0.1, -0.02]),
    ("OPENCV", [0.1, -0.02, 0.01, 0.02]),
    ("OPENCV_FISHEYE", [0.1, -0.02, 0.03, -0.01]),
    ("FULL_OPENCV", [0.1, -0.02, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06]),
    ("FOV", [0.9]),
    ("SIMPLE_RADIAL_FISHEYE", [0.1]),
    ("RADIAL_FISHEYE", [0.1, -0.02]),
    ("THIN_PRISM_FISHEYE", [0.1, -0.02, 0.01, 0.02, 0.03, -0.01, 0.03, 0.04]),
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
    yield "illuminate", [ring, {"smoothing": 3, "ambient": 0.25}], digest(cloud.illuminate(ring, smoothing=3, ambient=0.25))
    for edge in (0.3, np.inf):
        yield "reconstruct", [viewpoint, {"maxEdge": edge}], of_view(*cloud.reconstruct(viewpoint, max_edge=edge))
    low, high = (cloud.positions - viewpoint).min(axis=0) * 0.8 + viewpoint, cloud.positions.max(axis=0)
    for within in ({"box": [low.tolist(), high.tolist()]}, {"distance": float(np.linalg.norm(high - viewpoint))}):
        for options in ({"within": within}, {"within": within, "looks": 2}):
            yield "visibleFrom", [viewpoint, options], of_view(cloud.visible_from(viewpoint, **options))
            yield "coverage", [ring, options], digest(cloud.coverage(ring, **options))
    others = cloud.positions[::90] * 1.01
    for options in ({}, {"looks": 2}):
        yield "sees", [viewpoint, others.ravel().tolist(), options], digest(cloud.sees(viewpoint, others, **options))
    for options in ({}, {"looks": 3, "up": [0.0, 1.0, 2.0]}):
        seen = cloud.panorama(viewpoint, 24, 12, **options)
        areas = np.array([seen.sky_view_factor, seen.solid_angle])
        yield "panorama", [viewpoint, {"width": 24, "height": 12, **options}], digest(seen.ranges, seen.indices, areas)
    yield "survey", [], digest(np.array([cloud.spacing, cloud.noise]), cloud.surface.encode())
    radius, points, ids = {"radius": 1e9}, cloud.positions, np.arange(len(cloud), dtype=np.uint32)
    horizon = Horizon(viewpoint, **radius)
    horizon.add(points[::5])
    left = horizon.screen(points)
    merged = merge_visible([(points[left], ids[left])], viewpoint, **radius).astype(np.uint32)
    hidden = np.array([horizon.hides_box(place - 0.01, place + 0.01) for place in points[:99]])
    yield "merge", [viewpoint, radius], digest(left, horizon.visible(), hidden, merged)
    yield from cases_of_cameras(cloud, viewpoint, ring)


def camera(place, turn):
    """A camera in Python and in JavaScript. Its axes are turned around z and x."""
    (a, b), pose = turn, np.eye(4)
    around_z = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    around_x = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    pose[:3, :3], pose[:3, 3] = around_z @ around_x, place
    lens = {"fx": 20.0, "fy": 21.0, "cx": 32.0, "cy": 24.0, "width": 64, "height": 48}
    return {"camera_to_world": pose, **lens}, {"cameraToWorld": pose.T.ravel().tolist(), **lens}


def image(number, kind, channels):
    data = np.random.default_rng(number).integers(0, 256, (48, 64, channels)).astype(kind)
    if kind != np.uint8:
        data[::5, ::7, 0] = np.nan
    name = {np.uint8: "Uint8Array", np.float32: "Float32Array", np.float64: "Float64Array"}[kind]
    listed = [None if np.isnan(value) else float(value) for value in data.ravel()]
    return data, {"type": name, "data": listed, "width": 64, "height": 48}


def cases_of_cameras(cloud, viewpoint, ring):
    turns = [(0.0, np.pi), (1.0, np.pi - 0.2), (2.0, -np.pi / 2), (0.3, np.pi / 2), (0.0, 0.0)]
    places = [viewpoint, ring[1], viewpoint, ring[1], ring[1]]
    own, others = zip(*(camera(place, turn) for place, turn in zip(places, turns)))
    own, others = list(own), list(others)
    seen = cloud.seen_by(own)
    yield "seenBy", [others], digest(seen.offsets, seen.cameras, seen.pixels, seen.towards)
    normals = np.random.default_rng(7).normal(size=(len(cloud), 3))
    yield "orientNormals", [normals.ravel().tolist(), others], digest(orient_normals(normals, seen))
    yield "coverage", [[viewpoint, *others]], digest(cloud.coverage([viewpoint, *own]))
    placed = cloud.place_viewpoints([viewpoint, *own], count=3)
    numbers = np.array([*placed.chosen, *placed.gains], float)
    yield "placeViewpoints", [[viewpoint, *others], {"count": 3}], digest(numbers, placed.seen, placed.unseen)
    yield "visibleFromAtLeast", [2, others], of_view(cloud.visible_from_at_least(2, own))
    maps = cloud.visibility_map(viewpoint, points=500)
    numbers = np.array([*maps.uniforms["hprViewpoint"], *maps.uniforms["hprMargins"]], float)
    yield "visibilityMap", [viewpoint, {"points": 500}], digest(maps.data, numbers)
    towards = cloud.visibility_map(places[0], towards=own[0])
    numbers = np.array([*towards.uniforms["hprViewpoint"], *towards.uniforms["hprMargins"]], float)
    yield "visibilityMap", [places[0], {"towards": others[0]}], digest(towards.data, numbers)
    yield "hides", [viewpoint, {"points": 500}], digest(maps.hides(cloud.positions))
    for (model, distortion), convention in itertools.product(LENSES, ("opencv", "opengl")):
        lens = {"model": model, "distortion": distortion, "convention": convention, "near": 0.1, "far": 99.0}
        view = cloud.visible_from_camera({**own[1], **lens}, exponent=3)
        yield "visibleFromCamera", [{**others[1], **lens}, {"exponent": 3}], digest(view.indices, view.pixels, view.depths)
    stations = [{"viewpoint": viewpoint, "indices": list(range(0, len(cloud), 3))}]
    found = cloud.calibrate(stations)
    yield "calibrate", [stations], digest(np.array([found.thickness, found.shown, *found.recall]))
    for kind, channels, options in TRANSFERS:
        images, listed = zip(*(image(number, kind, channels) for number in range(len(own))))
        values, counts = transfer(cloud, own, list(images), **options)
        yield "transfer", [others, listed, options], digest(values.astype(np.float32), counts)


TRANSFERS = [
    (np.uint8, 3, {}),
    (np.uint8, 4, {"merge": "mean", "sampling": "bilinear"}),
    (np.float32, 2, {"merge": "mean", "weights": "score"}),
    (np.float64, 1, {"merge": "median", "weights": "score"}),
    (np.float64, 2, {"merge": "median", "weights": "distance", "sampling": "bilinear"}),
    (np.uint8, 1, {"merge": "vote", "exponent": 2.5}),
    (np.float32, 3, {"merge": "best"}),
]


@pytest.mark.skipif(shutil.which("node") is None or not PACKAGE.exists(), reason="the npm package is not built")
@pytest.mark.filterwarnings("ignore:next to no points", "ignore:the stations see less")
def test_the_same_bits_as_the_npm_package(tmp_path):
    asked, expected = [], []
    for (name, (points, viewpoint)), number in zip(clouds().items(), itertools.count()):
        file = tmp_path / f"{number}.bin"
        points.tofile(file)
        precision = "single" if points.dtype == np.float32 else "double"
        for call, arguments, answer in cases(PointCloud(points), viewpoint):
            asked.append({"name": name, "file": str(file), "precision": precision, "call": call, "arguments": arguments})
            expected.append(answer)
    (tmp_path / "cases.json").write_text(json.dumps(asked).replace("Infinity", "1e999"))
    command = ["node", HERE / "answers.mjs", PACKAGE, tmp_path / "cases.json"]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    answers = done.stdout.split()
    assert len(answers) == len(asked) > 200
    wrong = [f"{case['name']}: {case['call']} {str(case['arguments'])[-120:]}"
             for case, answer, own in zip(asked, answers, expected, strict=True) if answer != own]
    assert wrong == []
