"""Reference numbers of `service/src/compare`: NumPy and SciPy, from the formulas alone."""
import numpy as np
from scipy.stats import chi2

x = [np.array(v) for v in ([1.0, 2.0, 3.0], [1.4, 0.6, 3.3], [0.2, 1.9, 1.5])]
c = [np.array(v).reshape(3, 3) for v in (
    [0.5, 0.1, 0.0, 0.1, 0.4, 0.2, 0.0, 0.2, 0.9],
    [0.3, 0.0, 0.1, 0.0, 0.2, 0.0, 0.1, 0.0, 0.6],
    [0.7, 0.2, 0.1, 0.2, 0.8, 0.0, 0.1, 0.0, 0.5])]


def q(n):
    """Stacked generalised least squares: what is left of n estimates about one common vector."""
    y = np.concatenate(x[:n])
    big = np.zeros((3 * n, 3 * n))
    for k in range(n):
        big[3 * k:3 * k + 3, 3 * k:3 * k + 3] = c[k]
    ones = np.vstack([np.eye(3)] * n)
    root = np.linalg.inv(np.linalg.cholesky(big))
    left = np.linalg.lstsq(root @ ones, root @ y, rcond=None)[0]
    r = root @ (y - ones @ left)
    return r @ r, chi2.sf(r @ r, 3 * (n - 1))


d = x[1] - x[0]
print("two", d @ np.linalg.solve(c[0] + c[1], d))
for n in (2, 3):
    print(n, *(f"{v:.15g}" for v in q(n)))

# A drift: values at days 0, 31, 59, 90 with their standard uncertainties.
days = np.array([0.0, 31.0, 59.0, 90.0]) / (365.2425 / 12)
v = np.array([1.0, 1.6, 1.9, 3.1])
s = np.array([0.2, 0.3, 0.2, 0.4])
a = np.column_stack([np.ones(4), days])
w = np.diag(1 / s**2)
cov = np.linalg.inv(a.T @ w @ a)
print("drift", *(f"{n:.15g}" for n in (cov @ a.T @ w @ v)), *(f"{n:.15g}" for n in np.sqrt(np.diag(cov))))
