"""Reference numbers for the likelihood, by dense covariance matrices over the rows. NumPy only; shares no code with the crate.

    python likelihood.py > likelihood.txt

The crate works with Gram matrices, mixed-model equations and eigenvalues. Here each number comes from the marginal
covariance of the values themselves: V = C + sum of v Z S Z', REML by generalised least squares on V.
"""
import numpy as np

rng = np.random.default_rng(20261127)
N, M = 24, 2
azimuth, elevation = np.sort(rng.uniform(-2.5, 2.5, N)), rng.uniform(0.3, 1.3, N)
rng.shuffle(elevation)
joints = [azimuth, elevation]
declared = rng.normal(size=(N * M, 3)) * [1.0, 1e-3, 50.0]
places = rng.normal(size=(N * M, 4))
weights = np.exp(rng.normal(size=N * M) * 0.4)
y = rng.normal(size=N * M) + 2.0 * places[:, 0] * np.repeat(np.cos(2 * azimuth), M)
CARRIED, PART = 0.9, 0.7
FRAME = (0, 1)  # the two places that tilt the one frame


def over(values):
    return np.repeat(values, M)


def wave(joint, n, sine):
    return (np.sin if sine else np.cos)(n * joints[joint])


def spectrum(place, joint, deviation):
    functions, relative = [np.ones(N)], [deviation(0)]
    for n in range(1, 15):
        for sine in (0, 1):
            functions.append(wave(joint, n, sine))
            relative.append(deviation(n))
    return [places[:, place] * over(f) for f in functions], relative


def family(law, place, joint):
    """Columns and relative standard deviations, written from the specification."""
    p = places[:, place]
    if law == "constant":
        return [p], [1.0]
    if law == "scale":
        return [p * over(joints[joint]), p], [1.0, np.sqrt(0.3)]
    if law == "cot":
        return [p / np.tan(over(joints[joint])), p], [1.0, 1.0]
    if law.startswith("harmonic"):
        n = int(law[8:])
        return [p * over(wave(joint, n, s)) for s in (0, 1)], [1.0, 1.0]
    if law == "smooth0":
        return spectrum(place, joint, lambda n: max(n, 1) ** -2.0)
    if law == "smooth1":
        return spectrum(place, joint, lambda n: max(n, 1) ** -1.0)
    if law == "smooth2":
        return spectrum(place, joint, lambda n: np.exp(-0.25 * (n * 0.35) ** 2))
    if law == "smooth3":
        return spectrum(place, joint, lambda n: np.exp(-0.25 * (n * 0.15) ** 2))
    if law == "product":
        return [p * over(wave(0, 1, a) * wave(1, 1, b)) for a in (0, 1) for b in (0, 1)], [1.0] * 4
    if law == "surface":
        columns, relative = [p], [1.0]
        for j in (0, 1):
            for n in (1, 2, 3):
                for s in (0, 1):
                    columns.append(p * over(wave(j, n, s)))
                    relative.append(n ** -2.0)
        for n in (1, 2, 3):
            for m in (1, 2, 3):
                for a in (0, 1):
                    for b in (0, 1):
                        columns.append(p * over(wave(0, n, a) * wave(1, m, b)))
                        relative.append(2.0 / (n * n + m * m))
        return columns, relative
    if law == "walk":
        steps = min(max(N // 6, 4), 32)
        columns = []
        for k in range(1, steps):
            f = (np.arange(N) / N >= k / steps).astype(float)
            columns.append(p * over(f - f.mean()))
        return columns, [1.0] * len(columns)
    if law.startswith("whirl"):
        n = int(law[5:])
        a, b = places[:, FRAME[0]], places[:, FRAME[1]]
        c, s = over(wave(0, abs(n), 0)), over(wave(0, abs(n), 1)) * np.sign(n)
        return [a * c + b * s, -a * s + b * c], [1.0, 1.0]
    raise ValueError(law)


def scaled(law, place, joint):
    columns, relative = family(law, place, joint)
    z = np.stack(columns, 1)
    return z * (np.array(relative) / np.median(np.sqrt((z**2).mean(0))))


UNIT = np.sqrt((y**2).mean())
BASIS = np.linalg.qr(declared / np.linalg.norm(declared, axis=0))[0]
NU = N * M - 3


def correlation(memory):
    if not memory:
        return np.eye(N * M)
    d = np.abs(np.subtract.outer(np.arange(N), np.arange(N)))
    return np.kron((1 - PART) * np.eye(N) + PART * CARRIED**d, np.eye(M))


def restricted(active, w, memory, basis=BASIS):
    """REML log likelihood with the Haar prior, generalised least squares estimate and its covariance."""
    v = correlation(memory)
    for law, place, joint, variance in active:
        z = w[:, None] * scaled(law, place, joint)
        v = v + variance * z @ z.T
    x, target = w[:, None] * basis, w * y / UNIT
    vi = np.linalg.inv(v)
    information = x.T @ vi @ x
    b = np.linalg.solve(information, x.T @ vi @ target)
    q = target @ vi @ target - b @ (x.T @ vi @ target)
    logs = np.linalg.slogdet(v)[1] + np.linalg.slogdet(information)[1]
    p = vi - vi @ x @ np.linalg.solve(information, x.T @ vi)
    return -NU / 2 * np.log(q) - logs / 2 + np.log(w).sum(), b, np.linalg.inv(information) * q / NU, p


def gain(active, candidate, w, memory):
    base, _, _, p = restricted(active, w, memory)
    z = w[:, None] * scaled(*candidate)
    largest = np.linalg.eigvalsh(z.T @ p @ z)[-1]
    best = (-np.inf, 0.0)
    for step in range(101):
        variance = 10 ** (-1 + 0.1 * step) / largest
        value = restricted([*active, (*candidate, variance)], w, memory)[0] - base
        best = max(best, (value, variance))
    return best


def show(name, values):
    print(name + ":", *(repr(float(v)) for v in np.ravel(values)))


show("azimuth", azimuth)
show("elevation", elevation)
show("y", y)
for i in range(3):
    show(f"declared{i}", declared[:, i])
for i in range(4):
    show(f"place{i}", places[:, i])
show("weights", weights)
show("memory", [CARRIED, PART])
ACTIVE = [
    [],
    [("harmonic2", 0, 0, 3.0)],
    [("smooth0", 1, 1, 0.7), ("harmonic1", 2, 1, 10.0)],
]
STATES = [("even", np.ones(N * M), False), ("uneven", weights, False), ("memory", weights, True)]
CANDIDATES = [("constant", 3, 0), ("scale", 0, 0), ("cot", 1, 1), ("harmonic1", 0, 0), ("harmonic5", 3, 1)]
CANDIDATES += [(f"smooth{k}", 3, 0) for k in range(4)] + [("product", 2, 0), ("surface", 3, 0), ("walk", 1, 0), ("whirl2", 0, 0), ("whirl-1", 0, 0)]
for index, active in enumerate(ACTIVE):
    for state, w, memory in STATES:
        # In the caller's own columns for the estimates, in an orthonormal basis for the likelihood.
        value = restricted(active, w, memory)[0]
        _, b, covariance, _ = restricted(active, w, memory, declared)
        show(f"evidence {index} {state}", [value])
        show(f"estimates {index} {state}", b * UNIT)
        show(f"uncertainties {index} {state}", np.sqrt(np.diag(covariance)) * UNIT)
        if (state == "memory") == (index == 2):
            for candidate in CANDIDATES:
                law, place, joint = candidate
                print(f"gain {index} {state} {law} {place} {joint}:", *map(repr, map(float, gain(active, candidate, w, memory))))
