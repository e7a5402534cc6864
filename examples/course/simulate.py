#!/usr/bin/env python3
"""Writes secret.csv: 160 stars seen by a mount that does one thing that mount.chain does not say.

Shares no code with the project: plain 3 by 3 rotation matrices and Python's own random numbers.
Run it without an argument to write the file. What the mount does is told in the book's last exercise.
"""
import csv
import math
import pathlib
import random

ARCSEC = math.pi / 648000


def rotate(axis, angle, v):
    c, s = math.cos(angle), math.sin(angle)
    x, y, z = v
    if axis == "x":
        return (x, c * y - s * z, s * y + c * z)
    if axis == "y":
        return (c * x + s * z, y, -s * x + c * z)
    return (c * x - s * y, s * x + c * y, z)


def pointing(azimuth, elevation):
    v = (0.0, 1.0, 0.0)
    v = rotate("z", 22 * ARCSEC, v)  # collimation
    v = rotate("x", -12 * ARCSEC, v)  # elevation index
    v = rotate("x", -26 * ARCSEC * math.cos(elevation), v)  # the secret
    v = rotate("x", elevation, v)
    v = rotate("y", 9 * ARCSEC, v)  # axes not at right angles
    v = rotate("z", 40 * ARCSEC, v)  # azimuth index
    v = rotate("z", -azimuth, v)
    v = rotate("y", -7 * ARCSEC, v)  # lean of the azimuth axis
    return rotate("x", 15 * ARCSEC, v)


def main():
    random.seed(20)
    rows = []
    for _ in range(160):
        azimuth = random.uniform(0, 360)
        elevation = math.degrees(math.asin(random.uniform(math.sin(math.radians(12)), math.sin(math.radians(82)))))
        azimuth, elevation = round(azimuth, 4), round(elevation, 4)
        v = pointing(math.radians(azimuth), math.radians(elevation))
        v = [c + random.gauss(0, 2.5 * ARCSEC) for c in v]
        length = math.sqrt(sum(c * c for c in v))
        rows.append([f"{azimuth:.4f}", f"{elevation:.4f}"] + [f"{c / length:.9f}" for c in v])
    with open(pathlib.Path(__file__).with_name("secret.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["azimuth [deg]", "elevation [deg]", "east", "north", "up"])
        writer.writerows(rows)


if __name__ == "__main__":
    main()
