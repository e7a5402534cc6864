"""A C compiler while Python runs: texts in, functions out."""

from __future__ import annotations

import ctypes
import os
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from ._errors import TrueaxisError

# Where a compiler takes the options below, and Python loads what comes out.
_SYSTEMS = ("linux", "darwin")
_USUAL = ("cc", "gcc", "clang")
# Sums and products are rounded as they stand, never by the compiler's choice. Only the entries are to be seen from outside:
# a function of the same name elsewhere in the process must not take the place of one of these.
# GCC's third level of optimisation adds nothing to vectors here but time.
_OPTIONS = ("-O2", "-ftree-vectorize", "-ffp-contract=off", "-std=c99", "-shared", "-fPIC", "-fvisibility=hidden")
_LINES_SHOWN = 20


def compile_and_load(
    files: Sequence[tuple[str, str]], compiler: str | os.PathLike[str] | None
) -> Callable[[str], ctypes._CFuncPtr]:
    """The functions of a library by their names.

    :param files: name and text of each; the first is compiled, and includes the others.
    :param compiler: as of :meth:`trueaxis.Chain.compiled`.
    """
    if sys.platform not in _SYSTEMS:
        raise TrueaxisError(
            f"chains are compiled on Linux and macOS, not on {sys.platform}: use the chain's own methods, which give the same numbers"
        )
    command = _command(compiler)
    with tempfile.TemporaryDirectory(prefix="trueaxis-") as folder:
        for name, text in files:
            Path(folder, name).write_text(text, encoding="utf-8")
        source, library = Path(folder, files[0][0]), Path(folder, "chain.so")
        _compile([*command, *_OPTIONS, "-o", str(library), str(source)], command)
        # The library outlives its file: the system keeps what is loaded.
        return _load(library, command)


def _command(compiler: str | os.PathLike[str] | None) -> list[str]:
    """The compiler with the options that belong to its name, as in ``CC="ccache gcc"``."""
    if compiler is not None:
        return _words("compiler", os.fspath(compiler))
    from_environment = os.environ.get("CC", "").strip()
    if from_environment:
        return _words("$CC", from_environment)
    for name in _USUAL:
        found = shutil.which(name)
        if found:
            return [found]
    raise TrueaxisError(
        f"there is no C compiler: none of {', '.join(_USUAL)} is on the path; install one, or name it by compiler= or $CC"
    )


def _words(origin: str, text: str) -> list[str]:
    # A path with blanks in it is one word.
    whole = shutil.which(text)
    if whole:
        return [whole]
    try:
        words = shlex.split(text)
    except ValueError:
        words = []
    found = shutil.which(words[0]) if words else None
    if not found:
        raise TrueaxisError(f"{origin}: there is no C compiler `{text}`; give the name or the path of a program")
    return [found, *words[1:]]


def _compile(arguments: list[str], command: list[str]) -> None:
    shown = shlex.join(command)
    try:
        done = subprocess.run(
            arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False
        )
    except OSError as error:
        raise TrueaxisError(f"cannot run the C compiler `{shown}`: {error.strerror or error}") from None
    if done.returncode != 0:
        said = done.stdout.decode("utf-8", errors="replace").strip().splitlines()[:_LINES_SHOWN]
        how = f"ended with {done.returncode}" if done.returncode > 0 else f"was ended by signal {-done.returncode}"
        raise TrueaxisError("\n".join([f"the C compiler `{shown}` {how}" + (":" if said else ""), *said]))


def _load(path: Path, command: list[str]) -> Callable[[str], ctypes._CFuncPtr]:
    shown = shlex.join(command)
    if not path.exists():
        raise TrueaxisError(f"the C compiler `{shown}` wrote no library; is it one?")
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise TrueaxisError(
            f"what the C compiler `{shown}` wrote cannot be loaded: {error}; it must be made for this Python's processor, and "
            "the folder for temporary files ($TMPDIR) must allow programs"
        ) from None

    def function(name: str) -> ctypes._CFuncPtr:
        try:
            return library[name]
        except AttributeError:
            raise TrueaxisError(f"what the C compiler `{shown}` wrote has no function `{name}`") from None

    return function
