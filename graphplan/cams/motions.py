"""Motions: how a follower gets from rest to rest, as a function of the part of the stage that is behind it.

Each is a lift f(t) from f(0) = 0 to f(1) = 1 in closed form, with its derivatives: powers of t with fractions as
coefficients, so that a fraction goes in and a fraction comes out, or waves.

Sources: Ozols 1974, 20-2, fig. 20-4 (uniform, parabolic, sine, trapezoid); harmonic and 3-4-5 as they are usual.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.mechanism.equations import Elimination

ORDERS = 4  # lift, velocity, acceleration and jerk
HALF = Fraction(1, 2)


@dataclass(frozen=True)
class Wave:
    """amplitude sin(pi (frequency t + quarters/2)): `frequency` in half turns."""

    amplitude: float
    frequency: int
    quarters: int = 0

    def at(self, t: Any) -> Any:
        """Its value, in floats."""
        return self.amplitude * np.sin(math.pi * (self.frequency * t + self.quarters / 2))

    @property
    def derivative(self) -> Wave:
        return replace(self, amplitude=self.amplitude * math.pi * self.frequency, quarters=self.quarters + 1)


@dataclass(frozen=True)
class Piece:
    """A motion from one part of its stage to another: the sum of powers of t, the constant first, and of waves."""

    start: Fraction
    end: Fraction
    powers: tuple[Fraction, ...]
    waves: tuple[Wave, ...] = ()

    def at(self, t: Any, order: int = 0) -> Any:
        """The lift, or its derivative of an order, at t: a float, an array, or a fraction where there are no waves."""
        piece = self
        for _ in range(order):
            piece = piece._derivative
        exact = isinstance(t, Fraction)
        found: Any = 0 * t
        for power in reversed(piece.powers):
            found = found * t + (power if exact else float(power))
        return sum((wave.at(t) for wave in piece.waves), found)

    def times(self, factor: Fraction) -> Piece:
        """The same motion so many times as large."""
        waves = tuple(replace(wave, amplitude=float(factor) * wave.amplitude) for wave in self.waves)
        return replace(self, powers=tuple(factor * power for power in self.powers), waves=waves)

    @property
    def _derivative(self) -> Piece:
        powers = tuple(k * power for k, power in enumerate(self.powers))[1:]
        return replace(self, powers=powers, waves=tuple(wave.derivative for wave in self.waves))


def integrated(parts: Sequence[tuple[Fraction, Fraction]], order: int) -> tuple[Piece, ...]:
    """The motion from rest at 0 of which the derivative of an order is constant in parts: (where it begins, value)."""
    found, state = list[Piece](), (Fraction(0),) * order
    for (start, value), (end, _) in pairwise((*parts, (Fraction(1), Fraction(0)))):
        derivatives = (*state, value)
        taylor = [rate / math.factorial(k) for k, rate in enumerate(derivatives)]
        piece = Piece(start, end, _shifted(taylor, start))
        found.append(piece)
        state = tuple(piece.at(end, k) for k in range(order))
    return tuple(found)


def _shifted(powers: Sequence[Fraction], by: Fraction) -> tuple[Fraction, ...]:
    """The coefficients in t of a sum of powers of t - by."""
    found = [Fraction(0)] * len(powers)
    for n, power in enumerate(powers):
        for k in range(n + 1):
            found[k] += power * math.comb(n, k) * (-by) ** (n - k)
    return tuple(found)


def spline(knots: Sequence[Fraction], lifts: Sequence[Fraction], closed: bool) -> tuple[Piece, ...]:
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
        pieces.append(Piece(knots[k], knots[k + 1], _shifted(taylor, knots[k])))
    return tuple(pieces)


def _clamped_rates(widths: Sequence[Fraction], rises: Sequence[Fraction]) -> list[Fraction]:
    """The rates at all knots where those at the ends are 0."""
    inner = range(1, len(widths))
    rows = [{k - 1: widths[k], k: 2 * (widths[k - 1] + widths[k]), k + 1: widths[k - 1]} for k in inner]
    right = [3 * (widths[k] * rises[k - 1] + widths[k - 1] * rises[k]) for k in inner]
    ends: list[dict[int, Fraction]] = [{0: Fraction(1)}, {len(widths): Fraction(1)}]
    return _solved([ends[0], *rows, ends[1]], [Fraction(0), *right, Fraction(0)])


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
    rates = _solved(rows, right)
    return [*rates, rates[0]]


def _solved(rows: Sequence[dict[int, Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
    """The solution of a diagonally dominant system, which has one."""
    return Elimination(rows, len(rows)).solve(right) or []


def _whole(*powers: int, waves: Sequence[Wave] = ()) -> tuple[Piece, ...]:
    """One piece over the whole stage."""
    return (Piece(Fraction(0), Fraction(1), tuple(map(Fraction, powers)), tuple(waves)),)


EIGHTH, STEEPEST = Fraction(1, 8), Fraction(128, 3)
MOTIONS: dict[str, tuple[Piece, ...]] = {
    "dwell": _whole(0),
    "uniform": _whole(0, 1),
    "parabolic": integrated([(Fraction(0), Fraction(4)), (HALF, Fraction(-4))], 2),
    "harmonic": (Piece(Fraction(0), Fraction(1), (HALF,), (Wave(-0.5, 1, 1),)),),
    "sine": _whole(0, 1, waves=(Wave(-0.5 / math.pi, 2),)),
    "trapezoid": integrated([(Fraction(0), STEEPEST), (EIGHTH, Fraction(0)), (3 * EIGHTH, -STEEPEST),
                             (5 * EIGHTH, Fraction(0)), (7 * EIGHTH, STEEPEST)], 3),
    "3-4-5": _whole(0, 0, 0, 10, -15, 6),
}
DWELL, TABLE = "dwell", "table"
