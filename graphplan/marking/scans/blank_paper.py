"""A drawing on blank or squared paper: its plans by their dots, and the points of the task by the letters beside them.

Each dot that letters stand beside may be the point of that name; of all pairs that one is taken whose letters look most
like their names, and whose other points have dots where the task has them. Where lines meet, a dot may not be seen.

That a plan has the direction of the mechanism and the task's scale is likeliest; another scale must be borne out by
more marks, and a turn by most. A mistake moves its mark and all that follow: what comes first tells most, and lines
that run on as they should from marks that are off speak for a frame as well.

How large the paper is, its squares say, or else the picture's file, or else it is about as large as the task's. Printed
squares are taken off before the pencil is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import combinations, islice, permutations
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import MultiPoint, box

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Grey, Light, Spots, read_pictures, shrink, shrink_sides, stated_dpi
from graphplan.marking.scans.pencil_pixels import PencilInk, Ridges, darkness, find_ridges
from graphplan.marking.scans.ruled_paper import Ruling, find_ruling, squared_warp, without_ruling, without_smudges
from graphplan.marking.scans.scan import SHOWS, PencilPage
from graphplan.marking.scans.straighten import Warp, lay_straight, plane_warp
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.marking.traces import Frames, PlanFrame, Spot, Submission, Trace, as_spot, first_spots
from graphplan.mechanism.units import SIZES
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.plates.display import Rect

Points = Mapping[str, complex]


@dataclass(frozen=True)
class LetterPiece:
    """Strokes that may be letters: spots along them, in mm."""

    spots: Spots

    @property
    def longer_side(self) -> float:
        return float(np.ptp(self.spots, axis=0).max())

    @property
    def places(self) -> NDArray[np.complex128]:
        """Spots as complex numbers."""
        return self.spots[:, 0] + 1j * self.spots[:, 1]

    def turn_by(self, turn: complex) -> LetterPiece:
        """Strokes turned about the origin."""
        at = self.places * turn
        return LetterPiece(np.column_stack([at.real, at.imag]))


def letter_pieces(ink: PencilInk, ridges: Ridges, strokes: Sequence[Trace]) -> list[LetterPiece]:
    """Possible letters: drawn pieces apart from all else, and the remainder without strokes longer than a letter's."""
    pencil = np.zeros(ink.dark.shape, np.uint8)
    pencil[ink.cells(ridges.spots)] = 1
    pencil = np.asarray(cv2.dilate(pencil, np.ones((measures.PIECE_CLOSE_PX, measures.PIECE_CLOSE_PX), np.uint8)))
    beside = pencil.copy()
    for trace in strokes:
        if trace.figure.length > measures.LETTER_SIZES_MM[1] or (
                trace.kind == LINE and trace.figure.length > measures.MAX_LETTER_STROKE_MM):
            spots = np.rint(ink.pixels(np.array(trace.spots))).astype(np.int32)
            cv2.polylines(beside, [spots], False, 0, max(1, round(measures.STROKE_WIDTH_MM * ink.scale)))
    pieces = (*_pieces(pencil, ink, ridges), *_pieces(beside, ink, ridges))
    return [piece for piece in pieces if measures.LETTER_SIZES_MM[0] < piece.longer_side < measures.LETTER_SIZES_MM[1]]


def _pieces(drawn: NDArray[np.uint8], ink: PencilInk, ridges: Ridges) -> Iterator[LetterPiece]:
    """The pieces of what is drawn."""
    count, which = cv2.connectedComponents(drawn, connectivity=measures.PIXEL_NEIGHBOURS)
    piece_of_spot = which[ink.cells(ridges.spots)]
    order = np.argsort(piece_of_spot, kind="stable")
    for group in np.split(order, np.searchsorted(piece_of_spot[order], np.arange(1, count)))[1:]:
        if len(group) > measures.MIN_CRESTS:
            yield LetterPiece(ridges.spots[group])


def letter_likeness(piece: LetterPiece, name: str) -> float:
    """Likeness of strokes to a name, 0 to 1: by the distances between them and the letters' strokes, both of one size;
    upright or leaning."""
    templates = _templates(name.replace("_", ""))
    best = 0.0
    for lean in measures.LETTER_LEANS:
        spots = piece.spots[:: math.ceil(len(piece.spots) / measures.LETTER_SPOTS)].copy()
        spots[:, 0] -= lean * spots[:, 1]
        spots, aspect = _unit_box(spots)
        for template, own_aspect in templates:
            far = np.hypot(*np.moveaxis(spots[:, None] - template[None], -1, 0))
            off = (far.min(axis=1).mean() + far.min(axis=0).mean()) / 2 / measures.LETTER_OFF_SHARE
            odd = math.log(aspect / own_aspect) / measures.LETTER_ASPECT_LOG
            best = max(best, math.exp(-(off**2 + odd**2) / 2))
    return best


@cache
def _templates(name: str) -> list[tuple[Spots, float]]:
    """The strokes of a name as several alphabets of lettering have it, each in a box of size 1, and its aspect."""
    templates = []
    for font in (cv2.FONT_HERSHEY_SIMPLEX, cv2.FONT_HERSHEY_PLAIN):
        (wide, high), base = cv2.getTextSize(name, font, measures.ALPHABET_SIZE, 1)
        canvas = np.zeros((high + 2 * base, wide), np.uint8)
        cv2.putText(canvas, name, (0, high), font, measures.ALPHABET_SIZE, 1)
        row, column = np.nonzero(canvas)
        if len(row):
            spots = np.column_stack([column, -row]).astype(float)
            templates.append(_unit_box(spots[:: math.ceil(len(spots) / measures.LETTER_SPOTS)]))
    return templates


def _unit_box(spots: Spots) -> tuple[Spots, float]:
    """Spots moved and stretched into a box of size 1, and how many times as wide as high they were."""
    low, sides = spots.min(axis=0), np.ptp(spots, axis=0)
    box_sides = np.maximum(sides, measures.MIN_LETTER_SIDE * sides.max())
    return (spots - low) / box_sides, float(box_sides[0] / box_sides[1])


def possible_points(dots: Sequence[Trace], strokes: Sequence[Trace]) -> list[Trace]:
    """Dots, and where there are no dots, ends and crossings of straight strokes."""
    lines = [trace for trace in strokes if trace.kind == LINE]
    figures = [trace.figure for trace in lines]
    ends = [(spot, measures.END_BLUR_MM) for trace in lines for spot in trace.spots]
    crossings = [((crossing.x, crossing.y), measures.CROSSING_BLUR_MM) for first, second in combinations(figures, 2)
                 if (crossing := first.intersection(second)).geom_type == "Point" and not crossing.is_empty]
    spots = [Trace(POINT, (spot,), blur=blur) for spot, blur in (*crossings, *ends)]
    points = list(dots)
    for spot in spots:
        if all(math.dist(spot.spots[0], point.spots[0]) > measures.SAME_DOT_MM for point in points):
            points.append(spot)
    return points


def find_pins(dots: NDArray[np.complex128], pieces: Sequence[LetterPiece], points: Points, unit: float
              ) -> dict[str, int]:
    """The dots that two letters name, by name, and those that are where further points should be, whichever side of the
    paper is up; `points` are where the task has its points, in its own lengths, of which one is usually so many mm.
    Nothing where no two are found, or others may be meant as well."""
    weighed = list[tuple[float, dict[str, int]]]()
    for turn in (1, 1j, -1, -1j):
        weighed += _possible_pins(dots * turn, [piece.turn_by(turn) for piece in pieces], points, unit)
        if pins := _clear_pins(dots, weighed):
            return pins
    return {}


def _clear_pins(dots: NDArray[np.complex128], weighed: Sequence[tuple[float, dict[str, int]]]) -> dict[str, int]:
    """The pins for which most speaks, unless about as much speaks for others."""
    best, pins = max(weighed, key=lambda one: one[0], default=(0.0, dict[str, int]()))

    def is_other(rival: dict[str, int]) -> bool:
        """Whether most of its points lie elsewhere."""
        same = [name for name, place in rival.items() if name in pins
                and abs(dots[place] - dots[pins[name]]) < measures.PIN_NEAR_MM]
        return 2 * len(same) <= len(rival)

    most = max((odds for odds, rival in weighed if is_other(rival)), default=0.0)
    return pins if best > measures.MIN_PIN_ODDS and best - most > measures.CLEAR_PIN_ODDS else {}


def _possible_pins(dots: NDArray[np.complex128], pieces: Sequence[LetterPiece], points: Points, unit: float
                   ) -> Iterator[tuple[float, dict[str, int]]]:
    """Dots that may be those of points, two of which have their letters, and what speaks for them: the letters, and
    how many points have a dot where they should be."""
    likeness: dict[tuple[str, int], float] = {}
    for name, dot, like in _lettered_dots(dots, pieces, points):
        likeness[name, dot] = max(like, likeness.get((name, dot), like))
    names, places = list(points), np.array(list(points.values()))
    for name, dot in likeness:
        for other in {z for z in points.values() if z != points[name]}:
            units = (dots - dots[dot]) / (other - points[name])
            ratios = np.abs(units) / unit
            units = units[(ratios > 1 / measures.MAX_SCALE_RATIO) & (ratios < measures.MAX_SCALE_RATIO)]
            off = np.abs((dots[dot] + units[:, None] * (places - points[name]))[:, :, None] - dots)
            near = np.clip(1 - off.min(axis=2) / measures.PIN_NEAR_MM, 0, None)
            odds = ((2 * near.sum(axis=1) - len(points) - 2) * measures.POINT_ODDS
                    - np.abs(np.angle(units)) / measures.USUAL_TURN_RAD)
            for k in np.argsort(-odds)[:measures.PINS_WEIGHED]:
                pins = {key: int(off[k, i].argmin()) for i, key in enumerate(names) if near[k, i]} | {name: dot}
                letters = [likeness[pin] for pin in pins.items() if pin in likeness]
                if len(letters) > 1:
                    yield float(odds[k]) + sum(letters), pins


def _lettered_dots(dots: NDArray[np.complex128], pieces: Sequence[LetterPiece], points: Points
                   ) -> Iterator[tuple[str, int, float]]:
    """Names, dots that may be theirs, and what their letters speak for that."""
    for piece in pieces:
        far = np.abs(dots[:, None] - piece.places).min(axis=1)
        beside = np.abs(dots - piece.places.mean()) > piece.longer_side / 2
        near = np.flatnonzero((far < measures.LETTER_NEAR_MM) & beside)
        if not len(near):
            continue
        for name in points:
            if (like := letter_likeness(piece, name)) > measures.MIN_LETTER_LIKENESS:
                for dot in near[np.argsort(far[near])][:measures.DOTS_NEAR_LETTER]:
                    yield name, int(dot), like - float(far[dot]) / measures.LETTER_NEAR_MM / 4


SpotArray = NDArray[np.complex128]
IsDrawn = Callable[[complex, complex], bool]


def find_plans(dots: SpotArray, crossings: SpotArray, marks: Sequence[complex], unit: complex,
               is_drawn: IsDrawn) -> list[PlanFrame]:
    """The frame of a plan whose beginning is the first of some marks, followed by those that depend on fewest others,
    with its usual scale and turn by a unit, and after it a rival, if one is about as good; empty if few dots support
    any. `is_drawn` tells whether a line is between two spots: marks without one count little. At a crossing of lines
    there may be an invisible dot. No plan is turned slightly: then its marks are wrong."""
    page, plan = _SpotsSeen(dots, crossings), np.array(marks, np.complex128)
    usual = (page.spots[:, None] - unit * plan).ravel(), np.full(len(page.spots) * len(plan), unit)
    weighed = list[tuple[float, PlanFrame, dict[int, complex]]]()
    own_origins, own_units = _own_frames(dots, plan, unit, is_drawn)
    is_upright = np.isclose(np.angle(own_units / unit), 0.0)
    upright, turned = ((own_origins[which], own_units[which]) for which in (is_upright, ~is_upright))
    for origins, units in (usual, upright, turned):
        for frame in page.best_frames(origins, units, plan):
            for _ in range(measures.PLAN_FITS):
                frame = _fit_frame(frame, unit, page, plan, is_drawn)
            near = page.marks_near(frame, plan)
            support = _support(near, is_drawn, abs(frame.unit)) + _carried_support(
                near, dots, frame.unit * plan, is_drawn)
            spots = {mark.order: mark.spot for mark in near}
            weighed.append((support - _unlikelihood(frame.unit / unit), frame, spots))
    weighed.sort(key=lambda one: -one[0])
    if not weighed or weighed[0][0] < measures.MIN_PLAN_DOTS:
        return []
    best, frame, spots = weighed[0]
    rivals = (rival for score, rival, own_spots in weighed if score > best - measures.CLEAR_PLAN_DOTS
              and 2 * len(own_spots.items() & spots.items()) <= len(own_spots))
    return [frame, *islice(rivals, 1)]


class _SpotsSeen:
    """The spots of a page that may be marks, and what each speaks for that."""

    def __init__(self, dots: SpotArray, crossings: SpotArray):
        self.spots = np.concatenate([dots, crossings])
        self.worth = np.repeat([1.0, measures.CROSSING_DOTS], [len(dots), len(crossings)])

    def best_frames(self, origins: SpotArray, units: SpotArray, marks: SpotArray) -> Iterator[PlanFrame]:
        """The likeliest of some frames: those for which most dots speak, which count less the further off they are."""
        scores = np.zeros(len(origins))
        for first in range(0, len(origins), measures.FRAMES_AT_ONCE):
            piece = slice(first, first + measures.FRAMES_AT_ONCE)
            for order, mark in enumerate(marks):
                nearness = self._nearness(order, (origins[piece] + units[piece] * mark)[:, None])
                scores[piece] += nearness.max(axis=1, initial=0)
        for k in np.argsort(-scores)[:measures.PLANS_WEIGHED]:
            yield PlanFrame(complex(origins[k]), complex(units[k]))

    def _nearness(self, order: int, at: complex | SpotArray) -> NDArray[np.float64]:
        """Value of each spot as an expected mark: later ones may be further off."""
        reach = measures.MARK_NEAR_MM + measures.SLIP_PER_MARK_MM * order
        return self.worth * np.clip(1 - (np.abs(self.spots - at) / reach) ** 2, 0, None)

    def marks_near(self, frame: PlanFrame, marks: SpotArray) -> list[_MarkSeen]:
        """The marks that have a spot where a frame has them."""
        marks_seen = []
        for order, mark in enumerate(marks.tolist()):
            nearness = self._nearness(order, frame.to_sheet(mark))
            if nearness.max(initial=0.0):
                best = int(nearness.argmax())
                is_dot = bool(self.worth[best] == 1.0)
                marks_seen.append(_MarkSeen(order, mark, complex(self.spots[best]), is_dot, float(nearness[best])))
        return marks_seen


@dataclass(frozen=True)
class _MarkSeen:
    """A mark of a plan, its place in their order, and the spot near it: whether that is a dot, and how near, 0..1."""

    order: int
    mark: complex
    spot: complex
    is_dot: bool
    nearness: float


def _own_frames(dots: SpotArray, marks: SpotArray, unit: complex, is_drawn: IsDrawn) -> tuple[SpotArray, SpotArray]:
    """The frames, by their origins and units, in which two dots with a line between are any two marks, which have not
    quite another scale."""
    pairs = [(dot, end) for dot, end in permutations(dots.tolist(), 2) if abs(dot - end) > measures.MIN_TELLING_MM
             and is_drawn(*sorted((dot, end), key=abs))]
    between = [(mark, end) for mark, end in permutations(marks.tolist(), 2)
               if abs(mark - end) * abs(unit) > measures.MIN_TELLING_MM]
    starts, ends = np.array(pairs, np.complex128).reshape(-1, 2).T[:, :, None]
    mark, second = np.array(between, np.complex128).reshape(-1, 2).T[:, None, :]
    ratios = _upright((ends - starts) / (second - mark) / unit)
    wide = np.abs(ratios)
    is_likely = (wide > 1 / measures.MAX_SCALE_RATIO) & (wide < measures.MAX_SCALE_RATIO)
    units = ratios[is_likely] * unit
    return (np.broadcast_to(starts, ratios.shape)[is_likely]
            - units * np.broadcast_to(mark, ratios.shape)[is_likely]), units


def _upright(ratios: SpotArray) -> SpotArray:
    """Turns of plans relative to the mechanism, without slight ones, which are never meant."""
    return np.where(np.abs(np.angle(ratios)) < measures.MIN_PLAN_TURN_RAD, np.abs(ratios), ratios)


def _unlikelihood(ratio: complex) -> float:
    """Number of dots that a plan of this scale and turn needs as evidence."""
    if not np.isclose(np.angle(ratio), 0.0):
        return measures.TURNED_PLAN_DOTS
    return measures.OWN_SCALE_DOTS * min(1.0, abs(math.log(abs(ratio))) / measures.OTHER_SCALE_LOG)


def _support(seen: Sequence[_MarkSeen], is_drawn: IsDrawn, unit: float) -> float:
    """Number of dots that support a frame: those at which lines of the plan end, those of its beginning most, and of
    these the first, with which its scale was chosen."""
    ends = set(_line_ends(seen, is_drawn))
    begun = [mark for mark in seen if mark.order == 0]
    vectors = [end for end in seen if begun and end.is_dot and is_drawn(begun[0].spot, end.spot)
               and abs(end.mark - begun[0].mark) * unit > measures.MIN_TELLING_MM]
    firsts = sum(end.nearness for end in vectors if end.order == 1)
    return measures.FIRST_VECTOR_DOTS * firsts + measures.VECTOR_DOTS * len(vectors) + sum(
        one.nearness * (1.0 if one in ends else measures.LONE_DOTS) for one in seen)


def _carried_support(seen: Sequence[_MarkSeen], dots: SpotArray, vectors: SpotArray, is_drawn: IsDrawn) -> float:
    """Number of dots that support a frame away from its marks, to which lines run from other marks as they should:
    after a mistake, its right consequences. `vectors` are those to the marks. `vectors` are those to the marks."""
    spots, lines = {mark.order: mark.spot for mark in seen}, 0
    for order, vector in enumerate(vectors.tolist()):
        if order in spots:
            continue
        free = dots[~np.isin(dots, list(spots.values()))]
        counts = np.zeros(len(free), int)
        for start, spot in spots.items():
            along = (free - spot) * np.conj(vector - vectors[start]) / max(abs(vector - vectors[start]), MIN_DIVISOR)
            is_on = (np.abs(along.real) > measures.MIN_TELLING_MM) & (
                np.abs(along.imag) < measures.LINE_OFF_MM + measures.LINE_OFF_SLOPE * np.abs(along.real))
            for k in np.flatnonzero(is_on):
                counts[k] += is_drawn(*sorted((complex(free[k]), spot), key=abs))
        if counts.any():
            spots[order] = complex(free[counts.argmax()])
            lines += min(2, int(counts.max()))
    return measures.CARRIED_DOTS * lines


def _line_ends(seen: Sequence[_MarkSeen], is_drawn: IsDrawn) -> list[_MarkSeen]:
    """The marks between which and another a line is drawn."""
    return [one for one in seen if any(abs(one.spot - two.spot) > measures.MIN_LINK_MM and is_drawn(one.spot, two.spot)
                                       for two in seen)]


def _fit_frame(frame: PlanFrame, usual: complex, page: _SpotsSeen, marks: SpotArray, is_drawn: IsDrawn) -> PlanFrame:
    """A frame where its dots have it: upright, unless it is clearly turned, and with the usual scale, if it has about
    that. The marks that come first tell it best, as what goes before shakes the others, and crossings worse than dots;
    those at which no line ends are chance dots."""
    near = page.marks_near(frame, marks)
    if len(ends := _line_ends(near, is_drawn)) > 1:
        near = ends
    if min(len({one.spot for one in near}), len({one.mark for one in near})) < 2:
        return frame
    plan, sheet = np.array([one.mark for one in near]), np.array([one.spot for one in near])
    weights = np.array([one.nearness / ((measures.DOT_ERROR_MM if one.is_dot else measures.CROSSING_ERROR_MM) ** 2
                                        + (measures.SLIP_PER_MARK_MM * one.order) ** 2) for one in near])
    ratio = PlanFrame.least_squares(plan, sheet, weights).unit / usual
    unsure = 1 / float(np.sqrt((weights * np.abs(sheet - np.average(sheet, weights=weights)) ** 2).sum()))
    if abs(np.angle(ratio)) < measures.MIN_PLAN_TURN_RAD:
        ratio = ratio.real
    unit = complex(usual * (1.0 if abs(ratio - 1) < unsure else ratio))
    return PlanFrame(complex(np.average(sheet - unit * plan, weights=weights)), unit)


Marks = Mapping[str, Mapping[str, complex]]


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
    """The corners of the quadrilateral that all pixels lighter than a level fill; None if there is no such figure."""
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
    """Size of the paper in mm, if a whole picture of so many dots per inch has the size of some paper; many stated
    densities are wrong."""
    if not dpi:
        return None
    high, wide = (side / dpi * measures.INCH_MM for side in image.shape)
    sides = max(high, wide), min(high, wide)
    is_paper = any(max(abs(math.log(side / paper_side)) for side, paper_side in zip(sides, paper, strict=True))
                   < measures.PAPER_SIZE_LOG for paper in SIZES.values())
    return (wide, high) if is_paper else None


def lay_paper(image: Grey, dpi: float | None, usual: tuple[float, float]) -> tuple[Warp, bool]:
    """Map from a picture to the paper, and whether the file states the paper's size: else its longer side is that of
    the `usual` paper, and in a slanting view its proportions are so too."""
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
    """Whether lines run along most sides of the paper, as on printed sheets: their content is print, not pencil."""
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


def read_blank_paper(path: Path, marks: Marks, frames: Frames, usual: tuple[float, float]) -> Submission | None:
    """Read a drawing on blank or squared paper, in mm, and the frames of its plans; None if no two lettered points are
    found, or lines are printed about it. Fails with `Refused` if a plan may lie at several places.

    `marks` are the places of the task's marks on its plans, in their units, the beginning of each first; of the
    mechanism its given points. `frames` are those of the task's sheet, whose paper is usually of this size, in mm.
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
    """The only place of a plan; refused if there is no place, or another is as good."""
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
