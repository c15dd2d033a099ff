"""The objects of a GeoGebra file in their order, with their values: stated in the file, or reckoned from earlier ones.
"""

from __future__ import annotations

import math
from typing import Any
from xml.etree.ElementTree import Element

from graphplan.marking.files.curves import NEAR
from graphplan.marking.files.geogebra_terms import Ray, Round, Vector, called, reckoned
from graphplan.marking.files.safe import number

LINES = {"line", "segment", "ray", "vector"}
CIRCLES = {"conic", "conicpart"}
UNDEFINED = ("NaN", "?", "Infinity", "-Infinity")  # coordinates of what cannot be drawn
LETTERS = 300_000  # of terms that are reckoned; what is beyond has no value


class Objects:
    """The objects of a construction by label: elements, the commands that make them, and values of those that have one.
    """

    def __init__(self, construction: Element):
        self.elements: dict[str, Element] = {}
        self.commands: dict[str, tuple[str, list[str], int]] = {}
        self.values: dict[str, Any] = {}
        self.left = LETTERS
        self._terms: dict[str, str] = {}
        for child in construction:
            if child.tag == "expression":
                self._terms[child.get("label", "")] = child.get("exp", "")
            elif child.tag == "command":
                self._command(child)
            elif child.tag == "element":
                self._element(child)

    def _command(self, command: Element) -> None:
        """Which command makes an object, of what, and which of its results it is."""
        inputs = _arguments(command.find("input"))
        for place, label in enumerate(_arguments(command.find("output"))):
            self.commands[label] = command.get("name", ""), inputs, place

    def _element(self, element: Element) -> None:
        label = element.get("label", "")
        value = stated(element)
        if value is None and label in self._terms:
            value = self.term(self._terms[label])
        if value is None and label in self.commands:
            name, inputs, place = self.commands[label]
            value = self._made(name, inputs) if place == 0 else None
        self.elements[label] = element
        if value is not None:
            self.values[label] = value

    def _made(self, name: str, inputs: list[str]) -> Any:
        try:
            return called(name, [self.term(term) for term in inputs])
        except ValueError:
            return None

    def term(self, term: str) -> Any:
        """The value of a label or a term; None where it has none."""
        if term in self.values:
            return self.values[term]
        self.left -= len(term)
        if self.left < 0:
            return None
        try:
            return reckoned(term, self.values)
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
    normal = complex(x, y)
    return Ray(-z * normal / abs(normal) ** 2, 1j * normal) if normal and kind in LINES else None


def finite(written: str) -> float:
    """A coordinate; what cannot be drawn has none."""
    return math.nan if written in UNDEFINED else number(written)


def _conic(matrix: Element | None) -> Round | None:
    """A circle by the coefficients of x², y², 1, xy, x and y, the last three halved; None where it is none."""
    if matrix is None:
        return None
    xx, yy, one, xy, x, y = (finite(matrix.get(f"A{i}", "0")) for i in range(6))
    if not math.isfinite(xx + yy + one + xy + x + y) or not xx or abs(xx - yy) + abs(xy) > NEAR * abs(xx):
        return None
    centre = complex(-x / xx, -y / xx)
    square = abs(centre) ** 2 - one / xx
    return Round(centre, math.sqrt(square)) if square > 0 else None
