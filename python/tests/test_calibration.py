"""Calibrations: of the example's study, and of tables in memory."""

import json
import pickle

import numpy as np
import pandas
import polars
import pytest

import trueaxis

ARCSEC = np.pi / 180 / 3600
STUDY = """
chain = "mount.chain"
data = "table"
[observed]
kind = "direction"
x = "pointing_x"
y = "pointing_y"
z = "pointing_z"
[noise]
sigma = "2 arcsec"
[search]
effects = []
[hold_out]
folds = 3
seed = 1
"""
TRUE = {"collimation": 30 * ARCSEC, "tilt_x": 20 * ARCSEC, "tilt_y": -15 * ARCSEC, "elevation_index": 40 * ARCSEC}


@pytest.fixture(scope="module")
def example(tmp_path_factory):
    from conftest import EXAMPLES

    stages = []
    calibration = trueaxis.calibrate(EXAMPLES / "mobile-lidar" / "study.toml", progress=stages.append)
    assert stages
    return calibration


def test_the_main_job(example):
    assert example.verdict in ("explained", "confounded")
    assert example.effects.rows >= 1 and "beta" in example.effects["driver"]
    # The declared errors, and the coefficients of what was found.
    assert set(example.errors["name"]) == set(example.chain.errors) and len(example.chain.errors) > 30
    assert example.errors["value"].dtype == np.float64 and example.errors.to_pandas().shape[1] == 6
    # One of the causes that fit would bring another value of one declared error.
    by_cause = dict(zip(example.errors["name"], example.errors["moves_by_cause"]))
    down, up = by_cause.pop("dtheta_z2")
    assert down < -2e-5 and abs(up) < 1e-15 and set(by_cause.values()) == {None}
    assert example.report["schema"] == 4
    assert set(example.values) >= set(example.chain.errors)
    assert example.residuals.rows == example.report["observations"]["rows"]
    assert "Calibration" not in example.text() and example.text() == repr(example) and "\x1b" not in example.text()
    assert len(example.text(verbose=True)) > len(example.text())


def test_a_notebook_shows_the_first_screen_and_the_pictures(example):
    shown = example._repr_html_()
    assert shown.startswith("<iframe") and "http-equiv" not in shown
    page = example.html(whole=False)
    assert page.count("<svg") >= 3 and 'id="answer"' in page and 'id="values"' not in page
    assert 'id="values"' in example.html()


def test_the_files_are_those_of_the_command(example, tmp_path):
    example.write(tmp_path / "result")
    names = {path.name for path in (tmp_path / "result").iterdir()}
    assert names == {"report.html", "report.json", "instrument.toml", "amended.chain", "errors.toml", "residuals.csv"}
    report = json.loads((tmp_path / "result" / "report.json").read_text())
    assert report == example.report
    assert (tmp_path / "result" / "amended.chain").read_text() == example.amended
    again = trueaxis.Chain.from_file(tmp_path / "result" / "amended.chain")
    readings = {name: 0.3 for name in again.joints}
    np.testing.assert_allclose(
        again.exact(readings, tmp_path / "result" / "errors.toml", "pointing"),
        example.chain.exact(readings, example.values, "pointing"),
        atol=1e-9,
    )


@pytest.fixture
def table(mount):
    return mount.simulate(TRUE, poses=300, noise="2 arcsec", seed=4, ranges={"elevation": ("10 deg", "80 deg")})


@pytest.mark.parametrize("kind", ["pandas", "polars", "arrow", "dictionary"])
def test_tables_of_every_library(mount, table, kind):
    data = {"pandas": table.to_pandas, "polars": table.to_polars, "arrow": table.to_arrow, "dictionary": lambda: dict(table)}[kind]()
    calibration = trueaxis.calibrate("study.toml", data, text=STUDY, chain=mount)
    rows = dict(zip(calibration.errors["name"], zip(calibration.errors["value"], calibration.errors["standard_uncertainty"])))
    for name, value in TRUE.items():
        found, uncertainty = rows[name]
        assert abs(found - value) < 5 * uncertainty and uncertainty < 3 * ARCSEC
    with pytest.warns(trueaxis.TrueaxisWarning, match="own columns `pointing_x`, `pointing_y`, `pointing_z` were replaced"):
        corrected = calibration.apply(data)
    assert isinstance(corrected, trueaxis.Table if kind == "dictionary" else type(data))


def test_tables_by_name_and_files_beside(mount, table, tmp_path):
    (tmp_path / "mount.chain").write_text(mount.text)
    (tmp_path / "study.toml").write_text(STUDY.replace('"table"', '["a.csv", "b.csv"]'))
    frame = table.to_pandas()
    frame[150:].to_csv(tmp_path / "b.csv", index=False)
    calibration = trueaxis.calibrate(tmp_path / "study.toml", {"a.csv": frame[:150]})
    whole = trueaxis.calibrate("study.toml", frame, text=STUDY, chain=mount)
    np.testing.assert_allclose(calibration.errors["value"], whole.errors["value"], rtol=1e-9)
    for data, words in [(frame, "give a dictionary from each name"), ({"c.csv": frame}, "names no table `c.csv`")]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            trueaxis.calibrate(tmp_path / "study.toml", data)
    with pytest.raises(trueaxis.TrueaxisError, match="a.csv.*no such file"):
        trueaxis.calibrate(tmp_path / "study.toml")


def test_what_is_wrong_is_named_with_its_place(mount, table):
    calibrate = lambda data, text=STUDY: trueaxis.calibrate("study.toml", data, text=text, chain=mount)
    frame = table.to_pandas()
    frame.loc[7, "pointing_x"] = np.nan
    with pytest.raises(trueaxis.TrueaxisError, match="table: row 8, column `pointing_x`: `NaN` is not finite"):
        calibrate(frame)
    with pytest.raises(trueaxis.TrueaxisError, match="no column `pointing_y`"):
        calibrate(polars.DataFrame({name: table[name] for name in table if name != "pointing_y"}))
    with pytest.raises(trueaxis.TrueaxisError, match="no unit vector"):
        calibrate({**table, "pointing_x": table["pointing_x"] + 1})
    with pytest.raises(trueaxis.TrueaxisError, match="no rows"):
        calibrate({name: [] for name in table})
    with pytest.raises(trueaxis.MistakeError, match="study.toml:2") as raised:
        calibrate(table, STUDY.replace("chain =", "chian ="))
    assert raised.value.mistakes
    with pytest.raises(TypeError, match="a table is needed"):
        calibrate(3)
    for several in [[frame, frame], (frame for _ in range(2)), iter([])]:
        with pytest.raises(TypeError, match="several tables are no data of a study: .*pandas.concat.*paths of Parquet files"):
            calibrate(several)


def test_too_few_observations_are_an_outcome(mount, table):
    few = {name: column[:2] for name, column in table.items()}
    calibration = trueaxis.calibrate("study.toml", few, text=STUDY, chain=mount)
    assert calibration.verdict == "too few observations" and calibration.amended is None
    assert calibration.chain is None and calibration.values is None and "<iframe" in calibration._repr_html_()
    with pytest.raises(trueaxis.TrueaxisError, match="no usable model"):
        calibration.apply(few)


def test_groups_are_texts(mount, table):
    days = [f"day {row // 30}" for row in range(300)]
    text = STUDY.replace('[noise]', '[noise]\ngroup = "day"')
    calibration = trueaxis.calibrate("study.toml", pandas.DataFrame({**table, "day": days}), text=text, chain=mount)
    assert calibration.verdict


def test_what_the_study_reads_is_not_written_over(mount, table, tmp_path):
    (tmp_path / "amended.chain").write_text(mount.text)
    table.to_pandas().to_csv(tmp_path / "residuals.csv", index=False)
    text = STUDY.replace("mount.chain", "amended.chain").replace('"table"', '"residuals.csv"')
    (tmp_path / "study.toml").write_text(text)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    calibration = trueaxis.calibrate(tmp_path / "study.toml")
    with pytest.raises(trueaxis.TrueaxisError, match="amended.chain` would be written over `.*amended.chain`, which this command reads"):
        calibration.write(tmp_path)
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before
    calibration.write(tmp_path / "result")
    assert (tmp_path / "result" / "amended.chain").exists()


def test_a_calibration_knows_what_it_was_found_over(mount, table, tmp_path):
    calibration = trueaxis.calibrate("study.toml", table, text=STUDY, chain=mount)
    # The table has elevations from 10° to 80°.
    outside = {"azimuth": [0.1, 0.2], "elevation": [0.5, 1.5]}
    words = "1 of 2 rows is outside what the model was found over.*elevation by up to"
    values = pickle.loads(pickle.dumps(calibration.values))
    assert values == calibration.values == dict(values)
    for apply in [calibration.apply, lambda rows: calibration.chain.apply(rows, values)]:
        with pytest.warns(trueaxis.TrueaxisWarning, match=words) as told:
            apply(outside)
        assert len(told) == 1 and told[0].filename == __file__
    calibration.apply({"azimuth": [0.1], "elevation": [0.5]})
    calibration.write(tmp_path / "result")
    with pytest.warns(trueaxis.TrueaxisWarning, match=words) as by_file:
        calibration.chain.apply(outside, tmp_path / "result" / "errors.toml")
    assert str(by_file[0].message) == str(told[0].message)


def test_what_progress_raises_comes_out():
    from conftest import EXAMPLES

    def interrupted(stage):
        raise KeyboardInterrupt(stage)

    with pytest.raises(KeyboardInterrupt):
        trueaxis.calibrate(EXAMPLES / "mobile-lidar" / "study.toml", progress=interrupted)
