"""Floats that know how far they may be off, and linear systems solved in them with a proven bound for each unknown.

A number has a value, a bound of its error, and the size of what cancels in it. Each operation adds its own rounding to
what it is given (running error analysis), so whatever is reckoned with these numbers is proven, and needs nothing but
floats. Numbers that scenes may hold are within 10^±60: nothing underflows.

With an approximate inverse R of a matrix A, the error of an approximate solution x is at most e, by components, if
|R (b - A x)| + |I - R A| e is less than e everywhere; and then A has an inverse, which proves the pose to be regular
(S. M. Rump, Acta Numerica 19 (2010), 10.). Every rounding, of the coefficients and of the proof itself, is in it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphplan.mechanism import numerals

Array = NDArray[np.float64]

ROUNDING = 2.0**-53  # of a result: half a unit in its last place
UP = 1 + 2.0**-50  # more than the roundings of a bound itself


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
        two = bounded(other)
        if not two.size:
            return self
        value = self.value + two.value
        return Bounded(value, UP * (self.error + two.error + ROUNDING * abs(value)), self.size + two.size)

    def __sub__(self, other: Any) -> Bounded:
        return self + -bounded(other)

    def __rsub__(self, other: Any) -> Bounded:
        return bounded(other) + -self

    def __mul__(self, other: Any) -> Bounded:
        two = bounded(other)
        if two.value in (0.0, 1.0, -1.0) and not two.error:
            return Bounded(self.value * two.value, self.error * abs(two.value), self.size * abs(two.value))
        value, a, b = self.value * two.value, abs(self.value), abs(two.value)
        error = a * two.error + b * self.error + self.error * two.error + ROUNDING * abs(value)
        return Bounded(value, UP * error, max(a * two.size, b * self.size))

    def __truediv__(self, other: Any) -> Bounded:
        two = bounded(other)
        least = abs(two.value) - two.error
        if not least > 0:
            raise Unproven("a divisor may be zero")
        value = self.value / two.value
        error = (self.error + abs(value) * two.error) / least + ROUNDING * abs(value)
        return Bounded(value, UP * error, max(self.size, abs(value) * two.size) / abs(two.value))

    def __rtruediv__(self, other: Any) -> Bounded:
        return bounded(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __pow__(self, power: int) -> Bounded:
        return math.prod([self] * (power - 1), start=self)

    def __eq__(self, other: object) -> bool:
        """Whether the two are known to be one number."""
        two = bounded(other)
        return self.value == two.value and not (self.error or two.error)

    def __ge__(self, other: Any) -> bool:
        """Whether it may be so."""
        two = bounded(other)
        return self.value + self.error >= two.value - two.error

    def __lt__(self, other: Any) -> bool:
        return not self >= other

    def __hash__(self) -> int:
        return hash((self.value, self.error))

    @property
    def root(self) -> Bounded:
        """The square root of a number that is known not to be negative."""
        if self.value <= self.error:
            most = math.sqrt(max(self.value, 0.0) + self.error) * UP
            return Bounded(most / 2, most / 2, most)
        value = math.sqrt(self.value)
        return Bounded(value, UP * (self.error / value + ROUNDING * value), max(value, self.size / (2 * value)))

    def overlaps(self, other: Bounded) -> bool:
        """Whether the two may be one number."""
        return abs(self.value - other.value) <= UP * (self.error + other.error)


def bounded(number: Any) -> Bounded:
    """A whole number or fraction, rounded to a float, or a float as the binary fraction that it is."""
    if isinstance(number, Bounded):
        return number
    value = float(number)
    if isinstance(number, Fraction) and value.as_integer_ratio() != (number.numerator, number.denominator):
        return Bounded(value, UP * ROUNDING * abs(value))
    return Bounded(value)


PI = Bounded(math.pi, 2.0**-52)


def heading(degrees: Fraction) -> tuple[Bounded, Bounded]:
    """Cosine and sine of an angle in degrees: each is within four roundings of one."""
    return tuple(Bounded(float(part), 4 * ROUNDING) for part in numerals.heading(degrees)[:2])  # type: ignore[return-value]


ROUNDS = 12  # of widening the bound until it holds itself
WIDER = 1.125
LEAST = 1e-290  # a bound that a zero with nothing to round has: it holds a wider one strictly


class Proven:
    """A square system, made ready for any right-hand sides; `scales` make its unknowns comparable.

    What is solved proves that the matrix has an inverse.
    """

    def __init__(self, rows: Sequence[Mapping[int, Any]], scales: Sequence[float]):
        width = len(scales)
        if len(rows) != width:
            raise Unproven("the system is not square")
        self._scales = np.array(scales)
        self._matrix, self._off = np.zeros((width, width)), np.zeros((width, width))
        for i, row in enumerate(rows):
            for j, number in row.items():
                entry = bounded(number)
                self._matrix[i, j], self._off[i, j] = entry.value, entry.error
        try:
            self._inverse = np.linalg.inv(self._matrix) if width else self._matrix
        except np.linalg.LinAlgError:
            raise Unproven("the matrix has no inverse in floats") from None
        self._sizes, far = np.abs(self._matrix) + self._off, np.abs(self._inverse)
        self._slack = _roundings(np.count_nonzero(self._matrix, axis=1))  # of a row's sum of products, less a side
        columns = _roundings(np.count_nonzero(self._matrix, axis=0))
        gap = np.abs(np.eye(width) - self._inverse @ self._matrix)
        self._miss = gap + columns * (far @ self._sizes + np.eye(width)) + far @ self._off
        self._up = 1 + float(_roundings(np.array(2 * width)))  # of the sums that make a bound

    def solve(self, right: Sequence[Any]) -> list[Bounded]:
        """The unknowns; fails with `Unproven` where no bound holds."""
        sides = [bounded(number) for number in right]
        side, off, sizes = (np.array([getattr(number, part) for number in sides])
                            for part in ("value", "error", "size"))
        values = self._inverse @ side
        for _ in range(2):  # wins the last digits back
            values = values + self._inverse @ (side - self._matrix @ values)
        errors = self._errors(values, side, off)
        terms = np.abs(self._inverse) @ (self._sizes @ np.abs(values) + sizes)
        return [Bounded(float(x), float(e), float(s))
                for x, e, s in zip(values, errors, self._own(values, terms), strict=True)]

    def _errors(self, values: Array, side: Array, off: Array) -> Array:
        """How far each unknown is off at most."""
        rounded = self._slack * (self._sizes @ np.abs(values) + np.abs(side))
        residual = np.abs(side - self._matrix @ values) + rounded + self._off @ np.abs(values) + off
        least = self._up * (np.abs(self._inverse) @ residual) + LEAST
        errors: Array = least
        for _ in range(ROUNDS):
            wider = WIDER * errors
            errors = least + self._up * (self._miss @ wider)
            if np.all(errors < wider):
                return wider
        raise Unproven("the system is too near to a singular one for floats")

    def _own(self, values: Array, terms: Array) -> Array:
        """The size of what cancels in each unknown: its share of all terms, of which the unknowns are what is left.

        So what vanishes in a sound system counts beside what made it vanish, and a lost digit of a system near to a
        singular one, where all terms cancel, counts as lost.
        """
        whole, left = (float(np.max(part * self._scales, initial=0.0)) for part in (terms, np.abs(values)))
        return np.maximum(np.abs(values), terms * (left / whole if whole else 0.0))


def _roundings(terms: NDArray[Any]) -> Array:
    """The relative error that a sum of so many products, and what is done with it, has at most."""
    return 1.01 * ROUNDING * (terms + 4.0)
