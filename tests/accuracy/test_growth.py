"""How the work grows with the number of links: the exponents of what Python does, which no noise of a machine moves."""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import log
from typing import Any

import pytest

from graphplan.accuracy.survey.growth import chain
from graphplan.check.cycle import cycle
from graphplan.check.trusted import construct as checked
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct

LINKS = 20, 80
WORKS: dict[str, tuple[float, Callable[[Scene], object]]] = {  # the largest exponent, and what is done
    "construct": (1.3, construct),
    "checked": (1.3, checked),
    "cycle": (1.3, lambda scene: cycle(scene, 12, (0.0, 3.0))),
    "poles": (1.6, lambda scene: construct(scene, method="poles")),
}


def calls(work: Callable[[], object]) -> int:
    """How many functions are called."""
    count = 0

    def note(frame: Any, event: str, arg: Any) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(None)
    return count


@pytest.mark.parametrize("name", WORKS)
def test_work_grows_little_more_than_the_number_of_links(name: str) -> None:
    """From 20 to 80 links the work grows with at most this power of their number."""
    most, work = WORKS[name]
    few, many = (chain(links // 2 - 1) for links in LINKS)
    work(few)  # what is made once for all scenes
    exponent = log(calls(lambda: work(many)) / calls(lambda: work(few))) / log(LINKS[1] / LINKS[0])
    assert exponent <= most
