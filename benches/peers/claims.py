"""What SymPy and CasADi answer to claims of the gallery, and how long they take for it.

python claims.py [repeats]; prints the table of docs/src/gallery/peers.md. Both get the chain as 4 x 4 matrices and the printed
formula in their own syntax; the question is whether derived less printed is zero.
"""

import sys
import time

import casadi as ca
import sympy as sp

REPEATS = int(sys.argv[1]) if len(sys.argv) > 1 else 5


def rotation(m, axis, angle):
    c, s = m.cos(angle), m.sin(angle)
    one, zero = angle * 0 + 1, angle * 0
    rows = {"x": [[one, zero, zero], [zero, c, -s], [zero, s, c]],
            "y": [[c, zero, s], [zero, one, zero], [-s, zero, c]],
            "z": [[c, -s, zero], [s, c, zero], [zero, zero, one]]}[axis]
    return rows


def times(rows, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in rows]


# Each claim: symbols, errors, the factors from the ground up, the vector, the printed form.
def alt_azimuth(m, A, E, an, aw, ia, ie, ca_, npae, tf):
    factors = [("x", -E), ("z", A), ("x", -an), ("y", -aw), ("z", -A), ("z", ia), ("y", -npae), ("x", E),
               ("x", ie - tf * m.cos(E)), ("z", ca_)]
    printed = [-ia * m.cos(E) - ca_ - npae * m.sin(E) - (an * m.sin(A) + aw * m.cos(A)) * m.sin(E), A * 0,
               ie - tf * m.cos(E) - an * m.cos(A) + aw * m.sin(A)]
    return factors, [0, 1, 0], printed


def alt_azimuth_slip(m, A, E, *errors):
    factors, vector, printed = alt_azimuth(m, A, E, *errors)
    return factors, vector, [printed[0] / m.cos(E), printed[1], printed[2]]


def lidar(m, a, b, ty1, tx1, ty2, tz2, ty3, tx3):
    factors = [("y", ty1), ("x", tx1), ("z", a), ("y", ty2), ("z", tz2), ("x", b), ("y", ty3), ("x", tx3)]
    middle = ty2 * m.cos(b) + tz2 * m.sin(b)
    printed = [ty1 * m.cos(b) + middle * m.cos(a) + ty3 * m.cos(a) + tx3 * m.cos(b) * m.sin(a),
               -tx1 * m.cos(b) + middle * m.sin(a) + ty3 * m.sin(a) - tx3 * m.cos(a) * m.cos(b),
               -(tx1 * m.cos(a) + ty1 * m.sin(a)) * m.sin(b) - tx3 * m.sin(b)]
    return factors, [0, 0, 1], printed


def lidar_slip(m, a, b, *errors):
    factors, vector, printed = lidar(m, a, b, *errors)
    tx3 = errors[-1]
    return factors, vector, [printed[0], printed[1] + tx3 * m.cos(a) * (m.cos(b) - m.sin(b)), printed[2]]


CLAIMS = [("alt-azimuth, correct", alt_azimuth, 2, 7), ("alt-azimuth, without cos E", alt_azimuth_slip, 2, 7),
          ("mobile lidar (6), corrected", lidar, 2, 6), ("mobile lidar (6), sine for cosine", lidar_slip, 2, 6)]


def with_sympy(claim, joints, errors, decide):
    q = sp.symbols(f"q0:{joints}", real=True)
    e = sp.symbols(f"e0:{errors}", real=True)
    factors, vector, printed = claim(sp, *q, *e)
    moved = [sp.Integer(v) for v in vector]
    for axis, angle in reversed(factors):
        moved = times(rotation(sp, axis, angle), moved)
    zero = {error: 0 for error in e}
    derived = [sum(entry.diff(error).subs(zero) * error for error in e) for entry in moved]
    return all(decide(d - p) for d, p in zip(derived, printed))


def with_casadi(claim, joints, errors):
    q, e = ca.SX.sym("q", joints), ca.SX.sym("e", errors)
    factors, vector, printed = claim(ca, *ca.vertsplit(q), *ca.vertsplit(e))
    moved = [ca.SX(v) for v in vector]
    for axis, angle in reversed(factors):
        moved = times(rotation(ca, axis, angle), moved)
    moved = ca.vertcat(*moved)
    at_zero = ca.Function("f", [q, e], [ca.substitute(ca.jacobian(moved, e), e, ca.SX.zeros(errors)) @ e])(q, e)
    difference = ca.simplify(at_zero - ca.vertcat(*printed))
    return bool(difference.is_zero())


def exponentials(x):
    return sp.simplify(sp.expand(sp.together(x).rewrite(sp.exp))) == 0


def median(run):
    times_s = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        answer = run()
        times_s.append(time.perf_counter() - start)
    return answer, sorted(times_s)[len(times_s) // 2] * 1e3


print(f"| claim | SymPy {sp.__version__} `simplify` | SymPy, exponentials | CasADi {ca.__version__} `simplify`, `is_zero` |")
print("|---|---|---|---|")
word = {True: "equal", False: "not shown equal"}
for name, claim, joints, errors in CLAIMS:
    simple, t1 = median(lambda: with_sympy(claim, joints, errors, lambda x: sp.simplify(x) == 0))
    exact, t2 = median(lambda: with_sympy(claim, joints, errors, exponentials))
    casadi, t3 = median(lambda: with_casadi(claim, joints, errors))
    print(f"| {name} | {word[simple]}, {t1:.0f} ms | {word[exact]}, {t2:.0f} ms | {word[casadi]}, {t3:.1f} ms |")
