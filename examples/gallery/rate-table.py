from sympy import Matrix, cos, sin, symbols

from derive import R, first_order, judge, judge_confounded

al, be, ga = symbols("alpha beta gamma", real=True)
errors = mx, my, mz, dal, dbe, dga, oim, omo, lx, ly = symbols("m_x m_y m_z dal dbe dga o_im o_mo l_x l_y", real=True)
factors = [R("x", mx), R("y", my), R("z", mz), R("z", -ga), R("z", -dga), R("y", -oim), R("x", -be), R("x", -dbe),
           R("y", -omo), R("z", -al), R("z", -dal), R("x", -lx), R("y", -ly)]
form = first_order(factors, [0, 0, 1, 0], errors)
only = lambda vector, kept: vector.subs({e: 0 for e in errors if e not in kept})
sb, cb, sg, cg = sin(be), cos(be), sin(ga), cos(ga)
judge("axes of the table", only(form, {dal, dbe, dga, oim, omo}),
      [cb * sg * dbe + sb * cg * dga - (cb * oim + omo) * cg, cb * cg * dbe - sb * sg * dga + (cb * oim + omo) * sg,
       -sb * dbe])
judge("axes of the table, the inner axis without its lever", only(form, {oim}), [-oim * cg, oim * sg, 0])
judge("mounting of the sensor turns the plumb line as a whole", only(form, {mx, my, mz}),
      Matrix([mx, my, mz]).cross(Matrix([sb * sg, sb * cg, cb])))
judge("the zero of the outer axis is not seen", only(form, {dal}), [0, 0, 0])
judge_confounded("the zero of the inner axis and the sensor's turn about it are one", form, [dga, mz], [al, be, ga])
