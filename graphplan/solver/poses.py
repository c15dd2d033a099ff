"""The second opinion over many poses: the same equations filled with arrays, each block solved at once by LAPACK.

A scene whose links are held just once has square systems, for the rates and for the forces. Where special geometry
makes conditions redundant they are solved by singular values. Numbers may know the size of what cancels in them, too.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from graphplan.mechanism.equations import transpose
from graphplan.mechanism.model import Balance, Force, Scene
from graphplan.mechanism.numbers import map_numbers
from graphplan.mechanism.order import with_values
from graphplan.mechanism.pairs.pair import Along
from graphplan.solver import rates, statics
from graphplan.solver.friction import sign
from graphplan.solver.linear import Block, Row, blocks, by_blocks
from graphplan.solver.rates import Equations, force_equations, motion_equations
from graphplan.solver.statics import pushes
from graphplan.solver.tolerances import POSE_SINGULAR_TOL, SLIP_TOL

MAX_BLOCK = 24  # unknowns that one dense block has at most: over many poses small blocks cost no more than their sum


class Sized:
    """Numbers over n poses with the sizes of their terms, which are their own at least."""

    __slots__ = ("size", "value")
    __array_ufunc__ = None  # numpy's own numbers leave the arithmetic to this class

    def __init__(self, value: Any, size: Any = None):
        self.value, self.size = value, np.abs(value) if size is None else size

    def fill_missing(self, other: Sized) -> Sized:
        """Return the numbers with nan replaced by others."""
        missing = np.isnan(self.value)
        return Sized(np.where(missing, other.value, self.value), np.where(missing, other.size, self.size))

    def __abs__(self) -> Sized:
        return Sized(np.abs(self.value), self.size)

    def __neg__(self) -> Sized:
        return Sized(-self.value, self.size)

    def __add__(self, other: Any) -> Sized:
        two = with_size(other)
        return Sized(self.value + two.value, self.size + two.size)

    def __sub__(self, other: Any) -> Sized:
        return self + -with_size(other)

    def __rsub__(self, other: Any) -> Sized:
        return with_size(other) + -self

    def __mul__(self, other: Any) -> Sized:
        two = with_size(other)
        size = np.maximum(np.abs(self.value) * two.size, np.abs(two.value) * self.size)
        return Sized(self.value * two.value, size)

    def __truediv__(self, other: Any) -> Sized:
        two = with_size(other)
        with np.errstate(divide="ignore", invalid="ignore"):  # in a pose where it divides by nothing it is not a number
            value, least = self.value / two.value, np.abs(two.value)
            return Sized(value, np.maximum(self.size, np.abs(value) * two.size) / least)

    __radd__, __rmul__ = __add__, __mul__


def sense(number: Sized, scale: Any) -> Any:
    """The sense of a rate or a force in each pose, 1 or -1, at any `scale`; 0 if it may be rounding of what cancels."""
    return sign(number.value, SLIP_TOL * number.size)


def with_size(number: Any) -> Sized:
    """A number, or an array of them, as it is given."""
    return number if isinstance(number, Sized) else Sized(np.asarray(number, dtype=float))


def scene_in_poses(scene: Scene, points: Mapping[str, Any], guides: Mapping[str, Any],
                   loads: Mapping[str, Any] | None = None) -> Scene:
    """The scene in n poses at once: coordinates and directions that change are arrays of shape (n,).

    `points` gives them by name as complex arrays, `guides` the directions of pairs that no two points give; complex
    numbers give the scene in one other pose. `loads` are those that change, by their letters: forces as complex arrays.
    """
    def place_of(name: str) -> Any:
        return _pair(points[name]) if name in points else tuple(map(float, scene.points[name]))

    def direction(pair: Any) -> Any:
        if pair.through is not None:
            (ax, ay), (bx, by) = map(place_of, pair.through)
            return bx - ax, by - ay
        return _pair(guides[pair.name]) if pair.name in guides else tuple(map(float, pair.direction))

    driven = scene.with_drives(drive.driven_at(*map(float, drive.rates)) for drive in scene.drives)
    acting = map_numbers(scene.loads, float)
    if loads:
        acting = with_values(acting, {name: _pair(z) if np.iscomplexobj(z) else z for name, z in loads.items()})
    places = {name: place_of(name) for name in scene.points}
    return replace(driven, loads=acting).with_pose(
        places, lambda pair: pair.direction if isinstance(pair, Balance) else direction(pair), float)


def solve(scene: Scene, n: int, sizes: bool = False) -> rates.Rates:
    """The rates of a scene in n poses, as arrays of shape (n,); nan where a system has no solution.

    With `sizes` they are arrays that know the size of what cancels in them.
    """
    equations = motion_equations(scene, np.sqrt)
    scales = [1.0, 1.0, _reach(equations)] * len(equations.columns) + [1.0, 1.0] * len(equations.pins)
    system = by_blocks(equations.rows, blocks(equations.rows, equations.width, MAX_BLOCK),
                       partial(_ready, n, np.array(scales), sizes))
    return rates.motion(equations, system, Sized(np.zeros(n)) if sizes else np.zeros(n))  # type: ignore[arg-type]


def reactions(scene: Scene, motion: rates.Rates, n: int, sizes: bool = False) -> statics.Reactions:
    """The reactions and balances of a scene with loads in n poses, from its rates there, as arrays as those are."""
    equations = replace(force_equations(scene), root=np.sqrt)
    scales = [1.0 if isinstance(fact, Along) else 1 / _reach(equations) for fact in equations.facts]
    blocked = [block.transpose for block in reversed(blocks(equations.rows, equations.width, MAX_BLOCK))]
    system = by_blocks(transpose(equations.rows, equations.width), blocked, partial(_ready, n, np.array(scales), sizes))

    def solve(more: Iterable[Force] = ()) -> statics.Reactions:
        right = [-value for value in statics.resultants(equations, (*statics.acting(scene, motion), *more))]
        return statics.read(equations, system(right), statics.repeating(equations), motion)

    smooth = solve()
    apart = tuple(pushes(equations, smooth.higher))
    return solve(apart) if apart else smooth


def _reach(equations: Equations) -> float:
    """The longest coordinate of an arm in any pose, or 1 where every arm vanishes."""
    coordinates = (np.max(np.abs(np.asarray(coordinate, float))) for arm in equations.arms for coordinate in arm)
    return max(map(float, coordinates), default=0.0) or 1.0


def _ready(n: int, scales: Any, sizes: bool, block: Block, rows: Sequence[Row]) -> Callable[..., Sequence[Any]]:
    """Return what solves a block in n poses: as arrays, or with `sizes` as arrays that know what cancels in them."""
    matrix = np.zeros((n, len(rows), len(block.columns)))
    for i, row in enumerate(rows):
        for j, value in row.items():
            matrix[:, i, j] = value
    square = len(rows) == len(block.columns)
    if not sizes:
        solve = np.linalg.solve if square else _shortest
        return lambda sides, known: [*_everywhere(solve, matrix, _stack(sides, n))[:, :, 0].T]
    inverse = (_everywhere(np.linalg.inv, matrix) if square
               else _shortest(matrix, np.broadcast_to(np.eye(len(rows)), (n, len(rows), len(rows)))))
    return partial(_sized_unknowns, matrix, inverse, scales, [*block.columns])


def _stack(sides: Iterable[Any], n: int) -> Any:
    """Return right-hand sides as columns, shape (n, rows, 1)."""
    return np.stack([np.broadcast_to(np.asarray(side, float), n) for side in sides], axis=1)[:, :, np.newaxis]


def _sized_unknowns(matrix: Any, inverse: Any, scales: Any, columns: list[int], sides: Sequence[Any],
                    known: Mapping[int, Sized]) -> list[Sized]:
    """Return unknowns with the size of what cancels in each: its share of all terms, of which the unknowns are left.

    The `known` unknowns, on which they depend, are left as well.
    """
    n = len(matrix)
    known_size = np.max([np.zeros(n), *(scales[j] * value.size for j, value in known.items())], axis=0)
    right = _stack((with_size(side).value for side in sides), n)
    values = inverse @ right
    values += inverse @ (right - matrix @ values)  # wins the last digits back
    magnitudes = np.abs(values)
    terms = np.abs(inverse) @ (np.abs(matrix) @ magnitudes + _stack((with_size(side).size for side in sides), n))
    whole, most = (np.max(numbers * scales[columns, np.newaxis], axis=1, keepdims=True, initial=0.0)
                   for numbers in (terms, magnitudes))
    left = np.maximum(most, known_size[:, np.newaxis, np.newaxis])
    cancelling = np.maximum(magnitudes, terms * np.minimum(left / np.where(whole > 0, whole, 1.0), 1.0))
    return [Sized(value, size) for value, size in zip(values[:, :, 0].T, cancelling[:, :, 0].T, strict=True)]


def _shortest(matrix: Any, sides: Any) -> Any:
    """A solution by least squares in each pose, its columns and rows equilibrated; nan where the rank is too small."""
    columns = _lengths(matrix, 1)
    rows = _lengths(matrix / columns, 2)
    U, sigma, Vt = np.linalg.svd(matrix / columns / rows, full_matrices=False)
    regular = sigma[:, -1:] > POSE_SINGULAR_TOL * sigma[:, :1]
    weights = np.divide(1.0, sigma, out=np.full_like(sigma, np.nan), where=regular)
    solution = Vt.swapaxes(1, 2) @ (weights[:, :, None] * (U.swapaxes(1, 2) @ (sides / rows)))
    return solution / columns.swapaxes(1, 2)


def _lengths(matrix: Any, axis: int) -> Any:
    """The lengths of the columns (axis 1) or rows (axis 2) in each pose, 1 instead of 0."""
    lengths = np.linalg.norm(matrix, axis=axis, keepdims=True)
    return np.where(lengths > 0, lengths, 1.0)


def _everywhere(solve: Callable[..., Any], *systems: Any) -> Any:
    """Solve by LAPACK in every pose, or in one; nan for a singular pose."""
    try:
        return solve(*systems)
    except np.linalg.LinAlgError:
        if np.ndim(systems[0]) == 2:
            return np.full_like(systems[-1], np.nan)
        return np.array([_everywhere(solve, *pose) for pose in zip(*systems, strict=True)])


def _pair(z: Any) -> Any:
    """Coordinates as arrays, or as floats where there is but one pose."""
    as_they_are = np.ascontiguousarray if np.ndim(z) else float
    return as_they_are(z.real), as_they_are(z.imag)
