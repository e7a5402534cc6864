from sympy import symbols

from derive import R, T, first_order, judge

x, y, z, l = symbols("x y z l", real=True)
names = [f"{kind}_{d}({axis})" for axis in "xyz" for kind in "de" for d in "xyz"]
e = {name: symbols(name, real=True) for name in names}
c0y, a0z, b0z = symbols("c0y a0z b0z", real=True)
errors = [*e.values(), c0y, a0z, b0z]


def axis_errors(axis):
    return [T(d, e[f"d_{d}({axis})"]) for d in "xyz"] + [R(d, e[f"e_{d}({axis})"]) for d in "xyz"]


factors = [T("x", x), *axis_errors("x"), R("z", c0y), T("y", y), *axis_errors("y"), R("x", a0z), R("y", b0z), T("z", z),
           *axis_errors("z")]
tip = first_order(factors, [0, 0, -l, 1], errors)
axis = first_order(factors, [0, 0, 1, 0], errors)
s = lambda kind, d: sum(e[f"{kind}_{d}({axis})"] for axis in "xyz")
judge("volumetric error of the tool tip", tip,
      [s("d", "x") - y * (e["e_z(x)"] + c0y) + (z - l) * (e["e_y(x)"] + e["e_y(y)"] + b0z) - l * e["e_y(z)"],
       s("d", "y") - (z - l) * (e["e_x(x)"] + e["e_x(y)"] + a0z) + l * e["e_x(z)"],
       s("d", "z") + y * e["e_x(x)"]])
only = lambda vector, kept: vector.subs({error: 0 for error in errors if error not in kept})
judge("squareness of z without its lever", only(tip, {a0z, b0z}), [b0z, -a0z, 0])
judge("direction of the tool's axis", axis, [s("e", "y") + b0z, -s("e", "x") - a0z, 0])
judge("squareness of y to x moves the tip in x alone", only(tip, {c0y}), [-y * c0y, 0, 0])
