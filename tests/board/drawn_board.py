"""A board that the command serves, and its page in Chromium: mouse and keys alone, as a reader has them."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from live_browser import LOOK, browser

PROGRAM = "import sys; from graphplan.commands import main; sys.exit(main(sys.argv[1:]))"


class Server:
    """A running command, its address and the parts of that."""

    def __init__(self, *arguments: str | Path, program: str = PROGRAM):
        words = [sys.executable, "-c", program, "board", *map(str, arguments), "--no-browser"]
        self.process = subprocess.Popen(words, stderr=subprocess.PIPE, text=True)
        assert self.process.stderr is not None
        found = re.search(r"http://\S+", self.process.stderr.readline())
        assert found is not None
        self.address = found[0]
        self.host, self.token = urlsplit(self.address).netloc, self.address.partition("token=")[2]

    def end(self) -> int:
        """Ends it as Ctrl-C does; its exit status."""
        self.process.send_signal(2)
        assert self.process.stderr is not None
        self.process.stderr.close()
        return self.process.wait(30)


@contextmanager
def served(*arguments: str | Path) -> Iterator[Server]:
    server = Server(*arguments)
    try:
        yield server
    finally:
        server.end()


class Page:
    """A page of the board; presses are at places of the scene."""

    def __init__(self, page: Any):
        self.page = page

    def tool(self, name: str) -> None:
        """Take a tool, or press another button."""
        self.page.get_by_role("button", name=name, exact=True).click()

    def at(self, place: tuple[float, float]) -> list[float]:
        """Where a place of the scene is on the screen."""
        return self.page.evaluate("place => board.screen(place)", [*place])

    def press(self, *places: tuple[float, float]) -> None:
        """Click on one place after another."""
        for place in places:
            self.page.mouse.click(*self.at(place))

    def drag(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """Press at one place, release at another."""
        a, b = self.at(start), self.at(end)
        self.page.mouse.move(*a)
        self.page.mouse.down()
        self.page.mouse.move((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        self.page.mouse.move(*b)
        self.page.mouse.up()

    def link(self, *places: tuple[float, float]) -> None:
        """Draw a link through points."""
        self.press(*places)
        self.page.keyboard.press("Enter")

    def settle(self) -> None:
        """Wait for all answers."""
        self.page.evaluate("board.settled()")

    def scene(self) -> str:
        """The text, when all is answered."""
        self.settle()
        return self.page.evaluate("board.scene()")

    def load(self, text: str) -> None:
        """Bring another scene."""
        self.page.evaluate("text => board.load(text)", text)
        self.settle()

    def results(self) -> Any:
        """The results, when all is answered."""
        self.settle()
        return self.page.evaluate("board.results()")

    def faults(self) -> list[str]:
        """The faults, when all is answered."""
        self.settle()
        return self.page.evaluate("board.faults()")


@contextmanager
def board(server: Server, **look: Any) -> Iterator[Page]:
    """The page of a server; it must not say anything on its console, nor ask another host."""
    found = browser().new_page(**{**LOOK, **look})
    complaints: list[str] = []
    found.on("console", lambda message: complaints.append(message.text))
    found.on("pageerror", lambda error: complaints.append(str(error)))
    found.on("request", lambda request: None if urlsplit(request.url).netloc in (server.host, "") else
             complaints.append(request.url))
    found.goto(server.address)
    found.evaluate("board.ready")
    try:
        yield Page(found)
    finally:
        found.close()
    assert complaints == []
