#!/usr/bin/env python3
"""Time and memory of commands against rows, errors, joints and effects, with the law by which they grow.

    cargo build --release --workspace --bin trueaxis --features trueaxis-cli/parquet
    python3 benches/growth/costs.py target/release/trueaxis              all four, into the page "What it costs"
    python3 benches/growth/costs.py target/release/trueaxis joints       one of them

Each table of docs/src/calibration/growth.md between its two marks is written anew. Every command has a limit of processor time, and what is beyond it
is said in its row. Processor time is that of all threads and says the same on a busy machine, memory is the most that the process held. The law is the exponent p of
size^p that the processor times of two sizes make.
"""

import math
import os
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import chains
from measure import LIDAR, STUDY

PAGE = Path(__file__).resolve().parents[2] / "docs" / "src" / "calibration" / "growth.md"
LIMIT_S = 300
# Below this nothing can be said of growth: starting takes as long.
SHORT_S = 0.05
# What the instrument has and its declaration lacks: each line stands in the body that follows `upper`.
PLANTED = [
    ("motion:\n            /// Turn of the middle frame.", "motion_error: Rx(p1*cos(beta)), Rx(p2*sin(beta));\n        "),
    ("motion:\n            /// Turn of the outer frame.", "motion_error: Rz(p3*cos(alpha)), Rz(p4*sin(alpha));\n        "),
]


def limit():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT_S, LIMIT_S))


def measured(command, folder):
    """Seconds of all processors and MB, or why there are none."""
    with tempfile.TemporaryFile() as errors:
        words = [str(part) for part in command]
        process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=errors, preexec_fn=limit)
        _, status, used = os.wait4(process.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        if code in (-signal.SIGXCPU, -signal.SIGKILL):
            return f"over {LIMIT_S} s"
        if code not in (0, 1):
            errors.seek(0)
            return errors.read().decode().strip().splitlines()[-1]
        return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def table(size_of, jobs, folder):
    """Lines of a table: jobs are a name and its commands by size."""
    lines = [f"| what | {size_of} | processor time | memory at most | grows as |", "|---|---|---|---|---|"]
    for name, commands in jobs:
        before = None
        for size, command in commands:
            found = measured(command, folder)
            if isinstance(found, str):
                lines.append(f"| {name} | {size:,} | {found} | | |")
                break
            processor, memory = found
            law = ""
            if before and size > before[0] > 0 and before[1] > SHORT_S:
                law = f"{size_of}^{math.log(processor / before[1]) / math.log(size / before[0]):.1f}"
            lines.append(f"| {name} | {size:,} | {processor:.2f} s | {memory:.0f} MB | {law} |")
            print(lines[-1], flush=True)
            before = (size, processor)
    return lines


def of_rows(trueaxis, folder):
    chain, errors = LIDAR / "mobile-lidar.chain", LIDAR / "errors.toml"
    over = [chain, "--errors", errors, "--observable", "pointing"]
    (folder / "mobile-lidar.chain").write_text(chain.read_text())
    sizes = (10_000, 100_000, 1_000_000)
    for rows in sizes:
        simulate(trueaxis, chain, errors, rows, folder / f"{rows}.csv")
        (folder / f"{rows}.toml").write_text(STUDY.replace("measured.csv", f"{rows}.csv"))
    by_rows = lambda command: [(rows, command(rows)) for rows in sizes]
    return table("rows", [
        ("`eval`", by_rows(lambda rows: [trueaxis, "eval", *over, "--data", f"{rows}.csv", "--out", "out.csv"])),
        ("`apply`", by_rows(lambda rows: [trueaxis, "apply", *over, "--data", f"{rows}.csv", "--out", "out.csv"])),
        ("`calibrate`", by_rows(lambda rows: [trueaxis, "calibrate", f"{rows}.toml", "--out", f"result-{rows}"])),
    ], folder)


def of_errors(trueaxis, folder):
    sizes = (100, 1_000, 10_000)
    (folder / "sizes.toml").write_text(chains.sizes("r", "t"))
    for count in sizes:
        (folder / f"{count}.chain").write_text(chains.errors(count))
    by_errors = lambda command: [(count, command(f"{count}.chain")) for count in sizes]
    return table("errors", [
        ("`derive`", by_errors(lambda chain: [trueaxis, "derive", chain])),
        ("`bound`", by_errors(lambda chain: [trueaxis, "bound", chain, "--sizes", "sizes.toml"])),
        ("`budget`", by_errors(lambda chain: [trueaxis, "budget", chain, "--sizes", "sizes.toml"])),
        ("`generate`", by_errors(lambda chain: [trueaxis, "generate", chain, "--language", "rust", "--out", "out.rs"])),
        ("`identify`", by_errors(lambda chain: [trueaxis, "identify", chain])),
    ], folder)


def of_joints(trueaxis, folder):
    sizes = (3, 6, 10, 14)
    (folder / "sizes.toml").write_text(chains.sizes("abc", "uvw"))
    for count in sizes:
        (folder / f"{count}.chain").write_text(chains.joints(count))
    by_joints = lambda command: [(count, command(f"{count}.chain")) for count in sizes]
    return table("joints", [
        ("`derive`", by_joints(lambda chain: [trueaxis, "derive", chain])),
        ("`bound`", by_joints(lambda chain: [trueaxis, "bound", chain, "--sizes", "sizes.toml"])),
        ("`budget`", by_joints(lambda chain: [trueaxis, "budget", chain, "--sizes", "sizes.toml"])),
        ("`generate`", by_joints(lambda chain: [trueaxis, "generate", chain, "--language", "rust", "--out", "out.rs"])),
        ("`identify`", by_joints(lambda chain: [trueaxis, "identify", chain])),
    ], folder)


def of_effects(trueaxis, folder):
    declared = (LIDAR / "mobile-lidar.chain").read_text()
    (folder / "mobile-lidar.chain").write_text(declared)
    runs = []
    for count in range(len(PLANTED) + 1):
        truth, errors = declared, (LIDAR / "errors.toml").read_text()
        for number, (before, line) in enumerate(PLANTED[:count]):
            assert truth.count(before) == 1
            truth = truth.replace(before, line + before)
            errors += f'p{2 * number + 1} = "20 arcsec"\np{2 * number + 2} = "-15 arcsec"\n'
        (folder / "truth.chain").write_text(truth)
        (folder / "errors.toml").write_text(errors)
        simulate(trueaxis, folder / "truth.chain", folder / "errors.toml", 10_000, folder / f"{count}.csv")
        (folder / f"{count}.toml").write_text(STUDY.replace("measured.csv", f"{count}.csv"))
        runs.append((count, [trueaxis, "calibrate", f"{count}.toml", "--out", f"result-{count}"]))
    return table("effects", [("`calibrate`, 10,000 rows", runs)], folder)


def simulate(trueaxis, chain, errors, rows, out):
    command = [trueaxis, "simulate", chain, "--errors", errors, "--poses", rows, "--noise", "2 arcsec", "--seed", 1]
    subprocess.run([str(part) for part in [*command, "--observable", "pointing", "--out", out]], check=True)


def write(what, lines):
    begin, end = f"<!-- measured: {what} -->", f"<!-- end of {what} -->"
    before, rest = PAGE.read_text().split(begin)
    _, after = rest.split(end)
    PAGE.write_text(before + "\n".join([begin, "", *lines, "", end]) + after)


def main():
    trueaxis = Path(sys.argv[1]).resolve()
    tables = {"rows": of_rows, "errors": of_errors, "joints": of_joints, "effects": of_effects}
    for what in sys.argv[2:] or tables:
        with tempfile.TemporaryDirectory() as folder:
            write(what, tables[what](trueaxis, Path(folder)))


if __name__ == "__main__":
    main()
