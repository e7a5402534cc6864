"""RMS of the residual that the declared errors leave on measured data, by SciPy: all rows alike, exact rotations, no code
shared with the project.

Each mount is written out by hand here as its chain in `examples/` declares it. The residual of a direction is what the
prediction has along the unit vectors across and along at the measured direction.

Usage: instruments.py FOLDER, where FOLDER holds the measured data.
"""
import csv
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

ARCSEC = np.pi / 648000
FOLDER = Path(sys.argv[1])


def columns(name, *keys):
    rows = list(csv.DictReader(open(FOLDER / name)))
    return [np.array([float(row[key]) for row in rows]) for key in keys]


def rotation(axis, angle):
    """One matrix a row, or one for all."""
    angle = np.asarray(angle, dtype=float)
    c, s, o, i = np.cos(angle), np.sin(angle), np.zeros_like(angle), np.ones_like(angle)
    entries = {
        "x": [[i, o, o], [o, c, -s], [o, s, c]],
        "y": [[c, o, s], [o, i, o], [-s, o, c]],
        "z": [[c, -s, o], [s, c, o], [o, o, i]],
    }[axis]
    return np.moveaxis(np.array(entries), (0, 1), (-2, -1))


def sight(*factors):
    vector = np.array([0.0, 1.0, 0.0])
    for axis, angle in reversed(factors):
        vector = (rotation(axis, angle) @ vector[..., None])[..., 0]
    return vector


def spherical(a, e):
    return np.column_stack([np.sin(a) * np.cos(e), np.cos(a) * np.cos(e), np.sin(e)])


def frame(u):
    flat = np.hypot(u[:, 0], u[:, 1])
    sa, ca = u[:, 0] / flat, u[:, 1] / flat
    return np.column_stack([ca, -sa, 0 * sa]), np.column_stack([-sa * u[:, 2], -ca * u[:, 2], flat])


def on_tangent_plane(measured, predicted):
    return np.concatenate([-(axis * predicted).sum(axis=1) for axis in frame(measured)]) / ARCSEC


def rms(residual, parameters, rows):
    found = least_squares(
        residual, np.zeros(parameters), jac="3-point", x_scale="jac", xtol=1e-15, ftol=1e-15, gtol=1e-15
    )
    return np.sqrt((found.fun**2).sum() / rows)


def weighted(name, residual, parameters, rows):
    """Across and along each weighted by its own scatter, until that no longer changes."""
    weight = np.ones(2 * rows)
    for _ in range(50):
        start = np.zeros(parameters)
        found = least_squares(lambda p: weight * residual(p), start, jac="3-point", x_scale="jac", xtol=1e-12, ftol=1e-15, gtol=1e-15)
        left = residual(found.x)
        scatter = np.sqrt((left.reshape(2, -1) ** 2).mean(axis=1))
        if np.allclose(weight, 1 / np.repeat(scatter, rows), rtol=1e-9):
            break
        weight = 1 / np.repeat(scatter, rows)
    print(f"{name}, each component by its scatter: {np.sqrt((left**2).sum() / rows):.9f}")


def auxtel(p, az, el):
    return sight(("x", p[0]), ("y", p[1]), ("z", -az), ("z", -p[2]), ("x", el), ("x", p[3]), ("x", p[4] / np.tan(el)), ("z", p[5]))


def alt_azimuth(p, az, el):
    return sight(("x", p[0]), ("y", p[1]), ("z", -az), ("z", -p[2]), ("y", p[3]), ("x", el), ("x", p[4]), ("z", p[5]))


def equatorial(p, ha, dec, pier):
    return sight(("x", p[0]), ("y", p[1]), ("z", -ha), ("z", -p[2]), ("y", pier * p[3]), ("x", dec), ("x", pier * p[4]), ("z", pier * p[5]))


def linear(name, cross, along, terms):
    """First order by linear least squares: `terms` are pairs of columns, across and along."""
    design = np.vstack([np.column_stack(part) for part in zip(*terms)])
    offsets = np.concatenate([cross, along])
    left = offsets - design @ np.linalg.lstsq(design, offsets, rcond=None)[0]
    print(f"{name} {np.sqrt((left**2).sum() / len(cross)):.9f}")


def report(name, residual, parameters, rows):
    print(f"{name} {rms(residual, parameters, rows):.9f}")


for name in ("auxtel-2022-04", "auxtel-2020-03"):
    ta, te, az, el = np.radians(columns(name + ".csv", "true_az_deg", "true_el_deg", "encoder_az_deg", "encoder_el_deg"))
    measured = spherical(ta, te)
    residual = lambda p: on_tangent_plane(measured, auxtel(p * ARCSEC, az, el))
    report(name, residual, 6, len(az))
    weighted(name, residual, 6, len(az))

for name in ("iram30m-2013-04", "iram30m-2013-10"):
    keys = ("az_deg", "el_deg", "offset_cross_el_arcsec", "offset_el_arcsec", "fwhm_arcsec")
    az, el, cross, along, beam = columns(name + ".csv", *keys)
    for rows, kept in (("all rows", beam < np.inf), ("beam below 30 arcsec", beam < 30)):
        a, e = np.radians(az[kept]), np.radians(el[kept])
        nominal = spherical(a, e)
        across, up = frame(nominal)
        offset = nominal + across * (cross[kept] * ARCSEC)[:, None] + up * (along[kept] * ARCSEC)[:, None]
        measured = offset / np.linalg.norm(offset, axis=1)[:, None]
        for terms, more in (("six terms", []), ("and cos E", [np.cos(e)]), ("and sin E", [np.cos(e), np.sin(e)])):
            def residual(p):
                bent = e + sum((q * ARCSEC * f for q, f in zip(p[6:], more)), 0 * e)
                return on_tangent_plane(measured, alt_azimuth(p[:6] * ARCSEC, a, bent))

            report(f"{name}, {rows}, {terms}:", residual, 6 + len(more), len(a))

for name in ("equatorial-a", "equatorial-b"):
    keys = ("true_ha_deg", "true_dec_deg", "encoder_ha_deg", "encoder_dec_deg")
    th, td, ha, dec = np.radians(columns(name + ".csv", *keys))
    (pier,) = columns(name + ".csv", "pier_side")
    measured = spherical(th, td)
    residual = lambda p: on_tangent_plane(measured, equatorial(p * ARCSEC, ha, dec, pier))
    report(name, residual, 6, len(ha))
    weighted(name, residual, 6, len(ha))
    cross, along = columns(name + ".csv", "offset_cross_dec_arcsec", "offset_dec_arcsec")
    zero = np.zeros_like(th)
    terms = [
        (np.cos(td), zero),  # index of the hour angle
        (zero, pier),  # index of the declination
        (pier, zero),  # collimation
        (pier * np.sin(td), zero),  # non-perpendicularity
        (np.sin(th) * np.sin(td), np.cos(th)),  # tilts of the polar axis
        (-np.cos(th) * np.sin(td), np.sin(th)),
    ]
    linear(f"{name}, first order at the true position:", cross, along, terms)

for name in ("encoder-a", "encoder-b"):
    reference, raw = columns(name + ".csv", "reference_deg", "raw_deg")
    error = (reference - raw + 180) % 360 - 180
    print(f"{name} {3600 * np.sqrt(((error - error.mean()) ** 2).mean()):.9f}")
