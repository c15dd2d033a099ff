"""How the work grows with the number of links: the exponents of what Python does, which no noise of a machine moves."""

from __future__ import annotations

import sys
from collections.abc import Callable
from math import log
from typing import Any

import pytest
from tiers import sample

from graphplan.accuracy.survey.growth import chain
from graphplan.check.cycle import cycle
from graphplan.check.trusted import construct as checked
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
from graphplan.sheet import svg

LONG = sample(100, 1000)  # links of a chain that is checked
LINKS = 40, 80  # constructions of fewer links are drawn a few times more, to choose what suits a pencil
SHORT = 10, 32
WORKS: dict[str, tuple[float, tuple[int, int], Callable[[Scene], object]]] = {  # the largest exponent, of which links
    "construct": (1.15, LINKS, construct),
    "checked": (1.15, LINKS, checked),
    "cycle": (1.25, SHORT, lambda scene: cycle(scene, 12, (0.0, 3.0))),
    "poles": (1.2, SHORT, lambda scene: construct(scene, method="poles", by_pencil=False)),
    "draw": (1.45, (10, 40), lambda scene: svg(checked(scene))),  # of more links more papers are tried
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
    """From so many links to so many the work grows with at most this power of their number."""
    most, links, work = WORKS[name]
    few, many = (chain(count // 2 - 1) for count in links)
    work(few)  # what is made once for all scenes
    exponent = log(calls(lambda: work(many)) / calls(lambda: work(few))) / log(links[1] / links[0])
    assert exponent <= most


def test_a_check_costs_about_three_times_the_construction() -> None:
    """What is compared with the solver, in forty digits where floats do not do, and drawn out to see that each step is
    as it should be, takes three times the work of what is not checked, however long the chain."""
    scene = chain(LONG // 2 - 1)
    assert calls(lambda: checked(scene)) <= 3.1 * calls(lambda: construct(scene))
