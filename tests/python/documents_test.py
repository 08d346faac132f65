"""What documents show runs as it stands."""

import re
import subprocess
import sys

import pytest

from conftest import ROOT


def blocks():
    """The Python of the documents, with the file's name."""
    for name in ("README.md", "docs/python.md", "docs/analysis.md"):
        for block in re.findall(r"^```python\n(.*?)^```$", (ROOT / name).read_text(), re.MULTILINE | re.DOTALL):
            yield pytest.param(block, id=name)


@pytest.mark.parametrize("block", list(blocks()))
def test_examples_of_the_documents_run(block, tmp_path):
    (tmp_path / "scenes").symlink_to(ROOT / "scenes")
    program = [sys.executable, "-c", block]
    printed = subprocess.run(program, check=True, cwd=tmp_path, stdout=subprocess.PIPE, text=True).stdout
    shown = re.findall(r"^# (.*)$", block, re.MULTILINE)
    assert not shown or printed.splitlines() == shown


def test_the_example_prints_partitions():
    program = [sys.executable, ROOT / "examples/partitions.py", ROOT / "scenes/operators.json", "0", "-9000", "0"]
    text = subprocess.run([*program, "0", "1", "0"], check=True, capture_output=True, text=True).stdout
    assert re.search(r"^/operators/union +4330.000 ", text, re.MULTILINE)
