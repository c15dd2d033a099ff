"""The linear system in floats: equilibrated, each block decomposed once by singular values, solved for any right side.

Blocks follow each other. What a block leaves undetermined is carried on as parameters, one vector of all unknowns for
each: later blocks may settle them, as they may one that special geometry makes singular. Regular systems have none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from graphplan.mechanism.model import Number
from graphplan.solver.blocks import Block, blocks
from graphplan.solver.tolerances import NULL_VECTOR_TOL, SINGULAR_TOL

Array = NDArray[np.float64]
Places = NDArray[np.intp]
Sparse = Sequence[Mapping[int, Number]]

SWEEPS = 4
POWERS = 20  # of a matrix of many blocks: after so many the longest vector hardly grows any more


class Entries:
    """The entries of a sparse matrix: their rows, columns and values."""

    def __init__(self, rows: Places, columns: Places, values: Array, shape: tuple[int, int]):
        self.rows, self.columns, self.values, self.shape = rows, columns, values, shape

    @classmethod
    def from_rows(cls, sparse: Sparse, width: int) -> Entries:
        """The numbers of sparse rows as floats."""
        entries = [(i, j, float(value)) for i, row in enumerate(sparse) for j, value in row.items()]
        rows, columns, values = zip(*entries, strict=True) if entries else ((), (), ())
        return cls(np.array(rows, np.intp), np.array(columns, np.intp), np.array(values, float), (len(sparse), width))

    @property
    def transpose(self) -> Entries:
        """The columns as rows."""
        return Entries(self.columns, self.rows, self.values, self.shape[::-1])

    def scale(self, rows: Array, columns: Array) -> Entries:
        """Each entry times a factor of its row and one of its column."""
        return Entries(self.rows, self.columns, self.values * rows[self.rows] * columns[self.columns], self.shape)

    def lengths(self) -> Array:
        """The lengths of the rows, with 1 in the place of 0."""
        norms: Array = np.sqrt(np.bincount(self.rows, self.values**2, self.shape[0]))
        return np.where(norms > 0, norms, 1.0)

    def __matmul__(self, vector: Array) -> Array:
        return np.asarray(np.bincount(self.rows, self.values * vector[self.columns], self.shape[0]), dtype=np.float64)


class Decomposed:
    """One block by its singular values, with the columns `before` it that its rows speak of.

    `play` are the vectors of all unknowns that the blocks before leave undetermined; they are unknowns here.
    """

    def __init__(self, block: Block, entries: Entries, play: Array):
        self.rows, self.columns = np.array(block.rows, np.intp), np.array(block.columns, np.intp)
        place = np.full(entries.shape[1], -1, np.intp)
        place[self.columns] = np.arange(self.columns.size)
        before = np.unique(entries.columns[place[entries.columns] < 0])
        place[before] = np.arange(before.size) + self.columns.size
        dense = np.zeros((self.rows.size, self.columns.size + before.size))
        dense[np.searchsorted(self.rows, entries.rows), place[entries.columns]] = entries.values
        square, self._known, self._before = dense[:, : self.columns.size], dense[:, self.columns.size :], before
        self._play, self.matrix = play, np.hstack([square, self._known @ play[before]])
        self._left, self.sigma, self._right = np.linalg.svd(self.matrix)
        least = max(square.shape, default=0) * SINGULAR_TOL * self.sigma.max(initial=0.0)
        self._rank = int(np.sum(self.sigma > least))
        self.blur = float(self.sigma[0] / self.sigma[self._rank - 1]) if self._rank else 1.0

    @property
    def free(self) -> Array:
        """The vectors of all unknowns that this block leaves undetermined, too."""
        null = self._right[self._rank :].T
        if not null.size and not self._play.shape[1]:
            return self._play
        free: Array = self._play @ null[self.columns.size :]
        free[self.columns] = null[: self.columns.size]
        return free

    def solve(self, sides: Array, values: Array, tolerance: float) -> bool:
        """Set the unknowns of the block, and move those before as far as they are undetermined.

        Whether rows contradict each other; sides made of computed velocities carry their error: hence the blur.
        """
        remainder = sides[self.rows] - self._known @ values[self._before]
        coordinates = (self._left[:, : self._rank].T @ remainder) / self.sigma[: self._rank]
        solution = self._right[: self._rank].T @ coordinates
        if self._play.shape[1]:
            values += self._play @ solution[self.columns.size :]
        values[self.columns] = solution[: self.columns.size]
        outside = self._left[:, self._rank :]
        missed = np.abs(outside @ (outside.T @ remainder))
        return bool(np.any(missed > tolerance * self.blur * max(np.linalg.norm(remainder), np.linalg.norm(sides))))

    def solve_transposed(self, sides: Array, values: Array) -> None:
        """The same for the transposed system, from the last block to the first, of a system that is regular."""
        coordinates = (self._right @ sides[self.columns])[: self._rank] / self.sigma[: self._rank]
        values[self.rows] = self._left[:, : self._rank] @ coordinates
        sides[self._before] -= self._known.T @ values[self.rows]


class Floating:
    """A system decomposed once, to be solved for any right-hand side: an equilibrated matrix and its blocks' factors.

    `scales` make the unknowns comparable. For forces it is the transposed system, whose rows' factors are columns'.
    """

    def __init__(self, sparse: Sparse, scales: Sequence[float], forces: bool = False):
        entries, rows, columns = equilibrate(sparse, scales)
        system_blocks = blocks(sparse, len(scales))
        if forces:
            entries, rows, columns = entries.transpose, columns, rows
            system_blocks = [block.transpose for block in reversed(system_blocks)]
        self._entries, self._rows, self._columns, self._blocks = entries, rows, columns, system_blocks
        self._parts, self._free = decompose(entries, system_blocks)
        self._tolerance = max(entries.shape, default=0) * SINGULAR_TOL

    @property
    def condition(self) -> float:
        """The 2-norm condition of the equilibrated system: its largest singular value over its smallest.

        Of several blocks it is found by powers, which tell it to a few hundredths.
        """
        if len(self._parts) < 2:
            sigma = self._parts[0].sigma
            return float(sigma[0] / sigma[-1]) if sigma.size else 1.0
        if self._free.size:
            return float("inf")
        across = self._entries.transpose
        square = (_growth(lambda vector: across @ (self._entries @ vector), self._entries.shape[1])
                  * _growth(lambda vector: self._inverse(self._solve_transposed(vector))[0], self._entries.shape[1]))
        return math.sqrt(square)

    def solve(self, right: Sequence[Number]) -> list[float] | None:
        """The shortest solution, or None where the right-hand side contradicts the rows by more than rounding."""
        sides = self._sides(right)
        values, contradicted = self._inverse(sides)
        values = values + self._inverse(sides - self._entries @ values)[0]  # wins the last digits back
        return None if contradicted else [float(v) for v in self._columns * values]

    def _sides(self, right: Sequence[Number]) -> Array:
        return np.asarray(self._rows * np.array([float(value) for value in right]), dtype=np.float64)

    def _inverse(self, sides: Array) -> tuple[Array, bool]:
        """A solution, and whether rows contradict each other."""
        values, contradicted = np.zeros(self._entries.shape[1]), False
        for block in self._parts:
            contradicted |= block.solve(sides, values, self._tolerance)
        return values, contradicted

    def _solve_transposed(self, sides: Array) -> Array:
        """A solution of the transposed system."""
        values, remainder = np.zeros(self._entries.shape[0]), sides.copy()
        for block in reversed(self._parts):
            block.solve_transposed(remainder, values)
        return values

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        play = np.linalg.norm(np.linalg.qr(self._free)[0], axis=1)
        return frozenset(int(j) for j in np.flatnonzero(play > NULL_VECTOR_TOL * play.max(initial=0.0)))

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """The rows that contradict each other with this right-hand side."""
        sides, across = self._sides(right), [entries_block.transpose for entries_block in reversed(self._blocks)]
        decomposed, free = decompose(self._entries.transpose, across)
        outside, blur = np.linalg.qr(free)[0], max(block.blur for block in decomposed)
        missed = np.abs(outside @ (outside.T @ sides))
        return frozenset(int(i) for i in np.flatnonzero(missed > self._tolerance * blur * np.linalg.norm(sides)))


def decompose(entries: Entries, system_blocks: Sequence[Block]) -> tuple[list[Decomposed], Array]:
    """The blocks by singular values, and the vectors that they leave undetermined."""
    home = np.zeros(entries.shape[0], np.intp)
    for k, block in enumerate(system_blocks):
        home[list(block.rows)] = k
    order = np.argsort(home[entries.rows], kind="stable")
    ends = np.searchsorted(home[entries.rows][order], np.arange(len(system_blocks) + 1))
    decomposed, play = list[Decomposed](), np.zeros((entries.shape[1], 0))
    for k, block in enumerate(system_blocks):
        entry_places = order[ends[k] : ends[k + 1]]
        block_entries = Entries(entries.rows[entry_places], entries.columns[entry_places], entries.values[entry_places],
                                entries.shape)
        decomposed.append(Decomposed(block, block_entries, play))
        play = decomposed[-1].free
    return decomposed, play


def _growth(step: Callable[[Array], Array], width: int) -> float:
    """By how much a symmetric matrix lengthens the vector that it lengthens most."""
    vector, length = np.random.default_rng(1974).standard_normal(width), 1.0
    for _ in range(POWERS):
        vector = step(vector / np.linalg.norm(vector))
        length = float(np.linalg.norm(vector))
    return length


def independent(sparse: Sparse, scales: Sequence[float]) -> list[int]:
    """As many rows as there are unknowns, none following from others: of each block those that come first."""
    entries, *_ = equilibrate(sparse, scales)
    decomposed, _ = decompose(entries, blocks(sparse, len(scales)))
    return sorted(int(block.rows[i]) for block in decomposed for i in _independent_rows(block.matrix))


def _independent_rows(matrix: Array) -> list[int]:
    """The rows that do not follow from those before them, in a matrix of rows near unit length."""
    independent_rows: list[int] = []
    basis = np.zeros((0, matrix.shape[1]))
    for i, row in enumerate(matrix):
        remainder = row - basis.T @ (basis @ row)
        remainder -= basis.T @ (basis @ remainder)  # once more, for orthogonality to the last digit
        if np.linalg.norm(remainder) > NULL_VECTOR_TOL:
            independent_rows.append(i)
            basis = np.vstack([basis, remainder / np.linalg.norm(remainder)])
    return independent_rows


def equilibrate(sparse: Sparse, scales: Sequence[float]) -> tuple[Entries, Array, Array]:
    """The rows as a matrix with rows and columns near unit length, and the factors of its rows and of its columns.

    Unknowns are first measured by `scales`, so that the result does not depend on the unit of length.
    """
    matrix = Entries.from_rows(sparse, len(scales))
    rows, columns = np.ones(len(sparse)), 1.0 / np.array(scales)
    for _ in range(SWEEPS):
        rows /= matrix.scale(rows, columns).lengths()
        columns /= matrix.scale(rows, columns).transpose.lengths()
    return matrix.scale(rows, columns), rows, columns
