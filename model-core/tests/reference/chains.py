"""The two chains of the reference scripts, written down a second time, independently of the declarations.

A factor is (transform, amount); the amounts are Python expressions. Needs nothing but Python.
"""

LIDAR = [
    ("Ry", "dtheta_y1"), ("Rx", "dtheta_x1"), ("Rz", "alpha"),
    ("Tx", "dx1"), ("Ty", "dy1"), ("Tz", "dz1"), ("Rx", "da1"), ("Ry", "db1"),
    ("Tx", "delta_x2"), ("Ty", "delta_y2"), ("Ry", "dtheta_y2"), ("Rz", "dtheta_z2"), ("Rx", "beta"),
    ("Tx", "dx2"), ("Ty", "dy2"), ("Tz", "dz2"), ("Ry", "db2"), ("Rz", "dg2"),
    ("Ty", "delta_y3"), ("Ry", "dtheta_y3"), ("Rx", "dtheta_x3"), ("Rz", "gamma"),
    ("Tx", "dx3"), ("Ty", "dy3"), ("Tz", "dz3"), ("Rx", "da3"), ("Ry", "db3"),
    ("Tx", "dx4"), ("Ty", "dy4"), ("Tz", "dz4"), ("Rx", "da4"), ("Ry", "db4"), ("Rz", "dg4"),
]

YOKE = [
    ("Rz", "tilt"), ("Rx", "an"), ("Ry", "aw"), ("Rz", "-azimuth"),
    ("Rz", "ecc*cos(azimuth) + scale*azimuth"), ("Tz", "run*sin(2*azimuth)"),
    ("Tx", "arm"), ("Rx", "pi/2"), ("Ry", "npae"), ("Tx", "dx"), ("Rx", "elevation - pi/2"),
    ("Rx", "tf*cos(elevation) + tx*cos(elevation)/sin(elevation)"), ("Rz", "cte*temperature"),
]
CAMERA = YOKE + [("Ty", "-2*arm"), ("Ry", "pi"), ("Tz", "dz"), ("Rx", "ca"), ("Ry", "cb*cc")]
WEIGHT = YOKE + [("Ty", "dw"), ("Rz", "gw")]

# name: (joints and inputs with their ranges, constants, errors, observables as (factors, homogeneous vector))
CHAINS = {
    "mobile-lidar": (
        {"alpha": (-3.1, 3.1), "beta": (-3.1, 3.1), "gamma": (-3.1, 3.1), "range": (1.0, 100.0)},
        {},
        [amount for _, amount in LIDAR if amount not in ("alpha", "beta", "gamma")],
        {
            "pointing": (LIDAR, ("0", "0", "1", "0")),
            "position": (LIDAR, ("0", "0", "0", "1")),
            "target": (LIDAR, ("0", "0", "range", "1")),
        },
    ),
    "gimbal": (
        {"azimuth": (-3.1, 3.1), "elevation": (0.4, 1.4), "temperature": (-20.0, 40.0), "range": (1.0, 100.0)},
        {"arm": "0.25", "tilt": "0.3"},
        ["an", "aw", "ecc", "scale", "run", "npae", "dx", "tf", "tx", "cte", "dz", "ca", "cb", "cc", "dw", "gw"],
        {
            "sight": (CAMERA, ("0", "1", "0", "0")),
            "spot": (CAMERA, ("0", "range", "arm", "1")),
            "weight": (WEIGHT, ("arm", "0", "-1", "1")),
        },
    ),
}


def matrix(transform, amount, cos, sin, one, zero):
    """The 4 x 4 matrix of an elementary transform, as nested lists."""
    rows = [[one if i == j else zero for j in range(4)] for i in range(4)]
    axis = "xyz".index(transform[1])
    if transform[0] == "T":
        rows[axis][3] = amount
    else:
        a, b = (axis + 1) % 3, (axis + 2) % 3
        rows[a][a] = rows[b][b] = cos(amount)
        rows[b][a] = sin(amount)
        rows[a][b] = -sin(amount)
    return rows
