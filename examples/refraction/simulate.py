"""Stars seen through the air with two mounts, by spherical trigonometry alone; shares no code with trueaxis.

A star stands at an hour angle and declination. The air lifts it along the vertical circle by 58.2 arcsec times the tangent of
its zenith distance. The mount is pointed at where the star then appears, and its circles are read. Each file has the circles
read and the place of the star without air. `clean.csv` is the same night without air.

Run: python3 simulate.py
"""

import csv
import math
import random

ARCSEC = math.pi / 180 / 3600
LATITUDE = math.radians(48)
REFRACTION = 58.2 * ARCSEC
NOISE = 1.0 * ARCSEC


def horizontal(hour, declination):
    """Azimuth from south through west and altitude, of an hour angle and declination."""
    sine = math.sin(LATITUDE) * math.sin(declination) + math.cos(LATITUDE) * math.cos(declination) * math.cos(hour)
    across = math.cos(declination) * math.sin(hour)
    along = math.sin(LATITUDE) * math.cos(declination) * math.cos(hour) - math.cos(LATITUDE) * math.sin(declination)
    return math.atan2(across, along), math.asin(sine)


def equatorial(azimuth, altitude):
    """Hour angle and declination, of an azimuth from south through west and an altitude."""
    sine = math.sin(LATITUDE) * math.sin(altitude) - math.cos(LATITUDE) * math.cos(altitude) * math.cos(azimuth)
    across = math.cos(altitude) * math.sin(azimuth)
    along = math.sin(LATITUDE) * math.cos(altitude) * math.cos(azimuth) + math.cos(LATITUDE) * math.sin(altitude)
    return math.atan2(across, along), math.asin(sine)


def lifted(altitude, refraction):
    """The altitude at which a star appears, by iteration: the air bends by the tangent of the apparent zenith distance."""
    apparent = altitude
    for _ in range(20):
        apparent = altitude + refraction * math.tan(math.pi / 2 - apparent)
    return apparent


def write(name, header, rows):
    with open(name, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        for row in rows:
            writer.writerow(f"{math.degrees(angle):.8f}" for angle in row)


def on_an_equatorial_mount(name, refraction, seed):
    """Polar axis 70 arcsec high and 45 arcsec east of the pole, indices and collimation: to first order, as pointing models have them."""
    me, ma, ih, declination_index, ch, np = (70, -45, 210, -130, 55, -38)
    chance = random.Random(seed)
    rows = []
    while len(rows) < 58:
        hour = math.radians(chance.uniform(-75, 75))
        declination = math.asin(chance.uniform(math.sin(math.radians(-20)), math.sin(math.radians(75))))
        azimuth, altitude = horizontal(hour, declination)
        if altitude < math.radians(18):
            continue
        h, d = equatorial(azimuth, lifted(altitude, refraction))
        # Reading = place - correction; the corrections of TPOINT are IH + CH sec d + NP tan d - MA cos h tan d + ME sin h tan d and ID + MA sin h + ME cos h.
        dh = ih + (ch / math.cos(d)) + np * math.tan(d) - ma * math.cos(h) * math.tan(d) + me * math.sin(h) * math.tan(d)
        dd = declination_index + ma * math.sin(h) + me * math.cos(h)
        read_h = h - dh * ARCSEC + chance.gauss(0, NOISE) / math.cos(d)
        read_d = d - dd * ARCSEC + chance.gauss(0, NOISE)
        rows.append((read_h, read_d, hour, declination))
    write(name, ["encoder_ha_deg", "encoder_dec_deg", "true_ha_deg", "true_dec_deg"], rows)


def on_an_alt_azimuth_mount(name, refraction, seed):
    """Indices, collimation and a tilted azimuth axis."""
    ia, ie, ca, an = (160, -90, 40, 25)
    chance = random.Random(seed)
    rows = []
    while len(rows) < 80:
        azimuth = math.radians(chance.uniform(-180, 180))
        altitude = math.asin(chance.uniform(math.sin(math.radians(18)), math.sin(math.radians(80))))
        e = lifted(altitude, refraction)
        # Azimuth from north through east.
        da = -ia - ca / math.cos(e) - an * math.sin(azimuth) * math.tan(e)
        de = ie - an * math.cos(azimuth)
        read_a = azimuth - da * ARCSEC + chance.gauss(0, NOISE) / math.cos(e)
        read_e = e - de * ARCSEC + chance.gauss(0, NOISE)
        rows.append((read_a, read_e, azimuth, altitude))
    write(name, ["encoder_az_deg", "encoder_el_deg", "true_az_deg", "true_el_deg"], rows)


if __name__ == "__main__":
    on_an_equatorial_mount("stars.csv", REFRACTION, 1)
    on_an_equatorial_mount("clean.csv", 0.0, 2)
    on_an_alt_azimuth_mount("alt-azimuth.csv", REFRACTION, 3)
