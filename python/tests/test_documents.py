"""The Python examples of the documents run."""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


def examples(document):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / document).read_text(), re.DOTALL | re.MULTILINE)


def test_the_readme_runs():
    pytest.importorskip("scipy")
    code = "\n".join(examples("python/README.md"))
    assert code.count("assert") >= 2
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


def test_the_example_prints_the_lines_in_its_comments():
    example = ROOT / "examples" / "visible.py"
    printed = subprocess.run([sys.executable, example], check=True, capture_output=True, text=True).stdout
    assert printed.splitlines() == re.findall(r"# → (.*)", example.read_text())


@pytest.mark.parametrize("module", ["ray"])
def test_the_examples_of_other_engines_run(module, tmp_path):
    """They are checked as Python where the engine is missing."""
    [code] = [code for code in examples("docs/SCALE.md") if f"import {module}" in code or f"from {module}" in code]
    compile(code, module, "exec")
    if importlib.util.find_spec(module) is not None:
        subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, cwd=tmp_path)
