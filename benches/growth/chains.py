"""Chains of many joints, and of many errors, whose cost `costs.py` measures.

A chain of J joints turns about z, x and y in turn, with a constant shift and six errors a joint. A chain of N errors has three
joints, and N/3 errors at each.
"""

def sizes(turns, shifts):
    """A file of sizes, by the first letters of errors."""
    sized = [*((letter, "2 arcsec") for letter in turns), *((letter, "0.01 mm") for letter in shifts)]
    return "".join(f"\"{letter}*\" = \"{size}\"\n" for letter, size in sized)


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
