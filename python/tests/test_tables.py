"""Tables of every library: simulated, evaluated, corrected."""

import datetime
import pickle

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
        with pytest.warns(trueaxis.TrueaxisWarning, match="own columns `pointing_x`, `pointing_y`, `pointing_z` were replaced"):
            corrected = mount.apply(table, ERRORS)
        assert isinstance(corrected, trueaxis.Table if isinstance(table, dict) else type(table))
        columns = dict(columns_of(corrected))
        assert list(columns) == list(simulated)
        np.testing.assert_array_equal(columns["pointing_x"], expected[0])
    error = mount.eval(simulated.to_polars().drop("pointing_x", "pointing_y", "pointing_z"), ERRORS)
    assert error.columns[2:] == ["pointing_x", "pointing_y", "pointing_z"]
    readings = {name: simulated[name] for name in mount.joints}
    first = mount.eval(readings, ERRORS, form="first-order")
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
        ({"azimuth": np.zeros((2, 2)), "elevation": good}, "column `azimuth` holds 2 dimensions: give one number or text a row"),
        ({"azimuth": np.zeros(2, dtype=complex), "elevation": good}, "column `azimuth` holds complex128"),
        ({"azimuth": [True, False], "elevation": good}, "column `azimuth` holds truth values: give numbers"),
        ({"azimuth": [True, 0.5], "elevation": good}, "column `azimuth` holds truth values: give numbers"),
        ({"azimuth": [0.5, np.False_], "elevation": good}, "column `azimuth` holds truth values: give numbers"),
        ({"azimuth": np.array([None, True, 0.5], object)[1:], "elevation": good}, "column `azimuth` holds truth values: give numbers"),
        ({"azimuth": [10**400, 1], "elevation": good}, "column `azimuth` holds whole numbers larger than any that is calculated with"),
        ({"azimuth \udc80": good, "elevation": good}, "the name of a column: the letter '.udc80' at 8 is none"),
        ({"azimuth": np.array([1, 2], "m8[s]"), "elevation": good}, "column `azimuth` holds durations: give numbers, of seconds by"),
        ({"azimuth": [datetime.timedelta(1)] * 2, "elevation": good}, "column `azimuth` holds durations"),
        (pyarrow.table({"azimuth": [b"\xff", b"x"], "elevation": good}), "column `azimuth` holds bytes that are no text"),
        (pyarrow.table({"azimuth": [[1.0], [2.0, 3.0]], "elevation": good}), "column `azimuth` holds lists or groups"),
        ({"azimuth": [[1.0], [2.0, 3.0]], "elevation": good}, "column `azimuth` holds"),
        ({}, "no columns"),
        (pandas.DataFrame([[0.1, 0.1]], columns=["azimuth", "azimuth"]), "column `azimuth` is there twice"),
    ]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            mount.eval(table, ERRORS)
    for table, words in [
        (3, "a table is needed, this is a int"),
        ([1.0], "this is a list"),
        ("table.csv", "this is a str"),
        (pandas.Series(good), "this is a Series"),
        (polars.Series("azimuth", good), "this is a Series"),
        (pyarrow.chunked_array([good]), "this is a ChunkedArray"),
        (None, "this is a NoneType"),
        ({"azimuth": 0.1, "elevation": good}, "column `azimuth` is a float: give one number or text a row"),
        ({"azimuth": np.array(0.1), "elevation": good}, "column `azimuth` is a single number"),
        ({"azimuth": "12", "elevation": good}, "column `azimuth` is a str"),
        ({"azimuth": {0.1, 0.2}, "elevation": good}, "column `azimuth` is a set: give one number or text a row"),
        ({"azimuth": frozenset(good), "elevation": good}, "column `azimuth` is a frozenset"),
        ({"azimuth": (number for number in good), "elevation": good}, "column `azimuth` is a generator, which can be read only once"),
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
        assert columns["whole"] == [1, 2] and columns["single"] == [1.5, 2.5]
        labels, rows, why = columns["truth"]
        assert list(labels) == [1, 0] and rows == 2 and why.startswith("holds truth values")
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


def test_columns_of_pandas_in_a_dictionary_go_everywhere(mount):
    """Whatever they hold; and columns of another machine's numbers."""
    columns = {
        "azimuth": pandas.Series([0.1, 0.2]),
        "elevation": np.array([0.5, 0.6], ">f8"),
        "time": pandas.Series(pandas.date_range("2026-01-01", periods=2)),
        "index": pandas.date_range("2026-01-01", periods=2),
        "zone": pandas.Series(pandas.date_range("2026-01-01", periods=2, tz="UTC")),
        "kind": pandas.Series(["a", "b"], dtype="category"),
        "whole": pandas.Series([1, None], dtype="Int64"),
        "text": pandas.Series(["a", "b"]),
        "string": pandas.Series(["a", None], dtype="string"),
    }
    table = mount.eval(columns, ERRORS)
    assert type(table["azimuth"]) is np.ndarray
    pandas_, polars_, arrow = table.to_pandas(), table.to_polars(), table.to_arrow()
    assert list(pandas_) == polars_.columns == arrow.column_names == list(table)
    expected = mount.eval({"azimuth": [0.1, 0.2], "elevation": [0.5, 0.6]}, ERRORS)["pointing_y"]
    for frame in [pandas_, polars_, arrow]:
        assert [str(cell)[:10] for cell in frame["time"]] == ["2026-01-01", "2026-01-02"]
        np.testing.assert_array_equal(np.asarray(frame["pointing_y"]), expected)
        np.testing.assert_array_equal(np.asarray(frame["elevation"]), [0.5, 0.6])
    assert polars_["whole"].to_list() == [1, None] and polars_["kind"].to_list() == ["a", "b"]


def test_a_table_is_a_dictionary_for_every_library(mount, simulated):
    for frame in [pandas.DataFrame(simulated), polars.DataFrame(simulated), pyarrow.table(simulated)]:
        assert frame.shape == (50, 5) and frame_names(frame) == list(simulated)
    again = mount.simulate(ERRORS, poses=50, noise="2 arcsec", seed=1, ranges={"elevation": ("10 deg", "80 deg")})
    assert again == simulated and not again != simulated and pickle.loads(pickle.dumps(simulated)) == simulated
    again["pointing_x"] = np.nextafter(again["pointing_x"], 1.0)
    assert again != simulated and simulated != dict(simulated)
    nothing = [np.nan, 1.0]
    table = trueaxis.Table({"number": np.array(nothing), "text": ["a", "b"], "truth": [True, False], "wave": np.zeros(2, complex)})
    same = trueaxis.Table({**table, "number": [None, 1], "truth": np.array([True, False])})
    assert table == same and table != trueaxis.Table({**same, "truth": [True, True]})
    assert table != trueaxis.Table({**same, "wave": np.ones(2, complex)}) and table != trueaxis.Table(dict(reversed(same.items())))


def strange(rows):
    """Columns that nothing can be calculated of, as Arrow has them."""
    bytes_ = pyarrow.array([b"\xff\x00"] * rows)
    lists = pyarrow.array([[1.0, 2.0]] * rows)
    groups = pyarrow.array([{"a": 1}] * rows)
    maps = pyarrow.array([[("a", 1)]] * rows, pyarrow.map_(pyarrow.string(), pyarrow.int64()))
    durations = pyarrow.array([3] * rows, pyarrow.duration("s"))
    return {"bytes": bytes_, "lists": lists, "groups": groups, "maps": maps, "durations": durations, "ok": pyarrow.array([True] * rows)}


def test_columns_that_nobody_asks_for_are_carried(mount):
    table = pyarrow.table({"azimuth": [0.1, 0.2], "elevation": [0.5, 0.6], **strange(2)})
    expected = mount.exact({"azimuth": np.array([0.1, 0.2]), "elevation": np.array([0.5, 0.6])}, ERRORS, quantity="value")
    frames = [table, table.to_pandas(), polars.from_arrow(table), {name: table.column(name) for name in table.column_names}]
    frames += [{"azimuth": [0.1, 0.2], "elevation": [0.5, 0.6], "wave": np.zeros(2, complex), "image": np.zeros((2, 3, 3))}]
    for frame in frames:
        corrected = mount.apply(frame, ERRORS)
        assert frame_names(corrected) == [*frame_names(frame), "pointing_x", "pointing_y", "pointing_z"]
        np.testing.assert_array_equal(np.asarray(corrected["pointing_y"]), expected[1])
    assert mount.apply(table, ERRORS).select(table.column_names).equals(table)


def frame_names(frame):
    return list(getattr(frame, "column_names", getattr(frame, "columns", frame)))


def test_what_is_derived_from_a_frame_stays_what_it_is(mount):
    class Frame(pandas.DataFrame):
        @property
        def _constructor(self):
            return Frame

    class Series(pandas.Series):
        pass

    class PolarsFrame(polars.DataFrame):
        pass

    columns = {"azimuth": [0.1, 0.2], "elevation": [0.5, 0.6]}
    assert type(mount.apply(Frame(columns, index=["a", "b"]), ERRORS)) is Frame
    assert list(mount.apply(Frame(columns, index=["a", "b"]), ERRORS).index) == ["a", "b"]
    assert isinstance(mount.apply(PolarsFrame(columns), ERRORS), polars.DataFrame)
    series = {name: Series(column) for name, column in columns.items()}
    np.testing.assert_array_equal(mount.eval(series, ERRORS)["pointing_x"], mount.eval(columns, ERRORS)["pointing_x"])


def test_columns_of_the_table_that_have_a_name_of_the_result(scanner, mount):
    """Those with a unit in their name are the same column, as for the command; nothing else is touched."""
    own = {"azimuth": [0.1], "elevation": [0.5], "pointing_x": [7.0], "pointing_y [1]": [8.0], "pointing_w": [9.0]}
    for table in [own, pandas.DataFrame(own), polars.DataFrame(own), pyarrow.table(own)]:
        for ask in [mount.eval, mount.apply]:
            with pytest.warns(trueaxis.TrueaxisWarning, match="own columns `pointing_x`, `pointing_y \\[1\\]` were replaced$") as told:
                result = ask(table, ERRORS)
            assert len(told) == 1 and told[0].filename == __file__
            # What is replaced under its own name keeps its place.
            names = ["azimuth", "elevation", "pointing_x", "pointing_w", "pointing_y", "pointing_z"]
            assert frame_names(result) == names and float(np.asarray(result["pointing_x"])[0]) != 7.0


def test_cells_that_nobody_reads_are_not_looked_at(mount):
    """Of very many rows that takes longer than all else."""

    class Dear(list):
        def __iter__(self):
            raise AssertionError("somebody read it")

    columns = {"azimuth": [0.1, 0.2], "elevation [rad]": [0.5, 0.6]}
    native = mount._native
    read = dict(columns_of({**columns, "remark": Dear(["a", "b"])}, native))
    assert read["remark"].rows == 2 and list(read["azimuth"]) == [0.1, 0.2] and list(read["elevation [rad]"]) == [0.5, 0.6]
    with pytest.raises(trueaxis.TrueaxisError, match="column `remark` has 3 rows, column `azimuth` has 2"):
        mount.eval({**columns, "remark": ["a", "b", "c"]}, ERRORS)
