"""Many hands: poses shared out among processes of this machine, or among the workers of a dask cluster."""

from __future__ import annotations

import multiprocessing
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, cast

from graphplan.errors import Refused
from graphplan.methods.batch import Coordinates, Faults, Results, stretch

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction

Found = tuple[Results, Faults]
AHEAD = 2  # stretches for each worker that wait for it: it never idles, and memory stays small
PATIENCE = "10s"  # for a scheduler to answer


def errand(construction: Construction, given: Coordinates, kinds: tuple[str, ...], machine: bool) -> Found:
    """The results and faults of one stretch of poses."""
    n = len(next(iter(next(iter(given.values())).values())))
    results = {kind: named for kind, named in construction.blank(n, None).items() if kind in kinds}
    return results, stretch(construction, given, results, machine)


def shared_out(construction: Construction, parts: Iterable[Coordinates], kinds: tuple[str, ...], workers: int | str,
               machine: bool) -> Iterator[Found]:
    """The results of each part, in order."""
    with _executor(workers) as (executor, hands):
        waiting: deque[Future[Found]] = deque()
        for part in parts:
            waiting.append(executor.submit(errand, construction, part, kinds, machine))
            if len(waiting) > AHEAD * hands:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()


def _executor(workers: int | str) -> AbstractContextManager[tuple[Executor, int]]:
    """Who does the work, and how many they are."""
    if isinstance(workers, str):
        return _Cluster(workers)
    if workers < 1:
        raise Refused(f"workers {workers}", "nobody would do the work", "at least 1")
    return _Pool(workers)


class _Pool(AbstractContextManager[tuple[Executor, int]]):
    """Processes of this machine."""

    def __init__(self, workers: int):
        self.pool = ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"))
        self.workers = workers

    def __enter__(self) -> tuple[Executor, int]:
        return self.pool, self.workers

    def __exit__(self, *error: object) -> None:
        self.pool.shutdown(cancel_futures=True)


class _Cluster(AbstractContextManager[tuple[Executor, int]]):
    """The workers of a dask scheduler."""

    def __init__(self, address: str):
        try:
            from distributed import Client
        except ImportError:
            raise Refused(f"workers {address}", "dask is not installed", "pip install 'graphplan[dask]'") from None
        try:
            self.client: Any = cast(Any, Client)(address, timeout=PATIENCE)
        except (OSError, ValueError) as error:
            raise Refused(f"workers {address}", f"no dask scheduler answers there ({error})",
                          "a number of processes, or an address such as tcp://host:8786") from None

    def __enter__(self) -> tuple[Executor, int]:
        return self.client.get_executor(), max(1, sum(self.client.nthreads().values()))

    def __exit__(self, *error: object) -> None:
        self.client.close()
