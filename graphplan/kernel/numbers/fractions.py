"""Exact fractions: straightedge constructions are closed in them, compasses only where the root comes out."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.numbers import Domain


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
