from sympy import Matrix, cos, sin, symbols

from derive import R, first_order, judge, judge_confounded, judge_rank

psi, phi, th = symbols("psi phi theta", real=True)
errors = dpsi, dphi, dth, ery, epr, bz, by = symbols("dpsi dphi dtheta e_ry e_pr b_z b_y", real=True)
factors = [R("z", psi), R("z", dpsi), R("y", ery), R("x", phi), R("x", dphi), R("z", epr), R("y", -th), R("y", -dth),
           R("z", bz), R("y", -by)]
form = first_order(factors, [1, 0, 0, 0], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
judge("height of the sight: pitch and boresight", [only(form, {dpsi, dth, bz, by})[2]],
      [(dth + by) * cos(th) * cos(phi) + bz * sin(phi)])
Z = Matrix([[cos(psi), -sin(psi), 0], [sin(psi), cos(psi), 0], [0, 0, 1]])
X = Matrix([[1, 0, 0], [0, cos(phi), -sin(phi)], [0, sin(phi), cos(phi)]])
judge("pitch about the pitch axis", only(form, {dth, by}), (dth + by) * Z * X * Matrix([-sin(th), 0, cos(th)]))
sight = cos(th) * Matrix([cos(psi), sin(psi), 0]) + sin(th) * Matrix([sin(psi) * sin(phi), -cos(psi) * sin(phi), cos(phi)])
judge("yaw about the vertical: a cross product", only(form, {dpsi}), dpsi * Matrix([0, 0, 1]).cross(sight))
angles = [psi, phi, th]
judge_confounded("encoder of pitch and boresight in elevation are one", form, [dth, by], angles)
judge_confounded("the roll axis and the pitch axis are confounded, too", form, [ery, epr], angles)
judge_rank("seven errors, six of them to be told apart", form, errors, 6, angles)
