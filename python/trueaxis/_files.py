"""Files of rows: which a folder is made of, and Parquet files chunk by chunk."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._errors import MistakeError, TrueaxisError, warn
from ._inputs import path_of
from ._tables import is_frame

if TYPE_CHECKING:
    import pyarrow

ROWS = 1 << 18
"""Rows that are in memory at a time, a file."""
_NAMED = 5
"""How many files are named that are not read."""


def files_of(source: Any, kinds: list[str], *, told_apart: bool = False) -> list[Path]:
    """The files of one kind of a folder, one file, or the files of a list: as absolute paths, each once; where they are to be told apart by
    their names, no two of one name."""
    if isinstance(source, (str, os.PathLike)):
        path = Path(source)
        files = _files_in(path, kinds) if path.is_dir() else [path]
    else:
        if is_frame(source) or isinstance(source, bytes) or not isinstance(source, Iterable):
            instead = "; Chain.apply and calibrate take tables in memory" if is_frame(source) else ""
            raise TypeError(f"files: give a folder, a path or a list of paths, not a {type(source).__name__}{instead}")
        files = [Path(path_of("files", file)) for file in source]
        if not files:
            raise TrueaxisError("no files are given")
    seen: set[Path] = set()
    names: set[str] = set()
    for file in files:
        if not file.is_file():
            why = "it is a folder; list the files in it" if file.is_dir() else "there is no such file"
            raise TrueaxisError(f"cannot read `{file}`: {why}")
        # A link, or a way with `..` in it, is another name of the same file.
        if file.resolve() in seen:
            raise TrueaxisError(f"`{file}` is given twice")
        if told_apart and file.name in names:
            raise TrueaxisError(f"two files are named `{file.name}`: what came of them could not be told apart")
        seen.add(file.resolve())
        names.add(file.name)
    return [file.absolute() for file in files]


def kind_of(file: str | Path) -> str:
    """The ending that says what a file is: ``.parquet``, ``.csv``, …"""
    ending = Path(file).suffix.lower()
    return ".parquet" if ending == ".pq" else ending


def _files_in(folder: Path, kinds: list[str]) -> list[Path]:
    """The files of the one kind that a folder holds; warns of what else is in it. What a name hides is not looked at."""
    try:
        entries = sorted(entry for entry in folder.iterdir() if not entry.name.startswith((".", "_")))
    except OSError as error:
        raise TrueaxisError(f"cannot read `{folder}`: {error.strerror}") from None
    is_meant = {entry: kind_of(entry) in kinds and not entry.is_dir() for entry in entries}
    there = [kind for kind in kinds if any(is_meant[entry] and kind_of(entry) == kind for entry in entries)]
    if len(there) > 1:
        raise TrueaxisError(f"`{folder}` holds {' and '.join(there)} files: give a list of those that are meant")
    left = [f"`{entry.name}{'/' if entry.is_dir() else ''}`" for entry in entries if not is_meant[entry]]
    told = ", ".join(left[:_NAMED]) + (f" and {len(left) - _NAMED} more" if len(left) > _NAMED else "")
    if not there:
        held = f"; it holds {told}, which a list of files could name" if left else ""
        raise TrueaxisError(f"`{folder}`: there is no {' or '.join(kinds)} file in this folder{held}")
    if left:
        warn(f"`{folder}`: only its own {there[0]} files are read, not {told}; give a list of files where others are meant")
    return [entry for entry in entries if is_meant[entry]]


@contextmanager
def opened(file: str) -> Iterator[pyarrow.parquet.ParquetFile]:
    """A Parquet file; what is wrong with it is told by its name."""
    import pyarrow
    import pyarrow.parquet as parquet

    try:
        with parquet.ParquetFile(file) as open_file:
            yield open_file
    except (pyarrow.ArrowException, OSError) as error:
        raise TrueaxisError(f"{file}: {_no_parquet(file) or error}") from None


def _no_parquet(file: str) -> str | None:
    """What a file is, and what to do, that does not begin as a Parquet file."""
    try:
        with open(file, "rb") as open_file:
            first = open_file.read(4)
    except OSError:
        return None
    if first == b"PAR1":
        return None
    if first[:2] == b"\x1f\x8b":
        return "this is compressed with gzip, and Parquet files are read as they are: unpack it first, with `gunzip`"
    return "this is no Parquet file: write its rows as one (pandas.read_csv(...).to_parquet(...)), or give a data frame of them"


def batches(file: str) -> Iterator[tuple[int, pyarrow.Table]]:
    """The rows of a Parquet file chunk by chunk, each with the number of rows before it."""
    import pyarrow

    first = 0
    with opened(file) as open_file:
        for batch in open_file.iter_batches(batch_size=ROWS):
            if batch.num_rows == 0:
                continue
            yield first, pyarrow.Table.from_batches([batch])
            first += batch.num_rows


@contextmanager
def told_by_file(name: str, place_of: Callable[[int], tuple[str, int]]) -> Iterator[None]:
    """Tells what is wrong with a row of a table of that name by its file, and by its number there: ``place_of`` says both of a row. Rows are
    counted from 1."""
    try:
        yield
    except MistakeError:
        raise
    except TrueaxisError as error:
        row = re.match(rf"{re.escape(name)}: row (\d+)", str(error))
        if row is None:
            raise
        file, number = place_of(int(row[1]))
        raise TrueaxisError(f"{file}: row {number}{str(error)[row.end() :]}") from None
