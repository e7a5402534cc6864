"""One observable compiled: the numbers of the interpreter, its shapes and its words."""

import os
import pickle
import shutil
import sys
import threading

import numpy as np
import pytest

import trueaxis
from trueaxis import _compiler

from conftest import EXAMPLES, MOUNT, counted_while

ERRORS = {"tilt_x": 3e-4, "azimuth_index": 5e-4, "nonperpendicularity": "80 arcsec", "collimation": 1e-3}
TESTED = EXAMPLES.parent / "codegen" / "tests" / "chains"

pytestmark = pytest.mark.skipif(
    sys.platform not in ("linux", "darwin") or not any(map(shutil.which, ("cc", "gcc", "clang"))),
    reason="there is no C compiler here",
)


@pytest.fixture(scope="module")
def chain():
    return trueaxis.Chain.from_text(MOUNT, "mount.chain")


@pytest.fixture(scope="module")
def compiled(chain):
    return chain.compiled()


def readings_of(chain, rows, seed=7):
    random = np.random.default_rng(seed)
    return {name: random.uniform(0.1, 1.5, rows) for name in chain.joints + chain.inputs}


def every_form(evaluated, readings, errors):
    observable = evaluated.observable if isinstance(evaluated, trueaxis.Compiled) else None
    yield evaluated.exact(readings, errors, observable)
    yield evaluated.exact(readings, errors, observable, quantity="value")
    yield evaluated.first_order(readings, errors, observable)
    yield evaluated.jacobian(readings, observable=observable)
    yield evaluated.jacobian(readings, errors, observable, form="exact")


def assert_same_but_for_rounding(found, expected):
    """Sums of a few products, each rounded once instead of twice: some units in the last place of the largest number."""
    assert found.shape == expected.shape
    scale = np.nanmax(np.abs(expected), initial=1e-300)
    np.testing.assert_allclose(found, expected, rtol=0, atol=2e-15 * scale)


CHAINS = [
    EXAMPLES / "mobile-lidar" / "mobile-lidar.chain",
    EXAMPLES / "turntable" / "turntable.chain",
    EXAMPLES / "gallery" / "total-station.chain",
    EXAMPLES / "encoder" / "encoder.chain",
    EXAMPLES / "mobile-scanner" / "vehicle.chain",
    TESTED / "readings.chain",
    TESTED / "ramps.chain",
    TESTED / "words.chain",
    TESTED / "higher_order.chain",
]


@pytest.mark.parametrize("path", CHAINS, ids=lambda path: path.stem)
def test_numbers_are_those_of_the_interpreter(path):
    chain = trueaxis.Chain.from_file(path)
    readings = readings_of(chain, 1000)
    random = np.random.default_rng(1)
    errors = {name: float(random.uniform(-1e-3, 1e-3)) for name in chain.errors}
    # The last observables are the unusual ones: readings, orientations.
    observable = chain.observables[-1].name
    compiled = chain.compiled(observable)
    for quantity in ("error", "value"):
        assert_same_but_for_rounding(
            compiled.exact(readings, errors, quantity=quantity),
            chain.exact(readings, errors, observable, quantity=quantity),
        )
    assert_same_but_for_rounding(
        compiled.first_order(readings, errors), chain.first_order(readings, errors, observable)
    )
    try:
        expected = [chain.jacobian(readings, errors, observable, form=form) for form in ("first-order", "exact")]
    except trueaxis.TrueaxisError as no_derivative:
        with pytest.raises(trueaxis.TrueaxisError) as raised:
            compiled.jacobian(readings, errors)
        assert str(raised.value) == str(no_derivative)
        return
    for form, expected in zip(("first-order", "exact"), expected):
        assert_same_but_for_rounding(compiled.jacobian(readings, errors, form=form), expected)


def test_few_rows_have_the_bits_of_the_interpreter(chain, compiled):
    readings = readings_of(chain, 63)
    np.testing.assert_array_equal(compiled.exact(readings, ERRORS), chain.exact(readings, ERRORS))
    np.testing.assert_array_equal(compiled.first_order(readings, ERRORS), chain.first_order(readings, ERRORS))


@pytest.mark.parametrize("rows", [0, 1, 63, 64, 65, 255, 256, 511, 512, 513, 1000])
def test_every_number_of_rows(chain, compiled, rows):
    """Blocks and strides begin and end everywhere; a number stands for a column that holds it."""
    readings = readings_of(chain, rows)
    for found, expected in zip(every_form(compiled, readings, ERRORS), every_form(chain, readings, ERRORS)):
        assert_same_but_for_rounding(found, expected)
    with_number = {**readings, "elevation": 0.7}
    repeated = {**readings, "elevation": np.full(rows, 0.7)}
    for found, expected in zip(every_form(compiled, with_number, ERRORS), every_form(compiled, repeated, ERRORS)):
        np.testing.assert_array_equal(found, expected)


def test_numbers_in_place_of_arrays(chain, compiled):
    one = {"azimuth": 0.3, "elevation": 1}
    for found, expected in zip(every_form(compiled, one, ERRORS), every_form(chain, one, ERRORS)):
        assert_same_but_for_rounding(found, expected)
    assert compiled.exact(one, ERRORS).shape == (3,)


def test_the_same_array_twice(chain, compiled):
    angles = np.linspace(0, 1, 300)
    readings = {"azimuth": angles, "elevation": angles}
    for found, expected in zip(every_form(compiled, readings, ERRORS), every_form(chain, readings, ERRORS)):
        assert_same_but_for_rounding(found, expected)


def test_columns_of_jacobians_by_name(chain, compiled):
    readings = readings_of(chain, 200)
    everything = compiled.jacobian(readings, ERRORS, form="exact")
    wrt = ["collimation", "tilt_x", "collimation"]
    places = [chain.errors.index(name) for name in wrt]
    np.testing.assert_array_equal(compiled.jacobian(readings, ERRORS, wrt=wrt, form="exact"), everything[:, places])
    assert compiled.jacobian(readings, wrt="collimation").shape == (3, 1, 200)
    assert compiled.jacobian(readings, wrt=[]).shape == (3, 0, 200)


def test_not_a_number_and_wide_angles_stay_in_their_rows(chain, compiled):
    readings = readings_of(chain, 256)
    readings["azimuth"][[3, 100]] = np.nan, 1e9
    for found, expected in zip(every_form(compiled, readings, ERRORS), every_form(chain, readings, ERRORS)):
        np.testing.assert_array_equal(np.isnan(found), np.isnan(expected))
        assert_same_but_for_rounding(found, expected)


def test_results_go_where_they_are_wanted(chain, compiled):
    readings = readings_of(chain, 1000)
    out = np.empty((3, 1000))
    assert compiled.exact(readings, ERRORS, out=out) is out
    np.testing.assert_array_equal(out, compiled.exact(readings, ERRORS))
    one = np.empty(3)
    assert compiled.exact({"azimuth": 0.1, "elevation": 0.2}, ERRORS, out=one) is one and one.any()
    out = np.empty((3, 2, 1000))
    compiled.jacobian(readings, wrt=["tilt_y", "collimation"], out=out)
    np.testing.assert_array_equal(out, compiled.jacobian(readings)[:, [1, 5]])


def test_threads_change_no_bit(chain, compiled):
    rows = 200_003
    readings = readings_of(chain, rows)
    # In blocks with a wide angle, sines and cosines are computed another way.
    readings["azimuth"][::10_007] *= 1e7
    expected = list(every_form(compiled, readings, ERRORS))
    for threads in (1, 2, 3, 7):
        exact = compiled.exact(readings, ERRORS, threads=threads)
        jacobian = compiled.jacobian(readings, ERRORS, form="exact", threads=threads)
        np.testing.assert_array_equal(exact, expected[0])
        np.testing.assert_array_equal(jacobian, expected[4])
    with pytest.raises(ValueError, match="threads: at least one"):
        compiled.exact(readings, threads=0)


def test_several_callers_at_once(chain, compiled):
    readings = readings_of(chain, 100_000)
    expected = compiled.exact(readings, ERRORS, threads=1)
    results = [None] * 4

    def evaluate(at):
        results[at] = compiled.exact(readings, ERRORS)

    threads = [threading.Thread(target=evaluate, args=(at,)) for at in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    for result in results:
        np.testing.assert_array_equal(result, expected)


def test_the_interpreter_goes_on_meanwhile(chain, compiled):
    readings = readings_of(chain, 3_000_000)
    assert counted_while(lambda: compiled.jacobian(readings, ERRORS, form="exact", threads=1)) > 1000


@pytest.mark.parametrize(
    "ask",
    [
        lambda it: it.exact({"azimuth": 0.1, "elevaton": 0.2}),
        lambda it: it.exact({"azimuth": 0.1}),
        lambda it: it.exact({"azimuth": np.zeros(2), "elevation": np.zeros(3)}),
        lambda it: it.exact({"azimuth": np.zeros(3, dtype=np.float32), "elevation": np.zeros(3)}),
        lambda it: it.exact({"azimuth": np.zeros(6)[::2], "elevation": np.zeros(3)}),
        lambda it: it.exact({"azimuth": [0.1], "elevation": 0.2}),
        lambda it: it.exact({"azimuth": 0.1, "elevation": 0.2}, {"colimation": 1e-3}),
        lambda it: it.exact({"azimuth": 0.1, "elevation": 0.2}, {"collimation": "10 mm"}),
        lambda it: it.exact({"azimuth": 0.1, "elevation": 0.2}, observable="pointng"),
        lambda it: it.exact({"azimuth": 0.1, "elevation": 0.2}, quantity="size"),
        lambda it: it.exact({"azimuth": 0.1, "elevation": 0.2}, out=np.empty(4)),
        lambda it: it.jacobian({"azimuth": 0.1, "elevation": 0.2}, wrt=["colimation"]),
        lambda it: it.jacobian({"azimuth": 0.1, "elevation": 0.2}, form="second"),
    ],
)
def test_what_is_wrong_is_said_in_the_same_words(chain, compiled, ask):
    with pytest.raises(Exception) as expected:
        ask(chain)
    with pytest.raises(type(expected.value)) as found:
        ask(compiled)
    assert str(found.value) == str(expected.value)


def test_a_result_cannot_overwrite_its_readings(compiled):
    all_in_one = np.zeros((3, 100))
    with pytest.raises(ValueError, match="`out`: .*none of the readings"):
        compiled.exact({"azimuth": all_in_one[0], "elevation": np.zeros(100)}, ERRORS, out=all_in_one)


def test_a_doubtful_number_is_warned_of_where_it_was_written(compiled):
    with pytest.warns(trueaxis.TrueaxisWarning, match="did you mean") as warned:
        compiled.exact({"azimuth": 0.1, "elevation": 0.2}, {"collimation": 10.0})
    assert warned[0].filename == __file__


CONSTANTS = """
chain Boom {
    const reach: length = 0.25;
    body boom on ground { motion: Rz(swing); motion_error: Rz(index); }
    body foot on boom { position: Tx(reach); position_error: Tx(longer); }
    observe end: point(0, 0, 0) of foot;
    observe way: direction(1, 0, 0) of foot;
}
"""


def test_constants_are_compiled_in():
    chain = trueaxis.Chain.from_text(CONSTANTS)
    compiled = chain.compiled("end")
    readings = {"swing": np.linspace(0, 1, 100)}
    expected = chain.exact(readings, {"longer": "1 mm"}, "end")
    assert_same_but_for_rounding(compiled.exact(readings, {"longer": "1 mm", "reach": 0.25}), expected)
    with pytest.raises(trueaxis.TrueaxisError, match="the constant `reach` is compiled in as 0.25, .* to 0.26"):
        compiled.exact(readings, {"reach": 0.26})
    with pytest.raises(trueaxis.TrueaxisError, match="`reach` is a constant, which is compiled in"):
        compiled.jacobian(readings, wrt=["longer", "reach"])
    with pytest.raises(trueaxis.TrueaxisError, match="compiled for `end`: compile `way` too"):
        compiled.exact(readings, observable="way")
    with pytest.raises(trueaxis.TrueaxisError, match="declares `end`, `way`: name one of them"):
        chain.compiled()
    # The direction does not ask for what the point does.
    assert chain.compiled("way").exact({"swing": 0.5}, {"index": 1e-3}).shape == (3,)


def test_readings_that_are_not_needed_may_be_missing():
    chain = trueaxis.Chain.from_text(
        "chain Two { input warmth;"
        " body one on ground { motion: Rz(first); motion_error: Rz(a); }"
        " body two on one { motion: Rx(second); motion_error: Rx(b * warmth); }"
        " observe near: direction(1, 0, 0) of one; observe far: direction(0, 1, 0) of two; }"
    )
    near, far = chain.compiled("near"), chain.compiled("far")
    for rows in (10, 100):
        readings = readings_of(chain, rows)
        only = {"first": readings["first"]}
        assert_same_but_for_rounding(near.exact(only, {"a": 1e-3}), chain.exact(only, {"a": 1e-3}, "near"))
        np.testing.assert_array_equal(near.exact(only, {"a": 1e-3}), near.exact(readings, {"a": 1e-3}))
        assert_same_but_for_rounding(
            far.exact(readings, {"b": 1e-3}), chain.exact(readings, {"b": 1e-3}, "far")
        )
    with pytest.raises(trueaxis.TrueaxisError, match="`far` needs readings of `warmth`"):
        far.exact({"first": 0.1, "second": 0.2})


def test_chains_without_joints_and_without_errors():
    still = trueaxis.Chain.from_text(
        "chain Still { body post on ground { position_error: Rx(lean), Ry(nod); } observe top: direction(0, 0, 1) of post; }"
    )
    compiled = still.compiled()
    errors = {"lean": 1e-3, "nod": -2e-3}
    for found, expected in zip(every_form(compiled, {}, errors), every_form(still, {}, errors)):
        assert_same_but_for_rounding(found, expected)
    perfect = trueaxis.Chain.from_text(
        "chain Perfect { body top on ground { motion: Rz(turn); } observe edge: direction(1, 0, 0) of top; }"
    )
    compiled = perfect.compiled()
    readings = {"turn": np.linspace(0, 1, 100)}
    for found, expected in zip(every_form(compiled, readings, None), every_form(perfect, readings, None)):
        assert_same_but_for_rounding(found, expected)
    assert compiled.jacobian(readings).shape == (3, 0, 100)


def test_an_angle_off_the_axis_has_no_jacobian():
    chain = trueaxis.Chain.from_text(
        "chain Spin { body top on ground { motion: Rz(turn); motion_error: Rz(index); }"
        " observe off: off_axis of direction(1, 0, 0) of top; }"
    )
    readings = {"turn": np.linspace(0, 1, 100)}
    compiled = chain.compiled()
    np.testing.assert_allclose(compiled.exact(readings, {"index": 1e-3}), np.full((1, 100), 1e-3), rtol=1e-12)
    for it in (chain, compiled):
        with pytest.raises(trueaxis.TrueaxisError, match="off the axis of `off` has no derivative"):
            it.jacobian(readings)


def test_names_that_mean_something_in_c():
    chain = trueaxis.Chain.from_text(
        "/// */ #error \"\\\n"
        "chain given { body out on ground { motion: Rz(prepared); motion_error: Rz(errors); }"
        " body int on out { motion: Rx(columns); motion_error: Rx(TRUEAXIS_ROWS), Ry(α); }"
        " observe block: direction(0, 1, 0) of int; }"
    )
    readings = readings_of(chain, 100)
    errors = dict.fromkeys(chain.errors, 1e-3)
    compiled = chain.compiled()
    for found, expected in zip(every_form(compiled, readings, errors), every_form(chain, readings, errors)):
        assert_same_but_for_rounding(found, expected)


def test_two_chains_of_one_name_do_not_meet():
    def turning(axis):
        return trueaxis.Chain.from_text(
            f"chain Same {{ body top on ground {{ motion: R{axis}(turn); motion_error: R{axis}(index); }}"
            " observe edge: direction(0.6, 0.8, 0) of top; }"
        )

    chains = [turning("z"), turning("x")]
    both = [chain.compiled() for chain in chains]
    for chain, compiled in zip(chains, both):
        readings = {"turn": np.linspace(0, 1, 100)}
        assert_same_but_for_rounding(
            compiled.exact(readings, {"index": 1e-3}), chain.exact(readings, {"index": 1e-3})
        )


def test_a_copy_is_compiled_where_it_arrives(chain, compiled):
    readings = readings_of(chain, 100)
    expected = compiled.exact(readings, ERRORS)
    other = pickle.loads(pickle.dumps(compiled))
    assert other.observable == "pointing" and other.chain.name == "Mount"
    np.testing.assert_array_equal(other.exact(readings, ERRORS), expected)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked here")
@pytest.mark.filterwarnings("ignore:.*multi-threaded:DeprecationWarning")
def test_a_forked_process_has_threads_of_its_own(chain, compiled):
    readings = readings_of(chain, 100_000)
    compiled.exact(readings, ERRORS, threads=3)
    child = os.fork()
    if child == 0:
        compiled.exact(readings, ERRORS, threads=3)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def script(folder, text):
    path = folder / "a compiler"
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)
    return path


def test_compilers_that_are_none(chain, tmp_path, monkeypatch):
    with pytest.raises(trueaxis.TrueaxisError, match="there is no C compiler `no-such-cc`"):
        chain.compiled(compiler="no-such-cc")
    with pytest.raises(trueaxis.TrueaxisError, match="ended with 3:\nsome words"):
        chain.compiled(compiler=script(tmp_path, "echo some words >&2; exit 3"))
    with pytest.raises(trueaxis.TrueaxisError, match="wrote no library"):
        chain.compiled(compiler=script(tmp_path, "exit 0"))
    writes = script(tmp_path, 'while [ "$1" != -o ]; do shift; done; echo no program > "$2"')
    with pytest.raises(trueaxis.TrueaxisError, match="cannot be loaded"):
        chain.compiled(compiler=writes)
    for words in ("", "no-such-cc -m64", '"'):
        monkeypatch.setenv("CC", words)
        monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
        says = r"\$CC: there is no C compiler" if words else "none of cc, gcc, clang is on the path"
        with pytest.raises(trueaxis.TrueaxisError, match=says):
            chain.compiled()
    monkeypatch.setattr(_compiler.sys, "platform", "win32")
    with pytest.raises(trueaxis.TrueaxisError, match="Linux and macOS, not on win32"):
        chain.compiled()


def test_the_compiler_of_the_environment_and_what_is_left(tmp_path, monkeypatch):
    chain = trueaxis.Chain.from_text(CONSTANTS)
    monkeypatch.setenv("CC", f"{shutil.which('cc') or shutil.which('gcc') or shutil.which('clang')} -O1")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    compiled = chain.compiled("end")
    assert list(tmp_path.iterdir()) == []
    assert compiled.exact({"swing": np.zeros(3)}, {"longer": 1e-3})[0] == pytest.approx(1e-3)


def test_generated_files_are_those_of_the_command(scanner):
    files = scanner.generate("c", "pointing")
    assert list(files) == ["c", "h"] and '#include "mobile_lidar.h"' in files["c"]
    languages = ("rust", "cpp", "numpy", "jax", "javascript", "matlab", "latex")
    assert {language: list(scanner.generate(language)) for language in languages} == {
        "rust": ["rs"],
        "cpp": ["cpp", "hpp", "h"],
        "jax": ["py"],
        "matlab": ["m"],
        "numpy": ["py"],
        "javascript": ["js"],
        "latex": ["tex"],
    }
    with pytest.raises(trueaxis.TrueaxisError, match="no language `ruts`; did you mean `rust`?"):
        scanner.generate("ruts")
    with pytest.raises(trueaxis.TrueaxisError, match="no observable `pointng`"):
        scanner.generate("c", ["pointng"])


def test_generated_numpy_gives_the_same_numbers(mount):
    module = {}
    exec(compile(mount.generate("numpy")["py"], "mount.py", "exec"), module)
    readings = readings_of(mount, 100)
    prepared = module["prepare_exact_error"](module["Errors"](collimation=1e-3))
    found = module["exact_error"](prepared, module["Joints"](**readings)).pointing
    np.testing.assert_allclose(found, mount.exact(readings, {"collimation": 1e-3}), atol=1e-15)
