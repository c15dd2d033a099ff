"""Velocities: orthogonal on the mechanism plan (Rosenauer, Ozols), true on a polar plan (Jaanimets), or true in
triangles on the mechanism plan (Ozols)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

from graphplan.errors import Refused
from graphplan.kernel.kinds import Movement
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Number, Slide
from graphplan.mechanism.replaced import rolling_guides
from graphplan.methods.assembly import Pose
from graphplan.methods.motion.moves import (
    Carry,
    Centre,
    GuideLocus,
    Meet,
    Move,
    Roll,
    Settle,
    SimilarFigure,
    Slip,
    Swing,
)
from graphplan.methods.motion.network import BodyPoint, DrivenPair, Network
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.stages import VELOCITIES, beginning_stage
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.motion.vector_parts import RELATIVE, Vector
from graphplan.methods.panels import MECHANISM, TRIANGLES, VELOCITY_PLAN
from graphplan.phrases import Said, said

LAWS: dict[type, Said] = {
    Swing: said("the ends of two points of a link lie on a parallel to their line"),
    Slip: said("the link's turning is known, so its points' ends differ by a known vector"),
    Carry: said("the end lies on a line through the auxiliary point's end, parallel to the line joining the points"),
    Settle: said("the ends of two points of a link lie on a parallel to their line"),
    SimilarFigure: said("the ends of a link's points form a figure similar to the link's, with parallel sides"),
    GuideLocus: said("the sliding pair leaves only a velocity along the guide, drawn turned perpendicular to it"),
    Roll: said("where two links roll on each other their velocities agree"),
    Meet: said("the end lies on both"),
}
POLAR_LAWS = LAWS | {
    Swing: said("the velocity of one point of a link about another is perpendicular to their line"),
    Carry: said("the end lies on a line through the auxiliary point's end, perpendicular to the line joining the "
                "points"),
    Settle: said("the velocity of one point of a link about another is perpendicular to their line"),
    SimilarFigure: said("the ends of a link's points form a figure similar to the link's, a quarter turned"),
    GuideLocus: said("the sliding pair leaves only a velocity along the guide"),
}
TRIANGLE_LAWS = POLAR_LAWS | {
    SimilarFigure: said("the velocities of points of a link in line end on one straight line"),
}


class Velocity(MotionPlan):
    """Common part of both velocity plans: drives, guides, and the relative velocities that accelerations need."""

    words = VELOCITIES
    mechanism = MECHANISM  # the plan on which the mechanism's points lie
    pole_of: Callable[[str, str], Mark]  # of two links, where velocities are drawn by poles

    def _draw(self, move: Move) -> None:
        if isinstance(move, Centre):
            self._at_pole(*move)
        else:
            super()._draw(move)

    def _at_pole(self, body: str, place: BodyPoint) -> None:
        """Enter the pole of a body, whose vector is zero: its end is its start."""
        self.pose.points[place[0]] = self.pole_of(self.net.members[body][0], FRAME)
        self.stages.letters[place[0]] = self.pose.letter_of_point(place[0])
        self.ends[place] = self.plan_origin(place)
        self.known[body] += (place,)

    def origin(self, point: str) -> Mark:
        """Start of the velocity of a point."""
        raise NotImplementedError

    def ends_in_pose(self) -> Iterator[tuple[str, str]]:
        """The vectors of moving points that end in a point of the pose, by their letters."""
        for place, end in self.ends.items():
            moves = place[0] in self.pose.points and end is not self.plan_origin(place)
            if moves and end.step.op.movement is Movement.GIVEN:
                yield self.stages.vector(self.words.symbol, place).name, end.step.name

    def prescribed_length(self, rates: tuple[Number, Number]) -> Number:
        return self.tempo.rate(rates[0])

    def plan_origin(self, place: BodyPoint) -> Mark:
        return self.origin(place[0])

    def figure(self, link: str, point: str) -> Mark:
        return self.origin(point)

    def start(self, weld: DrivenPair, point: str) -> Mark:
        return self.origin(point)

    def seat(self, slide: Slide, known: str, new: str, point: str) -> Mark:
        return self.origin(point)

    def relative(self, link: str, K: str, A: str) -> Vector:
        """Two marks whose distance is the velocity of A about K, points of one link."""
        start, end = self.end_in(link, K), self.end_in(link, A)
        if end is self.origin(A):  # A is fixed: what is left is the velocity of K
            return start, self.origin(K)
        return self.shift_by(self.origin(A), self.origin(K), start), end

    def orthogonal(self, link: str, B: str) -> Mark:
        """The orthogonal velocity of B, a point of a link's plane, laid off at B: its end."""
        return self._subtract(self.origin(B), self.end_in(link, B), B, B)

    def relative_velocity(self, link: str, P: str, B: str) -> Mark:
        """The orthogonal velocity of B about P, points of one link, laid off at B: its end."""
        return self._subtract(self.end_in(link, P), self.end_in(link, B), P, B)

    def slip(self, known: str, new: str, B: str) -> Mark:
        """The orthogonal velocity of B as a point of one link about B as a point of the other, laid off at B."""
        return self._subtract(self.end_in(known, B), self.end_in(new, B), B, B)

    def _subtract(self, less: Mark, end: Mark, P: str, B: str) -> Mark:
        """The orthogonal velocity of B, which ends at `end`, less that of P, laid off at B."""
        raise NotImplementedError


class Orthogonal(Velocity):
    """Velocities turned a quarter counter-clockwise, each drawn from its point on the mechanism plan."""

    panel, turn, across, laws, ending = MECHANISM, "parallel", True, LAWS, "v_{0}"
    turned = True

    def origin(self, point: str) -> Mark:
        return self.pose.points[point]

    def _subtract(self, less: Mark, end: Mark, P: str, B: str) -> Mark:
        return self.shift_by(end, less, self.pose.points[P])


class Polar(Velocity):
    """True velocities from one pole p; a link's image is a quarter turned."""

    panel, turn, across, laws, ending = VELOCITY_PLAN, "perpendicular", False, POLAR_LAWS, "{0}"

    def __init__(self, board: Board, net: Network, pose: Pose, tempo: Tempo):
        super().__init__(board, net, pose, tempo)
        self.pole = self._origin_mark()

    def _origin_mark(self) -> Mark:
        """The mark from which all velocities are laid off."""
        with self.board.on(self.panel, stage=beginning_stage("p", self.panel.words, pole=True)):
            return self.board.pole(plan=self.panel, name="p")

    def origin(self, point: str) -> Mark:
        return self.pole

    def _draw(self, move: Move) -> None:
        super()._draw(move)
        match move:
            case Swing(body, K, X) | SimilarFigure(body, K, X, None) if self.net.common_link(body, K, X):
                self._note_relative(X, K, self.ends[K])
            case GuideLocus(_, point, known, new):
                on, place = (self.net.place(point, link) for link in (known, new))
                self._note_relative(place, on, self.end_in(known, point))

    def _note_relative(self, X: BodyPoint, about: BodyPoint, start: Mark) -> None:
        """Enter the velocity of X relative to another point, where that one moves."""
        if start is not self.pole:
            self.note_part(RELATIVE, self.stages.vector("v", X, about).name, start, X)

    def _subtract(self, less: Mark, end: Mark, P: str, B: str) -> Mark:
        return self.board.quarter(less, end, self.pose.points[B])


class Triangles(Polar):
    """True velocities, each drawn from its point on the mechanism plan.

    Those of the centres and pitch points of a train in line are perpendicular to the line, and the ends of each wheel's
    lie on one straight line (Ozols 1974, 7-2). Points off that line are found as from a pole, which is a fixed point.
    """

    panel, laws, ending = TRIANGLES, TRIANGLE_LAWS, "v_{0}"
    mechanism = TRIANGLES

    def __init__(self, board: Board, net: Network, pose: Pose, tempo: Tempo):
        super().__init__(board, net, pose, tempo)
        self.trains = trains(net)
        if not self.trains:
            raise Refused("plan triangles", "no gears here have a line of centres", "orthogonal or polar")

    def _origin_mark(self) -> Mark:
        return next(self.pose.points[point] for point in (*self.net.links.get(FRAME, ()), *self.pose.points))

    def plan_origin(self, place: BodyPoint) -> Mark:
        return self.point(place)

    def _note_relative(self, X: BodyPoint, about: BodyPoint, start: Mark) -> None:
        """Velocities that are drawn from their points show no parts."""

    def _resting_end(self, place: BodyPoint) -> Mark:
        """On a link that a drive turns on the frame the velocity is laid off at its point."""
        weld = self.net.welds.get(self.net.link_at(self.net.ground, place))
        if weld is None or weld.slide or weld.to != FRAME:
            return super()._resting_end(place)
        much, X = weld.sign * self.prescribed_length(weld.drive.rates), self.point(place)
        return self._step((self.pose.points[weld.at], X), X, much) if much and place[0] != weld.at else X

    def drawn_figure(self, body: str, K: BodyPoint, X: BodyPoint, R: BodyPoint | None, like: str) -> Mark:
        one_link = R and len({self.net.link_at(body, place) for place in (K, X, R)}) == 1
        if R and one_link and any({K[0], X[0], R[0]} <= train for train in self.trains):
            upright = self.board.perpendicular(self.board.side(self.point(K), self.point(R)), self.point(X))
            return self.board.meet(upright, self.board.side(self.ends[K], self.ends[R]))
        return super().drawn_figure(body, K, X, R, like)


def trains(net: Network) -> list[set[str]]:
    """The centres and pitch points that lie in line in every pose: those of gears whose centres are points of one link
    in line."""
    found: list[set[str]] = []
    for guide in rolling_guides(net.scene):
        if not guide.through:  # a rack, which has no line of centres
            continue
        line = {guide.at, *guide.through}
        for train in [train for train in found if _in_line(net, train | line)]:
            line |= train
            found.remove(train)
        found.append(line)
    return found


def _in_line(net: Network, points: set[str]) -> bool:
    """Whether these points are in line, and the centres among them all on one link."""
    centres = points - net.wandering
    (x, y), *others = (net.scene.points[point] for point in sorted(points))
    rays = [(p - x, q - y) for p, q in others]
    flat = all(p[0] * q[1] == p[1] * q[0] for p, q in pairwise(ray for ray in rays if any(ray)))
    return flat and any(centres <= {*link} for link in net.links.values())
