"""The designs that a drawing may follow beside that of its task: with velocities of another length or sense, true at
their points, or with motion on other plans; and how its marks are then taken.

A reading is looked at only where a mark is wrong or missing by the task's own. Velocities at their points tell by their
letters how they are drawn: where several differ from the task's by the same turn and factor, that is the design.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

from shapely import Point

from graphplan.design.hand import Pencil
from graphplan.errors import GraphplanError
from graphplan.kernel.kinds import LINE, POINT, Sizing
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.frames import (
    Pair,
    SheetReading,
    agreed_units,
    best_fit,
    mirror_submission,
    quarter_turns,
    to_mm,
)
from graphplan.marking.judge.lettering import name_marks
from graphplan.marking.judge.student_sheet import Fit
from graphplan.marking.tolerances import VECTOR_END_RATIO
from graphplan.marking.traces import PlanFrame, Submission, Trace, as_spot, spell
from graphplan.mechanism.model import FRAME
from graphplan.methods.construction import Construction
from graphplan.methods.draw import draw
from graphplan.methods.panels import ACCELERATION_PLAN, MECHANISM, VELOCITY_PLAN
from graphplan.methods.ways import Plan
from graphplan.phrases import Said, said
from graphplan.sheet.layout.composition import Composition

SENSES: Mapping[int, tuple[Said, ...]] = {  # by the quarter turns from the task's velocities
    0: (), 2: (said("velocities turned clockwise"),), 3: (said("true velocities at their points"),),
}
POLAR, POLAR_REMARK = "polar", said("a polar plan")


def unmirror(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil) -> SheetReading:
    """The drawing as the task has it, in mm; mirrored, where only then more than two of the given points are in their
    places."""
    submission, remarks = to_mm(drawing, composition, submission, pencil)
    given_pairs = [(complex(*map(float, drawing.scene.points[trace.label])), complex(*trace.spots[0]))
                   for trace in submission.traces if trace.kind == POINT and trace.label in drawing.scene.points]
    if len(given_pairs) > 2 and not submission.frames and not submission.page:
        upright_pairs, mirrored_pairs = (_marks_in_frame(pairs, best_fit(pairs, pencil.point), pencil) for pairs in (
            given_pairs, [(plan, sheet.conjugate()) for plan, sheet in given_pairs]))
        if len(mirrored_pairs) > max(2, len(upright_pairs)):
            return SheetReading(drawing, composition, mirror_submission(submission),
                                (*remarks, said("a mirrored sheet")))
    return SheetReading(drawing, composition, submission, remarks)


def _marks_in_frame(pairs: Sequence[Pair], fit: Fit | None, pencil: Pencil) -> list[Pair]:
    """The marks that a frame holds."""
    return [(plan, sheet) for plan, sheet in pairs
            if fit and abs(fit.frame.to_sheet(plan) - sheet) < 2 * measures.SURE_SIGMAS * pencil.point]


@dataclass(frozen=True)
class OtherDesigns:
    """The other designs of a task: `labelled` are the marks with the letters of the task, `frame` is the place of the
    mechanism, `plan` the wish for plans, empty where they are open."""

    task: SheetReading
    labelled: Submission
    frame: PlanFrame
    pencil: Pencil
    plan: str

    def readings(self) -> Iterator[SheetReading]:
        """Yield the drawing by each design: velocities at their points first, then other plans."""
        at_points = list(self._readings_at_points())
        yield from at_points
        for reading in (replace(self.task, submission=self.labelled), *at_points):
            yield from self._renumbered_readings(reading)
        if not self.labelled.page:
            yield from self._readings_on_other_plans()

    def _renumbered_readings(self, reading: SheetReading) -> Iterator[SheetReading]:
        """Yield the reading with the numbers at its marks in an order of the student's own, so that they tell only that
        these are marks, if one of them is a number that no such mark of the task has."""
        drawn, traces = self.task.drawing.drawn, reading.submission.traces
        marks = {(str(drawn.number(step.index)), step.op.gives) for step in drawn.steps}
        numbered = frozenset(place for place, trace in enumerate(traces) if trace.label.isdigit())
        if any((traces[place].label, traces[place].kind) not in marks for place in numbered):
            nameless_traces = tuple(replace(trace, label="") if place in numbered else trace
                                    for place, trace in enumerate(traces))
            yield self._departing(reading, said("steps numbered in another order"), numbered=numbered,
                                  submission=replace(reading.submission, traces=nameless_traces))

    @staticmethod
    def _departing(reading: SheetReading, *remarks: Said, **changes: Any) -> SheetReading:
        """A reading that departs from the task in what the remarks say."""
        return replace(reading, remarks=(*reading.remarks, *remarks), **changes)

    # ---- velocities drawn from their points ------------------------------------------------------------------------

    def _readings_at_points(self) -> Iterator[SheetReading]:
        """Yield designs with velocities of another length, turned the other way, or true at their points."""
        if self.task.drawing.turned and not self.labelled.page:
            for quarters, factor in self._agreed_turns():
                yield from self._turned_readings(quarters, factor)

    def _agreed_turns(self) -> Iterator[tuple[int, Fraction]]:
        """Yield the right angles and factors by which velocities differ from those of the task, where several of them
        agree, or one alone is turned by a right angle; the likeliest first."""
        ratios = self._velocity_ratios()
        of_cranks = [ratios[point][0] for point, _ in self._crank_velocities() if point in ratios]
        groups = []
        for count, ratio, sigma in agreed_units([*ratios.values()]):
            sure = measures.SURE_SIGMAS * sigma
            quarters = quarter_turns(ratio, min(measures.MAX_TURN_ERROR_RAD, math.inf if count > 1 else sure))
            if quarters is not None:
                groups.append((count, ratio, sigma, quarters))
        for count, ratio, sigma, quarters in groups:
            is_same = abs(1 / abs(ratio) - 1) < measures.SURE_SIGMAS * sigma
            # a mistake at a follower of a crank shows alike at all that follow: alone, only a crank's vector counts
            is_alone = count == 1 < groups[0][0] and not any(abs(crank / ratio - 1) < sigma for crank in of_cranks)
            if quarters in SENSES and not is_alone and not (is_same and quarters == 0):  # others would be reversed
                yield quarters, Fraction(1) if is_same else Fraction(abs(ratio))

    def _velocity_ratios(self) -> dict[str, tuple[complex, float]]:
        """Ratios of the velocities as drawn to those of the task, by their points, each with its deviation."""
        ratios = {}
        for point, vector_on_plan in self._turned_velocities.items():
            place = self._find_mark(point)
            task_vector = vector_on_plan * self.frame.unit
            if place is not None and abs(task_vector) > measures.MIN_VECTOR_MM:
                trace, start = self.labelled.traces[place], self.frame.to_sheet(self._given_point(point))
                vector = complex(*trace.spots[0]) - start
                if abs(vector) > measures.MIN_VECTOR_MM:
                    ratios[point] = vector / task_vector, math.hypot(2 * self.pencil.point, trace.blur) / abs(vector)
        return ratios

    @cached_property
    def _turned_velocities(self) -> Mapping[str, complex]:
        """The velocities of points turned on the mechanism, as the task has them: of the points of cranks first, then
        those that end in marks of their own, in the order in which they are drawn, and others that are asked for."""
        drawing = self.task.drawing
        ends = {bare_label(step.name): complex(*map(float, drawing.values[step.index][:2]))
                for step in drawing.drawn.steps if step.name and step.op.gives == POINT}
        points = {f"v{point.casefold()}": point for point in drawing.scene.points}
        marked = {points[name]: end - self._given_point(points[name]) for name, end in ends.items() if name in points}
        results = {point: 1j * velocity * drawing.kappa for point, velocity in drawing.velocity.items()}
        return dict(self._crank_velocities()) | marked | results

    def _crank_velocities(self) -> Iterator[tuple[str, complex]]:
        """The turned velocities of the points of cranks: against their arms where they turn counterclockwise."""
        drawing, fixed = self.task.drawing, self.task.drawing.scene.links.get(FRAME, ())
        for drive in drawing.scene.drives:
            points = drawing.scene.links.get(drive.link, ())
            centre = next((name for name in points if name in fixed), None)
            for name in points if centre and drive.rate and not drive.slides else ():
                if name not in fixed:
                    arm = self._given_point(name) - self._given_point(centre or name)
                    yield name, -float(drive.rate) * arm * drawing.kappa

    def _turned_readings(self, quarters: int, factor: Fraction) -> Iterator[SheetReading]:
        """Yield the design with velocities so turned, and so many times as long, if it can be drawn."""
        submission = self._turned_back_submission() if quarters == 3 else self.labelled
        if drawing := self._at_tempo(factor * (-1 if quarters == 2 else 1), submission):
            yield self._departing(self.task, *SENSES[quarters], drawing=drawing, submission=submission,
                                  scaled="" if factor == 1 else MECHANISM, departs=(factor != 1) + (quarters != 0))

    def _at_tempo(self, size: Fraction, submission: Submission) -> Construction | None:
        """The construction with velocities so many times as long; every one that is marked ends in a mark of its own.
        """
        for tempo in (size, size * VECTOR_END_RATIO):
            with suppress(GraphplanError):
                drawing = self._redraw(kappa=Fraction(self.task.drawing.tempo.kappa) * tempo)
                if not any(step.op.sizing is Sizing.QUOTIENT for step in self.task.drawing.drawn.steps):
                    # nothing is computed that the task constructs
                    drawing = replace(drawing, design=replace(drawing.design, form="semicircle"))
                if not find_orphans(drawing, submission):
                    return drawing
        return None

    def _turned_back_submission(self) -> Submission:
        """With every velocity that is drawn at its point turned a quarter, as on the task's sheet."""
        marks = {spell(trace.label): complex(*trace.spots[0]) for trace in self.labelled.traces
                 if trace.kind == POINT and trace.label}
        marks |= {point: self.frame.to_sheet(self._given_point(point)) for point in self.task.drawing.scene.points}
        starts = {f"v{name.casefold()}": spot for name, spot in marks.items() if name[:1].isupper()}

        def turn_trace(trace: Trace) -> Trace:
            start = starts.get(bare_label(trace.label)) if trace.kind == POINT else None
            if start is None:
                return trace
            spot = start + 1j * (complex(*trace.spots[0]) - start)
            return replace(trace, spots=((spot.real, spot.imag),))

        return replace(self.labelled, traces=tuple(map(turn_trace, self.labelled.traces)))

    # ---- other plans -----------------------------------------------------------------------------------------------

    def _readings_on_other_plans(self) -> Iterator[SheetReading]:
        """Yield designs with motion on polar plans, or accelerations alone on one, where the task has orthogonal
        velocities and asks for no other."""
        if not self.task.drawing.turned or (self.plan and POLAR not in self.plan):
            return
        with suppress(GraphplanError):
            drawing = self._redraw(plan=self.task.drawing.design.on_polar_plans)
            yield self._departing(self.task, POLAR_REMARK, drawing=drawing, scaled=VELOCITY_PLAN)
            yield from self._gathered_readings(drawing)

    def _gathered_readings(self, drawing: Construction) -> Iterator[SheetReading]:
        """Yield the design with accelerations from a pole, if any is drawn, but velocities from their points, whose
        ends are called as the student does."""
        accelerations = {bare_label(step.name) for step in drawing.drawn.steps if step.panel == ACCELERATION_PLAN}
        if not any(bare_label(trace.label) in accelerations - {""} for trace in self.labelled.traces):
            return
        ends_at_points = {point: place for point in self.task.drawing.scene.points
                          if (place := self._find_mark(point)) is not None}
        drawing = call_ends(drawing, {point: self.labelled.traces[place].label
                                      for point, place in ends_at_points.items()})
        named = replace(name_marks(drawing, self.task.task, self.task.submission, self.pencil), letters=())
        others = replace(self, labelled=named)
        ends = {point: place for point in ends_at_points if (place := others._find_mark(point)) is not None}
        if gathered := gather_velocities(drawing, named, self.frame, ends):
            submission, sense = gathered
            yield self._departing(self.task, sense, POLAR_REMARK, drawing=drawing, submission=submission,
                                  scaled=VELOCITY_PLAN)

    # ---- letters and constructions ---------------------------------------------------------------------------------

    def _find_mark(self, point: str) -> int | None:
        """The place of the mark that is called as the end of a point's velocity."""
        for place, trace in enumerate(self.labelled.traces):
            if trace.kind == POINT and trace.label not in self.task.drawing.scene.points and (
                    bare_label(trace.label) == f"v{point.casefold()}"):
                return place
        return None

    def _given_point(self, point: str) -> complex:
        return complex(*map(float, self.task.drawing.scene.points[point]))

    def _redraw(self, **changes: Any) -> Construction:
        """The construction of the task by another design; fails with `Refused` where that reaches less."""
        drawing = self.task.drawing
        plan = Plan(drawing.scene, drawing.design.method)
        return draw(plan, plan.way_by(drawing.design.ways), replace(drawing.design, **changes))


def find_orphans(drawing: Construction, submission: Submission) -> list[int]:
    """The places of the marks that are called as ends of velocities for which the construction has no mark of its own,
    as they end in another point."""
    step_labels = {bare_label(step.name) for step in drawing.drawn.steps if step.name}
    names = {f"v{point.casefold()}" for point in drawing.velocity} - step_labels if drawing.turned else set()
    return [place for place, trace in enumerate(submission.traces)
            if trace.kind == POINT and not trace.beside and bare_label(trace.label) in names]


def bare_label(label: str) -> str:
    """A letter as it is compared: v_{A}, vA and v_a are one."""
    return spell(label.replace(" ", "")).replace("_", "").casefold()


# ---- velocities gathered at a pole ----------------------------------------------------------------------------------

# Velocities that are drawn from their points, gathered at a pole: so a drawing is read whose accelerations lie on a
# polar plan while its velocities do not. With each end go the strokes to it: its vector, and the loci where it lies.


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
                      ) -> tuple[Submission, Said] | None:
    """The marks with each velocity laid off true from the pole of a polar drawing, beside the sheet, and how they were
    drawn; `ends` are the places of those marks by their points, `frame` is the place of the mechanism. None if they are
    turned as no velocities are."""
    steps = {step.name: step for step in drawing.drawn.steps if step.panel == VELOCITY_PLAN and step.op.gives == POINT}
    pole = next((step for step in steps.values() if step.op.free), None)
    vectors = {point: _vector(submission, frame, point, drawing, place) for point, place in ends.items()}
    turns = Counter[int]()
    for point, vector in vectors.items() if pole else ():
        end = steps.get(submission.traces[ends[point]].label)
        true = (_value(drawing, end) - _value(drawing, pole)) * frame.unit if end and pole else 0
        turn = quarter_turns(vector / true, measures.MAX_TURN_ERROR_RAD) if true and (
            abs(vector) > measures.MIN_VECTOR_MM) else None
        turns.update([turn] if turn in FROM_POINTS and turn is not None else [])
    if not turns or not pole:
        return None
    turn, _ = turns.most_common(1)[0]
    at = complex(*map(min, zip(*(spot for trace in submission.traces for spot in trace.spots), strict=True)))
    at -= 2 * max(map(abs, vectors.values())) * (1 + 1j)
    traces = [*submission.traces, Trace(POINT, (as_spot(at),), pole.name, VELOCITY_PLAN)]
    for point, place in ends.items():
        old, new = complex(*traces[place].spots[0]), at + vectors[point] / 1j**turn
        traces[place] = replace(traces[place], spots=(as_spot(new),), panel=VELOCITY_PLAN, beside=False)
        traces += [replace(stroke, panel=VELOCITY_PLAN, spots=tuple(
            as_spot(new + (complex(*spot) - old) / 1j**turn) for spot in stroke.spots))
            for stroke in submission.traces if stroke.kind == LINE and stroke.figure.distance(Point(old.real, old.imag))
            < measures.DRIFT_MM]
    return replace(submission, traces=tuple(traces)), FROM_POINTS[turn]


def _vector(submission: Submission, frame: PlanFrame, point: str, drawing: Construction, place: int) -> complex:
    """A velocity as it is drawn, from the student's own mark of its point, if there is one."""
    marks = (complex(*trace.spots[0]) for trace in submission.traces if trace.kind == POINT and trace.label == point)
    start = frame.to_sheet(complex(*map(float, drawing.scene.points[point])))
    return complex(*submission.traces[place].spots[0]) - next(marks, start)


def _value(drawing: Construction, step: Step) -> complex:
    """True place of a mark on its plan."""
    return complex(*map(float, drawing.values[step.index][:2]))
