"""Dimensions on a task's figure: lengths and angles as given, clear of all else, on no solution."""

from __future__ import annotations

import pytest
from sheets import composition_of, pages_of

from graphplan.sheet.handout import task
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Sheet, Text
from graphplan.sheet.words.facts import given_facts

NAMES = "four-bar", "slider-crank", "jaanimets-10", "shaper"


def numbers(sheet: Sheet) -> list[Text]:
    return [item for item in sheet.items if item.layer == "dimensions" and isinstance(item, Text)]


@pytest.mark.parametrize("name", NAMES)
def test_a_task_has_dimensions_that_are_its_facts(name: str) -> None:
    """Each number on the figure is a fact that is given; a solution has none."""
    facts = {plain_text(str(fact.quantity)) for fact in given_facts(composition_of(name).plans.drawing.scene)}
    told = [plain_text(plain(text.runs)) for text in numbers(task(composition_of(name))[0])]
    assert told
    assert set(told) <= facts
    assert not numbers(pages_of(name)[0])


@pytest.mark.parametrize("name", NAMES)
def test_no_letters_stand_on_dimensions(name: str) -> None:
    sheet = task(composition_of(name))[0]
    texts = [item for item in sheet.items if isinstance(item, Text)]
    assert not [plain(number.runs) for number in numbers(sheet) for other in texts
                if other is not number and number.box.meets(other.box)]


def plain_text(text: str) -> str:
    return text.replace("phi", "φ").replace("_", "")
