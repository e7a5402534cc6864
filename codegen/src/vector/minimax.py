"""Derives the constants of `kernel.rs`, `single.rs` and their twins in C: π/2 in parts, 2/π in words, and the
polynomials.

    sin r = r + r z S(z),   cos r = 1 - z/2 + z² C(z),   z = r², |r| ≤ π/4 (and a little more).

S and C are minimax in the relative error of the sine and cosine (Remez exchange in 60-digit arithmetic). Coefficients
are rounded to f64 or f32 one after another, lowest first, and the rest is fitted again to the rounded ones, so that
rounding costs almost nothing. The largest relative error of the rounded polynomials is printed in units of 2^-53 or 2^-24.

Needs mpmath. Run: python3 minimax.py
"""

import struct

from mpmath import cos, floor, findroot, linspace, lu_solve, matrix, mp, mpf, nint, pi, sin, sqrt

mp.dps = 60

# A little beyond π/4: the quadrant is rounded from an inexact product.
EDGE = pi / 4 + mpf("1e-6")


def sine_target(z):
    """S exactly, by its series near zero, where the closed form cancels."""
    if z < mpf("1e-6"):
        return -mpf(1) / 6 + z / 120 - z**2 / 5040
    r = sqrt(z)
    return (sin(r) / r - 1) / z


def cosine_target(z):
    """C exactly, by its series near zero."""
    if z < mpf("1e-6"):
        return mpf(1) / 24 - z / 720 + z**2 / 40320
    return (cos(sqrt(z)) - 1 + z / 2) / z**2


def sine_weight(z):
    """d(relative error of sin r) / dS."""
    r = sqrt(z)
    return z * r / sin(r)


def cosine_weight(z):
    """d(relative error of cos r) / dC."""
    return z**2 / cos(sqrt(z))


def remez(target, weight, low, high, terms, first_power):
    """Coefficients c_k of Σ c_k z^(first_power + k), minimax for `weight · (sum - target)` on [low, high]."""
    nodes = [(low + high) / 2 - (high - low) / 2 * cos(pi * k / terms) for k in range(terms + 1)]
    grid = linspace(low, high, 400)
    coefficients = []
    for _ in range(12):
        system = matrix(terms + 1, terms + 1)
        right = matrix(terms + 1, 1)
        for row, z in enumerate(nodes):
            for k in range(terms):
                system[row, k] = z ** (first_power + k)
            system[row, terms] = (-1) ** row / weight(z)
            right[row] = target(z)
        solution = lu_solve(system, right)
        coefficients = [solution[k] for k in range(terms)]

        def error(z):
            value = sum(c * z ** (first_power + k) for k, c in enumerate(coefficients))
            return weight(z) * (value - target(z))

        # The new nodes are the extremes between the sign changes of the error.
        values = [error(z) for z in grid]
        extremes, best = [], 0
        for k in range(1, len(grid)):
            if values[k] * values[k - 1] < 0:
                extremes.append(grid[best])
                best = k
            elif abs(values[k]) > abs(values[best]):
                best = k
        extremes.append(grid[best])
        # Coefficients already rounded leave a small extra extreme at an end.
        while len(extremes) > terms + 1:
            extremes.pop(0 if abs(error(extremes[0])) < abs(error(extremes[-1])) else -1)
        if len(extremes) < terms + 1:
            break
        nodes = extremes
    return coefficients


def as_double(value):
    """The nearest f64."""
    return mpf(float(value))


def as_single(value):
    """The nearest f32."""
    return mpf(struct.unpack("<f", struct.pack("<f", float(value)))[0])


def rounded(target, weight, terms, as_number):
    """The coefficients, each rounded before the later ones are fitted."""
    low, high = mpf("1e-12"), EDGE**2
    done = []
    for k in range(terms):
        rest = lambda z: target(z) - sum(c * z**j for j, c in enumerate(done))
        fitted = remez(rest, weight, low, high, terms - k, k)
        done.append(as_number(fitted[0]))
    worst = max(
        abs(weight(z) * (sum(c * z**j for j, c in enumerate(done)) - target(z)))
        for z in linspace(low, high, 2000)
    )
    return done, worst


def leading_bits(value, bits):
    """`value` cut off (not rounded) after so many significant bits."""
    _, exponent = mp.frexp(value)
    scale = mpf(2) ** (bits - exponent)
    return floor(value * scale) / scale


def show(name, value):
    bits = struct.unpack("<Q", struct.pack("<d", float(value)))[0]
    print(f"{name:12} {float(value)!r:26} 0x{bits:016x} {float(value).hex()}")


def main():
    half = pi / 2
    show("2/pi", 2 / pi)
    # 33 bits leave room for a quadrant number of 20 bits, so that the product is exact. Fused arithmetic never rounds
    # the first product, and can take all bits of it.
    for path, lengths in (("fused", (53, 33, 53)), ("portable", (33, 33, 33, 53))):
        rest = half
        for k, bits in enumerate(lengths):
            part = leading_bits(rest, bits)
            show(f"{path} {k + 1}", part)
            rest -= part
    for name, target, weight in (("S", sine_target, sine_weight), ("C", cosine_target, cosine_weight)):
        for precision, terms, as_number, digits in (("f64", 6, as_double, 53), ("f32", 3, as_single, 24)):
            coefficients, worst = rounded(target, weight, terms, as_number)
            for k, c in enumerate(coefficients):
                show(f"{name}{k} {precision}", c)
            print(f"largest relative error {float(worst * 2**digits):.4f} * 2^-{digits}")
    # 2/π as a binary fraction, 64 bits a word, enough for every exponent of an f64.
    mp.prec = 1400
    fraction = 2 / pi
    words = []
    for _ in range(19):
        fraction *= 2**64
        words.append(int(floor(fraction)))
        fraction -= words[-1]
    print("2/pi words:")
    for word in words:
        print(f"0x{word:016x}")


main()
