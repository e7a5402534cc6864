"""How often `trueaxis verify` gives a false alarm, and how often it finds a change of twice the goal.

Each calibration is simulated, calibrated by `trueaxis calibrate`, and then checked with ten new rows at a time, by the command as users run it. The
simulator is plain matrices and Python's own random numbers: nothing of the project.

    python3 benches/monthly/verify.py --program target/release/trueaxis --calibrations 100 --checks 10
"""
import argparse
import json
import math
import os
import random
import subprocess
import tempfile

ARCSEC = math.pi / 648000
ERRORS = ["tilt_x", "tilt_y", "index", "collimation"]
CHAIN = """chain Mount {
    body fork on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
    }
    body tube on fork {
        motion: Rx(elevation);
        motion_error: Rx(index), Rz(collimation);
    }
    observe pointing: direction(0, 1, 0) of tube;
}
"""
STUDY = """chain = "mount.chain"
data = "stars.csv"
[columns]
azimuth = { column = "az", unit = "deg" }
elevation = { column = "el", unit = "deg" }
[observed]
kind = "spherical"
azimuth = { column = "true_az", unit = "deg" }
elevation = { column = "true_el", unit = "deg" }
[hold_out]
folds = 3
"""


def turn(axis, angle, v):
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out = list(v)
    out[i] = c * v[i] - s * v[j]
    out[j] = s * v[i] + c * v[j]
    return out


def pointing(e, azimuth, elevation):
    """Azimuth from y through x, and elevation, of where the tube points."""
    v = turn(2, e["collimation"], [0.0, 1.0, 0.0])
    v = turn(0, elevation + e["index"], v)
    v = turn(2, -azimuth, v)
    v = turn(0, e["tilt_x"], turn(1, e["tilt_y"], v))
    return math.atan2(v[0], v[1]), math.asin(v[2])


def pose(source):
    return math.radians(source.uniform(-180, 180)), math.radians(source.uniform(10, 80))


def measured(e, poses, sigma, source):
    lines = ["az,el,true_az,true_el"]
    for azimuth, elevation in poses:
        a, b = pointing(e, azimuth, elevation)
        a += source.gauss(0, sigma) / math.cos(b)
        b += source.gauss(0, sigma)
        lines.append(",".join(f"{math.degrees(x):.9f}" for x in (azimuth, elevation, a, b)))
    return "\n".join(lines) + "\n"


def rms(e, name, size):
    """Of the change of what is observed where one error changes, over the region."""
    changed = dict(e, **{name: e[name] + size})
    total, count = 0.0, 0
    for k in range(36):
        for elevation in range(10, 81, 5):
            azimuth = math.radians(10 * k)
            (a, b), (c, d) = (pointing(x, azimuth, math.radians(elevation)) for x in (e, changed))
            cosine = math.sin(b) * math.sin(d) + math.cos(b) * math.cos(d) * math.cos(a - c)
            side = math.hypot(d - b, math.cos(b) * math.sin(c - a))
            total += side * side if cosine > 0 else math.pi ** 2
            count += 1
    return math.sqrt(total / count)


def inside(source, region):
    """A pose within the measured region of a calibration, as its file states it."""
    return tuple(source.uniform(*region[name]) for name in ("azimuth", "elevation"))


def run(program, folder, *arguments):
    done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode == 2:
        raise SystemExit(done.stderr)
    return done.stdout


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--calibrations", type=int, default=100)
    parser.add_argument("--checks", type=int, default=10)
    parser.add_argument("--rows", type=int, default=60)
    parser.add_argument("--goal", type=float, default=5.0, help="arc seconds")
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    program = os.path.abspath(asked.program)
    source = random.Random(asked.seed)
    sigma = 1.0 * ARCSEC
    counts = {"unchanged": {}, "changed": {}}
    named = 0
    with tempfile.TemporaryDirectory() as folder:
        def write(name, text):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)

        write("mount.chain", CHAIN)
        write("study.toml", STUDY)
        for _ in range(asked.calibrations):
            truth = {name: source.gauss(0, 20 * ARCSEC) for name in ERRORS}
            poses = [pose(source) for _ in range(asked.rows)]
            write("stars.csv", measured(truth, poses, sigma, source))
            run(program, folder, "calibrate", "study.toml", "--out", "result", "--quiet")
            region = {name: (min(own), max(own)) for name, own in zip(("azimuth", "elevation"), zip(*poses))}
            for kind in counts:
                for _ in range(asked.checks):
                    now, name = truth, None
                    if kind == "changed":
                        name = source.choice(ERRORS)
                        size = 2 * asked.goal * ARCSEC / (rms(truth, name, ARCSEC) / ARCSEC)
                        now = dict(truth, **{name: truth[name] + source.choice([-1, 1]) * size})
                    write("ten.csv", measured(now, [inside(source, region) for _ in range(10)], sigma, source))
                    answer = json.loads(run(program, folder, "verify", "result/instrument.toml", "--data", "ten.csv",
                                            "--goal", f"{asked.goal} arcsec", "--format", "json"))
                    key = f"{answer['verdict']}: {answer['reason']}"
                    counts[kind][key] = counts[kind].get(key, 0) + 1
                    named += kind == "changed" and answer["explained_by"][:1] == [name]
    total = asked.calibrations * asked.checks
    for kind, own in counts.items():
        print(kind, f"({total} checks)")
        for key, count in sorted(own.items()):
            share = count / total
            print(f"  {key}: {count}, {100 * share:.1f} % ± {100 * math.sqrt(share * (1 - share) / total):.1f}")
    print(f"the changed error is named first: {100 * named / total:.1f} %")


main()
