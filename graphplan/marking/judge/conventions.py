"""Conventions of a drawing: which construction it follows, on which sheet, and how its marks are to be taken.

A student may draw velocities at a scale of his own, turned the other way, true at their points, or from a pole; his
sheet may be mirrored. The letters tell which vectors are meant: where several of
them differ from the true ones by the same turn and factor, that is how he draws.
"""

from __future__ import annotations

import cmath
import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any

from shapely import Point

from graphplan.design.hand import Pencil
from graphplan.errors import GraphplanError
from graphplan.kernel.kinds import LINE, POINT, Sizing
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.frames import Pair, SheetReading, agreed_units, best_fit, mirror_submission, to_mm
from graphplan.marking.judge.lettering import name_marks
from graphplan.marking.judge.student_sheet import Fit
from graphplan.marking.judge.whole_plans import with_letters_exchanged
from graphplan.marking.tolerances import VECTOR_END_RATIO
from graphplan.marking.traces import PlanFrame, Submission, Trace, as_spot, spell
from graphplan.mechanism.model import FRAME
from graphplan.methods.construction import Construction
from graphplan.methods.draw import draw
from graphplan.methods.kinds import ACCELERATION, VELOCITY, ResultKind
from graphplan.methods.panels import ACCELERATION_PLAN, MECHANISM, VELOCITY_PLAN
from graphplan.methods.ways import Plan
from graphplan.phrases import Said, said
from graphplan.sheet.layout.composition import Composition

POLES = ("p", "pi", "o", "ov", "pv", "oa", "pa", "o1", "o2", "p1", "p2")  # what the poles of polar plans are called
SENSES: Mapping[int, tuple[tuple[Said, ...], float]] = {  # by the quarter turns from the task's velocities
    0: ((), 0.0), 2: ((said("velocities turned clockwise"),), measures.TURNED_ODDS),
    3: ((said("true velocities at their points"),), measures.AT_JOINTS_ODDS),
}
END_NAME_PATTERNS: Mapping[ResultKind, tuple[str, ...]] = {  # how the ends of a point's vectors are called
    VELOCITY: ("v{0}", "{0}"), ACCELERATION: ("a{0}", "j{0}", "w{0}", "{0}'", "{0}1"),
}


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
                                (*remarks, said("a mirrored sheet")), prior=measures.MIRRORED_ODDS)
    return SheetReading(drawing, composition, submission, remarks)


def _marks_in_frame(pairs: Sequence[Pair], fit: Fit | None, pencil: Pencil) -> list[Pair]:
    """The marks that a frame holds."""
    return [(plan, sheet) for plan, sheet in pairs
            if fit and abs(fit.frame.to_sheet(plan) - sheet) < 2 * measures.FRAME_SIGMAS * pencil.point]


@dataclass(frozen=True)
class PolarNames:
    """Names of marks on a polar plan, by their places, and the number of those with true directions."""

    count: int
    names: Mapping[int, str]


@dataclass(frozen=True)
class Proposer:
    """Proposals of other meanings of a drawing: `labelled` are its marks with the letters of the task, `frame` is the
    place of its mechanism."""

    task: SheetReading
    labelled: Submission
    frame: PlanFrame
    pencil: Pencil
    plan: str

    def readings(self) -> Iterator[SheetReading]:
        """The readings that something on the sheet speaks for."""
        at_points = self._readings_at_points()
        yield from at_points
        for reading in (replace(self.task, submission=self.labelled), *at_points):
            yield from self._renumbered_readings(reading)
        if "polar" in (self.plan or "polar") and not self.labelled.page:
            yield from self._polar_readings()

    def _renumbered_readings(self, reading: SheetReading) -> Iterator[SheetReading]:
        """With the numbers at its marks in an order of the student's own, so that they tell only that these are marks,
        if one of them is a number that no such mark of the task has."""
        drawn, traces = self.task.drawing.drawn, reading.submission.traces
        marks = {(str(drawn.number(step.index)), step.op.gives) for step in drawn.steps}
        numbered = frozenset(place for place, trace in enumerate(traces) if trace.label.isdigit())
        if any((traces[place].label, traces[place].kind) not in marks for place in numbered):
            nameless_traces = tuple(replace(trace, label="") if place in numbered else trace
                                    for place, trace in enumerate(traces))
            yield replace(reading, submission=replace(reading.submission, traces=nameless_traces), numbered=numbered,
                          prior=reading.prior + measures.RENUMBERED_ODDS,
                          remarks=(*reading.remarks, said("steps numbered in another order")))

    # ---- velocities drawn from their points ------------------------------------------------------------------------

    def _readings_at_points(self) -> list[SheetReading]:
        """With the velocities at a scale of the student's own, turned the other way, or true at their points, where
        several of them agree on that; the likeliest first."""
        if not self.task.drawing.turned or self.labelled.page:
            return []
        votes = []
        for point, vector_on_plan in self._turned_velocities.items():
            place = self._find_mark(point, "v{0}")
            task_vector = vector_on_plan * self.frame.unit
            if place is not None and abs(task_vector) > measures.MIN_VECTOR_MM:
                trace, start = self.labelled.traces[place], self.frame.to_sheet(self._given_point(point))
                vector = complex(*trace.spots[0]) - start
                if abs(vector) > measures.MIN_VECTOR_MM:
                    votes.append((vector / task_vector, math.hypot(2 * self.pencil.point, trace.blur) / abs(vector)))
        turned_readings = (self._turned_reading(ratio, factor) for count, ratio, sigma in agreed_units(votes)
                           if count > 1 or abs(_angle_error(ratio)) < measures.ROUND_SPEED_SIGMAS * sigma
                           for factor in self._meant_factors(abs(ratio), sigma))
        return [reading for reading in turned_readings if reading]

    @cached_property
    def _turned_velocities(self) -> Mapping[str, complex]:
        """The velocities of points turned on the mechanism, as the task has them: of the points of cranks first, then
        those that end in marks of their own, in the order in which they are drawn, and others that are asked for."""
        drawing = self.task.drawing
        ends = {_bare_label(step.name): complex(*map(float, drawing.values[step.index][:2]))
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

    def _turned_reading(self, ratio: complex, factor: Fraction) -> SheetReading | None:
        """With velocities drawn as this ratio to those of the task has it, at this factor, if they can be meant so."""
        quarters = round(cmath.phase(ratio) / (math.pi / 2)) % 4
        if abs(_angle_error(ratio)) > measures.MAX_TURN_ERROR_RAD or quarters == 1:  # true ones would be reversed
            return None
        if factor == 1 and quarters == 0:
            return None
        remarks, prior = SENSES[quarters]
        submission = self._turned_back_submission() if quarters == 3 else self.labelled
        drawing = self.at_tempo(factor * (-1 if quarters == 2 else 1), submission)
        return replace(
            self.task, drawing=drawing, submission=submission, remarks=(*self.task.remarks, *remarks),
            scaled=MECHANISM if factor != 1 else "",
            departs=(factor != 1) + (quarters != 0),
            prior=self.task.prior + prior + (measures.OWN_SCALE_ODDS if factor != 1 else 0.0)
        ) if drawing else None

    def at_tempo(self, size: Fraction, submission: Submission) -> Construction | None:
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

    def _meant_factors(self, size: float, sigma: float) -> Iterator[Fraction]:
        """The factors that a scale may be meant as: the task's, a round one, or that of a drive, if one is so near; and
        if it is not the task's, as it is measured."""
        if abs(1 / size - 1) < measures.ROUND_SPEED_SIGMAS * sigma:
            yield Fraction(1)
            return
        kappa = Fraction(self.task.drawing.tempo.kappa)
        # k_v of the task
        speed = Fraction(abs(1 / (float(kappa) * self.frame.unit))).limit_denominator(measures.MAX_SPEED_DENOMINATOR)
        rates = [abs(Fraction(drive.rate)) * kappa for drive in self.task.drawing.scene.drives if drive.rate]
        near = [*_round_numbers(size), *(speed / k_v for k_v in _round_numbers(float(speed) / size)),
                *(factor / rate for rate in rates for factor in _round_numbers(size * float(rate)))]
        nearest = min(near, key=lambda one: abs(math.log(float(one) / size)))
        if abs(float(nearest) / size - 1) < measures.ROUND_SPEED_SIGMAS * sigma:
            yield nearest
        yield Fraction(size).limit_denominator(measures.MAX_SPEED_DENOMINATOR)

    def _turned_back_submission(self) -> Submission:
        """With every velocity that is drawn at its point turned a quarter, as on the task's sheet."""
        marks = {spell(trace.label): complex(*trace.spots[0]) for trace in self.labelled.traces
                 if trace.kind == POINT and trace.label}
        marks |= {point: self.frame.to_sheet(self._given_point(point)) for point in self.task.drawing.scene.points}
        starts = {f"v{name.casefold()}": spot for name, spot in marks.items() if name[:1].isupper()}

        def turn_trace(trace: Trace) -> Trace:
            start = starts.get(_bare_label(trace.label)) if trace.kind == POINT else None
            if start is None:
                return trace
            spot = start + 1j * (complex(*trace.spots[0]) - start)
            return replace(trace, spots=((spot.real, spot.imag),))

        return replace(self.labelled, traces=tuple(map(turn_trace, self.labelled.traces)))

    # ---- velocities and accelerations from a pole ------------------------------------------------------------------

    def _polar_readings(self) -> Iterator[SheetReading]:
        """On polar plans, which lie where their marks tell."""
        try:
            drawing = self._redraw(plan=self.task.drawing.design.on_polar_plans)
        except GraphplanError:
            return
        submission, panels = self._with_polar_names(drawing, VELOCITY, ACCELERATION)
        if VELOCITY_PLAN in panels or not self._all_named:
            yield replace(self.task, drawing=drawing, submission=submission if panels else self.task.submission,
                          scaled=VELOCITY_PLAN, remarks=(*self.task.remarks, said("a polar plan")),
                          prior=self.task.prior + measures.POLAR_PLAN_ODDS)
        if ACCELERATION_PLAN in panels:
            yield from self._gathered_readings(drawing)

    def _with_polar_names(self, drawing: Construction, *kinds: ResultKind) -> tuple[Submission, list[str]]:
        """The marks by the names of a polar drawing, and the plans that there are."""
        submission, panels = self.labelled, list[str]()
        for kind in kinds:
            plan = max(self._polar_plans(drawing, kind), key=lambda plan: plan.count, default=None)
            if plan:
                panels.append(panel := VELOCITY_PLAN if kind == VELOCITY else ACCELERATION_PLAN)
                submission = replace(submission, traces=tuple(
                    replace(trace, label=plan.names[place], panel=panel, beside=False) if place in plan.names else trace
                    for place, trace in enumerate(submission.traces)))
        return submission, panels

    def _gathered_readings(self, drawing: Construction) -> Iterator[SheetReading]:
        """With accelerations from a pole, but velocities from their points, whose ends are called as the student does.
        """
        drawing = call_ends(drawing, {point: self.labelled.traces[place].label
                                      for point, place in self._ends_at_points.items()})
        named = replace(name_marks(drawing, self.task.task, self.task.submission, self.pencil), letters=())
        proposer = replace(self, labelled=named)
        submission, _ = proposer._with_polar_names(drawing, ACCELERATION)
        ends, most = proposer._ends_at_points, 0
        for places in ((), *combinations(ends.values(), 2)):
            traces = with_letters_exchanged(submission.traces, *places) if places else submission.traces
            now = {point: places[1 - places.index(place)] if place in places else place
                   for point, place in ends.items()}
            gathered = gather_velocities(drawing, replace(submission, traces=tuple(traces)), self.frame, now)
            if gathered and gathered[0] > most + len(places) // 2:  # exchanged, two more are as they should be
                most = most or gathered[0]
                yield replace(self.task, drawing=drawing, submission=gathered[1], scaled=VELOCITY_PLAN,
                              exchanged=places, remarks=(*self.task.remarks, gathered[2], said("a polar plan")),
                              prior=self.task.prior + measures.POLAR_PLAN_ODDS)

    @property
    def _ends_at_points(self) -> dict[str, int]:
        """The places of the marks that are called as the ends of velocities drawn from their points."""
        found = {point: self._find_mark(point, "v{0}") for point in self.task.drawing.scene.points}
        return {point: place for point, place in found.items() if place is not None}

    @cached_property
    def _all_named(self) -> bool:
        """Whether every point of the sheet says what it is."""
        return all(trace.label and not trace.beside for trace in self.labelled.traces if trace.kind == POINT)

    def _polar_plans(self, drawing: Construction, kind: ResultKind) -> Iterator[PolarNames]:
        """The polar plans that the ends of vectors agree on, by each way to write them."""
        steps, traces, ends = drawing.drawn.steps, self.labelled.traces, dict[str, tuple[int, int]]()
        for reading in drawing.readings:
            if reading.kind == kind:
                start, end = (drawing.drawn.wanted[mark] for mark in reading.marks[-2:])
                ends[reading.of] = start, end
        for written in END_NAME_PATTERNS[kind] if ends else ():
            marks = {place: end for point, (_, end) in ends.items()
                     if (place := self._find_mark(point, written)) is not None}
            pole = next(iter(ends.values()))[0]
            poles = {place: pole for place, trace in enumerate(traces) if trace.kind == POINT
                     and _bare_label(trace.label) in POLES and trace.label not in drawing.scene.points}
            pairs = {place: (complex(*drawing.values[mark]), complex(*traces[place].spots[0]))
                     for place, mark in (poles | marks).items()}
            if marks and (count := self._count_agreeing(list(pairs.values()))):
                called = {place: pole for place in poles if traces[place].label == steps[pole].name}
                near = [place for place in called or poles
                        if place not in marks and self._is_nearest_pole(place, called or poles, marks)]
                names = {place: steps[mark].name for place, mark in marks.items()}
                yield PolarNames(count, names | dict.fromkeys(near, steps[pole].name))

    def _is_nearest_pole(self, place: int, poles: Collection[int], marks: Collection[int]) -> bool:
        """Whether of several poles one is the nearest to the marks of a plan."""
        spots = [complex(*self.labelled.traces[mark].spots[0]) for mark in marks]
        return place == min(poles, key=lambda pole: min(
            abs(complex(*self.labelled.traces[pole].spots[0]) - spot) for spot in spots))

    def _count_agreeing(self, pairs: Sequence[Pair]) -> int:
        """Number of vectors between marks that are turned alike from the true ones; 0 if that may be chance: three
        marks have no such frame by chance, nor have two of which one has the right direction from the other."""
        units = []
        for (plan, sheet), (second_plan, second_sheet) in combinations(pairs, 2):
            size = abs(second_sheet - sheet)
            if abs(plan - second_plan) * abs(self.frame.unit) > 1.0 and size > measures.MIN_VECTOR_MM:
                units.append(((second_sheet - sheet) / (second_plan - plan), measures.POLAR_MARK_MM / 2 / size))
        for count, unit, sigma in agreed_units(units):
            turn = abs(cmath.phase(unit / self.frame.unit))
            if count > 2 or turn < measures.SAME_DIRECTION_SINE + sigma:
                return count
        return 0

    # ---- letters and constructions ---------------------------------------------------------------------------------

    def _find_mark(self, point: str, written: str) -> int | None:
        """The place of the mark that is called so for a point of the mechanism."""
        name = written.format(point.casefold())
        for place, trace in enumerate(self.labelled.traces):
            if trace.kind == POINT and trace.label not in self.task.drawing.scene.points and (
                    _bare_label(trace.label) == name):
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
    """The places of the marks that are called as ends of velocities
    for which the construction has no mark of its own, as they end in another point."""
    step_labels = {_bare_label(step.name) for step in drawing.drawn.steps if step.name}
    names = {f"v{point.casefold()}" for point in drawing.velocity} - step_labels if drawing.turned else set()
    return [place for place, trace in enumerate(submission.traces)
            if trace.kind == POINT and not trace.beside and _bare_label(trace.label) in names]


def _bare_label(label: str) -> str:
    """A letter as it is compared: v_{A}, vA and v_a are one."""
    return spell(label.replace(" ", "")).replace("_", "").casefold()


def _angle_error(ratio: complex) -> float:
    """The angle, in radians, that a ratio of vectors is off the next right angle."""
    return cmath.phase(ratio * (-1j) ** round(cmath.phase(ratio) / (math.pi / 2)))


def _round_numbers(size: float) -> Iterator[Fraction]:
    """The round numbers next to a number."""
    power = Fraction(10) ** math.floor(math.log10(size))
    yield from (number * power * tens for number in measures.ROUND_SPEEDS for tens in (1, 10))


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
                      ) -> tuple[int, Submission, Said] | None:
    """The number of velocities that are turned alike, the marks with each laid off true from the pole of a polar
    drawing, beside the sheet, and how they were drawn; `ends` are the places of those marks by their points, `frame` is
    the place of the mechanism. None if they are turned as no velocities are."""
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
    """True place of a mark on its plan."""
    return complex(*map(float, drawing.values[step.index][:2]))
