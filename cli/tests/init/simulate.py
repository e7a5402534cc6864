"""Data of each kind of instrument, with planted errors: simulate.py KIND writes KIND.csv and prints `name value`, in rad and m.

Every instrument is written out by hand here, as a product of rotations and shifts; shares no code with the project.
"""
import math
import random
import sys

ARCSEC = math.pi / 648000
DEG = math.pi / 180
chance = random.Random(11)


def turned(vector, axis, angle):
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return {"x": (x, c * y - s * z, s * y + c * z), "y": (c * x + s * z, y, c * z - s * x), "z": (c * x - s * y, s * x + c * y, z)}[axis]


def moved(vector, *factors):
    """Factors from the ground up: (axis, angle), or three lengths of a shift."""
    for factor in reversed(factors):
        if len(factor) == 3:
            vector = tuple(v + f for v, f in zip(vector, factor))
        else:
            vector = turned(vector, *factor)
    return vector


def noisy(vector, sigma):
    """A unit vector with normal noise along any two directions across it."""
    noise = [chance.gauss(0, sigma) for _ in range(3)]
    along = sum(n * v for n, v in zip(noise, vector))
    off = [v + n - along * v for v, n in zip(vector, noise)]
    length = math.sqrt(sum(v * v for v in off))
    return [v / length for v in off]


def planted(*names, size=60 * ARCSEC):
    errors = {name: chance.uniform(-size, size) for name in names}
    return errors


def angles(vector):
    return math.atan2(vector[0], vector[1]), math.asin(vector[2])


def alt_azimuth():
    p = planted("tilt_x", "tilt_y", "azimuth_index", "nonperpendicularity", "elevation_index", "droop", "collimation")
    rows = ["star,trueAz [degrees],trueEl [degrees],encoderAz [degrees],encoderEl [degrees],snr"]
    for row in range(160):
        az, el = chance.uniform(0, 2 * math.pi), math.asin(chance.uniform(0.2, 0.95))
        seen = moved((0, 1, 0), ("x", p["tilt_x"]), ("y", p["tilt_y"]), ("z", -az), ("z", -p["azimuth_index"]), ("y", p["nonperpendicularity"]),
                     ("x", el), ("x", p["elevation_index"]), ("x", p["droop"] * math.cos(el)), ("z", p["collimation"]))
        true = angles(noisy(seen, 2 * ARCSEC))
        rows.append(f"HR {row + 7},{true[0] / DEG:.8f},{true[1] / DEG:.8f},{az / DEG:.8f},{el / DEG:.8f},{chance.uniform(5, 90):.1f}")
    return p, rows


def equatorial():
    p = planted("polar_tilt_x", "polar_tilt_y", "ha_index", "nonperpendicularity", "dec_index", "collimation")
    rows = ["true_ha (hours);true_dec (degs);encoder_ha (hours);encoder_dec (degs);pier_side"]
    for row in range(160):
        ha, dec, pier = chance.uniform(-1.4, 1.4), math.asin(chance.uniform(-0.4, 0.9)), (-1) ** row
        seen = moved((0, 1, 0), ("x", p["polar_tilt_x"]), ("y", p["polar_tilt_y"]), ("z", -ha), ("z", -p["ha_index"]), ("y", pier * p["nonperpendicularity"]),
                     ("x", dec), ("x", pier * p["dec_index"]), ("z", pier * p["collimation"]))
        true = angles(noisy(seen, 3 * ARCSEC))
        cells = f"{true[0] / DEG / 15:.9f};{true[1] / DEG:.8f};{ha / DEG / 15:.9f};{dec / DEG:.8f};{pier}"
        rows.append(cells.replace(".", ","))
    return p, rows


def gimbal():
    # x ahead, y to the left, z up: yaw to the left, pitch upwards.
    p = planted("base_tilt_x", "base_tilt_y", "pan_index", "nonperpendicularity", "tilt_index", "collimation", size=300 * ARCSEC)
    rows = ["t\tyaw_deg\tpitch_deg\tlos_x\tlos_y\tlos_z"]
    for row in range(150):
        yaw, pitch = chance.uniform(-2.5, 2.5), chance.uniform(-0.5, 1.0)
        seen = moved((1, 0, 0), ("x", p["base_tilt_x"]), ("y", p["base_tilt_y"]), ("z", yaw), ("z", p["pan_index"]), ("x", p["nonperpendicularity"]),
                     ("y", -pitch), ("y", -p["tilt_index"]), ("z", p["collimation"]))
        x, y, z = noisy(seen, 10 * ARCSEC)
        rows.append(f"{row / 10}\t{yaw / DEG:.7f}\t{pitch / DEG:.7f}\t{x:.10f}\t{y:.10f}\t{z:.10f}")
    return p, rows


def scanner():
    p = planted("tilt_x", "tilt_y", "alpha_index", "middle_axis", "beta_index", "inner_axis", "sight_x", "sight_y")
    rows = ["alpha,beta,gamma,x,y,z"]
    for _ in range(200):
        a, b, g = (chance.uniform(-3.1, 3.1) for _ in range(3))
        seen = moved((0, 0, 1), ("x", p["tilt_x"]), ("y", p["tilt_y"]), ("z", a), ("z", p["alpha_index"]), ("y", p["middle_axis"]), ("x", b),
                     ("x", p["beta_index"]), ("y", p["inner_axis"]), ("z", g), ("x", p["sight_x"]), ("y", p["sight_y"]))
        x, y, z = noisy(seen, 2 * ARCSEC)
        rows.append(f"{a:.9f},{b:.9f},{g:.9f},{x:.11f},{y:.11f},{z:.11f}")
    return p, rows


def total_station():
    p = planted("trunnion_axis", "vertical_index", "collimation")
    p |= planted("distance_zero", size=0.01) | planted("distance_scale", size=1e-4)
    rows = ["point;Hz [gon];V [gon];slope distance [m];target_x [mm];target_y [mm];target_z [mm]"]
    for row in range(120):
        hz, zd, d = chance.uniform(0, 2 * math.pi), math.acos(chance.uniform(-0.6, 0.6)), chance.uniform(5, 60)
        if row % 2:
            zd = 2 * math.pi - zd
        target = moved((0, d, 0), (12.5, -3.25, 1.5), ("x", 0.01), ("y", -0.02), ("z", 0.7), ("z", -hz), ("y", p["trunnion_axis"]), ("x", math.pi / 2 - zd),
                       ("x", p["vertical_index"]), ("z", p["collimation"]), (0, p["distance_zero"] + p["distance_scale"] * d, 0))
        x, y, z = (1000 * t + chance.gauss(0, 0.2) for t in target)
        rows.append(f"P{row};{hz / DEG / 0.9:.7f};{zd / DEG / 0.9:.7f};{d:.6f};{x:.4f};{y:.4f};{z:.4f}")
    return p, rows


def turntable():
    p = planted("tilt_x", "tilt_y", "index", "rise")
    rows = ["table angle [deg],normal_x,normal_y,normal_z"]
    for row in range(0, 720, 7):
        a = row * DEG
        seen = moved((1, 0, 0), ("x", p["tilt_x"]), ("y", p["tilt_y"]), ("z", a), ("z", p["index"]), ("y", -p["rise"]))
        x, y, z = noisy(seen, ARCSEC)
        rows.append(f"{row},{x:.11f},{y:.11f},{z:.11f}")
    return p, rows


def arm():
    # A UR5e: d, a and the twist of each link.
    links = [(0.1625, 0, math.pi / 2), (0, -0.425, 0), (0, -0.3922, 0), (0.1333, 0, math.pi / 2), (0.0997, 0, -math.pi / 2), (0.0996, 0, 0)]
    p = planted(*(f"dq{n}" for n in range(1, 7)), *(f"dalpha{n}" for n in range(1, 7)), size=200 * ARCSEC)
    p |= planted(*(f"d{k}{n}" for k in "da" for n in range(1, 7)), size=5e-4)
    rows = ["pose,joint_1 [rad],joint_2 [rad],joint_3 [rad],joint_4 [rad],joint_5 [rad],joint_6 [rad],reflector_x_mm,reflector_y_mm,reflector_z_mm"]
    for row in range(260):
        q = [chance.uniform(-2.8, 2.8) for _ in links]
        factors = [(1.2, -0.4, 0.8), ("x", 0.02), ("y", 0.03), ("z", -1.1)]
        for n, ((d, a, twist), angle) in enumerate(zip(links, q), 1):
            factors += [("z", angle), ("z", p[f"dq{n}"]), (0, 0, d), (a, 0, 0), ("x", twist), (0, 0, p[f"dd{n}"]), (p[f"da{n}"], 0, 0), ("x", p[f"dalpha{n}"])]
        at = moved((0.05, 0.03, 0.07), *factors)
        cells = [f"{angle:.9f}" for angle in q] + [f"{1000 * v + chance.gauss(0, 0.02):.5f}" for v in at]
        rows.append(",".join([str(row)] + cells))
    return p, rows


def encoder():
    # It counts backwards, and starts anywhere.
    p = {"index": -0.0123 * DEG}
    rows = ["reference_deg,count,raw_deg"]
    for row in range(120):
        raw = 3.0 * row + chance.uniform(0, 1)
        azimuth = -raw + 40 - p["index"] / DEG + chance.gauss(0, 0.002)
        rows.append(f"{azimuth % 360:.6f},{int(raw * 45.5)},{raw:.6f}")
    return p, rows


kind = sys.argv[1]
errors, lines = globals()[kind.replace("-", "_")]()
open(f"{kind}.csv", "w").write("\n".join(lines) + "\n")
for name, value in errors.items():
    print(name, repr(value))
