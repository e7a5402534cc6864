"""Calibrations of folders of files: in one process, and on a scheduler with two workers as processes of their own."""

import numpy as np
import pyarrow
import pyarrow.parquet as parquet
import pytest
from conftest import MOUNT
from test_calibration import STUDY, TRUE
from test_cluster import cluster, scheduler  # noqa: F401

import trueaxis
from trueaxis import _files, _native

FILES = 64
ROWS = 2000
SEARCHED = 20_000
SEARCHING = STUDY.replace("effects = []\n", "")
# Twice what the study states.
NOISE = 2e-5
# The elevation circle sits off its axis: 60 µrad, which the declaration lacks.
ECCENTRIC = 60e-6


@pytest.fixture(scope="module")
def mount():
    return trueaxis.Chain.from_text(MOUNT, "mount.chain")


def pointings(rows, seed, off_centre=ECCENTRIC, noise=NOISE):
    """Where a mount with these errors points, by rotations written down here."""
    random = np.random.default_rng(seed)
    azimuth, elevation = random.uniform(-3, 3, rows), random.uniform(0.1, 1.4, rows)
    e = {name: TRUE.get(name, 0.0) for name in ["tilt_x", "tilt_y", "nonperpendicularity", "elevation_index", "collimation"]}

    def turned(point, axis, angle):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        out = point.copy()
        out[i] = np.cos(angle) * point[i] - np.sin(angle) * point[j]
        out[j] = np.sin(angle) * point[i] + np.cos(angle) * point[j]
        return out

    point = np.zeros((3, rows))
    point[1] = 1.0
    path = [(2, e["collimation"]), (0, e["elevation_index"] + off_centre * np.cos(elevation)), (0, elevation)]
    path += [(1, e["nonperpendicularity"]), (2, -azimuth), (1, e["tilt_y"]), (0, e["tilt_x"])]
    for axis, angle in path:
        point = turned(point, axis, angle)
    point += random.normal(0, noise, (3, rows))
    x, y, z = point / np.linalg.norm(point, axis=0)
    return {"azimuth": azimuth, "elevation": elevation, "pointing_x": x, "pointing_y": y, "pointing_z": z}


def written(folder, tables):
    folder.mkdir(exist_ok=True)
    for at, columns in enumerate(tables):
        parquet.write_table(pyarrow.table(columns), folder / f"part-{at:02}.parquet")
    return folder


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return written(tmp_path_factory.mktemp("scan"), [pointings(ROWS, at) for at in range(FILES)])


def calibrate(mount, data, **more):
    more = {"search_rows": SEARCHED, "text": SEARCHING, "chain": mount, **more}
    return trueaxis.calibrate("study.toml", data, **more)


@pytest.fixture(scope="module")
def alone(mount, folder):
    return calibrate(mount, folder)


def test_the_effect_is_found_and_every_row_is_fitted(mount, folder, alone, tmp_path):
    assert alone.verdict in ("explained", "confounded", "form not determined")
    assert alone.effects["body"][0] == "elevation_axis" and alone.effects["dof"][0] == "Rx"
    every = alone.report["every_row"]
    assert (every["rows"], alone.report["observations"]["rows"]) == (FILES * ROWS, SEARCHED)
    assert every["converged"] and every["files"] == FILES and every["shared_by_files"] is None
    # What the declaration foretells of rows that nobody fitted is off by the effect, what the amended one foretells is noise.
    left = every["validation"]
    assert left["rows"] == FILES * ROWS - SEARCHED and 0.99 * left["rows"] < left["rows_kept"] <= left["rows"]
    assert left["before"] > 1.1 * left["after"] and abs(left["after"] / (NOISE * np.sqrt(2)) - 1) < 0.02
    # A file with as many rows as were searched.
    searched = calibrate(mount, written(tmp_path / "few", [pointings(SEARCHED, 99)]))
    assert "every_row" not in searched.report
    for name, value, uncertainty in zip(*(alone.errors[key] for key in ["name", "value", "standard_uncertainty"])):
        if name in TRUE and name != "elevation_index":
            assert abs(value - TRUE[name]) < 4.5 * uncertainty, name
            # Of 6.4 times as many rows the estimates are that much better.
            of_drawn = dict(zip(searched.errors["name"], searched.errors["standard_uncertainty"]))[name]
            assert 0.35 < uncertainty / of_drawn < 0.45, name
    text = " ".join(repr(alone).split())
    assert "The search used 20000 of 128000 rows from 64 files. The errors are estimated from every row." in text
    assert "On the 108000 rows that the search did not use, the error goes from 6.6″ to 5.8″ RMS." in text
    assert "The search used 20000 of 128000 rows" in alone.html(whole=False)


def test_a_worker_that_dies_changes_nothing(mount, folder, alone, cluster):  # noqa: F811
    address, workers = cluster
    killed = []

    def kill_one(told):
        if told.startswith("fitting every row, pass 2: 5 of") and not killed:
            workers[0].kill()
            killed.append(told)

    there = calibrate(mount, folder, client=address, progress=kill_one)
    assert killed and workers[0].wait() != 0 and workers[1].poll() is None
    assert there.amended == alone.amended and there.errors_toml == alone.errors_toml
    assert {**there.report, "provenance": None} == {**alone.report, "provenance": None}
    for key in ["name", "value", "standard_uncertainty"]:
        assert list(there.errors[key]) == list(alone.errors[key])


def test_all_rows_in_memory_say_the_same_where_all_are_searched(mount, folder):
    files = sorted(folder.iterdir())[:4]
    here = calibrate(mount, files, search_rows=4 * ROWS)
    table = pyarrow.concat_tables([parquet.read_table(file) for file in files])
    whole = trueaxis.calibrate("study.toml", table, text=SEARCHING, chain=mount)
    assert here.amended == whole.amended
    assert {**here.report, "noise": None, "provenance": None} == {**whole.report, "noise": None, "provenance": None}
    assert list(here.errors["value"]) == list(whole.errors["value"]) and here.text() == whole.text()


def test_the_amended_chain_lacks_nothing(mount, folder, alone):
    again = calibrate(alone.chain, folder)
    left = again.report["every_row"]["validation"]
    assert again.effects.rows == 0 and left["before"] == pytest.approx(left["after"], rel=1e-3)


def nights():
    """Rows of a night share an error as large as their own: no number of rows makes up for few nights."""
    for at in range(20):
        night = pointings(ROWS, at, off_centre=0.0)
        shift = np.random.default_rng([7, at]).normal(0, NOISE, 3)
        point = np.array([night[f"pointing_{c}"] for c in "xyz"]) + shift[:, None]
        night.update(zip(["pointing_x", "pointing_y", "pointing_z"], point / np.linalg.norm(point, axis=0)))
        yield {**night, "night": np.array([f"n{at}"] * ROWS)}


def is_wide(told, holds=True):
    """Whether the ± are those of twenty nights: their mean has a twentieth of their variance. They hold the truth."""
    for name, value, uncertainty in zip(*(told.errors[key] for key in ["name", "value", "standard_uncertainty"])):
        assert not holds or abs(value - TRUE.get(name, 0.0)) < 4.5 * uncertainty, name
    return dict(zip(told.errors["name"], told.errors["standard_uncertainty"]))["tilt_x"] > 0.5 * NOISE / np.sqrt(20)


def test_errors_that_rows_of_a_file_share_widen_the_estimates(mount, tmp_path):
    told = calibrate(mount, written(tmp_path / "nights", nights()), search_rows=10_000)
    assert told.report["every_row"]["files"] == 20 and told.report["every_row"]["shared_by_files"]["ratio"] > 50
    assert "Rows of one file share an error" in repr(told) and is_wide(told)
    fitted = trueaxis.fit("study.toml", tmp_path / "nights", text=SEARCHING, chain=mount)
    assert "rows of a file share errors" in repr(fitted) and is_wide(fitted)


def test_errors_that_declared_groups_share_widen_the_estimates(mount, tmp_path):
    """Every file has rows of every night, so that files share nothing of their own."""
    all_rows = {name: np.concatenate([night[name] for night in parts]) for parts in [list(nights())] for name in parts[0]}
    dealt = [{name: cells[at::10] for name, cells in all_rows.items()} for at in range(10)]
    grouped = SEARCHING.replace("[noise]\n", '[noise]\ngroup = "night"\n')
    told = calibrate(mount, written(tmp_path / "dealt", dealt), text=grouped, search_rows=10_000)
    assert told.report["every_row"]["shared_by_files"] is None and is_wide(told)
    # Nothing tells the fit alone of nights.
    assert not is_wide(trueaxis.fit("study.toml", tmp_path / "dealt", text=SEARCHING, chain=mount), holds=False)


def test_what_is_written_is_read_again(alone, tmp_path):
    alone.write(tmp_path / "out")
    chain = trueaxis.Chain.from_file(tmp_path / "out" / "amended.chain")
    readings = {"azimuth": np.array([0.3]), "elevation": np.array([0.7])}
    of_file = chain.exact(readings, str(tmp_path / "out" / "errors.toml"))
    np.testing.assert_array_equal(of_file, chain.exact(readings, alone.values))
    assert alone.values["collimation"] == dict(zip(alone.errors["name"], alone.errors["value"]))["collimation"]


def test_what_is_wrong_is_named(mount, folder, tmp_path):
    good = [pointings(50, at) for at in range(3)]

    def refused(words, data, **more):
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            calibrate(mount, data, **more)

    def spoiled(name, **columns):
        parts = [dict(part) for part in good]
        for column, cells in columns.items():
            parts[1].pop(column)
            if cells is not None:
                parts[1][column] = cells
        return written(tmp_path / name, parts)

    cut = spoiled("cut")
    (cut / "part-01.parquet").write_bytes((cut / "part-01.parquet").read_bytes()[:-100])
    refused("part-01.parquet", cut)
    refused("part-01.parquet: column `elevation` is not there", spoiled("lacking", elevation=None))
    refused("part-01.parquet: column `elevation` holds texts", spoiled("texts", elevation=["x"] * 50))
    refused("no .parquet file", tmp_path)
    refused("no such file", tmp_path / "nowhere")
    two = SEARCHING.replace('data = "table"', 'data = ["one", "two"]')
    refused("this one names `one`, `two`", folder, text=two)
    refused("no scheduler answers at `nonsense`", folder, client="nonsense")
    with pytest.raises(trueaxis.TrueaxisError, match="give a folder of Parquet files"):
        calibrate(mount, good[0], client="tcp://127.0.0.1:9")
    with pytest.raises(trueaxis.TrueaxisError, match="search_rows"):
        calibrate(mount, folder, search_rows=0)


@pytest.mark.parametrize("search_rows", [500, 2900, 3000])
def test_a_bad_row_is_told_by_its_file(mount, tmp_path, search_rows, monkeypatch):
    """Whether it is drawn, not drawn, or in a later chunk of its file."""
    monkeypatch.setattr(_files, "ROWS", 400)
    parts = [pointings(1000, at) for at in range(3)]
    parts[1]["azimuth"][740] = np.nan
    folder = written(tmp_path / "spoiled", parts)
    words = f"^{folder / 'part-01.parquet'}: row 741, column `azimuth`: `NaN` is not finite"
    with pytest.raises(trueaxis.TrueaxisError, match=words):
        calibrate(mount, folder, search_rows=search_rows)
    with pytest.raises(trueaxis.TrueaxisError, match=words):
        trueaxis.fit("study.toml", folder, text=SEARCHING, chain=mount)
    with pytest.raises(trueaxis.TrueaxisError, match=words):
        trueaxis.apply(folder, mount, {}, tmp_path / "out")


def test_a_worker_of_another_version_is_named(mount, folder, cluster, monkeypatch):  # noqa: F811
    address, _ = cluster
    monkeypatch.setattr(_native, "__version__", "0.0.9")
    with pytest.raises(trueaxis.TrueaxisError, match=r"worker tcp://127\.0\.0\.1:\d+ runs trueaxis .* that asks 0\.0\.9"):
        calibrate(mount, folder, client=address)
