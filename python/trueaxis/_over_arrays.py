"""Forms as numbers over arrays: the methods that a chain and a compiled chain share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Literal

import numpy as np

from . import _native
from ._inputs import Errors, errors_text, names, number_of, observable_of, text_of, whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

Readings = Mapping[str, "NDArray[np.float64] | float"]
"""Joints and inputs by name: an array with a number a row, or one number for all rows; rad and m."""


class OverArrays:
    """Exact, first-order and Jacobian over arrays, by the interpreter or by what was compiled for one observable."""

    _native: _native.Chain
    _compiled: tuple[_native.Loadable, Callable[[str, _native.Call], None]] | None

    def exact(
        self,
        readings: Readings,
        errors: Errors = None,
        observable: str | None = None,
        *,
        quantity: Literal["error", "value"] = "error",
        out: NDArray[np.float64] | None = None,
        threads: int | None = None,
    ) -> NDArray[np.float64]:
        """The exact error of an observable, without cancellation; or its value with errors.

        :param readings: joints and inputs by name, rad and m: contiguous arrays of float64 of one length, or numbers that hold
            for all rows. Names that the observable does not depend on may be given too.
        :param errors: by name or pattern, numbers in SI or texts with a unit; or the path of a file. Errors not named are zero.
        :param observable: which, where the chain declares several.
        :param quantity: what the errors add to the observable, or the observable with its errors.
        :param out: a contiguous array of float64 for the result, which is then not allocated.
        :param threads: how many at most; as many as there are processors where none is given. No bit depends on it.
        :returns: an array of shape ``(shown, rows)``; ``(shown,)`` where every reading is one number. Its first axis has the
            numbers that the observable shows (:attr:`Observable.shown`): x, y, z unless the declaration names others. Directions
            have no unit (their error is in rad, to first order); points are in m, angles in rad.
        """
        if quantity not in ("error", "value"):
            raise ValueError(f'quantity: write "error" or "value", not {quantity!r}')
        return self._evaluate(f"exact {quantity}", readings, errors, observable, [], out, threads)

    def first_order(
        self,
        readings: Readings,
        errors: Errors = None,
        observable: str | None = None,
        *,
        out: NDArray[np.float64] | None = None,
        threads: int | None = None,
    ) -> NDArray[np.float64]:
        """The error of an observable to first order in the errors; arguments and result as of :meth:`exact`."""
        return self._evaluate("first-order error", readings, errors, observable, [], out, threads)

    def jacobian(
        self,
        readings: Readings,
        errors: Errors = None,
        observable: str | None = None,
        *,
        wrt: Iterable[str] | None = None,
        form: Literal["first-order", "exact"] = "first-order",
        out: NDArray[np.float64] | None = None,
        threads: int | None = None,
    ) -> NDArray[np.float64]:
        """The derivatives of an observable with respect to errors. An angle off the axis has none.

        :param wrt: names of errors, or of constants; every error, in order, where none is given.
        :param form: ``"first-order"``: where every error is zero, the coefficients of :meth:`first_order`; ``"exact"``: at the
            errors given.
        :returns: an array of shape ``(shown, len(wrt), rows)``, or ``(shown, len(wrt))`` where every reading is one number; for
            an angle in 1/rad times the observable's unit, for a length in 1/m times it.

        Other arguments as of :meth:`exact`.
        """
        if form not in ("first-order", "exact"):
            raise ValueError(f'form: write "first-order" or "exact", not {form!r}')
        columns = None if wrt is None else names(wrt)
        return self._evaluate(f"{form} jacobian", readings, errors, observable, columns, out, threads)

    def _evaluate(self, form, readings, errors, observable, wrt, out, threads):
        columns, constants = [], []
        if not hasattr(readings, "items"):
            raise TypeError(f'readings: write a dictionary of joints and inputs, {{"azimuth": 0.1}}, not a {type(readings).__name__}')
        for name, reading in readings.items():
            is_number = isinstance(reading, (int, float, np.integer, np.floating)) and not isinstance(reading, bool)
            name = text_of("a name of readings", name)
            if is_number:
                constants.append((name, number_of(name, reading)))
            else:
                columns.append((name, reading))
        if threads is not None and whole("threads", threads, 32) < 1:
            raise ValueError(f"threads: at least one is needed, not {threads}")
        is_one = not columns
        given = out.reshape(*out.shape, 1) if is_one and isinstance(out, np.ndarray) else out
        result = self._native.evaluate(
            form, observable_of(observable), columns, constants, errors_text(errors), wrt, given, threads, self._compiled
        )
        if out is not None:
            return out
        return result[..., 0] if is_one else result
