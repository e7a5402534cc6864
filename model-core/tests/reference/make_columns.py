"""Reference columns of the first-order form, by SymPy: for every error, the derivative of the exact product at zero.

Writes columns.txt, a line for every chain, observable, error and axis: `chain observable error axis = expression`, in
the plain syntax of amounts, as SymPy leaves it (not simplified). Columns that are zero are left out.

    pip install sympy==1.14.0 && python make_columns.py
"""

import sympy
from sympy import Integer, Matrix, cos, diff, expand, pi, sin

from chains import CHAINS, matrix


def main():
    with open("columns.txt", "w") as file:
        for chain, (varying, constants, errors, observables) in CHAINS.items():
            symbols = {name: sympy.Symbol(name) for name in [*varying, *constants, *errors]}
            names = {**symbols, "cos": cos, "sin": sin, "pi": pi}
            zero = {symbols[name]: 0 for name in errors}
            for observable, (factors, homogeneous) in observables.items():
                matrices = []
                for transform, amount in factors:
                    value = eval(amount, names) * Integer(1)
                    matrices.append(Matrix(matrix(transform, value, cos, sin, Integer(1), Integer(0))))
                vector = Matrix([eval(part, names) * Integer(1) for part in homogeneous])
                nominal = [m.subs(zero) for m in matrices]
                for error in errors:
                    column = sympy.zeros(4, 1)
                    for index, factor in enumerate(matrices):
                        slope = diff(factor, symbols[error]).subs(zero)
                        if slope.is_zero_matrix:
                            continue
                        product = vector
                        for other in reversed(nominal[index + 1:]):
                            product = other * product
                        product = slope * product
                        for other in reversed(nominal[:index]):
                            product = other * product
                        column += product
                    for axis, entry in zip("xyz", column[:3]):
                        entry = expand(entry)
                        if entry != 0:
                            text = str(entry).replace("**", "^")
                            file.write(f"{chain} {observable} {error} {axis} = {text}\n")


if __name__ == "__main__":
    main()
