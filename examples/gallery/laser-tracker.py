from sympy import cos, pi, sin, sqrt, symbols, tan

from derive import R, T, first_order, judge, judge_rank

H, V, r = symbols("H V R", positive=True)
errors = x6x, x6y, x2, x5, x3, x1t, x1m, x4t, x8 = symbols("x6x x6y x2 x5 x3 x1t x1m x4t x8", real=True)
factors = [R("x", V - pi / 2), R("z", H), R("z", -H), R("z", -(x6x * cos(H) - x6y * sin(H))), T("y", x2), R("y", x5),
           R("x", pi / 2 - V), R("x", -x3), T("x", x1t), T("z", x1m), R("z", -x4t), T("y", x8)]
form = first_order(factors, [0, r, 0, 1], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
right = x1t + r * (x4t + x5 * cos(V) + (x6x * cos(H) - x6y * sin(H)) * sin(V))
along, up = x2 * sin(V) + x8, -x2 * cos(V) + x1m - r * x3
judge("angles times range, and range", form, [right, along, up])
judge("the same, as corrections of angles", form,
      [r * sin(V) * (x1t / (r * sin(V)) + x4t / sin(V) + x5 / tan(V) + x6x * cos(H) - x6y * sin(H)), along,
       -r * (x3 + x2 * cos(V) / r - x1m / r)])
sight = first_order(factors, [0, 1, 0, 0], errors)
judge("the beam alone knows no offsets", only(sight, {x2, x1t, x1m, x8}), [0, 0, 0])
judge("the offset of the transit axis divided by the wrong distance", only(form, {x2}), [0, x2 * sin(V), -x2 * cos(V) / r])
length = only(form, {x2})
judge("the offset of the transit axis alone moves the target by its own size", [length.dot(length)], [x2**2])
judge_rank("from targets all nine can be told apart", form, errors, 9, [H, V], [r])
