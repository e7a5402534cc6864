#!/usr/bin/env python3
"""An imaginary arm with a camera on its hand, and the pixels in which it saw marks.

It shares no code with trueaxis. NumPy alone is needed. The arm has the errors of its declaration and one thing that this
lacks: the elbow's encoder sits off centre.

    python3 simulate.py            writes marks.csv beside this file
"""

import pathlib

import numpy as np

ERRORS = {"zero2": 0.9e-3, "zero3": -1.3e-3, "length3": 0.6e-3, "focal": 1.5e-3}
EYE = np.array([0.8e-3, -1.2e-3, 0.5e-3])
TURNED = (2.1e-3, -1.4e-3, 1.0e-3)
ELBOW_ECCENTRIC, ELBOW_PHASE = 700e-6, 0.8
FOCAL, CENTRE, SIZE = 1180.0, (640.0, 512.0), (1280, 1024)
PIXEL_NOISE = 0.12
MARKS, VIEWS = 14, 26


def about(axis, angle):
    """Rodrigues' formula for a turn about a coordinate axis."""
    k = np.zeros(3)
    k[axis] = 1.0
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def camera(q):
    """How the camera is turned, and where its eye is."""
    e = ERRORS
    elbow = q[2] + e["zero3"] + ELBOW_ECCENTRIC * np.sin(q[2] - ELBOW_PHASE)
    turn, place = about(2, q[0]), np.array([0.0, 0.0, 0.4])
    turn = turn @ about(0, q[1] + e["zero2"])
    place = place + turn @ [0.0, 0.6, 0.0]
    turn = turn @ about(0, elbow)
    place = place + turn @ [0.0, 0.5 + e["length3"], 0.0]
    turn = turn @ about(1, q[3]) @ about(0, q[4])
    place = place + turn @ (np.array([0.0, 0.05, 0.08]) + EYE)
    for axis, angle in enumerate(TURNED):
        turn = turn @ about(axis, angle)
    return turn, place


def seen(q, mark):
    """The pixel of a mark, or none where it is not in the picture."""
    turn, place = camera(q)
    x, y, z = turn.T @ (mark - place)
    if y < 0.2:
        return None
    focal = FOCAL * (1 + ERRORS["focal"])
    pixel = np.array([CENTRE[0] + focal * x / y, CENTRE[1] - focal * z / y])
    return pixel if np.all(pixel > 8) and np.all(pixel < np.array(SIZE) - 8) else None


def rows(random):
    for number in range(MARKS):
        around = random.uniform(-np.pi, np.pi)
        mark = np.array([1.7 * np.cos(around), 1.7 * np.sin(around), random.uniform(0.0, 1.6)])
        views = 0
        while views < VIEWS:
            q = random.uniform([-np.pi, -0.9, -2.2, -np.pi, -1.4], [np.pi, 2.2, 2.2, np.pi, 1.4])
            pixel = seen(q, mark)
            if pixel is None:
                continue
            views += 1
            pixel = pixel + PIXEL_NOISE * random.standard_normal(2)
            joints = ",".join(f"{angle:.7f}" for angle in q)
            yield f"M{number + 1},{joints},{pixel[0]:.3f},{pixel[1]:.3f}\n"


def main():
    here = pathlib.Path(__file__).parent
    with open(here / "marks.csv", "w", newline="\n") as file:
        file.write("mark," + ",".join(f"q{joint} [rad]" for joint in range(1, 6)) + ",u [px],v [px]\n")
        file.writelines(rows(np.random.default_rng(11)))


if __name__ == "__main__":
    main()
