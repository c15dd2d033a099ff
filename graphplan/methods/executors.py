"""Work shared out among processes of this machine, or among the workers of a dask cluster."""

from __future__ import annotations

import multiprocessing
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any, cast

from graphplan.errors import Refused

AHEAD = 2  # parts for each worker that wait for it: it never idles, and memory stays small
PATIENCE = "10s"  # for a scheduler to answer


def shared_out(work: Callable[[Any], Any], parts: Iterable[Any], workers: int | str) -> Iterator[Any]:
    """What the work makes of each part, in order."""
    with (_cluster(workers) if isinstance(workers, str) else _processes(workers)) as (executor, hands):
        waiting: deque[Future[Any]] = deque()
        for part in parts:
            waiting.append(executor.submit(work, part))
            if len(waiting) > AHEAD * hands:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()


@contextmanager
def _processes(workers: int) -> Iterator[tuple[Executor, int]]:
    """Processes of this machine, and how many they are."""
    if workers < 1:
        raise Refused(f"workers {workers}", "nobody would do the work", "at least 1")
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
        raise Refused(f"workers {address}", f"no dask scheduler answers there ({error})",
                      "a number of processes, or an address such as tcp://host:8786") from None
    try:
        yield client.get_executor(), max(1, sum(client.nthreads().values()))
    finally:
        client.close()
