"""Calibrations: a study in, what came of it out, as values, tables and a page."""

from __future__ import annotations

import html
import json
import os
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._chain import Chain, require_chain
from ._inputs import Found, path_of, text_of
from ._instrument import Instrument
from ._tables import Table, columns_of, is_frame

if TYPE_CHECKING:
    import distributed


class Calibration:
    """What came of a study. A notebook shows the first screen of its report, with the pictures."""

    def __init__(self, native: _native.Calibration):
        self._native = native

    @cached_property
    def report(self) -> dict[str, Any]:
        """The whole report, with the keys of ``report.json``."""
        return json.loads(self._native.report())

    @property
    def verdict(self) -> str:
        """``explained``, ``confounded``, ``structure remains``, …"""
        return self.report["verdict"]

    @cached_property
    def errors(self) -> Table:
        """A row an error, those of the effects that were found among them: ``name``, ``value``, ``standard_uncertainty``, ``unit``, ``separable``, and
        ``moves_by_cause``: how far the value would move, down and up, if another cause that the data fit were the true one; none
        where that is within its uncertainty."""
        keys = ["name", "value", "standard_uncertainty", "unit", "separable", "moves_by_cause"]
        return _table(self.report["errors"], keys)

    @cached_property
    def effects(self) -> Table:
        """A row an effect that was found: ``text``, ``body``, ``dof``, ``driver``, ``form``, ``names``, ``p_value``."""
        keys = ["text", "body", "dof", "driver", "form", "names", "p_value"]
        effects = [{**effect, "names": "; ".join(effect["names"])} for effect in self.report["effects"]]
        return _table(effects, keys)

    @cached_property
    def residuals(self) -> Table:
        """A row an observation: its number, the readings, the residual before and after, in SI, and its weight."""
        return Table(dict(self._native.residuals()))

    @property
    def amended(self) -> str | None:
        """The declaration with what was found, or none where no usable model came out."""
        return self._native.amended

    @cached_property
    def chain(self) -> Chain | None:
        """The amended declaration, read."""
        return None if self.amended is None else Chain.from_text(self.amended, "amended.chain")

    @property
    def errors_toml(self) -> str | None:
        """The estimates as a file of errors for ``chain``."""
        return self._native.errors_toml

    @cached_property
    def instrument(self) -> Instrument | None:
        """The calibrated instrument, as ``instrument.toml`` has it, or none where no usable model came out."""
        text = self._native.instrument_toml
        return None if text is None else Instrument.from_text(text)

    @property
    def values(self) -> dict[str, float] | None:
        """The estimates of errors, and of constants that were fitted, by name, in SI: ``errors`` of the methods of
        ``chain``; none where no usable model came out. They know what they were found over: :meth:`Chain.apply` and
        :func:`trueaxis.apply` warn of rows outside."""
        values, over = self._native.values, self._native.found_over
        if values is None or over is None:
            return None
        return Found([(name, value) for name, value, _ in values], {name: unit for name, _, unit in values}, over)

    def apply(self, table: Any) -> Any:
        """New readings corrected with this calibration, as :meth:`Chain.apply` does."""
        from ._errors import TrueaxisError

        if self.chain is None or self.values is None:
            raise TrueaxisError(f"no usable model came out ({self.verdict}): there is nothing to apply")
        return self.chain.apply(table, self.values)

    def text(self, *, verbose: bool = False) -> str:
        """The summary as the command prints it."""
        return self._native.text(verbose)

    def html(self, *, whole: bool = True) -> str:
        """``report.html``; or only its first screen and its pictures."""
        return self._native.html(whole)

    def write(self, folder: str | os.PathLike[str], *, all_residuals: bool = False) -> None:
        """Writes every file of the command's ``--out``; they appear together, or not at all. What the study reads is not written over.

        Of more than 100,000 rows ``residuals.csv`` has a part, unless ``all_residuals``.
        """
        self._native.write(path_of("folder", folder), all_residuals)

    def __reduce__(self):
        raise TypeError(
            "a calibration cannot be copied or pickled: keep its `report`, `amended` and `errors_toml`, or write(folder) it"
        )

    def __repr__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        page = html.escape(self.html(whole=False), quote=True)
        # A page of its own: its style does not touch the notebook's, nor the notebook's it.
        return (
            f'<iframe title="Calibration" sandbox="allow-scripts" srcdoc="{page}" '
            'style="width:100%;height:60em;border:0"></iframe>'
        )


def _table(rows: list[dict[str, Any]], keys: list[str]) -> Table:
    columns = {key: [row.get(key) for row in rows] for key in keys}
    is_number = {key: all(isinstance(cell, float) for cell in cells) for key, cells in columns.items()}
    return Table({key: np.array(cells) if is_number[key] else cells for key, cells in columns.items()})


def calibrate(
    study: str | os.PathLike[str],
    data: Any = None,
    *,
    text: str | None = None,
    chain: Chain | None = None,
    client: distributed.Client | str | None = None,
    search_rows: int = 1_000_000,
    seed: int = 1,
    progress: Callable[[str], object] | None = None,
) -> Calibration:
    """Fits the errors to measured data, finds what the declaration lacks, and judges both on data that nobody fitted.

    The data may be a folder of Parquet files, of any size: the search reads at most ``search_rows`` rows drawn from all files, the
    amended declaration is fitted to every row, and the error before and after is told for the rows that were not drawn. Errors, ± and
    values are then those of every row, the evidence and the pictures those of the rows drawn; ``report["every_row"]`` says more.

    :param study: the path of the study file.
    :param data: tables that stand for files that the study names: a pandas, Polars or Arrow table or a dictionary of columns
        where it names one, else a dictionary from each name to its table. What is not given is read from its file. Or a
        folder of ``.parquet`` or ``.pq`` files, one such file, or a list of them, which stand for the one table that the study names.
        What a folder holds beside them is warned of, and a file without rows counts for nothing.
    :param text: the text of the study, where it is no file; ``study`` then only says where it would be.
    :param chain: a declaration that stands for the one that the study names.
    :param client: for a folder: a Dask client, or the address of a scheduler, whose workers read a file each and must see the same
        files. If a worker dies, others read its files again. The search itself runs here. Without one, the processors of this
        machine do all. The answer has the same bits either way.
    :param search_rows: for a folder: rows that the search reads at most, in this process's memory.
    :param seed: for a folder: of which rows are drawn.
    :param progress: called with a text when the next stage begins.
    :raises MistakeError: mistakes in the study or the declaration.
    :raises TrueaxisError: a file or a table that cannot be read, with the row and the column.
    """
    if chain is not None:
        require_chain(chain)
    study, text = path_of("study", study), None if text is None else text_of("text", text)
    if isinstance(data, Iterator) and not hasattr(data, "__arrow_c_stream__"):
        data = list(data)
    if isinstance(data, (list, tuple)) and not (data and all(_is_path(one) for one in data)):
        raise TypeError(
            "several tables are no data of a study: give one for each table that it names (pandas.concat, polars.concat or "
            "pyarrow.concat_tables make one of several), or a list of paths of Parquet files"
        )
    if _is_path(data) or isinstance(data, (list, tuple)):
        from ._folder import calibrate_folder

        return calibrate_folder(study, data, text, chain, client, search_rows, seed, progress)
    if client is not None:
        from ._errors import TrueaxisError

        raise TrueaxisError("a cluster reads files: give a folder of Parquet files that its workers see as `data`")
    resolved = _native.Study(study, text, None if chain is None else chain._native)
    tables = [] if data is None else _named(data, resolved.tables)
    command = f"trueaxis.calibrate({study!r})"
    return Calibration(_native.calibrate(resolved, tables, command, progress))


def _named(data: Any, names: list[str]) -> list[tuple[str, Any]]:
    """Each table with the name that the study has for it."""
    from ._errors import TrueaxisError

    if isinstance(data, Mapping) and data and all(is_frame(value) for value in data.values()):
        for name in data:
            if name not in names:
                listed = ", ".join(f"`{name}`" for name in names)
                raise TrueaxisError(f"the study names no table `{name}`: it names {listed}")
        return [(name, columns_of(table)) for name, table in data.items()]
    if len(names) != 1:
        listed = ", ".join(f"`{name}`" for name in names)
        raise TrueaxisError(f"the study names {listed}: give a dictionary from each name to its table")
    return [(names[0], columns_of(data))]


def _is_path(value: Any) -> bool:
    return isinstance(value, (str, os.PathLike))
