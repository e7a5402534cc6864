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
from ._errors import MistakeError, TrueaxisError
from ._files import batches, files_of, opened, place_of
from ._fit import of_files, of_table
from ._inputs import errors_text, whole
from ._tables import Columns, column_of, columns_of
from ._workers import Each, require_version, workers

if TYPE_CHECKING:
    import distributed
    import pyarrow

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
    seed = whole("seed", seed, 64)
    tell = progress or (lambda _: None)
    files = [str(file) for file in files_of(data, [".parquet"])]
    resolved = _native.Study(os.fspath(study), text, None if chain is None else chain._native)
    if len(resolved.tables) != 1:
        listed = ", ".join(f"`{name}`" for name in resolved.tables)
        raise TrueaxisError(f"the files of a folder stand for the one table that a study names; this one names {listed}")
    with workers(client) as each:
        of_file = dict(each(_count, [(file, _native.__version__) for file in files]))
        rows = sum(of_file.values())
        files = [file for file in files if of_file[file]]
        if not files:
            raise TrueaxisError("there are no rows in any file")
        stretches = _native.stretches([of_file[file] for file in files], search_rows, seed)
        drawn = sum(end - start for own in stretches for start, end in own)
        tell(f"drawing {drawn:,} of {rows:,} rows from {len(files)} files")
        sample, unusable = _drawn(each, files, stretches)
        table = (f"{drawn} of {rows} rows, drawn from {len(files)} files", sample)
        command = f"trueaxis.calibrate({os.fspath(study)!r}, {os.fspath(os.path.dirname(files[0]))!r})"
        texts = (os.fspath(study), text)
        declaration = None if chain is None else (chain._native.origin, chain.text)
        try:
            # What a fit of every row refuses is refused before the search.
            before = None if drawn == rows else _native.Fitting(texts, declaration, [table])
            native = _native.calibrate(resolved, [(resolved.tables[0], sample)], command, progress)
        except MistakeError:
            raise
        except TrueaxisError as error:
            why = [told for name, told in unusable.items() if f"`{name}`" in str(error)]
            raise TrueaxisError("\n".join([*why, str(error)])) from None
        found = Calibration(native)
        if before is None or found.amended is None:
            return found
        tell("fitting the declaration to the rows that were drawn, as it was and as amended")
        fitted, (studied, declared) = of_table(before, table), before.texts
        amended = ("amended.chain", found.amended)
        fitting = _native.Fitting(studied, amended, [table])
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
        return file, parquet.metadata.num_rows


def _drawn(each: Each, files: list[str], stretches: list[list[Stretch]]) -> tuple[Columns, dict[str, str]]:
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


def _joined(name: str, parts: dict[str, pyarrow.Table]) -> np.ndarray | list[str]:
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
