"""The circle diagram: in which order the poles of a linkage follow from each other, and from which two lines each.

The links stand on a circle, and a side joins two whose pole is known: a pin, a guide's point at infinity. The poles of
three links lie on one line (Aronhold 1872, Kennedy 1886). So a missing side that closes two triangles is a pole where
two lines cross, each through two known poles; a side that closes one is such a pole where a line of it is known from
elsewhere, as the common normal of two profiles. In each round all missing sides that close are drawn; each by as few
lines as may be, of those that cross well.

Poles and lines are vectors (x, y, w) and (a, b, c), so that what is at infinity is like all else. How well they are
known is measured on the unit sphere, with the mechanism as the unit of length.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations
from typing import Any, NamedTuple

from graphplan.kernel.program import Mark
from graphplan.mechanism.model import Scene

Vector = tuple[Any, Any, Any]
Sides = tuple[str, str]  # the two links of a pole, in the order of the diagram
PENCIL = 1e-3  # how far off a point is that is given or marked, beside the mechanism
EQUAL = 3.0  # errors within this factor count as equal: then the fewest lines win
WILD = 1e3  # times a pencil's error: such a pole waits for better lines
ONE = 1e-9  # the sine of an angle below which two vectors are one


def cross(u: Vector, v: Vector) -> Vector:
    """The line through two poles, or the pole on two lines; its largest number is one, if it is any."""
    found = u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]
    most = max(found, key=abs)
    return (found[0] / most, found[1] / most, found[2] / most) if most else found


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
    """Where a pole is, how far it may be off, on which two lines it lies, if on any, and all lines that it rests on."""

    at: Vector
    error: float = PENCIL
    lines: tuple[PoleLine, ...] = ()
    rests: frozenset[tuple[Sides, str]] = frozenset()
    round: int = 0


@dataclass
class CircleDiagram:
    """The poles of a scene as far as they are known; `lines` are those on which unknown ones are known to lie."""

    scene: Scene
    links: tuple[str, ...]
    found: dict[Sides, FoundPole] = field(default_factory=dict)
    lines: dict[Sides, list[tuple[PoleLine, Vector]]] = field(default_factory=dict)
    rounds: int = 0

    def sides(self, one: str, two: str) -> Sides:
        """Two links in the order of the diagram."""
        return (one, two) if self.links.index(one) < self.links.index(two) else (two, one)

    def close(self) -> None:
        """Draw all missing sides that close, round after round; those that cross badly where nothing else is left."""
        while True:
            best = {sides: found for sides in self._missing() if (found := self._best(sides))}
            sound = {sides: found for sides, found in best.items() if found.error < WILD * PENCIL}
            if not best:
                return
            self.rounds += 1
            worst = min(best, key=lambda sides: best[sides].error)
            self.found |= sound or {worst: best[worst]}

    def _missing(self) -> Iterator[Sides]:
        return (sides for sides in combinations(self.links, 2) if sides not in self.found)

    def _best(self, sides: Sides) -> FoundPole | None:
        """The pole by the fewest lines of those that cross well."""
        lines = list(self._lines(sides))
        every: list[FoundPole] = []
        for (one, k, e, before), (two, l, f, more) in combinations(lines, 2):
            if (sine := self.sine(k, l, dual=True)) > ONE:
                every.append(FoundPole(cross(k, l), (e + f + PENCIL) / sine, (one, two), before | more,
                                       self.rounds + 1))
        least = min((found.error for found in every), default=0.0)
        return min((found for found in every if found.error <= EQUAL * least),
                   key=lambda found: (len(found.rests), found.error), default=None)

    def _lines(self, sides: Sides) -> Iterator[tuple[PoleLine, Vector, float, frozenset[tuple[Sides, str]]]]:
        """The lines on which a missing pole lies, each with its error and the lines that it rests on."""
        one, two = sides
        yield from ((line, vector, PENCIL, frozenset()) for line, vector in self.lines.get(sides, ()))
        for third in self.links:
            if third not in sides:
                P, Q = (self.found.get(self.sides(link, third)) for link in (one, two))
                if P and Q and (sine := self.sine(P.at, Q.at)) > ONE:
                    error = (P.error + Q.error + PENCIL) / sine
                    yield PoleLine(third), cross(P.at, Q.at), error, P.rests | Q.rests | {(sides, third)}

    def sine(self, u: Vector, v: Vector, dual: bool = False) -> float:
        """The sine of the angle of two poles, or of two lines, on the unit sphere."""
        (a, b, c), (d, e, f) = (self._unit(vector, dual) for vector in (u, v))
        return math.hypot(b * f - c * e, c * d - a * f, a * e - b * d)

    def _unit(self, vector: Vector, dual: bool) -> Vector:
        """A pole or a line about the mechanism's middle, in its size, as a unit vector of floats."""
        (x, y), size = self._middle, float(self.scene.extent)
        most = max(map(abs, vector)) or 1
        u, v, w = (float(number / most) for number in vector)
        if dual:
            u, v, w = u * size, v * size, w + u * x + v * y
        else:
            u, v, w = (u - w * x) / size, (v - w * y) / size, w
        long = math.hypot(u, v, w) or 1.0
        return u / long, v / long, w / long

    @property
    def _middle(self) -> tuple[float, float]:
        xs, ys = zip(*((float(x), float(y)) for x, y in self.scene.points.values()), strict=True)
        return (max(xs) + min(xs)) / 2, (max(ys) + min(ys)) / 2

    def distance(self, sides: Sides) -> float:
        """How far a pole is from the mechanism's middle, in sizes of the mechanism; infinite of one at infinity."""
        u, v, w = self._unit(self.found[sides].at, dual=False)
        return math.hypot(u, v) / abs(w) if abs(w) > ONE**2 else math.inf

    def at_infinity(self, sides: Sides) -> bool:
        """Whether a pole is at infinity: exactly so, or beside rounding."""
        x, y, w = self.found[sides].at
        if isinstance(w, Fraction | int):
            return bool(w == 0)
        return bool(abs(self._unit((x, y, w), dual=False)[2]) <= 1e-13)
