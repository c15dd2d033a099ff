"""Linear systems solved in floats with a proven bound for each unknown (S. M. Rump, Acta Numerica 19 (2010), 10.).

With an approximate inverse R of a matrix A, the error of an approximate solution x is at most e, by components, if
|R (b - A x)| + |I - R A| e is less than e everywhere; and then A has an inverse, which proves the pose to be regular.
Every rounding, of the coefficients and of the proof itself, is in the bounds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphplan.solver.bounded import ROUNDING, Bounded, Unproven, bounded

Array = NDArray[np.float64]

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
