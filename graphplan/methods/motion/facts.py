"""Facts: what is known of the end of a vector or of a link, and which lines can coincide whatever the pose.

A pose's coordinates become residues; what is zero in the pose is zero here, and chance makes nothing else so.

Each body has three unknowns, each place two. A body with two facts gives every other place of it one (a locus), with
three facts two (the end itself). The moves are found on the mechanism's graph. The pose has one word in it: whether
facts are independent there. Two loci of a place that are parallel are one fact, three loci of a body through one point
are two; that is decided modulo a prime, and no length or angle matters. In general position nothing is so.

With `common` two links that roll on each other share the end of their pitch point, as velocities do where their line
of centres has its length: two facts, of which one follows from that.

A fact is filed at its place under its source, so that a body never takes its own word for news.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from fractions import Fraction
from itertools import chain, combinations
from random import Random

from graphplan.kernel.elementary import incident
from graphplan.kernel.kinds import LINE, POINT, Movement
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.equations import PRIME
from graphplan.mechanism.model import Number, Pair, Slide
from graphplan.mechanism.replaced import RollingGuide
from graphplan.methods.motion import moves
from graphplan.methods.motion.moves import Carry, Locus, Move
from graphplan.methods.motion.network import BodyPoint, Network

Two = tuple[int, int]
Triple = tuple[int, int, int]


def residue(number: Number) -> int:
    """A number of the scene; rounded ones as the binary fractions that they are."""
    exact = number if isinstance(number, Fraction) else Fraction(float(number))
    return exact.numerator * pow(exact.denominator, -1, PRIME) % PRIME


def residues(pair: Pair) -> Two:
    """A point or vector of the scene."""
    return residue(pair[0]), residue(pair[1])


def cross(p: Triple, q: Triple) -> Triple:
    """The line through two points, or the point of two lines."""
    return ((p[1] * q[2] - p[2] * q[1]) % PRIME, (p[2] * q[0] - p[0] * q[2]) % PRIME,
            (p[0] * q[1] - p[1] * q[0]) % PRIME)


def dot(p: Triple, q: Triple) -> int:
    """Product of a point and a line: zero if the point lies on the line."""
    return sum(a * b for a, b in zip(p, q, strict=True)) % PRIME


def difference(p: Two, q: Two) -> Two:
    """The vector from q to p."""
    return (p[0] - q[0]) % PRIME, (p[1] - q[1]) % PRIME


def product(p: Two, q: Two) -> int:
    """The inner product of two vectors."""
    return (p[0] * q[0] + p[1] * q[1]) % PRIME


def quarter(p: Two) -> Two:
    """A vector turned a quarter."""
    return -p[1] % PRIME, p[0]


def parallel(p: Two, q: Two) -> bool:
    """Whether two vectors are parallel, or one is zero."""
    return not product(p, quarter(q))


def line(normal: Two, at: Two) -> Triple:
    """The line through a point, perpendicular to a normal."""
    return *normal, -product(normal, at) % PRIME


def meet(k: Triple, l: Triple) -> Two | None:
    """The point of two lines; None where they are parallel."""
    x, y, w = cross(k, l)
    if not w:
        return None
    inverse = pow(w, -1, PRIME)
    return x * inverse % PRIME, y * inverse % PRIME


class Image:
    """Knowledge of a body's image X -> t + s X: the independent conditions on t and s that have been entered."""

    def __init__(self) -> None:
        self._rows: list[Triple] = []

    @property
    def rank(self) -> int:
        """The number of independent conditions: three tell the whole image."""
        return len(self._rows)

    def locus(self, normal: Two, at: Two) -> None:
        """The end of a point lies on a line with this normal."""
        self._enter((*normal, product(normal, at)))

    def end(self, at: Two) -> None:
        """The end of a point is known."""
        self._enter((1, 0, at[0]))
        self._enter((0, 1, at[1]))

    def turning(self) -> None:
        """The turning is known."""
        self._enter((0, 0, 1))

    def _enter(self, row: Triple) -> None:
        """Keep a condition that the others do not say."""
        match self._rows:
            case []:
                new = any(row)
            case [one]:
                new = any(cross(one, row))
            case [one, two]:
                new = dot(cross(one, two), row) != 0
            case _:
                new = False
        if new:
            self._rows.append(row)


def shift_mark(board: Board, mark: Mark, one: Mark, two: Mark) -> Mark:
    """A point or line shifted by the vector from one mark to another; the mark itself if these are one.

    The other mark may begin another plan: a point that is laid off from the one is laid off from the other.
    """
    if one is two:
        return mark
    if mark.kind == LINE:
        return board.shift(mark, one, two)
    if mark is one:
        return two
    return lay_vector(board, one, mark, two) if mark.panel == one.panel else lay_vector(board, one, two, mark)


def lay_vector(board: Board, P: Mark, Q: Mark, R: Mark) -> Mark:
    """The vector PQ laid off from R; one that drives prescribe, a_r, -ω²·AX and α·AX, in the scale of R's own plan, as
    a tenth of a millimetre on P's may be many there, and many here a tenth there."""
    normal, turned = P.step, Q.step
    if P.panel == R.panel:
        return board.transfer(P, Q, R)
    if turned.op.movement is Movement.LAID_ALONG and turned.args[1] == normal.index:
        line = board.marks[turned.args[0]]
        return board.lay_along(line, R, length=turned.params["length"], quantity=turned.quantity)
    if not (normal.quantity and normal.op.movement is Movement.LAID_OFF):
        return board.transfer(P, Q, R)
    A, X, base = (board.marks[index] for index in normal.args)
    turns = turned.quantity and turned.op.movement is Movement.TURNED and turned.args[2] == base.step.index
    if not (turns or Q is base):
        return board.transfer(P, Q, R)
    laid = board.step_off(X, A, R, ratio=normal.params["ratio"], quantity=normal.quantity)
    if not turns:
        return laid
    start, end, _ = (board.marks[index] for index in turned.args)
    return board.step_across(start, end, laid, ratio=turned.params["ratio"], quantity=turned.quantity)


def start_on(board: Board, line: Mark, here: Mark) -> Mark:
    """Start of the vector by which a line is shifted: here, if that is on the line's plan, else a point that the line
    was drawn through, else the beginning of its plan."""
    if here.panel == line.panel:
        return here
    through = [line.step.args[place] for place in incident(line.step.op)]
    begun = (step.index for step in board.steps if step.panel == line.panel and step.op.gives == POINT)
    return board.marks[through[0] if through else next(begun)]


Fact = Two | None  # the normal of a locus; nothing where the end itself is known
ANYWHERE: Two = (1939, 1974)  # the normal of what no line is drawn of, such as an assumption: like none of the pose


class Facts:
    """Known facts of one network, and the moves that found them."""

    def __init__(self, network: Network, general: bool = False, common: bool = False):
        self.net, self.common = network, common
        self.chance = Random(1939) if general else None  # gives what the pose does not
        self.moves: list[Move] = []
        self.facts: dict[BodyPoint, dict[str, Fact]] = {}
        self.drawn: set[BodyPoint] = set()
        self.places = {body: network.places_of(body) for body in network.members}
        for slide in network.slides:
            if not slide.turns_alike:
                self._add_place(network.body[slide.along], network.place(slide.at, slide.along))
        self.bodies = {place: network.bodies_at(place) for body in self.places for place in self.places[body]}
        self.told: dict[tuple[str, BodyPoint], int] = {}
        self.carried = set[tuple[str, BodyPoint]]()  # bodies and the places that have a locus by their auxiliary points
        self.spots: dict[str, Two] = {}
        self.turning: dict[str, str] = {}
        self.passed: set[str] = set()
        self.retired: set[str] = set()
        self.waiting: deque[str | Slide] = deque()
        self.queued: set[str | Slide] = set()

    def _on_redundant_fact(self, body: str) -> None:
        """A body has heard more facts than are independent: a planner with an open trial may close it here."""

    # ---- travelling -----------------------------------------------------------------------------------------

    def _seed(self) -> None:
        ground = self.net.ground
        if ground:
            self.turning[self.net.classes[ground]] = ground
            for place in self.places[ground]:
                self.moves.append(moves.Rest(place))
                self._file(place, ground, None)
            self._wake_class(ground)
        for point in sorted(map(self.net.name, self.net.scene.motions), key=self.net.order.point):
            self.moves.append(moves.Seed((point, "")))
            self._file((point, ""), "motion", None)
        self._queue(*[b for b in self.places if b != ground], *self.net.slides)

    def _queue(self, *nodes: str | Slide) -> None:
        for node in nodes:
            if node not in self.queued:
                self.queued.add(node)
                self.waiting.append(node)

    def _travel(self) -> None:
        while self.waiting:
            node = self.waiting.popleft()
            self.queued.discard(node)
            if isinstance(node, Slide):
                self._through_slide(node)
            elif node in self.retired:
                self._turning_known(node)
            elif node != self.net.ground:
                self._through_body(node)

    def _file(self, place: BodyPoint, source: str, fact: Fact, *, marked: bool = False) -> None:
        """Enter a fact; where a place then knows enough, its end is marked, and the neighbours are told."""
        here = self.facts.setdefault(place, {})
        here[source] = fact if here.get(source, fact) is not None else None
        if place not in self.drawn:
            pair = next(((one, two) for one, two in combinations(here, 2) if _cross(here[one], here[two])), None)
            if pair and not marked and None not in here.values():
                self.moves.append(moves.Meet(place, pair))
            if pair or marked or None in here.values():
                self.drawn.add(place)
        self._notify_listeners(place)

    def _notify_listeners(self, place: BodyPoint) -> None:
        for body in self._bodies_at(place):
            self._queue(body, *self.net.slides_of.get(body, ()))

    def _bodies_at(self, place: BodyPoint) -> list[str]:
        if place not in self.bodies:
            self.bodies[place] = self.net.bodies_at(place)
        return self.bodies[place]

    def _count_from_others(self, place: BodyPoint, body: str) -> int:
        """Number of independent facts of a place that come from other bodies."""
        facts = [fact for source, fact in self.facts.get(place, {}).items() if source != body]
        if None in facts or any(_cross(one, two) for one, two in combinations(facts, 2)):
            return 2
        return min(len(facts), 1)

    def _spot(self, place: BodyPoint) -> Two:
        """Place of a point in the pose."""
        point = place[0]
        if point not in self.spots:
            self.spots[point] = self._direction_of(self.net.scene.points[point])
        return self.spots[point]

    def _direction_of(self, pair: Pair) -> Two:
        """A point or direction of the pose, or in general position any other."""
        return residues(pair) if self.chance is None else (self.chance.randrange(PRIME), self.chance.randrange(PRIME))

    def _loci(self, body: str, but: BodyPoint = ("", "")) -> Iterator[Locus]:
        """Yield loci of the body's places from other sources, one a spot, without the spot of `but`."""
        seen = {self.net.spot(but[0])}
        for place in self.places[body]:
            spot = self.net.spot(place[0])
            if spot not in seen and (locus := self._locus_of(place, body)):
                seen.add(spot)
                yield locus

    def _locus_of(self, place: BodyPoint, body: str) -> Locus | None:
        """A locus of a place that another source than this body gives."""
        return next(((place, source) for source, fact in self.facts.get(place, {}).items()
                     if source != body and fact is not None and fact is not ANYWHERE), None)

    def _normal(self, locus: Locus) -> Two:
        """The normal of a locus on the plan of orthogonal velocities; on the others all are turned alike."""
        place, source = locus
        normal = self.facts[place][source]
        assert normal is not None
        return normal

    def _carried_normal(self, A: Locus, B: Locus, X: BodyPoint) -> Two:
        """The normal of the locus that two loci give a third place; zero if their crossing determines its end."""
        one, two = self._normal(A), self._normal(B)
        p = product(one, difference(self._spot(A[0]), self._spot(X)))
        q = product(two, difference(self._spot(B[0]), self._spot(X)))
        return (q * one[0] - p * two[0]) % PRIME, (q * one[1] - p * two[1]) % PRIME

    def _like(self, body: str) -> str:
        """The body by whose turning this one's is known, if any."""
        source = self.turning.get(self.net.classes[body], "")
        return "" if source == body else source

    def _count(self, body: str, but: BodyPoint | None = None) -> int:
        """Number of independent facts of a body, without those of one place."""
        image = Image()
        if self._like(body):
            image.turning()
        for place in self.places[body]:
            if place != but:
                self._enter(image, place, body)
        return image.rank

    def _enter(self, image: Image, place: BodyPoint, body: str) -> None:
        """Enter the facts of a place into a body's image, without those that come from the body."""
        at = self._spot(place)
        for source, fact in self.facts.get(place, {}).items():
            if source != body:
                image.end(at) if fact is None else image.locus(fact, at)

    def _excess(self, body: str) -> int:
        """Number of a body's facts that follow from its others."""
        heard = sum(self._count_from_others(place, body) for place in self.places[body]) + bool(self._like(body))
        return heard - self._count(body)

    def _is_known(self, body: str) -> bool:
        return body == self.net.ground or body in self.retired or self._count(body) >= 3

    def _through_body(self, body: str) -> None:
        count = self._count(body)
        self._on_redundant_fact(body)
        for place in self._closing_first(body):
            if place not in self.drawn:
                rest = self._count(body, place)
                here = max((self._count_from_others(other, body) for other in self._places_with(body, place)),
                           default=0)
                rank = 2 if rest >= 3 or here == 2 else 1 if rest == 2 or here == 1 else 0
                if rank > self.told.get((body, place), 0):
                    self._emit(body, place, rank)
        if count >= 3:
            self._turning_known(body)

    def _closing_first(self, body: str) -> list[BodyPoint]:
        """The places of a body; of one that is known by loci alone first those where the loci of two auxiliary points
        close, its own and another body's."""
        if self._ends(body) or self._like(body):
            return [*self.places[body]]
        _, names = self.net.auxiliary.get(body, ("", ()))
        return sorted(self.places[body], key=lambda place: (place[0] in names, not self._is_carried(place, body)))

    def _is_carried(self, place: BodyPoint, body: str) -> bool:
        """Whether another body's auxiliary point has given a place a locus."""
        return any((source, place) in self.carried for source in self.facts.get(place, ()) if source != body)

    def _places_with(self, body: str, X: BodyPoint) -> list[BodyPoint]:
        """The other places of a body that lie in one spot with X: they move alike, however the body turns."""
        spot = self.net.spot(X[0])
        return [place for place in self.places[body] if place != X and self.net.spot(place[0]) == spot]

    def _ends(self, body: str, but: BodyPoint = ("", "")) -> list[BodyPoint]:
        """The body's places whose ends are drawn, but for those in the spot of one place."""
        spot = self.net.spot(but[0])
        return [place for place in self.places[body] if place in self.drawn and self.net.spot(place[0]) != spot]

    def _emit(self, body: str, X: BodyPoint, rank: int) -> None:
        """Tell a place what the body knows of it, unless others have told the same: special geometry repeats it."""
        if (body, X) in self.net.repeating:
            return
        figure = self._figure(body, X) if rank == 2 else None
        if figure:
            self._tell_fact(body, X, [figure], None)
        elif not self.told.get((body, X)):  # known wholly, maybe, but no end is drawn yet to begin a figure at
            whole = self._settle(body, X) or self._similar_figure(body, X)
            line = self._line(body, X, self._locus_of(X, body) if whole else None)
            if line and whole:  # the locus is for others, who may ask for it; pruned if nobody does
                self._tell_fact(body, X, [line[0], whole], line[1], marked=True)
            elif whole:
                self._tell_fact(body, X, [whole], ANYWHERE, marked=True)
            elif line:
                self._tell_fact(body, X, [line[0]], line[1])
            elif crossing := self._auxiliary(body, X):
                self._tell_fact(body, X, [crossing], None)

    def _tell_fact(self, body: str, X: BodyPoint, moves: list[Move], fact: Fact, *, marked: bool = False) -> None:
        """Tell a place its end, or a locus of it."""
        self.moves += moves
        self.told[body, X] = 2 if fact is None else 1
        if isinstance(moves[-1], Carry):
            self.carried.add((body, X))
        self._file(X, body, fact, marked=marked)

    def _circle_normal(self, K: BodyPoint, X: BodyPoint) -> Two:
        """The normal of the locus that a body gives X about K."""
        return quarter(difference(self._spot(X), self._spot(K)))

    def _line(self, body: str, X: BodyPoint, own: Locus | None) -> tuple[Move, Two] | None:
        """One fact for X, and its normal: from an end, from a locus and the turning, or from two loci of the body.

        Where X has an own locus by which the body is known, a line that is parallel to it is no news: better another.
        """
        here = next(filter(None, (self._locus_of(place, body) for place in self._places_with(body, X))), None)
        if here:
            return moves.Slip(body, here, X, ""), self._normal(here)
        known, loci, like = self._ends(body, X), list(self._loci(body, X)), self._like(body)
        K = max(known, key=lambda place: self._count_from_others(place, body), default=None)
        if K and not (own and parallel(self._normal(own), self._circle_normal(K, X))):
            return moves.Swing(body, K, X), self._circle_normal(K, X)
        if loci and like:
            return moves.Slip(body, loci[0], X, like), self._normal(loci[0])
        if len(loci) > 1:
            A, B = self._auxiliary_loci(body, loci)
            if any(normal := self._carried_normal(A, B, X)):
                return moves.Carry(body, A, B, X), normal
        return (moves.Swing(body, K, X), self._circle_normal(K, X)) if K else None

    def _auxiliary_loci(self, body: str, loci: list[Locus]) -> list[Locus]:
        """The two of a body's loci that give its auxiliary point: those that the sheet names, else the first."""
        _, names = self.net.auxiliary.get(body, ("", ()))
        named = [locus for locus in loci if locus[0][0] in names]
        return named if len(named) == 2 else loci[:2]

    def _auxiliary(self, body: str, X: BodyPoint) -> moves.Auxiliary | None:
        """The end of X where it is itself the auxiliary point of two loci."""
        match list(self._loci(body, X)):
            case [A, B, *_] if _cross(self._normal(A), self._normal(B)) and not any(self._carried_normal(A, B, X)):
                return moves.Auxiliary(body, A, B, X)
        return None

    def _settle(self, body: str, X: BodyPoint) -> moves.Settle | None:
        """The end of X, in a body with three loci: from an end found by them, and the two others."""
        own, loci = self._locus_of(X, body), list(self._loci(body, X))
        known = [place for place, _ in loci if place in self.drawn]
        if len(loci) < 2 or not own or not known:
            return None
        K = known[0]
        return moves.Settle(body, K, own, next(locus for locus in loci if locus[0] != K))

    def _similar_figure(self, body: str, X: BodyPoint) -> moves.SimilarFigure | None:
        """The end of X, which has a locus of its own, from an end in its spot, or from another and the turning."""
        return next(chain(self._by_one(body, X), self._by_turning(body, X)), None) if self.facts.get(X) else None

    def _figure(self, body: str, X: BodyPoint) -> moves.SimilarFigure | None:
        """The end of X from the whole body, or from an end in the same spot."""
        return next(chain(self._by_one(body, X), self._by_two(body, X), self._by_turning(body, X)), None)

    def _by_one(self, body: str, X: BodyPoint) -> Iterator[moves.SimilarFigure]:
        """The end of X by one that is drawn in the same spot."""
        return (moves.SimilarFigure(body, K, X) for K in self._places_with(body, X) if K in self.drawn)

    def _by_turning(self, body: str, X: BodyPoint) -> Iterator[moves.SimilarFigure]:
        """The end of X by another and the turning of the body."""
        like = self._like(body)
        return (moves.SimilarFigure(body, K, X, like=like) for K in self._ends(body, X) if like)

    def _by_two(self, body: str, X: BodyPoint) -> Iterator[moves.SimilarFigure]:
        """The end of X by two others that lie apart."""
        return (moves.SimilarFigure(body, K, X, R=R) for K, R in combinations(self._ends(body, X), 2)
                if self.net.spot(K[0]) != self.net.spot(R[0]))

    def _meet_of_loci(self, body: str, X: BodyPoint) -> tuple[list[Move], moves.Meet] | None:
        """The end of X from loci elsewhere in the body: two of them and its turning, or three; None of fewer."""
        loci = [self._locus_of(place, body) for place in self.places[body]]
        spot, like = self.net.spot(X[0]), self._like(body)
        found: dict[str, Two] = {}
        lines: list[Move] = []
        if like:
            given = [locus for locus in loci if locus and self.net.spot(locus[0][0]) != spot]
            ways: Iterator[tuple[moves.Slip | moves.Carry, Two]] = (
                (moves.Slip(body, A, X, like), self._normal(A)) for A in given)
        else:
            apart = combinations(self._loci(body, X), 2)
            ways = ((moves.Carry(body, A, B, X), self._carried_normal(A, B, X)) for A, B in apart)
        for move, normal in ways:
            if any(normal) and (not found or _cross(normal, next(iter(found.values())))):
                name = f"{body} again" if found else f"{body} once"
                found[name] = normal
                lines.append(move._replace(source=name))
            if len(found) == 2:
                one, two = found
                return lines, moves.Meet(X, (one, two))
        return None

    def _turning_known(self, body: str) -> None:
        if self.net.classes[body] not in self.turning and len({self.net.spot(X[0]) for X in self._ends(body)}) > 1:
            self.turning[self.net.classes[body]] = body
            self._wake_class(body)

    def _wake_class(self, body: str) -> None:
        self._queue(*[other for other in self.net.turning_alike[self.net.classes[body]] if other != body])

    # ---- sliding pairs --------------------------------------------------------------------------------------

    def _through_slide(self, slide: Slide) -> None:
        """A known end in one link's plane gives the other link one locus, once."""
        for known, new in ((slide.link, slide.along), (slide.along, slide.link)):
            if known in self.net.passive or slide.name in self.net.silent_slides:
                continue
            if slide.name not in self.passed and (point := self._guide_point(slide, known, new)):
                target = self.net.place(point, new)
                self.passed.add(slide.name)
                self._add_place(self.net.body[new], target)
                rolls = isinstance(slide, RollingGuide)
                kind = moves.GuideLocus if not rolls else moves.Common if self.common else moves.Roll
                self.moves.append(kind(slide, point, known, new))
                self._file(target, slide.name, None if kind is moves.Common else self._slide_normal(slide))

    def _slide_normal(self, slide: Slide) -> Two:
        """The normal of the locus that a slide gives: its direction; that of a line of centres follows from these."""
        if isinstance(slide, RollingGuide) and slide.through:
            one, two = (self._spot((centre, "")) for centre in slide.through)
            return difference(two, one)
        return self._direction_of(slide.direction)

    def _guide_point(self, slide: Slide, known: str, new: str) -> str:
        """A point whose end is known in the plane of `known`, not by this slide: any, if its links turn alike."""
        own, at = self.net.place(slide.at, known), self.net.name(slide.at)
        if self.net.body[new] == self.net.ground:
            return ""
        if not slide.turns_alike:
            at_rest = self.net.body[known] == self.net.ground
            return at if at_rest or (own in self.drawn and self._count_from_others(own, slide.name) == 2) else ""
        if self.net.body[known] == self.net.ground:
            points = self.net.links[new]
            joints = [p for p in points if len(self.net.links_of[p]) > 1]
            return at if at in points else (joints or list(points) or [slide.at])[0]
        for place in self.places[self.net.body[known]]:
            if place in self.drawn and self._count_from_others(place, slide.name) == 2 and self.net.has(known, place):
                return place[0]
        return ""

    def _add_place(self, body: str, place: BodyPoint) -> None:
        if place not in self.places[body]:
            self.places[body].append(place)


def _cross(one: Fact, two: Fact) -> bool:
    """Whether two loci of a place cross in one point."""
    return one is not None and two is not None and not parallel(one, two)
