#!/usr/bin/env python3
"""Measure an imaginary three-axis scanner, and write what a laboratory would have written down.

It shares no code with trueaxis: the homogeneous transforms are multiplied here, from the theory's own order
(position error, motion, motion error; body after body from the ground up). Python's standard library is
enough. The scanner has the errors of `mobile-lidar.chain` and one thing that the declaration lacks: the
encoder of the middle axis sits off centre, so the frame turns to beta + E_COS cos(beta) + E_SIN sin(beta)
where the encoder says beta.

    python3 simulate.py            writes measured.csv and second-run.csv beside this file
"""

import math
import pathlib
import random

ARCSEC = math.pi / 180 / 3600

# What the declaration knows of, in arcseconds. Shifts do not move a direction, so there are none here.
ERRORS = {
    "dtheta_y1": 21.0, "dtheta_x1": -14.0, "da1": 6.0, "db1": -4.0,
    "dtheta_y2": 33.0, "dtheta_z2": -18.0, "db2": 7.0, "dg2": 5.0,
    "dtheta_y3": -12.0, "dtheta_x3": 27.0, "da3": 4.0, "db3": -6.0,
    "da4": 40.0, "db4": -25.0, "dg4": 15.0,
}  # fmt: skip

# What it does not know of: the encoder's eccentricity, in arcseconds.
E_COS, E_SIN = 6.0, 8.0

NOISE_ARCSEC = 2.0  # standard deviation along each of two directions across the beam


def rotation(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = [[float(row == column) for column in range(3)] for row in range(3)]
    matrix[i][i], matrix[i][j], matrix[j][i], matrix[j][j] = c, -s, s, c
    return matrix


def product(*factors):
    result = factors[0]
    for factor in factors[1:]:
        result = [
            [sum(result[i][k] * factor[k][j] for k in range(3)) for j in range(3)] for i in range(3)
        ]
    return result


def beam(alpha, beta, gamma):
    """The direction of the laser in the ground frame when the encoders say alpha, beta, gamma."""
    e = {name: value * ARCSEC for name, value in ERRORS.items()}
    turned = beta + (E_COS * math.cos(beta) + E_SIN * math.sin(beta)) * ARCSEC
    x, y, z = 0, 1, 2
    frame = product(
        rotation(y, e["dtheta_y1"]), rotation(x, e["dtheta_x1"]),
        rotation(z, alpha), rotation(x, e["da1"]), rotation(y, e["db1"]),
        rotation(y, e["dtheta_y2"]), rotation(z, e["dtheta_z2"]),
        rotation(x, turned), rotation(y, e["db2"]), rotation(z, e["dg2"]),
        rotation(y, e["dtheta_y3"]), rotation(x, e["dtheta_x3"]),
        rotation(z, gamma), rotation(x, e["da3"]), rotation(y, e["db3"]),
        rotation(x, e["da4"]), rotation(y, e["db4"]), rotation(z, e["dg4"]),
    )  # fmt: skip
    return [row[2] for row in frame]


def with_noise(direction, chance):
    """The direction moved across itself by independent normal amounts."""
    least = min(range(3), key=lambda axis: abs(direction[axis]))
    across = [float(axis == least) for axis in range(3)]
    along = sum(a * b for a, b in zip(across, direction))
    across = [a - along * b for a, b in zip(across, direction)]
    length = math.hypot(*across)
    u = [a / length for a in across]
    v = [
        direction[1] * u[2] - direction[2] * u[1],
        direction[2] * u[0] - direction[0] * u[2],
        direction[0] * u[1] - direction[1] * u[0],
    ]
    p, q = (chance.gauss(0.0, NOISE_ARCSEC * ARCSEC) for _ in "uv")
    moved = [d + p * a + q * b for d, a, b in zip(direction, u, v)]
    length = math.hypot(*moved)
    return [m / length for m in moved]


def run(path, sessions, poses, seed):
    """Write one run: a few sessions, each at its own temperature, with poses spread over all turns."""
    chance = random.Random(seed)
    lines = ["session,ambient_celsius,alpha_deg,beta_deg,gamma_deg,pointing_x,pointing_y,pointing_z"]
    for session in range(1, sessions + 1):
        celsius = chance.uniform(12.0, 26.0)
        for _ in range(poses):
            degrees = [round(chance.uniform(-180.0, 180.0), 4) for _ in range(3)]
            direction = with_noise(beam(*map(math.radians, degrees)), chance)
            cells = [f"{session}", f"{celsius + chance.gauss(0.0, 0.2):.2f}"]
            cells += [f"{angle:.4f}" for angle in degrees] + [f"{d:.10f}" for d in direction]
            lines.append(",".join(cells))
    path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    here = pathlib.Path(__file__).parent
    run(here / "measured.csv", sessions=20, poses=20, seed=2019)
    run(here / "second-run.csv", sessions=5, poses=20, seed=2020)
