#!/usr/bin/env python3
"""Drive a profile scanner past walls, and write what its files would hold.

It shares no code with trueaxis. NumPy alone is needed. The scanner sits on the vehicle with the lever arm and boresight below,
and its stamps are late: the vehicle has driven on by LATENCY times its speed when the range is measured.

    python3 simulate.py            writes drives.csv beside this file
"""

import pathlib

import numpy as np

LEVER = np.array([0.012, -0.4 - 0.020, 1.8 + 0.008])
BORESIGHT = np.array([1.5e-3, -2.0e-3, 2.5e-3])
LATENCY = 4e-3
NOISE = 0.003
# Walls, floors and slopes on all sides: normal and distance.
PLANES = {
    "road": ((0.0, 0.0, 1.0), 0.0), "north": ((0.0, -1.0, 0.0), -60.0), "south": ((0.02, 1.0, 0.0), -60.0),
    "east": ((-1.0, 0.03, 0.0), -55.0), "west": ((1.0, 0.05, 0.0), -55.0), "roof": ((0.3, -0.2, -1.0), -25.0),
    "gable": ((-0.7, -0.7, -0.2), -60.0), "bank": ((0.6, -0.5, 0.6), -30.0),
}  # fmt: skip


def turn(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    cross = np.zeros((3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    cross[i, j], cross[j, i] = -1.0, 1.0
    return np.eye(3) + s * cross + (1 - c) * cross @ cross


def drive(random, count):
    """Drives along a figure of eight with the speed of town traffic, out of level as a car is."""
    for _ in range(count):
        t = random.uniform(0, 2 * np.pi)
        east, north = 25 * np.sin(t), 20 * np.sin(2 * t)
        heading = np.arctan2(25 * np.cos(t), 40 * np.cos(2 * t))
        speed = 8 + 6 * np.sin(3 * t) + random.uniform(-1, 1)
        pitch, roll = 0.03 * random.standard_normal(2)
        yield east, north, 0.5 + 0.1 * random.standard_normal(), heading, pitch, roll, speed, random.uniform(-np.pi, np.pi)


def main(random, rows):
    lines = []
    for east, north, up, heading, pitch, roll, speed, angle in drive(random, rows):
        vehicle = turn(2, -heading) @ turn(0, pitch) @ turn(1, roll)
        place = np.array([east, north, up]) + vehicle @ np.array([0.0, LATENCY * speed, 0.0])
        sight = turn(0, BORESIGHT[0]) @ turn(1, BORESIGHT[1]) @ turn(2, BORESIGHT[2]) @ turn(1, angle)
        origin, beam = place + vehicle @ LEVER, vehicle @ sight @ np.array([0.0, 0.0, 1.0])
        hits = []
        for name, (normal, distance) in PLANES.items():
            n = np.array(normal) / np.linalg.norm(normal)
            along = (distance / np.linalg.norm(normal) - n @ origin) / (n @ beam)
            if along > 1.0:
                hits.append((along, name))
        if not hits:
            continue
        along, name = min(hits)
        along += NOISE * random.standard_normal()
        pose = f"{east:.4f},{north:.4f},{up:.4f},{heading:.6f},{pitch:.6f},{roll:.6f}"
        lines.append(f"{name},{pose},{speed:.3f},{angle:.6f},{along:.4f}\n")
    with open(pathlib.Path(__file__).parent / "drives.csv", "w", newline="\n") as file:
        file.write("wall,east [m],north [m],up [m],heading [rad],pitch [rad],roll [rad],way [m],angle [rad],range [m]\n")
        file.writelines(lines)


if __name__ == "__main__":
    main(np.random.default_rng(20), 900)
