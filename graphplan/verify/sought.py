"""What a picture shows where a step should be: faint lines, short arcs and dots, found only by seeking them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.errors import Undrawable
from graphplan.handed.traces import Searched, Spot, Trace
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Step
from graphplan.sheet.planes import Planes
from graphplan.verify.board import Board, plain

HIDDEN = 0.6  # the part of a line that print may hide
ALONE, WIDEST = 10.0, 3.0  # mm: a line about its only mark; and no search is wider
WOBBLE = 0.06  # mm: the standard deviation of a pencil line from the edge that it is drawn along
STRUCK = 4.0  # mm of an arc to both sides of its mark


def wobbly(trace: Trace) -> Trace:
    """A trace of a picture, as sure as a line is straight that a hand draws."""
    return replace(trace, blur=math.hypot(trace.blur, WOBBLE))


class Sought:
    """A picture that is searched for the steps of a construction; the same thing is sought once."""

    def __init__(self, board: Board, page: Searched):
        self.board, self.page = board, page
        self._found: dict[tuple[Any, ...], Trace | None] = {}

    def trace(self, step: Step, expected: Any, own: Sequence[Any], within: float) -> Trace | None:
        """What is there about an expected value, no further off than so many mm."""
        value, reach = plain(expected), min(within, WIDEST)
        key = (step.index, *value)
        if key not in self._found:
            found = self._sought(step, value, own, reach)
            self._found[key] = wobbly(found) if found else None
        return self._found[key]

    def hidden(self, step: Step, expected: Any, own: Sequence[Any]) -> bool:
        """Whether most of a line would lie on what is printed."""
        if step.op.gives != LINE:
            return False
        start, end = (complex(*spot) for spot in self._stretch(step, plain(expected), own))
        spots = [start + (end - start) * k / 20 for k in range(21)]
        return self.page.hidden([(z.real, z.imag) for z in spots]) > HIDDEN

    def _stretch(self, step: Step, line: tuple[float, ...], own: Sequence[Any]) -> tuple[Spot, Spot]:
        """Where on the sheet a line would be drawn: between the outermost of its marks, or about its only one."""
        a, b, c = line
        home = self.board.homes[step.index]
        frame, mm = self.board.fits[home].frame, self.board.mm(home)
        way, foot = complex(b, -a) / math.hypot(a, b), -complex(a, b) * c / (a * a + b * b)
        along = [((z - foot) * way.conjugate()).real for z in self._marks(step, line, own)] or [0.0]
        spare = ALONE / mm if max(along) - min(along) < ALONE / mm else 0.0
        start, end = (frame.onto(foot + way * far) for far in (min(along) - spare, max(along) + spare))
        return (start.real, start.imag), (end.real, end.imag)

    def _sought(self, step: Step, value: tuple[float, ...], own: Sequence[Any], within: float) -> Trace | None:
        frame = self.board.fits[self.board.homes[step.index]].frame

        def onto(z: complex) -> Spot:
            spot = frame.onto(z)
            return spot.real, spot.imag

        if step.op.gives == POINT:
            return self.page.dot(onto(complex(*value[:2])), within)
        if step.op.gives == LINE:
            return self.page.near(*self._stretch(step, value, own), within)
        marks, mm = self._marks(step, value, own), self.board.mm(self.board.homes[step.index])
        centre, radius = complex(value[0], value[1]), math.sqrt(value[2])
        if not marks or radius * mm < STRUCK:
            return None
        turn = STRUCK / mm / radius
        spots = [onto(centre + cmath.rect(radius, cmath.phase(z - centre) + k * turn)) for z in marks
                 for k in (-1, 0, 1)]
        return self.page.rim(onto(centre), radius * mm, spots, within)

    def _marks(self, step: Step, value: tuple[float, ...], own: Sequence[Any]) -> list[complex]:
        """Where the marks on a line or an arc are: those that are drawn, and those that it makes with them; where
        others to come should be."""
        found = [self._mark(index, step, value, own) for index in self._on.get(step.index, ())]
        return [complex(*spot) for spot in found if np.all(np.isfinite(spot))]

    def _mark(self, index: int, step: Step, value: tuple[float, ...], own: Sequence[Any]) -> tuple[float, ...]:
        """Where one of the marks on what a step makes is, or would be."""
        if index < len(own):
            return plain(own[index])[:2]
        other, drawing = self.board.drawing.drawn.steps[index], self.board.drawing
        if all(arg < len(own) or arg == step.index for arg in other.args):
            read = [value if arg == step.index else plain(own[arg]) for arg in other.args]
            try:
                return plain(other.op.rule(Floats(), *read, **other.params))[:2]
            except Undrawable:
                pass
        return plain(drawing.values[index])[:2]

    @cached_property
    def _on(self) -> dict[int, tuple[int, ...]]:
        return Planes(self.board.drawing).marks_on
