"""Writes measured.csv: a turntable's pointer seen by a theodolite at every tenth degree, three turns.

Planted: the axis leans 20 arcsec about x and -35 arcsec about y, the encoder's zero is off by 60 arcsec, and each direction is
noisy by 2 arcsec across and along. Nothing else: there is no effect to be found. The file is as a spreadsheet with a decimal
comma writes it. Shares no code with the project.
"""
import math
import random

ARCSEC = math.pi / 648000
TILT_X, TILT_Y, INDEX, NOISE = (angle * ARCSEC for angle in (20, -35, 60, 2))

chance = random.Random(7)


def rotate(x, y, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * x - s * y, s * x + c * y


rows = ["azimuth [deg];pointing_x;pointing_y;pointing_z"]
for degrees in range(0, 1080, 10):
    # In the frame of the pointer: ahead, and noise to the left and up.
    x, y, z = 1.0, chance.gauss(0, NOISE), chance.gauss(0, NOISE)
    x, y = rotate(x, y, math.radians(degrees) + INDEX)
    z, x = rotate(z, x, TILT_Y)
    y, z = rotate(y, z, TILT_X)
    length = math.sqrt(x * x + y * y + z * z)
    cells = [str(degrees)] + [f"{component / length:.12f}" for component in (x, y, z)]
    rows.append(";".join(cells).replace(".", ","))
open("measured.csv", "w", newline="").write("\ufeff" + "\r\n".join(rows) + "\r\n")
