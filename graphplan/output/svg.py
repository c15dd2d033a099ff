"""The display list as SVG text: one group a layer, one group a drawing step with its sentence as title.

Every number is rounded to a hundredth of a millimetre and nothing depends on time or memory, so the same sheet is the
same text. Attributes stand in alphabetical order.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import groupby
from xml.etree.ElementTree import Element, SubElement, tostring

from graphplan.sheet.lettering.lettering import DROP, FONTS, SUBSCRIPT, width
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.sheet.plates.pens import Pen

DOCUMENT: dict[str, object] = {
    "baseProfile": "full", "version": "1.1",
    "font-family": FONTS, "stroke-linecap": "round", "stroke-linejoin": "round",
    "xmlns": "http://www.w3.org/2000/svg", "xmlns:ev": "http://www.w3.org/2001/xml-events",
    "xmlns:xlink": "http://www.w3.org/1999/xlink",
}  # fmt: skip

FINE = 4  # decimals of a radius: what is left of one moves the middle of a half circle much farther
Look = dict[str, object]  # attributes of an element


def svg(sheet: Sheet) -> str:
    """The sheet as one SVG document, in millimetres."""
    return _Writer(sheet).text()


class _Writer:
    """Writes one sheet; y runs down in SVG and up on the sheet."""

    def __init__(self, sheet: Sheet):
        self.sheet = sheet
        wide, high = _round(sheet.width), _round(sheet.height)
        size = {"width": f"{wide}mm", "height": f"{high}mm", "viewBox": f"0 0 {wide} {high}",
                "xml:lang": sheet.language}
        self.root = _element("svg", DOCUMENT | size)
        _titled(self.root, sheet.title)
        SubElement(self.root, "desc").text = sheet.description
        if sheet.scene:
            SubElement(self.root, "metadata", {"id": "scene"}).text = sheet.scene
        self.root.append(_element("rect", {"x": 0, "y": 0, "width": wide, "height": high, "fill": "#ffffff"}))

    def text(self) -> str:
        for key, items in groupby(self.sheet.items, lambda item: item.layer if item.step is None else item.step):
            self.root.append(self._group(key, items))
        return '<?xml version="1.0" encoding="utf-8"?>\n' + tostring(self.root, encoding="unicode") + "\n"

    def _group(self, key: str | int, items: Iterable[Item]) -> Element:
        if isinstance(key, int):
            group = _element("g", {"class": "step", "data-step": key})
            _titled(group, self.sheet.sentences[key])
        else:
            group = _element("g", {"class": f"layer-{key}"})
        group.extend(map(self._item, items))
        return group

    def _item(self, item: Item) -> Element:
        match item:
            case Polyline():
                return self._line(item.spots, item.pen)
            case Polygon():
                return _element("polygon", {"points": self._spots(item.spots)} | _look(item.pen))
            case Circle():
                x, y = self._spot(item.centre)
                return _element("circle", {"cx": x, "cy": y, "r": _round(item.radius, FINE)} | _look(item.pen))
            case Arc():
                return self._arc(item)
            case Arrow():
                return self._arrow(item)
            case Text():
                return self._text(item)
        raise TypeError(f"no SVG for {type(item).__name__}")

    def _line(self, spots: Iterable[Spot], pen: Pen) -> Element:
        return _element("polyline", _look(pen) | {"points": self._spots(spots), "fill": "none"})

    def _arc(self, arc: Arc) -> Element:
        (x, y), (u, v), r = self._spot(arc.at(arc.start)), self._spot(arc.at(arc.end)), _round(arc.radius, FINE)
        large = int(arc.end - arc.start > 180)
        return _element("path", _look(arc.pen) | {"d": f"M {x} {y} A {r} {r} 0 {large} 0 {u} {v}", "fill": "none"})

    def _arrow(self, arrow: Arrow) -> Element:
        """The shaft ends in the head, so that the tip is sharp; data-from and data-to keep the true ends."""
        tip, left, right = arrow.barbs
        neck = (left[0] + right[0]) / 2, (left[1] + right[1]) / 2
        ends = {"data-from": self._spot(arrow.start), "data-to": self._spot(arrow.end)}
        look: Look = {"class": "vector", **{name: f"{x} {y}" for name, (x, y) in ends.items()}}
        group = _element("g", look | ({"data-vector": arrow.label} if arrow.label else {}))
        if math.dist(arrow.start, neck) > 0.01:
            group.append(self._line((arrow.start, neck), arrow.pen))
        group.append(_element("polygon", {"points": self._spots((tip, left, right)), "fill": arrow.pen.colour}))
        return group

    def _text(self, text: Text) -> Element:
        """Levels by shifting tspans; the anchor is worked out here, as renderers disagree about it over tspans."""
        shift = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor] * width(text.runs, text.size, text.bold)
        anchored = len(text.runs) == 1
        x, y = self._spot(text.at if anchored else (text.at[0] - shift, text.at[1]))
        look: Look = {"x": x, "y": y, "font-size": _round(text.size), "fill": text.pen.colour}
        if text.bold:
            look["font-weight"] = "bold"
        if anchored and text.anchor != "start":
            look["text-anchor"] = text.anchor
        out = _element("text", look)
        if anchored and text.runs[0].level == 0:
            out.text = text.runs[0].text
        else:
            out.extend(_spans(text))
        return out

    def _spot(self, spot: Spot) -> tuple[float, float]:
        return _round(spot[0]), _round(self.sheet.height - spot[1])

    def _spots(self, spots: Iterable[Spot]) -> str:
        return " ".join(f"{x},{y}" for x, y in map(self._spot, spots))


def _element(name: str, look: Look) -> Element:
    return Element(name, {key: str(look[key]) for key in sorted(look)})


def _titled(element: Element, title: str) -> None:
    """What a viewer says of an element."""
    SubElement(element, "title").text = title


def _spans(text: Text) -> Iterator[Element]:
    """The runs of a text, each shifted from the level of the last to its own."""
    level = 0
    for run in text.runs:
        dy = _round((level - run.level) * DROP * text.size)
        small: Look = {"font-size": _round(SUBSCRIPT * text.size)} if run.level else {}
        span = _element("tspan", ({"dy": dy} if dy else {}) | small)
        span.text, level = run.text, run.level
        yield span


def _look(pen: Pen) -> Look:
    look: Look = {"fill": pen.fill}
    if pen.width:
        look |= {"stroke": pen.colour, "stroke-width": _round(pen.width)}
    if pen.dash:
        look["stroke-dasharray"] = " ".join(f"{_round(part):g}" for part in pen.dash)
    return look


def _round(number: float, places: int = 2) -> float:
    """To 0.01 mm, or to more places, and never -0."""
    value = round(number, places) + 0.0
    return int(value) if value == int(value) else value
