from sympy import Matrix, symbols

from derive import R, T, judge, product

X, Y, Z, f, k1, u0, w0 = symbols("X Y Z f k_1 u_0 v_0", real=True)
errors = vx, vy, vz, wx, wy, wz = symbols("v_x v_y v_z omega_x omega_y omega_z", real=True)
camera = [R("z", -wz), R("y", -wy), R("x", -wx), T("z", -vz), T("y", -vy), T("x", -vx)]
seen = (product(camera) * Matrix([X, Y, Z, 1]))[:3, :]
zero = {error: 0 for error in errors}
point = seen.subs(zero)
flat = Matrix([point[0] / point[2], point[1] / point[2]])
judge("pinhole", f * flat + Matrix([u0, w0]), Matrix([f * X / Z + u0, f * Y / Z + w0]))
x, y = X / Z, Y / Z
stretch = 1 + k1 * (flat[0]**2 + flat[1]**2)
judge("radial distortion", f * flat * stretch, f * Matrix([x, y]) * (1 + k1 * (x**2 + y**2)))
image = Matrix([seen[0] / seen[2], seen[1] / seen[2]])
change = sum((image.diff(error).subs(zero) * error for error in errors), Matrix([0, 0]))
velocity = Matrix(errors)
rows = lambda sign: Matrix([[-1 / Z, 0, x / Z, x * y, sign * (1 + x**2), y], [0, -1 / Z, y / Z, 1 + y**2, -x * y, -x]])
judge("interaction matrix", change, rows(-1) * velocity)
judge("interaction matrix with a sign turned", change, rows(1) * velocity)
