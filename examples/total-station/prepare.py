#!/usr/bin/env python3
"""Make the tables and the declaration of this example from a table of the survey's observations.

Data: linz/python-linz-pyaxis (BSD-3), the example of 2015, as one table with the columns from, to, orientation, arc, target, set,
ha [deg], zd [deg], sd [m], and their standard deviations. Arcs A and B turn the telescope by steps of 10 degrees of azimuth, arcs C and D of elevation: the labels of the
orientations say roughly by how much. What the telescope's own circles read nobody wrote down, so that each arc has an error of
its own at each orientation.

    python3 prepare.py total-station-30m.csv     writes first.csv, second.csv beside this file
    python3 prepare.py                           writes telescope.chain alone
"""

import csv
import math
import pathlib
import sys

HERE = pathlib.Path(__file__).parent
# The orientations of each arc, as labelled, and by how many degrees a label counts.
LABELS = {
    "A": (range(0, 36, 2), 10), "B": (range(0, 36, 2), 10),
    "C": (range(0, 100, 10), 1), "D": (range(0, 100, 10), 1),
}  # fmt: skip


def table(arc, joint, gate, sign=""):
    """A value at each orientation but the first, linear between them: an error has one value at one orientation."""
    labels, degrees = LABELS[arc]
    labels = list(labels)
    factors = []
    for at, label in enumerate(labels[1:], 1):
        knots = [f"{one * degrees} deg" for one in labels[at - 1 : at + 2]]
        hat = f"ramp({joint}, {knots[0]}, {knots[1]})"
        if len(knots) == 3:
            hat = f"({hat} - ramp({joint}, {knots[1]}, {knots[2]}))"
        elif arc == "B":
            # The azimuth at which arc C was driven stands a turn behind.
            hat = f"({hat} - ramp({joint}, {knots[1]}, 360 deg))"
        factors.append((sign, f"{arc.lower()}{label:02d}*{hat}*{gate}"))
    return factors


def written(factors, motion):
    return ",\n            ".join(f"{motion}({sign}{amount})" for sign, amount in factors)


def chain():
    elevations = table("D", "elevation", "(1 - second)", "-") + table("C", "elevation", "second", "-")
    azimuths = table("A", "azimuth", "(1 - second)") + table("B", "azimuth", "second")
    azimuths.append(("", "c_azimuth*ramp(azimuth, 360 deg, 450 deg)"))
    template = (HERE / "telescope.chain.in").read_text()
    text = template.replace("@ELEVATIONS@", written(elevations, "Rx")).replace("@AZIMUTHS@", written(azimuths, "Rz"))
    (HERE / "telescope.chain").write_text(text)


def tables(source):
    with open(source) as file:
        everything = list(csv.DictReader(file))
    # Every round begins or ends at the other station, from which its directions count.
    rounds = {}
    for row in everything:
        if row["to"] in ("WAS3", "WAN3"):
            ha = (float(row["ha [deg]"]) + 180) % 360 - 180
            rounds.setdefault((row["from"], row["set"]), []).append(ha)
    rows = [row for row in everything if row["arc"]]
    for number, station, arcs in ((0, "WAS3", "AD"), (1, "WAN3", "BC")):
        with open(HERE / ("second.csv" if number else "first.csv"), "w") as out:
            out.write("target,ha [deg],zd [deg],range [m],azimuth [deg],elevation [deg],second,aside [m],along [m]\n")
            for row in rows:
                if row["from"] != station:
                    continue
                arc, label = row["arc"], int(row["orientation"])
                assert arc in arcs
                # The elevation arc of the second station was driven a quarter turn on; a turn more tells it from arc B.
                azimuth = 10 * label if arc in "AB" else 450 * number
                elevation = label if arc in "CD" else 0
                back = rounds[row["from"], row["set"]]
                ha = float(row["ha [deg]"]) - sum(back) / len(back)
                angles = f"{ha:.6f},{row['zd [deg]']},{row['sd [m]']}"
                # The standard deviation of a direction (both circles state the same), as a length at the target.
                aside = math.radians(float(row["zd_sd [deg]"])) * float(row["sd [m]"])
                sigma = f"{aside:.7f},{row['sd_sd [m]']}"
                out.write(f"{arc}{row['target']},{angles},{azimuth},{elevation},{number},{sigma}\n")


if __name__ == "__main__":
    chain()
    if len(sys.argv) > 1:
        tables(sys.argv[1])
