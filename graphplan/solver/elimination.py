"""Exact elimination of a sparse linear system, with whole numbers and nothing rounded.

Rows are kept as primitive integers, so that no fraction is reduced before the last division. The shortest row
is always used next, on its rarest column: a mechanism's system then hardly fills in.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.model import Number


class Operation(NamedTuple):
    """One step: row `target` becomes (keep * target - take * source) / content."""

    target: int
    keep: int
    take: int
    source: int
    content: int


class Elimination:
    """A system brought to echelon form once, to be solved for any right-hand side.

    `rows` hold ints or fractions by column. `pivots` are (column, row) in the order of elimination, `dependent`
    the rows that vanished.
    """

    def __init__(self, rows: Sequence[Mapping[int, Number]], width: int):
        self.width = width
        self._given = [{j: Fraction(value) for j, value in row.items() if value} for row in rows]
        self._scales = [math.lcm(*(value.denominator for value in row.values())) for row in self._given]
        scaled = zip(self._given, self._scales, strict=True)
        self._rows = [{j: int(value * scale) for j, value in row.items()} for row, scale in scaled]
        self.pivots: list[tuple[int, int]] = []
        self.dependent: list[int] = []
        self._operations: list[Operation] = []
        self._eliminate()

    def _eliminate(self) -> None:
        """Take the shortest row left, and clear its rarest column from the others, until no row is left."""
        left = set(range(len(self._rows)))
        users: dict[int, set[int]] = {j: {i for i in left if j in self._rows[i]} for j in range(self.width)}
        while left:
            source = min(left, key=lambda i: (len(self._rows[i]), i))
            left.remove(source)
            for j in self._rows[source]:
                users[j].remove(source)
            if not self._rows[source]:
                self.dependent.append(source)
                continue
            column = min(self._rows[source], key=lambda j: (len(users[j]), j))
            self.pivots.append((column, source))
            for target in sorted(users[column]):
                before = self._rows[target].keys()
                self._clear(target, source, column)
                for j in before ^ self._rows[target].keys():
                    users[j] ^= {target}

    def _clear(self, target: int, source: int, column: int) -> None:
        """Clear `column` from the row `target` with the row `source`, and note how."""
        row, pivot = self._rows[target], self._rows[source]
        common = math.gcd(pivot[column], row[column])
        keep, take = pivot[column] // common, row[column] // common
        mixed = {j: keep * row.get(j, 0) - take * pivot.get(j, 0) for j in row.keys() | pivot.keys()}
        content = math.gcd(*mixed.values()) or 1
        self._rows[target] = {j: value // content for j, value in sorted(mixed.items()) if value}
        self._operations.append(Operation(target, keep, take, source, content))

    def solve(self, right: Sequence[Number]) -> list[Fraction] | None:
        """The solution (zero in free columns), or None where the right-hand side contradicts the rows."""
        sides = [Fraction(value) * scale for value, scale in zip(right, self._scales, strict=True)]
        for target, keep, take, source, content in self._operations:
            sides[target] = (keep * sides[target] - take * sides[source]) / content
        return None if any(sides[i] for i in self.dependent) else self._substitute(sides, {})

    def _substitute(self, sides: Sequence[Fraction], chosen: Mapping[int, int]) -> list[Fraction]:
        """Back substitution from chosen values of the free columns."""
        values = [Fraction(chosen.get(j, 0)) for j in range(self.width)]
        for column, i in reversed(self.pivots):
            rest = sum((v * values[j] for j, v in self._rows[i].items() if j != column and values[j]), Fraction(0))
            values[column] = (sides[i] - rest) / self._rows[i][column]
        return values

    @property
    def null_vectors(self) -> list[list[Fraction]]:
        """A basis of what solves the system with nothing on the right."""
        nothing = [Fraction(0)] * len(self._rows)
        bound = {column for column, _ in self.pivots}
        return [self._substitute(nothing, {free: 1}) for free in range(self.width) if free not in bound]

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        return frozenset(j for vector in self.null_vectors for j, value in enumerate(vector) if value)

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """The rows that contradict each other with this right-hand side."""
        proofs = Elimination(transpose(self._given, self.width), len(self._given)).null_vectors
        against = (y for y in proofs if sum(a * Fraction(b) for a, b in zip(y, right, strict=True)))
        return frozenset(i for y in against for i, value in enumerate(y) if value)


def transpose(rows: Sequence[Mapping[int, Number]], width: int) -> list[dict[int, Number]]:
    """The columns of a system as rows."""
    return [{i: row[j] for i, row in enumerate(rows) if j in row} for j in range(width)]
