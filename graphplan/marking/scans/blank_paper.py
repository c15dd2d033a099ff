"""A picture of a drawing on blank or squared paper, and the points of the task by the letters beside them.

How large the paper is, its squares say, or else the picture's file, or else it is about as large as the task's. Printed
squares are taken off before the pencil is read.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import combinations
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import MultiPoint, box

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Grey, Light, Spots, read_pictures, shrink, shrink_sides, stated_dpi
from graphplan.marking.scans.pencil_pixels import PencilInk, darkness, find_ridges
from graphplan.marking.scans.pin_letters import LetterPiece, find_pins, letter_pieces, possible_points
from graphplan.marking.scans.plan_places import find_plans
from graphplan.marking.scans.ruled_paper import Ruling, find_ruling, squared_warp, without_ruling, without_smudges
from graphplan.marking.scans.scan import SHOWS, PencilPage
from graphplan.marking.scans.straighten import Warp, lay_straight, plane_warp
from graphplan.marking.traces import Frames, PlanFrame, Spot, Submission, Trace, as_spot, first_spots
from graphplan.mechanism.units import SIZES
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.plates.display import Rect

Marks = Mapping[str, Mapping[str, complex]]

# ---- the sheet ------------------------------------------------------------------------------------------------------


def paper_corners(image: Grey) -> Spots | None:
    """The corners of the paper in pixels, the lower left first, then counter-clockwise: of the light figure of four
    sides at whose edges light falls off most, as it does at no shadow's; None where the paper's edges are not seen."""
    small, scale = shrink_sides(image, measures.PAPER_SEARCH_PX)
    small = np.asarray(cv2.GaussianBlur(small, (0, 0), measures.PAPER_BLUR_PX), np.uint8)
    figures = [figure for level in np.unique(np.percentile(small, measures.PAPER_LIGHT_PERCENTILES))
               if (figure := _light_figure(small, level)) is not None]
    corners = max(figures, key=lambda figure: _least_fall(small, figure), default=None)
    if corners is None or _least_fall(small, corners) < measures.MIN_PAPER_FALL:
        return None
    nearest = [int(np.hypot(*(corners - corner).T).argmin()) for corner in _picture_corners(small)]
    return np.asarray(corners[nearest] / scale, float) if len(corners) == len(set(nearest)) else None


def _picture_corners(image: Grey) -> Spots:
    """The corners of a picture in pixels, in the same order."""
    high, wide = image.shape
    return np.array(Rect(0.0, high, wide, 0.0).corners)


def _light_figure(small: Grey, level: float) -> NDArray[np.float32] | None:
    """The corners of the figure of four sides that all lighter than a level fills; None where it is none."""
    light = np.where(small > level, np.uint8(255), np.uint8(0))
    window = np.ones((measures.PAPER_CLOSE_PX, measures.PAPER_CLOSE_PX), np.uint8)
    rims, _ = cv2.findContours(cv2.morphologyEx(light, cv2.MORPH_CLOSE, window), cv2.RETR_EXTERNAL,
                               cv2.CHAIN_APPROX_SIMPLE)
    rim = max(rims, key=cv2.contourArea, default=None)
    if rim is None or not measures.MIN_PAPER_SHARE < cv2.contourArea(rim) / small.size < measures.WHOLE_PAPER_SHARE:
        return None
    hull = cv2.convexHull(rim)
    four = cv2.approxPolyDP(hull, measures.FRAME_CORNER_SHARE * cv2.arcLength(hull, True), True).reshape(-1, 2)
    return np.asarray(four, np.float32) if len(four) == 4 else None


def _least_fall(small: Grey, corners: NDArray[np.float32]) -> float:
    """By how much of itself light falls off at the edges of a figure, at that where it falls off least."""
    falls, shares = list[float](), np.linspace(*measures.PAPER_EDGE_ENDS, measures.PAPER_EDGE_SPOTS)[:, None]
    for corner, following in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        spots = corner + shares * (following - corner)
        inward = corners.mean(axis=0) - spots
        inward *= measures.PAPER_EDGE_PX / np.hypot(*inward.T)[:, None]
        inner, outer = (small[tuple(np.clip(np.round(at[:, ::-1]).astype(int), 0, np.array(small.shape) - 1).T)]
                        .astype(float) for at in (spots + inward, spots - inward))
        falls.append(float(np.median(1 - outer / np.maximum(inner, 1))))
    return min(falls)


def stated_size(image: Grey, dpi: float | None) -> tuple[float, float] | None:
    """How large the paper is in mm, if a whole picture of so many dots per inch is as large as some paper; programs
    write down densities that are none."""
    if not dpi:
        return None
    high, wide = (side / dpi * measures.INCH_MM for side in image.shape)
    sides = max(high, wide), min(high, wide)
    is_paper = any(max(abs(math.log(side / paper_side)) for side, paper_side in zip(sides, paper, strict=True))
                   < measures.PAPER_SIZE_LOG for paper in SIZES.values())
    return (wide, high) if is_paper else None


def lay_paper(image: Grey, dpi: float | None, usual: tuple[float, float]) -> tuple[Warp, bool]:
    """How a picture shows the paper, and whether its file says how large that is: else its longer side is that of the
    `usual` paper, and in a slanting view its proportions are so too."""
    corners, stated_sides = paper_corners(image), None
    if corners is None:
        corners, stated_sides = _picture_corners(image), stated_size(image, dpi)
        fine = max(image.shape) / max(usual)
        wide, high = stated_sides or (image.shape[1] / fine, image.shape[0] / fine)
    else:
        across, up = np.hypot(*(corners[[1, 3]] - corners[0]).T)
        high, wide = sorted(usual) if across > up else sorted(usual, reverse=True)
    warp = plane_warp(np.array(Rect(0.0, 0.0, wide, high).corners), corners, (wide, high))
    return warp, stated_sides is not None


def blank_ink(image: Grey, warp: Warp, is_stated: bool, scale: float) -> tuple[PencilInk, Warp]:
    """The pencil on paper laid straight, without its squares or lines, and how the picture shows it: by its squares,
    where it has any."""
    dark = darkness(lay_straight(image, warp, scale))
    upward, across = _rulings(dark, scale)
    if upward and across:
        side = math.sqrt(upward.apart * across.apart) if is_stated else measures.SQUARE_MM
        warp = squared_warp(warp, upward, across, side)
        dark = darkness(lay_straight(image, warp, scale))
        upward, across = _rulings(dark, scale)
    if upward:
        dark = without_ruling(dark[::-1], upward, scale)[::-1]
    if across:
        dark = without_ruling(dark[::-1].T, across, scale).T[::-1]
    if upward or across:
        dark = without_smudges(dark, scale)
    hidden = np.ones(dark.shape, bool)
    rim = round(measures.PAPER_RIM_MM * scale)
    hidden[rim:-rim, rim:-rim] = False
    return PencilInk(np.where(hidden, np.float32(0.0), dark), hidden, scale, warp.size[1]), warp


def _rulings(dark: Light, scale: float) -> list[Ruling | None]:
    """The printed lines up the paper, and those across it."""
    return [find_ruling(dark[::-1], scale), find_ruling(dark[::-1].T, scale)]


def has_frame(strokes: Sequence[Trace], size: tuple[float, float]) -> bool:
    """Whether lines run along most sides of the paper, as they do on printed sheets: what is printed within is none of
    this task, and no pencil."""
    framed_sides = set()
    for trace in strokes:
        if trace.kind != LINE:
            continue
        low, high = np.sort(trace.spots, axis=0)
        for along, across in ((0, 1), (1, 0)):
            long, slant = high[along] - low[along], high[across] - low[across]
            near = low[across], size[across] - high[across]
            if long > measures.FRAME_SIDE_SHARE * size[along] and slant < measures.FRAME_SLOPE * long:
                framed_sides |= {(across, end) for end in (0, 1) if near[end] < measures.FRAME_RIM_SHARE * size[across]}
    return len(framed_sides) >= measures.MIN_FRAME_SIDES


# ---- what is handed in ----------------------------------------------------------------------------------------------


def read_blank_paper(path: Path, marks: Marks, frames: Frames, usual: tuple[float, float]) -> Submission | None:
    """What was drawn on blank or squared paper, in mm, and where its plans are; None where no two lettered points are
    found, or lines are printed about it. Fails with `Refused` where a plan may lie at several places.

    `marks` are where the task has the marks of its plans, in their units, the beginning of each first; of the mechanism
    its given points. `frames` are those of the task's sheet, whose paper is usually of this size, in mm.
    """
    for picture in read_pictures(path):
        image, dpi = shrink(picture, measures.MAX_PAGE_PX), stated_dpi(path, picture)
        warp, is_stated = lay_paper(image, dpi and dpi * max(image.shape) / max(picture.shape), usual)
        if warp.fineness() * measures.INCH_MM < measures.MIN_DPI:
            continue
        ink, warp = blank_ink(image, warp, is_stated, measures.PAGE_PX_PER_MM)
        page = PencilPage(ink, find_ridges(ink, warp.fineness()), measures.BLANK_PAGE_ERROR_MM, warp)
        if not has_frame(page.strokes, page.warp.size) and (submission := _read_page(path, page, marks, frames)):
            return submission
    return None


def _read_page(path: Path, page: PencilPage, marks: Marks, frames: Frames) -> Submission | None:
    """A page with the points of the mechanism named, which two letters tell, and its plans; None without such letters.
    """
    points, usual = marks[MECHANISM], frames[MECHANISM].unit
    pieces = letter_pieces(page.ink, page.clear_ridges, page.strokes)
    dots = first_spots(possible_points(page.possible_dots, page.strokes))
    pins = find_pins(dots, pieces, points, abs(usual))
    mechanism = _mechanism_frame([(points[name], complex(dots[place])) for name, place in pins.items()])
    if mechanism is None:
        return None
    page = without_given(page, [as_spot(mechanism.to_sheet(z)) for z in points.values()])
    spots, count = first_spots(possible_points(page.possible_dots, page.strokes)), len(page.possible_dots)

    @cache
    def is_drawn(one: complex, two: complex) -> bool:
        return shows_line(page, as_spot(one), as_spot(two), measures.VECTOR_SPOTS)

    beginnings, plan_frames = list[Trace](), dict[str, PlanFrame]({MECHANISM: mechanism})
    for panel, plan_marks in marks.items():
        if panel == MECHANISM:
            continue
        frame = plan_frames[panel] = _clear_place(path, panel, find_plans(
            spots[:count], spots[count:], list(plan_marks.values()), mechanism.unit * frames[panel].unit / usual,
            is_drawn))
        name, begin = next(iter(plan_marks.items()))
        if dot := page.find_dot(as_spot(frame.to_sheet(begin)), measures.MARK_NEAR_MM):
            beginnings.append(replace(dot, label=name))
    about = MultiPoint([trace.spots[0] for trace in beginnings])
    traces = [trace for trace in page.traces if not _is_letter(trace, pieces) and not (
        beginnings and trace.kind == POINT and trace.figure.distance(about) < measures.SAME_DOT_MM)]
    return Submission(path.name, (*beginnings, *traces), shows=SHOWS, frames=plan_frames, page=page,
                      paper=Rect(0.0, 0.0, *page.warp.size))


def _clear_place(path: Path, panel: str, places: Sequence[PlanFrame]) -> PlanFrame:
    """The only place of a plan; refused where there is none, or another is as good."""
    if not places:
        raise Refused(f"{path}", f"the {panel} is not found", "mark its beginning and all of its marks by dots")
    if len(places) > 1:
        raise Refused(f"{path}", f"where the {panel} lies, and at which scale, is not clear",
                      "mark its beginning and all of its marks by dots, or draw it at the task's scale")
    return places[0]


def _mechanism_frame(pairs: Sequence[tuple[complex, complex]]) -> PlanFrame | None:
    """The frame in which points of the mechanism are where the page has them, but those that are far off; None where
    too few agree on one."""
    while len(pairs) >= measures.MIN_PINS:
        plan, sheet = (np.array(spots) for spots in zip(*pairs, strict=True))
        frame = PlanFrame.least_squares(plan, sheet)
        off = np.abs(frame.origin + frame.unit * plan - sheet)
        if off.max() < measures.PIN_OFF_MM:
            return frame
        pairs = [pair for place, pair in enumerate(pairs) if place != off.argmax()]
    return None


def shows_line(page: PencilPage, one: Spot, two: Spot, count: int) -> bool:
    """Whether a line is seen between two spots, at nearly all of so many spots along it."""
    spots = [tuple(spot) for spot in np.linspace(one, two, count)]
    return (page.visible_share(LINE, spots, measures.VECTOR_NEAR_MM) or 0.0) > measures.LINE_SHARE


def without_given(page: PencilPage, given: Sequence[Spot]) -> PencilPage:
    """A page on which the points of the mechanism, and its links, are hidden, as print hides them on the task's sheet.
    """
    lines = [ends for ends in combinations(given, 2) if shows_line(page, *ends, measures.LINK_SPOTS)]
    ink = page.ink.hide(given, lines, measures.SAME_DOT_MM, measures.LINK_HALF_MM)
    far = ~ink.hidden[ink.cells(page.ridges.spots)]
    return replace(page, ink=ink, ridges=page.ridges.select(far))


def _is_letter(trace: Trace, pieces: Sequence[LetterPiece]) -> bool:
    """Whether a rim is that of a letter which stands apart."""
    return trace.kind == CIRCLE and any(trace.figure.within(box(*piece.spots.min(axis=0), *piece.spots.max(axis=0))
                                                            .buffer(measures.HALF_LINE_MM)) for piece in pieces)
