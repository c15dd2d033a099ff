"""Accelerations on the plan of relative normal accelerations (Rosenauer).

On the N-plan every link has its figure, the link's own shrunk or blown up by omega squared, so that the vector from a
to b is the relative normal acceleration of A about B. Lay the acceleration of a point off from its mark there: what is
left between the ends of two points of a link is tangential, perpendicular to their line. So the ends are the image of
the link a quarter turned, and the moves that found the velocities find the accelerations.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from functools import partial
from typing import NamedTuple

from graphplan.kernel.kinds import Movement, Quantity
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Number, Slide
from graphplan.mechanism.replaced import RollingGuide, rolling_guides
from graphplan.methods.assembly import Pose
from graphplan.methods.motion.moves import Carry, GuideLocus, Meet, Move, Pole, Roll, Settle, SimilarFigure, Slip, Swing
from graphplan.methods.motion.network import BodyPoint, DrivenPair, Network
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.stages import ACCELERATIONS, beginning_stage
from graphplan.methods.motion.vector_parts import Vector
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import N_PLAN
from graphplan.phrases import Said, phrase, said

GREEK = {  # of loci: no letter is that of two points
    "A": "alpha", "B": "beta", "C": "gamma", "D": "delta", "E": "epsilon", "F": "phi", "G": "chi", "H": "eta",
    "I": "iota", "K": "kappa", "L": "lambda", "M": "mu", "N": "nu", "O": "theta", "P": "pi", "R": "rho",
    "S": "sigma", "T": "tau", "U": "upsilon", "W": "omega", "X": "xi", "Y": "psi", "Z": "zeta",
}

NORMAL = phrase("Normal acceleration of {0} about {1}")
CORIOLIS = phrase("Coriolis acceleration of {0} relative to {1}")
LAWS: dict[type, Said] = {
    Swing: said("the rest of the relative acceleration is tangential, perpendicular to the line of the points"),
    Slip: said("the link's angular acceleration is known, so its points' ends differ by a known vector"),
    Carry: said("the end lies on a line through the auxiliary point's end, perpendicular to the line joining the "
                "points"),
    Settle: said("the rest of the relative acceleration is tangential, perpendicular to the line of the points"),
    SimilarFigure: said("the ends of a link's points form a figure similar to the link's, a quarter turned"),
    GuideLocus: said("beyond the Coriolis vector the sliding pair leaves only an acceleration along the guide"),
    Roll: said("where two links roll on each other their accelerations agree perpendicular to the line of centres"),
    Meet: said("the end lies on both"),
    Pole: said("the pole's ends in the two links differ by the vector that the perpendiculars to the bars cut off"),
}
ALONG_CENTRES = said("the normal acceleration about the centre lies along the line of centres, as the locus does, and "
                     "is not needed")


class Anchor(NamedTuple):
    """Start of a link's figure: a point that it shares with a link drawn before, by a joint, slide or drive."""

    link: str
    point: str
    slide: Slide | None = None


class Normal(MotionPlan):
    """The plan of relative normal accelerations."""

    panel, turn, across, laws, ending = N_PLAN, "perpendicular", False, LAWS, "{1}_1"
    words = ACCELERATIONS

    def __init__(self, board: Board, net: Network, pose: Pose, velocity: Velocity, moves: Iterable[Move]):
        super().__init__(board, net, pose, velocity.tempo)
        self.velocity = velocity
        self.passing = {m.slide.name: m.point for m in moves if isinstance(m, GuideLocus) and m.point in pose.points}
        self.figures: dict[tuple[str, str], Mark] = {}
        self.centres = {(link, net.place(guide.at, link)[0]): centre for guide in rolling_guides(net.scene)
                        for link in (guide.link, guide.along)
                        for centre in guide.through or () if centre in net.links.get(link, ())}
        self.order: dict[str, int] = {}
        self.anchors = self._anchors()

    # ---- the links' figures ---------------------------------------------------------------------------------

    def _moving(self, link: str) -> bool:
        return self.net.body[link] != self.net.ground

    def _anchors(self) -> dict[str, Anchor]:
        """Each link's figure hangs on one drawn before it; a component begins at its richest link."""
        anchors: dict[str, Anchor] = {}
        links = [link for link in self.net.links if link != FRAME and self._moving(link)]
        joints = {k: sum(len(self.net.links_of[p]) > 1 for p in self.net.links[k]) for k in links}
        for root in sorted(links, key=lambda link: -joints[link]):
            if root not in anchors:
                self._hang(root, Anchor("", self._centre(root)), anchors)
        return anchors

    def _hang(self, root: str, anchor: Anchor, anchors: dict[str, Anchor]) -> None:
        """Give a link its anchor, and all that hang on it theirs: links tied by drives before the others."""
        anchors[root] = anchor
        tied, others = deque([root]), deque([root])
        while tied or others:
            if tied:
                beside = self._driven_beside(tied.popleft())
            else:
                self.order[others[0]] = len(self.order)
                beside = self._neighbours(others.popleft())
            for link, at in beside:
                if link not in anchors and self._moving(link):
                    anchors[link] = at
                    tied.append(link)
                    others.append(link)

    def _centre(self, root: str) -> str:
        """The point at which the plan begins: a joint with another rich link, if the root has one."""
        net = self.net

        def riches(point: str) -> int:
            return max((len(net.links[k]) for k in net.links_of[point] if k not in (root, FRAME)), default=0)

        return max(net.links[root], key=riches)

    def _driven_beside(self, link: str) -> Iterable[tuple[str, Anchor]]:
        """The links that drives tie to a link: what they prescribe is measured from there."""
        for weld in self.net.welds.values():
            if link in (weld.link, weld.to):
                other = weld.to if link == weld.link else weld.link
                yield other, Anchor(link, weld.slide.at if weld.slide else weld.at, weld.slide)

    def _neighbours(self, link: str) -> Iterable[tuple[str, Anchor]]:
        """The links beside a link, by pins and slides."""
        for point in self.net.links[link]:
            for other in self.net.links_of[point]:
                yield other, Anchor(link, point)
        for slide in self.net.slides:
            if link in (slide.link, slide.along):
                other = slide.along if link == slide.link else slide.link
                yield other, Anchor(link, self.passing.get(slide.name, slide.at), slide)

    def plan_origin(self, place: BodyPoint) -> Mark:
        point, link = place
        if link:
            return self.figure(link, point)
        links = self.net.links_of[point]
        moving = sorted((k for k in links if k in self.order), key=lambda k: self.order[k])
        return self.figure((moving or [k for k in links if k != FRAME] or [FRAME])[0], point)

    def figure(self, link: str, point: str) -> Mark:
        point = self.net.place(point, link)[0]
        if (link, point) not in self.figures:
            mark = self._crank_figure(link, point) if not self._moving(link) else self._figured_point(link, point)
            self.figures[link, point] = mark
        return self.figures[link, point]

    def figure_name(self, link: str, point: str) -> str:
        home = (point, "") if point in self.net.links[link] else (point, link)
        links = [k for k in self.net.links_of.get(point, ()) if k in self.order]
        first = min(links, key=lambda k: self.order[k], default=link)
        name = self.pose.letter_of_point(point).lower()
        if first == link and not home[1]:
            return name
        return self.net.coincident_name(point, link).lower() or f"{name}({link})"

    def _crank_figure(self, link: str, point: str) -> Mark:
        """The figure of a crank is drawn on the crank itself: its points towards the pivot, as far as omega bids."""
        chain = self.net.chain(link)
        if not chain:
            return self.pose.points[point]
        weld = chain[0]
        joint = weld.slide.at if weld.slide else weld.at
        base = self.pose.points[joint] if weld.to == FRAME else self._driven_seat(weld, joint)
        omega = sum(w.sign * self.tempo.rate(w.drive.rate) for w in chain if not w.drive.slides)
        A, X = self.pose.points[joint], self.pose.points[point]
        if not omega or self.net.coincide(point, joint):
            return base
        if omega * omega == 1 and base is A:
            return X
        arm = Quantity(f"ω²·{joint}{point}", self.words.kind)
        return self._normal(link, joint, point, partial(
            self.board.step_off, A, X, base, ratio=omega * omega, quantity=arm))

    def _normal(self, link: str, K: str, X: str, draw: Callable[..., Mark]) -> Mark:
        """The mark of X, drawn from that of K in the figure of their link: the vector is the acceleration of K."""
        places = [self.net.place(point, link) for point in (K, X)]
        with self.board.on(stage=partial(self.stages.normal, *places)):
            return draw(why=NORMAL(*(self.stages.name(*place) for place in places)))

    def _driven_seat(self, weld: DrivenPair, joint: str) -> Mark:
        if weld.slide is None:
            return self.figure(weld.to, joint)
        return self._less_coriolis(weld.slide, weld.to, weld.link, joint)

    def _figured_point(self, link: str, point: str) -> Mark:
        """A point of a moving link's figure: its anchor, or by the similar figure on one side of the link."""
        anchor = self.anchors[link]
        if point == self.net.place(anchor.point, link)[0]:
            return self.board.give_name(self._anchor_figure(link, anchor), self.figure_name(link, point))
        if self.net.never_turns(link) or self.net.coincide(point, anchor.point):
            return self.figure(link, anchor.point)
        mark = self._figure_side(link, anchor.point, point)
        return self.board.give_name(mark, self.figure_name(link, point))

    def _anchor_figure(self, link: str, anchor: Anchor) -> Mark:
        if not anchor.link:
            name = self.figure_name(link, anchor.point)
            begins = [step for step in self.board.steps if step.op.movement is Movement.BEGUN]
            plan = self.panel.numbered_part(1 + sum(step.panel.whole == self.panel for step in begins))
            with self.board.on(self.panel, stage=beginning_stage(name, plan.words)):
                return self.board.begin(plan=plan, name=name)
        if anchor.slide is None:
            return self.figure(anchor.link, anchor.point)
        return self._less_coriolis(anchor.slide, anchor.link, link, anchor.point)

    def _figure_side(self, link: str, K: str, X: str) -> Mark:
        """The figure's side KX, by the semicircle on the link's first side from K or in proportion to it."""
        side = self._side(link, K) or X
        points = self.pose.points
        if side == X:
            return self._normal(link, K, X, lambda why: self.board.normal(
                points[K], points[X], *self.velocity.relative(link, K, X), self.figure(link, K), why=why))
        ends = self.figure(link, K), self.figure(link, side)
        with self.board.on(stage=partial(self.stages.figure, link)):
            return self.board.similar(points[K], points[side], points[X], *ends, turn="parallel")

    def _side(self, link: str, K: str) -> str | None:
        """The other end of the side on which the semicircle is drawn: a joint if there is one."""
        names = [p for p in self.net.links[link] if self.net.spot(p) != self.net.spot(K)]
        return max(names, key=lambda p: len(self.net.links_of[p]) > 1, default=None)

    def level(self, link: str, point: str) -> Mark:
        """A mark of a link's figure that stands level with that of a point of contact, along the line of centres: that
        of the centre, where the figure begins there or has it already."""
        centre, anchor = self.centres.get((link, point), ""), self.anchors.get(link)
        known = anchor and (anchor.point == centre or (link, centre) in self.figures)
        return self.figure(link, centre if known else point)

    def stands_level(self, link: str, point: str, centre: str) -> bool:
        """Whether the vectors of both begin in the link's figure, one a point of contact, the other its centre."""
        homes = [self.net.place(name, link) for name in (point, centre)]
        return self.centres.get((link, homes[0][0])) == centre and all(
            self.plan_origin(home) is self.figure(link, home[0]) for home in homes)

    # ---- drives, guides, given motions ----------------------------------------------------------------------

    def start(self, weld: DrivenPair, point: str) -> Mark:
        return self.pose.points[weld.slide.at if weld.slide else weld.at]

    def prescribed_length(self, rates: tuple[Number, Number]) -> Number:
        return self.tempo.change(rates[1])

    def hop(self, weld: DrivenPair, point: str, mark: Mark, sign: int) -> Mark:
        one, two = self._gap(weld)
        return super().hop(weld, point, self.shift_by(mark, one, two) if sign > 0 else self.shift_by(mark, two, one),
                           sign)

    def _gap(self, weld: DrivenPair) -> Vector:
        """Vector between the figures of a drive's two links where they meet; zero if one depends on the other."""
        if weld.slide is None:
            return self.figure(weld.to, weld.at), self.figure(weld.link, weld.at)
        at = weld.slide.at
        return self.seat(weld.slide, weld.to, weld.link, at), self.figure(weld.link, at)

    def seat(self, slide: Slide, known: str, new: str, point: str) -> Mark:
        if self._hangs(slide, known, new):
            return self.figure(new, point)
        return self._less_coriolis(slide, known, new, point)

    def _hangs(self, slide: Slide, one: str, two: str) -> bool:
        """Whether one link's figure hangs on the other's by this slide: then the Coriolis vector is in it already."""
        pairs = ((one, two), (two, one))
        return any(k in self.anchors and self.anchors[k].slide is slide and self.anchors[k].link == o for k, o in pairs)

    def _guide(self, slide: Slide, point: str, known: str, new: str, move: Move) -> None:
        place = self.net.place(point, new)
        if not isinstance(slide, RollingGuide) or not (place[1] or self.net.links_of[place[0]] == (new,)):
            super()._guide(slide, point, known, new, move)
            return
        seat, own = (self.level(link, self.net.place(point, link)[0]) for link in (known, new))
        through = self.shift_by(self.end_in(known, point), seat, own)
        law = None if own is self.figures.get((new, place[0])) else ALONG_CENTRES
        self._locus((place, slide.name), self.board.parallel(self.pose.guide(slide), through), move, law)

    def _less_coriolis(self, slide: Slide, known: str, new: str, B: str) -> Mark:
        """The coincident point's mark in the known link's figure, less the Coriolis vector of `new` about `known`."""
        start = self.figure(known, B)
        if not self.net.turns(slide):
            return start
        link, P = self._pivot(slide.guiding, B)
        one, two = (self.net.place(B, end) for end in (known, new))
        with self.board.on(stage=partial(self.stages.coriolis, link, one, two)):
            turning = self.velocity.relative_velocity(link, P, B)
            slip = self.velocity.slip(known, new, B)
            why = CORIOLIS(self.stages.name(*one), self.stages.name(*two))
            return self.board.coriolis(self.pose.points[P], self.pose.points[B], turning, slip, start, why=why)

    def _pivot(self, links: tuple[str, ...], B: str) -> tuple[str, str]:
        """A point to measure the turning of a guide about: one of its links', fixed to the frame if there is such."""
        net = self.net
        found = [(link, p) for link in links for p in net.links[link] if net.spot(p) != net.spot(B)]
        if found:
            return max(found, key=lambda pair: FRAME in net.links_of[pair[1]])
        return links[0], next(p for p in self.pose.points if net.spot(p) != net.spot(B))

    def assume(self, place: BodyPoint, locus: Mark, ratio: Number) -> Mark:
        """Assume a trial end in proportion to a side of the link and its normal vector together: accelerations may be
        far larger than links, or zero."""
        point, link = place
        for name in [link] if link else self.net.links_of[point]:
            K = self._base(name, point) if self._moving(name) else None
            side = self._side(name, K) if K else None
            if K and side:
                return self.board.pick(locus, self.plan_origin(place), self.figure(name, side), self.pose.points[K],
                                       self.pose.points[side], ratio=ratio)
        return super().assume(place, locus, ratio)

    def _base(self, link: str, point: str) -> str:
        """The point of a link at whose mark the vector of another begins."""
        return point

    def pole_shift(self, move: Pole) -> Vector | None:
        """The perpendiculars to the two bars cut off what the poles' images differ by."""
        one, two = move.bodies
        origin: Mark | None = None
        gaps = []
        for bar, D, G in move.bars:
            begin = self.figure(self.net.link_at(one, D), D[0])
            end = self.figure(self.net.link_at(two, G), G[0])
            start = self.shift_by(self.figure(bar, G[0]), self.figure(bar, D[0]), begin)
            origin = start if origin is None else origin
            tip = self.shift_by(end, start, origin)
            side = self.board.side(self.point(D), self.point(G))
            gaps.append(self.board.perpendicular(side, tip))
        assert origin is not None
        return origin, self.board.meet(*gaps)

    def sliding(self, slide: Slide) -> Vector:
        """Of a link that drives tie to the frame, whose figure lies on the mechanism plan, where its point's own vector
        is drawn."""
        (begin, end), place = super().sliding(slide), self.net.place(slide.at, slide.link)
        if self._moving(slide.link) or place not in self.ends:
            return begin, end
        return self.shift_by(begin, self.figure(slide.link, slide.at), self.plan_origin(place)), self.ends[place]

    # ---- letters --------------------------------------------------------------------------------------------

    def locus_name(self, place: BodyPoint) -> str:
        name = self.pose.letter_of_point(place[0])
        letter, rest = name[0].upper(), name[1:].strip("_")
        has_one = letter in GREEK and name.lower() not in GREEK.values()  # k of "kappa" is no letter
        return GREEK[letter] + (f"_{rest}" if rest else "") if has_one else ""
