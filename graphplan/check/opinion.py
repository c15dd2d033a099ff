"""The second opinion between proven bounds: the solver's own equations, solved in enclosures.

A scene whose links are held just once has square systems, for the rates and for the forces. Where special geometry
makes facts redundant, as many are kept as there are unknowns; that the others hold, too, is checked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from flint import arb_mat

from graphplan.kernel.numbers.enclosures import Enclosure, Undecided, ball
from graphplan.mechanism.model import Scene, Slide
from graphplan.solver.elimination import transpose
from graphplan.solver.equations import Equations
from graphplan.solver.facts import facts, supports
from graphplan.solver.plane import dot
from graphplan.solver.rates import Rates, motion

if TYPE_CHECKING:
    from graphplan.solver.loads import Load
    from graphplan.solver.statics import Reactions


def enclosed_rates(scene: Scene) -> Rates:
    """The rates of a scene in enclosures; `Undecided` where the pose is singular as far as the bits tell."""
    equations = Equations(scene, facts(scene, _length))
    zero: Any = Enclosure(0)
    kept = _independent(equations)
    return motion(equations, lambda right: _consistent(equations.rows, right, kept), zero)


def enclosed_reactions(scene: Scene, motion: Rates, besides: tuple[Load, ...] = ()) -> Reactions:
    """The reactions and balances in enclosures, of a scene with loads, of its rates, and with other loads `besides`."""
    from graphplan.solver.loads import acting, resultants  # what forces need is imported where there are loads
    from graphplan.solver.statics import read as read_forces
    from graphplan.solver.statics import repeating, without

    equations = Equations(scene, supports(scene))
    right = [-value for value in resultants(equations, (*acting(scene, motion), *besides))]
    kept = _independent(equations)
    values = dict(zip(kept, _solved(transpose([equations.rows[i] for i in kept], equations.width), right), strict=True))
    told = without([values.get(i, 0) for i in range(len(equations.facts))], repeating(equations))
    return read_forces(equations, told, motion)


def _length(slide: Slide) -> Any:
    """The length of a direction, which is a root."""
    return Enclosure(dot(slide.direction, slide.direction)).root


def _independent(equations: Equations) -> list[int]:
    """As many facts as there are unknowns, none following from others, in the order in which they are stated."""
    if len(equations.facts) == equations.width:
        return list(range(equations.width))
    from graphplan.solver.floating import independent

    return independent(equations)


def _consistent(rows: Sequence[Mapping[int, Any]], right: Sequence[Any], kept: Sequence[int]) -> list[Any]:
    """The solution of the rows that are kept; `Undecided` where it certainly does not meet the others."""
    values = _solved([rows[i] for i in kept], [right[i] for i in kept])
    for i in set(range(len(rows))).difference(kept):
        left = sum((Enclosure(value) * values[j] for j, value in rows[i].items()), Enclosure(0))
        if not left.overlaps(Enclosure(right[i])):
            raise Undecided("the redundant facts contradict the others")
    return values


def _solved(rows: Sequence[Mapping[int, Any]], right: Sequence[Any]) -> list[Any]:
    """The one solution of a square system."""
    size = len(rows)
    matrix = arb_mat(size, size, [ball(row.get(column, 0)) for row in rows for column in range(size)])
    try:
        solution = matrix.solve(arb_mat(size, 1, [ball(value) for value in right]))
    except ZeroDivisionError:
        raise Undecided("whether the equations have one solution cannot be told") from None
    return [Enclosure(solution[row, 0]) for row in range(size)]
