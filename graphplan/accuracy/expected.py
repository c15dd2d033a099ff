"""Expected errors of the results of a construction on its sheet, in their units and in mm of paper.

They are of first order in the errors of the pencil. Where curves cross at too small an angle for the pencil, real
drawings scatter otherwise, and some of the curves do not meet.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from graphplan.design.cost import reading_errors
from graphplan.design.hand import UNBOUNDED, Hand, draw_with_slips, variances
from graphplan.kernel.numbers.gradients import Gradients
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import CURVING, HEADING, LENGTH, PLACE
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, FORCES, VELOCITY, ResultKind
from graphplan.methods.panels import MECHANISM
from graphplan.methods.results import Control, thing_named
from graphplan.phrases import Said, join, said
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.words.rows import Deviation


class Result(NamedTuple):
    """The expected error of one reading: in its own unit and in mm, relative to the largest value of its kind where
    there is any, and the share of each drawn step in its variance. An error without bound is shared by the steps that
    no pencil follows."""

    kind: ResultKind
    of: str
    subject: str
    deviation: Deviation
    relative: float | None
    shares: tuple[float, ...]

    @property
    def label(self) -> Said:
        """The reading in words."""
        if self.kind.turning:
            return said("{0} of link {1}", self.kind.words, self.of)
        numbered = self.of.isdigit()
        return join((self.kind.words, self.of), " ") if numbered else said("{0} of {1}", self.kind.words, self.subject)

    def unit(self, scene: Scene) -> str:
        """The unit of its error."""
        return self.kind.dimension.sheet_unit(scene.units).replace("rad", "1")

    @property
    def worst_step(self) -> int:
        """The step that contributes most, by its place in the drawn program."""
        return max(range(len(self.shares)), key=self.shares.__getitem__)

    def part_of(self, steps: int) -> float:
        """The part of its error that the first steps make alone."""
        whole = sum(self.shares)
        return math.sqrt(sum(self.shares[:steps]) / whole) if whole else 0.0

    def relative_part(self, steps: int) -> float:
        """The part relative to the largest value of its kind; 0 without such a value or bound."""
        return self.relative * self.part_of(steps) if self.relative and math.isfinite(self.relative) else 0.0


def first_order(drawing: Construction, hand: Hand, scales: Scales) -> tuple[Result, ...]:
    """The expected error of every result, as the hand draws the construction at these scales."""
    plan_of_step, results = drawing.plan_of_step, list[Result]()
    for reading, off, relative, shares in reading_errors(drawing, hand):
        marks = [drawing.drawn.wanted[position] for position in reading.marks]
        of_mm = _of_mm(reading.kind, [hand.values[index] for index in marks], scales, plan_of_step[marks[-1]])
        subject = thing_named(drawing.scene, reading.kind, reading.of)
        deviation = Deviation(off, off / of_mm if of_mm else None)
        results.append(Result(reading.kind, reading.of, subject, deviation, relative, shares))
    return tuple(results)


def worst_error(results: Sequence[Result], plan_of_step: Sequence[Panel],
                at: Scales) -> Callable[[Scales], float]:
    """The largest relative error that has a bound, by the scales, of results at some: slips count with the square of
    their plan's lengths per mm, the turning of set squares, which no scale makes smaller, among them."""
    variances = [np.square(result.relative) * np.divide(result.shares, sum(result.shares))
                 for result in results if result.relative and math.isfinite(result.relative)]

    def worst(scales: Scales) -> float:
        coarser = [(scales.lengths_per_mm(plan) / at.lengths_per_mm(plan)) ** 2 for plan in plan_of_step]
        return math.sqrt(max((float(np.dot(by_step, coarser)) for by_step in variances), default=0.0))

    return worst


@UNBOUNDED
def deviation(hand: Hand, reading: Callable[[Sequence[Any]], Any]) -> float:
    """The standard deviation of what is read off a program as the hand draws it; `reading` is linear in its values."""
    domain, values = draw_with_slips(hand)
    return math.sqrt(float(np.sum(variances(domain, reading(values)))))


@UNBOUNDED
def point_deviations(hand: Hand, points: Iterable[int]) -> list[float]:
    """The standard deviation in x and in y, on the average, of points as the hand draws them, by their steps."""
    domain, values = draw_with_slips(hand)
    return [math.sqrt(float(np.sum(variances(domain, values[index][:2]))) / 2) for index in points]


@UNBOUNDED
def control_errors(drawing: Construction, hand: Hand, scales: Scales) -> list[tuple[Control, float]]:
    """By how many mm each control's pole misses the third line, by standard deviation."""
    domain, values = draw_with_slips(hand) if drawing.controls else (Gradients(0), [])
    misses = []
    for control in drawing.controls:
        off = math.sqrt(float(np.sum(variances(domain, control.drawn_deviation(values)))))
        start, end = (hand.values[mark] for mark in control.marks[-1])
        misses.append((control, off / math.dist(start, end) / scales.lengths_per_mm(MECHANISM)))
    return misses


def _of_mm(kind: ResultKind, marks: Sequence[Any], scales: Scales, panel: str) -> float | None:
    """Value of a millimetre of the drawn vector; for a turning that of the two points' relative vector.

    A moment is no vector of a plan, nor is a curvature.
    """
    if (kind.single and not kind.turning and len(marks) > 1) or kind.dimension in (HEADING, CURVING):
        return None
    measures = {VELOCITY: scales.speed, ACCELERATION: scales.acceleration, FORCES: scales.force}
    scale = scales.lengths_per_mm(panel) if kind.dimension in (LENGTH, PLACE) else measures[kind.group](panel)
    return scale / math.dist(marks[0], marks[1]) if kind.turning else scale
