#!/usr/bin/env python3
"""Write a drive and a flight past planes: a trajectory as SBET, and what a scanner saw, by time.

Written from the public description of SBET (17 little-endian doubles a record; radians, metres, seconds; body axes forward, right,
down; heading = platform heading - wander angle) and of WGS 84 (a = 6378137 m, 1/f = 298.257223563). It shares no code with trueaxis.
NumPy alone is needed.

    python3 simulate.py [FOLDER [SEED]]      default: beside this file, seed 6
"""

import pathlib
import sys

import numpy as np

A, F = 6378137.0, 1 / 298.257223563
E2 = F * (2 - F)
ADJUSTED = 1e9
WEEK, WEEKS = 604800.0, 2315


def turn(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array(
        {
            "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis]
    )


def body(heading, pitch, roll):
    """From forward, right, down to north, east, down."""
    return turn("z", heading) @ turn("y", pitch) @ turn("x", roll)


def north_east_down(latitude, longitude):
    """North, east and down as columns of geocentric components."""
    sp, cp, sl, cl = np.sin(latitude), np.cos(latitude), np.sin(longitude), np.cos(longitude)
    return np.array([[-sp * cl, -sl, -cp * cl], [-sp * sl, cl, -cp * sl], [cp, 0, -sp]])


def geocentric(latitude, longitude, height):
    n = A / np.sqrt(1 - E2 * np.sin(latitude) ** 2)
    return np.array(
        [
            (n + height) * np.cos(latitude) * np.cos(longitude),
            (n + height) * np.cos(latitude) * np.sin(longitude),
            (n * (1 - E2) + height) * np.sin(latitude),
        ]
    )


def geodetic(p):
    """By Newton's method on the three equations above."""
    latitude, longitude, height = np.arcsin(p[2] / np.linalg.norm(p)), np.arctan2(p[1], p[0]), 0.0
    guess = np.array([latitude, longitude, height])
    for _ in range(12):
        steps = np.array([1e-6, 1e-6, 1.0])
        jacobian = np.stack(
            [(geocentric(*(guess + np.eye(3)[i] * steps[i])) - geocentric(*(guess - np.eye(3)[i] * steps[i]))) / (2 * steps[i]) for i in range(3)], axis=1
        )
        guess = guess - np.linalg.solve(jacobian, geocentric(*guess) - p)
    return guess


class Place:
    """North, east and down about a place, in which the truth is made up."""

    def __init__(self, latitude, longitude, height):
        self.axes = north_east_down(latitude, longitude)
        self.centre = geocentric(latitude, longitude, height)

    def record(self, time, place, attitude, wander):
        latitude, longitude, height = geodetic(self.centre + self.axes @ place)
        m = north_east_down(latitude, longitude).T @ self.axes @ attitude
        heading, pitch, roll = np.arctan2(m[1, 0], m[0, 0]), -np.arcsin(m[2, 0]), np.arctan2(m[2, 1], m[2, 2])
        # Velocities, accelerations and rates are not read: numbers that can be told from each other.
        return [time, latitude, longitude, height, 1.5, -2.5, 0.25, roll, pitch, heading + wander, wander, 0.5, 0.75, -9.75, 0.125, -0.125, 0.0625]


def seen(origin, beam, planes):
    """The first plane that a beam meets: its name and the distance."""
    hits = []
    for name, (normal, distance) in planes.items():
        toward = normal @ beam
        if abs(toward) > 0.15:
            along = (distance - normal @ origin) / toward
            if along > 1.0:
                hits.append((along, name))
    return min(hits) if hits else None


def unit(v):
    return np.array(v, float) / np.linalg.norm(v)


def street(random):
    """A figure of eight in a street, 40 records a second; a profile scanner behind the roof turns about the way ahead, from up to the left."""
    mount = np.array([[0.0, 0.0, -1.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]])  # columns: the scanner's x, y, z as forward, right, down
    boresight = body(*np.radians([0.35, -0.22, 0.41]))
    lever = np.array([-0.62, 0.17, -0.95])
    place = Place(np.radians(48.2083), np.radians(16.3725), 190.0)
    normals = {
        "road": ([0, 0, 1], 1.9), "north": ([1, 0.02, 0], 42), "south": ([-1, 0.1, 0.03], 40), "east": ([0.05, 1, 0], 45), "west": ([0.1, -1, 0], 44),
        "bank": ([0.6, 0.5, 0.6], 40), "gable": ([-0.5, 0.6, -0.4], 38), "roof": ([0.3, -0.5, -0.8], 24), "gate": ([-0.5, -0.7, -0.1], 50),
    }  # fmt: skip
    planes = {name: (unit(n), d / np.linalg.norm(n)) for name, (n, d) in normals.items()}

    def pose(t):
        w = 2 * np.pi / 50
        north, east = 18 * np.sin(w * t), 14 * np.sin(2 * w * t)
        heading = np.arctan2(28 * w * np.cos(2 * w * t), 18 * w * np.cos(w * t))
        pitch, roll = 0.03 * np.sin(0.9 * t + 1), 0.04 * np.sin(0.7 * t)
        return np.array([north, east, 0.1 * np.sin(0.5 * t)]), body(heading, pitch, roll)

    start = 309_600.0
    records = [place.record(start + k / 40, *pose(k / 40), 0.01) for k in range(50 * 40 + 1)]
    lines = ["gps_time [s],wall,angle [deg],range [m]"]
    for t in np.sort(random.uniform(0.2, 49.8, 900)):
        position, attitude = pose(t)
        angle = random.uniform(-np.pi, np.pi)
        sight = np.array([np.cos(angle), np.sin(angle), 0.0])
        hit = seen(position + attitude @ lever, attitude @ boresight @ mount @ sight, planes)
        if hit:
            stamp = start + t + WEEK * WEEKS - ADJUSTED
            lines.append(f"{stamp:.6f},{hit[1]},{np.degrees(angle):.5f},{hit[0] + 0.004 * random.standard_normal():.4f}")
    return records, lines


def flight(random):
    """Crossing lines 400 m above roofs; the scanner looks down and has points as x (forward), y (right), z (down)."""
    boresight = body(*np.radians([-0.3, 0.15, 0.25]))
    lever = np.array([0.35, -0.12, 0.41])
    place = Place(np.radians(-33.87), np.radians(151.21), 60.0)
    planes = {}
    for number in range(40):
        centre = np.append(random.uniform(-600, 600, 2), random.uniform(-12, 0))
        slope, way = np.radians(random.uniform(5, 50)), random.uniform(-np.pi, np.pi)
        planes[number] = (centre, np.array([np.sin(slope) * np.cos(way), np.sin(slope) * np.sin(way), -np.cos(slope)]))
    lines_flown = [(h, off) for h in (0, 180, 90, 270) for off in (-200, 200)]
    span = 24.0

    def pose(t):
        heading, off = lines_flown[min(int(t // span), len(lines_flown) - 1)]
        along = (t % span - span / 2) * 60
        h = np.radians(heading)
        way = np.array([np.cos(h), np.sin(h), 0]) * along + np.array([-np.sin(h), np.cos(h), 0]) * off
        wobble = 0.02 * np.sin(0.3 * t), 0.02 * np.sin(0.23 * t + 2), 0.03 * np.sin(0.31 * t + 1)
        return way + [0, 0, -400 + 5 * np.sin(0.1 * t)], body(h + wobble[0], 0.03 + wobble[1], wobble[2])

    start = 120_000.0
    records, lines = [], ["time_of_week,x,y,z,intensity,plane_id"]
    rate = 10
    for line in range(len(lines_flown)):
        records += [place.record(start + line * (span + 100) + k / rate, *pose(line * span + k / rate), -0.02) for k in range(int(span * rate))]
        for _ in range(4000):
            t = line * span + random.uniform(0.1, span - 0.3)
            number = int(random.integers(40))
            centre, normal = planes[number]
            position, attitude = pose(t)
            point = centre + np.cross(normal, random.uniform(-8, 8, 3))
            sight = (attitude @ boresight).T @ (point - position - attitude @ lever)
            if abs(sight[0]) < 40 and abs(sight[1]) < abs(sight[2]) and len(lines) < (line + 1) * 120:
                sight = sight * (1 + 0.02 * random.standard_normal() / np.linalg.norm(sight))
                lines.append(f"{start + line * (span + 100) + t - line * span:.6f},{sight[0]:.4f},{sight[1]:.4f},{sight[2]:.4f},{random.integers(200)},{number}")
    return records, lines


def main(folder, seed):
    for name, make in (("street", street), ("flight", flight)):
        records, lines = make(np.random.default_rng(seed))
        np.array(records, dtype="<f8").tofile(folder / f"{name}.sbet")
        (folder / f"{name}.csv").write_text("\n".join(lines) + "\n", newline="\n")


if __name__ == "__main__":
    given = sys.argv[1:]
    main(pathlib.Path(given[0]) if given else pathlib.Path(__file__).parent, int(given[1]) if len(given) > 1 else 6)
