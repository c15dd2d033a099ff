"""Linear systems solved in floats, block by block, with a proven bound for each unknown.

With an approximate inverse R of a block A, the error of an approximate solution x is at most e, by components, if
|R (b - A x)| + |I - R A| e is less than e everywhere; and then A has an inverse, which proves the pose to be regular
(S. M. Rump, Acta Numerica 19 (2010), 10.). Every rounding, of the coefficients and of the proof itself, is in it.

What earlier blocks are off by comes in addition. As bounds of each unknown alone it would grow with every block, though
errors that belong together cancel. So what a block hands on is held in a parallelepiped, not in a box: all sums of some
vectors, each times a number from -1 to 1, of which those that are many are replaced by as many as there are unknowns,
along the longest of them (R. J. Lohner, Computational Ordinary Differential Equations (1992), 425).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphplan.solver.blocks import Block, blocks
from graphplan.solver.bounds import Bounded, Unproven, bounded_number
from graphplan.solver.tolerances import MAX_WIDENINGS, MIN_BOUND, ROUNDOFF, WIDENING

Array = NDArray[np.float64]
Places = NDArray[np.intp]


class Found(NamedTuple):
    """Unknowns with the bounds of their errors and the sizes of what cancels in them."""

    values: Array
    errors: Array
    sizes: Array

    def select_columns(self, columns: Places) -> Found:
        """Those of some columns."""
        return Found(self.values[columns], self.errors[columns], self.sizes[columns])


class Proven:
    """A square system, made ready for any right-hand sides; `scales` make its unknowns comparable.

    What is solved proves that the matrix has an inverse.
    """

    def __init__(self, rows: Sequence[Mapping[int, Any]], scales: Sequence[float]):
        width = len(scales)
        if len(rows) != width:
            raise Unproven("the system is not square")
        entries = [{j: bounded_number(number) for j, number in row.items()} for row in rows]
        self._parts = [_Part(entries, block, np.array(scales)) for block in blocks(rows, width)]
        home = {column: k for k, block_system in enumerate(self._parts) for column in block_system.columns.tolist()}
        self._sources = [sorted({home[column] for column in block_system.before.tolist()})
                         for block_system in self._parts]
        used = {column for block_system in self._parts for column in block_system.before.tolist()}
        for block_system in self._parts:
            block_system.outlets = np.flatnonzero([column in used for column in block_system.columns.tolist()])

    def solve(self, right: Sequence[Any]) -> list[Bounded]:
        """The unknowns; fails with `Unproven` where no bound holds."""
        numbers = [bounded_number(number) for number in right]
        sides = Found(*(np.array([getattr(number, field) for number in numbers])
                        for field in ("value", "error", "size")))
        unknowns = Found(*np.zeros((3, len(numbers))))
        passed: list[Array] = []
        for block, sources in zip(self._parts, self._sources, strict=True):
            coming = [block.coming(self._parts[k], passed[k]) for k in sources]
            solution, vectors = block.solve(sides.select_columns(block.rows), unknowns.select_columns(block.before),
                                            np.hstack([np.zeros((block.before.size, 0)), *coming]))
            passed.append(vectors)
            for all_unknowns, block_unknowns in zip(unknowns, solution, strict=True):
                all_unknowns[block.columns] = block_unknowns
        return [Bounded(float(x), float(e), float(s)) for x, e, s in zip(*unknowns, strict=True)]


class _Part:
    """One block: its matrix with an approximate inverse, and how it hangs on the unknowns `before`.

    `outlets` are its places of the unknowns that later blocks hang on.
    """

    def __init__(self, entries: Sequence[Mapping[int, Bounded]], block: Block, scales: Array):
        self.rows, self.columns = np.array(block.rows, dtype=np.intp), np.array(block.columns, dtype=np.intp)
        width, block_columns = len(block.columns), frozenset(block.columns)
        before = sorted({j for i in block.rows for j in entries[i]} - block_columns)
        self.before, self.outlets = np.array(before, dtype=np.intp), np.array([], dtype=np.intp)
        place = {column: k for k, column in enumerate([*block.columns, *before])}
        value, off = np.zeros((2, width, len(place)))
        for i, row in enumerate(block.rows):
            for j, number in entries[row].items():
                value[i, place[j]], off[i, place[j]] = number.value, number.error
        self._matrix, self._known = value[:, :width], value[:, width:]
        self._off, self._known_off = off[:, :width], off[:, width:]
        try:
            self._inverse = np.linalg.inv(self._matrix) if width else self._matrix
        except np.linalg.LinAlgError:
            raise Unproven("the matrix has no inverse in floats") from None
        self._sizes, self._known_sizes = np.abs(self._matrix) + self._off, np.abs(self._known) + self._known_off
        self._far = np.abs(self._inverse)
        self._slack = _roundings(np.count_nonzero(value, axis=1))  # of a row's sum of products, less a side
        columns = _roundings(np.count_nonzero(self._matrix, axis=0))
        gap = np.abs(np.eye(width) - self._inverse @ self._matrix)
        self._miss = gap + columns * (self._far @ self._sizes + np.eye(width)) + self._far @ self._off
        self._scales, self._known_scales = scales[self.columns], scales[self.before]

    def coming(self, source: _Part, vectors: Array) -> Array:
        """What an earlier block hands on, for the unknowns before this one."""
        place = {int(column): k for k, column in enumerate(source.columns[source.outlets])}
        passed = np.zeros((self.before.size, vectors.shape[1]))
        for k, column in enumerate(self.before.tolist()):
            if column in place:
                passed[k] = vectors[place[column]]
        return passed

    @np.errstate(over="ignore", invalid="ignore")  # a bound beyond all numbers proves nothing, as is found then
    def solve(self, sides: Found, earlier: Found, vectors: Array) -> tuple[Found, Array]:
        """The unknowns of the block, and the vectors of what their errors hand on."""
        remainders = sides.values - self._known @ earlier.values
        values = self._inverse @ remainders
        for _ in range(2):  # wins the last digits back
            values = values + self._inverse @ (remainders - self._matrix @ values)
        absolute_terms = self._sizes @ np.abs(values)
        rounded = self._slack * (absolute_terms + self._known_sizes @ np.abs(earlier.values) + np.abs(sides.values))
        residual = (np.abs(remainders - self._matrix @ values) + rounded + self._off @ np.abs(values) + sides.errors
                    + self._known_off @ (np.abs(earlier.values) + earlier.errors))
        shaken, lost = self._propagate_errors(vectors)
        up = 1 + float(_roundings(np.array(2 * values.size + vectors.shape[1])))  # of the sums that make a bound
        errors = self._errors(up * (self._far @ residual + np.abs(shaken).sum(axis=1) + lost) + MIN_BOUND, up)
        terms = self._far @ (absolute_terms + self._known_sizes @ earlier.sizes + sides.sizes)
        unknowns = Found(values, errors, self._cancelling_sizes(values, terms, earlier.sizes * self._known_scales))
        box = np.diag(up * (self._miss @ errors + lost) + MIN_BOUND)
        passed = np.hstack([shaken, self._inverse * (up * residual), box])[self.outlets]
        return unknowns, _enclosing_box(passed, self._scales[self.outlets])

    def _propagate_errors(self, vectors: Array) -> tuple[Array, Array]:
        """By how much the errors of earlier unknowns move those of the block, and the rounding of this."""
        rounding = _roundings(np.array(self.columns.size + self.before.size))
        lost = rounding * (self._far @ (np.abs(self._known) @ np.abs(vectors).sum(axis=1)))
        return self._inverse @ (self._known @ vectors), lost

    def _errors(self, least: Array, up: float) -> Array:
        """How far each unknown is off at most."""
        errors = least
        for _ in range(MAX_WIDENINGS):
            wider = WIDENING * errors
            errors = least + up * (self._miss @ wider)
            if np.all(errors < wider):
                return wider
        raise Unproven("the system is too near to a singular one for floats")

    def _cancelling_sizes(self, values: Array, terms: Array, known: Array) -> Array:
        """The size of what cancels in each unknown: its share of all terms, of which the unknowns are what is left.

        So what vanishes in a sound system counts beside what made it vanish, and a lost digit of a system near to a
        singular one, where all terms cancel, counts as lost.
        """
        whole, left = (float(np.max(part * self._scales, initial=0.0)) for part in (terms, np.abs(values)))
        left = max(left, float(np.max(known, initial=0.0)))  # and what they hang on
        return np.maximum(np.abs(values), terms * (min(left / whole, 1.0) if whole else 0.0))


def _enclosing_box(vectors: Array, scales: Array) -> Array:
    """As many vectors as unknowns, and a box for their rounding, of which the sums hold all sums of the given ones."""
    if not vectors.size:
        return vectors
    size, even = len(vectors), np.exp2(np.round(np.log2(scales)))[:, np.newaxis]  # powers of two round nothing
    scaled = vectors * even
    longest = np.argsort(-np.linalg.norm(scaled, axis=0), kind="stable")[:size]
    axes = np.linalg.qr(scaled[:, longest])[0]
    rounding, reach = _roundings(np.array(2 * sum(vectors.shape))), np.abs(scaled).sum(axis=1)
    along = np.abs(axes.T @ scaled).sum(axis=1) + rounding * (np.abs(axes.T) @ reach)
    askew = np.abs(np.eye(size) - axes @ axes.T) + rounding * (np.abs(axes) @ np.abs(axes.T) + np.eye(size))
    box = askew @ reach + rounding * (np.abs(axes) @ along)
    return np.hstack([axes * along, np.diag((1 + rounding) * box)]) / even


def _roundings(terms: NDArray[Any]) -> Array:
    """The relative error that a sum of so many products, and what is done with it, has at most."""
    return 1.01 * ROUNDOFF * (terms + 4.0)
