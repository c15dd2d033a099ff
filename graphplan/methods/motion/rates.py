"""How a link turns: as the drives prescribe, or alike with a link that has two points whose vectors are drawn.

A slide makes two links turn alike, a turning drive by a given difference. So a link of one point, such as a block, has
its turning from another; one that such pairs tie to the frame has what the drives prescribe, and nothing is drawn.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations
from typing import NamedTuple

from graphplan.kernel.passes import needed_steps
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Number, Scene
from graphplan.mechanism.order import ordered_slides, turning_drives
from graphplan.methods.motion.plan import Plan


class Rates(NamedTuple):
    """An angular velocity and an angular acceleration."""

    omega: Number
    alpha: Number


class Turnings:
    """How the links of a scene turn beside each other; asked link by link."""

    def __init__(self, scene: Scene):
        self._beside: dict[str, list[tuple[str, Rates]]] = {}
        self._found: dict[str, dict[str, Rates]] = {}
        for slide in ordered_slides(scene):
            if slide.turns_alike:
                self._join(*slide.links, Rates(0, 0))
        for drive in turning_drives(scene):
            self._join(*drive.links, Rates(*drive.rates))

    def _join(self, link: str, other: str, more: Rates) -> None:
        self._beside.setdefault(link, []).append((other, more))
        self._beside.setdefault(other, []).append((link, Rates(-more.omega, -more.alpha)))

    def alike(self, link: str) -> dict[str, Rates]:
        """The links whose turning differs from this one's by given rates, and by how much this link exceeds each."""
        if link not in self._found:
            found = self._found[link] = {link: Rates(0, 0)}
            waiting = [link]
            for here in waiting:
                for other, more in self._beside.get(here, ()):
                    if other not in found:
                        found[other] = Rates(found[here].omega + more.omega, found[here].alpha + more.alpha)
                        waiting.append(other)
        return self._found[link]

    def given(self, link: str) -> Rates | None:
        """The rates that the drives prescribe for a link: by how much it exceeds the frame."""
        return self.alike(link).get(FRAME)


class Side(NamedTuple):
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

    def price(self, side: Side) -> tuple[int, bool, float]:
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


def sides(plan: Plan, links: Iterable[str]) -> list[Side]:
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


def _drawn(plan: Plan, link: str) -> list[str]:
    """The points of a link's plane whose ends are drawn."""
    own = [p for p in plan.net.links[link] if (p, "") in plan.ends]
    return own + [p for p, seen in plan.ends if seen == link and p in plan.net.scene.points]


def _known(plan: Plan, link: str) -> list[str]:
    """The points whose ends tell all of the motion of a link's body."""
    return [p for p, _ in plan.known[plan.net.body[link]] if p in plan.net.scene.points]


def _side(plan: Plan, link: str, P: str, R: str) -> Side:
    points, own = plan.pose.points, {P, R} <= {*plan.net.links[link]}
    marks = points[P], points[R], *_vector(plan, link, P), *_vector(plan, link, R)
    return Side(link, marks, apart(plan.net.scene, P, R), own)


def _vector(plan: Plan, link: str, point: str) -> tuple[Mark, Mark]:
    """Begin and end of the vector of a point of a link's plane."""
    with plan.board.on(plan.panel, (link,)):
        for place in ((point, ""), (point, link)):
            if place in plan.ends and (place[1] or point in plan.net.links[link]):
                return plan.home(place), plan.ends[place]
        return plan.figure(link, point), plan.end_in(link, point)
