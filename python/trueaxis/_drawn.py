"""Rows that are drawn from Parquet files, evenly from all."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import _native
from ._errors import TrueaxisError
from ._files import batches, opened
from ._tables import Column, Columns, Other, column_of
from ._workers import Each, require_version

if TYPE_CHECKING:
    import pyarrow

Stretch = tuple[int, int]
"""The first row of a stretch of a file, and the first behind it."""


def counted(each: Each, files: list[str]) -> dict[str, int]:
    """How many rows each Parquet file has that has any, in their order."""
    of_file = dict(each(_count, [(file, _native.__version__) for file in files]))
    return {file: of_file[file] for file in files if of_file[file]}


def explained(error: TrueaxisError, unusable: dict[str, str]) -> TrueaxisError:
    """What is wrong with a study's columns, with why they could not be drawn."""
    why = [told for name, told in unusable.items() if f"`{name}`" in str(error)]
    return TrueaxisError("\n".join([*why, str(error)]))


def _count(task: tuple) -> tuple[str, int]:
    """How many rows a file has."""
    file, version = task
    require_version(version)
    with opened(file) as parquet:
        return file, parquet.metadata.num_rows


def rows_drawn(each: Each, files: list[str], stretches: list[list[Stretch]]) -> tuple[Columns, dict[str, str]]:
    """The rows of all stretches, in the order of the files: the columns that all files have alike; and by the names of others, why they are
    left out."""
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
    return columns, unusable


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
