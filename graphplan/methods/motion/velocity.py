"""Velocities: orthogonal on the mechanism plan (Rosenauer, Ozols), or true on a polar plan (Jaanimets)."""

from __future__ import annotations

from typing import Any

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import Slide
from graphplan.methods.motion.moves import Carry, Figure, Guide, Meet, Move, Settle, Slip, Swing
from graphplan.methods.motion.network import Network, Place, Weld
from graphplan.methods.motion.plan import Plan, Vector
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.panels import MECHANISM, VELOCITY_PLAN
from graphplan.methods.poses import Pose
from graphplan.phrases import said

LAWS: dict[type, str] = {
    Swing: said("the ends of two points of a link lie on a parallel to their line"),
    Slip: said("the link's turning is known, so its points' ends differ by a known vector"),
    Carry: said("the end lies on a line through the auxiliary point's end, parallel to the line joining the points"),
    Settle: said("the ends of two points of a link lie on a parallel to their line"),
    Figure: said("the ends of a link's points form a figure similar to the link's, with parallel sides"),
    Guide: said("the sliding pair leaves only a velocity along the guide, drawn turned square to it"),
    Meet: said("the end lies on both"),
}


class Velocity(Plan):
    """What both velocity plans share: drives, guides, and the relative velocities that accelerations need."""

    def __init__(self, board: Board, net: Network, pose: Pose, tempo: Tempo):
        super().__init__(board, net, pose)
        self.tempo = tempo

    def seat(self, slide: Slide, known: str, new: str, point: str) -> Mark:
        return self.figure(new, point)

    def relative(self, link: str, K: str, A: str) -> Vector:
        """Two marks whose distance is the velocity of A about K, points of one link."""
        raise NotImplementedError

    def about(self, link: str, P: str, B: str) -> Mark:
        """The orthogonal velocity of B about P, points of one link, laid off at B: its end."""
        raise NotImplementedError

    def slip(self, known: str, new: str, B: str) -> Mark:
        """The orthogonal velocity of B as a point of one link about B as a point of the other, laid off at B."""
        raise NotImplementedError

    def law(self, move: Move) -> str:
        return LAWS.get(type(move), "")


class Orthogonal(Velocity):
    """Velocities turned a quarter counter-clockwise, each drawn from its point on the mechanism plan."""

    panel, turn, across = MECHANISM, "parallel", True

    def home(self, place: Place) -> Mark:
        return self.point(place)

    def figure(self, link: str, point: str) -> Mark:
        return self.pose.points[point]

    def start(self, weld: Weld, point: str) -> Mark:
        return self.pose.points[point]

    def hop(self, weld: Weld, point: str, mark: Mark, sign: int) -> Mark:
        X = self.pose.points[point]
        if not weld.drive.slides:
            A, ratio = self.pose.points[weld.at], -sign * weld.sign * self.tempo.turning(weld.drive.rate)
            if A is X or not ratio:
                return mark
            return A if ratio == -1 and mark is X else self.board.step_off(A, X, mark, ratio=ratio)
        assert weld.slide is not None
        across = self.board.perpendicular(self.pose.guide(weld.slide, run=True), X)
        return _along(self.board, across, mark, sign * weld.sign * self.tempo.velocity(weld.drive.rate))

    def seeded(self, place: Place) -> Mark:
        vx, vy = self.pose.scene.motions[place[0]].velocity
        return _laid(self.board, self.point(place), -self.tempo.velocity(vy), self.tempo.velocity(vx))

    def turned_by(self, body: str, like: str, base: Vector, at: Mark) -> Mark:
        ratio = -sum(sign * self.tempo.turning(drive.rate) for sign, drive in self.net.excess(body, like))
        return self.board.step_off(*base, at, ratio=ratio) if ratio else at

    def end_name(self, place: Place) -> str:
        return f"v_{self.pose.spoken(place[0]).lower()}" + (f"({place[1]})" if place[1] in self.net.body else "")

    def relative(self, link: str, K: str, A: str) -> Vector:
        return self.moved(self.pose.points[A], self.pose.points[K], self.end_in(link, K)), self.end_in(link, A)

    def about(self, link: str, P: str, B: str) -> Mark:
        pole, end = self.pose.points[P], self.end_in(link, P)
        return self.moved(self.end_in(link, B), end, pole)

    def slip(self, known: str, new: str, B: str) -> Mark:
        return self.moved(self.end_in(new, B), self.end_in(known, B), self.pose.points[B])


class Polar(Velocity):
    """True velocities from one pole p; a link's image is a quarter turned."""

    panel, turn, across = VELOCITY_PLAN, "perpendicular", False

    def __init__(self, board: Board, net: Network, pose: Pose, tempo: Tempo):
        super().__init__(board, net, pose, tempo)
        with board.on(self.panel):
            self.pole = board.begin(plan=self.panel.words, number=1, name="p")

    def far_from(self, place: Place) -> Mark:
        """As far from the pole as the place is from another point of its link."""
        return self.board.transfer(self.point(place), super().far_from(place), self.pole)

    def home(self, place: Place) -> Mark:
        return self.pole

    def figure(self, link: str, point: str) -> Mark:
        return self.pole

    def start(self, weld: Weld, point: str) -> Mark:
        return self.pole

    def hop(self, weld: Weld, point: str, mark: Mark, sign: int) -> Mark:
        X = self.pose.points[point]
        if not weld.drive.slides:
            A, ratio = self.pose.points[weld.at], sign * weld.sign * self.tempo.turning(weld.drive.rate)
            return mark if A is X or not ratio else self.board.step_across(A, X, mark, ratio=ratio)
        assert weld.slide is not None
        guide = self.pose.guide(weld.slide, run=True)
        return _along(self.board, guide, mark, sign * weld.sign * self.tempo.velocity(weld.drive.rate))

    def seeded(self, place: Place) -> Mark:
        vx, vy = self.pose.scene.motions[place[0]].velocity
        return _laid(self.board, self.pole, self.tempo.velocity(vx), self.tempo.velocity(vy))

    def turned_by(self, body: str, like: str, base: Vector, at: Mark) -> Mark:
        ratio = sum(sign * self.tempo.turning(drive.rate) for sign, drive in self.net.excess(body, like))
        return self.board.step_across(*base, at, ratio=ratio) if ratio else at

    def end_name(self, place: Place) -> str:
        return self.pose.spoken(place[0]).lower() + (f"({place[1]})" if place[1] in self.net.body else "")

    def relative(self, link: str, K: str, A: str) -> Vector:
        return self.end_in(link, K), self.end_in(link, A)

    def about(self, link: str, P: str, B: str) -> Mark:
        return self.board.quarter(self.end_in(link, P), self.end_in(link, B), self.pose.points[B])

    def slip(self, known: str, new: str, B: str) -> Mark:
        return self.board.quarter(self.end_in(known, B), self.end_in(new, B), self.pose.points[B])

    def law(self, move: Move) -> str:
        return POLAR_LAWS.get(type(move), "")


POLAR_LAWS: dict[type, str] = {
    Swing: said("the velocity of one point of a link about another is square to their line"),
    Slip: LAWS[Slip],
    Carry: said("the end lies on a line through the auxiliary point's end, square to the line joining the points"),
    Settle: said("the velocity of one point of a link about another is square to their line"),
    Figure: said("the ends of a link's points form a figure similar to the link's, a quarter turned"),
    Guide: said("the sliding pair leaves only a velocity along the guide"),
    Meet: said("the end lies on both"),
}


def _along(board: Board, line: Mark, mark: Mark, length: Any) -> Mark:
    return board.lay_along(line, mark, length=length) if length else mark


def _laid(board: Board, mark: Mark, dx: Any, dy: Any) -> Mark:
    return board.lay_off(mark, dx=dx, dy=dy) if dx or dy else mark
