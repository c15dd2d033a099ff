"""How a link turns: as the drives prescribe, or alike with a link that has two points whose vectors are drawn.

A slide makes two links turn alike, a turning drive by a given difference. So a link of one point, such as a block, has
its turning from another; one that such pairs tie to the frame has what the drives prescribe, and nothing is drawn.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from typing import NamedTuple

from graphplan.kernel.program import Board, Mark, needed_steps
from graphplan.mechanism.model import Scene
from graphplan.methods.motion.plan import MotionPlan


class LinkSide(NamedTuple):
    """Two points of a link's plane, and the marks that its turning is read from: both, begin and end of each vector.

    `own` says whether both are points of the link, which cannot come together in another pose.
    """

    link: str
    marks: tuple[Mark, ...]
    length: float
    own: bool


class Needed:
    """The steps that the wanted marks need, as more and more are wanted."""

    def __init__(self, board: Board, wanted: Iterable[Mark]):
        self.board = board
        self.steps = needed_steps(board, wanted)

    def add(self, marks: Iterable[Mark]) -> None:
        self.steps |= self._more(marks)

    def price(self, side: LinkSide) -> tuple[int, bool, float]:
        """How dear a side is: by the steps that are not drawn anyway, then by whose it is, then by its length."""
        return len(self._more(side.marks)), not side.own, -side.length

    def _more(self, marks: Iterable[Mark]) -> set[int]:
        """The steps that these marks need beside those that are drawn anyway."""
        found: set[int] = set()
        waiting = [mark.step.index for mark in marks]
        while waiting:
            index = waiting.pop()
            if index not in found and index not in self.steps:
                found.add(index)
                waiting.extend(self.board.steps[index].args)
        return found


def sides(plan: MotionPlan, links: Iterable[str]) -> list[LinkSide]:
    """The sides of these links from which their turning can be read: those between points whose ends are drawn, if
    there are any, else those whose ends follow from all that is known of the link."""
    for places in (_drawn, _known):
        found = [_side(plan, link, P, R) for link in links for P, R in combinations(places(plan, link), 2)
                 if apart(plan.net.scene, P, R)]
        if found:
            return found
    return []


def apart(scene: Scene, P: str, R: str) -> float:
    """How far apart two points are: a link's turning is read off its longest side."""
    return max(abs(float(p - q)) for p, q in zip(scene.points[P], scene.points[R], strict=True))


def _drawn(plan: MotionPlan, link: str) -> list[str]:
    """The points of a link's plane whose ends are drawn."""
    own = [p for p in plan.net.links[link] if (p, "") in plan.ends]
    return own + [p for p, seen in plan.ends if seen == link and p in plan.net.scene.points]


def _known(plan: MotionPlan, link: str) -> list[str]:
    """The points whose ends tell all of the motion of a link's body."""
    return [p for p, _ in plan.known[plan.net.body[link]] if p in plan.net.scene.points]


def _side(plan: MotionPlan, link: str, P: str, R: str) -> LinkSide:
    points, own = plan.pose.points, {P, R} <= {*plan.net.links[link]}
    marks = points[P], points[R], *_vector(plan, link, P), *_vector(plan, link, R)
    return LinkSide(link, marks, apart(plan.net.scene, P, R), own)


def _vector(plan: MotionPlan, link: str, point: str) -> tuple[Mark, Mark]:
    """Begin and end of the vector of a point of a link's plane."""
    with plan.board.on(plan.panel, (link,)):
        for place in ((point, ""), (point, link)):
            if place in plan.ends and (place[1] or point in plan.net.links[link]):
                return plan.home(place), plan.ends[place]
        return plan.figure(link, point), plan.end_in(link, point)
