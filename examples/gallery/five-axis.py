from sympy import Matrix, cos, sin, symbols

from derive import R, T, first_order, judge, judge_rank

a, c, x, y, z = symbols("a c x y z", real=True)
errors = yca, bca, xa, ya, za, aa, ba, ca = symbols("yca bca xa ya za aa ba ca", real=True)
factors = [R("z", -c), T("y", yca), R("y", bca), R("x", -a), T("x", xa), T("y", ya), T("z", za), R("x", aa), R("y", ba),
           R("z", ca), T("x", x), T("y", y), T("z", z)]
tip = first_order(factors, [0, 0, 0, 1], errors)
axis = first_order(factors, [0, 0, 1, 0], errors)
C = Matrix([[cos(c), sin(c), 0], [-sin(c), cos(c), 0], [0, 0, 1]])
A = Matrix([[1, 0, 0], [0, cos(a), sin(a)], [0, -sin(a), cos(a)]])
judge("tool axis in the workpiece", axis, C * (A * Matrix([ba, -aa, 0]) + bca * Matrix([cos(a), 0, 0])))
judge("tool axis, the tilt of the c axis taken in the frame of the bed", axis, C * A * Matrix([ba + bca, -aa, 0]))
judge("position of the a axis", tip.subs({e: 0 for e in (yca, bca, aa, ba, ca)}),
      [xa * cos(c) + (ya * cos(a) + za * sin(a)) * sin(c), -xa * sin(c) + (ya * cos(a) + za * sin(a)) * cos(c),
       -ya * sin(a) + za * cos(a)])
judge_rank("from the tip all eight are determined", tip, errors, 8, [a, c], [x, y, z])
judge_rank("from the tool's axis three are", axis, errors, 3, [a, c])
