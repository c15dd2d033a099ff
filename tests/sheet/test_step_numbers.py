"""Step numbers in the figures: every mark that a step makes bears its number once, beside its letter or alone."""

from __future__ import annotations

from functools import cache

import pytest
from sheets import SCENES, composition_of, outside, pages_of, sheet_of, solved_of

from graphplan.kernel.kinds import POINT
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import layout, pages, with_numbers
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.lettering import TextRun, plain
from graphplan.sheet.plates.display import ENLARGED, Arc, Circle, Polyline, Rect, Sheet, Text

NUMBERED = ("point", "line", "arc", "step")


@cache
def numbered(name: str, paper: str | None = None) -> tuple[Composition, Sheet]:
    """A scene composed as ever, and its sheet with numbers."""
    composition = with_numbers(composition_of(name, paper))
    return composition, layout(composition) if paper else solved_of(name)


def numbers(sheet: Sheet, layer: str = "letters") -> list[int]:
    """The numbers of steps that stand in the figures, or in their details."""
    labels = [item.label.partition(" ") for item in sheet.items if isinstance(item, Text) and item.layer == layer]
    return sorted(int(number) for kind, _, told in labels if kind in NUMBERED for number in told.split(", "))


def marked(composition: Composition, sheet: Sheet) -> set[int]:
    """The numbers of the steps whose mark is on paper: their strokes, and of points those that no panel cuts off."""
    plans = composition.plans
    drawn = plans.drawing.drawn
    found = {item.step for item in sheet.items
             if item.step is not None and isinstance(item, Polyline | Arc | Circle) and item.layer == "construction"}
    for index in [index for index in found if drawn.steps[index].op.gives == POINT]:
        window = composition.views[plans.plan_of_step[index]]
        if not window.rect.holds(window(plans.spot(index))):
            found.remove(index)
    return {drawn.number(index) for index in found}


@pytest.mark.parametrize("name", SCENES)
def test_every_mark_bears_its_number_once(name: str) -> None:
    """Every step of the list that makes a mark has its number in the figure, once; no other number stands there."""
    composition, sheet = numbered(name)
    drawn, found, enlarged = composition.plans.drawing.drawn, numbers(sheet), numbers(sheet, ENLARGED)
    assert [len(set(found)), len(set(enlarged))] == [len(found), len(enlarged)]
    assert marked(composition, sheet) <= {*found, *enlarged} <= set(range(1, len(drawn) - drawn.givens + 1))


@pytest.mark.parametrize("name", SCENES)
def test_numbers_find_room(name: str) -> None:
    """With all numbers no lettering covers another, and nothing leaves the frame."""
    _, sheet = numbered(name)
    texts = [(plain(item.runs), item.box.inset(0.05, 0.05, 0.05, 0.05)) for item in sheet.items
             if isinstance(item, Text)]
    assert [(one, two) for i, (one, box) in enumerate(texts) for two, other in texts[:i] if box.meets(other)] == []
    assert outside(sheet) == []


@pytest.mark.parametrize("name", ["four-bar", "jaanimets-10"])
def test_a_plain_sheet_has_only_the_numbers_that_are_spoken_of(name: str) -> None:
    """Without the option lettered marks have no number, and the words are the same with it."""
    plain_sheet, (_, sheet) = sheet_of(name), numbered(name)
    assert set(numbers(plain_sheet)) < set(numbers(sheet))
    assert not [item for item in plain_sheet.items if isinstance(item, Text) and item.label.startswith("step ")]
    assert [page.items for page in pages(with_numbers(composition_of(name)))[1:]] == [
        page.items for page in pages_of(name)[1:]]


def test_a_number_is_raised_behind_its_letter() -> None:
    """A raised number stands behind its letter, above its base line, smaller and apart."""
    wish = Wish((TextRun("v"), TextRun("b", -1)), ((50.0, 50.0),), label="v_b", raised="5")
    letter, number = place_letters([wish], [], [(50.0, 50.0)], Rect(0, 0, 100, 100))
    assert isinstance(letter, Text)
    assert isinstance(number, Text)
    assert (plain(number.runs), number.label) == ("5", "step 5")
    assert number.box.left > letter.box.right
    assert letter.at[1] < number.at[1] < letter.box.top < number.box.top
    assert number.size < letter.size


def test_a_number_without_room_has_a_leader() -> None:
    """A number that may stand anywhere along a line goes far and is tied to it where all near places are taken."""
    middle = (50.0, 50.0)
    crowd = [Wish((TextRun("M"),), (middle,), label="M") for _ in range(30)]
    along = Wish((TextRun("7"),), (middle,), label="line 7", step=7, free=True)
    items = place_letters([*crowd, along], [], [], Rect(0, 0, 100, 100))
    number, *others = sorted((item for item in items if isinstance(item, Text)), key=lambda item: item.label)[::-1]
    assert number.label == "line 7"
    assert [item for item in items if isinstance(item, Polyline) and item.step == 7]
    assert not any(number.box.meets(other.box) for other in others)
