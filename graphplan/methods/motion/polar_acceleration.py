"""Accelerations from one pole, each the sum of its parts (Jaanimets): a_B = a_A + a^n_BA + a^t_BA, head to tail.

A normal acceleration is laid off from the end of the point that it is about, a Coriolis acceleration from that of the
coincident point; perpendicular to the one, or along the guide, lies what is left. The ends of a link's points form a
figure similar to the link's: two give every other. What goes by loci of a link (auxiliary points, trial figures,
relative poles), or from link to link by their drives, is drawn with the links' figures of normal accelerations, laid
off from the pole.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import partial

from graphplan.kernel.kinds import Quantity
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import Number, Slide
from graphplan.methods.assembly import Pose
from graphplan.methods.motion.acceleration import CORIOLIS as CORIOLIS_TEXT
from graphplan.methods.motion.acceleration import LAWS, Anchor, Normal
from graphplan.methods.motion.acceleration import NORMAL as NORMAL_TEXT
from graphplan.methods.motion.moves import Move, SimilarFigure, Swing
from graphplan.methods.motion.network import BodyPoint, DrivenPair, Network
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.stages import beginning_stage
from graphplan.methods.motion.vector_parts import CORIOLIS, NORMAL, SLIDING, TANGENTIAL, Vector
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import ACCELERATION_PLAN
from graphplan.phrases import Said, said

SIMILAR = said("the ends of the accelerations of a link's points form a figure similar to the link's")
POLAR_LAWS: dict[type, Said] = LAWS | {SimilarFigure: SIMILAR}


class PolarAcceleration(Normal):
    """The polar plan of accelerations."""

    panel, laws, ending = ACCELERATION_PLAN, POLAR_LAWS, "{0}'"

    def __init__(self, board: Board, net: Network, pose: Pose, velocity: Velocity, moves: Iterable[Move]):
        with board.on(self.panel, stage=beginning_stage("pi", self.panel.words, pole=True)):
            self.pole = board.pole(plan=self.panel, name="pi")
        super().__init__(board, net, pose, velocity, moves)
        self.stages = replace(self.stages, head_to_tail=True)
        self.normals: dict[tuple[str, BodyPoint, int], tuple[BodyPoint, Mark]] = {}
        self.tangents: dict[tuple[BodyPoint, BodyPoint], tuple[Mark, Mark | BodyPoint]] = {}
        self.coriolis_ends: dict[tuple[str, str, str, int], Mark] = {}

    def plan_origin(self, place: BodyPoint) -> Mark:
        return self.pole

    # ---- moves from point to point --------------------------------------------------------------------------------

    def _draw(self, move: Move) -> None:
        match move:
            case Swing(body, K, X, source) if link := self.net.common_link(body, K, X):
                start = self._normal_part(link, K, X, self.ends[K])
                self._tangential_part(X, K, start, X)
                self._locus((X, source or body), self.board.perpendicular(self.pose.side(K[0], X[0]), start), move)
            case _:
                super()._draw(move)

    def drawn_figure(self, body: str, K: BodyPoint, X: BodyPoint, R: BodyPoint | None, like: str) -> Mark:
        if R and self.net.common_link(body, K, X, R):
            return self.board.triangle(*map(self.point, (K, R, X)), self.ends[K], self.ends[R])
        link = "" if R else self.net.common_link(body, K, X)
        if not link:
            return super().drawn_figure(body, K, X, R, like)
        start = self._normal_part(link, K, X, self.ends[K])
        end = self._as_turned(body, like, K, X, start)
        if excess := self._driven_turning(link, 1):  # of the link over the body's top link
            end = self._step((self.point(K), self.point(X)), end, excess)
        self._tangential_part(X, K, start, end)
        return end

    def _guide(self, slide: Slide, point: str, known: str, new: str, move: Move) -> None:
        on, place = (self.net.place(point, link) for link in (known, new))
        begin = self.end_of(known, point)
        start = self._coriolis_part(slide, known, new, point, begin)
        if start is not self.pole:
            self._note(SLIDING, "a^r", place, on, start, place)
        self._locus((place, slide.name), self.board.parallel(self.pose.guide(slide), start), move)

    def end_of(self, link: str, point: str) -> Mark:
        """The end of the acceleration of a point of a link's plane."""
        place, body = self.net.place(point, link), self.net.body[link]
        if place in self.ends:
            return self.ends[place]
        if body == self.net.ground:
            return self._driven(link, place)
        corners = [K for K in self.known[body] if self.net.common_link(body, K, place)]
        if coincident := next((K for K in corners if self.net.spot(K[0]) == self.net.spot(place[0])), None):
            return self.ends[coincident]
        if len(corners) > 1:
            return self.drawn_figure(body, corners[0], place, corners[1], "")
        return self.shift_by(self.end_in(link, point), self.figure(link, place[0]), self.pole)

    def vector(self, link: str, point: str) -> Vector:
        return self.pole, self.end_of(link, point)

    def turning(self, link: str, P: str, R: str) -> Vector:
        """The tangential acceleration of one about the other, where that is drawn."""
        first, second = (self.net.place(point, link) for point in (P, R))
        for X, about in ((second, first), (first, second)):
            start, until = self.tangents.get((X, about), (None, X))
            end = until if isinstance(until, Mark) else self.ends.get(until)
            if start is not None and end is not None:
                return (start, end) if X is second else (end, start)
        return super().turning(link, P, R)

    def sliding(self, slide: Slide) -> Vector:
        """From or to the end of the Coriolis acceleration, from whichever of the two points that is laid off."""
        under, end = (self.end_of(link, slide.at) for link in (slide.along, slide.link))
        if (back := self.coriolis_ends.get((slide.name, slide.link, slide.along, end.step.index))) is not None:
            return under, back
        return self._coriolis_part(slide, slide.along, slide.link, slide.at, under), end

    # ---- the parts ------------------------------------------------------------------------------------------------

    def _note(self, kind: str, symbol: str, X: BodyPoint, about: BodyPoint, start: Mark, end: Mark | BodyPoint) -> None:
        """Enter a part of the acceleration of X."""
        self.note_part(kind, self.stages.vector(symbol, X, about).name, start, end,
                       of=self.stages.name(X[0]) if kind in (CORIOLIS, SLIDING) else "")

    def _normal_part(self, link: str, K: BodyPoint, X: BodyPoint, start: Mark) -> Mark:
        """The normal acceleration of X about K, points of one link, laid off: by the semicircle, or in proportion to
        that of another point about K."""
        if self.net.never_turns(link) or self.net.coincide(K[0], X[0]):
            return start
        R, tip = self.normals.setdefault((link, K, start.step.index), (X, start))
        if R != X:
            with self.board.on(stage=partial(self.stages.figure, link)):
                end = self.board.similar(*map(self.point, (K, R, X)), start, tip, turn="parallel")
        else:
            with self.board.on(stage=partial(self.stages.normal, X, K)):
                end = self.board.normal(self.point(X), self.point(K), *self.velocity.relative(link, X[0], K[0]), start,
                                        why=NORMAL_TEXT(self.stages.name(*X), self.stages.name(*K)))
            self.normals[link, K, start.step.index] = X, end
        self._note(NORMAL, "a^n", X, K, start, end)
        return end

    def _tangential_part(self, X: BodyPoint, about: BodyPoint, start: Mark, end: Mark | BodyPoint) -> None:
        """Note the tangential part of the acceleration of X about a point: it begins where the normal acceleration
        ends."""
        if end is not start:
            self._give_letter("n", X, about, start)
            self._note(TANGENTIAL, "a^t", X, about, start, end)
            self.tangents[X, about] = start, end

    def _give_letter(self, letter: str, X: BodyPoint, about: BodyPoint, mark: Mark) -> None:
        """Name the end of a part after the points that it is of, where one can."""
        name = self.stages.vector(letter, X, about).name
        if "," not in name:
            self.board.give_name(mark, name + self.prime)

    def _coriolis_part(self, slide: Slide, known: str, new: str, B: str, start: Mark) -> Mark:
        """The Coriolis acceleration of the point of `new` relative to that of `known`, laid off."""
        if not self.net.turns(slide):
            return start
        link, P = self._pivot(slide.guiding, B)
        on, place = (self.net.place(B, end) for end in (known, new))
        with self.board.on(stage=partial(self.stages.coriolis, link, place, on)):
            turning, slip = self.velocity.relative_velocity(link, P, B), self.velocity.slip(new, known, B)
            end = self.board.coriolis(self.pose.points[P], self.pose.points[B], turning, slip, start,
                                      why=CORIOLIS_TEXT(self.stages.name(*place), self.stages.name(*on)))
        self.coriolis_ends[slide.name, known, new, start.step.index] = end
        self._give_letter("k", place, on, end)
        self._note(CORIOLIS, "a^C", place, on, start, end)
        return end

    # ---- links that drives tie to the frame -----------------------------------------------------------------------

    def _resting_end(self, place: BodyPoint) -> Mark:
        return self._driven(self.net.link_at(self.net.ground, place), place)

    def _driven_end(self, link: str, point: str) -> Mark:
        end = self._driven(link, self.net.place(point, link))
        return self.shift_by(end, self.pole, self.figure(link, point))

    def _driven(self, link: str, X: BodyPoint) -> Mark:
        """The end of a point of a link that drives tie to the frame: from joint to joint."""
        chain = self.net.chain(link)
        if X in self.ends or not chain:
            return self.ends.get(X, self.pole)
        weld = chain[0]
        J = self.net.place(weld.slide.at if weld.slide else weld.at, link)
        start = self._driven_along(weld, weld.slide) if weld.slide else self._driven(weld.to, J)
        if self.net.coincide(X[0], J[0]):
            return start
        omega, alpha = (self._driven_turning(link, order) for order in (0, 1))
        end, (A, B) = start, (self.point(X), self.point(J))
        if omega:
            end = self._driven_normal(A, B, start, omega * omega)
            self._note(NORMAL, "a^n", X, J, start, end)
        if alpha:
            start, end = end, self._step((B, A), end, alpha)
            self._tangential_part(X, J, start, end)
        return end

    def _driven_turning(self, link: str, order: int) -> Number:
        """By how much drives make a link turn faster than its body's top link, as that is drawn, or its change."""
        draw = self.prescribed_length if order else self.velocity.prescribed_length
        return sum(weld.sign * draw(weld.drive.rates) for weld in self.net.chain(link) if not weld.drive.slides)

    def _driven_normal(self, X: Mark, J: Mark, start: Mark, square: Number) -> Mark:
        if square == 1:
            return self.board.transfer(X, J, start)
        written = f"ω²·{J.step.name}{X.step.name}"
        return self.board.step_off(X, J, start, ratio=square, quantity=Quantity(written, self.words.kind))

    def _driven_along(self, weld: DrivenPair, slide: Slide) -> Mark:
        """The end of the sliding point of a link that a drive pushes along another."""
        on, place = (self.net.place(slide.at, link) for link in (weld.to, weld.link))
        start = self._coriolis_part(slide, weld.to, weld.link, slide.at, self._driven(weld.to, on))
        end = MotionPlan.hop(self, weld, slide.at, start, 1)
        if start is not self.pole:
            self._note(SLIDING, "a^r", place, on, start, end)
        return end

    # ---- links' figures, where loci need them ---------------------------------------------------------------------

    def _base(self, link: str, point: str) -> str:
        return self.anchors[link].point

    def _anchor_figure(self, link: str, anchor: Anchor) -> Mark:
        """Every link begins at the pole, but for two that a drive ties together."""
        return super()._anchor_figure(link, anchor) if self._are_driven_together(link, anchor.link) else self.pole

    def _hangs(self, slide: Slide, one: str, two: str) -> bool:
        return self._are_driven_together(one, two) and super()._hangs(slide, one, two)

    def _are_driven_together(self, one: str, two: str) -> bool:
        return any({weld.link, weld.to} == {one, two} for weld in self.net.welds.values())

    def figure_name(self, link: str, point: str) -> str:
        return f"n_{self.pose.letter_of_point(point).lower()}({link})"

    def locus_name(self, place: BodyPoint) -> str:
        return ""
