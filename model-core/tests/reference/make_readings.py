"""The reference of `tests/readings`: what the chain `codegen/tests/chains/readings.chain` shows, in 120-digit arithmetic.

Nothing is shared with trueaxis: the chain is written out here as 4 x 4 matrices, the angles are differences of two arc
tangents (which 120 digits can afford), and the parts by degree are the Taylor coefficients of the exact error along a ray.

    python make_readings.py > readings.csv
    python make_readings.py turned > orientations.csv     the small rotation vector, by the trace and the antisymmetric part
"""

import sys
from random import Random

from mpmath import acos, atan2, cos, mp, mpf, pi, sin, sqrt, taylor

mp.dps = 120

ERRORS = ("tilt_x tilt_y pier_x index_a mount_y cross index_e sag collimation scale table_y table_x index_t").split()
JOINTS = "azimuth elevation turn distance".split()


def eye():
    return [[mpf(int(i == j)) for j in range(4)] for i in range(4)]


def mul(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def R(axis, angle):
    m = eye()
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    m[i][i] = m[j][j] = cos(angle)
    m[i][j], m[j][i] = -sin(angle), sin(angle)
    return m


def T(axis, shift):
    m = eye()
    m["xyz".index(axis)][3] = shift
    return m


def product(*factors):
    m = eye()
    for factor in factors:
        m = mul(m, factor)
    return m


def inverse(m):
    rotation = [[m[j][i] for j in range(3)] for i in range(3)]
    out = eye()
    for i in range(3):
        for j in range(3):
            out[i][j] = rotation[i][j]
        out[i][3] = -sum(rotation[i][k] * m[k][3] for k in range(3))
    return out


def apply(m, v, w):
    return [sum(m[i][k] * v[k] for k in range(3)) + w * m[i][3] for i in range(3)]


def bodies(j, e):
    pier = product(T("z", mpf("0.3")), R("x", e["tilt_x"]), R("y", e["tilt_y"]), T("x", e["pier_x"]))
    mount = product(pier, R("z", j["azimuth"]), R("z", e["index_a"]), T("y", e["mount_y"]))
    sag = -e["index_e"] + e["sag"] * cos(j["elevation"])
    tube = product(mount, R("x", e["cross"]), R("y", -j["elevation"]), R("y", sag), R("z", e["collimation"]),
                   T("x", e["scale"] * j["distance"]))
    table = product(pier, T("y", e["table_y"]), R("x", e["table_x"]), R("z", j["turn"]), R("z", e["index_t"]))
    return {"ground": eye(), "mount": mount, "tube": tube, "table": table}


def norm(v):
    return sqrt(sum(c * c for c in v))


def wrapped(angle):
    while angle > pi:
        angle -= 2 * pi
    while angle <= -pi:
        angle += 2 * pi
    return angle


X, Y, Z = 0, 1, 2


def azimuth(zero, sign_zero, through, sign_through):
    angle = lambda v: atan2(sign_through * v[through], sign_zero * v[zero])
    return angle, lambda a, b: wrapped(angle(b) - angle(a))


def cross(zero, sign_zero, through, sign_through):
    _, turned = azimuth(zero, sign_zero, through, sign_through)
    error = lambda a, b: turned(a, b) * sqrt(a[zero] ** 2 + a[through] ** 2) / norm(a)
    return None, error


def elevation(sign):
    angle = lambda v: atan2(sign * v[2], sqrt(v[0] ** 2 + v[1] ** 2))
    return angle, lambda a, b: angle(b) - angle(a)


def plain(function):
    return function, lambda a, b: function(b) - function(a)


zenith = plain(lambda v: acos(v[2] / norm(v)))
AZ, HA = azimuth(X, 1, Y, 1), azimuth(X, 1, Y, -1)
OBSERVABLES = {
    "sky": ("direction", [1, 0, 0], "tube", "ground", [AZ, elevation(1)]),
    "arcs": ("direction", [2, 0, 0], "tube", "ground", [cross(X, 1, Y, 1), zenith]),
    "clock": ("direction", [1, 0, 0], "tube", "ground", [HA, elevation(1)]),
    "other": ("direction", [1, 0, 0], "tube", "ground", [azimuth(Y, 1, X, -1), elevation(-1), cross(X, 1, Y, -1)]),
    "station": ("point", ["d", 0, 0], "tube", "mount", [HA, zenith, plain(norm)]),
    "lone": ("point", ["d", 0, 0], "tube", "ground", [plain(lambda v: v[2]), plain(lambda v: v[0])]),
    "seen": ("point", ["d", 0, 0], "tube", "table", [plain(lambda v, i=i: v[i]) for i in range(3)]),
    "bearing": ("point", ["d", 0, 0], "tube", "table", [AZ]),
    "away": ("point", [0, mpf("0.3"), 0], "tube", "table", [plain(norm)]),
}


def vector(name, j, e):
    kind, components, body, frame, _ = OBSERVABLES[name]
    frames = bodies(j, e)
    components = [j["distance"] if c == "d" else mpf(c) for c in components]
    return apply(mul(inverse(frames[frame]), frames[body]), components, 1 if kind == "point" else 0)


TURNED = {"turned": ("tube", "ground"), "held": ("table", "mount")}


def turned(name, j, e):
    """The vector along the axis by which the body is turned from where it is by design, as long as the angle is large."""
    body, frame = TURNED[name]
    at = lambda errors: mul(inverse((frames := bodies(j, errors))[frame]), frames[body])
    r = mul(at(e), inverse(at({error: mpf(0) for error in ERRORS})))
    half = [(r[2][1] - r[1][2]) / 2, (r[0][2] - r[2][0]) / 2, (r[1][0] - r[0][1]) / 2]
    sine = norm(half)
    return [h * (atan2(sine, (r[0][0] + r[1][1] + r[2][2] - 1) / 2) / sine if sine else 1) for h in half]


def orientations():
    random = Random(18)
    print("observable,size,values,shown,value,error,first,second,third")
    for name in TURNED:
        for size in ["1", "1e-2", "1e-5", "1e-12"]:
            j = {joint: random.uniform(-3, 3) for joint in JOINTS}
            given = {error: float(mpf(size) * mpf(random.uniform(-0.3, 0.3))) for error in ERRORS}
            jm, em = ({key: mpf(value) for key, value in d.items()} for d in (j, given))
            exact = turned(name, jm, em)
            for i in range(3):
                series = taylor(lambda t: turned(name, jm, {key: t * em[key] for key in ERRORS})[i], 0, 3)
                numbers = [exact[i], exact[i]] + [series[k] / mpf(size)**k for k in (1, 2, 3)]
                values = " ".join(f"{key}={value!r}" for key, value in {**j, **given}.items())
                print(f"{name},{size},{values},{i}," + ",".join(mp.nstr(n, 25) for n in numbers))


def main():
    random = Random(17)
    print("observable,size,values,shown,value,error,first,second,third")
    for name in OBSERVABLES:
        for size in ["1e-2", "1e-5", "1e-12"]:
            j = {"azimuth": random.uniform(-3, 3), "elevation": random.uniform(0.2, 1.2), "turn": random.uniform(-3, 3),
                 "distance": random.uniform(2, 40)}
            raw = {error: random.uniform(-1, 1) for error in ERRORS}
            given = {error: float(mpf(size) * mpf(raw[error])) for error in ERRORS}
            jm = {key: mpf(value) for key, value in j.items()}
            em = {key: mpf(value) for key, value in given.items()}
            nominal = vector(name, jm, {error: mpf(0) for error in ERRORS})
            moved = vector(name, jm, em)
            for index, (value, error) in enumerate(OBSERVABLES[name][4]):
                along = lambda t: error(nominal, vector(name, jm, {key: t * em[key] for key in ERRORS}))
                series = taylor(along, 0, 3)
                exact = error(nominal, moved)
                shown = exact if value is None else value(moved)
                scale = mpf(size)
                numbers = [shown, exact] + [series[k] / scale**k for k in (1, 2, 3)]
                values = " ".join(f"{key}={value!r}" for key, value in {**j, **given}.items())
                print(f"{name},{size},{values},{index}," + ",".join(mp.nstr(n, 25) for n in numbers))


orientations() if sys.argv[1:] == ["turned"] else main()
