"""GeoGebra's commands and expressions as far as drawings need them: values of what a file states no coordinates for.

Nothing is executed: a term is parsed by its grammar and reckoned from a table of a few operations. What is not in the
table has no value.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

NUMERAL, NAME = r"\d+\.?\d*(?:E[+-]?\d+)?|\.\d+", r"[^\W\d](?:\w|')*(?:\{[^{}]*\}'*)?"
TOKEN = re.compile(rf"\s*(?:({NUMERAL})|({NAME})|(<=|>=|[-+*/^(),\[\]°<>≤≥]))")
DEEPEST = 40  # terms within each other
LONGEST = 20_000  # characters of a term


class Ray(NamedTuple):
    """A line by a point and its direction."""

    at: complex
    along: complex


class Round(NamedTuple):
    """A circle."""

    at: complex
    radius: float


class Vector(NamedTuple):
    """A vector, which is no point."""

    z: complex


def _cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag


def _along(thing: Any) -> complex:
    return thing.along if isinstance(thing, Ray) else thing.z


def _line(point: complex, second: Any) -> Ray:
    return Ray(point, second - point if isinstance(second, complex) else _along(second))


def _meet(k: Ray, l: Ray) -> complex:
    return k.at + _cross(l.at - k.at, l.along) / _cross(k.along, l.along) * k.along


def _distance(point: complex, other: Any) -> float:
    return abs(_cross(other.along, point - other.at)) / abs(other.along) if isinstance(other, Ray) else abs(
        other - point)


def _circle(centre: complex, other: Any) -> Round:
    return Round(centre, abs(other - centre) if isinstance(other, complex) else float(other))


def _vector(start: complex, end: complex | None = None) -> Vector:
    return Vector(start if end is None else end - start)


def _if(holds: bool, one: Any, other: Any) -> Any:
    return one if holds else other


NUMBER = float | int
DIRECTED = Ray | Vector
CALLS: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {  # what a command does, and of which kinds of thing
    "Line": (_line, (complex, complex | DIRECTED)), "Ray": (_line, (complex, complex | DIRECTED)),
    "Segment": (_line, (complex, complex)), "Intersect": (_meet, (Ray, Ray)),
    "Distance": (_distance, (complex, complex | Ray)), "Circle": (_circle, (complex, complex | NUMBER)),
    "Vector": (_vector, (complex, complex)),
    "OrthogonalLine": (lambda point, other: Ray(point, 1j * _along(other)), (complex, DIRECTED)),
    "PerpendicularLine": (lambda point, other: Ray(point, 1j * _along(other)), (complex, DIRECTED)),
    "LineBisector": (lambda one, two: Ray((one + two) / 2, 1j * (two - one)), (complex, complex)),
    "PerpendicularBisector": (lambda one, two: Ray((one + two) / 2, 1j * (two - one)), (complex, complex)),
    "Midpoint": (lambda one, two: (one + two) / 2, (complex, complex)),
    "Center": (lambda round_one: round_one.at, (Round,)), "Radius": (lambda round_one: round_one.radius, (Round,)),
    "Direction": (lambda line: Vector(line.along), (Ray,)),
    "UnitVector": (lambda thing: Vector(_along(thing) / abs(_along(thing))), (DIRECTED,)),
    "OrthogonalVector": (lambda thing: Vector(1j * _along(thing)), (DIRECTED,)),
    "UnitOrthogonalVector": (lambda thing: Vector(1j * _along(thing) / abs(_along(thing))), (DIRECTED,)),
    "Translate": (lambda point, vector: point + vector.z, (complex, Vector)),
    "Rotate": (lambda point, angle, centre: centre + (point - centre) * cmath.exp(1j * angle),
               (complex, NUMBER, complex)),
    "If": (_if, (bool, object, object)), "sqrt": (math.sqrt, (NUMBER,)), "abs": (abs, (complex | NUMBER,)),
    "sgn": (lambda value: (value > 0) - (value < 0), (NUMBER,)),
    "x": (lambda thing: (thing.z if isinstance(thing, Vector) else thing).real, (complex | Vector,)),
    "y": (lambda thing: (thing.z if isinstance(thing, Vector) else thing).imag, (complex | Vector,)),
    "sin": (math.sin, (NUMBER,)), "cos": (math.cos, (NUMBER,)),
}  # fmt: skip
COMPARED: dict[str, Callable[[float, float], bool]] = {
    "<=": lambda a, b: a <= b, "≤": lambda a, b: a <= b, ">=": lambda a, b: a >= b, "≥": lambda a, b: a >= b,
    "<": lambda a, b: a < b, ">": lambda a, b: a > b,
}  # fmt: skip


def called(name: str, arguments: list[Any]) -> Any:
    """What a command gives.

    Fails with `ValueError` where it is not known, or not for these arguments.
    """
    made, kinds = CALLS.get(name, (None, ()))
    if made is None or len(arguments) > len(kinds) or not all(map(isinstance, arguments, kinds)):
        raise ValueError(f"{name} is not known, or not of these")
    try:
        return made(*arguments)
    except (TypeError, ArithmeticError) as error:  # TypeError: it lacks arguments
        raise ValueError(f"{name}: {error}") from None


def reckoned(term: str, known: Mapping[str, Any]) -> Any:
    """The value of a term: a number, a point as complex number, a line, a circle, a vector.

    Fails with `ValueError` where it has none.
    """
    if len(term) > LONGEST:
        raise ValueError("a term is too long")
    parser = _Parser(term, known)
    value = parser.compared()
    if parser.next:
        raise ValueError(f"{parser.next!r} is not understood")
    return value


class _Parser:
    """Descends through one term; `known` gives the values of labels."""

    def __init__(self, term: str, known: Mapping[str, Any]):
        self.tokens, self.known, self.place, self.depth = _tokens(term), known, 0, 0

    @property
    def next(self) -> str:
        """The token ahead; nothing at the end."""
        return self.tokens[self.place][0] if self.place < len(self.tokens) else ""

    def _taken(self, *among: str) -> str:
        """The next token if it is one of these."""
        token = self.next
        if token not in among or not token:
            return ""
        self.place += 1
        return token

    def compared(self) -> Any:
        """Sums, or two that are compared."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError("a term is nested too deeply")
        value = self._sum()
        if sign := self._taken(*COMPARED):
            value = COMPARED[sign](_number(value), _number(self._sum()))
        self.depth -= 1
        return value

    def _sum(self) -> Any:
        value = self._product()
        while sign := self._taken("+", "-"):
            value = _added(value, _times(self._product(), 1.0 if sign == "+" else -1.0))
        return value

    def _product(self) -> Any:
        value = self._power()
        while sign := self._taken("*", "/"):
            other = self._power()
            value = _times(value, other if sign == "*" else 1 / _number(other))
        return value

    def _power(self) -> Any:
        if self._taken("-"):
            return _times(self._power_below(), -1.0)
        value = self._atom()
        if self._taken("^"):
            return _number(_number(value) ** _number(self._power_below()))
        return _times(value, math.pi / 180) if self._taken("°") else value

    def _power_below(self) -> Any:
        """A power within another, counted."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError("a term is nested too deeply")
        value = self._power()
        self.depth -= 1
        return value

    def _atom(self) -> Any:
        """A numeral, a label, a call, a point, or a term in parentheses."""
        if self.place >= len(self.tokens):
            raise ValueError("a term ends too early")
        token, kind = self.tokens[self.place]
        self.place += 1
        if kind == "number":
            return float(token)
        if kind == "name":
            if self.next in ("(", "["):
                return called(token, self._list())
            return self._value(token)
        if token != "(":
            raise ValueError(f"{token!r} is not understood")
        self.place -= 1
        parts = self._list()
        if len(parts) == 2:
            return complex(_number(parts[0]), _number(parts[1]))
        if len(parts) != 1:
            raise ValueError("a point has two coordinates")
        return parts[0]

    def _value(self, label: str) -> Any:
        if label not in self.known:
            raise ValueError(f"{label!r} has no value")
        return self.known[label]

    def _list(self) -> list[Any]:
        """Terms between parentheses or brackets."""
        opened = self._taken("(", "[")
        found = [self.compared()]
        while self._taken(","):
            found.append(self.compared())
        if not self._taken(")" if opened == "(" else "]"):
            raise ValueError("a parenthesis is open")
        return found


def _tokens(term: str) -> list[tuple[str, str]]:
    """The tokens with their kinds."""
    found, place, term = [], 0, term.rstrip()
    while place < len(term):
        token = TOKEN.match(term, place)
        if token is None:
            raise ValueError(f"{term[place:place + 10]!r} is not understood")
        kind = "number" if token[1] else "name" if token[2] else "sign"
        found.append((token[1] or token[2] or token[3], kind))
        place = token.end()
    return found


def _number(value: Any) -> float:
    if not isinstance(value, float | int):
        raise ValueError("a number is meant")
    return float(value)


def _added(one: Any, two: Any) -> Any:
    match one, two:
        case Vector(u), Vector(v):
            return Vector(u + v)
        case (complex(), Vector(v)):
            return one + v
        case (complex() | float() | int(), complex() | float() | int()):
            return one + two
    raise ValueError("these cannot be added")


def _times(one: Any, two: Any) -> Any:
    if isinstance(two, Vector):
        one, two = two, one
    factor = _number(two) if not isinstance(two, complex) else two
    if isinstance(one, Vector):
        return Vector(one.z * factor)
    if isinstance(one, complex | float | int):
        return one * factor
    raise ValueError("these cannot be multiplied")
