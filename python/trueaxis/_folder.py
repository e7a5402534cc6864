"""Calibrations of folders: the search in rows drawn from all files, the estimates from every row, and the error before and after on
the rows that were not drawn."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _native
from ._calibration import Calibration
from ._chain import Chain
from ._cluster import Each, batches, files_of, opened, place_of, require_version, workers
from ._errors import TrueaxisError
from ._fit import Fit, of_files, of_table
from ._inputs import errors_text
from ._tables import Columns, Table, columns_of

if TYPE_CHECKING:
    import distributed

STRETCH = 1000
"""Rows beside each other that are drawn together: neighbours tell whether the noise remembers."""

BORNE_OUT = 3.0
"""Standard uncertainties that a coefficient of an effect differs from zero by at least, where every row bears the effect out."""

Stretch = tuple[int, int]
"""The first row of a stretch of a file, and the first behind it."""


class Validation(NamedTuple):
    """What is left of rows that nobody fitted: RMS of the residuals' lengths, rad or m."""

    rows: int
    """How many rows there are."""
    rows_kept: int
    """How many of them are no outliers."""
    before: float
    """Over the rows kept, by the declaration as it was."""
    after: float
    """Over the same rows, by the amended one."""
    before_every: float
    """By the declaration as it was, outliers too."""
    after_every: float
    """By the amended one, outliers too."""


class FolderCalibration(Calibration):
    """What came of a folder of files. What was found, its evidence and its pictures are of the rows that the search read; errors and
    values are of every row."""

    fit: Fit | None
    """The amended declaration fitted to every row; none where the search read every row, or no usable model came out of it."""
    validation: Validation | None
    """The error before and after on the rows that were not drawn, by what the drawn ones say; none where every row was drawn, or no
    usable model came out."""
    rows: int
    """Rows of the folder."""
    rows_searched: int
    """Rows that the search read."""

    def __init__(self, native: _native.Calibration, rows: int, searched: int):
        super().__init__(native)
        self.rows, self.rows_searched = rows, searched
        self.fit = self.validation = None
        # The same fit of the rows that were drawn: what the search knows of noise and a fit of every row does not, is between them.
        self._of_drawn: Fit | None = None

    @property
    def _fitted(self) -> Fit | None:
        """The fit of every row, if it came to an end."""
        return self.fit if self.fit is not None and self.fit.converged else None

    @property
    def errors(self) -> Table:
        """As of :class:`Calibration`, from every row. The ± allow for noise that remembers, and for errors that rows of a group share, as
        the rows that were searched show them."""
        if self._fitted is None:
            return super().errors
        searched = {row["name"]: row["standard_uncertainty"] for row in self.report["errors"]}
        independent = dict(zip(*(self._of_drawn.errors[key] for key in ["name", "standard_uncertainty"])))
        # More rows of the same groups tell less than more groups would.
        groups = self.report["observations"]["groups"] < self.rows_searched

        def widened(name: str, own: float) -> float:
            if searched.get(name) is None or not independent.get(name):
                return own
            return max(own, searched[name]) if groups else own * max(1.0, searched[name] / independent[name])

        fitted = dict(self._fitted.errors)
        names, own = fitted["name"], fitted["standard_uncertainty"]
        return Table({**fitted, "standard_uncertainty": np.array([widened(*pair) for pair in zip(names, own)])})

    @property
    def values(self) -> dict[str, float] | None:
        """As of :class:`Calibration`, from every row."""
        searched = super().values
        return searched if searched is None or self._fitted is None else {**searched, **self._fitted.values}

    @property
    def not_borne_out(self) -> list[str]:
        """The effects that the search found and that every row does not bear out: none of their coefficients differs from zero by three
        of its standard uncertainties."""
        if self._fitted is None:
            return []
        told = {row[0]: abs(row[1]) / row[2] for row in zip(*self.errors.values())}
        effects = [(effect["text"], [told[name] for name in effect["coefficients"] if name in told]) for effect in self.report["effects"]]
        return [text for text, sizes in effects if sizes and max(sizes) < BORNE_OUT]

    @property
    def errors_toml(self) -> str | None:
        """As of :class:`Calibration`, from every row."""
        text = super().errors_toml
        if text is None or self._fitted is None:
            return text
        told = {row[0]: row[1:] for row in zip(*self.errors.values())}
        lines = []
        for line in text.splitlines():
            key, is_set, _ = line.partition(" = ")
            name = key.strip().strip('"')
            if is_set and name in told:
                value, uncertainty, unit, separable = told[name]
                remark = f"± {uncertainty:.2g}" if separable else "determined only together with others"
                line = f"{key} = {float(value)!r:24} # {unit}, {remark}"
            lines.append(line)
        return "\n".join(lines) + "\n"

    def text(self, *, verbose: bool = False) -> str:
        """What the search found, then what every row says."""
        if self.rows_searched == self.rows:
            return super().text(verbose=verbose)
        told = [f"The search read {self.rows_searched:,} of {self.rows:,} rows, drawn from all files.", "", super().text(verbose=verbose)]
        if self.validation is not None:
            before, after = (_length(rms, self.report["unit"]) for rms in [self.validation.before, self.validation.after])
            falls = self.validation.after <= self.validation.before
            told += [
                f"In the {self.validation.rows:,} rows that were not drawn the error (RMS) {'falls' if falls else 'grows'} from {before} to "
                f"{after}{'.' if falls else ': do not correct with what was found.'}"
            ]
        told += [f"Every row does not bear it out: {name}. Leave it out of the declaration." for name in self.not_borne_out]
        if self.fit is not None and not self.fit.converged:
            told += ["The fit of every row did not come to an end: the errors are those of the rows that were drawn."]
        elif self.fit is not None:
            told += ["", "Errors from every row:", repr(self.errors)]
        return "\n".join(told)

    def write(self, folder: str | os.PathLike[str], *, all_residuals: bool = False) -> None:
        """Writes the amended declaration, the errors from every row and a summary, and beside them in ``search`` every file of the
        search's calibration; they appear together, or not at all."""
        if self.rows_searched == self.rows:
            super().write(folder, all_residuals=all_residuals)
            return
        target = Path(folder).absolute()
        if target.exists():
            raise TrueaxisError(f"`{folder}` is there already: name a folder that is not")
        if not target.parent.is_dir():
            raise TrueaxisError(f"cannot write `{folder}`: the folder it would lie in is not there; create it first")
        staged = target.with_name(f".{target.name}.{secrets.token_hex(8)}.partial")
        staged.mkdir()
        try:
            super().write(staged / "search", all_residuals=all_residuals)
            files = {"summary.txt": self.text() + "\n", "amended.chain": self.amended, "errors.toml": self.errors_toml}
            for name, text in files.items():
                if text is not None:
                    (staged / name).write_text(text, encoding="utf-8")
            staged.rename(target)
        finally:
            shutil.rmtree(staged, ignore_errors=True)


def _length(rms: float, unit: str) -> str:
    """A length of residuals as people read it."""
    return f"{np.degrees(rms) * 3600:.3g}″" if unit == "rad" else f"{rms:.4g} {unit}"


def calibrate_folder(
    study: str | os.PathLike[str],
    data: Any,
    text: str | None,
    chain: Chain | None,
    client: distributed.Client | str | None,
    search_rows: int,
    seed: int,
    progress: Callable[[str], object] | None,
) -> FolderCalibration:
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
        stretches = _stretches([of_file[file] for file in files], search_rows, seed)
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
        found = FolderCalibration(native, rows, drawn)
        if before is None or found.amended is None:
            return found
        tell("fitting the declaration to the rows that were drawn, as it was and as amended")
        before, (studied, declared) = of_table(before, table), before.texts
        amended = ("amended.chain", found.amended)
        found._of_drawn = of_table(_native.Fitting(studied, amended, table), table)
        if before.converged and found._of_drawn.converged:
            judged = [(declared, errors_text(before.values)), (amended, errors_text(super(FolderCalibration, found).values))]
            tasks = [(file, own, studied, judged, found._of_drawn.noise, _native.__version__) for file, own in zip(files, stretches)]
            found.validation = _validated(each, tasks, tell)
        fitting = _native.Fitting(studied, amended, table)
        found.fit = of_files(fitting, files, each, lambda number, done, of: tell(f"fitting every row, pass {number}: {done} of {of} files"))
        return found


def _count(task: tuple) -> tuple[str, int]:
    """How many rows a file has."""
    file, version = task
    require_version(version)
    with opened(file) as parquet:
        rows = parquet.metadata.num_rows
    if rows == 0:
        raise TrueaxisError(f"{file}: there are no rows")
    return file, rows


def _stretches(rows: list[int], wanted: int, seed: int) -> list[list[Stretch]]:
    """Which rows of each file to draw, evenly from all: of as many parts of the rows, a stretch somewhere in each."""
    total = sum(rows)
    if total <= wanted:
        return [[(0, count)] for count in rows]
    count = max(1, wanted // STRETCH)
    random = np.random.default_rng(seed)
    bounds = np.linspace(0, total, count + 1).astype(int)
    length = min(STRETCH, wanted)
    starts = [int(low + random.integers(0, max(1, high - low - length + 1))) for low, high in zip(bounds, bounds[1:])]
    drawn: list[list[Stretch]] = []
    first = 0
    for own in rows:
        cut = [(max(start, first) - first, min(start + length, first + own) - first) for start in starts]
        drawn.append([(start, end) for start, end in cut if start < end])
        first += own
    return drawn


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


def _validated(each: Each, tasks: list[tuple], tell: Callable[[str], object]) -> Validation | None:
    """The sums of all files; none where all rows were drawn."""
    of_file: dict[str, np.ndarray] = {}
    for file, sums in each(_validate_file, tasks):
        of_file[file] = sums
        tell(f"judging the rows that were not drawn: {len(of_file)} of {len(tasks)} files")
    rows, kept, before, after, before_kept, after_kept = np.sum([of_file[task[0]] for task in tasks], axis=0)
    if not kept:
        return None
    over_kept, over_all = (np.sqrt(np.array(pair)) for pair in [(before_kept / kept, after_kept / kept), (before / rows, after / rows)])
    return Validation(int(rows), int(kept), *over_kept.tolist(), *over_all.tolist())


def _validate_file(task: tuple) -> tuple[str, np.ndarray]:
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
