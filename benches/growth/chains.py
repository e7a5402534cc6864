"""How time and memory grow with joints and errors: chains are made, and commands run on them.

    python3 benches/growth/chains.py target/release/trueaxis

A chain of J joints turns about z, x and y in turn, with a constant shift and six errors a joint. A chain of N errors has three
joints, and N/3 errors at each.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path


# Sizes by the first letter of an error: turns and shifts.
SIZES = [*((letter, "2 arcsec") for letter in "abcr"), *((letter, "0.01 mm") for letter in "uvwt")]


def joints(count):
    lines = ["chain Arm {"]
    for j in range(count):
        lower = "ground" if j == 0 else f"b{j - 1}"
        axis = "zxy"[j % 3]
        lines.append(
            f" body b{j} on {lower} {{ motion: R{axis}(q{j}); "
            f"motion_error: Rx(a{j}), Ry(b{j}), Rz(c{j}), Tx(u{j}), Ty(v{j}), Tz(w{j}); position: Tx(0.{j + 3}), Tz(0.1); }}"
        )
    lines.append(f" observe tip: point(0.1, 0, 0.3) of b{count - 1};")
    lines.append(f" observe way: direction(0, 0, 1) of b{count - 1};")
    return "\n".join([*lines, "}\n"])


def errors(count):
    lines = ["chain Wide {"]
    for j in range(3):
        lower = "ground" if j == 0 else f"b{j - 1}"
        factors = ", ".join(
            f"{'RT'[k % 2]}{'xyz'[k % 3]}({'rt'[k % 2]}{j}_{k})" for k in range(count // 3 + (j < count % 3))
        )
        lines.append(f" body b{j} on {lower} {{ motion: R{'zxy'[j]}(q{j}); motion_error: {factors}; position: Tx(0.{j + 3}); }}")
    lines.append(" observe tip: point(0.1, 0, 0.3) of b2;")
    return "\n".join([*lines, "}\n"])


def run(label, command):
    start = time.monotonic()
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
        ended = str(done.returncode)
    except subprocess.TimeoutExpired:
        ended = "stopped"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"{label}: exit {ended}, {time.monotonic() - start:.1f} s by the clock, {used:.1f} s of a processor", flush=True)


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        sizes = folder / "sizes.toml"
        sizes.write_text("".join(f"\"{letter}*\" = \"{size}\"\n" for letter, size in SIZES))
        for count in (3, 6, 10, 14):
            chain = folder / f"joints-{count}.chain"
            chain.write_text(joints(count))
            run(f"budget, {count} joints", [program, "budget", chain, "--sizes", sizes])
        for count in (100, 1_000, 10_000):
            chain = folder / f"errors-{count}.chain"
            chain.write_text(errors(count))
            run(f"bound, {count} errors", [program, "bound", chain, "--sizes", sizes])
            run(f"derive, {count} errors", [program, "derive", chain])
            run(f"generate, {count} errors", [program, "generate", chain, "--language", "rust", "--out", folder / "out.rs"])
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"memory at most: {peak:.0f} MB")


main()
