"""Equations (6) and (7) of the paper, derived independently of trueaxis, and its statements measured.

The chain is built from plain 4 x 4 matrices; SymPy differentiates the exact product at zero errors, subtracts the
formulas as printed, and simplifies. Influences are evaluated by mpmath at 40 digits on the exact product, their root mean
squares by quadrature over t in (0, 2 pi) with alpha = beta = gamma = t, and their largest values on a fine grid.

    python3 reference.py > reference.txt        (SymPy 1.14, mpmath 1.3)
"""

import mpmath as mp
import sympy as sp
from sympy import cos, sin

a, b, g = sp.symbols("alpha beta gamma", real=True)


def rotation(axis, angle):
    c, s = cos(angle), sin(angle)
    return {
        "x": sp.Matrix([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]]),
        "y": sp.Matrix([[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]]),
        "z": sp.Matrix([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]),
    }[axis]


def shift(axis, amount):
    m = sp.eye(4)
    m["xyz".index(axis), 3] = amount
    return m


# The declaration: kind, axis, amount; from the ground up.
CHAIN = """
Ry dtheta_y1, Rx dtheta_x1, Rz alpha, Tx dx1, Ty dy1, Tz dz1, Rx da1, Ry db1,
Tx delta_x2, Ty delta_y2, Ry dtheta_y2, Rz dtheta_z2, Rx beta, Tx dx2, Ty dy2, Tz dz2, Ry db2, Rz dg2,
Ty delta_y3, Ry dtheta_y3, Rx dtheta_x3, Rz gamma, Tx dx3, Ty dy3, Tz dz3, Rx da3, Ry db3,
Tx dx4, Ty dy4, Tz dz4, Rx da4, Ry db4, Rz dg4
"""
JOINTS = {"alpha": a, "beta": b, "gamma": g}
factors = []
errors = {}
for item in CHAIN.replace("\n", " ").split(","):
    kind, name = item.split()
    symbol = JOINTS.get(name) or errors.setdefault(name, sp.Symbol(name, real=True))
    factors.append((kind, symbol))


def product(kept):
    m = sp.eye(4)
    for kind, symbol in factors:
        if symbol in JOINTS.values() or symbol.name in kept:
            m = m * (rotation if kind[0] == "R" else shift)(kind[1], symbol)
    return m


def first_order(vector, kept):
    exact = product(kept) * vector
    zero = {errors[name]: 0 for name in kept}
    return [
        sum(errors[name] * sp.diff(exact[i], errors[name]).subs(zero) for name in kept) for i in range(3)
    ]


kept = [name for name in errors if name.startswith(("dtheta", "delta"))]
y1, x1, y2, z2, y3, x3 = (errors[n] for n in ("dtheta_y1", "dtheta_x1", "dtheta_y2", "dtheta_z2", "dtheta_y3", "dtheta_x3"))
p, q, r = (errors[n] for n in ("delta_x2", "delta_y2", "delta_y3"))
PRINTED = {
    "(6)": (
        sp.Matrix([0, 0, 1, 0]),
        [
            y1 * cos(b) + (y2 * cos(b) + z2 * sin(b)) * cos(a) + x3 * cos(b) * sin(a),
            -x1 * cos(b) + (y2 * cos(b) + z2 * sin(b)) * sin(a) - x3 * cos(a) * sin(b),
            -(x1 * cos(a) + y1 * sin(a)) * sin(b) - x3 * sin(b),
        ],
    ),
    "(7)": (
        sp.Matrix([0, 0, 0, 1]),
        [
            p * cos(a) - q * sin(a) - r * cos(b) * sin(a),
            q * cos(a) + p * sin(a) + r * cos(b) * cos(a),
            r * sin(b),
        ],
    ),
}
for name, (vector, printed) in PRINTED.items():
    derived = first_order(vector, kept)
    found = False
    for axis, (claim, truth) in zip("xyz", zip(printed, derived)):
        for error in kept:
            print_, truth_ = (sp.simplify(sp.diff(f, errors[error])) for f in (claim, truth))
            if sp.simplify(print_ - truth_) != 0:
                found = True
                print(f"{name} {axis} {error}: printed {print_}, derived {sp.expand_trig(truth_)}")
    if not found:
        print(f"{name} holds")

mp.mp.dps = 40
size = 10 * mp.pi / (180 * 3600)
for error in ("da1", "db1", "db2", "dg2", "da3", "db3"):
    m = (product([error]) * sp.Matrix([0, 0, 1, 0]))[:3]
    nominal = (product([]) * sp.Matrix([0, 0, 1, 0]))[:3]
    f = sp.lambdify((a, b, g, errors[error]), m, "mpmath")
    f0 = sp.lambdify((a, b, g), nominal, "mpmath")

    def influence(t):
        v, w = f(t, t, t, size), f0(t, t, t)
        return 2 * mp.asin(mp.sqrt(sum((x - y) ** 2 for x, y in zip(v, w))) / 2)

    n = 720
    values = [influence(2 * mp.pi * k / n) for k in range(n)]
    rms = mp.sqrt(sum(v**2 for v in values) / n)
    print(f"influence of {error}: rms {mp.nstr(rms, 15)} sup {mp.nstr(max(values), 15)}")
