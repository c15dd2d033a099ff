"""Enclosures: real numbers between proven bounds, as sharp as the working precision makes them.

An enclosure is a ball of the flint library, a middle and a radius that holds the number for certain, roots and angles
among them. It reckons with whole numbers, fractions and floats (each the binary fraction that it is). What a ball
cannot decide is not guessed: it is undecided, until the same is reckoned with more bits.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat, ctx, fmpq

from graphplan.errors import Undrawable
from graphplan.kernel.numbers import Domain


class Undecided(Exception):
    """Raised where a choice hangs on two numbers that the working precision cannot tell apart."""


@contextmanager
def precision(bits: int) -> Iterator[None]:
    """Within this context every enclosure is reckoned with so many bits."""
    before, ctx.prec = ctx.prec, bits
    try:
        yield
    finally:
        ctx.prec = before


def ball(value: Any) -> arb:
    """A whole number, fraction, float or enclosure as a ball of the working precision."""
    if type(value) is Enclosure:
        return value.ball
    if type(value) is arb:
        return value
    if isinstance(value, Fraction):
        return arb(fmpq(value.numerator, value.denominator))
    return arb(value)


class Enclosure:
    """A number between proven bounds.

    Two are equal where they are known to be one number: the same ball of the same reckoning. Which of two that overlap
    is larger is `Undecided`.
    """

    __slots__ = ("ball",)

    def __init__(self, value: Any) -> None:
        self.ball = value if type(value) is arb else ball(value)

    def __repr__(self) -> str:
        return str(self.ball)

    def __float__(self) -> float:
        return float(self.ball)

    def __hash__(self) -> int:
        return hash(float(self.ball))

    def __abs__(self) -> Enclosure:
        return Enclosure(abs(self.ball))

    def __neg__(self) -> Enclosure:
        return Enclosure(-self.ball)

    def __add__(self, other: Any) -> Enclosure:
        return Enclosure(self.ball + (other.ball if type(other) is Enclosure else ball(other)))

    def __sub__(self, other: Any) -> Enclosure:
        return Enclosure(self.ball - (other.ball if type(other) is Enclosure else ball(other)))

    def __rsub__(self, other: Any) -> Enclosure:
        return Enclosure(ball(other) - self.ball)

    def __mul__(self, other: Any) -> Enclosure:
        return Enclosure(self.ball * (other.ball if type(other) is Enclosure else ball(other)))

    def __truediv__(self, other: Any) -> Enclosure:
        if other is self and not self.ball.contains(0):
            return Enclosure(1)
        return Enclosure(self.ball / ball(other))

    def __rtruediv__(self, other: Any) -> Enclosure:
        return Enclosure(ball(other) / self.ball)

    __radd__, __rmul__ = __add__, __mul__

    def __pow__(self, power: int) -> Enclosure:
        return Enclosure(self.ball**power)

    def __bool__(self) -> bool:
        return self != 0

    def __eq__(self, other: object) -> bool:
        one, two = self.ball, ball(other)
        return bool(one.mid() == two.mid() and one.rad() == two.rad())

    def __lt__(self, other: Any) -> bool:
        return self._decide(self.ball < ball(other), not self.ball >= ball(other))

    def __gt__(self, other: Any) -> bool:
        return self._decide(self.ball > ball(other), not self.ball <= ball(other))

    def __le__(self, other: Any) -> bool:
        return not self > other

    def __ge__(self, other: Any) -> bool:
        return not self < other

    def _decide(self, certain: bool, possible: bool) -> bool:
        """Decide a comparison; fails with `Undecided` if it is possible but not certain."""
        if possible and not certain:
            raise Undecided("two numbers cannot be told apart")
        return certain

    @property
    def root(self) -> Enclosure:
        """The square root of a number that is known not to be negative, such as a sum of squares."""
        if not self.ball.contains(0):
            return Enclosure(self.ball.sqrt())
        half = self.ball.abs_upper().sqrt().upper() / 2
        return Enclosure(half + half * arb(0, 1))

    @property
    def error(self) -> Fraction:
        """Radius of the number's ball."""
        return _exactly(self.ball.rad())

    @property
    def middle(self) -> Fraction:
        """The middle of its ball."""
        return _exactly(self.ball.mid())

    def overlaps(self, other: Enclosure) -> bool:
        """Whether the two may be one number."""
        return bool(self.ball.overlaps(other.ball))


def heading(degrees: Fraction) -> tuple[Enclosure, Enclosure]:
    """Cosine and sine of an angle in degrees."""
    sine, cosine = arb.sin_cos_pi_fmpq(fmpq(degrees.numerator, 180 * degrees.denominator))
    return Enclosure(cosine), Enclosure(sine)


def pi() -> Enclosure:
    """The ratio of a circle's circumference to its diameter."""
    return Enclosure(arb.pi())


def solve(rows: Sequence[Mapping[int, Any]]) -> Callable[[Sequence[Any]], list[Enclosure]]:
    """Return a function that solves a square system for a right-hand side; `Undecided` if it may be singular."""
    size, zero = len(rows), arb(0)
    entries = [{column: ball(value) for column, value in row.items()} for row in rows]
    matrix = arb_mat(size, size, [row.get(column, zero) for row in entries for column in range(size)])

    def solution_for(right: Sequence[Any], *_: Any) -> list[Enclosure]:
        try:
            solution = matrix.solve(arb_mat(size, 1, [ball(value) for value in right]))
        except ZeroDivisionError:
            raise Undecided("whether the equations have one solution cannot be told") from None
        return [Enclosure(solution[row, 0]) for row in range(size)]

    return solution_for


def _exactly(point: arb) -> Fraction:
    """A ball without radius as the binary fraction that it is."""
    if not point.is_finite():
        raise Undecided("a number has no bounds yet")
    whole, exponent = map(int, point.man_exp())
    return Fraction(whole << exponent) if exponent > 0 else Fraction(whole, 1 << -exponent)


class Enclosures(Domain):
    """One pose between proven bounds. What is zero or negative as far as the bits tell raises; `undecided` says which
    failure more bits may take back."""

    def __init__(self) -> None:
        self.undecided = False

    def lift(self, value: Any) -> Enclosure:
        return Enclosure(value)

    def sqrt(self, value: Enclosure, code: str, why: str) -> Enclosure:
        if code != "not-rational" and not value.ball >= 0:  # a root that can but be irrational is of squares
            raise self._undrawable(not value.ball < 0, code, why)
        return value.root

    def nonzero(self, value: Enclosure, scale: Any, code: str, why: str) -> Enclosure:
        if value.ball.contains(0):
            raise self._undrawable(not value.ball.is_zero(), code, why)
        return value

    def sign(self, value: Enclosure, scale: Any) -> Enclosure:
        if value.ball.contains(0) and not value.ball.is_zero():
            return Enclosure(arb(0, 1))  # either sense, or none
        return Enclosure((value.ball > 0) - (value.ball < 0))

    @property
    def rounds(self) -> int:  # type: ignore[override]
        return 4 + int(ctx.prec) // 32

    def middle(self, value: Enclosure) -> Enclosure:
        return Enclosure(value.ball.mid())

    def _undrawable(self, undecided: bool, code: str, why: str) -> Undrawable:
        self.undecided = undecided
        return Undrawable(code, why)
