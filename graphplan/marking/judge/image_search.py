"""What a picture shows where a step should be: faint lines, short arcs and dots, found only by seeking them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge.mistakes import Mistake, value_of
from graphplan.marking.judge.student_sheet import StudentSheet, plain
from graphplan.marking.traces import Searched, Spot, Trace
from graphplan.sheet.plates import clip
from graphplan.sheet.plates.display import Rect

PARTS, NEAR = 20, 1.0  # at so many spots, so near, a stroke is looked for
ALONE, WIDEST = 10.0, 3.0  # mm: a line about its only mark; and no search is wider
WOBBLE = 0.06  # mm: the standard deviation of a pencil line from the edge that it is drawn along
STRUCK = 4.0  # mm of an arc to both sides of its mark
Value = tuple[float, ...]


@dataclass(frozen=True)
class KnownMarks:
    """How far a drawing has been gone through: the values of its steps, and the slips still to come, or what they
    make."""

    values: Sequence[Any]
    mistakes: Mapping[int, Mistake | Value]


def wobbly(trace: Trace) -> Trace:
    """A trace of a picture, as sure as a line is straight that a hand draws."""
    return replace(trace, blur=math.hypot(trace.blur, WOBBLE))


class ImageSearch:
    """A picture that is searched for the steps of a construction; the same thing is sought once."""

    def __init__(self, sheet: StudentSheet, page: Searched, panels: Mapping[str, Rect]):
        self.sheet, self.page, self.panels = sheet, page, panels
        self._found: dict[tuple[Any, ...], Trace | None] = {}

    def trace(self, step: Step, expected: Any, own: KnownMarks, within: float) -> Trace | None:
        """What is there about an expected value, no further off than so many mm."""
        value, reach = plain(expected), min(within, WIDEST)
        spots = self._held(step, self._spots(step, value, own))
        key = (step.index, *value, *(round(part) for spot in spots for part in spot))
        if key not in self._found:
            found = self._sought(step, value, spots, reach) if spots else None
            self._found[key] = wobbly(found) if found else None
        return self._found[key]

    def share(self, step: Step, value: Any, own: KnownMarks) -> float | None:
        """At how much of what a step would make something like it is to be seen: at nothing off its panel; None where
        print hides most, or where it is too small to see."""
        spots = self._spots(step, plain(value), own, STRUCK / 2)
        held = self._held(step, spots)
        return self.page.share(step.op.gives, held, NEAR) if held else 0.0 if spots else None

    def beyond(self, step: Step, value: Any) -> bool:
        """Whether a point would be off its panel, so that nothing can be drawn from it."""
        return step.op.gives == POINT and not self._panel(step).holds(self._onto(step, complex(*plain(value)[:2])))

    def _spots(self, step: Step, value: Value, own: KnownMarks, struck: float = STRUCK) -> list[Spot]:
        """Spots on the sheet of what a step makes, there where it would be drawn."""
        if step.op.gives == LINE:
            ends = self._stretch(step, value, own)
            return [clip.between(*ends, k / PARTS) for k in range(PARTS + 1)]
        if step.op.gives == POINT:
            return [self._onto(step, complex(*value[:2]))]
        return self._arc(step, value, self._marks(step, value, own), struck)

    def _held(self, step: Step, spots: Sequence[Spot]) -> list[Spot]:
        """Those of some spots that are on the step's panel."""
        return list(filter(self._panel(step).holds, spots))

    def _panel(self, step: Step) -> Rect:
        return self.panels[self.sheet.plan_of_step[step.index]]

    def _onto(self, step: Step, z: complex) -> Spot:
        spot = self.sheet.fits[self.sheet.plan_of_step[step.index]].frame.onto(z)
        return spot.real, spot.imag

    def _arc(self, step: Step, value: Value, marks: Sequence[complex], struck: float) -> list[Spot]:
        """Spots of an arc about its marks; none of one that is too small, or has no marks."""
        mm = self.sheet.mm(self.sheet.plan_of_step[step.index])
        centre, radius = complex(value[0], value[1]), math.sqrt(max(value[2], 0.0))
        if radius * mm < STRUCK:
            return []
        turn = 2 * struck / mm / radius / PARTS
        return [self._onto(step, centre + cmath.rect(radius, cmath.phase(z - centre) + k * turn)) for z in marks
                for k in range(-PARTS // 2, PARTS // 2 + 1)]

    def _stretch(self, step: Step, line: Value, own: KnownMarks) -> tuple[Spot, Spot]:
        """Where a line would be drawn, as far as it is on its panel: between the outermost of its marks, or about its
        only one."""
        a, b, c = line
        mm = self.sheet.mm(self.sheet.plan_of_step[step.index])
        way, foot = complex(b, -a) / math.hypot(a, b), -complex(a, b) * c / (a * a + b * b)
        along = [((z - foot) * way.conjugate()).real for z in self._marks(step, line, own)] or [0.0]
        spare = ALONE / mm if max(along) - min(along) < ALONE / mm else 0.0
        start, end = (self._onto(step, foot + way * far) for far in (min(along) - spare, max(along) + spare))
        inside = clip.segment(self._panel(step), start, end) or (0.0, 1.0)
        return clip.between(start, end, inside[0]), clip.between(start, end, inside[1])

    def _sought(self, step: Step, value: Value, spots: Sequence[Spot], within: float) -> Trace | None:
        if step.op.gives == LINE:
            return self.page.near(spots[0], spots[-1], within)
        if step.op.gives == POINT:
            return self.page.dot(spots[0], within)
        radius = math.sqrt(value[2]) * self.sheet.mm(self.sheet.plan_of_step[step.index])
        return self.page.rim(self._onto(step, complex(*value[:2])), radius, spots, within)

    def _marks(self, step: Step, value: Value, own: KnownMarks) -> list[complex]:
        """Where the marks on a line or an arc are: those that are drawn, and where those to come would follow."""
        known: dict[int, Value | None] = {step.index: value}
        found = [self._value(index, known, own) for index in self.sheet.marks_on.get(step.index, ())]
        return [complex(*spot[:2]) for spot in found if spot and np.all(np.isfinite(spot))]

    def _value(self, index: int, known: dict[int, Value | None], own: KnownMarks) -> Value | None:
        """What a step makes, or a slip at it, of those that are known; None where it cannot be drawn."""
        if index not in known:
            known[index] = plain(own.values[index]) if index < len(own.values) else self._made(index, known, own)
        return known[index]

    def _made(self, index: int, known: dict[int, Value | None], own: KnownMarks) -> Value | None:
        mistake = own.mistakes.get(index)
        if isinstance(mistake, tuple):  # what it makes
            return mistake
        step = mistake.step if mistake else self.sheet.drawing.drawn.steps[index]
        read = {arg: self._value(arg, known, own) for arg in (*step.args, *(mistake.mirror or () if mistake else ()))}
        return None if None in read.values() else value_of(step, read, mistake)
