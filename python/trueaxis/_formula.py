"""SymPy expressions from the steps of a closed form. No text is evaluated, so that no name can be anything but a name."""

from __future__ import annotations

import sympy

_FUNCTIONS = {
    "sin": sympy.sin,
    "cos": sympy.cos,
    "tan": sympy.tan,
    "cot": sympy.cot,
    "sec": sympy.sec,
    "csc": sympy.csc,
}


def expression(steps: list[tuple[str, str, int]]) -> sympy.Expr:
    """The expression that the steps leave on a stack."""
    stack: list[sympy.Expr] = []
    for what, with_, count in steps:
        operands = stack[len(stack) - count :]
        del stack[len(stack) - count :]
        stack.append(_step(what, with_, operands))
    (result,) = stack
    return result


def _step(what: str, with_: str, operands: list[sympy.Expr]) -> sympy.Expr:
    if what == "number":
        return sympy.Rational(with_)
    if what == "pi":
        return sympy.pi
    if what == "symbol":
        return sympy.Symbol(with_, real=True)
    if what == "negative":
        return -operands[0]
    if what == "sum":
        return sympy.Add(*operands)
    if what == "product":
        return sympy.Mul(*operands)
    if what == "quotient":
        return operands[0] / operands[1]
    if what == "power":
        return operands[0] ** int(with_)
    if what == "function":
        return _FUNCTIONS[with_](operands[0])
    if what == "ramp":
        x, start, end = operands
        if sympy.expand(end - start) == 0:
            # A step: 0 below the threshold, 1 at it and beyond.
            return sympy.Heaviside(x - start, 1)
        return sympy.Min(1, sympy.Max(0, (x - start) / (end - start)))
    raise AssertionError(f"internal error: no step `{what}`")
