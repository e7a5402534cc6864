#!/usr/bin/env python3
"""Scan an imaginary room, and write what the scanner's files would hold.

It shares no code with trueaxis: rotations are multiplied here, in the theory's own order. NumPy alone is needed. The
scanner has the errors of `scanner.chain` and one thing that the declaration lacks: the horizontal circle sits off centre,
so that the alidade turns to azimuth + ECCENTRIC * sin(azimuth - PHASE) where the circle says azimuth.

    python3 simulate.py            writes walls.csv and targets.csv beside this file
"""

import pathlib

import numpy as np

ARCSEC = np.pi / 180 / 3600
ERRORS = {
    "axes_apart": 0.4e-3, "trunnion": 25 * ARCSEC, "index": -30 * ARCSEC,
    "beam_aside": -0.6e-3, "collimation": 40 * ARCSEC, "range_zero": 1.5e-3,
}  # fmt: skip
ECCENTRIC, PHASE = 200e-6, 0.7
RANGE_NOISE, ANGLE_NOISE = 0.5e-3, 8 * ARCSEC
# Where the scanner stood, m and rad: shift, heading, and how it was out of level (about x, about y).
STATIONS = {
    "A": ((0.0, 0.0, 1.6), 0.0, 0.002, -0.001),
    "B": ((4.2, -1.1, 1.5), 1.3, -0.001, 0.003),
    "C": ((1.0, 3.9, 1.7), -2.2, 0.001, 0.001),
    "D": ((-3.1, 1.7, 0.9), 2.9, -0.003, 0.002),
}
# Walls, floor, ceiling and boards: normal and distance.
WALLS = {
    "floor": ((0.0, 0.0, 1.0), 0.0), "ceiling": ((0.01, 0.0, -1.0), -3.4), "north": ((0.0, -1.0, 0.0), -7.0),
    "south": ((0.02, 1.0, 0.0), -5.5), "east": ((-1.0, 0.03, 0.0), -8.0), "west": ((1.0, 0.0, 0.02), -6.5),
    "board": ((-0.6, -0.7, 0.3), -4.1), "roof": ((0.5, -0.2, -0.8), -4.6),
}  # fmt: skip


def rotation(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def point(azimuth, elevation, distance):
    """Where the beam ends in the scanner's own frame when it says azimuth, elevation and distance."""
    e, x, y, z = ERRORS, 0, 1, 2
    turned = azimuth + ECCENTRIC * np.sin(azimuth - PHASE)
    p = np.array([0.0, distance + e["range_zero"], 0.0])
    p = rotation(z, e["collimation"]) @ p + [e["beam_aside"], 0.0, 0.0]
    p = rotation(x, elevation) @ rotation(x, e["index"]) @ p
    p = rotation(y, e["trunnion"]) @ p + [0.0, e["axes_apart"], 0.0]
    return rotation(z, -turned) @ p


def outside(station, p):
    shift, heading, roll, pitch = STATIONS[station]
    return rotation(2, heading) @ rotation(1, pitch) @ rotation(0, roll) @ p + np.array(shift)


def walls(random, rows):
    """Beams in all directions; each ends at the nearest wall."""
    for station in STATIONS:
        for _ in range(rows):
            azimuth, elevation = random.uniform(-np.pi, np.pi), random.uniform(-0.9, 1.3)
            if random.random() < 0.5:
                azimuth, elevation = azimuth - np.pi if azimuth > 0 else azimuth + np.pi, np.pi - elevation
            near, far = (outside(station, point(azimuth, elevation, d)) for d in (0.0, 1.0))
            hits = []
            for name, (normal, distance) in WALLS.items():
                n = np.array(normal) / np.linalg.norm(normal)
                along = (distance / np.linalg.norm(normal) - n @ near) / (n @ (far - near))
                if along > 0.3:
                    hits.append((along, name))
            along, name = min(hits)
            yield station, name, azimuth, elevation, along


def targets(random, count, repeats):
    """Targets all round, each in two faces from every station."""
    there = [np.array([random.uniform(-7, 8), random.uniform(-5, 7), random.uniform(0, 3.4)]) for _ in range(count)]
    for station, (shift, heading, roll, pitch) in STATIONS.items():
        turn = rotation(2, heading) @ rotation(1, pitch) @ rotation(0, roll)
        for number, target in enumerate(there):
            local = turn.T @ (target - np.array(shift))
            for face in range(2 * repeats):
                q = np.array([np.arctan2(local[0], local[1]), np.arcsin(local[2] / np.linalg.norm(local)), np.linalg.norm(local)])
                if face % 2:
                    q[0], q[1] = q[0] - np.pi if q[0] > 0 else q[0] + np.pi, np.pi - q[1]
                for _ in range(8):
                    step = 1e-6
                    columns = [(point(*(q + step * e)) - point(*(q - step * e))) / (2 * step) for e in np.eye(3)]
                    q = q + np.linalg.solve(np.array(columns).T, local - point(*q))
                yield station, f"T{number + 1}", *q


def write(name, rows, random):
    here = pathlib.Path(__file__).parent
    with open(here / name, "w", newline="\n") as file:
        file.write("station,object,azimuth [rad],elevation [rad],range [m]\n")
        for station, label, azimuth, elevation, distance in rows:
            azimuth += ANGLE_NOISE * random.standard_normal()
            elevation += ANGLE_NOISE * random.standard_normal()
            distance += RANGE_NOISE * random.standard_normal()
            file.write(f"{station},{label},{azimuth:.9f},{elevation:.9f},{distance:.6f}\n")


if __name__ == "__main__":
    random = np.random.default_rng(19)
    write("walls.csv", walls(random, 150), random)
    write("targets.csv", targets(random, 24, 1), random)
