from sympy import Matrix, symbols

from derive import R, T, first_order, judge, product

ax, ay, az, bx, by, bz = symbols("ax ay az bx by bz", real=True)
x, y, z, psi, theta, phi = symbols("x y z psi theta phi", real=True)
errors = symbols("dbx dby dbz dx dy dz wx wy wz dax day daz", real=True)
dbx, dby, dbz, dx, dy, dz, wx, wy, wz, dax, day, daz = errors
shift = lambda vector: [T(axis, amount) for axis, amount in zip("xyz", vector)]
back = shift([-dbx, -dby, -dbz]) + shift([-bx, -by, -bz])
turned = [R("z", psi), R("y", theta), R("x", phi)]
tilt = [R("x", wx), R("y", wy), R("z", wz)]
factors = back + shift([x, y, z]) + shift([dx, dy, dz]) + tilt + turned + shift([ax, ay, az]) + shift([dax, day, daz])
zero = {error: 0 for error in errors}
R3, a, b, p = product(turned)[:3, :3], Matrix([ax, ay, az]), Matrix([bx, by, bz]), Matrix([x, y, z])
judge("the leg", (product(factors) * Matrix([0, 0, 0, 1]))[:3, :].subs(zero), p + R3 * a - b)
form = first_order(factors, [0, 0, 0, 1], errors)
da, db, dp, w = Matrix([dax, day, daz]), Matrix([dbx, dby, dbz]), Matrix([dx, dy, dz]), Matrix([wx, wy, wz])
judge("its error", form, dp + w.cross(R3 * a) + R3 * da - db)
judge("its error without the platform's attitude", form, dp + w.cross(R3 * a) + da - db)
