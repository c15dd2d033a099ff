"""Who does work that can be shared out: this process or its threads, several processes, or a dask cluster."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from graphplan.errors import Refused

if TYPE_CHECKING:  # what shares work out is loaded where work is shared out
    from concurrent.futures import Executor, Future

AHEAD = 2  # parts for each worker that wait for it: it never idles, and memory stays small
PATIENCE = "10s"  # for a scheduler to answer
SharedOut = Callable[[Callable[[Any], Any], Iterable[Any]], Iterator[Any]]  # the work and its parts: what it makes


def cores() -> int:
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def worker_pool(workers: int | str) -> Iterator[SharedOut]:
    """What does work part by part and gives what is made of each, in order: so many processes, or the dask scheduler at
    an address. One worker is this process.

    Fails with `Refused` where there is nobody to do it.
    """
    if workers == 1:
        yield map
        return
    with (_cluster(workers) if isinstance(workers, str) else _processes(workers)) as (executor, hands):
        yield partial(_shared_out, executor, hands)


def _shared_out(executor: Executor, hands: int, work: Callable[[Any], Any], parts: Iterable[Any]) -> Iterator[Any]:
    waiting: deque[Future[Any]] = deque()
    try:
        for part in parts:
            waiting.append(executor.submit(work, part))
            if len(waiting) > AHEAD * hands:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    finally:  # nobody wants the rest
        for future in waiting:
            future.cancel()


@contextmanager
def threads(workers: int) -> Iterator[SharedOut]:
    """What does work on arrays of this process, as numpy and machine code let others run meanwhile; `worker_pool` has
    more."""
    _require_workers(workers)
    if workers == 1:
        yield map
        return
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(workers) as pool:
        yield partial(_shared_out, pool, workers)


def _require_workers(workers: int) -> None:
    if workers < 1:
        raise Refused(f"workers {workers}", "no worker", "give at least 1")


@contextmanager
def _processes(workers: int) -> Iterator[tuple[Executor, int]]:
    """Processes of this machine, and how many they are."""
    _require_workers(workers)
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor

    pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))
    try:
        yield pool, workers
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _cluster(address: str) -> Iterator[tuple[Executor, int]]:
    """The workers of a dask scheduler, and how many they are."""
    try:
        from distributed import Client
    except ImportError:
        raise Refused(f"workers {address}", "dask is not installed", "pip install 'graphplan[dask]'") from None
    try:
        client: Any = cast(Any, Client)(address, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise Refused(f"workers {address}", f"no dask scheduler answers ({error})",
                      "a number of processes, or an address such as tcp://host:8786") from None
    try:
        yield client.get_executor(), max(1, sum(client.nthreads().values()))
    finally:
        client.close()
