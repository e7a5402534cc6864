from sympy import cos, sin, symbols

from derive import R, T, first_order, judge

a, b, g = symbols("alpha beta gamma", real=True)
errors = ty1, tx1, ty2, tz2, ty3, tx3, dx2, dy2, dy3 = symbols("ty1 tx1 ty2 tz2 ty3 tx3 dx2 dy2 dy3", real=True)
factors = [R("y", ty1), R("x", tx1), R("z", a), T("x", dx2), T("y", dy2), R("y", ty2), R("z", tz2), R("x", b), T("y", dy3),
           R("y", ty3), R("x", tx3), R("z", g)]
pointing = first_order(factors, [0, 0, 1, 0], errors)
position = first_order(factors, [0, 0, 0, 1], errors)
middle = ty2 * cos(b) + tz2 * sin(b)
judge("equation (6)", pointing,
      [ty1 * cos(b) + middle * cos(a) + tx3 * cos(b) * sin(a), -tx1 * cos(b) + middle * sin(a) - tx3 * cos(a) * sin(b),
       -(tx1 * cos(a) + ty1 * sin(a)) * sin(b) - tx3 * sin(b)])
judge("equation (7)", position,
      [dx2 * cos(a) - dy2 * sin(a) - dy3 * cos(b) * sin(a), dy2 * cos(a) + dx2 * sin(a) + dy3 * cos(b) * cos(a),
       dy3 * sin(b)])
judge("the lens centre at rest knows perpendicularity by nothing", position.subs({e: 0 for e in (dx2, dy2, dy3)}), [0, 0, 0])
judge("how far the intersections move the lens centre", [position.dot(position)],
      [dx2**2 + dy2**2 + dy3**2 + 2 * dy2 * dy3 * cos(b)])
