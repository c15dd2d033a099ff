"""Linear systems of few unknowns solved in floats, with the bound of each that `proven` proves of one block.

It is done in plain Python: for a usual linkage numpy takes longer to load than all the rest does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from operator import mul
from typing import Any

from graphplan.solver.bounds import Bounded, Unproven, bounded_number
from graphplan.solver.tolerances import MAX_WIDENINGS, MIN_BOUND, ROUNDOFF, WIDENING

Vector = Sequence[float]
Matrix = Sequence[Vector]

MAX_UNKNOWNS = 24  # of some eight links: more take longer than a millisecond


class SmallSystem:
    """A square system of few unknowns, made ready for any right-hand sides; `scales` make its unknowns comparable.

    What is solved proves that the matrix has an inverse.
    """

    def __init__(self, rows: Sequence[Mapping[int, Any]], scales: Vector):
        if len(rows) != len(scales):
            raise Unproven("the system is not square")
        places, none = range(len(scales)), Bounded(0.0)
        entries = [[bounded_number(row[j]) if j in row else none for j in places] for row in rows]
        self._scales = [*map(float, scales)]
        self._matrix = [[number.value for number in row] for row in entries]
        self._off = [[number.error for number in row] for row in entries]
        self._sizes = [[abs(number.value) + number.error for number in row] for row in entries]
        self._slack = [_rounding(sum(map(bool, row))) for row in self._matrix]
        self._inverse = _inverse(self._matrix)
        self._far = [[*map(abs, row)] for row in self._inverse]
        self._miss = self._errors_of_inverse()

    def _errors_of_inverse(self) -> Matrix:
        """|I - R A| at most, by entries."""
        by_columns: list[list[float]] = []
        for j, column in enumerate(zip(*self._matrix, strict=True)):
            rounding = _rounding(sum(map(bool, column)))
            doubt = [rounding * size[j] + off[j] for size, off in zip(self._sizes, self._off, strict=True)]
            by_columns.append([abs((i == j) - _dot(row, column)) + rounding * (i == j) + _dot(far, doubt)
                               for i, (row, far) in enumerate(zip(self._inverse, self._far, strict=True))])
        return [*zip(*by_columns, strict=True)]

    def solve(self, right: Sequence[Any]) -> list[Bounded]:
        """The unknowns; fails with `Unproven` where no bound holds."""
        sides = [*map(bounded_number, right)]
        targets = [side.value for side in sides]
        values = _product(self._inverse, targets)
        for _ in range(2):  # wins the last digits back
            correction = _product(self._inverse, self._remainders(targets, values))
            values = [value + more for value, more in zip(values, correction, strict=True)]
        lengths = [*map(abs, values)]
        absolute_terms = _product(self._sizes, lengths)
        residual = [abs(remainder) + slack * (terms + abs(side.value)) + doubt + side.error
                    for remainder, slack, terms, doubt, side in zip(
                        self._remainders(targets, values), self._slack, absolute_terms, _product(self._off, lengths),
                        sides, strict=True)]
        errors = self._errors(residual)
        terms = _product(self._far, [term + side.size for term, side in zip(absolute_terms, sides, strict=True)])
        return [*map(Bounded, values, errors, self._cancelling_sizes(lengths, terms))]

    def _remainders(self, targets: Vector, values: Vector) -> list[float]:
        return [target - _dot(row, values) for target, row in zip(targets, self._matrix, strict=True)]

    def _errors(self, residual: Vector) -> list[float]:
        """How far each unknown is off at most."""
        up = 1 + _rounding(2 * len(residual))  # of the sums that make a bound
        least = [up * error + MIN_BOUND for error in _product(self._far, residual)]
        errors = least
        for _ in range(MAX_WIDENINGS):
            wider = [WIDENING * error for error in errors]
            errors = [bound + up * more for bound, more in zip(least, _product(self._miss, wider), strict=True)]
            if all(error < bound for error, bound in zip(errors, wider, strict=True)):
                return wider
        raise Unproven("the system is too near to a singular one for floats")

    def _cancelling_sizes(self, lengths: Vector, terms: Vector) -> Iterable[float]:
        """The size of what cancels in each unknown: its share of all terms, of which the unknowns are what is left."""
        whole, left = (max(map(mul, part, self._scales), default=0.0) for part in (terms, lengths))
        share = min(left / whole, 1.0) if whole else 0.0
        return (max(length, share * term) for length, term in zip(lengths, terms, strict=True))


def _inverse(matrix: Matrix) -> Matrix:
    """An approximate inverse, by elimination with the largest of each column (Gauss and Jordan)."""
    width = len(matrix)
    rows = [[*row, *(float(i == j) for j in range(width))] for i, row in enumerate(matrix)]
    for k in range(width):
        largest = max(range(k, width), key=lambda i: abs(rows[i][k]))
        if not rows[largest][k]:
            raise Unproven("the matrix has no inverse in floats")
        rows[k], rows[largest] = rows[largest], rows[k]
        pivot = rows[k][k]
        leading = rows[k] = [value / pivot for value in rows[k]]
        for i, row in enumerate(rows):
            if i != k and (factor := row[k]):
                rows[i] = [value - factor * lead for value, lead in zip(row, leading, strict=True)]
    return [row[width:] for row in rows]


def _dot(one: Vector, other: Vector) -> float:
    return float(sum(map(mul, one, other)))


def _product(matrix: Matrix, vector: Vector) -> list[float]:
    return [_dot(row, vector) for row in matrix]


def _rounding(terms: int) -> float:
    """The relative error that a sum of so many products, and what is done with it, has at most."""
    return 1.01 * ROUNDOFF * (terms + 4.0)
