"""The declared errors from more rows than memory holds: file by file, in this process or on a Dask cluster."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._chain import Chain
from ._cluster import ROWS, files_of, place_of, require_version, workers
from ._errors import TrueaxisError
from ._tables import Table, columns_of

if TYPE_CHECKING:
    import distributed


class Fit:
    """What a fit found: the declared errors, and nothing of what the declaration lacks."""

    def __init__(self, found: dict[str, Any]):
        self._found = found

    @property
    def errors(self) -> Table:
        """A row an error: ``name``, ``value``, ``standard_uncertainty``, ``unit`` (SI), ``separable``: whether the data tell it from
        the others."""
        rows = self._found["errors"]
        keys = ["name", "value", "standard_uncertainty", "unit", "separable"]
        columns = {key: [row[key] for row in rows] for key in keys}
        return Table({key: np.array(cells) if key in keys[1:3] else cells for key, cells in columns.items()})

    @property
    def values(self) -> dict[str, float]:
        """The value of every error by name, in SI: ``errors`` of the methods of a chain."""
        return self._found["values"]

    @property
    def rms(self) -> float:
        """RMS of the residuals' lengths over the rows kept, rad or m."""
        return self._found["rms"]

    @property
    def noise(self) -> list[float]:
        """Standard deviation of each component, rad or m, or a factor on what the data state."""
        return self._found["noise"]

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
        errors = self.errors
        width = max(len(name) for name in errors["name"])
        for name, value, uncertainty, unit in zip(*(errors[key] for key in list(errors)[:4])):
            lines.append(f"{name:{width}} {value: .6e} ± {uncertainty:.1e} {unit}")
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
    these, :func:`calibrate` a part of the rows.

    :param study: the path of the study file. The files stand for the one table that it names.
    :param data: a folder of ``.parquet`` or ``.csv`` files, one file, or a list of files. The first must have rows enough to start
        from.
    :param text: the text of the study, where it is no file.
    :param chain: a declaration that stands for the one that the study names.
    :param client: a Dask client, or the address of a scheduler: its workers read a file each, and must see the same files. If a
        worker dies, others read its files again. Without one, the processors of this machine do it. The answer has the same
        bits either way.
    :param progress: called with the number of the pass, how many files are done in it, and of how many.
    :raises MistakeError: mistakes in the study or the declaration.
    :raises TrueaxisError: a file that cannot be read, a worker of another version, a scheduler that does not answer; each by name.
    """
    files = [str(file) for file in files_of(data, [".parquet", ".csv"])]
    declaration = None if chain is None else (chain._native.origin, chain.text)
    sample = next(_chunks(files[0]), None)
    if sample is None:
        raise TrueaxisError(f"{files[0]}: there are no rows")
    fitting = _native.Fitting((os.fspath(study), text), declaration, sample)
    texts = fitting.texts
    number = 0
    with workers(client) as each:
        while (step := fitting.step()) is not None:
            number += 1
            tasks = [(file, *texts, step, _native.__version__) for file in files]
            tallies: dict[str, list[bytes]] = {}
            for file, of_file in each(_accumulate_file, tasks):
                tallies[file] = of_file
                if progress is not None:
                    progress(number, len(tallies), len(files))
            fitting.take([tally for file in files for tally in tallies[file]])
    return Fit(json.loads(fitting.found()))


def _accumulate_file(task: tuple) -> tuple[str, list[bytes]]:
    """What each chunk of a file says in a pass."""
    file, study, chain, step, version = task
    require_version(version)
    tallies = [_native.accumulate(study, chain, rows, step) for rows in _chunks(file)]
    if not tallies:
        raise TrueaxisError(f"{file}: there are no rows")
    return file, tallies


def _chunks(file: str) -> Iterator[tuple[str, Any]]:
    """The rows of a file chunk by chunk; a file of separated values as one."""
    if not file.endswith(".parquet"):
        yield file, None
        return
    import pyarrow
    import pyarrow.parquet as parquet

    rows = 0
    try:
        with parquet.ParquetFile(file) as opened:
            for batch in opened.iter_batches(batch_size=ROWS):
                yield place_of(file, rows), columns_of(pyarrow.Table.from_batches([batch]))
                rows += batch.num_rows
    except (pyarrow.ArrowException, OSError) as error:
        raise TrueaxisError(f"{file}: {error}") from None
