"""Workers that share work out: this process or its threads, several processes, or a dask cluster."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, cast

from graphplan.errors import Refused, missing_package

if TYPE_CHECKING:  # what shares work out is loaded where work is shared out
    from concurrent.futures import Executor, Future

AHEAD = 2  # parts for each worker that wait for it: it never idles, and memory stays small
PATIENCE = "10s"  # for a scheduler to answer
SharedOut = Callable[[Callable[[Any], Any], Iterable[Any]], Iterator[Any]]  # the work and its parts: what it makes


def cores() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def worker_pool(workers: int | str, threads: bool = False) -> Iterator[SharedOut]:
    """A function that does work part by part and gives the results in order: by so many processes, or by the dask
    scheduler at an address. One worker is this process; `threads` of it serve where numpy or machine code works.

    Fails with `Refused` where there is nobody to do it.
    """
    if workers == 1:
        yield map
    elif isinstance(workers, str):
        with _cluster(workers) as client:
            yield partial(_shared_out, client.get_executor(), max(1, sum(client.nthreads().values())))
    elif workers < 1:
        raise Refused(f"workers {workers}", "no worker", "give at least 1")
    else:
        import multiprocessing
        from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

        pool = (ThreadPoolExecutor(workers) if threads
                else ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")))
        try:
            yield partial(_shared_out, pool, workers)
        finally:
            pool.shutdown(cancel_futures=True)


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


def _cluster(address: str) -> Any:
    """The client of a dask scheduler; it closes where its `with` ends."""
    try:
        from distributed import Client
    except ImportError:
        raise missing_package(f"workers {address}", "dask", "dask") from None
    try:
        return cast(Any, Client)(address, timeout=PATIENCE)
    except (OSError, ValueError) as error:
        raise Refused(f"workers {address}", f"no dask scheduler answers ({error})",
                      "a number of processes, or an address such as tcp://host:8786") from None
