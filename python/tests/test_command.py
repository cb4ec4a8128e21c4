"""python -m hidden_point_removal."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hidden_point_removal import PointCloud, __version__

POINTS = np.random.default_rng(1).normal(size=(2000, 3))
PLACE = ["--from", "0,0,5"]
TABLE = Path(__file__).parents[2] / "src" / "options.json"


def run(folder, *words):
    return subprocess.run([sys.executable, "-m", "hidden_point_removal", *map(str, words)], cwd=folder, capture_output=True, text=True)


@pytest.mark.parametrize(("words", "options"), [
    ([], {"looks": 3}),
    (["--looks", 0], {}),
    (["--looks", 3, "--thickness", 0.1, "--surface", "clean"], {"looks": 3, "thickness": 0.1, "surface": "clean"}),
    (["--inversion", "power:1.5", "--within", 6], {"inversion": {"power": 1.5}, "within": {"distance": 6}}),
    (["--inversion", "exponential:auto"], {"inversion": {"exponential": "auto"}}),
    (["--inversion", "spherical", "--exponent", ".5", "--within", "-1,-1,-1,1,1,1"], {"exponent": 0.5, "within": {"box": [[-1] * 3, [1] * 3]}}),
    (["--radius", "opposite", "--threads", 2], {"radius": "opposite"}),
])
def test_a_file(tmp_path, words, options):
    np.save(tmp_path / "cloud.npy", POINTS)
    eyes = [[0, 0, 5], [-5, 0.5, 0]]
    done = run(tmp_path, "cloud.npy", "--from", "0,0,5", "--from", "-5,.5,0", *words, "-o", "seen.npy")
    seen = [PointCloud(POINTS).visible_from(eye, **options).indices for eye in eyes]
    said = [f"{eye}: {len(own)} of 2000 points are visible" for eye, own in zip(("0,0,5", "-5,0.5,0"), seen)]
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
    flags = {name: row for name, row in json.loads(TABLE.read_text())["view"]["options"].items() if "flag" in row}
    assert all(f"--{name} {row['flag']} {row.get('help', '')}" in shown for name, row in flags.items()) and "--scores" not in shown
    assert run(tmp_path, "--version").stdout.strip() == __version__
    for words, said in (
        (["a.npy", "--from", "0,0"], "argument --from: X,Y,Z is needed, not 0,0"),
        (["b.npy", *PLACE, "--looks", "4"], "--looks must be from 2 to 3, got 4"),
        (["b.npy", *PLACE, "--inversion", "power"], "--inversion must be "),
        (["b.npy", *PLACE, "--inversion", "power:x"], "--inversion"),
        (["b.npy", *PLACE, "--within", "1,2"], "--within: box must be numbers of the shape (2, 3), got the shape (2, 1) (--help shows how)"),
        (["b.npy", *PLACE, "--within", "x"], "--within: distance must be a number"),
        (["b.npy", *PLACE, "--radius", "9", "--radius=9"], "--radius is given twice"),
        (["b.npy", *PLACE, "-o", "a.txt", "--output", "b.txt"], "--output is given twice"),
        (["b.npy", *PLACE, "--exponent", "1", "--radius", "9"], "exclude each other"),
        (["a.npy", *PLACE, "-o", "a.csv"], "a.csv: the output must be a .npy or .txt file"),
        (["a.npy", *PLACE, "-o", "a.npy"], "a.npy: the output must not be an input"),
        (["a.npy", *PLACE, "--draft", "\x1b1"], "--draft ?1"),
        (["a.npy", *PLACE, "--scores"], "--scores"),
    ):
        done = run(tmp_path, *words)
        assert done.returncode == 2 and said in done.stderr and "\x1b" not in done.stderr, done.stderr
    for file, said in (("b.npy", "b.npy cannot be read"), ("b\x1b.npy", "b?.npy cannot be read"), ("a.xyz", ".npy")):
        done = run(tmp_path, file, *PLACE)
        assert done.returncode == 1 and said in done.stderr and "Traceback" not in done.stderr, done.stderr
