"""Reference numbers for ramps: as make_numbers.py, for the chain in ramps.chain, written down a second time here.

    pip install mpmath==1.3.0 && python make_ramps.py
"""

from make_numbers import main

STAND = [
    ("Rz", "-azimuth"),
    ("Rx", "give*ramp(elevation, 53*pi/180, 39*pi/180)"),
    ("Ry", "flop*ramp(azimuth, mpf(4)/10, mpf(4)/10) + hinge*ramp(azimuth, begins, begins + width)**2"),
]
TUBE = STAND + [
    ("Ty", "offset*ramp(ambient, -1, 2)"),
    ("Ry", "elevation"),
    ("Rz", "skew*cos(elevation)*ramp(elevation, -2, mpf(3)/2)"),
    ("Tx", "creep*(1 - ramp(ambient, mpf(1)/2, mpf(1)/2))"),
]

CHAINS = {
    "ramps": (
        {"azimuth": (-3.1, 3.1), "elevation": (0.2, 1.4), "ambient": (-2.0, 3.0)},
        {"begins": "0.7", "width": "0.4363323129985824"},
        ["give", "flop", "hinge", "offset", "skew", "creep"],
        {
            "axis": (TUBE, ("1", "0", "0", "0")),
            "focus": (TUBE, ("begins", "0", "ramp(ambient, 0, 1)", "1")),
        },
    ),
}

if __name__ == "__main__":
    main(CHAINS, "ramps.csv")
