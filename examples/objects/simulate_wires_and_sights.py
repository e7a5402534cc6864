#!/usr/bin/env python3
"""An imaginary arm on wires and bars, and an imaginary theodolite, and what their files would hold.

It shares no code with trueaxis. NumPy alone is needed. Both instruments have the errors of their declarations and one thing
that these lack: the shoulder's encoder of the arm, and the horizontal circle of the theodolite, sit off centre.

    python3 simulate_wires_and_sights.py            writes wires.csv, bars.csv, rings.csv and sights.csv beside this file
"""

import pathlib

import numpy as np

ARCSEC = np.pi / 180 / 3600
ARM = {"zero2": 0.8e-3, "length2": 0.7e-3, "zero3": -1.1e-3, "length3": -0.5e-3, "aside": 0.9e-3}
SHOULDER_ECCENTRIC, SHOULDER_PHASE = 600e-6, 0.4
WIRE_NOISE = 0.1e-3
RADIUS = 0.25
PIVOTS = {"P1": (1.1, 0.4, -0.3), "P2": (-0.9, 1.2, 0.1), "P3": (-0.7, -1.3, 1.4), "P4": (0.8, -1.0, 0.6)}
SIGHTS = {"trunnion": 12 * ARCSEC, "index": -18 * ARCSEC, "collimation": 25 * ARCSEC}
CIRCLE_ECCENTRIC, CIRCLE_PHASE = 20 * ARCSEC, -0.9
ANGLE_NOISE = 3 * ARCSEC
# Shift, heading, and how far out of level about x and y.
STATIONS = {
    "A": ((0.1, -0.05, 1.62), 0.01, 0.001, -0.002),
    "B": ((9.2, 0.9, 1.48), 1.41, -0.002, 0.001),
    "C": ((2.9, 8.1, 1.71), -2.08, 0.001, 0.001),
    "D": ((-6.1, 4.8, 1.43), 2.80, 0.002, -0.001),
}


def about(axis, angle):
    """Rodrigues' formula for a turn about a coordinate axis."""
    k = np.zeros(3)
    k[axis] = 1.0
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def tip(q1, q2, q3):
    e = ARM
    shoulder = q2 + e["zero2"] + SHOULDER_ECCENTRIC * np.sin(q2 - SHOULDER_PHASE)
    p = np.array([e["aside"], 0.5 + e["length3"], 0.0])
    p = about(0, q3 + e["zero3"]) @ p + [0.0, 0.6 + e["length2"], 0.0]
    return about(2, q1) @ (about(0, shoulder) @ p + [0.0, 0.0, 0.4])


def wires(random):
    for drum in range(6):
        anchor = np.array([random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 1.8)])
        lacks = random.uniform(-0.05, 0.05)
        for _ in range(70):
            q = random.uniform(-np.pi, np.pi), random.uniform(-1.2, 2.6), random.uniform(-2.4, 2.4)
            length = np.linalg.norm(tip(*q) - anchor) - lacks + WIRE_NOISE * random.standard_normal()
            yield f"D{drum + 1},{q[0]:.7f},{q[1]:.7f},{q[2]:.7f},{length:.6f}\n"


def bars(random):
    """A telescoping bar from each of four pivots to the tip; it reads its whole length."""
    for name, pivot in PIVOTS.items():
        for _ in range(50):
            q = random.uniform(-np.pi, np.pi), random.uniform(-1.2, 2.6), random.uniform(-2.4, 2.4)
            length = np.linalg.norm(tip(*q) - np.array(pivot)) + WIRE_NOISE * random.standard_normal()
            yield f"{name},{q[0]:.7f},{q[1]:.7f},{q[2]:.7f},{length * 1e3:.3f}\n"


def rings(random):
    """The tip holds a ball at the end of a crank that turns about one of four axes; every other crank is 20 mm shorter."""
    for crank in range(4):
        around = np.pi / 2 * crank + random.uniform(-0.4, 0.4)
        centre = np.array([0.65 * np.cos(around), 0.65 * np.sin(around), random.uniform(0.2, 0.8)])
        axis = random.standard_normal(3)
        axis /= np.linalg.norm(axis)
        across = np.cross(axis, [0.3, 0.5, 0.8])
        across /= np.linalg.norm(across)
        along = np.cross(axis, across)
        radius = RADIUS - 0.02 * (crank % 2)
        rows = 0
        while rows < 60:
            turned = random.uniform(-np.pi, np.pi)
            ball = centre + radius * (np.cos(turned) * across + np.sin(turned) * along)
            ball = ball + WIRE_NOISE * random.standard_normal(3)
            q = random.uniform([-np.pi, -1.2, -2.4], [np.pi, 2.6, 2.4])
            for _ in range(30):
                step = 1e-6
                columns = [(tip(*(q + step * e)) - tip(*(q - step * e))) / (2 * step) for e in np.eye(3)]
                change = np.linalg.lstsq(np.array(columns).T, ball - tip(*q), rcond=None)[0]
                q = q + change * min(1.0, 0.5 / max(np.abs(change).max(), 1e-12))
            q[0] = (q[0] + np.pi) % (2 * np.pi) - np.pi
            if np.linalg.norm(tip(*q) - ball) > 1e-9 or not -1.2 < q[1] < 2.6 or not -2.4 < q[2] < 2.4:
                continue
            rows += 1
            yield f"C{crank + 1},{q[0]:.7f},{q[1]:.7f},{q[2]:.7f},{radius * 1e3:.0f}\n"


def beam(azimuth, elevation):
    e = SIGHTS
    turned = azimuth + CIRCLE_ECCENTRIC * np.sin(azimuth - CIRCLE_PHASE)
    sight = about(0, elevation + e["index"]) @ about(2, e["collimation"]) @ [0.0, 1.0, 0.0]
    return about(2, -turned) @ about(1, e["trunnion"]) @ sight


def sights(random):
    marks = [np.array([random.uniform(-15, 18), random.uniform(-13, 20), random.uniform(-1, 9)]) for _ in range(22)]
    for station, (shift, heading, roll, pitch) in STATIONS.items():
        turn = about(2, heading) @ about(1, pitch) @ about(0, roll)
        for number, mark in enumerate(marks):
            local = turn.T @ (mark - np.array(shift))
            local /= np.linalg.norm(local)
            for face in (False, True):
                q = np.array([np.arctan2(local[0], local[1]), np.arcsin(local[2])])
                if face:
                    q = np.array([q[0] - np.pi if q[0] > 0 else q[0] + np.pi, np.pi - q[1]])
                for _ in range(8):
                    step = 1e-6
                    columns = [(beam(*(q + step * e)) - beam(*(q - step * e))) / (2 * step) for e in np.eye(2)]
                    q = q + np.linalg.lstsq(np.array(columns).T, local - beam(*q), rcond=None)[0]
                q = q + ANGLE_NOISE * random.standard_normal(2)
                yield f"{station},M{number + 1},{q[0]:.9f},{q[1]:.9f}\n"


def main():
    here = pathlib.Path(__file__).parent
    with open(here / "wires.csv", "w", newline="\n") as file:
        file.write("drum,q1 [rad],q2 [rad],q3 [rad],length [m]\n")
        file.writelines(wires(np.random.default_rng(3)))
    with open(here / "bars.csv", "w", newline="\n") as file:
        file.write("pivot,q1 [rad],q2 [rad],q3 [rad],length [mm]\n")
        file.writelines(bars(np.random.default_rng(5)))
    with open(here / "rings.csv", "w", newline="\n") as file:
        file.write("crank,q1 [rad],q2 [rad],q3 [rad],radius [mm]\n")
        file.writelines(rings(np.random.default_rng(6)))
    with open(here / "sights.csv", "w", newline="\n") as file:
        file.write("station,mark,azimuth [rad],elevation [rad]\n")
        file.writelines(sights(np.random.default_rng(4)))


if __name__ == "__main__":
    main()
