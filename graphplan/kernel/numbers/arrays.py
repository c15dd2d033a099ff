"""numpy arrays of shape (n,): n poses at once; a pose that cannot be drawn becomes nan and says why. And where
functions of numbers change.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from graphplan.kernel.numbers import Domain
from graphplan.kernel.tolerances import ROUNDOFF_TOL

Reals = npt.NDArray[np.float64]
BISECTIONS = 60  # of an interval with a root: to the last digit


class Arrays(Domain):
    """n poses in double precision. `faults` collects, for each failure, its code, reason and the mask of poses."""

    def __init__(self) -> None:
        self.faults: list[tuple[str, str, Any]] = []
        self._bad: Any = None

    def lift(self, value: Any) -> Any:
        return np.asarray(value, dtype=float)

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        return np.sqrt(self._mask(value, np.less(value, 0), code, why))

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        return self._mask(value, np.abs(value) <= ROUNDOFF_TOL * scale, code, why)

    def _mask(self, value: Any, bad: Any, code: str, why: str) -> Any:
        if not np.any(bad):
            return value
        self.faults.append((code, why, bad))
        self._bad = bad if self._bad is None else self._bad | bad
        return np.where(bad, np.nan, value)

    def sign(self, value: Any, scale: Any) -> Any:
        return np.where(np.abs(value) <= ROUNDOFF_TOL * scale, 0.0, np.sign(value))

    def mask_refused(self, value: Any) -> Any:
        bad, self._bad = self._bad, None
        return value if bad is None else tuple(np.where(bad, np.nan, number) for number in value)


def distinct_values(values: npt.ArrayLike) -> npt.NDArray[Any]:
    """The values, each once, in ascending order, shape (n,). `numpy.unique` would load masked arrays, which takes about
    as long as to load numpy itself."""
    ordered = np.sort(values, axis=None)
    return ordered[np.append(True, ordered[1:] != ordered[:-1])] if len(ordered) else ordered


def bisect(is_before: Callable[[Reals], npt.NDArray[np.bool_] | bool], low: Reals | float, high: Reals | float,
           rounds: int = BISECTIONS) -> tuple[Reals, Reals]:
    """The ends of intervals, shape (n,) or a number each, halved to the last digit or so many times; `is_before` tells
    of places whether what is sought lies beyond them."""
    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    for _ in range(rounds):
        middle: Reals = (low + high) / 2
        before = is_before(middle)
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return low, high


def sign_change(function: Callable[[float], float], low: float, high: float) -> float:
    """Find where a function changes its sign between two numbers."""
    sign = function(low) > 0
    low_end, high_end = bisect(lambda place: (function(float(place)) > 0) == sign, low, high)
    return float((low_end + high_end) / 2)
