"""How often `trueaxis verify` gives a false alarm, and how often it finds a change of twice the goal.

Each calibration is simulated and fitted by least squares of this program's own, and written as an instrument file. It is then checked with ten new
rows at a time, by the command as users run it. All is plain matrices and Python's own random numbers: nothing of the project.

    python3 benches/monthly/verify.py --program target/release/trueaxis
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
FILE = """instrument = 1

chain = '''
{chain}'''

[errors]
{errors}

[found-over]
azimuth = ["{azimuth[0]!r} rad", "{azimuth[1]!r} rad"]
elevation = ["{elevation[0]!r} rad", "{elevation[1]!r} rad"]

[covariance]
of = ["tilt_x", "tilt_y", "index", "collimation"]
undetermined = []
rows = {covariance}

[[noise]]
sigma = [{sigma!r}, {sigma!r}]
degrees-of-freedom = {freedom}

[study]
chain = "mount.chain"
data = "stars.csv"

[study.columns]
azimuth = {{ column = "az", unit = "deg" }}
elevation = {{ column = "el", unit = "deg" }}

[study.observed]
kind = "spherical"
azimuth = {{ column = "true_az", unit = "deg" }}
elevation = {{ column = "true_el", unit = "deg" }}
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


def rows_of(e, poses, sigma, source):
    """Readings, and what is measured there."""
    rows = []
    for azimuth, elevation in poses:
        a, b = pointing(e, azimuth, elevation)
        rows.append((azimuth, elevation, a + source.gauss(0, sigma) / math.cos(b), b + source.gauss(0, sigma)))
    return rows


def table(rows):
    lines = [",".join(f"{math.degrees(x):.9f}" for x in row) for row in rows]
    return "\n".join(["az,el,true_az,true_el", *lines]) + "\n"


def off(e, row):
    """Measured less predicted, sideways and upwards."""
    azimuth, elevation, a, b = row
    c, d = pointing(e, azimuth, elevation)
    return (math.remainder(a - c, 2 * math.pi) * math.cos(b), b - d)


def inverse(m):
    n = len(m)
    rows = [list(row) + [float(i == k) for k in range(n)] for i, row in enumerate(m)]
    for i in range(n):
        best = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[best] = rows[best], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(n):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i])]
    return [row[n:] for row in rows]


def fitted(rows):
    """Least squares: the errors, their covariance, the noise of a component and its degrees of freedom."""
    e, step = dict.fromkeys(ERRORS, 0.0), ARCSEC
    for _ in range(4):
        normal, right, squares = [[0.0] * 4 for _ in range(4)], [0.0] * 4, 0.0
        for row in rows:
            here = off(e, row)
            moved = [off(dict(e, **{name: e[name] + step}), row) for name in ERRORS]
            for component in (0, 1):
                slope = [(here[component] - own[component]) / step for own in moved]
                squares += here[component] ** 2
                for i in range(4):
                    right[i] += slope[i] * here[component]
                    for k in range(4):
                        normal[i][k] += slope[i] * slope[k]
        root = inverse(normal)
        e = {name: e[name] + sum(root[i][k] * right[k] for k in range(4)) for i, name in enumerate(ERRORS)}
    freedom = 2 * len(rows) - 4
    variance = sum(x * x for row in rows for x in off(e, row)) / freedom
    return e, [[variance * (root[i][k] + root[k][i]) / 2 for k in range(4)] for i in range(4)], math.sqrt(variance), freedom


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

        for _ in range(asked.calibrations):
            truth = {name: source.gauss(0, 20 * ARCSEC) for name in ERRORS}
            poses = [pose(source) for _ in range(asked.rows)]
            found, covariance, noise, freedom = fitted(rows_of(truth, poses, sigma, source))
            region = {name: (min(own), max(own)) for name, own in zip(("azimuth", "elevation"), zip(*poses))}
            errors = "\n".join(f'{name} = "{found[name]!r} rad"' for name in ERRORS)
            write("instrument.toml", FILE.format(chain=CHAIN, errors=errors, covariance=covariance, sigma=noise,
                                                 freedom=float(freedom), **region))
            for kind in counts:
                for _ in range(asked.checks):
                    now, name = truth, None
                    if kind == "changed":
                        name = source.choice(ERRORS)
                        size = 2 * asked.goal * ARCSEC / (rms(truth, name, ARCSEC) / ARCSEC)
                        now = dict(truth, **{name: truth[name] + source.choice([-1, 1]) * size})
                    write("ten.csv", table(rows_of(now, [inside(source, region) for _ in range(10)], sigma, source)))
                    answer = json.loads(run(program, folder, "verify", "instrument.toml", "--data", "ten.csv",
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
