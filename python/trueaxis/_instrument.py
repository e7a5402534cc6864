"""Instrument files: a calibrated instrument as one text, which stands where a chain and its errors stand."""

from __future__ import annotations

import os
from collections.abc import Iterable
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

from . import _native
from ._answers import Answer
from ._chain import Chain
from ._inputs import Found, path_of, text_of
from ._over_arrays import Readings
from ._tables import columns_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Instrument:
    """A calibrated instrument: its declaration with the values that a calibration found, as ``instrument.toml`` has them.

    Read one with :meth:`from_file` or :meth:`from_text`.
    """

    def __init__(self, native: _native.Instrument, text: str, name: str):
        self._native, self._text, self._name = native, text, name

    @classmethod
    def from_text(cls, text: str, name: str = "instrument.toml") -> Instrument:
        """Reads the text of an instrument file. Mistakes in it are shown under ``name``.

        :raises MistakeError: with every mistake of the text.
        :raises TrueaxisError: another kind of file, or one of a later version.
        """
        text, name = text_of("text", text), text_of("name", name)
        return cls(_native.Instrument.from_text(text, name), text, name)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Instrument:
        """Reads an ``instrument.toml``, as :meth:`from_text` reads a text.

        :raises TrueaxisError: the file cannot be read.
        """
        name = path_of("path", path)
        return cls.from_text(_native.read_text(name), name)

    def __reduce__(self):
        return type(self).from_text, (self._text, self._name)

    def __repr__(self) -> str:
        made = f", calibrated {self.made}" if self.made else ""
        return f"<trueaxis.Instrument {self.chain.name}: {len(self.values)} values{made}>"

    @cached_property
    def chain(self) -> Chain:
        """The declaration, with what the calibration found missing."""
        name, text = self._native.declaration
        return Chain.from_text(text, name)

    @cached_property
    def values(self) -> dict[str, float]:
        """The estimates of errors, and of constants that were fitted, by name, in SI: ``errors`` of the methods of :attr:`chain`."""
        values = self._native.values
        units = {name: unit for name, _, unit in values}
        return Found([(name, value) for name, value, _ in values], units, self._native.found_over)

    @property
    def made(self) -> str | None:
        """The day of the calibration, ``2026-11-21``, if the file says so."""
        return self._native.made

    @property
    def valid_until(self) -> str | None:
        """The last day on which it counts, if the file says so. After it, reading the file warns."""
        return self._native.valid_until

    def exact(
        self,
        readings: Readings,
        observable: str | None = None,
        *,
        quantity: Literal["error", "value"] = "value",
        out: NDArray[np.float64] | None = None,
        threads: int | None = None,
    ) -> NDArray[np.float64]:
        """What the instrument really shows at some readings, as :meth:`Chain.exact` with its values."""
        return self.chain.exact(readings, self.values, observable, quantity=quantity, out=out, threads=threads)

    def apply(self, table: Any, observables: str | Iterable[str] | None = None) -> Any:
        """New readings corrected, as :meth:`Chain.apply` with its values; warns of rows outside of what was measured."""
        return self.chain.apply(table, self.values, observables)

    def verify(self, table: Any, *, goal: str | None = None, false_alarm: float | None = None) -> Answer:
        """Whether the calibration is still valid, by some new measured rows; as ``trueaxis verify``.

        :param table: a table with the headings of the study that was calibrated. Ten rows suffice to ask.
        :param goal: the change of what is observed that matters, ``"5 arcsec"``; the noise of one observation where none is given.
        :param false_alarm: the chance of a wrong alarm; 0.05 where none is given.
        :returns: ``answer["verdict"]`` and the other keys of the command's JSON.
        """
        goal = None if goal is None else text_of("goal", goal)
        false_alarm = None if false_alarm is None else float(false_alarm)
        return Answer._of(self._native.verify(("the table", columns_of(table)), goal, false_alarm))


def compare(*instruments: Instrument) -> Answer:
    """What changed from the first of some calibrations of one instrument to the last; as ``trueaxis compare``.

    :raises TrueaxisError: fewer than two, or one that does not say how sure its values are.
    """
    for instrument in instruments:
        if not isinstance(instrument, Instrument):
            raise TypeError(f"compare: give a trueaxis.Instrument, as Instrument.from_file reads one, not a {type(instrument).__name__}")
    return Answer._of(_native.compare([(instrument._name, instrument._native) for instrument in instruments]))
