#!/usr/bin/env python3
"""Blind trials with stations and objects that nobody knows: false alarms, and how often a planted effect is found.

    cargo build --release --bin trueaxis
    python3 benches/blind/objects.py --runs 100 [--only walls] > table.md

Each run draws a scanner's errors, its stations and the room, simulates it with one effect or none by the exact form below, which
shares no code with the project, and calibrates it with the whole command. NumPy alone is needed. Intervals are of 95 % (Wilson).
"""
import argparse
import json
import math
import pathlib
import subprocess
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
ARCSEC = math.pi / 648_000
RANGE_NOISE, ANGLE_NOISE = 0.5e-3, 8 * ARCSEC
# What is planted, how large, and what the catalogue calls it.
EFFECTS = {
    "nothing": (0.0, None),
    "circle off centre, 200 µrad": (200e-6, "encoder eccentricity of azimuth"),
    "sag, 200 µrad": (200e-6, "gravity flexure of mirror about x"),
    "range scale, 1e-3": (1e-3, "range scale"),
}


def about(axis, angle):
    """Rotations by angles, n × 3 × 3."""
    angle = np.asarray(angle, float)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn = np.zeros(angle.shape + (3, 3))
    turn[..., axis, axis] = 1
    turn[..., i, i] = turn[..., j, j] = np.cos(angle)
    turn[..., i, j], turn[..., j, i] = -np.sin(angle), np.sin(angle)
    return turn


def applied(turn, points):
    return np.einsum("...ij,...j->...i", turn, points)


class Scanner:
    """A scanner of two axes with errors of its own, and one effect."""

    def __init__(self, random, effect):
        self.errors = [*(random.normal(0, 1e-3, 3)), *(random.normal(0, 30 * ARCSEC, 3))]
        self.effect, self.size = effect, EFFECTS[effect][0]
        self.phase = random.uniform(-math.pi, math.pi)

    def point(self, azimuth, elevation, distance):
        """Where the beam ends in the scanner's own frame."""
        apart, aside, zero, trunnion, index, collimation = self.errors
        turned, tipped = azimuth, elevation + index
        if self.effect.startswith("circle"):
            turned = azimuth + self.size * np.sin(azimuth - self.phase)
        if self.effect.startswith("sag"):
            tipped = tipped + self.size * np.cos(elevation)
        if self.effect.startswith("range"):
            distance = distance * (1 + self.size)
        p = np.stack([np.zeros_like(distance), distance + zero, np.zeros_like(distance)], -1)
        p = applied(about(2, collimation), p) + [aside, 0, 0]
        p = applied(about(0, tipped), p)
        p = applied(about(1, trunnion), p) + [0, apart, 0]
        return applied(about(2, -turned), p)


def stations(random):
    """Four places in a room, with headings, about level; as label → (turn, shift, numbers)."""
    placed = {}
    for label, middle in zip("ABCD", ((0, 0, 1.6), (4.2, -1.1, 1.5), (1, 3.9, 1.7), (-3.1, 1.7, 0.9))):
        shift = np.array(middle) + random.normal(0, 0.3, 3)
        heading, pitch, roll = random.uniform(-math.pi, math.pi), *random.normal(0, 0.002, 2)
        placed[label] = (about(2, heading) @ about(1, pitch) @ about(0, roll), shift, (*shift, roll, pitch, heading))
    return placed


WALLS = {
    "floor": ((0, 0, 1), 0), "ceiling": ((0.01, 0, -1), -3.4), "north": ((0, -1, 0), -7), "south": ((0.02, 1, 0), -5.5),
    "east": ((-1, 0.03, 0), -8), "west": ((1, 0, 0.02), -6.5), "board": ((-0.6, -0.7, 0.3), -4.1), "roof": ((0.5, -0.2, -0.8), -4.6),
}  # fmt: skip


def walls(random, scanner, placed, rows):
    for label, (turn, shift, _) in placed.items():
        azimuth, elevation = random.uniform(-math.pi, math.pi, rows), random.uniform(-0.9, 1.3, rows)
        other = random.random(rows) < 0.5
        azimuth = np.where(other, azimuth - np.sign(azimuth) * math.pi, azimuth)
        elevation = np.where(other, math.pi - elevation, elevation)
        # The point is a straight line of the distance.
        near = applied(turn, scanner.point(azimuth, elevation, np.zeros(rows))) + shift
        far = applied(turn, scanner.point(azimuth, elevation, np.ones(rows))) + shift
        best, name = np.full(rows, np.inf), np.empty(rows, object)
        for wall, (normal, distance) in WALLS.items():
            n = np.array(normal) / np.linalg.norm(normal)
            along = (distance / np.linalg.norm(normal) - near @ n) / ((far - near) @ n)
            hit = (along > 0.3) & (along < best)
            best[hit], name[hit] = along[hit], wall
        yield from zip([label] * rows, name, azimuth, elevation, best)


def targets(random, scanner, placed, rows):
    there = np.stack([random.uniform(-7, 8, rows // 2), random.uniform(-5, 7, rows // 2), random.uniform(0, 3.4, rows // 2)], -1)
    for label, (turn, shift, _) in placed.items():
        local = applied(turn.T, there - shift)
        length = np.linalg.norm(local, axis=1)
        for face in range(2):
            q = np.stack([np.arctan2(local[:, 0], local[:, 1]), np.arcsin(local[:, 2] / length), length])
            if face:
                q[0], q[1] = q[0] - np.where(q[0] > 0, math.pi, -math.pi), math.pi - q[1]
            for _ in range(8):
                steps = 1e-6 * np.eye(3)[:, :, None]
                columns = np.stack([(scanner.point(*(q + s)) - scanner.point(*(q - s))) / 2e-6 for s in steps], -1)
                q = q + np.linalg.solve(columns, (local - scanner.point(*q))[..., None])[..., 0].T
            yield from zip([label] * (rows // 2), [f"T{at}" for at in range(rows // 2)], *q)


def study(kind, placed, known, scale):
    text = 'chain = "scanner.chain"\ndata = "data.csv"\n[observed]\n'
    text += f'kind = "{"plane" if kind == "walls" else "target"}"\nobject = "object"\nstation = "station"\n[stations]\n'
    for label, (_, _, numbers) in placed.items():
        units = zip(("x", "y", "z", "roll", "pitch", "heading"), numbers, ["m"] * 3 + ["rad"] * 3)
        cells = ", ".join(f'{name} = "{value:.9f} {unit}"' for name, value, unit in units)
        text += f"{label} = {{ {cells}{'' if known else ', rough = true'} }}\n"
    return text + ('[fit]\ntolerance = { longer = "0.1" }\n' if scale else "")


def calibrated(command, random, kind, effect, rows, known=False, scale=False):
    scanner, placed = Scanner(random, effect), stations(random)
    table = "station,object,azimuth [rad],elevation [rad],range [m]\n"
    for label, name, *readings in {"walls": walls, "targets": targets}[kind](random, scanner, placed, rows):
        noisy = [value + sigma * random.standard_normal() for value, sigma in zip(readings, [ANGLE_NOISE, ANGLE_NOISE, RANGE_NOISE])]
        table += f"{label},{name},{noisy[0]:.9f},{noisy[1]:.9f},{noisy[2]:.6f}\n"
    chain = (ROOT / "examples" / "objects" / "scanner.chain").read_text()
    if scale:
        chain = chain.replace("Ty(range_zero)", "Ty(range_zero), Ty(longer*range)")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scanner.chain").write_text(chain)
        (folder / "data.csv").write_text(table)
        (folder / "study.toml").write_text(study(kind, placed, known, scale))
        asked = [command, "calibrate", "study.toml", "--format", "json", "--dry-run"]
        run = subprocess.run(asked, cwd=folder, capture_output=True, text=True)
    if run.returncode not in (0, 1):
        raise SystemExit(f"{kind}, {effect}: {run.stderr}")
    return scanner, json.loads(run.stdout)


def wilson(hits, runs):
    z, p = 1.96, hits / runs
    middle, half = p + z * z / (2 * runs), z * math.sqrt(p * (1 - p) / runs + z * z / (4 * runs * runs))
    return f"{p:.3f} ({(middle - half) / (1 + z * z / runs):.3f} to {(middle + half) / (1 + z * z / runs):.3f})"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=100)
    parser.add_argument("--rows", type=int, default=150, help="rows from each of four stations")
    parser.add_argument("--only", choices=["walls", "targets"])
    parser.add_argument("--trueaxis", default=str(ROOT / "target" / "release" / "trueaxis"))
    arguments = parser.parse_args()
    command = pathlib.Path(arguments.trueaxis).resolve()
    kinds = [arguments.only] if arguments.only else ["walls", "targets"]
    print("| observed | planted | stations | runs | right | truth in the set | any effect | range zero: mean of (found − planted)/± |")
    print("|---|---|---|---|---|---|---|---|")
    for kind in kinds:
        for effect, (_, name) in EFFECTS.items():
            known = effect.startswith("range")
            right = held = alarms = 0
            pulls = []
            runs = arguments.runs * (3 if effect == "nothing" else 1)
            for run in range(runs):
                random = np.random.default_rng([run, len(kind), list(EFFECTS).index(effect)])
                scanner, report = calibrated(command, random, kind, effect, arguments.rows, known)
                found = report["effects"]
                named = lambda effect: {cause["name"] for cause in effect["causes"]} | set(effect["names"])
                accepted = {cause["name"] for one in found for cause in one["causes"] if cause["relation"] == "accepted"}
                right += name in accepted
                held += any(name in named(one) for one in found)
                alarms += bool(found)
                zero = next(error for error in report["errors"] if error["name"] == "range_zero")
                if zero["standard_uncertainty"]:
                    pulls.append((zero["value"] - scanner.errors[2]) / zero["standard_uncertainty"])
            mean = f"{np.mean(pulls):+.2f} ± {np.std(pulls) / math.sqrt(max(len(pulls), 1)):.2f}" if pulls else ""
            hits = [wilson(right, runs), wilson(held, runs)] if name else ["", ""]
            where = "known" if known else "unknown"
            print(f"| {kind} | {effect} | {where} | {runs} | {hits[0]} | {hits[1]} | {wilson(alarms, runs)} | {mean} |", flush=True)
        shown = 0
        runs = max(arguments.runs // 5, 1)
        for run in range(runs):
            random = np.random.default_rng([run, len(kind), 99])
            _, report = calibrated(command, random, kind, "range scale, 1e-3", arguments.rows, scale=True)
            longer = next(error for error in report["errors"] if error["name"] == "longer")
            shown += (longer["standard_uncertainty"] or math.inf) < 0.09
        print(f"| {kind} | range scale, 1e-3, declared | unknown | {runs} | | | shown in {shown} | |", flush=True)


if __name__ == "__main__":
    main()
