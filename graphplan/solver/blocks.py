"""The order in which sparse rows determine their unknowns: block by block, each from those before (Duff and Reid 1978).

Each unknown is matched with a row; it then depends on the other unknowns of its row, and those that depend on each
other in a ring are a block. So motion passes from the drives through the groups of links, and forces the other way,
which nobody has to say: the rows do. What is done with a mechanism block by block costs in proportion to its size.

A row that is left over, as special geometry makes them, ties its unknowns into one block. Small blocks that follow each
other are taken together: up to the size at which one dense block costs no more than the parts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from graphplan.mechanism.equations import matching, rings

MAX_BLOCK = 64  # unknowns that one dense block has at most, where it is no ring of more: some twenty links


class Block(NamedTuple):
    """Rows, and the columns that they determine when those of the blocks before are known."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]

    @property
    def transpose(self) -> Block:
        """The block of the transposed system, where the blocks follow each other the other way."""
        return Block(self.columns, self.rows)


def blocks(rows: Sequence[Mapping[int, Any]], width: int, together: int = MAX_BLOCK) -> list[Block]:
    """The blocks of a system, one after the other; all of it, where it is no larger than what is taken together."""
    if width <= together:
        return [Block(tuple(range(len(rows))), tuple(range(width)))]
    joined: list[list[int]] = []
    for ring in _rings(rows, width):
        if joined and len(joined[-1]) + len(ring) <= together:
            joined[-1] += ring
        else:
            joined.append([*ring])
    place = {column: k for k, columns in enumerate(joined) for column in columns}
    block_rows: list[list[int]] = [[] for _ in joined]
    for i, row in enumerate(rows):
        block_rows[max((place[column] for column in row), default=0)].append(i)
    return [Block(tuple(rows_of_block), tuple(sorted(columns)))
            for rows_of_block, columns in zip(block_rows, joined, strict=True)]


def _rings(rows: Sequence[Mapping[int, Any]], width: int) -> Iterator[tuple[int, ...]]:
    """The columns that depend on each other, each ring after all that it depends on."""
    owner = matching([tuple(row) for row in rows])
    depends: dict[int, list[int]] = {column: [] for column in range(width)}
    for column, i in owner.items():
        depends[column] += (neighbour for neighbour in rows[i] if neighbour != column)
    for i in set(range(len(rows))).difference(owner.values()):
        for column in rows[i]:
            depends[column] += (neighbour for neighbour in rows[i] if neighbour != column)
    return rings(depends)


def by_blocks(rows: Sequence[Mapping[int, Any]], ready: Callable[[Sequence[Mapping[int, Any]]], Callable[..., Any]],
              ) -> Callable[[Sequence[Any]], list[Any]]:
    """What solves a square system for a right-hand side, in any numbers, by what is made `ready` for each block."""
    prepared_blocks = []
    for block in blocks(rows, len(rows)):
        local = {column: k for k, column in enumerate(block.columns)}
        local_rows = [{local[j]: value for j, value in rows[i].items() if j in local} for i in block.rows]
        earlier_terms = [[(j, value) for j, value in rows[i].items() if j not in local] for i in block.rows]
        prepared_blocks.append((block, earlier_terms, ready(local_rows)))

    def solve_for(right: Sequence[Any]) -> list[Any]:
        values: list[Any] = [0] * len(rows)
        for block, earlier_terms, solve in prepared_blocks:
            sides = [sum((-(value * values[j]) for j, value in terms), right[i])
                     for i, terms in zip(block.rows, earlier_terms, strict=True)]
            for column, value in zip(block.columns, solve(sides), strict=True):
                values[column] = value
        return values

    return solve_for
