"""The nodes of a COPC file are tiles. The fixture has three levels with 500, 500 and 2,000 points, on several pages."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

laspy = pytest.importorskip("laspy")
pytest.importorskip("lazrs")
pytest.importorskip("scipy")

from hidden_point_removal import HprError, PointCloud
from hidden_point_removal.distributed import read_tile, visible_from_tiles
from hidden_point_removal.distributed.copc import CopcNode, nodes_of

FIXTURE = Path(__file__).parents[2] / "tests" / "browser" / "fixtures" / "octree.copc.laz"
#: Around the ball, inside of it, and on one of its points.
VIEWPOINTS = [[512345.0, 5403250.0, 431.6], [512340.0, 5403215.0, 418.0]]


@pytest.fixture
def octree(tmp_path):
    return Path(shutil.copy(FIXTURE, tmp_path / "octree.copc.laz"))


def test_nodes_hold_the_points_of_the_file_in_its_order(octree):
    nodes = nodes_of(octree)
    assert len(nodes) > 20 and sum(node.points for node in nodes) == 3000
    assert np.array_equal(np.concatenate([node() for node in nodes]), read_tile(octree))


@pytest.mark.parametrize("options", [{}, {"radius": 1e5}, {"inversion": {"power": 2}, "radius": 1000.0}])
def test_nodes_answer_as_one_cloud(octree, options):
    points = read_tile(octree)
    own = points[:40] + [0.0, 0.0, 3.0]
    viewpoints = [*VIEWPOINTS, points.mean(axis=0), points[7]]
    answers = visible_from_tiles([own, octree, own[:3]], viewpoints, **options)
    assert answers.tiles == len(nodes_of(octree)) + 2
    whole = PointCloud(np.concatenate([own, points, own[:3]]))
    for viewpoint, answer in zip(viewpoints, answers, strict=True):
        assert np.array_equal(answer, whole.visible_from(viewpoint, **answers.options).indices)


def test_a_hidden_node_is_not_read(octree, monkeypatch):
    reads = []
    read = CopcNode.__call__
    monkeypatch.setattr(CopcNode, "__call__", lambda node: reads.append(node.key) or read(node))
    options = {"inversion": {"exponential": 2.0}, "share": 0.2}
    first = visible_from_tiles([octree], VIEWPOINTS[:1], **options)
    assert first.skipped[0] > 0
    assert len(reads) == 2 * first.tiles - first.skipped[0], "a node is measured once, and then read unless it is hidden"
    reads.clear()
    again = visible_from_tiles([octree], VIEWPOINTS[:1], **options)
    assert len(reads) == again.tiles - again.skipped[0], "what is known of the nodes was kept"
    assert np.array_equal(first[0], again[0])
    whole = PointCloud(read_tile(octree)).visible_from(VIEWPOINTS[0], **again.options)
    assert np.array_equal(again[0], whole.indices)


def damaged(path, where, value):
    content = bytearray(path.read_bytes())
    content[where : where + len(value)] = value
    path.write_bytes(content)


def page_of(path):
    with open(path, "rb") as file:
        info = laspy.LasHeader.read_from(file).vlrs[0]
    return info.hierarchy_root_offset, info.hierarchy_root_size


def test_a_broken_octree_is_refused(octree):
    start, size = page_of(octree)
    content = octree.read_bytes()
    entries = np.frombuffer(content[start : start + size], "<i4").reshape(-1, 8)
    root = int(np.flatnonzero((entries[:, :4] == 0).all(axis=1))[0])
    number = lambda value, length=4: int(value).to_bytes(length, "little", signed=True)  # noqa: E731
    node = nodes_of(octree)[5]
    for where, value, said in [
        (start + 32 * root + 28, number(499), "2999 points"),
        (start + 32 * root + 28, number(-7), "-7 points"),
        (start + 32 * root + 24, number(1 << 30), "bytes"),
        (start + 32 * root + 16, number(len(content), 8), "bytes"),
        # A page that contains itself.
        (start + 32 * root + 16, number(start, 8) + number(size) + number(-1), "page"),
        # A page beyond the end.
        (start + 32 * root + 16, number(len(content), 8) + number(32) + number(-1), "page"),
        (start + 32 * root + 16, number(start, 8) + number(31) + number(-1), "page"),
        (node.offset + 36, number(3), f"node {node.key}"),
        (0, b"LASX", "octree.copc.laz"),
        (377, b"cops", "not a COPC file"),
    ]:
        octree.write_bytes(content)
        damaged(octree, where, value)
        with pytest.raises(HprError) as refused:
            visible_from_tiles([octree], VIEWPOINTS, radius=1e5)
        assert refused.value.code == "load" and said in str(refused.value), str(refused.value)
    octree.write_bytes(content[: len(content) // 2])
    with pytest.raises(HprError) as refused:
        visible_from_tiles([octree], VIEWPOINTS, radius=1e5)
    assert refused.value.code == "load"


def run(folder, path=os.defpath, *words):
    cameras = folder / "cameras.csv"
    cameras.write_text("\n".join(",".join(map(str, viewpoint)) for viewpoint in VIEWPOINTS))
    command = [str(folder), "--from", str(cameras), "-o", str(folder / "seen"), "--laz", *words]
    return subprocess.run(
        [sys.executable, "-m", "hidden_point_removal.command", *command],
        capture_output=True,
        text=True,
        env={**os.environ, "PATH": str(path)},
    )


def test_without_pdal_the_copy_is_laz_and_the_command_says_so(octree, tmp_path):
    done = run(tmp_path, tmp_path / "nowhere")
    assert done.returncode == 0, done.stderr
    said = "octree.copc.laz was copied as octree.laz, which is not a COPC file: the program pdal is not installed."
    assert said in done.stderr
    assert sorted(path.name for path in (tmp_path / "seen").glob("*.laz")) == ["octree.laz"]
    copied = laspy.read(tmp_path / "seen" / "octree.laz")
    answers = visible_from_tiles([octree], VIEWPOINTS)
    for number, answer in enumerate(answers):
        assert np.array_equal(np.flatnonzero(np.asarray(copied["visible"]) >> number & 1), answer)


def fake_pdal(folder, script):
    folder.mkdir()
    (folder / "pdal").write_text(f"#!/bin/sh\n{script}\n")
    (folder / "pdal").chmod(0o755)
    return f"{folder}{os.pathsep}{os.defpath}"


@pytest.mark.skipif(os.name == "nt", reason="the stand-in for pdal is a shell script")
def test_with_pdal_the_copy_is_copc(octree, tmp_path):
    path = fake_pdal(tmp_path / "bin", f'echo "$@" > {tmp_path}/words; cp "$2" "$3"')
    done = run(tmp_path, path)
    assert done.returncode == 0 and "pdal" not in done.stderr, done.stderr
    assert sorted(path.name for path in (tmp_path / "seen").glob("*.laz")) == ["octree.copc.laz"]
    words = (tmp_path / "words").read_text().split()
    assert words[0] == "translate" and words[3:] == ["--writer", "writers.copc", "--writers.copc.forward=all"]


@pytest.mark.skipif(os.name == "nt", reason="the stand-in for pdal is a shell script")
def test_a_pdal_that_fails_is_reported_and_the_laz_is_kept(octree, tmp_path):
    done = run(tmp_path, fake_pdal(tmp_path / "bin", "echo no driver >&2; exit 1"))
    assert done.returncode != 0 and "no driver" in done.stderr and "Traceback" not in done.stderr
    assert sorted(path.name for path in (tmp_path / "seen").glob("*.laz")) == ["octree.laz"]


def test_a_copy_never_replaces_the_copy_of_another_tile(octree, tmp_path):
    shutil.copy(FIXTURE, tmp_path / "octree.laz")
    done = run(tmp_path)
    assert done.returncode != 0 and "another tile has this name" in done.stderr
