"""RMS distance of the UR10's reflector from its prediction, in mm, by SciPy: the nominal geometry with base and
reflector estimated, and all geometry estimated.

Usage: ur10.py ur10-joint-configurations.csv
"""
import csv
import sys

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

D = np.array([0.1273, 0, 0, 0.163941, 0.1157, 0.0922])
A = np.array([0, -0.612, -0.5723, 0, 0, 0])
ALPHA = np.array([np.pi / 2, 0, 0, np.pi / 2, -np.pi / 2, 0])

rows = list(csv.DictReader(open(sys.argv[1])))
q = np.array([[float(row[f"q{k}_rad"]) for k in range(1, 7)] for row in rows])
measured = np.array([[float(row[f"{axis}_mm"]) for axis in "xyz"] for row in rows]) / 1e3


def predict(x):
    base = Rotation.from_rotvec(x[3:6])
    geometry = np.zeros((4, 6)) if len(x) == 9 else x[9:].reshape(4, 6)
    point = np.tile(x[6:9], (len(q), 1))
    for k in range(5, -1, -1):
        dq, dd, da, dalpha = (float(v) for v in geometry[:, k])
        point = Rotation.from_euler("x", ALPHA[k] + dalpha).apply(point)
        point = point + [A[k] + da, 0, D[k] + dd]
        point = Rotation.from_euler("z", (q[:, k] + dq)[:, None]).apply(point)
    return base.apply(point) + x[:3]


def fit(x, step=1e-6):
    # Gauss-Newton by central differences; lstsq keeps combinations that the data hardly show where they are.
    for _ in range(30):
        columns = [(predict(x + e) - predict(x - e)).ravel() / (2 * step) for e in step * np.eye(len(x))]
        design = np.column_stack(columns)
        scale = np.linalg.norm(design, axis=0)
        change, _, rank, _ = np.linalg.lstsq(design / scale, (measured - predict(x)).ravel(), rcond=1e-4)
        change /= scale
        before, x = rms(x), x + change
        if abs(rms(x) - before) < 1e-11:
            return x, rank
    raise SystemExit("not converged")


distance = lambda x: np.linalg.norm(predict(x) - measured, axis=1) * 1e3
rms = lambda x: np.sqrt((distance(x) ** 2).mean())
# The base's turn about z is known well enough from a coarse search.
turned = lambda turn: least_squares(
    lambda x: (predict(x) - measured).ravel(), [0, 0, 0, 0, 0, turn, 0, 0, 0.1], x_scale="jac", ftol=1e-6
)
nominal = fit(min((turned(turn) for turn in (0, 2, -2)), key=lambda f: f.cost).x)[0]
print(f"nominal {rms(nominal):.9f}, mean {distance(nominal).mean():.4f}, median {np.median(distance(nominal)):.4f}")
calibrated, rank = fit(np.append(nominal, np.zeros(24)))
print(f"calibrated {rms(calibrated):.9f}, {rank} combinations")
