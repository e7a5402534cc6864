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


def circles(factors, vector, errors, elevation):
    """The first order of an azimuth from y through x and of the elevation, of a way whose vector has this elevation."""
    x, y, z = (product(factors) * sp.Matrix(vector))[:3, :]
    zero = {error: 0 for error in errors}
    level = sp.sqrt(x**2 + y**2)
    total = sp.zeros(2, 1)
    for error in errors:
        turned, raised = sp.atan2(x, y).diff(error), sp.atan2(z, level).diff(error)
        both = sp.Matrix([turned, raised]).subs(zero).applyfunc(sp.simplify)
        # Where the elevation is below a quarter turn.
        total += both.subs(sp.Abs(sp.cos(elevation)), sp.cos(elevation)) * error
    return total


def is_zero(expression):
    """Decided by the exponentials of the angles, not by sampling."""
    rewritten = sp.expand(sp.expand_trig(sp.together(expression)).rewrite(sp.exp))
    return sp.simplify(rewritten) == 0


def judge(name, derived, printed):
    """Prints whether a claim holds; vectors are compared entry by entry."""
    derived, printed = sp.Matrix(derived), sp.Matrix(printed)
    same = derived.shape == printed.shape and all(is_zero(d - p) for d, p in zip(derived, printed))
    print(f"{name}: {'holds' if same else 'differs'}")


def rank(form, errors, angles, others=()):
    """The rank of the columns as functions, at rational points of the circles: exact, and never above the true one."""
    columns = [form.diff(error) for error in errors]
    rows = []
    for point in range(2 * len(errors) + 2):
        values = {}
        for index, angle in enumerate(angles):
            t = sp.Rational(3 * point + 2 * index + 1, 7 + 5 * index + point)
            values[sp.cos(angle)], values[sp.sin(angle)] = (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)
        values.update({other: (point + 3) ** (index + 1) % 17 + index for index, other in enumerate(others)})
        expanded = [sp.expand_trig(entry) for column in columns for entry in column]
        numbers = [entry.subs(values) for entry in expanded]
        rows += [[numbers[3 * c + axis] for c in range(len(columns))] for axis in range(3)]
    return sp.Matrix(rows).rank()


def judge_rank(name, form, errors, claimed, angles, others=()):
    print(f"{name}: {'holds' if rank(form, errors, angles, others) == claimed else 'differs'}")


def judge_confounded(name, form, errors, angles, others=()):
    """Whether each of the errors could be a combination of the others."""
    whole = rank(form, errors, angles, others)
    same = all(rank(form, [e for e in errors if e != error], angles, others) == whole for error in errors)
    print(f"{name}: {'holds' if same else 'differs'}")
