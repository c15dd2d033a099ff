"""What the objects of a GeoGebra file are: as the file states it, or as commands and expressions make it of others.

Nothing is executed: a term becomes a syntax tree, of which a table of few operations gives the value; commands are the
rules of the kernel. Points are complex numbers, lines and circles as the kernel has them. What is not in the tables has
no value.
"""

from __future__ import annotations

import ast
import cmath
import math
import operator
import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

from graphplan.errors import Undrawable
from graphplan.kernel.elementary import bisector, foot, midpoint, parallel, perpendicular
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.primitives import guide, line, meet
from graphplan.marking.files.curves import NEAR
from graphplan.marking.files.safe import number

LINES, CIRCLES = {"line", "segment", "ray", "vector"}, {"conic", "conicpart"}
UNDEFINED = ("NaN", "?", "Infinity", "-Infinity")  # coordinates of what cannot be drawn
LETTERS, LONGEST = 300_000, 2000  # of all terms that are worked out, and of one; what is beyond has no value
NUMERAL, NAME = r"\d+\.?\d*(?:E[+-]?\d+)?|\.\d+", r"[^\W\d](?:\w|')*(?:\{[^{}]*\}'*)?"
TOKEN = re.compile(rf"\s*(?:({NUMERAL})|({NAME})|(<=|>=|[-+*/^(),\[\]°<>≤≥]))")
DEGREE = "degree"
SIGNS = {"^": "**", "≤": "<=", "≥": ">=", "[": "(", "]": ")", "°": f"**{DEGREE}"}  # in Python's grammar
FLOATS = Floats()


class LineValue(NamedTuple):
    """A line a x + b y + c = 0, which runs along (b, -a)."""

    a: float
    b: float
    c: float

    @property
    def along(self) -> complex:
        return complex(self.b, -self.a)

    @property
    def at(self) -> complex:
        """Its point nearest to the origin."""
        return -self.c * complex(self.a, self.b) / (self.a**2 + self.b**2)


class CircleValue(NamedTuple):
    """A circle by its centre and the square of its radius."""

    x: float
    y: float
    square: float

    @property
    def at(self) -> complex:
        return complex(self.x, self.y)

    @property
    def radius(self) -> float:
        return math.sqrt(self.square)


class Vector(NamedTuple):
    """A vector, which is no point."""

    z: complex

    @property
    def along(self) -> complex:
        return self.z


def _ruled(rule: Callable[..., Any], *things: Any, **params: float) -> Any:
    """What a rule of the kernel gives."""
    read = [(thing.real, thing.imag) if isinstance(thing, complex) else thing for thing in things]
    found = rule(FLOATS, *read, **params)
    return LineValue(*found) if len(found) == 3 else complex(*found)


def _line(point: complex, second: Any) -> LineValue:
    match second:
        case Vector(z):
            found = _ruled(guide, point, dx=z.real, dy=z.imag)
        case LineValue():
            found = _ruled(parallel, second, point)
        case _:
            found = _ruled(line, point, second)
    return LineValue(*found)


def _upright(point: complex, other: Any) -> LineValue:
    return LineValue(*_ruled(perpendicular, _line(point, other), point))


def _distance(point: complex, other: Any) -> float:
    end: complex = _ruled(foot, other, point) if isinstance(other, LineValue) else other
    return abs(point - end)


def _circle(centre: complex, other: Any) -> CircleValue:
    return CircleValue(centre.real, centre.imag, (abs(other - centre) if isinstance(other, complex) else other) ** 2)


def _unit(thing: Any, turn: complex = 1.0) -> Vector:
    return Vector(turn * thing.along / abs(thing.along))


NUMBER = float | int
DIRECTED = LineValue | Vector
CALLS: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {  # what a command does, and of which kinds of thing
    **dict.fromkeys(("Line", "Ray"), (_line, (complex, complex | DIRECTED))), "Segment": (_line, (complex, complex)),
    **dict.fromkeys(("OrthogonalLine", "PerpendicularLine"), (_upright, (complex, DIRECTED))),
    **dict.fromkeys(("LineBisector", "PerpendicularBisector"),
                    (lambda one, two: _ruled(bisector, one, two), (complex, complex))),
    "Intersect": (lambda one, two: _ruled(meet, one, two), (LineValue, LineValue)),
    "Midpoint": (lambda one, two: _ruled(midpoint, one, two), (complex, complex)),
    "Distance": (_distance, (complex, complex | LineValue)), "Circle": (_circle, (complex, complex | NUMBER)),
    "Center": (lambda circle: circle.at, (CircleValue,)), "Radius": (lambda circle: circle.radius, (CircleValue,)),
    "Vector": (lambda start, end=None: Vector(start if end is None else end - start), (complex, complex)),
    "Direction": (lambda line: Vector(line.along), (LineValue,)), "UnitVector": (_unit, (DIRECTED,)),
    "OrthogonalVector": (lambda thing: Vector(1j * thing.along), (DIRECTED,)),
    "UnitOrthogonalVector": (lambda thing: _unit(thing, 1j), (DIRECTED,)),
    "Translate": (lambda point, vector: point + vector.z, (complex, Vector)),
    "Rotate": (lambda point, angle, centre: centre + (point - centre) * cmath.exp(1j * angle),
               (complex, NUMBER, complex)),
    "If": (lambda holds, one, other: one if holds else other, (bool, object, object)),
    "sqrt": (math.sqrt, (NUMBER,)), "abs": (abs, (complex | NUMBER,)),
    "sgn": (lambda value: (value > 0) - (value < 0), (NUMBER,)), "sin": (math.sin, (NUMBER,)),
    "cos": (math.cos, (NUMBER,)), "x": (lambda thing: _place(thing).real, (complex | Vector,)),
    "y": (lambda thing: _place(thing).imag, (complex | Vector,)),
}  # fmt: skip


def _place(thing: Any) -> complex:
    return thing.z if isinstance(thing, Vector) else complex(thing)


def called(name: str, arguments: list[Any]) -> Any:
    """What a command gives.

    Fails with `ValueError` where it is not known, or not for these arguments.
    """
    made, kinds = CALLS.get(name, (None, ()))
    if made is None or len(arguments) > len(kinds) or not all(map(isinstance, arguments, kinds)):
        raise ValueError(f"{name} is not known, or not of these")
    try:
        return made(*arguments)
    except (TypeError, ArithmeticError, Undrawable) as error:  # TypeError: it lacks arguments
        raise ValueError(f"{name}: {error}") from None


def _number(value: Any) -> float:
    if not isinstance(value, NUMBER):
        raise ValueError("a number is meant")
    return float(value)


def _plus(one: Any, two: Any) -> Any:
    if isinstance(two, Vector) and isinstance(one, complex | Vector):
        return one + two.z if isinstance(one, complex) else Vector(one.z + two.z)
    if isinstance(one, complex | NUMBER) and isinstance(two, complex | NUMBER):
        return one + two
    raise ValueError("these cannot be added")


def _times(one: Any, two: Any) -> Any:
    if isinstance(two, Vector):
        one, two = two, one
    factor = two if isinstance(two, complex) else _number(two)
    if not isinstance(one, complex | NUMBER | Vector):
        raise ValueError("these cannot be multiplied")
    return Vector(one.z * factor) if isinstance(one, Vector) else one * factor


OPERATIONS: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: _plus, ast.Sub: lambda one, two: _plus(one, _times(two, -1.0)),
    ast.Mult: _times, ast.Div: lambda one, two: _times(one, 1 / _number(two)),
    ast.Pow: lambda one, two: _number(_number(one) ** _number(two)),
    ast.LtE: operator.le, ast.GtE: operator.ge, ast.Lt: operator.lt, ast.Gt: operator.gt,
}  # fmt: skip


def valued(term: str, known: Mapping[str, Any]) -> Any:
    """The value of a term: a number, a point as complex number, a line, a circle, a vector.

    Fails with `ValueError` where it has none.
    """
    try:
        names: list[str] = []
        return _valued(ast.parse(_written(term, names), mode="eval").body, names, known)
    except (SyntaxError, RecursionError, MemoryError, KeyError):
        raise ValueError("a term is not understood") from None


def _written(term: str, names: list[str]) -> str:
    """A term in Python's grammar; its names are numbered, and gathered."""
    found, place, term = [], 0, term.rstrip()
    while place < len(term):
        token = TOKEN.match(term, place)
        if token is None or len(term) > LONGEST:
            raise ValueError(f"{term[place:place + 10]!r} is not understood")
        numeral, name, sign = token.groups()
        if name:
            names.append(name)
        found.append(repr(float(numeral)) if numeral else f"n{len(names) - 1}" if name else SIGNS.get(sign, sign))
        place = token.end()
    return " ".join(found)


def _valued(node: ast.AST, names: list[str], known: Mapping[str, Any]) -> Any:
    def of(part: ast.AST) -> Any:
        return _valued(part, names, known)

    match node:
        case ast.Constant(value=float(value)):
            return value
        case ast.Name(id=name):
            return known[names[int(name[1:])]]
        case ast.Tuple(elts=[x, y]):
            return complex(_number(of(x)), _number(of(y)))
        case ast.UnaryOp(op=ast.USub(), operand=part):
            return _times(of(part), -1.0)
        case ast.BinOp(op=ast.Pow(), left=part, right=ast.Name(id="degree")):
            return _times(of(part), math.pi / 180)
        case ast.BinOp(op=sign, left=one, right=two):
            return OPERATIONS[type(sign)](of(one), of(two))
        case ast.Compare(left=one, ops=[sign], comparators=[two]):
            return OPERATIONS[type(sign)](_number(of(one)), _number(of(two)))
        case ast.Call(func=ast.Name(id=name), args=arguments):
            return called(names[int(name[1:])], [of(part) for part in arguments])
    raise ValueError("a term is not understood")


class Objects:
    """The objects of a construction by label: elements, the commands that make them, and values of those that have one.
    """

    def __init__(self, construction: Element):
        self.elements: dict[str, Element] = {}
        self.commands: dict[str, tuple[str, list[str], int]] = {}  # its name, of what, and which of its results
        self.values: dict[str, Any] = {}
        self.left = LETTERS
        terms: dict[str, str] = {}
        for child in construction:
            if child.tag == "expression":
                terms[child.get("label", "")] = child.get("exp", "")
            elif child.tag == "command":
                inputs = _arguments(child.find("input"))
                for place, label in enumerate(_arguments(child.find("output"))):
                    self.commands[label] = child.get("name", ""), inputs, place
            elif child.tag == "element":
                label = child.get("label", "")
                self.elements[label] = child
                value = stated(child)
                if value is None and label in terms:
                    value = self.term(terms[label])
                if value is None and label in self.commands:
                    value = self._made(*self.commands[label])
                if value is not None:
                    self.values[label] = value

    def _made(self, name: str, inputs: list[str], place: int) -> Any:
        try:
            return None if place else called(name, [self.term(term) for term in inputs])
        except ValueError:
            return None

    def term(self, term: str) -> Any:
        """The value of a label or a term; None where it has none."""
        if term in self.values:
            return self.values[term]
        self.left -= len(term)
        try:
            return valued(term, self.values) if self.left >= 0 else None
        except (ValueError, ArithmeticError):
            return None

    def point(self, term: str) -> complex | None:
        """The value of a term if it is a point."""
        value = self.term(term)
        return value if isinstance(value, complex) else None


def _arguments(element: Element | None) -> list[str]:
    """a0, a1, ... of a command."""
    return [] if element is None else [element.get(f"a{i}", "") for i in range(len(element.attrib))]


def stated(element: Element) -> Any:
    """The value that the file states for an object; None where it states none, or it is undefined.

    Fails with `ValueError` where a number is none.
    """
    kind, coords = element.get("type"), element.find("coords")
    if kind in ("numeric", "angle"):
        value = element.find("value")
        return None if value is None else finite(value.get("val", ""))
    if kind in CIRCLES:
        return _conic(element.find("matrix"))
    if coords is None:
        return None
    x, y, z = (finite(coords.get(name, "0")) for name in "xyz")
    if not math.isfinite(x + y + z):
        return None
    if kind == "point":
        return complex(x / z, y / z) if z else None
    if kind == "vector":
        return Vector(complex(x, y))
    return LineValue(x, y, z) if (x or y) and kind in LINES else None


def finite(written: str) -> float:
    """A coordinate; what cannot be drawn has none."""
    return math.nan if written in UNDEFINED else number(written)


def _conic(matrix: Element | None) -> CircleValue | None:
    """A circle by the coefficients of x², y², 1, xy, x and y, the last three halved; None where it is none."""
    if matrix is None:
        return None
    xx, yy, one, xy, x, y = (finite(matrix.get(f"A{i}", "0")) for i in range(6))
    if not math.isfinite(xx + yy + one + xy + x + y) or not xx or abs(xx - yy) + abs(xy) > NEAR * abs(xx):
        return None
    centre = complex(-x / xx, -y / xx)
    square = abs(centre) ** 2 - one / xx
    return CircleValue(centre.real, centre.imag, square) if square > 0 else None
