"""A construction in first order as a student draws it: where each plan lies, what shakes, how far off a mark may be.

Everything is computed with its derivatives by every slip of the hand, every reading of the sheet and every frame. So a
mark's deviation from what the student's own earlier marks ask for comes with its own covariance; what all marks of a
plan have in common, such as the frame they were read in, falls out by itself.

How much a mark that is found, or is not, speaks for a way through a drawing is weighed in natural logarithms of odds:
how much likelier what is seen is if the mark was drawn there than if it was not."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from graphplan.design.hand import Hand, Pencil, program_hand
from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.numbers.gradients import Gradients
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.tolerances import BOUND_TOL, VARIANCE_TOL
from graphplan.marking.traces import Frames, PlanFrame, Submission, Trace
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM, VELOCITY_PLAN
from graphplan.sheet.plates.plans import Plans

MIN_VARIANCE = np.finfo(float).tiny

SURVIVAL: dict[int, Callable[[float], float]] = {  # how often a sum of n squares is larger than x
    1: lambda x: math.erfc(math.sqrt(x / 2)),
    2: lambda x: math.exp(-x / 2),
    3: lambda x: math.erfc(math.sqrt(x / 2)) + math.sqrt(2 * x / math.pi) * math.exp(-x / 2),
}


@cache
def squares_bound(freedoms: int, chance: float) -> float:
    """The sum of as many squares of normal deviates that is only so seldom surpassed."""
    low, high = 0.0, measures.BOUND_LIMIT
    while high - low > BOUND_TOL:
        middle = (low + high) / 2
        low, high = (middle, high) if SURVIVAL[freedoms](middle) > chance else (low, middle)
    return high


@dataclass(frozen=True)
class Residual:
    """Distances of a trace from a thing, spot by spot in mm, with their covariance, and the part of each error."""

    off: Any
    covariance: Any
    partials: Any = None
    most: float = math.inf  # mm: beyond it, what only a `coarse` pencil allows is no slip of a pencil
    coarse: float = 1.0  # how many times as large the variance is as that of the usual pencil

    @cached_property
    def _axes_and_deviations(self) -> tuple[Any, Any]:
        """The variances along the axes of the covariance, all positive, and the deviation along them."""
        if len(self.off) == 1:
            return np.maximum(self.covariance[0], MIN_VARIANCE), self.off
        variances, axes = np.linalg.eigh(self.covariance)
        return np.maximum(variances, max(VARIANCE_TOL * variances[-1], MIN_VARIANCE)), axes.T @ self.off

    @property
    def square(self) -> float:
        """The sum of squares of the deviation in its own standard deviations."""
        variances, deviations = self._axes_and_deviations
        with np.errstate(over="ignore"):  # what has no tolerance is off without end
            return float(np.sum(deviations**2 / variances))

    @property
    def distance(self) -> float:
        """Largest distance, in mm; of a point's two coordinates their distance."""
        return float(np.max(np.abs(self.off)))

    def tolerance(self, chance: float) -> float:
        """Allowed distance in this direction, in mm; without a deviation the average."""
        most, square = squares_bound(len(self.off), chance), self.square
        if square > VARIANCE_TOL and self.distance > 0:
            allowed = self.distance * math.sqrt(most / square)
        else:
            allowed = math.sqrt(most * float(np.mean(self._axes_and_deviations[0])))
        return min(allowed, max(self.most, allowed / math.sqrt(self.coarse)))

    def vague(self, sharp: float) -> float:
        """Loss of evidence of a vague place relative to one within so many mm: the logarithm of the ratio of
        tolerances."""
        return float(np.sum(np.log(np.maximum(self._axes_and_deviations[0] / sharp**2, 1.0)))) / 2

    def fits(self, chance: float) -> bool:
        """Whether it is a slip of the pencil, however coarse that is."""
        most, square = squares_bound(len(self.off), chance), self.square
        return square <= most and (self.distance <= self.most or self.coarse * square <= most)


class PointResidual(Residual):
    """Of a point: its two coordinates."""

    @property
    def distance(self) -> float:
        return float(np.hypot(*self.off)) if len(self.off) == 2 else float(abs(self.off[0]))


@dataclass(frozen=True)
class Fit:
    """A frame with its standard deviations: `turn` of its scale and direction, as a part of one, about `centre` on
    the plan; `shift` of its place, in mm. `tied` names the plan that it shares both with, `aligned` its direction."""

    frame: PlanFrame
    turn: float = 0.0
    shift: float = 0.0
    centre: complex = 0j
    tied: str = ""
    aligned: str = ""


@dataclass(frozen=True)
class StudentSheet:
    """A construction on a student's sheet: `fits` say where its plans lie there; `hidden` are the steps whose marks
    the task's own sheet leaves out, as too small to draw; `enlarged` is how many times as large as there velocities are
    on their plan, and what is made of them on the mechanism."""

    drawing: Construction
    fits: Mapping[str, Fit]
    pencil: Pencil
    hidden: Collection[int] = ()
    enlarged: float = 1.0

    @cached_property
    def plan_of_step(self) -> Sequence[str]:
        """The plan of every step."""
        return Plans(self.drawing).plan_of_step

    @cached_property
    def marks_on(self) -> Mapping[int, tuple[int, ...]]:
        """The marks that lie on each line and arc."""
        return Plans(self.drawing).marks_on

    @cached_property
    def link_points(self) -> list[list[int]]:
        """The steps of the points of each link, as far as they are drawn: of those that lie together one is."""
        scene, drawn = self.drawing.scene, self.drawing.drawn
        steps = {scene.points[step.name]: step.index for step in drawn.steps[:drawn.givens]
                 if step.name in scene.points}
        return [[steps[at] for name in names if (at := scene.points.get(name)) in steps]
                for names in scene.links.values()]

    @cached_property
    def hand(self) -> Hand:
        """The hand that draws it at the scales of the sheet. Who draws velocities larger makes no smaller figures of
        them, nor does who computes with them: slips are small beside the carried vectors, and beside their squares."""
        carried_steps, figure_steps = self._velocity_figures

        def unit(step: Step) -> float:
            """The length of a millimetre where a step is drawn."""
            power = (step.index in carried_steps) + 2 * (step.index in figure_steps)
            return 1 / self.mm(self.plan_of_step[step.index]) / self.enlarged**power

        return program_hand(self.drawing.drawn, self.drawing.values, unit, self.pencil)

    @property
    def _velocity_figures(self) -> tuple[set[int], set[int]]:
        """The steps on the mechanism that carry velocities over from a plan of theirs, and those that are made there of
        these."""
        carried_steps, figure_steps, homes = set[int](), set[int](), self.plan_of_step
        for step in (step for step in self.drawing.drawn.steps if homes[step.index] == MECHANISM):
            if any(homes[arg] == VELOCITY_PLAN for arg in step.args):
                carried_steps.add(step.index)
            elif not (carried_steps | figure_steps).isdisjoint(step.args):
                figure_steps.add(step.index)
        return carried_steps, figure_steps

    def frame(self, step: Step) -> PlanFrame:
        """Frame of a step's plan."""
        return self.fits[self.plan_of_step[step.index]].frame

    def mm(self, panel: str) -> float:
        """The mm of a plan unit."""
        return abs(self.fits[panel].frame.unit)

    @cached_property
    def _starts(self) -> list[int]:
        """Offsets of each step's errors: the hand's slips, then its trace's."""
        counts = [len(slips) + measures.SPOT_ERRORS for slips in self.hand.slips]
        return np.concatenate(([0], np.cumsum(counts))).tolist()  # type: ignore[no-any-return]

    @cached_property
    def domain(self) -> Gradients:
        return Gradients(self._starts[-1] + measures.FRAME_ERRORS * len(self.fits))

    @property
    def reading_errors(self) -> Any:
        """Mask of the errors of reading a trace."""
        is_reading = np.zeros(self._starts[-1] + measures.FRAME_ERRORS * len(self.fits), dtype=bool)
        for start in self._starts[1:]:
            is_reading[start - measures.SPOT_ERRORS:start] = True
        return is_reading

    def errors(self, index: int) -> list[Any]:
        """The slips of the hand at a step."""
        return [self.domain.error(i, slip) for i, slip in enumerate(self.hand.slips[index], self._starts[index])]

    def expected_value(self, step: Step, drawn: Sequence[Any]) -> Any:
        """Expected value of a step from these marks, with the errors of the hand; fails as its rule does."""
        return self.hand.draw_step(step, self.domain, drawn, self.errors)

    def laid_off(self, step: Step, start: int, drawn: Sequence[Any]) -> tuple[complex, float] | None:
        """The vector that a step lays off from a mark, and its standard deviation; None where it cannot be drawn."""
        try:
            end = self.expected_value(step, drawn)
        except Undrawable:
            return None
        components = [end[i] - drawn[start][i] for i in (0, 1)]
        partials = np.array([self.domain.partials(component) for component in components])
        return complex(*plain_value(components)), float(np.sqrt(np.sum(partials**2) / 2))

    # ---- what is seen ----------------------------------------------------------------------------------------------

    @cached_property
    def _spots(self) -> dict[tuple[int, Trace], ReadSpots]:
        """Spots read so far."""
        return {}

    def spots(self, index: int, trace: Trace) -> ReadSpots:
        """The spots of a step's trace on its plan, with the errors of the frame and of reading them."""
        if (index, trace) not in self._spots:
            self._spots[index, trace] = ReadSpots(self._read_spots(index, trace))
        return self._spots[index, trace]

    def _read_spots(self, index: int, trace: Trace) -> Iterator[tuple[Any, Any]]:
        panel, panels = self.plan_of_step[index], list(self.fits)
        fit, first, mm = self.fits[panel], self._starts[index] + len(self.hand.slips[index]), self.mm(panel)
        leads = fit.tied or panel, fit.tied or fit.aligned or panel, panel
        stretched, turned, own_errors = (self._starts[-1] + measures.FRAME_ERRORS * panels.index(one) for one in leads)
        (stretch, turn), shift, blur = (self.fits[lead].turn for lead in leads[:2]), fit.shift / mm, trace.blur / mm
        for k, spot in enumerate(measured_spots(trace)):
            z, own_error = fit.frame.to_plan(complex(*spot)), first + 2 * k
            away, across = (z - fit.centre) * stretch, (z - fit.centre) * 1j * turn
            x = (stretched, away.real), (turned + 1, across.real), (own_errors + 2, shift), (own_error, blur)
            y = (stretched, away.imag), (turned + 1, across.imag), (own_errors + 3, shift), (own_error + 1, blur)
            yield self.domain.with_errors(z.real, x), self.domain.with_errors(z.imag, y)

    def residual(self, step: Step, expected: Any, spots: Sequence[tuple[Any, Any]], drawn: Sequence[Any]) -> Residual:
        """Residual of a trace from a step's expected value."""
        domain, kind = self.domain, step.op.gives
        if step.op.movement is Movement.PICKED:  # any point of the line will do
            line = drawn[step.args[0]]
            deviations = [_offset_from_line(domain, line, spots[0]) - _offset_from_line(domain, line, expected)]
        elif kind == POINT:
            deviations = [spots[0][0] - expected[0], spots[0][1] - expected[1]]
        elif kind == LINE:
            deviations = [_offset_from_line(domain, expected, spot) for spot in spots]
        else:
            deviations = [_offset_from_circle(domain, expected, spot) for spot in spots]
        scale = abs(self.frame(step).unit)
        partials = np.array([domain.partials(deviation) for deviation in deviations]) * scale
        off = np.array([_plain_number(deviation) for deviation in deviations]) * scale
        most = self.max_hidden_error(step) if self.coarse > 1.0 else math.inf
        return (PointResidual if kind == POINT else Residual)(off, partials @ partials.T, partials, most, self.coarse)

    @cached_property
    def coarse(self) -> float:
        """Largest ratio of a variance to that of the usual pencil."""
        usual = Pencil().model
        return max(1.0, *((deviation / usual[name]) ** 2 for name, deviation in self.pencil.model.items()))

    def max_hidden_error(self, step: Step) -> float:
        """The most that a coarse pencil hides at a step, mm: a share of its plan."""
        home = self.plan_of_step[step.index]
        spots = np.array([complex(*value[:2]) for step_on_plan, value, plan in zip(
            self.drawing.drawn.steps, self.drawing.values, self.plan_of_step, strict=True)
            if plan == home and step_on_plan.op.gives == POINT])
        across = math.hypot(float(np.ptp(spots.real)), float(np.ptp(spots.imag))) if len(spots) else 0.0
        return min(max(measures.DRIFT_MM, measures.COARSE_ERROR_SHARE * across * self.mm(home)),
                   measures.MAX_COARSE_ERROR_MM)

    def value_of_trace(self, step: Step, expected: Any, spots: ReadSpots, steady: bool) -> Any:
        """The value of a trace as a step's: a line runs the way it should, and where its spots are not `steady` enough
        to tell, a short arc has the centre that it should."""
        if step.op.gives == POINT:
            return spots[0]
        if step.op.gives == LINE:
            return spots.line(expected)
        tells_centre = steady or _angle_span(expected, spots) > measures.SHORT_ARC_RAD
        return (spots.rim if tells_centre and len({plain_value(spot) for spot in spots}) == 3
                else _circle_about(expected, spots))


class ReadSpots(list[tuple[Any, Any]]):
    """The spots of a trace on its plan, and what goes through them, made once: a value that is the same thing on two
    ways through a drawing needs no second look."""

    def line(self, expected: Any) -> Any:
        """The line through two, running as the expected one does."""
        a, b, _ = line = self._forward_line
        return (line if _plain_number(a) * _plain_number(expected[0])
                + _plain_number(b) * _plain_number(expected[1]) >= 0 else self._backward_line)

    @cached_property
    def _forward_line(self) -> tuple[Any, Any, Any]:
        P, Q = self
        a, b = P[1] - Q[1], Q[0] - P[0]
        return a, b, -(a * P[0] + b * P[1])

    @property
    def _backward_line(self) -> tuple[Any, Any, Any]:
        a, b, c = self._forward_line
        return -a, -b, -c

    @property
    def rim(self) -> Any:
        """The circle through three spots."""
        return _circle_through(*self)


def measured_spots(trace: Trace) -> tuple[tuple[float, float], ...]:
    """The spots by which a trace is measured: of an arc its ends and its middle."""
    if trace.kind == CIRCLE:
        return trace.spots[0], trace.spots[len(trace.spots) // 2], trace.spots[-1]
    return trace.spots[:2] if trace.kind == LINE else trace.spots[:1]


def distance_apart(kind: str, value: Sequence[float], spots: Any) -> Any:
    """Largest distance of some spots, an array, from a thing, on its plan; for rows of spots row by row."""
    if kind == LINE:
        a, b, c = value
        return np.max(np.abs(a * spots.real + b * spots.imag + c), axis=-1) / (math.hypot(a, b) or math.inf)
    off, radius = np.abs(spots - complex(*value[:2])), math.sqrt(max(value[2], 0.0)) if kind == CIRCLE else 0.0
    return np.max(np.abs(off - radius), axis=-1)


def plain_value(value: Sequence[Any]) -> tuple[float, ...]:
    """A value without its errors."""
    return tuple(map(_plain_number, value))


def _plain_number(number: Any) -> float:
    return float(getattr(number, "value", number))


def _offset_from_line(domain: Gradients, line: Any, spot: tuple[Any, Any]) -> Any:
    a, b, c = line
    return (a * spot[0] + b * spot[1] + c) / domain.sqrt(a * a + b * b, "", "")


def _offset_from_circle(domain: Gradients, circle: Any, spot: tuple[Any, Any]) -> Any:
    x, y, r2 = circle
    u, v = spot[0] - x, spot[1] - y
    return domain.sqrt(u * u + v * v, "", "") - domain.sqrt(r2, "", "")


def _angle_span(circle: Any, spots: Sequence[tuple[Any, Any]]) -> float:
    """The angle between the outer spots, seen from a centre."""
    radii = [complex(*plain_value(spot)) - complex(*plain_value(circle[:2])) for spot in (spots[0], spots[-1])]
    return abs(cmath.phase(radii[0].conjugate() * radii[1]))


def _circle_about(circle: Any, spots: Sequence[tuple[Any, Any]]) -> Any:
    """The circle about a known centre that passes best through some spots."""
    x, y = circle[:2]
    return x, y, sum((u - x) * (u - x) + (v - y) * (v - y) for u, v in spots) / len(spots)


def _circle_through(P: tuple[Any, Any], Q: tuple[Any, Any], R: tuple[Any, Any]) -> Any:
    """The circle through three spots."""
    u, v = (Q[0] - P[0], Q[1] - P[1]), (R[0] - P[0], R[1] - P[1])
    uu, vv, cross = u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1], 2 * (u[0] * v[1] - u[1] * v[0])
    p, q = (uu * v[1] - vv * u[1]) / cross, (vv * u[0] - uu * v[0]) / cross
    return P[0] + p, P[1] + q, p * p + q * q


def weigh_mark(most: float, none: float, residual: Residual | None, share: float = 1.0) -> float:
    """Weight of a mark at a distance, of whose stroke a share is visible, between the weight of an absent mark and
    `most`."""
    presence = min(max((share - measures.ABSENT_SHARE) / (measures.PRESENT_SHARE - measures.ABSENT_SHARE), 0.0), 1.0)
    beyond = max(0.0, residual.square - len(residual.off)) / 2 if residual else 0.0
    return max(presence * most + (1 - presence) * none - beyond, none)


# ---- marks of several steps -----------------------------------------------------------------------------------------

# Marks that several steps of a plan share, so that one dot is the mark of all.


@dataclass(frozen=True)
class SharedMarks:
    """Steps of a drawing with the same dot, on the plans with known `frames`."""

    drawing: Construction
    plan_of_step: Sequence[str]
    frames: Frames

    @cached_property
    def spots(self) -> Sequence[complex | None]:
        """Places of the steps' marks on the sheet, in mm; None for a step without a point, or on another plan."""
        return [frame.to_sheet(complex(*plain_value(value)[:2])) if step.op.gives == POINT and frame else None
                for step, value, frame in zip(self.drawing.drawn.steps, self.drawing.values,
                                              map(self.frames.get, self.plan_of_step), strict=True)]

    def are_one(self, step: int, other: int) -> bool:
        """Whether two steps make the same dot of one plan."""
        at, there = self.spots[step], self.spots[other]
        return (at is not None and there is not None and self.plan_of_step[step] == self.plan_of_step[other]
                and abs(at - there) < measures.DIFFERENT_MM)

    def labels_of_others(self, submission: Submission, labels: Mapping[int, int]) -> dict[int, int]:
        """The steps without labels that share the mark of a step with one, where there is a single dot for both, by the
        place of its trace."""
        dots = {complex(*trace.spots[0]) for trace in submission.traces if trace.kind == POINT}  # some of two names

        def has_single_dot(step: int, place: int) -> bool:
            at, dot = self.spots[step], complex(*submission.traces[place].spots[0])
            return (at is not None and abs(dot - at) < measures.DIFFERENT_MM
                    and sum(abs(near - dot) < measures.DIFFERENT_MM for near in dots) == 1)

        single_dots = {step: place for step, place in labels.items() if has_single_dot(step, place)}
        return {step: place for step in range(len(self.spots)) if step not in labels
                for labelled, place in single_dots.items() if self.are_one(step, labelled)}
