"""What tolerances of the paper's chain come to, computed independently of trueaxis.

The chain is built from plain 4 x 4 matrices, the columns from the generators of each factor between the factors before and
behind it. The target is 10 m away; 721 poses in the middles of equal steps along alpha = beta = gamma = t over (0, 2 pi); every
rotation 10 arcsec, every shift 0.3 mm, uniform. The worst combination is found from many directions, each improved sign by sign
until no sign gains.

    python3 reference.py > reference.txt        (NumPy 2)
"""

import numpy as np

ARCSEC = np.pi / 180 / 3600
CHAIN = """
Ry dtheta_y1, Rx dtheta_x1, Rz alpha, Tx dx1, Ty dy1, Tz dz1, Rx da1, Ry db1,
Tx delta_x2, Ty delta_y2, Ry dtheta_y2, Rz dtheta_z2, Rx beta, Tx dx2, Ty dy2, Tz dz2, Ry db2, Rz dg2,
Ty delta_y3, Ry dtheta_y3, Rx dtheta_x3, Rz gamma, Tx dx3, Ty dy3, Tz dz3, Rx da3, Ry db3,
Tx dx4, Ty dy4, Tz dz4, Rx da4, Ry db4, Rz dg4
"""
FACTORS = [part.split() for part in CHAIN.replace("\n", " ").split(",")]
JOINTS = ["alpha", "beta", "gamma"]
ERRORS = [(kind, name) for kind, name in FACTORS if name not in JOINTS]
SIZES = np.array([10 * ARCSEC if kind[0] == "R" else 3e-4 for kind, _ in ERRORS])


def generator(kind):
    m = np.zeros((4, 4))
    axis = "xyz".index(kind[1])
    if kind[0] == "T":
        m[axis, 3] = 1
    else:
        i, j = (axis + 1) % 3, (axis + 2) % 3
        m[i, j], m[j, i] = -1, 1
    return m


def turn(kind, angle):
    g = generator(kind)
    return np.eye(4) + np.sin(angle) * g + (1 - np.cos(angle)) * g @ g


def columns(t, distance=10.0):
    """3 x 30: what a unit of each error adds; and where the target is."""
    joints = dict.fromkeys(JOINTS, t)
    before = [np.eye(4)]
    for kind, name in FACTORS:
        before.append(before[-1] @ (turn(kind, joints[name]) if name in joints else np.eye(4)))
    place = before[-1] @ np.array([0, 0, distance, 1])
    found = []
    for (kind, name), m in zip(FACTORS, before):
        if name not in joints:
            found.append((m @ generator(kind) @ np.linalg.inv(m) @ place)[:3])
    return np.array(found).T, place[:3]


def middles(count):
    return [columns(t) for t in (np.arange(count) + 0.5) / count * 2 * np.pi]


def rms(j):
    """Root mean square over the poses of what is expected of columns in units of standard deviations."""
    return np.sqrt((j**2).sum((1, 2)).mean())


def worst(c, rng):
    best = 0
    for direction in rng.normal(size=(60, 3)):
        signs = np.where(direction @ c >= 0, 1, -1)
        while True:
            better = np.where((c @ signs) @ c >= 0, 1, -1)
            if (better == signs).all():
                break
            signs = better
        # One sign at a time: the sum of the others says which is longer.
        best = max(best, np.linalg.norm(c @ signs))
    return best


def registered(j, places):
    """The columns of all poses less what a common turn and shift explains."""
    rows = []
    for x, y, z in places:
        rows.append([[0, z, -y, 1, 0, 0], [-z, 0, x, 0, 1, 0], [y, -x, 0, 0, 0, 1]])
    g = np.array(rows, dtype=float).reshape(-1, 6)
    flat = j.reshape(-1, j.shape[2])
    flat = flat - g @ np.linalg.lstsq(g, flat, rcond=None)[0]
    return flat.reshape(j.shape)


def after(j, a, sigma):
    a = a.reshape(-1, a.shape[2]) / sigma
    kept = np.linalg.inv(np.eye(a.shape[1]) + a.T @ a)
    return np.sqrt(np.einsum("pck,kl,pcl->p", j, kept, j).mean())


def main():
    rng = np.random.default_rng(1)
    use, campaign = middles(721), middles(100)
    unit = np.array([c for c, _ in use])
    places = [p for _, p in use]
    sigma = SIZES / np.sqrt(3)
    j = unit * sigma
    a = np.array([c for c, _ in campaign]) * sigma
    by_pose = np.sqrt((j**2).sum((1, 2)))
    print("expected rms", repr(float(rms(j))))
    print("expected largest", repr(float(by_pose.max())))
    print("worst combination", repr(float(max(worst(c * SIZES, rng) for c in unit))))
    print("after calibration", repr(float(after(j, a, 3e-4))))
    seen, measured = registered(j, places), registered(a, [p for _, p in campaign])
    print("expected registered", repr(float(rms(seen))))
    print("after registered", repr(float(after(seen, measured, 3e-4))))
    # Least cost for 0.5 mm: sizes as the cube root of present size over mean square, to scale.
    mean_square = (unit**2).sum(1).mean(0) / 3
    acts = mean_square * SIZES**2 > 1e-20
    shape = np.where(acts, np.cbrt(SIZES / np.where(acts, mean_square, 1)), 0)
    shape *= 5e-4 / np.sqrt((mean_square * shape**2).sum())
    print("cost ratio", repr(float((SIZES[acts] / shape[acts]).sum() / acts.sum())))
    for (_, name), size in zip(ERRORS, shape):
        if name in ("db2", "dtheta_x1", "dx1"):
            print("size of", name, repr(float(size)))
    draws = 200_000
    squares = []
    for _ in range(draws // 2000):
        e = rng.uniform(-1, 1, (2000, len(ERRORS))) * SIZES
        moved = e @ unit.reshape(-1, len(ERRORS)).T
        squares.append((moved.reshape(2000, -1, 3) ** 2).sum(2).astype(np.float32))
    squares = np.concatenate([s[:, ::7] for s in squares]), np.concatenate(
        [np.stack([s.mean(1), s.max(1)], 1) for s in squares]
    )
    for name, sample in [("single", squares[0].ravel()), ("rms", squares[1][:, 0]), ("largest", squares[1][:, 1])]:
        for part in (50, 95):
            print("drawn", name, part, repr(float(np.sqrt(np.percentile(sample, part)))))


if __name__ == "__main__":
    main()
