"""Tables: what data frames hand over, and what is handed back.

The common denominator is a dictionary of columns: arrays of float64 for numbers, lists of texts, and for what is neither the words
that refuse it where somebody asks for it.
"""

from __future__ import annotations

import datetime
import html
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np

from ._inputs import text_of

if TYPE_CHECKING:
    from . import _native


class Other(NamedTuple):
    """A column of neither numbers nor texts."""

    labels: np.ndarray | None
    """Numbers that tell the cells apart and put them in order, where there are such."""
    rows: int
    """How many cells there are."""
    why: str
    """What they are, and what to give instead."""


Column = Union[np.ndarray, list[str], Other]
Columns = list[tuple[str, Column]]

_ROWS_SHOWN = 10
# Above this, not every whole number is a float64.
_WHOLE = 2**53
# What columns hold that are no numbers although they could be made some, and what to give.
_TRUTHS = ("truth values", "give numbers")
_DURATIONS = ("durations", 'give numbers, of seconds by dividing by numpy.timedelta64(1, "s")')


class Table(dict[str, Any]):
    """Columns by name, in order. Columns of numbers are arrays of float64, others lists; those that came in a dictionary stay what they
    were.

    ``table["value"]`` is a column; :meth:`to_pandas`, :meth:`to_polars` and :meth:`to_arrow` make data frames. Units stand in the
    names of the columns.
    """

    def __eq__(self, other: object) -> bool:
        """Whether it is a table of the same columns in the same order, which are read alike: so are 1 and 1.0, and nothing (NaN) and
        nothing."""
        is_like = isinstance(other, Table) and list(self) == list(other)
        return is_like and all(_are_alike(name, self[name], other[name]) for name in self)

    def __ne__(self, other: object) -> bool:
        return not self == other

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self.values()))) if self else 0

    def to_pandas(self):
        """A ``pandas.DataFrame``."""
        import pandas

        return pandas.DataFrame(self)

    def to_polars(self):
        """A ``polars.DataFrame``."""
        import polars

        def of(column: Any) -> Any:
            if library_of(column) != "pandas":
                return column
            import pandas

            return polars.Series(pandas.Series(column))

        return polars.DataFrame({name: of(column) for name, column in self.items()}, strict=False)

    def to_arrow(self):
        """A ``pyarrow.Table``."""
        import pyarrow

        def of(column: Any) -> Any:
            # Arrow has numbers as this machine has them.
            is_swapped = isinstance(column, np.ndarray) and not column.dtype.isnative
            return column.astype(column.dtype.newbyteorder("=")) if is_swapped else column

        return pyarrow.table({name: of(column) for name, column in self.items()})

    def _shown(self) -> list[list[str]]:
        def cell(value: Any) -> str:
            return f"{value:.6g}" if isinstance(value, (float, np.floating)) else str(value)

        rows = min(self.rows, _ROWS_SHOWN)
        return [[cell(column[row]) for column in self.values()] for row in range(rows)]

    def __repr__(self) -> str:
        lines = [list(self), *self._shown()]
        widths = [max(map(len, column)) for column in zip(*lines)]
        text = "\n".join("  ".join(cell.ljust(w) for cell, w in zip(line, widths)).rstrip() for line in lines)
        return text + (f"\n… {self.rows} rows" if self.rows > _ROWS_SHOWN else "")

    def _repr_html_(self) -> str:
        def row(cells: Sequence[str], tag: str) -> str:
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

        more = f"<p>{self.rows} rows</p>" if self.rows > _ROWS_SHOWN else ""
        body = "".join(row(line, "td") for line in self._shown())
        return f"<table><thead>{row(list(self), 'th')}</thead><tbody>{body}</tbody></table>{more}"


def _are_alike(name: str, one: Any, other: Any) -> bool:
    """Whether two columns are read alike. Of what nobody reads that is known of the same column alone."""
    if one is other:
        return True
    first, second = column_of(name, one), column_of(name, other)
    if isinstance(first, Other) and isinstance(second, Other):
        return first.why == second.why and first.labels is not None and np.array_equal(first.labels, second.labels, equal_nan=True)
    if isinstance(first, np.ndarray) and isinstance(second, np.ndarray):
        return np.array_equal(first, second, equal_nan=True)
    return type(first) is type(second) and first == second


def kept(table: Any) -> Any:
    """The table, or of what can be read only once, an Arrow table of it."""
    marks = {"pandas": ["columns"], "polars": ["get_columns", "collect"], "pyarrow": ["column_names"]}.get(library_of(table), [])
    is_held = isinstance(table, Mapping) or any(hasattr(table, mark) for mark in marks)
    if is_held or not hasattr(table, "__arrow_c_stream__"):
        return table
    import pyarrow

    try:
        return pyarrow.table(table)
    except pyarrow.ArrowInvalid:
        # A stream of one column.
        raise _no_table(table) from None


def _no_table(table: Any) -> TypeError:
    return TypeError(
        f"a table is needed, this is a {type(table).__name__}: give a pandas, Polars or Arrow table, or a dictionary of columns"
    )


def is_frame(value: Any) -> bool:
    """Whether a value is a table, and no column of one."""
    # A stream of Arrow's has a schema and no columns.
    return isinstance(value, Mapping) or any(hasattr(value, name) for name in ["columns", "column_names", "schema"])


def library_of(thing: Any) -> str:
    """Which library made a table or a column, or what it is derived from; nothing where none did."""
    made = (cls.__module__.partition(".")[0] for cls in type(thing).__mro__)
    return next((library for library in made if library in ("pandas", "polars", "pyarrow")), "")


def columns_of(table: Any, chain: _native.Chain | None = None) -> Columns:
    """The columns of a pandas, Polars or Arrow table, of a dictionary, or of what speaks Arrow's stream of tables. Where a chain is to read
    them, the cells of others than its joints and inputs are not looked at."""
    library = library_of(table)
    if isinstance(table, Mapping):
        pairs = list(table.items())
    elif library == "pandas" and hasattr(table, "columns"):
        pairs = [(name, table.iloc[:, at]) for at, name in enumerate(table.columns)]
    elif library == "polars" and hasattr(table, "get_columns"):
        pairs = [(column.name, column) for column in table.get_columns()]
    elif library == "polars" and hasattr(table, "collect"):
        raise TypeError("this table is lazy: write table.collect()")
    elif library == "pyarrow" and hasattr(table, "column_names"):
        pairs = list(zip(table.column_names, table.columns))
    elif hasattr(table, "__arrow_c_stream__"):
        return columns_of(kept(table), chain)
    else:
        raise _no_table(table)
    names = [text_of("the name of a column", str(name)) for name, _ in pairs]
    is_read = [True] * len(names) if chain is None else chain.are_readings(names)
    return [(name, column_of(name, column, is_one)) for name, (_, column), is_one in zip(names, pairs, is_read)]


def column_of(name: str, column: Any, is_read: bool = True) -> Column:
    """A column as an array of float64, without a copy where it is one, as a list of texts, or as neither, which it is where nobody reads
    it."""
    if isinstance(column, Iterator):
        raise TypeError(f"column `{name}` is a {type(column).__name__}, which can be read only once: write list(...) of it")
    if isinstance(column, np.ndarray) and column.ndim == 0:
        raise TypeError(f"column `{name}` is a single number: give one number or text a row")
    # Of a set nobody knows which row is whose.
    if isinstance(column, (str, bytes, Mapping, Set)) or not hasattr(column, "__len__"):
        raise TypeError(f"column `{name}` is a {type(column).__name__}: give one number or text a row")

    def other(what: str, instead: str = "give one number or text a row", labels: np.ndarray | None = None) -> Other:
        return Other(labels, len(column), f"holds {what}: {instead}")

    if not is_read:
        return other("what nobody asks for")
    try:
        array = _array(column)
    except MemoryError:
        raise
    except Exception as error:
        # Whatever a library says of a type that it does not convert.
        return other(f"{getattr(column, 'dtype', getattr(column, 'type', 'what is no column'))} ({error})")
    if isinstance(array, np.ma.MaskedArray):
        array = _unmasked(array)
    kind = array.dtype.kind
    if array.ndim != 1:
        return other(f"{array.ndim} dimensions")
    if kind == "b":
        return other(*_TRUTHS, array.astype(np.float64))
    if kind in "iu":
        if array.size == 0 or (-_WHOLE <= array.min() and array.max() <= _WHOLE):
            return array.astype(np.float64)
        return [str(value) for value in array.tolist()]
    if kind == "f":
        # Columns from a buffer that somebody sent need not lie where numbers of their size do.
        return np.require(array, dtype=np.float64, requirements=["C", "A"])
    if kind == "M":
        return ["" if np.isnat(value) else str(value) for value in array]
    if kind == "m":
        return other(*_DURATIONS, array / np.timedelta64(1, "s"))
    if kind in "OUST":
        values = array.tolist()
        if any(hasattr(value, "__len__") and not isinstance(value, (str, bytes)) for value in values):
            return other("lists or groups")
        try:
            values = [value.decode() if isinstance(value, bytes) else value for value in values]
        except UnicodeDecodeError:
            return other("bytes that are no text")
        return _mixed(values, other)
    return other(str(array.dtype))


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
    library = library_of(column)
    if library == "pyarrow":
        return column.to_numpy(zero_copy_only=False) if hasattr(column, "chunks") else np.asarray(column)
    if library in ("pandas", "polars"):
        return column.to_numpy()
    values = list(column)
    # A list with a text in it is one of texts; NumPy would make texts of its numbers too, and numbers of truth values among them.
    if any(isinstance(value, (str, bool, np.bool_)) or value is None for value in values):
        mixed = np.empty(len(values), dtype=object)
        mixed[:] = values
        return mixed
    return np.asarray(values) if values else np.empty(0)


def _mixed(values: list[Any], other: Callable[..., Other]) -> Column:
    """Numbers with nothing in some rows are numbers, where NaN says so; so are truth values, alone or among numbers, and durations, which
    are none to calculate with; all else is texts."""

    def is_none(value: Any) -> bool:
        is_nan = isinstance(value, float) and value != value
        return value is None or is_nan or type(value).__name__ in ("NAType", "NaTType")

    def all_are(kinds: tuple[type, ...], but: tuple[type, ...] = ()) -> bool:
        return all(is_none(value) or (isinstance(value, kinds) and not isinstance(value, but)) for value in values)

    def numbers(of: Callable[[Any], float]) -> np.ndarray:
        return np.array([np.nan if is_none(value) else of(value) for value in values])

    try:
        if values and all_are((int, float, np.number), (bool, np.timedelta64)):
            return numbers(float)
        if values and all_are((int, float, np.number, np.bool_), (np.timedelta64,)):
            return other(*_TRUTHS, numbers(float))
    except OverflowError:
        return other("whole numbers larger than any that is calculated with", "give numbers below 1.8e308")
    if values and all_are((datetime.timedelta, np.timedelta64)):
        return other(*_DURATIONS, numbers(lambda value: value / np.timedelta64(1, "s")))

    def text(value: Any) -> str:
        if isinstance(value, (datetime.datetime, datetime.date)):
            return value.isoformat()
        return "" if is_none(value) else str(value)

    return [text(value) for value in values]


def with_columns(table: Any, columns: Mapping[str, np.ndarray], replaced: Sequence[str]) -> Any:
    """The table, of the library that made it, with columns added; some of its own give way."""
    library = library_of(table)
    lost = [name for name in replaced if name not in columns]
    if library == "pandas" and not isinstance(table, Mapping):
        kept = table.loc[:, [str(name) not in lost for name in table.columns]] if lost else table
        return kept.assign(**columns)
    if library == "polars" and hasattr(table, "with_columns"):
        import polars

        return table.drop(lost).with_columns([polars.Series(name, column) for name, column in columns.items()])
    if library == "pyarrow":
        import pyarrow

        table = table.drop_columns(lost)
        for name, column in columns.items():
            at = table.column_names.index(name) if name in table.column_names else None
            if at is None:
                table = table.append_column(name, pyarrow.array(column))
            else:
                table = table.set_column(at, name, pyarrow.array(column))
        return table
    own = {name: _without_index(column) for name, column in table.items() if str(name) not in lost}
    return Table({**own, **columns})


def _without_index(column: Any) -> Any:
    """A column whose rows are told by their places, as those of all others are, whatever pandas calls them."""
    if library_of(column) != "pandas" or not hasattr(column, "array"):
        return column
    return column.to_numpy() if isinstance(column.dtype, np.dtype) else column.array
