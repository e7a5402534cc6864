"""Who works on tasks one by one: the processors of this machine, or the workers of a Dask cluster."""

from __future__ import annotations

import asyncio
import functools
import os
import queue
import secrets
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

from ._errors import TrueaxisError, kept_warnings, warn
from ._native import __version__

if TYPE_CHECKING:
    import distributed

_SECONDS = 10
"""How long a scheduler may take to answer."""
_MORE_SECONDS = 5
"""How long whoever asks may take beyond that to say that nobody answers."""
_WORKER_SECONDS = 60
"""How long a scheduler may be without any worker."""
_PAUSE = 0.01
"""How long nobody looks for results, s."""

Each = Callable[[Callable[[tuple], Any], list[tuple]], Iterator[Any]]
"""Does a piece of work for each task, and gives what it returns as it is done."""

_TOLD = 5
"""How many warnings of one stretch of work are told one by one."""


@contextmanager
def workers(client: distributed.Client | str | None) -> Iterator[Each]:
    """Those who do the work: the processors of this machine, or the workers of a scheduler. What they warn of is told here, each once."""
    told: set[str] = set()

    def each(done: Each, work: Callable[[tuple], Any], tasks: list[tuple]) -> Iterator[Any]:
        kept: dict[int, list[str]] = {}
        for number, result, warnings in done(functools.partial(_heard, work), list(enumerate(tasks))):
            kept[number] = warnings
            yield result
        new = dict.fromkeys(text for number in sorted(kept) for text in kept[number] if text not in told)
        told.update(new)
        for text in list(new)[:_TOLD]:
            warn(text)
        if len(new) > _TOLD:
            warn(f"{len(new) - _TOLD} more warnings like these, of other rows")

    with _doing(client) as done:
        yield functools.partial(each, done)


def _heard(work: Callable[[tuple], Any], numbered: tuple[int, tuple]) -> tuple[int, Any, list[str]]:
    """What a piece of work returns, with its number and what it warns of: who does it has no line of the caller's to warn at."""
    number, task = numbered
    with kept_warnings() as kept:
        return number, work(task), kept


@contextmanager
def _doing(client: distributed.Client | str | None) -> Iterator[Each]:
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

    if not isinstance(client, (str, distributed.Client)):
        raise TypeError(f"client: give a Dask client or the address of a scheduler, not a {type(client).__name__}")
    own = None
    if isinstance(client, str):
        _require_scheduler(client, distributed.Security())
        client = own = _connected(client)
    else:
        _require_usable(client)
    address = client.scheduler.address
    try:
        try:
            with _lost_is_told(client, address):
                client.wait_for_workers(1, timeout=_WORKER_SECONDS)
        except asyncio.TimeoutError:
            raise TrueaxisError(f"the scheduler at `{address}` has no worker: start one with `dask worker {address}`") from None

        def there(work, tasks):
            with _lost_is_told(client, address):
                futures = client.map(work, tasks, pure=False, key=f"trueaxis-{secrets.token_hex(4)}")
            try:
                yield from _done(client, address, distributed.as_completed(futures, with_results=True, raise_errors=False))
            finally:
                # Who is gone has nothing to be cancelled.
                with suppress(Exception):
                    client.cancel(futures)

        yield there
    finally:
        if own is not None:
            own.close(timeout=_SECONDS)


def _done(client: distributed.Client, address: str, results: distributed.as_completed) -> Iterator[Any]:
    """What pieces of work return, as they are done: as long as there is a scheduler, and a worker that could do the rest."""
    from distributed.scheduler import KilledWorker

    looked = heard = busy = time.monotonic()
    while not results.is_empty():
        if results.has_ready():
            future, result = next(results)
            if isinstance(result, BaseException):
                raise _lost(address)
            if future.status == "error":
                _, error, trace = result
                if isinstance(error, KilledWorker):
                    raise TrueaxisError(f"workers of the scheduler at `{address}` died, one after the other, over the same file")
                raise error.with_traceback(trace)
            yield result
            continue
        time.sleep(_PAUSE)
        now = time.monotonic()
        if now - looked < 1:
            continue
        looked = now
        # A scheduler that does not answer has lost nothing yet.
        with suppress(Exception):
            if client.nthreads(callback_timeout=_SECONDS):
                busy = now
            heard = now
        if time.monotonic() - heard > _SECONDS:
            raise _lost(address)
        if heard - busy > _WORKER_SECONDS:
            raise TrueaxisError(
                f"the scheduler at `{address}` has had no worker for {_WORKER_SECONDS} s, and work is left: start some and ask again"
            )


def _lost(address: str) -> TrueaxisError:
    return TrueaxisError(f"the scheduler at `{address}` does not answer any more: see whether it runs, and ask again")


@contextmanager
def _lost_is_told(client: distributed.Client, address: str) -> Iterator[None]:
    """Tells of a scheduler that is gone by its address."""
    try:
        yield
    except asyncio.TimeoutError:
        raise
    except Exception as error:
        if isinstance(error, OSError) or client.status != "running":
            raise _lost(address) from None
        raise


def _require_usable(client: distributed.Client) -> None:
    """Refuses a client that nobody can wait for."""
    what = "closed" if client.status in ("closing", "closed") else "asynchronous" if client.asynchronous else None
    if what is not None:
        raise TrueaxisError(f"client: this Dask client is {what}: give one that is open and not asynchronous, or the address of its scheduler")
    _require_scheduler(client.scheduler.address, client.security)


def _require_scheduler(address: str, security: distributed.Security) -> None:
    """Refuses an address where no scheduler answers. A client that connects to something else may wait for ever, and be ended as little:
    a thread that nobody waits for asks before."""
    from distributed.core import rpc

    answers: queue.SimpleQueue[Any] = queue.SimpleQueue()

    async def identity() -> dict[str, Any]:
        async with rpc(address, timeout=_SECONDS, connection_args=security.get_connection_args("client")) as there:
            return await there.identity()

    def ask() -> None:
        try:
            answers.put(asyncio.run(identity()))
        except Exception as error:
            answers.put(error)

    threading.Thread(target=ask, name="trueaxis-asks", daemon=True).start()
    try:
        answer = answers.get(timeout=_SECONDS + _MORE_SECONDS)
    except queue.Empty:
        answer = TimeoutError(f"what is there has said nothing for {_SECONDS + _MORE_SECONDS} s")
    if isinstance(answer, Exception):
        raise TrueaxisError(f"no scheduler answers at `{address}`: {answer}") from None
    if "workers" not in answer:
        kind, scheduler = answer.get("type", "something else"), answer.get("scheduler")
        instead = f": give the address of its scheduler, `{scheduler}`" if scheduler else ""
        raise TrueaxisError(f"no scheduler answers at `{address}`: this is the address of a {kind}{instead}")


def _connected(address: str) -> distributed.Client:
    import distributed

    class Client(distributed.Client):
        def __init__(self):
            try:
                super().__init__(address, timeout=_SECONDS)
            except BaseException:
                # Left open it ends its thread when it is collected: where another one starts meanwhile, each waits for the other.
                with suppress(Exception):
                    self.close(timeout=_SECONDS)
                raise

    try:
        return Client()
    except (OSError, ValueError) as error:
        raise TrueaxisError(f"no scheduler answers at `{address}`: {error}") from None


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
