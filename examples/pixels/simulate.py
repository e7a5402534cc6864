"""A camera on a pan-tilt head looks at a checkerboard of known corners; the tilt encoder has an index error that the
declaration knows, and the camera's numbers are those of a lens that nobody has calibrated. Shares no code with trueaxis."""

import csv
import math
import random

import numpy as np
from scipy.optimize import least_squares

random.seed(20260)
INTRINSICS = np.array([812.0, 808.5, 322.4, 236.1, -0.21, 0.06, 0.0008, -0.0005])
INDEX = math.radians(0.12)
NOISE_PX = 0.1


def turn(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[j, j], matrix[j, k], matrix[k, j], matrix[k, k] = c, -s, s, c
    return matrix


def image(point, pan, tilt, index, numbers):
    """The camera stands in the origin, turns about y, then about x, and looks along z."""
    x, y, z = (turn(1, pan) @ turn(0, tilt + index)).T @ point
    fx, fy, cx, cy, k1, k2, p1, p2 = numbers
    x, y = x / z, y / z
    r2 = x * x + y * y
    radial = 1 + k1 * r2 + k2 * r2 * r2
    u = fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + cx
    v = fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + cy
    return u, v


corners = [np.array([0.06 * i - 0.21, 0.06 * j - 0.15, 1.0 + 0.2 * (i % 2)]) for i in range(8) for j in range(6)]
rows = []
for pan in np.radians([-14, -7, 0, 7, 14]):
    for tilt in np.radians([-9, 0, 9]):
        for corner in corners:
            u, v = image(corner, pan, tilt, INDEX, INTRINSICS)
            if 0 <= u <= 640 and 0 <= v <= 480:
                u, v = u + random.gauss(0, NOISE_PX), v + random.gauss(0, NOISE_PX)
                rows.append([pan, tilt, *corner, u, v])

with open("corners.csv", "w", newline="") as file:
    table = csv.writer(file, lineterminator="\n")
    table.writerow(["pan", "tilt", "px", "py", "pz", "u", "v"])
    table.writerows([[f"{number:.9g}" for number in row] for row in rows])


def residuals(unknown):
    index, numbers = unknown[0], unknown[1:]
    seen = [image(np.array(row[2:5]), row[0], row[1], index, numbers) for row in rows]
    return (np.array(seen) - np.array([row[5:] for row in rows])).ravel()


start = np.array([0, 800, 800, 320, 240, 0, 0, 0, 0], dtype=float)
fit = least_squares(residuals, start, x_scale=[1e-3, 1, 1, 1, 1, 0.1, 0.1, 1e-3, 1e-3])
print("rows", len(rows), "rms_px", math.sqrt(np.mean(fit.fun**2)))
print("index_rad and intrinsics", [float(f"{number:.9g}") for number in fit.x])
