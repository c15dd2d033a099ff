"""A reader of the part of GeoGebra's files that exports use: every object from its command, as GeoGebra 4.0 reckons it.

Points are complex numbers; a line is a point and a direction; a circle its centre and radius.
"""

from __future__ import annotations

import ast
import cmath
import io
import math
import re
import zipfile
from collections.abc import Mapping
from functools import lru_cache
from types import CodeType
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, fromstring

WORD = re.compile(r"(?<![\w.'])[^\W\d](?:\w|')*(?:\{[^}]*\}'*)?")  # v_{a}, B_{1}', sqrt


class Ray(NamedTuple):
    at: complex
    along: complex


class Round(NamedTuple):
    at: complex
    radius: float


class Vector(NamedTuple):
    z: complex

    def __rmul__(self, factor: Any) -> Vector:
        return Vector(factor * self.z)

    def __neg__(self) -> Vector:
        return Vector(-self.z)


class Undefined(complex):
    """What there is not in a pose, of whatever kind: all that hangs on it is undefined, too."""

    @property
    def z(self) -> Undefined:
        return self

    at = along = radius = z


def _z(spot: Any) -> complex:
    return complex(*spot) if type(spot) is tuple else spot


def _vector(start: Any, end: Any = None) -> Vector:
    return Vector(_z(start) if end is None else end - start)


def _line(P: Any, second: Any) -> Ray:
    P = _z(P)
    return Ray(P, second.along if isinstance(second, Ray) else second.z if isinstance(second, Vector) else second - P)


def _cross(u: complex, v: complex) -> float:
    return (u.conjugate() * v).imag


def _intersect(k: Ray, l: Ray) -> complex:
    return k.at + _cross(l.at - k.at, l.along) / _cross(k.along, l.along) * k.along


def _distance(P: complex, Q: Any) -> float:
    return abs(_cross(Q.along / abs(Q.along), P - Q.at)) if isinstance(Q, Ray) else abs(Q - P)


def _along(thing: Any) -> complex:
    return thing.along if isinstance(thing, Ray) else thing.z


COMMANDS = {
    "Line": _line, "Intersect": _intersect, "Distance": _distance, "Vector": _vector,
    "Circle": lambda C, r: Round(_z(C), r), "Center": lambda c: c.at, "Radius": lambda c: c.radius,
    "OrthogonalLine": lambda P, l: Ray(_z(P), 1j * l.along),
    "LineBisector": lambda P, Q: Ray((P + Q) / 2, 1j * (Q - P)),
    "Midpoint": lambda P, Q: (P + Q) / 2,
    "Translate": lambda P, v: P + v.z,
    "Rotate": lambda P, angle, C: C + (P - C) * cmath.exp(1j * angle),
    "Direction": lambda l: l.along,
    "UnitVector": lambda l: Vector(_along(l) / abs(_along(l))),
    "OrthogonalVector": lambda v: Vector(1j * v.z),
    "UnitOrthogonalVector": lambda v: Vector(1j * v.z / abs(v.z)),
    "Segment": lambda *ends: ends, "Polygon": lambda *corners: corners, "CircleArc": lambda *ends: ends,
    "Defined": lambda P: _z(P) == _z(P),
    "If": lambda holds, one, other: one if holds else other,
    "x": lambda P: P.real, "y": lambda P: P.imag, "abs": abs, "floor": math.floor, "Min": min, "Max": max,
    "sqrt": lambda a: math.sqrt(a) if a >= 0 else math.nan, "acos": math.acos, "cos": math.cos, "sin": math.sin,
    "Element": lambda values, place: values[int(place) - 1],
    "Angle": lambda P, Q, R: cmath.phase((R - Q) / (P - Q)) % (2 * math.pi), "Point": lambda arc: arc[1],
    "sgn": lambda a: math.copysign(1.0, a) if a else 0.0,
}


def opened(packed: bytes) -> Element:
    """The document in a .ggb file."""
    return fromstring(zipfile.ZipFile(io.BytesIO(packed)).read("geogebra.xml"))


def read(document: Element, moved: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """The value of every object, by label, with some free points, points of curves and sliders moved."""
    values: dict[str, Any] = {}
    for entry in document.find("construction") or ():
        label = entry.get("label", "")
        if entry.tag == "command":
            inputs = [_value(text, values) for text in entry.find("input").attrib.values()]  # type: ignore[union-attr]
            output = next(iter(entry.find("output").attrib.values()))  # type: ignore[union-attr]
            try:
                values[output] = (moved or {}).get(output, COMMANDS[entry.get("name", "")](*inputs))
            except ZeroDivisionError:  # such as the direction of a line through one point
                values[output] = Undefined(complex(math.nan, math.nan))
        elif entry.tag == "expression":
            assert label not in values, f"{label} is there already"
            values[label] = _value(entry.get("exp", ""), values)
        elif (number := entry.find("value")) is not None and label not in values:
            told = number.get("val", "")
            values[label] = (moved or {}).get(label, float(told) if told not in ("true", "false") else told == "true")
        elif entry.get("type") == "point" and label not in values:
            at = entry.find("coords")
            values[label] = (moved or {}).get(label, complex(float(at.get("x")), float(at.get("y"))))  # type: ignore[union-attr,arg-type]
    return values


def condition(document: Element, words: str, values: Mapping[str, Any]) -> bool:
    """Whether the text with these words is seen where objects have these values."""
    label = next(entry.get("label", "") for entry in document.iter("expression") if words in entry.get("exp", ""))
    told = next(element.find("condition") for element in document.iter("element") if element.get("label") == label)
    assert told is not None
    return bool(_value(told.get("showObject", ""), values))


class Spots(ast.NodeTransformer):
    """Two numbers in brackets are a point."""

    def visit_Tuple(self, node: ast.Tuple) -> ast.AST:
        self.generic_visit(node)
        return ast.Call(ast.Name("complex", ast.Load()), node.elts, [])


def _value(text: str, values: Mapping[str, Any]) -> Any:
    """What an expression gives: it is Python's but for brackets, powers and degrees."""
    if text.startswith('"'):
        return text
    if text.startswith("{"):
        return [_value(part, values) for part in text[1:-1].split(", ")]
    try:
        value = eval(_compiled(text), {"V": values, "complex": complex, **COMMANDS})
    except ZeroDivisionError:
        return Undefined(complex(math.nan, math.nan))
    return value % math.tau if text.endswith("°") else value  # an angle has no whole turns


@lru_cache(maxsize=8192)
def _compiled(text: str) -> CodeType:
    source = text.replace("[", "(").replace("]", ")").replace("^", "**").replace("°", f"*{math.pi / 180!r}")
    source = WORD.sub(lambda word: word[0] if source[word.end():word.end() + 1] == "(" else f"V[{word[0]!r}]", source)
    source = source.replace("¬", "not ").replace(" ∨ ", " or ").replace(" ∧ ", " and ")
    return compile(ast.fix_missing_locations(Spots().visit(ast.parse(source, mode="eval"))), "<ggb>", "eval")
