"""Folders of Parquet files: in one process, and on a scheduler with two workers as processes of their own."""

import asyncio
import re
import socket
import subprocess
import sys
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from threading import Thread

import distributed
import numpy as np
import pyarrow
import pyarrow.parquet as parquet
import pytest

import trueaxis
from trueaxis import _native, _workers

ERRORS = {"collimation": "30 arcsec", "tilt_x": "20 arcsec"}
FILES = 64
ROWS = 20_000


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scan")
    random = np.random.default_rng(5)
    for at in range(FILES):
        columns = {"azimuth": random.uniform(-3, 3, ROWS), "elevation": random.uniform(0, 1.5, ROWS), "id": np.arange(ROWS) + at * ROWS}
        parquet.write_table(pyarrow.table(columns), folder / f"part-{at:02}.parquet")
    return folder


def started(*arguments):
    program = f"from distributed.cli.dask_{arguments[0]} import main; main()"
    return subprocess.Popen([sys.executable, "-c", program, *arguments[1:]], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


@pytest.fixture
def scheduler():
    """The address of a scheduler, and its process."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    process = started("scheduler", "--host", address, "--no-dashboard")
    yield address, process
    process.kill()
    process.wait()


@pytest.fixture
def cluster(scheduler):
    """The address of a scheduler and its two workers."""
    address, _ = scheduler
    options = ["--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1"]
    workers = [started("worker", address, *options) for _ in range(2)]
    yield address, workers
    for process in workers:
        process.kill()
        process.wait()


def check(chain, folder, result):
    """Every row of every file is there, and right."""
    assert sorted(path.name for path in result.iterdir()) == sorted(path.name for path in folder.iterdir())
    for path in folder.iterdir():
        before, after = parquet.read_table(path), parquet.read_table(result / path.name)
        assert after.column_names == ["azimuth", "elevation", "id", "pointing_x", "pointing_y", "pointing_z"]
        assert after.select(before.column_names).equals(before)
        expected = chain.exact({name: before[name].to_numpy() for name in chain.joints}, ERRORS, quantity="value")
        np.testing.assert_array_equal(np.array([after[f"pointing_{c}"].to_numpy() for c in "xyz"]), expected)


def test_a_folder_in_this_process(mount, folder, tmp_path):
    told = []
    done = trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", progress=lambda *at: told.append(at))
    assert sum(done["rows"]) == FILES * ROWS and told[-1] == (FILES, FILES)
    check(mount, folder, tmp_path / "out")


def test_a_worker_that_dies_costs_no_row(mount, folder, tmp_path, cluster):
    address, workers = cluster
    killed = []

    def kill_one(done, of):
        if done == 5:
            workers[0].kill()
            killed.append(done)

    done = trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client=address, progress=kill_one)
    assert killed and workers[0].wait() != 0 and workers[1].poll() is None
    assert sum(done["rows"]) == FILES * ROWS
    check(mount, folder, tmp_path / "out")


def test_a_worker_of_another_version_is_named(mount, folder, tmp_path, cluster, monkeypatch):
    address, _ = cluster
    monkeypatch.setattr(_native, "__version__", "0.0.9")
    with pytest.raises(trueaxis.TrueaxisError, match=r"worker tcp://127\.0\.0\.1:\d+ runs trueaxis .* that asks 0\.0\.9"):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client=address)
    assert not list(tmp_path.iterdir())


def test_what_is_wrong_is_named_and_nothing_is_left(mount, folder, tmp_path, monkeypatch):
    spoiled = tmp_path / "spoiled"
    spoiled.mkdir()
    for path in sorted(folder.iterdir())[:3]:
        (spoiled / path.name).write_bytes(path.read_bytes())
    cut = spoiled / "part-01.parquet"
    cut.write_bytes(cut.read_bytes()[:-100])
    empty = tmp_path / "empty"
    empty.mkdir()
    out = tmp_path / "out"
    monkeypatch.setattr(_workers, "_SECONDS", 1)
    for source, words in [(spoiled, "part-01.parquet"), (empty, "no .parquet file"), (tmp_path / "none", "no such file"), ([], "no files")]:
        with pytest.raises(trueaxis.TrueaxisError, match=words):
            trueaxis.apply(source, mount, ERRORS, out)
    with pytest.raises(trueaxis.TrueaxisError, match="no scheduler answers at `tcp://127.0.0.1:9`"):
        trueaxis.apply(folder, mount, ERRORS, out, client="tcp://127.0.0.1:9")
    with pytest.raises(trueaxis.TrueaxisError, match="is there already"):
        trueaxis.apply(folder, mount, ERRORS, empty)
    with pytest.raises(trueaxis.TrueaxisError, match="create it first"):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "no" / "out")
    with pytest.raises(trueaxis.MistakeError, match="colimation"):
        trueaxis.apply(folder, mount, {"colimation": 1e-5}, out)
    with pytest.raises(trueaxis.TrueaxisError, match="two files are named"):
        trueaxis.apply([folder / "part-01.parquet", cut], mount, ERRORS, out)
    bad = tmp_path / "bad"
    bad.mkdir()
    parquet.write_table(pyarrow.table({"azimuth": [0.1, None], "elevation": [0.1, 0.2]}), bad / "a.parquet")
    with pytest.raises(trueaxis.TrueaxisError, match="a.parquet: row 2, column `azimuth`"):
        trueaxis.apply(bad, mount, ERRORS, out)
    assert not out.exists() and {path.name for path in tmp_path.iterdir()} == {"spoiled", "empty", "bad"}


def test_a_scheduler_without_an_answer_is_soon_told(mount, folder, tmp_path, monkeypatch):
    monkeypatch.setattr(_workers, "_SECONDS", 1)
    began = time.monotonic()
    with pytest.raises(trueaxis.TrueaxisError, match="no scheduler answers at `nonsense`"):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client="nonsense")
    assert time.monotonic() - began < 30


@pytest.mark.parametrize("server", ["web", "silent"])
def test_what_answers_and_is_no_scheduler_is_soon_told(mount, folder, tmp_path, monkeypatch, server):
    monkeypatch.setattr(_workers, "_SECONDS", 1)
    monkeypatch.setattr(_workers, "_MORE_SECONDS", 1)
    began = time.monotonic()
    if server == "web":
        with ThreadingHTTPServer(("127.0.0.1", 0), BaseHTTPRequestHandler) as web:
            Thread(target=web.serve_forever, daemon=True).start()
            refused(mount, folder, tmp_path, f"tcp://127.0.0.1:{web.server_address[1]}", "no scheduler answers at")
            web.shutdown()
    else:
        with socket.create_server(("127.0.0.1", 0)) as silent:
            refused(mount, folder, tmp_path, f"tcp://127.0.0.1:{silent.getsockname()[1]}", "no scheduler answers at")
    assert time.monotonic() - began < 30


def refused(mount, folder, tmp_path, client, words):
    told = f"{words} `{re.escape(client)}`" if isinstance(client, str) else words
    with pytest.raises(trueaxis.TrueaxisError, match=told):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client=client)
    assert not list(tmp_path.iterdir())


def test_what_is_no_client_to_wait_for_is_told(mount, folder, tmp_path, cluster):
    address, _ = cluster
    with distributed.Client(address) as client:
        client.wait_for_workers(1, timeout=60)
        worker = next(iter(client.scheduler_info()["workers"]))
    refused(mount, folder, tmp_path, worker, "no scheduler answers at")
    refused(mount, folder, tmp_path, client, "this Dask client is closed")

    async def in_a_loop():
        async with distributed.Client(address, asynchronous=True) as client:
            refused(mount, folder, tmp_path, client, "this Dask client is asynchronous")

    asyncio.run(in_a_loop())


def test_a_scheduler_without_workers_is_told(mount, folder, tmp_path, cluster, monkeypatch):
    address, workers = cluster
    for worker in workers:
        worker.kill()
        worker.wait()
    monkeypatch.setattr(_workers, "_WORKER_SECONDS", 2)
    with pytest.raises(trueaxis.TrueaxisError, match="has no worker: start one with"):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client=address)
    assert not list(tmp_path.iterdir())


def test_all_workers_that_die_are_told(mount, folder, tmp_path, cluster, monkeypatch):
    address, workers = cluster
    monkeypatch.setattr(_workers, "_WORKER_SECONDS", 20)
    died = []

    def kill_all(done, of):
        if not died:
            for worker in workers:
                worker.kill()
            died.append(time.monotonic())

    with pytest.raises(trueaxis.TrueaxisError, match=f"scheduler at `{address}` has had no worker for 20 s"):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client=address, progress=kill_all)
    assert 15 < time.monotonic() - died[0] < 60 and not list(tmp_path.iterdir())


def test_a_scheduler_that_dies_is_told(mount, folder, tmp_path, cluster, scheduler, monkeypatch):
    address, process = scheduler
    died = []

    def kill(done, of):
        if not died:
            process.kill()
            died.append(time.monotonic())

    with pytest.raises(trueaxis.TrueaxisError, match=f"scheduler at `{address}` does not answer any more"):
        trueaxis.apply(folder, mount, ERRORS, tmp_path / "out", client=address, progress=kill)
    assert time.monotonic() - died[0] < 60 and not list(tmp_path.iterdir())
