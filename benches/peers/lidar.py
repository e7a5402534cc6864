"""The mobile lidar with its thirty errors, direction and point, for any kind of number that has a sine and a cosine.

Written from the published theory alone: a body's transform is position, position error, motion, motion error, multiplied
from the ground up; the error of a vector q is the transform with errors less the one without, times q. Source: "Modeling
Analysis for Positioning Error of Mobile Lidar Based on Multi-Body System Kinematics" (2019), equations 1 to 5 and table 1.
Nothing here comes from trueaxis, its declaration or its generated code.
"""

import math

JOINTS = ["alpha", "beta", "gamma"]

# What lies between the ground and the device, in the order of multiplication: R turns, T shifts, about or along an axis.
FACTORS = [
    # Outer frame.
    ("R", "y", "dtheta_y1"), ("R", "x", "dtheta_x1"),
    ("R", "z", "alpha"),
    ("T", "x", "dx1"), ("T", "y", "dy1"), ("T", "z", "dz1"), ("R", "x", "da1"), ("R", "y", "db1"),
    # Middle frame.
    ("T", "x", "delta_x2"), ("T", "y", "delta_y2"), ("R", "y", "dtheta_y2"), ("R", "z", "dtheta_z2"),
    ("R", "x", "beta"),
    ("T", "x", "dx2"), ("T", "y", "dy2"), ("T", "z", "dz2"), ("R", "y", "db2"), ("R", "z", "dg2"),
    # Inner frame.
    ("T", "y", "delta_y3"), ("R", "y", "dtheta_y3"), ("R", "x", "dtheta_x3"),
    ("R", "z", "gamma"),
    ("T", "x", "dx3"), ("T", "y", "dy3"), ("T", "z", "dz3"), ("R", "x", "da3"), ("R", "y", "db3"),
    # Device.
    ("T", "x", "dx4"), ("T", "y", "dy4"), ("T", "z", "dz4"),
    ("R", "x", "da4"), ("R", "y", "db4"), ("R", "z", "dg4"),
]  # fmt: skip

ERRORS = [name for _, _, name in FACTORS if name not in JOINTS]

# Homogeneous vectors in the frame of the device.
DIRECTION = [0, 0, 1, 0]
POINT = [0, 0, 0, 1]


def turned(axis, s, c, v):
    """R v for a turn of sine s and cosine c; the fourth component stays."""
    x, y, z, w = v
    if axis == "x":
        return [x, c * y - s * z, s * y + c * z, w]
    if axis == "y":
        return [c * x + s * z, y, c * z - s * x, w]
    return [c * x - s * y, s * x + c * y, z, w]


def shifted(axis, amount, v):
    """T v."""
    moved = list(v)
    moved["xyz".index(axis)] = moved["xyz".index(axis)] + amount * v[3]
    return moved


def to_ground(q, values, sin, cos):
    """The product of the factors whose amounts are given, times q; other factors are left out."""
    for kind, axis, name in reversed(FACTORS):
        if name not in values:
            continue
        amount = values[name]
        q = turned(axis, sin(amount), cos(amount), q) if kind == "R" else shifted(axis, amount, q)
    return q[:3]


def exact_error(values, sin, cos):
    """Direction error x, y, z and point error x, y, z."""
    joints = {name: values[name] for name in JOINTS}
    out = []
    for q in (DIRECTION, POINT):
        with_errors, without = to_ground(q, values, sin, cos), to_ground(q, joints, sin, cos)
        out += [a - b for a, b in zip(with_errors, without)]
    return out


def rate(kind, axis, v):
    """The derivative of a factor at amount zero, times v."""
    if kind == "T":
        return shifted(axis, 1, [0, 0, 0, v[3]])[:3] + [0]
    x, y, z, _ = v
    return {"x": [0, -z, y, 0], "y": [z, 0, -x, 0], "z": [-y, x, 0, 0]}[axis]


def first_order_error(values, sin, cos):
    """The same, without products of errors: vector and error carried down together, factor by factor."""
    out = []
    for q in (DIRECTION, POINT):
        error = [0, 0, 0, 0]
        for kind, axis, name in reversed(FACTORS):
            if name in JOINTS:
                s, c = sin(values[name]), cos(values[name])
                q, error = turned(axis, s, c, q), turned(axis, s, c, error)
            else:
                error = [e + values[name] * r for e, r in zip(error, rate(kind, axis, q))]
        out += error[:3]
    return out


def first_order_jacobian(values, sin, cos):
    """Six rows, a column for each error: its derivative where all errors are zero."""
    rows = []
    for q in (DIRECTION, POINT):
        columns = []
        for kind, axis, name in reversed(FACTORS):
            if name in JOINTS:
                s, c = sin(values[name]), cos(values[name])
                q = turned(axis, s, c, q)
                columns = [turned(axis, s, c, column) for column in columns]
            else:
                columns.append(rate(kind, axis, q))
        columns.reverse()
        rows += [[column[i] for column in columns] for i in range(3)]
    return rows


def derivatives():
    """Row and column of each derivative of the first-order Jacobian that is not zero for every pose."""
    found = set()
    for pose in ([0.3, 1.1, -0.7], [2.1, -0.4, 0.9]):
        rows = first_order_jacobian(dict(zip(JOINTS, pose)), math.sin, math.cos)
        found |= {(i, j) for i, row in enumerate(rows) for j, value in enumerate(row) if value != 0}
    return sorted(found)
