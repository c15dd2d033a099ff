"""The display list as a PNG picture.

matplotlib brings the renderer. It is driven item by item, from back to front, so that what covers what is as on the
sheet. Nothing depends on time or memory: the same sheet is the same bytes.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from functools import lru_cache
from typing import Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.colors import to_rgb
from matplotlib.font_manager import FontProperties
from matplotlib.image import imsave
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from graphplan.output.typeface import advance, font_file, place_runs, refuse_lacking
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.pens import PAPER, Pen

INCH = 25.4
POINTS = 72 / INCH  # typographic points in a mm
WORD = re.compile(r" *[^ ]+ *|^ +$")  # with the spaces about it
SETTINGS: Any = {"text.hinting": "no_hinting", "text.antialiased": True}  # whatever the reader's own are


def png(sheet: Sheet, dpi: float = 150) -> bytes:
    """The sheet as a picture of so many dots per inch.

    Fails with `Refused` where the sheet has letters that the font does not.
    """
    written, about = io.BytesIO(), {"Title": sheet.title, "Software": "graphplan"}
    with matplotlib.rc_context(SETTINGS):
        renderer = RendererAgg(int(sheet.width / INCH * dpi), int(sheet.height / INCH * dpi), dpi)
        _Painter(renderer).sheet(sheet)
        imsave(written, np.asarray(renderer.buffer_rgba()), format="png", dpi=dpi, metadata=about)
    return written.getvalue()


class _Painter:
    """Draws items with a renderer: `mm` of its pixels are a millimetre."""

    def __init__(self, renderer: Any):
        self.renderer, self.mm = renderer, renderer.points_to_pixels(POINTS)
        self.height = renderer.get_canvas_width_height()[1]
        self.pens: dict[Pen, Any] = {}

    def sheet(self, sheet: Sheet) -> None:
        """Draw a sheet on its paper, from back to front."""
        refuse_lacking(sheet)
        paper = Rect(0.0, 0.0, sheet.width, sheet.height).corners
        self._stroke(Pen(0.0), Path([*paper, paper[0]], closed=True), PAPER)
        for item in sheet.items:
            self.draw(item)

    def draw(self, item: Item) -> None:
        match item:
            case Polyline():
                self._stroke(item.pen, Path(item.spots))
            case Polygon():
                self._stroke(item.pen, Path([*item.spots, item.spots[0]], closed=True), item.pen.fill)
            case Circle():
                self._stroke(item.pen, _round(Path.unit_circle(), item.centre, item.radius), item.pen.fill)
            case Arc():
                self._stroke(item.pen, _round(Path.arc(item.start, item.end), item.centre, item.radius))
            case Arrow():
                self._arrow(item)
            case Text():
                self._text(item)
            case _:
                raise TypeError(f"no ink for {type(item).__name__}")

    def _arrow(self, arrow: Arrow) -> None:
        """The shaft ends in the head, so that the tip is sharp."""
        for shaft in arrow.shaft:
            self._stroke(arrow.pen, Path(shaft))
        for spots, fill in arrow.figures:
            self._stroke(Pen(0.0), Path([*spots, spots[0]], closed=True), fill)

    def _stroke(self, pen: Pen, path: Path, fill: str = "none") -> None:
        """A path in mm, drawn with a pen and filled."""
        face = None if fill == "none" else to_rgb(fill)
        self.renderer.draw_path(self._pen(pen), path, Affine2D().scale(self.mm), face)

    def _text(self, text: Text) -> None:
        gc = self._pen(Pen(0.0, text.pen.colour))
        for words, (x, y), size in _pieces(text):
            self.renderer.draw_text(gc, x * self.mm, self.height - y * self.mm, words, _font(text.bold, size), 0)

    def _pen(self, pen: Pen) -> Any:
        """The renderer's own record of a pen."""
        if pen not in self.pens:
            gc = self.renderer.new_gc()
            gc.set_foreground(pen.colour)
            gc.set_linewidth(pen.width * POINTS)
            gc.set_dashes(0, [stretch * POINTS for stretch in pen.dash] or None)
            gc.set_capstyle("round")
            gc.set_joinstyle("round")
            gc.set_snap(False)
            self.pens[pen] = gc
        return self.pens[pen]


def _round(path: Path, centre: Spot, radius: float) -> Path:
    """A path about the origin, of radius one, about this centre and with this radius."""
    return Path(np.asarray(path.vertices) * radius + centre, path.codes)


def _pieces(text: Text) -> Iterator[tuple[str, Spot, float]]:
    """What is lettered in one go, where, and in which size: single words, as renderers push letters together and the
    next level is to stand close by; the last run whole."""
    for k, (run, (x, y), size) in enumerate(place_runs(text), 1):
        for words in WORD.findall(run.text) if k < len(text.runs) else [run.text]:
            yield words, (x, y), size
            x += advance(words, text.bold) * size


@lru_cache(maxsize=64)
def _font(bold: bool, size: float) -> FontProperties:
    return FontProperties(fname=str(font_file(bold)), size=size * POINTS)
