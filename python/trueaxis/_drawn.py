"""Rows that are drawn from Parquet files, evenly from all."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from . import _native
from ._errors import MistakeError, TrueaxisError
from ._files import batches, opened, told_by_file
from ._tables import Column, Columns, Other, column_of
from ._workers import Each, require_version

if TYPE_CHECKING:
    import pyarrow

Stretch = tuple[int, int]
"""The first row of a stretch of a file, and the first behind it."""


class Drawn(NamedTuple):
    """Rows of files as one table."""

    columns: Columns
    """The columns that all files have alike."""
    unusable: dict[str, str]
    """Why others are left out, by their names."""
    stretches: list[tuple[str, Stretch]]
    """Where the rows came from, in their order."""

    @contextmanager
    def explained(self, name: str) -> Iterator[None]:
        """Tells what is wrong with this table, by that name, by the files that its rows came from: with a row by its place there, with a
        column by why it could not be drawn."""
        try:
            with told_by_file(name, self._place_of):
                yield
        except MistakeError:
            raise
        except TrueaxisError as error:
            why = [told for column, told in self.unusable.items() if f"`{column}`" in str(error)]
            raise TrueaxisError("\n".join([*why, str(error)])) from None

    def _place_of(self, row: int) -> tuple[str, int]:
        left = row
        for file, (start, end) in self.stretches:
            if left <= end - start:
                return file, start + left
            left -= end - start
        raise IndexError(f"row {row} was not drawn")


def counted(each: Each, files: list[str]) -> dict[str, int]:
    """How many rows each Parquet file has that has any, in their order."""
    of_file = dict(each(_count, [(file, _native.__version__) for file in files]))
    return {file: of_file[file] for file in files if of_file[file]}


def _count(task: tuple) -> tuple[str, int]:
    """How many rows a file has."""
    file, version = task
    require_version(version)
    with opened(file) as parquet:
        return file, parquet.metadata.num_rows


def rows_drawn(each: Each, files: list[str], stretches: list[list[Stretch]]) -> Drawn:
    """The rows of all stretches, in the order of the files."""
    tasks = [(file, own) for file, own in zip(files, stretches) if own]
    parts = dict(each(_draw, tasks))
    columns: Columns = []
    unusable: dict[str, str] = {}
    for name in dict.fromkeys(name for file, _ in tasks for name in parts[file].column_names):
        how_often = {file: parts[file].column_names.count(name) for file, _ in tasks}
        odd = next((file for file, often in how_often.items() if often != 1), None)
        if odd is not None:
            unusable[name] = f"{odd}: column `{name}` is " + ("there twice" if how_often[odd] else "not there, as it is in other files")
            continue
        try:
            columns.append((name, _joined(name, {file: parts[file].select([name]) for file, _ in tasks})))
        except TypeError as error:
            unusable[name] = str(error)
    return Drawn(columns, unusable, [(file, stretch) for file, own in tasks for stretch in own])


def _joined(name: str, parts: dict[str, pyarrow.Table]) -> Column:
    """One column of all files. What it holds is decided by all of them: nothing in one file goes with anything in others."""
    import pyarrow

    try:
        whole_column = pyarrow.concat_tables(parts.values(), promote_options="permissive")
        return column_of(name, whole_column.column(name))
    except pyarrow.ArrowException:
        pass
    # Types that Arrow does not join may be alike as what they are read as.
    columns = {file: column_of(name, part.column(name)) for file, part in parts.items()}
    first, *_ = columns
    other = next(((file, column) for file, column in columns.items() if isinstance(column, Other)), None)
    if other is not None:
        file, column = other
        raise TypeError(f"{file}: column `{name}` {column.why}")
    is_number = {file: isinstance(column, np.ndarray) for file, column in columns.items()}
    odd = next((file for file, is_one in is_number.items() if is_one != is_number[first]), None)
    if odd is not None:
        raise TypeError(f"{odd}: column `{name}` holds {'numbers' if is_number[odd] else 'texts'}, in {first} it does not")
    if is_number[first]:
        return np.concatenate(list(columns.values()))
    return [cell for column in columns.values() for cell in column]


def _draw(task: tuple) -> tuple[str, pyarrow.Table]:
    """The rows of some stretches of a file."""
    file, stretches = task
    import pyarrow

    parts = []
    for first, batch in batches(file):
        for start, end in stretches:
            start, end = max(start, first) - first, min(end, first + batch.num_rows) - first
            if start < end:
                parts.append(batch.slice(start, end - start))
    return file, pyarrow.concat_tables(parts)
