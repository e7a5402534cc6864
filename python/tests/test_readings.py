"""Observables that show other numbers than x, y and z: the shapes of arrays, names, closed forms."""

import copy
import pickle

import numpy as np
import pytest
import sympy

import trueaxis

SKY = """
chain Sky {
    body base on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(-azimuth); }
    body tube on base { position_error: Ry(cross), Ty(shift); motion: Rx(elevation); motion_error: Rz(-collimation); }
    observe sky: azimuth(y, x), elevation of direction(0, 1, 0) of tube;
    observe height: z of point(0, 2, 0) of tube;
    observe far: range of point(0, 2, 1) of tube;
    observe off: off_axis of direction(0, 1, 0) of tube;
    observe turned: rotation_z of orientation of tube;
    observe line: direction(0, 1, 0) of tube;
}
"""
ERRORS = {"tilt_x": 1e-4, "cross": -2e-4, "collimation": 3e-4, "shift": 1e-3}
SHOWN = {"sky": ["azimuth", "elevation"], "height": ["z"], "far": ["range"], "off": ["off_axis"], "turned": ["rotation_z"], "line": ["x", "y", "z"]}


@pytest.fixture(scope="module")
def chain():
    return trueaxis.Chain.from_text(SKY, "sky.chain")


@pytest.fixture(scope="module")
def readings():
    random = np.random.default_rng(1)
    return {"azimuth": random.uniform(-3, 3, 70), "elevation": random.uniform(0.1, 1.3, 70)}


@pytest.mark.parametrize("name", SHOWN)
def test_the_first_axis_has_what_is_shown(chain, readings, name):
    table = chain.eval(readings, ERRORS, name)
    expected = np.array([table[f"{name}_{label}"] for label in SHOWN[name]])
    np.testing.assert_array_equal(chain.exact(readings, ERRORS, name), expected)
    first = chain.first_order(readings, ERRORS, name)
    assert first.shape == expected.shape == (len(SHOWN[name]), 70)
    one = chain.exact({"azimuth": 0.3, "elevation": 1.0}, ERRORS, name)
    assert one.shape == (len(SHOWN[name]),)
    out = np.empty((len(SHOWN[name]), 70))
    assert chain.exact(readings, ERRORS, name, out=out) is out
    if name == "off":
        return
    jacobian = chain.jacobian(readings, observable=name)
    assert jacobian.shape == (len(SHOWN[name]), len(chain.errors), 70)
    sizes = np.array([ERRORS.get(error, 0.0) for error in chain.errors])
    np.testing.assert_allclose(np.einsum("ckn,k->cn", jacobian, sizes), first, atol=1e-15)


def test_an_angle_off_the_axis_has_no_jacobian(chain, readings):
    with pytest.raises(trueaxis.TrueaxisError, match="`off`"):
        chain.jacobian(readings, observable="off")


def test_what_an_observable_shows_is_said(chain):
    of_name = {observable.name: observable for observable in chain.observables}
    assert {name: observable.shown for name, observable in of_name.items()} == SHOWN
    assert (of_name["sky"].kind, of_name["sky"].units) == ("direction", ["rad", "rad"])
    assert (of_name["height"].kind, of_name["height"].units) == ("point", ["m"])
    assert (of_name["turned"].kind, of_name["turned"].units) == ("orientation", ["rad"])
    assert of_name["line"].units == ["1", "1", "1"]


def test_closed_forms_are_named_as_derive_names_them(chain):
    form = chain.closed_form("sky")
    assert form.names == ["sky_azimuth", "sky_elevation"] and len(form.text) == 2
    assert f"sky_azimuth = {form.text[0]}\nsky_elevation = {form.text[1]}" in repr(form)
    assert r"\text{sky}_{\text{azimuth}} &=" in form._repr_latex_() and "x &=" not in form._repr_latex_()
    assert chain.closed_form("line").names == ["line_x", "line_y", "line_z"]


def test_closed_forms_are_copied(chain):
    form = chain.closed_form("sky", order=1)
    for other in [copy.deepcopy(form), pickle.loads(pickle.dumps(form))]:
        assert repr(other) == repr(form) and other.sympy() == form.sympy() and other._repr_latex_() == form._repr_latex_()


@pytest.mark.parametrize(("start", "end"), [("pi", "pi"), ("2", "2"), ("1", "3"), ("3", "1"), ("c", "c")])
def test_ramps_as_expressions(start, end):
    chain = trueaxis.Chain.from_text(
        "chain R { const c: angle = 2; body b on ground { motion: Rz(q); "
        f"motion_error: Rz(flop*ramp(q, {start}, {end})); }} observe o: direction(1, 0, 0) of b; }}"
    )
    expressions = chain.closed_form().sympy()
    q, flop, c = (sympy.Symbol(name, real=True) for name in ["q", "flop", "c"])
    for at in [0.0, 1.0, 2.0, 2.5, 3.0, np.pi, 4.0]:
        expected = chain.first_order({"q": at}, {"flop": 1e-3})
        found = [float(one.subs({q: sympy.Float(at) if at != np.pi else sympy.pi, flop: 1e-3, c: 2})) for one in expressions]
        np.testing.assert_allclose(found, expected, atol=1e-12)


def test_constants_without_value_are_symbols(tmp_path):
    text = (
        "chain N { const L: length; body b on ground { position: Tx(L); position_error: Rz(e); motion: Rz(q); } "
        "observe o: point(1, 0, 0) of b; }"
    )
    path = tmp_path / "novalue.chain"
    path.write_text(text)
    chain = trueaxis.Chain.from_file(path)
    assert chain.constants == ["L"] and pickle.loads(pickle.dumps(chain)).text == text
    assert chain.closed_form().sympy()[1].free_symbols == {sympy.Symbol(name, real=True) for name in "eq"}
    assert chain.identify()["identifiability"]
    readings = {"q": np.zeros(3)}
    for needs_numbers in [
        lambda: chain.exact(readings, {"e": 1e-3}),
        lambda: chain.jacobian(readings),
        lambda: chain.eval(readings, {}),
        lambda: chain.apply(readings, {}),
        lambda: chain.bound({"e": 1e-3}),
        lambda: chain.budget({"e": 1e-3}, path="q=t"),
        lambda: chain.simulate({}, poses=3, noise="1 mm", seed=1),
    ]:
        with pytest.raises(trueaxis.MistakeError, match="the constant `L` has no value") as raised:
            needs_numbers()
        assert "novalue.chain" in str(raised.value) and raised.value.mistakes[0].line == 1
