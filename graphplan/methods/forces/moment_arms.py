"""A balancing moment as forces times arms: M = R h, with each arm h drawn on the mechanism plan.

The arm is the perpendicular from the centre of the turning link on the line of action of a force; forces through the
centre have none (Ozols 1974, 10-2). The moment is read from the forces where they act, so that it stands in poses, too,
in which one of them vanishes and shows no line.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from math import dist
from typing import Any, NamedTuple

from graphplan.errors import ConstructionError
from graphplan.kernel.elementary import cross, vector
from graphplan.kernel.program import Board, Mark
from graphplan.kernel.stages import Teller
from graphplan.methods.forces.loading import Acting
from graphplan.methods.panels import MECHANISM
from graphplan.methods.tolerances import DIRECTION_SHARE
from graphplan.phrases import said

Values = Callable[[Sequence[Mark]], list[Any]]


class CentreMoment(NamedTuple):
    """A balancing moment about the centre of a link: that of these forces, which oppose those on the link.

    `couples` names those that stand square to the way from the centre, so that this is their arm; `stage` tells the
    moment.
    """

    link: str
    centre: Mark
    forces: tuple[Acting, ...]
    couples: Collection[str]
    stage: Teller

    def arms(self, board: Board, values: Values, letter: str, shortest: float) -> Iterator[tuple[str, Acting, Mark]]:
        """The forces that show a direction and have an arm, each with the letter of its arm and where that ends."""
        try:
            spots = values([mark for force in self.forces for mark in (force.tail, force.head, force.at, self.centre)])
        except ConstructionError:  # whoever reads the numbers is told
            return
        ends = list(zip(self.forces, *(spots[place::4] for place in range(4)), strict=True))
        least = max([shortest, *(DIRECTION_SHARE * dist(tail, head) for _, tail, head, *_ in ends)])
        directed = [force for force, tail, head, at, centre in ends if (size := dist(tail, head)) > least
                    and abs(cross(vector(tail, head), vector(centre, at))) > shortest * size]
        for number, force in enumerate(directed, 1):
            own = f"{letter}_{number}" if len(directed) > 1 else letter
            yield own, force, force.at if force.name in self.couples else self._foot(board, own, force)

    def _foot(self, board: Board, letter: str, force: Acting) -> Mark:
        """The mark where the line of action of a force is nearest to the centre."""
        with board.on(MECHANISM, (self.link,), self.stage):
            line = board.parallel(board.side(force.tail, force.head), force.at)
            return board.foot(line, self.centre, why=said("the arm {0} of {1}", letter, force.name))
