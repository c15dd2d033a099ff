"""Letters and marks paired at the least cost: each letter has few candidates, and a mark may be left without one."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from graphplan.marking.judge import measures

Costs = Mapping[int, float]  # of a letter's candidates


def assigned(wishes: Sequence[Costs], nothing: float, shared: float) -> list[int | None]:
    """The candidate of each letter, None where none is worth it, so that all together cost least: `nothing` is the
    cost of a letter that names no candidate, `shared` that of a candidate's second letter, of its third twice as much.
    """
    found: list[int | None] = [None] * len(wishes)
    for crowd in _crowds(wishes):
        if len(crowd) > measures.MAX_CROWD:
            for letter in crowd:
                best = min(wishes[letter], key=wishes[letter].__getitem__)
                found[letter] = best if wishes[letter][best] < nothing else None
            continue
        named = sorted({one for letter in crowd for one in wishes[letter]})
        copies = min(3, len(crowd))
        table = [[wishes[letter].get(one, math.inf) + shared * copy for copy in range(copies) for one in named]
                 + [nothing] * len(crowd) for letter in crowd]
        for letter, column in zip(crowd, cheapest(table), strict=True):
            found[letter] = named[column % len(named)] if column < copies * len(named) else None
    return found


def _crowds(wishes: Sequence[Costs]) -> Iterator[list[int]]:
    """The letters that have candidates, in groups that share none with each other."""
    group = list(range(len(wishes)))

    def root(letter: int) -> int:
        while group[letter] != letter:
            group[letter] = letter = group[group[letter]]
        return letter

    first: dict[int, int] = {}
    for letter, costs in enumerate(wishes):
        for one in costs:
            group[root(letter)] = root(first.setdefault(one, letter))
    crowds: dict[int, list[int]] = {}
    for letter, costs in enumerate(wishes):
        if costs:
            crowds.setdefault(root(letter), []).append(letter)
    yield from crowds.values()


def cheapest(table: Sequence[Sequence[float]]) -> list[int]:
    """The column of each row, no two the same, at the least sum: by shortest augmenting paths (Jonker and Volgenant,
    Computing 38, 1987). There are at least as many columns as rows, and some way of finite cost."""
    rows, columns = len(table), len(table[0]) if table else 0
    price, spare = [0.0] * columns, [0.0] * rows  # of the dual problem
    holder: list[int] = [-1] * columns
    for row in range(rows):
        least, before = [math.inf] * columns, [-1] * columns
        done = [False] * columns
        here, column, far = row, -1, 0.0
        while True:
            for other in range(columns):
                if not done[other]:
                    length = far + table[here][other] - spare[here] - price[other]
                    if length < least[other]:
                        least[other], before[other] = length, column
            column = min((other for other in range(columns) if not done[other]), key=least.__getitem__)
            far, done[column] = least[column], True
            if holder[column] < 0:
                break
            here = holder[column]
        spare[row] += far
        for other in range(columns):
            if done[other] and other != column:
                spare[holder[other]] += far - least[other]
                price[other] -= far - least[other]
        while column >= 0:
            last = before[column]
            holder[column] = holder[last] if last >= 0 else row
            column = last
    found = [-1] * rows
    for column, row in enumerate(holder):
        if row >= 0:
            found[row] = column
    return found
