from sympy import Matrix, cos, pi, sin, symbols

from derive import R, first_order, judge, product

H, V = symbols("H V", real=True)
errors = wx, wy, h0, i, v0, c = symbols("wx wy h0 i v0 c", real=True)
factors = [R("x", wx), R("y", wy), R("z", -H), R("z", -h0), R("y", i), R("x", pi / 2 - V), R("x", -v0), R("z", -c)]
form = first_order(factors, [0, 1, 0, 0], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
second = form.subs({H: H + pi, V: -V}, simultaneous=True)
mean, half = (form + second) / 2, (form - second) / 2
right = Matrix([cos(H), -sin(H), 0])
judge("collimation moves the sight to the right", only(form, {c}), c * right)
judge("two faces: collimation and trunnion axis drop out of the mean", only(mean, {c, i}), [0, 0, 0])
judge("two faces: the index of the vertical circle drops out as well", only(mean, {c, i, v0}), [0, 0, 0])
sight = Matrix([sin(H) * sin(V), cos(H) * sin(V), cos(V)])
judge("two faces: the tilt of the standing axis stays", only(mean, {c, i, v0, wx, wy}), Matrix([wx, wy, 0]).cross(sight))
judge("two faces: half the difference is collimation and trunnion axis", only(half, {c, i, wx, wy}), (c + i * cos(V)) * right)
judge("two faces: the tilt of the standing axis drops out", only(mean, {wx, wy}), [0, 0, 0])
moved = product(factors) * Matrix([0, 1, 0, 0])
exact = (moved - moved.subs({e: 0 for e in errors}))[:3, :]
judge("exact: collimation alone", only(exact, {c}),
      sin(c) * right + (cos(c) - 1) * sight)
