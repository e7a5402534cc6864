"""Tables of every library: simulated, evaluated, corrected."""

import datetime

import numpy as np
import pandas
import polars
import pyarrow
import pytest

import trueaxis
from trueaxis._tables import columns_of

ERRORS = {"collimation": "30 arcsec", "tilt_x": "20 arcsec"}


@pytest.fixture
def simulated(mount):
    return mount.simulate(ERRORS, poses=50, noise="2 arcsec", seed=1, ranges={"elevation": ("10 deg", "80 deg")})


def test_simulated_data_are_tables(mount, simulated):
    assert list(simulated) == ["azimuth", "elevation", "pointing_x", "pointing_y", "pointing_z"]
    assert simulated.rows == 50 and "pointing_x" in repr(simulated) and "<table>" in simulated._repr_html_()
    assert simulated.to_pandas().shape == simulated.to_polars().shape == (50, 5)
    assert simulated.to_arrow().num_rows == 50
    again = mount.simulate(ERRORS, poses=50, noise="2 arcsec", seed=1, ranges={"elevation": "10 deg..80 deg"})
    np.testing.assert_array_equal(again["pointing_x"], simulated["pointing_x"])
    readings = {name: simulated[name] for name in mount.joints}
    noise = np.array([simulated[f"pointing_{c}"] for c in "xyz"]) - mount.exact(readings, ERRORS, quantity="value")
    # Two of three components are noise of 2 arcsec, the one along the direction none.
    assert np.sqrt((noise**2).sum(axis=0).mean()) == pytest.approx(np.sqrt(2) * 2 * np.pi / 180 / 3600, rel=0.3)
    with pytest.raises(trueaxis.TrueaxisError, match="--noise"):
        mount.simulate(ERRORS, poses=5, noise="2 bananas", seed=1)


def test_every_library_gets_its_own_kind_back(mount, simulated):
    expected = mount.exact({name: simulated[name] for name in mount.joints}, ERRORS, quantity="value")
    for table in [simulated.to_pandas(), simulated.to_polars(), simulated.to_arrow(), simulated, dict(simulated)]:
        corrected = mount.apply(table, ERRORS)
        assert isinstance(corrected, trueaxis.Table if isinstance(table, dict) else type(table))
        columns = dict(columns_of(corrected))
        assert list(columns) == list(simulated)
        np.testing.assert_array_equal(columns["pointing_x"], expected[0])
    error = mount.eval(simulated.to_polars().drop("pointing_x", "pointing_y", "pointing_z"), ERRORS)
    assert error.columns[2:] == ["pointing_x", "pointing_y", "pointing_z"]
    first = mount.eval(simulated, ERRORS, form="first-order")
    np.testing.assert_allclose(first["pointing_y"], error["pointing_y"].to_numpy(), atol=1e-7)


def test_units_in_the_names_of_columns(mount):
    degrees = {"azimuth [deg]": np.array([10.0]), "elevation_deg": [20]}
    radians = {"azimuth": np.deg2rad([10.0]), "elevation": np.deg2rad([20.0])}
    np.testing.assert_allclose(mount.eval(degrees, ERRORS)["pointing_x"], mount.eval(radians, ERRORS)["pointing_x"], rtol=1e-14)


def test_what_is_wrong_with_a_table_is_named_with_its_place(mount):
    good = [0.1, 0.2]
    for table, words in [
        ({"azimuth": [0.1, np.nan], "elevation": good}, "row 2, column `azimuth`: `NaN` is not finite"),
        ({"azimuth": ["0.1", "x"], "elevation": good}, "row 2, column `azimuth`: `x` is no number"),
        ({"azimuth": [0.1, None], "elevation": good}, "row 2, column `azimuth`"),
        ({"azimuth": [0.1], "elevation": good}, "column `elevation` has 2 rows, column `azimuth` has 1"),
        ({"azimut": good, "elevation": good}, "no column `azimuth`"),
        ({"azimuth": [], "elevation": []}, "no rows"),
        ({}, "no columns"),
        (pandas.DataFrame([[0.1, 0.1]], columns=["azimuth", "azimuth"]), "column `azimuth` is there twice"),
    ]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            mount.eval(table, ERRORS)
    for table, words in [
        (3, "a table is needed, this is a int"),
        ([1.0], "this is a list"),
        ({"azimuth": np.zeros((2, 2)), "elevation": good}, "2 dimensions"),
        ({"azimuth": np.zeros(2, dtype=complex), "elevation": good}, "complex128"),
        (polars.LazyFrame({"azimuth": good}), "lazy"),
    ]:
        with pytest.raises(TypeError, match=words):
            mount.eval(table, ERRORS)


def test_columns_of_every_type():
    day = datetime.datetime(2026, 3, 1, 12)
    frame = pandas.DataFrame(
        {
            "whole": [1, 2],
            "single": np.array([1.5, 2.5], dtype=np.float32),
            "truth": [True, False],
            "missing": pandas.array([1, None], dtype="Int64"),
            "text": ["a", None],
            "time": [day, day],
            "huge": [2**60 + 1, 1],
            "kind": pandas.Categorical(["x", "y"]),
        }
    )
    for table in [frame, polars.from_pandas(frame), pyarrow.Table.from_pandas(frame), frame.to_dict("list")]:
        columns = {name: list(column) for name, column in columns_of(table)}
        assert columns["whole"] == [1, 2] and columns["single"] == [1.5, 2.5] and columns["truth"] == [1, 0]
        assert columns["missing"][0] == 1 and np.isnan(columns["missing"][1])
        assert columns["text"] == ["a", ""] and columns["kind"] == ["x", "y"]
        assert columns["time"][0].startswith("2026-03-01T12:00:00")
        assert columns["huge"] == [str(2**60 + 1), "1"]


def test_numbers_are_not_copied():
    array = np.arange(3.0)
    ((_, column),) = columns_of({"a": array})
    assert column is array or column.base is array or np.shares_memory(column, array)


def test_columns_that_do_not_lie_as_numbers_do(mount):
    """What came over a wire begins anywhere."""
    unaligned = np.frombuffer(b"." + np.linspace(0.1, 0.9, 50).tobytes(), dtype=np.float64, offset=1)
    assert not unaligned.flags.aligned
    columns = {"azimuth": unaligned, "elevation": unaligned}
    copied = {name: column.copy() for name, column in columns.items()}
    expected = mount.eval(copied, {})["pointing_y"]
    for table in (columns, pyarrow.table(columns), pandas.DataFrame(columns)):
        np.testing.assert_array_equal(np.asarray(mount.eval(table, {})["pointing_y"]), expected)
    with pytest.raises(TypeError, match=r"not aligned in memory; write azimuth.copy\(\)"):
        mount.exact(columns, {}, "pointing")


def test_rows_of_a_dictionary_are_told_by_their_place(mount):
    """Whatever pandas calls them."""
    azimuth = pandas.Series([0.1, 0.2, 0.3])
    elevation = pandas.Series([0.7, 0.8, 0.9], index=[2, 1, 0])
    table = mount.eval({"azimuth": azimuth, "elevation": elevation}, {}).to_pandas()
    np.testing.assert_array_equal(table["elevation"], [0.7, 0.8, 0.9])
    np.testing.assert_array_equal(
        table["pointing_y"], mount.eval({"azimuth": azimuth.to_numpy(), "elevation": elevation.to_numpy()}, {})["pointing_y"]
    )
