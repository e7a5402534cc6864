"""SciPy's least_squares, or Ceres, on an alt-azimuth mount: rows azimuth, elevation, x, y, z on standard input.

Usage: peer.py scipy|ceres < rows.csv

Prints the least time of five runs and the least processor time, in seconds, then the estimates in the chain's order:
tilt_east, tilt_north, azimuth_index, nonperpendicularity, elevation_index, collimation. Residuals are NumPy's in both;
Ceres (pip install pyceres) gets its derivatives by complex steps, exact to the last bits.
"""
import sys
import time

import numpy as np

az, el, x, y, z = np.loadtxt(sys.stdin, delimiter=",", unpack=True)
level = np.hypot(x, y)
across = y / level, -x / level
along = -x / level * z, -y / level * z, level
sigma = 2 * np.pi / 648000


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
    return np.concatenate([across[0] * ux + across[1] * uy, along[0] * ux + along[1] * uy + along[2] * uz]) / sigma


def scipy():
    from scipy.optimize import least_squares

    tight = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15}
    return lambda: least_squares(residual, np.zeros(6), method="lm", x_scale="jac", **tight).x


def ceres():
    import pyceres

    class Mount(pyceres.CostFunction):
        def __init__(self):
            super().__init__()
            self.set_num_residuals(2 * len(az))
            self.set_parameter_block_sizes([6])

        def Evaluate(self, parameters, residuals, jacobians):
            p = parameters[0]
            residuals[:] = residual(p)
            if jacobians is not None:
                steps = [residual(p + 1e-30j * np.eye(6)[k]).imag / 1e-30 for k in range(6)]
                jacobians[0][:] = np.stack(steps, axis=1).ravel()
            return True

    def run():
        p = np.zeros(6)
        problem = pyceres.Problem()
        problem.add_residual_block(Mount(), None, [p])
        options = pyceres.SolverOptions()
        options.linear_solver_type = pyceres.LinearSolverType.DENSE_QR
        options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 1e-15
        options.minimizer_progress_to_stdout = False
        options.num_threads = 2
        pyceres.solve(options, problem, pyceres.SolverSummary())
        return p

    return run


run = {"scipy": scipy, "ceres": ceres}[sys.argv[1]]()
wall = processor = np.inf
for _ in range(5):
    start = time.perf_counter(), time.process_time()
    found = run()
    wall = min(wall, time.perf_counter() - start[0])
    processor = min(processor, time.process_time() - start[1])
print(wall, processor, *(f"{value:.17e}" for value in found))
