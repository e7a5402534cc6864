"""Sample files in the forms that other programs write, two of each: write.py writes them into samples/ beside it.

Every form is written from its public description, which the reader of that form names; every instrument is written out by hand, as a product
of rotations and shifts. Nothing of the project is used. Places of J2000 are made by ERFA (pip install pyerfa).
"""

import json
import math
import pathlib
import random

import erfa

ARCSEC = math.pi / 648000
DEG = math.pi / 180
OUT = pathlib.Path(__file__).with_name("samples")
chance = random.Random(54)


def turned(vector, axis, angle):
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return {"x": (x, c * y - s * z, s * y + c * z), "y": (c * x + s * z, y, c * z - s * x), "z": (c * x - s * y, s * x + c * y, z)}[axis]


def moved(vector, *factors):
    """Factors from the ground up: (axis, angle), or three lengths of a shift."""
    for factor in reversed(factors):
        vector = tuple(v + f for v, f in zip(vector, factor)) if len(factor) == 3 else turned(vector, *factor)
    return vector


def noisy(vector, sigma):
    off = [v + chance.gauss(0, sigma) for v in vector]
    length = math.sqrt(sum(v * v for v in off))
    return [v / length for v in off]


def angles(vector):
    return math.atan2(vector[0], vector[1]), math.asin(vector[2])


def write(name, text, newline="\n"):
    (OUT / name).write_bytes(text.replace("\n", newline).encode())


def sexagesimal(value, digits, separator=" ", sign=False):
    """Hours or degrees, minutes and seconds."""
    units = round(abs(value) * 3600 * 10**digits)
    seconds, fraction = divmod(units, 10**digits)
    text = f"{seconds // 3600:02d}{separator}{seconds // 60 % 60:02d}{separator}{seconds % 60:02d}"
    text += f".{fraction:0{digits}d}" if digits else ""
    return ("-" if value < 0 else "+" if sign else "") + text


# Telescopes


def equatorial(rows, sigma=3 * ARCSEC):
    """Readings and true hour angles and declinations, rad, with the side of the pier."""
    p = {name: chance.uniform(-150, 150) * ARCSEC for name in ("tx", "ty", "ha", "np", "dec", "ch")}
    for row in range(rows):
        pier = 1 if row % 2 else -1
        ha = chance.uniform(0.05, 1.2) * pier
        dec = math.asin(chance.uniform(-0.3, 0.9))
        seen = moved((0, 1, 0), ("x", p["tx"]), ("y", p["ty"]), ("z", -ha), ("z", -p["ha"]), ("y", pier * p["np"]), ("x", dec),
                     ("x", pier * p["dec"]), ("z", pier * p["ch"]))
        yield ha, dec, *angles(noisy(seen, sigma)), pier


def horizontal_mount(rows, sigma=2 * ARCSEC):
    p = {name: chance.uniform(-60, 60) * ARCSEC for name in ("tx", "ty", "az", "np", "el", "dr", "ch")}
    for _ in range(rows):
        az, el = chance.uniform(0, 2 * math.pi), math.asin(chance.uniform(0.3, 0.95))
        seen = moved((0, 1, 0), ("x", p["tx"]), ("y", p["ty"]), ("z", -az), ("z", -p["az"]), ("y", p["np"]), ("x", el), ("x", p["el"]),
                     ("x", p["dr"] * math.cos(el)), ("z", p["ch"]))
        yield az, el, *angles(noisy(seen, sigma))


def to_equatorial(az, el, latitude):
    dec = math.asin(math.sin(el) * math.sin(latitude) + math.cos(el) * math.cos(latitude) * math.cos(az))
    west = -math.cos(el) * math.sin(az)
    south = math.sin(el) * math.cos(latitude) - math.cos(el) * math.sin(latitude) * math.cos(az)
    return math.atan2(west, south), dec


def tpoint_of_radio(name, newline="\n"):
    latitude = 19 + 49 / 60 + 22.3 / 3600
    lines = ["JCMT Pointing Test - 2009/01/28", ": ALTAZ", "+19 49 22.30  2009 01 29    -2.25  621.00   4120.00   0.827   866.963"]
    for row, (az, el, true_az, true_el) in enumerate(horizontal_mount(60)):
        minutes = 480 + row * 7.13254
        sidereal = minutes / 60
        cells = []
        for a, e in ((true_az, true_el), (az, el)):
            ha, dec = to_equatorial(a, e, latitude * DEG)
            cells += [sexagesimal((sidereal - ha / DEG / 15) % 24, 3), sexagesimal(dec / DEG, 2, sign=True)]
        cells[2:2] = [""]
        lines.append(f"{cells[0]} {cells[1]}  {cells[3]} {cells[4]}   {int(sidereal):02d} {minutes % 60:8.5f}    4.760  108.775 HARPB    0.00    0.00")
    write(name, "\n".join(lines) + "\nEND\n", newline)


def tpoint_of_mount(name):
    lines = ["! written by a mount-control program", "ROTSE-III Prototype", ":EQUAT", ":NODA", ":ALLSKY", "35 52 8.4 2001 5 30"]
    for row, (ha, dec, true_ha, true_dec, pier) in enumerate(equatorial(60)):
        minutes = 780 + row * 4.21
        sidereal = minutes / 60
        ra, true_ra = ((sidereal - angle / DEG / 15) % 24 for angle in (ha, true_ha))
        read = (ra, dec / DEG) if pier > 0 else ((ra + 12) % 24, math.copysign(180, dec) - dec / DEG)
        lines.append(f"{sexagesimal(true_ra, 2)} {sexagesimal(true_dec / DEG, 1, sign=True)} {sexagesimal(read[0], 2)} "
                     f"{sexagesimal(read[1], 1, sign=True)} {int(sidereal):02d} {minutes % 60:05.2f}")
    write(name, "\n".join(lines) + "\nEND\n")


def mountwizard(name, latitude):
    points = []
    for row, (ha, dec, true_ha, true_dec, pier) in enumerate(equatorial(50)):
        sidereal = (3.5 + 0.06 * row) % 24
        points.append({
            "altitude": 50.0, "azimuth": 120.0, "countSequence": row, "decJNowM": dec / DEG, "decJNowS": true_dec / DEG,
            "decJ2000S": true_dec, "errorRMS_S": 1.2, "julianDate": f"2024-02-10T20:{row:02d}:00Z", "latitude": latitude,
            "name": "m-file-2024", "pierside": "E" if pier > 0 else "W", "profile": "config", "raJNowM": (sidereal - ha / DEG / 15) % 24,
            "raJNowS": (sidereal - true_ha / DEG / 15) % 24, "siderealTime": sidereal, "version": "3.2.3",
        })
    write(name, json.dumps(points, sort_keys=True, indent=4))


def to_j2000(day, ha, dec, longitude):
    """Right ascension (h) and declination (deg) of ICRS of an apparent hour angle and declination at an instant of UTC."""
    tt = day + 69.184 / 86400
    gast = erfa.gst06a(2451545.0, day - 2451545.0, 2451545.0, tt - 2451545.0)
    apparent = gast + longitude * DEG - ha
    _, _, eo = erfa.atci13(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2451545.0, tt - 2451545.0)
    ra, dec, _ = erfa.atic13(apparent + eo, dec, 2451545.0, tt - 2451545.0)
    return float(ra) / DEG / 15 % 24, float(dec) / DEG


def sidereal_hours(day, longitude):
    tt = day + 69.184 / 86400
    return (erfa.gst06a(2451545.0, day - 2451545.0, 2451545.0, tt - 2451545.0) / DEG / 15 + longitude / 15) % 24


def calendar(day, digits):
    year, month, date, clock = erfa.d2dtf("UTC", digits, 2451545.0, day - 2451545.0)
    hour, minute, second, fraction = tuple(clock.item())
    return f"{year:04d}-{month:02d}-{date:02d}T{hour:02d}:{minute:02d}:{second:02d}.{fraction:0{digits}d}"


def autoslew(name, longitude, newline):
    """Points at whole hundredths of seconds, so that what is written is what was."""
    lines = []
    points = list(equatorial(40))
    for row, (ha, dec, true_ha, true_dec, pier) in enumerate(points):
        day = 2460345.25 + round(row * 311.37, 2) / 86400
        read, seen = (to_j2000(day, a, d, longitude) for a, d in ((ha, dec), (true_ha, true_dec)))
        time = calendar(day, 2)
        if row == 0:
            read = seen
        lines += [f'"Number {row + 1} {"sync point" if row == 0 else "no pointing correction"}"', f"\"'{time}'\"", f'"{time[14:]}"', '"5"',
                  repr(read[0]), repr(seen[0]), repr(read[1]), repr(seen[1]), '"1"' if pier > 0 else '"-1"', "*" * 26]
    write(name, "\n".join([str(len(points)), *lines]) + "\n", newline)


def plate_solves_with_sidereal_time(name):
    lines = ["Frame,Mount RA,Mount Dec,Solved RA,Solved Dec,LST,Side of pier"]
    for row, (ha, dec, true_ha, true_dec, pier) in enumerate(equatorial(50)):
        sidereal = (20.1 + row * 0.0731) % 24
        ra, true_ra = ((sidereal - angle / DEG / 15) % 24 for angle in (ha, true_ha))
        # The sidereal time as it is written.
        written = sexagesimal(sidereal, 3)
        cells = [f"frame_{row:03d}.fits", sexagesimal(ra, 3), sexagesimal(dec / DEG, 2, sign=True), sexagesimal(true_ra, 3, ":"),
                 sexagesimal(true_dec / DEG, 2, ":", True), written, "East" if pier > 0 else "West"]
        lines.append(",".join(cells))
    write(name, "\n".join(lines) + "\n")


def plate_solves_with_site(name, longitude):
    """Semicolons and decimal commas, a byte-order mark, a site above the header, the solve in J2000 and the mount of date."""
    lines = ["\ufeff# latitude = 48 08 14 N", f"# longitude: {longitude} E", "Image;Telescope RA JNow [h];Telescope Dec JNow [deg];WCS RA J2000 [deg];WCS Dec J2000 [deg];DATE-OBS;SideOfPier"]
    for row, (ha, dec, true_ha, true_dec, pier) in enumerate(equatorial(50)):
        day = 2460980.3 + row * 0.0021
        time = calendar(day, 3)
        seen = to_j2000(day, true_ha, true_dec, longitude)
        read = (sidereal_hours(day, longitude) - ha / DEG / 15) % 24
        cells = [f"{row}", f"{read:.8f}", f"{dec / DEG:.7f}", f"{seen[0] * 15:.7f}", f"{seen[1]:.7f}"]
        lines.append(";".join([*(cell.replace(".", ",") for cell in cells), time, "pierEast" if pier > 0 else "pierWest"]))
    write(name, "\n".join(lines) + "\n", "\r\n")


# Surveying


def stations(points, places):
    """Angles of both faces and distances from stations (shift, turn about z) to points: station, point, face, hz, zenith, distance."""
    p = {"trunnion": 25 * ARCSEC, "index": -18 * ARCSEC, "collimation": 30 * ARCSEC, "zero": 0.002}
    for station, (shift, turn) in enumerate(places):
        for name, point in enumerate(points):
            local = turned(tuple(a - b for a, b in zip(point, shift)), "z", -turn)
            for face in (1, 2):
                # The readings whose sight goes through the point, by a few steps.
                hz, el = math.atan2(local[0], local[1]), math.atan2(local[2], math.hypot(local[0], local[1]))
                distance = math.sqrt(sum(v * v for v in local))
                wanted = tuple(v / distance for v in local)
                if face == 2:
                    hz, el = hz + math.pi, math.pi - el
                for _ in range(6):
                    sight = moved((0, 1, 0), ("z", -hz), ("y", p["trunnion"]), ("x", el), ("x", p["index"]), ("z", p["collimation"]))
                    az, up = angles(sight)
                    target_az, target_up = angles(wanted)
                    hz += (target_az - az + math.pi) % (2 * math.pi) - math.pi
                    el += (target_up - up) * (1 if face == 1 else -1)
                noise = chance.gauss
                yield (station, name, face, (hz + noise(0, 2 * ARCSEC)) % (2 * math.pi), (math.pi / 2 - el + noise(0, 2 * ARCSEC)) % (2 * math.pi),
                       distance - p["zero"] + noise(0, 2e-4))


def around(count, low=6, high=40):
    points = []
    for at in range(count):
        direction = 2 * math.pi * at / count + chance.uniform(-0.2, 0.2)
        reach = chance.uniform(low, high)
        points.append((reach * math.sin(direction), reach * math.cos(direction), reach * chance.uniform(-0.5, 0.7)))
    return points


def gsi8(name):
    """Gon, unknown points from two stations, with the coordinates that the instrument computes beside them."""
    lines, block = [], 1
    last = None
    for station, point, face, hz, zenith, distance in stations(around(14), [((0, 0, 0), 0.0), ((9.0, -5.0, 0.4), 2.1)]):
        if station != last:
            lines.append(f"11{block:04d}+000ST{station + 1:03d} 84..16+00000000 85..16+00000000 86..16+00000000 88..16+00015500")
            last, block = station, block + 1
        gon = [round(angle / DEG / 0.9 * 1e5) % 40000000 for angle in (hz, zenith)]
        lines.append(f"11{block:04d}+00P{point:05d} 21.322+{gon[0]:08d} 22.322+{gon[1]:08d} 31..06+{round(distance * 1e4):08d} 51....+0000+000 "
                     f"81..00+00012345 82..00-00002345 83..00+00000123")
        block += 1
    write(name, "\n".join(lines) + "\n", "\r\n")


def gsi16(name):
    """Degrees, minutes and seconds, to points whose coordinates stand in front."""
    points, lines = around(24), []
    for at, point in enumerate(points):
        coordinates = " ".join(f"8{axis}..16{'-' if value < 0 else '+'}{round(abs(value) * 1e4):016d}" for axis, value in enumerate(point, 1))
        lines.append(f"*11{at + 1:04d}+{'CTRL' + str(at):0>16} {coordinates}")
    for at, (_, point, face, hz, zenith, distance) in enumerate(stations(points, [((1.2, -0.8, 0.3), 0.6)])):
        words = []
        for index, angle in (("21", hz), ("22", zenith)):
            tenths = round(angle / DEG * 36000) % (360 * 36000)
            packed = tenths // 36000 * 100000 + tenths // 600 % 60 * 1000 + tenths % 600
            words.append(f"{index}.324+{packed:016d}")
        lines.append(f"*11{len(points) + at + 1:04d}+{'CTRL' + str(point):0>16} {' '.join(words)} 31..06+{round(distance * 1e4):016d}")
    write(name, "\n".join(lines) + "\n")


def packed_degrees(angle):
    """DDD.MMSSs as pocket calculators of surveyors have it: 12.34567 is 12° 34′ 56.7″."""
    tenths = round(angle / DEG * 36000)
    return f"{tenths // 36000}.{tenths // 600 % 60:02d}{tenths % 600:03d}"


def points_csv(name, separator):
    points = around(20)
    lines = [separator.join(["Point", "Hz [DDD.MMSS]", "V [DDD.MMSS]", "SD [m]", "x [m]", "y [m]", "z [m]"])]
    for _, point, face, hz, zenith, distance in stations(points, [((0.5, 0.9, -0.2), 1.1)]):
        cells = [packed_degrees(hz), packed_degrees(zenith), f"{distance:.4f}", *(f"{value:.4f}" for value in points[point])]
        cells = [cell.replace(".", ",") if separator == ";" else cell for cell in cells]
        lines.append(separator.join([f"N{point}F{face}", *cells]))
    write(name, "\n".join(lines) + "\n")


# Robots


def arm_at(links, q, modified=False):
    """Factors of an arm of links (theta, d, a, alpha) at readings q."""
    factors = []
    for (theta, d, a, alpha), angle in zip(links, q):
        turn, across = [("z", theta + angle), (0, 0, d)], [(a, 0, 0), ("x", alpha)]
        factors += [("x", alpha), (a, 0, 0), *turn] if modified else turn + across
    return factors


def disturbed(links, size=4e-4, turn=90 * ARCSEC):
    return [(theta + chance.uniform(-turn, turn), d + chance.uniform(-size, size), a + chance.uniform(-size, size), alpha + chance.uniform(-turn, turn))
            for theta, d, a, alpha in links]


def poses(name, links, header, rows=40, modified=False):
    true = disturbed(links)
    lines = [header]
    for _ in range(rows):
        q = [chance.uniform(-2.4, 2.4) for _ in links]
        at = moved((0.35, 0.03, 0.07), (0.8, -0.4, 0.3), ("x", 0.02), ("y", 0.03), ("z", -1.1), *arm_at(true, q, modified))
        cells = [f"{angle / DEG:.7f}" for angle in q] + [f"{1000 * v + chance.gauss(0, 0.02):.4f}" for v in at]
        lines.append(",".join(cells))
    write(name, "\n".join(lines) + "\n")


def axes(factors):
    """The columns of the rotation of some factors."""
    origin = moved((0, 0, 0), *factors)
    return [tuple(v - o for v, o in zip(moved(unit, *factors), origin)) for unit in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]


def as_quaternion(columns):
    """w, x, y, z of a rotation matrix by its columns, by the largest of the four."""
    m = [[columns[c][r] for c in range(3)] for r in range(3)]
    squares = [1 + m[0][0] + m[1][1] + m[2][2]] + [1 + 2 * m[i][i] - (m[0][0] + m[1][1] + m[2][2]) for i in range(3)]
    at = max(range(4), key=lambda i: squares[i])
    size = 2 * math.sqrt(squares[at])
    mixed = {(0, 1): m[2][1] - m[1][2], (0, 2): m[0][2] - m[2][0], (0, 3): m[1][0] - m[0][1], (1, 2): m[0][1] + m[1][0], (1, 3): m[0][2] + m[2][0],
             (2, 3): m[1][2] + m[2][1]}
    return [size / 4 if i == at else mixed[tuple(sorted((i, at)))] / size for i in range(4)]


def as_zyx(columns):
    """Turns about z, the new y and the new x."""
    m = [[columns[c][r] for c in range(3)] for r in range(3)]
    return math.atan2(m[1][0], m[0][0]), math.asin(-m[2][0]), math.atan2(m[2][1], m[2][2])


def whole_poses(name, links, joints, header, cells_of, modified=False, rows=40):
    """Where a probe is and how it is turned, to 0.02 mm and 20 arc seconds."""
    true = disturbed(links)
    lines = [",".join([*joints, header])]
    for _ in range(rows):
        q = [chance.uniform(-2.4, 2.4) for _ in links]
        factors = [(0.8, -0.4, 0.3), ("x", 0.02), ("y", 0.03), ("z", -1.1), *arm_at(true, q, modified)]
        at = [v + chance.gauss(0, 2e-5) for v in moved((0.35, 0.03, 0.07), *factors)]
        noise = [(axis, chance.gauss(0, 20 * ARCSEC)) for axis in "xyz"]
        turn = axes([*noise, *factors, ("x", 0.1), ("y", -0.05), ("z", 0.2)])
        lines.append(",".join([f"{angle / DEG:.7f}" for angle in q] + cells_of(at, turn)))
    write(name, "\n".join(lines) + "\n")


def dh_tables():
    # The first three axes of a PUMA 560, by J. J. Craig (2005), figure 3.21, in his convention; in metres.
    modified = [(0, 0, 0, 0), (0, 0, 0, -math.pi / 2), (0, 0.1244, 0.4318, 0)]
    rows = ["# PUMA 560", "# convention: modified", "joint,alpha [deg],a [mm],d [mm],theta [deg]"]
    rows += [f"{at},{alpha / DEG:g},{a * 1000:g},{d * 1000:g},q{at}" for at, (_, d, a, alpha) in enumerate(modified, 1)]
    write("puma.dh.csv", "\n".join(rows) + "\n")
    poses("puma.poses.csv", modified, ",".join(f"q{at} [deg]" for at in range(1, 4)) + ",x [mm],y [mm],z [mm]", modified=True)
    standard = [(0, 0.4, 0.025, math.pi / 2), (math.pi / 2, 0, 0.455, 0), (0, 0, 0.35, 0)]
    rows = ["# convention: standard", "link;theta [deg];d [m];a [m];alpha [rad]"]
    rows += [f"A{at};{f'A{at} + 90' if theta else f'A{at}'};{d:g};{a:g};{alpha:.12g}".replace(".", ",") for at, (theta, d, a, alpha) in enumerate(standard, 1)]
    write("three-axis.dh.csv", "\n".join(rows) + "\n", "\r\n")
    poses("three-axis.poses.csv", standard, ",".join(f"A{at} [deg]" for at in range(1, 4)) + ",x [mm],y [mm],z [mm]")
    of_puma, of_three = [f"q{at} [deg]" for at in range(1, 4)], [f"A{at} [deg]" for at in range(1, 4)]
    millimetres = lambda at: [f"{1000 * v:.4f}" for v in at]
    whole_poses("quaternion-1.csv", modified, of_puma, "x [mm],y [mm],z [mm],qw,qx,qy,qz",
                lambda at, turn: millimetres(at) + [f"{v:.9f}" for v in as_quaternion(turn)], True)
    whole_poses("quaternion-2.csv", standard, of_three, "pos_x [m],pos_y [m],pos_z [m],quat_x,quat_y,quat_z,quat_w",
                lambda at, turn: [f"{v:.7f}" for v in at] + [f"{-v:.9f}" for v in as_quaternion(turn)[1:] + as_quaternion(turn)[:1]])
    whole_poses("euler-kuka.csv", standard, of_three, "X [mm],Y [mm],Z [mm],A [deg],B [deg],C [deg]",
                lambda at, turn: millimetres(at) + [f"{v / DEG:.7f}" for v in as_zyx(turn)])
    whole_poses("euler-ros.csv", modified, of_puma, "x [m],y [m],z [m],roll [rad],pitch [rad],yaw [rad]",
                lambda at, turn: [f"{v:.7f}" for v in at] + [f"{v:.9f}" for v in reversed(as_zyx(turn))], True)
    entries = lambda at, turn: [f"{(turn[c][r] if c < 3 else at[r]):.9f}" for r in range(3) for c in range(4)]
    whole_poses("matrix-12.csv", modified, of_puma, ",".join(f"m{r}{c}" + (" [m]" if c == 3 else "") for r in range(3) for c in range(4)), entries, True)
    whole_poses("matrix-16.csv", standard, of_three, ",".join(f"T{r}{c}" + (" [m]" if c == 4 and r < 4 else "") for r in range(1, 5) for c in range(1, 5)),
                lambda at, turn: entries(at, turn) + ["0", "0", "0", "1"])


UR = {
    "UR10e": [(0, 0.1807, 0, math.pi / 2), (0, 0, -0.6127, 0), (0, 0, -0.57155, 0), (0, 0.17415, 0, math.pi / 2), (0, 0.11985, 0, -math.pi / 2), (0, 0.11655, 0, 0)],
    "UR5e": [(0, 0.1625, 0, math.pi / 2), (0, 0, -0.425, 0), (0, 0, -0.3922, 0), (0, 0.1333, 0, math.pi / 2), (0, 0.0997, 0, -math.pi / 2), (0, 0.0996, 0, 0)],
}


def calibration_conf(name, arm):
    """Deltas as the controllers have them: d of the second and third joint goes far away and comes back."""
    far, small = chance.uniform(80, 600), chance.uniform
    theta = [small(-1e-6, 1e-6), 0.0012, -0.0009, -0.0003, 1e-6, 0]
    d = [1e-4, far, -far + 5e-4, 3e-4, -2e-4, -9e-4]
    a = [1e-4, 2e-4, -1e-4, 3e-5, -5e-5, 0]
    alpha = [2e-4, 8e-7, 1.1e-6, -3e-4, 1e-4, 0]
    lists = {"delta_theta": theta, "delta_a": a, "delta_d": d, "delta_alpha": alpha}
    lines = ["[mounting]"] + [f"{key} = [ {', '.join(repr(v) for v in values)}]" for key, values in lists.items()]
    lines += ["calibration_status = 2   # 0 == notInitialized / 1 == notLinearised / 2 == Linearised",
              "joint_checksum = [0xb435bb63, 0xb441d7b1, 0xb5198b08, 0xb40d9f92, 0xb41b2338, 0xb42edc4e]",
              "joint_raw_offset = [0x7fff0000, 0x0, 0x0, 0x0, 0x0, 0x0]"]
    write(f"{name}.conf", "\n".join(lines) + "\n")
    links = [tuple(n + e for n, e in zip(nominal, deltas)) for nominal, deltas in zip(UR[arm], zip(theta, d, a, alpha))]
    # What has moved since the calibration: an exchanged joint and a bent link, beside the far frames.
    lines = [",".join(f"q{at} [rad]" for at in range(1, 7)) + ",x [mm],y [mm],z [mm]"]
    for _ in range(90):
        q = [chance.uniform(-2.4, 2.4) for _ in links]
        factors = arm_at(links, q)
        at = moved((0.05, 0.03, 0.07), (0.8, -0.4, 0.3), ("x", 0.02), ("y", 0.03), ("z", -1.1), *factors[:16], ("x", 100 * ARCSEC), *factors[16:])
        lines.append(",".join([f"{angle:.9f}" for angle in q] + [f"{1000 * v + chance.gauss(0, 0.02):.4f}" for v in at]))
    write(f"{name}.poses.csv", "\n".join(lines) + "\n")


tpoint_of_radio("radio-1.dat")
tpoint_of_radio("radio-2.pnt", "\r\n")
tpoint_of_mount("mount-1.dat")
tpoint_of_mount("mount-2.txt")
mountwizard("north.model", 48.1)
mountwizard("south.model", -33.2)
autoslew("asa-1.pox", 11.25, "\r\n")
autoslew("asa-2.pox", -70.5, "\n")
plate_solves_with_sidereal_time("solves-1.csv")
plate_solves_with_site("solves-2.csv", 11.608)
gsi8("stations.gsi")
gsi16("control.gsi")
points_csv("points-1.csv", ",")
points_csv("points-2.csv", ";")
dh_tables()
calibration_conf("ur10e", "UR10e")
calibration_conf("ur5e", "UR5e")
