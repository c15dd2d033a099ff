"""Echelon form in decimals: equations taken in one by one, and those found out that only repeat the ones before."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from decimal import Decimal
from typing import Generic, NamedTuple, TypeVar

K = TypeVar("K", bound=Hashable)

NOTHING = Decimal("1e-40")  # the coefficients are about 1, and good to twice as many digits and more


class _Row(NamedTuple, Generic[K]):
    """What is left of an equation, its pivot (None if nothing is left), and how often each row before it was taken."""

    terms: dict[K, Decimal]
    pivot: K | None
    taken: dict[int, Decimal]


class Echelon(Generic[K]):
    """Equations brought to echelon form in the order in which they come, to be solved for any right-hand side."""

    def __init__(self) -> None:
        self._rows: list[_Row[K]] = []

    @property
    def rank(self) -> int:
        """How many of the equations say something that those before them do not."""
        return sum(row.pivot is not None for row in self._rows)

    def add(self, equation: Mapping[K, Decimal | int]) -> bool:
        """Take in one more equation; whether it says something new."""
        terms, taken = {k: Decimal(c) for k, c in equation.items()}, {}
        for i, row in enumerate(self._rows):
            if row.pivot is not None and (excess := terms.get(row.pivot)):
                taken[i] = factor = excess / row.terms[row.pivot]
                for k, c in row.terms.items():
                    terms[k] = terms.get(k, 0) - factor * c
                del terms[row.pivot]
        terms = {k: c for k, c in terms.items() if abs(c) > NOTHING}
        self._rows.append(_Row(terms, max(terms, key=lambda k: abs(terms[k]), default=None), taken))
        return bool(terms)

    def repeated(self) -> set[int]:
        """The equations that take part in any repetition: each follows from others of them."""
        return {i for last, row in enumerate(self._rows) if row.pivot is None for i in self._parts(last)}

    def _parts(self, last: int) -> set[int]:
        """The equations whose weighted sum is nothing, the last of them among them."""
        weights = {last: Decimal(1)}
        for i in range(last, -1, -1):
            for k, factor in self._rows[i].taken.items() if i in weights else ():
                weights[k] = weights.get(k, Decimal(0)) - weights[i] * factor
        return {i for i, weight in weights.items() if abs(weight) > NOTHING}

    def solve(self, right: Sequence[Decimal], chosen: Mapping[K, Decimal]) -> dict[K, Decimal] | None:
        """The solution with chosen values of what is free; None where the right-hand side contradicts the equations."""
        sides: list[Decimal] = []
        for row, side in zip(self._rows, right, strict=True):
            sides.append(side - sum((f * sides[i] for i, f in row.taken.items()), Decimal(0)))
        size = max(map(abs, right), default=Decimal(0))
        if any(row.pivot is None and abs(side) > NOTHING * size for row, side in zip(self._rows, sides, strict=True)):
            return None
        values = dict(chosen)
        for row, side in zip(reversed(self._rows), reversed(sides), strict=True):
            if row.pivot is not None:
                known = sum((c * values[k] for k, c in row.terms.items() if k != row.pivot), Decimal(0))
                values[row.pivot] = (side - known) / row.terms[row.pivot]
        return values
