"""Number domains: what a rule may ask of its numbers beyond + - * / and abs.

A domain lifts scene numbers, takes square roots and decides what is zero. Rules are written once and serve floats,
arrays of poses and exact fractions alike.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from fractions import Fraction
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.tolerances import ROUNDOFF_TOL


class Domain(ABC):
    """The questions that a rule may ask, and one that is asked of its answer."""

    def lift(self, value: Any) -> Any:
        """The scene's number in this domain."""
        return float(value)

    @abstractmethod
    def sqrt(self, value: Any, code: str, why: str) -> Any:
        """The square root, or the failure `code` where `value` is negative."""

    @abstractmethod
    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        """`value`, or the failure `code` where it is zero beside `scale`, the size of what it was made from."""

    @abstractmethod
    def sign(self, value: Any, scale: Any) -> Any:
        """1, -1, or 0 where `value` is zero beside `scale`: the sense of a motion, and whether there is one."""

    rounds = 8  # of Newton's method, where a rule has to ask for it: each leaves some fifteen digits more

    def middle(self, value: Any) -> Any:
        """A number that Newton's method may go on from, without what is not known of it."""
        return value

    def mask_refused(self, value: Any) -> Any:
        """The result of a rule, with nan in poses that it refused."""
        return value


# ---- exact -----------------------------------------------------------------------------------------------------------


class Fractions(Domain):
    """One pose, exactly; an irrational root raises `not-rational`."""

    def lift(self, value: Any) -> Fraction:
        if isinstance(value, float):
            raise Undrawable("not-rational", f"{value!r} is not known exactly")
        return Fraction(value)

    def sqrt(self, value: Fraction, code: str, why: str) -> Fraction:
        if value < 0:
            raise Undrawable(code, why)
        over, under = math.isqrt(value.numerator), math.isqrt(value.denominator)
        if over * over != value.numerator or under * under != value.denominator:
            raise Undrawable("not-rational", f"the root of {value} is irrational")
        return Fraction(over, under)

    def nonzero(self, value: Fraction, scale: Fraction, code: str, why: str) -> Fraction:
        if value == 0:
            raise Undrawable(code, why)
        return value

    def sign(self, value: Fraction, scale: Fraction) -> int:
        return (value > 0) - (value < 0)


# A difference of two products is noise when it is within a few roundings of them.


class Floats(Domain):
    """One pose in double precision; what cannot be drawn raises."""

    def sqrt(self, value: float, code: str, why: str) -> float:
        if value < 0:
            raise Undrawable(code, why)
        return math.sqrt(value)

    def nonzero(self, value: float, scale: float, code: str, why: str) -> float:
        if abs(value) <= ROUNDOFF_TOL * scale or not math.isfinite(value):
            raise Undrawable(code, why)
        return value

    def sign(self, value: float, scale: float) -> float:
        return 0.0 if abs(value) <= ROUNDOFF_TOL * scale else math.copysign(1.0, value)
