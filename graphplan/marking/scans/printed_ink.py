"""What was printed on a sheet, as a picture and as straight pieces: what is there before the student draws."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import LinearRing, LineString

from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Light
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.sheet.plates.pens import Pen, rgb

MARKS = "corner marks"


@dataclass(frozen=True)
class Pieces:
    """Straight pieces of print: where their middles are, their directions, and half their lengths, in mm; and which are
    the task's `own`, that lie on its plans."""

    middles: NDArray[np.float64]
    along: NDArray[np.float64]
    halves: NDArray[np.float64]
    own: NDArray[np.bool_]

    def only(self, which: NDArray[np.bool_]) -> Pieces:
        """Some of them."""
        return Pieces(self.middles[which], self.along[which], self.halves[which], self.own[which])


def picture(sheet: Sheet, scale: float) -> Light:
    """The sheet without its words, lightness 0..1, so many pixels per mm, seen from above: the top is the first row."""
    fine = scale * measures.PRINT_FINENESS
    canvas = np.full((round(sheet.height * fine), round(sheet.width * fine)), 255, np.uint8)
    for item in sheet.items:
        _draw(canvas, item, sheet.height, fine)
    small = cv2.resize(canvas, (round(sheet.width * scale), round(sheet.height * scale)), interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.float32) / np.float32(255)


def words(sheet: Sheet, scale: float) -> NDArray[np.bool_]:
    """Where words are printed."""
    mask = np.zeros((round(sheet.height * scale), round(sheet.width * scale)), bool)
    for box in (item.box for item in sheet.items if isinstance(item, Text)):
        rows = slice(max(0, int((sheet.height - box.top) * scale)), math.ceil((sheet.height - box.bottom) * scale))
        mask[rows, max(0, int(box.left * scale)) : math.ceil(box.right * scale)] = True
    return mask


def pieces(sheet: Sheet) -> Pieces:
    """The straight lines of print, cut short."""
    chains = [LineString(item.spots) if isinstance(item, Polyline) else LinearRing(item.spots)
              for item in sheet.items if isinstance(item, Polyline | Polygon) and item.layer != MARKS]
    cut = [piece for chain in chains for piece in pairwise(chain.segmentize(measures.MAX_PIECE_MM).coords)
           if math.dist(*piece) >= measures.MIN_PIECE_MM]
    ends = np.array(cut, float).reshape(-1, 2, 2)
    way = ends[:, 1] - ends[:, 0]
    long = np.hypot(way[:, 0], way[:, 1])
    middles, own = ends.mean(axis=1), np.zeros(len(ends), bool)
    for panel in sheet.panels.values():
        inside = panel.inset(measures.OWN_PIECE_INSET_MM, measures.OWN_PIECE_INSET_MM, measures.OWN_PIECE_INSET_MM,
                             measures.OWN_PIECE_INSET_MM)
        low, high = (inside.left, inside.bottom), (inside.right, inside.top)
        own |= (long > measures.MIN_OWN_PIECE_MM) & (middles > low).all(axis=1) & (middles < high).all(axis=1)
    return Pieces(middles, way / long[:, None], long / 2, own)


# ---- drawn ---------------------------------------------------------------------------------------------------------


def _draw(canvas: NDArray[np.uint8], item: Item, height: float, scale: float) -> None:
    """One item in ink; words are not drawn."""
    fill, filled = item.pen.fill, tuple[Spot, ...]()
    match item:
        case Polygon(spots=spots):
            filled = spots
        case Circle(centre=centre, radius=radius):
            filled = spots = Arc(item.pen, item.layer, item.step, centre, radius, 0.0, 360.0).spots()
        case Polyline(spots=spots):
            pass
        case Arc():
            spots = item.spots()
        case Arrow():
            for part in (*(Polyline(item.pen, item.layer, item.step, shaft) for shaft in item.shaft),
                         *(Polygon(Pen(0.0, fill=of), item.layer, item.step, figure) for figure, of in item.figures)):
                _draw(canvas, part, height, scale)
            return
        case _:
            return
    if filled and fill != "none":
        cv2.fillPoly(canvas, [_pixels(filled, height, scale)], _light(fill), cv2.LINE_AA, measures.PRINT_BITS)
    if item.pen.width:
        cv2.polylines(canvas, [_pixels(spots, height, scale)], spots == filled, _light(item.pen.colour),
                      max(1, round(item.pen.width * scale)), cv2.LINE_AA, measures.PRINT_BITS)


def _pixels(spots: tuple[Spot, ...], height: float, scale: float) -> NDArray[np.int32]:
    """Spots in parts of pixels, whose middles have whole numbers."""
    at = np.array([(x, height - y) for x, y in spots]) * scale - 0.5
    return np.rint(at * (1 << measures.PRINT_BITS)).astype(np.int32).reshape(-1, 1, 2)


def _light(colour: str) -> tuple[int]:
    """How light a colour is to a scanner, 0..255."""
    red, green, blue = rgb(colour)
    of_red, of_green, of_blue = measures.RED_GREEN_BLUE_LIGHT
    return (round(of_red * red + of_green * green + of_blue * blue),)
