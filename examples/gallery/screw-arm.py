from sympy import Matrix, cos, sin, symbols

from derive import R, T, judge, product

q1, q2, q3, q4, l0, l1, l2 = symbols("q1 q2 q3 q4 l0 l1 l2", real=True)
pose = product([R("z", q1), T("y", l1), R("z", q2), T("y", l2), R("z", q3), T("z", l0), T("z", q4)])


# A turn about the vertical through (0, y), from shifts alone. Its v = -omega x q is (y, 0, 0).
def turn(y, angle):
    return T("y", y) * R("z", angle) * T("y", -y)


zero = T("y", l1 + l2) * T("z", l0)
said = turn(0, q1) * turn(l1, q2) * turn(l1 + l2, q3) * T("z", q4) * zero
slip = turn(0, q1) * turn(l1, q2) * turn(l1, q3) * T("z", q4) * zero
judge("product of exponentials", pose, said)
judge("a screw through the wrong joint", pose, slip)
tool = Matrix([-l1 * sin(q1) - l2 * sin(q1 + q2), l1 * cos(q1) + l2 * cos(q1 + q2), l0 + q4])
judge("the tool, multiplied out", pose[:3, 3], tool)
