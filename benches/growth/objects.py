#!/usr/bin/env python3
"""Time and memory of `trueaxis calibrate` as rows and unknown objects grow: a lidar of three axes at targets or facets.

    cargo build --release --bin trueaxis
    python3 benches/growth/objects.py target/release/trueaxis targets 10000x100 100000x1000 [--keep FOLDER] [--plain]

Writes a row of the table in docs/src/calibration/growth.md for each size: rows x objects, from ten stations that nobody knows
better than roughly. The scanner has all of its thirty errors, and an outer circle that sits 200 µrad off centre, which the
declaration lacks (`--plain`: it does not). NumPy alone is needed; what a scanner shows is worked out here, by its matrices.
"""
import argparse
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import time

import numpy as np

CHAIN = pathlib.Path(__file__).resolve().parents[2] / "examples" / "mobile-lidar" / "mobile-lidar.chain"
STATIONS = 10
RANGE_NOISE, ANGLE_NOISE = 0.5e-3, math.radians(8 / 3600)
# The path from the ground to the lens: what turns or shifts, along which axis, by which joint or which error.
PATH = (
    "Ry dtheta_y1, Rx dtheta_x1, Rz alpha, Tx dx1, Ty dy1, Tz dz1, Rx da1, Ry db1,"
    "Tx delta_x2, Ty delta_y2, Ry dtheta_y2, Rz dtheta_z2, Rx beta, Tx dx2, Ty dy2, Tz dz2, Ry db2, Rz dg2,"
    "Ty delta_y3, Ry dtheta_y3, Rx dtheta_x3, Rz gamma, Tx dx3, Ty dy3, Tz dz3, Rx da3, Ry db3,"
    "Tx dx4, Ty dy4, Tz dz4, Rx da4, Ry db4, Rz dg4"
)
STEPS = [(kind[0], "xyz".index(kind[1]), name) for kind, name in (step.split() for step in PATH.split(","))]


def turned(points, axis, angle):
    """Points, n × 3, turned about an axis by an angle or by n of them."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out = points.copy()
    out[:, i] = np.cos(angle) * points[:, i] - np.sin(angle) * points[:, j]
    out[:, j] = np.sin(angle) * points[:, i] + np.cos(angle) * points[:, j]
    return out


def seen(errors, off_centre, alpha, beta, gamma, distance):
    """Where the beam ends, in the scanner's frame."""
    joints = {"alpha": alpha + off_centre * np.sin(alpha - 0.7), "beta": beta, "gamma": gamma}
    points = np.zeros((len(alpha), 3))
    points[:, 2] = distance
    for kind, axis, name in reversed(STEPS):
        amount = joints.get(name, errors.get(name))
        if kind == "T":
            points[:, axis] += amount
        else:
            points = turned(points, axis, amount)
    return points


def readings(random, errors, off_centre, local):
    """Angles and range under which points in the scanner's frame are seen, some in either face."""
    n = len(local)
    gamma = random.uniform(-math.pi, math.pi, n)
    distance = np.linalg.norm(local, axis=1)
    # The beam is Rz(alpha) Rx(beta) (0, 0, 1) but for errors.
    beta = np.arccos(np.clip(local[:, 2] / distance, -1, 1))
    alpha = np.arctan2(local[:, 0], -local[:, 1])
    other = random.random(n) < 0.5
    alpha = np.where(other, alpha - np.where(alpha > 0, math.pi, -math.pi), alpha)
    beta = np.where(other, -beta, beta)
    q = np.stack([alpha, beta, distance])
    at = lambda q: seen(errors, off_centre, q[0], q[1], gamma, q[2])
    for _ in range(6):
        columns = np.stack([(at(q + s) - at(q - s)) / 2e-6 for s in 1e-6 * np.eye(3)[:, :, None]], -1)
        q = q + np.linalg.solve(columns, (local - at(q))[..., None])[..., 0].T
    assert np.abs(local - at(q)).max() < 1e-9
    return q[0], q[1], gamma, q[2]


def simulate(folder, kind, rows, objects, off_centre):
    random = np.random.default_rng([rows, objects, len(kind)])
    names = [name for _, _, name in STEPS if name not in ("alpha", "beta", "gamma")]
    turn = {name for step, _, name in STEPS if step == "R"}
    errors = {name: random.normal(0, 1e-4 if name in turn else 2e-4) for name in names}
    places = np.stack([random.uniform(-20, 20, objects), random.uniform(-20, 20, objects), random.uniform(-2, 8, objects)], -1)
    normals = random.normal(size=(objects, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    stations = [(random.uniform([-8, -8, 0], [8, 8, 3]), random.uniform(-math.pi, math.pi), random.normal(0, 0.003, 2)) for _ in range(STATIONS)]
    repeats = rows // (objects * STATIONS)
    table = ["station,object,alpha [rad],beta [rad],gamma [rad],range [m]\n"]
    study = f'chain = "lidar.chain"\nobservable = "target"\ndata = "data.csv"\n[observed]\nkind = "{kind}"\n'
    study += 'object = "object"\nstation = "station"\n[stations]\n'
    for number, (shift, heading, (pitch, roll)) in enumerate(stations):
        label = f"S{number}"
        study += f'{label} = {{ x = "{shift[0]:.2f} m", y = "{shift[1]:.2f} m", z = "{shift[2]:.2f} m", heading = "{heading:.3f} rad", rough = true }}\n'
        which = np.repeat(np.arange(objects), repeats)
        there = places[which]
        if kind == "plane":
            away = random.normal(0, 0.7, there.shape)
            there = there + away - (away * normals[which]).sum(1)[:, None] * normals[which]
        local = turned(turned(turned(there - shift, 2, -heading), 1, -pitch), 0, -roll)
        a, b, c, r = readings(random, errors, off_centre, local)
        noisy = [angle + ANGLE_NOISE * random.standard_normal(len(a)) for angle in (a, b, c)]
        noisy.append(r + RANGE_NOISE * random.standard_normal(len(a)))
        table += [f"{label},T{w},{i:.8f},{j:.8f},{k:.8f},{l:.5f}\n" for w, i, j, k, l in zip(which, *noisy)]
    (folder / "data.csv").write_text("".join(table))
    (folder / "study.toml").write_text(study)
    shutil.copy(CHAIN, folder / "lidar.chain")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("trueaxis", type=pathlib.Path)
    parser.add_argument("kind", choices=["targets", "planes"])
    parser.add_argument("sizes", nargs="+", help="rows x objects")
    parser.add_argument("--keep", type=pathlib.Path, help="write the data here, and run nothing")
    parser.add_argument("--plain", action="store_true", help="leave nothing out of the declaration")
    arguments = parser.parse_args()
    for size in arguments.sizes:
        rows, objects = (int(part) for part in size.split("x"))
        with tempfile.TemporaryDirectory() as name:
            folder = arguments.keep or pathlib.Path(name)
            folder.mkdir(exist_ok=True)
            simulate(folder, arguments.kind.rstrip("s"), rows, objects, 0.0 if arguments.plain else 200e-6)
            if arguments.keep:
                continue
            began = time.monotonic()
            command = [str(arguments.trueaxis.resolve()), "calibrate", "study.toml", "--dry-run", "--format", "json"]
            with open(folder / "report.json", "w") as report:
                process = subprocess.Popen(command, cwd=folder, stdout=report)
                _, status, used = os.wait4(process.pid, 0)
            clock, processor = time.monotonic() - began, used.ru_utime + used.ru_stime
            if os.waitstatus_to_exitcode(status) not in (0, 1):
                raise SystemExit(f"{size}: exit code {os.waitstatus_to_exitcode(status)}")
            report = json.loads((folder / "report.json").read_text())
            found = ", ".join(cause["name"] for one in report["effects"] for cause in one["causes"] if cause["relation"] == "accepted")
            memory = used.ru_maxrss / 1024
            print(f"| {rows:,} | {objects:,} {arguments.kind} | {processor:.1f} s | {clock:.1f} s | {memory:.0f} MB | {report['verdict']}: {found or 'nothing'} |", flush=True)


if __name__ == "__main__":
    main()
