from sympy import cos, cot, pi, sin, symbols

from derive import R, circles, first_order, judge

H, V = symbols("H V", real=True)
errors = wx, wy, h0, i, v0, c = symbols("wx wy h0 i v0 c", real=True)
factors = [R("x", V - pi / 2), R("z", H), R("x", wx), R("y", wy), R("z", -H), R("z", -h0), R("y", i), R("x", pi / 2 - V),
           R("x", -v0), R("z", -c)]
form = first_order(factors, [0, 1, 0, 0], errors)
right = h0 * sin(V) + c + i * cos(V) + (wx * sin(H) + wy * cos(H)) * cos(V)
up = -v0 + wx * cos(H) - wy * sin(H)
judge("horizontal circle, times sin V, and vertical circle", form, [right, 0, up])
judge("the same, as the quotients that are printed", form,
      [(h0 + c / sin(V) + i * cot(V) + (wx * sin(H) + wy * cos(H)) * cot(V)) * sin(V), 0, up])
judge("tilt of the standing axis with the other sign", form.subs({e: 0 for e in (h0, i, v0, c)}),
      [-(wx * sin(H) + wy * cos(H)) * cos(V), 0, wx * cos(H) - wy * sin(H)])
elevation = symbols("elevation", real=True)
moved = circles([f.subs(V, pi / 2 - elevation) for f in factors[2:]], [0, 1, 0, 0], errors, elevation)
moved = moved.subs(elevation, pi / 2 - V)
judge("the readings of both circles", [moved[0], -moved[1]],
      [h0 + c / sin(V) + i * cot(V) + (wx * sin(H) + wy * cos(H)) * cot(V), v0 - wx * cos(H) + wy * sin(H)])
