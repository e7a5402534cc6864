"""SciPy's least_squares on an alt-azimuth mount: rows azimuth, elevation, x, y, z on standard input.

Prints the least time of five runs in seconds, then the estimates in the chain's order: tilt_east, tilt_north,
azimuth_index, nonperpendicularity, elevation_index, collimation.
"""
import sys
import time

import numpy as np
from scipy.optimize import least_squares

az, el, x, y, z = np.loadtxt(sys.stdin, delimiter=",", unpack=True)
level = np.hypot(x, y)
across = y / level, -x / level
along = -x / level * z, -y / level * z, level


def turn(a, b, angle):
    c, s = np.cos(angle), np.sin(angle)
    return c * a - s * b, s * a + c * b


def residual(p):
    tilt_east, tilt_north, azimuth_index, nonperpendicularity, elevation_index, collimation = p
    ux, uy, uz = np.zeros_like(az), np.ones_like(az), np.zeros_like(az)
    ux, uy = turn(ux, uy, collimation)
    uy, uz = turn(uy, uz, el + elevation_index)
    uz, ux = turn(uz, ux, nonperpendicularity)
    ux, uy = turn(ux, uy, -az - azimuth_index)
    uz, ux = turn(uz, ux, tilt_north)
    uy, uz = turn(uy, uz, tilt_east)
    sigma = 2 * np.pi / 648000
    return np.concatenate([across[0] * ux + across[1] * uy, along[0] * ux + along[1] * uy + along[2] * uz]) / sigma


best = np.inf
for _ in range(5):
    start = time.perf_counter()
    fit = least_squares(residual, np.zeros(6), method="lm", x_scale="jac", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    best = min(best, time.perf_counter() - start)
print(best, *(f"{value:.17e}" for value in fit.x))
