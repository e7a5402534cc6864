"""Folders of Parquet files, corrected: in this process or on a Dask cluster."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._chain import Chain, require_chain
from ._errors import TrueaxisError, kept_warnings
from ._files import batches, files_of, opened, told_by_file
from ._inputs import Errors, errors_and_ranges, names, path_of
from ._tables import Table, columns_of, with_columns
from ._workers import require_version, workers

if TYPE_CHECKING:
    import distributed
    import pyarrow


def apply(
    source: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
    chain: Chain,
    errors: Errors,
    out: str | os.PathLike[str],
    *,
    observables: str | Iterable[str] | None = None,
    client: distributed.Client | str | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Table:
    """Corrects Parquet files with calibrated errors, as :meth:`Chain.apply` corrects a table; memory is that of some chunks.

    :param source: a folder of ``.parquet`` or ``.pq`` files, one file, or a list of files. Hidden files of a folder are left out; what
        else is not read is warned of.
    :param out: a folder that is not there yet. It appears with a file for each, of the same name, when all are done.
    :param client: a Dask client, or the address of a scheduler: its workers do a file each, and must see the same folders. If a
        worker dies, others do its files again. Without one, the processors of this machine do them.
    :param progress: called with how many files are done, of how many.
    :returns: a row a file: ``file``, ``rows``.
    :raises TrueaxisError: a file that cannot be read, a worker of another version, a scheduler that does not answer or has had no
        worker for 60 s; each by name. Nothing is left at ``out`` then.
    """
    require_chain(chain)
    files = files_of(source, [".parquet"], told_apart=True)
    target = Path(path_of("out", out)).absolute()
    if target.exists():
        raise TrueaxisError(f"`{out}` is there already: name a folder that is not")
    if not target.parent.is_dir():
        raise TrueaxisError(f"cannot write `{out}`: the folder it would lie in is not there; create it first")
    # What is wrong with the errors is told before a worker is asked; what is doubtful of them, by those.
    known, chosen = errors_and_ranges(errors), names(observables)
    with kept_warnings():
        chain.eval({reading: [0.5] for reading in chain.joints + chain.inputs}, errors, observables)
    staged = target.with_name(f".{target.name}.{secrets.token_hex(8)}.partial")
    try:
        staged.mkdir()
    except OSError as error:
        raise TrueaxisError(f"cannot write `{out}`: {error.strerror}") from None
    tasks = [(str(file), str(staged / file.name), chain, known, chosen, _native.__version__) for file in files]
    rows: dict[str, int] = {}
    outside: list[Any] = []
    try:
        with workers(client) as each:
            for done, (file, count, counted) in enumerate(each(_apply_file, tasks), 1):
                rows[file] = count
                outside.extend(counted)
                if progress is not None:
                    progress(done, len(tasks))
        # A worker that died leaves what it had begun.
        wanted = {file.name for file in files}
        for begun in staged.iterdir():
            if begun.name not in wanted:
                begun.unlink()
        staged.rename(target)
    finally:
        shutil.rmtree(staged, ignore_errors=True)
    _native.warn_of_outside(chain._native, known, outside)
    listed = [str(file) for file in files]
    return Table({"file": listed, "rows": [rows[file] for file in listed]})


def _apply_file(task: tuple) -> tuple[str, int, list]:
    """Corrects one file, chunk by chunk; the result takes its name when it is whole. What each chunk says of rows outside comes back."""
    source, out, chain, known, observables, version = task
    require_version(version)
    import pyarrow
    import pyarrow.parquet as parquet

    # A worker that died may have left a part of it.
    partial = f"{out}.{secrets.token_hex(8)}.partial"
    rows, outside, writer = 0, [], None
    try:
        for first, table in batches(source):
            rows_there = (source, columns_of(table, chain._native))
            with told_by_file(source, lambda row: (source, first + row)):
                added, replaced, counted = _native.apply(chain._native, rows_there, known, observables)
            outside.append(counted)
            corrected = with_columns(table, dict(added), replaced)
            if writer is None:
                writer = parquet.ParquetWriter(partial, corrected.schema)
            writer.write_table(corrected)
            rows = first + table.num_rows
        if writer is None:
            parquet.write_table(_without_rows(source, chain, known, observables), partial)
        else:
            writer.close()
        os.replace(partial, out)
    except (pyarrow.ArrowException, OSError) as error:
        raise TrueaxisError(f"{source}: {error}") from None
    finally:
        if os.path.exists(partial):
            os.remove(partial)
    return source, rows, outside


def _without_rows(source: str, chain: Chain, known: tuple[str, str], observables: list[str]) -> pyarrow.Table:
    """A file without rows, corrected: it has the columns that one row would have."""
    with opened(source) as open_file:
        table = open_file.schema_arrow.empty_table()
    one_row = [(name, np.array([0.5])) for name in table.column_names]
    added, replaced, _ = _native.apply(chain._native, (source, one_row), known, observables)
    return with_columns(table, {name: column[:0] for name, column in added}, replaced)
