"""Sample files of tests of machine tools: write_machines.py writes them into samples/ beside it, and prints what was planted.

Each form is written from its public description, which the reader names (ISO 230-1, ISO 230-2, ISO 230-4, S. Weikert 2004). Machines are
matrices that are written out here. Nothing of the project is used, and nothing but Python's own library.
"""

import math
import pathlib
import random

OUT = pathlib.Path(__file__).with_name("samples")
chance = random.Random(2304)
DEG = math.pi / 180


def turn(axis, angle):
    s, c = math.sin(angle), math.cos(angle)
    return {
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }[axis]


def times(matrix, vector):
    return [sum(m * v for m, v in zip(row, vector)) for row in matrix]


def back(matrix, vector):
    return times([list(column) for column in zip(*matrix)], vector)


def plus(one, other):
    return [a + b for a, b in zip(one, other)]


def minus(one, other):
    return [a - b for a, b in zip(one, other)]


def tip(command, xy=0.0, xz=0.0, yz=0.0, scales=(0.0, 0.0, 0.0)):
    """Where the tool really is, mm: x carries y carries z."""
    x, y, z = (c * (1 + s) for c, s in zip(command, scales))
    point = times(turn("y", xz), [0, 0, z])
    point = times(turn("x", yz), point)
    point = times(turn("z", xy), plus(point, [0, y, 0]))
    return plus(point, [x, 0, 0])


def noisy(vector, sigma):
    return [v + chance.gauss(0, sigma) for v in vector]


def length(vector):
    return math.sqrt(sum(v * v for v in vector))


def write(name, lines):
    (OUT / name).write_text("\n".join(lines) + "\n")


def planted(name, **values):
    print(name, *(f"{key}={value:.4g}" for key, value in values.items()))


def bar_xy():
    """A ball bar in the plane xy, not about zero, commanded positions and radial deviations."""
    radius, centre = 150.0, (210.0, -85.0, -40.0)
    p = dict(xy=48e-6, scales=(11e-6, -17e-6, 0.0))
    ball = [0.0042, -0.0027, 0.0]
    lines = ["# circular test, ISO 230-4", "# radius = 150 mm", "X [mm],Y [mm],Z [mm],radial deviation [um]"]
    for step in range(200):
        angle = step * 1.8 * DEG
        command = plus(centre, [radius * math.cos(angle), radius * math.sin(angle), 0.0])
        bar = length(minus(tip(command, **p), plus(centre, ball)))
        lines.append(f"{command[0]:.4f},{command[1]:.4f},{command[2]:.4f},{1e3 * (bar - radius) + chance.gauss(0, 0.3):.2f}")
    write("bar-xy.csv", lines)
    # The scales act on the whole travel: at the centre they move the tool, which shows as another place of the ball.
    planted("bar-xy.csv", square_xy=48e-6, scale_x=11e-6, scale_y=-17e-6)


def bar_both_ways():
    """Once round and back: the slide of y is half of its lost motion behind on either way."""
    radius, lost = 150.0, 0.006
    before = -1.0
    lines = ["# radius = 150 mm", "programmed x [mm],programmed y [mm],deviation [um]"]
    for way in (1, -1):
        for step in range(150):
            angle = way * step * 2.4 * DEG
            command = [radius * math.cos(angle), radius * math.sin(angle), 0.0]
            behind = math.copysign(lost / 2, command[1] - before)
            before = command[1]
            bar = length(tip([command[0], command[1] + behind, 0.0], xy=44e-6, scales=(9e-6, 21e-6, 0.0)))
            lines.append(f"{command[0]:.4f},{command[1]:.4f},{1e3 * (bar - radius) + chance.gauss(0, 0.25):.2f}")
    write("bar-both-ways.csv", lines)
    planted("bar-both-ways.csv", square_xy=44e-6, scale_x=9e-6, scale_y=21e-6)


def bar_zx():
    """The same by an angle in the plane zx, over 220 degrees, with semicolons, decimal commas and a column of the radius."""
    radius = 100.0
    p = dict(xz=-35e-6, scales=(-9e-6, 0.0, 14e-6))
    ball = [-0.0031, 0.0, 0.0019]
    lines = ["# plane = ZX", "angle [deg];radius [mm];dr [um]"]
    for step in range(150):
        degrees = -20 + 220 * step / 149
        angle = degrees * DEG
        command = [radius * math.sin(angle), 0.0, radius * math.cos(angle)]
        bar = length(minus(tip(command, **p), ball))
        cells = [f"{degrees:.6f}", f"{radius:.3f}", f"{1e3 * (bar - radius) + chance.gauss(0, 0.2):.2f}"]
        lines.append(";".join(cells).replace(".", ","))
    write("bar-zx.csv", lines)
    planted("bar-zx.csv", square_xz=-35e-6, scale_x=-9e-6, scale_z=14e-6)


def bar_space():
    """Three planes in one file, with lengths."""
    radius = 150.0
    p = dict(xy=28e-6, xz=-41e-6, yz=19e-6, scales=(8e-6, -12e-6, 5e-6))
    ball = [0.002, 0.003, -0.001]
    lines = ["plane,commanded X [mm],commanded Y [mm],commanded Z [mm],bar length [mm]"]
    for plane, axes in (("XY", (0, 1)), ("YZ", (1, 2)), ("ZX", (2, 0))):
        for step in range(60):
            angle = (step * 3.6 if plane != "XY" else step * 6) * DEG
            command = [0.0, 0.0, 0.0]
            command[axes[0]], command[axes[1]] = radius * math.cos(angle), radius * math.sin(angle)
            bar = length(minus(tip(command, **p), ball)) + chance.gauss(0, 0.0003)
            lines.append(f"{plane}," + ",".join(f"{c:.4f}" for c in command) + f",{bar:.5f}")
    write("bar-space.csv", lines)
    planted("bar-space.csv", square_xy=28e-6, square_xz=-41e-6, square_yz=19e-6, scale_x=8e-6, scale_y=-12e-6, scale_z=5e-6)


def five_axes(name, turns, frame, header, lines, a_error, c_error, nest, p):
    """A sphere on the tool against a nest on a table of a (about x) and c, or of c alone; a table turns against its sign."""
    has_a = a_error is not None
    pivot = [0.0, -12.5, -95.0] if has_a else [0.0, 0.0, 0.0]
    offset = [31.25, 8.0, 0.0]
    place = [88.0, 0.0, 61.0]
    for a, c in turns:
        by_a, by_c = turn("x", -a * DEG), turn("z", -c * DEG)
        command = plus(pivot, times(by_a, plus(offset, times(by_c, place))))
        seen = tip(command, **p)
        if has_a:
            seen = minus(seen, plus(pivot, [0.0, a_error[0], a_error[1]]))
            seen = back(by_a, back(turn("z", a_error[3]), back(turn("y", a_error[2]), seen)))
        seen = minus(seen, plus(offset, [c_error[0], c_error[1], 0.0]))
        seen = back(by_c, back(turn("y", c_error[3]), back(turn("x", c_error[2]), seen)))
        off = minus(seen, plus(place, nest))
        if frame == "machine":
            off = times(by_a, times(by_c, off))
        cells = [f"{v:.4f}" for v in command] + ([f"{a:g}"] if has_a else []) + [f"{c:g}"]
        lines.append(",".join(cells + [f"{1e3 * v:.2f}" for v in noisy(off, 0.0004)]))
    write(name, [*header, *lines])


def r_test_of_table():
    five_axes(
        "r-test-c.csv",
        [(0.0, c * 10.0) for c in range(36)],
        "table",
        ["# displacement = table"],
        ["X [mm],Y [mm],Z [mm],C [deg],dX [um],dY [um],dZ [um]"],
        None,
        (0.0121, -0.0083, 31e-6, -18e-6),
        [0.0031, -0.0022, 0.0014],
        dict(xy=26e-6),
    )
    planted("r-test-c.csv", square_xy=26e-6, c_shift_x=12.1e-6, c_shift_y=-8.3e-6, c_tilt_x=31e-6, c_tilt_y=-18e-6)


def r_test_of_two():
    five_axes(
        "r-test-ac.csv",
        [(a, c) for a in (-30.0, 0.0, 30.0, 60.0, 90.0) for c in range(0, 360, 45)],
        "machine",
        ["# displacement = machine"],
        ["commanded X [mm],commanded Y [mm],commanded Z [mm],A [deg],C [deg],sphere dX [um],sphere dY [um],sphere dZ [um]"],
        (0.0078, -0.0044, -21e-6, 15e-6),
        (0.0062, 0.0091, 17e-6, -12e-6),
        [0.002, -0.0015, 0.001],
        dict(xy=22e-6, xz=-16e-6, yz=13e-6),
    )
    planted("r-test-ac.csv", square_xy=22e-6, square_xz=-16e-6, square_yz=13e-6)


def balls(counts, pitch):
    return [[pitch * i, pitch * j, pitch * k] for k in range(counts[2]) for j in range(counts[1]) for i in range(counts[0])]


def plate(name, header, is_deviation):
    """A stack of ball plates that the machine probes: calibrated places, and what the machine read there."""
    p = dict(xy=33e-6, xz=21e-6, yz=-27e-6, scales=(14e-6, -8e-6, 19e-6))
    lines = list(header)
    for number, ball in enumerate(balls((5, 5, 3), 80.0)):
        known = noisy(ball, 0.02)
        # In the machine the plate lies turned and moved; where only deviations are given, it was laid along the axes.
        there = known if is_deviation else plus(times(turn("z", 0.31), times(turn("x", 0.004), known)), [120.0, -60.0, 15.0])
        read = list(there)
        for _ in range(6):
            read = plus(read, minus(there, tip(read, **p)))
        read = noisy(read, 0.0005)
        cells = [f"{v:.4f}" for v in known]
        cells += [f"{1e3 * (r - k):.2f}" for r, k in zip(read, known)] if is_deviation else [f"{v:.4f}" for v in read]
        lines.append(",".join([f"{number + 1}", *cells]))
    write(name, lines)
    planted(name, square_xy=33e-6, square_xz=21e-6, square_yz=-27e-6, scale_x=14e-6, scale_y=-8e-6, scale_z=19e-6)


def grid(name, header, is_deviation):
    """A tracker on the bed, or a grid whose deviations are given: actual minus commanded."""
    p = dict(xy=-29e-6, xz=38e-6, yz=12e-6, scales=(-13e-6, 22e-6, 6e-6))
    lines = list(header)
    for command in balls((6, 5, 3), 60.0):
        command = plus(command, [-150.0, -120.0, -60.0])
        true = noisy(tip(command, **p), 0.0006)
        if is_deviation:
            cells = [f"{v:.3f}" for v in command] + [f"{1e3 * (t - c):.2f}" for t, c in zip(true, command)]
        else:
            seen = plus(times(turn("z", -1.9), times(turn("y", 0.02), true)), [1250.0, 430.0, -310.0])
            cells = [f"{v:.3f}" for v in command] + [f"{v:.4f}" for v in seen]
        lines.append(",".join(cells))
    write(name, lines)
    planted(name, square_xy=-29e-6, square_xz=38e-6, square_yz=12e-6, scale_x=-13e-6, scale_y=22e-6, scale_z=6e-6)


def main():
    bar_xy()
    bar_both_ways()
    bar_zx()
    bar_space()
    r_test_of_table()
    r_test_of_two()
    plate("plate-1.csv", ["ball,nominal x [mm],nominal y [mm],nominal z [mm],measured x [mm],measured y [mm],measured z [mm]"], False)
    plate("plate-2.csv", ["ball,calibrated x [mm],calibrated y [mm],calibrated z [mm],dx [um],dy [um],dz [um]"], True)
    grid("grid-1.csv", ["commanded x [mm],commanded y [mm],commanded z [mm],tracker x [mm],tracker y [mm],tracker z [mm]"], False)
    grid("grid-2.csv", ["X_mm,Y_mm,Z_mm,deviation X (µm),deviation Y (µm),deviation Z (µm)"], True)


main()
