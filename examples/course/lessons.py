#!/usr/bin/env python3
"""Writes lesson-1.csv to lesson-8.csv: one small data set for each of the first lessons of the course, each with a secret.

Shares no code with the project: plain 3 by 3 rotation matrices, multiplied here, and Python's own random numbers.
Run it without an argument to write the files. The secrets are told in the lessons, behind their exercises; whoever
learns should not read on before.
"""
import csv
import math
import pathlib
import random

ARCSEC = math.pi / 648000
DEGREE = math.pi / 180


def rotate(axis, angle, v):
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = v
    if axis == "x":
        return (x, c * y - s * z, s * y + c * z)
    if axis == "y":
        return (c * x + s * z, y, -s * x + c * z)
    return (c * x - s * y, s * x + c * y, z)


def carried(v, *rotations):
    """The vector after the rotations, the first written acting last, as in a product of matrices."""
    for axis, angle in reversed(rotations):
        v = rotate(axis, angle, v)
    return v


def noisy(v, sigma):
    v = [c + random.gauss(0, sigma) for c in v]
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def lesson_1(alpha):
    """A plate that lies a little wrong under a pointer: 31, -17 and 44 arc seconds about x, y and z."""
    return carried((1, 0, 0), ("x", 31 * ARCSEC), ("y", -17 * ARCSEC), ("z", 44 * ARCSEC), ("z", alpha))


def lesson_2():
    """Large angles: 3 degrees about z and 2 degrees about y."""
    return carried((1, 0, 0), ("z", 3 * DEGREE), ("y", 2 * DEGREE))


def lesson_3(alpha, beta):
    """Two axes: tilt -26, skew 19, index 35 arc seconds."""
    return carried(
        (0, 0, 1),
        ("y", -26 * ARCSEC), ("z", alpha), ("y", 19 * ARCSEC), ("x", beta), ("x", 35 * ARCSEC),
    )  # fmt: skip


def lesson_4(alpha):
    """A table whose top leans and turns with it: 52 arc seconds about y, behind the motion; its axis is upright."""
    return carried((1, 0, 0), ("z", alpha), ("y", 52 * ARCSEC))


def lesson_5(alpha, beta, gamma):
    """The paper's scanner with six of its errors at work."""
    return carried(
        (0, 0, 1),
        ("y", 12 * ARCSEC), ("x", -8 * ARCSEC), ("z", alpha),
        ("y", 30 * ARCSEC), ("z", -21 * ARCSEC), ("x", beta),
        ("y", -14 * ARCSEC), ("z", gamma), ("x", 25 * ARCSEC),
    )  # fmt: skip


def lesson_6(t):
    """The same scanner along the path of the figures, all three angles equal; one error, 20 arc seconds about z."""
    return carried((0, 0, 1), ("z", t), ("z", 20 * ARCSEC), ("x", t), ("z", t))


def lesson_7(azimuth, elevation):
    """A mount in which two pairs of errors are one: 30 - 12 and 5 + 9 arc seconds."""
    return carried(
        (0, 1, 0),
        ("x", 11 * ARCSEC), ("y", -6 * ARCSEC), ("z", 30 * ARCSEC), ("z", -azimuth), ("z", -12 * ARCSEC),
        ("x", 5 * ARCSEC), ("y", 16 * ARCSEC), ("x", elevation), ("x", 9 * ARCSEC), ("y", 70 * ARCSEC),
    )  # fmt: skip


def lesson_8(azimuth):
    """What a controller with first-order formulas reports: the direction, plus the cross product with each small angle."""
    tilt_x, tilt_y, index = 0.8 * DEGREE, -0.6 * DEGREE, 0.9 * DEGREE
    x, y = math.cos(azimuth), math.sin(azimuth)
    return (x - index * y, y + index * x, tilt_x * y - tilt_y * x)


def write(name, header, rows):
    with open(pathlib.Path(__file__).with_name(f"{name}.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def measured(function, poses, sigma):
    """Rows of angles in degrees, rounded as a display rounds them, and the direction, with noise in each component."""
    rows = []
    for pose in poses:
        pose = [round(angle, 3) for angle in pose]
        v = noisy(function(*(angle * DEGREE for angle in pose)), sigma)
        rows.append([f"{angle:.3f}" for angle in pose] + [f"{c:.9f}" for c in v])
    return rows


def main():
    random.seed(1)
    direction = ["x", "y", "z"]
    turn = [[30.0 * step] for step in range(12)]
    write("lesson-1", ["alpha [deg]", *direction], measured(lesson_1, turn, 1 * ARCSEC))
    rows = [[number, *row] for number, row in enumerate(measured(lesson_2, [[]] * 12, 1 * ARCSEC), 1)]
    write("lesson-2", ["reading", *direction], rows)
    poses = [[random.uniform(0, 360), random.uniform(-80, 80)] for _ in range(40)]
    write("lesson-3", ["alpha [deg]", "beta [deg]", *direction], measured(lesson_3, poses, 2 * ARCSEC))
    write("lesson-4", ["alpha [deg]", *direction], measured(lesson_4, turn * 2, 2 * ARCSEC))
    poses = [[random.uniform(-180, 180) for _ in range(3)] for _ in range(60)]
    header = ["alpha [deg]", "beta [deg]", "gamma [deg]", *direction]
    write("lesson-5", header, measured(lesson_5, poses, 2 * ARCSEC))
    path = [[10.0 * step] for step in range(36)]
    rows = measured(lesson_6, path, 1 * ARCSEC)
    write("lesson-6", ["t [deg]", *direction], rows)
    poses = [[random.uniform(0, 360), random.uniform(10, 80)] for _ in range(60)]
    write("lesson-7", ["azimuth [deg]", "elevation [deg]", *direction], measured(lesson_7, poses, 1.5 * ARCSEC))
    write("lesson-8", ["azimuth [deg]", *direction], measured(lesson_8, path, 1 * ARCSEC))


if __name__ == "__main__":
    main()
