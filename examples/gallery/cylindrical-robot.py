from sympy import Matrix, cos, pi, sin, symbols

from derive import R, T, judge, product

q1, d1, d2, d3 = symbols("q_1 d_1 d_2 d_3", real=True)
row = lambda theta, d, a, alpha: [R("z", theta), T("z", d), T("x", a), R("x", alpha)]
pose = product(row(q1, d1, 0, 0) + row(0, d2, 0, -pi / 2) + row(0, d3, 0, 0))
c, s = cos(q1), sin(q1)
said = Matrix([[c, 0, -s, -s * d3], [s, 0, c, c * d3], [0, -1, 0, d1 + d2], [0, 0, 0, 1]])
slip = Matrix([[c, -s, 0, -s * d3], [s, c, 0, c * d3], [0, 0, -1, d1 + d2], [0, 0, 0, 1]])
judge("the pose", pose, said)
judge("the pose with its axes run together", pose, slip)
tool = pose[:3, 3]
judge("linear part of the Jacobian", tool.jacobian([q1, d2, d3]), Matrix([[-c * d3, 0, -s], [-s * d3, 0, c], [0, 1, 0]]))
turn = pose[:3, :3]
columns = []
for joint in (q1, d2, d3):
    spin = (turn.diff(joint) * turn.T).applyfunc(lambda entry: entry.simplify())
    columns.append([spin[2, 1], spin[0, 2], spin[1, 0]])
judge("angular part of the Jacobian", Matrix(columns).T, Matrix([[0, 0, 0], [0, 0, 0], [1, 0, 0]]))
