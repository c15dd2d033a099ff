"""A sheet as SVG: display lists in groups by layer and step, written by svgwrite.

For Inkscape these groups are layers, called as they are in the language of the sheet. Every number is rounded to a
hundredth of a millimetre and nothing depends on time or memory, so the same sheet is the same text.
"""

from __future__ import annotations

import math
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any
from xml.etree.ElementTree import tostring

import svgwrite
from svgwrite.text import TSpan

from graphplan.phrases import said
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import ANCHORS, DROP, FONTS, SIZE, Runs, script_size, width
from graphplan.sheet.plates.display import (
    ENLARGED,
    Arc,
    Arrow,
    Circle,
    Item,
    Outline,
    Photograph,
    Polygon,
    Polyline,
    Rect,
    Sheet,
    Spot,
    Text,
)
from graphplan.sheet.plates.pens import LETTERS, PAPER, Pen
from graphplan.sheet.plates.view import clip_item
from graphplan.words.tongue import Tongue, tongue

TITLE, LINE, MARGIN = 5.0, 4.2, 10.0  # mm: the letters of a title, from line to line, and around the sheet
LAYER = "chart"
CIRCLE, CROSSED = "circle", "crossed"


@dataclass(frozen=True)
class Canvas:
    """Items of a picture, from back to front."""

    items: list[Item] = field(default_factory=list)

    def line(self, spots: Iterable[Spot], pen: Pen, edge: Rect | None = None) -> None:
        """A line through spots, cut off at an edge."""
        line = Polyline(pen, LAYER, None, tuple(spots))
        self.items.extend([line] if edge is None else clip_item(line, edge))

    def mark(self, mark: str, spot: Spot, size: float, pen: Pen) -> None:
        """A mark of this size: a circle or a cross."""
        if mark == CIRCLE:
            self.items.append(Circle(pen, LAYER, None, spot, size / 2))
            return
        for up in (size / 2, -size / 2):
            self.line([(spot[0] - size / 2, spot[1] - up), (spot[0] + size / 2, spot[1] + up)], pen)

    def text(self, at: Spot, runs: Runs, size: float = SIZE, anchor: str = "start", pen: Pen = LETTERS) -> None:
        """Lettering on its base line."""
        self.items.append(Text(pen, LAYER, None, at, runs, size, anchor))

    def svg(self, width: float, height: float, title: str) -> str:
        """The sheet as SVG text."""
        whole, items = Rect(0.0, 0.0, width, height), tuple(self.items)
        return svg(Sheet(width, height, whole, {}, items, title, "", (), Scales(1.0, 1.0, "mm", {})))


RADIUS_DECIMALS = 4  # decimals of a radius: what is left of one moves the middle of a long arc much farther
MAKE = svgwrite.Drawing(debug=False)  # makes elements and leaves out their validation, which takes ten times as long
Element = Any  # of svgwrite, which has no types
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
SPACED = {"xml:space": "preserve"}  # Inkscape leaves out spaces between levels of letters
STEP, GIVEN = said("Step"), said("Given")
LAYERS = {  # what their groups are called
    "paper": said("Paper"), "border": said("Border"), "ruling": said("Ruling"), "corner marks": said("Corner marks"),
    "plates": said("Plates"), "motion": said("Motion"), "ground": said("Ground"), "links": said("Links"),
    "wheels": said("Wheels and profiles"), "blocks": said("Blocks"), "drive": said("Drive"), "pairs": said("Pairs"),
    "letters": said("Letters"), "blanks": said("Blanks"), "text": said("Text"), "results": said("Results"),
    "given": said("Given"), "found": said("Found"), "details": said("Details"), ENLARGED: said("Details"),
    "machine": said("Machine"), "arms": said("Lever arms"), "dimensions": said("Dimensions"),
}  # fmt: skip


def svg(sheet: Sheet, *, alone: bool = True, **look: Any) -> str:
    """The sheet as one SVG document, in millimetres; `look` are attributes of the whole.

    One that is not `alone`, but a part of a page, has no identifiers and no names of layers.
    """
    wide, high = round_mm(sheet.width), round_mm(sheet.height)
    document = _Document(
        size=(f"{wide}mm", f"{high}mm"), viewBox=f"0 0 {wide} {high}", font_family=FONTS, stroke_linecap="round",
        stroke_linejoin="round", debug=False,
        **({"xmlns:inkscape": INKSCAPE} | SPACED if alone else {}), **{"xml:lang": sheet.language}, **look)  # fmt: skip
    document.elements.remove(document.defs)  # a sheet defines nothing
    document.set_desc(sheet.title, sheet.description)
    if sheet.scene:
        document.add(_Metadata(sheet.scene, id="scene", factory=MAKE))
    document.add(MAKE.rect((0, 0), (wide, high), fill=PAPER))
    for key, group in groups(sheet, lambda step: max(0, step + 1 - sheet.givens)):
        document.add(group)
        if alone:
            _name_group(group, key, tongue(sheet.language))
    return f'<?xml version="1.0" encoding="utf-8"?>\n{tostring(document.get_xml(), encoding="unicode")}\n'


def _name_group(group: Element, key: str, say: Tongue) -> None:
    """Give the group of a layer or a step its name, and an identifier."""
    step = int(key) if key.isdecimal() else None
    name = say(LAYERS.get(key, key)) if step is None else f"{say(STEP)} {step}" if step else say(GIVEN)
    group.update({"inkscape:groupmode": "layer", "inkscape:label": name,
                  "id": f"layer-{key.replace(' ', '-')}" if step is None else f"step-{step}"})


def groups(sheet: Sheet, number: Callable[[int], int] = int) -> Iterator[tuple[str, Element]]:
    """The groups of a sheet from back to front, each by its layer or by the number of its step.

    Steps that `number` gives the same one, as those of the pose's own points have 0, are one group.
    """
    for key, items in split_groups(sheet, number):
        yield str(key), ink_group(sheet, key, items)


def split_groups(sheet: Sheet, number: Callable[[int], int] = int) -> Iterator[tuple[str | int, list[Item]]]:
    """The items of each group; those of details stand together, whatever their steps."""
    for key, items in groupby(sheet.items, lambda item: item.layer if item.step is None or item.layer == ENLARGED
                              else number(item.step)):
        yield key, list(items)


def ink_group(sheet: Sheet, key: str | int, items: Sequence[Item]) -> Element:
    """A group of these items."""
    writer, steps = _SheetWriter(sheet.height), dict.fromkeys(item.step for item in items if item.step is not None)
    element = group(key, " ".join(sheet.sentences[step] for step in steps))
    for item in items:
        drawn = element.add(writer.item(item))
        if item.layer == ENLARGED and item.step is not None:
            drawn["data-step"] = max(0, item.step + 1 - sheet.givens)
    return element


def group(key: str | int, sentence: str) -> Element:
    """An empty group: a layer, or a step by its number with its sentence."""
    if isinstance(key, str):
        return MAKE.g(class_=key if key in FACTS else f"layer-{key}")
    element = MAKE.g(class_="step", data_step=key)
    element.set_desc(sentence)
    return element


def round_mm(number: float, places: int = 2) -> float:
    """To 0.01 mm, or to more places, and never -0."""
    value = round(number, places) + 0.0
    return int(value) if value.is_integer() else value


class _Document(svgwrite.Drawing):  # type: ignore[misc]
    """A document of SVG 2, which states no version: in 1.1, of which the writer is, there are no data attributes."""

    def get_xml(self) -> Element:
        element = super().get_xml()
        for former in ("version", "baseProfile"):
            del element.attrib[former]
        return element


class _Metadata(TSpan):  # type: ignore[misc]
    """Text for programs."""

    elementname = "metadata"


@dataclass(frozen=True)
class _SheetWriter:
    """Writes items; y runs down in SVG and up on the sheet."""

    height: float

    def item(self, item: Item) -> Element:
        match item:
            case Polyline():
                return self._line(item.spots, item.pen)
            case Outline():
                return self._outline(item)
            case Polygon():
                return MAKE.polygon(self._spots(item.spots), **look(item.pen))
            case Circle():
                return MAKE.circle(self._spot(item.centre), round_mm(item.radius, RADIUS_DECIMALS), **look(item.pen))
            case Arc():
                return self._arc(item)
            case Arrow():
                return self._arrow(item)
            case Text():
                return self._text(item)
            case Photograph():
                return self._photograph(item)
        raise TypeError(f"no SVG for {type(item).__name__}")

    def _outline(self, item: Outline) -> Element:
        (left, bottom), (right, top) = self._spots((item.spots[0], item.spots[2]))
        named = {"class_": "panel", "data_plan": item.plan} if item.plan else {"class_": "frame"}
        return MAKE.rect((left, top), (round_mm(right - left), round_mm(bottom - top)), **named, **look(item.pen))

    def _line(self, spots: Iterable[Spot], pen: Pen) -> Element:
        return MAKE.polyline(self._spots(spots), **look(pen) | {"fill": "none"})

    def _arc(self, arc: Arc) -> Element:
        (x, y), (u, v), r = self._spot(arc.spot_at(arc.start)), self._spot(arc.spot_at(arc.end)), round_mm(arc.radius,
                                                                                                           RADIUS_DECIMALS)
        large = int(arc.end - arc.start > 180)
        if math.isclose(arc.end - arc.start, 180):  # SVG: what is too small for its chord has that for a diameter
            r = round_mm(math.dist((x, y), (u, v)) / 2 - 0.1**RADIUS_DECIMALS, RADIUS_DECIMALS)
        return MAKE.path(f"M {x} {y} A {r} {r} 0 {large} 0 {u} {v}", **look(arc.pen) | {"fill": "none"})

    def _photograph(self, item: Photograph) -> Element:
        size = round_mm(item.rect.width), round_mm(item.rect.height)
        data = f"data:image/jpeg;base64,{b64encode(item.jpeg).decode()}"
        return MAKE.image(data, self._spot((item.rect.left, item.rect.top)), size, preserveAspectRatio="none")

    def _arrow(self, arrow: Arrow) -> Element:
        """The shaft ends in the head, so that the tip is sharp; data-from and data-to keep the true ends."""
        (x, y), (u, v) = self._spots((arrow.start, arrow.end))
        element = MAKE.g(class_="vector", data_from=f"{x} {y}", data_to=f"{u} {v}", data_vector=arrow.label or None)
        for shaft in arrow.shaft:
            element.add(self._line(shaft, arrow.pen))
        for spots, fill in arrow.figures:
            element.add(MAKE.polygon(self._spots(spots), fill=fill))
        return element

    def _text(self, text: Text) -> Element:
        """Levels by shifting tspans; the anchor is worked out here, as renderers disagree about it over tspans."""
        whole = len(text.runs) == 1
        x, y = text.at
        x, y = self._spot((x if whole else x - ANCHORS[text.anchor] * width(text.runs, text.size, text.bold), y))
        plain = whole and text.runs[0].level == 0
        element = MAKE.text(text.runs[0].text if plain else "", font_size=round_mm(text.size), fill=text.pen.colour,
                            font_weight="bold" if text.bold else None,
                            text_anchor=text.anchor if whole and text.anchor != "start" else None)  # fmt: skip
        element.update({"x": x, "y": y})  # what is told when it is made is taken apart first, which takes long
        level = 0
        for run in () if plain else text.runs:
            dy = round_mm((level - run.level) * DROP * text.size)
            size, level = round_mm(script_size(text.size)) if run.level else None, run.level
            element.add(MAKE.tspan(run.text, font_size=size)).update({"dy": dy or None})
        return element

    def _spot(self, spot: Spot) -> Spot:
        return round_mm(spot[0]), round_mm(self.height - spot[1])

    def _spots(self, spots: Iterable[Spot]) -> list[Spot]:
        return [self._spot(spot) for spot in spots]


def look(pen: Pen) -> dict[str, Any]:
    """The attributes of what a pen draws."""
    look: dict[str, Any] = {"fill": pen.fill}
    if pen.width:
        look |= {"stroke": pen.colour, "stroke_width": round_mm(pen.width)}
    if pen.dash:
        look["stroke_dasharray"] = " ".join(f"{round_mm(stretch):g}" for stretch in pen.dash)
    return look
