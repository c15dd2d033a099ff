"""Processes that answer the board's questions, and are stopped where an answer takes too long or nobody waits for it.

A scene may take longer than anybody waits, so nothing is computed in the server itself. Each worker is a process that
answers one question after another; it ends by itself when the server does, however that ends.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from queue import SimpleQueue
from typing import Any

Answer = dict[str, Any]
LIMIT = 20.0  # seconds that an answer may take
PATIENCE = 0.5  # seconds for which a newer question waits for the answer to an older one
PERIOD = 0.02  # seconds between two looks at whether an answer is there
# Forking from one process that has all imported gives a new worker in some hundredths of a second.
METHOD = "forkserver" if "forkserver" in multiprocessing.get_all_start_methods() else "spawn"
CONTEXT: Any = multiprocessing.get_context(METHOD)
CONTEXT.set_forkserver_preload(["graphplan.board.warm"])


class Superseded(Exception):
    """Raised for a question whose answer is not wanted any more, as a newer one was asked."""


class OutOfTime(Exception):
    """Raised for a question that was not answered within the limit."""


class WorkerDied(Exception):
    """Raised for a question at which the process ended, such as for want of memory."""


def answer_questions(questions: Connection) -> None:
    """Answer questions, the whole life of a worker."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which ends its workers
    waiting = SimpleQueue[tuple[str, Mapping[str, Any]]]()

    def listen() -> None:
        with suppress(EOFError, OSError):
            while True:
                waiting.put(questions.recv())
        os._exit(0)  # the server is gone

    threading.Thread(target=listen, daemon=True).start()
    from graphplan.board.warm import ANSWERS  # the server itself does not load all that answers need

    while True:
        name, values = waiting.get()
        questions.send(ANSWERS[name](**values))


class Worker:
    """A process that answers one question at a time; a newer question with the same `key` takes an older one's place.
    """

    def __init__(self, limit: float = LIMIT):
        self.limit = limit
        self._turn = asyncio.Lock()
        self._newest = dict[str, object]()
        self._answering: object = None
        self._process: Any = None
        self._pipe: Connection | None = None

    async def ask(self, name: str, key: str = "", /, **values: Any) -> Answer:
        """Return the answer of a function.

        Raises `Superseded` where a newer question with the same key came before the answer, if there is a key,
        `OutOfTime` where the answer takes too long, and `WorkerDied` where the process ended.
        """
        ticket, older = object(), self._newest.get(key)
        if key:
            self._newest[key] = ticket
            if older is not None and older is self._answering:
                asyncio.get_running_loop().call_later(PATIENCE, self._stop_at, older)
        try:
            async with self._turn:
                if key and self._newest[key] is not ticket:
                    raise Superseded
                self._answering = ticket
                try:
                    return await self._exchange(name, values)
                except (EOFError, OSError):
                    raise (WorkerDied if self._answering is ticket else Superseded) from None
                finally:
                    self._answering = None
        finally:
            if self._newest.get(key) is ticket:
                del self._newest[key]

    def start(self) -> None:
        """Start the process, where there is none."""
        if self._process is None:
            self._pipe, theirs = CONTEXT.Pipe()
            self._process = CONTEXT.Process(target=answer_questions, args=(theirs,), daemon=True)
            self._process.start()
            theirs.close()

    def stop(self) -> None:
        """End the process, whatever it does."""
        process, pipe, self._process, self._pipe = self._process, self._pipe, None, None
        if process is not None and pipe is not None:
            process.kill()
            process.join()
            process.close()
            pipe.close()

    async def _exchange(self, name: str, values: Mapping[str, Any]) -> Answer:
        self.start()
        pipe, ends, wait = self._pipe, time.monotonic() + self.limit, PERIOD / 10
        assert pipe is not None
        try:
            pipe.send((name, values))
            while not pipe.poll():  # OSError where the process was stopped meanwhile
                if time.monotonic() > ends:
                    raise OutOfTime
                await asyncio.sleep(wait)
                wait = min(wait * 1.5, PERIOD)
            answer: Answer = pipe.recv()
        except BaseException:
            self.stop()
            raise
        return answer

    def _stop_at(self, ticket: object) -> None:
        """Stop the process where it still answers this question."""
        if self._answering is ticket:
            self._answering = None
            self.stop()
