"""A plan: how the moves are drawn, whatever the plan is of.

Velocities and accelerations are one linear problem. On each plan the ends of a link's vectors are the image of the
link, with parallel sides or a quarter turned (`turn`). What differs is where a point's vector begins:

- `plan_origin(place)` is the mark from which the place's vector is laid off;
- `figure(link, X)` is where X stands in the link's own figure: a joint's two links have it apart where a ring of links
  does not close on the plan. Between the two all marks shift by that vector.
Plans: orthogonal velocities on the mechanism plan, relative normal accelerations, and the two polar plans.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import partial

from graphplan.errors import Refused
from graphplan.kernel.kinds import POINT
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.mechanism.model import Number, Slide
from graphplan.methods.assembly import Pose
from graphplan.methods.motion import moves
from graphplan.methods.motion.facts import shift_mark, start_on
from graphplan.methods.motion.moves import Locus, Move, draw_false_position
from graphplan.methods.motion.network import POLE, BodyPoint, DrivenPair, Network
from graphplan.methods.motion.stages import MotionStages, Words, auxiliary
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.motion.vector_parts import Vector, VectorPart
from graphplan.methods.panels import link_named
from graphplan.phrases import Said, phrase, said

FIXED = phrase("{0} lies on {1} itself: {2} is fixed")


class MotionPlan:
    """Draws moves on one panel. Subclasses say where vectors begin, and what drives and guides add."""

    panel: Panel
    turn: str
    across: bool  # whether a sliding pair's free vector lies perpendicular to the guide
    laws: Mapping[type, Said]  # by which each kind of move is drawn
    words: Words
    turned = False  # whether all vectors are drawn a quarter ahead
    ending: str  # the letter of an end, made from that of its point in small letters, or as it is

    def __init__(self, board: Board, net: Network, pose: Pose, tempo: Tempo):
        self.board, self.net, self.pose, self.tempo = board, net, pose, tempo
        self.ends: dict[BodyPoint, Mark] = {}
        self.loci: dict[Locus, Mark] = {}
        self._located: set[BodyPoint] = set()
        self.prime = ""  # of the letters in a trial figure
        self.known: dict[str, tuple[BodyPoint, ...]] = dict.fromkeys(net.members, ())
        self._told: set[tuple[str, str]] = set()
        self.pole_vectors: dict[tuple[BodyPoint, str], Vector] = {}
        self.parts: list[VectorPart] = []
        self.stages = MotionStages(net, self.words, self.laws, self.ending, {})

    # ---- what a plan says of itself -------------------------------------------------------------------------

    def plan_origin(self, place: BodyPoint) -> Mark:
        raise NotImplementedError

    def figure(self, link: str, point: str) -> Mark:
        raise NotImplementedError

    def start(self, weld: DrivenPair, point: str) -> Mark:
        """End of the vector of a point of the frame, in the figure of a link that the drive ties to the frame."""
        raise NotImplementedError

    def prescribed_length(self, rates: tuple[Number, Number]) -> Number:
        """Drawn length of a prescribed velocity and acceleration: one of them, in the scale of the plan."""
        raise NotImplementedError

    def hop(self, weld: DrivenPair, point: str, mark: Mark, sign: int) -> Mark:
        """The end of a point in the plane of `weld.link` from its end in that of `weld.to` (sign 1), or back (-1)."""
        X, much = self.pose.points[point], sign * weld.sign * self.prescribed_length(weld.drive.rates)
        if weld.slide is None:
            A = self.pose.points[weld.at]
            if A is X or not much:
                return mark
            return A if self.turned and much == 1 and mark is X else self._step((A, X), mark, much)
        line = self.pose.guide(weld.slide, run=True)
        line = self.board.perpendicular(line, X) if self.across else line
        return self.board.lay_along(line, mark, length=much, quantity=self.words.given_vector()) if much else mark

    def _step(self, base: Vector, at: Mark, ratio: Number) -> Mark:
        """`at` moved by the image of a vector of a link that turns so much."""
        draw, times = (self.board.step_off, -ratio) if self.turned else (self.board.step_across, ratio)
        return draw(*base, at, ratio=times, quantity=self.words.turning_part(*(mark.step.name for mark in base)))

    def seat(self, slide: Slide, known: str, new: str, point: str) -> Mark:
        """Start of the vector of the guide's coincident point, for use in the other link's figure."""
        raise NotImplementedError

    def draw_given_point(self, place: BodyPoint) -> Mark:
        """The end of a point whose motion the scene gives."""
        motion, home = self.pose.scene.motions[place[0]], self.plan_origin(place)
        dx, dy = map(self.prescribed_length, zip(motion.velocity, motion.acceleration, strict=True))
        dx, dy = (-dy, dx) if self.turned else (dx, dy)
        given = self.words.given_vector(self.stages.vector(self.words.symbol, place).name, turned=self.turned)
        return self.board.lay_off(home, dx=dx, dy=dy, quantity=given) if dx or dy else home

    def turned_by(self, body: str, like: str, base: Vector, at: Mark) -> Mark:
        """`at` moved by what the turning of `body` exceeds that of `like` on the vector `base`."""
        ratio = self.prescribed_length(self.net.excess(body, like))
        return self._step(base, at, ratio) if ratio else at

    def assume(self, place: BodyPoint, locus: Mark, ratio: Number) -> Mark:
        """An end on a locus for a trial, in proportion to how far its place is from another point of its link."""
        far, home = self.pose.far_from(place), self.plan_origin(place)
        start = home if far.panel == home.panel else self.point(place)
        return self.board.pick(locus, home, home, start, far, ratio=ratio)

    def pole_shift(self, move: moves.Pole) -> Vector | None:
        """The vector from the relative pole's end in the first body to its end in the second, if there is any."""
        return None

    def end_name(self, place: BodyPoint) -> str:
        return self.stages.end(self.pose.letter_of_point(place[0]), place)

    def locus_name(self, place: BodyPoint) -> str:
        return ""

    # ---- drawing moves --------------------------------------------------------------------------------------

    def draw(self, planned: Iterable[Move]) -> None:
        for group in self.stages.group_moves(planned):
            stage = partial(self.stages.tell, group, self.prime, self.stages.place(group[-1]) in self._located)
            for move in group:
                with self.board.on(self.panel, self._links(move), stage):
                    if isinstance(move, moves.FalsePosition):
                        draw_false_position(self, move)
                    else:
                        self._draw(move)

    def _draw(self, move: Move) -> None:
        match move:
            case moves.Rest(place):
                self._end(place, self._resting_end(place))
            case moves.Seed(place):
                self._end(place, self.draw_given_point(place))
            case moves.Swing(body, K, X, source):
                through = self._outward(body, X, self._inward(body, K, self.ends[K]))
                side = self.pose.side(K[0], X[0])
                line = getattr(self.board, self.turn)(side, through)
                named = "".join(self.board.steps[end].name for end in side.step.args)
                fixed = FIXED(self.end_name(X), named, self.pose.letter_of_point(K[0])) if line is side else None
                self._locus((X, source or body), line, move, fixed)
            case moves.Slip(body, A, X, like, source):
                self._locus((X, source or body), self._shift_locus(body, A, X, like), move)
            case moves.Carry(body, A, B, X, source):
                ends = [self.point(A[0]), self._locus_in(body, A), self.point(B[0]), self._locus_in(body, B)]
                line = self.board.carry(*ends, self.point(X), turn=self.turn, names=self._letters(body, A, B, X))
                self._locus((X, source or body), self._outward(body, X, line), move)
            case moves.Settle(body, K, X, B):
                self._end(X[0], self._outward(body, X[0], self._settle_trials(body, K, X, B)), move)
            case moves.SimilarFigure(body, K, X, R, like, copy):
                self._end(copy or X, self.drawn_figure(body, K, X, R, like), move)
            case moves.GuideLocus(slide, point, known, new):
                self._guide(slide, point, known, new, move)
            case moves.Common(point=point, known=known, new=new):
                place = self.net.place(point, new)
                end = self.end_in(known, point)
                self._end(place, self.shift_by(end, self.figure(new, point), self.plan_origin(place)))
            case moves.Meet(place, (one, two), copy):
                self._end(copy or place, self.board.meet(self.loci[place, one], self.loci[place, two]), move)
            case moves.Auxiliary(body, A, B, place):
                self._auxiliary(body, A, B, place, move)
            case moves.Pole():
                self._pole(move)

    def _links(self, move: Move) -> tuple[str, ...]:
        """The links that a step's fault should name."""
        names: list[str] = []
        if isinstance(move, moves.Meet):
            names = [link for source in move.sources for link in self.net.told_by(source)]
        elif isinstance(move, moves.GuideLocus | moves.Common):
            names = [move.known, move.new]
        elif (body := getattr(move, "body", "")) in self.net.members:
            names = self.net.members[body]
        return self.net.given_links(names)

    def _end(self, place: BodyPoint, mark: Mark, move: Move | None = None) -> None:
        self.know(place, self.board.give_name(mark, self.end_name(place) + self.prime))
        self._reason(mark, self.laws.get(type(move)))

    def _reason(self, mark: Mark, law: Said | None) -> None:
        """Tell the law of a mark that was drawn just now."""
        if law and mark.step.index == len(self.board.steps) - 1:
            self.board.annotate(mark.step.index, why=law)

    def know(self, place: BodyPoint, mark: Mark) -> None:
        """Enter an end; the bodies there may be drawn from it."""
        if place not in self.ends and (place[1] in self.net.body or not place[1]):
            for body in self.net.bodies_at(place):
                if (body, self.net.spot(place[0])) not in self._told:
                    self._told.add((body, self.net.spot(place[0])))
                    self.known[body] += (place,)  # a figure needs points that lie apart
        self.ends[place] = mark

    def _locus(self, locus: Locus, mark: Mark, move: Move, law: Said | None = None) -> None:
        if name := self.locus_name(locus[0]):
            self.board.give_name(mark, name + self.prime)
        self._reason(mark, law or self.laws.get(type(move)))
        self.loci[locus] = mark
        self._located.add(locus[0])

    def point(self, place: BodyPoint) -> Mark:
        """The place on the mechanism plan."""
        return self.pose.points[place[0]]

    # ---- between origin and figure --------------------------------------------------------------------------

    def _inward(self, body: str, place: BodyPoint, mark: Mark) -> Mark:
        """A mark at a place's home, shifted into the figure of the body's top link."""
        if place[1] == POLE:
            vector = self.pole_vectors.get((place, body))
            return mark if vector is None else self.shift_by(mark, *vector)
        link = self.net.link_at(body, place)
        mark = self.shift_by(mark, self.plan_origin(place), self.figure(link, place[0]))
        for weld in self.net.chain(link):
            mark = self._hop_over(weld, place[0], mark, -1)
        return mark

    def _outward(self, body: str, place: BodyPoint, mark: Mark) -> Mark:
        """A mark in the figure of the body's top link, shifted to the place's home."""
        if place[1] == POLE:
            vector = self.pole_vectors.get((place, body))
            return mark if vector is None else self.shift_by(mark, vector[1], vector[0])
        link = self.net.link_at(body, place)
        mark = self._carry_down(link, place[0], mark)
        return self.shift_by(mark, self.figure(link, place[0]), self.plan_origin(place))

    def _carry_down(self, link: str, point: str, mark: Mark) -> Mark:
        """From the top link of a body down to one of its links."""
        for weld in reversed(self.net.chain(link)):
            mark = self._hop_over(weld, point, mark, 1)
        return mark

    def _hop_over(self, weld: DrivenPair, point: str, mark: Mark, sign: int) -> Mark:
        if mark.kind == POINT:
            return self.hop(weld, point, mark, sign)
        start = start_on(self.board, mark, self.pose.points[point])
        return self.shift_by(mark, start, self.hop(weld, point, start, sign))

    def shift_by(self, mark: Mark, one: Mark, two: Mark) -> Mark:
        """A point or line shifted by the vector from one mark to another."""
        return shift_mark(self.board, mark, one, two)

    def _locus_in(self, body: str, locus: Locus) -> Mark:
        return self._inward(body, locus[0], self.loci[locus])

    def end_in(self, link: str, point: str) -> Mark:
        """The end of a point in a link's own figure, drawn from the link's known ends if need be."""
        place, body = self.net.place(point, link), self.net.body[link]
        if place in self.ends:
            return self.shift_by(self.ends[place], self.plan_origin(place), self.figure(link, place[0]))
        if body == self.net.ground:
            return self._driven_end(link, point)
        return self._carry_down(link, point, self._image(body, place))

    def note_part(self, kind: str, letter: str, start: Mark, end: Mark | BodyPoint, of: str = "") -> None:
        """Enter a part of a vector, of the points that its letter says or `of` this one."""
        self.parts.append(VectorPart(kind, of or letter.partition("_")[2], letter, start, end))

    def vector(self, link: str, point: str) -> Vector:
        """Begin and end of the vector of a point of a link's plane."""
        return self.figure(link, point), self.end_in(link, point)

    def turning(self, link: str, P: str, R: str) -> Vector:
        """Begin and end of the vector that a link's turning makes of its side PR."""
        return self.end_in(link, P), self.end_in(link, R)

    def sliding(self, slide: Slide) -> Vector:
        """Begin and end of the vector of a slide's link along the other, at its point."""
        begin, end = self.end_in(slide.along, slide.at), self.end_in(slide.link, slide.at)
        seat = self.seat(slide, slide.along, slide.link, slide.at)
        return self.shift_by(begin, seat, self.figure(slide.link, slide.at)), end

    def _driven_end(self, link: str, point: str) -> Mark:
        """The end of a point of the frame, or of a link that drives tie to it."""
        chain = self.net.chain(link)
        return self._carry_down(link, point, self.start(chain[-1], point) if chain else self.figure(link, point))

    def _resting_end(self, place: BodyPoint) -> Mark:
        link = self.net.link_at(self.net.ground, place)
        mark = self._driven_end(link, place[0])
        return self.shift_by(mark, self.figure(link, place[0]), self.plan_origin(place))

    def _image(self, body: str, place: BodyPoint) -> Mark:
        """The end of a place in the figure of the body's top link, by two known ends or one and the turning."""
        known = [p for p in self.known[body] if p != place]
        here = next((p for p in known if self.net.spot(p[0]) == self.net.spot(place[0])), None)
        if here:
            return self._draw_similar(body, here, place, None, "")
        if len(known) > 1:
            return self._draw_similar(body, known[0], place, known[1], "")
        partner = self._partner(body)
        return self._draw_similar(body, known[0], place, None, partner)

    def _partner(self, body: str) -> str:
        """A body that turns alike and has two known ends, or the frame's."""
        alike = [b for b, c in self.net.classes.items() if c == self.net.classes[body] and b != body]
        if self.net.ground in alike:
            return self.net.ground
        if partner := next((b for b in alike if len(self.known[b]) > 1), ""):
            return partner
        raise Refused(link_named(body), said("no known construction determines it"), "ask for other links")

    # ---- the single moves -----------------------------------------------------------------------------------

    def _shift_locus(self, body: str, A: Locus, X: BodyPoint, like: str) -> Mark:
        """A's locus moved along by the known vector from A's end to X's."""
        locus = self._locus_in(body, A)
        start = start_on(self.board, locus, self.point(A[0]))
        line = self.shift_by(locus, start, self._as_turned(body, like, A[0], X, start))
        return self._outward(body, X, line)

    def _as_turned(self, body: str, like: str, A: BodyPoint, X: BodyPoint, at: Mark) -> Mark:
        """`at` moved by the image of AX in a body that turns as `like` does, but for a known difference."""
        if self.net.coincide(A[0], X[0]):
            return at
        base = self.point(A), self.point(X)
        if like == self.net.ground:
            mark = self.at_rest(base, at)
        elif (same := self._same_side(like, base)) is not None:
            mark = self.shift_by(at, *same)
        else:
            K, R = self.known[like][:2]
            ends = self._inward(like, K, self.ends[K]), self._inward(like, R, self.ends[R])
            sides = self.point(K), self.point(R)
            tip = self.board.similar(*sides, self.board.transfer(*base, sides[0]), *ends, turn=self.turn)
            mark = self.board.transfer(ends[0], tip, at)
        return self.turned_by(body, like, base, mark)

    def _same_side(self, like: str, base: Vector) -> Vector | None:
        """The image of the very vector `base`, if the other body knows the ends of points in the same places."""
        ends = [next((p for p in self.known[like] if self.point(p) is mark), None) for mark in base]
        if ends[0] is None or ends[1] is None:
            return None
        return self._inward(like, ends[0], self.ends[ends[0]]), self._inward(like, ends[1], self.ends[ends[1]])

    def at_rest(self, base: Vector, at: Mark) -> Mark:
        """The mark `at` moved by the image of a vector of a link that does not turn: by the vector, or not at all on a
        turned plan."""
        if self.turn == "perpendicular":
            return at
        return base[1] if at is base[0] else self.board.transfer(*base, at)

    def _settle_trials(self, body: str, K: BodyPoint, X: Locus, B: Locus) -> Mark:
        known = self.point(K), self._inward(body, K, self.ends[K])
        one, two = self._locus_in(body, X), self._locus_in(body, B)
        return self.board.settle(*known, self.point(X[0]), one, self.point(B[0]), two, turn=self.turn)

    def _draw_similar(self, body: str, K: BodyPoint, X: BodyPoint, R: BodyPoint | None, like: str) -> Mark:
        at = self._inward(body, K, self.ends[K])
        if R is None:
            return self._as_turned(body, like, K, X, at)
        sides = self.point(K), self.point(R), self.point(X)
        other = self._inward(body, R, self.ends[R])
        return self.board.similar(*sides, at, other, turn=self.turn)

    def drawn_figure(self, body: str, K: BodyPoint, X: BodyPoint, R: BodyPoint | None, like: str) -> Mark:
        """The end of X at its home, by the figure of its body."""
        return self._outward(body, X, self._draw_similar(body, K, X, R, like))

    def _guide(self, slide: Slide, point: str, known: str, new: str, move: Move) -> None:
        place = self.net.place(point, new)
        own = self.figure(new, place[0])
        through = self.shift_by(self.end_in(known, point), self.seat(slide, known, new, point), own)
        through = self.shift_by(through, own, self.plan_origin(place))
        side = self.board.perpendicular if self.across else self.board.parallel
        self._locus((place, slide.name), side(self.pose.guide(slide), through), move)

    def _auxiliary(self, body: str, A: Locus, B: Locus, place: BodyPoint, move: Move) -> None:
        """The auxiliary point itself, where a sliding pair needs it."""
        homes = [getattr(self.board, self.turn)(self.loci[locus], self.point(locus[0])) for locus in (A, B)]
        if place[0] not in self.pose.points:
            self.pose.points[place[0]] = self.board.meet(*homes, name=self.pose.letter(body))
        self.stages.letters[place[0]] = self.pose.letter_of_point(place[0])
        end = self.board.meet(self._locus_in(body, A), self._locus_in(body, B))
        self._end(place, self._outward(body, place, end), move)

    def _letters(self, body: str, A: Locus, B: Locus, X: BodyPoint) -> dict[str, str]:
        """Letters for the auxiliary point of a body and its end, and for the corners of trial figures."""
        letter = self.stages.letters[auxiliary(body)] = self.pose.letter(body)
        trial = {f"{letter}{mark}": f"{self.pose.letter_of_point(place)}{mark}"
                 for letter, place in (("A", A[0][0]), ("B", B[0][0]), ("C", X[0])) for mark in ("'", "''")}
        return {"Q": letter, "q": self.end_name((letter, "")) + self.prime, "U": "U'", **trial}

    # ---- relative poles --------------------------------------------------------------------------------------

    def _pole(self, move: moves.Pole) -> None:
        if move.place[0] not in self.pose.points:
            bars = [self.board.side(self.point(one), self.point(two)) for _, one, two in move.bars]
            self.pose.points[move.place[0]] = self.board.meet(*bars, name=f"P_{move.bodies[0]}{move.bodies[1]}")
        self.stages.letters[move.place[0]] = self.pose.letter_of_point(move.place[0])
        if (vector := self.pole_shift(move)) is not None:
            self.pole_vectors[move.place, move.bodies[1]] = vector
