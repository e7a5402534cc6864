"""Measures the vector sine and cosine against 200-bit arithmetic (MPFR, through gmpy2).

    python3 measure.py [COUNT] [PATH…]

For each path and range: the largest distance from the true value in units in the last place of the true value rounded
to f64, and where it is. COUNT is 10000000 unless given; every edge of a quadrant up to 1e6 rad needs 1909857 points.
Needs gmpy2; builds and runs the program `sine_points` of this folder's package unless SINE_POINTS names one.
"""

import math
import os
import struct
import subprocess
import sys

import gmpy2

PACKAGE = ["cargo", "run", "--release", "--quiet", "-p", "trueaxis-benches", "--bin", "sine_points", "--"]


def measure(path, span, count, seed):
    program = [os.environ["SINE_POINTS"]] if "SINE_POINTS" in os.environ else PACKAGE
    command = program + [path, str(count), str(seed), span]
    worst = [(0.0, 0.0), (0.0, 0.0)]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        while data := process.stdout.read(24 * 4096):
            for x, *found in struct.iter_unpack("<3d", data):
                if not math.isfinite(x):
                    assert all(math.isnan(value) for value in found), x
                    continue
                for k, (value, true) in enumerate(zip(found, gmpy2.sin_cos(gmpy2.mpfr(x)))):
                    off = abs(float(value - true)) / math.ulp(float(true))
                    if not off <= worst[k][0]:
                        worst[k] = (off, x)
    if process.returncode:
        sys.exit(f"{' '.join(command)} failed")
    return worst


def main():
    gmpy2.get_context().precision = 200
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000
    for path in sys.argv[2:] or ["portable", "v3", "v4"]:
        for span in ("narrow", "small", "edges", "wide"):
            sine, cosine = measure(path, span, count if span != "edges" else min(count, 1_909_857), 1)
            print(
                f"{path:9} {span:7} sine {sine[0]:.4f} ulp at {sine[1]!r}, cosine {cosine[0]:.4f} ulp at {cosine[1]!r}",
                flush=True,
            )


main()
