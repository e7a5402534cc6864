"""Which files a folder is made of, and what files without rows count for."""

import gzip

import numpy as np
import pyarrow
import pyarrow.parquet as parquet
import pytest
from test_calibration import STUDY
from test_folder import pointings

import trueaxis

ROWS = 400
REPLACED = pytest.mark.filterwarnings("ignore:the input's own columns")


@pytest.fixture(scope="module")
def mount():
    from conftest import MOUNT

    return trueaxis.Chain.from_text(MOUNT, "mount.chain")


@pytest.fixture(scope="module")
def tables():
    return [pointings(ROWS, at, off_centre=0.0) for at in range(3)]


def fit(mount, data, **more):
    return trueaxis.fit("study.toml", data, text=STUDY, chain=mount, **more)


def calibrate(mount, data, **more):
    return trueaxis.calibrate("study.toml", data, text=STUDY, chain=mount, **more)


def written(folder, **tables):
    """Files by their names; two underscores stand for a dot."""
    folder.mkdir()
    for name, table in tables.items():
        parquet.write_table(table if isinstance(table, pyarrow.Table) else pyarrow.table(table), folder / name.replace("__", "."))
    return folder


@REPLACED
def test_endings_in_capitals_and_short(mount, tables, tmp_path):
    a, b, c = tables
    folder = written(tmp_path / "scan", a__parquet=a, b__PARQUET=b, c__pq=c)
    assert fit(mount, folder).rows == calibrate(mount, folder).report["observations"]["rows"] == 3 * ROWS
    done = trueaxis.apply(folder, mount, {}, tmp_path / "out")
    assert done["rows"] == [ROWS] * 3 and {path.name for path in (tmp_path / "out").iterdir()} == {"a.parquet", "b.PARQUET", "c.pq"}


def test_hidden_files_are_left_out(mount, tables, tmp_path):
    folder = written(tmp_path / "scan", a__parquet=tables[0], __b__parquet=tables[1], _metadata=tables[2])
    (folder / ".b.parquet").exists() or pytest.fail("no hidden file")
    (folder / "_SUCCESS").touch()
    assert fit(mount, folder).rows == ROWS


@REPLACED
def test_what_is_left_out_is_told(mount, tables, tmp_path):
    folder = written(tmp_path / "scan", a__parquet=tables[0])
    (folder / "2024").mkdir()
    (folder / "x.parquet").mkdir()
    (folder / "readme.txt").touch()
    words = "only its own .parquet files are read, not `2024/`, `readme.txt`, `x.parquet/`; give a list of files"
    with pytest.warns(trueaxis.TrueaxisWarning, match=words) as told:
        assert fit(mount, folder).rows == ROWS
    assert told[0].filename == __file__
    with pytest.warns(trueaxis.TrueaxisWarning, match=words):
        calibrate(mount, folder)
    (folder / "b.csv").touch()
    with pytest.warns(trueaxis.TrueaxisWarning, match="not `2024/`, `b.csv`"):
        trueaxis.apply(folder, mount, {}, tmp_path / "out")
    with pytest.raises(trueaxis.TrueaxisError, match="holds .parquet and .csv files"):
        fit(mount, folder)
    with pytest.raises(trueaxis.TrueaxisError, match="x.parquet`: it is a folder; list the files in it"):
        fit(mount, [folder / "x.parquet"])


def test_a_folder_of_folders_is_told(mount, tables, tmp_path):
    table = pyarrow.table({**tables[0], "night": ["a", "b"] * (ROWS // 2)})
    parquet.write_to_dataset(table, tmp_path / "scan", partition_cols=["night"])
    with pytest.raises(trueaxis.TrueaxisError, match="no .parquet or .csv file in this folder; it holds `night=a/`, `night=b/`, which a list"):
        fit(mount, tmp_path / "scan")
    assert fit(mount, sorted((tmp_path / "scan").rglob("*.parquet"))).rows == ROWS


@REPLACED
def test_files_without_rows_count_for_nothing(mount, tables, tmp_path):
    a, b, _ = tables
    none = {name: column[:0] for name, column in a.items()}
    folder = written(tmp_path / "scan", a__parquet=none, b__parquet=a, c__parquet=none, d__parquet=b)
    without = [folder / "b.parquet", folder / "d.parquet"]
    one, other = fit(mount, folder), fit(mount, without)
    assert (one.rows, one.values) == (other.rows, other.values)
    one, other = calibrate(mount, folder, search_rows=500), calibrate(mount, without, search_rows=500)
    assert one.values == other.values and one.report["every_row"] == other.report["every_row"]
    done = trueaxis.apply(folder, mount, {}, tmp_path / "out")
    assert done["rows"] == [0, ROWS, 0, ROWS]
    schemas = [parquet.read_schema(tmp_path / "out" / f"{name}.parquet") for name in "ab"]
    assert schemas[0].equals(schemas[1]) and parquet.read_table(tmp_path / "out" / "a.parquet").num_rows == 0
    (tmp_path / "header.csv").write_text(",".join(a) + "\n")
    assert fit(mount, [tmp_path / "header.csv", *without]).values == fit(mount, [*without, tmp_path / "header.csv"]).values
    for ask in [fit, calibrate]:
        with pytest.raises(trueaxis.TrueaxisError, match="there are no rows in any file"):
            ask(mount, [folder / "a.parquet"])


def test_names_may_repeat_where_nothing_goes_by_them(mount, tables, tmp_path):
    files = [written(tmp_path / name, p__parquet=table) / "p.parquet" for name, table in zip("xy", tables)]
    assert fit(mount, files).rows == calibrate(mount, files).report["observations"]["rows"] == 2 * ROWS
    with pytest.raises(trueaxis.TrueaxisError, match="is given twice"):
        fit(mount, [files[0], files[0]])
    (tmp_path / "link.parquet").symlink_to(files[0])
    for again in [tmp_path / "link.parquet", tmp_path / "y" / ".." / "x" / "p.parquet"]:
        for ask in [fit, calibrate]:
            with pytest.raises(trueaxis.TrueaxisError, match="is given twice"):
                ask(mount, [files[0], again])
    with pytest.raises(trueaxis.TrueaxisError, match="two files are named `p.parquet`"):
        trueaxis.apply(files, mount, {}, tmp_path / "out")


def test_paths_may_come_one_by_one(mount, tables, tmp_path):
    folder = written(tmp_path / "scan", a__parquet=tables[0], b__parquet=tables[1])
    for ask in [lambda data: fit(mount, data).values, lambda data: calibrate(mount, data).values]:
        assert ask(path for path in sorted(folder.iterdir())) == ask(sorted(folder.iterdir()))


def test_a_copy_of_a_file_is_told(mount, tables, tmp_path):
    folder = written(tmp_path / "scan", a__parquet=tables[0], b__parquet=tables[1], c__parquet=tables[0])
    with pytest.warns(trueaxis.TrueaxisWarning, match=r"c\.parquet` has the rows of `.*a\.parquet`, which count twice") as told:
        assert fit(mount, folder).rows == 3 * ROWS
    assert len(told) == 1


@pytest.mark.parametrize("ending", ["parquet", "csv"])
def test_bare_degrees_of_any_file_are_told(mount, tables, tmp_path, ending):
    degrees = {**tables[1], "azimuth": np.rad2deg(tables[1]["azimuth"])}
    for name, table in [("a", tables[0]), ("b", degrees)]:
        if ending == "csv":
            lines = [",".join(table), *(",".join(map(repr, map(float, row))) for row in zip(*table.values()))]
            (tmp_path / f"{name}.csv").write_text("\n".join(lines))
        else:
            parquet.write_table(pyarrow.table(dict(table)), tmp_path / f"{name}.parquet")
    with pytest.warns(trueaxis.TrueaxisWarning) as told:
        fit(mount, sorted(tmp_path.glob(f"*.{ending}")))
    assert any("column `azimuth` reaches" in str(one.message) for one in told)


def test_columns_that_nobody_asks_for_may_differ(mount, tables, tmp_path):
    expected = calibrate(mount, written(tmp_path / "plain", **{f"{at}__parquet": table for at, table in enumerate(tables)}))

    def differing(at):
        return {
            "remark": pyarrow.nulls(ROWS) if at == 1 else ["x"] * ROWS,
            "id": np.arange(ROWS) + (2**60 if at == 2 else 0),
            "ok": [True] * (ROWS - 1) + [None if at == 1 else True],
            "code": ["x"] * ROWS if at == 1 else np.arange(ROWS),
            **({"once": [0.0] * ROWS} if at == 1 else {}),
        }

    more = {f"{at}__parquet": {**table, **differing(at)} for at, table in enumerate(tables)}
    found = calibrate(mount, written(tmp_path / "more", **more))
    assert found.values == expected.values
    # A label is the same whatever other files hold.
    grouped = STUDY.replace("[noise]\n", '[noise]\ngroup = "id"\n')
    assert trueaxis.calibrate("study.toml", tmp_path / "more", text=grouped, chain=mount).verdict
    with pytest.raises(trueaxis.TrueaxisError, match="1.parquet: column `code` holds texts, in .*0.parquet it does not"):
        trueaxis.calibrate("study.toml", tmp_path / "more", text=STUDY.replace("[noise]\n", '[noise]\ngroup = "code"\n'), chain=mount)
    with pytest.raises(trueaxis.TrueaxisError, match="0.parquet: column `once` is not there"):
        trueaxis.calibrate("study.toml", tmp_path / "more", text=STUDY.replace("[noise]\n", '[noise]\ngroup = "once"\n'), chain=mount)


def test_a_place_that_cannot_be_written(mount, tables, tmp_path):
    folder = written(tmp_path / "scan", a__parquet=tables[0])
    (tmp_path / "file").touch()
    for out in ["/proc/x", tmp_path / "file" / "out"]:
        with pytest.raises(trueaxis.TrueaxisError, match="cannot write `[^`]*`") as raised:
            trueaxis.apply(folder, mount, {}, out)
        assert "partial" not in str(raised.value)


def test_a_seed_is_a_whole_number(mount, tables, tmp_path):
    with pytest.raises(trueaxis.TrueaxisError, match="seed=-1"):
        calibrate(mount, written(tmp_path / "scan", a__parquet=tables[0]), seed=-1)


def test_a_file_of_another_kind_is_named_as_what_it_is(mount, tables, tmp_path):
    lines = [";".join(tables[0]), *(";".join(map(repr, map(float, row))) for row in zip(*tables[0].values()))]
    (tmp_path / "scan.csv").write_text("\n".join(lines))
    (tmp_path / "scan.csv.gz").write_bytes(gzip.compress((tmp_path / "scan.csv").read_bytes()))
    # Where separated values are read, a semicolon parts them as well as a comma.
    assert fit(mount, tmp_path / "scan.csv").rows == ROWS
    with pytest.raises(trueaxis.TrueaxisError, match="scan.csv.gz: this is compressed with gzip: unpack it first, with `gunzip`"):
        fit(mount, tmp_path / "scan.csv.gz")
    for ask in [lambda file: calibrate(mount, file), lambda file: trueaxis.apply(file, mount, {}, tmp_path / "out")]:
        with pytest.raises(trueaxis.TrueaxisError, match=r"scan.csv: this is no Parquet file: write its rows as one"):
            ask(tmp_path / "scan.csv")
        with pytest.raises(trueaxis.TrueaxisError, match="scan.csv.gz: this is compressed with gzip"):
            ask(tmp_path / "scan.csv.gz")
    with pytest.raises(TypeError, match="client: give a Dask client or the address of a scheduler, not a int"):
        trueaxis.apply(tmp_path / "scan.csv", mount, {}, tmp_path / "out", client=3)
