"""What the solver says of a scene in one arithmetic, by the kinds and names of a construction's results."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from graphplan.check.arithmetics import FLOATS, Arithmetic, Exact, bounded_rates, enclosed
from graphplan.check.compared import Results
from graphplan.mechanism.model import Scene
from graphplan.methods.kinds import ORDER
from graphplan.solver import Rates, solve

if TYPE_CHECKING:
    from graphplan.check.forces import Forces
    from graphplan.solver.statics import Reactions


@dataclass(frozen=True)
class Opinion:
    """The solver's rates of a scene, where there are loads its reactions, too, and those after so many `rounds` of
    friction; `power` is the third opinion on the balances, where it is known."""

    scene: Scene
    rates: Rates
    reactions: Reactions | None = None
    rounds: Callable[[int], Reactions] | None = None
    power: tuple[Any, ...] = ()

    def truth(self, results: Results, rounds: int = 0) -> dict[str, dict[str, Any]]:
        """What a construction's results should be that draws so many rounds of friction."""
        if self.reactions is None or self.rounds is None:
            return by_part(self.rates)
        from graphplan.check.forces import force_truth

        rough = self.rounds(rounds) if rounds else None
        return by_part(self.rates) | force_truth(self.scene, results, self.reactions, rough)

    @property
    def third(self) -> dict[str, dict[str, Any]]:
        """The power balance, which is compared as what is drawn is."""
        if not self.power:
            return {}
        from graphplan.check.forces import powers

        return powers(self.power)

    def beside(self, scene: Scene, results: dict[str, dict[str, Any]], rounds: int, exact: bool = False,
               bounded: bool = False) -> Forces | None:
        """The forces among the results of a construction, beside this; none where there are no loads."""
        if self.reactions is None:
            return None
        from graphplan.check.forces import Forces

        return Forces(scene, results, self.reactions, self.power, rounds, exact, bounded)


def opinion(scene: Scene, by: Arithmetic) -> Opinion:
    """What the solver says; fails with the arithmetic's doubt where its bounds are too wide to tell."""
    known = scene if isinstance(by, Exact) else enclosed(scene, by)
    rates = solve(scene, exact=True) if isinstance(by, Exact) else bounded_rates(known, by)
    if scene.loads is None:
        return Opinion(known, rates)
    from graphplan.check.forces import bounded_reactions, rubbed
    from graphplan.solver.friction import with_friction
    from graphplan.solver.statics import reactions
    from graphplan.solver.virtual_power import power

    if isinstance(by, Exact):
        return Opinion(known, rates, reactions(scene, exact=True),
                       lambda rounds: with_friction(scene, rounds, exact=True), power(scene, exact=True))
    smooth, certain = bounded_reactions(known, rates, by), by
    return Opinion(known, rates, smooth, lambda rounds: rubbed(smooth, rounds, certain),
                   power(scene) if by is FLOATS else ())


def by_part(rates: Rates) -> dict[str, Any]:
    """The solver's rates, by the kinds of readings."""
    return {part: getattr(rates, part.replace(" ", "_")) for part in ORDER}
