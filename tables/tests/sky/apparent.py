"""Apparent places of date of stars of J2000, and sidereal times, by ERFA (pip install pyerfa): writes apparent.txt beside this file.

Nothing of the project is used. Columns: Julian day of UTC, right ascension (h) and declination (deg) of ICRS, the same apparent of date
(geocentric), longitude (deg, east), apparent sidereal time there (h). Stars within 20 degrees of the Sun, whose light it bends by more than
0.02 arc seconds, are left out.
"""

import math
import pathlib
import random

import erfa

random.seed(54)


def from_sun(tt, ra, dec):
    heliocentric, _ = erfa.epv00(2451545.0, tt - 2451545.0)
    x, y, z = (-part for part in heliocentric["p"])
    a, d = math.radians(15 * ra), math.radians(dec)
    along = x * math.cos(d) * math.cos(a) + y * math.cos(d) * math.sin(a) + z * math.sin(d)
    return math.degrees(math.acos(along / math.sqrt(x * x + y * y + z * z)))



TT = 69.184 / 86400.0
lines = ["# JD_UTC ra_h dec_deg apparent_ra_h apparent_dec_deg longitude_deg last_h"]
for year in (2001, 2009, 2017, 2023, 2026, 2031):
    for _ in range(8):
        day = 2451544.5 + (year - 2000) * 365.25 + random.uniform(0, 365)
        ra, dec = random.uniform(0, 24), math.degrees(math.asin(random.uniform(-0.999, 0.999)))
        longitude = random.uniform(-180, 180)
        tt = day + TT
        if from_sun(tt, ra, dec) < 20.0:
            continue
        # Catalogue place to CIRS without parallax and motion; less the equation of the origins it is the apparent place.
        ri, di, eo = erfa.atci13(math.radians(15 * ra), math.radians(dec), 0.0, 0.0, 0.0, 0.0, 2451545.0, tt - 2451545.0)
        apparent = (math.degrees(ri - eo) / 15.0) % 24.0
        gast = erfa.gst06a(2451545.0, day - 2451545.0, 2451545.0, tt - 2451545.0)
        last = (math.degrees(gast) / 15.0 + longitude / 15.0) % 24.0
        lines.append(f"{day:.9f} {ra:.9f} {dec:.8f} {apparent:.10f} {math.degrees(di):.9f} {longitude:.6f} {last:.10f}")
pathlib.Path(__file__).with_name("apparent.txt").write_text("\n".join(lines) + "\n")
