"""What was printed on a sheet, and is there before the student draws: as a picture, as straight pieces, and the coded
marks in its corners, which tell in a picture which sheet it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import LinearRing, LineString

from graphplan.errors import Refused
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Flags, Grey, Light, Sizes, Spots
from graphplan.sheet.frames.frame import corner_numbers
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.sheet.plates.pens import Pen, rgb

MARKS = "corner marks"


@dataclass(frozen=True)
class Pieces:
    """Straight pieces of print: where their middles are, their directions, and half their lengths, in mm; and which are
    the task's own (`is_own`), that lie on its plans."""

    middles: Sizes
    along: Sizes
    halves: Sizes
    is_own: Flags

    def select(self, which: Flags) -> Pieces:
        """The pieces that the flags select."""
        return Pieces(self.middles[which], self.along[which], self.halves[which], self.is_own[which])


def print_picture(sheet: Sheet, scale: float) -> Light:
    """The sheet without its words, lightness 0..1, so many pixels per mm, seen from above: the top is the first row."""
    fine = scale * measures.PRINT_FINENESS
    canvas = np.full((round(sheet.height * fine), round(sheet.width * fine)), 255, np.uint8)
    for item in sheet.items:
        _draw_item(canvas, item, sheet.height, fine)
    small = cv2.resize(canvas, (round(sheet.width * scale), round(sheet.height * scale)), interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.float32) / np.float32(255)


def print_words(sheet: Sheet, scale: float) -> Flags:
    """Mask of printed words."""
    mask = np.zeros((round(sheet.height * scale), round(sheet.width * scale)), bool)
    for box in (item.box for item in sheet.items if isinstance(item, Text)):
        rows = slice(max(0, int((sheet.height - box.top) * scale)), math.ceil((sheet.height - box.bottom) * scale))
        mask[rows, max(0, int(box.left * scale)) : math.ceil(box.right * scale)] = True
    return mask


def print_pieces(sheet: Sheet) -> Pieces:
    """The straight lines of print, cut short."""
    chains = [LineString(item.spots) if isinstance(item, Polyline) else LinearRing(item.spots)
              for item in sheet.items if isinstance(item, Polyline | Polygon) and item.layer != MARKS]
    cut = [piece for chain in chains for piece in pairwise(chain.segmentize(measures.MAX_PIECE_MM).coords)
           if math.dist(*piece) >= measures.MIN_PIECE_MM]
    ends = np.array(cut, float).reshape(-1, 2, 2)
    vectors = ends[:, 1] - ends[:, 0]
    long = np.hypot(vectors[:, 0], vectors[:, 1])
    middles, is_own = ends.mean(axis=1), np.zeros(len(ends), bool)
    for panel in sheet.panels.values():
        inside = panel.inset(measures.OWN_PIECE_INSET_MM, measures.OWN_PIECE_INSET_MM, measures.OWN_PIECE_INSET_MM,
                             measures.OWN_PIECE_INSET_MM)
        low, high = (inside.left, inside.bottom), (inside.right, inside.top)
        is_own |= (long > measures.MIN_OWN_PIECE_MM) & (middles > low).all(axis=1) & (middles < high).all(axis=1)
    return Pieces(middles, vectors / long[:, None], long / 2, is_own)


# ---- drawn ---------------------------------------------------------------------------------------------------------


def _draw_item(canvas: NDArray[np.uint8], item: Item, height: float, scale: float) -> None:
    """Draw an item in printed ink; texts are left out."""
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
            for item_part in (*(Polyline(item.pen, item.layer, item.step, shaft) for shaft in item.shaft),
                              *(Polygon(Pen(0.0, fill=of), item.layer, item.step, figure)
                                for figure, of in item.figures)):
                _draw_item(canvas, item_part, height, scale)
            return
        case _:
            return
    if filled and fill != "none":
        cv2.fillPoly(canvas, [_to_pixels(filled, height, scale)], _lightness(fill), cv2.LINE_AA, measures.PRINT_BITS)
    if item.pen.width:
        cv2.polylines(canvas, [_to_pixels(spots, height, scale)], spots == filled, _lightness(item.pen.colour),
                      max(1, round(item.pen.width * scale)), cv2.LINE_AA, measures.PRINT_BITS)


def _to_pixels(spots: tuple[Spot, ...], height: float, scale: float) -> NDArray[np.int32]:
    """Spots in parts of pixels, whose middles have whole numbers."""
    at = np.array([(x, height - y) for x, y in spots]) * scale - 0.5
    return np.rint(at * (1 << measures.PRINT_BITS)).astype(np.int32).reshape(-1, 1, 2)


def _lightness(colour: str) -> tuple[int]:
    """Lightness of a colour to a scanner, 0..255."""
    red, green, blue = rgb(colour)
    of_red, of_green, of_blue = measures.RED_GREEN_BLUE_LIGHT
    return (round(of_red * red + of_green * green + of_blue * blue),)


# ---- corner marks ---------------------------------------------------------------------------------------------------


PLACES = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)  # of the corners, from the lower left, counter-clockwise


def marks_of_sheet(image: Grey) -> dict[int, int]:
    """The numbers of the marks of the sheet in a picture, by their corner, as far as they are seen. Of a mirrored
    sheet it finds some too, with other numbers."""
    marks = detect_marks(np.ascontiguousarray(image))
    large_first = sorted(marks, key=lambda mark: -abs(signed_area(mark[1])))
    best: dict[int, int] = {}
    for anchor in large_first:
        consistent = [anchor]
        for candidate in large_first:
            if all(_are_consistent(chosen, candidate) for chosen in consistent):
                consistent.append(candidate)
        if len(consistent) > len(best):
            best = {number >> measures.CORNER_BITS: number for number, _ in consistent}
    return best


def is_blank(image: Grey) -> bool:
    """Whether hardly anything on a page is dark, its rim apart."""
    high, wide = (round(measures.PAGE_RIM_SHARE * side) for side in image.shape)
    middle = image[high : image.shape[0] - high : 2, wide : image.shape[1] - wide : 2]
    dark, light = np.percentile(middle, measures.BLANK_PERCENTILES)
    return bool(light - dark < measures.MIN_CONTRAST_SHADES)


Mark = tuple[int, Spots]


def _are_consistent(one: Mark, other: Mark) -> bool:
    """Whether two marks are as large as each other, and each where the other has it."""
    (first, rim), (second, far) = one, other
    small, large = sorted(abs(signed_area(corners)) for corners in (rim, far))
    return (first >> measures.CORNER_BITS != second >> measures.CORNER_BITS
            and large < measures.MARK_SIZE_RATIO**2 * small
            and _faces_mark(rim, far, PLACES[second >> measures.CORNER_BITS] - PLACES[first >> measures.CORNER_BITS])
            and _faces_mark(far, rim, PLACES[first >> measures.CORNER_BITS] - PLACES[second >> measures.CORNER_BITS]))


def _faces_mark(rim: Spots, far: Spots, way: Sizes) -> bool:
    """Whether a mark has another that way, along its own sides to the right and up."""
    out = far.mean(axis=0) - rim.mean(axis=0)
    right, up = rim[1] - rim[0], rim[0] - rim[3]
    along = np.array([out @ right / (right @ right), out @ up / (up @ up)])
    return bool(np.hypot(*along) > measures.MARKS_APART_SIDES and (along * way >= np.abs(way)).all())


def find_marks(image: Grey, code: int | None, name: str) -> dict[int, Spots]:
    """The marks of the sheet with this code, or without a code those of any sheet: by their corner, each as its own
    four corners in pixels, upper left, upper right, lower right, lower left as it was printed.

    Fails with `Refused` if the marks are those of another sheet.
    """
    detected_marks = detect_marks(image)
    if code is None:
        # what looks like a mark by chance is small
        small_first = sorted(detected_marks, key=lambda mark: abs(signed_area(mark[1])))
        return {number >> measures.CORNER_BITS: rim for number, rim in small_first}
    corner_of_number = {number: corner for corner, number in enumerate(corner_numbers(code))}
    corners_found = {corner_of_number[number]: corners
                     for number, corners in detected_marks if number in corner_of_number}
    if (not corners_found
        and _show_one_sheet([(number >> measures.CORNER_BITS, corners) for number, corners in detected_marks])):
        raise Refused(name, "the marks in its corners are those of another task",
                      "verify it against its own scene, plan, pose and paper, by the graphplan that printed it")
    return corners_found


def shows_task(image: Grey, code: int | None, name: str) -> bool:
    """Whether a picture has the marks of a printed sheet, be it of another task than that of this code."""
    try:
        return bool(find_marks(image, code, name))
    except Refused:
        return True


def detect_marks(image: Grey) -> list[tuple[int, Spots]]:
    """Every mark in the picture with its number, its corners to a part of a pixel."""
    settings = cv2.aruco.DetectorParameters()
    settings.minMarkerPerimeterRate = measures.MIN_MARK_RIM_PX / max(image.shape)
    (settings.adaptiveThreshWinSizeMin, settings.adaptiveThreshWinSizeMax,
     settings.adaptiveThreshWinSizeStep) = measures.THRESHOLD_WINDOWS_PX
    settings.perspectiveRemovePixelPerCell = measures.CELL_PX
    settings.perspectiveRemoveIgnoredMarginPerCell = measures.CELL_RIM_SHARE
    settings.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    settings.relativeCornerRefinmentWinSize = measures.CORNER_WINDOW_SHARE
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_ARUCO_ORIGINAL)
    corners, ids, _ = cv2.aruco.ArucoDetector(words, settings).detectMarkers(image)
    marker_ids = [] if ids is None else ids.ravel()
    return [(int(number), np.asarray(rim, float).reshape(4, 2))
            for number, rim in zip(marker_ids, corners, strict=True)]


def _show_one_sheet(marks: list[tuple[int, Spots]]) -> bool:
    """Whether the large ones among marks are those of several corners; print may look like a small mark by chance."""
    sizes = [math.sqrt(abs(signed_area(rim))) for _, rim in marks]
    return len({corner for (corner, _), side in zip(marks, sizes, strict=True)
                if side * measures.MARK_SIZE_RATIO > max(sizes)}) > 1


def signed_area(rim: Spots) -> float:
    """The area within a rim, by Gauss's formula: positive in the sense of the clock where rows count down."""
    ahead = np.roll(rim, -1, axis=0)
    return float((rim[:, 0] * ahead[:, 1] - ahead[:, 0] * rim[:, 1]).sum() / 2)
