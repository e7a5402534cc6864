"""Exact, first-order and Jacobian over arrays, against products of matrices in NumPy."""

import threading

import numpy as np
import pytest
from conftest import counted_while

import trueaxis

ERRORS = {
    "tilt_x": 3e-4,
    "tilt_y": -2e-4,
    "azimuth_index": 5e-4,
    "nonperpendicularity": 4e-4,
    "elevation_index": -6e-4,
    "collimation": 1e-3,
}


def rotation(axis, angle):
    """Matrices of right-handed rotations, one an angle."""
    c, s = np.cos(angle), np.sin(angle)
    zero, one = np.zeros_like(c), np.ones_like(c)
    rows = {
        "x": [[one, zero, zero], [zero, c, -s], [zero, s, c]],
        "y": [[c, zero, s], [zero, one, zero], [-s, zero, c]],
        "z": [[c, -s, zero], [s, c, zero], [zero, zero, one]],
    }[axis]
    return np.moveaxis(np.array(rows), -1, 0)


def pointing(azimuth, elevation, errors):
    """The direction of the mount, factor by factor as it is declared."""
    at = lambda name: np.full_like(azimuth, errors.get(name, 0.0))
    product = np.broadcast_to(np.eye(3), (azimuth.size, 3, 3))
    for axis, angle in [
        ("x", at("tilt_x")),
        ("y", at("tilt_y")),
        ("z", -azimuth),
        ("z", at("azimuth_index")),
        ("y", at("nonperpendicularity")),
        ("x", elevation),
        ("x", at("elevation_index")),
        ("z", at("collimation")),
    ]:
        product = product @ rotation(axis, angle)
    return product[:, :, 1].T


@pytest.fixture
def readings():
    random = np.random.default_rng(7)
    return {"azimuth": random.uniform(-3, 3, 1000), "elevation": random.uniform(0, 1.5, 1000)}


def test_exact_is_the_product_of_matrices(mount, readings):
    expected = pointing(**readings, errors=ERRORS)
    nominal = pointing(**readings, errors={})
    np.testing.assert_allclose(mount.exact(readings, ERRORS, quantity="value"), expected, atol=1e-15)
    error = mount.exact(readings, ERRORS)
    assert error.shape == (3, 1000) and error.flags.c_contiguous
    np.testing.assert_allclose(error, expected - nominal, atol=1e-15)


def test_the_exact_error_of_tiny_errors_keeps_its_digits(mount, readings):
    """What a difference of directions would lose: the error is linear there, to 12 digits and more."""
    tiny = mount.exact(readings, {"collimation": 1e-14})
    np.testing.assert_allclose(tiny * 1e14, mount.jacobian(readings, wrt=["collimation"])[:, 0], atol=2e-12)


def test_the_jacobian_is_the_derivative_of_the_product(mount, readings):
    step = 1e-6
    jacobian = mount.jacobian(readings)
    at_errors = mount.jacobian(readings, ERRORS, form="exact")
    assert jacobian.shape == (3, len(mount.errors), 1000)
    for column, name in enumerate(mount.errors):
        for found, errors in [(jacobian, {}), (at_errors, ERRORS)]:
            moved = [
                pointing(**readings, errors={**errors, name: errors.get(name, 0.0) + sign * step}) for sign in (1, -1)
            ]
            np.testing.assert_allclose(found[:, column], (moved[0] - moved[1]) / (2 * step), atol=1e-9)


def test_first_order_is_the_jacobian_times_the_errors(mount, readings):
    sizes = np.array([ERRORS[name] for name in mount.errors])
    expected = np.einsum("ckn,k->cn", mount.jacobian(readings), sizes)
    np.testing.assert_allclose(mount.first_order(readings, ERRORS), expected, atol=1e-18)


def test_numbers_in_place_of_arrays(mount):
    one = mount.exact({"azimuth": 0.3, "elevation": 1}, ERRORS)
    assert one.shape == (3,)
    many = mount.exact({"azimuth": np.full(5, 0.3), "elevation": 1.0}, ERRORS)
    assert many.shape == (3, 5)
    np.testing.assert_array_equal(many, np.repeat(one[:, None], 5, axis=1))
    assert mount.jacobian({"azimuth": 0.3, "elevation": 1}, wrt="collimation").shape == (3, 1)


def test_texts_with_units_and_patterns_and_files(mount, tmp_path):
    readings = {"azimuth": 0.3, "elevation": 1.0}
    arcsec = np.pi / 180 / 3600
    file = tmp_path / "errors.toml"
    file.write_text('"tilt_*" = "10 arcsec"\ncollimation = 0.001\n')
    expected = mount.exact(readings, {"tilt_x": 10 * arcsec, "tilt_y": 10 * arcsec, "collimation": 0.001})
    np.testing.assert_array_equal(mount.exact(readings, {"tilt_*": "10 arcsec", "collimation": 1e-3}), expected)
    for path in (file, str(file)):
        np.testing.assert_array_equal(mount.exact(readings, path), expected)


def test_no_rows(mount):
    nothing = {"azimuth": np.empty(0), "elevation": np.empty(0)}
    assert mount.exact(nothing, ERRORS).shape == (3, 0)
    assert mount.jacobian(nothing).shape == (3, 6, 0)


def test_not_a_number_stays_in_its_row(mount):
    azimuth = np.array([0.1, np.nan, np.inf, 0.4])
    result = mount.exact({"azimuth": azimuth, "elevation": np.full(4, 0.5)}, ERRORS)
    assert np.isnan(result[:2, 1:3]).all() and np.isfinite(result[:, [0, 3]]).all()


def test_wrong_lengths_are_named(mount):
    with pytest.raises(ValueError, match="`elevation` has 3 rows, `azimuth` has 2"):
        mount.exact({"azimuth": np.zeros(2), "elevation": np.zeros(3)})


@pytest.mark.parametrize(
    ("azimuth", "words"),
    [
        (np.zeros(3, dtype=np.float32), r"float32; write azimuth\.astype\(numpy\.float64\)"),
        (np.zeros(3, dtype=">f8"), "float64 is needed, this holds >f8"),
        (np.zeros(3, dtype=np.int64), "this holds int64"),
        (np.zeros(6)[::2], r"not contiguous in memory; write numpy\.ascontiguousarray\(azimuth\)"),
        (np.zeros((3, 2))[:, 0], "not contiguous"),
        (np.zeros((3, 1)), "one dimension is needed, this has 2"),
        ([0.0, 0.0, 0.0], "this is a list"),
        ("0.5", "this is a str"),
        (None, "this is a NoneType"),
    ],
)
def test_what_cannot_be_read_in_place_is_refused(mount, azimuth, words):
    with pytest.raises(TypeError, match=words):
        mount.exact({"azimuth": azimuth, "elevation": np.zeros(3)})


def test_results_go_where_they_are_wanted(mount, readings):
    expected = mount.exact(readings, ERRORS)
    out = np.empty((3, 1000))
    assert mount.exact(readings, ERRORS, out=out) is out
    np.testing.assert_array_equal(out, expected)
    one = np.empty(3)
    assert mount.exact({"azimuth": 0.1, "elevation": 0.2}, ERRORS, out=one) is one and one.any()
    for wrong in [np.empty((1000, 3)), np.empty((3, 1000), dtype=np.float32), np.empty((3, 1000), order="F"), [0.0]]:
        with pytest.raises(TypeError, match=r"`out`: .*shape \(3, 1000\)"):
            mount.exact(readings, ERRORS, out=wrong)
    for wrong in [np.empty((3, 1)), np.empty(4)]:
        with pytest.raises(TypeError, match=r"shape \(3,\) is needed; write numpy.empty\(\(3,\)\)"):
            mount.exact({"azimuth": 0.1, "elevation": 0.2}, ERRORS, out=wrong)
    read_only = np.empty((3, 1000))
    read_only.flags.writeable = False
    with pytest.raises(ValueError, match="`out`"):
        mount.exact(readings, ERRORS, out=read_only)


def test_a_result_cannot_overwrite_its_readings(mount):
    all_in_one = np.zeros((3, 100))
    with pytest.raises(ValueError, match="`out`"):
        mount.exact({"azimuth": all_in_one[0], "elevation": np.zeros(100)}, ERRORS, out=all_in_one)


@pytest.mark.parametrize("first", [0, 50, 299, 300])
def test_nor_through_another_array_of_the_same_memory(mount, first):
    memory = bytearray(8 * 400)
    azimuth = np.frombuffer(memory)[first : first + 100]
    out = np.frombuffer(memory)[:300].reshape(3, 100)
    readings = {"azimuth": azimuth, "elevation": np.full(100, 0.5)}
    if first == 300:
        expected = mount.exact(readings, ERRORS)
        np.testing.assert_array_equal(mount.exact(readings, ERRORS, out=out), expected)
        return
    with pytest.raises(ValueError, match="`out`: it lies where readings lie: it must be writable, and none of the readings"):
        mount.exact(readings, ERRORS, out=out)


def test_threads_change_no_bit(scanner):
    random = np.random.default_rng(3)
    rows = 100_001
    readings = {name: random.uniform(-3, 3, rows) for name in scanner.joints}
    errors = {"d*": "20 arcsec", "dx*": "0.1 mm", "dy*": "0.1 mm", "dz*": "0.1 mm", "delta*": "0.1 mm"}
    errors = {name: 1e-4 for name in scanner.errors}
    expected = scanner.exact(readings, errors, "pointing", threads=1)
    results = [None] * 4

    def evaluate(at):
        results[at] = scanner.exact(readings, errors, "pointing", threads=[1, 2, 3, None][at])

    threads = [threading.Thread(target=evaluate, args=(at,)) for at in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    for result in results:
        np.testing.assert_array_equal(result, expected)
    with pytest.raises(ValueError, match="threads"):
        scanner.exact(readings, errors, "pointing", threads=0)


def test_the_interpreter_goes_on_meanwhile(scanner):
    """Python runs while a chain is evaluated: the lock is released."""
    readings = {name: np.linspace(0, 3, 2_000_000) for name in scanner.joints}
    assert counted_while(lambda: scanner.jacobian(readings, observable="pointing", wrt=scanner.errors[:8], threads=1)) > 1000


def test_names_are_checked(mount, scanner):
    readings = {"azimuth": 0.1, "elevation": 0.2}
    with pytest.raises(trueaxis.TrueaxisError, match="has no joint or input `elevaton`; did you mean `elevation`?"):
        mount.exact({"azimuth": 0.1, "elevaton": 0.2})
    with pytest.raises(trueaxis.TrueaxisError, match="`pointing` needs readings of `elevation`"):
        mount.exact({"azimuth": 0.1})
    with pytest.raises(trueaxis.TrueaxisError, match="no observable `pointng`; did you mean `pointing`?"):
        mount.exact(readings, observable="pointng")
    with pytest.raises(trueaxis.TrueaxisError, match="no error `colimation`; did you mean `collimation`?"):
        mount.jacobian(readings, wrt=["colimation"])
    with pytest.raises(trueaxis.TrueaxisError, match="declares `pointing`, .*: name one of them"):
        scanner.exact({name: 0.1 for name in scanner.joints})
    with pytest.raises(trueaxis.MistakeError, match="did you mean `collimation`?") as raised:
        mount.exact(readings, {"tilt_x": 0.0, "colimation": 0.0})
    assert raised.value.mistakes[0].line == 2
    for wrong in [True, None, [1.0], object()]:
        with pytest.raises(TypeError, match="write a number in SI or a text with a unit"):
            mount.exact(readings, {"collimation": wrong})
    with pytest.raises(trueaxis.TrueaxisError):
        mount.exact(readings, {"collimation": float("nan")})


def test_a_bare_number_that_is_no_radian_is_doubted(mount):
    with pytest.warns(trueaxis.TrueaxisWarning, match='did you mean collimation = "10 arcsec"'):
        mount.exact({"azimuth": 0.1, "elevation": 0.2}, {"collimation": 10.0})
