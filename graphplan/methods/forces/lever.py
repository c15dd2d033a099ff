"""Zhukovsky's lever: the orthogonal velocities from one pole as a rigid body, with the forces at their ends.

The moment of a force about the pole is its power, in the scale of the plan. So the lever balances when the mechanism
does, and one unknown force or moment is had from the moments of all others, without any reaction; the velocities may be
of any size, and those of a mechanism at rest are assumed. To find a reaction its pair is freed: the link may then move
in the pair, the balances do no work, and the reaction takes their place (Ozols 1974, 10-6 and 13-3).
"""

from __future__ import annotations

from collections.abc import Iterator

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Balance, Slide
from graphplan.methods import panels
from graphplan.methods.forces.loading import Acting, Loading
from graphplan.methods.forces.reactions import Shown
from graphplan.methods.motion.velocity import Polar, Velocity
from graphplan.phrases import said

Span = tuple[Mark, Mark]


class Lever:
    """One lever: the loads of a scene at the ends of one set of velocities, on a panel of its own."""

    def __init__(self, board: Board, velocity: Velocity, loading: Loading, panel: panels.LeverPlan,
                 renamed: dict[tuple[str, str], str] | None = None):
        self.board, self.velocity, self.loading, self.panel = board, velocity, loading, panel
        self.renamed = renamed or {}
        self.shown: list[Shown] = []
        with board.on(panel):
            self.pole = board.begin(plan=panel.words, number=1, name="o")

    # ---- velocities --------------------------------------------------------------------------------------------

    def end(self, link: str, point: str) -> Mark:
        """The end of the orthogonal velocity of a link's point, from the pole."""
        scene, point = self.velocity.net.scene, self.renamed.get((link, point), point)
        if FRAME in scene.links_of.get(point, ()) and point in scene.links[link]:
            return self.pole
        name = f"{self.velocity.pose.spoken(point).lower()}_o"
        if isinstance(self.velocity, Polar):
            return self.board.quarter(self.velocity.pole, self.velocity.end_in(link, point), self.pole, name=name)
        home, end = self.velocity.figure(link, point), self.velocity.end_in(link, point)
        return self.board.transfer(home, end, self.pole, name=name)

    def _relative(self, one: Mark, two: Mark) -> Mark:
        """The end of the velocity of one point about another, from the pole."""
        return two if one is self.pole else self.board.transfer(one, two, self.pole)

    # ---- forces ------------------------------------------------------------------------------------------------

    def forces(self) -> Iterator[Acting]:
        """The loads at the ends of the velocities; those at fixed points have no moment, and are left out."""
        for link in self.loading.scene.moving:
            for point, lay in self.loading.each(link):
                end = self.end(link, point)
                if end is not self.pole:
                    force = lay(end)
                    yield Acting(end, end, force.head, force.name)
            yield from self._couples(link)

    def _couples(self, link: str) -> Iterator[Acting]:
        """The couples, as pairs of forces at two points of the link; that at a fixed point is left out."""
        ends = [self.end(link, point) for point in self.loading.arm_points(link)]
        for force, answer in self.loading.couples(link, ends[1]):
            yield Acting(ends[1], force.tail, force.head, force.name)
            if ends[0] is not self.pole:
                tip = self.board.transfer(answer.tail, answer.head, ends[0])
                yield Acting(ends[0], ends[0], tip, answer.name)

    def _held(self, X: Mark) -> Mark:
        """The force at the end X, square to its velocity and laid off there, that keeps the lever in balance."""
        mark = X
        for force in self.forces():
            self.shown.append(Shown("load", force.name, force.tail, force.head))
            mark = self.board.balance(self.pole, X, force.at, force.tail, force.head, mark,
                                      why=said("moments about the pole balance, since powers do"))
        return mark

    def moment(self, link: str) -> tuple[Mark, ...]:
        """The balancing moment on a link, as a pair of forces at two of its points: a pole, a point, tail and head."""
        return self.turning(link, FRAME)

    def turning(self, link: str, on: str) -> tuple[Mark, ...]:
        """The moment on a link that turns on another, as a pair of forces: a pole, a point, tail and head."""
        P, R = names = self.loading.arm_points(link)
        with self.board.on(self.panel, (link,)):
            X = self._relative(*(self.end(link, point) for point in names))
            if on != FRAME:
                X = self._relative(self._relative(*(self.end(on, point) for point in names)), X)
            head = self._held(X)
        return self.velocity.pose.points[P], self.velocity.pose.points[R], X, head

    def force(self, balance: Balance) -> Span:
        """The balancing force of known line."""
        assert balance.direction is not None
        with self.board.on(self.panel, (balance.link,)):
            X = self.end(balance.link, balance.at)
            dx, dy = balance.direction
            return self._along(X, self.board.guide(X, dx=dx, dy=dy))

    def _along(self, X: Mark, line: Mark) -> Span:
        """The force at X along a line: as much of it as has the moment of that which stands square."""
        return X, self.board.meet(line, self.board.parallel(self.board.line(self.pole, X), self._held(X)))

    def across(self, point: str, link: str, pin: str) -> Span:
        """The force on a link at a freed pin, along the direction in which it may move there."""
        with self.board.on(self.panel, (link,)):
            X = self._relative(self.end(pin, point), self.end(link, point))
            return X, self._held(X)

    def off_guide(self, slide: Slide) -> Span:
        """The force on a sliding link that may leave its guide."""
        guide = self.velocity.pose.guide(slide)
        with self.board.on(self.panel, (slide.link,)):
            X = self._relative(self.end(slide.along, slide.at), self.end(slide.link, slide.at))
            return self._along(X, self.board.perpendicular(guide, X))
