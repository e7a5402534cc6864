"""The notebooks run from top to bottom: the example, which shows what it is meant to show, and one a lesson of the course."""

from pathlib import Path

import nbclient
import nbformat
import pytest

ROOT = Path(__file__).resolve().parents[2]
LESSONS = sorted((ROOT / "docs/src/course/notebooks").glob("*.ipynb"))


def run(path, folder):
    """The cells after they ran, in an empty folder: a notebook brings what it needs."""
    notebook = nbformat.read(path, as_version=4)
    resources = {"metadata": {"path": str(folder)}}
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources=resources).execute()
    return notebook.cells


def test_the_notebook_runs(tmp_path):
    cells = run(ROOT / "python/examples/mount.ipynb", tmp_path)
    shown = [output.get("data", {}) for cell in cells for output in cell.get("outputs", [])]
    assert any("<iframe" in data.get("text/html", "") for data in shown)
    assert any("text/latex" in data for data in shown)


def test_each_lesson_has_a_notebook():
    assert [path.stem for path in LESSONS] == sorted(path.stem for path in (ROOT / "docs/src/course").glob("[0-9]*.md"))


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_the_notebook_of_a_lesson_runs(path, tmp_path, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    run(path, tmp_path)
