"""Ctrl-C ends a calibration soon, whoever listens to it."""

import os
import shutil
import signal
import subprocess
import sys
import time

import pytest
from conftest import EXAMPLES, MOUNT
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

# One call that takes long: many points of a chain of thirty errors.
QUESTIONS = {
    "bound": "chain.bound({name: 1e-3 for name in chain.errors})",
    "budget": "chain.budget({name: 1e-3 for name in chain.errors})",
    "identify": "chain.identify()",
}
ASKED = f"""
import trueaxis
text = open({str(EXAMPLES / "mobile-lidar" / "mobile-lidar.chain")!r}).read()
end = text.rindex("}}")
more = "".join(f"observe more{{at}}: point(0.{{at + 100}}, 0.{{at + 200}}, {{at + 1}}) of device;" for at in range(400))
chain = trueaxis.Chain.from_text(text[:end] + more + "}}", "lidar.chain")
print("begins", flush=True)
try:
    QUESTION
except KeyboardInterrupt:
    print("interrupted", flush=True)
print(len(chain.errors), flush=True)
"""


# One call over many rows of a robot, or of a closed form that takes a minute.
OVER_ROWS = {
    "exact": "chain.exact(readings, errors, threads=1)",
    "jacobian": "chain.jacobian(readings, errors, wrt=chain.errors[:1], form='exact', threads=1)",
    "compiled": "compiled.jacobian(readings, errors, wrt=chain.errors[:1], form='exact', threads=2)",
    "closed_form": "telescope.closed_form(telescope.observables[0].name, order=2)",
}
ROBOT = f"""
import numpy as np, trueaxis
chain = trueaxis.Chain.from_file({str(EXAMPLES / "ur10" / "ur10.chain")!r})
telescope = trueaxis.Chain.from_file({str(EXAMPLES / "total-station" / "telescope.chain")!r})
readings = {{name: np.linspace(0.1, 1.5, 3_000_000) for name in chain.joints + chain.inputs}}
errors = {{name: 1e-4 for name in chain.errors}}
COMPILE
print("begins", flush=True)
try:
    QUESTION
except KeyboardInterrupt:
    print("interrupted", flush=True)
few = {{name: column[:100] for name, column in readings.items()}}
print(chain.exact(few, errors).shape, flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are not there")
@pytest.mark.parametrize("question", OVER_ROWS)
def test_ctrl_c_ends_a_call_over_many_rows(question):
    if question == "compiled" and not any(map(shutil.which, ("cc", "gcc", "clang"))):
        pytest.skip("there is no C compiler here")
    compiled = "compiled = chain.compiled()" if question == "compiled" else ""
    ends_soon(ROBOT.replace("COMPILE", compiled).replace("QUESTION", OVER_ROWS[question]), 0.4)


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are not there")
@pytest.mark.parametrize("question", QUESTIONS)
def test_ctrl_c_ends_a_long_question(question):
    ends_soon(ASKED.replace("QUESTION", QUESTIONS[question]), 0.4)


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are not there")
@pytest.mark.parametrize("wait", [0.1, 0.7])
def test_ctrl_c_ends_a_long_calibration(wait):
    ends_soon(LONG, wait)


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are not there")
def test_ctrl_c_in_the_first_call_is_no_panic():
    """Which fetches what later ones have."""
    program = f"""
import os, signal, threading, trueaxis
chain = trueaxis.Chain.from_text({MOUNT!r}, "mount.chain")
threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    chain.simulate({{}}, poses=2_000_000, noise="2 arcsec", seed=1)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""
    work = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert work.stdout == "interrupted\n" and work.returncode == 0, work.stderr


def ends_soon(program, wait):
    work = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert work.stdout.readline() == "begins\n"
    time.sleep(wait)
    work.send_signal(signal.SIGINT)
    began = time.monotonic()
    line = work.stdout.readline()
    took = time.monotonic() - began
    assert line == "interrupted\n", line
    assert work.stdout.readline().strip() and work.wait(60) == 0
    assert took < 2, took
