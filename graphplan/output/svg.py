"""The display list as SVG 2: one group a layer, one a drawing step with its sentence as title.

For Inkscape these groups are layers, called as they are in the language of the sheet. Every number is rounded to a
hundredth of a millimetre and nothing depends on time or memory, so the same sheet is the same text.
"""

from __future__ import annotations

import math
from base64 import b64encode
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any
from xml.etree.ElementTree import Element, tostring

from graphplan.phrases import said
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.lettering.lettering import ANCHORS, DROP, FONTS, script_size, width
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
    Sheet,
    Spot,
    Text,
)
from graphplan.sheet.plates.pens import PAPER, Pen
from graphplan.words.tongue import Tongue, tongue

RADIUS_DECIMALS = 4  # decimals of a radius: what is left of one moves the middle of a long arc much farther
INKSCAPE = "http://www.inkscape.org/namespaces/inkscape"
NAMESPACES = {"xmlns": "http://www.w3.org/2000/svg", "xmlns:xlink": "http://www.w3.org/1999/xlink",
              "xmlns:ev": "http://www.w3.org/2001/xml-events"}
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
    document = make("svg", **NAMESPACES, width=f"{wide}mm", height=f"{high}mm", viewBox=f"0 0 {wide} {high}",
                    font_family=FONTS, stroke_linecap="round", stroke_linejoin="round",
                    **({"xmlns:inkscape": INKSCAPE} | SPACED if alone else {}), **{"xml:lang": sheet.language}, **look)
    document.extend([make("title", sheet.title), make("desc", sheet.description)])
    if sheet.scene:
        document.append(make("metadata", sheet.scene, id="scene"))
    document.append(_rectangle((0, 0), (wide, high), fill=PAPER))
    for key, group in groups(sheet):
        document.append(group)
        if alone:
            _name_group(group, key, tongue(sheet.language))
    return f'<?xml version="1.0" encoding="utf-8"?>\n{tostring(document, encoding="unicode")}\n'


def _name_group(group: Element, key: str, say: Tongue) -> None:
    """Give the group of a layer or a step its name, and an identifier."""
    step = int(key) if key.isdecimal() else None
    name = say(LAYERS.get(key, key)) if step is None else f"{say(STEP)} {step}" if step else say(GIVEN)
    group.attrib |= {"id": f"layer-{key.replace(' ', '-')}" if step is None else f"step-{step}",
                     "inkscape:groupmode": "layer", "inkscape:label": name}


def groups(sheet: Sheet) -> Iterator[tuple[str, Element]]:
    """The groups of a sheet from back to front, each by its layer or by the number of its step.

    The pose's own points, whose number is 0, are one group.
    """
    for key, items in split_groups(sheet, lambda step: _step_number(sheet, step)):
        yield str(key), ink_group(sheet, key, items)


def _step_number(sheet: Sheet, step: int) -> int:
    return max(0, step + 1 - sheet.givens)


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
        drawn = writer.item(item)
        if item.layer == ENLARGED and item.step is not None:
            drawn.set("data-step", str(_step_number(sheet, item.step)))
            drawn.attrib = dict(sorted(drawn.attrib.items()))
        element.append(drawn)
    return element


def group(key: str | int, sentence: str) -> Element:
    """A group with nothing in it yet: a layer, or a step by its number with its sentence."""
    if isinstance(key, str):
        return make("g", class_=key if key in FACTS else f"layer-{key}")
    element = make("g", class_="step", data_step=key)
    element.append(make("title", sentence))
    return element


def make(tag: str, text: str = "", **attributes: Any) -> Element:
    """An element with these attributes in the order of their names, without those that are None or empty.

    `_` in their names stands for `-`; at the end it is none, as in `class_`.
    """
    values = {name.rstrip("_").replace("_", "-"): value for name, value in attributes.items()
              if value is not None and value != ""}
    element = Element(tag, {name: str(values[name]) for name in sorted(values)})
    element.text = text
    return element


def _rectangle(corner: Spot, size: Spot, **attributes: Any) -> Element:
    """A rectangle by its upper left corner."""
    return make("rect", x=corner[0], y=corner[1], width=size[0], height=size[1], **attributes)


def round_mm(number: float, places: int = 2) -> float:
    """To 0.01 mm, or to more places, and never -0."""
    value = round(number, places) + 0.0
    return int(value) if value == int(value) else value


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
                return self._polygon(item.spots, **look(item.pen))
            case Circle():
                (x, y), r = self._spot(item.centre), round_mm(item.radius, RADIUS_DECIMALS)
                return make("circle", cx=x, cy=y, r=r, **look(item.pen))
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
        return _rectangle((left, top), (round_mm(right - left), round_mm(bottom - top)), **named, **look(item.pen))

    def _line(self, spots: Iterable[Spot], pen: Pen) -> Element:
        return make("polyline", points=self._points(spots), **look(pen) | {"fill": "none"})

    def _polygon(self, spots: Iterable[Spot], **attributes: Any) -> Element:
        return make("polygon", points=self._points(spots), **attributes)

    def _arc(self, arc: Arc) -> Element:
        (x, y), (u, v), r = self._spot(arc.spot_at(arc.start)), self._spot(arc.spot_at(arc.end)), round_mm(arc.radius,
                                                                                                           RADIUS_DECIMALS)
        large = int(arc.end - arc.start > 180)
        if math.isclose(arc.end - arc.start, 180):  # SVG: what is too small for its chord has that for a diameter
            r = round_mm(math.dist((x, y), (u, v)) / 2 - 0.1**RADIUS_DECIMALS, RADIUS_DECIMALS)
        return make("path", d=f"M {x} {y} A {r} {r} 0 {large} 0 {u} {v}", **look(arc.pen) | {"fill": "none"})

    def _photograph(self, item: Photograph) -> Element:
        x, y = self._spot((item.rect.left, item.rect.top))
        return make("image", x=x, y=y, width=round_mm(item.rect.width), height=round_mm(item.rect.height),
                    preserveAspectRatio="none",
                    **{"xlink:href": f"data:image/jpeg;base64,{b64encode(item.jpeg).decode()}"})

    def _arrow(self, arrow: Arrow) -> Element:
        """The shaft ends in the head, so that the tip is sharp; data-from and data-to keep the true ends."""
        (x, y), (u, v) = self._spots((arrow.start, arrow.end))
        element = make("g", class_="vector", data_from=f"{x} {y}", data_to=f"{u} {v}", data_vector=arrow.label)
        element.extend([self._line(shaft, arrow.pen) for shaft in arrow.shaft])
        element.extend([self._polygon(spots, fill=fill) for spots, fill in arrow.figures])
        return element

    def _text(self, text: Text) -> Element:
        """Levels by shifting tspans; the anchor is worked out here, as renderers disagree about it over tspans."""
        whole = len(text.runs) == 1
        x, y = text.at
        x, y = self._spot((x if whole else x - ANCHORS[text.anchor] * width(text.runs, text.size, text.bold), y))
        plain = whole and text.runs[0].level == 0
        element = make("text", text.runs[0].text if plain else "", x=x, y=y, font_size=round_mm(text.size),
                       fill=text.pen.colour, font_weight="bold" if text.bold else None,
                       text_anchor=text.anchor if whole and text.anchor != "start" else None)
        level = 0
        for run in () if plain else text.runs:
            dy = round_mm((level - run.level) * DROP * text.size)
            size, level = round_mm(script_size(text.size)) if run.level else None, run.level
            element.append(make("tspan", run.text, font_size=size, dy=dy or None))
        return element

    def _spot(self, spot: Spot) -> Spot:
        return round_mm(spot[0]), round_mm(self.height - spot[1])

    def _spots(self, spots: Iterable[Spot]) -> list[Spot]:
        return [self._spot(spot) for spot in spots]

    def _points(self, spots: Iterable[Spot]) -> str:
        return " ".join(f"{x},{y}" for x, y in self._spots(spots))


def look(pen: Pen) -> dict[str, Any]:
    """The attributes of what a pen draws."""
    look: dict[str, Any] = {"fill": pen.fill}
    if pen.width:
        look |= {"stroke": pen.colour, "stroke_width": round_mm(pen.width)}
    if pen.dash:
        look["stroke_dasharray"] = " ".join(f"{round_mm(stretch):g}" for stretch in pen.dash)
    return look
