"""Items of the display list as entities of a CAD drawing, wherever and in whatever size they are drawn.

Texts are whole: a line of letters is one entity, with subscripts and superscripts as stacked text.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ezdxf.enums import MTextEntityAlignment, TextEntityAlignment

from graphplan.exports.cad.layers import NAME, Layers, colour, weight
from graphplan.sheet.lettering.lettering import CAPS, TextRun, plain, script_size
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Spot, Text
from graphplan.sheet.plates.pens import PAPER, Pen

# LibreCAD letters in its own font of the style's name, other programs in the style's file; both have Greek, Cyrillic
# and true minus signs. The GOST letters of LibreCAD lack some of Latvian, which another of its fonts has.
STYLE, BOLD, LATVIAN = "lc_opengost-br", "lc_opengost-ar", "amiri-regular"
FONTS = {STYLE: "arial.ttf", BOLD: "arialbd.ttf", LATVIAN: "arial.ttf"}
LACKING = re.compile("[āēģīķļņūŗĀĒĢĪĶĻŅŪŖ]")
ANCHORS = {"start": TextEntityAlignment.LEFT, "middle": TextEntityAlignment.CENTER, "end": TextEntityAlignment.RIGHT}
HANGING = {"start": MTextEntityAlignment.TOP_LEFT, "middle": MTextEntityAlignment.TOP_CENTER,
           "end": MTextEntityAlignment.TOP_RIGHT}
MEANT = re.compile(r"[\\{}]")  # what means something else in texts of several levels
STACKED = re.compile(r"[\\{}^/#;]")  # and in what is stacked
STROKE = 10  # of the height of capitals: the pen of letters that are lines, as ISO 3098 has them
MAX_LINE_WIDTH_MM = 1.0  # mm: what is wider than this is no line but a bar
DISC_STEP_DEG = 10.0  # degrees between the corners of what covers a disc
DRAWING = "construction", "vectors"  # layers of the sheet with what steps draw


@dataclass(frozen=True)
class Ink:
    """Draws items in a space, a mm of which is so many of its units, from where the items' own origin is."""

    space: Any
    layers: Layers
    unit: float = 1.0
    origin: Spot = (0.0, 0.0)

    def item(self, item: Item) -> None:
        """Draw an item; what of a step is no drawing bears its layer of the sheet."""
        look = self.layers.look(item)
        if item.pen.dash and self.unit != 1.0:
            look["ltscale"] = self.unit
        entities = list(self._draw_item(item, look))
        if item.step is not None and item.layer not in DRAWING:
            for entity in entities:
                entity.set_xdata(NAME, [(1000, item.layer)])

    def _draw_item(self, item: Item, look: dict[str, Any]) -> Iterator[Any]:
        match item:
            case Polyline():
                yield self._line(item, look)
            case Polygon():
                yield from self._fill_figure(item.spots, item.pen, look)
                if item.pen.width:
                    yield self.space.add_lwpolyline(self._spots(item.spots), close=True, dxfattribs=look)
            case Circle():
                disc = Arc(item.pen, item.layer, item.step, item.centre, item.radius, 0.0, 360.0)
                yield from self._fill_figure(disc.spots(DISC_STEP_DEG)[:-1], item.pen, look)
                if item.pen.width:
                    yield self.space.add_circle(self.place_spot(item.centre), self.unit * item.radius, dxfattribs=look)
            case Arc():
                yield self.space.add_arc(self.place_spot(item.centre), self.unit * item.radius, item.start, item.end,
                                         dxfattribs=look)  # fmt: skip
            case Arrow():
                yield from self._arrow(item, look)
            case Text():
                yield self._text(item, look)
            case _:
                raise TypeError(f"no DXF for {type(item).__name__}")

    def _line(self, line: Polyline, look: dict[str, Any]) -> Any:
        """A bar has its width in the drawing itself, as many programs show no line weights."""
        spots = self._spots(line.spots)
        if line.pen.width > MAX_LINE_WIDTH_MM:
            return self.space.add_lwpolyline(spots, dxfattribs=look | {"const_width": self.unit * line.pen.width})
        if len(spots) == 2:
            return self.space.add_line(*spots, dxfattribs=look)
        return self.space.add_lwpolyline(spots, dxfattribs=look)

    def _fill_figure(self, spots: tuple[Spot, ...], pen: Pen, look: dict[str, Any]) -> Iterator[Any]:
        """What fills a figure: a tint, or the paper itself, which covers what lies behind."""
        if pen.fill == PAPER:
            yield self.space.add_wipeout(self._spots(spots), dxfattribs={"layer": look["layer"]})
        elif pen.fill != "none":
            hatch = self.space.add_hatch(dxfattribs={"layer": look["layer"], **colour(pen.fill)})
            hatch.paths.add_polyline_path(self._spots(spots), is_closed=True)
            yield hatch

    def _arrow(self, arrow: Arrow, look: dict[str, Any]) -> Iterator[Any]:
        """The shaft ends in the head, so that the tip is sharp; the extended data keep the true ends."""
        strokes: list[Any] = []
        for spots, fill in arrow.figures:
            corners = self._spots((*spots[:2], *reversed(spots[2:])))  # the last two of a solid cross
            strokes += (self._fill_figure(spots, arrow.pen.with_fill(fill), look) if fill == PAPER
                        else [self.space.add_solid(corners, dxfattribs=look)])
        strokes += [self.space.add_line(*self._spots(shaft), dxfattribs=look) for shaft in arrow.shaft]
        start, end = self._spots((arrow.start, arrow.end))
        for stroke in strokes:
            stroke.set_xdata(NAME, [(1000, arrow.label), (1011, (*start, 0.0)), (1011, (*end, 0.0))])
            yield stroke

    def _text(self, text: Text, look: dict[str, Any]) -> Any:
        """A line of letters, anchored by whoever letters it."""
        high, (x, y) = CAPS * text.size, text.at
        lacking = LACKING.search(plain(text.runs))
        look |= {"style": LATVIAN if lacking else BOLD if text.bold else STYLE, "lineweight": weight(high / STROKE)}
        if len(text.runs) == 1 and text.runs[0].level == 0:
            written = text.runs[0].text.replace("^", "^ ")
            letters = self.space.add_text(written, height=self.unit * high, dxfattribs=look)
            if lacking:  # that font is wide
                ends = self._spots(((text.box.left, y), (text.box.right, y)))
                return letters.set_placement(*ends, align=TextEntityAlignment.FIT)
            return letters.set_placement(self.place_spot((x, y)), align=ANCHORS[text.anchor])
        small = script_size(text.size) / text.size
        written = "".join(_stacked_text(run, small) for run in text.runs)
        letters = self.space.add_mtext(written, dxfattribs=look | {"char_height": self.unit * high})
        return letters.set_location(self.place_spot((x, y + high)), attachment_point=HANGING[text.anchor])

    def place_spot(self, spot: Spot) -> Spot:
        """Where a spot in mm lies in the space."""
        return self.origin[0] + self.unit * spot[0], self.origin[1] + self.unit * spot[1]

    def _spots(self, spots: tuple[Spot, ...]) -> list[Spot]:
        return [self.place_spot(spot) for spot in spots]


def _stacked_text(run: TextRun, small: float) -> str:
    """Letters in the language of stacked text: `small` is the size of those that hang or are raised."""
    if run.level == 0:
        return MEANT.sub(r"\\\g<0>", run.text)
    written = STACKED.sub(r"\\\g<0>", run.text)
    return rf"{{\H{small:.3g}x;\S{written}^ ;}}" if run.level > 0 else rf"{{\H{small:.3g}x;\S^ {written};}}"
