"""Whether the ± of a study with `[reference]` is as large as the spread over simulated references (GUM supplement 1, JCGM 101:2008).

A machine with three slides visits targets again and again. Each run draws a scale, a frame, coordinates of targets and noise, writes a table, and
calibrates by the command as users run it. All is Python's own random numbers and plain arithmetic: nothing of the project.

    python3 benches/monthly/reference.py --program target/release/trueaxis --runs 1000
"""
import argparse
import csv
import json
import math
import os
import random
import subprocess
import tempfile

CHAIN = """chain Machine {
    const tool: length = 0.12;
    body x_slide on ground {
        position_error: Tx(origin_x), Ty(origin_y), Tz(origin_z), Rx(turn_x), Ry(turn_y), Rz(turn_z);
        motion: Tx(x);
        motion_error: Tx(scale_x*x);
    }
    body y_slide on x_slide {
        position_error: Rz(square_xy);
        motion: Ty(y);
        motion_error: Ty(scale_y*y);
    }
    body z_slide on y_slide {
        position_error: Rx(square_yz), Ry(square_xz);
        motion: Tz(z);
        motion_error: Tz(scale_z*z);
    }
    observe tip: point(0, 0, -tool) of z_slide;
}
"""
STUDY = """chain = "machine.chain"
data = "rows.csv"

[columns]
x = {{ column = "x", unit = "m" }}
y = {{ column = "y", unit = "m" }}
z = {{ column = "z", unit = "m" }}

[observed]
kind = "point"
x = {{ column = "tip_x", unit = "m" }}
y = {{ column = "tip_y", unit = "m" }}
z = {{ column = "tip_z", unit = "m" }}

[model]
terms = ["origin_x", "origin_y", "origin_z", "turn_x", "turn_y", "turn_z", "scale_x", "scale_y", "scale_z", "square_xy", "square_yz", "square_xz"]

[hold_out]
folds = 2

[reference]
scale = "{scale} ppm"
targets = "{targets} um"
target = "nest"
rotation = "{rotation} rad"
shift = "{shift} um"
"""
SCALE, TARGETS, ROTATION, SHIFT, NOISE = 10e-6, 20e-6, 15e-6, 20e-6, 10e-6


def rotated(axis, angle, v):
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out = list(v)
    out[i], out[j] = c * v[i] - s * v[j], s * v[i] + c * v[j]
    return out


def table(path, chance):
    scale = 1 + chance.gauss(0, SCALE)
    turn = [chance.gauss(0, ROTATION) for _ in range(3)]
    shift = [chance.gauss(0, SHIFT) for _ in range(3)]
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["nest", "x", "y", "z", "tip_x", "tip_y", "tip_z"])
        for nest in range(12):
            off = [chance.gauss(0, TARGETS) for _ in range(3)]
            at = [chance.uniform(0, 0.9) for _ in range(3)]
            for _ in range(6):
                read = [part + chance.uniform(0, 0.01) for part in at]
                tip = [read[0], read[1], read[2] - 0.12]
                seen = [scale * tip[k] + off[k] + chance.gauss(0, NOISE) for k in range(3)]
                for axis in range(3):
                    seen = rotated(axis, turn[axis], seen)
                writer.writerow([f"nest {nest}", *read, *(seen[k] + shift[k] for k in range(3))])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--runs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    program = os.path.abspath(asked.program)
    squares, said, inside, count, failed = {}, {}, 0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        names = {"scale": SCALE * 1e6, "targets": TARGETS * 1e6, "rotation": ROTATION, "shift": SHIFT * 1e6}
        with open(os.path.join(folder, "machine.chain"), "w") as file:
            file.write(CHAIN)
        with open(os.path.join(folder, "study.toml"), "w") as file:
            file.write(STUDY.format(**names))
        for run in range(asked.runs):
            table(os.path.join(folder, "rows.csv"), random.Random(f"{asked.seed} {run}"))
            command = [program, "calibrate", "study.toml", "--format", "json"]
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
            if done.returncode != 0:
                failed += 1
                continue
            for budget in json.loads(done.stdout)["budgets"]:
                if budget["of"] == "corrected reading":
                    continue
                errors = {own["name"]: own["value"] for own in json.loads(done.stdout)["errors"]}
                error = errors[budget["of"]]
                squares[budget["of"]] = squares.get(budget["of"], 0) + error**2
                said[budget["of"]] = said.get(budget["of"], 0) + budget["standard_uncertainty"] ** 2
                inside += abs(error) <= budget["expanded_uncertainty"]
                count += 1
    print(f"{asked.runs} runs, {failed} without a result")
    for name in squares:
        print(f"{name}: spread over ± {math.sqrt(squares[name] / said[name]):.3f}")
    print(f"inside the expanded uncertainty: {inside / max(count, 1):.4f} of {count}")


main()
