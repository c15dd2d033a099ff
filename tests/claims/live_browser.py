"""Chromium, once in a process, and live pages in it: none may say anything on its console or ask for another file."""

from __future__ import annotations

import atexit
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from tempfile import mkdtemp
from typing import Any

import pytest
from face import ran

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
LOOK = {"viewport": {"width": 1280, "height": 800}, "reduced_motion": "reduce"}


@cache
def browser() -> Any:
    """A browser without a window, until the process ends."""
    api = pytest.importorskip("playwright.sync_api")
    if CHROMIUM is None:
        pytest.skip("no Chromium is installed")
    play = api.sync_playwright().start()
    running = play.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
    atexit.register(play.stop)
    atexit.register(running.close)
    return running


@cache
def folder() -> Path:
    made = Path(mkdtemp(prefix="graphplan-live-"))
    atexit.register(shutil.rmtree, made, True)
    return made


@cache
def page_of(*arguments: str) -> Path:
    """The page that a command writes: its name, the scene, further options."""
    path = folder() / f"{'-'.join(Path(word).name for word in arguments)}.html"
    done = ran(*arguments, "-q", "-o", path)
    assert done.status == 0, done.err
    return path


@contextmanager
def opened(path: Path, **look: Any) -> Iterator[Any]:
    """A page, opened and ready."""
    found = browser().new_page(**{**LOOK, **look})
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


@contextmanager
def live(scene: str, *options: str, **look: Any) -> Iterator[Any]:
    """The live page of a scene, without choices where none are asked for."""
    with opened(page_of("live", scene, *(options or ("--choices", "none"))), **look) as page:
        yield page
