from sympy import Matrix, cos, pi, sin, symbols

from derive import R, T, first_order, judge, judge_rank

q1, q2, q3, a2, a3 = symbols("theta1:4 a2 a3", real=True)
errors = d1, d2, d3, da2, da3, dal = symbols("dtheta1:4 da2 da3 dalpha1", real=True)
factors = [R("z", q1), R("z", d1), R("x", pi / 2), R("x", dal), R("z", q2), R("z", d2), T("x", a2), T("x", da2), R("z", q3),
           R("z", d3), T("x", a3), T("x", da3)]
form = first_order(factors, [0, 0, 0, 1], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
s1, c1, s2, c2, s23, c23 = sin(q1), cos(q1), sin(q2), cos(q2), sin(q2 + q3), cos(q2 + q3)
J = Matrix([[-s1 * (a2 * c2 + a3 * c23), -c1 * (a2 * s2 + a3 * s23), -a3 * c1 * s23],
            [c1 * (a2 * c2 + a3 * c23), -s1 * (a2 * s2 + a3 * s23), -a3 * s1 * s23],
            [0, a2 * c2 + a3 * c23, a3 * c23]])
judge("Jacobian times joint errors", only(form, {d1, d2, d3}), J * Matrix([d1, d2, d3]))
judge("lengths of the links", only(form, {da2, da3}),
      [da2 * c1 * c2 + da3 * c1 * c23, da2 * s1 * c2 + da3 * s1 * c23, da2 * s2 + da3 * s23])
judge("twist between the first two axes", only(form, {dal}), (a2 * s2 + a3 * s23) * dal * Matrix([s1, -c1, 0]))
judge("third column by the forearm's own angle", only(form, {d3}),
      [-a3 * c1 * sin(q3) * d3, -a3 * s1 * sin(q3) * d3, a3 * cos(q3) * d3])
column = only(form, {d3})
judge("a joint error of the third joint moves the hand by the length of the forearm", [column.dot(column)], [a3**2 * d3**2])
judge_rank("six errors, all determined", form.subs({a2: 2, a3: 3}), errors, 6, [q1, q2, q3])
