"""Drawings of GeoGebra (.ggb): the objects of the construction with their values; a unit of its plane is a mm of paper.

What its objects are, the file states, or commands and expressions make it of others. Nothing is executed: a term
becomes a syntax tree, of which a table of few operations gives the value. Points are complex numbers. What is not in
the tables has no value.
"""

from __future__ import annotations

import ast
import cmath
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from copy import copy
from pathlib import Path
from typing import Any, NamedTuple, TypeVar
from xml.etree.ElementTree import Element

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files import measures
from graphplan.marking.files.drawing import arc_spots, circle_trace, drawing_submission, visible_stretch
from graphplan.marking.files.safe import contents, number, tree, unpack
from graphplan.marking.tolerances import PARALLEL_TOL
from graphplan.marking.traces import Spot, Submission, Trace, can_name_line, mark_name

T = TypeVar("T")
CAPTION_MODE = "3"  # the mode in which a caption is shown as label

LINE_TYPES, CIRCLE_TYPES = {"line", "segment", "ray", "vector"}, {"conic", "conicpart"}
UNDEFINED_NUMERALS = ("NaN", "?", "Infinity", "-Infinity")  # coordinates of what cannot be drawn
NUMERAL, NAME = r"\d+\.?\d*(?:E[+-]?\d+)?|\.\d+", r"[^\W\d](?:\w|')*(?:\{[^{}]*\}'*)?"
TOKEN = re.compile(rf"\s*(?:({NUMERAL})|({NAME})|(<=|>=|[-+*/^(),;\[\]°<>≤≥]))")
PYTHON_SIGNS = {"^": "**", "≤": "<=", "≥": ">=", ";": "|", "[": "(", "]": ")", "°": "**degree"}  # in Python's grammar


class LineValue(NamedTuple):
    """A line through a point, and the way in which it runs."""

    at: complex
    along: complex


class CircleValue(NamedTuple):
    """A circle by its centre and its radius."""

    at: complex
    radius: float


class PlaneVector(NamedTuple):
    """A vector, which is no point."""

    along: complex


def _line(point: complex, second: Any) -> LineValue:
    return LineValue(point, second - point if isinstance(second, complex) else second.along)


def _bisector(one: complex, two: complex) -> LineValue:
    return LineValue((one + two) / 2, 1j * (two - one))


def _meet(one: LineValue, two: LineValue) -> complex:
    across = _vector_product(one.along, two.along)
    if abs(across) <= PARALLEL_TOL * abs(one.along) * abs(two.along):
        raise ValueError("parallel lines do not meet")
    return one.at + one.along * _vector_product(two.at - one.at, two.along) / across


def _meetings(one: Any, two: Any) -> list[complex]:
    """Return the points where two lines or circles meet.

    Fails with `ValueError` where they do not.
    """
    if isinstance(two, CircleValue) and not isinstance(one, CircleValue):
        one, two = two, one
    if isinstance(one, CircleValue) and isinstance(two, CircleValue):
        apart = two.at - one.at
        share = (abs(apart) ** 2 + one.radius**2 - two.radius**2) / (2 * abs(apart) ** 2)
        two = LineValue(one.at + share * apart, 1j * apart)
    if not isinstance(two, LineValue) or not isinstance(one, CircleValue | LineValue):
        raise ValueError("only lines and circles meet")
    if isinstance(one, LineValue):
        return [_meet(one, two)]
    along = two.along / abs(two.along)
    foot = two.at + ((one.at - two.at) * along.conjugate()).real * along
    half = math.sqrt(one.radius**2 - abs(foot - one.at) ** 2)
    return [foot + half * along, foot - half * along]


def _vector_product(one: complex, two: complex) -> float:
    """The vector product."""
    return (one.conjugate() * two).imag


def _distance(point: complex, other: Any) -> float:
    if isinstance(other, LineValue):
        return abs(_vector_product(other.along, point - other.at)) / abs(other.along)
    return float(abs(point - other))


def _circle(centre: complex, other: Any) -> CircleValue:
    return CircleValue(centre, abs(other - centre if isinstance(other, complex) else other))


def _unit(thing: Any, turn: complex = 1.0) -> PlaneVector:
    return PlaneVector(turn * thing.along / abs(thing.along))


NUMBER_TYPES = float | int
DIRECTED_TYPES = LineValue | PlaneVector
COMMANDS: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {  # what a command does, and of which kinds of thing
    **dict.fromkeys(("Line", "Ray"), (_line, (complex, complex | DIRECTED_TYPES))),
    "Segment": (_line, (complex, complex)),
    **dict.fromkeys(("OrthogonalLine", "PerpendicularLine"),
                    (lambda point, other: LineValue(point, 1j * other.along), (complex, DIRECTED_TYPES))),
    **dict.fromkeys(("LineBisector", "PerpendicularBisector"), (_bisector, (complex, complex))),
    "Intersect": (_meet, (LineValue, LineValue)),
    "Midpoint": (lambda one, two: (one + two) / 2, (complex, complex)),
    "Distance": (_distance, (complex, complex | LineValue)), "Circle": (_circle, (complex, complex | NUMBER_TYPES)),
    "Center": (lambda circle: circle.at, (CircleValue,)), "Radius": (lambda circle: circle.radius, (CircleValue,)),
    "Vector": (lambda start, end=None: PlaneVector(start if end is None else end - start), (complex, complex)),
    "Direction": (lambda line: PlaneVector(line.along), (LineValue,)), "UnitVector": (_unit, (DIRECTED_TYPES,)),
    "OrthogonalVector": (lambda thing: PlaneVector(1j * thing.along), (DIRECTED_TYPES,)),
    "UnitOrthogonalVector": (lambda thing: _unit(thing, 1j), (DIRECTED_TYPES,)),
    "Translate": (lambda point, vector: point + vector.along, (complex, PlaneVector)),
    "Rotate": (lambda point, angle, centre: centre + (point - centre) * cmath.exp(1j * angle),
               (complex, NUMBER_TYPES, complex)),
    "If": (lambda holds, one, other: one if holds else other, (bool, object, object)),
    "sqrt": (math.sqrt, (NUMBER_TYPES,)), "abs": (abs, (complex | NUMBER_TYPES,)),
    "sgn": (lambda value: (value > 0) - (value < 0), (NUMBER_TYPES,)), "sin": (math.sin, (NUMBER_TYPES,)),
    "cos": (math.cos, (NUMBER_TYPES,)), "x": (lambda thing: _vector_or_point(thing).real, (complex | PlaneVector,)),
    "y": (lambda thing: _vector_or_point(thing).imag, (complex | PlaneVector,)),
}  # fmt: skip


def _vector_or_point(thing: Any) -> complex:
    return thing.along if isinstance(thing, PlaneVector) else complex(thing)


def _run_command(name: str, arguments: list[Any]) -> Any:
    """Run a command; fails with `ValueError` if it is unknown, or not for these arguments.

    Fails with `ValueError` where it is not known, or not for these arguments.
    """
    command, kinds = COMMANDS.get(name, (None, ()))
    if command is None or len(arguments) > len(kinds) or not all(map(isinstance, arguments, kinds)):
        raise ValueError(f"{name} is not known, or not of these")
    try:
        return command(*arguments)
    except (TypeError, ArithmeticError) as error:  # TypeError: it lacks arguments
        raise ValueError(f"{name}: {error}") from None


def _number(value: Any) -> float:
    if not isinstance(value, NUMBER_TYPES):
        raise ValueError("a number is expected")
    return float(value)


def _plus(one: Any, two: Any) -> Any:
    if isinstance(two, PlaneVector) and isinstance(one, complex | PlaneVector):
        return one + two.along if isinstance(one, complex) else PlaneVector(one.along + two.along)
    if isinstance(one, complex | NUMBER_TYPES) and isinstance(two, complex | NUMBER_TYPES):
        return one + two
    raise ValueError("these cannot be added")


def _times(one: Any, two: Any) -> Any:
    if isinstance(two, PlaneVector):
        one, two = two, one
    factor = two if isinstance(two, complex) else _number(two)
    if not isinstance(one, complex | NUMBER_TYPES | PlaneVector):
        raise ValueError("these cannot be multiplied")
    return PlaneVector(one.along * factor) if isinstance(one, PlaneVector) else one * factor


OPERATIONS: dict[type[ast.AST], Callable[[Any, Any], Any]] = {
    ast.Add: _plus, ast.Sub: lambda one, two: _plus(one, _times(two, -1.0)),
    ast.Mult: _times, ast.Div: lambda one, two: _times(one, 1 / _number(two)),
    ast.Pow: lambda one, two: _number(_number(one) ** _number(two)),
    ast.BitOr: lambda radius, angle: cmath.rect(_number(radius), _number(angle)),  # polar coordinates
    ast.LtE: operator.le, ast.GtE: operator.ge, ast.Lt: operator.lt, ast.Gt: operator.gt,
}  # fmt: skip


def _python_term(term: str, names: list[str]) -> str:
    """A term in Python's grammar; its names are numbered, and gathered."""
    tokens, place, term = [], 0, term.rstrip()
    while place < len(term):
        token = TOKEN.match(term, place)
        if token is None or len(term) > measures.MAX_TERM_LENGTH:
            raise ValueError(f"{term[place:place + 10]!r} is not understood")
        numeral, name, sign = token.groups()
        if name:
            names.append(name)
        tokens.append(repr(float(numeral)) if numeral else f"n{len(names) - 1}" if name
                      else PYTHON_SIGNS.get(sign, sign))
        place = token.end()
    return " ".join(tokens)


def _evaluate(node: ast.AST, names: list[str], known: Mapping[str, Any]) -> Any:
    def value_of(argument: ast.AST) -> Any:
        return _evaluate(argument, names, known)

    match node:
        case ast.Constant(value=float(value)):
            return value
        case ast.Name(id=name):
            return known[names[int(name[1:])]]
        case ast.Tuple(elts=[x, y]):
            return complex(_number(value_of(x)), _number(value_of(y)))
        case ast.UnaryOp(op=ast.USub(), operand=argument):
            return _times(value_of(argument), -1.0)
        case ast.BinOp(op=ast.Pow(), left=argument, right=ast.Name(id="degree")):
            return _times(value_of(argument), math.pi / 180)
        case ast.BinOp(op=sign, left=one, right=two):
            return OPERATIONS[type(sign)](value_of(one), value_of(two))
        case ast.Compare(left=one, ops=[sign], comparators=[two]):
            return OPERATIONS[type(sign)](_number(value_of(one)), _number(value_of(two)))
        case ast.Call(func=ast.Name(id=name), args=arguments):
            return _run_command(names[int(name[1:])], [value_of(argument) for argument in arguments])
    raise ValueError("a term is not understood")


class GeoGebraObjects:
    """The objects of a construction by label: elements, the commands that make them, and values of those that have one.
    """

    def __init__(self, construction: Element):
        self.document = construction
        self.elements: dict[str, Element] = {}
        self.commands: dict[str, tuple[str, list[str], int]] = {}  # its name, of what, and which of its results
        self.values: dict[str, Any] = {}
        self.terms: dict[str, str] = {}  # the expressions of those that have one
        self.left = measures.MAX_TERM_LETTERS
        for child in construction:
            if child.tag == "expression":
                self.terms[child.get("label", "")] = child.get("exp", "")
            elif child.tag == "command":
                inputs = _command_arguments(child.find("input"))
                for place, label in enumerate(_command_arguments(child.find("output"))):
                    self.commands[label] = child.get("name", ""), inputs, place
            elif child.tag == "element":
                label = child.get("label", "")
                self.elements[label] = child
                value = stated_value(child)
                if value is None and label in self.terms:
                    value = self.term(self.terms[label])
                name, inputs, place = self.commands.get(label, ("", [], 0))
                if value is None and name and not place:
                    with suppress(ValueError):
                        value = _run_command(name, [self.term(term) for term in inputs])
                if value is not None:
                    self.values[label] = value

    def term(self, term: str) -> Any:
        """The value of a label or a term: a number, a point as complex number, a line, a circle, a vector.

        None where it has none.
        """
        if term in self.values:
            return self.values[term]
        self.left -= len(term)
        try:
            if self.left >= 0:
                names: list[str] = []
                return _evaluate(ast.parse(_python_term(term, names), mode="eval").body, names, self.values)
        except (ValueError, ArithmeticError, SyntaxError, RecursionError, MemoryError, KeyError):
            pass  # it is not understood
        return None

    def values_with(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return the values of all objects for other values of free ones; nan for objects that are made of these in an
        unknown way."""
        objects, changed = copy(self), {*values}
        objects.values = {"xAxis": LineValue(0j, 1 + 0j), "yAxis": LineValue(0j, 1j), **self.values, **values}
        objects.left = measures.MAX_TERM_LETTERS
        for name in self.elements:
            inputs, term = self.commands.get(name, ("", [], 0))[1], self.terms.get(name, "")
            if name not in values and not changed.isdisjoint(re.findall(NAME, " ".join([*inputs, term]))):
                changed.add(name)
                objects.values.pop(name, None)
                with suppress(ValueError, ArithmeticError):
                    if (remade := objects._remake(name, self.values.get(name))) is not None:
                        objects.values[name] = remade
        return objects.values

    def _remake(self, label: str, before: Any) -> Any:
        """The value of an object by its command or term: of several places that which is next to the one `before`."""
        name, inputs, _ = self.commands.get(label, ("", [], 0))
        if not name:
            return self.term(self.terms.get(label, ""))
        ends = [self._ends(term) for term in inputs]
        if name == "Midpoint" and len(inputs) == 1 and ends[0]:
            return sum(ends[0]) / 2
        values = [self.term(term) for term in inputs]
        if name == "Circle" and len(ends) == 2 and ends[1]:
            values[1] = abs(ends[1][1] - ends[1][0])
        if name == "Intersect" and isinstance(before, complex) and len(values) > 1:
            return min(_meetings(*values[:2]), key=lambda place: abs(place - before))
        return _run_command(name, values)

    def _ends(self, label: str) -> list[complex]:
        """The ends of a segment; empty for any other object."""
        name, inputs, _ = self.commands.get(label, ("", [], 0))
        ends = [end for end in map(self.term, inputs) if isinstance(end, complex)]
        return ends if name == "Segment" and len(ends) == 2 else []

    def point(self, term: str) -> complex | None:
        """The value of a term if it is a point."""
        value = self.term(term)
        return value if isinstance(value, complex) else None


def _command_arguments(element: Element | None) -> list[str]:
    """a0, a1, ... of a command."""
    return [] if element is None else [element.get(f"a{i}", "") for i in range(len(element.attrib))]


def stated_value(element: Element) -> Any:
    """The value that the file states for an object; None if it is missing or undefined.

    Fails with `ValueError` if a number is not readable.
    """
    kind, coords = element.get("type"), element.find("coords")
    if kind in ("numeric", "angle"):
        value = element.find("value")
        return None if value is None else coordinate(value.get("val", ""))
    if kind in CIRCLE_TYPES:
        return _circle_of_conic(element.find("matrix"))
    if coords is None:
        return None
    x, y, z = (coordinate(coords.get(name, "0")) for name in "xyz")
    if not math.isfinite(x + y + z):
        return None
    if kind == "point":
        return complex(x / z, y / z) if z else None
    if kind == "vector":
        return PlaneVector(complex(x, y))
    across = complex(x, y)  # of the line x X + y Y + z = 0
    return LineValue(-z * across / abs(across) ** 2, -1j * across) if across and kind in LINE_TYPES else None


def coordinate(written: str) -> float:
    """A coordinate; nan if it is undefined."""
    return math.nan if written in UNDEFINED_NUMERALS else number(written)


def _circle_of_conic(matrix: Element | None) -> CircleValue | None:
    """A circle by the coefficients of x², y², 1, xy, x and y, the last three halved; None if it is not a circle."""
    if matrix is None:
        return None
    xx, yy, constant, xy, x, y = (coordinate(matrix.get(f"A{i}", "0")) for i in range(6))
    if not math.isfinite(xx + yy + constant + xy + x + y) or not xx or (
            abs(xx - yy) + abs(xy) > measures.SHAPE_TOL * abs(xx)):
        return None
    centre = complex(-x / xx, -y / xx)
    square = abs(centre) ** 2 - constant / xx
    return CircleValue(centre, math.sqrt(square)) if square > 0 else None


def is_shown(element: Element) -> bool:
    """Whether an object is shown."""
    show = element.find("show")
    return show is None or show.get("object") != "false"


def read_construction(path: Path, data: bytes, read: Callable[[GeoGebraObjects], T]) -> T:
    """Read from the objects of a GeoGebra file; fails with `Refused` if it is damaged."""
    root = tree(path, unpack(path, data, "geogebra.xml", measures.MAX_GGB_BYTES))
    construction = root.find("construction")
    if root.tag != "geogebra" or construction is None:
        raise Refused(f"{path}", "it holds no construction of GeoGebra", "save the drawing anew")
    try:
        objects = GeoGebraObjects(construction)
        objects.document = root
        return read(objects)
    except (ValueError, ArithmeticError) as error:
        raise Refused(f"{path}", f"the drawing is damaged ({error})", "save it anew") from None


ARC_COMMANDS = {"CircleArc", "CircularArc", "Arc"}


def read_ggb(path: Path) -> Submission:
    """The things that are to be seen in a GeoGebra file, and hidden points that are named as marks."""
    return read_construction(path, contents(path, measures.MAX_GGB_BYTES),
                             lambda objects: drawing_submission(path, _traces(objects), (), {}, _tips(objects)))


def _traces(objects: GeoGebraObjects) -> list[Trace]:
    """Points first, as lines without ends go as far as these do."""
    points = []
    for label, element in objects.elements.items():
        value, name = objects.values.get(label), mark_name(_letters(label, element))
        if element.get("type") == "point" and isinstance(value, complex) and (name or is_shown(element)):
            points.append(Trace(POINT, ((value.real, value.imag),), name))
    xs, ys = ([trace.spots[0][i] for trace in points] or [0.0] for i in (0, 1))
    box = [(x, y) for x in (min(xs), max(xs)) for y in (min(ys), max(ys))]  # no line without ends is seen farther
    return points + [trace for label in objects.elements for trace in _curve(objects, label, box)]


def _tips(objects: GeoGebraObjects) -> list[Spot]:
    """Ends of the visible vectors."""
    return [ends[1] for label, element in objects.elements.items()
            if element.get("type") == "vector" and is_shown(element) and (ends := _ends(objects, label))]


def _curve(objects: GeoGebraObjects, label: str, box: list[Spot]) -> Iterator[Trace]:
    """A line or circle that is seen; its label is a name where it is a Greek letter or a number, as others are given
    by GeoGebra."""
    element, value = objects.elements[label], objects.values.get(label)
    if not is_shown(element):
        return
    letters = mark_name(_letters(label, element))
    name = letters if can_name_line(letters) else ""
    if element.get("type") in CIRCLE_TYPES:
        yield from _round(objects, label, name)
    elif element.get("type") in LINE_TYPES:
        ends = _ends(objects,
                     label) or (visible_stretch(value.at, value.along, box) if isinstance(value, LineValue) else None)
        if ends is not None:
            yield Trace(LINE, ends, name)


def _round(objects: GeoGebraObjects, label: str, name: str) -> Iterator[Trace]:
    """A circle, or as much of it as an arc has."""
    command, inputs, _ = objects.commands.get(label, ("", [], 0))
    circle = objects.values.get(label)
    arc = [spot for term in inputs if (spot := objects.point(term)) is not None] if command in ARC_COMMANDS else []
    if len(arc) == 3 and arc[0] != arc[1]:
        centre, *ends = arc
        angles = [math.degrees(math.atan2((end - centre).imag, (end - centre).real)) for end in ends]
        yield Trace(CIRCLE, arc_spots((centre.real, centre.imag), abs(ends[0] - centre), *angles), name)
    elif isinstance(circle, CircleValue):
        trace = circle_trace((circle.at.real, circle.at.imag), circle.radius)
        yield Trace(trace.kind, trace.spots, name)


def _ends(objects: GeoGebraObjects, label: str) -> tuple[Spot, Spot] | None:
    """The ends of a segment, a polygon's side or a vector, which begins at its start point, else at the origin; None if
    they do not exist or are unknown."""
    command, inputs, place = objects.commands.get(label, ("", [], 0))
    value, begin = objects.values.get(label), objects.elements[label].find("startPoint")
    start: complex | None = 0j
    end: complex | None = None
    if command == "Polygon" and 0 < place <= len(inputs):
        start, end = objects.point(inputs[place - 1]), objects.point(inputs[place % len(inputs)])
    elif command in ("Segment", "Vector") and len(inputs) == 2:
        start, end = objects.point(inputs[0]), objects.point(inputs[1])
    elif isinstance(value, PlaneVector):
        if begin is not None:
            start = objects.point(begin.get("exp", "")) if "exp" in begin.attrib else complex(
                coordinate(begin.get("x", "0")), coordinate(begin.get("y", "0")))
        end = None if start is None else start + value.along
    if start is None or end is None or start == end:
        return None
    return (start.real, start.imag), (end.real, end.imag)


def _letters(label: str, element: Element) -> str:
    """Text beside an object: its caption if that is shown or the label is no mark's, else its label."""
    mode, caption = element.find("labelMode"), element.find("caption")
    caption_text = "" if caption is None else caption.get("val", "")
    captioned = not mark_name(label) or (mode is not None and mode.get("val") == CAPTION_MODE)
    return caption_text if captioned and mark_name(caption_text) else label
