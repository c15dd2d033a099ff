"""A scene's equations made ready in floats or in fractions: for the rates or, transposed, for the forces."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain
from typing import Protocol

from graphplan.errors import Refused, by_name
from graphplan.mechanism.model import Number, Scene
from graphplan.solver.elimination import Elimination, transpose
from graphplan.solver.equations import Equations


class Linear(Protocol):
    """A linear system made ready once, over floats or over fractions."""

    @property
    def free(self) -> frozenset[int]:
        """The columns that it leaves undetermined."""

    def solve(self, right: Sequence[Number]) -> Sequence[Number] | None:
        """A solution, or None where there is none."""

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """The rows that contradict each other."""


def for_rates(equations: Equations, exact: bool) -> Linear:
    """The rates of every link are unknown: three columns a link, one row a fact."""
    return _prepared(equations, exact, forces=False)


def for_forces(equations: Equations, exact: bool) -> Linear:
    """What holds every fact is unknown: one column a fact, the three equilibrium conditions of each link as rows."""
    return _prepared(equations, exact, forces=True)


def _prepared(equations: Equations, exact: bool, forces: bool) -> Linear:
    if exact:
        require_fractions(equations.scene, numbers(equations))
        columns = transpose(equations.rows, equations.width) if forces else equations.rows
        return Elimination(columns, len(equations.facts) if forces else equations.width)
    from graphplan.solver.floating import prepared  # numpy is imported there: fractions do without it

    return prepared(equations, forces)


def condition(equations: Equations) -> float:
    """The 2-norm condition of either system, its rows and columns equilibrated."""
    from graphplan.solver.floating import prepared

    return prepared(equations).condition


def numbers(equations: Equations) -> Iterable[Number]:
    """Every number in the rows and on the right-hand side of the velocities and of the accelerations at rest."""
    return chain(*(row.values() for row in equations.rows), *equations.prescribed)


def require_fractions(scene: Scene, used: Iterable[Number]) -> None:
    """Fails with `Refused` where the scene is irrational, or a number in use is rounded."""
    if scene.irrational or any(isinstance(number, float) for number in used):
        known = sorted(scene.irrational, key=by_name)
        why = "; ".join(known) or "a coordinate, a drive, a given motion or a load is not a fraction"
        raise Refused("exact numbers", why, "ask for floats, without --exact")
