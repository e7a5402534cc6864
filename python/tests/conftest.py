"""Paths and declarations that several tests use."""

import threading
from pathlib import Path

import pytest

import trueaxis

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

MOUNT = """
/// An alt-azimuth mount.
chain Mount {
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
    body telescope on elevation_axis { position_error: Rz(collimation); }
    observe pointing: direction(0, 1, 0) of telescope;
}
"""


def counted_while(work):
    """How far another thread counts while some work is done. With the interpreter's lock held it would stand still but for the few
    steps before and after."""
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1

    counter = threading.Thread(target=count)
    counter.start()
    before = counted[0]
    work()
    after = counted[0]
    done.set()
    counter.join()
    return after - before


@pytest.fixture
def examples():
    return EXAMPLES


@pytest.fixture
def mount():
    return trueaxis.Chain.from_text(MOUNT, "mount.chain")


@pytest.fixture
def scanner():
    return trueaxis.Chain.from_file(EXAMPLES / "mobile-lidar" / "mobile-lidar.chain")
