"""The compass rules: each of the five dyads placed between links that are placed already, as a draughtsman does.

The outer joints are called A and C, the inner one B; any of them may be a slide instead. On which side of a line a
point lies, or which way along it, is read once from the given pose: it stays so on the whole path, since it can only
change at a limit.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from graphplan.cycle.linkage import Linkage, direction
from graphplan.kernel.numbers import Domain
from graphplan.kernel.program import Board, Mark, Program, evaluate, freeze
from graphplan.mechanism.model import Slide

Vector = tuple[Any, Any]
"""A pair of numbers of any kind, along x and along y."""

Attitude = tuple[Vector, Vector]
"""How a link lies: its base and its turn."""


@dataclass(frozen=True)
class Figure:
    """A link on the board: one point of it, given at `place`, and two marks whose vector, given so, turns with it."""

    board: Board
    point: Mark
    place: complex
    tail: Mark
    head: Mark
    vector: complex

    def at(self, place: complex) -> Mark:
        """The link's point that was given at this place, by similar figures."""
        if place == self.place:
            return self.point
        ratio = (place - self.place) / self.vector
        along = self.board.step_off(self.tail, self.head, self.point, ratio=ratio.real)
        return self.board.step_across(self.tail, self.head, along, ratio=ratio.imag)

    def line(self, place: complex, way: complex) -> Mark:
        """The link's line through this place, running that way in the given pose."""
        return self.board.line(self.at(place), self.at(place + way * abs(self.vector)))

    def beside(self, point: Mark, place: complex) -> Figure:
        """Another link that turns as this one does, and has this point."""
        return replace(self, point=point, place=place)


class Hinge(NamedTuple):
    """One pair of a dyad: a revolute at a point; or a slide, with its other link, the carrier, and its direction."""

    letter: str
    point: str
    carrier: str = ""
    along: complex = 0j


@dataclass(frozen=True)
class Dyad:
    """A dyad's construction: its program, the marks that it needs, those that it gives, and how it can fail.

    `known_points` names the marks of points, `known_links` those of a link's base and of the point one `reach` from it.
    Wanted are, in order, `points`, then for each of `links` a point of it, and the tail and head of a vector that turns
    with it; beside the link's name stand the vectors, as given, from that point to its base, and from tail to head.
    """

    program: Program
    known_points: dict[str, str]
    known_links: dict[str, tuple[str, str]]
    reach: float
    points: tuple[str, ...]
    links: tuple[tuple[str, complex, complex], ...]
    failure: str

    def read(self, domain: Domain, points: Mapping[str, Vector],
             carriers: Mapping[str, Attitude]) -> tuple[dict[str, Vector], dict[str, Attitude]]:
        """The new points, and how both links lie.

        Reads the known points and links that are elsewhere than they were given, in numbers of the domain.
        """
        known = {self.known_points[point]: place for point, place in points.items()}
        for link, ((x, y), (cos, sin)) in carriers.items():
            tail, head = self.known_links[link]
            known |= {tail: (x, y), head: (x + self.reach * cos, y + self.reach * sin)}
        values = evaluate(self.program, domain, {mark: {"x": x, "y": y} for mark, (x, y) in known.items()})
        found = iter([values[index] for index in self.program.wanted])
        return (dict(zip(self.points, found, strict=False)),
                {link: _attitude(next(found), next(found), next(found), *given) for link, *given in self.links})


def _attitude(point: Vector, tail: Vector, head: Vector, to_base: complex, vector: complex) -> Attitude:
    """How a link lies, of which a point is found, and a vector."""
    turn = _scaled((head[0] - tail[0], head[1] - tail[1]), 1 / vector)
    x, y = _scaled(turn, to_base)
    return (point[0] + x, point[1] + y), turn


def _scaled(v: Vector, z: complex) -> Vector:
    """A vector turned and stretched by a complex number."""
    return v[0] * z.real - v[1] * z.imag, v[0] * z.imag + v[1] * z.real


def dyad(linkage: Linkage, part: tuple[str, ...]) -> Dyad | None:
    """The construction of a plain dyad; none where the part is anything else, or a drive works in it."""
    if len(part) != 2 or linkage.drives(part):
        return None
    before = linkage.carriers(part)
    outer = [_pairs(linkage, link, before) for link in part]
    inner = [pair for pair in _pairs(linkage, part[0], part[1:]) if pair not in outer[0]]
    if [len(pairs) for pairs in (*outer, inner)] != [1, 1, 1]:
        return None
    (one,), (two,) = outer
    if not {one.letter, two.letter, inner[0].letter} <= {"R", "P"}:
        return None
    swapped = one.letter + two.letter == "PR"
    return _Sketch(linkage, part[::-1] if swapped else part, (two, one) if swapped else (one, two), inner[0]).dyad()


def _pairs(linkage: Linkage, link: str, others: tuple[str, ...]) -> list[Hinge]:
    """The pairs of a link with some others."""
    return [Hinge(pair.letter, pair.at, next(other for other in pair.links if other != link), direction(pair))
            if isinstance(pair, Slide) else Hinge(pair.letter, pair.at) for pair in linkage.pairs(link, others)]


class _Sketch:
    """The board on which one dyad is constructed."""

    def __init__(self, linkage: Linkage, part: tuple[str, ...], outer: tuple[Hinge, Hinge], inner: Hinge):
        self.linkage, self.part, self.outer, self.inner = linkage, part, outer, inner
        self.board = Board()
        pins = [pair.point for pair in outer if not pair.carrier]
        self.points = {point: self.given(point, linkage.places[point]) for point in pins}
        self.carriers = {pair.carrier: self.carrier(pair.carrier) for pair in outer if pair.carrier}

    def given(self, name: str, place: complex) -> Mark:
        """A mark that is known in every pose."""
        return self.board.given(x=place.real, y=place.imag, name=name)

    def carrier(self, link: str) -> Figure:
        """A placed link: its base, and the point one reach from it."""
        origin, reach = self.linkage.origins[link], self.linkage.reach
        base, end = self.given(f"{link}_0", origin), self.given(f"{link}_1", origin + reach)
        return Figure(self.board, base, origin, base, end, complex(reach))

    def dyad(self) -> Dyad:
        """The recorded construction."""
        one, two, failure = _RULES["".join((self.outer[0].letter, self.inner.letter, self.outer[1].letter))](self)
        figures = dict(zip(self.part, (one, two), strict=True))
        new = {point: self.board.named(figure.at(self.linkage.places[point]), point)
               for link, figure in figures.items() for point in self.linkage.points(link) if point not in self.points}
        marks = [mark for figure in figures.values() for mark in (figure.point, figure.tail, figure.head)]
        known = {point: mark.step.name for point, mark in self.points.items()}
        carriers = {link: (at.tail.step.name, at.head.step.name) for link, at in self.carriers.items()}
        links = tuple((link, self.linkage.origins[link] - at.place, at.vector) for link, at in figures.items())
        program = freeze(self.board, [*new.values(), *marks])
        return Dyad(program, known, carriers, self.linkage.reach, tuple(new), links, failure)

    def place(self, pair: Hinge) -> complex:
        """Where the point of a pair was given."""
        return self.linkage.places[pair.point]

    def arc(self, centre: Hinge, about: complex) -> Mark:
        """The circle about an outer joint on which a point of its link lies."""
        radius = self.board.radius(length=abs(about - self.place(centre)))
        return self.board.circle(self.points[centre.point], radius)

    def bar(self, pair: Hinge, B: Mark, b: complex) -> Figure:
        """The link that joins an outer joint to B."""
        return Figure(self.board, B, b, self.points[pair.point], B, b - self.place(pair))


def _rrr(s: _Sketch) -> tuple[Figure, Figure, str]:
    """B lies on a circle about A and on a circle about C."""
    A, C = s.outer
    a, b, c = s.place(A), s.place(s.inner), s.place(C)
    side = "left" if ((c - a).conjugate() * (b - a)).imag > 0 else "right"
    B = s.board.circles_meet(s.arc(A, b), s.arc(C, b), side=side)
    return s.bar(A, B, b), s.bar(C, B, b), f"the circles about {A.point} and {C.point} do not meet"


def _rrp(s: _Sketch) -> tuple[Figure, Figure, str]:
    """B lies on a circle about A, and on a line of the guide's link along the guide."""
    A, guide = s.outer
    a, b, along = s.place(A), s.place(s.inner), guide.along
    carrier = s.carriers[guide.carrier]
    path = carrier.line(b, along)
    B = s.board.line_meets_circle(path, s.arc(A, b), way=_way(along, b - a))
    failure = f"the circle about {A.point} does not meet the line of {s.inner.point} along link {guide.carrier}"
    return s.bar(A, B, b), carrier.beside(B, b), failure


def _rpr(s: _Sketch) -> tuple[Figure, Figure, str]:
    """The guide's line through A passes C at a given distance: its angle with AC has that sine."""
    A, C = (s.points[pair.point] for pair in s.outer)
    (a, c), along = map(s.place, s.outer), s.inner.along
    offset = (along.conjugate() * (c - a)).imag
    AC = s.board.line(A, C)
    H = s.board.lay_along(s.board.perpendicular(AC, A), A, length=-offset)
    round_A = s.board.circle(A, s.board.opening(A, C))
    T = s.board.line_meets_circle(s.board.parallel(AC, H), round_A, way=_way(along, c - a))
    end = s.board.lay_along(s.board.line(A, T), A, length=s.linkage.reach)
    one = Figure(s.board, A, a, A, end, along * s.linkage.reach)
    return one, one.beside(C, c), f"the guide through {s.outer[0].point} passes {s.outer[1].point} by"


def _prp(s: _Sketch) -> tuple[Figure, Figure, str]:
    """B lies on a line along either guide."""
    one, two = (s.carriers[pair.carrier] for pair in s.outer)
    b = s.place(s.inner)
    B = s.board.meet(*(s.carriers[pair.carrier].line(b, pair.along) for pair in s.outer))
    return one.beside(B, b), two.beside(B, b), "the two guides are parallel"


def _rpp(s: _Sketch) -> tuple[Figure, Figure, str]:
    """All turn alike; the middle link's point that was at A lies on its guide through A, and on one along the outer."""
    A, guide = s.outer
    a, carrier = s.place(A), s.carriers[guide.carrier]
    one = carrier.beside(s.points[A.point], a)
    X = s.board.meet(one.line(a, s.inner.along), carrier.line(a, guide.along))
    return one, carrier.beside(X, a), "the two guides are parallel"


_RULES = {"RRR": _rrr, "RRP": _rrp, "RPR": _rpr, "PRP": _prp, "RPP": _rpp}


def _way(along: complex, vector: complex) -> str:
    """Which way along a line a vector points."""
    return "on" if (along.conjugate() * vector).real > 0 else "back"
