from sympy import Matrix, cos, sin, symbols

from derive import R, T, first_order, judge, judge_confounded, judge_rank

k, p, w, t, rho, lx, ly, lz = symbols("kappa phi omega theta rho l_x l_y l_z", real=True)
errors = dlx, dly, dlz, bw, bp, bk, dt, dr = symbols("dlx dly dlz bw bp bk dtheta drho", real=True)
factors = [R("z", k), R("y", p), R("x", w), T("x", lx), T("y", ly), T("z", lz), T("x", dlx), T("y", dly), T("z", dlz),
           R("x", bw), R("y", bp), R("z", bk), R("x", t), R("x", dt), T("z", dr)]
form = first_order(factors, [0, 0, rho, 1], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
attitude = (R("z", k) * R("y", p) * R("x", w))[:3, :3]
r, b, lever = Matrix([0, -rho * sin(t), rho * cos(t)]), Matrix([bw, bp, bk]), Matrix([lx, ly, lz])
judge("boresight and lever arm through the vehicle's attitude", only(form, {dlx, dly, dlz, bw, bp, bk}),
      attitude * (Matrix([dlx, dly, dlz]) + b.cross(r)))
judge("boresight about the inertial unit", only(form, {bw, bp, bk}), attitude * b.cross(r + lever))
moved = b.cross(r)
judge("how far the boresight moves a point", [moved.dot(moved)],
      [rho**2 * (bw**2 + (bp * cos(t) + bk * sin(t))**2)])
angles = [k, p, w, t]
judge_confounded("boresight about the mirror's axis and the mirror's index are one", form, [bw, dt], angles, [rho])
judge_rank("eight errors, seven to be told apart", form.subs({lx: 1, ly: 2, lz: 3}), errors, 7, angles, [rho])
