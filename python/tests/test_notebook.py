"""The notebook runs: its cells assert what they say."""

from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parent.parent / "examples" / "colors.ipynb"


def test_the_notebook_runs():
    nbformat = pytest.importorskip("nbformat", reason="Jupyter is not installed")
    nbclient = pytest.importorskip("nbclient", reason="Jupyter is not installed")
    pytest.importorskip("ipykernel", reason="Jupyter is not installed")
    notebook = nbformat.read(EXAMPLE, as_version=4)
    done = nbclient.NotebookClient(notebook, timeout=120).execute()
    assert "of the points are visible" in done.cells[3].outputs[0]["data"]["text/plain"]
    assert all(not cell.get("outputs") for cell in nbformat.read(EXAMPLE, as_version=4).cells)
