from sympy import cos, sec, sin, symbols, tan

from derive import R, T, first_order, judge, judge_rank

t, a, rho = symbols("theta alpha rho", real=True)
errors = b1, b2, b3, b4, b5, b6, c0, c1, c2, a0, a1 = symbols("b1:7 c0:3 a0:2", real=True)
factors = [R("x", -a), R("z", t), R("z", -t), R("z", -(b3 * sin(t) + b4 * cos(t) + b5 * sin(2 * t) + b6 * cos(2 * t))),
           R("y", b2), R("x", a), R("x", c0 + c1 * sin(a) + c2 * cos(a)), R("z", -b1), T("y", a0 + a1 * rho)]
form = first_order(factors, [0, rho, 0, 1], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
judge("the three observations", form,
      [rho * cos(a) * (b1 * sec(a) + b2 * tan(a) + b3 * sin(t) + b4 * cos(t) + b5 * sin(2 * t) + b6 * cos(2 * t)),
       a0 + a1 * rho, rho * (c0 + c1 * sin(a) + c2 * cos(a))])
judge("vertical circle by half angles", only(form, {c0, c2}), [0, 0, rho * (c0 + c2 - 2 * c2 * sin(a / 2)**2)])
judge("collimation with the tangent, trunnion axis with the secant", only(form, {b1, b2}),
      [rho * cos(a) * (b1 * tan(a) + b2 / cos(a)), 0, 0])
judge("the horizontal circle moves the point to the right alone", [only(form, {b3, b4})[0]],
      [rho * cos(a) * (b3 * sin(t) + b4 * cos(t))])
judge_rank("eleven parameters, all of them determined", form, errors, 11, [t, a], [rho])
