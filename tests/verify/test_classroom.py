"""The drawings of a class: a line for each, and what goes wrong most often."""

from __future__ import annotations

import pytest
from judged import judgement

from graphplan.phrases import said
from graphplan.verify.classroom import MISTAKEN, Classroom, Marked, Unread, lines
from graphplan.verify.mistakes import MISTAKES
from graphplan.verify.score import score

WRONG_LINE = "wrong line"


def handed(file: str, wrong: int | None = None, kind: str = "") -> Marked:
    """A drawing of the four-bar with this step wrong."""
    told = said("parallel to {0} instead of {1}", "AB", "BC") if kind == WRONG_LINE else None
    found = judgement("four-bar", {} if wrong is None else {wrong: 2.5 + 1j}, told, kind, file)
    return Marked(file, found, score(found))


def parallels() -> list[int]:
    """The parallels that the four-bar's construction draws."""
    return [step.index for step in judgement("four-bar").drawing.drawn.steps if step.op.name == "parallel"]


def room(*marked: Marked, unread: tuple[Unread, ...] = ()) -> Classroom:
    drawing = judgement("four-bar").drawing
    return Classroom(drawing.scene.title, drawing.drawn, marked, unread)


def test_the_most_frequent_mistake_and_step_are_told() -> None:
    """Of four drawings three go wrong, two of them at the same step by the same mistake."""
    one, two = parallels()[:2]
    found = room(handed("a"), handed("b", two, WRONG_LINE), handed("c", one, "reversed"), handed("d", two, WRONG_LINE))
    assert found.histogram == {one: 1, two: 2}
    assert found.hardest == two
    assert found.mistakes == {WRONG_LINE: 2, "reversed": 1}
    told = [str(line) for line in lines(found)]
    number = found.drawn.number(two)
    assert told[0] == "a: 100 of 100; no wrong step"
    assert f"b: 97 of 100; Step {number}: parallel to AB instead of BC, 2.7 mm off, 0.5 mm allowed" in told
    assert "Drawings: 4, of which 1 have no wrong step." in told
    assert "Most frequent mistake: parallel or perpendicular to the wrong line (2)." in told
    assert f"Most frequent first wrong step: step {number} (2)." in told


def test_of_equally_frequent_steps_the_earlier_is_told() -> None:
    """Where two steps are wrong as often, the one that is drawn first comes first."""
    one, two = parallels()[:2]
    assert room(handed("a", two), handed("b", one)).hardest == one


def test_the_mean_is_that_of_what_could_be_judged() -> None:
    """A file that could not be read counts neither as a score nor as a drawing, but it is told."""
    found = room(handed("a"), handed("b", parallels()[0]), unread=(Unread("c", "it is empty; give a drawing"),))
    assert found.mean == pytest.approx((100 + found.data["drawings"][1]["score"]) / 2)
    assert found.data["not_judged"] == [{"file": "c", "why": "it is empty; give a drawing"}]
    assert "Not judged: 1." in map(str, lines(found))


def test_a_class_of_which_nothing_can_be_read_has_no_findings() -> None:
    """Without a single drawing there is no mean, no mistake and no step."""
    data = room(unread=(Unread("a", "no"),)).data
    assert (data["mean_score"], data["most_frequent_mistake"], data["most_frequent_first_wrong"]) == (None, None, None)


def test_every_kind_of_mistake_can_be_told() -> None:
    """The table of mistakes has no kind that a class report has no words for, nor the other way round."""
    assert set(MISTAKEN) == set(MISTAKES)
