from sympy import cos, sin, symbols

from derive import R, circles, first_order, judge, judge_rank

h, d = symbols("h delta", real=True)
errors = me, ma, ih, idx, ch, np = symbols("me ma ih id ch np", real=True)
factors = [R("x", -d), R("z", h), R("x", me), R("y", -ma), R("z", -h), R("z", -ih), R("y", np), R("x", d), R("x", idx),
           R("z", -ch)]
form = first_order(factors, [0, 1, 0, 0], errors)
arcs = [ih * cos(d) + ch + np * sin(d) + (me * sin(h) - ma * cos(h)) * sin(d), 0, idx + me * cos(h) + ma * sin(h)]
judge("arcs on the sky", form, arcs)
judge("as typed", form, arcs)
judge("both signs of the polar axis exchanged", form,
      [ih * cos(d) + ch + np * sin(d) + (me * cos(h) - ma * sin(h)) * sin(d), 0, idx + me * sin(h) + ma * cos(h)])
judge_rank("all six can be told apart", form, errors, 6, [h, d])
judge("hour angle and declination by the circles", circles(factors[2:], [0, 1, 0, 0], errors, d),
      [ih + ch / cos(d) + (np + me * sin(h) - ma * cos(h)) * sin(d) / cos(d), idx + me * cos(h) + ma * sin(h)])
