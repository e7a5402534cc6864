from sympy import cos, sin, symbols, tan

from derive import R, circles, first_order, judge, judge_rank

A, E = symbols("A E", real=True)
errors = an, aw, ia, ie, ca, npae, tf = symbols("an aw ia ie ca npae tf", real=True)
factors = [R("x", -E), R("z", A), R("x", -an), R("y", -aw), R("z", -A), R("z", ia), R("y", -npae), R("x", E),
           R("x", ie - tf * cos(E)), R("z", ca)]
form = first_order(factors, [0, 1, 0, 0], errors)
cross = -ia * cos(E) - ca - npae * sin(E) - (an * sin(A) + aw * cos(A)) * sin(E)
azimuth = -ia - ca / cos(E) - npae * tan(E) - (an * sin(A) + aw * cos(A)) * tan(E)
up = ie - tf * cos(E) - an * cos(A) + aw * sin(A)
judge("cross-elevation and elevation", form, [cross, 0, up])
judge("azimuth itself, times cos E", form, [cos(E) * azimuth, 0, up])
judge("azimuth without cos E", form, [azimuth, 0, up])
judge_rank("all seven can be told apart", form, errors, 7, [A, E])
judge("azimuth and elevation by the circles", circles(factors[2:], [0, 1, 0, 0], errors, E), [azimuth, up])
