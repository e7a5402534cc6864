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


def fit(start):
    # A faint pull to the start decides what the data leave open.
    return least_squares(lambda x: np.append((predict(x) - measured).ravel(), 1e-6 * x), start, x_scale="jac", xtol=1e-14)


best = min((fit(np.append([0, 0, 0, *turn], np.zeros(3))) for turn in ([0, 0, 0], [0, 0, 2], [0, 0, -2])), key=lambda f: f.cost)
rms = lambda x: np.sqrt(((predict(x) - measured) ** 2).sum() / len(q)) * 1e3
print(f"nominal {rms(best.x):.4f}", f"calibrated {rms(fit(np.append(best.x, np.zeros(24))).x):.4f}")
