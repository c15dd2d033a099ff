"""Many poses by LAPACK: the analytic solver's own rows, filled with arrays of poses and solved as batches by numpy.

The matrices are filled once for both rates, so this rival is a little faster than the solver's own batches.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphplan.mechanism.model import Scene
from graphplan.solver.equations import moved
from graphplan.solver.rates import Rates, read

BLOCK = 2000  # poses, whose matrices take 7 MB


Points = Mapping[str, NDArray[np.complex128]]


def motion(scene: Scene, points: Points) -> dict[str, dict[str, NDArray[np.complex128]]]:
    """The velocities and accelerations of the points given, complex arrays of shape (n,)."""
    n = len(next(iter(points.values())))
    found = {kind: {name: np.empty(n, complex) for name in points} for kind in ("velocity", "acceleration")}
    for k in range(0, n, BLOCK):
        rates = block(scene, {name: z[k : k + BLOCK] for name, z in points.items()})
        for name in points:
            for kind, (x, y) in ("velocity", rates.velocity[name]), ("acceleration", rates.acceleration[name]):
                found[kind][name][k : k + BLOCK] = x + 1j * y
    return found


def block(scene: Scene, points: Points) -> Rates:
    """The rates over one block of poses: two batches of linear systems, velocities and then accelerations."""
    n = len(next(iter(points.values())))
    standing: dict[str, Any] = {name: (float(x), float(y)) for name, (x, y) in scene.points.items()}
    moving = {name: (z.real, z.imag) for name, z in points.items()}
    equations = moved(replace(scene, points=standing | moving))
    matrices = np.zeros((n, len(equations.facts), equations.width))
    for i, row in enumerate(equations.rows):
        for j, value in row.items():
            matrices[:, i, j] = value
    first = equations.rates(solved(matrices, equations.velocities), 0.0)
    second = equations.rates(solved(matrices, equations.accelerations(first)), 0.0)
    return read(equations, first, second)


def solved(matrices: NDArray[np.float64], right: Sequence[object]) -> list[Any]:
    """The unknowns, each of shape (n,), for a right-hand side of numbers and arrays."""
    sides = np.stack([np.broadcast_to(np.asarray(side, float), len(matrices)) for side in right], axis=1)
    return list(np.linalg.solve(matrices, sides[:, :, None])[:, :, 0].T)
