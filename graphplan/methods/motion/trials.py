"""False position on a plan: a figure is drawn from two assumed ends, and then from the right one."""

from __future__ import annotations

from collections.abc import Iterable
from copy import copy
from fractions import Fraction
from typing import Protocol

from graphplan.kernel.program import Board, Mark
from graphplan.methods.motion.moves import FalsePosition, Locus, Move
from graphplan.methods.motion.network import BodyPoint

STATE = "ends", "loci", "known", "_told", "pole_vectors", "parts"  # of a plan: what a trial figure may not pass on
TRIAL_RATIOS = Fraction(3, 10), Fraction(-2, 5)  # where trial figures stand on their locus, in lengths of a link


class TrialPlan(Protocol):
    """A plan as far as trial figures are concerned."""

    board: Board
    prime: str
    ends: dict[BodyPoint, Mark]
    loci: dict[Locus, Mark]

    def plan_origin(self, place: BodyPoint) -> Mark: ...
    def assume(self, place: BodyPoint, locus: Mark, ratio: Fraction) -> Mark: ...
    def end_name(self, place: BodyPoint) -> str: ...
    def know(self, place: BodyPoint, mark: Mark) -> None: ...
    def draw(self, planned: Iterable[Move]) -> None: ...


def draw_false_position(plan: TrialPlan, move: FalsePosition) -> None:
    """Two trial figures, the false position, then the true figure by the same moves."""
    place, locus = move.at[0], plan.loci[move.at]
    trials, outer = list[Mark](), plan.prime
    before = {name: getattr(plan, name) for name in STATE}
    for prime, ratio in zip(("'", "''"), TRIAL_RATIOS, strict=True):
        for name, drawn in before.items():
            setattr(plan, name, copy(drawn))  # nothing of another trial serves
        plan.prime = outer + prime
        start = plan.assume(place, locus, ratio)
        plan.know(place, plan.board.give_name(start, plan.end_name(place) + plan.prime))
        plan.draw(move.moves)
        trials += [start, plan.ends[move.end], plan.loci[move.locus]]
    plan.prime = outer
    for name, drawn in before.items():
        setattr(plan, name, drawn)
    A1, Z1, l1, A2, Z2, l2 = trials
    true = plan.board.false_position(A1, A2, Z1, l1, Z2, l2, name=plan.end_name(place) + plan.prime)
    plan.know(place, true)
    plan.draw(move.moves)
