"""Time and memory of `apply` on point clouds, as points grow.

    cargo build --release --workspace --bin trueaxis --features trueaxis-cli/point-clouds
    python3 benches/growth/clouds.py target/release/trueaxis 1000000 10000000

Writes rows of the table in docs/src/calibration/growth.md, as measure.py does. Points are those of a scanner that turns its head
slowly and its mirror fast: format 1, with two angles and a range as doubles in extra dimensions, 52 bytes a point. NumPy is needed.
"""

import struct
import sys
import tempfile
from pathlib import Path

import numpy as np

from measure import measured

CHAIN = """chain Scanner {
    body head on ground { motion: Rz(azimuth); motion_error: Rx(tilt); }
    body mirror on head { position_error: Ty(beside), Rz(askew); motion: Rx(elevation); motion_error: Rx(index); }
    input range: length;
    observe target: point(0, range, 0) of mirror;
}
"""
ERRORS = 'tilt = "40 arcsec"\nbeside = "3 mm"\naskew = "-2 arcmin"\nindex = "75 arcsec"\n'
POINT = np.dtype(
    [("xyz", "<i4", 3), ("intensity", "<u2"), ("rest", "u1", 6), ("time", "<f8"), ("angles", "<f8", 2), ("range", "<f8")]
)
PIECE = 1 << 20


def dimension(name):
    """The description of an extra dimension of doubles."""
    return struct.pack("<2xBB32s", 10, 0, name.encode()).ljust(192, b"\0")


def write(path, points):
    described = b"".join(dimension(name) for name in ("azimuth [rad]", "elevation [rad]", "range [m]"))
    record = struct.pack("<2x16sHH32s", b"LASF_Spec", 4, len(described), b"") + described
    head = struct.pack("<4s20xBB64x4xHIIBHI20x", b"LASF", 1, 2, 227, 227 + len(record), 1, 1, POINT.itemsize, points)
    head += struct.pack("<12d", *[1e-3] * 3, *[0.0] * 9)
    rng = np.random.default_rng(1)
    with open(path, "wb") as file:
        file.write(head + record)
        for first in range(0, points, PIECE):
            time = 1e-6 * np.arange(first, min(first + PIECE, points))
            azimuth, elevation = 0.02 * time, (300 * time) % (2 * np.pi)
            distance = 20 + 5 * np.sin(azimuth) + rng.normal(0, 0.01, len(time))
            piece = np.zeros(len(time), POINT)
            level, up = distance * np.cos(elevation), distance * np.sin(elevation)
            piece["xyz"] = np.round(1e3 * np.stack([-level * np.sin(azimuth), level * np.cos(azimuth), up], axis=1))
            piece["intensity"], piece["time"], piece["range"] = rng.integers(0, 4096, len(time)), time, distance
            piece["angles"] = np.stack([azimuth, elevation], axis=1)
            piece.tofile(file)


def main():
    command, sizes = Path(sys.argv[1]).resolve(), [int(size) for size in sys.argv[2:]]
    print("| points | what | processor time | by the clock | memory at most |\n|---|---|---|---|---|")
    for points in sizes:
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            (folder / "scanner.chain").write_text(CHAIN)
            (folder / "errors.toml").write_text(ERRORS)
            (folder / "none.toml").write_text("tilt = 0.0\n")
            write(folder / "given.las", points)
            job = lambda errors, given, out: [command, "apply", "scanner.chain", "--errors", errors, "--data", given, "--out", out]
            measured("`apply`, LAS to LAS", points, job("errors.toml", "given.las", "out.las"), folder)
            measured("LAS to LAZ, nothing moved", points, job("none.toml", "given.las", "given.laz"), folder)
            measured("`apply`, LAZ to LAZ", points, job("errors.toml", "given.laz", "out.laz"), folder)
            print(f"{(folder / 'given.las').stat().st_size:,} and {(folder / 'given.laz').stat().st_size:,} bytes")


main()
