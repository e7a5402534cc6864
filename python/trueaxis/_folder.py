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
from ._drawn import counted, rows_drawn
from ._errors import TrueaxisError
from ._files import batches, files_of, told_by_file
from ._fit import of_files, of_table
from ._inputs import errors_text, whole
from ._tables import columns_of
from ._workers import Each, require_version, workers

if TYPE_CHECKING:
    import distributed


def calibrate_folder(
    study: str,
    data: Any,
    text: str | None,
    chain: Chain | None,
    client: distributed.Client | str | None,
    search_rows: int,
    seed: int,
    progress: Callable[[str], object] | None,
) -> Calibration:
    """Calibrates a folder of Parquet files; what it is asked for is said at :func:`trueaxis.calibrate`."""
    if whole("search_rows", search_rows, 64) < 1:
        raise TrueaxisError(f"search_rows={search_rows}: the search needs rows to read")
    seed = whole("seed", seed, 64)
    tell = progress or (lambda _: None)
    files = [str(file) for file in files_of(data, [".parquet"])]
    resolved = _native.Study(study, text, None if chain is None else chain._native)
    if len(resolved.tables) != 1:
        listed = ", ".join(f"`{name}`" for name in resolved.tables)
        raise TrueaxisError(f"the files of a folder stand for the one table that a study names; this one names {listed}")
    with workers(client) as each:
        rows_of = counted(each, files)
        if not rows_of:
            raise TrueaxisError("there are no rows in any file")
        rows, files = sum(rows_of.values()), list(rows_of)
        stretches = _native.stretches(list(rows_of.values()), search_rows, seed)
        count = sum(end - start for own in stretches for start, end in own)
        tell(f"drawing {count:,} of {rows:,} rows from {len(files)} files")
        drawn = rows_drawn(each, files, stretches)
        name, named = f"{count} of {rows} rows, drawn from {len(files)} files", resolved.tables[0]
        table = (name, drawn.columns)
        command = f"trueaxis.calibrate({study!r}, {os.path.dirname(files[0])!r})"
        texts = (study, text)
        declaration = None if chain is None else (chain._native.origin, chain.text)
        # What a fit of every row refuses is refused before the search.
        with drawn.explained(name):
            before = None if count == rows else _native.Fitting(texts, declaration, table)
        with drawn.explained(named):
            native = _native.calibrate(resolved, [(named, drawn.columns)], command, progress)
        found = Calibration(native)
        if before is None or found.amended is None:
            return found
        tell("fitting the declaration to the rows that were drawn, as it was and as amended")
        amended = ("amended.chain", found.amended)
        with drawn.explained(name):
            fitted, (studied, declared) = of_table(before, table), before.texts
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
            numbers = first + 1 + np.flatnonzero(outside)
            rows = (file, columns_of(batch.filter(outside)))
            with told_by_file(file, lambda row: (file, int(numbers[row - 1]))):
                count, kept, squares, squares_kept = _native.validate(study, before, after, rows, noise)
            sums += [count, kept, *squares, *squares_kept]
    return file, sums
