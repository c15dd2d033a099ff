"""The drawings of a class: a line for each, and what goes wrong most often."""

from __future__ import annotations

from dataclasses import replace

import pytest
from judged import judgement

import graphplan as gp
from graphplan.marking.classroom.results import Classroom, MarkedDrawing, Unread, class_lines, mistake_words
from graphplan.marking.judge.findings import StepName, step_name
from graphplan.marking.judge.mistakes import MISTAKES
from graphplan.marking.judge.score import score
from graphplan.marking.judge.verdict import RIGHT, UNSEEN, WRONG, Judgement, Verdict
from graphplan.phrases import said
from graphplan.sheet.layout.composition import compose

WRONG_LINE = "wrong line"


def paper(file: str, wrong: int | None = None, kind: str = "") -> MarkedDrawing:
    """A drawing of the four-bar with this step wrong."""
    told = said("parallel to {0} instead of {1}", "AB", "BC") if kind == WRONG_LINE else None
    found = judgement("four-bar", {} if wrong is None else {wrong: 2.5 + 1j}, told, kind, file)
    return MarkedDrawing(found, score(found))


def by_construction(file: str, plan: str, wrong: int) -> MarkedDrawing:
    """A drawing of the four-bar by the construction of a plan, with this step wrong, counted from the last."""
    drawing = gp.construct(gp.load("four-bar"), plan=plan)
    steps = [Verdict(step.index, RIGHT) for step in drawing.drawn.steps]
    steps[wrong] = replace(steps[wrong], state=WRONG)
    found = Judgement(file, drawing, compose(drawing), {}, tuple(steps))
    return MarkedDrawing(found, score(found))


def parallels() -> list[int]:
    """The parallels that the four-bar's construction draws."""
    return [step.index for step in judgement("four-bar").drawing.drawn.steps if step.op.name == "parallel"]


def room(*marked: MarkedDrawing, unread: tuple[Unread, ...] = ()) -> Classroom:
    return Classroom(judgement("four-bar").drawing.scene.title, marked, unread)


def step(index: int) -> StepName:
    """What a step of the four-bar's construction is called."""
    return step_name(judgement("four-bar").drawing.drawn, index)


def test_the_most_frequent_mistake_and_step_are_told() -> None:
    """Of four drawings three go wrong, two of them at the same step by the same mistake."""
    one, two = parallels()[:2]
    found = room(paper("a"), paper("b", two, WRONG_LINE), paper("c", one, "reversed"), paper("d", two, WRONG_LINE))
    assert found.histogram == {step(one): 1, step(two): 2}
    assert found.hardest == step(two)
    assert found.mistakes == {WRONG_LINE: 2, "reversed": 1}
    told = [str(line) for line in class_lines(found)]
    number = step(two).number
    assert told[0] == "a: 100 of 100; no wrong step"
    assert f"b: 80 of 100; Step {number}: parallel to AB instead of BC, 2.7 mm off, 0.5 mm allowed" in told
    assert "Drawings: 4, of which 1 have no wrong step." in told
    assert "Most frequent mistake: parallel or perpendicular to the wrong line (2)." in told
    assert f"Most frequent first wrong step: step {number}, line {number} (2)." in told


def test_doubtful_verdicts_come_first() -> None:
    """What the judge is not sure of is listed before the rest, unless the teacher has scored it."""
    sure, unsure = paper("a"), paper("b", parallels()[0])
    first = replace(unsure.judgement.verdicts[parallels()[0]], confidence=0.5)
    verdicts = [first if verdict.step == first.step else verdict for verdict in unsure.judgement.verdicts]
    unsure = replace(unsure, judgement=replace(unsure.judgement, verdicts=tuple(verdicts)))
    lines = [str(line) for line in class_lines(room(sure, unsure))]
    assert [line[:2] for line in lines[:2]] == ["b:", "a:"]
    assert "To be looked at first: b." in lines
    settled = replace(unsure, score=replace(unsure.score, given=85.0, note="Well drawn."))
    lines = [str(line) for line in class_lines(room(sure, settled))]
    assert lines[1].startswith("b: 85 of 100; The teacher's score: 85 of 100. The teacher's note: Well drawn.")
    assert not any("looked at first" in line for line in lines)


def test_of_equally_frequent_steps_the_earlier_is_told() -> None:
    """Where two steps are wrong as often, the one that is drawn first comes first."""
    one, two = parallels()[:2]
    assert room(paper("a", two), paper("b", one)).hardest == step(one)


def test_a_class_may_follow_several_constructions() -> None:
    """A step is told after the construction of its own drawing, however many steps the others have."""
    drawings = [by_construction("a", "", -1), by_construction("b", "polar", -1), by_construction("c", "polar", -1)]
    orthogonal, polar = (step_name(one.judgement.drawing.drawn, one.judgement.first_wrong_step or 0)
                         for one in drawings[:2])
    assert orthogonal != polar
    found = room(*drawings)
    assert found.histogram == {orthogonal: 1, polar: 2}
    assert [one.guilty for one in found.marked] == [orthogonal, polar, polar]
    assert found.data["most_frequent_first_wrong"] == polar.number
    assert f"Most frequent first wrong step: {polar.words_with_mark} (2)." in map(str, class_lines(found))


def test_a_drawing_of_which_nothing_is_judged_is_not_faultless() -> None:
    """Where nothing is to be seen, that is told, and the drawing is none without a wrong step."""
    found = judgement("four-bar", file="b")
    unseen = replace(found, verdicts=tuple(replace(v, state=UNSEEN) for v in found.verdicts))
    told = [str(line) for line in class_lines(room(paper("a"), MarkedDrawing(unseen, score(unseen))))]
    assert "b: nothing to judge" in told
    assert "Drawings: 2, of which 1 have no wrong step." in told


def test_the_mean_is_that_of_what_could_be_judged() -> None:
    """A file that could not be read counts neither as a score nor as a drawing, but it is told."""
    found = room(paper("a"), paper("b", parallels()[0]), unread=(Unread("c", "it is empty; give a drawing"),))
    assert found.mean == pytest.approx((100 + found.data["drawings"][1]["score"]) / 2)
    assert found.data["not_judged"] == [{"file": "c", "why": "it is empty; give a drawing"}]
    assert "Not judged: 1." in map(str, class_lines(found))


def test_a_class_of_which_nothing_can_be_read_has_no_findings() -> None:
    """Without a single drawing there is no mean, no mistake and no step."""
    data = room(unread=(Unread("a", "no"),)).data
    assert (data["mean_score"], data["most_frequent_mistake"], data["most_frequent_first_wrong"]) == (None, None, None)


def test_every_kind_of_mistake_can_be_told() -> None:
    """A class report has words for every kind of the table of mistakes, and others for each."""
    assert len({str(mistake_words(kind)) for kind in MISTAKES}) == len(MISTAKES)
