"""First-order forms from plain 4 x 4 matrices, for the scripts beside it: nothing is shared with trueaxis.

A script writes its chain as a list of elementary transforms in Python, its printed formulas as SymPy expressions, and calls
`judge` for each claim; the verdicts go to standard output, one a line. `NAME.txt` beside `NAME.py` is that output.
"""

import sympy as sp


def R(axis, angle):
    c, s = sp.cos(angle), sp.sin(angle)
    m = sp.eye(4)
    a, b = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    m[a, a] = m[b, b] = c
    m[a, b], m[b, a] = -s, s
    return m


def T(axis, shift):
    m = sp.eye(4)
    m["xyz".index(axis), 3] = shift
    return m


def product(factors):
    m = sp.eye(4)
    for factor in factors:
        m = m * factor
    return m


def first_order(factors, vector, errors):
    """The derivative of the transformed vector along the errors, at no error."""
    moved = product(factors) * sp.Matrix(vector)
    zero = {error: 0 for error in errors}
    columns = [moved[:3, :].diff(error).subs(zero) * error for error in errors]
    return sum(columns, sp.zeros(3, 1))


def is_zero(expression):
    """Decided by the exponentials of the angles, not by sampling."""
    rewritten = sp.expand(sp.expand_trig(sp.together(expression)).rewrite(sp.exp))
    return sp.simplify(rewritten) == 0


def judge(name, derived, printed):
    """Prints whether a claim holds; vectors are compared entry by entry."""
    derived, printed = sp.Matrix(derived), sp.Matrix(printed)
    same = derived.shape == printed.shape and all(is_zero(d - p) for d, p in zip(derived, printed))
    print(f"{name}: {'holds' if same else 'differs'}")
