from sympy import cos, cot, pi, sin, sqrt, symbols

from derive import R, first_order, judge

az, el = symbols("az el", real=True)
errors = p1, p2, p3, p4, p5, p7, p8, p9, r = symbols("p1 p2 p3 p4 p5 p7 p8 p9 r", real=True)
factors = [R("x", -el), R("z", az), R("x", -p5), R("y", p4), R("z", -az), R("z", -p1), R("y", p3), R("x", el),
           R("x", p7 + p8 * cos(el) + p9 * sin(el) + r * cot(el)), R("z", -p2)]
form = first_order(factors, [0, 1, 0, 0], errors)
cross = p1 * cos(el) + p2 + p3 * sin(el) + (p4 * cos(az) - p5 * sin(az)) * sin(el)
up = p7 - p4 * sin(az) - p5 * cos(az) + p8 * cos(el) + p9 * sin(el) + r * cot(el)
judge("azimuth on the sky, and elevation", form, [cross, 0, up])
judge("the form at a fixed elevation is no other", form.subs({e: 0 for e in (p1, p2, p3, p4, p5, p7, r)}),
      [0, 0, p8 * cos(el) + sqrt(2) * p9 * (sin(el + pi / 4) - sqrt(2) / 2 * cos(el))])
judge("a sign of the tilt towards east", form, [cross, 0, up + 2 * p4 * sin(az)])
