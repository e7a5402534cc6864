"""Tables: what data frames hand over, and what is handed back.

The common denominator is a dictionary of columns: arrays of float64 for numbers, lists of texts for anything else.
"""

from __future__ import annotations

import datetime
import html
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

Columns = list[tuple[str, "np.ndarray | list[str]"]]

_ROWS_SHOWN = 10
# Above this, not every whole number is a float64.
_WHOLE = 2**53


class Table(Mapping[str, Any]):
    """Columns by name, in order. Columns of numbers are arrays of float64, others lists.

    ``table["value"]`` is a column, ``dict(table)`` all of them; :meth:`to_pandas`, :meth:`to_polars` and :meth:`to_arrow`
    make data frames. Units stand in the names of the columns.
    """

    def __init__(self, columns: Mapping[str, Any]):
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> Any:
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self._columns.values()))) if self._columns else 0

    def to_pandas(self):
        """A ``pandas.DataFrame``."""
        import pandas

        return pandas.DataFrame(self._columns)

    def to_polars(self):
        """A ``polars.DataFrame``."""
        import polars

        return polars.DataFrame(self._columns, strict=False)

    def to_arrow(self):
        """A ``pyarrow.Table``."""
        import pyarrow

        return pyarrow.table(self._columns)

    def _shown(self) -> list[list[str]]:
        def cell(value: Any) -> str:
            return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)

        rows = min(self.rows, _ROWS_SHOWN)
        return [[cell(column[row]) for column in self._columns.values()] for row in range(rows)]

    def __repr__(self) -> str:
        lines = [list(self._columns), *self._shown()]
        widths = [max(map(len, column)) for column in zip(*lines)]
        text = "\n".join("  ".join(cell.ljust(w) for cell, w in zip(line, widths)).rstrip() for line in lines)
        return text + (f"\n… {self.rows} rows" if self.rows > _ROWS_SHOWN else "")

    def _repr_html_(self) -> str:
        def row(cells: Sequence[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

        more = f"<p>{self.rows} rows</p>" if self.rows > _ROWS_SHOWN else ""
        body = "".join(row(line, "td") for line in self._shown())
        return f"<table><thead>{row(list(self._columns), 'th')}</thead><tbody>{body}</tbody></table>{more}"


def kept(table: Any) -> Any:
    """The table, or of what can be read only once, an Arrow table of it."""
    marks = {"pandas": ["iloc"], "polars": ["get_columns", "collect"], "pyarrow": ["column_names"]}.get(_library(table), [])
    is_held = isinstance(table, Mapping) or any(hasattr(table, mark) for mark in marks)
    if is_held or not hasattr(table, "__arrow_c_stream__"):
        return table
    import pyarrow

    return pyarrow.table(table)


def _library(table: Any) -> str:
    """Which library made a table."""
    return type(table).__module__.partition(".")[0]


def columns_of(table: Any) -> Columns:
    """The columns of a pandas, Polars or Arrow table, of a dictionary, or of what speaks Arrow's stream of tables."""
    library = _library(table)
    if isinstance(table, Mapping):
        pairs = list(table.items())
    elif library == "pandas" and hasattr(table, "iloc"):
        pairs = [(name, table.iloc[:, at]) for at, name in enumerate(table.columns)]
    elif library == "polars" and hasattr(table, "get_columns"):
        pairs = [(column.name, column) for column in table.get_columns()]
    elif library == "polars" and hasattr(table, "collect"):
        raise TypeError("this table is lazy: write table.collect()")
    elif library == "pyarrow" and hasattr(table, "column_names"):
        pairs = list(zip(table.column_names, table.columns))
    elif hasattr(table, "__arrow_c_stream__"):
        return columns_of(kept(table))
    else:
        raise TypeError(
            f"a table is needed, this is a {type(table).__name__}: give a pandas, Polars or Arrow table, or a dictionary "
            "of columns"
        )
    return [(str(name), column_of(str(name), column)) for name, column in pairs]


def column_of(name: str, column: Any) -> np.ndarray | list[str]:
    """A column as an array of float64, without a copy where it is one, or as a list of texts."""
    array = _array(column)
    if isinstance(array, np.ma.MaskedArray):
        array = _unmasked(array)
    if array.ndim != 1:
        raise TypeError(f"column `{name}` has {array.ndim} dimensions: give one number or text a row")
    if array.dtype.kind in "biu":
        if array.dtype.kind == "b" or array.size == 0 or (-_WHOLE <= array.min() and array.max() <= _WHOLE):
            return array.astype(np.float64)
        return [str(value) for value in array.tolist()]
    if array.dtype.kind == "f":
        # Columns from a buffer that somebody sent need not lie where numbers of their size do.
        return np.require(array, dtype=np.float64, requirements=["C", "A"])
    if array.dtype.kind == "M":
        return ["" if np.isnat(value) else str(value) for value in array]
    if array.dtype.kind == "m":
        return array / np.timedelta64(1, "s")
    if array.dtype.kind in "OUST":
        return _mixed([value.decode() if isinstance(value, bytes) else value for value in array.tolist()])
    raise TypeError(f"column `{name}` holds {array.dtype}: give numbers or texts")


def _unmasked(array: np.ma.MaskedArray) -> np.ndarray:
    """The array where what lies under the mask is not there."""
    if not np.ma.is_masked(array):
        return array.data
    if array.dtype.kind in "mM":
        return array.filled(np.array("NaT", dtype=array.dtype))
    plain = array.data.astype(object)
    plain[np.ma.getmaskarray(array)] = None
    return plain


def _array(column: Any) -> np.ndarray:
    if isinstance(column, np.ndarray):
        return column
    library = _library(column)
    if library == "pyarrow":
        return column.to_numpy(zero_copy_only=False) if hasattr(column, "chunks") else np.asarray(column)
    if library in ("pandas", "polars"):
        return column.to_numpy()
    values = list(column)
    # A list with a text in it is one of texts; NumPy would make texts of its numbers too.
    if any(isinstance(value, str) or value is None for value in values):
        mixed = np.empty(len(values), dtype=object)
        mixed[:] = values
        return mixed
    return np.asarray(values) if values else np.empty(0)


def _mixed(values: list[Any]) -> np.ndarray | list[str]:
    """Numbers with nothing in some rows are numbers, where NaN says so; all else is texts."""

    def is_none(value: Any) -> bool:
        is_nan = isinstance(value, float) and value != value
        return value is None or is_nan or type(value).__name__ in ("NAType", "NaTType")

    def is_number(value: Any) -> bool:
        return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)

    def is_truth(value: Any) -> bool:
        return isinstance(value, (bool, np.bool_))

    if values and any(all(is_none(value) or is_(value) for value in values) for is_ in (is_number, is_truth)):
        return np.array([np.nan if is_none(value) else float(value) for value in values])

    def text(value: Any) -> str:
        if isinstance(value, (datetime.datetime, datetime.date)):
            return value.isoformat()
        return "" if is_none(value) else str(value)

    return [text(value) for value in values]


def with_columns(table: Any, columns: Mapping[str, np.ndarray]) -> Any:
    """The table, of the library that made it, with columns added or replaced."""
    library = _library(table)
    if library == "pandas" and not isinstance(table, Mapping):
        return table.assign(**columns)
    if library == "polars" and hasattr(table, "with_columns"):
        import polars

        return table.with_columns([polars.Series(name, column) for name, column in columns.items()])
    if library == "pyarrow":
        import pyarrow

        for name, column in columns.items():
            at = table.column_names.index(name) if name in table.column_names else None
            if at is None:
                table = table.append_column(name, pyarrow.array(column))
            else:
                table = table.set_column(at, name, pyarrow.array(column))
        return table
    # The rows of pandas' columns are told by their places, as those of all others are.
    plain = {name: column.array if _library(column) == "pandas" else column for name, column in table.items()}
    return Table({**plain, **columns})
