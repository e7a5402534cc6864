"""Calibrations of folders: the search in rows drawn from all files, the estimates from every row, and the error before and after on
the rows that were not drawn."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._calibration import Calibration
from ._chain import Chain
from ._cluster import Each, batches, files_of, opened, place_of, require_version, workers
from ._errors import TrueaxisError
from ._fit import of_files, of_table
from ._inputs import errors_text
from ._tables import Columns, columns_of

if TYPE_CHECKING:
    import distributed

Stretch = tuple[int, int]
"""The first row of a stretch of a file, and the first behind it."""


def calibrate_folder(
    study: str | os.PathLike[str],
    data: Any,
    text: str | None,
    chain: Chain | None,
    client: distributed.Client | str | None,
    search_rows: int,
    seed: int,
    progress: Callable[[str], object] | None,
) -> Calibration:
    """Calibrates a folder of Parquet files; what it is asked for is said at :func:`trueaxis.calibrate`."""
    if search_rows < 1:
        raise TrueaxisError(f"search_rows={search_rows}: the search needs rows to read")
    tell = progress or (lambda _: None)
    files = [str(file) for file in files_of(data, [".parquet"])]
    resolved = _native.Study(os.fspath(study), text, None if chain is None else chain._native)
    if len(resolved.tables) != 1:
        listed = ", ".join(f"`{name}`" for name in resolved.tables)
        raise TrueaxisError(f"the files of a folder stand for the one table that a study names; this one names {listed}")
    with workers(client) as each:
        of_file = dict(each(_count, [(file, _native.__version__) for file in files]))
        rows = sum(of_file.values())
        stretches = _native.stretches([of_file[file] for file in files], search_rows, seed)
        drawn = sum(end - start for own in stretches for start, end in own)
        tell(f"drawing {drawn:,} of {rows:,} rows from {len(files)} files")
        sample, lacking = _drawn(each, files, stretches)
        table = (f"{drawn} of {rows} rows, drawn from {len(files)} files", sample)
        command = f"trueaxis.calibrate({os.fspath(study)!r}, {os.fspath(os.path.dirname(files[0]))!r})"
        texts = (os.fspath(study), text)
        declaration = None if chain is None else (chain._native.origin, chain.text)
        # What a fit of every row refuses is refused before the search.
        before = None if drawn == rows else _native.Fitting(texts, declaration, table)
        try:
            native = _native.calibrate(resolved, [(resolved.tables[0], sample)], command, progress)
        except TrueaxisError as error:
            if lacking and any(f"`{name}`" in str(error) for name in lacking):
                told = ", ".join(f"`{name}` ({file})" for name, file in lacking.items())
                raise TrueaxisError(f"{error}\nColumns that not every file has: {told}") from None
            raise
        found = Calibration(native)
        if before is None or found.amended is None:
            return found
        tell("fitting the declaration to the rows that were drawn, as it was and as amended")
        fitted, (studied, declared) = of_table(before, table), before.texts
        amended = ("amended.chain", found.amended)
        fitting = _native.Fitting(studied, amended, table)
        of_drawn = fitting.copy()
        after = of_table(of_drawn, table)
        sums = None
        if fitted.converged and after.converged:
            judged = [(declared, errors_text(fitted.values)), (amended, errors_text(after.values))]
            tasks = [(file, own, studied, judged, after.noise, _native.__version__) for file, own in zip(files, stretches)]
            sums = _judged(each, tasks, tell)
        of_files(fitting, files, each, lambda number, done, of: tell(f"fitting every row, pass {number}: {done} of {of} files"))
        fitting.complete(native, of_drawn, len(files), sums)
        return Calibration(native)


def _count(task: tuple) -> tuple[str, int]:
    """How many rows a file has."""
    file, version = task
    require_version(version)
    with opened(file) as parquet:
        rows = parquet.metadata.num_rows
    if rows == 0:
        raise TrueaxisError(f"{file}: there are no rows")
    return file, rows


def _drawn(each: Each, files: list[str], stretches: list[list[Stretch]]) -> tuple[Columns, dict[str, str]]:
    """The rows of all stretches, in the order of the files: the columns that all files have; and others, each with a file that lacks it."""
    tasks = [(file, own) for file, own in zip(files, stretches) if own]
    parts = dict(each(_draw, tasks))
    tables = [(file, dict(parts[file])) for file, _ in tasks]
    lacking: dict[str, str] = {}
    for file, table in tables:
        for _, other in tables:
            lacking.update({name: file for name in other if name not in table and name not in lacking})
    columns: Columns = []
    for name in tables[0][1]:
        if name in lacking:
            continue
        own = [(file, table[name]) for file, table in tables]
        numbers = [isinstance(column, np.ndarray) for _, column in own]
        if all(numbers):
            columns.append((name, np.concatenate([column for _, column in own])))
        elif any(numbers):
            odd = own[numbers.index(not numbers[0])][0]
            raise TrueaxisError(f"{odd}: column `{name}` holds {'texts' if numbers[0] else 'numbers'}, in {own[0][0]} it does not")
        else:
            columns.append((name, [cell for _, column in own for cell in column]))
    return columns, lacking


def _draw(task: tuple) -> tuple[str, Columns]:
    """The rows of some stretches of a file."""
    file, stretches = task
    import pyarrow

    parts = []
    for first, batch in batches(file):
        for start, end in stretches:
            start, end = max(start, first) - first, min(end, first + batch.num_rows) - first
            if start < end:
                parts.append(batch.slice(start, end - start))
    return file, columns_of(pyarrow.concat_tables(parts))


def _judged(each: Each, tasks: list[tuple], tell: Callable[[str], object]) -> tuple:
    """The sums of all files, added in their order."""
    of_file: dict[str, np.ndarray] = {}
    for file, sums in each(_judge_file, tasks):
        of_file[file] = sums
        tell(f"judging the rows that were not drawn: {len(of_file)} of {len(tasks)} files")
    rows, kept, *squares = np.sum([of_file[task[0]] for task in tasks], axis=0).tolist()
    return int(rows), int(kept), squares[:2], squares[2:]


def _judge_file(task: tuple) -> tuple[str, np.ndarray]:
    """Sums over the rows of a file outside of some stretches."""
    file, stretches, study, (before, after), noise, version = task
    require_version(version)
    sums = np.zeros(6)
    for first, batch in batches(file):
        outside = np.ones(batch.num_rows, dtype=bool)
        for start, end in stretches:
            outside[max(start - first, 0) : max(end - first, 0)] = False
        if outside.any():
            rows = (place_of(file, first), columns_of(batch.filter(outside)))
            count, kept, squares, squares_kept = _native.validate(study, before, after, rows, noise)
            sums += [count, kept, *squares, *squares_kept]
    return file, sums
