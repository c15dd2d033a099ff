"""The unit of times: the equations of a whole mechanism as dense matrices, many poses at once solved by LAPACK.

What anybody with numpy would write. The rows are the solver's own; the matrices are filled once for both rates.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from graphplan.check.arithmetics import independent_facts
from graphplan.mechanism.elimination import transpose
from graphplan.mechanism.model import Scene
from graphplan.solver.equations import Row, held, moved
from graphplan.solver.rates import Rates, motion
from graphplan.solver.statics import Reactions, acting, read, repeating, resultants

BYTES = 8e6


def solve(alone: Scene, posed: Scene, n: int) -> Rates | Reactions:
    """The rates of a scene in n poses, and where it has loads its reactions, too; arrays of shape (n,).

    Reads the scene in one pose, which tells redundant conditions from others, and in n poses at once.
    """
    equations, kept = moved(posed, np.sqrt), independent_facts(moved(alone))
    solve = dense([equations.rows[i] for i in kept], equations.width, n)
    rates = motion(equations, lambda right: solve([right[i] for i in kept]), np.zeros(n))  # type: ignore[arg-type]
    if posed.loads is None:
        return rates
    forces, kept = held(posed), independent_facts(held(alone))
    right = [-value for value in resultants(forces, acting(posed, rates))]
    values = dict(zip(kept, dense(transpose([forces.rows[i] for i in kept], forces.width), len(kept), n)(right),
                      strict=True))
    return read(forces, [values.get(i, 0) for i in range(len(forces.facts))], repeating(forces), rates)


def dense(rows: Sequence[Row], width: int, n: int) -> Callable[[Sequence[Any]], list[Any]]:
    """What solves n systems for a right-hand side; coefficients and sides are numbers, or arrays of shape (n,)."""
    matrices = np.zeros((n, len(rows), width))
    for i, row in enumerate(rows):
        for j, value in row.items():
            matrices[:, i, j] = value

    def solved(right: Sequence[Any]) -> list[Any]:
        sides = np.empty((n, len(rows), 1))
        for i, side in enumerate(right):
            sides[:, i, 0] = side
        return list(np.linalg.solve(matrices, sides)[:, :, 0].T)

    return solved


def block(scene: Scene) -> int:
    """How many poses are solved at once: their matrices take a few megabytes, which was measured to be fastest."""
    return max(1, int(BYTES / (8 * moved(scene).width**2)))
