"""Files that are worked on one by one, in this process or on a Dask cluster; and folders of Parquet files, corrected so."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._chain import Chain
from ._errors import TrueaxisError
from ._inputs import Errors, errors_text, names
from ._native import __version__
from ._tables import Table, columns_of, with_columns

if TYPE_CHECKING:
    import distributed
    import pyarrow

ROWS = 1 << 18
"""Rows that are in memory at a time, a file that is being corrected."""
_SECONDS = 10
"""How long a scheduler may take to answer."""
_WORKER_SECONDS = 60
"""How long its first worker may take to join."""


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

    :param source: a folder of ``.parquet`` files, one file, or a list of files.
    :param out: a folder that is not there yet. It appears with a file for each, of the same name, when all are done.
    :param client: a Dask client, or the address of a scheduler: its workers do a file each, and must see the same folders. If a
        worker dies, others do its files again. Without one, the processors of this machine do them.
    :param progress: called with how many files are done, of how many.
    :returns: a row a file: ``file``, ``rows``.
    :raises TrueaxisError: a file that cannot be read, a worker of another version, a scheduler that does not answer; each by
        name. Nothing is left at ``out`` then.
    """
    files = files_of(source, [".parquet"])
    target = Path(out).absolute()
    if target.exists():
        raise TrueaxisError(f"`{out}` is there already: name a folder that is not")
    if not target.parent.is_dir():
        raise TrueaxisError(f"cannot write `{out}`: the folder it would lie in is not there; create it first")
    # What is wrong with the errors is told before a worker is asked.
    name, text = errors_text(errors)
    chosen = names(observables)
    chain.eval({reading: [0.5] for reading in chain.joints + chain.inputs}, errors, observables)
    staged = target.with_name(f".{target.name}.{secrets.token_hex(8)}.partial")
    staged.mkdir()
    tasks = [(str(file), str(staged / file.name), chain, name, text, chosen, __version__) for file in files]
    rows: dict[str, int] = {}
    try:
        with workers(client) as each:
            for done, (file, count) in enumerate(each(_apply_file, tasks), 1):
                rows[file] = count
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
    listed = [str(file) for file in files]
    return Table({"file": listed, "rows": [rows[file] for file in listed]})


def files_of(source: Any, endings: list[str]) -> list[Path]:
    """The files of one kind of a folder, one file, or the files of a list: as absolute paths, no two of one name."""
    if isinstance(source, (str, os.PathLike)):
        path = Path(source)
        if path.is_dir():
            by_ending = {ending: sorted(path.glob(f"*{ending}")) for ending in endings}
            there = [ending for ending, files in by_ending.items() if files]
            if not there:
                raise TrueaxisError(f"`{source}`: there is no {' or '.join(endings)} file in this folder")
            if len(there) > 1:
                raise TrueaxisError(f"`{source}` holds {' and '.join(there)} files: give a list of those that are meant")
            files = by_ending[there[0]]
        else:
            files = [path]
    else:
        files = [Path(file) for file in source]
        if not files:
            raise TrueaxisError("no files are given")
    seen: set[str] = set()
    for file in files:
        if not file.is_file():
            raise TrueaxisError(f"cannot read `{file}`: there is no such file")
        if file.name in seen:
            raise TrueaxisError(f"two files are named `{file.name}`: what came of them could not be told apart")
        seen.add(file.name)
    return [file.absolute() for file in files]


Each = Callable[[Callable[[tuple], Any], list[tuple]], Iterator[Any]]
"""Does a piece of work for each task, and gives what it returns as it is done."""


@contextmanager
def workers(client: distributed.Client | str | None) -> Iterator[Each]:
    """Those who do the work: the processors of this machine, or the workers of a scheduler."""
    if client is None:
        with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:

            def here(work, tasks):
                futures = [pool.submit(work, task) for task in tasks]
                try:
                    for future in as_completed(futures):
                        yield future.result()
                finally:
                    for future in futures:
                        future.cancel()

            yield here
        return
    import distributed

    own = None
    if isinstance(client, str):
        client = own = _connected(client)
    try:
        try:
            client.wait_for_workers(1, timeout=_WORKER_SECONDS)
        except TimeoutError:
            address = client.scheduler.address
            raise TrueaxisError(f"the scheduler at `{address}` has no worker: start one with `dask worker {address}`") from None

        def there(work, tasks):
            futures = client.map(work, tasks, pure=False, key=f"trueaxis-{secrets.token_hex(4)}")
            try:
                for future in distributed.as_completed(futures):
                    yield future.result()
            finally:
                client.cancel(futures)

        yield there
    finally:
        if own is not None:
            own.close()


def _connected(address: str) -> distributed.Client:
    import distributed

    try:
        return distributed.Client(address, timeout=_SECONDS)
    except (OSError, ValueError) as error:
        raise TrueaxisError(f"no scheduler answers at `{address}`: {error}") from None


@contextmanager
def opened(file: str) -> Iterator[pyarrow.parquet.ParquetFile]:
    """A Parquet file; what is wrong with it is told by its name."""
    import pyarrow
    import pyarrow.parquet as parquet

    try:
        with parquet.ParquetFile(file) as open_file:
            yield open_file
    except (pyarrow.ArrowException, OSError) as error:
        raise TrueaxisError(f"{file}: {error}") from None


def batches(file: str) -> Iterator[tuple[int, pyarrow.Table]]:
    """The rows of a Parquet file chunk by chunk, each with the number of rows before it."""
    import pyarrow

    first = 0
    with opened(file) as open_file:
        for batch in open_file.iter_batches(batch_size=ROWS):
            yield first, pyarrow.Table.from_batches([batch])
            first += batch.num_rows


def _apply_file(task: tuple) -> tuple[str, int]:
    """Corrects one file, chunk by chunk; the result takes its name when it is whole."""
    source, out, chain, name, text, observables, version = task
    require_version(version)
    import pyarrow
    import pyarrow.parquet as parquet

    # A worker that died may have left a part of it.
    partial = f"{out}.{secrets.token_hex(8)}.partial"
    rows, writer = 0, None
    try:
        for first, table in batches(source):
            place = place_of(source, first)
            added = chain._native.over_table((place, columns_of(table)), (name, text), observables, True, True)
            corrected = with_columns(table, dict(added))
            if writer is None:
                writer = parquet.ParquetWriter(partial, corrected.schema)
            writer.write_table(corrected)
            rows = first + table.num_rows
        if writer is None:
            raise TrueaxisError(f"{source}: there are no rows")
        writer.close()
        os.replace(partial, out)
    except (pyarrow.ArrowException, OSError) as error:
        raise TrueaxisError(f"{source}: {error}") from None
    finally:
        if os.path.exists(partial):
            os.remove(partial)
    return source, rows


def place_of(file: str, row: int) -> str:
    """A file and where in it a chunk begins: rows in messages are counted from there."""
    return f"{file}, behind row {row}" if row else file


def require_version(version: str) -> None:
    """Refuses to work for a program of another version."""
    if version != __version__:
        raise TrueaxisError(
            f"{_worker()} runs trueaxis {__version__}, the program that asks {version}: install the same version everywhere"
        )


def _worker() -> str:
    try:
        import distributed

        return f"worker {distributed.get_worker().address}"
    except (ImportError, ValueError):
        return "this process"
