"""Python floats: one pose, rounding at 2**-53."""

from __future__ import annotations

import math
from typing import Any

from graphplan.errors import Undrawable

# A difference of two products is noise when it is within a few roundings of them.
ZERO = 2.0**-50


class Floats:
    """One pose in double precision; what cannot be drawn raises."""

    name = "float"

    def lift(self, value: Any) -> float:
        return float(value)

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

    def whole(self, value: Any) -> Any:
        return value
