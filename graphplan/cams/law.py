"""The law of a follower over one turn of the cam: stages one after the other, lift and its derivatives, and jumps.

Angles of the cam are in degrees, counted from the beginning of the first stage the way the cam turns; derivatives are
by the angle in radians. Where two stages meet each has its own derivatives: a jump of the velocity is a hard shock, as
the acceleration is infinite there, a jump of the acceleration a soft one (Ozols 1974, 20-2).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any

import numpy as np

from graphplan.cams.motions import ORDERS, Piece
from graphplan.cams.tolerances import JUMP_TOL, MIN_SIZE

Array = Any

HARD, SOFT = 1, 2  # the orders of the derivatives that jump
PARTS, FINER, ROUNDS = 90, 16, 9  # of a piece in which the largest value is searched, then so often again


@dataclass(frozen=True)
class Stage:
    """A part of the turn: over so many degrees the lift changes by `stroke` in a motion of this name.

    Its pieces are lifts over the part of the stage that is behind.
    """

    angle: Fraction
    stroke: Fraction
    motion: str
    pieces: tuple[Piece, ...]


@dataclass(frozen=True)
class Stretch:
    """One smooth piece of the law, from one angle to another, in degrees."""

    start: Fraction
    end: Fraction
    stage: Stage
    begins: Fraction  # the angle at which its stage begins
    lift: Fraction  # the lift there
    piece: Piece

    def at(self, angle: Any, order: int = 0) -> Any:
        """The lift, or its derivative by the angle in radians, which may be an array of degrees."""
        part = (angle - float(self.begins)) / float(self.stage.angle)
        found = self.piece.at(part, order)
        return found + float(self.lift) if order == 0 else found / math.radians(self.stage.angle) ** order

    def divided(self, parts: int) -> Array:
        """Its angles from end to end, so many parts of it apart."""
        return np.linspace(float(self.start), float(self.end), parts + 1)


Value = Callable[[Array, Stretch], Array]


@dataclass(frozen=True)
class Jump:
    """Where a derivative of the law changes at once: at which angle, of which order, from what to what."""

    angle: Fraction
    order: int
    before: float
    after: float


@dataclass(frozen=True)
class Law:
    """The stages of one turn; `times` turns lifts into the lengths or radians that are reckoned with."""

    stages: tuple[Stage, ...]
    times: float = 1.0

    @cached_property
    def stretches(self) -> tuple[Stretch, ...]:
        """The smooth pieces in order."""
        found, angle, lift = list[Stretch](), Fraction(0), Fraction(0)
        for stage in self.stages:
            found += [Stretch(angle + stage.angle * piece.start, angle + stage.angle * piece.end, stage, angle, lift,
                              piece) for piece in stage.pieces]
            angle, lift = angle + stage.angle, lift + stage.stroke
        return tuple(found)

    @cached_property
    def lifts(self) -> tuple[Fraction, ...]:
        """The lift at the end of each stage."""
        return tuple(accumulate(stage.stroke for stage in self.stages))

    @cached_property
    def bounds(self) -> tuple[Fraction, ...]:
        """The angles at which stages begin, and the end of the last."""
        return tuple(accumulate((stage.angle for stage in self.stages), initial=Fraction(0)))

    def at(self, angles: Any, order: int = 0) -> Any:
        """The lift or a derivative at angles in degrees, an array; where two pieces meet, of the one that begins."""
        turned = np.asarray(angles, float) % 360.0
        starts = np.array([float(one.start) for one in self.stretches])
        which = np.maximum(np.searchsorted(starts, turned, "right") - 1, 0)
        found = np.empty_like(turned)
        for k, one in enumerate(self.stretches):
            own = which == k
            if own.any():
                found[own] = one.at(turned[own], order)
        return self.times * found

    @property
    def closed(self) -> tuple[Fraction, Fraction]:
        """How many degrees its stages have, and how high it is after them."""
        return self.bounds[-1], self.lifts[-1]

    @cached_property
    def jumps(self) -> tuple[Jump, ...]:
        """The hard and soft shocks in the order of the turn."""
        scale = [max(self.largest(order), MIN_SIZE) for order in range(ORDERS)]
        return tuple(jump for jump in self._joints() if abs(jump.after - jump.before) > JUMP_TOL * scale[jump.order])

    def largest(self, order: int) -> float:
        """About how large the derivative of an order is where it is largest."""
        found = (abs(one.at(one.divided(8), order)).max() for one in self.stretches)
        return self.times * max(map(float, found))

    def _joints(self) -> Iterator[Jump]:
        """What each derivative does where pieces meet; a velocity that jumps says nothing of the acceleration."""
        for before, after in pairwise((self.stretches[-1], *self.stretches)):
            for order in (HARD, SOFT):
                values = before.at(float(before.end), order), after.at(float(after.start), order)
                yield Jump(after.start, order, *(self.times * float(value) for value in values))

    def extremum(self, value: Value, rounds: int = ROUNDS) -> tuple[float, float]:
        """The angle and the size of the largest value over the turn of a function of (angles, stretch).

        The function reads an array of degrees and the piece that they lie on. Each piece is divided, then the parts
        beside the best place so many times again.
        """
        found = (_highest(lambda angles, one=one: value(angles, one), one, rounds)  # type: ignore[misc]
                 for one in self.stretches)
        return max(found, key=lambda pair: pair[1])


def _highest(value: Callable[[Array], Array], one: Stretch, rounds: int) -> tuple[float, float]:
    """The place and size of the largest value of a function on a piece."""
    low, high, parts, best = float(one.start), float(one.end), PARTS, (math.nan, -math.inf)
    for _ in range(rounds + 1):
        angles = np.linspace(low, high, parts + 1)
        values = np.nan_to_num(np.asarray(value(angles), float), nan=-math.inf)
        k = int(np.argmax(values))
        best = max(best, (float(angles[k]), float(values[k])), key=lambda pair: pair[1])
        low, high, parts = float(angles[max(k - 1, 0)]), float(angles[min(k + 1, parts)]), FINER
    return best
