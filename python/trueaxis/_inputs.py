"""What users write in Python, as the texts that the library reads: errors, ranges, names."""

from __future__ import annotations

import functools
import json
import operator
import os
from collections.abc import Iterable, Mapping
from typing import Any, Union

import numpy as np

from . import _native
from ._errors import TrueaxisError

Amount = Union[float, str]
"""A number in SI, or a text with a unit: ``"10 arcsec"``."""
Errors = Union[Mapping[str, Amount], "os.PathLike[str]", str, None]
"""Errors by name or pattern (``{"da*": "2 arcsec"}``), or the path of a file of them."""


class Found(dict[str, float]):
    """Values of errors by name that data were fitted for; they know their units, and the ranges of readings that they came from."""

    units: dict[str, str]
    """The unit of each: ``rad``, ``m`` or ``1``."""
    over: list[tuple[str, float, float]]
    """Joints and inputs with the smallest and the largest reading, rad and m."""

    def __init__(self, values: Iterable[tuple[str, float]], units: dict[str, str], over: list[tuple[str, float, float]]):
        super().__init__(values)
        self.units, self.over = units, over

    def __reduce__(self):
        return type(self), (list(self.items()), self.units, self.over)

    def written(self, name: str, value: Any) -> str:
        """A value as TOML has it: with its unit, which nobody doubts, however large it is."""
        unit = self.units.get(name, "1")
        return amount(name, value) if unit == "1" or isinstance(value, str) else _quoted(f"{number_of(name, value)!r} {unit}")


def text_of(what: str, value: str) -> str:
    """A text as files have it."""
    if not isinstance(value, str):
        raise TypeError(f"{what}: write a text, not {value!r}")
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise TrueaxisError(f"{what}: the letter {value[error.start]!r} at {error.start} is none: was a file read in another encoding?") from None
    return value


def path_of(what: str, value: str | os.PathLike[str]) -> str:
    """A path as a text."""
    found = os.fspath(value) if isinstance(value, os.PathLike) else value
    if not isinstance(found, str):
        raise TypeError(f"{what}: give a path, as a text or a pathlib.Path, not a {type(value).__name__}")
    return found


def number_of(what: str, value: Any) -> float:
    """A number that may be a whole one of any size."""
    try:
        return float(value)
    except OverflowError:
        raise TrueaxisError(f"{what}: this whole number is larger than any that is calculated with: give one below 1.8e308") from None


def amount(what: str, value: Any) -> str:
    """An amount as TOML has it."""
    # Most are, and calls over few rows wait for nothing else.
    if type(value) is float:
        return repr(value)
    if isinstance(value, str):
        return _quoted(text_of(what, value))
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f'{what}: write a number in SI or a text with a unit, such as "2 arcsec", not {value!r}')
    return repr(number_of(what, value))


@functools.lru_cache(maxsize=1024)
def _quoted(text: str) -> str:
    # JSON's texts are TOML's, but for this one letter.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def errors_text(errors: Errors) -> tuple[str, str]:
    """The name and the text of a file of errors."""
    if errors is None:
        return "errors", ""
    if isinstance(errors, Mapping):
        written = errors.written if isinstance(errors, Found) else amount
        lines = [f"{_quoted(text_of('errors', str(name)))} = {written(str(name), value)}\n" for name, value in errors.items()]
        return "errors", "".join(lines)
    if isinstance(errors, (str, os.PathLike)):
        return os.fspath(errors), _native.read_text(os.fspath(errors))
    raise TypeError(
        f'errors: write a dictionary, {{"dtheta_y1": "10 arcsec"}}, or the path of a file, not {type(errors).__name__}'
    )


def errors_and_ranges(errors: Errors) -> tuple[str, str]:
    """The same with the ranges that the errors were found over, where they are known."""
    name, text = errors_text(errors)
    if isinstance(errors, Found) and errors.over:
        lines = [f"{amount('a name', reading)} = [{low!r}, {high!r}]\n" for reading, low, high in errors.over]
        text += "[found-over]\n" + "".join(lines)
    return name, text


def whole(what: str, value: int, bits: int) -> int:
    """A whole number that is not negative."""
    try:
        value = operator.index(value)
    except TypeError:
        raise TypeError(f"{what}: write a whole number, not {value!r}") from None
    if not 0 <= value < 2**bits:
        raise TrueaxisError(f"{what}={value}: write a whole number from 0 to {2**bits - 1}")
    return value


def observable_of(name: str | None) -> str | None:
    """The name of one observable, or none."""
    if name is not None and not isinstance(name, str):
        raise TypeError(f"observable: write one name, not {name!r}")
    return None if name is None else text_of("observable", name)


def names(one_or_more: str | Iterable[str] | None) -> list[str]:
    """Names of observables, or none."""
    if one_or_more is None:
        return []
    if isinstance(one_or_more, str):
        return [text_of("a name", one_or_more)]
    several = list(one_or_more) if isinstance(one_or_more, Iterable) else [one_or_more]
    odd = next((one for one in several if not isinstance(one, str)), None)
    if several and odd is not None:
        raise TypeError(f"write a name, or a list of names, not {odd!r}")
    return [text_of("a name", one) for one in several]


def ranges(given: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """Ranges by name: ``{"elevation": ("10 deg", "80 deg")}`` or ``{"elevation": "10 deg..80 deg"}``."""

    def text(name: str, bounds: Any) -> str:
        if isinstance(bounds, str):
            return bounds
        try:
            low, high = bounds
        except (TypeError, ValueError):
            raise TypeError(f'range of {name}: write ("10 deg", "80 deg"), not {bounds!r}') from None
        return "..".join(b if isinstance(b, str) else amount(f"range of {name}", b) for b in (low, high))

    if given is not None and not isinstance(given, Mapping):
        raise TypeError(f'ranges: write a dictionary, {{"elevation": ("10 deg", "80 deg")}}, not a {type(given).__name__}')
    return [(str(name), text(str(name), bounds)) for name, bounds in (given or {}).items()]
