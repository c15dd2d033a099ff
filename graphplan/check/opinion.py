"""The second opinion between proven bounds: the solver's own equations, solved in enclosures.

Every scene that is read holds each link just once, so both systems, for the rates and for the forces, are square.
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
    return motion(equations, lambda right: _solved(equations.rows, right), zero)


def enclosed_reactions(scene: Scene, motion: Rates, besides: tuple[Load, ...] = ()) -> Reactions:
    """The reactions and balances in enclosures, of a scene with loads, of its rates, and with other loads `besides`."""
    from graphplan.solver.loads import acting, resultants  # what forces need is imported where there are loads
    from graphplan.solver.statics import read as read_forces

    equations = Equations(scene, supports(scene))
    right = [-value for value in resultants(equations, (*acting(scene, motion), *besides))]
    return read_forces(equations, _solved(transpose(equations.rows, equations.width), right), motion)


def _length(slide: Slide) -> Any:
    """The length of a direction, which is a root."""
    return Enclosure(dot(slide.direction, slide.direction)).root


def _solved(rows: Sequence[Mapping[int, Any]], right: Sequence[Any]) -> list[Any]:
    """The one solution of a square system."""
    size = len(rows)
    matrix = arb_mat(size, size, [ball(row.get(column, 0)) for row in rows for column in range(size)])
    try:
        solution = matrix.solve(arb_mat(size, 1, [ball(value) for value in right]))
    except ZeroDivisionError:
        raise Undecided("whether the equations have one solution cannot be told") from None
    return [Enclosure(solution[row, 0]) for row in range(size)]
