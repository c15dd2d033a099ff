"""Newton's step of one group in any numbers, and on a tape: recorded once for all groups of one structure.

The step is a sparse QR factorisation by plane rotations (Givens 1958): stable in any order, so that the order is that
of the structure alone, and no number is asked anything on the way. The first rotations turn each loop's two equations
along a link and across it, so that they hold for any pose.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from graphplan.cycle.closure import (
    RESIDUE,
    TRAVEL,
    DriveState,
    GroupLayout,
    LinkPose,
    Row,
    Vector,
    pose_links,
    residual_rows,
    rotate,
)
from graphplan.cycle.tolerances import TINY_PIVOT
from graphplan.kernel.tape.machine import Machine
from graphplan.kernel.tape.record import Blocks, Symbol, Symbols, Tape, function


class NewtonStep(NamedTuple):
    """Newton's step: what is to be taken from each unknown, their rates, and the determinant of the derivatives."""

    corrections: list[Any]
    rates: list[Any]
    determinant: Any


def step(rows: Sequence[Row], width: int, sqrt: Callable[[Any], Any]) -> NewtonStep:
    """Newton's step for so many unknowns, from what is left open."""
    open_rows, pivots, determinant = list(rows), list[tuple[int, Row]](), 1.0
    free = set(range(width))
    while free:
        column = min(free, key=lambda j: (sum(j in row for row in open_rows), j))
        pivot, *lower_rows = sorted((row for row in open_rows if column in row),
                                    key=lambda row: sum(j >= 0 for j in row))
        open_rows = [row for row in open_rows if column not in row]
        for lower_row in lower_rows:
            pivot, cleared = _rotate_rows(pivot, lower_row, column, sqrt)
            open_rows.append(cleared)
        free.remove(column)
        pivots.append((column, pivot))
        determinant = determinant * pivot[column]
    corrections, rates = (_back_substitute(pivots, side) for side in (RESIDUE, TRAVEL))
    return NewtonStep(corrections, [-rate for rate in rates], determinant)


def _rotate_rows(upper: Row, lower: Row, column: int, sqrt: Callable[[Any], Any]) -> tuple[Row, Row]:
    """Two rows rotated so that the second has nothing in a column."""
    a, b = upper[column] + TINY_PIVOT, lower[column]
    hypotenuse = sqrt(a * a + b * b)
    cos, sin = a / hypotenuse, b / hypotenuse
    first: Row = {column: hypotenuse}
    second: Row = {}
    for k in dict.fromkeys([*upper, *lower]):
        x, y = upper.get(k), lower.get(k)
        if k == column:
            continue
        if y is None:
            first[k], second[k] = cos * x, -(sin * x)
        elif x is None:
            first[k], second[k] = sin * y, cos * y
        else:
            first[k], second[k] = cos * x + sin * y, cos * y - sin * x
    return first, second


def _back_substitute(pivots: Sequence[tuple[int, Row]], side: int) -> list[Any]:
    """Back substitution for one right-hand side."""
    solution: Row = {}
    for column, row in reversed(pivots):
        value = row.get(side, 0.0)
        for k, weight in row.items():
            if k in solution:
                value = value - weight * solution[k]
        solution[column] = value / row[column]
    return [solution[column] for column in range(len(pivots))]


def rates_of(link: LinkPose, rates: Sequence[Any]) -> Iterator[Any]:
    """How a link's base moves along x and along y by the travel, and how it turns, where the unknowns change so."""
    base = link.moves
    for moves in ({k: x for k, (x, _) in base.items()}, {k: y for k, (_, y) in base.items()}, link.spin):
        rate: Any = moves.get(TRAVEL, 0.0)
        for k in moves.keys() - {TRAVEL}:
            rate = rate + (rates[k] if moves[k] is None else rates[k] * moves[k])
        yield rate


def apply_corrections(layout: GroupLayout, state: Sequence[Any], corrections: Sequence[Any]) -> list[Any]:
    """The state less the corrections; an angle is turned back by Cayley's formula, right to second order, and where it
    is counted by as much: twice the arc tangent of half the correction."""
    corrected = list(state)
    for i, correction in enumerate(corrections):
        if i < layout.angles:
            half = 0.5 * correction
            square = half * half
            denominator = 1.0 + square
            cos, sin, *angle = state[i]
            turned = rotate((cos, sin), ((1.0 - square) / denominator, -correction / denominator))
            corrected[i] = (*turned, *(angle_in_all - correction * _arc_tangent_ratio(square)
                                       for angle_in_all in angle))
        else:
            corrected[i] = state[i] - correction
    return corrected


def _arc_tangent_ratio(square: Any) -> Any:
    """The arc tangent over its tangent, from the square of that: to the last digit up to a quarter, by its series."""
    ratio: Any = 1 / 15
    for k in range(13, 0, -2):
        ratio = 1 / k - square * ratio
    return ratio


# ---- recorded on a tape, once for all groups of one structure --------------------------------------------------------


PoseNumbers = tuple[float, ...]
"""How a link lies in one pose: its base and turn as x, y, cos, sin, and their rates by the travel as x, y, angle; where
angles are counted then how far it has turned in all."""


TapeRun = Blocks | Machine
"""What replays a tape over arrays."""


class CorrectedPose(NamedTuple):
    """One pose, corrected: as Newton's step has it, and how each link of the group lies then and moves."""

    corrections: tuple[float, ...]
    rates: tuple[float, ...]
    determinant: float
    lies: tuple[PoseNumbers, ...]


class _Record:
    """Newton's step of a group on a tape; where nobody asks for `rates`, known links and drives have none.

    The inputs are how each known link but the frame lies, the arms, the drives, and the state.
    """

    def __init__(self, layout: GroupLayout, rates: bool):
        self.tape, self.inputs, self.layout = Symbols().tape, list[int](), layout
        known_links = [LinkPose(), *(LinkPose(self._pair(), self._pair(), {TRAVEL: self._pair()} if rates else {},
                                              {TRAVEL: self._new()} if rates else {}, self._new() if layout.counted
                                              else 0.0)
                                     for _ in range(layout.carriers - 1))]
        arms = [self._pair() for _ in range(layout.arms)]
        drives = [DriveState(self._angle() if turns else self._new(), self._new() if rates else None)
                  for turns in layout.drives]
        state = [self._angle() if i < layout.angles else self._new() for i in range(layout.unknowns)]
        links = pose_links(layout, known_links, arms, drives, state)
        self.step = step(residual_rows(layout, links, arms, drives), layout.unknowns, Symbol.root)
        closed = pose_links(layout, known_links, arms, drives, apply_corrections(layout, state, self.step.corrections),
                            moving=False)
        self.links, self.closed = links[layout.carriers:], closed[layout.carriers:]

    def _new(self) -> Symbol:
        symbol = self.tape.input(f"n{len(self.inputs)}")
        self.inputs.append(symbol.place)
        return symbol

    def _pair(self) -> Vector:
        return self._new(), self._new()

    def _angle(self) -> tuple[Symbol, ...]:
        """The cosine and sine of an angle, and where angles are counted that itself."""
        return tuple(self._new() for _ in range(3 if self.layout.counted else 2))

    def tape_places(self, *numbers: Any) -> tuple[int, ...]:
        """The places of numbers."""
        return tuple(map(self.tape.place, numbers))

    def link_pose(self, i: int) -> tuple[Any, ...]:
        """How a link of the group lies."""
        return *self.closed[i].base, *(self.closed[i].turn or (1.0, 0.0))

    def link_angle(self, i: int) -> tuple[Any, ...]:
        """How far it has turned in all, if that is counted."""
        return (self.closed[i].angle,) if self.layout.counted else ()

    def link_rates(self, i: int) -> Iterator[Any]:
        """How it moves."""
        return rates_of(self.links[i], self.step.rates)


def record_step(layout: GroupLayout) -> tuple[Tape, list[int], Any]:
    """The tape that corrects one pose: its inputs, and where on it the parts of a :class:`Corrected` stand.

    The inputs are how each known link but the frame lies, the arms, the cosine and sine or the length of each drive
    with its rate, and of each unknown the cosine and sine, or the displacement.
    """
    record = _Record(layout, rates=True)
    step, places_of = record.step, record.tape_places
    lies = tuple(places_of(*record.link_pose(i), *record.link_rates(i), *record.link_angle(i))
                 for i in range(len(record.links)))
    return record.tape, record.inputs, CorrectedPose(places_of(*step.corrections), places_of(*step.rates),
                                                     record.tape.place(step.determinant), lies)


@lru_cache(maxsize=256)
def single_pose_step(layout: GroupLayout) -> Callable[..., Any]:
    """A function that corrects one pose: it reads the inputs of the record and gives the parts of :class:`Corrected`.
    """
    return function(*record_step(layout))


@lru_cache(maxsize=64)
def many_poses_step(layout: GroupLayout, machine: bool) -> TapeRun:
    """The same over arrays, without rates: corrections, determinant, and x, y, cos, sin of each link, then the angle if
    counted."""
    record = _Record(layout, rates=False)
    lies = [number for i in range(len(record.links)) for number in (*record.link_pose(i), *record.link_angle(i))]
    outputs = record.tape_places(*record.step.corrections, record.step.determinant, *lies)
    return (Machine if machine else Blocks)(record.tape, record.inputs, outputs)
