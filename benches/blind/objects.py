#!/usr/bin/env python3
"""Blind trials with stations and objects that nobody knows: false alarms, coverage of the ±, and how often a planted effect is found.

    cargo build --release --bin trueaxis
    python3 benches/blind/objects.py --runs 100 [--only walls] [--planted sag] > table.md

Each run draws a scanner's errors, its stations and the room, simulates it with one effect or none by the exact form below, which
shares no code with the project, and calibrates it with the whole command. Stations that are unknown are told to 0.1 m and 1°, as
starts; those that are stated, to 1 mm and 20″. A range scale that is declared, with nothing to hold it, is to be refused. Beside each draw a control says what F tests say of it. NumPy alone is needed. Intervals are of 95 % (Wilson).
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from blind import ROOT, student, wilson
from control import smallest_p

ARCSEC = math.pi / 648_000
RANGE_NOISE, ANGLE_NOISE = 0.5e-3, 8 * ARCSEC
# What is known of stations, with how far off what the study says of each is: x, y, z, m; roll, pitch, heading, rad.
STATED_M, STATED_RAD = 1e-3, 20 * ARCSEC
STATIONS = {
    "unknown": [0.1, 0.1, 0.1, 0.002, 0.002, math.radians(1)],
    "known": [0.0] * 6,
    "stated": [STATED_M] * 3 + [STATED_RAD] * 3,
}
# Half a wavelength of the modulation, over which a phase meter's error repeats.
REPEATS = 1.5
# What is planted, how large, and what the catalogue calls it.
EFFECTS = {
    "nothing": (0.0, None),
    "circle off centre, 200 µrad": (200e-6, "encoder eccentricity of azimuth"),
    "sag, 200 µrad": (200e-6, "gravity flexure of mirror about x"),
    "range scale, 1e-3": (1e-3, "range scale"),
    "cyclic error of the range, 0.3 mm": (0.3e-3, "cyclic error of range, once a wavelength"),
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


def phase(distance):
    """Of the modulation, in radians."""
    return 2 * math.pi / REPEATS * distance


class Scanner:
    """A scanner of two axes with errors of its own, and one effect."""

    NAMES = ("axes_apart", "beam_aside", "range_zero", "trunnion", "index", "collimation")

    def __init__(self, random, effect):
        self.errors = [*(random.normal(0, 1e-3, 3)), *(random.normal(0, 30 * ARCSEC, 3))]
        self.effect, self.size = effect, EFFECTS[effect][0]
        self.phase = random.uniform(-math.pi, math.pi)

    def named(self):
        return dict(zip(self.NAMES, self.errors))

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
        if self.effect.startswith("cyclic"):
            distance = distance + self.size * np.sin(phase(distance) - self.phase)
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
        # The point lies on a straight line, along which it moves nearly as the distance does.
        at = lambda distance: applied(turn, scanner.point(azimuth, elevation, distance)) + shift
        near = at(np.zeros(rows))
        far = at(np.ones(rows))
        best, name = np.full(rows, np.inf), np.empty(rows, object)
        for wall, (normal, distance) in WALLS.items():
            n = np.array(normal) / np.linalg.norm(normal)
            along = (distance / np.linalg.norm(normal) - near @ n) / ((far - near) @ n)
            hit = (along > 0.3) & (along < best)
            best[hit], name[hit] = along[hit], wall
        normal = np.array([WALLS[wall][0] for wall in name], float)
        length = np.linalg.norm(normal, axis=1)
        off = lambda distance: (at(distance) * normal).sum(1) / length - np.array([WALLS[wall][1] for wall in name]) / length
        for _ in range(8):
            best = best - off(best) * 2e-6 / (off(best + 1e-6) - off(best - 1e-6))
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


def study(kind, placed, random, known, more):
    text = 'chain = "scanner.chain"\ndata = "data.csv"\n[observed]\n'
    text += f'kind = "{"plane" if kind == "walls" else "target"}"\nobject = "object"\nstation = "station"\n[stations]\n'
    for label, (_, _, numbers) in placed.items():
        about = numbers if known == "known" else numbers + random.normal(0, 1, 6) * STATIONS[known]
        units = zip(("x", "y", "z", "roll", "pitch", "heading"), about, ["m"] * 3 + ["rad"] * 3)
        cells = ", ".join(f'{name} = "{value:.9f} {unit}"' for name, value, unit in units)
        more_of_it = {"unknown": ", rough = true", "known": "", "stated": f', sigma = "{STATED_M} m", sigma_angle = "{STATED_RAD} rad"'}
        text += f"{label} = {{ {cells}{more_of_it[known]} }}\n"
    return text + more


def calibrated(command, random, kind, effect, rows, known="unknown", declared=False):
    """The instrument, what the command reports of it, and the control's p."""
    scanner, placed = Scanner(random, effect), stations(random)
    # A phase is a column only where a phase meter is suspected.
    cyclic = effect.startswith("cyclic")
    table = f"station,object,azimuth [rad],elevation [rad],range [m]{',phase [rad]' if cyclic else ''}\n"
    drawn, noise = [], [ANGLE_NOISE, ANGLE_NOISE, RANGE_NOISE]
    for label, name, *readings in {"walls": walls, "targets": targets}[kind](random, scanner, placed, rows):
        noisy = [value + sigma * random.standard_normal() for value, sigma in zip(readings, noise)]
        last = f",{phase(noisy[2]) % (2 * math.pi):.9f}" if cyclic else ""
        table += f"{label},{name},{noisy[0]:.9f},{noisy[1]:.9f},{noisy[2]:.6f}{last}\n"
        drawn.append((label, name, readings, noisy))
    control = smallest_p(scanner, placed, WALLS if kind == "walls" else None, drawn, noise)
    chain = (ROOT / "examples" / "objects" / "scanner.chain").read_text()
    if declared:
        chain = chain.replace("Ty(range_zero)", "Ty(range_zero), Ty(longer*range)")
    if cyclic:
        chain = chain.replace("input range: length;", "input range: length;\n    input phase: phase of range;")
    more = '[fit]\ntolerance = { longer = "0.1" }\n' if declared else ""
    more += '[search]\ninputs = ["phase"]\n' if cyclic else ""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scanner.chain").write_text(chain)
        (folder / "data.csv").write_text(table)
        (folder / "study.toml").write_text(study(kind, placed, random, known, more))
        asked = [command, "calibrate", "study.toml", "--format", "json", "--dry-run"]
        run = subprocess.run(asked, cwd=folder, capture_output=True, text=True, env={**os.environ, "RAYON_NUM_THREADS": "1"})
    if declared and run.returncode == 2 and "nothing holds the scale" in run.stderr:
        return scanner, None, control
    if run.returncode not in (0, 1):
        raise RuntimeError(f"{kind}, {effect}: {run.stderr}")
    return scanner, json.loads(run.stdout), control


def trial(command, kind, cell, run, rows):
    """What one run came to: what was accepted and told, and how many intervals hold what was drawn."""
    effect, known, declared = cell
    random = np.random.default_rng([run, len(kind), list(EFFECTS).index(effect), list(STATIONS).index(known), declared])
    scanner, report, control = calibrated(command, random, kind, effect, rows, known, declared)
    if report is None:
        return {"kind": kind, "cell": cell, "run": run, "verdict": "refused", "accepted": [], "told": [], "effects": 0, "control": control, "inside": 0, "of": 0}
    told = lambda one: {cause["name"] for cause in one["causes"]} | set(one["names"])
    result = {
        "kind": kind, "cell": cell, "run": run, "verdict": report["verdict"],
        "accepted": [cause["name"] for one in report["effects"] for cause in one["causes"] if cause["relation"] == "accepted"],
        "told": sorted(set().union(*(told(one) for one in report["effects"]))),
        "effects": len(report["effects"]), "control": control, "inside": 0, "of": 0,
    }  # fmt: skip
    for error in report["errors"]:
        sigma = error["standard_uncertainty"]
        if error["name"] not in scanner.named() or not sigma or not error["separable"] or not error["shown"]:
            continue
        away = error["value"] - scanner.named()[error["name"]]
        result["of"] += 1
        result["inside"] += bool(abs(away) <= student(0.975, error["degrees_of_freedom"]) * sigma)
        result.setdefault("pulls", {})[error["name"]] = away / sigma
    return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=30, help="with one effect planted; five times as many with none")
    parser.add_argument("--first", type=int, default=0, help="the first run's number")
    parser.add_argument("--rows", type=int, default=150, help="rows from each of four stations")
    parser.add_argument("--only", choices=["walls", "targets"])
    parser.add_argument("--planted", default="", help="those alone whose name holds this")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--record", type=pathlib.Path, help="add every run to this file, a line of JSON each")
    parser.add_argument("--trueaxis", default=str(ROOT / "target" / "release" / "trueaxis"))
    arguments = parser.parse_args()
    command = pathlib.Path(arguments.trueaxis).resolve()
    kinds = [arguments.only] if arguments.only else ["walls", "targets"]
    cells = [(effect, "unknown", False) for effect in EFFECTS]
    cells += [("range scale, 1e-3", known, declared) for known, declared in (("known", False), ("unknown", True), ("stated", False))]
    cells += [("nothing", "stated", False)]
    print("| observed | planted | stations | runs | right | truth in the set | any effect | control below 0.05 | 95 % intervals that hold the truth | verdicts |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for kind in kinds:
        for cell in cells:
            effect, known, declared = cell
            if arguments.planted not in effect:
                continue
            numbers = range(arguments.first, arguments.first + arguments.runs * (5 if effect == "nothing" else 1))
            with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
                results = list(pool.map(lambda run: trial(command, kind, cell, run, arguments.rows), numbers))
            if arguments.record:
                with open(arguments.record, "a") as file:
                    file.writelines(json.dumps(result) + "\n" for result in results)
            name, runs = EFFECTS[effect][1], len(results)
            share = lambda holds: wilson(sum(map(holds, results)), runs)
            verdicts = [result["verdict"] for result in results]
            print(f"| {kind} | {effect}{', declared' if declared else ''} | "
                  f"{known} | {runs} | "
                  f"{share(lambda result: name in result['accepted']) if name else ''} | "
                  f"{share(lambda result: name in result['told']) if name else ''} | {share(lambda result: result['effects'] > 0)} | "
                  f"{share(lambda result: result['control'] < 0.05)} | "
                  f"{wilson(sum(result['inside'] for result in results), sum(result['of'] for result in results))} | "
                  f"{', '.join(f'{one} {verdicts.count(one)}' for one in sorted(set(verdicts)))} |", flush=True)  # fmt: skip
            pulls = {one: [result["pulls"][one] for result in results if one in result.get("pulls", {})] for one in Scanner.NAMES}
            for one, pull in pulls.items():
                if pull:
                    print(f"{kind}, {effect}: {one} mean {np.mean(pull):+.2f}, sigma {np.std(pull):.2f} of {len(pull)}", file=sys.stderr)


if __name__ == "__main__":
    main()
