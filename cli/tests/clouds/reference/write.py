"""Writes the point clouds that the tests read, and where their points belong, with NumPy, laspy, and LASzip itself.

    pip install numpy laspy laszip lazrs
    python write.py            # writes the files beside this one
    python write.py check IN OUT   # compares a corrected file with its input, as laspy and LASzip read them

Points are drawn in two ways: without errors, as a scanner's software computes them, and with the errors of errors.toml, as a
product of matrices that knows nothing of the project.
"""

import io
import pathlib
import sys

import laspy
import numpy as np
from laspy.vlrs.vlr import VLR

HERE = pathlib.Path(__file__).parent
ARCSEC = np.pi / 648000
TILT, BESIDE, ASKEW, INDEX = 40 * ARCSEC, 3e-3, -120 * ARCSEC, 75 * ARCSEC
POINTS = 80


def turn(axis, angle):
    """Homogeneous matrices of turns about an axis, one an angle."""
    c, s = np.cos(angle), np.sin(angle)
    a, b = [(1, 2), (2, 0), (0, 1)][axis]
    m = np.zeros((len(angle), 4, 4))
    m[:] = np.eye(4)
    m[:, a, a] = m[:, b, b] = c
    m[:, a, b], m[:, b, a] = -s, s
    return m


def shift(x, y, z, n):
    m = np.zeros((n, 4, 4))
    m[:] = np.eye(4)
    m[:, 0, 3], m[:, 1, 3], m[:, 2, 3] = x, y, z
    return m


def where(azimuth, elevation, distance, size):
    """Points of the scanner; size 0 is a scanner without errors."""
    n = len(azimuth)
    one = np.ones(n)
    head = turn(2, azimuth) @ turn(0, size * TILT * one)
    mirror = shift(0, size * BESIDE, 0, n) @ turn(2, size * ASKEW * one) @ turn(0, elevation) @ turn(0, size * INDEX * one)
    beam = np.stack([0 * one, distance, 0 * one, one], axis=1)[:, :, None]
    return (head @ mirror @ beam)[:, :3, 0]


def readings(n=POINTS, seed=1):
    rng = np.random.default_rng(seed)
    time = 5000 + np.sort(rng.uniform(0, 4, n))
    azimuth = (6.1 + 0.2 * (time - 5000)) % (2 * np.pi)  # through zero
    elevation = np.deg2rad(-40 + 25 * (time - 5000))
    return time, azimuth, elevation, rng.uniform(2, 60, n)


def cloud(version, point_format, angles, step=1e-3, offset=(10.0, -20.0, 0.5), n=POINTS, evlr=False, waveforms=False):
    """A cloud whose coordinates have no errors, and where its points belong."""
    time, azimuth, elevation, distance = readings(n)
    header = laspy.LasHeader(version=version, point_format=point_format)
    header.offsets, header.scales = np.array(offset), np.array([step, step, 2 * step])
    header.system_identifier, header.generating_software = "scanner 7", "a maker's software"
    header.file_source_id = 4711
    extra = laspy.ExtraBytesParams
    header.add_extra_dim(extra("quality", np.uint8, description="0 to 255"))
    unit = {"rad64": 1.0, "deg32": np.rad2deg(1), "scaled": np.rad2deg(1)}[angles]
    if angles == "rad64":
        header.add_extra_dim(extra("azimuth [rad]", np.float64))
        header.add_extra_dim(extra("elevation", np.float64, description="mirror [rad]"))
        header.add_extra_dim(extra("range", np.float64, description="m"))
    elif angles == "deg32":
        header.add_extra_dim(extra("azimuth_deg", np.float32))
        header.add_extra_dim(extra("elevation", np.float32, description="deg"))
        header.add_extra_dim(extra("range", np.float32))
    else:
        scale = {"scales": np.array([1e-5]), "offsets": np.array([0.0])}
        header.add_extra_dim(extra("azimuth", np.int32, description="of the head (deg)", **scale))
        header.add_extra_dim(extra("elevation [deg]", np.int32, **scale))
        header.add_extra_dim(extra("range [mm]", np.uint32))
    header.add_extra_dim(extra("pair", "2u2"))
    header.vlrs.append(VLR("somebody", 17, "a note", b"keep me \x00\xff as I am"))
    las = laspy.LasData(header)
    rng = np.random.default_rng(2)
    for name in las.point_format.dimension_names:
        size = las.point_format.dimension_by_name(name)
        if name not in ("X", "Y", "Z") and not name.startswith(("azimuth", "elevation", "range", "quality", "pair")):
            top = size.max if size.max and size.max < 2**31 else 1000
            las[name] = rng.integers(1 if "return" in name else 0, min(int(top), 60000) + 1, n)
    las.quality = rng.integers(0, 256, n)
    las.pair = rng.integers(0, 60000, (n, 2))
    if "gps_time" in las.point_format.dimension_names:
        las.gps_time = time
    names = [d for d in las.point_format.extra_dimension_names]
    name = {key: next(d for d in names if d.startswith(key)) for key in ("azimuth", "elevation", "range")}
    if angles == "scaled":
        las[name["range"]] = np.round(1e3 * distance).astype(np.uint32)
        las[name["azimuth"]], las[name["elevation"]] = azimuth * unit, elevation * unit
    else:
        for key, values in (("azimuth", azimuth * unit), ("elevation", elevation * unit), ("range", distance)):
            las[name[key]] = values
    # The maker computes with the readings that he has, and writes them rounded.
    maker = where(azimuth, elevation, distance, 0)
    las.x, las.y, las.z = maker.T
    if evlr:
        las.evlrs = laspy.vlrs.vlrlist.VLRList([VLR("somebody", 18, "more", b"behind the points " * 9)])
    return las, where(azimuth, elevation, distance, 1)


def write(las, name, backend=None):
    out = io.BytesIO()
    las.write(out, do_compress=name.endswith(".laz"), laz_backend=backend)
    (HERE / name).write_bytes(out.getvalue())


def write_steps(las, points, name):
    """Where points belong, in steps of the file, not rounded."""
    np.savetxt(HERE / f"{name}.steps", (points - las.header.offsets) / las.header.scales, fmt="%.4f")


CLOUDS = {
    "v12f1": dict(version="1.2", point_format=1, angles="rad64"),
    "v12f3": dict(version="1.2", point_format=3, angles="scaled"),
    "v13f4": dict(version="1.3", point_format=4, angles="rad64"),
    "v14f0": dict(version="1.4", point_format=0, angles="deg32", evlr=True),
    "v14f6": dict(version="1.4", point_format=6, angles="scaled", evlr=True),
    "v14f8": dict(version="1.4", point_format=8, angles="deg32"),
    "v14f10": dict(version="1.4", point_format=10, angles="rad64", evlr=True),
    "none": dict(version="1.4", point_format=7, angles="rad64", evlr=True, n=0),
}


def timed():
    """A cloud whose angles stand in a table by time, which passes through zero azimuth; they move evenly."""
    time, azimuth, elevation, distance = readings(seed=3)
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.offsets, header.scales = np.zeros(3), np.full(3, 1e-3)
    header.add_extra_dim(laspy.ExtraBytesParams("range", np.float64))
    las = laspy.LasData(header)
    las.x, las.y, las.z = where(azimuth, elevation, distance, 0).T
    las.gps_time, las["range"] = time, distance
    write(las, "timed.las")
    write_steps(las, where(azimuth, elevation, distance, 1), "timed")
    rows = ["gps_time [s],azimuth [deg],elevation [deg],note"]
    for tick in range(41):
        turned = np.rad2deg(6.1 + 0.2 * 0.1 * tick) % 360
        rows.append(f"{5000 + 0.1 * tick:.1f},{turned:.10f},{-40 + 2.5 * tick:.10f},row {tick}")
    (HERE / "timed.csv").write_text("\n".join(rows) + "\n")


def main():
    for name, how in CLOUDS.items():
        las, points = cloud(**how)
        write(las, f"{name}.las")
        write(las, f"{name}.laz", laspy.LazBackend.Laszip)
        write_steps(las, points, name)
    timed()


def check(given, corrected):
    given, corrected = laspy.read(given, laz_backend=laspy.LazBackend.Laszip), laspy.read(corrected, laz_backend=laspy.LazBackend.Laszip)
    for name in given.point_format.dimension_names:
        if name not in ("X", "Y", "Z"):
            assert np.array_equal(given[name], corrected[name]), name
    print(len(given.points), "points,", np.abs(given.xyz - corrected.xyz).max(axis=0, initial=0), "moved;", corrected.header.mins, corrected.header.maxs)
    print([v.user_id for v in corrected.vlrs], [v.record_data_bytes()[:20] for v in (corrected.evlrs or [])])


if __name__ == "__main__":
    check(*sys.argv[2:4]) if sys.argv[1:2] == ["check"] else main()
