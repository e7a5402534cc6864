#!/usr/bin/env python3
"""Where a mount with one fault really points, by what the fault is, for the test of the form `tpoint`.

Each fault is built as the published definition of a TPOINT term has it (P. T. Wallace: where the pole of the mount is, to which side the
line of sight is displaced, what droops), with vectors and no formula of a pointing model. Prints: mount, term, value in arc seconds, first
angle, second angle (degrees), side, and the direction.

    python3 cli/tests/export/reference.py > cli/tests/export/reference.txt
"""
from math import cos, pi, radians, sin

ARCSEC = pi / 648000
LATITUDE = 39 * pi / 180
POSES = [(-70, 10, 1), (-20, 55, 1), (15, -20, 1), (60, 35, -1), (110, 70, -1), (-140, 25, -1)]


def add(*parts):
    """The sum of vectors, each with its factor."""
    return tuple(sum(factor * vector[axis] for factor, vector in parts) for axis in range(3))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def unit(a):
    length = dot(a, a) ** 0.5
    return tuple(p / length for p in a)


def turned_to(vector, start, end):
    """A vector turned by the smallest turn that brings one unit vector to another."""
    axis = cross(start, end)
    sine, cosine = dot(axis, axis) ** 0.5, dot(start, end)
    if sine == 0:
        return vector
    axis = unit(axis)
    return add((cosine, vector), (sine, cross(axis, vector)), ((1 - cosine) * dot(axis, vector), axis))


def mount(first, second, side, pole=(0, 0, 1), sight=0.0, square=0.0, towards=1):
    """A mount that turns about the third axis by `first`, from the second axis through the first one, then by `second`.

    `sight`: the line of sight is displaced by so much from the perpendicular to the second axis, and `square` the second axis by so much from
    the perpendicular to the first: in the normal state both towards growing `first` (or against it, `towards` = -1) for positive `second`.
    Through the pole (`side` = -1) the first reading differs by half a turn, and the second is beyond a quarter.
    """
    if side < 0:
        first, second = first + pi, pi - second
    level = (sin(first), cos(first), 0)
    aside = (towards * cos(first), -towards * sin(first), 0)
    up = add((cos(square), (0, 0, 1)), (sin(square), aside))
    seen = add((cos(second), level), (sin(second), up))
    seen = unit(add((1, seen), (sight, aside)))
    return turned_to(seen, (0, 0, 1), pole)


def drooped(vector, zenith, value):
    """A direction lowered by `value` times the sine of its distance from the zenith."""
    away = add((dot(vector, zenith), vector), (-1, zenith))
    return unit(add((1, vector), (value, away)))


def equatorial(term, value, h, d, side):
    """x west, y where the meridian meets the equator, z the pole of the north."""
    s, c = sin(value), cos(value)
    zenith = (0, cos(LATITUDE), sin(LATITUDE))
    if term == "IH":
        return mount(h + value, d, side)
    if term == "ID":
        return mount(h, d + side * value, side)
    if term == "CH":
        return mount(h, d, side, sight=value)
    if term == "NP":
        return mount(h, d, side, square=value)
    if term == "ME":  # Below the true pole: away from the zenith.
        return mount(h, d, side, pole=(0, -s, c))
    if term == "MA":  # To the right of due north: east.
        return mount(h, d, side, pole=(-s, 0, c))
    if term == "TF":
        return drooped(mount(h, d, side), zenith, value)
    raise ValueError(term)


def alt_azimuth(term, value, a, e, side):
    """x east, y north, z up; to the left is against growing azimuth."""
    s, c = sin(value), cos(value)
    if term == "IA":
        return mount(a - value, e, side)
    if term == "IE":
        return mount(a, e + side * value, side)
    if term == "CA":
        return mount(a, e, side, sight=value, towards=-1)
    if term == "NPAE":
        return mount(a, e, side, square=value, towards=-1)
    if term == "AN":
        return mount(a, e, side, pole=(0, s, c))
    if term == "AW":
        return mount(a, e, side, pole=(-s, 0, c))
    if term == "TF":
        return drooped(mount(a, e, side), (0, 0, 1), value)
    raise ValueError(term)


def main():
    values = {"IH": 50, "ID": -40, "CH": 60, "NP": -35, "ME": 55, "MA": 45, "TF": 30}
    of_altaz = {"IA": 50, "IE": -40, "CA": 60, "NPAE": -35, "AN": 55, "AW": 45, "TF": 30}
    for name, terms, points in (("equatorial", values, equatorial), ("alt-azimuth", of_altaz, alt_azimuth)):
        for term, value in terms.items():
            for first, second, side in POSES:
                x, y, z = points(term, value * ARCSEC, radians(first), radians(second), side)
                print(f"{name} {term} {value} {first} {second} {side} {x:.15f} {y:.15f} {z:.15f}")


main()
