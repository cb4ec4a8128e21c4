"""The Python examples of the documents run."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def examples(document):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / document).read_text(), re.DOTALL | re.MULTILINE)


def test_the_readme_runs(tmp_path):
    code = "\n".join(examples("python/README.md"))
    assert code.count("assert") >= 2
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, cwd=tmp_path)


def test_the_example_prints_the_lines_in_its_comments():
    example = ROOT / "examples" / "visible.py"
    printed = subprocess.run([sys.executable, example], check=True, capture_output=True, text=True).stdout
    assert printed.splitlines() == re.findall(r"# → (.*)", example.read_text())
