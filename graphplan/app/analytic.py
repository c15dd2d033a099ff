"""The independent solver as users ask for it, vectors as complex numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from graphplan.mechanism.model import Scene
from graphplan.methods.kinds import kind_of
from graphplan.methods.results import NamedResults
from graphplan.solver import Rates
from graphplan.solver import solve as solve_rates
from graphplan.solver.friction import with_friction
from graphplan.solver.statics import power, reactions

__all__ = ["AnalyticResults", "power", "reactions", "solve", "with_friction"]


@dataclass(frozen=True)
class AnalyticResults(NamedResults[complex, float]):
    """The velocities and accelerations of all points and slides of a scene, the rates of all its links, as the solver
    alone finds them, in scene units; with fractions vectors are pairs of them."""

    scene: Scene
    rates: Rates

    def results_of_kind(self, kind: str) -> dict[str, Any]:
        """The rates of a kind, by name."""
        values = {} if kind_of(kind).place else getattr(self.rates, kind.replace(" ", "_"), {})
        return {name: complex(*value) if isinstance(value, tuple) and isinstance(value[0], float) else value
                for name, value in values.items()}


def solve(scene: Scene, exact: bool = False) -> AnalyticResults:
    """Solve a scene by the analytic solver alone; with `exact` in fractions. Fails with `SingularPose`."""
    return AnalyticResults(scene, solve_rates(scene, exact))
