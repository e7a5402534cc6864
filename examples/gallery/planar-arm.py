from sympy import Matrix, cos, sin, symbols

from derive import R, T, first_order, judge, product

t1, t2, l1, l2 = symbols("theta_1 theta_2 l_1 l_2", real=True)
errors = d1, d2, e1, e2 = symbols("dtheta_1 dtheta_2 dl_1 dl_2", real=True)
factors = [R("z", t1), R("z", d1), T("x", l1), T("x", e1), R("z", t2), R("z", d2), T("x", l2), T("x", e2)]
tip = (product(factors) * Matrix([0, 0, 0, 1]))[:3, :].subs({error: 0 for error in errors})
c12, s12 = cos(t1 + t2), sin(t1 + t2)
judge("position", tip, Matrix([l1 * cos(t1) + l2 * c12, l1 * sin(t1) + l2 * s12, 0]))
rows = lambda s, c: Matrix([[-l1 * sin(t1) - l2 * s12, -l2 * s], [l1 * cos(t1) + l2 * c12, l2 * c], [0, 0]])
judge("Jacobian", tip.jacobian([t1, t2]), rows(s12, c12))
judge("Jacobian with the elbow's angle alone", tip.jacobian([t1, t2]), rows(sin(t2), cos(t2)))
judge("its determinant", [tip.jacobian([t1, t2])[:2, :].det()], [l1 * l2 * sin(t2)])
form = first_order(factors, [0, 0, 0, 1], errors).subs({e1: 0, e2: 0})
judge("errors of the encoders through the Jacobian", form, rows(s12, c12) * Matrix([d1, d2]))
