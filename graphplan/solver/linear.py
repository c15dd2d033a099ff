"""Sparse linear systems: their blocks, and their solution in floats with proven bounds.

The rows of a mechanism say in which order they determine their unknowns: block by block, each from those before
(Duff and Reid 1978). Each unknown is matched with a row; it then depends on the other unknowns of its row, and those
that depend on each other in a ring are a block. A row that is left over, as special geometry makes them, ties its
unknowns into one block.

With an approximate inverse R of the matrix A, the error e of an approximate solution x is, by components, at most
|R| |b - A x| + |I - R A| e (S. M. Rump, Acta Numerica 19 (2010), 10). Any weights w with |I - R A| w < w prove that A
has an inverse, that is that the pose is regular, and bound e. Every rounding is in it, those of the coefficients and
of the proof itself. A usual linkage is solved before numpy would be loaded.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from operator import add, mul
from typing import Any, NamedTuple

from graphplan.mechanism.equations import matching, rings, transpose
from graphplan.mechanism.numbers import heading as exact_heading
from graphplan.solver.tolerances import MARGIN, ROUNDOFF

Row = Mapping[int, Any]
Vector = Sequence[float]

MAX_BLOCK = 64  # unknowns that one dense block has at most, where it is no ring of more: some twenty links
MISS_WEIGHT = 8  # |I - R A| w is so many times added to weights w: of the sum it is then little more than 1/8
MAX_UNKNOWNS = 36  # of a system that Python solves: more take some milliseconds, and numpy far less


# ---- blocks ----------------------------------------------------------------------------------------------------------


class Block(NamedTuple):
    """Rows, and the columns that they determine when those of the blocks before are known."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]

    @property
    def transpose(self) -> Block:
        """The block of the transposed system, where the blocks follow each other the other way."""
        return Block(self.columns, self.rows)


def blocks(rows: Sequence[Row], width: int, together: int = MAX_BLOCK) -> list[Block]:
    """Return the blocks of a system, one after the other, small ones joined up to `together` unknowns."""
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


def _rings(rows: Sequence[Row], width: int) -> Iterator[tuple[int, ...]]:
    """Yield the columns that depend on each other, each ring after all that it depends on."""
    owner = matching([tuple(row) for row in rows])
    depends: dict[int, list[int]] = {column: [] for column in range(width)}
    for column, i in owner.items():
        depends[column] += (neighbour for neighbour in rows[i] if neighbour != column)
    for i in set(range(len(rows))).difference(owner.values()):
        for column in rows[i]:
            depends[column] += (neighbour for neighbour in rows[i] if neighbour != column)
    return rings(depends)


def by_blocks(rows: Sequence[Row], system_blocks: Sequence[Block],
              ready: Callable[[Block, Sequence[Row]], Callable[..., Sequence[Any]]]
              ) -> Callable[[Sequence[Any]], list[Any]]:
    """Return what solves a system for a right-hand side, in any numbers, by what is made `ready` for each block.

    That reads the block's sides, with what earlier unknowns add to them, and the earlier unknowns by column.
    """
    prepared = []
    for block in system_blocks:
        local = {column: k for k, column in enumerate(block.columns)}
        earlier_terms = [[(j, value) for j, value in rows[i].items() if j not in local] for i in block.rows]
        local_rows = [{local[j]: value for j, value in rows[i].items() if j in local} for i in block.rows]
        prepared.append((block, earlier_terms, ready(block, local_rows)))

    def solve(right: Sequence[Any]) -> list[Any]:
        values: dict[int, Any] = {}
        for block, earlier_terms, solve_block in prepared:
            sides = [sum((-(value * values[j]) for j, value in terms), right[i])
                     for i, terms in zip(block.rows, earlier_terms, strict=True)]
            known = {j: values[j] for terms in earlier_terms for j, _ in terms}
            values.update(zip(block.columns, solve_block(sides, known), strict=True))
        return [values[column] for column in range(len(values))]

    return solve


# ---- floats with bounds ----------------------------------------------------------------------------------------------


class Unproven(ArithmeticError):
    """Raised where floats cannot prove a result: for example a divisor that may be zero, or a matrix without an
    inverse."""


class Bounded:
    """A float with the bound of its error; `size` is the size of the terms that it is made of, and its own at least."""

    __slots__ = ("error", "size", "value")

    def __init__(self, value: float, error: float = 0.0, size: float = 0.0):
        self.value, self.error, self.size = value, error, size or abs(value)

    def __repr__(self) -> str:
        return f"{self.value!r} ± {self.error:.2g}"

    def __float__(self) -> float:
        return self.value

    def __neg__(self) -> Bounded:
        return Bounded(-self.value, self.error, self.size)

    def __abs__(self) -> Bounded:
        return Bounded(abs(self.value), self.error, self.size)

    def __add__(self, other: Any) -> Bounded:
        two = other if type(other) is Bounded else bounded_number(other)
        if not two.size:
            return self
        value = self.value + two.value
        return Bounded(value, MARGIN * (self.error + two.error + ROUNDOFF * abs(value)), self.size + two.size)

    def __sub__(self, other: Any) -> Bounded:
        return self + -bounded_number(other)

    def __rsub__(self, other: Any) -> Bounded:
        return bounded_number(other) + -self

    def __mul__(self, other: Any) -> Bounded:
        two = other if type(other) is Bounded else bounded_number(other)
        if two.value in (0.0, 1.0, -1.0) and not two.error:
            return Bounded(self.value * two.value, self.error * abs(two.value), self.size * abs(two.value))
        value, a, b = self.value * two.value, abs(self.value), abs(two.value)
        error = a * two.error + b * self.error + self.error * two.error + ROUNDOFF * abs(value)
        return Bounded(value, MARGIN * error, max(a * two.size, b * self.size))

    def __truediv__(self, other: Any) -> Bounded:
        two = other if type(other) is Bounded else bounded_number(other)
        least = abs(two.value) - two.error
        if not least > 0:
            raise Unproven("a divisor may be zero")
        value = self.value / two.value
        error = (self.error + abs(value) * two.error) / least + ROUNDOFF * abs(value)
        return Bounded(value, MARGIN * error, max(self.size, abs(value) * two.size) / abs(two.value))

    def __rtruediv__(self, other: Any) -> Bounded:
        return bounded_number(other) / self

    __radd__, __rmul__ = __add__, __mul__

    def __pow__(self, power: int) -> Bounded:
        return math.prod([self] * (power - 1), start=self)

    def __eq__(self, other: object) -> bool:
        """Whether the two are known to be one number."""
        two = bounded_number(other)
        return self.value == two.value and not (self.error or two.error)

    def __bool__(self) -> bool:
        """Whether it is not known to be zero."""
        return bool(self.value or self.error)

    def __ge__(self, other: Any) -> bool:
        """Whether it may be so."""
        two = bounded_number(other)
        return self.value + self.error >= two.value - two.error

    def __lt__(self, other: Any) -> bool:
        return not self >= other

    def __hash__(self) -> int:
        return hash((self.value, self.error))

    @property
    def root(self) -> Bounded:
        """The square root of a number that is known not to be negative."""
        if self.value <= self.error:
            most = math.sqrt(max(self.value, 0.0) + self.error) * MARGIN
            return Bounded(most / 2, most / 2, most)
        value = math.sqrt(self.value)
        return Bounded(value, MARGIN * (self.error / value + ROUNDOFF * value), max(value, self.size / (2 * value)))

    def overlaps(self, other: Bounded) -> bool:
        """Whether the two may be one number."""
        return abs(self.value - other.value) <= MARGIN * (self.error + other.error)


def bounded_number(number: Any) -> Bounded:
    """A whole number or fraction, rounded to a float, or a float as the binary fraction that it is."""
    if type(number) is Bounded:
        return number
    if not isinstance(number, Fraction):
        return Bounded(float(number))
    whole = number.as_integer_ratio()
    value = whole[0] / whole[1]
    return Bounded(value) if value.as_integer_ratio() == whole else Bounded(value, MARGIN * ROUNDOFF * abs(value))


PI = Bounded(math.pi, 2.0**-52)


def heading(degrees: Fraction) -> tuple[Bounded, Bounded]:
    """Cosine and sine of an angle in degrees: each is within four roundings of one."""
    return tuple(Bounded(float(coordinate), 4 * ROUNDOFF) for coordinate in exact_heading(degrees)[:2])  # type: ignore[return-value]


# ---- systems of them -------------------------------------------------------------------------------------------------


def small_inverse(matrix: Sequence[Row]) -> tuple[Any, Any, Any]:
    """Return R, the inverse by elimination with the largest entry of each column (Gauss and Jordan), |R| and |I - R A|.

    Raises `Unproven` where a column has no entry left.
    """
    width = len(matrix)
    rows = [[float(row.get(j, 0.0)) for j in range(width)] + [float(i == j) for j in range(width)]
            for i, row in enumerate(matrix)]
    for k in range(width):
        largest = max(range(k, width), key=lambda i: abs(rows[i][k]))
        rows[k], rows[largest] = rows[largest], rows[k]
        if not (pivot := rows[k][k]):
            raise Unproven("the matrix has no inverse in floats")
        leading = rows[k] = [value / pivot for value in rows[k]]
        for i, row in enumerate(rows):
            if i != k and (factor := row[k]):
                rows[i] = [value - factor * lead for value, lead in zip(row, leading, strict=True)]
    inverse, columns = [row[width:] for row in rows], [[*column.items()] for column in transpose(matrix, width)]
    gap = [[abs(sum([row[k] * value for k, value in column]) - (i == j)) for j, column in enumerate(columns)]
           for i, row in enumerate(inverse)]
    return inverse, [[*map(abs, row)] for row in inverse], gap


def large_inverse(matrix: Sequence[Row]) -> tuple[Any, Any, Any]:
    """Return R, the inverse of a sparse square matrix A by its blocks, |R| and |I - R A|.

    Raises `Unproven` where a block is singular.
    """
    import numpy as np  # a small system does without it

    inverse = np.zeros((len(matrix), len(matrix)))
    for block in blocks(matrix, len(matrix)):
        place = {column: k for k, column in enumerate(block.columns)}
        square, sides = np.zeros((len(block.rows), len(place))), np.zeros((len(block.rows), len(matrix)))
        for k, i in enumerate(block.rows):
            sides[k, i] = 1.0
            for j, value in matrix[i].items():
                if j in place:
                    square[k, place[j]] = value
                else:
                    sides[k] -= value * inverse[j]
        try:
            inverse[[*block.columns]] = np.linalg.solve(square, sides)
        except np.linalg.LinAlgError:
            raise Unproven("the matrix has no inverse in floats") from None
    by_columns = np.ascontiguousarray(inverse.T)
    gap = np.array([np.array([*column.values()]) @ by_columns[[*column]] for column in transpose(matrix, len(matrix))])
    gap.flat[:: len(matrix) + 1] -= 1.0
    return inverse, np.abs(inverse), np.abs(gap, out=gap).T


def times(matrix: Any, vector: Vector) -> list[float]:
    """Return a dense matrix, a list of rows or an array, times a vector."""
    if isinstance(matrix, list):
        return [sum(map(mul, row, vector)) for row in matrix]
    return matrix.dot(vector).tolist()  # type: ignore[no-any-return]


class BoundedSystem:
    """A square system made ready for any right-hand sides; `scales` make its unknowns comparable.

    Raises `Unproven` unless the matrix is proven to have an inverse: |I - R A| times the weights is less than these.
    The weights grow with the unknowns' errors, as |R| times the terms of the rows does, and what it misses of them.
    """

    def __init__(self, rows: Sequence[Row], scales: Vector):
        if len(rows) != len(scales):
            raise Unproven("the system is not square")
        entries = [{j: bounded_number(number) for j, number in row.items()} for row in rows]
        self._scales = [*map(float, scales)]
        self._rows = [{j: number.value for j, number in row.items()} for row in entries]
        self._sizes = [{j: abs(number.value) + number.error for j, number in row.items()} for row in entries]
        self._errors = [{j: number.error for j, number in row.items() if number.error} for row in entries]
        self._slack = [_rounding(len(row)) for row in rows]
        self._up = 1 + _rounding(2 * len(rows))  # times the sums that make a bound
        invert = small_inverse if len(rows) <= MAX_UNKNOWNS else large_inverse
        self._inverse, self._far, self._gap = invert(self._rows)
        columns = Counter(j for row in rows for j in row)
        self._column_slack = [_rounding(columns[j]) for j in range(len(rows))]
        weights = times(self._far, product(self._sizes, [1 / scale for scale in self._scales]))
        self._weights = [weight + MISS_WEIGHT * miss for weight, miss in zip(weights, self._bounded_miss(weights),
                                                                             strict=True)]
        self._miss = self._bounded_miss(self._weights)
        self._share = self._largest(self._miss)
        if not self._share < 1:
            raise Unproven("the system is too near to a singular one for floats")

    def _bounded_miss(self, vector: Vector) -> Vector:
        """Return no less than |I - R A| times a vector."""
        rounded = [*map(mul, self._column_slack, vector)]
        doubt = map(add, product(self._sizes, rounded), product(self._errors, vector))
        return [self._up * (gap + far + near) for gap, far, near in zip(
            times(self._gap, vector), times(self._far, [*doubt]), rounded, strict=True)]

    def _largest(self, errors: Vector) -> float:
        """Return the largest ratio of errors to the weights; infinite where a weight is no positive number."""
        return self._up * max((error / weight if 0 < weight < math.inf else math.inf
                               for error, weight in zip(errors, self._weights, strict=True)), default=0.0)

    def solve(self, right: Sequence[Any]) -> list[Bounded]:
        """Return the unknowns."""
        sides = [*map(bounded_number, right)]
        values = times(self._inverse, [side.value for side in sides])
        for _ in range(2):  # wins the last digits back
            values = [value + more for value, more in zip(values, times(self._inverse, self._remainders(sides, values)),
                                                          strict=True)]
        lengths = [*map(abs, values)]
        terms = product(self._sizes, lengths)
        residual = [abs(remainder) + slack * (term + abs(side.value)) + doubt + side.error
                    for remainder, slack, term, doubt, side in zip(
                        self._remainders(sides, values), self._slack, terms, product(self._errors, lengths), sides,
                        strict=True)]
        least = [self._up * error for error in times(self._far, residual)]
        factor = self._up * self._largest(least) / (1 - self._share)
        if not factor < math.inf:
            raise Unproven("a bound is beyond all numbers")
        errors = [self._up * (error + factor * miss) for error, miss in zip(least, self._miss, strict=True)]
        errors = [self._up * error for error in map(add, least, self._bounded_miss(errors))]  # tightens the small ones
        cancelling = times(self._far, [term + side.size for term, side in zip(terms, sides, strict=True)])
        return [*map(Bounded, values, errors, self._cancelling_sizes(lengths, cancelling))]

    def _remainders(self, sides: Sequence[Bounded], values: Vector) -> list[float]:
        return [side.value - total for side, total in zip(sides, product(self._rows, values), strict=True)]

    def _cancelling_sizes(self, lengths: Vector, terms: Vector) -> Iterable[float]:
        """Return the size of what cancels in each unknown: its share of all terms, of which the unknowns are left.

        So what vanishes in a sound system counts beside what made it vanish, and a lost digit of a system near to a
        singular one, where all terms cancel, counts as lost.
        """
        whole, left = (max(map(mul, part, self._scales), default=0.0) for part in (terms, lengths))
        share = min(left / whole, 1.0) if whole else 0.0
        return (max(length, share * term) for length, term in zip(lengths, terms, strict=True))


def product(rows: Sequence[Row], vector: Vector) -> list[float]:
    """Return a sparse matrix times a vector."""
    return [sum([value * vector[j] for j, value in row.items()]) for row in rows]


def _rounding(terms: int) -> float:
    """Return the relative error that a sum of so many products, and what is done with it, has at most."""
    return 1.01 * ROUNDOFF * (terms + 4.0)
