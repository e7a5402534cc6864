"""Chains: the declaration, its errors as numbers over arrays, and what follows from it exactly."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from . import _native
from ._answers import Answer
from ._compiled import Compiled
from ._inputs import Amount, Errors, amount, errors_and_ranges, errors_text, names, observable_of, path_of, ranges, text_of, whole
from ._over_arrays import OverArrays
from ._tables import Table, columns_of, kept, with_columns

if TYPE_CHECKING:
    import sympy

Ranges = Mapping[str, "str | tuple[Amount, Amount]"]
"""Joints and inputs by name: ``("-30 deg", "60 deg")`` or ``"-30 deg..60 deg"``."""


class Symbol(NamedTuple):
    """A declared name."""

    name: str
    kind: Literal["joint", "input", "error", "constant"]
    unit: str
    """``rad``, ``m`` or ``1``."""


class Observable(NamedTuple):
    """What an instrument shows."""

    name: str
    kind: Literal["direction", "point", "orientation"]
    """What its numbers are of: a direction, a point, or how a body is turned."""
    readings: list[str]
    """The joints and inputs that it depends on."""
    shown: list[str]
    """The numbers that it shows, one to three: ``x``, ``y``, ``z``; or ``azimuth``, ``elevation``. The first axis of arrays."""
    units: list[str]
    """The unit of each: ``rad``, ``m``, or ``1`` for components of directions."""


class ClosedForm:
    """The closed form of an observable's error: a component for each number that it shows.

    ``names`` says which they are, ``text`` has the plain syntax of amounts, ``latex`` the printed symbols, :meth:`sympy`
    expressions.
    """

    def __init__(self, native: _native.ClosedForm):
        self._native = native

    def __reduce__(self):
        fields = ["title", "names", "printed", "text", "latex", "steps"]
        return type(self), (SimpleNamespace(**{field: getattr(self._native, field) for field in fields}),)

    @property
    def title(self) -> str:
        """What it is, in words."""
        return self._native.title

    @property
    def names(self) -> list[str]:
        """The names of the components: ``pointing_x``, or ``sky_azimuth``."""
        return list(self._native.names)

    @property
    def text(self) -> list[str]:
        """The components in the plain syntax of amounts."""
        return list(self._native.text)

    @property
    def latex(self) -> list[str]:
        """The components in LaTeX."""
        return list(self._native.latex)

    def sympy(self) -> list[sympy.Expr]:
        """The components as SymPy expressions; each name is a real symbol."""
        from ._formula import expression

        return [expression(steps) for steps in self._native.steps]

    def __repr__(self) -> str:
        text, _ = self._native.printed
        return f"{self.title}\n{text}".rstrip("\n")

    def _repr_latex_(self) -> str:
        _, latex = self._native.printed
        return f"$${latex}$$"


class Chain(OverArrays):
    """A declared chain; read one with :meth:`from_text` or :meth:`from_file`.

    Evaluations hold no lock of the interpreter: several threads may use one chain at once. Arrays must be contiguous and
    of float64; they are read in place, so nobody may write to them meanwhile.
    """

    def __init__(self, native: _native.Chain):
        self._native = native
        self._compiled = None

    @classmethod
    def from_text(cls, text: str, name: str = "declaration") -> Chain:
        """Reads a declaration. Mistakes in it are shown under ``name``. Where a constant has no value, :meth:`closed_form` and
        :meth:`identify` have it as a symbol, and what needs numbers refuses it.

        :raises MistakeError: with every mistake of the text.
        """
        return cls(_native.Chain.from_text(text_of("text", text), text_of("name", name)))

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Chain:
        """Reads a ``.chain`` file, as :meth:`from_text` reads a text.

        :raises MistakeError: with every mistake of the file.
        :raises TrueaxisError: the file cannot be read.
        """
        return cls(_native.Chain.from_file(path_of("path", path)))

    def __reduce__(self):
        return type(self).from_text, (self.text, self._native.origin)

    def __repr__(self) -> str:
        shown = ", ".join(observable.name for observable in self.observables)
        return f"<trueaxis.Chain {self.name}: {len(self.errors)} errors; observables {shown}>"

    def _repr_html_(self) -> str:
        import html

        return f"<pre>{html.escape(self.text)}</pre>"

    @property
    def name(self) -> str:
        """The chain's name."""
        return self._native.name

    @property
    def text(self) -> str:
        """The declaration as written."""
        return self._native.text

    @property
    def symbols(self) -> list[Symbol]:
        """Every declared name with its kind and unit."""
        return [Symbol(*symbol) for symbol in self._native.symbols]

    def _of_kind(self, kind: str) -> list[str]:
        return [symbol.name for symbol in self.symbols if symbol.kind == kind]

    @property
    def joints(self) -> list[str]:
        """Names of the joints, in order."""
        return self._of_kind("joint")

    @property
    def inputs(self) -> list[str]:
        """Names of the measured side quantities, in order."""
        return self._of_kind("input")

    @property
    def errors(self) -> list[str]:
        """Names of the errors, in order: the columns of Jacobians."""
        return self._of_kind("error")

    @property
    def constants(self) -> list[str]:
        """Names of the constants, in order."""
        return self._of_kind("constant")

    @property
    def observables(self) -> list[Observable]:
        """What the instrument shows."""
        def observable(name, kind, readings, shown):
            return Observable(name, kind, readings, [word for word, _ in shown], [unit for _, unit in shown])

        return [observable(*declared) for declared in self._native.observables]

    def generate(
        self,
        language: Literal["rust", "c", "cpp", "latex", "numpy", "javascript", "matlab", "jax"],
        observables: str | Iterable[str] | None = None,
    ) -> dict[str, str]:
        """Evaluators in another language, as ``trueaxis generate`` writes them: functions for the value, the exact error, the
        first-order error and both Jacobians, for one pose and for arrays of poses; rad and m.

        :param observables: which; every one where none is given.
        :returns: the text of each file by its ending: ``{"c": ..., "h": ...}``. C and C++ include their headers by the chain's name,
            ``MobileLidar`` as ``mobile_lidar.h``; the file of MATLAB is called so, too.
        """
        return dict(self._native.generate(text_of("language", language), names(observables)))

    def compiled(
        self, observable: str | None = None, *, compiler: str | os.PathLike[str] | None = None
    ) -> Compiled:
        """The same evaluations of one observable by C that is generated, compiled and loaded now: about three times as fast.

        It takes some seconds, and what was loaded stays in memory until the process ends: compile once. Linux and macOS.

        :param observable: which, where the chain declares several.
        :param compiler: a C compiler; ``$CC`` where none is given, else the first of ``cc``, ``gcc`` and ``clang`` that there is.
        :raises TrueaxisError: there is no compiler, or it fails; another system.
        """
        return Compiled(self, observable, compiler)

    def closed_form(self, observable: str | None = None, order: int = 1) -> ClosedForm:
        """The closed form of an observable's error, up to products of ``order`` errors (1, 2 or 3)."""
        return ClosedForm(self._native.closed_form(observable_of(observable), whole("order", order, 32)))

    def identify(
        self, observables: str | Iterable[str] | None = None, *, candidate: str | None = None
    ) -> Answer:
        """What no data can tell apart: for each observable alone and all together, or for those named, together.

        :param candidate: an effect that the declaration lacks, ``"middle Rx(x*cos(beta))"``: which declared errors it would
            be mistaken for.
        :returns: ``answer["identifiability"]`` is a list with an entry a set of observables.
        """
        effect = None if candidate is None else text_of("candidate", candidate)
        return Answer._of(self._native.identify(names(observables), effect))

    def bound(
        self,
        sizes: Errors,
        observables: str | Iterable[str] | None = None,
        *,
        ranges: Ranges | None = None,
        seed: int = 1,
    ) -> Answer:
        """A proven bound on what the first-order form leaves out, while every error stays within its size.

        :param sizes: the largest size of each error, as ``errors`` of :meth:`exact`.
        :param ranges: of joints and inputs; joints without one make a full turn.
        :returns: ``answer["bounds"]`` is a list with an entry an observable: ``bound``, ``largest_found`` (a search's),
            ``unit``, ``shares``.
        """
        seed = whole("seed", seed, 64)
        return Answer._of(self._native.bound(errors_text(sizes), names(observables), _ranges(ranges), seed))

    def budget(
        self,
        sizes: Errors,
        observables: str | Iterable[str] | None = None,
        *,
        path: str | None = None,
        ranges: Ranges | None = None,
    ) -> Answer:
        """What each error alone does, and what all do together, over a path or over ranges.

        :param path: joints and inputs as functions of t over (0, 2π): ``"alpha=t, beta=t/2"``.
        :returns: ``answer["observables"]`` is a list with an entry an observable: ``errors`` (``sup`` and ``rms`` of each),
            ``worst_case``, ``root_sum_square``, ``unit``.
        """
        if path is not None and ranges:
            raise ValueError("give a path or ranges, not both")
        followed = None if path is None else text_of("path", path)
        return Answer._of(self._native.budget(errors_text(sizes), names(observables), followed, _ranges(ranges)))

    def simulate(
        self,
        errors: Errors,
        *,
        poses: int,
        noise: Amount | Iterable[Amount],
        seed: int,
        ranges: Ranges | None = None,
        observables: str | Iterable[str] | None = None,
    ) -> Table:
        """Measured data with normal noise, at joints drawn at random from their ranges (or a whole turn).

        :param noise: the standard deviation: ``"2 arcsec"`` of directions, ``"0.1 mm"`` of points; both where both are seen.
        :returns: a table of readings and of components of observables, rad and m.
        """
        poses, seed = whole("poses", poses, 32), whole("seed", seed, 64)
        noises = list(noise) if isinstance(noise, Iterable) and not isinstance(noise, str) else [noise]
        noises = [sigma if isinstance(sigma, str) else amount("noise", sigma) for sigma in noises]
        columns = self._native.simulate(
            errors_text(errors), poses, noises, seed, _ranges(ranges), names(observables)
        )
        return Table(dict(columns))

    def eval(
        self,
        table: Any,
        errors: Errors,
        observables: str | Iterable[str] | None = None,
        *,
        form: Literal["exact", "first-order"] = "exact",
        quantity: Literal["error", "value"] = "error",
    ) -> Any:
        """The error, or the value, of observables over a table of readings.

        :param table: a pandas, Polars or Arrow table, or a dictionary of columns, with columns named like joints and inputs;
            their names may carry units, ``"alpha [deg]"``. What speaks Arrow's stream of tables is read once, and becomes an Arrow
            table.
        :returns: the same kind of table (of a dictionary a :class:`Table`) with ``<observable>_x``, ``_y``, ``_z`` added, in SI, or
            the other numbers that an observable shows.
        """
        if form not in ("exact", "first-order"):
            raise ValueError(f'form: write "exact" or "first-order", not {form!r}')
        if quantity not in ("error", "value"):
            raise ValueError(f'quantity: write "error" or "value", not {quantity!r}')
        table = kept(table)
        added, replaced = self._native.over_table(
            ("the table", columns_of(table, self._native)),
            errors_text(errors),
            names(observables),
            form == "exact",
            quantity == "value",
        )
        return with_columns(table, dict(added), replaced)

    def apply(self, table: Any, errors: Errors, observables: str | Iterable[str] | None = None) -> Any:
        """New readings corrected with calibrated errors: where the instrument really points, or its points really are.

        Arguments and result as of :meth:`eval`. Rows outside of what the errors were found over are warned of, where that is known:
        by the ``[found-over]`` of a file of errors, and by the :attr:`Calibration.values` of a calibration.
        """
        table, known = kept(table), errors_and_ranges(errors)
        rows = ("the table", columns_of(table, self._native))
        added, replaced, counted = _native.apply(self._native, rows, known, names(observables))
        _native.warn_of_outside(self._native, known, [counted])
        return with_columns(table, dict(added), replaced)


def _ranges(given: Ranges | None) -> list[tuple[str, str]]:
    return ranges(given)


def require_chain(chain: Any) -> None:
    """Refuses what is no chain: the path of one, most likely."""
    if not isinstance(chain, Chain):
        raise TypeError(f"chain: give a trueaxis.Chain, as Chain.from_file reads one, not a {type(chain).__name__}")


def check(claims: str | os.PathLike[str]) -> Answer:
    """Checks the claims of a file: is the printed formula what the chain implies?

    :returns: ``answer["claims"]`` is a list with an entry a claim: ``name``, ``verdict`` (``"holds"``, ``"differs"``,
        ``"open"``), ``differences``.
    """
    return Answer._of(_native.check(path_of("claims", claims)))
