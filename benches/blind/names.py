#!/usr/bin/env python3
"""Effects of the catalogue: whether what is told holds the one that was planted, and whether the amended chain is calibrated.

    cargo build --release --bin trueaxis
    python3 benches/blind/names.py [--runs 5] [--snr 0.3 1 3] > table.md

Each run plants one effect, calibrates, and calibrates the amended chain on the same data once more, with the same words for the
columns. The truth is told if its name is that of an accepted effect, or of one that the report calls the same or as good over these
data. The size of the set counts what these data can tell apart: the accepted effect and each that competes with it. SNR is the
effect's RMS a component, after what declared errors can take of it, over the noise.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor

from blind import ROOT, study, wilson, written
from outside import projected_rms
from simulate import AltAzimuth, Scanner, measured, poses


def about(axis, joint, function):
    """A rotation about one axis by a function of a joint, with a phase."""
    return lambda phase, size: [(axis, lambda e, q: size * function(q[joint], phase))]


def whirl(joint, order):
    """A tilt of the axis whose tip goes round `order` times a turn, in the frame that turns."""
    return lambda phase, size: [("Rx", lambda e, q: size * math.cos(order * q[joint] + phase)),
                                ("Ry", lambda e, q: size * math.sin(order * q[joint] + phase))]


def sine(order):
    return lambda x, phase: math.sin(order * x + phase)


def scale(x, phase):
    return x


# Instrument, body, what is planted there, and names of which one has to be told.
PLANTED = [
    (AltAzimuth, "azimuth_axis", about("Rz", "azimuth", sine(1)), ["encoder eccentricity of azimuth"]),
    (AltAzimuth, "azimuth_axis", about("Rz", "azimuth", sine(2)), ["encoder ellipticity of azimuth"]),
    (AltAzimuth, "azimuth_axis", about("Rz", "azimuth", sine(5)), ["encoder error of azimuth, 5 per turn"]),
    (AltAzimuth, "azimuth_axis", about("Rz", "azimuth", scale), ["encoder scale of azimuth"]),
    (AltAzimuth, "azimuth_axis", whirl("azimuth", 2), ["tilt of the azimuth axis, 2 per turn"]),
    (AltAzimuth, "azimuth_axis", whirl("azimuth", -3), ["tilt of the azimuth axis, 3 per turn"]),
    (AltAzimuth, "elevation_axis", about("Rx", "elevation", sine(1)), ["encoder eccentricity of elevation"]),
    (AltAzimuth, "elevation_axis", about("Rx", "elevation", sine(2)), ["encoder ellipticity of elevation"]),
    (AltAzimuth, "elevation_axis", about("Rx", "elevation", scale), ["encoder scale of elevation"]),
    (AltAzimuth, "elevation_axis", about("Rx", "azimuth", sine(1)), ["coupling of azimuth into elevation_axis about x, harmonic 1"]),
    (AltAzimuth, "azimuth_axis", about("Rz", "elevation", sine(2)), ["coupling of elevation into azimuth_axis about z, harmonic 2"]),
    (Scanner, "outer", about("Rz", "alpha", sine(1)), ["encoder eccentricity of alpha"]),
    (Scanner, "outer", about("Rz", "alpha", sine(2)), ["encoder ellipticity of alpha"]),
    (Scanner, "outer", about("Rz", "alpha", scale), ["encoder scale of alpha"]),
    (Scanner, "outer", whirl("alpha", 2), ["tilt of the alpha axis, 2 per turn"]),
    (Scanner, "outer", whirl("alpha", -2), ["tilt of the alpha axis, 2 per turn"]),
    (Scanner, "middle", about("Rx", "beta", sine(1)), ["encoder eccentricity of beta"]),
    (Scanner, "middle", about("Rx", "beta", sine(3)), ["encoder error of beta, 3 per turn"]),
    (Scanner, "middle", about("Rx", "beta", scale), ["encoder scale of beta"]),
    (Scanner, "middle", about("Ry", "alpha", sine(2)), ["coupling of alpha into middle about y, harmonic 2"]),
    (Scanner, "outer", about("Ry", "beta", sine(2)), ["coupling of beta into outer about y, harmonic 2"]),
]


class Planted:
    """An instrument whose body carries several planted factors behind its motion."""

    def __init__(self, instrument, body, factors):
        self.instrument, self.body, self.factors = instrument, body, factors

    def __getattr__(self, name):
        return getattr(self.instrument, name)

    def value(self, e, q, planted=None):
        if planted is None:
            return self.instrument.value(e, q)
        # One factor turns by one small angle; two of them turn by both, since they commute to first order.
        (kind, amount), *more = self.factors(*planted)
        value = self.instrument.value
        still, first = value(e, q), value(e, q, (self.body, kind, amount))
        for kind, amount in more:
            other = value(e, q, (self.body, kind, amount))
            first = tuple(a + b - c for a, b, c in zip(first, other, still))
        return first


def run(command, folder, *words):
    answer = subprocess.run([command, "calibrate", *words, "--format", "json"], cwd=folder, capture_output=True, text=True)
    return json.loads(answer.stdout) if answer.returncode in (0, 1) and answer.stdout else None


def told(effect):
    return [effect["form"], *effect["names"], *effect["confounded_with"], *sum(effect["competing_with"], [])]


def trial(command, case, snr, seed, narrow):
    kind, body, factors, words = case
    instrument = Planted(kind(False) if kind is Scanner else kind(), body, factors)
    if narrow:
        instrument.instrument.ranges = {joint: (low, low + (high - low) / 6) if high - low > 3 else (low, high)
                                        for joint, (low, high) in instrument.ranges.items()}
    rng = random.Random(f"{words} {snr} {seed} {narrow}")
    e = {key: rng.gauss(0, size) for key, size in instrument.errors.items()}
    where = poses(instrument, 400, False, rng)
    phase = rng.uniform(0, math.tau)
    unit = 1e-6
    size = unit * snr * instrument.noise / projected_rms(instrument, where, (phase, unit))
    data = [measured(instrument, e, q, [rng.gauss(0, instrument.noise) for _ in range(3)], planted=(phase, size)) for q in where]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "i.chain").write_text(instrument.chain)
        written(folder / "d.csv", instrument.joints, where, data)
        (folder / "s.toml").write_text(study(instrument))
        report = run(command, folder, "s.toml", "--out", "result")
        if report is None:
            return None
        effects = report["effects"]
        holds = any(word in text for word in words for effect in effects for text in told(effect))
        result = {"verdict": report["verdict"], "holds": holds, "count": len(effects), "more": None,
                  "size": max((1 + len(effect["competing_with"]) for effect in effects), default=0),
                  "told": [effect["names"][:1] for effect in effects]}
        if effects and (folder / "result" / "amended.chain").exists():
            (folder / "again.toml").write_text(study(instrument, "result/amended.chain"))
            again = run(command, folder, "again.toml", "--out", "again")
            result["more"] = [effect["names"][:1] for effect in again["effects"]] if again else ["failed"]
        return result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--snr", type=float, nargs="*", default=[0.3, 1.0, 3.0])
    parser.add_argument("--narrow", action="store_true", help="every joint of more than half a turn over a sixth of its range")
    parser.add_argument("--each", action="store_true")
    parser.add_argument("--command", default=str(ROOT / "target/release/trueaxis"))
    arguments = parser.parse_args()
    print("| joints | SNR | an effect accepted | the planted one is named | mean size of the set | nothing more in the amended chain |\n"
          "|---|---|---|---|---|---|")
    with ThreadPoolExecutor(2) as pool:
        for snr in arguments.snr:
            cases = [(case, seed) for case in PLANTED for seed in range(arguments.runs)]
            results = list(pool.map(lambda c: trial(arguments.command, c[0], snr, c[1], arguments.narrow), cases))
            if arguments.each:
                for (case, seed), result in zip(cases, results):
                    print(f"<!-- {case[3][0]} {seed}: {result} -->", flush=True)
            found = [result for result in results if result and result["count"]]
            again = [result for result in found if result["more"] is not None]
            print(f"| {'a sixth' if arguments.narrow else 'whole range'} | {snr:g} | {wilson(len(found), len(results))} | "
                  f"{wilson(sum(result['holds'] for result in found), len(found))} | "
                  f"{sum(result['size'] for result in found) / max(len(found), 1):.2f} | "
                  f"{wilson(sum(not result['more'] for result in again), len(again))} |", flush=True)


if __name__ == "__main__":
    main()
