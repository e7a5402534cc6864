"""A machine with three slides whose guides are not straight, by homogeneous matrices written out here; shares no code with trueaxis.

Each row has the readings of the three slides and where a tracker saw the tip, with 0.3 micrometres of noise in each coordinate.
`plate.csv` has a bow of x sideways, a roll of x, a positioning error of y that grows with the cube of its travel, and a tilt of z.
`clean.csv` has none of them. Both have squarenesses, and a scale of x.

Run: python3 simulate.py
"""

import csv
import math
import random

NOISE_M = 0.3e-6
TOOL_M = 0.12


def turned(rx, ry, rz):
    """Rz Ry Rx as rows."""
    cx, sx, cy, sy, cz, sz = math.cos(rx), math.sin(rx), math.cos(ry), math.sin(ry), math.cos(rz), math.sin(rz)
    return [
        [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
        [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
        [-sy, cy * sx, cy * cx],
    ]


def moved(turn, shift, point):
    return [sum(turn[i][k] * point[k] for k in range(3)) + shift[i] for i in range(3)]


def tip(x, y, z, has_errors):
    on = 1.0 if has_errors else 0.0
    # The tool, then the slide that carries it, and so on down to the bed.
    point = [0.0, 0.0, -TOOL_M]
    point = moved(turned(on * 60e-6 * z * z, 0, 0), [0, 0, z], point)
    point = moved(turned(15e-6, -22e-6, 0), [0, 0, 0], point)
    point = moved(turned(0, 0, 0), [0, y + on * 90e-6 * y**3, 0], point)
    point = moved(turned(0, 0, 31e-6), [0, 0, 0], point)
    return moved(turned(on * 40e-6 * x, 0, 0), [x * (1 + 12e-6), on * 28e-6 * x * x, 0], point)


def write(name, has_errors, seed):
    chance = random.Random(seed)
    with open(name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["x_mm", "y_mm", "z_mm", "tip_x_mm", "tip_y_mm", "tip_z_mm"])
        for _ in range(160):
            x, y, z = chance.uniform(-0.5, 0.5), chance.uniform(-0.4, 0.4), chance.uniform(-0.3, 0.3)
            seen = [part + chance.gauss(0, NOISE_M) for part in tip(x, y, z, has_errors)]
            writer.writerow(f"{1000 * value:.6f}" for value in [x, y, z, *seen])


if __name__ == "__main__":
    write("plate.csv", True, 1)
    write("clean.csv", False, 2)
