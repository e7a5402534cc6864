"""Reference for identifiability: which combinations of errors the first-order columns leave undetermined, by mpmath.

For sets of observables, evaluates the columns (derivatives of the exact error at zero) at many random joints and inputs
in 300-bit arithmetic, and writes to ranks.txt: chain, observables, rank, and the errors without influence. The rank is
the number of singular values that are not zero to 1e-40 of the largest; constants have their declared values.

    pip install mpmath==1.3.0 && python make_ranks.py
"""

import random

from mpmath import cos, matrix as mp_matrix, mp, mpf, pi, sin, svd_r

from chains import CHAINS, matrix

mp.prec = 300
SETS = {
    "mobile-lidar": [["pointing"], ["position"], ["target"], ["pointing", "position"]],
    "gimbal": [["sight"], ["spot"], ["weight"], ["sight", "weight"], ["spot", "weight"]],
}
POSES = 25


def vector(factors, homogeneous, values):
    names = {**values, "cos": cos, "sin": sin, "pi": +pi}
    result = [eval(part, names) * mpf(1) for part in homogeneous]
    for transform, amount in reversed(factors):
        rows = matrix(transform, eval(amount, names) * mpf(1), cos, sin, mpf(1), mpf(0))
        result = [sum(x * y for x, y in zip(row, result)) for row in rows]
    return result[:3]


def column(factors, homogeneous, values, error):
    # A symmetric difference so small, at 300 bits, that it is the derivative to 50 digits.
    step = mpf(2) ** -90
    up, down = (vector(factors, homogeneous, values | {error: sign * step}) for sign in (1, -1))
    return [(a - b) / (2 * step) for a, b in zip(up, down)]


def main():
    rng = random.Random(7)
    with open("ranks.txt", "w") as file:
        for chain, sets in SETS.items():
            varying, constants, errors, observables = CHAINS[chain]
            for names in sets:
                rows = []
                for _ in range(POSES):
                    values = {name: mpf(rng.uniform(*span)) for name, span in varying.items()}
                    values |= {name: mpf(float(value)) for name, value in constants.items()}
                    values |= {name: mpf(0) for name in errors}
                    for name in names:
                        columns = [column(*observables[name], values, error) for error in errors]
                        rows += [list(row) for row in zip(*columns)]
                invisible = [e for i, e in enumerate(errors) if all(abs(row[i]) < mpf(10) ** -40 for row in rows)]
                singular = svd_r(mp_matrix(rows), compute_uv=False)
                rank = sum(1 for value in singular if value > singular[0] * mpf(10) ** -40)
                file.write(f"{chain} {'+'.join(names)} {rank} {','.join(invisible) or '-'}\n")


if __name__ == "__main__":
    main()
