"""Floats that know how far they may be off.

A number has a value, a bound of its error, and the size of what cancels in it. Each operation adds its own rounding to
what it is given (running error analysis), so whatever is reckoned with these numbers is proven, and needs nothing but
floats. Numbers that scenes may hold are within 10^±60: nothing underflows.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from graphplan.mechanism.numbers import heading as exact_heading
from graphplan.solver.tolerances import MARGIN, ROUNDOFF


class Unproven(ArithmeticError):
    """Raised where floats prove nothing: such as of a divisor that may be zero, or of a matrix without an inverse."""


class Bounded:
    """A float with the bound of its error; `size` is the size of the terms that it is made of, and its own at least."""

    __slots__ = ("error", "size", "value")

    def __init__(self, value: float, error: float = 0.0, size: float = 0.0):
        self.value, self.error, self.size = value, error, size or abs(value)

    def __repr__(self) -> str:
        return f"{self.value!r} ± {self.error:.2g}"

    def __float__(self) -> float:
        return self.value

    def __neg__(self) -> Bounded:
        return Bounded(-self.value, self.error, self.size)

    def __abs__(self) -> Bounded:
        return Bounded(abs(self.value), self.error, self.size)

    def __add__(self, other: Any) -> Bounded:
        two = other if type(other) is Bounded else bounded_number(other)
        if not two.size:
            return self
        value = self.value + two.value
        return Bounded(value, MARGIN * (self.error + two.error + ROUNDOFF * abs(value)), self.size + two.size)

    def __sub__(self, other: Any) -> Bounded:
        return self + -bounded_number(other)

    def __rsub__(self, other: Any) -> Bounded:
        return bounded_number(other) + -self

    def __mul__(self, other: Any) -> Bounded:
        two = other if type(other) is Bounded else bounded_number(other)
        if two.value in (0.0, 1.0, -1.0) and not two.error:
            return Bounded(self.value * two.value, self.error * abs(two.value), self.size * abs(two.value))
        value, a, b = self.value * two.value, abs(self.value), abs(two.value)
        error = a * two.error + b * self.error + self.error * two.error + ROUNDOFF * abs(value)
        return Bounded(value, MARGIN * error, max(a * two.size, b * self.size))

    def __truediv__(self, other: Any) -> Bounded:
        two = other if type(other) is Bounded else bounded_number(other)
        least = abs(two.value) - two.error
        if not least > 0:
            raise Unproven("a divisor may be zero")
        value = self.value / two.value
        error = (self.error + abs(value) * two.error) / least + ROUNDOFF * abs(value)
        return Bounded(value, MARGIN * error, max(self.size, abs(value) * two.size) / abs(two.value))

    def __rtruediv__(self, other: Any) -> Bounded:
        return bounded_number(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __pow__(self, power: int) -> Bounded:
        return math.prod([self] * (power - 1), start=self)

    def __eq__(self, other: object) -> bool:
        """Whether the two are known to be one number."""
        two = bounded_number(other)
        return self.value == two.value and not (self.error or two.error)

    def __bool__(self) -> bool:
        """Whether it is not known to be zero."""
        return bool(self.value or self.error)

    def __ge__(self, other: Any) -> bool:
        """Whether it may be so."""
        two = bounded_number(other)
        return self.value + self.error >= two.value - two.error

    def __lt__(self, other: Any) -> bool:
        return not self >= other

    def __hash__(self) -> int:
        return hash((self.value, self.error))

    @property
    def root(self) -> Bounded:
        """The square root of a number that is known not to be negative."""
        if self.value <= self.error:
            most = math.sqrt(max(self.value, 0.0) + self.error) * MARGIN
            return Bounded(most / 2, most / 2, most)
        value = math.sqrt(self.value)
        return Bounded(value, MARGIN * (self.error / value + ROUNDOFF * value), max(value, self.size / (2 * value)))

    def overlaps(self, other: Bounded) -> bool:
        """Whether the two may be one number."""
        return abs(self.value - other.value) <= MARGIN * (self.error + other.error)


def bounded_number(number: Any) -> Bounded:
    """A whole number or fraction, rounded to a float, or a float as the binary fraction that it is."""
    if type(number) is Bounded:
        return number
    if not isinstance(number, Fraction):
        return Bounded(float(number))
    whole = number.as_integer_ratio()
    value = whole[0] / whole[1]
    return Bounded(value) if value.as_integer_ratio() == whole else Bounded(value, MARGIN * ROUNDOFF * abs(value))


PI = Bounded(math.pi, 2.0**-52)


def heading(degrees: Fraction) -> tuple[Bounded, Bounded]:
    """Cosine and sine of an angle in degrees: each is within four roundings of one."""
    return tuple(Bounded(float(coordinate), 4 * ROUNDOFF) for coordinate in exact_heading(degrees)[:2])  # type: ignore[return-value]
