"""What of a sheet is shown: steps up to one, steps over what was drawn before, and the film strip."""

from __future__ import annotations

import pytest
from sheets import SCENES, drawing_of, outside, sheet_of

from graphplan.errors import Refused
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Arrow, Text
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.selection import numbered, selected
from graphplan.sheet.strip import Strip, strip
from graphplan.sheet.words.texts import RESULTS


@pytest.mark.parametrize("name", SCENES)
def test_a_step_shows_what_is_drawn_by_then(name: str) -> None:
    """Up to a step there is all that the steps before it made, nothing later, and no result."""
    drawn, sheet = drawing_of(name).drawn, sheet_of(name)
    last = drawn.givens + (len(drawn) - drawn.givens) // 2
    shown = selected(sheet, last)
    assert {item.step for item in shown.items} - {None} == {item.step for item in sheet.items
                                                           if item.step is not None and item.step <= last}
    assert not [item for item in shown.items if item.layer == RESULTS]


def test_the_last_step_shows_the_whole_sheet() -> None:
    """Up to the last step a sheet is as it is, results and all."""
    sheet = sheet_of("four-bar")
    assert selected(sheet, len(sheet.sentences) - 1) == sheet


def test_what_was_drawn_before_is_grey() -> None:
    """Steps before the first have a paler pen and the same place; those from it on are as they were."""
    sheet, drawn = sheet_of("four-bar"), drawing_of("four-bar").drawn
    first, last = numbered(drawn, "5-9")
    for item, one in zip(selected(sheet, last, first).items, selected(sheet, last).items, strict=True):
        assert (item == one) == (one.step is None or one.step >= first or item.pen == one.pen)
        assert item.pen.width == one.pen.width


@pytest.mark.parametrize("name", SCENES)
def test_an_arrow_waits_for_both_its_ends(name: str) -> None:
    """No vector is drawn before both its ends are."""
    plans = Plans(drawing_of(name))
    vectors = [vector for panel in plans.panels for vector in plans.vectors(panel)]
    for arrow in (item for item in sheet_of(name).items if isinstance(item, Arrow) and item.label):
        assert arrow.step in {max(v.start, v.end) for v in vectors if f"{v.kind} {v.point}" == arrow.label}


@pytest.mark.parametrize("text", ["0", "3-2", "40000", "a", "", "1-2-3", "-4"])
def test_steps_that_are_not_there_are_refused(text: str) -> None:
    """A number that is no step, or a range that runs backwards, is refused with the numbers that there are."""
    with pytest.raises(Refused, match="numbers from 1 to "):
        numbered(drawing_of("four-bar").drawn, text)


@pytest.mark.parametrize("name", SCENES[::3])
def test_the_strip_shows_every_step_once(name: str) -> None:
    """The pictures' steps are all steps in order, each picture's on one plan, its words below it inside the frame."""
    drawing = drawing_of(name)
    film, pages = Strip(Plans(drawing), single=False), strip(drawing)
    drawn = drawing.drawn
    assert [step.index for group in film.groups for step in group] == list(range(drawn.givens, len(drawn)))
    assert all(len({film.plans.plan_of_step[step.index] for step in group}) == 1 for group in film.groups)
    texts = [plain(item.runs) for page in pages for item in page.items if isinstance(item, Text)]
    assert all(str(drawn.number(index)) in texts for index in range(drawn.givens, len(drawn)))
    assert not [item for page in pages for item in outside(page)]


@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "jaanimets-10"])
def test_letters_of_a_strip_stand_apart(name: str) -> None:
    """No letter of a picture covers another, nor a word below it."""
    for page in strip(drawing_of(name)):
        boxes = [item.box.inset(0.05, 0.05, 0.05, 0.05) for item in page.items if isinstance(item, Text)]
        assert not [(one, other) for i, one in enumerate(boxes) for other in boxes[:i] if one.meets(other)]


def test_a_single_strip_has_a_picture_for_each_step() -> None:
    """A picture for every step; they are more than those for every mark."""
    plans = Plans(drawing_of("four-bar"))
    steps = len(plans.drawing.drawn) - plans.drawing.drawn.givens
    assert len(Strip(plans, single=True).groups) == steps > len(Strip(plans, single=False).groups)


def test_a_strip_that_does_not_fit_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where one picture with its words is larger than the sheet, a larger one is advised."""
    monkeypatch.setattr("graphplan.sheet.strip.WIDTHS", (300.0,))
    with pytest.raises(Refused, match="larger --paper"):
        strip(drawing_of("four-bar"), "A4")
