"""Many things done at once, in processes of their own, and kept, so that doing them again does only what is new.

What is kept is found by a digest of all that it was made from. A process that dies takes nothing else with it: what
was under way is done once more, each alone, and what fails alone is told.
"""

from __future__ import annotations

import json
import os
import signal
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from hashlib import blake2b
from multiprocessing import get_context, parent_process
from pathlib import Path
from threading import Thread
from typing import Any, TypeVar

from graphplan.errors import GraphplanError
from graphplan.marking.classroom import measures
from graphplan.threads import THREAD_COUNT_VARIABLES

Data = dict[str, Any]
Job = TypeVar("Job")
FAULT_KEY = "fault"  # of data: why it cannot be done, instead of all else
FILES_KEY = "files"  # of data: names of files beside it that belong to it
OF_A_PROCESS = *THREAD_COUNT_VARIABLES, "OPENCV_FOR_THREADS_NUM"  # the threads: each core has a process
PROCESS_DIED = "the process that worked on it died"


@dataclass(frozen=True)
class Keeper:
    """A folder in which results are kept."""

    folder: Path

    def get(self, key: str) -> Data | None:
        """The data kept under a key; None if there are no readable data, or one of their files is missing."""
        try:
            data = json.loads((self.folder / f"{key}.json").read_text(encoding="utf-8"))
        except (OSError, ValueError, RecursionError):
            return None
        whole = isinstance(data, dict) and all((self.folder / name).is_file() for name in data.get(FILES_KEY, ()))
        return data if whole else None

    def put(self, key: str, data: Data) -> None:
        """Keep data, whole or not at all."""
        self.folder.mkdir(parents=True, exist_ok=True)
        write_whole(self.folder / f"{key}.json", json.dumps(data, ensure_ascii=False).encode())


def write_whole(path: Path, content: bytes) -> None:
    """Write a file in one step, whole or not at all."""
    temporary = path.with_name(f".{path.name}-{os.getpid()}")
    try:
        temporary.write_bytes(content)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def key(*parts: Any) -> str:
    """A digest of what something is made from."""
    return blake2b(repr(parts).encode(), digest_size=measures.DIGEST_BYTES, person=b"graphplan key").hexdigest()


def file_digest(path: Path) -> str:
    """A digest of a file's bytes."""
    digest = blake2b(digest_size=measures.DIGEST_BYTES, person=b"graphplan file")
    with path.open("rb") as file:
        while block := file.read(measures.READ_BYTES):
            digest.update(block)
    return digest.hexdigest()


def run_jobs(work: Callable[[Job], Data], jobs: Mapping[str, Job], keeper: Keeper, processes: int
              ) -> Iterator[tuple[str, Data]]:
    """Yield the result of each job, by its key, as it is done: kept ones first, and new ones are kept.

    A job is data that can go to another process, `work` a function of a module.
    """
    new = dict[str, Job]()
    for name, job in jobs.items():
        if (data := keeper.get(name)) is not None:
            yield name, data
        else:
            new[name] = job
    for name, outcome in _run_together(work, new, processes):
        if FAULT_KEY not in outcome:
            keeper.put(name, outcome)
        yield name, outcome


def _run_together(work: Callable[[Job], Data], jobs: Mapping[str, Job], processes: int
                   ) -> Iterator[tuple[str, Data]]:
    """The jobs, so many at once; each alone that was under way, or waited, when a process died."""
    if min(processes, len(jobs)) < 2:
        yield from ((name, _try_job(work, job)) for name, job in jobs.items())
        return
    waiting = dict(jobs)
    for name, outcome in _run_in_pool(work, jobs, min(processes, len(jobs))):
        del waiting[name]
        yield name, outcome
    for name, job in waiting.items():
        yield next(iter(_run_in_pool(work, {name: job}, 1)), (name, {FAULT_KEY: PROCESS_DIED}))


def _run_in_pool(work: Callable[[Job], Data], jobs: Mapping[str, Job], processes: int
                 ) -> Iterator[tuple[str, Data]]:
    """Yield the results until a process dies; an interrupted one lets the begun jobs end by themselves."""
    with _one_thread_each():
        pool = ProcessPoolExecutor(processes, get_context("spawn"), _start_process)
        futures: dict[Future[Data], str] = {pool.submit(_try_job, work, job): name
                                                     for name, job in jobs.items()}
    try:
        for future in as_completed(futures):
            yield futures[future], future.result()
    except BrokenProcessPool:
        return
    finally:
        for future in futures:
            future.cancel()
        pool.shutdown(wait=False)


def _start_process() -> None:
    """Begin a process that ends with the one that started it, however that ends, and by no key pressed meanwhile."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    if parent := parent_process():
        parent.join()
        os._exit(1)


def _try_job(work: Callable[[Job], Data], job: Job) -> Data:
    """Run a job and return its result or its fault."""
    try:
        return work(job)
    except GraphplanError as fault:
        return {FAULT_KEY: fault.lines[0]}
    except MemoryError:
        return {FAULT_KEY: "there is not enough memory for it"}
    except Exception as fault:  # nothing that is wrong with one page may stop the others
        return {FAULT_KEY: f"{type(fault).__name__}: {fault}"}


@contextmanager
def _one_thread_each() -> Iterator[None]:
    """The processes that start meanwhile have one thread each for sums of arrays."""
    before = {name: os.environ.get(name) for name in OF_A_PROCESS}
    os.environ.update(dict.fromkeys(OF_A_PROCESS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
