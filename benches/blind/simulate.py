"""Instruments and noise for blind trials: plain matrices and Python's own random numbers, nothing of the project.

An instrument is a list of factors (kind, amount): a rotation "Rx Ry Rz" in radians or a shift "Tx Ty Tz" in metres; an amount
is a function of the errors e and of the joints q. Angles are radians, lengths metres.
"""
import math

ARCSEC = math.pi / 648000


def apply(kind, amount, v, point):
    x, y, z = v
    if kind[0] == "T":
        shift = {"x": (amount, 0, 0), "y": (0, amount, 0), "z": (0, 0, amount)}[kind[1]]
        return tuple(a + b for a, b in zip(v, shift)) if point else v
    c, s = math.cos(amount), math.sin(amount)
    if kind[1] == "x":
        return (x, c * y - s * z, s * y + c * z)
    if kind[1] == "y":
        return (c * x + s * z, y, -s * x + c * z)
    return (c * x - s * y, s * x + c * y, z)


def observe(factors, e, q, v, point):
    for kind, amount in reversed(factors):
        v = apply(kind, amount(e, q), v, point)
    return v


class AltAzimuth:
    """Six errors, direction, three components measured."""

    name = "alt-azimuth"
    errors = {k: 20 * ARCSEC for k in
              ["tilt_x", "tilt_y", "azimuth_index", "nonperpendicularity", "elevation_index", "collimation"]}
    chain = """chain Mount {
    body azimuth_axis on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion:         Rz(-azimuth);
        motion_error:   Rz(azimuth_index);
    }
    body elevation_axis on azimuth_axis {
        position_error: Ry(nonperpendicularity);
        motion:         Rx(elevation);
        motion_error:   Rx(elevation_index);
    }
    body telescope on elevation_axis {
        position_error: Rz(collimation);
    }
    observe observed: direction(0, 1, 0) of telescope;
}
"""
    joints = ["azimuth", "elevation"]
    ranges = {"azimuth": (-math.pi, math.pi), "elevation": (0.2, 1.4)}
    point = False
    noise = 2 * ARCSEC
    components = 2

    def value(self, e, q, planted=None):
        factors = [("Rx", lambda e, q: e["tilt_x"]), ("Ry", lambda e, q: e["tilt_y"]), ("Rz", lambda e, q: -q["azimuth"]),
                   ("Rz", lambda e, q: e["azimuth_index"]), ("Ry", lambda e, q: e["nonperpendicularity"]),
                   ("Rx", lambda e, q: q["elevation"]), ("Rx", lambda e, q: e["elevation_index"]),
                   ("Rz", lambda e, q: e["collimation"])]
        if planted:
            # Behind the motion and the errors of its axis.
            at, kind, amount = planted
            factors.insert({"azimuth_axis": 4, "elevation_axis": 7}[at], (kind, amount))
        return observe(factors, e, q, (0.0, 1.0, 0.0), False)


class Scanner:
    """The mobile lidar: thirty errors; a target at 5 to 30 m, or its direction alone."""

    joints = ["alpha", "beta", "gamma"]
    ranges = {j: (-math.pi, math.pi) for j in joints}
    order = [("dtheta_y1", "Ry"), ("dtheta_x1", "Rx"), ("alpha", "Rz"), ("dx1", "Tx"), ("dy1", "Ty"), ("dz1", "Tz"),
             ("da1", "Rx"), ("db1", "Ry"), ("delta_x2", "Tx"), ("delta_y2", "Ty"), ("dtheta_y2", "Ry"), ("dtheta_z2", "Rz"),
             ("beta", "Rx"), ("dx2", "Tx"), ("dy2", "Ty"), ("dz2", "Tz"), ("db2", "Ry"), ("dg2", "Rz"), ("delta_y3", "Ty"),
             ("dtheta_y3", "Ry"), ("dtheta_x3", "Rx"), ("gamma", "Rz"), ("dx3", "Tx"), ("dy3", "Ty"), ("dz3", "Tz"),
             ("da3", "Rx"), ("db3", "Ry"), ("dx4", "Tx"), ("dy4", "Ty"), ("dz4", "Tz"), ("da4", "Rx"), ("db4", "Ry"),
             ("dg4", "Rz")]

    def __init__(self, target):
        self.errors = {name: (20 * ARCSEC if kind[0] == "R" else 2e-4) for name, kind in self.order if name not in self.joints}
        self.point = target
        self.name = "scanner, targets" if target else "scanner, directions"
        self.noise = 1e-4 if target else 2 * ARCSEC
        self.components = 3 if target else 2
        if target:
            self.joints = self.joints + ["range"]
            self.ranges = {**self.ranges, "range": (5.0, 30.0)}
        bodies, at = [], 0
        for body, lower, joint, last in [("outer", "ground", "alpha", "db1"), ("middle", "outer", "beta", "dg2"),
                                         ("inner", "middle", "gamma", "db3"), ("device", "inner", None, "dg4")]:
            end = [name for name, _ in self.order].index(last) + 1
            own = self.order[at:end]
            at = end
            cut = [name for name, _ in own].index(joint) if joint else len(own)
            text = f"    body {body} on {lower} {{\n        position_error: {', '.join(f'{k}({n})' for n, k in own[:cut])};\n"
            if joint:
                text += f"        motion: {own[cut][1]}({joint});\n"
                text += f"        motion_error: {', '.join(f'{k}({n})' for n, k in own[cut + 1:])};\n"
            bodies.append(text + "    }\n")
        tail = "    input range: length;\n    observe observed: point(0, 0, range) of device;\n" if target else \
            "    observe observed: direction(0, 0, 1) of device;\n"
        self.chain = "chain Scanner {\n" + "".join(bodies) + tail + "}\n"

    def value(self, e, q, planted=None):
        factors = [(kind, (lambda e, q, n=name: q[n] if n in q else e[n])) for name, kind in self.order]
        if planted:
            at, kind, amount = planted
            behind = {"outer": "alpha", "middle": "beta"}[at]
            factors.insert([name for name, _ in self.order].index(behind) + 1, (kind, amount))
        v = (0.0, 0.0, q["range"] if self.point else 1.0)
        return observe(factors, e, q, v, self.point)


class Arm:
    """Six joints in a row, an index error and a skew at each, shifts between them; the tool's point."""

    name = "six-joint arm"
    joints = [f"q{i}" for i in range(1, 7)]
    ranges = {j: (-1.8, 1.8) for j in joints}
    lengths = [0.13, 0.61, 0.57, 0.16, 0.12, 0.09]
    axes = ["Rz", "Rx", "Rx", "Rz", "Rx", "Rz"]
    point = True
    noise = 5e-5
    components = 3
    errors = {**{f"index{i}": 2e-4 for i in range(1, 7)}, **{f"skew{i}": 2e-4 for i in range(1, 7)}}

    def __init__(self):
        bodies = []
        for i, axis in enumerate(self.axes, 1):
            lower = "ground" if i == 1 else f"link{i - 1}"
            position = "" if i == 1 else f"        position: Tz({self.lengths[i - 2]});\n"
            bodies.append(f"    body link{i} on {lower} {{\n{position}        motion: {axis}(q{i});\n"
                          f"        motion_error: {axis}(index{i}), Ry(skew{i});\n    }}\n")
        tool = f"    body tool on link6 {{\n        position: Tz({self.lengths[5]});\n    }}\n"
        self.chain = "chain Arm {\n" + "".join(bodies) + tool + "    observe observed: point(0.05, 0, 0) of tool;\n}\n"

    def value(self, e, q):
        factors = []
        for i, axis in enumerate(self.axes, 1):
            factors += [(axis, lambda e, q, i=i: q[f"q{i}"]), (axis, lambda e, q, i=i: e[f"index{i}"]),
                        ("Ry", lambda e, q, i=i: e[f"skew{i}"]), ("Tz", lambda e, q, i=i: self.lengths[i - 1])]
        return observe(factors, e, q, (0.05, 0.0, 0.0), True)


def serial(kind, rows, random):
    """A column of noise of variance one in the long run, or of steps of a fifth for a walk."""
    if kind == "independent":
        return [random.gauss(0, 1) for _ in range(rows)]
    if kind == "t3":
        return [random.gauss(0, 1) / math.sqrt(random.gammavariate(1.5, 2) / 3) / math.sqrt(3) for _ in range(rows)]
    if kind == "outliers":
        return [random.gauss(0, 1) if random.random() > 0.05 else random.gauss(0, 30) for _ in range(rows)]
    if kind.startswith("AR"):
        phi = float(kind[3:-1])
        x, out = random.gauss(0, 1), []
        for _ in range(rows):
            out.append(x)
            x = phi * x + math.sqrt(1 - phi * phi) * random.gauss(0, 1)
        return out
    if kind == "walk":
        x, out = 0.0, []
        for _ in range(rows):
            out.append(x + random.gauss(0, 1))
            x += 0.2 * random.gauss(0, 1)
        return out
    raise ValueError(kind)


def poses(instrument, rows, trajectory, random):
    """Random poses, or a slow sweep over all joints in the order of the rows."""
    out = []
    for row in range(rows):
        q = {}
        for j, (low, high) in instrument.ranges.items():
            if trajectory:
                turns = 1.0 + 0.7 * list(instrument.ranges).index(j)
                share = 0.5 + 0.5 * math.sin(2 * math.pi * turns * row / rows + 0.4)
            else:
                share = random.random()
            q[j] = low + (high - low) * share
        out.append(q)
    return out


def measured(instrument, e, q, noise, in_space=False, planted=None):
    """The observable with noise: of a point's three components; of a direction across and along the vertical, as an
    instrument reads it, or of the three components of space, by which a drift of the ground moves it. A direction stays of
    length one."""
    value = instrument.value(e, q, planted) if planted else instrument.value(e, q)
    if instrument.point or in_space:
        v = [a + b for a, b in zip(value, noise)]
    else:
        x, y, z = value
        level = math.hypot(x, y) or 1e-300
        across, along = (-y / level, x / level, 0.0), (-x * z / level, -y * z / level, level)
        v = [a + noise[0] * b + noise[1] * c for a, b, c in zip(value, across, along)]
    if instrument.point:
        return v
    size = math.sqrt(sum(a * a for a in v))
    return [a / size for a in v]
