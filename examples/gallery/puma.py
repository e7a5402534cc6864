from sympy import Matrix, cos, pi, sin, symbols

from derive import R, T, judge, product

t1, t2, t3, t4, a2, a3, d3, d4 = symbols("theta_1 theta_2 theta_3 theta_4 a_2 a_3 d_3 d_4", real=True)
row = lambda alpha, a, d, theta: [R("x", alpha), T("x", a), R("z", theta), T("z", d)]
factors = row(0, 0, 0, t1) + row(-pi / 2, 0, 0, t2) + row(0, a2, d3, t3) + row(-pi / 2, a3, d4, t4)
wrist = (product(factors) * Matrix([0, 0, 0, 1]))[:3, :]
c23, s23 = cos(t2 + t3), sin(t2 + t3)
reach = a2 * cos(t2) + a3 * c23 - d4 * s23
said = lambda d: Matrix([cos(t1) * reach - d * sin(t1), sin(t1) * reach + d * cos(t1), -a3 * s23 - a2 * sin(t2) - d4 * c23])
judge("the wrist", wrist, said(d3))
judge("the wrist with the shoulder's offset turned round", wrist, said(-d3))
