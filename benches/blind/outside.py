#!/usr/bin/env python3
"""Functions outside the catalogue: twenty at two places of two instruments, at three sizes; and harmonics that nobody asked for.

    cargo build --release --bin trueaxis
    python3 benches/blind/outside.py [--runs 1] [--snr 0.3 1 3] > table.md

A run is wrong if its verdict is "explained" or "confounded" and neither an accepted effect, nor what is told to explain the data
as well, has the shape that was planted; or if its verdict names a place and an accepted effect follows another joint (gravity in the
body that the joint turns follows the joint). SNR is the planted effect's RMS a component, after what the declared errors can take of
it, over the noise.
"""
import argparse
import math
import random

from blind import ROOT, calibrated, wilson
from simulate import AltAzimuth, Scanner, measured, poses

RAMP = ("ramp",)
FREE = ("unnamed function",)

# Name, function of the joint u over its range (0 to 1) and x in radians, and the words of shapes that it is.
FUNCTIONS = [
    ("step at 0.4", lambda u, x: u > 0.4, ("step", "ramp")),
    ("step at 0.7", lambda u, x: u > 0.7, ("step", "ramp")),
    ("plateau 0.3 to 0.65", lambda u, x: 0.3 < u < 0.65, ("plateau",)),
    ("plateau 0.5 to 0.6", lambda u, x: 0.5 < u < 0.6, ("plateau", "bump")),
    ("saturating ramp 0.4 to 0.6", lambda u, x: min(max((u - 0.4) / 0.2, 0), 1), RAMP),
    ("saturating ramp 0.2 to 0.5", lambda u, x: min(max((u - 0.2) / 0.3, 0), 1), RAMP),
    ("hinge at 0.5", lambda u, x: max(u - 0.5, 0), RAMP),
    ("hinge at 0.8", lambda u, x: max(u - 0.8, 0), RAMP),
    ("absolute value about 0.5", lambda u, x: abs(u - 0.5), ("ramp", "triangle", "bump")),
    ("sawtooth, 3 per turn", lambda u, x: (3 * x / math.tau + 0.2) % 1, ("sawtooth",)),
    ("sawtooth, 5 per turn", lambda u, x: (5 * x / math.tau + 0.7) % 1, ("sawtooth",)),
    ("square wave, 4 per turn", lambda u, x: (4 * x / math.tau + 0.1) % 1 < 0.5, ("square", "plateau")),
    ("triangle wave, 3 per turn", lambda u, x: abs((3 * x / math.tau + 0.3) % 1 - 0.5), ("triangle",)),
    ("bump 0.03 wide", lambda u, x: max(1 - abs(u - 0.35) / 0.03, 0), ("bump", "plateau")),
    ("bump 0.12 wide", lambda u, x: max(1 - abs(u - 0.6) / 0.12, 0), ("bump",)),
    ("bell 0.05 wide", lambda u, x: math.exp(-0.5 * ((u - 0.45) / 0.05) ** 2), ("bump",)),
    ("root of the distance from 0.5", lambda u, x: math.sqrt(abs(u - 0.5)), FREE),
    ("exponential, a tenth long", lambda u, x: math.exp(-u / 0.1), FREE),
    ("reciprocal of 0.1 + u", lambda u, x: 1 / (0.1 + u), FREE),
    ("hyperbolic tangent, 0.05 wide", lambda u, x: math.tanh((u - 0.5) / 0.05), ("ramp", "step")),
]
# Over 69 degrees a wave is what its one period shows: no jump, one jump, one corner.
NARROW = {"sawtooth, 3 per turn": ("scale",), "square wave, 4 per turn": ("step", "ramp"), "triangle wave, 3 per turn": RAMP + ("bump",)}
HARMONICS = [(f"{order} per turn", lambda u, x, n=order: math.cos(n * x + 0.5), (f"{order} per turn",)) for order in (11, 17, 26)]

PLACES = [(AltAzimuth(), "azimuth_axis", "Ry", "azimuth"), (AltAzimuth(), "elevation_axis", "Rx", "elevation"),
          (Scanner(False), "outer", "Ry", "alpha"), (Scanner(False), "middle", "Rx", "beta")]


def tangents(v):
    level = math.hypot(v[0], v[1]) or 1e-300
    return (-v[1] / level, v[0] / level, 0.0), (-v[0] * v[2] / level, -v[1] * v[2] / level, level)


def projected_rms(instrument, where, planted):
    """The RMS a component of the planted effect after what the declared errors can take of it."""
    nothing = dict.fromkeys(instrument.errors, 0.0)
    base = [instrument.value(nothing, q) for q in where]
    def column(values):
        return [sum((a - b) * t for a, b, t in zip(moved, still, tangent))
                for moved, still in zip(values, base) for tangent in tangents(still)]
    columns = [column([instrument.value({**nothing, name: 1e-6}, q) for q in where]) for name in instrument.errors]
    columns.append(column([instrument.value(nothing, q, planted) for q in where]))
    basis = []
    for values in columns:
        before = sum(v * v for v in values)
        for known in basis + basis:
            share = sum(a * b for a, b in zip(known, values))
            values = [v - share * k for v, k in zip(values, known)]
        left = sum(v * v for v in values)
        if values and left > 1e-9 * before:
            basis.append([v / math.sqrt(left) for v in values])
    return math.sqrt(left / len(values))


def trial(command, place, function, snr, seed):
    instrument, body, kind, joint = place
    name, shape, words = function
    words = NARROW.get(name, words) if joint == "elevation" else words
    rng = random.Random(f"{instrument.name} {joint} {name} {snr} {seed}")
    e = {key: rng.gauss(0, scale) for key, scale in instrument.errors.items()}
    where = poses(instrument, 400, False, rng)
    low, high = instrument.ranges[joint]
    of = lambda q: float(shape((q[joint] - low) / (high - low), q[joint]))
    unit = 1e-6
    rms = projected_rms(instrument, where, (body, kind, lambda e, q: unit * of(q)))
    size = unit * snr * instrument.noise / rms
    planted = (body, kind, lambda e, q: size * of(q))
    noise = [[rng.gauss(0, instrument.noise) for _ in range(3)] for _ in where]
    data = [measured(instrument, e, q, n, planted=planted) for q, n in zip(where, noise)]
    report = calibrated({"instrument": instrument, "command": command}, where, data, [0] * len(where))
    if "failed" in report:
        return None
    found = report["effects"]
    placed = report["verdict"] in ("explained", "confounded", "form not determined", "unnamed function")
    follows = lambda effect: joint in effect["driver"] or (effect["driver"], effect["body"]) == ("gravity", body)
    others = not all(follows(effect) for effect in found)
    told = [(joint if follows(effect) else effect["driver"], effect["body"]) for effect in found]
    left = report["remaining"]["where"] if report["remaining"] else None
    if left:
        told.append((left["driver"], left["body"]))
    names = [text for effect in found for text in [effect["form"], *effect["names"], *effect["confounded_with"], *sum(effect["competing_with"], [])]]
    form = any(word in text for word in words for text in names)
    explained = report["verdict"] in ("explained", "confounded")
    return {"verdict": report["verdict"], "place": (joint, body) in told, "form": form,
            "wrong": explained and not form or placed and others, "alarm": bool(found) or report["verdict"] != "nothing detectable"}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--snr", type=float, nargs="*", default=[0.3, 1.0, 3.0])
    parser.add_argument("--harmonics", action="store_true")
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--command", default=str(ROOT / "target/release/trueaxis"))
    arguments = parser.parse_args()
    functions = HARMONICS if arguments.harmonics else FUNCTIONS
    print("| instrument | SNR | told at all | right joint and body | shape among those told | wrongly explained | verdicts |\n"
          "|---|---|---|---|---|---|---|")
    for snr in arguments.snr:
        for instrument in dict.fromkeys(place[0].name for place in PLACES):
            results = []
            for place in (place for place in PLACES if place[0].name == instrument):
                for function in functions:
                    for seed in range(arguments.runs):
                        result = trial(arguments.command, place, function, snr, seed)
                        if arguments.each:
                            print(f"<!-- {place[3]} {function[0]}: {result} -->", flush=True)
                        if result:
                            results.append(result)
            verdicts = {}
            for result in results:
                verdicts[result["verdict"]] = verdicts.get(result["verdict"], 0) + 1
            share = lambda key: wilson(sum(result[key] for result in results), len(results))
            print(f"| {instrument} | {snr:g} | {share('alarm')} | {share('place')} | {share('form')} | {share('wrong')} | "
                  f"{', '.join(f'{k} {v}' for k, v in sorted(verdicts.items(), key=lambda p: -p[1]))} |", flush=True)


if __name__ == "__main__":
    main()
