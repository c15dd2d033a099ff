"""Bracing: whether a mechanism is held as it should be, and if not, which links are loose and which overbraced.

Counting freedoms is not enough: the count can be right while one part is held twice and another not at all. So the
equations are solved, for points in general position: what can still move while all drives stand still is loose;
the same question of the transposed equations finds those that only repeat what others say.
"""

from __future__ import annotations

from typing import NamedTuple

from graphplan.errors import by_name
from graphplan.mechanism.elimination import PRIME, Elimination, transpose
from graphplan.mechanism.equations import System
from graphplan.mechanism.model import Scene


class Bracing(NamedTuple):
    """The links that can move though every drive stands still, and the links that are held more than once."""

    loose: tuple[str, ...]
    overbraced: tuple[str, ...]

    @property
    def sound(self) -> bool:
        """Whether the drives determine the motion, each link's once."""
        return not self.loose and not self.overbraced


def bracing(scene: Scene, balanced: bool = False) -> Bracing:
    """How the scene's moving links are held: by its drives, or by its balances in their place."""
    system = System(scene, balanced)
    columns = {unknown: j for j, unknown in enumerate(system.unknowns)}
    rows = [{columns[unknown]: c for unknown, c in equation.terms.items()} for equation in system.equations]
    held = Elimination(rows, len(columns), PRIME)
    loose = {system.unknowns[j][0][1] for j in held.free}
    proofs = Elimination(transpose(rows, len(columns)), len(rows), PRIME) if held.dependent else None
    repeated = [system.equations[i].fact for i in (proofs.free if proofs else ())]
    overbraced = {link for fact in repeated for link in (fact.link, fact.on)}
    return Bracing(*(tuple(sorted(found.intersection(scene.moving), key=by_name)) for found in (loose, overbraced)))
