"""Reference numbers for the exact error and for its parts of degree 1, 2 and 3 in the errors, by mpmath.

Writes numbers.csv: chain, observable, size of the errors, values of the symbols, then x, y, z of the exact error in
200-bit arithmetic, and of the parts of degree 1, 2 and 3 (Taylor coefficients of t -> error(t * errors), divided by
size ** degree to keep them in range).

    pip install mpmath==1.3.0 && python make_numbers.py
"""

import csv
import random

from mpmath import cos, mp, mpf, nstr, pi, sin

from chains import CHAINS, matrix

# Central differences over 9 points for the Taylor coefficients; their error is of order step ** 6 or better.
WEIGHTS = {
    1: ["1/280", "-4/105", "1/5", "-4/5", "0", "4/5", "-1/5", "4/105", "-1/280"],
    2: ["-1/1120", "4/315", "-1/10", "4/5", "-205/144", "4/5", "-1/10", "4/315", "-1/1120"],
    3: ["-7/1440", "1/20", "-169/720", "61/180", "0", "-61/180", "169/720", "-1/20", "7/1440"],
}
SIZES = [1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1]


def vector(factors, homogeneous, values):
    names = {**values, "mpf": mpf, "cos": cos, "sin": sin, "ramp": ramp, "pi": +pi}
    result = [eval(str(part), names) * mpf(1) for part in homogeneous]
    for transform, amount in reversed(factors):
        rows = matrix(transform, eval(amount, names) * mpf(1), cos, sin, mpf(1), mpf(0))
        result = [sum(x * y for x, y in zip(row, result)) for row in rows]
    return result[:3]


def fraction(text):
    above, _, below = text.partition("/")
    return mpf(int(above)) / int(below or 1)


def ramp(x, begins, ends):
    """0 before, 1 behind, linear between, in either direction; equal thresholds are a step."""
    if begins == ends:
        return mpf(1) if x >= begins else mpf(0)
    gone, way = x - begins, ends - begins
    if gone * way <= 0:
        return mpf(0)
    return mpf(1) if abs(gone) >= abs(way) else gone / way


def main(chains=CHAINS, path="numbers.csv"):
    rng = random.Random(20260705)
    with open(path, "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        parts = [f"{part}_{axis}" for part in ("exact", "degree1", "degree2", "degree3") for axis in "xyz"]
        out.writerow(["chain", "observable", "size", "values", *parts])
        for chain, (varying, constants, errors, observables) in chains.items():
            for size in SIZES:
                for name, (factors, homogeneous) in observables.items():
                    # Doubles, so that both programs start from the same numbers.
                    values = {symbol: rng.uniform(*span) for symbol, span in varying.items()}
                    values |= {symbol: size * rng.uniform(-1, 1) for symbol in errors}
                    mp.prec = 200
                    exact = {symbol: mpf(value) for symbol, value in values.items()}
                    exact |= {symbol: mpf(float(value)) for symbol, value in constants.items()}

                    def scaled(t):
                        return vector(factors, homogeneous, exact | {e: t * exact[e] for e in errors})

                    nominal = scaled(mpf(0))
                    difference = [a - b for a, b in zip(scaled(mpf(1)), nominal)]
                    row = [nstr(part, 25) for part in difference]
                    # Taylor coefficients from differences at high precision: the step is far below, the precision
                    # far above what the digits printed need.
                    mp.prec = 1200
                    exact = {symbol: mpf(values[symbol]) for symbol in values}
                    exact |= {symbol: mpf(float(value)) for symbol, value in constants.items()}
                    step = mpf(2) ** -80 / mpf(size)
                    points = [scaled(k * step) for k in range(-4, 5)]
                    for degree, weights in WEIGHTS.items():
                        for axis in range(3):
                            total = sum(fraction(w) * p[axis] for w, p in zip(weights, points))
                            row.append(nstr(total / (step * size) ** degree, 20))
                    listed = " ".join(f"{symbol}={value!r}" for symbol, value in values.items())
                    out.writerow([chain, name, repr(size), listed, *row])


if __name__ == "__main__":
    main()
