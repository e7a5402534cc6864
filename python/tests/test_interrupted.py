"""Ctrl-C ends a calibration soon, whoever listens to it."""

import os
import signal
import subprocess
import sys
import time

import pytest
from conftest import MOUNT
from test_calibration import STUDY

LONG = f"""
import sys, numpy as np, trueaxis
chain = trueaxis.Chain.from_text({MOUNT!r}, "mount.chain")
table = chain.simulate({{"collimation": "30 arcsec"}}, poses=300_000, noise="2 arcsec", seed=1, ranges={{"elevation": ("10 deg", "80 deg")}})
table = {{**table, "wave": np.sin(np.arange(300_000))}}
text = {STUDY!r}
print("begins", flush=True)
try:
    trueaxis.calibrate("study.toml", table, text=text, chain=chain)
except KeyboardInterrupt:
    print("interrupted", flush=True)
# What was interrupted leaves everything in order.
few = {{name: column[:200] for name, column in table.items()}}
print(trueaxis.calibrate("study.toml", few, text=text, chain=chain).verdict, flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are not there")
@pytest.mark.parametrize("wait", [0.1, 0.7])
def test_ctrl_c_ends_a_long_calibration(wait):
    work = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True)
    assert work.stdout.readline() == "begins\n"
    time.sleep(wait)
    work.send_signal(signal.SIGINT)
    began = time.monotonic()
    line = work.stdout.readline()
    took = time.monotonic() - began
    assert line == "interrupted\n", line
    assert work.stdout.readline().strip() and work.wait(60) == 0
    assert took < 2, took
