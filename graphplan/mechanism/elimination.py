"""Exact elimination of a sparse linear system, with whole numbers or residues of a prime and nothing rounded.

Rows are kept as primitive integers, so that no fraction is reduced before the last division. The shortest row is always
used next, on its rarest column: a mechanism's system then hardly fills in, and a chain's costs little more than reading
it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from heapq import heapify, heappop, heappush
from random import Random
from typing import Any

from graphplan.mechanism.plane import Number

PRIME = 2**61 - 1
"""Residues of this prime are exact, of one size, and a chance zero among them is all but impossible."""


class Elimination:
    """A system brought to echelon form once, to be solved for any right-hand side.

    `rows` hold ints or fractions by column; where a `prime` is given, ints that count modulo the prime. `pivots` are
    (column, row) in the order of elimination, `dependent` the rows that vanished.
    """

    def __init__(self, rows: Sequence[Mapping[int, Number]], width: int, prime: int = 0):
        self.width, self._prime = width, prime
        self._given: list[dict[int, Any]] = [
            {j: value % prime if prime else Fraction(value) for j, value in row.items()} for row in rows]
        self._scales = [math.lcm(*(value.denominator for value in row.values())) for row in self._given]
        scaled = zip(self._given, self._scales, strict=True)
        self._rows = [{j: int(value * scale) for j, value in row.items() if value} for row, scale in scaled]
        self.pivots: list[tuple[int, int]] = []
        self.dependent: list[int] = []
        self._operations: list[tuple[int, int, int, int, int]] = []
        self._eliminate()

    def _eliminate(self) -> None:
        """Take the shortest row left, and clear its rarest column from the others, until no row is left."""
        users: list[set[int]] = [set() for _ in range(self.width)]
        for i, row in enumerate(self._rows):
            for j in row:
                users[j].add(i)
        queue, left = [(len(row), i) for i, row in enumerate(self._rows)], set(range(len(self._rows)))
        heapify(queue)
        while queue:
            size, source = heappop(queue)
            row = self._rows[source]
            if source not in left or size != len(row):  # spent, or its length has changed since it was queued
                continue
            left.remove(source)
            if not row:
                self.dependent.append(source)
                continue
            for j in row:
                users[j].remove(source)
            column = min(row, key=lambda j: (len(users[j]), j))
            self.pivots.append((column, source))
            for target in sorted(users[column]):
                before = self._rows[target].keys()
                self._clear(target, source, column)
                for j in before ^ self._rows[target].keys():
                    users[j] ^= {target}
                heappush(queue, (len(self._rows[target]), target))

    def _clear(self, target: int, source: int, column: int) -> None:
        """Clear `column` from the row `target` with the row `source`, and note how:

        the row becomes (keep * target - take * source) / content.
        """
        row, pivot = self._rows[target], self._rows[source]
        common = math.gcd(pivot[column], row[column])
        keep, take = pivot[column] // common, row[column] // common
        mixed = {j: keep * row.get(j, 0) - take * pivot.get(j, 0) for j in row.keys() | pivot.keys()}
        if self._prime:
            mixed = {j: value % self._prime for j, value in mixed.items()}
        content = math.gcd(*mixed.values()) or 1
        self._rows[target] = {j: value // content for j, value in sorted(mixed.items()) if value}
        self._operations.append((target, keep, take, source, content))

    def solve(self, right: Sequence[Number]) -> list[Fraction] | None:
        """The solution (zero in free columns), or None where the right-hand side contradicts the rows."""
        sides = [Fraction(value) * scale for value, scale in zip(right, self._scales, strict=True)]
        for target, keep, take, source, content in self._operations:
            sides[target] = (keep * sides[target] - take * sides[source]) / content
        return None if any(sides[i] for i in self.dependent) else self._substitute(sides, {})

    def _substitute(self, sides: Sequence[Number], chosen: Mapping[int, int]) -> list[Any]:
        """Back substitution from chosen values of the free columns."""
        values: list[Any] = [chosen.get(j, 0) for j in range(self.width)]
        for column, i in reversed(self.pivots):
            row, prime = self._rows[i], self._prime
            rest = sides[i] - sum(v * values[j] for j, v in row.items() if j != column and values[j])
            values[column] = rest * pow(row[column], -1, prime) % prime if prime else Fraction(rest) / row[column]
        return values

    def _null_vector(self, chosen: Mapping[int, int]) -> list[Any]:
        """What solves the system with nothing on the right and chosen values of the free columns."""
        return self._substitute([0] * len(self._rows), chosen)

    @cached_property
    def _unbound(self) -> list[int]:
        """The columns that no row was solved for."""
        return sorted(set(range(self.width)).difference(column for column, _ in self.pivots))

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        return frozenset(j for j, value in enumerate(self.moved) if value)

    @property
    def moved(self) -> list[Any]:
        """What solves the system with nothing on the right: what moves when chance moves all that no row binds."""
        chance = Random(1974)
        return self._null_vector({j: chance.randrange(1, PRIME) for j in self._unbound})

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """The rows that contradict each other with this right-hand side."""
        proofs = Elimination(transpose(self._given, self.width), len(self._given))
        found = (proofs._null_vector({j: 1}) for j in proofs._unbound)
        against = (y for y in found if sum(a * Fraction(b) for a, b in zip(y, right, strict=True)))
        return frozenset(i for y in against for i, value in enumerate(y) if value)


def transpose(rows: Sequence[Mapping[int, Number]], width: int) -> list[dict[int, Number]]:
    """The columns of a system as rows."""
    columns: list[dict[int, Number]] = [{} for _ in range(width)]
    for i, row in enumerate(rows):
        for j, value in row.items():
            columns[j][i] = value
    return columns
