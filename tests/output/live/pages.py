"""Live pages in a browser: one browser, each page written once."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest

from graphplan.commands import main

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
VOID = {"meta", "br", "hr", "input", "link", "img"}


@cache
def folder() -> Path:
    return Path(mkdtemp(prefix="graphplan-live-"))


@cache
def page_of(*arguments: str) -> Path:
    """The page that a command writes: its name, the scene, further options."""
    path = folder() / f"{'-'.join(arguments).replace('/', '')}.html"
    assert main([*arguments, "-o", str(path)]) == 0
    return path


@contextmanager
def chromium() -> Iterator[Any]:
    """A browser without a window."""
    api = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed")
    with api.sync_playwright() as play:
        running = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield running
        running.close()


@contextmanager
def opened(browser: Any, path: Path, **look: Any) -> Iterator[Any]:
    """A page, opened and ready; it may say nothing on the console and ask nothing of the network."""
    found = browser.new_page(**{"viewport": {"width": 1280, "height": 800}, "reduced_motion": "reduce", **look})
    complaints: list[str] = []
    found.on("console", lambda message: complaints.append(message.text))
    found.on("pageerror", lambda error: complaints.append(str(error)))
    found.on("request", lambda request: None if request.url == path.as_uri() else complaints.append(request.url))
    found.goto(path.as_uri())
    found.evaluate("graphplan.ready")
    try:
        yield found
    finally:
        found.close()
    assert complaints == []


class Reader(HTMLParser):
    """Reads a page: whether its elements are balanced, their attributes, and the text of scripts by id."""

    def __init__(self, page: str):
        super().__init__()
        self.open: list[str] = []
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.scripts: dict[str, str] = {}
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "script":
            self.scripts[self.elements[-1][1].get("id") or ""] = data
