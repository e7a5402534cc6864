"""The declared errors from more rows than memory holds: file by file, in this process or on a Dask cluster."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._chain import Chain, require_chain
from ._drawn import counted, rows_drawn
from ._errors import TrueaxisError, warn
from ._files import batches, files_of, kind_of, told_by_file
from ._inputs import Found, path_of, text_of
from ._tables import Columns, Table, columns_of
from ._workers import Each, require_version, workers

if TYPE_CHECKING:
    import distributed

_START_ROWS = 100_000
"""Rows of all files that the fit begins with, about."""
_MOST = 0.75
"""Where a smaller share of the rows counts, something is wrong with the others."""


class Fit:
    """What a fit found: the declared errors, and nothing of what the declaration lacks."""

    def __init__(self, found: dict[str, Any]):
        self._found = found

    @property
    def errors(self) -> Table:
        """A row an error: ``name``, ``value``, ``standard_uncertainty``, ``unit`` (SI), ``separable``: whether the data tell it from
        the others. Where they do not, its uncertainty is NaN."""
        rows = self._found["errors"]
        keys = ["name", "value", "standard_uncertainty", "unit", "separable"]
        columns = {key: [np.nan if row[key] is None else row[key] for row in rows] for key in keys}
        return Table({key: np.array(cells) if key in keys[1:3] else cells for key, cells in columns.items()})

    @property
    def values(self) -> dict[str, float]:
        """The value of every error by name, in SI: ``errors`` of the methods of a chain."""
        return Found(self._found["values"].items(), self._found["units"], [])

    @property
    def rms(self) -> float:
        """RMS of the residuals' lengths over the rows kept, rad or m."""
        return self._found["rms"]

    @property
    def noise(self) -> list[float]:
        """Standard deviation of each component, rad or m, or a factor on what the data state."""
        return self._found["noise"]

    @property
    def shared_by_files(self) -> dict[str, float] | None:
        """Where rows of a file share errors, how much: ``ratio``, the variance of what the files say of the estimates over what their rows
        explain, ``p_value`` and ``files``. The ± then come from whole files. None where they do not, or fewer than three files are there."""
        return self._found["shared_by_files"]

    @property
    def rank(self) -> int:
        """How many independent combinations of errors the data determine."""
        return self._found["rank"]

    @property
    def rows(self) -> int:
        """How many rows were read."""
        return self._found["rows"]

    @property
    def rows_kept(self) -> int:
        """How many of them have any weight; the others are outliers."""
        return self._found["rows_kept"]

    @property
    def passes(self) -> int:
        """How often all rows were read."""
        return self._found["passes"]

    @property
    def converged(self) -> bool:
        """Whether the last step was negligible: if not, the estimates are none."""
        return self._found["converged"]

    def __repr__(self) -> str:
        ended = f"after {self.passes} passes" if self.converged else f"not converged after {self.passes} passes"
        lines = [f"{self.rows} rows, {self.rows_kept} kept, {ended}; rms {self.rms:.4g}"]
        if self.shared_by_files is not None:
            ratio = self.shared_by_files["ratio"]
            lines.append(f"rows of a file share errors ({ratio:.3g} times the variance of independent rows): ± from whole files")
        errors = self.errors
        width = max(len(name) for name in errors["name"])
        for name, value, uncertainty, unit in zip(*(errors[key] for key in list(errors)[:4])):
            known = "not told from others" if np.isnan(uncertainty) else f"± {uncertainty:.1e} {unit}"
            lines.append(f"{name:{width}} {value: .6e} {known}")
        return "\n".join(lines)


def fit(
    study: str | os.PathLike[str],
    data: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    *,
    text: str | None = None,
    chain: Chain | None = None,
    client: distributed.Client | str | None = None,
    progress: Callable[[int, int, int], object] | None = None,
) -> Fit:
    """Estimates the declared errors from a folder of files, which is read again for each of some passes; memory is that of a
    chunk a processor. It looks for no effects that the declaration lacks, nor for noise that remembers or changes: for
    these, :func:`calibrate` the same folder.

    :param study: the path of the study file. The files stand for the one table that it names.
    :param data: a folder of ``.parquet`` or ``.csv`` files, one file, or a list of files. A file
        without rows counts for nothing. Hidden files of a folder are left out; what else is not read is warned of.
    :param text: the text of the study, where it is no file.
    :param chain: a declaration that stands for the one that the study names.
    :param client: a Dask client, or the address of a scheduler: its workers read a file each, and must see the same files. If a
        worker dies, others read its files again. Without one, the processors of this machine do it. The answer has the same
        bits either way.
    :param progress: called with the number of the pass, how many files are done in it, and of how many.
    :raises MistakeError: mistakes in the study or the declaration.
    :raises TrueaxisError: a file that cannot be read, a worker of another version, a scheduler that does not answer; each by name.
    """
    if chain is not None:
        require_chain(chain)
    texts = (path_of("study", study), None if text is None else text_of("text", text))
    files = [str(file) for file in files_of(data, [".parquet", ".csv"])]
    declaration = None if chain is None else (chain._native.origin, chain.text)
    with workers(client) as each:
        # Files of separated values are read where the fit is; of both kinds together Parquet files say where it begins, if they can.
        separated = [file for file in files if kind_of(file) != ".parquet"]
        rows_of = counted(each, [file for file in files if file not in separated])
        if rows_of or not separated:
            fitting = _started(each, texts, declaration, rows_of)
        else:
            fitting = _native.Fitting.of_files(texts, declaration, separated, _START_ROWS)
        found = of_files(fitting, files, each, progress)
    if found.converged and found.rows_kept < _MOST * found.rows:
        warn(
            f"{found.rows - found.rows_kept} of {found.rows} rows count for nothing: they are far from what the others say; "
            "are units, signs and time stamps of every file right?"
        )
    return found


def of_files(fitting: _native.Fitting, files: list[str], each: Each, progress: Callable[[int, int, int], object] | None) -> Fit:
    """Makes every pass of a fit over files."""
    texts = fitting.texts
    number = 0
    while (step := fitting.step()) is not None:
        number += 1
        tasks = [(file, *texts, step, _native.__version__) for file in files]
        tallies: dict[str, list[bytes]] = {}
        for file, of_file in each(_accumulate_file, tasks):
            tallies[file] = of_file
            if progress is not None:
                progress(number, len(tallies), len(files))
        if number == 1:
            _tell_of_copies(files, tallies)
        fitting.take([tallies[file] for file in files])
    return Fit(json.loads(fitting.found()))


def _tell_of_copies(files: list[str], tallies: dict[str, list[bytes]]) -> None:
    """Warns of files that say the same to the last bit, as only the same rows do."""
    known: dict[tuple[bytes, ...], str] = {}
    for file in files:
        said = tuple(tallies[file])
        if said and (of := known.setdefault(said, file)) != file:
            warn(f"`{file}` has the rows of `{of}`, which count twice: the ± are too small; leave the copy out")


def of_table(fitting: _native.Fitting, rows: tuple[str, Columns]) -> Fit:
    """Makes every pass of a fit over rows in memory."""
    texts = fitting.texts
    while (step := fitting.step()) is not None:
        tally = _native.accumulate(*texts, rows, step)
        fitting.take([[] if tally is None else [tally]])
    return Fit(json.loads(fitting.found()))


def _started(
    each: Each, texts: tuple[str, str | None], declaration: tuple[str, str] | None, rows_of: dict[str, int]
) -> _native.Fitting:
    """A fit from rows of all files: where it begins, no file says more than another."""
    if not rows_of:
        raise TrueaxisError("there are no rows in any file")
    stretches = _native.stretches(list(rows_of.values()), _START_ROWS, 1)
    drawn = rows_drawn(each, list(rows_of), stretches)
    name = f"rows of {len(rows_of)} files"
    with drawn.explained(name):
        return _native.Fitting(texts, declaration, (name, drawn.columns))


def _accumulate_file(task: tuple) -> tuple[str, list[bytes]]:
    """What each chunk of a file says in a pass: nothing where there are no rows."""
    file, study, chain, step, version = task
    require_version(version)
    tallies = []
    for first, columns in chunks(file):
        with told_by_file(file, lambda row: (file, first + row)):
            tallies.append(_native.accumulate(study, chain, (file, columns), step))
    return file, [tally for tally in tallies if tally is not None]


def chunks(file: str) -> Iterator[tuple[int, Columns | None]]:
    """The rows of a file chunk by chunk, each with the number of rows before it; a file of separated values as one, which is not read
    here."""
    if kind_of(file) != ".parquet":
        yield 0, None
        return
    for first, batch in batches(file):
        yield first, columns_of(batch)
