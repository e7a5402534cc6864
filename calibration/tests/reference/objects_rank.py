#!/usr/bin/env python3
"""What four stations can see of the errors of the paper's scanner with its range: ranks by finite differences and SVD.

Independent of trueaxis: NumPy, the homogeneous transforms multiplied here. Writes the readings that it judged, so that the
test judges the same, and prints the ranks.

    python3 objects_rank.py        writes ../objects/lidar-targets.csv and lidar-planes.csv, prints the ranks
"""

import pathlib

import numpy as np

NAMES = (
    "dtheta_y1 dtheta_x1 dx1 dy1 dz1 da1 db1 delta_x2 delta_y2 dtheta_y2 dtheta_z2 dx2 dy2 dz2 db2 dg2 "
    "delta_y3 dtheta_y3 dtheta_x3 dx3 dy3 dz3 da3 db3 dx4 dy4 dz4 da4 db4 dg4"
).split()


def turn(axis, angle):
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(4)
    matrix[i, i], matrix[i, j], matrix[j, i], matrix[j, j] = c, -s, s, c
    return matrix


def shift(x=0.0, y=0.0, z=0.0):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def point(q, e):
    x, y, z = 0, 1, 2
    alpha, beta, gamma, distance = q
    e = dict(zip(NAMES, e))
    frame = np.eye(4)
    for factor in (
        turn(y, e["dtheta_y1"]), turn(x, e["dtheta_x1"]), turn(z, alpha),
        shift(e["dx1"], e["dy1"], e["dz1"]), turn(x, e["da1"]), turn(y, e["db1"]),
        shift(e["delta_x2"], e["delta_y2"]), turn(y, e["dtheta_y2"]), turn(z, e["dtheta_z2"]), turn(x, beta),
        shift(e["dx2"], e["dy2"], e["dz2"]), turn(y, e["db2"]), turn(z, e["dg2"]),
        shift(0.0, e["delta_y3"]), turn(y, e["dtheta_y3"]), turn(x, e["dtheta_x3"]), turn(z, gamma),
        shift(e["dx3"], e["dy3"], e["dz3"]), turn(x, e["da3"]), turn(y, e["db3"]),
        shift(e["dx4"], e["dy4"], e["dz4"]), turn(x, e["da4"]), turn(y, e["db4"]), turn(z, e["dg4"]),
    ):
        frame = frame @ factor
    return (frame @ [0.0, 0.0, distance, 1.0])[:3]


def jacobian(q):
    step = 1e-6
    columns = []
    for at in range(len(NAMES)):
        e = np.zeros(len(NAMES))
        e[at] = step
        columns.append((point(q, e) - point(q, -e)) / (2 * step))
    return np.array(columns).T


def rank(matrix):
    lengths = np.linalg.norm(matrix, axis=0)
    kept = matrix[:, lengths > 1e-6 * lengths.max()]
    values = np.linalg.svd(kept / np.linalg.norm(kept, axis=0), compute_uv=False)
    return int((values > 1e-5 * values[0]).sum())


def without(columns, others):
    """Columns without what the others explain."""
    if others.shape[1] == 0:
        return columns
    u, s, _ = np.linalg.svd(others, full_matrices=False)
    u = u[:, s > 1e-9 * s[0]]
    return columns - u @ (u.T @ columns)


def cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def ranks(rows, poses, planes):
    """Ranks for (stations known, objects known) of rows (station, object, q)."""
    stations, objects = sorted(poses), sorted({row[1] for row in rows})
    answers = {}
    errors, of_stations, of_objects = [], [], []
    for station, label, q in rows:
        r, t = poses[station]
        p = point(q, np.zeros(len(NAMES)))
        block = np.hstack([np.eye(3), -r @ cross(p)])
        moved = r @ jacobian(q)
        if planes is None:
            own, kept = -np.eye(3), np.eye(3)
        else:
            normal, _ = planes[label]
            kept = normal[None, :]
            tangent = np.linalg.svd(normal[None, :])[2][1:]
            own = np.hstack([tangent @ (r @ p + t), [-1.0]])[None, :]
        station_row = np.zeros((len(kept), 6 * len(stations)))
        station_row[:, 6 * stations.index(station):][:, :6] = kept @ block
        object_row = np.zeros((len(kept), 3 * len(objects)))
        object_row[:, 3 * objects.index(label):][:, :3] = own
        errors.append(kept @ moved)
        of_stations.append(station_row)
        of_objects.append(object_row)
    errors, of_stations, of_objects = (np.vstack(part) for part in (errors, of_stations, of_objects))
    for known_stations in (True, False):
        for known_objects in (True, False):
            nuisance = [np.zeros((len(errors), 0))]
            if not known_stations:
                nuisance.append(of_stations)
            if not known_objects:
                nuisance.append(of_objects)
            answers[known_stations, known_objects] = rank(without(errors, np.hstack(nuisance)))
    return answers


def main():
    random = np.random.default_rng(7)
    here = pathlib.Path(__file__).parent.parent / "objects"
    # Two of the poses are far from level, as those of a scanner on a vehicle or on a tilted mount are.
    poses = {}
    for number, (roll, pitch, heading) in enumerate([(0.0, 0.0, 0.0), (0.1, -0.3, 1.2), (-0.4, 0.2, 2.8), (0.2, 0.5, -1.9)]):
        r = (turn(2, heading) @ turn(1, pitch) @ turn(0, roll))[:3, :3]
        poses[f"S{number + 1}"] = (r, random.uniform(-4, 4, 3) * (number > 0))
    targets = {f"T{number + 1}": random.uniform(-9, 9, 3) for number in range(15)}
    planes = {}
    for number in range(12):
        normal = random.standard_normal(3)
        planes[f"P{number + 1}"] = (normal / np.linalg.norm(normal), random.uniform(5, 9))
    rows = {"targets": [], "planes": []}
    for station, (r, t) in poses.items():
        for label, there in targets.items():
            local = r.T @ (there - t)
            distance = np.linalg.norm(local)
            beta = np.arccos(local[2] / distance)
            alpha = np.arctan2(local[0], -local[1])
            for face in range(3):
                q = (alpha, beta) if face % 2 == 0 else ((alpha + 2 * np.pi) % (2 * np.pi) - np.pi, -beta)
                rows["targets"].append((station, label, (*q, random.uniform(-3, 3), distance)))
        for label, (normal, d) in planes.items():
            taken = 0
            while taken < 15:
                q = random.uniform(-3, 3, 3)
                beam = r @ point((*q, 1.0), np.zeros(len(NAMES)))
                along = (d - normal @ t) / (normal @ beam)
                if 0.5 < along < 40:
                    rows["planes"].append((station, label, (*q, along)))
                    taken += 1
    for name, own in rows.items():
        with open(here / f"lidar-{name}.csv", "w", newline="\n") as file:
            file.write("station,object,alpha [rad],beta [rad],gamma [rad],range [m]\n")
            for station, label, q in own:
                file.write(",".join([station, label, *(f"{value:.12f}" for value in q)]) + "\n")
        found = ranks(own, poses, planes if name == "planes" else None)
        for (stations, objects), value in found.items():
            words = ["unknown", "known"]
            print(f"{name}: {words[stations]} stations, {words[objects]} objects: {value}")
    with open(here / "lidar-stations.txt", "w", newline="\n") as file:
        for station, (r, t) in poses.items():
            roll, pitch, heading = np.arctan2(r[2, 1], r[2, 2]), -np.arcsin(r[2, 0]), np.arctan2(r[1, 0], r[0, 0])
            numbers = " ".join(f"{value:.15e}" for value in (*t, roll, pitch, heading))
            file.write(f"{station} {numbers}\n")


if __name__ == "__main__":
    main()
