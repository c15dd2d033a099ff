"""Python floats: one pose, rounding at 2**-53."""

from __future__ import annotations

import math

from graphplan.errors import Undrawable
from graphplan.kernel.numbers import Domain
from graphplan.kernel.tolerances import ROUNDOFF_TOL

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
