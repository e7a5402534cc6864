"""What files are doubtful of is told once, at the caller's own line, whoever reads them."""

import inspect
import warnings

import numpy as np
import pyarrow
import pyarrow.parquet as parquet
import pytest
from test_calibration import STUDY
from test_cluster import cluster, scheduler  # noqa: F401
from test_folder import pointings

import trueaxis

ROWS = 400


@pytest.fixture
def scan(tmp_path):
    """Three files, one of them in degrees that nobody says."""
    (tmp_path / "scan").mkdir()
    for at in range(3):
        table = pointings(ROWS, at, off_centre=0.0)
        if at == 1:
            table = {**table, "azimuth": np.rad2deg(table["azimuth"])}
        parquet.write_table(pyarrow.table(dict(table)), tmp_path / "scan" / f"{at}.parquet", row_group_size=100)
    return tmp_path / "scan"


def told(what):
    """What is warned of, and whether each is of the line that asked."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        what()
    own = [warning for warning in caught if issubclass(warning.category, trueaxis.TrueaxisWarning)]
    places = {(warning.filename, warning.lineno) for warning in own}
    assert places <= {(__file__, inspect.getsourcelines(what)[1])}, places
    return [str(warning.message) for warning in own]


def check_of_files(scan, mount, out, **more):
    """Fits, calibrates and corrects a folder."""
    applied = told(lambda: trueaxis.apply(scan, mount, {"collimation": 3.0}, out, **more))
    assert [text.split(" has no unit")[0] for text in applied if text.startswith("collimation")] == ["collimation = 3"], applied
    replaced = "the input's own columns `pointing_x`, `pointing_y`, `pointing_z` were replaced"
    assert [text for text in applied if "replaced" in text] == [replaced], applied
    assert sum("1.parquet" in text and "column `azimuth` reaches" in text for text in applied) == 1 and len(applied) == 3, applied
    fitted = told(lambda: trueaxis.fit("study.toml", scan, text=STUDY, chain=mount, **more))
    assert any("column `azimuth` reaches" in text for text in fitted) and len(set(fitted)) == len(fitted), fitted
    calibrated = told(lambda: trueaxis.calibrate("study.toml", scan, text=STUDY, chain=mount, search_rows=600, **more))
    assert any("column `azimuth` reaches" in text for text in calibrated) and len(set(calibrated)) == len(calibrated), calibrated


def test_of_the_processors_of_this_machine(scan, mount, tmp_path):
    check_of_files(scan, mount, tmp_path / "out")


def test_of_workers(scan, mount, tmp_path, cluster):  # noqa: F811
    address, _ = cluster
    check_of_files(scan, mount, tmp_path / "out", client=address)


def test_very_many_are_told_in_part(mount, tmp_path):
    (tmp_path / "scan").mkdir()
    for at in range(9):
        columns = {"azimuth": np.array([100.0]), "elevation": np.array([0.5])}
        parquet.write_table(pyarrow.table(columns), tmp_path / "scan" / f"{at}.parquet")
    texts = told(lambda: trueaxis.apply(tmp_path / "scan", mount, {}, tmp_path / "out"))
    assert len(texts) == 6 and texts[-1] == "4 more warnings like these, of other rows", texts
    assert [text for at, text in enumerate(texts[:5]) if f"{at}.parquet" not in text] == []
