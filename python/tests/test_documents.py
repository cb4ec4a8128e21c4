"""The Python examples of the documents run."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]


def examples(document):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / document).read_text(), re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("document", ["python/README.md", "docs/PYTHON.md"])
def test_the_examples_run(document, tmp_path):
    code = "\n".join(examples(document))
    assert code.count("assert") >= 2
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, cwd=tmp_path)


def test_the_example_prints_the_lines_in_its_comments():
    example = ROOT / "examples" / "visible.py"
    printed = subprocess.run([sys.executable, example], check=True, capture_output=True, text=True).stdout
    assert printed.splitlines() == re.findall(r"# → (.*)", example.read_text())


def test_the_types_of_the_examples_and_of_the_package_are_right(tmp_path):
    pytest.importorskip("mypy", reason="mypy is not installed")
    for document in ("python/README.md", "docs/PYTHON.md", "docs/SCALE.md"):
        (tmp_path / f"{Path(document).stem.lower()}.py").write_text("\n".join(examples(document)))
    words = ["mypy", "--strict", "--ignore-missing-imports", str(ROOT / "python" / "hidden_point_removal"), *map(str, tmp_path.glob("*.py"))]
    done = subprocess.run([sys.executable, "-m", *words], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout


def test_the_recipes_run(tmp_path):
    pytest.importorskip("PIL", reason="Pillow is not installed")
    from PIL import Image

    np.save(tmp_path / "cloud.npy", np.random.default_rng(0).normal(size=(3000, 3)))
    (tmp_path / "cameras.txt").write_text("1 PINHOLE 64 48 50 50 32 24\n")
    (tmp_path / "images.txt").write_text("1 1 0 0 0 0 0 9 1 a.png\n\n2 0 1 0 0 0 0 9 1 b.png\n\n")
    for name in "ab":
        Image.new("RGB", (64, 48), (200, 100, 0)).save(tmp_path / f"{name}.png")
    for recipe, *words in (("partial_views", "cloud.npy", "views.npz"), ("colmap_colors", "cloud.npy", ".", ".", "colored.txt")):
        example = ROOT / "python" / "examples" / f"{recipe}.py"
        subprocess.run([sys.executable, example, *words], check=True, capture_output=True, cwd=tmp_path)
    views, colored = np.load(tmp_path / "views.npz"), np.loadtxt(tmp_path / "colored.txt")
    assert len(views) == 16 and all(0 < len(views[name]) < 3000 for name in views)
    assert 0 < len(colored) < 3000 and (colored[:, 3:] == [200, 100, 0]).all()


def test_the_notebook_runs():
    """Its cells assert what they say."""
    nbformat = pytest.importorskip("nbformat", reason="Jupyter is not installed")
    nbclient = pytest.importorskip("nbclient", reason="Jupyter is not installed")
    pytest.importorskip("ipykernel", reason="Jupyter is not installed")
    notebook = nbformat.read(ROOT / "python" / "examples" / "colors.ipynb", as_version=4)
    assert all(not cell.get("outputs") for cell in notebook.cells)
    if not importlib.util.find_spec("matplotlib"):
        notebook.cells.pop(4)
    done = nbclient.NotebookClient(notebook, timeout=120).execute()
    assert "of 50,000 points are visible" in done.cells[3].outputs[0]["data"]["text/html"]
    if importlib.util.find_spec("matplotlib"):
        assert done.cells[4].outputs[0]["data"]["image/png"]
