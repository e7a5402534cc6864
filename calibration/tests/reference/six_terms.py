"""RMS on the sky of the six geometric terms of an alt-azimuth mount, by linear least squares, all rows alike.

Usage: six_terms.py iram30m-2013-04.csv iram30m-2013-10.csv
"""
import csv
import sys

import numpy as np

for name in sys.argv[1:]:
    rows = list(csv.DictReader(open(name)))
    az, el = (np.radians([float(row[key]) for row in rows]) for key in ("az_deg", "el_deg"))
    cross, along = (
        np.array([float(row[key]) for row in rows]) for key in ("offset_cross_el_arcsec", "offset_el_arcsec")
    )
    zero, one = np.zeros_like(az), np.ones_like(az)
    terms = [
        (np.cos(el), zero),  # index of azimuth
        (zero, one),  # index of elevation
        (one, zero),  # collimation
        (np.sin(el), zero),  # non-perpendicularity
        (np.sin(az) * np.sin(el), np.cos(az)),  # tilt about east
        (-np.cos(az) * np.sin(el), np.sin(az)),  # tilt about north
    ]
    design = np.vstack([np.column_stack(part) for part in zip(*terms)])
    measured = np.concatenate([cross, along])
    estimate = np.linalg.lstsq(design, measured, rcond=None)[0]
    residual = (measured - design @ estimate).reshape(2, -1)
    print(name, f"{np.sqrt((residual**2).sum() / len(rows)):.4f}")
