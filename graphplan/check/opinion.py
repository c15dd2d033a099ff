"""The second opinion between proven bounds: the solver's own equations, solved in enclosures.

Every scene that is read holds each link just once, so both systems, for the rates and for the forces, are square.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from flint import arb_mat

from graphplan.kernel.numbers.enclosures import Enclosure, Undecided, ball
from graphplan.mechanism.model import Scene, TurningDrive
from graphplan.solver.elimination import transpose
from graphplan.solver.equations import Equations
from graphplan.solver.facts import Along, Fact, facts, supports
from graphplan.solver.plane import dot, times
from graphplan.solver.rates import Rates, read

if TYPE_CHECKING:
    from graphplan.solver.loads import Load
    from graphplan.solver.statics import Reactions


def enclosed_rates(scene: Scene) -> Rates:
    """The rates of a scene in enclosures; `Undecided` where the pose is singular as far as the bits tell."""
    equations = Equations(scene, tuple(_facts(scene)))
    zero: Any = Enclosure(0)
    first = equations.rates(_solved(equations.rows, equations.velocities), zero)
    second = equations.rates(_solved(equations.rows, equations.accelerations(first)), zero)
    return read(equations, first, second)


def enclosed_reactions(scene: Scene, motion: Rates, besides: tuple[Load, ...] = ()) -> Reactions:
    """The reactions and balances in enclosures, of a scene with loads, of its rates, and with other loads `besides`."""
    from graphplan.solver.loads import acting, resultants  # what forces need is imported where there are loads
    from graphplan.solver.statics import read as read_forces

    equations = Equations(scene, supports(scene))
    right = [-value for value in resultants(equations, (*acting(scene, motion), *besides))]
    return read_forces(equations, _solved(transpose(equations.rows, equations.width), right), motion)


def _facts(scene: Scene) -> Iterator[Fact]:
    """The scene's facts; an actuator's speed counts along a direction whose length is a root."""
    turning = tuple(drive for drive in scene.drives if isinstance(drive, TurningDrive))
    yield from facts(replace(scene, drives=turning))
    for drive in scene.drives:
        if not isinstance(drive, TurningDrive):
            slide = next(s for s in scene.slides if (s.link, s.along) == (drive.link, drive.along))
            length: Any = Enclosure(dot(slide.direction, slide.direction)).root
            rate, change = times(length, (drive.speed, drive.acceleration))
            yield Along(slide.link, slide.along, slide.at, slide.direction, rate, change)


def _solved(rows: Sequence[Mapping[int, Any]], right: Sequence[Any]) -> list[Any]:
    """The one solution of a square system."""
    size = len(rows)
    matrix = arb_mat(size, size, [ball(row.get(column, 0)) for row in rows for column in range(size)])
    try:
        solution = matrix.solve(arb_mat(size, 1, [ball(value) for value in right]))
    except ZeroDivisionError:
        raise Undecided("whether the equations have one solution cannot be told") from None
    return [Enclosure(solution[row, 0]) for row in range(size)]
