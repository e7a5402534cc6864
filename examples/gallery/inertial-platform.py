from sympy import Matrix, eye, symbols

from derive import R, T, first_order, judge, product

psi, theta, phi, fx, fy, fz = symbols("psi theta phi f_x f_y f_z", real=True)
errors = sx, sy, sz, bx, by, bz = symbols("s_x s_y s_z b_x b_y b_z", real=True)
tilt = [R("x", -sx), R("y", -sy), R("z", -sz)]
attitude = [R("z", psi), R("y", theta), R("x", phi)]
C, s, f, b = product(attitude)[:3, :3], Matrix([sx, sy, sz]), Matrix([fx, fy, fz]), Matrix([bx, by, bz])
cross = lambda v: Matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
zero = {error: 0 for error in errors}
exact = product(tilt + attitude)[:3, :3]
linear = exact.subs(zero) + sum((exact.diff(error).subs(zero) * error for error in (sx, sy, sz)), Matrix.zeros(3, 3))
judge("computed attitude", linear, (eye(3) - cross(s)) * C)
form = first_order(tilt + attitude + [T("x", bx), T("y", by), T("z", bz)], [fx, fy, fz, 1], errors)
judge("error of the specific force", form, cross(C * f) * s + C * b)
judge("error of the specific force with the tilt turned round", form, cross(s) * (C * f) + C * b)
judge("what has to be added to the computed force", -form.subs({bx: 0, by: 0, bz: 0}), s.cross(C * f))
