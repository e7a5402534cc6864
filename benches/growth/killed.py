#!/usr/bin/env python3
"""A large job killed at random times and started again: what is written is whole, or absent.

    cargo build --release --bin trueaxis
    python3 benches/growth/killed.py target/release/trueaxis [COMMAND [TURNS [ROWS]]]

A chain of 14 joints and 64 errors, measured in three files with 200 groups. One run goes through and says what whole is. Each turn starts the
run anew in what the turns before left, and kills it, as no handler of a signal sees: half of the turns anywhere in the time that the whole run
took, half of them while files are being written. Behind every kill each file of the result is whole or absent. The last run goes through: its
files are those of the first, and nothing half-written is left. COMMAND is `eval` or `calibrate`; without one both are tried.

The whole catalogue would be 4,686 functions, for which a study has to allow 8 GiB; the search here is for two effects.
"""

import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import chains

JOINTS, ERRORS, GROUPS, FILES = 14, 64, 200, 3
STUDY = """chain = "arm.chain"
observable = "tip"
data = ["part-0.csv", "part-1.csv", "part-2.csv"]
[observed]
kind = "point"
[noise]
group = "session"
[search]
effects = ["encoder eccentricity of q1", "encoder eccentricity of q7"]
[hold_out]
folds = 3
"""


def arm():
    """The chain of 14 joints, with its first 64 errors."""
    lines, left = chains.joints(JOINTS).split("\n"), ERRORS
    for j in range(JOINTS):
        share = left // (JOINTS - j)
        left -= share
        before, errors = lines[j + 1].split("motion_error: ")
        errors, behind = errors.split("; position")
        lines[j + 1] = before + "motion_error: " + ", ".join(errors.split(", ")[:share]) + "; position" + behind
    return "\n".join(line for line in lines if "observe way" not in line)


def data(trueaxis, rows, folder):
    (folder / "arm.chain").write_text(arm())
    (folder / "study.toml").write_text(STUDY)
    (folder / "errors.toml").write_text('"a*" = "3 arcsec"\n"b*" = "-2 arcsec"\n"c*" = "1 arcsec"\n"u*" = "0.01 mm"\n"v*" = "-0.02 mm"\n')
    command = [trueaxis, "simulate", "arm.chain", "--observable", "tip", "--errors", "errors.toml", "--noise", "0.05 mm", "--seed", "1"]
    subprocess.run([*command, "--poses", str(rows), "--out", "all.csv"], cwd=folder, check=True)
    with open(folder / "all.csv") as table:
        header = next(table).rstrip("\n")
        parts = [open(folder / f"part-{at}.csv", "w") for at in range(FILES)]
        for part in parts:
            part.write(f"{header},session\n")
        for row, line in enumerate(table):
            line = line.rstrip("\n")
            parts[row * FILES // rows].write(f"{line},s{row * GROUPS // rows}\n")
        for part in parts:
            part.close()


def content(place):
    """Each file that is there, by its name."""
    if place.is_dir():
        return {path.name: path.read_bytes() for path in place.iterdir()}
    return {place.name: place.read_bytes()} if place.exists() else {}


def run(command, folder):
    began = time.monotonic()
    done = subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode not in (0, 1):
        sys.exit(f"exit code {done.returncode}: {done.stderr}")
    return time.monotonic() - began


def wait_for_writing(running, folder, until):
    """Until something is being written, or the time is over."""
    while running.poll() is None and time.monotonic() < until:
        if any(path.name.endswith(".partial") for path in folder.iterdir()):
            return
        time.sleep(0.002)


def job(what, command, folder, turns, chance):
    place = folder / command[-1]
    took = run(command, folder)
    whole, last = content(place), command[-1]
    names = {path.name for path in folder.iterdir()}
    shutil.rmtree(place) if place.is_dir() else place.unlink()
    killed = writing = absent = complete = 0
    for turn in range(turns):
        running = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if turn % 2:
            wait_for_writing(running, folder, time.monotonic() + 3 * took)
            time.sleep(chance.uniform(0, 0.3))
        else:
            time.sleep(chance.uniform(0, took))
        running.kill()
        killed += running.wait() < 0
        writing += any(path.name.endswith(".partial") for path in folder.iterdir())
        found = content(place)
        for name, text in found.items():
            if text != whole.get(name):
                sys.exit(f"{what}, turn {turn}: {last}/{name} is neither whole nor absent")
        absent += not found
        complete += found == whole
        if found and turn % 4 == 3:
            shutil.rmtree(place) if place.is_dir() else place.unlink()
    run(command, folder)
    if content(place) != whole or {path.name for path in folder.iterdir()} != names:
        sys.exit(f"{what}: the run behind all kills left something else")
    print(f"{what}: {took:.0f} s a run; {turns} turns, {killed} killed, {writing} of them while it wrote; behind them the result was {absent} times absent and {complete} times whole", flush=True)


def main():
    trueaxis = str(Path(sys.argv[1]).resolve())
    wanted = sys.argv[2:3] or ["eval", "calibrate"]
    turns = int(sys.argv[3]) if len(sys.argv) > 3 else 50
    rows = int(sys.argv[4]) if len(sys.argv) > 4 else 1_000_000
    evaluate = ["arm.chain", "--errors", "errors.toml", "--observable", "tip", "--data", "all.csv", "--out", "evaluated.csv"]
    commands = {"eval": evaluate, "calibrate": ["study.toml", "--out", "result"]}
    for what in wanted:
        with tempfile.TemporaryDirectory() as folder:
            folder, chance = Path(folder), random.Random(1)
            data(trueaxis, rows, folder)
            job(f"{what}, {rows:,} rows", [trueaxis, what, *commands[what]], folder, turns, chance)


if __name__ == "__main__":
    main()
