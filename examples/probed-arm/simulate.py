#!/usr/bin/env python3
"""Move an imaginary arm through poses, and write what a tracker with a six-dimensional probe would have recorded.

It shares no code with trueaxis: rotations are multiplied here, as quaternions (w, x, y, z). The arm has the errors of `arm.chain`
and one thing that the declaration lacks: the circle of the wrist sits off centre, so that the wrist turns to
q4 + ECCENTRIC * sin(q4 - PHASE) where the circle says q4. The centre of the probe lies on the axis of the wrist: its place says
nothing of it.

    python3 simulate.py            writes poses.csv beside this file
"""

import pathlib
import random
from math import cos, hypot, pi, radians, sin

ARCSEC = pi / 180 / 3600
HEADING, EAST, NORTH = 2.2, 2.4, -0.7
ERRORS = {
    "base_x": 0.31e-3, "base_y": -0.22e-3, "base_z": 0.40e-3, "base_tilt_x": 45 * ARCSEC, "base_tilt_y": -70 * ARCSEC,
    "zero1": 110 * ARCSEC, "offset2": -0.25e-3, "skew2": 60 * ARCSEC, "zero2": -95 * ARCSEC, "length2": 0.18e-3,
    "skew3": -50 * ARCSEC, "zero3": 130 * ARCSEC, "length3": -0.27e-3, "skew4_x": 75 * ARCSEC, "skew4_z": -40 * ARCSEC,
    "mount_x": 90 * ARCSEC, "mount_y": -140 * ARCSEC, "mount_z": 65 * ARCSEC,
}  # fmt: skip
ECCENTRIC, PHASE = 85 * ARCSEC, 0.9
POINT_NOISE, TURN_NOISE = 30e-6, 12 * ARCSEC
POSES = 80


def times(p, q):
    """The product of two quaternions."""
    a, b, c, d = p
    w, x, y, z = q
    return (
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    )


def turned(q, v):
    """A vector turned by a unit quaternion: q v q*."""
    w, x, y, z = q
    return times(times(q, (0.0, *v)), (w, -x, -y, -z))[1:]


class Frame:
    """A frame that is moved step by step, each step in the frame so far."""

    def __init__(self):
        self.at, self.q = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)

    def shift(self, *by):
        self.at = tuple(a + b for a, b in zip(self.at, turned(self.q, by)))
        return self

    def turn(self, axis, angle):
        q = [cos(angle / 2), 0.0, 0.0, 0.0]
        q[1 + "xyz".index(axis)] = sin(angle / 2)
        self.q = times(self.q, q)
        return self


def probe(q1, q2, q3, q4):
    e = ERRORS
    wrist = q4 + ECCENTRIC * sin(q4 - PHASE)
    f = Frame().shift(EAST, NORTH, 0).turn("z", HEADING)
    f.shift(e["base_x"], e["base_y"], e["base_z"])
    f.turn("x", e["base_tilt_x"]).turn("y", e["base_tilt_y"])
    f.turn("z", q1 + e["zero1"])
    f.shift(0, 0, 0.4).shift(0, e["offset2"], 0).turn("y", e["skew2"]).turn("x", q2 + e["zero2"])
    f.shift(0, 0.6 + e["length2"], 0).turn("z", e["skew3"]).turn("x", q3 + e["zero3"])
    f.shift(0, 0.5 + e["length3"], 0).turn("x", e["skew4_x"]).turn("z", e["skew4_z"]).turn("y", wrist)
    f.shift(0, 0.15, 0).turn("x", e["mount_x"]).turn("y", e["mount_y"]).turn("z", e["mount_z"])
    return f


def main():
    rng = random.Random(20261122)
    rows = ["pose,q1 [deg],q2 [deg],q3 [deg],q4 [deg],x,y,z,qw,qx,qy,qz"]
    for pose in range(1, POSES + 1):
        # The circles say whole hundredths of a degree: what is written is what they said.
        ranges = [(-170, 170), (-40, 80), (-120, -10), (-175, 175)]
        degrees = [round(rng.uniform(low, high), 2) for low, high in ranges]
        f = probe(*map(radians, degrees))
        place = [at + rng.gauss(0, POINT_NOISE) for at in f.at]
        q = times((1.0, *(rng.gauss(0, TURN_NOISE) / 2 for _ in range(3))), f.q)
        # A tracker gives the one quaternion or its opposite, as it comes.
        length = rng.choice([-1, 1]) * hypot(*q)
        numbers = [f"{d:.2f}" for d in degrees] + [f"{1e3 * at:.4f}" for at in place] + [f"{c / length:.8f}" for c in q]
        rows.append(",".join([f"P{pose}", *numbers]))
    pathlib.Path(__file__).with_name("poses.csv").write_text("\n".join(rows) + "\n")


main()
