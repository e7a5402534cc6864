#!/usr/bin/env python3
"""Writes secret.csv and secret-2.csv to secret-4.csv: stars seen by mounts that may do more than mount.chain says.

Shares no code with the project: plain 3 by 3 rotation matrices and Python's own random numbers.
Run it without an argument to write the files. What the mounts do is told in the book, behind each exercise.
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


def pointing(mount, azimuth, elevation):
    tilt_x, tilt_y, azimuth_index, perpendicularity, elevation_index, collimation = mount["errors"]
    v = (0.0, 1.0, 0.0)
    v = rotate("z", collimation * ARCSEC, v)
    v = rotate("x", elevation_index * ARCSEC, v)
    v = rotate("x", -mount.get("sag", 0) * ARCSEC * math.cos(elevation), v)
    v = rotate("x", elevation, v)
    v = rotate("y", perpendicularity * ARCSEC, v)
    v = rotate("z", azimuth_index * ARCSEC, v)
    v = rotate("z", mount.get("oval", 0) * ARCSEC * math.sin(2 * azimuth), v)
    v = rotate("z", -azimuth, v)
    v = rotate("y", tilt_y * ARCSEC, v)
    return rotate("x", tilt_x * ARCSEC, v)


# Errors in arc seconds: tilt_x, tilt_y, azimuth_index, nonperpendicularity, elevation_index, collimation.
MOUNTS = {
    "secret": {"errors": (15, -7, 40, 9, -12, 22), "sag": 26, "seed": 20, "stars": 160, "elevations": (12, 82)},
    "secret-2": {"errors": (-11, 18, -25, 14, 31, -40), "seed": 21, "stars": 40, "elevations": (12, 82)},
    "secret-3": {"errors": (6, 4, -18, -22, 9, 12), "oval": 8, "seed": 22, "stars": 160, "elevations": (12, 82)},
    "secret-4": {"errors": (15, -7, 40, 9, -12, 22), "sag": 26, "seed": 23, "stars": 100, "elevations": (45, 55)},
}


def write(name, mount):
    random.seed(mount["seed"])
    low, high = (math.sin(math.radians(limit)) for limit in mount["elevations"])
    rows = []
    for _ in range(mount["stars"]):
        azimuth = random.uniform(0, 360)
        elevation = math.degrees(math.asin(random.uniform(low, high)))
        azimuth, elevation = round(azimuth, 4), round(elevation, 4)
        v = pointing(mount, math.radians(azimuth), math.radians(elevation))
        v = [c + random.gauss(0, 2.5 * ARCSEC) for c in v]
        length = math.sqrt(sum(c * c for c in v))
        rows.append([f"{azimuth:.4f}", f"{elevation:.4f}"] + [f"{c / length:.9f}" for c in v])
    with open(pathlib.Path(__file__).with_name(f"{name}.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["azimuth [deg]", "elevation [deg]", "east", "north", "up"])
        writer.writerows(rows)


def main():
    for name, mount in MOUNTS.items():
        write(name, mount)


if __name__ == "__main__":
    main()
