"""What of a sheet is shown: steps up to one, steps over what was drawn before, and the film strip."""

from __future__ import annotations

import pytest
from sheets import SCENES, composition_of, drawing_of, outside, sheet_of

import graphplan as gp
from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE, POINT
from graphplan.sheet.layout.layout import sheet_at_step, step_range
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.pictures import MARK, STAGE, STEP, cut_into_runs, marks_used
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Polyline, Text
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.strip import MAX_HEIGHT, Strip, by_stages, strip
from graphplan.sheet.words.texts import RESULTS


@pytest.mark.parametrize("name", SCENES)
def test_a_step_shows_what_is_drawn_by_then(name: str) -> None:
    """Up to a step there is all that the steps before it made, nothing later, and no result."""
    drawn, sheet = drawing_of(name).drawn, sheet_of(name)
    last = drawn.givens + (len(drawn) - drawn.givens) // 2
    shown = sheet_at_step(sheet, last)
    assert {item.step for item in shown.items} - {None} == {item.step for item in sheet.items
                                                            if item.step is not None and item.step <= last}
    assert not [item for item in shown.items if item.layer == RESULTS]


def test_the_last_step_shows_the_whole_sheet() -> None:
    """Up to the last step a sheet is as it is, results and all."""
    sheet = sheet_of("four-bar")
    assert sheet_at_step(sheet, len(sheet.sentences) - 1) == sheet


def test_what_was_drawn_before_is_grey() -> None:
    """Steps before the first have a paler pen and the same place; those from it on are as they were."""
    sheet, drawn = sheet_of("four-bar"), drawing_of("four-bar").drawn
    first, last = step_range(drawn, "5-9")
    for item, one in zip(sheet_at_step(sheet, last, first).items, sheet_at_step(sheet, last).items, strict=True):
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
        step_range(drawing_of("four-bar").drawn, text)


@pytest.mark.parametrize("name", SCENES[::6])
def test_the_strip_shows_every_step_once(name: str) -> None:
    """The pictures' steps are all steps in order, each picture's on one plan, its words below it inside the frame."""
    drawing = drawing_of(name)
    composition, drawn = composition_of(name), drawing.drawn
    plans = composition.plans
    for cut in (MARK, STAGE):
        film = Strip.from_composition(composition, cut)
        assert [step.index for one in film.pictures for step in one.steps] == list(range(drawn.givens, len(drawn)))
        assert all(len({plans.plan_of_step[step.index] for step in one.steps}) == 1 for one in film.pictures)
        texts = [plain(item.runs) for page in film.sheets for item in page.items
                 if isinstance(item, Text) and item.layer == "text"]
        runs = [[int(end) for end in text.split("–")] for text in texts if text.replace("–", "").isdigit()]
        told = {number for run in runs for number in range(run[0], run[-1] + 1)}
        assert told >= set(range(1, len(drawn) - drawn.givens + 1))
        assert not [item for page in film.sheets for item in outside(page)]


@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "jaanimets-10"])
def test_letters_of_a_strip_stand_apart(name: str) -> None:
    """No letter of a picture covers another, nor a word below it."""
    composition = composition_of(name)
    for page in [*strip(composition), *by_stages(composition, "A4 portrait")[1]]:
        boxes = [item.box.inset(0.05, 0.05, 0.05, 0.05) for item in page.items if isinstance(item, Text)]
        assert not [(one, other) for i, one in enumerate(boxes) for other in boxes[:i] if one.meets(other)]


def test_a_single_strip_has_a_picture_for_each_step() -> None:
    """There is a picture for every step; for every mark they are fewer."""
    composition = composition_of("four-bar")
    drawn = composition.plans.drawing.drawn
    steps = len(drawn) - drawn.givens
    assert len(Strip.from_composition(composition, STEP).pictures) == steps > len(Strip.from_composition(composition,
                                                                                                         MARK).pictures)


@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "jaanimets-10"])
def test_a_picture_shows_what_its_steps_use(name: str) -> None:
    """Every point that a step of a picture draws or reads on its plan is in it, with nothing else of before."""
    composition = composition_of(name)
    for one in Strip.from_composition(composition, STAGE).pictures:
        shown, own = one.excerpt, {step.index for step in one.steps}
        points = [drawn for drawn in shown.steps if drawn.kind == POINT and drawn.number]
        assert all(shown.is_on_panel(mark) for mark in points)
        assert own <= {drawn.index for drawn in shown.steps}
        assert {drawn.index for drawn in shown.steps} - own <= marks_used(composition.plans.drawing.drawn, own)


def test_the_mechanism_of_a_picture_stays_in_it_and_new_lines_are_seen_on_links() -> None:
    """No link, as wide as it is drawn, crosses the border; a line through two joints is drawn along their link."""
    composition = composition_of("shaper", plan="polar")
    for one in Strip.from_composition(composition, MARK).pictures:
        rect = one.excerpt.view.rect.inset(*[pens.LINK.width / 2] * 4)
        strokes = [item for item in one.excerpt.mechanism if isinstance(item, Polyline)]
        assert all(rect.holds(spot) for item in strokes for spot in item.spots)
        for line in (drawn for drawn in one.excerpt.steps if drawn.index in one.excerpt.own and drawn.kind == LINE):
            assert sum(stroke.length for stroke in one.excerpt.strokes(line)) > 3.0


def test_new_strokes_are_in_ink_and_others_in_grey() -> None:
    """In a picture what its steps draw is as dark as ink, what they use is paler, and so is the mechanism."""
    one = Strip.from_composition(composition_of("four-bar"), MARK).pictures[1]
    own = {step.index for step in one.steps}
    dark = {item.step for item in one.items if not isinstance(item, Text) and item.pen.colour == pens.INK}
    assert dark <= own
    assert dark
    assert any(item.step is None for item in one.items)


def test_long_stages_are_cut_where_little_is_carried_over() -> None:
    """A stage is parted where the fewest of its marks are used on both sides, in runs no longer than asked."""
    drawn, cut = gp.construct(gp.load("four-bar"), strict=True).drawn, 0
    for _, steps in drawn.stages:
        runs = cut_into_runs(drawn, steps, 12)
        assert [step for run in runs for step in run] == steps
        assert max(map(len, runs)) <= 12
        if len(runs) == 2:
            crossing = [len({arg for step in steps[at:] for arg in step.args} & {step.index for step in steps[:at]})
                        for at in range(len(steps) - 12, 13)]
            assert crossing[len(runs[0]) - len(steps) + 12] == min(crossing)
            cut += 1
    assert cut


def test_a_strip_that_does_not_fit_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where one picture with its words is larger than the sheet, a larger one is advised."""
    monkeypatch.setitem(MAX_HEIGHT, MARK, 4.0)
    monkeypatch.setattr("graphplan.sheet.pictures.MIN_HEIGHT", 3.0)
    with pytest.raises(Refused, match="larger --paper"):
        strip(composition_of("four-bar"), "A4")
