"""What is given wrong is told in the package's own words, at the caller's own line."""

import copy
import inspect
import pickle
import warnings

import numpy as np
import pyarrow
import pytest

import trueaxis
from trueaxis._tables import columns_of

ERRORS = {"collimation": "30 arcsec"}
READINGS = {"azimuth": [0.1, 0.2], "elevation": [0.5, 0.6]}


def test_a_file_of_errors_that_cannot_be_read(mount, tmp_path):
    (tmp_path / "errors.toml").write_text("collimation = 0\n")
    readings = {"azimuth": 0.1, "elevation": 0.2}
    for path, words in [
        (tmp_path / "error.toml", "cannot read .*error.toml.*no such file.*did you mean .*errors.toml"),
        (tmp_path, "it is a folder"),
        ("none.toml", "cannot read `none.toml`"),
    ]:
        for ask in [lambda: mount.exact(readings, path), lambda: mount.eval(READINGS, path), lambda: mount.apply(READINGS, path)]:
            with pytest.raises(trueaxis.TrueaxisError, match=words):
                ask()
        with pytest.raises(trueaxis.TrueaxisError):
            trueaxis.apply(tmp_path, mount, path, tmp_path / "out")


def test_numbers_out_of_bounds(mount):
    def simulate(**more):
        return mount.simulate(ERRORS, **{"poses": 5, "noise": "2 arcsec", "seed": 1, **more})

    for ask, words in [
        (lambda: simulate(poses=-3), "poses=-3: write a whole number from 0"),
        (lambda: simulate(seed=-1), "seed=-1"),
        (lambda: simulate(seed=2**64), "seed="),
        (lambda: mount.bound({"*": 1e-3}, seed=-1), "seed=-1"),
        (lambda: mount.closed_form(order=-1), "order=-1"),
    ]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            ask()
    for noise in [np.float32(1e-5), np.float64(1e-5), 1e-5, [1e-5]]:
        assert simulate(noise=noise, poses=np.int64(7)).rows == 7


def test_warnings_are_of_the_callers_line(mount, tmp_path):
    readings = {"azimuth": 1.0, "elevation": 1.0}
    file = tmp_path / "errors.toml"
    file.write_text("collimation = 0\n[found-over]\nazimuth = [0, 0.15]\n")

    def ask(what):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            what()
        return [(warning.filename, warning.lineno) for warning in caught]

    for what in [
        lambda: mount.eval({"azimuth": [100.0], "elevation": [45.0]}, ERRORS),
        lambda: mount.apply(READINGS, file),
        lambda: mount.exact(readings, {"collimation": 10.0}),
        lambda: mount.simulate({"collimation": 10.0}, poses=3, noise="2 arcsec", seed=1),
    ]:
        assert set(ask(what)) == {(__file__, inspect.getsourcelines(what)[1])}, ask(what)


FOUND = "collimation = 0\n[found-over]\nazimuth = [\"-170 deg\", \"170 deg\"]\nelevation = [\"15 deg\", \"80 deg\"]\n"
OUTSIDE = {"azimuth": np.deg2rad([200.0, 175.0, 0.0, 10.0]), "elevation": np.deg2rad([45.0, 85.0, 10.0, 20.0])}


def test_rows_outside_of_what_the_model_was_found_over(mount, tmp_path):
    file = tmp_path / "errors.toml"
    file.write_text(FOUND)
    words = r"2 of 4 rows are outside what the model was found over, where nothing confirms it: azimuth by up to 5\.0000° \(found"
    with pytest.warns(trueaxis.TrueaxisWarning, match=words) as told:
        corrected = mount.apply(OUTSIDE, file)
    assert len(told) == 1 and "elevation by up to 5.0000°" in str(told[0].message)
    np.testing.assert_array_equal(corrected["pointing_x"], mount.exact(OUTSIDE, quantity="value")[0])
    # As of the command: `eval` says nothing, nor is there anything to say of rows within.
    mount.eval(OUTSIDE, file, quantity="value")
    mount.apply({name: column[3:] for name, column in OUTSIDE.items()}, file)


def test_rows_outside_are_counted_over_all_files(mount, tmp_path):
    import pyarrow.parquet as parquet

    (tmp_path / "errors.toml").write_text(FOUND)
    (tmp_path / "scan").mkdir()
    for at in range(3):
        parquet.write_table(pyarrow.table(OUTSIDE), tmp_path / "scan" / f"{at}.parquet", row_group_size=1)
    with pytest.warns(trueaxis.TrueaxisWarning, match="6 of 12 rows are outside") as told:
        trueaxis.apply(tmp_path / "scan", mount, tmp_path / "errors.toml", tmp_path / "out")
    assert len(told) == 1 and told[0].filename == __file__


def test_masked_rows_are_no_readings(mount):
    azimuth = np.ma.masked_array([0.1, 1.5], mask=[False, True])
    elevation = np.array([0.5, 0.6])
    with pytest.raises(TypeError, match=r"`azimuth`: some of its rows are masked; write azimuth\.filled\(numpy\.nan\)"):
        mount.exact({"azimuth": azimuth, "elevation": elevation}, ERRORS)
    for column in [azimuth, azimuth.astype(np.float32)]:
        for ask in [mount.eval, mount.apply]:
            with pytest.raises(trueaxis.TrueaxisError, match="row 2, column `azimuth`: `NaN` is not finite"):
                ask({"azimuth": column, "elevation": elevation}, ERRORS)
    # What is masked nowhere is an array, and what nobody asks for may be masked.
    whole = np.ma.masked_array([0.1, 1.5])
    plain = mount.exact({"azimuth": whole.data, "elevation": elevation}, ERRORS)
    np.testing.assert_array_equal(mount.exact({"azimuth": whole, "elevation": elevation}, ERRORS), plain)
    other = mount.eval({"azimuth": whole, "elevation": elevation, "other": azimuth}, ERRORS)
    np.testing.assert_array_equal(other["pointing_x"], plain[0])
    time = np.ma.masked_array(np.array(["2026-01-01", "2026-01-02"], dtype="datetime64[ns]"), mask=[True, False])
    texts = np.ma.masked_array(["a", "b"], mask=[True, False])
    columns = dict(columns_of({"whole": np.ma.masked_array([1, 2], mask=[True, False]), "time": time, "text": texts}))
    assert np.isnan(columns["whole"][0]) and columns["whole"][1] == 2
    assert columns["time"][0] == "" and columns["time"][1].startswith("2026-01-02") and columns["text"] == ["", "b"]


class Once:
    """Speaks Arrow's stream of tables once, as a cursor does."""

    def __init__(self, table):
        self._table = table

    def __arrow_c_stream__(self, requested_schema=None):
        table, self._table = self._table, None
        if table is None:
            raise ValueError("read already")
        return table.__arrow_c_stream__(requested_schema)


def test_streams_are_read_once(mount):
    table = pyarrow.table({**READINGS, "id": ["a", "b"]})
    expected = mount.apply(table, ERRORS)
    for ask in [mount.apply, lambda *given: mount.eval(*given, quantity="value")]:
        for stream in [table.to_reader(), Once(table)]:
            assert ask(stream, ERRORS).equals(expected)


def test_truth_with_nothing_in_a_row_is_a_label():
    ((_, column),) = columns_of(pyarrow.table({"ok": [True, None, False]}))
    np.testing.assert_array_equal(column.labels, [1.0, np.nan, 0.0])


def test_answers_that_are_no_files_of_the_same_are_not_copied(mount):
    calibration = trueaxis._calibration.Calibration(None)
    for what in [copy.deepcopy, copy.copy, pickle.dumps]:
        with pytest.raises(TypeError, match="cannot be copied or pickled: keep its `report`"):
            what(calibration)


def test_what_is_no_table_no_chain_and_no_path_is_told_in_words(mount, tmp_path):
    readings = {"azimuth": 0.1, "elevation": 0.2}
    for ask, words in [
        (lambda: mount.exact("readings.csv"), "readings: write a dictionary of joints and inputs"),
        (lambda: mount.exact(None), "readings: write a dictionary"),
        (lambda: mount.exact({1: 0.1}), "a name of readings: write a text, not 1"),
        (lambda: mount.exact(readings, None, ["pointing"]), "observable: write one name, not \\['pointing'\\]"),
        (lambda: mount.closed_form(3), "observable: write one name, not 3"),
        (lambda: mount.compiled(3), "observable: write one name, not 3"),
        (lambda: mount.identify(candidate=5), "candidate: write a text, not 5"),
        (lambda: mount.budget({"*": 1e-3}, path=5), "path: write a text, not 5"),
        (lambda: mount.generate(5), "language: write a text, not 5"),
        (lambda: trueaxis.Chain.from_text(b"chain"), "text: write a text, not b'chain'"),
        (lambda: trueaxis.Chain.from_file(b"mount.chain"), "path: give a path, as a text or a pathlib.Path, not a bytes"),
        (lambda: trueaxis.check(5), "claims: give a path, as a text or a pathlib.Path, not a int"),
        (lambda: trueaxis.calibrate(b"study.toml", READINGS), "study: give a path"),
        (lambda: trueaxis.calibrate("study.toml", READINGS, text=5), "text: write a text, not 5"),
        (lambda: trueaxis.fit(5, tmp_path), "study: give a path"),
        (lambda: trueaxis.fit("study.toml", pyarrow.table(READINGS)), "files: .* not a Table; Chain.apply and calibrate take tables in memory"),
        (lambda: trueaxis.fit("study.toml", READINGS), "files: give a folder, a path or a list of paths, not a dict"),
        (lambda: trueaxis.fit("study.toml", b"folder"), "files: give a folder, a path or a list of paths, not a bytes"),
        (lambda: trueaxis.fit("study.toml", [5]), "files: give a path, as a text"),
        (lambda: trueaxis.apply([__file__], mount, {}, b"out"), "out: give a path"),
        (lambda: mount.exact(readings, threads=1.5), "threads: write a whole number, not 1.5"),
        (lambda: mount.eval(READINGS, {}, observables=3), "write a name, or a list of names, not 3"),
        (lambda: mount.bound({"*": 1e-3}, ranges="10 deg"), "ranges: write a dictionary"),
        (lambda: mount.simulate({}, poses=1.5, noise=1e-5, seed=1), "poses: write a whole number, not 1.5"),
        (lambda: mount.simulate({}, poses=3, noise=None, seed=1), "noise: write a number in SI or a text with a unit"),
        (lambda: trueaxis.apply(tmp_path, "mount.chain", {}, tmp_path / "out"), "chain: give a trueaxis.Chain"),
        (lambda: trueaxis.calibrate("study.toml", tmp_path, chain="mount.chain"), "chain: give a trueaxis.Chain"),
        (lambda: trueaxis.calibrate("study.toml", 3, text=STUDY_TEXT, chain=mount), "a table is needed, this is a int"),
        (lambda: trueaxis.calibrate("study.toml", tmp_path, text=STUDY_TEXT, chain=mount, search_rows=1.5), "search_rows: write a whole number"),
        (lambda: trueaxis.fit("study.toml", tmp_path, chain="mount.chain"), "chain: give a trueaxis.Chain"),
        (lambda: trueaxis.fit("study.toml", 3), "files: give a folder, a path or a list of paths, not a int"),
        (lambda: trueaxis.apply(3, mount, {}, tmp_path / "out"), "files: give a folder"),
    ]:
        with pytest.raises(TypeError, match=words):
            ask()


def test_letters_and_whole_numbers_that_are_none(mount):
    readings = {"azimuth": 0.1, "elevation": 0.2}
    for ask, words in [
        (lambda: trueaxis.Chain.from_text("chain \udc80 {}"), "text: the letter '.udc80' at 6 is none: was a file read in another encoding?"),
        (lambda: trueaxis.calibrate("study.toml", READINGS, text="\udc80"), "text: the letter"),
        (lambda: mount.exact(readings, {"collimation": "1 \udc80"}), "collimation: the letter '.udc80' at 2 is none"),
        (lambda: mount.exact(readings, {"\udc80": 1e-5}), "errors: the letter"),
        (lambda: mount.exact(readings, None, "\udc80"), "observable: the letter"),
        (lambda: mount.eval(READINGS, {}, ["\udc80"]), "a name: the letter"),
        (lambda: mount.exact({**readings, "azimuth": 10**400}), "azimuth: this whole number is larger than any that is calculated with"),
        (lambda: mount.exact(readings, {"collimation": 10**400}), "collimation: this whole number is larger"),
        (lambda: mount.simulate({}, poses=3, noise=10**400, seed=1), "noise: this whole number is larger"),
    ]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            ask()


STUDY_TEXT = 'chain = "mount.chain"\ndata = "table"\n[observed]\nkind = "direction"\n'


def test_counts_that_no_memory_holds_are_refused(mount):
    """An allocation that fails would end the process, not the call."""
    for poses, words in [(2**32, "poses=4294967296: write a whole number"), (2**32 - 1, "poses=4294967295: so many rows of 5 columns do not fit")]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            mount.simulate(ERRORS, poses=poses, noise="2 arcsec", seed=1)


def test_estimates_are_in_si_without_a_doubt(mount):
    """However large they are: a number that somebody wrote without a unit is doubted."""
    from trueaxis._inputs import Found

    found = Found([("collimation", 1.5)], {"collimation": "rad"}, [])
    corrected = mount.apply(READINGS, found)
    with pytest.warns(trueaxis.TrueaxisWarning, match="collimation = 1.5 has no unit"):
        doubted = mount.apply(READINGS, dict(found))
    np.testing.assert_array_equal(corrected["pointing_x"], doubted["pointing_x"])
    again = pickle.loads(pickle.dumps(found))
    assert again == found and again.units == found.units
