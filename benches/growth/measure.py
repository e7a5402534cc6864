"""Time and memory of commands, and of the Python package's fit, as rows grow.

    cargo build --release --bin trueaxis --features parquet
    python3 benches/growth/measure.py target/release/trueaxis 100000 1000000

Writes a row of the table in docs/src/calibration/growth.md for each size and job. Processor time is that of all threads, and says
the same on a busy machine; memory is the most that the process held. Every file lies in a folder of its own that is removed.
The fit of many files is measured where the package `trueaxis` is installed.
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LIDAR = Path(__file__).resolve().parents[2] / "examples" / "mobile-lidar"
STUDY = """
chain = "mobile-lidar.chain"
observable = "pointing"
data = "measured.csv"
[observed]
kind = "direction"
x = "pointing_x"
y = "pointing_y"
z = "pointing_z"
[hold_out]
folds = 10
seed = 1
"""
FIT = """
import sys, trueaxis
found = trueaxis.fit(sys.argv[1], sys.argv[2])
assert found.converged and found.rows == int(sys.argv[3]), found
print(found.passes, file=sys.stderr)
"""
SPLIT = """
import sys
import pyarrow.csv as csv, pyarrow.parquet as parquet
table, files = csv.read_csv(sys.argv[1]), int(sys.argv[3])
for at in range(files):
    rows = table.num_rows // files
    parquet.write_table(table.slice(at * rows, rows), f"{sys.argv[2]}/part-{at:03}.parquet")
"""


def measured(what, rows, command, folder, may_fail=False):
    """Runs a command and prints what it took; whether it was done, where it may fail."""
    began = time.monotonic()
    process = subprocess.Popen([str(part) for part in command], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    clock, processor = time.monotonic() - began, used.ru_utime + used.ru_stime
    if os.waitstatus_to_exitcode(status) != 0:
        if may_fail:
            return False
        sys.exit(f"{what}, {rows} rows: exit code {os.waitstatus_to_exitcode(status)}: {command}")
    memory = used.ru_maxrss / 1024
    print(f"| {rows:,} | {what} | {processor:.2f} s | {clock:.2f} s | {memory:.0f} MB |", flush=True)
    return True


def main():
    trueaxis, sizes = Path(sys.argv[1]).resolve(), [int(size) for size in sys.argv[2:]]
    chain, errors = LIDAR / "mobile-lidar.chain", LIDAR / "errors.toml"
    has_package = importlib.util.find_spec("trueaxis") is not None
    for rows in sizes:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "mobile-lidar.chain").write_text(chain.read_text())
            (folder / "study.toml").write_text(STUDY)
            data = folder / "measured.csv"
            simulate = [trueaxis, "simulate", chain, "--errors", errors, "--poses", rows, "--noise", "2 arcsec", "--seed", 1]
            subprocess.run([str(part) for part in [*simulate, "--observable", "pointing", "--out", data]], check=True)
            over = [chain, "--errors", errors, "--observable", "pointing"]
            evaluate = lambda source, out: [trueaxis, "eval", *over, "--data", source, "--out", out]
            measured("eval, CSV to CSV", rows, evaluate(data, "out.csv"), folder)
            # A build without Parquet refuses.
            if measured("eval, CSV to Parquet", rows, evaluate(data, "in.parquet"), folder, may_fail=True):
                measured("eval, Parquet to Parquet", rows, evaluate("in.parquet", "out.parquet"), folder)
                measured("apply, Parquet to Parquet", rows, [trueaxis, "apply", *over, "--data", "in.parquet", "--out", "a.parquet"], folder)
            if has_package:
                (folder / "parts").mkdir()
                subprocess.run([sys.executable, "-c", SPLIT, data, folder / "parts", "16"], check=True)
                measured("fit, 16 Parquet files", rows, [sys.executable, "-c", FIT, "study.toml", "parts", rows // 16 * 16], folder)
            measured("calibrate, whole loop, ten folds", rows, [trueaxis, "calibrate", "study.toml", "--out", "result"], folder)


if __name__ == "__main__":
    main()
