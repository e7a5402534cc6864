"""What does not fit into memory is an error, and no end of the process."""

import os
import subprocess
import sys

import pytest
from conftest import MOUNT

# Room for the readings, and for no more than what the process has beside the result.
PROGRAM = f"""
import resource, sys, numpy as np, trueaxis
chain = trueaxis.Chain.from_text({MOUNT!r}, "mount.chain")
readings = {{name: np.full(8_000_000, 0.5) for name in chain.joints}}
chain.apply({{name: column[:10_000] for name, column in readings.items()}}, {{}})
pages = int(open("/proc/self/statm").read().split()[0])
most = pages * resource.getpagesize() + 110_000_000
resource.setrlimit(resource.RLIMIT_AS, (most, most))
try:
    QUESTION
except trueaxis.TrueaxisError as error:
    print(error, flush=True)
# As many as there is room for are computed.
print(chain.eval({{name: column[:100_000] for name, column in readings.items()}}, {{}}).rows, flush=True)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the limit is Linux's")
@pytest.mark.parametrize(
    ("question", "words"),
    [
        ("chain.eval(readings, {}, 'pointing')", "the table: 3 numbers for each of its 8000000 rows do not fit into memory"),
        ("chain.apply(readings, {})", "the table: 3 numbers for each of its 8000000 rows do not fit into memory"),
        ("chain.simulate({}, poses=8_000_000, noise='1 arcsec', seed=1)", "poses=8000000: so many rows of 5 columns do not fit"),
    ],
)
def test_the_process_goes_on(question, words):
    # Each thread's arena would take address space of its own, more of it in one run than in another.
    environment = {**os.environ, "MALLOC_ARENA_MAX": "1"}
    program = [sys.executable, "-c", PROGRAM.replace("QUESTION", question)]
    work = subprocess.run(program, capture_output=True, text=True, timeout=60, env=environment)
    assert work.returncode == 0, work.stderr
    assert work.stdout.startswith(words) and work.stdout.endswith("\n100000\n")
