"""One observable of a chain, compiled."""

from __future__ import annotations

import ctypes
import functools
import os
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from . import _native
from ._compiler import compile_and_load
from ._inputs import observable_of
from ._over_arrays import OverArrays

if TYPE_CHECKING:
    from ._chain import Chain

_ADDRESS, _SIZE = ctypes.c_void_p, ctypes.c_size_t
# Rows that are computed before somebody looks for Ctrl-C; whole blocks of vector code.
_ROWS = 1 << 16
# Errors, columns, their steps, rows, start, end, which derivatives, how many, where the result goes.
_ARGUMENTS = [_ADDRESS, _ADDRESS, _ADDRESS, _SIZE, _SIZE, _SIZE, _ADDRESS, _SIZE, _ADDRESS]


class Compiled(OverArrays):
    """One observable of a chain, by C that was compiled for it; :meth:`trueaxis.Chain.compiled` makes one.

    :meth:`exact`, :meth:`first_order` and :meth:`jacobian` take and return what those of the chain do, and refuse the same. Three
    things differ. Results are the chain's but for rounding, where the processor fuses products with sums. Constants are
    compiled in: errors that set one to another value are refused, and so are derivatives by constants. ``observable`` is the
    one that was compiled.

    Several threads may use it at once. Arrays are read in place, so nobody may write to them meanwhile. A copy that another process
    gets (by pickle) is compiled there.
    """

    def __init__(self, chain: Chain, observable: str | None = None, compiler: str | os.PathLike[str] | None = None):
        self._chain = chain
        self._compiler = compiler
        self._native = chain._native
        loadable = self._native.loadable(observable_of(observable))
        function = compile_and_load(loadable.files, compiler)
        entries = {form: function(name) for form, name in loadable.entries}
        for entry in entries.values():
            entry.argtypes, entry.restype = _ARGUMENTS, None
        self._observable = loadable.observable
        self._compiled = loadable, functools.partial(_run, entries)

    @property
    def chain(self) -> Chain:
        """The chain."""
        return self._chain

    @property
    def observable(self) -> str:
        """The observable that was compiled."""
        return self._observable

    def __reduce__(self):
        return type(self), (self._chain, self._observable, self._compiler)

    def __repr__(self) -> str:
        return f"<trueaxis.Compiled {self._chain.name}: {self._observable}>"


def _run(entries: dict[str, ctypes._CFuncPtr], form: str, call: _native.Call) -> None:
    entry = entries[form]
    *others, own = call.shares
    stop = threading.Event()
    working = [_pool().submit(_share, entry, call, stop, *share) for share in others]
    try:
        _share(entry, call, stop, *own)
    except BaseException:
        # Ctrl-C, between the rows of this thread: the others end theirs.
        stop.set()
        raise
    finally:
        for work in working:
            work.result()


def _share(entry: ctypes._CFuncPtr, call: _native.Call, stop: threading.Event, start: int, end: int) -> None:
    # The call owns what the addresses point to, and is held until the entry is done. ctypes gives the interpreter's lock away.
    before, behind = call.arguments
    for first in range(start, end, _ROWS):
        if stop.is_set():
            break
        entry(*before, first, min(first + _ROWS, end), *behind)


@functools.cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(max_workers=os.cpu_count(), thread_name_prefix="trueaxis")


# A process that was forked has the pool, but none of its threads.
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_pool.cache_clear)
