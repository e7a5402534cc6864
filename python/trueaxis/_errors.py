"""What is wrong, as exceptions, in the words of the command; and what is doubtful, as warnings."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple

_KEPT: ContextVar[list[str] | None] = ContextVar("trueaxis-warnings", default=None)


class Mistake(NamedTuple):
    """One mistake in a text that a person wrote."""

    line: int
    """Line of its first character, from 1."""
    column: int
    """Column of its first character, from 1."""
    message: str
    """What is wrong."""
    help: str | None
    """What to write instead."""


class TrueaxisError(ValueError):
    """Something to mend: the text says what is wrong, where, and what to write instead."""


class MistakeError(TrueaxisError):
    """Mistakes in a declaration, a study, a claims file or a file of errors, each with its place.

    ``str(error)`` shows them below the lines that they stand on; ``error.mistakes`` lists them for programs.
    """

    def __init__(self, rendered: str, mistakes: list[tuple[int, int, str, str | None]] = []):
        super().__init__(rendered)
        self.mistakes: list[Mistake] = [Mistake(*mistake) for mistake in mistakes]

    def __reduce__(self):
        return type(self), (self.args[0], [tuple(mistake) for mistake in self.mistakes])


class TrueaxisWarning(UserWarning):
    """Something doubtful that the command would warn of: a bare number that can hardly be in SI, say."""


@contextmanager
def kept_warnings() -> Iterator[list[str]]:
    """Keeps what is warned of on this thread meanwhile, for whoever has a line to warn at."""
    kept: list[str] = []
    token = _KEPT.set(kept)
    try:
        yield kept
    finally:
        _KEPT.reset(token)


def warn(text: str) -> None:
    """Warns at the line of the caller's own program that called the package."""
    kept = _KEPT.get()
    if kept is not None:
        kept.append(text)
        return
    package = __name__.partition(".")[0]
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == package:
        frame, level = frame.f_back, level + 1
    warnings.warn(text, TrueaxisWarning, stacklevel=level)
