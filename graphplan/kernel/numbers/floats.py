"""Python floats: one pose, rounding at 2**-53."""

from __future__ import annotations

import math

from graphplan.errors import Undrawable
from graphplan.kernel.numbers import Domain

# A difference of two products is noise when it is within a few roundings of them.
ZERO = 2.0**-50


class Floats(Domain):
    """One pose in double precision; what cannot be drawn raises."""

    def sqrt(self, value: float, code: str, why: str) -> float:
        if value < 0:
            raise Undrawable(code, why)
        return math.sqrt(value)

    def nonzero(self, value: float, scale: float, code: str, why: str) -> float:
        if abs(value) <= ZERO * scale or not math.isfinite(value):
            raise Undrawable(code, why)
        return value

    def sign(self, value: float, scale: float) -> float:
        return 0.0 if abs(value) <= ZERO * scale else math.copysign(1.0, value)
