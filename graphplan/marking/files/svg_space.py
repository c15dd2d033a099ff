"""Where the elements of an SVG file lie on paper: lengths, transforms and view boxes."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import NamedTuple
from xml.etree.ElementTree import Element

from graphplan.marking.traces import Spot

MM = {"mm": 1.0, "cm": 10.0, "in": 25.4, "px": 25.4 / 96, "pt": 25.4 / 72, "pc": 25.4 / 6, "q": 0.25}
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBERS = re.compile(NUMBER)
LENGTH = re.compile(rf"\s*({NUMBER})\s*([a-zA-Z%]*)\s*")
CALL = re.compile(r"(matrix|translate|scale|rotate|skewX|skewY)\s*\(([^()]*)\)")


class Affine(NamedTuple):
    """z becomes `along` z + `across` z* + `at`, with points as complex numbers: any affine map."""

    along: complex
    across: complex = 0j
    at: complex = 0j

    def __call__(self, spot: complex) -> Spot:
        """Where a point falls."""
        found = self.along * spot + self.across * spot.conjugate() + self.at
        return found.real, found.imag

    def after(self, first: Affine) -> Affine:
        """This map after another."""
        return Affine(
            self.along * first.along + self.across * first.across.conjugate(),
            self.along * first.across + self.across * first.along.conjugate(),
            self.along * first.at + self.across * first.at.conjugate() + self.at,
        )

    @property
    def even(self) -> bool:
        """Whether circles stay circles: one of the two parts is nothing beside the other."""
        small, large = sorted((abs(self.along), abs(self.across)))
        return small <= 1e-9 * large

    @property
    def size(self) -> float:
        """How many times as large things become, on the average of all directions where these differ."""
        return math.sqrt(abs(abs(self.along) ** 2 - abs(self.across) ** 2))


def matrix(a: float, b: float, c: float, d: float, e: float, f: float) -> Affine:
    """The map that SVG writes so: x becomes a x + c y + e, y becomes b x + d y + f."""
    along, across = complex(a + d, b - c) / 2, complex(a - d, b + c) / 2
    return Affine(along, across, complex(e, f))


def transform(written: str) -> Affine:
    """A transform attribute.

    Fails with `ValueError` where it is none.
    """
    found = Affine(1.0)
    for name, arguments in CALL.findall(written):
        found = found.after(_call(name, [float(number) for number in NUMBERS.findall(arguments)]))
    return found


def _call(name: str, given: list[float]) -> Affine:
    match name, given:
        case "matrix", [a, b, c, d, e, f]:
            return matrix(a, b, c, d, e, f)
        case "translate", [x, *y]:
            return Affine(1.0, 0j, complex(x, *y[:1]))
        case "scale", [x, *rest]:
            return matrix(x, 0, 0, rest[0] if rest else x, 0, 0)
        case "rotate", [angle, *about]:
            turn = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
            centre = complex(*about[:2])
            return Affine(turn, 0j, centre - turn * centre)
        case "skewX", [angle]:
            return matrix(1, 0, math.tan(math.radians(angle)), 1, 0, 0)
        case "skewY", [angle]:
            return matrix(1, math.tan(math.radians(angle)), 0, 1, 0, 0)
    raise ValueError(f"{name}({len(given)} numbers) is no transform")


def length(written: str | None, whole: float = 0.0, otherwise: float = 0.0) -> float:
    """A length in user units, a part of the whole where it is a percentage.

    Fails with `ValueError` where it is none.
    """
    if written is None or written.strip() == "auto":
        return otherwise
    found = LENGTH.fullmatch(written)
    if found is None:
        raise ValueError(f"{written[:40]!r} is no length")
    value, unit = float(found[1]), found[2].lower()
    if unit in ("", "px"):
        return value
    if unit == "%":
        return value / 100 * whole
    if unit in ("em", "rem", "ex"):
        return value * (8.0 if unit == "ex" else 16.0)
    if unit not in MM:
        raise ValueError(f"{unit!r} is no unit of length")
    return value * MM[unit] / MM["px"]


class Window(NamedTuple):
    """The view that an element stands in by its size in user units, of which lengths may be parts."""

    wide: float
    high: float

    def __call__(self, element: Element, key: str, otherwise: float = 0.0) -> float:
        """A length of an element, along x or y by its attribute's name."""
        return length(element.get(key), self.part(key), otherwise)

    def part(self, key: str) -> float:
        """What 100% of an attribute is."""
        if key == "r":
            return math.hypot(self.wide, self.high) / math.sqrt(2)
        return self.high if "y" in key or key == "height" else self.wide


def window(root: Mapping[str, str]) -> Window:
    """The view of the outermost element."""
    box = view_box(root)
    return Window(*box[2:]) if box else Window(*(length(_absolute(root.get(key))) for key in ("width", "height")))


def paper_size(root: Mapping[str, str]) -> tuple[float, float]:
    """Width and height of the outermost element in user units; those of its view where it states none."""
    view = window(root)
    return (length(_absolute(root.get("width")), otherwise=view.wide),
            length(_absolute(root.get("height")), otherwise=view.high))


def paper(root: Mapping[str, str]) -> Affine:
    """From the user units of the outermost element to mm of paper, y up from its lower edge."""
    box = view_box(root)
    wide, high = paper_size(root)
    mm = MM["px"]
    onto = matrix(mm, 0, 0, -mm, 0, mm * high)
    return onto.after(fitted(box, wide, high, root.get("preserveAspectRatio", ""))) if box else onto


def _absolute(written: str | None) -> str | None:
    return None if written is None or "%" in written else written


def view_box(element: Mapping[str, str]) -> tuple[float, float, float, float] | None:
    """The view box of an element; None where it has none, or an empty one."""
    numbers = [float(number) for number in NUMBERS.findall(element.get("viewBox", ""))]
    if len(numbers) != 4 or numbers[2] <= 0 or numbers[3] <= 0:
        return None
    return numbers[0], numbers[1], numbers[2], numbers[3]


def fitted(box: tuple[float, float, float, float], wide: float, high: float, aspect: str) -> Affine:
    """A view box set into a window: as large as it goes and in the middle, unless it is said otherwise."""
    x, y, w, h = box
    across, up = (wide or w) / w, (high or h) / h
    if aspect.strip().startswith("none"):
        return matrix(across, 0, 0, up, -across * x, -up * y)
    size = max(across, up) if "slice" in aspect else min(across, up)
    places = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}
    named = re.search(r"x(Min|Mid|Max)Y(Min|Mid|Max)", aspect)
    at, to = (places[named[1]], places[named[2]]) if named else (0.5, 0.5)
    return matrix(size, 0, 0, size, at * ((wide or w) - size * w) - size * x, to * ((high or h) - size * h) - size * y)
