"""Bracing: whether a mechanism is held as it should be, and if not, which links are loose and which overbraced.

Counting freedoms is not enough: the count can be right while one part is held twice and another not at all. So the
equations are solved, for points in general position: what can still move while all drives stand still is loose;
the same question of the transposed equations finds those that only repeat what others say.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from heapq import heapify, heappop, heappush
from random import Random
from typing import NamedTuple, TypeVar

from graphplan.errors import by_name
from graphplan.mechanism.equations import PRIME, System, Unknown
from graphplan.mechanism.model import Scene

K = TypeVar("K", bound=Hashable)


class Bracing(NamedTuple):
    """The links that can move though every drive stands still, and the links that are held more than once."""

    loose: tuple[str, ...]
    overbraced: tuple[str, ...]

    @property
    def sound(self) -> bool:
        """Whether the drives determine the motion, each link's once."""
        return not self.loose and not self.overbraced


def bracing(scene: Scene, balanced: bool = False) -> Bracing:
    """How the scene's moving links are held: by its drives, or by its balances in their place."""
    system = System(scene, balanced)
    rows = [equation.terms for equation in system.equations]
    loose = {name for (_, name), _ in freedom(system.unknowns, rows)}
    repeated = freedom(range(len(rows)), _transposed(system.unknowns, rows))
    overbraced = {link for i in repeated for link in system.equations[i].links}
    return Bracing(*(tuple(sorted(found.intersection(scene.moving), key=by_name)) for found in (loose, overbraced)))


def freedom(unknowns: Iterable[K], equations: Sequence[Mapping[K, int]]) -> set[K]:
    """The unknowns that are not zero in every solution of the homogeneous equations, modulo the prime.

    Sparse elimination, lightest equation first: on chains it costs little more than reading them.
    """
    rows = [{k: c % PRIME for k, c in row.items() if c % PRIME} for row in equations]
    users: dict[K, set[int]] = {k: set() for k in unknowns}
    for i, row in enumerate(rows):
        for k in row:
            users[k].add(i)
    queue = [(len(row), i) for i, row in enumerate(rows)]
    heapify(queue)
    solved: dict[K, dict[K, int]] = {}
    while queue:
        size, i = heappop(queue)
        row = rows[i]
        if not row or size != len(row):  # spent, or its weight has changed since it was queued
            continue
        pivot = min(row, key=lambda k: len(users[k]))
        rows[i] = {}
        for k in row:
            users[k].discard(i)
        solved[pivot] = _scaled(row, pivot)
        for j in users.pop(pivot):
            _eliminate(rows[j], solved[pivot], rows[j].pop(pivot), users, j)
            heappush(queue, (len(rows[j]), j))
    return _moving(users, solved)


def _scaled(row: Mapping[K, int], pivot: K) -> dict[K, int]:
    """The equation solved for its pivot: the coefficients of the other unknowns."""
    inverse = pow(row[pivot], -1, PRIME)
    return {k: -c * inverse % PRIME for k, c in row.items() if k != pivot}


def _eliminate(row: dict[K, int], solved: Mapping[K, int], factor: int, users: dict[K, set[int]], i: int) -> None:
    """Put the solved equation into row `i`, in place of its pivot times `factor`."""
    for k, c in solved.items():
        value = (row.get(k, 0) + factor * c) % PRIME
        if value:
            row[k] = value
            users[k].add(i)
        elif k in row:
            del row[k]
            users[k].discard(i)


def _moving(free: Iterable[K], solved: Mapping[K, Mapping[K, int]]) -> set[K]:
    """What moves when chance moves all unknowns that no equation was solved for."""
    chance = Random(1974)
    value = {k: chance.randrange(1, PRIME) for k in free}
    for pivot, row in reversed(list(solved.items())):
        value[pivot] = sum(c * value[k] for k, c in row.items()) % PRIME
    return {k for k, v in value.items() if v}


def _transposed(unknowns: Iterable[Unknown], rows: Sequence[Mapping[Unknown, int]]) -> list[dict[int, int]]:
    columns: dict[Unknown, dict[int, int]] = {k: {} for k in unknowns}
    for i, row in enumerate(rows):
        for k, c in row.items():
            columns[k][i] = c
    return list(columns.values())
