"""What a design costs, in percent of its results: one number, by which designs are chosen.

The terms stand in one table, each with its price: the expected error of the worst result, beside the largest value of
its kind; each step; each vector that is shorter than a point of the pencil is off; plans that are larger than the
mechanism or the vectors that they are there for; and that it is another design than the textbook's. Errors are those of
first order of a careful hand, on plans that are each as large as there is room for on a usual panel: what is drawn of
the mechanism and its vectors, and marks beside it as far as they make it no more than twice as large.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from graphplan.design.hand import UNBOUNDED, Hand, Pencil, draw_with_slips, hand, variances
from graphplan.design.tolerances import EXTENT_TOL, ZERO_TOL
from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel.kinds import POINT
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.gradients import Gradients
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import LENGTH, PLACE
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ResultKind
from graphplan.methods.panels import MECHANISM
from graphplan.methods.recorded import Reading, components

USUAL_PANEL = 150.0, 100.0  # mm: the room for the marks of a plan, the long way and the short way
MAX_WIDTH_RATIO = 2.05  # times as large a plan may be for marks beside its vectors
MOST_STEPS = 500  # of a drawing that is weighed: no sheet shows more
Spots = list[tuple[float, float]]
Marks = Mapping[Panel, tuple[Spots, Spots]]  # of each plan: the pose and the ends of vectors, and all other points


class ReadingError(NamedTuple):
    """The expected error of a reading: in its own unit, relative to the largest value of its kind where there is any,
    and the share of each drawn step in its variance."""

    reading: Reading
    off: float
    relative: float | None
    shares: tuple[float, ...]


@UNBOUNDED
def reading_errors(drawing: Construction, hand: Hand) -> list[ReadingError]:
    """The expected error of every reading, to first order, as the hand draws the construction."""
    domain, values = draw_with_slips(hand)
    owner = np.repeat(np.arange(len(hand.slips)), [len(slips) for slips in hand.slips])
    largest, errors = largest_values(drawing, hand.values), list[ReadingError]()
    for reading, _, value in readings(drawing, values, domain):
        if not reading.marks:
            continue  # it is given, not drawn
        squares = variances(domain, value)
        off = math.sqrt(float(np.sum(squares)))
        if math.isinf(off):
            squares = np.isinf(squares)
        group, arm = _group_and_arm(drawing.scene, reading.kind)
        relative = math.inf if math.isinf(off) else None
        if largest[group] > ZERO_TOL * arm * off:
            relative = arm * off / largest[group]
        shares = np.bincount(owner, squares, len(hand.slips))
        errors.append(ReadingError(reading, off, relative, tuple(shares.tolist())))
    return errors


def readings(drawing: Construction, values: Sequence[Any], domain: Domain) -> Iterator[tuple[Reading, list[Any], Any]]:
    """Yield each reading of drawn values with its marks and its value."""
    outputs = [values[index] for index in drawing.drawn.wanted]
    for reading in drawing.readings:
        marks = [outputs[position] for position in reading.marks]
        yield reading, marks, drawing.value(reading, marks, domain)


def largest_values(drawing: Construction, values: Sequence[Any]) -> dict[str, float]:
    """The largest value of each group of kinds; the places of slides' reactions are compared with the mechanism."""
    largest = {"place": drawing.scene.extent}
    for reading, _, value in readings(drawing, values, Gradients(0)):
        group, arm = _group_and_arm(drawing.scene, reading.kind)
        largest[group] = max(largest.get(group, 0.0), arm * math.hypot(*components(value)))
    return largest


def _group_and_arm(scene: Scene, kind: ResultKind) -> tuple[str, float]:
    """The group with which a kind is compared, and its arm."""
    return "place" if kind.dimension in (LENGTH, PLACE) else kind.group, float(kind.arm(scene.extent, scene.units))


class Weighed(NamedTuple):
    """A construction that is weighed: its pencil, the marks of its plans, the scene's lengths in a millimetre of each,
    the errors of its readings, and whether its design departs from the textbook's."""

    drawing: Construction
    pencil: Pencil
    marks: Marks
    units: Mapping[Panel, float]
    errors: Sequence[ReadingError]
    departs: bool


class Term(NamedTuple):
    """A term of the cost: its name, what one of it costs in percent, for what, and how much of it a construction has.
    """

    name: str
    price: float
    each: str
    amount: Callable[[Weighed], float]


def _worst_error(weighed: Weighed) -> float:
    """The expected error of the worst result, in percent of the largest of its kind."""
    return 100 * max((error.relative for error in weighed.errors if error.relative is not None), default=0.0)


def _steps(weighed: Weighed) -> int:
    """The number of steps."""
    return len(weighed.drawing.drawn) - weighed.drawing.drawn.givens


def _too_short(weighed: Weighed) -> int:
    """The number of vectors that are drawn shorter than a point of the pencil is off, though they are not zero."""
    return sum(0.0 < length < weighed.pencil.point for length in _lengths_mm(weighed.drawing, weighed.units))


def _doublings(weighed: Weighed) -> float:
    """Number of doublings by which plans exceed their purpose: the mechanism, or the vectors of another plan."""
    drawing, tiny = weighed.drawing, EXTENT_TOL * weighed.drawing.scene.extent
    pose = [_spot(drawing.values[step.index]) for step in drawing.drawn.steps[:drawing.drawn.givens]
            if step.op.gives == POINT]
    doublings = 0.0
    for panel, (core, others) in weighed.marks.items():
        least, whole = _longer_side(pose if panel == MECHANISM else core), _longer_side([*core, *others])
        doublings += math.log2(whole / least) if least > tiny else 0.0
    return doublings


TERMS = (
    Term("error", 1.0, "a percent that the worst result is off", _worst_error),
    Term("steps", 0.05, "a step", _steps),
    Term("too short", 5.0, "a vector too short for a pencil", _too_short),
    Term("wide", 2.0, "a doubling of a plan beside what it is there for", _doublings),
    Term("departs", 4.0, "where it is not the textbook's", lambda weighed: weighed.departs),
)


class DesignCost(NamedTuple):
    """The cost of a design in percent, and the amount of each term; empty if it is not weighed."""

    percent: float
    amounts: tuple[float, ...] = ()


UNDRAWABLE, TOO_LONG = DesignCost(math.inf), DesignCost(0.0)


def cost(drawing: Construction, pencil: Pencil, departs: bool = False) -> DesignCost:
    """Cost of a construction, drawn with a pencil; one of more steps than any sheet shows is not weighed."""
    try:
        if len(drawing.program) > MOST_STEPS or len(drawing.drawn) > MOST_STEPS:
            return TOO_LONG if drawing.has_numbers else UNDRAWABLE
        marks = _marks_of_plans(drawing)
        units = _units(marks, drawing.scene.extent)
        errors = reading_errors(drawing, hand(drawing, units.__getitem__, pencil))
    except (ConstructionError, Undrawable, ZeroDivisionError):
        return UNDRAWABLE
    weighed = Weighed(drawing, pencil, marks, units, errors, departs)
    amounts = tuple(term.amount(weighed) for term in TERMS)
    return DesignCost(sum(term.price * amount for term, amount in zip(TERMS, amounts, strict=True)), amounts)


def _units(marks: Marks, extent: float) -> Mapping[Panel, float]:
    """The scene's lengths in a millimetre of each plan, where each has a usual panel and twins have one scale."""
    scales = dict[Panel, float]()
    for panel, spots in marks.items():
        scales[panel.twin] = max(_lengths_per_mm(*spots, EXTENT_TOL * extent), scales.get(panel.twin, 0.0))
    whole = max(scales.values(), default=0.0) or extent / USUAL_PANEL[0]
    return {panel: scales[panel.twin] or whole for panel in marks}


def _marks_of_plans(drawing: Construction) -> Marks:
    """The points of each plan: what is given of the pose and the ends of vectors, and all others."""
    values, plan_of_step, givens = drawing.values, drawing.plan_of_step, drawing.drawn.givens
    plans: dict[Panel, tuple[Spots, Spots]] = {panel: ([], []) for panel in plan_of_step}
    for vector in drawing.arrows:
        plans[plan_of_step[vector.end]][0].extend(_spot(values[mark]) for mark in (vector.start, vector.end))
    for step in drawing.drawn.steps:
        plan = plans[plan_of_step[step.index]]
        if step.op.gives == POINT:
            plan[step.index >= givens].append(_spot(values[step.index]))
    return plans


def _spot(mark: Any) -> tuple[float, float]:
    return float(mark[0]), float(mark[1])


def _longer_side(spots: Spots) -> float:
    """The longer side of the box around some points."""
    return max((max(coordinates) - min(coordinates) for coordinates in zip(*spots, strict=True)), default=0.0)


def _lengths_per_mm(core: Spots, others: Spots, tiny: float) -> float:
    """The lengths in a millimetre at which some points, and others near them, just have room on a usual panel; zero
    where they all coincide."""
    points = core or others
    low, high = ([choose(point[axis] for point in points) for axis in (0, 1)] for choose in (min, max)) if points else (
        [0.0, 0.0], [0.0, 0.0])
    most = MAX_WIDTH_RATIO * max(high[0] - low[0], high[1] - low[1])

    def outside(point: tuple[float, float]) -> float:
        return max(*(low[axis] - point[axis] for axis in (0, 1)), *(point[axis] - high[axis] for axis in (0, 1)))

    for point in sorted(others, key=outside):
        least, greatest = ([choose(side[axis], point[axis]) for axis in (0, 1)]
                           for side, choose in ((low, min), (high, max)))
        if max(greatest[0] - least[0], greatest[1] - least[1]) <= most:
            low, high = least, greatest
    short, long = sorted((high[0] - low[0], high[1] - low[1]))
    return max(long / USUAL_PANEL[0], short / USUAL_PANEL[1]) if long > tiny else 0.0


def _lengths_mm(drawing: Construction, units: Mapping[Panel, float]) -> Iterator[float]:
    """Yield the lengths of the vectors that were asked for, in mm; zero if rounding alone makes them."""
    tiny = EXTENT_TOL * drawing.scene.extent
    for vector in drawing.arrows:
        start, end = drawing.values[vector.start], drawing.values[vector.end]
        length = math.dist(start[:2], end[:2])
        yield length / units[drawing.plan_of_step[vector.end]] if length > tiny else 0.0
