"""The second opinion between proven bounds: the solver's own equations, in numbers that know how far they may be off.

A scene whose links are held just once has square systems, for the rates and for the forces. Where special geometry
makes facts redundant, as many are kept as there are unknowns; that the others hold, too, is checked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from graphplan.check.arithmetics import Arithmetic
from graphplan.mechanism.model import Scene
from graphplan.mechanism.pairs.pair import Along, Statement
from graphplan.methods.kinds import ORDER
from graphplan.solver.elimination import transpose
from graphplan.solver.equations import Equations, held, moved
from graphplan.solver.rates import Rates, motion

if TYPE_CHECKING:
    from graphplan.solver.statics import Reactions


def bounded_rates(scene: Scene, by: Arithmetic) -> Rates:
    """The rates of a scene in numbers with bounds; fails where the pose may be singular as far as they tell."""
    equations = moved(scene, by.root)
    kept = _independent(equations)
    solve = by.solve([equations.rows[i] for i in kept], [1.0, 1.0, equations.reach] * len(equations.columns))
    return motion(equations, lambda right: _consistent(equations, right, kept, solve, by), by.lift(0))


def bounded_reactions(scene: Scene, motion: Rates, by: Arithmetic,
                      stated: Iterable[Statement] | None = None) -> Reactions:
    """The reactions and balances of a scene with loads, from its rates; of these facts, if not its own."""
    from graphplan.solver.loads import acting, resultants  # what forces need is imported where there are loads
    from graphplan.solver.statics import read as read_forces
    from graphplan.solver.statics import repeating, without

    equations = held(scene) if stated is None else Equations(scene, tuple(stated))
    right = [-value for value in resultants(equations, acting(scene, motion))]
    kept = _independent(equations)
    facts = [equations.facts[i] for i in kept]
    scales = [_length(fact.direction) if isinstance(fact, Along) else 1 / equations.reach for fact in facts]
    solve = by.solve(transpose([equations.rows[i] for i in kept], equations.width), scales)
    values = dict(zip(kept, solve(right), strict=True))
    told = without([values.get(i, 0) for i in range(len(equations.facts))], repeating(equations))
    return read_forces(equations, told, motion)


def _length(direction: Any) -> float:
    return math.hypot(*map(float, direction))


def _independent(equations: Equations) -> list[int]:
    """As many facts as there are unknowns, none following from others, in the order in which they are stated."""
    if len(equations.facts) == equations.width:
        return list(range(equations.width))
    from graphplan.solver.floating import independent

    return independent(equations)


def _consistent(equations: Equations, right: Sequence[Any], kept: Sequence[int],
                solve: Callable[[Sequence[Any]], list[Any]], by: Arithmetic) -> list[Any]:
    """The solution of the rows that are kept; fails where it certainly does not meet the others."""
    values = solve([right[i] for i in kept])
    for i in set(range(len(equations.rows))).difference(kept):
        left = sum((by.lift(value) * values[j] for j, value in equations.rows[i].items()), by.lift(0))
        if not left.overlaps(by.lift(right[i])):
            raise by.doubt("the redundant facts contradict the others")
    return values


def by_part(rates: Rates) -> dict[str, Any]:
    """The solver's rates, by the kinds of readings."""
    return {part: getattr(rates, part.replace(" ", "_")) for part in ORDER}


def plain_rates(rates: Rates, plain: Callable[[Any], Any]) -> Rates:
    """The rates in plain numbers."""
    def simple(value: Any) -> Any:
        return tuple(map(plain, value)) if isinstance(value, tuple) else plain(value)

    named: dict[str, Any] = {part.replace(" ", "_"): {name: simple(value) for name, value in values.items()}
                             for part, values in by_part(rates).items()}
    return replace(rates, **named)
