"""Velocities that are drawn from their points, gathered at a pole: so a drawing is read whose accelerations lie on a
polar plan while its velocities do not. With each end go the strokes to it: its vector, and the loci where it lies."""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

from shapely import Point

from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.traces import PlanFrame, Submission, Trace, as_spot
from graphplan.methods.construction import Construction
from graphplan.methods.panels import VELOCITY_PLAN
from graphplan.phrases import Said, said

FROM_POINTS: Mapping[int, Said] = {  # by the quarter turns from the true velocities
    0: said("true velocities at their points"), 1: said("orthogonal velocities at their points"),
    3: said("velocities turned clockwise"),
}


def call_ends(drawing: Construction, letters: Mapping[str, str]) -> Construction:
    """A polar drawing with the ends of velocities called by these letters, by their points, but for letters that it has
    for other marks."""
    ends = {point.casefold(): letter for point, letter in letters.items()}
    others = {step.name for step in drawing.program.steps if step.panel != VELOCITY_PLAN or step.name not in ends}
    names = {end: letter for end, letter in ends.items() if letter not in others}
    steps = tuple(step.but(name=names[step.name]) if step.panel == VELOCITY_PLAN and step.name in names else step
                  for step in drawing.program.steps)
    return replace(drawing, program=replace(drawing.program, steps=steps))


def gather_velocities(drawing: Construction, submission: Submission, frame: PlanFrame, ends: Mapping[str, int]
                      ) -> tuple[int, Submission, Said] | None:
    """How many velocities are turned alike, the marks with each laid off true from the pole of a polar drawing, beside
    the sheet, and how they were drawn; `ends` are the places of those marks by their points, `frame` is where the
    mechanism lies. None where they are turned as no velocities are."""
    steps = {step.name: step for step in drawing.drawn.steps if step.panel == VELOCITY_PLAN and step.op.gives == POINT}
    pole = next((step for step in steps.values() if step.op.free), None)
    vectors = {point: _vector(submission, frame, point, drawing, place) for point, place in ends.items()}
    turns = Counter[int]()
    for point, vector in vectors.items() if pole else ():
        end = steps.get(submission.traces[ends[point]].label)
        turn = _quarter_turns(vector, _value(drawing, end) - _value(drawing, pole), frame) if end and pole else None
        turns.update([turn] if turn in FROM_POINTS and turn is not None else [])
    if not turns or not pole:
        return None
    turn, count = turns.most_common(1)[0]
    at = complex(*map(min, zip(*(spot for trace in submission.traces for spot in trace.spots), strict=True)))
    at -= 2 * max(map(abs, vectors.values())) * (1 + 1j)
    traces = [*submission.traces, Trace(POINT, (as_spot(at),), pole.name, VELOCITY_PLAN)]
    for point, place in ends.items():
        old, new = complex(*traces[place].spots[0]), at + vectors[point] / 1j**turn
        traces[place] = replace(traces[place], spots=(as_spot(new),), panel=VELOCITY_PLAN, beside=False)
        traces += [replace(stroke, panel=VELOCITY_PLAN, spots=tuple(
            as_spot(new + (complex(*spot) - old) / 1j**turn) for spot in stroke.spots))
            for stroke in submission.traces if stroke.kind == LINE and stroke.figure.distance(Point(old.real, old.imag))
            < measures.LINE_END_MM]
    return count, replace(submission, traces=tuple(traces)), FROM_POINTS[turn]


def _vector(submission: Submission, frame: PlanFrame, point: str, drawing: Construction, place: int) -> complex:
    """A velocity as it is drawn, from the student's own mark of its point, if there is one."""
    marks = (complex(*trace.spots[0]) for trace in submission.traces if trace.kind == POINT and trace.label == point)
    start = frame.to_sheet(complex(*map(float, drawing.scene.points[point])))
    return complex(*submission.traces[place].spots[0]) - next(marks, start)


def _quarter_turns(vector: complex, true: complex, frame: PlanFrame) -> int | None:
    """By how many right angles a vector is turned from the true one; None where by no whole number of them."""
    if not true or abs(vector) < measures.MIN_VECTOR_MM:
        return None
    turn = cmath.phase(vector / (true * frame.unit)) / (math.pi / 2)
    return round(turn) % 4 if abs(turn - round(turn)) * math.pi / 2 < measures.MAX_TURN_ERROR_RAD else None


def _value(drawing: Construction, step: Step) -> complex:
    """Where a mark truly is on its plan."""
    return complex(*map(float, drawing.values[step.index][:2]))
