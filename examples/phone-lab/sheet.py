#!/usr/bin/env python3
"""The sheet of the lab with a phone: a circle of degrees, and six marks. Print it at 100 %.

    python3 sheet.py > sheet.svg
"""

import math

MARKS_MM = [(62, 0), (20, 58), (-45, 40), (-55, -30), (0, -64), (28, -12)]
DIAL_MM = 90


def line(x1, y1, x2, y2):
    return f'<path d="M{x1:.2f} {-y1:.2f}L{x2:.2f} {-y2:.2f}"/>'


def text(x, y, size, words):
    return f'<text x="{x:.2f}" y="{-y:.2f}" font-size="{size}">{words}</text>'


def dial():
    yield f'<circle r="{DIAL_MM}"/>'
    for degrees in range(0, 360, 5):
        # The numbers run clockwise, so that they grow at a pin in the base while the table turns to the left.
        along = math.radians(-degrees)
        x, y = math.cos(along), math.sin(along)
        inner = DIAL_MM - (6 if degrees % 15 == 0 else 3)
        yield line(inner * x, inner * y, DIAL_MM * x, DIAL_MM * y)
        if degrees % 15 == 0:
            yield text(80 * x, 80 * y - 1.2, 3.5, degrees)


def mark(number, x, y):
    """Two black quarters: their common corner is the mark."""
    yield f'<path class="black" d="M{x} {-y}h4a4 4 0 0 1 -4 4zM{x} {-y}h-4a4 4 0 0 1 4 -4z"/>'
    yield f'<circle cx="{x}" cy="{-y}" r="4"/>'
    yield text(x + 6.5, y - 1.2, 3.5, number)


print('<svg xmlns="http://www.w3.org/2000/svg" width="210mm" height="210mm" viewBox="-105 -105 210 210">')
print("<style>*{fill:none;stroke:#000;stroke-width:.2}text{fill:#000;stroke:none;font-family:sans-serif;text-anchor:middle}.black{fill:#000}</style>")
print('<rect x="-105" y="-105" width="210" height="210" style="fill:#fff;stroke:none"/>')
print("\n".join(dial()))
for number, (x, y) in enumerate(MARKS_MM, start=1):
    print("\n".join(mark(number, x, y)))
print(line(-4, 0, 4, 0), line(0, -4, 0, 4))
print(line(-50, -98, 50, -98), text(0, -103, 3.5, "100 mm"))
print("</svg>")
