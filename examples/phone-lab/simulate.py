#!/usr/bin/env python3
"""A phone on a stack of books looks down at a printed sheet on a turntable. Simulated, for those who have none.

It shares no code with trueaxis; NumPy alone is needed. The sheet was glued 2.1 mm off the axis of the table. So the printed degrees
are off centre as well, which the declaration does not know.

    python3 simulate.py            writes marks.csv beside this file
"""

import pathlib

import numpy as np

MARKS_MM = [(62, 0), (20, 58), (-45, 40), (-55, -30), (0, -64), (28, -12)]
SHEET_MM = np.array([1.6, -1.4])  # where the centre of the sheet lies on the table
DIAL_MM = 90.0  # radius of the printed circle
EYE_MM = np.array([6.0, -262.0, 309.0])  # where the lens is; the books were meant for 0, -270, 300
LOOKS_AT_MM = np.array([4.0, 3.0, 0.0])
ROLL = np.radians(0.8)
FOCAL, SHORTER, CENTRE, SIZE = 1512.0, -0.035, (960.0, 540.0), (1920, 1080)
NOISE_PX = 0.5  # of a finger that puts the cross-hairs on a mark
SET_DEG = 0.05  # of a hand that turns the table to a line of the dial


def camera():
    """The axes of the camera as rows: right, down, ahead."""
    ahead = LOOKS_AT_MM - EYE_MM
    ahead = ahead / np.linalg.norm(ahead)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right = right / np.linalg.norm(right)
    down = np.cross(ahead, right)
    return np.array([np.cos(ROLL) * right + np.sin(ROLL) * down, np.cos(ROLL) * down - np.sin(ROLL) * right, ahead])


def turned(alpha):
    """How far the table has really turned where the pointer reads alpha on the dial.

    The pointer is a pin in the base of the table, on the x axis. Seen from the centre of the dial it has the angle minus alpha.
    """
    angle = alpha
    for _ in range(50):
        pin = DIAL_MM * np.array([np.cos(angle), -np.sin(angle)]) - SHEET_MM
        missing = alpha + np.arctan2(pin[1], pin[0])
        angle += np.arctan2(np.sin(missing), np.cos(missing))
    return angle


def seen(alpha, mark, view):
    """The pixel of a mark."""
    x, y = np.array(mark) + SHEET_MM
    place = np.array([np.cos(alpha) * x - np.sin(alpha) * y, np.sin(alpha) * x + np.cos(alpha) * y, 0.0])
    right, down, ahead = view @ (place - EYE_MM)
    u, v = right / ahead, down / ahead
    bent = FOCAL * (1 + SHORTER * (u * u + v * v))
    return CENTRE[0] + bent * u, CENTRE[1] + bent * v


def main():
    random, view = np.random.default_rng(20261), camera()
    lines = ["picture,mark,alpha [deg],px [mm],py [mm],u [px],v [px]\n"]
    for picture, degrees in enumerate(range(0, 360, 15), start=1):
        alpha = turned(np.radians(degrees + SET_DEG * random.standard_normal()))
        for number, mark in enumerate(MARKS_MM, start=1):
            u, v = np.array(seen(alpha, mark, view)) + NOISE_PX * random.standard_normal(2)
            assert 0 < u < SIZE[0] and 0 < v < SIZE[1], (degrees, mark, u, v)
            lines.append(f"{picture},{number},{degrees},{mark[0]},{mark[1]},{u:.1f},{v:.1f}\n")
    with open(pathlib.Path(__file__).parent / "marks.csv", "w", newline="\n") as file:
        file.writelines(lines)


if __name__ == "__main__":
    main()
