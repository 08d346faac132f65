"""docs/csgrt.ipynb runs, and its numbers are right. By label: it needs nbclient, ipykernel and matplotlib."""

import ast
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")
pytest.importorskip("matplotlib")

DOCS = Path(__file__).parents[2] / "docs"


def test_the_notebook_runs():
    notebook = nbformat.read(DOCS / "csgrt.ipynb", 4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "outputs are not kept in the tree"
    nbclient.NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(DOCS)}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 5
    volumes = ast.literal_eval(outputs[-1]["data"]["text/plain"])
    cube = 60 * 50 * 50
    assert volumes["/overlap/left.r"] == pytest.approx(cube, rel=5e-3)
    assert volumes["/overlap/right.r"] == pytest.approx(cube - 50 * 15 * 40, rel=5e-3)
