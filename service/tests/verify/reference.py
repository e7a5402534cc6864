"""Reference numbers of `service/src/verify/chance.rs` (SciPy's noncentral distributions) and of `test.rs` (NumPy, by the full covariance)."""
import numpy as np
from scipy.stats import chi2, f, ncf, ncx2

print("const REFERENCE")
for k, nu, x, lam in [(4, None, 11.0, 0.0), (4, None, 11.0, 9.5), (20, None, 34.0, 25.0), (4, 60.0, 11.0, 0.0),
                      (4, 60.0, 11.0, 9.5), (12, 300.0, 25.0, 150.0), (1, 8.0, 6.0, 3.0)]:
    if nu is None:
        p = ncx2.sf(x, k, lam) if lam else chi2.sf(x, k)
    else:
        p = ncf.sf(x / k, k, nu, lam) if lam else f.sf(x / k, k, nu)
    print(f"({k}, {'None' if nu is None else f'Some({nu})'}, {x}, {lam}, {p:.12g}),")
print("const LIMITS")
for k, nu, level in [(4, None, 0.025), (4, 60.0, 0.025), (20, 500.0, 0.05)]:
    q = chi2.isf(level, k) if nu is None else k * f.isf(level, k, nu)
    print(f"({k}, {'None' if nu is None else f'Some({nu})'}, {level}, {q:.12g}),")

# Six whitened numbers, three errors with a covariance: everything by V = I + J C J', written out.
j = np.array([[1.0, 0.2, 0.0], [0.0, 1.0, 0.5], [0.3, 0.0, 1.0], [1.0, -0.2, 0.1], [0.1, 1.0, -0.5], [-0.3, 0.4, 1.0]])
c = np.array([[0.05, 0.01, 0.0], [0.01, 0.08, -0.02], [0.0, -0.02, 0.04]])
r = np.array([2.1, -0.4, 1.9, 1.2, 0.3, 0.8])
v = np.eye(6) + j @ c @ j.T
vi = np.linalg.inv(v)
total = r @ vi @ r
a = j.T @ vi @ j
u = j.T @ vi @ r
t1 = u @ np.linalg.solve(a, u)
print("total", f"{total:.12g}", "explained", f"{t1:.12g}", "rest", f"{total - t1:.12g}")
print("information", [f"{n:.12g}" for n in np.diag(a)], "score", [f"{n:.12g}" for n in u])
gains = []
for row in range(3):
    keep = [n for n in range(6) if n // 2 != row]
    left = r[keep] @ np.linalg.solve(v[np.ix_(keep, keep)], r[keep])
    gains.append(total - left)
print("rows", [f"{g:.12g}" for g in gains])
