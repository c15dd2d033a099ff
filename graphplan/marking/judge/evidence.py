"""What is there of a step: the unlabelled traces of a sheet, and in a picture also faint lines, short arcs and dots,
found only by seeking them; which traces are near to something expected, and which are one stroke."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from shapely import LineString, union_all

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.mistakes import Mistake, value_of
from graphplan.marking.judge.student_sheet import SharedMarks, StudentSheet, distance_apart, measured_spots, plain_value
from graphplan.marking.traces import Spot, Submission, Trace
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.view import clip_segment, interpolate

Value = tuple[float, ...]


@dataclass(frozen=True)
class KnownMarks:
    """State of a drawing that is partly matched: the values of its steps, and the mistakes still to come, or their
    values."""

    values: Sequence[Any]
    mistakes: Mapping[int, Mistake | Value]


def with_wobble(trace: Trace) -> Trace:
    """A trace of a picture, as sure as a line is straight that a hand draws."""
    return replace(trace, blur=math.hypot(trace.blur, measures.PENCIL_LINE_BLUR_MM))


class Evidence:
    """The traces of a file, of which some are unlabelled: where those are near to something expected, on every plan;
    where marks are `nameless`, they may be but ends of strokes, else such ends alone that are where a mark should be.
    """

    picture, most = False, measures.FILE_ODDS  # whether print may hide a mark; what one weighs

    def __init__(self, sheet: StudentSheet, submission: Submission, traces: list[Trace], places: Sequence[int],
                 nameless: bool = True):
        self.sheet, self.traces, self.shows, self._read = sheet, traces, submission.shows, len(submission.traces)
        self._places = {kind: [i for i in places if traces[i].kind == kind] for kind in (POINT, LINE, CIRCLE)}
        # of marks that are called by their letters, not by the numbers of steps, only those with letters are asked for
        self.only_letters = not nameless and not any(trace.label.isdigit() for trace in submission.traces)
        self._cached, self._twins = dict[tuple[str, str], Any](), dict[int, set[int]]()
        ends = [] if submission.page else [spot for trace in submission.traces if trace.kind == LINE
                                           for spot in trace.spots[:2]]
        self._reach = math.inf if nameless else measures.END_NEAR_MM
        self._ends = np.array([complex(*spot) for spot in (*submission.tips, *ends)])

    @cached_property
    def shared_marks(self) -> SharedMarks:
        """Steps with the same dot on the sheet."""
        frames = {panel: fit.frame for panel, fit in self.sheet.fits.items()}
        return SharedMarks(self.sheet.drawing, self.sheet.plan_of_step, frames)

    def weight(self, place: int) -> float:
        """Largest weight of a trace."""
        return self.most[self.traces[place].kind]

    def trace_weight(self, trace: Trace) -> float:
        """Largest weight of a found trace, whether it was searched for or not."""
        return self.most[trace.kind]

    def find_trace(self, step: Step, expected: Any, own: KnownMarks, within: float) -> Trace | None:
        """Trace at an expected value, within so many mm."""
        places, off = self.nearby_traces(step.op.gives, self.sheet.plan_of_step[step.index], plain_value(expected))
        return self.traces[places[off.argmin()]] if off.min(initial=math.inf) < within else None

    def search(self, step: Step, expected: Any, own: KnownMarks, within: float) -> Trace | None:
        """End of a stroke at an expected point without a dot, as corners of force polygons are."""
        if step.op.gives != POINT or not len(self._ends):
            return None
        off = np.abs(self._ends - self.sheet.frame(step).to_sheet(complex(*plain_value(expected))))
        end = self._ends[off.argmin()]
        return Trace(POINT, ((float(end.real), float(end.imag)),)) if off.min() < min(within, self._reach) else None

    def visible_share(self, step: Step, value: Any, own: KnownMarks) -> float | None:
        """Visible share of the ink that a step would make; None if it would not be visible."""
        _, off = self.nearby_traces(step.op.gives, self.sheet.plan_of_step[step.index], plain_value(value))
        is_shown = step.op.gives in self.shows and step.index not in self.sheet.hidden
        return float(off.min(initial=math.inf) < measures.BESIDE_MM) if is_shown else None

    def is_beyond_panel(self, step: Step, value: Any) -> bool:
        """Whether a point would be off its panel, so that no step can use it."""
        return False

    def unlabelled_of(self, kind: str) -> list[int]:
        """The unlabelled traces of a kind."""
        return self._places.get(kind, [])

    def twins(self, place: int) -> set[int]:
        """The traces that are the same ink as a trace that was found by seeking it: the unlabelled strokes upon it, or
        the dots in which a stroke ends."""
        trace = self.traces[place]
        if place < self._read or (trace.kind == POINT and self.picture):
            return set()
        if place not in self._twins:
            rivals = range(self._read) if trace.kind == POINT else self._places[trace.kind]
            self._twins[place] = {rival for rival in rivals if self.traces[rival].kind == trace.kind
                                  and _is_same_ink(trace, self.traces[rival])}
        return self._twins[place]

    def strokes_upon(self, kind: str, panel: str, value: Sequence[float]) -> set[int]:
        """The strokes that lie upon a line or a circle: one is drawn in parts, or goes on beyond its marks."""
        places, off = self.nearby_traces(kind, panel, value)
        return {place for place, far in zip(places, off, strict=True) if far < measures.SAME_STROKE_MM}

    def neighbours(self, place: int, panel: str, value: Sequence[float]) -> list[int]:
        """The other traces that are so near to what one is that it could be they."""
        places, off = self.nearby_traces(self.traces[place].kind, panel, value)
        return [neighbour
                for neighbour, far in zip(places, off, strict=True) if far < measures.BESIDE_MM
                and neighbour != place]

    def nearby_traces(self, kind: str, panel: str, value: Sequence[float]) -> tuple[list[int], Any]:
        """The traces of a kind that may lie on a plan, and how far each is from a value in mm at most."""
        places = self.unlabelled_of(kind)
        if not places:
            return places, np.zeros(0)
        return places, distance_apart(kind, value, self._spots_on_plan(kind, panel)) * self.sheet.mm(panel)

    def _spots_on_plan(self, kind: str, panel: str) -> Any:
        """The spots of all traces of a kind in the units of a plan; infinite if they are stated to be on another."""
        if (kind, panel) not in self._cached:
            frame = self.sheet.fits[panel].frame
            rows = [[frame.to_plan(complex(*spot)) if self.traces[i].panel in ("", panel) else complex(math.inf)
                     for spot in measured_spots(self.traces[i])] for i in self._places[kind]]
            self._cached[kind, panel] = np.array(rows)
        return self._cached[kind, panel]


class ImageSearch(Evidence):
    """The traces of a picture, which is searched for more; what was found is kept: the same thing is searched for
    once."""

    picture, most = True, measures.VECTOR_ODDS

    def __init__(self, sheet: StudentSheet, submission: Submission, traces: list[Trace], places: Sequence[int],
                 panels: Mapping[str, Rect], found: dict[tuple[Any, ...], Trace | None]):
        super().__init__(sheet, submission, traces, places)
        assert submission.page
        self.page, self.panels, self._cache = submission.page, panels, found

    def trace_weight(self, trace: Trace) -> float:
        return self.weight(self.traces.index(trace)) if trace in self.traces else measures.FAINT_ODDS[trace.kind]

    def weight(self, place: int) -> float:
        """Less where it was found only by seeking it; more of a dot in which a stroke ends: it is a vector's."""
        if place >= self._read:
            return measures.FAINT_ODDS[self.traces[place].kind]
        return super().weight(place) if place in self._vector_ends else measures.PICTURE_ODDS[self.traces[place].kind]

    @cached_property
    def _vector_ends(self) -> set[int]:
        """The dots in which a stroke ends, or near which it does."""
        read = self.traces[:self._read]
        strokes = [tuple(complex(*spot) for spot in trace.spots[:2]) for trace in read if trace.kind == LINE]
        return {place for place, trace in enumerate(read) if trace.kind == POINT and any(
            ends_at(stroke, complex(*trace.spots[0])) for stroke in strokes)}

    def find_trace(self, step: Step, expected: Any, own: KnownMarks, within: float) -> Trace | None:
        value, reach = plain_value(expected), min(within, measures.DRIFT_MM)
        spots = self._spots_to_search(step, self._spots(step, value, own))
        key = (step.index, *value, *(round(coordinate) for spot in spots for coordinate in spot))
        if key not in self._cache:
            trace = self._find_near(step, value, spots, reach) if spots else None
            self._cache[key] = with_wobble(trace) if trace else None
        return self._cache[key]

    def search(self, step: Step, expected: Any, own: KnownMarks, within: float) -> Trace | None:
        return self.find_trace(step, expected, own, within)

    def visible_share(self, step: Step, value: Any, own: KnownMarks) -> float | None:
        """Off its panel at what is there all the same; None where print hides most, or where it is too small to see."""
        spots = self._spots(step, plain_value(value), own, measures.ARC_MM / 2)
        share = self.page.visible_share(step.op.gives, self._spots_to_search(step, spots),
                                        measures.BESIDE_MM) if spots else None
        return share if not spots or self._spots_on_panel(step, spots) else share or 0.0

    def is_beyond_panel(self, step: Step, value: Any) -> bool:
        if step.op.gives != POINT:
            return False
        spot = self._sheet_spot(step, complex(*plain_value(value)[:2]))
        return not (self._panel(step).holds(spot) or self.page.visible_share(POINT, [spot], measures.BESIDE_MM))

    def _spots(self, step: Step, value: Value, own: KnownMarks, struck: float = measures.ARC_MM) -> list[Spot]:
        """Spots on the sheet of what a step makes, there where it would be drawn."""
        if step.op.gives == LINE:
            ends = self._line_stretch(step, value, own)
            return [interpolate(*ends, k / measures.STROKE_SPOTS) for k in range(measures.STROKE_SPOTS + 1)]
        if step.op.gives == POINT:
            return [self._sheet_spot(step, complex(*value[:2]))]
        return self._arc(step, value, self._marks_on(step, value, own), struck)

    def _spots_to_search(self, step: Step, spots: Sequence[Spot]) -> Sequence[Spot]:
        """Spots on the step's panel, or all spots if that is empty."""
        return self._spots_on_panel(step, spots) or spots

    def _spots_on_panel(self, step: Step, spots: Sequence[Spot]) -> list[Spot]:
        """Spots on the step's panel."""
        return list(filter(self._panel(step).holds, spots))

    def _panel(self, step: Step) -> Rect:
        return self.panels[self.sheet.plan_of_step[step.index]]

    def _sheet_spot(self, step: Step, z: complex) -> Spot:
        spot = self.sheet.frame(step).to_sheet(z)
        return spot.real, spot.imag

    def _arc(self, step: Step, value: Value, marks: Sequence[complex], struck: float) -> list[Spot]:
        """Spots of an arc about its marks; empty for one that is too small, or has no marks."""
        mm = abs(self.sheet.frame(step).unit)
        centre, radius = complex(value[0], value[1]), math.sqrt(max(value[2], 0.0))
        if radius * mm < measures.ARC_MM:
            return []
        turn = 2 * struck / mm / radius / measures.STROKE_SPOTS
        return [self._sheet_spot(step, centre + cmath.rect(radius, cmath.phase(z - centre) + k * turn)) for z in marks
                for k in range(-measures.STROKE_SPOTS // 2, measures.STROKE_SPOTS // 2 + 1)]

    def _line_stretch(self, step: Step, line: Value, own: KnownMarks) -> tuple[Spot, Spot]:
        """Drawn part of a line on its panel: between the outermost of its marks, or about its only one."""
        a, b, c = line
        mm = abs(self.sheet.frame(step).unit)
        direction, foot = complex(b, -a) / math.hypot(a, b), -complex(a, b) * c / (a * a + b * b)
        along = [((z - foot) * direction.conjugate()).real for z in self._marks_on(step, line, own)] or [0.0]
        spare = measures.LONE_LINE_MM / mm if max(along) - min(along) < measures.LONE_LINE_MM / mm else 0.0
        start, end = (self._sheet_spot(step, foot + direction * far)
                      for far in (min(along) - spare, max(along) + spare))
        inside = clip_segment(self._panel(step), start, end) or (0.0, 1.0)
        return interpolate(start, end, inside[0]), interpolate(start, end, inside[1])

    def _find_near(self, step: Step, value: Value, spots: Sequence[Spot], within: float) -> Trace | None:
        if step.op.gives == LINE:
            return self.page.find_line(spots[0], spots[-1], within)
        if step.op.gives == POINT:
            return self.page.find_dot(spots[0], within)
        radius = math.sqrt(value[2]) * abs(self.sheet.frame(step).unit)
        return self.page.find_arc(self._sheet_spot(step, complex(*value[:2])), radius, spots, within)

    def _marks_on(self, step: Step, value: Value, own: KnownMarks) -> list[complex]:
        """Places of the marks on a line or an arc: drawn ones, and the expected places of later ones."""
        known_values: dict[int, Value | None] = {step.index: value}
        mark_values = [self._value_at(index, known_values, own) for index in self.sheet.marks_on.get(step.index, ())]
        return [complex(*spot[:2]) for spot in mark_values if spot and np.all(np.isfinite(spot))]

    def _value_at(self, index: int, known: dict[int, Value | None], own: KnownMarks) -> Value | None:
        """Value of a step, or of a mistake at it, if known; None if it cannot be drawn."""
        if index not in known:
            mistake, step = own.mistakes.get(index), self.sheet.drawing.drawn.steps[index]
            if index < len(own.values):
                known[index] = plain_value(own.values[index])
            elif isinstance(mistake, tuple):  # what it makes
                known[index] = mistake
            else:
                args = mistake.reads if mistake else step.args
                read = {arg: self._value_at(arg, known, own) for arg in args}
                known[index] = None if None in read.values() else value_of(
                    mistake.step if mistake else step, read, mistake)
        return known[index]


def unexplained_traces(traces: Sequence[Trace], explained: Sequence[Trace]) -> list[Trace]:
    """Of the traces of a picture those that are no part of the strokes and dots that steps explain: half of a stroke,
    or a dot, lies beside them."""
    about = union_all([trace.figure.buffer(measures.END_NEAR_MM if trace.kind == POINT else measures.BESIDE_MM)
                       for trace in explained])
    return [trace for trace in traces if not (
        trace.figure.within(about) or trace.figure.intersection(about).length > trace.figure.length / 2)]


def ends_at(stroke: Sequence[complex], spot: complex) -> bool:
    """Whether a stroke ends at a spot, or a little beyond or before it."""
    start, end = stroke
    along = (spot - start) / ((end - start) or 1.0)
    aside, beyond = abs(along.imag * (end - start)), min(abs(along.real), abs(1.0 - along.real)) * abs(end - start)
    return aside < measures.SAME_STROKE_MM and beyond < measures.OVERSHOOT_MM


def _is_same_ink(one: Trace, other: Trace) -> bool:
    """Whether a point is another, or a line, or a rim, lies upon another of its kind, and beside no more than half of
    it."""
    if one.kind == POINT:
        return math.dist(one.spots[0], other.spots[0]) < measures.END_NEAR_MM
    whole = LineString(other.spots)
    return bool(whole.intersection(LineString(one.spots).buffer(measures.SAME_STROKE_MM)).length > whole.length / 2)
