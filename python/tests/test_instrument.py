"""Instrument files in Python: read, applied, checked by new rows, compared; and what is wrong with them."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import trueaxis

ARCSEC = np.pi / 648_000
MOUNT = """
chain Mount {
    body azimuth_axis on ground {
        motion:       Rz(-azimuth);
        motion_error: Rz(azimuth_index);
    }
    body telescope on azimuth_axis {
        motion:       Rx(elevation);
        motion_error: Rx(elevation_index);
    }
    observe pointing: direction(0, 1, 0) of telescope;
}
"""
STUDY = """
chain = "mount.chain"
data  = "measured.csv"
[observed]
kind = "direction"
[hold_out]
folds = 5
seed  = 1
"""
TRUTH = {"azimuth_index": "20 arcsec", "elevation_index": "-12 arcsec"}
CHAIN = trueaxis.Chain.from_text(MOUNT, "mount.chain")


def measured(seed, poses=120, errors=TRUTH):
    return CHAIN.simulate(errors, poses=poses, noise="2 arcsec", seed=seed, ranges={"elevation": ("15 deg", "80 deg")})


@pytest.fixture(scope="module")
def result():
    return trueaxis.calibrate("study.toml", measured(31), text=STUDY, chain=CHAIN)


@pytest.fixture(scope="module")
def instrument(result, tmp_path_factory):
    folder = tmp_path_factory.mktemp("result") / "out"
    result.write(folder)
    return trueaxis.Instrument.from_file(Path(folder) / "instrument.toml")


def test_a_file_has_what_the_calibration_found(result, instrument):
    assert instrument.values == pytest.approx(result.values)
    assert instrument.chain.errors == result.chain.errors
    assert result.instrument.values == pytest.approx(result.values)
    assert len(instrument.made) == 10 and instrument.valid_until is None
    assert "Mount" in repr(instrument)
    assert pickle.loads(pickle.dumps(instrument)).values == instrument.values


def test_it_stands_where_a_chain_and_its_errors_stand(result, instrument):
    readings = {"azimuth": np.linspace(0, 2, 7), "elevation": np.linspace(0.4, 1.2, 7)}
    right = result.chain.exact(readings, result.values, quantity="value")
    assert np.allclose(instrument.exact(readings), right, rtol=0, atol=1e-12)
    table = instrument.apply(readings)
    assert np.allclose([table[f"pointing_{axis}"] for axis in "xyz"], right, rtol=0, atol=1e-12)


def test_rows_outside_of_what_was_measured_are_warned_of(instrument):
    with pytest.warns(trueaxis.TrueaxisWarning, match="elevation"):
        instrument.apply({"azimuth": np.array([1.0]), "elevation": np.array([0.05])})


def test_new_rows_say_whether_it_is_still_valid(instrument):
    same = instrument.verify(measured(32, poses=20))
    assert same["verdict"] == "still valid", same
    moved = instrument.verify(measured(33, poses=20, errors={**TRUTH, "azimuth_index": "60 arcsec"}), goal="5 arcsec")
    assert moved["verdict"] == "recalibrate", moved
    assert "RECALIBRATE" in str(moved)


def test_two_calibrations_are_compared(instrument):
    again = trueaxis.calibrate("study.toml", measured(34), text=STUDY, chain=CHAIN).instrument
    assert not trueaxis.compare(instrument, again)["changed"]
    other = {**TRUTH, "elevation_index": "40 arcsec"}
    moved = trueaxis.calibrate("study.toml", measured(35, errors=other), text=STUDY, chain=CHAIN).instrument
    answer = trueaxis.compare(instrument, again, moved)
    assert answer["changed"] and "elevation_index" in str(answer)


def test_what_is_no_instrument_is_refused(instrument, tmp_path):
    with pytest.raises(trueaxis.TrueaxisError, match="no instrument file"):
        trueaxis.Instrument.from_text(MOUNT)
    for spoiled in ["", "instrument = 1\n", "instrument = 99\n", instrument._text.replace("Rx", "Qx"), instrument._text[:-40]]:
        with pytest.raises(trueaxis.TrueaxisError):
            trueaxis.Instrument.from_text(spoiled)
    with pytest.raises(trueaxis.TrueaxisError):
        trueaxis.Instrument.from_file(tmp_path / "missing.toml")
    with pytest.raises(TypeError):
        trueaxis.Instrument.from_text(3)
    with pytest.raises(TypeError, match="Instrument.from_file"):
        trueaxis.compare(instrument, "result/instrument.toml")
    with pytest.raises(trueaxis.TrueaxisError, match="two"):
        trueaxis.compare(instrument)


def test_rows_that_lack_a_column_are_refused(instrument):
    rows = dict(measured(36, poses=12))
    del rows["pointing_z"]
    with pytest.raises(trueaxis.TrueaxisError, match="pointing_z"):
        instrument.verify(rows)
    with pytest.raises(trueaxis.TrueaxisError):
        instrument.verify({name: column[:0] for name, column in measured(36, poses=12).items()})
    with pytest.raises(trueaxis.TrueaxisError, match="goal|arcsec|unit"):
        instrument.verify(measured(36, poses=12), goal="5 apples")
    with pytest.raises(trueaxis.TrueaxisError, match="0.05"):
        instrument.verify(measured(36, poses=12), false_alarm=2)
