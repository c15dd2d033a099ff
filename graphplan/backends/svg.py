"""The display list as SVG text: one group a layer, one group a drawing step with its sentence as title.

Every number is rounded to a hundredth of a millimetre and nothing depends on time or memory, so the same sheet is the
same text. svgwrite is imported here and nowhere else.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import groupby
from typing import Any

import svgwrite

from graphplan.sheet.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.sheet.lettering import DROP, FONTS, SUBSCRIPT, width
from graphplan.sheet.pens import Pen


def svg(sheet: Sheet) -> str:
    """The sheet as one SVG document, in millimetres."""
    return _Writer(sheet).text()


class _Writer:
    """Writes one sheet; y runs down in SVG and up on the sheet."""

    def __init__(self, sheet: Sheet):
        self.sheet = sheet
        size = f"{_round(sheet.width)}mm", f"{_round(sheet.height)}mm"
        self.doc = svgwrite.Drawing(size=size, viewBox=f"0 0 {_round(sheet.width)} {_round(sheet.height)}", debug=False)
        self.doc.attribs["font-family"] = FONTS
        self.doc.attribs["stroke-linecap"] = self.doc.attribs["stroke-linejoin"] = "round"
        self.doc.set_desc(title=sheet.title, desc=sheet.description)
        self.doc.add(self.doc.rect((0, 0), (_round(sheet.width), _round(sheet.height)), fill="#ffffff"))

    def text(self) -> str:
        for key, items in groupby(self.sheet.items, lambda item: item.layer if item.step is None else item.step):
            self.doc.add(self._group(key, items))
        return '<?xml version="1.0" encoding="utf-8"?>\n' + str(self.doc.tostring()) + "\n"

    def _group(self, key: str | int, items: Iterable[Item]) -> Any:
        group = self.doc.g(class_=f"layer-{key}" if isinstance(key, str) else "step")
        if isinstance(key, int):
            group.attribs["data-step"] = str(key)
            group.set_desc(title=self.sheet.sentences[key])
        for item in items:
            group.add(self._item(item))
        return group

    def _item(self, item: Item) -> Any:
        look = _look(item.pen)
        match item:
            case Polyline():
                return self.doc.polyline(self._spots(item.spots), **look | {"fill": "none"})
            case Polygon():
                return self.doc.polygon(self._spots(item.spots), **look)
            case Circle():
                return self.doc.circle(self._spot(item.centre), _round(item.radius), **look)
            case Arc():
                return self._arc(item, look)
            case Arrow():
                return self._arrow(item, look)
            case Text():
                return self._text(item)
        raise TypeError(f"no SVG for {type(item).__name__}")

    def _arc(self, arc: Arc, look: dict[str, Any]) -> Any:
        (x, y), (u, v), r = self._spot(arc.at(arc.start)), self._spot(arc.at(arc.end)), _round(arc.radius)
        large = int(arc.end - arc.start > 180)
        return self.doc.path(f"M {x} {y} A {r} {r} 0 {large} 0 {u} {v}", **look | {"fill": "none"})

    def _arrow(self, arrow: Arrow, look: dict[str, Any]) -> Any:
        """The shaft ends in the head, so that the tip is sharp; data-from and data-to keep the true ends."""
        tip, left, right = arrow.barbs
        neck = (left[0] + right[0]) / 2, (left[1] + right[1]) / 2
        group = self.doc.g(class_="vector")
        group.attribs["data-from"] = "{} {}".format(*self._spot(arrow.start))
        group.attribs["data-to"] = "{} {}".format(*self._spot(arrow.end))
        if arrow.label:
            group.attribs["data-vector"] = arrow.label
        if math.dist(arrow.start, neck) > 0.01:
            group.add(self.doc.polyline(self._spots((arrow.start, neck)), **look | {"fill": "none"}))
        group.add(self.doc.polygon(self._spots((tip, left, right)), fill=arrow.pen.colour))
        return group

    def _text(self, text: Text) -> Any:
        """Levels by shifting tspans; the anchor is worked out here, as renderers disagree about it over tspans."""
        shift = {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor] * width(text.runs, text.size, text.bold)
        anchored = len(text.runs) == 1
        spot = text.at if anchored else (text.at[0] - shift, text.at[1])
        look: dict[str, Any] = {"font_size": _round(text.size), "fill": text.pen.colour}
        if text.bold:
            look["font_weight"] = "bold"
        if anchored and text.anchor != "start":
            look["text_anchor"] = text.anchor
        if anchored and text.runs[0].level == 0:
            return self.doc.text(text.runs[0].text, insert=self._spot(spot), **look)
        out = self.doc.text("", insert=self._spot(spot), **look)
        level = 0
        for run in text.runs:
            dy = _round((level - run.level) * DROP * text.size)
            small = {"font_size": _round(SUBSCRIPT * text.size)} if run.level else {}
            out.add(self.doc.tspan(run.text, **({"dy": [dy]} if dy else {}), **small))
            level = run.level
        return out

    def _spot(self, spot: Spot) -> tuple[float, float]:
        return _round(spot[0]), _round(self.sheet.height - spot[1])

    def _spots(self, spots: Iterable[Spot]) -> list[tuple[float, float]]:
        return [self._spot(spot) for spot in spots]


def _look(pen: Pen) -> dict[str, Any]:
    look: dict[str, Any] = {"fill": pen.fill}
    if pen.width:
        look |= {"stroke": pen.colour, "stroke_width": _round(pen.width)}
    if pen.dash:
        look["stroke_dasharray"] = " ".join(f"{_round(part):g}" for part in pen.dash)
    return look


def _round(number: float) -> float:
    """To 0.01 mm, and never -0."""
    value = round(number, 2) + 0.0
    return int(value) if value == int(value) else value
