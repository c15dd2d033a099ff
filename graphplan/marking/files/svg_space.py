"""Where and how the elements of an SVG file are drawn on paper: lengths, view boxes, transforms, paths and styles.

svgelements reads transforms and paths, as matrices and segments; it takes much for granted, so what it would pass over
in silence is refused here.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element

from svgelements import Close, Line, Matrix, Move, Path, Viewbox

from graphplan.marking.traces import Spot

MM = {"mm": 1.0, "cm": 10.0, "in": 25.4, "px": 25.4 / 96, "pt": 25.4 / 72, "pc": 25.4 / 6, "q": 0.25}
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
NUMBERS = re.compile(NUMBER)
LENGTH = re.compile(rf"\s*({NUMBER})\s*([a-zA-Z%]*)\s*")
PATH = re.compile(r"\s*(?:[Mm][-+\d.,eE\s]*[\d.](?:[MmZzLlHhVvCcSsQqTtAa]|[-+\d.,eE\s])*)?")
PARTS = 8  # a curve by so many stretches
RULE = re.compile(r"\.([\w-]+)\s*\{([^{}]*)\}")  # of a style sheet, by class alone
INHERITED = ("stroke", "font-size", "text-anchor", "visibility")
LOOKS = {*INHERITED, "display", "baseline-shift"}
Look = Mapping[str, str]


class Viewport(NamedTuple):
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


def length(written: str | None, whole: float = 0.0, otherwise: float = 0.0) -> float:
    """A length in user units, a part of the whole where it is a percentage.

    Fails with `ValueError` where it is none.
    """
    if written is None or written.strip() == "auto":
        return otherwise
    found = LENGTH.fullmatch(written)
    if found is None:
        raise ValueError(f"{written[:40]!r} is no length")
    sizes = {"": 1.0, "%": whole / 100, "em": 16.0, "rem": 16.0, "ex": 8.0} | {u: mm / MM["px"] for u, mm in MM.items()}
    if (unit := found[2].lower()) not in sizes:
        raise ValueError(f"{unit!r} is no unit of length")
    return float(found[1]) * sizes[unit]


def paper(root: Element) -> tuple[Matrix, Viewport, tuple[float, float]]:
    """From the user units of the outermost element to mm of paper, y up from its lower edge; its view; its size in mm,
    that of its view where it states none."""
    box = view_box(root)
    sides = box[2:] if box else (0.0, 0.0)
    stated = (None if "%" in (root.get(key) or "") else root.get(key) for key in ("width", "height"))
    wide, high = (length(written, otherwise=side) for written, side in zip(stated, sides, strict=True))
    px = MM["px"]
    onto = fitted(root, wide, high) * Matrix(px, 0, 0, -px, 0, px * high)
    return onto, Viewport(*(sides if box else (wide, high))), (wide * px, high * px)


def view_box(element: Element) -> tuple[float, ...] | None:
    """The view box of an element; None where it has none, or an empty one."""
    numbers = tuple(float(number) for number in NUMBERS.findall(element.get("viewBox", "")))
    return numbers if len(numbers) == 4 and min(numbers[2:]) > 0 else None


def fitted(element: Element, wide: float, high: float) -> Matrix:
    """The view box of an element set into a window of this size, or of its own where a side is nothing."""
    box = view_box(element)
    return Matrix(Viewbox.viewbox_transform(0, 0, wide or box[2], high or box[3], *box, element.get(
        "preserveAspectRatio"))) if box else Matrix()


def transform(written: str | None) -> Matrix:
    """A transform attribute.

    Fails with `ValueError` where it is none.
    """
    try:
        found = Matrix(written or "")
        return Matrix(*(float(getattr(found, part)) for part in "abcdef"))
    except (ValueError, TypeError, IndexError):
        raise ValueError(f"{str(written)[:40]!r} is no transform") from None


def spot(onto: Matrix, z: Any) -> Spot:
    """Where a point falls on paper."""
    x, y = float(z.real), float(z.imag)
    return onto.a * x + onto.c * y + onto.e, onto.b * x + onto.d * y + onto.f


def path(data: str) -> Path:
    """Path data as segments.

    Fails with `ValueError` where they are none.
    """
    try:
        if PATH.fullmatch(data):
            return Path(data)
    except (ValueError, TypeError, AttributeError, ArithmeticError):
        pass
    raise ValueError(f"{data.strip()[:20]!r} is no path")


def chains(drawn: Path, onto: Matrix) -> Iterator[tuple[bool, list[Spot]]]:
    """The chains of a path on paper, and whether curves join their spots: a new one wherever the pen is lifted, or goes
    over from straight pieces to curves."""
    segments = (part for part in drawn if not isinstance(part, Close) or part.start != part.end)
    for curved, group in groupby(segments, key=_curved):
        parts = list(group)
        if curved is not None:
            ends = [part.point(i / PARTS) if i < PARTS else part.end
                    for part in parts for i in range(1 if curved else PARTS, PARTS + 1)]
            yield curved, [spot(onto, end) for end in (parts[0].start, *ends)]


def _curved(segment: Any) -> bool | None:
    return None if isinstance(segment, Move) else not isinstance(segment, Line | Close)


class Looks:
    """How the elements of one document look: by their attributes, over them the style sheet's classes, over them their
    style."""

    def __init__(self, root: Element):
        self.rules = {name: _declared(declared) for sheet in root.iter("style")
                      for name, declared in RULE.findall(sheet.text or "")}

    def of(self, element: Element) -> dict[str, str]:
        """What is said of an element itself."""
        look = dict(element.attrib)
        for name in element.get("class", "").split():
            look |= self.rules.get(name, {})
        return look | _declared(element.get("style", ""))


def inherited(look: Look, above: Look) -> Look:
    """What an element hands on to those in it."""
    return {**above, **{key: value for key in INHERITED if (value := look.get(key, "inherit")) != "inherit"}}


def _declared(style: str) -> dict[str, str]:
    parts = [part.partition(":") for part in style.split(";")]
    named = ((name.strip(), value.strip()) for name, _, value in parts)
    return {name: value for name, value in named if name in LOOKS}
