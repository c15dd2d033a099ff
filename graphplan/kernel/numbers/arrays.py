"""numpy arrays of shape (n,): n poses at once; a pose that cannot be drawn becomes nan and says why."""

from __future__ import annotations

from typing import Any

import numpy as np

from graphplan.kernel.numbers import Domain
from graphplan.kernel.tolerances import ROUNDOFF_TOL


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
