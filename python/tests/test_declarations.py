"""Declarations and what follows from them: mistakes with their places, closed forms, answers."""

import pickle

import numpy as np
import pytest
import sympy

import trueaxis


def test_what_a_chain_says_of_itself(mount, scanner):
    assert mount.name == "Mount" and mount.joints == ["azimuth", "elevation"]
    assert mount.errors[0] == "tilt_x" and len(scanner.errors) == 30
    assert ("collimation", "error", "rad") in mount.symbols
    (observable,) = mount.observables
    assert observable[:3] == ("pointing", "direction", ["azimuth", "elevation"]) and observable.shown == ["x", "y", "z"]
    assert "Mount" in repr(mount) and "chain Mount" in mount._repr_html_()
    again = pickle.loads(pickle.dumps(mount))
    assert again.text == mount.text


def test_mistakes_come_with_their_places():
    text = "chain C {\n    body b on ground { motion: Rw(a); }\n    observe o: direction(0, 0, 1) of c;\n}\n"
    with pytest.raises(trueaxis.MistakeError) as raised:
        trueaxis.Chain.from_text(text, "wrong.chain")
    error = raised.value
    assert isinstance(error, trueaxis.TrueaxisError) and isinstance(error, ValueError)
    assert [(m.line, m.column) for m in error.mistakes] == [(2, 32), (3, 38)]
    assert "--> wrong.chain:2:32" in str(error) and "unknown axis `Rw`" in error.mistakes[0].message
    assert error.mistakes[0].help
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.mistakes == error.mistakes


@pytest.mark.parametrize(
    "text",
    ["", "\0", "chain", "chain {", "}" * 1000, "(" * 100_000, "chain C {" * 5000, "\U0001f600", "chain C { observe }", '"' * 99],
)
def test_hostile_texts_are_refused(text):
    with pytest.raises(trueaxis.MistakeError):
        trueaxis.Chain.from_text(text)


def test_a_file_that_is_not_there(tmp_path, examples):
    with pytest.raises(trueaxis.TrueaxisError, match="there is no such file"):
        trueaxis.Chain.from_file(tmp_path / "none.chain")
    with pytest.raises(trueaxis.TrueaxisError, match="did you mean .*mobile-lidar.chain"):
        trueaxis.Chain.from_file(examples / "mobile-lidar" / "mobile-lider.chain")
    (tmp_path / "bytes.chain").write_bytes(b"\xff\xfe")
    with pytest.raises(trueaxis.TrueaxisError, match="not UTF-8"):
        trueaxis.Chain.from_file(tmp_path / "bytes.chain")


@pytest.mark.parametrize("order", [1, 2, 3])
def test_closed_forms_as_expressions(mount, order):
    """A closed form in SymPy has the value that NumPy gives the product of matrices, to its order."""
    from test_numbers import ERRORS, pointing

    form = mount.closed_form(order=order)
    assert "order in the errors" in form.title and len(form.latex) == 3 and r"\begin{aligned}" in form._repr_latex_()
    azimuth, elevation = 0.7, 0.4
    error = (pointing(np.array([azimuth]), np.array([elevation]), ERRORS) - pointing(np.array([azimuth]), np.array([elevation]), {}))[:, 0]
    values = {sympy.Symbol(name, real=True): value for name, value in ERRORS.items()}
    values |= {sympy.Symbol("azimuth", real=True): azimuth, sympy.Symbol("elevation", real=True): elevation}
    found = [float(component.subs(values)) for component in form.sympy()]
    np.testing.assert_allclose(found, error, atol=(3e-3) ** (order + 1))
    with pytest.raises(trueaxis.TrueaxisError, match="order 4"):
        mount.closed_form(order=4)


def test_names_that_mean_something_in_python_are_only_names():
    chain = trueaxis.Chain.from_text(
        "chain Odd { const arm: length = 1/4; body b on ground { motion: Rz(lambda); position_error: Rx(E), Ry(S), Tx(I); }"
        " observe o: point(arm, 0, 1/3) of b; }"
    )
    names = {symbol.name for component in chain.closed_form().sympy() for symbol in component.free_symbols}
    assert names == {"lambda", "E", "S", "I", "arm"}
    assert all(component.is_real for component in chain.closed_form().sympy())


def test_identify(scanner):
    answer = scanner.identify("pointing")
    (alone,) = answer["identifiability"]
    assert alone["declared"] == 30 and "pointing" in str(answer)
    assert any({m["error"] for m in group} >= {"dtheta_y3", "db2"} for group in alone["alike"])
    assert len(scanner.identify()["identifiability"]) == len(scanner.observables) + 1
    with pytest.raises(trueaxis.TrueaxisError, match="--candidate"):
        scanner.identify("pointing", candidate="nowhere")
    with pytest.raises(trueaxis.MistakeError):
        scanner.identify("pointing", candidate="middle Rx(")
    assert "<pre>" in answer._repr_html_()


def test_bound_holds(mount):
    sizes = {"*": 1e-3}
    answer = mount.bound(sizes, ranges={"elevation": ("0 deg", 1.5)})
    (bound,) = answer["bounds"]
    random = np.random.default_rng(1)
    readings = {"azimuth": random.uniform(-np.pi, np.pi, 200), "elevation": random.uniform(0, 1.5, 200)}
    for _ in range(50):
        errors = dict(zip(mount.errors, random.uniform(-1e-3, 1e-3, 6)))
        left_out = np.linalg.norm(mount.exact(readings, errors) - mount.first_order(readings, errors), axis=0)
        assert left_out.max() <= bound["bound"]
    assert 0 < bound["largest_found"] <= bound["bound"]
    with pytest.raises(trueaxis.TrueaxisError, match="lower bound is above"):
        mount.bound(sizes, ranges={"elevation": "80 deg..10 deg"})
    with pytest.raises(TypeError, match="range of elevation"):
        mount.bound(sizes, ranges={"elevation": 3})
    with pytest.raises(trueaxis.TrueaxisError, match="no joint or input `x=1..2`|no joint or input `x`"):
        mount.bound(sizes, ranges={"x=1..2": (0, 1)})


def test_budget(mount):
    answer = mount.budget({"collimation": "10 arcsec"}, path="azimuth=t, elevation=t/8")
    (pointing,) = answer["observables"]
    assert pointing["worst_case"]["sup"] == pytest.approx(10 * np.pi / 180 / 3600, rel=1e-9)
    assert "collimation" in str(answer)
    with pytest.raises(trueaxis.MistakeError, match="--path"):
        mount.budget({"collimation": 1e-5}, path="azimuth=t, elevatio=t")
    with pytest.raises(ValueError, match="not both"):
        mount.budget({"collimation": 1e-5}, path="azimuth=t", ranges={"elevation": (0, 1)})


def test_check(examples):
    answer = trueaxis.check(examples / "mobile-lidar" / "paper.toml")
    assert {claim["verdict"] for claim in answer["claims"]} >= {"holds", "differs"}
    assert str(answer).strip()
    with pytest.raises(trueaxis.TrueaxisError, match="there is no such file"):
        trueaxis.check("none.toml")
