"""Typical students' sheets, each with the score that a teacher would give it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cache

import pytest
from hands import Drawn, draw, frames, off_paper, slipped, traced
from judged import composed

from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.numbers import Floats
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.score import groups_of_steps, score
from graphplan.marking.traces import StudentNumber, Submission, Trace
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import VELOCITY

PENCIL = Pencil(0.1, 0.1, 0.05, 0.1)
Kept = Callable[[Construction, int], bool]


@cache
def hand(kind: str = "", op: str = "") -> Drawn:
    """A four-bar drawn by hand, with a mistake of this kind at the first step of an operation after which it can still
    be finished on the paper."""
    sheet = composed("four-bar")
    drawing = sheet.plans.drawing
    wrong = [{step.index: slip} for step in drawing.drawn.steps if step.op.name == op
             for slip in slipped(drawing, step.index) if slip.kind == kind]
    ways = (draw(drawing, frames(drawing, sheet), PENCIL, 5, one) for one in (wrong if kind else [{}]))
    return next(way for way in ways if None not in way.values and not off_paper(way))


def traces(drawn: Drawn, kept: Kept = lambda drawing, index: True, kinds: Iterable[str] = (POINT, LINE)) -> list[Trace]:
    """What of a drawing is on the sheet; what is given is printed there."""
    drawing, program = drawn.drawing, drawn.drawing.drawn
    which = {(step.name or str(program.number(step.index)), step.op.gives): step.index for step in program.steps}
    return [trace for trace in traced(drawn) if trace.kind in kinds and (
        program.steps[index := which[trace.label, trace.kind]].op.free or kept(drawing, index))]


def velocities(drawing: Construction, index: int) -> bool:
    """Whether a step serves the velocities."""
    return groups_of_steps(drawing)[index] == VELOCITY


def results(drawing: Construction, index: int) -> bool:
    """Whether a step is a mark at which a result is read."""
    return index in drawing.drawn.wanted


def table(drawing: Construction, count: int | None = None, factor: float = 1.0) -> tuple[StudentNumber, ...]:
    """So many of the results that are asked for, as numbers."""
    asked = [reading for reading in drawing.readings if reading.given is None][:count]
    found = []
    for reading in asked:
        value = drawing.value(reading, [drawing.values[drawing.drawn.wanted[place]] for place in reading.marks],
                              Floats())
        parts = value if isinstance(value, tuple) else (value,)
        found.append(StudentNumber(reading.kind, reading.of, tuple(factor * float(part) for part in parts)))
    return tuple(found)


def sheet(found: list[Trace], numbers: tuple[StudentNumber, ...] = (),
          shows: Iterable[str] = (POINT, LINE)) -> Submission:
    return Submission("a.csv", tuple(found), numbers, frozenset(shows) if found else frozenset())


def shifted(found: list[Trace], label: str, off: float) -> list[Trace]:
    """The same with one mark so many mm aside."""
    return [replace(one, spots=tuple((x + off, y) for x, y in one.spots))
            if one.label == label and one.kind == POINT else one for one in found]


DRAWING = composed("four-bar").plans.drawing
SHEETS: dict[str, tuple[Submission, float, float]] = {  # with the least and the most that a teacher gives
    "everything is right": (sheet(traces(hand())), 100, 100),
    "only the results are drawn, all right": (sheet(traces(hand(), results, [POINT]), shows=[POINT]), 100, 100),
    "nothing but the table, all right": (sheet([], table(DRAWING)), 100, 100),
    "one number, right": (sheet([], table(DRAWING, 1)), 5, 20),
    "a blank sheet": (sheet(traces(hand(), lambda drawing, index: False)), 0, 0),
    "velocities alone, right": (sheet(traces(hand(), velocities)), 25, 50),
    "one parallel is perpendicular": (sheet(traces(hand("parallel missed", "parallel"))), 70, 85),
    "a vector is reversed": (sheet(traces(hand("reversed", "transfer"))), 70, 85),
    "the last point is 6 mm off": (sheet(shifted(traces(hand()), "M_1", 6.0)), 80, 89),
    "all numbers are of the wrong sign": (sheet([], table(DRAWING, factor=-1.0)), 0, 0),
}


@pytest.mark.parametrize("which", SHEETS)
def test_a_sheet_scores_as_a_teacher_would_mark_it(which: str) -> None:
    """With the default weights, within a few points."""
    submission, least, most = SHEETS[which]
    found = score(judge(DRAWING, composed("four-bar"), submission, PENCIL))
    assert found.total is not None
    assert least <= found.total <= most, found.text
