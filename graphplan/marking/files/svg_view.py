"""Lengths, views, transforms and looks of the elements of an SVG drawing: where each falls on paper, in mm."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

from svgelements import Matrix, Viewbox

from graphplan.marking.traces import Spot

MM_PER_UNIT = {"mm": 1.0, "cm": 10.0, "in": 25.4, "px": 25.4 / 96, "pt": 25.4 / 72, "pc": 25.4 / 6, "q": 0.25}
PHYSICAL_UNITS = re.compile("mm|cm|in|pt|pc|q", re.IGNORECASE)  # not so px
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBERS = re.compile(NUMBER)
LENGTH = re.compile(rf"\s*({NUMBER})\s*([a-zA-Z%]*)\s*")
STYLE_RULE = re.compile(r"\.([\w-]+)\s*\{([^{}]*)\}")  # of a style sheet, by class alone
INHERITED_KEYS = ("stroke", "font-size", "text-anchor", "visibility", "marker-start", "marker-end")
LOOK_KEYS = {*INHERITED_KEYS, "display", "baseline-shift"}
Look = Mapping[str, str]


class Viewport(NamedTuple):
    """The view that an element stands in by its size in user units, of which lengths may be parts."""

    wide: float
    high: float

    def __call__(self, element: Element, key: str, otherwise: float = 0.0) -> float:
        """A length of an element, along x or y by its attribute's name."""
        return length(element.get(key), self.side_length(key), otherwise)

    def side_length(self, key: str) -> float:
        """Length of 100% for an attribute."""
        if key == "r":
            return math.hypot(self.wide, self.high) / math.sqrt(2)
        return self.high if "y" in key or key == "height" else self.wide


def length(written: str | None, whole: float = 0.0, otherwise: float = 0.0) -> float:
    """A length in user units, a part of the whole where it is a percentage.

    Fails with `ValueError` where it is none.
    """
    if written is None or written.strip() == "auto":
        return otherwise
    number_and_unit = LENGTH.fullmatch(written)
    if number_and_unit is None:
        raise ValueError(f"{written[:40]!r} is not a length")
    sizes = {"": 1.0, "%": whole / 100, "em": 16.0, "rem": 16.0, "ex": 8.0}
    sizes |= {name: mm / MM_PER_UNIT["px"] for name, mm in MM_PER_UNIT.items()}
    if (unit := number_and_unit[2].lower()) not in sizes:
        raise ValueError(f"{unit!r} is not a unit of length")
    return float(number_and_unit[1]) * sizes[unit]


def paper(root: Element) -> tuple[Matrix, Viewport, tuple[float, float]]:
    """Map from the user units of the outermost element to mm of paper, y up from its lower edge; its view; its size in
    mm, that of its view if not stated."""
    box = view_box(root)
    sides = box[2:] if box else (0.0, 0.0)
    stated = (None if "%" in (root.get(key) or "") else root.get(key) for key in ("width", "height"))
    wide, high = (length(written, otherwise=side) for written, side in zip(stated, sides, strict=True))
    px = MM_PER_UNIT["px"]
    onto = fit_view_box(root, wide, high) * Matrix(px, 0, 0, -px, 0, px * high)
    return onto, Viewport(*(sides if box else (wide, high))), (wide * px, high * px)


def view_box(element: Element) -> tuple[float, ...] | None:
    """The view box of an element; None if it is missing or empty."""
    numbers = tuple(float(number) for number in NUMBERS.findall(element.get("viewBox", "")))
    return numbers if len(numbers) == 4 and min(numbers[2:]) > 0 else None


def fit_view_box(element: Element, wide: float, high: float) -> Matrix:
    """The view box of an element set into a window of this size; a side of 0 is the view box's own."""
    box = view_box(element)
    return Matrix(Viewbox.viewbox_transform(0, 0, wide or box[2], high or box[3], *box, element.get(
        "preserveAspectRatio"))) if box else Matrix()


def transform(written: str | None) -> Matrix:
    """A transform attribute.

    Fails with `ValueError` where it is none.
    """
    try:
        matrix = Matrix(written or "")
        return Matrix(*(float(getattr(matrix, coefficient)) for coefficient in "abcdef"))
    except (ValueError, TypeError, IndexError):
        raise ValueError(f"{str(written)[:40]!r} is not a transform") from None


def spot(onto: Matrix, z: Any) -> Spot:
    """Place of a point on paper."""
    x, y = float(z.real), float(z.imag)
    return onto.a * x + onto.c * y + onto.e, onto.b * x + onto.d * y + onto.f


class Looks:
    """Styles of the elements of one document: by their attributes, over them the style sheet's classes, over them their
    style."""

    def __init__(self, root: Element):
        self.rules = {name: _style_entries(declared) for sheet in root.iter("style")
                      for name, declared in STYLE_RULE.findall(sheet.text or "")}

    def look_of(self, element: Element) -> dict[str, str]:
        """Style of an element itself."""
        look = dict(element.attrib)
        for name in element.get("class", "").split():
            look |= self.rules.get(name, {})
        return look | _style_entries(element.get("style", ""))


def inherit_look(look: Look, above: Look) -> Look:
    """Style that an element's children inherit."""
    return {**above, **{key: value for key in INHERITED_KEYS if (value := look.get(key, "inherit")) != "inherit"}}


def _style_entries(style: str) -> dict[str, str]:
    entries = (entry.partition(":") for entry in style.split(";"))
    return {name.strip(): value.strip() for name, _, value in entries if name.strip() in LOOK_KEYS}
