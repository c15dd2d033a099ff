"""The second opinion over many poses: the same equations filled with arrays, all systems solved at once by LAPACK.

A scene whose links are held just once has square systems, for the rates and for the forces. Where special geometry
makes conditions redundant they are solved by singular values.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from graphplan.mechanism.model import Drive, Number, Scene, Slide, SlidingDrive
from graphplan.solver import rates, statics
from graphplan.solver.elimination import transpose
from graphplan.solver.equations import Equations, Row
from graphplan.solver.facts import facts, supports
from graphplan.solver.loads import acting, resultants
from graphplan.solver.plane import dot

_ROUNDING = 2.0**-44
"""Below this part of the largest a singular value counts as zero."""


def posed(scene: Scene, points: Mapping[str, Any], guides: Mapping[str, Any]) -> Scene:
    """The scene in n poses at once: coordinates and directions that change are arrays of shape (n,).

    `points` gives them by name as complex arrays, `guides` the directions of slides that no two points give; complex
    numbers give the scene in one other pose.
    """
    def where(name: str) -> Any:
        return _pair(points[name]) if name in points else tuple(map(float, scene.points[name]))

    def direction(slide: Slide) -> Any:
        if slide.through is not None:
            (ax, ay), (bx, by) = map(where, slide.through)
            return bx - ax, by - ay
        return _pair(guides[slide.name]) if slide.name in guides else tuple(map(float, slide.direction))

    slides = tuple(replace(slide, direction=direction(slide)) for slide in scene.slides)
    drives = tuple(_in_floats(drive) for drive in scene.drives)
    return replace(scene, points={name: where(name) for name in scene.points}, slides=slides, drives=drives)


def _in_floats(drive: Drive) -> Drive:
    if isinstance(drive, SlidingDrive):
        return replace(drive, speed=float(drive.speed), acceleration=float(drive.acceleration))
    return replace(drive, omega=float(drive.omega), alpha=float(drive.alpha))


def solve(scene: Scene, n: int) -> rates.Rates:
    """The rates of a scene in n poses, as arrays of shape (n,); nan where a system has no solution."""
    equations = Equations(scene, facts(scene, _length))
    zero: Any = np.zeros(n)
    return rates.motion(equations, lambda right: _solved(equations.rows, right, n, equations.width), zero)


def reactions(scene: Scene, motion: rates.Rates, n: int) -> statics.Reactions:
    """The reactions and balances of a scene with loads in n poses, from its rates there, as arrays."""
    equations = Equations(scene, supports(scene))
    right = [-value for value in resultants(equations, acting(scene, motion))]
    values = _solved(transpose(equations.rows, equations.width), right, n, len(equations.facts))
    return statics.read(equations, statics.without(values, statics.repeating(equations)), motion)


def _length(slide: Slide) -> Any:
    """The length of a direction in all poses."""
    square: Any = dot(slide.direction, slide.direction)
    return np.sqrt(square)


def _solved(rows: Sequence[Row], right: Sequence[Number], n: int, width: int) -> Sequence[Any]:
    """The unknowns, each over all poses."""
    size = len(rows)
    matrix, sides = np.zeros((n, size, width)), np.empty((n, size, 1))
    for i, (row, side) in enumerate(zip(rows, right, strict=True)):
        sides[:, i, 0] = side
        for j, value in row.items():
            matrix[:, i, j] = value
    if size != width:
        return list(_shortest(matrix, sides)[:, :, 0].T)
    try:
        return list(np.linalg.solve(matrix, sides)[:, :, 0].T)
    except np.linalg.LinAlgError:
        return list(np.array([_alone(*pose) for pose in zip(matrix, sides, strict=True)])[:, :, 0].T)


def _shortest(matrix: Any, sides: Any) -> Any:
    """A solution by least squares in each pose, its columns and rows equilibrated; nan where the rank is too small."""
    columns = _lengths(matrix, 1)
    rows = _lengths(matrix / columns, 2)
    left, sigma, right = np.linalg.svd(matrix / columns / rows, full_matrices=False)
    regular = sigma[:, -1:] > _ROUNDING * sigma[:, :1]
    weights = np.divide(1.0, sigma, out=np.full_like(sigma, np.nan), where=regular)
    found = right.swapaxes(1, 2) @ (weights[:, :, None] * (left.swapaxes(1, 2) @ (sides / rows)))
    return found / columns.swapaxes(1, 2)


def _lengths(matrix: Any, axis: int) -> Any:
    """The lengths of the columns (axis 1) or rows (axis 2) in each pose, 1 in the place of 0."""
    lengths = np.linalg.norm(matrix, axis=axis, keepdims=True)
    return np.where(lengths > 0, lengths, 1.0)


def _alone(matrix: Any, side: Any) -> Any:
    """The solution in one pose, nan where there is none."""
    try:
        return np.linalg.solve(matrix, side)
    except np.linalg.LinAlgError:
        return np.full_like(side, np.nan)


def _pair(z: Any) -> Any:
    """Coordinates as arrays, or as floats where there is but one pose."""
    as_they_are = np.ascontiguousarray if np.ndim(z) else float
    return as_they_are(z.real), as_they_are(z.imag)
