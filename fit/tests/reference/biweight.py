"""Constants of Tukey's biweight on the norm of m normal components, by numerical integration.

c: where the weight reaches zero, for 95 % efficiency at the normal distribution.
k: by which the weighted mean square, sum(w r^2) / (m sum(w)), must be multiplied to be the variance.
"""
import numpy as np
from scipy import integrate, optimize, stats


def expect(m, c, f):
    return integrate.quad(lambda r: f(r) * stats.chi(m).pdf(r), 0, c, epsabs=1e-13, epsrel=1e-13, limit=400)[0]


def constants(m):
    def efficiency(c):
        w = lambda r: (1 - (r / c) ** 2) ** 2
        slope = lambda r: -4 * r / c**2 * (1 - (r / c) ** 2)
        a = expect(m, c, lambda r: w(r) ** 2 * r**2) / m
        b = expect(m, c, lambda r: w(r) + slope(r) * r / m)
        return b**2 / a

    c = optimize.brentq(lambda c: efficiency(c) - 0.95, 2, 20, xtol=1e-12)
    w = lambda r: (1 - (r / c) ** 2) ** 2
    k = m * expect(m, c, w) / expect(m, c, lambda r: w(r) * r**2)
    return c, k, stats.chi(m).median()


for m in (1, 2, 3):
    print(m, *(f"{x:.9f}" for x in constants(m)))
