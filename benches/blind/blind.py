#!/usr/bin/env python3
"""Blind trials of the whole command: coverage of its ±, false acceptances, held-out figure over new data.

    cargo build --release --bin trueaxis
    python3 benches/blind/blind.py --runs 100 [--only "few rows"] > table.md

Each trial simulates an instrument with `simulate.py`, which shares no code with the project, calibrates it with the command, and
compares what the report says with the truth. Intervals are of 95 % (Wilson).
"""
import argparse
import concurrent.futures
import csv
import json
import math
import pathlib
import random
import subprocess
import tempfile

from simulate import AltAzimuth, Arm, Scanner, measured, poses, serial

# Rows of the same instrument that no calibration sees; along a trajectory as many as were calibrated.
NEW = 1000
ROOT = pathlib.Path(__file__).resolve().parents[2]


def student(p, dof):
    """The quantile of Student's t by bisection on its distribution (incomplete beta by a continued fraction)."""
    if not dof or dof > 1e6:
        return 1.959964
    def cdf(t):
        x = dof / (dof + t * t)
        a, b = dof / 2, 0.5
        front = math.exp(a * math.log(x) + b * math.log(1 - x) + math.lgamma(a + b) - math.lgamma(a) - math.lgamma(b)) if 0 < x < 1 else 0
        flip = x > (a + 1) / (a + b + 2)
        if flip:
            a, b, x = b, a, 1 - x
        f = c = 1.0
        d = 0.0
        for i in range(400):
            m = i // 2
            n = 1.0 if i == 0 else (m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)) if i % 2 == 0
                                    else -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)))
            d = 1 / max(1 + n * d, 1e-300)
            c = 1 + n / c
            f *= c * d
            if abs(1 - c * d) < 1e-13:
                break
        part = front * (f - 1) / a
        if flip:
            part = 1 - part
        return 1 - part / 2
    low, high = 0.0, 1e4
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if cdf(middle) < p else (low, middle)
    return low


def written(path, names, where, data, session=None):
    """A table of joints and the observable's components; with sessions, of those too."""
    with open(path, "w") as file:
        file.write(",".join([*names, "x", "y", "z"] + (["night"] if session else [])) + "\n")
        for row, (q, v) in enumerate(zip(where, data)):
            night = [f"n{session[row]}"] if session else []
            file.write(",".join([repr(q[j]) for j in names] + [repr(c) for c in v] + night) + "\n")


def study(instrument, chain="i.chain", more=()):
    """The text of a study of a table, which says nothing but which column is which, and what `more` says."""
    unit_of = lambda j: "m" if j == "range" else "rad"
    told = (lambda c: f'{c} = {{ column = "{c}", unit = "m" }}') if instrument.point else (lambda c: f'{c} = "{c}"')
    lines = [f'chain = "{chain}"', 'observable = "observed"', 'data = "d.csv"', "[columns]"]
    lines += [f'{j} = {{ column = "{j}", unit = "{unit_of(j)}" }}' for j in instrument.joints]
    lines += ["[observed]", f'kind = "{"point" if instrument.point else "direction"}"'] + [told(c) for c in "xyz"]
    return "\n".join([*lines, *more]) + "\n"


def calibrated(cell, where, data, session, noise=(), new=None):
    """What the command reports of these data; with new ones, also the RMS that its amended chain leaves in them."""
    instrument = cell["instrument"]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "i.chain").write_text(instrument.chain)
        names = instrument.joints
        written(folder / "d.csv", names, where, data, session)
        more = ["[noise]", *noise] if noise else []
        if cell.get("functions") is not None:
            more += ["[search]", f"functions = {str(cell['functions']).lower()}"]
        (folder / "s.toml").write_text(study(instrument, more=more))
        run = subprocess.run([cell["command"], "calibrate", "s.toml", "--out", "result", "--format", "json"], cwd=folder, capture_output=True, text=True)
        if run.returncode not in (0, 1):
            return {"failed": run.stderr.strip()[-300:]}
        try:
            report = json.loads(run.stdout)
        except json.JSONDecodeError:
            return {"failed": run.stdout[:200] + run.stderr[-200:]}
        if new and run.returncode == 0:
            report["new_rms"] = left_in(cell["command"], folder, names, *new)
        return report


def left_in(command, folder, names, where, data):
    """The RMS over rows of what the amended chain leaves, length of the difference of vectors."""
    written(folder / "new.csv", names, where, data)
    run = subprocess.run([command, "eval", "result/amended.chain", "--errors", "result/errors.toml", "--observable", "observed",
                          "--quantity", "value", "--data", "new.csv", "--out", "told.csv"], cwd=folder, capture_output=True, text=True)
    if run.returncode != 0:
        raise RuntimeError(run.stderr)
    with open(folder / "told.csv") as file:
        rows = list(csv.DictReader(file))
    square = sum((float(row[f"observed_{c}"]) - v) ** 2 for row, value in zip(rows, data) for c, v in zip("xyz", value))
    return math.sqrt(square / len(data))


def trial(cell, seed):
    rng = random.Random(f"{cell['name']} {seed}")
    instrument, rows = cell["instrument"], cell["rows"]
    size = cell.get("size", 1.0)
    e = {name: size * rng.gauss(0, scale) for name, scale in instrument.errors.items()}
    where = poses(instrument, rows, cell.get("trajectory", False), rng)
    # Targets observed in rounds, each aimed at anew, and each off by as much as the noise of a row.
    places = cell.get("places")
    if places:
        aimed = lambda joint, q: q if joint == "range" else q + rng.gauss(0, cell.get("aimed", 0.0))
        where = [{joint: aimed(joint, q) for joint, q in where[row % places].items()} for row in range(rows)]
    columns = [serial(cell["noise"], rows, rng) for _ in range(3)]
    sessions = cell.get("sessions")
    session = [row * (sessions or 1) // rows for row in range(rows)]
    # Levelled anew: each session has tilts of its own, so many times the noise of a row.
    levelled = [{name: rng.gauss(0, cell.get("levelled", 0.0) * instrument.noise) for name in ("tilt_x", "tilt_y")}
                for _ in range(sessions or 1)]
    shared = 0.0 if "levelled" in cell else 1.0
    own = lambda row: {name: value + levelled[session[row]].get(name, 0.0) for name, value in e.items()}
    shifts = [(of_row, [[rng.gauss(0, shared) for _ in range(3)] for _ in range(count)])
              for count, of_row in ((sessions, session), (places, [row % (places or 1) for row in range(rows)])) if count]
    if sessions and not places:
        for row, q in enumerate(where):
            # Each session in a band of the first joint of its own.
            low, high = instrument.ranges[instrument.joints[0]]
            q[instrument.joints[0]] = low + (high - low) * (session[row] + rng.random()) / sessions
    unit = [[instrument.noise * (columns[k][row] + sum(shift[of_row[row]][k] for of_row, shift in shifts)) for k in range(3)] for row in range(rows)]
    data = [measured(instrument, own(row), q, n, cell.get("in_space", False)) for row, (q, n) in enumerate(zip(where, unit))]
    noise = []
    if sessions and cell.get("declared", True):
        noise.append('group = ["night"]')
    if cell.get("stated"):
        noise.append(f'sigma = "{instrument.noise!r} {"m" if instrument.point else "rad"}"')
    def as_new():
        """Other rows of the same instrument, with noise of the same kind."""
        count = rows if cell.get("trajectory") else NEW
        poses_of_new = poses(instrument, count, cell.get("trajectory", False), rng)
        noise_of_new = [serial(cell["noise"], count, rng) for _ in range(3)]
        unit = [[instrument.noise * column[row] for column in noise_of_new] for row in range(count)]
        return poses_of_new, [measured(instrument, e, q, n, cell.get("in_space", False)) for q, n in zip(poses_of_new, unit)]
    # Sessions and targets have offsets of their own: what is new there is a question by itself.
    labels = session if cell.get("labelled", True) else None
    report = calibrated(cell, where, data, labels, noise, None if sessions or places else as_new())
    if "failed" in report:
        return report
    noise = report["noise"]
    result = {"verdict": report["verdict"], "found": len(report["effects"]), "names": [effect["names"] for effect in report["effects"]], "inside": 0, "of": 0,
              "remembers": noise["serial"] is not None or noise["undeclared_order"], "ratio": None}
    held_out = (report["after"] or {}).get("held_out_rms")
    if held_out and report.get("new_rms"):
        result["ratio"] = held_out / report["new_rms"]
    for entry in report["errors"]:
        sigma = entry.get("standard_uncertainty")
        if not entry.get("separable") or entry.get("shown") is False or entry["name"] not in e or not sigma:
            continue
        wide = student(0.975, entry.get("degrees_of_freedom")) * sigma
        result["of"] += 1
        result["inside"] += abs(entry["value"] - e[entry["name"]]) <= wide
    return result


def wilson(k, n):
    if n == 0:
        return "–"
    z, p = 1.96, k / n
    middle = (p + z * z / 2 / n) / (1 + z * z / n)
    half = z * math.sqrt(p * (1 - p) / n + z * z / 4 / n / n) / (1 + z * z / n)
    return f"{p:.3f} ({max(0.0, middle - half):.3f} to {min(1.0, middle + half):.3f})"


def middle(ratios):
    if not ratios:
        return "–"
    ratios = sorted(ratios)
    at = lambda share: ratios[min(int(share * len(ratios)), len(ratios) - 1)]
    return f"{at(0.5):.3f}, {at(0.05):.2f} to {at(0.95):.2f}"


def cells(command):
    mount, directions, targets, arm = AltAzimuth(), Scanner(False), Scanner(True), Arm()
    out = []
    def add(group, instrument, rows, noise, **more):
        words = ", ".join([f"N = {rows}", noise] + [f"{k} {v}" if v is not True else k for k, v in more.items()])
        out.append({"name": f"{group}: {instrument.name}, {words}", "instrument": instrument, "rows": rows, "noise": noise, "command": command, **more})
    for rows in (5, 6, 8, 10, 15):
        add("few rows", mount, rows, "independent")
    for rows in (6, 8, 12):
        add("few rows", arm, rows, "independent")
    for rows in (8, 12, 20):
        add("few rows", targets, rows, "independent")
    for instrument in (mount, directions, targets, arm):
        add("independent", instrument, 200, "independent")
    add("large errors", targets, 200, "independent", size=20.0)
    for instrument in (mount, directions):
        add("no memory", instrument, 300, "independent", trajectory=True)
    for noise in ("AR(0.5)", "AR(0.9)", "walk"):
        add("undeclared memory", mount, 300, noise, trajectory=True)
        add("undeclared memory", directions, 300, noise, trajectory=True)
    for noise in ("AR(0.5)", "AR(0.9)", "walk"):
        add("memory of the ground", directions, 300, noise, trajectory=True, in_space=True)
    for noise in ("t3", "outliers"):
        add("uneven", mount, 200, noise)
    for instrument in (mount, directions):
        add("rounds", instrument, 300, "independent", places=60)
        add("rounds", instrument, 300, "independent", places=60, aimed=0.003)
    for sessions in (6, 12, 60):
        add("sessions", mount, 300, "independent", sessions=sessions)
    for more in ({"levelled": 3.0}, {"levelled": 3.0, "labelled": False}, {}):
        for sessions in (6, 12):
            add("sessions that nobody declared", mount, 300, "independent", sessions=sessions, declared=False, **more)
    for instrument in (mount, directions):
        # Every target in every session.
        add("crossed", instrument, 300, "independent", sessions=6, places=50)
        add("crossed", instrument, 300, "independent", sessions=12, places=25)
    return out


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=50)
    parser.add_argument("--only", default="")
    parser.add_argument("--seed", type=int, default=0, help="the seed of the first run; seeds below 1000 were used in development")
    parser.add_argument("--each", action="store_true", help="print each run that accepts an effect")
    parser.add_argument("--functions", choices=["true", "false"])
    parser.add_argument("--command", default=str(ROOT / "target/release/trueaxis"))
    arguments = parser.parse_args()
    print("| design | 95 % intervals that hold the truth | an effect accepted, none there | held-out figure over that of new rows: median, middle 90 % | verdicts |\n|---|---|---|---|---|")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for cell in cells(arguments.command):
            if arguments.only not in cell["name"]:
                continue
            if arguments.functions:
                cell["functions"] = arguments.functions == "true"
            results = list(pool.map(lambda seed: trial(cell, seed), range(arguments.seed, arguments.seed + arguments.runs)))
            for seed, r in enumerate(results, arguments.seed):
                if arguments.each and r.get("found"):
                    print(f"<!-- {seed}: {r['verdict']}: {r['names']} -->", flush=True)
            good = [r for r in results if "failed" not in r]
            verdicts = {}
            for r in results:
                key = r.get("verdict") or f"error: {r['failed'].splitlines()[0][:60] if r['failed'] else '?'}"
                verdicts[key] = verdicts.get(key, 0) + 1
            remembers = sum(r["remembers"] for r in good)
            if remembers:
                verdicts["(memory told)"] = remembers
            print(f"| {cell['name']} | {wilson(sum(r['inside'] for r in good), sum(r['of'] for r in good))} | "
                  f"{wilson(sum(r['found'] > 0 for r in good), len(good))} | "
                  f"{middle([r['ratio'] for r in good if r['ratio']])} | "
                  f"{', '.join(f'{k} {v}' for k, v in sorted(verdicts.items(), key=lambda p: -p[1]))} |", flush=True)


if __name__ == "__main__":
    main()
