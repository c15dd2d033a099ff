"""Linear systems in floats, by numpy.

A system is equilibrated and decomposed by singular values, which say what is determined, what contradicts and how good
the condition is. A large one is solved block by block, in proportion to its size, unless a block is near to singular.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from operator import sub
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from graphplan.mechanism.equations import transpose
from graphplan.mechanism.model import Number
from graphplan.solver.linear import Block, Row, blocks, by_blocks, product
from graphplan.solver.tolerances import EIGENVALUE_TOL, NULL_VECTOR_TOL, SINGULAR_TOL

Array = NDArray[np.float64]

SWEEPS = 4  # of equilibration


class Floating:
    """A system made ready for any right-hand sides; `scales` make its unknowns comparable.

    For forces it is the transposed system. `free_vectors` are the directions, shape (columns, k), that the system
    leaves undetermined, `bound_vectors` those of right-hand sides, shape (rows, k), that contradict it.
    """

    def __init__(self, rows: Sequence[Row], scales: Sequence[float], forces: bool = False):
        equilibrated, self._row_factors, self._column_factors = equilibrate(rows, scales)
        self._rows: Sequence[Row] = equilibrated
        self._blocks = blocks(rows, len(scales))
        if forces:
            self._rows = transpose(equilibrated, len(scales))
            self._row_factors, self._column_factors = self._column_factors, self._row_factors
            self._blocks = [block.transpose for block in reversed(self._blocks)]
        width = len(self._column_factors)
        self._tolerance = max(len(self._rows), width, 1) * SINGULAR_TOL
        self.free_vectors, self.bound_vectors = np.zeros((width, 0)), np.zeros((len(self._rows), 0))
        self._sigma: NDArray[Any] = np.ones(0)
        if len(self._blocks) > 1:
            with suppress(np.linalg.LinAlgError):
                self._inverse = by_blocks(self._rows, self._blocks, _invert)
                return
        U, self._sigma, Vt = np.linalg.svd(dense(self._rows, width))
        rank = int(np.sum(self._sigma > self._tolerance * self._sigma.max(initial=0.0)))
        inverse = (Vt[:rank].T / self._sigma[:rank]) @ U[:, :rank].T
        self._inverse = lambda sides: cast(list[float], (inverse @ sides).tolist())
        self.free_vectors, self.bound_vectors = Vt[rank:].T, U[:, rank:]

    @property
    def condition(self) -> float:
        """The 2-norm condition of the equilibrated system, free of units: 1 is best."""
        if self._rows and not self._sigma.size:
            return math.sqrt(self._largest_square() * self._largest_inverse_square())
        return float(self._sigma[0] / self._sigma[-1]) if self._sigma.size else 1.0

    def _largest_square(self) -> float:
        """Return the square of the largest singular value."""
        (i, j, values), width = _entries(self._rows), len(self._column_factors)

        def multiply(vector: Array) -> Array:
            return _sums(j, values * _sums(i, values * vector[j], len(self._rows))[i], width)

        return _largest_eigenvalue(multiply, width)

    def _largest_inverse_square(self) -> float:
        """Return the square of the inverse's largest singular value, of a system that is solved block by block."""
        transposed_inverse = by_blocks(transpose(self._rows, len(self._column_factors)),
                                       [block.transpose for block in reversed(self._blocks)], _invert)
        return _largest_eigenvalue(lambda vector: np.array(self._inverse(transposed_inverse(vector.tolist()))),
                                   len(self._rows))

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        play = np.linalg.norm(self.free_vectors, axis=1)
        return _places(play > NULL_VECTOR_TOL * play.max(initial=0.0))

    def solve(self, right: Sequence[Number]) -> list[float] | None:
        """Return the shortest solution, or None where the right-hand side contradicts the rows by more than rounding.
        """
        if self.conflict(right):
            return None
        sides = self._sides(right)
        values = self._inverse(sides)
        remainders = [*map(sub, sides, product(self._rows, values))]
        return [float(factor) * (value + more) for factor, value, more in zip(
            self._column_factors, values, self._inverse(remainders), strict=True)]

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """Return the rows that contradict each other with this right-hand side.

        Sides made of computed velocities carry their errors, which the condition enlarges.
        """
        if not self.bound_vectors.size:
            return frozenset()
        sides, rank = self._sides(right), len(self._column_factors) - self.free_vectors.shape[1]
        condition = self._sigma[0] / self._sigma[rank - 1] if rank else 1.0
        missed = np.abs(self.bound_vectors @ (self.bound_vectors.T @ sides))
        return _places(missed > self._tolerance * condition * np.linalg.norm(sides))

    def _sides(self, right: Sequence[Number]) -> list[float]:
        return [factor * float(value) for factor, value in zip(self._row_factors, right, strict=True)]


def _invert(block: Block, rows: Sequence[Row]) -> Callable[..., list[float]]:
    """Return what solves a block. Raises `LinAlgError` unless it is square and regular."""
    matrix = dense(rows, len(block.columns))
    inverse = np.linalg.inv(matrix)
    if np.linalg.norm(matrix) * np.linalg.norm(inverse) * len(rows) * SINGULAR_TOL >= 1:
        raise np.linalg.LinAlgError
    return lambda sides, known: cast(list[float], (inverse @ sides).tolist())


def _largest_eigenvalue(multiply: Callable[[Array], Array], width: int) -> float:
    """Return the largest eigenvalue of a symmetric positive matrix, given by its product with a vector.

    Lanczos's iteration doubles its steps until the eigenvalue stops growing (G. H. Golub, C. F. Van Loan, Matrix
    Computations (2013), 10.1). A remainder of zero ends it: the vectors so far span all that the first one is made of.
    """
    vector, remainder = np.zeros(width), np.random.default_rng(0).standard_normal(width)
    diagonal, off_diagonal, largest = list[float](), [float(np.linalg.norm(remainder))], 0.0
    while off_diagonal[-1]:
        before, vector = vector, remainder / off_diagonal[-1]
        remainder = multiply(vector) - off_diagonal[-1] * before
        diagonal.append(float(remainder @ vector))
        remainder -= diagonal[-1] * vector
        off_diagonal.append(float(np.linalg.norm(remainder)))
        if len(diagonal).bit_count() == 1 or not off_diagonal[-1]:
            previous, largest = largest, _largest_of_tridiagonal(diagonal, off_diagonal[1:-1])
            if largest - previous <= EIGENVALUE_TOL * largest:
                break
    return largest


def _largest_of_tridiagonal(diagonal: Sequence[float], off_diagonal: Sequence[float]) -> float:
    """Return the largest eigenvalue of a symmetric tridiagonal matrix, by bisection to the last digit.

    Above all eigenvalues, every pivot of the matrix less a multiple of the identity is negative.
    """
    squares = [0.0, *(value * value for value in off_diagonal)]
    low, high = max(diagonal), max(diagonal) + 2 * max(off_diagonal, default=0.0)
    while low < (middle := (low + high) / 2) < high:
        pivot = math.inf
        for value, square in zip(diagonal, squares, strict=True):
            pivot = value - middle - square / pivot
            if pivot >= 0:
                low = middle
                break
        else:
            high = middle
    return high


def _places(mask: NDArray[np.bool_]) -> frozenset[int]:
    return frozenset(np.flatnonzero(mask).tolist())


def dense(rows: Sequence[Row], width: int) -> Array:
    """Return sparse rows as a matrix."""
    matrix = np.zeros((len(rows), width))
    for i, row in enumerate(rows):
        matrix[i, [*row]] = [*row.values()]
    return matrix


def equilibrate(rows: Sequence[Row], scales: Sequence[float]) -> tuple[list[dict[int, float]], Array, Array]:
    """Return the rows with rows and columns near unit length, and the factors of the rows and of the columns.

    Unknowns are first measured by `scales`, so that the result does not depend on the unit of length.
    """
    i, j, values = _entries(rows)
    row_factors, column_factors = np.ones(len(rows)), 1.0 / np.array(scales)
    for _ in range(SWEEPS):
        row_factors /= _lengths(i, values * row_factors[i] * column_factors[j], len(rows))
        column_factors /= _lengths(j, values * row_factors[i] * column_factors[j], len(scales))
    return ([{k: float(value) * r * column_factors[k] for k, value in row.items()}
             for r, row in zip(row_factors, rows, strict=True)], row_factors, column_factors)


def _entries(rows: Sequence[Row]) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Return the row, the column and the value of each entry."""
    return (np.repeat(np.arange(len(rows)), [*map(len, rows)]),
            np.array([column for row in rows for column in row], np.intp),
            np.array([float(value) for row in rows for value in row.values()]))


def _lengths(places: NDArray[np.intp], values: Array, count: int) -> Array:
    """Return the length of each row or column, from the places of its entries and their values; 1 instead of 0."""
    lengths = np.sqrt(_sums(places, values**2, count))
    return np.where(lengths > 0, lengths, 1.0)


def _sums(places: NDArray[np.intp], values: Array, count: int) -> Array:
    """Return the sum of the values at each of so many places."""
    return np.asarray(np.bincount(places, values, count), np.float64)


def independent(sparse: Sequence[Row], scales: Sequence[float]) -> list[int]:
    """Return as many independent rows as there are unknowns: of each block those that come first."""
    matrix = dense(equilibrate(sparse, scales)[0], len(scales))
    rows: list[int] = []
    for block in blocks(sparse, len(scales)):
        basis = np.zeros((0, len(block.columns)))
        for i in block.rows:
            row = matrix[i, list(block.columns)]
            for _ in range(2):  # twice, for orthogonality to the last digit
                row = row - basis.T @ (basis @ row)
            if (length := np.linalg.norm(row)) > NULL_VECTOR_TOL:
                rows.append(i)
                basis = np.vstack([basis, row / length])
    return sorted(rows)
