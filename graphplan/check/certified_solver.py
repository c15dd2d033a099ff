"""The rates between proven bounds: the solver's own equations, in numbers that know how far they may be off.

A scene whose links are held just once has a square system. Where special geometry makes facts redundant, as many are
kept as there are unknowns; that the others hold, too, is checked.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from graphplan.check.arithmetics import Bounds
from graphplan.mechanism.model import Scene
from graphplan.solver.equations import Equations, moved
from graphplan.solver.rates import Rates, motion


def bounded_rates(scene: Scene, by: Bounds) -> Rates:
    """The rates of a scene in numbers with bounds; fails where the pose may be singular as far as they tell."""
    equations = moved(scene, by.root)
    kept = independent_facts(equations)
    solve = by.solve([equations.rows[i] for i in kept], [1.0, 1.0, equations.reach] * len(equations.columns))
    return motion(equations, lambda right: _consistent(equations, right, kept, solve, by), by.lift(0))


def independent_facts(equations: Equations) -> list[int]:
    """As many facts as there are unknowns, none following from others, in the order in which they are stated."""
    if len(equations.facts) == equations.width:
        return list(range(equations.width))
    from graphplan.solver.floating import independent

    return independent(equations.rows, equations.width, equations.reach)


def _consistent(equations: Equations, right: Sequence[Any], kept: Sequence[int],
                solve: Callable[[Sequence[Any]], list[Any]], by: Bounds) -> list[Any]:
    """The solution of the rows that are kept; fails where it certainly does not meet the others."""
    values = solve([right[i] for i in kept])
    for i in set(range(len(equations.rows))).difference(kept):
        left = sum((by.lift(value) * values[j] for j, value in equations.rows[i].items()), by.lift(0))
        if not left.overlaps(by.lift(right[i])):
            raise by.doubt("the redundant facts contradict the others")
    return values
