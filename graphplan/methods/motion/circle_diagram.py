"""The circle diagram: in which order the poles of a linkage follow from each other, and from which two lines each.

The links stand on a circle, and a side joins two whose pole is known: a pin, a guide's point at infinity. The poles of
three links lie on one line (Aronhold 1872, Kennedy 1886). So a missing side that closes two triangles is a pole where
two lines cross, each through two known poles; a side that closes one is such a pole where a line of it is known from
elsewhere, as the common normal of two profiles. Which sides those that are asked for rest on is first sought in the
graph alone, and no others are drawn. In each round all of these that close are drawn; each by as few lines as may be,
of those that cross well. Of many lines those are tried that rest on the fewest and are known best.

Poles and lines are vectors (x, y, w) and (a, b, c), so that what is at infinity is like all else. How well they are
known is measured on the unit sphere, with the mechanism as the unit of length.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from heapq import nsmallest
from itertools import combinations
from typing import Any, NamedTuple

from graphplan.kernel.program import Mark
from graphplan.mechanism.model import Scene
from graphplan.methods.tolerances import INFINITY_TOL, NEAR_SINE, PENCIL, SINE_TOL

Vector = tuple[Any, Any, Any]
Unit = tuple[float, float, float]  # the same on the unit sphere
Sides = tuple[str, str]  # the two links of a pole, in the order of the diagram
Rests = frozenset[tuple[Sides, str]]  # lines through poles: of which side, and by which third link
EQUAL = 3.0  # errors within this factor count as equal: then the fewest lines win
MAX_POLE_GROWTH = 1e3  # times a pencil's error: such a pole waits for better lines
MOST_LINES = 8  # of a pole: so many that rest on the fewest, and so many that are known best, are crossed


def cross(u: Vector, v: Vector) -> Vector:
    """The line through two poles, or the pole on two lines; its largest number is one, if it is any."""
    product = u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]
    most = max(product, key=abs)
    return (product[0] / most, product[1] / most, product[2] / most) if most else product


def sine(u: Unit, v: Unit) -> float:
    """The sine of the angle of two poles, or of two lines, on the unit sphere."""
    return math.hypot(*_normal(u, v))


def _normal(u: Unit, v: Unit) -> Unit:
    """Vector perpendicular to two unit vectors, as long as the sine of their angle."""
    (a, b, c), (d, e, f) = u, v
    return b * f - c * e, c * d - a * f, a * e - b * d


class DrawnSide(NamedTuple):
    """A side of a circle diagram that is drawn: as which one, or 0 of one that is there at the outset."""

    links: Sides
    number: int


class DrawnCircle(NamedTuple):
    """A circle diagram as it is drawn: the links around it, and its sides."""

    links: tuple[str, ...]
    sides: tuple[DrawnSide, ...]


@dataclass(frozen=True)
class PoleLine:
    """A line on which a pole lies: through those of its links with a third, `by`, or one that is known and `drawn`."""

    by: str
    drawn: Mark | None = field(default=None, compare=False)


@dataclass(frozen=True)
class FoundPole:
    """Place of a pole, its possible error, the two lines on which it lies, if any, and all lines that it depends on."""

    at: Vector
    error: float = PENCIL
    lines: tuple[PoleLine, ...] = ()
    rests: Rests = frozenset()


class KnownLine(NamedTuple):
    """A line on which a missing pole lies, how far it may be off, and where it is: known, or through two poles."""

    line: PoleLine
    unit: Unit
    error: float
    known: Vector | None
    through: tuple[FoundPole, ...] = ()

    @property
    def coefficients(self) -> Vector:
        """Homogeneous coefficients of the line."""
        return cross(*(pole.at for pole in self.through)) if self.known is None else self.known

    @property
    def weight(self) -> int:
        """On how many lines its poles rest, those of both counted twice."""
        return sum(len(pole.rests) for pole in self.through)

    def rests(self, sides: Sides) -> Rests:
        """The lines that a pole rests on by it, itself among them unless it is known."""
        itself = {(sides, self.line.by)} if self.through else ()
        return frozenset().union(itself, *(pole.rests for pole in self.through))


@dataclass
class CircleDiagram:
    """The poles of a scene as far as they are known; `lines` are those on which unknown ones are known to lie.

    A pole that is found stays where it is, and so does a line through two: each is drawn once.
    """

    scene: Scene
    links: tuple[str, ...]
    found: dict[Sides, FoundPole] = field(default_factory=dict)
    lines: dict[Sides, list[tuple[PoleLine, Vector]]] = field(default_factory=dict)
    _beside: dict[str, list[str]] = field(default_factory=dict)  # the links with which each has a pole that is found
    _thirds: dict[Sides, list[str]] = field(default_factory=dict)  # by which links a missing side has lines
    _changed: set[Sides] = field(default_factory=set)  # missing sides that have lines which were not looked at yet
    _best: dict[Sides, FoundPole] = field(default_factory=dict)  # missing sides as they would be drawn now
    _through: dict[tuple[Sides, str], KnownLine | None] = field(default_factory=dict)
    _units: dict[Sides, Unit] = field(default_factory=dict)  # of the poles that are found
    _one_line: set[tuple[str | Sides, ...]] = field(default_factory=set)  # sides, and by which thirds lines are one
    _closure: _GraphClosure | None = None  # as long as no side is found that it does not foresee

    @cached_property
    def _place(self) -> dict[str, int]:
        return {link: place for place, link in enumerate(self.links)}

    def sides(self, one: str, two: str) -> Sides:
        """Two links in the order of the diagram."""
        return (one, two) if self._place[one] < self._place[two] else (two, one)

    def places(self, sides: Sides) -> tuple[int, ...]:
        """Places of the two links in the order of the diagram."""
        return tuple(self._place[link] for link in sides)

    def enter(self, sides: Sides, pole: FoundPole) -> None:
        """Draw a side: with each that meets it, it may close a triangle over a missing one."""
        if self._closure is not None and sides not in self._closure.thirds:
            self._closure = None
        self.found[sides], self._units[sides] = pole, self._unit(pole.at, dual=False)
        self._best.pop(sides, None)
        for link, third in (sides, sides[::-1]):
            for other in self._beside.get(third, ()):
                if (missing := self.sides(link, other)) not in self.found:
                    self._thirds.setdefault(missing, []).append(third)
                    self._changed.add(missing)
        for link, other in (sides, sides[::-1]):
            self._beside.setdefault(link, []).append(other)

    def enter_line(self, sides: Sides, line: PoleLine, at: Vector) -> None:
        """A line on which a pole lies that may be missing."""
        self.lines.setdefault(sides, []).append((line, at))
        self._changed.add(sides)

    def close(self, wanted: Collection[Sides]) -> None:
        """Draw the missing sides that these depend on and that close, round after round, until these are found or no
        side closes; those that cross badly only if no other is left."""
        missing = {sides for sides in wanted if sides not in self.found}
        while missing and (below := self._sides_below(missing)):
            while not missing <= self.found.keys() and self._draw_round(below):
                pass
            missing -= self.found.keys()
            if missing and not self._note_parallel_lines(below):
                return

    def _draw_round(self, among: set[Sides]) -> bool:
        """Draw all of these missing sides that close, once; whether any does."""
        for sides in (self._changed & among) - self.found.keys():
            if pole := self._best_crossing(sides):
                self._best[sides] = pole
        self._changed -= among
        order = sorted(self._best.keys() & among, key=self.places)
        if not order:
            return False
        sound = [sides for sides in order if self._best[sides].error < MAX_POLE_GROWTH * PENCIL]
        worst = min(order, key=lambda sides: self._best[sides].error)
        for sides in sound or [worst]:
            self.enter(sides, self._best[sides])
        return True

    def _sides_below(self, wanted: Collection[Sides]) -> set[Sides]:
        """The missing sides that wanted ones rest on, themselves among them, as far as the graph tells: of all lines
        on which a pole lies those two that rest on the fewest, in the round in which there are two."""
        self._closure = self._closure or _GraphClosure(self)
        self._closure.close(wanted)
        below, waiting, thirds = set[Sides](), [*wanted], self._closure.thirds
        while waiting:
            sides = waiting.pop()
            if sides in thirds and sides not in below:
                below.add(sides)
                waiting += (self.sides(link, third) for third in thirds[sides] if third for link in sides)
        return below

    def _note_parallel_lines(self, below: set[Sides]) -> bool:
        """Note which of the sides that could not be drawn have two lines that are one in this pose; whether any has."""
        assert self._closure is not None
        count = len(self._one_line)
        for sides in below - self.found.keys():
            thirds = self._closure.thirds[sides]
            if all(self.sides(link, third) in self.found for third in thirds if third for link in sides):
                self._one_line.add((sides, *thirds))
        self._closure = None
        return len(self._one_line) > count

    def _best_crossing(self, sides: Sides) -> FoundPole | None:
        """The pole by the fewest lines of those that cross well."""
        lines = [(line, line.rests(sides)) for line in self._lines(sides)]
        crossing = [((one.error + two.error + PENCIL) / angle, one, two, rests, more_rests)
                    for (one, rests), (two, more_rests) in combinations(lines, 2)
                    if (angle := sine(one.unit, two.unit)) > SINE_TOL]
        least = min((error for error, *_ in crossing), default=0.0)
        sharp = ((error, one, two, rests | more_rests) for error, one, two, rests, more_rests in crossing
                 if error <= EQUAL * least)
        sharpest = min(sharp, key=lambda two: (len(two[3]), two[0]), default=None)
        if sharpest is None:
            return None
        error, one, two, rests = sharpest
        return FoundPole(cross(one.coefficients, two.coefficients), error, (one.line, two.line), rests)

    def _lines(self, sides: Sides) -> list[KnownLine]:
        """The lines on which a missing pole lies, if they are two at least; of many the most promising."""
        lines, thirds = self.lines.get(sides, ()), self._thirds.get(sides, ())
        if len(lines) + len(thirds) < 2:
            return []
        known_lines = [KnownLine(line, self._unit(at, dual=True), PENCIL, at) for line, at in lines]
        pole_lines = [self._line_of_poles(sides, third) for third in sorted(thirds, key=self._place.__getitem__)]
        line_choices = [*known_lines, *filter(None, pole_lines)]
        if len(line_choices) <= 2 * MOST_LINES:
            return line_choices
        places = range(len(line_choices))
        likely = {*nsmallest(MOST_LINES, places, key=lambda place: line_choices[place].weight),
                  *nsmallest(MOST_LINES, places, key=lambda place: line_choices[place].error)}
        return [line_choices[place] for place in sorted(likely)]

    def _line_of_poles(self, sides: Sides, third: str) -> KnownLine | None:
        """The line through the poles of two links with a third, if they lie apart."""
        if (sides, third) not in self._through:
            (P, p), (Q, q) = ((self.found[with_third], self._units[with_third])
                              for with_third in (self.sides(link, third) for link in sides))
            normal, line = _normal(p, q), None
            if (angle := math.hypot(*normal)) > SINE_TOL:
                x, y, z = normal
                unit = x / angle, y / angle, z / angle
                if angle <= NEAR_SINE:
                    unit = self._unit(cross(P.at, Q.at), dual=True)
                line = KnownLine(PoleLine(third), unit, (P.error + Q.error + PENCIL) / angle, None, (P, Q))
            self._through[sides, third] = line
        return self._through[sides, third]

    def sine(self, u: Vector, v: Vector, dual: bool = False) -> float:
        """The sine of the angle of two poles, or of two lines, on the unit sphere."""
        return sine(self._unit(u, dual), self._unit(v, dual))

    def _unit(self, vector: Vector, dual: bool) -> Unit:
        """A pole or a line about the mechanism's middle, in its size, as a unit vector of floats."""
        (x, y), size = self._middle, float(self.scene.extent)
        most = max(map(abs, vector)) or 1
        u, v, w = (float(number / most) for number in vector)
        if dual:
            u, v, w = u * size, v * size, w + u * x + v * y
        else:
            u, v = (u - w * x) / size, (v - w * y) / size
        long = math.hypot(u, v, w) or 1.0
        return u / long, v / long, w / long

    @cached_property
    def _middle(self) -> tuple[float, float]:
        xs, ys = zip(*((float(x), float(y)) for x, y in self.scene.points.values()), strict=True)
        return (max(xs) + min(xs)) / 2, (max(ys) + min(ys)) / 2

    def distance(self, sides: Sides) -> float:
        """Distance of a pole from the mechanism's middle, in sizes of the mechanism; infinite for one at infinity."""
        u, v, w = self._unit(self.found[sides].at, dual=False)
        return math.hypot(u, v) / abs(w) if abs(w) > SINE_TOL**2 else math.inf

    def at_infinity(self, sides: Sides) -> bool:
        """Whether a pole is at infinity: exactly so, or beside rounding."""
        x, y, w = self.found[sides].at
        if isinstance(w, Fraction | int):
            return bool(w == 0)
        return bool(abs(self._unit((x, y, w), dual=False)[2]) <= INFINITY_TOL)


class _GraphClosure:
    """Sides of a circle diagram that the graph can close.

    `weights` are on how many others sides rest, none of those that are found before. `thirds` are the links by which
    each that closes has the two lines that rest on the fewest; "" is that of a known line. Lines through one place are
    one there: links of one joint have their poles with another link on one line.
    """

    def __init__(self, diagram: CircleDiagram):
        self.diagram, numbers = diagram, dict[Vector, int]()
        self.spots = {sides: numbers.setdefault(pole.at, len(numbers)) for sides, pole in diagram.found.items()}
        self.weights, self.thirds = dict.fromkeys(diagram.found, 0), dict[Sides, list[str]]()
        self.lines: dict[Sides, list[_GraphLine]] = {}
        self.beside: dict[str, list[str]] = {}
        self.changed = {*diagram.lines}
        for sides in diagram.found:
            self._enter(sides)

    def close(self, wanted: Collection[Sides]) -> None:
        """Close the missing sides that close, round after round, until those wanted do."""
        while self.changed and not {*wanted} <= self.weights.keys():
            closing = {sides: two for sides in self.changed if sides not in self.weights and (two := self._two(sides))}
            self.changed = set()
            for sides, two in closing.items():
                self.thirds[sides] = [line.third for line in two]
                self.weights[sides] = sum(line.weight + 1 for line in two if line.third)
            for sides in closing:
                self._enter(sides)

    def _enter(self, sides: Sides) -> None:
        """Note the lines that a side gives missing ones with each that meets it."""
        place, spot, weight = self.diagram._place, self.spots.get(sides), self.weights[sides]
        for link, third in (sides, sides[::-1]):
            for other in self.beside.get(third, ()):
                missing = (link, other) if place[link] < place[other] else (other, link)
                if missing not in self.weights:
                    second = (third, other) if place[third] < place[other] else (other, third)
                    second_spot = self.spots.get(second)
                    if spot is None or spot != second_spot:
                        ends = (spot, second_spot) if missing[0] == link else (second_spot, spot)
                        line = _GraphLine(weight + self.weights[second], place[third], third, *ends)
                        self.lines.setdefault(missing, []).append(line)
                        self.changed.add(missing)
        for link, other in (sides, sides[::-1]):
            self.beside.setdefault(link, []).append(other)

    def _two(self, sides: Sides) -> tuple[_GraphLine, _GraphLine] | None:
        """The two lines of a missing side that rest on the fewest, of those that do not pass through one place."""
        normals = [_GraphLine(-1, -1, "", None, None)] * len(self.diagram.lines.get(sides, ()))
        lines, one_line = sorted((*normals, *self.lines.get(sides, ()))), self.diagram._one_line
        for place, two in enumerate(lines):
            for one in lines[:place]:
                if one.is_apart(two) and (sides, one.third, two.third) not in one_line:
                    return one, two
        return None


class _GraphLine(NamedTuple):
    """A line on which a missing pole lies, the best first: how many others it rests on, by which third link it is, in
    the order of the diagram, if by any, and the places of the two poles that it passes through, as far as these are
    known."""

    weight: int
    order: int
    third: str
    first_end: int | None
    second_end: int | None

    def is_apart(self, other: _GraphLine) -> bool:
        """Whether no pole of the one and the same link is in one place on both lines."""
        return ((self.first_end is None or self.first_end != other.first_end)
                and (self.second_end is None or self.second_end != other.second_end))
