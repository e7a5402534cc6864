#!/usr/bin/env python3
"""Time and memory of `trueaxis.calibrate` over folders of Parquet files as rows grow: a lidar's directions, 30 errors, and an encoder
200 µrad off centre that the declaration lacks; in one process, and with two workers of a Dask cluster on this machine.

    python3 -m venv env && env/bin/pip install './python[cluster]'
    env/bin/python benches/growth/folders.py 1000000 10000000 [--files 64]

Writes a row of the table in docs/src/calibration/growth.md for each size and way. The data are made here with NumPy, by matrices, in a folder that
is removed. Processor time is that of all threads and processes.
"""
import argparse
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

import numpy as np
import pyarrow
import pyarrow.parquet as parquet

from measure import STUDY
from objects import CHAIN, STEPS, seen

NOISE, OFF_CENTRE = 1e-5, 200e-6
JOB = """
import sys, trueaxis
client = sys.argv[3] if len(sys.argv) > 3 else None
found = trueaxis.calibrate("study.toml", "scan", client=client)
every = found.report.get("every_row", {"rows": found.report["observations"]["rows"], "converged": True})
assert every["converged"] and every["rows"] == int(sys.argv[1]), every
print(found.verdict, list(found.effects["driver"]), every, file=sys.stderr)
found.write(sys.argv[2])
"""


def simulate(folder, rows, files):
    random = np.random.default_rng([rows, files])
    # What shifts the lens does not turn its beam.
    errors = {name: random.normal(0, 1e-4) if kind == "R" else 0.0 for kind, _, name in STEPS if name not in ("alpha", "beta", "gamma")}
    for at in range(files):
        angles = random.uniform(-3.1, 3.1, (3, rows // files))
        beam = seen(errors, OFF_CENTRE, *angles, 1.0) + random.normal(0, NOISE, (rows // files, 3))
        beam /= np.linalg.norm(beam, axis=1)[:, None]
        columns = dict(zip(["alpha", "beta", "gamma"], angles)) | {f"pointing_{c}": beam[:, i] for i, c in enumerate("xyz")}
        parquet.write_table(pyarrow.table(columns), folder / f"part-{at:04}.parquet")
    return rows // files * files


def ended(process):
    """Processor seconds and MB of a process that has ended."""
    _, status, used = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def cluster():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
    start = lambda *arguments: subprocess.Popen(
        [sys.executable, "-c", f"from distributed.cli.dask_{arguments[0]} import main; main()", *arguments[1:]],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    scheduler = start("scheduler", "--host", address, "--no-dashboard")
    worker = lambda: start("worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard", "--host", "127.0.0.1")
    return address, [scheduler, worker(), worker()]


def measured(folder, rows, way):
    address, others = cluster() if way == "two workers" else (None, [])
    began = time.monotonic()
    job = subprocess.Popen([sys.executable, "-c", JOB, str(rows), f"out-{len(others)}", *([address] if address else [])], cwd=folder, stdout=subprocess.DEVNULL)
    code, processor, memory = ended(job)
    clock = time.monotonic() - began
    held = [f"{memory:.0f} MB"]
    for other in others:
        other.kill()
        _, more, own = ended(other)
        processor += more
        held.append(f"{own:.0f} MB")
    if code != 0:
        sys.exit(f"{rows} rows, {way}: exit code {code}")
    print(f"| {rows:,} | calibrate, a folder, {way} | {processor:.1f} s | {clock:.1f} s | {', '.join(held)} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("sizes", nargs="+", type=int)
    parser.add_argument("--files", type=int, default=64)
    arguments = parser.parse_args()
    for size in arguments.sizes:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scan").mkdir()
            shutil.copy(CHAIN, folder / "mobile-lidar.chain")
            (folder / "study.toml").write_text(STUDY)
            rows = simulate(folder / "scan", size, arguments.files)
            for way in ["one process", "two workers"]:
                measured(folder, rows, way)
            same = [(folder / out / "errors.toml").read_bytes() for out in ["out-0", "out-3"]]
            if same[0] != same[1]:
                sys.exit(f"{size}: the cluster's errors are others")


if __name__ == "__main__":
    main()
