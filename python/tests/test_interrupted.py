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


# One call over many rows of a long chain, or of a closed form that takes a minute.
OVER_ROWS = {
    "exact": "long(300).exact(readings, errors, threads=1)",
    "jacobian": "long(300).jacobian(readings, errors, wrt=['e0'], form='exact', threads=1)",
    "compiled": "compiled.exact(readings, errors, threads=2)",
    "closed_form": "telescope.closed_form(telescope.observables[0].name, order=2)",
}
OVER_ROWS_ASKED = f"""
import numpy as np, trueaxis
telescope = trueaxis.Chain.from_file({str(EXAMPLES / "total-station" / "telescope.chain")!r})

def long(bodies):
    of = lambda at: f"body b{{at + 1}} on b{{at}} {{{{ position: Tx(0.1); motion: Rz(a); motion_error: Rx(e{{at}}); }}}}"
    text = "".join(map(of, range(bodies))).replace("on b0 ", "on ground ")
    return trueaxis.Chain.from_text(f"chain Long {{{{ {{text}} observe end: point(0, 1, 0) of b{{bodies}}; }}}}", "long.chain")

readings = {{"a": np.linspace(0.1, 1.5, ROWS)}}
errors = {{"e*": 1e-4}}
COMPILE
print("begins", flush=True)
try:
    QUESTION
except KeyboardInterrupt:
    print("interrupted", flush=True)
print(long(2).exact({{"a": readings["a"][:100]}}, errors).shape, flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="signals of this kind are not there")
@pytest.mark.parametrize("question", OVER_ROWS)
def test_ctrl_c_ends_a_call_over_many_rows(question):
    if question == "compiled" and not any(map(shutil.which, ("cc", "gcc", "clang"))):
        pytest.skip("there is no C compiler here")
    compiled = "compiled = long(20).compiled()" if question == "compiled" else ""
    program = OVER_ROWS_ASKED.replace("COMPILE", compiled).replace("QUESTION", OVER_ROWS[question])
    ends_soon(program.replace("ROWS", "8_000_000" if compiled else "2_000_000"), 0.1 if compiled else 0.4)


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
