"""The law of a follower over one turn of the cam: stages one after the other, lift and its derivatives, and jumps.

A motion is how a follower gets from rest to rest, as a function of the part of the stage that is behind it: a lift f(t)
from f(0) = 0 to f(1) = 1 in closed form, with its derivatives: powers of t with fractions as coefficients, so that a
fraction goes in and a fraction comes out, or waves.

Angles of the cam are in degrees, counted from the beginning of the first stage the way the cam turns; derivatives are
by the angle in radians. Where two stages meet each has its own derivatives: a jump of the velocity is a hard shock, as
the acceleration is infinite there, a jump of the acceleration a soft one.

Sources: Ozols 1974, 20-2, fig. 20-4 (uniform, parabolic, sine, trapezoid); harmonic and 3-4-5 as they are usual.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Any

import numpy as np

from graphplan.cams.tolerances import JUMP_TOL, MIN_SIZE
from graphplan.mechanism.equations import Elimination

# ---- motions --------------------------------------------------------------------------------------------------------


ORDERS = 4  # lift, velocity, acceleration and jerk
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Wave:
    """amplitude sin(pi (frequency t + quarters/2)): `frequency` in half turns."""

    amplitude: float
    frequency: int
    quarters: int = 0

    def value_at(self, t: Any) -> Any:
        """Value, in floats."""
        return self.amplitude * np.sin(math.pi * (self.frequency * t + self.quarters / 2))

    @property
    def derivative(self) -> Wave:
        return replace(self, amplitude=self.amplitude * math.pi * self.frequency, quarters=self.quarters + 1)


@dataclass(frozen=True)
class MotionPiece:
    """A motion from one part of its stage to another: the sum of powers of t, the constant first, and of waves."""

    start: Fraction
    end: Fraction
    powers: tuple[Fraction, ...]
    waves: tuple[Wave, ...] = ()

    def value_at(self, t: Any, order: int = 0) -> Any:
        """The lift, or its derivative of an order, at t: a float, an array, or a fraction where there are no waves."""
        piece = self
        for _ in range(order):
            piece = piece._derivative
        exact = isinstance(t, Fraction)
        value: Any = 0 * t
        for power in reversed(piece.powers):
            value = value * t + (power if exact else float(power))
        return sum((wave.value_at(t) for wave in piece.waves), value)

    def times(self, factor: Fraction) -> MotionPiece:
        """Return the motion multiplied by a factor."""
        waves = tuple(replace(wave, amplitude=float(factor) * wave.amplitude) for wave in self.waves)
        return replace(self, powers=tuple(factor * power for power in self.powers), waves=waves)

    @property
    def _derivative(self) -> MotionPiece:
        powers = tuple(k * power for k, power in enumerate(self.powers))[1:]
        return replace(self, powers=powers, waves=tuple(wave.derivative for wave in self.waves))


def integrate_parts(parts: Sequence[tuple[Fraction, Fraction]], order: int) -> tuple[MotionPiece, ...]:
    """The motion from rest at 0 of which the derivative of an order is constant in parts: (where it begins, value)."""
    pieces, state = list[MotionPiece](), (Fraction(0),) * order
    for (start, value), (end, _) in pairwise((*parts, (Fraction(1), Fraction(0)))):
        derivatives = (*state, value)
        taylor = [rate / math.factorial(k) for k, rate in enumerate(derivatives)]
        piece = MotionPiece(start, end, shift_powers(taylor, start))
        pieces.append(piece)
        state = tuple(piece.value_at(end, k) for k in range(order))
    return tuple(pieces)


def shift_powers(powers: Sequence[Fraction], by: Fraction) -> tuple[Fraction, ...]:
    """The coefficients in t of a sum of powers of t - by."""
    shifted = [Fraction(0)] * len(powers)
    for n, power in enumerate(powers):
        for k in range(n + 1):
            shifted[k] += power * math.comb(n, k) * (-by) ** (n - k)
    return tuple(shifted)


def spline(knots: Sequence[Fraction], lifts: Sequence[Fraction], closed: bool) -> tuple[MotionPiece, ...]:
    """The cubic spline through lifts at knots from 0 to 1: at rest at both ends or, `closed`, periodic.

    Velocity and acceleration are continuous inside, jerk is not. All coefficients are fractions.
    """
    widths = [end - start for start, end in pairwise(knots)]
    rises = [(end - start) / width for (start, end), width in zip(pairwise(lifts), widths, strict=True)]
    rates = _periodic_rates(widths, rises) if closed else _clamped_rates(widths, rises)
    pieces = []
    for k, (width, rise) in enumerate(zip(widths, rises, strict=True)):
        bend = (rates[k + 1] + rates[k] - 2 * rise) / width**2
        taylor = (lifts[k], rates[k], (rise - rates[k]) / width - bend * width, bend)
        pieces.append(MotionPiece(knots[k], knots[k + 1], shift_powers(taylor, knots[k])))
    return tuple(pieces)


def _clamped_rates(widths: Sequence[Fraction], rises: Sequence[Fraction]) -> list[Fraction]:
    """The rates at all knots where those at the ends are 0."""
    inner = range(1, len(widths))
    rows = [{k - 1: widths[k], k: 2 * (widths[k - 1] + widths[k]), k + 1: widths[k - 1]} for k in inner]
    right = [3 * (widths[k] * rises[k - 1] + widths[k - 1] * rises[k]) for k in inner]
    ends: list[dict[int, Fraction]] = [{0: Fraction(1)}, {len(widths): Fraction(1)}]
    return solve_rates([ends[0], *rows, ends[1]], [Fraction(0), *right, Fraction(0)])


def _periodic_rates(widths: Sequence[Fraction], rises: Sequence[Fraction]) -> list[Fraction]:
    """The rates at all knots where the last is the first."""
    count = len(widths)
    rows, right = list[dict[int, Fraction]](), list[Fraction]()
    for k in range(count):
        row: dict[int, Fraction] = {}
        for at, value in ((k - 1, widths[k]), (k, 2 * (widths[k - 1] + widths[k])), (k + 1, widths[k - 1])):
            row[at % count] = row.get(at % count, Fraction(0)) + value
        rows.append(row)
        right.append(3 * (widths[k] * rises[k - 1] + widths[k - 1] * rises[k]))
    rates = solve_rates(rows, right)
    return [*rates, rates[0]]


def solve_rates(rows: Sequence[dict[int, Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
    """The solution of a diagonally dominant system, which has one."""
    return Elimination(rows, len(rows)).solve(right) or []


def whole_stage(*powers: int, waves: Sequence[Wave] = ()) -> tuple[MotionPiece, ...]:
    """A law of one piece over the whole stage, from coefficients of powers and waves."""
    return (MotionPiece(Fraction(0), Fraction(1), tuple(map(Fraction, powers)), tuple(waves)),)


EIGHTH, STEEPEST = Fraction(1, 8), Fraction(128, 3)
MOTIONS: dict[str, tuple[MotionPiece, ...]] = {
    "dwell": whole_stage(0),
    "uniform": whole_stage(0, 1),
    "parabolic": integrate_parts([(Fraction(0), Fraction(4)), (HALF, Fraction(-4))], 2),
    "harmonic": (MotionPiece(Fraction(0), Fraction(1), (HALF,), (Wave(-0.5, 1, 1),)),),
    "sine": whole_stage(0, 1, waves=(Wave(-0.5 / math.pi, 2),)),
    "trapezoid": integrate_parts([(Fraction(0), STEEPEST), (EIGHTH, Fraction(0)), (3 * EIGHTH, -STEEPEST),
                                  (5 * EIGHTH, Fraction(0)), (7 * EIGHTH, STEEPEST)], 3),
    "3-4-5": whole_stage(0, 0, 0, 10, -15, 6),
}
DWELL, TABLE = "dwell", "table"


# ---- the law of one turn --------------------------------------------------------------------------------------------


Array = Any

HARD, SOFT = 1, 2  # the orders of the derivatives that jump
# of a piece in which the largest value is searched, then so often again
SCAN_PARTS, REFINED_PARTS, SCAN_ROUNDS = 90, 16, 9


@dataclass(frozen=True)
class LawStage:
    """A part of the turn: over so many degrees the lift changes by `stroke` in a motion of this name.

    Its pieces are lifts over the part of the stage that is behind.
    """

    angle: Fraction
    stroke: Fraction
    motion: str
    pieces: tuple[MotionPiece, ...]


@dataclass(frozen=True)
class LawPiece:
    """One smooth piece of the law, from one angle to another, in degrees."""

    start: Fraction
    end: Fraction
    stage: LawStage
    begins: Fraction  # the angle at which its stage begins
    lift: Fraction  # the lift there
    piece: MotionPiece

    def value_at(self, angle: Any, order: int = 0) -> Any:
        """The lift, or its derivative by the angle in radians, which may be an array of degrees."""
        share = (angle - float(self.begins)) / float(self.stage.angle)
        value = self.piece.value_at(share, order)
        return value + float(self.lift) if order == 0 else value / math.radians(self.stage.angle) ** order

    def divide(self, parts: int) -> Array:
        """Angles that divide the piece into equal parts, both ends included."""
        return np.linspace(float(self.start), float(self.end), parts + 1)


Value = Callable[[Array, LawPiece], Array]


@dataclass(frozen=True)
class Jump:
    """Jump of a derivative of the law: its angle, its order, and the values before and after."""

    angle: Fraction
    order: int
    before: float
    after: float


@dataclass(frozen=True)
class Law:
    """The stages of one turn; `times` turns lifts into the lengths or radians that are reckoned with."""

    stages: tuple[LawStage, ...]
    times: float = 1.0

    @cached_property
    def stretches(self) -> tuple[LawPiece, ...]:
        """The smooth pieces in order."""
        pieces, angle, lift = list[LawPiece](), Fraction(0), Fraction(0)
        for stage in self.stages:
            pieces += [LawPiece(angle + stage.angle * piece.start, angle + stage.angle * piece.end, stage, angle, lift,
                                piece) for piece in stage.pieces]
            angle, lift = angle + stage.angle, lift + stage.stroke
        return tuple(pieces)

    @property
    def lifts(self) -> tuple[Fraction, ...]:
        """The lift at the end of each stage."""
        return tuple(accumulate(stage.stroke for stage in self.stages))

    @property
    def bounds(self) -> tuple[Fraction, ...]:
        """The angles at which stages begin, and the end of the last."""
        return tuple(accumulate((stage.angle for stage in self.stages), initial=Fraction(0)))

    def value_at(self, angles: Any, order: int = 0) -> Any:
        """The lift or a derivative at angles in degrees, an array; where two pieces meet, of the one that begins."""
        turned = np.asarray(angles, float) % 360.0
        starts = np.array([float(one.start) for one in self.stretches])
        which = np.maximum(np.searchsorted(starts, turned, "right") - 1, 0)
        values = np.empty_like(turned)
        for k, stretch in enumerate(self.stretches):
            is_in_piece = which == k
            if is_in_piece.any():
                values[is_in_piece] = stretch.value_at(turned[is_in_piece], order)
        return self.times * values

    @property
    def turn_and_rest(self) -> tuple[Fraction, Fraction]:
        """Sum of the stages' angles in degrees, and the lift after them."""
        return self.bounds[-1], self.lifts[-1]

    @cached_property
    def jumps(self) -> tuple[Jump, ...]:
        """The hard and soft shocks in the order of the turn."""
        scale = [max(self.largest(order), MIN_SIZE) for order in range(ORDERS)]
        return tuple(jump for jump in self._joints() if abs(jump.after - jump.before) > JUMP_TOL * scale[jump.order])

    def largest(self, order: int) -> float:
        """About how large the derivative of an order is where it is largest."""
        maxima = (abs(stretch.value_at(stretch.divide(8), order)).max() for stretch in self.stretches)
        return self.times * max(map(float, maxima))

    def _joints(self) -> Iterator[Jump]:
        """Yield each derivative's jump between pieces; at a jump of the velocity the acceleration is undefined."""
        for before, after in pairwise((self.stretches[-1], *self.stretches)):
            for order in (HARD, SOFT):
                values = before.value_at(float(before.end), order), after.value_at(float(after.start), order)
                yield Jump(after.start, order, *(self.times * float(value) for value in values))

    def extremum(self, value: Value, rounds: int = SCAN_ROUNDS) -> tuple[float, float]:
        """The angle and the size of the largest value over the turn of a function of (angles, stretch).

        The function reads an array of degrees and the piece that they lie on. Each piece is divided, then the parts
        beside the best place so many times again.
        """
        extrema = (highest_on(lambda angles, one=one: value(angles, one), one, rounds)  # type: ignore[misc]
                   for one in self.stretches)
        return max(extrema, key=lambda pair: pair[1])


def highest_on(value: Callable[[Array], Array], one: LawPiece, rounds: int) -> tuple[float, float]:
    """The place and size of the largest value of a function on a piece."""
    low, high, count, best = float(one.start), float(one.end), SCAN_PARTS, (math.nan, -math.inf)
    for _ in range(rounds + 1):
        angles = np.linspace(low, high, count + 1)
        values = np.nan_to_num(np.asarray(value(angles), float), nan=-math.inf)
        k = int(np.argmax(values))
        best = max(best, (float(angles[k]), float(values[k])), key=lambda pair: pair[1])
        low, high, count = float(angles[max(k - 1, 0)]), float(angles[min(k + 1, count)]), REFINED_PARTS
    return best
