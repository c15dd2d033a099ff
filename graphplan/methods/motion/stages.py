"""The stages of velocities and accelerations: what textbooks tell of the planner's moves.

The loci of a point and where they meet are one stage, such as v_B = v_A + v_BA = v_BC. Vectors of fixed points are
nothing and left out. Poles, inflection circles and centres of curvature have stages of their own.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

from graphplan.kernel.images import TRIAL_LAWS
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.stages import Equation, Knowledge, Stage, Vector
from graphplan.mechanism.model import FRAME, Contact, Slide
from graphplan.mechanism.replaced import RollingGuide
from graphplan.methods.motion.moves import (
    Auxiliary,
    Carry,
    Centre,
    Common,
    FalsePosition,
    GuideLocus,
    Meet,
    Move,
    Pole,
    Rest,
    Seed,
    Settle,
    SimilarFigure,
    Slip,
    Swing,
)
from graphplan.methods.motion.network import BodyPoint, DrivenPair, Network
from graphplan.methods.panels import link_named, list_links, pair_text, slide_named
from graphplan.phrases import Phrase, Said, arrange, digits, join, phrase, said

ROLLING = said("links that roll on each other have the same velocity where they touch: it is their relative pole")
LAWS: dict[type, Said] = {  # of the moves whose steps say nothing themselves
    Rest: said("a drive prescribes how its links move; points of the frame stand still"),
    Seed: said("its motion is given"),
    Auxiliary: said("the end of the auxiliary point lies on the loci of both points that it was found from"),
    Common: ROLLING,
    Pole: said("links joined by two bars turn relative to each other about the point where the bars meet"),
    Centre: said("as a point of the link its pole is at rest"),
    FalsePosition: said("the error of a trial is proportional to what is assumed, so two trials show where it is zero")}
BY = {"": phrase("Normal acceleration of {0}"), "computed": phrase("Normal acceleration of {0}, computed"),
      "semicircle": phrase("Normal acceleration of {0}, by the semicircle"),
      "companion": phrase("Normal acceleration of {0}, by the right triangle")}
BEGUN = said("wherever there is room")
NORMAL = said("magnitude v²/r, directed from the first point to the second")
FIGURE = said("the normal accelerations of a link's points about one of them are in proportion to the distances")
CORIOLIS = said("magnitude 2 ω v, directed as v turned by 90° with ω")
PITCH_POINT = phrase("Pitch point {0} of {1}")
POINT_OF_CONTACT = phrase("Point of contact {0} of {1}")
INSIDE = phrase("the relative pole of {0} divides {1} as {2} : {3}")
OUTSIDE = phrase("the relative pole of {0} divides {1} externally, as {2} : {3}")
RATE = said("the difference of the vectors of two points of a link is in proportion to their distance")
SLIDING = said("the vectors of two coincident points differ by that of one relative to the other")


class Words(NamedTuple):
    """Words for plans of one kind: the kind of vector and its letter, the letter of turning, and titles."""

    kind: str
    symbol: str
    turning: str  # that of its rate
    point: Phrase
    figure: Phrase
    link: Phrase
    slide: Phrase

    def given_vector(self, name: str = "", *, turned: bool = False) -> Quantity:
        """A given vector by its name, drawn turned or not; without a name that of a slide."""
        name = name or f"{self.symbol}_r"
        return Quantity(said("{0}, turned by 90°", name) if turned else name, self.kind)

    def turning_part(self, A: str, X: str) -> Quantity:
        """Quantity of a link's turning over its side AX."""
        return Quantity(f"{self.turning}·{A}{X}", self.kind)


VELOCITIES = Words("velocity", "v", "ω", phrase("Velocity of {0}"),
                   phrase("Velocity of {0}, by the similar figure of {1}"), phrase("Angular velocity of {0}"),
                   phrase("Relative velocity of the slide {0}"))
ACCELERATIONS = Words("acceleration", "a", "α", phrase("Acceleration of {0}"),
                      phrase("Acceleration of {0}, by the similar figure of {1}"),
                      phrase("Angular acceleration of {0}"), phrase("Relative acceleration of the slide {0}"))


@dataclass(frozen=True)
class MotionStages:
    """The stages of one plan. `letters` are those of auxiliary points, which get them as they are drawn.

    `ending` is the letter of an end, made from that of its point in small letters, or as it is; `purpose` is what an
    assumed motion is for. Where parts are laid off `head_to_tail`, none is reversed, and figures are those of the ends.
    """

    net: Network
    words: Words
    laws: Mapping[type, Said]
    ending: str
    letters: dict[str, str]
    purpose: Said | None = None
    head_to_tail: bool = False

    def group_moves(self, planned: Iterable[Move]) -> Iterator[tuple[Move, ...]]:
        """The moves, those that textbooks make one together: the loci of a place, and where they meet."""
        group: list[Move] = []
        for move in planned:
            locus = isinstance(move, Swing | Slip | GuideLocus)
            if group and not ((locus or isinstance(move, Meet)) and self.place(move) == self.place(group[0])):
                yield tuple(group)
                group = []
            group.append(move)
            if not locus:
                yield tuple(group)
                group = []
        if group:
            yield tuple(group)

    def place(self, move: Move) -> BodyPoint:
        """The place whose locus or end a move gives."""
        match move:
            case Swing(X=X) | Slip(X=X) | Carry(X=X) | SimilarFigure(X=X) | Settle(X=(X, _)) | FalsePosition(at=(X, _)):
                return X
            case GuideLocus(point=point, new=new) | Common(point=point, new=new):
                return self.net.place(point, new)
            case Meet(place=X) | Rest(place=X) | Seed(place=X) | Auxiliary(place=X) | Pole(place=X) | Centre(place=X):
                return X

    # ---- what is called how -------------------------------------------------------------------------------------

    def end(self, name: str, place: BodyPoint) -> str:
        """The letter of the end of a place whose point has this name."""
        on_link = place[1] if place[1] in self.net.body else ""
        coincident = self.net.coincident_name(name, on_link) if on_link else ""
        letter = coincident or name
        return self.ending.format(letter.lower(), letter) + (f"({on_link})" if on_link and not coincident else "")

    def name(self, point: str, link: str = "") -> str:
        """Name of a point, or of the point of a link's plane that coincides with it: B2 of link 2, if that name is
        free. Auxiliary points and poles are nobody else's."""
        name = self.letters.get(point, point)
        if link not in self.net.links or point in self.letters:
            return name
        together = f"{name}{'0' if link == FRAME else link}"
        if (coincident := self.net.coincident_name(name, link)) and coincident not in self.net.scene.points:
            return coincident
        plain = name.isalpha() and together[len(name) :].isdigit() and together not in self.net.scene.points
        return together if plain else f"{name}({link})"

    def vector(self, symbol: str, of: BodyPoint, about: BodyPoint | None = None,
               known: Knowledge = Knowledge.WHOLLY) -> Vector:
        """The vector of a point, or its part of a kind relative to another point."""
        names = [self.name(*place).replace("_", "") for place in (of, about) if place]
        plain = len(names) == 1 or all(re.fullmatch(r"[A-Z]\d*'*", name) for name in names)
        return Vector(f"{symbol}_{('' if plain else ',').join(names)}", known)

    def sum(self, body: str, known: BodyPoint, X: BodyPoint, spare: Knowledge = Knowledge.DIRECTION) -> list[Vector]:
        """Terms of the vector of X, from that of a point of its body; `spare` is the knowledge of the tangential part.

        A drive between the two adds what it prescribes: X moves so relative to the point under it of the other's link.
        """
        if not self._are_of_one_link(body, known, X):
            under = X[0], self.net.link_at(body, known)
            return [*self.sum("", known, under, spare), *self._relative(X, under, Knowledge.WHOLLY)]
        start = self._start(known)
        if self.words.symbol == "v":
            return [*start, self.vector("v", X, known, spare)]
        return [*start, self.vector("a^n", X, known), self.vector("a^t", X, known, spare)]

    def _are_of_one_link(self, body: str, K: BodyPoint, X: BodyPoint) -> bool:
        """Whether two places are those of one link of a body, as all are but where drives make more than one a body."""
        links = self.net.members.get(body, ())
        return len(links) < 2 or any(self.net.has(link, K) and self.net.has(link, X) for link in links)

    def _relative(self, B: BodyPoint, on: BodyPoint, spare: Knowledge, *, turns: bool = True) -> list[Vector]:
        """The vector of a point relative to the one under it, of a link that may turn."""
        if self.words.symbol == "v":
            return [self.vector("v", B, on, spare)]
        return [*([self.vector("a^C", B, on)] if turns else []), self.vector("a^r", B, on, spare)]

    def _start(self, place: BodyPoint) -> list[Vector]:
        """The vector of a place, if it is any."""
        point, link = place
        fixed = FRAME in ((link,) if link else self.net.links_of.get(point, ()))
        return [] if fixed else [self.vector(self.words.symbol, place)]

    def sliding(self, slide: Slide, B: BodyPoint, on: BodyPoint,
                spare: Knowledge = Knowledge.DIRECTION) -> list[Vector]:
        """Terms of the vector from the coincident point of the other link of a slide; for a guide at rest the sliding
        alone."""
        return [*self._start(on), *self._relative(B, on, spare, turns=self.net.turns(slide))]

    # ---- the stages of moves ------------------------------------------------------------------------------------

    def tell(self, moves: tuple[Move, ...], prime: str, located: bool, forms: Collection[str]) -> Stage:
        """The stage of moves of one place, which has a locus already where it is `located`; a trial's has a `prime`."""
        end = self.end(self.letters.get((place := self.place(moves[-1]))[0], place[0]), place) + prime
        title = self._title(moves[-1], end, forms)
        title = arrange("{0:capital}: {1}", self.purpose, title) if self.purpose else title
        title = arrange("{0} ({1})", title, end) if prime and end not in title else title
        laws = dict.fromkeys(self._law(move, forms) for move in moves)
        equations = [(left, right) for move in moves for left, right in self._equations(move, forms) if right]
        found = self.vector(self.words.symbol, place, known=self._known_of(moves, located))
        sums = [Equation.sum(found if left.name == found.name else left, right) for left, right in equations]
        return Stage(title, join(laws, "; "), tuple(sums))

    def _law(self, move: Move, forms: Collection[str]) -> Said:
        """The law by which a move is drawn in these forms."""
        by_trials = [law for form, law in TRIAL_LAWS.items() if form in forms] if isinstance(move, Carry) else ()
        return next(iter(by_trials), {**LAWS, **self.laws}[type(move)])

    def _known_of(self, moves: tuple[Move, ...], located: bool) -> Knowledge:
        """Knowledge of the vector before the moves: its direction if a guide is at rest."""
        guided = any(isinstance(move, GuideLocus) and FRAME in (move.known, move.new) for move in moves)
        if guided and len(moves) > 1:
            return Knowledge.DIRECTION
        return Knowledge.LOCUS if located or isinstance(moves[-1], Settle) else Knowledge.NOTHING

    def _title(self, move: Move, end: str, forms: Collection[str]) -> Said:
        match move:
            case Carry(body=body):
                if "auxiliary point" in forms:
                    letter = self.letters[auxiliary(body)]
                    return said("Auxiliary point {0} of {1}, locus of {2}", letter, self._links(body), end)
                if not TRIAL_LAWS.keys().isdisjoint(forms):
                    return said("Trial figure of {0}, locus of {1}", self._links(body), end)
                return said("Locus of {0}", end)
            case Swing() | Slip() | GuideLocus():
                return said("Locus of {0}", end)
            case SimilarFigure(body=body, X=X):
                return self.words.figure(self.name(*X), self._links(body))
            case Auxiliary(body=body, place=place):
                return said("Auxiliary point {0} of {1}", self.name(*place), self._links(body))
            case Pole(bodies=bodies, place=place):
                return said("Relative pole {0} of {1}", self.name(*place), list_links(bodies))
            case Centre(body=body, place=place):
                return said("Pole {0} of {1}", self.name(*place), self._links(body))
            case FalsePosition():
                return arrange("{0:capital}", said("false position of {0}", end))
            case Common() | Settle() | Rest() | Seed() | Meet():
                return self.words.point(self.name(*self.place(move)))

    def _links(self, body: str) -> Said:
        return list_links([link for link in self.net.members[body] if link != FRAME])

    def _equations(self, move: Move, forms: Collection[str]) -> Iterator[tuple[Vector, list[Vector]]]:
        """The equations of a move: of which vector, and what it is the sum of."""
        unknown = partial(self.vector, self.words.symbol, known=Knowledge.NOTHING)
        match move:
            case Swing(body, K, X) | Settle(body, K, (X, _)) | SimilarFigure(body, K, X, None):
                spare = Knowledge.WHOLLY if isinstance(move, SimilarFigure) else Knowledge.DIRECTION
                yield unknown(X), self.sum(body, K, X, spare)
            case SimilarFigure(body, K, X, R) if R and not self.head_to_tail:
                yield from ((unknown(X), self.sum(body, known, X)) for known in (K, R))
            case Slip(body, (A, _), X):
                yield unknown(X), self._locus_vectors(body, A, X, Knowledge.WHOLLY)
            case Carry(body, (A, _), (B, _), X) if "auxiliary point" in forms:
                Q = auxiliary(body), next(link for link in self.net.members[body] if link not in self.net.welds)
                yield from ((unknown(Q), self._locus_vectors(body, known, Q)) for known in (A, B))
                yield unknown(X), self.sum(body, Q, X)
            case Auxiliary(body, (A, _), (B, _), Q):
                yield from ((unknown(Q), self._locus_vectors(body, known, Q)) for known in (A, B))
            case GuideLocus(slide, point, known, new) if FRAME not in (known, new):
                B, on = (self.net.place(point, link) for link in (new, known))
                yield unknown(B), self.sliding(slide, B, on)
            case Rest(place):
                yield from ((unknown(place), right) for right in self._driven_vectors(place))

    def _locus_vectors(self, body: str, A: BodyPoint, X: BodyPoint,
                       spare: Knowledge = Knowledge.DIRECTION) -> list[Vector]:
        """Terms of the vector of X, from that of a point with a known locus."""
        base, *rest = self.sum(body, A, X, spare)
        return [base._replace(known=Knowledge.LOCUS), *rest]

    def _driven_vectors(self, place: BodyPoint) -> Iterator[list[Vector]]:
        """Yield the terms of the vector of a point whose link a drive moves."""
        weld: DrivenPair | None = self.net.welds.get(self.net.link_at(self.net.ground, place))
        if weld and weld.slide:
            yield self.sliding(weld.slide, place, self.net.place(place[0], weld.to), Knowledge.WHOLLY)
        elif weld and weld.at != place[0]:
            found = self.sum("", (weld.at, ""), place, Knowledge.WHOLLY)
            yield found if weld.drive.rates[1] or self.words.symbol == "v" else found[:-1]

    # ---- others -------------------------------------------------------------------------------------------------

    def normal(self, K: BodyPoint, X: BodyPoint, forms: Collection[str] = ()) -> Stage:
        """The normal acceleration of K about X, points of one link, and so that of X about K."""
        part, square = self.vector("a^n", K, X), f"{self.vector('v', K, X).name}²"
        equation = self._equal_parts(part, self.vector("a^n", X, K), f"{square}/{self.name(*K)}{self.name(*X)}")
        title = BY[next((form for form in forms if form in BY), "")]
        return Stage(title(said("{0} about {1}", self.name(*K), self.name(*X))), NORMAL, (equation,))

    def figure(self, link: str, forms: Collection[str] = ()) -> Stage:
        """The normal accelerations of a link's other points."""
        return Stage(said("Normal accelerations of {0}, by the similar figure", link_named(link)), FIGURE)

    def coriolis(self, guide: str, B: BodyPoint, on: BodyPoint, forms: Collection[str] = ()) -> Stage:
        """The Coriolis acceleration of a point relative to the one under it, where the guide turns as a link does."""
        part, slip = self.vector("a^C", B, on), self.vector("v", B, on)
        equation = self._equal_parts(part, self.vector("a^C", on, B), f"2 ω_{guide} {slip.name}", slip)
        title = said("Coriolis acceleration of {0} relative to {1}", self.name(*B), self.name(*on))
        return Stage(title, CORIOLIS, (equation,))

    def _equal_parts(self, part: Vector, reverse: Vector, size: str, *others: Vector) -> Equation:
        """A vector relative to a point is that of the point relative to it, reversed, and of a size."""
        if self.head_to_tail:
            return Equation(f"{part.name} = {size}", (part, *others))
        return Equation(f"{part.name} = -{reverse.name} = {size}", (part, reverse, *others))

    def rate(self, link: str, forms: Collection[str] = ()) -> Stage:
        """The turning of a link."""
        return Stage(self.words.link(link_named(link)), RATE)

    def sliding_stage(self, slide: Slide, forms: Collection[str] = ()) -> Stage:
        """The motion of a slide's links relative to each other."""
        B, on = (self.net.place(slide.at, link) for link in (slide.link, slide.along))
        equation = Equation.sum(self.vector(self.words.symbol, B), self.sliding(slide, B, on, Knowledge.NOTHING))
        return Stage(self.words.slide(slide_named(slide)), SLIDING, (equation,))


def pitch_point(guide: RollingGuide) -> Stage:
    """Stage of the point at which two links roll on each other."""
    title = POINT_OF_CONTACT if isinstance(guide.given_pair, Contact) else PITCH_POINT
    return Stage(title(guide.at, pair_text(guide.given_links)), ROLLING)


def pitch_point_text(guide: RollingGuide) -> Said:
    """Division of the line of centres by the pitch point, in words: as the radii, or the numbers of teeth."""
    assert guide.through is not None
    centres = "".join(guide.through)
    if isinstance(guide.given_pair, Contact):
        return said("the point of contact lies on {0}, the line of the centres of curvature", centres)
    one, two = guide.given_pair.factors
    pattern = INSIDE if (one > 0) == (two > 0) else OUTSIDE
    return pattern(pair_text(guide.given_links), centres, digits(abs(float(one)), 6), digits(abs(float(two)), 6))


def auxiliary(body: str) -> str:
    """The place of a body's auxiliary point."""
    return f"auxiliary point of {body}"


def beginning_stage(name: str, plan: Said, *, pole: bool = False) -> Stage:
    """Stage of a plan's beginning."""
    title = said("Pole {0} of the {1}", name, plan) if pole else said("Origin {0} of the {1}", name, plan)
    return Stage(title, BEGUN)


EULER = said("by Euler and Savary the way from a point to the pole is the mean proportional of its ways to the "
             "inflection circle and to its centre of curvature, which lie on one side of it")
NORMALS = said("the normals of the paths of a link's points pass through its pole")
CURVATURE_LAWS = {
    "Bobillier": said("the tangent of the centrodes makes with one ray the angle that the axis of collineation of two "
                      "points makes with the other ray"),
    "Hartmann": said("the ends of a point's velocity and of the part of the pole's own velocity along it lie on one "
                     "line with the centre of curvature")}
RATES = said("the acceleration towards the pole is omega squared times the way to the inflection circle, as the "
             "velocity is omega times the way to the pole")
ROLLING_CIRCLE_LAW = said("the pole is where the wheel touches, and the inflection pole lies on the line of "
                          "centres: the centre of a wheel on a rail, of a wheel on a wheel by Euler and Savary")
MIRRORED = said("the pole and the inflection pole are opposite points of the inflection circle; the return circle is "
                "its mirror image in the pole")
NORMAL_CURVATURE_LAW = said("the radius of curvature is the third proportional to the normal acceleration and the "
                            "velocity")


def pole_of(link: str) -> Stage:
    """The pole of a link from the paths of two points."""
    return Stage(said("Pole of {0}", link_named(link)), NORMALS)


def by_centres(link: str) -> Stage:
    """The inflection circle of a link from two points with known centres of curvature."""
    return Stage(said("Inflection circle of {0}", link_named(link)), EULER, (Equation("MP² = MW · MC", ()),))


def by_rolling(link: str) -> Stage:
    """The inflection circle of a wheel that rolls on another, or on a rail."""
    title = said("Inflection circle of {0}, which rolls", link_named(link))
    return Stage(title, ROLLING_CIRCLE_LAW, (Equation("BP² = BW_0 · BC", ()),))


def by_rates(link: str) -> Stage:
    """The inflection circle of a link from the velocities and accelerations of two points."""
    return Stage(said("Inflection circle of {0}, from velocities and accelerations", link_named(link)), RATES,
                 (Equation("a_n = ω² · MW, v = ω · MP", ()),))


def circle_of(link: str) -> Stage:
    """The circles themselves."""
    return Stage(said("Inflection circle and return circle of {0}", link_named(link)), MIRRORED)


def centre_of(point: str, forms: Collection[str]) -> Stage:
    """The centre of curvature of a point's path, by its link's circle or by known centres."""
    for form in CURVATURE_LAWS.keys() & {*forms}:
        return Stage(said("Centre of curvature of the path of {0}, after {1}", point, said(form)), CURVATURE_LAWS[form])
    equation = Equation("MP² = MW · MC".replace("M", point), ())
    return Stage(said("Centre of curvature of the path of {0}", point), EULER, (equation,))


def centre_by_rates(point: str) -> Stage:
    """The centre of curvature of a point's path, by its velocity and its normal acceleration."""
    return Stage(said("Centre of curvature of the path of {0}, from its normal acceleration", point),
                 NORMAL_CURVATURE_LAW, (Equation(f"ρ_{point} = v_{point}² / a^n_{point}", ()),))
