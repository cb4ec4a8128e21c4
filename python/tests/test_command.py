"""python -m hidden_point_removal."""

import subprocess
import sys

import numpy as np
import pytest

from hidden_point_removal import PointCloud, __version__

POINTS = np.random.default_rng(1).normal(size=(2000, 3))


def run(folder, *words):
    return subprocess.run([sys.executable, "-m", "hidden_point_removal", *map(str, words)], cwd=folder, capture_output=True, text=True)


@pytest.mark.parametrize(("words", "options"), [
    ([], {}),
    (["--looks", 3, "--thickness", 0.1, "--surface", "clean"], {"looks": 3, "thickness": 0.1, "surface": "clean"}),
    (["--inversion", '{"power": 1.5}', "--within", '{"distance": 6}'], {"inversion": {"power": 1.5}, "within": {"distance": 6}}),
    (["--radius", "opposite", "--threads", 2], {"radius": "opposite"}),
])
def test_a_file(tmp_path, words, options):
    np.save(tmp_path / "cloud.npy", POINTS)
    eyes = [[0, 0, 5], [-5, 0.5, 0]]
    done = run(tmp_path, "cloud.npy", "--from", "0,0,5", "--from=-5,.5,0", *words, "-o", "seen.npy")
    seen = [PointCloud(POINTS).visible_from(eye, **options).indices for eye in eyes]
    said = [f"{eye}: {len(own)} of 2000 points are visible" for eye, own in zip(("0.0,0.0,5.0", "-5.0,0.5,0.0"), seen)]
    assert (done.returncode, done.stdout.splitlines()) == (0, said), done.stderr
    assert np.array_equal(np.load(tmp_path / "seen.npy"), np.unique(np.concatenate(seen)))


def test_several_files(tmp_path):
    for name, part in zip("ab", np.split(POINTS, 2)):
        np.save(tmp_path / f"{name}.npy", part)
    done = run(tmp_path, "a.npy", "b.npy", "--from", "0,0,5", "--radius", 90, "-o", "seen.txt")
    expected = PointCloud(POINTS).visible_from([0, 0, 5], radius=90).indices
    assert np.array_equal(np.loadtxt(tmp_path / "seen.txt", int), expected) and f"{len(expected)} of 2000" in done.stdout


def test_help_and_what_is_refused(tmp_path):
    np.save(tmp_path / "a.npy", POINTS)
    shown = " ".join(run(tmp_path, "--help").stdout.split())
    assert "--looks" in shown and "each decides only the points that it is sure of" in shown and run(tmp_path, "--version").stdout.strip() == __version__
    for words, said in (
        (["a.npy", "--from", "0,0"], "argument --from"),
        (["a.npy", "--from", "0,0,5", "--looks", "4"], "looks"),
        (["b.npy", "--from", "0,0,5"], "b.npy cannot be read"),
        (["b\x1b.npy", "--from", "0,0,5"], "b?.npy cannot be read"),
        (["a.xyz", "--from", "0,0,5"], ".npy"),
        (["a.npy", "--from", "0,0,5", "-o", "a.npy"], "another .npy"),
        (["a.npy", "--from", "0,0,5", "--draft", "1"], "--draft"),
    ):
        done = run(tmp_path, *words)
        assert done.returncode not in (0, -2) and said in done.stderr and "Traceback" not in done.stderr, done.stderr
