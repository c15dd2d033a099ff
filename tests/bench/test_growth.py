"""How work grows with the number of links, and what second thoughts cost: calls, which no noise moves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import log

import pytest
from counted_calls import OF_PYTHON, count_calls
from sheet.test_second_thoughts import crowd

import graphplan as gp
from graphplan.accuracy.survey.growth import chain
from graphplan.check.cycle import cycle
from graphplan.check.trusted import construct as checked
from graphplan.cycle import follow
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct

LINKS = 80, 160  # constructions of fewer links are drawn a few times more, to choose what suits a pencil
SHORT = 10, 32
WORKS: dict[str, tuple[float, tuple[int, int], Callable[[Scene], object]]] = {  # the largest exponent, of which links
    "construct": (1.1, LINKS, construct),
    "checked": (1.1, LINKS, checked),
    "follow": (1.05, (60, 240), lambda scene: follow(scene, 3, (0.0, 3.0))),
    "cycle": (1.22, SHORT, lambda scene: cycle(scene, 12, (0.0, 3.0))),
    "poles": (1.18, SHORT, lambda scene: construct(scene, method="poles", by_pencil=False)),
    "draw": (1.25, (4, 40), lambda scene: gp.sheet.svg(gp.construct(scene))),  # of more links more papers are tried
}
LONG = 400  # links of a chain of which floats prove all digits


@cache
def calls(name: str, links: int) -> int:
    """How many functions are called for a chain of so many links, once what is made for all scenes is made."""
    *_, work = WORKS[name]
    work(chain(2))
    scene = chain(links // 2 - 1)
    return count_calls(lambda: work(scene))


@pytest.mark.parametrize("name", WORKS)
def test_work_grows_little_more_than_the_number_of_links(name: str) -> None:
    """From so many links to so many the work grows with at most this power of their number."""
    most, (few, many), _ = WORKS[name]
    assert log(calls(name, many) / calls(name, few)) / log(many / few) <= most


def test_a_check_costs_about_two_and_a_half_constructions() -> None:
    """What is compared with the solver, and drawn out to see that each step is as it should be, takes about two and a
    half times the work of what is not checked, where no more digits are needed than floats have."""
    assert calls("checked", LONG) <= 2.6 * calls("construct", LONG)


def test_second_thoughts_cost_little_more_than_first_ones() -> None:
    """Neighbours that are asked to make room are not moved to see whether they can, and places beside those that stay
    are looked at once: three crowds take at most 6.5 times the calls that placing their letters at first did, and half
    of that in haste."""
    crowd(4, 0)
    first = second = hasty = 0
    for seed in range(3):
        first += count_calls(lambda: crowd(30, seed), OF_PYTHON)  # noqa: B023
        letters = crowd(30, seed)
        in_haste = replace(letters, in_haste=True)
        hasty += count_calls(lambda: in_haste.places, OF_PYTHON)  # noqa: B023
        second += count_calls(lambda: letters.places, OF_PYTHON)  # noqa: B023
    assert 2 * hasty <= second <= 6.5 * first
