"""Processes that are forked: threads of the process before them are not theirs."""

import subprocess
import sys

import pytest

PROGRAM = """
import multiprocessing, sys
import numpy as np
import trueaxis
sys.path.insert(0, {tests!r})
from conftest import MOUNT
from test_calibration import STUDY, TRUE

chain = trueaxis.Chain.from_text(MOUNT, "mount.chain")
readings = {{"azimuth": np.linspace(0, 3, 100_000), "elevation": np.linspace(0.1, 1.4, 100_000)}}
table = dict(chain.simulate(TRUE, poses=100, noise="2 arcsec", seed=4, ranges={{"elevation": ("10 deg", "80 deg")}}))

def work(_):
    exact = chain.exact(readings, TRUE).sum()
    value = dict(chain.apply(readings, TRUE))["pointing_x"].sum()
    found = trueaxis.calibrate("study.toml", table, text=STUDY, chain=chain)
    return exact, value, found.values, found.html() == found.html()

here = work(0)
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert pool.map_async(work, range(2)).get(timeout=200) == [here, here]
print("done")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="nothing is forked there")
def test_a_forked_process_answers_as_the_one_before_it(tmp_path):
    from pathlib import Path

    program = tmp_path / "program.py"
    program.write_text(PROGRAM.format(tests=str(Path(__file__).parent)))
    run = subprocess.run([sys.executable, program], capture_output=True, text=True, timeout=240)
    assert run.stdout == "done\n", run.stderr
