"""What is said of a step, and how sure that is, where marks are faint, hidden or missing."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hands import draw, frames, points, traced
from judged import composed

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.shared_marks import SharedMarks
from graphplan.marking.judge.verdict import EARNED, IMPLIED, MISSING, RIGHT, UNCLEAR, WRONG, Judgement
from graphplan.marking.judge.verdicts import sureness
from graphplan.marking.traces import PlanFrame, StudentNumber, Submission, Trace
from graphplan.sheet.plates.plans import Plans

PENCIL = Pencil(0.1, 0.1, 0.05, 0.1)


def four_bar(*without: str, moved: dict[str, float] | None = None, kinds: tuple[str, ...] = (POINT, LINE),
             letters: bool = True, numbers: tuple[StudentNumber, ...] = ()) -> Judgement:
    """A four-bar as a hand drew it, some of its marks left out, some drawn so many mm aside."""
    sheet = composed("four-bar")
    drawing = sheet.plans.drawing
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 3)
    found = list[Trace]()
    for trace in traced(drawn):
        if trace.kind in kinds and trace.label not in without:
            aside = (moved or {}).get(trace.label, 0.0)
            spots = tuple((x + aside, y) for x, y in trace.spots)
            given = trace.label in drawing.scene.points
            named = letters or given
            found.append(replace(trace, spots=spots, label=trace.label if named else "",
                                 panel=trace.panel if named else ""))
    return judge(drawing, sheet, Submission("x.svg", tuple(found), numbers, frozenset(kinds)), PENCIL)


def states(found: Judgement) -> dict[str, str]:
    """The states of the lettered steps."""
    steps = found.drawing.drawn.steps
    return {steps[verdict.step].name: verdict.state for verdict in found.verdicts if steps[verdict.step].name}


def test_a_crossing_of_right_lines_needs_no_dot() -> None:
    """A result where two drawn lines cross is drawn, though nobody pricked it; points alone show none there."""
    assert states(four_bar("M_1"))["M_1"] == IMPLIED
    assert states(four_bar("M_1", kinds=(POINT,)))["M_1"] == MISSING


def test_a_right_number_shows_its_result() -> None:
    """What is not drawn is missing, unless its number is in the table and right."""
    true = gp.construct(gp.load("four-bar")).acceleration["M"]
    right, wrong = (StudentNumber("acceleration", "M", (value.real, value.imag), "mm/s^2") for value in (true, -true))
    told = four_bar("M_1", kinds=(POINT,), numbers=(right,))
    assert states(told)["M_1"] == IMPLIED
    assert states(four_bar("M_1", kinds=(POINT,), numbers=(wrong,)))["M_1"] == MISSING


def test_ink_beside_a_missing_mark_is_to_be_looked_at() -> None:
    """An unlabelled dot that is no step's, some mm beside where a result should be, may be it: nobody can tell."""
    assert states(four_bar("M_1", kinds=(POINT,), letters=False))["M_1"] == MISSING
    found = four_bar(kinds=(POINT,), letters=False, moved={"M_1": 4.5})
    assert states(found)["M_1"] in (UNCLEAR, WRONG)
    shown = next(verdict for verdict in found.verdicts if found.drawing.drawn.steps[verdict.step].name == "M_1")
    assert shown.trace is not None


def test_every_verdict_bears_its_confidence() -> None:
    """What is right and what is wrong in measured points is all but certain; every confidence is a probability."""
    sheet = composed("four-bar")
    drawing = sheet.plans.drawing
    drawn = points(draw(drawing, frames(drawing, sheet), PENCIL, 3))
    spoilt = replace(drawn, traces=tuple(
        replace(trace, spots=((trace.spots[0][0] + 8.0, trace.spots[0][1]),)) if trace.label == "M_1" else trace
        for trace in drawn.traces))
    for submission in (drawn, spoilt):
        found = judge(drawing, sheet, submission, PENCIL)
        assert all(0.0 <= verdict.confidence <= 1.0 for verdict in found.verdicts)
        sure = [verdict.confidence for verdict in found.verdicts if verdict.state in (*EARNED, WRONG)]
        assert min(sure) > 0.85
    assert RIGHT in {verdict.state for verdict in found.counting_verdicts}
    assert found.first_wrong


def test_odds_become_probabilities() -> None:
    """Even odds are one half, and no odds are too long."""
    assert sureness(0.0) == 0.5
    assert sureness(2.0) + sureness(-2.0) == pytest.approx(1.0)
    assert 0.0 <= sureness(-1e9) < sureness(1e9) <= 1.0


@pytest.mark.parametrize(("apart", "is_single"), [(0.0, True), (0.1, False)])
def test_a_dot_of_two_names_is_a_single_one(apart: float, is_single: bool) -> None:
    """It is the mark of a nameless step that ends there as well; of two dots one may be that step's own."""
    drawing = gp.construct(gp.load("shaper"))
    plan_of_step = Plans(drawing).plan_of_step
    marks = SharedMarks(drawing, plan_of_step, {panel: PlanFrame(0j, 1 + 0j) for panel in plan_of_step})
    lettered = next(step.index for step in drawing.drawn.steps if step.name == "v_b(5)")
    at = marks.spots[lettered]
    assert at
    dots = tuple(Trace(POINT, ((at.real + far, at.imag),), label) for far, label in ((0.0, "v_b(5)"), (apart, "m")))
    others = marks.labels_of_others(Submission("", dots), {lettered: 0})
    nameless = {step for step in range(lettered) if marks.are_one(step, lettered)}
    assert nameless
    assert others.keys() == (nameless if is_single else set())
