"""The overlay: the student's marks over the true ones, each by its verdict, the first wrong step called out."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from judged import TOLERANCE, TURNED, judgement

from graphplan.kernel.kinds import CIRCLE, POINT
from graphplan.marking.judge.overlay import (
    GOLD,
    HALF_SIZES_MM,
    LAYER,
    PENS,
    RED,
    SPARE_PEN,
    TOLERANCE_PEN,
    WANTED_PEN,
    StudentStrokes,
    overlay,
)
from graphplan.marking.judge.score import score
from graphplan.marking.judge.verdict import RIGHT, UNCLEAR, WRONG, Judgement, NumberVerdict
from graphplan.marking.traces import StudentNumber
from graphplan.phrases import said
from graphplan.sheet.plates.display import Arc, Circle, Item, Polygon, Polyline, Text

SCENES = ["four-bar", "alt-eight-link", "slider-crank"]


def items(found: Judgement) -> list[Item]:
    """What the first page shows."""
    return list(overlay(found, score(found))[0].items)


def words(shown: list[Item]) -> str:
    """All lettering, in order."""
    return " ".join("".join(run.text for run in item.runs) for item in shown if isinstance(item, Text))


def wrong_step(found: Judgement, op: str, which: int = 0) -> int:
    return [step.index for step in found.drawing.drawn.steps if step.op.name == op][which]


@pytest.mark.parametrize("name", SCENES)
def test_right_marks_lie_on_the_true_ones(name: str) -> None:
    """However the student's sheet lies, every point that is right is drawn where ours has it."""
    found = judgement(name)
    student, plans = StudentStrokes(found), found.composition.plans
    centres = {item.step: item.centre for item in student.items() if isinstance(item, Circle) and item.step is not None}
    assert centres
    for index, centre in centres.items():
        window = found.composition.views[plans.plan_of_step[index]]
        assert math.dist(centre, window(plans.spot(index))) < 1e-9


@pytest.mark.parametrize("name", SCENES)
def test_a_wrong_point_stands_where_it_was_drawn(name: str) -> None:
    """Its cross is as many mm off as the student was, by the size of our sheet, and a dashed stroke leads to the
    place where it should be."""
    index = wrong_step(judgement(name), "meet")
    found = judgement(name, {index: 3 + 1j})
    plans = found.composition.plans
    true = found.composition.views[plans.plan_of_step[index]](plans.spot(index))
    (stroke,) = [item
                 for item in StudentStrokes(found).items() if item.pen == WANTED_PEN and isinstance(item, Polyline)]
    assert math.dist(stroke.spots[1], true) < 1e-9
    assert math.dist(stroke.spots[0], true) == pytest.approx(abs((3 + 1j) / TURNED))


def test_tolerances_are_as_large_as_they_are_on_the_students_sheet() -> None:
    """The ellipse of a right point has its half axes, enlarged as the sheet is."""
    found = judgement("four-bar")
    ellipses = [item
                for item in StudentStrokes(found).items() if item.pen == TOLERANCE_PEN and isinstance(item, Polygon)]
    points = [v for v in found.verdicts if v.ellipse is not None]
    assert len(ellipses) == len(points)
    index = ellipses[0].step
    assert index is not None
    centre = found.composition.views["mechanism"](found.composition.plans.spot(index))
    radii = [math.dist(centre, spot) * abs(TURNED) for spot in ellipses[0].spots]
    assert (max(radii), min(radii)) == (pytest.approx(TOLERANCE), pytest.approx(TOLERANCE / 2))


@pytest.mark.parametrize("name", SCENES)
def test_the_first_wrong_step_alone_is_called_out(name: str) -> None:
    """Its sentence stands in a box on its plan and covers no other; further ones bear their numbers; a faultless
    drawing has no callout."""
    found = judgement(name, {wrong_step(judgement(name), "parallel"): 2j, wrong_step(judgement(name), "meet", -1): 4.0},
                      said("parallel to {0} instead of {1}", "AB", "BC"))
    shown = items(found)
    boxes = [item for item in shown if isinstance(item, Polygon) and item.pen.colour == RED]
    first = found.first_wrong
    assert first is not None
    drawn, panel = found.drawing.drawn, found.composition.plates.steps[first.step].view.rect
    assert len(boxes) == 1
    assert all(map(panel.holds, boxes[0].spots))
    assert f"Step {drawn.number(first.step)}: parallel to AB instead of BC, 2 mm off," in words(shown)
    last = wrong_step(found, "meet", -1)
    red = [item for item in shown if isinstance(item, Text) and item.pen.colour == RED]
    assert words(list(red)) == str(drawn.number(last))
    assert not any(item.pen.colour == RED for item in items(judgement(name)) if item.layer == LAYER and item.step)


def test_numbers_stand_beside_the_true_ones() -> None:
    """The table has what was handed in, what is true, and how far off it may be; what is wrong is told below."""
    number = StudentNumber("velocity", "A", (3.0, 4.5))
    verdict = NumberVerdict(number, WRONG, 0.5, 0.25, (3.0, 4.0), said("y has the wrong sign"))
    found = replace(judgement("four-bar"), numbers=(verdict,))
    told = words([item for sheet in overlay(found, score(found)) for item in sheet.items])
    assert "velocity A (3, 4.5) (3, 4) 0.5 0.25" in told
    assert "Wrong result: velocity A, off 0.5, allowed 0.25, y has the wrong sign." in told


def test_many_wrong_steps_run_over_to_further_pages() -> None:
    """Every wrong step is told; the pages are numbered, and the plans stand on the first alone."""
    found = judgement("alt-eight-link")
    long = said("parallel to {0} instead of {1}", *("a line of a very long name " * 5 for _ in range(2)))
    wrong = (replace(v, state=WRONG, mistake=long) if v.trace else v for v in found.verdicts)
    spoilt = replace(found, verdicts=tuple(wrong))
    sheets = overlay(spoilt, score(spoilt))
    assert [bool(sheet.panels) for sheet in sheets] == [True, *(False for _ in sheets[1:])]
    assert len(sheets) > 1
    assert all(f"{i}/{len(sheets)}" in words(list(sheet.items)) for i, sheet in enumerate(sheets, 1))
    told = words([item for sheet in sheets for item in sheet.items])
    drawn = found.drawing.drawn
    assert all(f" {drawn.number(v.step)} " in told for v in spoilt.verdicts if v.trace and v.step >= drawn.givens)


def test_verdicts_differ_by_more_than_colour() -> None:
    """The strokes of verdicts differ in width or dashes, so that they are told apart in grey."""
    looks = {(pen.width, pen.dash) for pen in (*PENS.values(), SPARE_PEN)}
    assert len(looks) == len(PENS) + 1
    assert HALF_SIZES_MM[WRONG] > HALF_SIZES_MM[RIGHT]


def test_what_is_spare_is_shown_where_it_lies() -> None:
    """A mark that no step asks for is dotted, on the plan that it lies on."""
    found = judgement("four-bar")
    trace = next(v.trace for v in found.verdicts if v.trace is not None and v.trace.kind == POINT)
    strokes = StudentStrokes(replace(found, spare=(trace,)))
    spared = [item for item in strokes.items() if item.pen.colour == SPARE_PEN.colour]
    assert len(spared) == 1


def test_an_arc_is_drawn_as_far_as_it_goes() -> None:
    """The student's arcs have the centre of the construction's, and no more than what was struck of them."""
    found = judgement("four-bar")
    arcs = [item for item in StudentStrokes(found).items() if isinstance(item, Arc)]
    assert len(arcs) == sum(v.trace is not None and v.trace.kind == CIRCLE for v in found.verdicts)
    assert all(arc.end - arc.start == pytest.approx(math.degrees(0.4)) for arc in arcs)


def test_nothing_leaves_its_plan() -> None:
    """The stroke to a mark far outside the panel ends at its edge."""
    index = wrong_step(judgement("four-bar"), "meet")
    found = judgement("four-bar", {index: 2000.0})
    rects = [view.rect for view in found.composition.views.values()]
    strokes = [item for item in StudentStrokes(found).items() if isinstance(item, Polyline)]
    assert any(item.pen == WANTED_PEN for item in strokes)
    assert all(any(all(rect.holds(spot, 1e-9) for spot in item.spots) for rect in rects) for item in strokes)


def test_what_cannot_be_told_is_ringed_where_it_should_be() -> None:
    """A teacher is led to each place at which there is nothing to judge by: about a point, or the middle of a line."""
    found = judgement("four-bar")
    point, line = wrong_step(found, "meet"), wrong_step(found, "parallel")
    verdicts = tuple(replace(v, state=UNCLEAR, trace=None) if v.step in (point, line) else v for v in found.verdicts)
    student = StudentStrokes(replace(found, verdicts=verdicts))
    rings = {item.step: item for item in student.items() if isinstance(item, Circle) and item.pen.colour == GOLD}
    plans = found.composition.plans
    assert set(rings) == {point, line}
    assert math.dist(rings[point].centre, found.composition.views[plans.plan_of_step[point]](plans.spot(point))) < 1e-9
    assert abs(_off(found.composition.plates.steps[line].line, rings[line].centre)) < 1e-6


def _off(line: tuple[float, float, float], spot: tuple[float, float]) -> float:
    return (line[0] * spot[0] + line[1] * spot[1] + line[2]) / math.hypot(*line[:2])
