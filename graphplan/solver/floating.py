"""The linear system in floats: equilibrated, decomposed once by singular values, solved for any right-hand side.

The only module of the solver that imports numpy; imported when called.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from graphplan.mechanism.model import Number

Array = NDArray[np.float64]
Sparse = Sequence[Mapping[int, Number]]

# Coordinates and their differences carry a rounding of about 2^-52 each, which moves every singular value by up to
# n 2^-52 sigma_max, and the decomposition as much again; with a margin, anything below 8 times that may be zero.
ROUNDING = 8 * 2.0**-52

# A null vector is known to about its gap's rounding; half of the digits tell what moves from what stands still.
STANDS_STILL = 2.0**-26

SWEEPS = 4


class Floating:
    """A system decomposed once, to be solved for any right-hand side: an equilibrated matrix and its factors.

    For forces it is the transposed one, whose rows' factors are columns'.
    """

    def __init__(self, sparse: Sparse, width: int, reach: float, forces: bool = False):
        matrix, rows, columns = equilibrated(sparse, width, reach)
        self._matrix, self._rows, self._columns = (matrix.T, columns, rows) if forces else (matrix, rows, columns)
        self._left, self._sigma, self._right = np.linalg.svd(self._matrix)
        self._tolerance = max(self._matrix.shape, default=0) * ROUNDING
        self._rank = int(np.sum(self._sigma > self._tolerance * self._sigma.max(initial=0.0)))

    @property
    def condition(self) -> float:
        """The 2-norm condition of the equilibrated system: its largest singular value over its smallest."""
        return float(self._sigma[0] / self._sigma[-1]) if self._sigma.size else 1.0

    def solve(self, right: Sequence[Number]) -> list[float] | None:
        """The shortest solution, or None where the right-hand side contradicts the rows by more than rounding."""
        sides = self._sides(right)
        values = self._inverse(sides)
        values = values + self._inverse(sides - self._matrix @ values)  # one refinement wins the last digits back
        return None if self._contradiction(sides).any() else [float(v) for v in self._columns * values]

    def _sides(self, right: Sequence[Number]) -> Array:
        return np.asarray(self._rows * np.array([float(value) for value in right]), dtype=np.float64)

    def _inverse(self, sides: Array) -> Array:
        """The pseudo-inverse times `sides`, from the singular values that are not zero."""
        parts = (self._left[:, : self._rank].T @ sides) / self._sigma[: self._rank]
        values: Array = self._right[: self._rank].T @ parts
        return values

    def _contradiction(self, sides: Array) -> NDArray[np.bool_]:
        """The rows that no motion can meet. Sides made of computed velocities carry their error: hence the blur."""
        outside = self._left[:, self._rank :]
        missed = np.abs(outside @ (outside.T @ sides))
        blur = self._sigma[0] / self._sigma[self._rank - 1] if self._rank else 1.0
        beyond: NDArray[np.bool_] = missed > self._tolerance * blur * np.linalg.norm(sides)
        return beyond

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        play = np.linalg.norm(self._right[self._rank :], axis=0)
        return frozenset(int(j) for j in np.flatnonzero(play > STANDS_STILL * play.max(initial=0.0)))

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """The rows that contradict each other with this right-hand side."""
        return frozenset(int(i) for i in np.flatnonzero(self._contradiction(self._sides(right))))


def independent(sparse: Sparse, width: int, reach: float) -> list[int]:
    """As many rows as there are unknowns, none following from others: those that come first."""
    kept: list[int] = []
    known = np.zeros((0, width))
    for i, row in enumerate(equilibrated(sparse, width, reach)[0]):
        rest = row - known.T @ (known @ row)
        rest -= known.T @ (known @ rest)  # once more, for orthogonality to the last digit
        if np.linalg.norm(rest) > STANDS_STILL * np.linalg.norm(row):
            kept.append(i)
            known = np.vstack([known, rest / np.linalg.norm(rest)])
    return kept


def equilibrated(sparse: Sparse, width: int, reach: float) -> tuple[Array, Array, Array]:
    """The rows as a matrix with rows and columns near unit length, and the factors of its rows and of its columns.

    Turnings are first measured as reach * omega, so that the result does not depend on the unit of length.
    """
    matrix = np.zeros((len(sparse), width))
    for i, row in enumerate(sparse):
        for j, value in row.items():
            matrix[i, j] = float(value)
    rows, columns = np.ones(len(sparse)), np.tile([1.0, 1.0, 1.0 / reach], width // 3)
    for _ in range(SWEEPS):
        rows /= lengths(matrix * rows[:, None] * columns, 1)
        columns /= lengths(matrix * rows[:, None] * columns, 0)
    return matrix * rows[:, None] * columns, rows, columns


def lengths(matrix: Array, axis: int) -> Array:
    """The lengths of rows (axis 1) or columns (axis 0), with 1 in the place of 0."""
    norms: Array = np.linalg.norm(matrix, axis=axis)
    return np.where(norms > 0, norms, 1.0)
