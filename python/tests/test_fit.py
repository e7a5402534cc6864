"""The fit of many files: in one process, and on a scheduler with two workers as processes of their own."""

import numpy as np
import pyarrow
import pyarrow.parquet as parquet
import pytest
from test_calibration import STUDY, TRUE
from test_cluster import cluster, scheduler  # noqa: F401

import trueaxis
from trueaxis import _native, _workers

FILES = 64
ROWS = 3000


@pytest.fixture(scope="module")
def mount():
    from conftest import MOUNT

    return trueaxis.Chain.from_text(MOUNT, "mount.chain")


def pointings(mount, rows, seed):
    """Made up here, not by the package's own simulation of noise: a tenth of the rows are far off."""
    random = np.random.default_rng(seed)
    readings = {"azimuth": random.uniform(-3, 3, rows), "elevation": random.uniform(0.1, 1.4, rows)}
    x, y, z = mount.exact(readings, TRUE, quantity="value") + random.normal(0, 1e-5, (3, rows))
    far = random.random(rows) < 0.05
    x[far] += 1e-2
    length = np.sqrt(x * x + y * y + z * z)
    return {**readings, "pointing_x": x / length, "pointing_y": y / length, "pointing_z": z / length}


@pytest.fixture(scope="module")
def folder(mount, tmp_path_factory):
    folder = tmp_path_factory.mktemp("scan")
    for at in range(FILES):
        columns = pointings(mount, ROWS, at)
        if at % 2:
            # Another order of columns, and one that nobody asks for.
            columns = {"note": ["x"] * ROWS, **dict(reversed(columns.items()))}
        parquet.write_table(pyarrow.table(columns), folder / f"part-{at:02}.parquet")
    return folder


def fit(mount, data, **more):
    return trueaxis.fit("study.toml", data, text=STUDY, chain=mount, **more)


@pytest.fixture(scope="module")
def alone(mount, folder):
    return fit(mount, folder)


def apart(one, other):
    """How far two fits are apart, in standard uncertainties."""
    assert list(one.errors["name"]) == list(other.errors["name"])
    return np.max(np.abs(one.errors["value"] - other.errors["value"]) / one.errors["standard_uncertainty"])


def test_the_truth_is_found(mount, alone):
    assert alone.converged and alone.rows == FILES * ROWS and 0.93 * alone.rows < alone.rows_kept < 0.97 * alone.rows
    for name, value, uncertainty in zip(*(alone.errors[key] for key in ["name", "value", "standard_uncertainty"])):
        assert abs(value - TRUE.get(name, 0.0)) < 5 * uncertainty, name
    assert alone.values["collimation"] == alone.errors["value"][alone.errors["name"].index("collimation")]
    assert "192000 rows" in repr(alone) and "collimation" in repr(alone)


def test_all_rows_at_once_say_the_same(mount, folder, alone):
    # `calibrate` knows more of the noise than a floor for each component: rows near the cutoff count a little otherwise.
    table = {name: np.concatenate([parquet.read_table(path)[name].to_numpy() for path in sorted(folder.iterdir())][:8])
             for name in ["azimuth", "elevation", "pointing_x", "pointing_y", "pointing_z"]}
    whole = trueaxis.calibrate("study.toml", table, text=STUDY, chain=mount)
    eight = fit(mount, sorted(folder.iterdir())[:8])
    estimates = dict(zip(whole.errors["name"], whole.errors["value"]))
    for name, value, uncertainty in zip(*(eight.errors[key] for key in ["name", "value", "standard_uncertainty"])):
        assert abs(value - estimates[name]) < 0.1 * uncertainty, name


def test_a_worker_that_dies_changes_nothing(mount, folder, alone, cluster):  # noqa: F811
    address, workers = cluster
    killed = []

    def kill_one(number, done, of):
        assert of == FILES
        if number == 2 and done == 5:
            workers[0].kill()
            killed.append(done)

    there = fit(mount, folder, client=address, progress=kill_one)
    assert killed and workers[0].wait() != 0 and workers[1].poll() is None
    assert there.rows == alone.rows and there.passes == alone.passes
    assert apart(alone, there) < 1e-9


def test_a_worker_of_another_version_is_named(mount, folder, cluster, monkeypatch):  # noqa: F811
    address, _ = cluster
    monkeypatch.setattr(_native, "__version__", "0.0.9")
    with pytest.raises(trueaxis.TrueaxisError, match=r"worker tcp://127\.0\.0\.1:\d+ runs trueaxis .* that asks 0\.0\.9"):
        fit(mount, folder, client=address)


def test_files_of_separated_values_say_the_same(mount, folder, tmp_path):
    paths = sorted(folder.iterdir())[:3]
    for path in paths:
        table = parquet.read_table(path)
        lines = [",".join(table.column_names)] + [",".join(map(str, row.values())) for row in table.to_pylist()]
        # As another system ends its lines.
        (tmp_path / path.with_suffix(".csv").name).write_bytes("\r\n".join(lines).encode())
    assert apart(fit(mount, paths), fit(mount, tmp_path)) < 1e-9


def test_what_is_wrong_is_named(mount, folder, tmp_path, monkeypatch):
    good = sorted(folder.iterdir())[0]

    def refused(words, data, **more):
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            fit(mount, data, **more)

    def spoiled(name, bytes_):
        (tmp_path / name).write_bytes(bytes_)
        return [good, tmp_path / name]

    refused("cut.parquet", spoiled("cut.parquet", good.read_bytes()[:-100]))
    refused("nothing.csv", spoiled("nothing.csv", b""))
    header = b"azimuth,elevation,pointing_x,pointing_y,pointing_z\n"
    refused("packed.csv", spoiled("packed.csv", b"\x1f\x8b\x08\x00" + bytes(range(255))))
    refused("word.csv: line 2, row 1, column `elevation`", spoiled("word.csv", header + b"1,x,0,1,0\n"))
    refused("other.csv", spoiled("other.csv", b"azimuth,pointing_x,pointing_y,pointing_z\n1,0,1,0\n"))
    mixed = tmp_path / "mixed"
    mixed.mkdir()
    (mixed / "a.csv").write_bytes(header)
    (mixed / "b.parquet").write_bytes(good.read_bytes())
    refused("holds .parquet and .csv files: give a list", mixed)
    refused("no such file", tmp_path / "nowhere")
    monkeypatch.setattr(_workers, "_SECONDS", 1)
    refused("no scheduler answers at `tcp://127.0.0.1:9`", folder, client="tcp://127.0.0.1:9")
    two = STUDY.replace('data = "table"', 'data = ["one", "two"]')
    with pytest.raises(trueaxis.TrueaxisError, match="is of one table"):
        trueaxis.fit("study.toml", folder, text=two, chain=mount)


def test_one_row_more_counts(mount, folder, tmp_path):
    """A file of one row is a file; its row is in the sum."""
    good = sorted(folder.iterdir())[0]
    parquet.write_table(pyarrow.table(pointings(mount, 1, 99)), tmp_path / "one.parquet")
    assert fit(mount, [good, tmp_path / "one.parquet"]).rows == ROWS + 1


def short_and_long(mount, folder, rows, spoiled=None):
    """A file for each number of rows; in one of them the azimuth is read off by 10 mrad."""
    for at, count in enumerate(rows):
        columns = pointings(mount, count, 700 + at)
        if at == spoiled:
            columns["azimuth"] = columns["azimuth"] + 0.01
        parquet.write_table(pyarrow.table(columns), folder / f"part-{at}.parquet")
    return folder


@pytest.mark.parametrize("first", [1, 2, 3])
def test_a_short_first_file_decides_nothing(mount, tmp_path, first):
    found = fit(mount, short_and_long(mount, tmp_path, [first, 500, 500, 500]))
    assert found.converged and found.rows_kept > 0.9 * found.rows
    for name, value, uncertainty in zip(*(found.errors[key] for key in ["name", "value", "standard_uncertainty"])):
        assert 0 < uncertainty < 1e-4 and abs(value - TRUE.get(name, 0.0)) < 5 * uncertainty, name


@pytest.mark.parametrize("spoiled", [0, 2])
def test_the_order_of_files_decides_nothing(mount, tmp_path, spoiled):
    with pytest.warns(trueaxis.TrueaxisWarning, match="rows count for nothing"):
        found = fit(mount, short_and_long(mount, tmp_path, [500, 500, 500], spoiled))
    assert found.converged and 900 < found.rows_kept < 1010
    assert abs(found.values["azimuth_index"] - TRUE.get("azimuth_index", 0.0)) < 1e-4


def test_separated_values_start_from_all_files_too(mount, tmp_path):
    for at, count in enumerate([2, 400, 400]):
        columns = pointings(mount, count, 800 + at)
        lines = [",".join(columns)] + [",".join(map(repr, map(float, row))) for row in zip(*columns.values())]
        (tmp_path / f"part-{at}.csv").write_text("\n".join(lines))
    found = fit(mount, tmp_path)
    assert found.converged and found.rows == 802 and found.rows_kept > 0.9 * found.rows


def test_as_many_errors_as_numbers_are_no_estimate(mount, tmp_path):
    assert not fit(mount, short_and_long(mount, tmp_path, [3])).converged
