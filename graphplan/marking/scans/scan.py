"""A scan or a photo of a handout, read: a page that tells what was drawn on it, and can be asked whether something is
drawn near where it belongs.

Faint lines, of which there is too little to be found in the whole page, are found where they are expected.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import LineString, STRtree, points

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.scans import measures, pencil_pixels
from graphplan.marking.scans.image import Flags, Grey, Light, Places, Sizes, read_pictures, require_contrast, shrink
from graphplan.marking.scans.pencil_pixels import (
    PencilInk,
    Ridges,
    Ring,
    clear_ridges,
    dot_width_darkness,
    dots_beyond_strokes,
    find_dots,
    find_ridges,
    find_rings,
    pencil_ink,
    ring_point,
)
from graphplan.marking.scans.printed_ink import print_picture
from graphplan.marking.scans.straighten import RegisteredWarp, Warp, straighten
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.marking.traces import Frames, Spot, Submission, Trace, first_spots
from graphplan.sheet.plates.display import Sheet

SHOWS = frozenset({LINE, CIRCLE})  # dots are found too, but not every point of a drawing is a dot


def read_scan(path: Path, printed: Sheet, frames: Frames, code: int | None = None) -> Submission:
    """Read a drawing on a printed page, in mm of it.

    `code` is that of its marks, and `frames` says where its plans lie, which is passed on.

    Fails with `Refused` where the file is no picture, or not one of this page.
    """
    refused: Refused | None = None
    for image in read_pictures(path):
        try:
            return read_picture(image, f"{path}", printed, frames, code)
        except Refused as this:
            refused = this
    raise refused or Refused(f"{path}", "the document has no pages", "hand in a scan of the sheet")


def read_picture(image: Grey, name: str, printed: Sheet, frames: Frames, code: int | None = None) -> Submission:
    """Read a drawing in a picture, in which dots alone are specks; fails as `read_scan`."""
    page = _pencil_page(image, printed, code, name)
    if all(trace.kind == POINT for trace in page.traces):
        return Submission(Path(name).name, (), shows=SHOWS, frames=frames)
    return Submission(Path(name).name, page.traces, shows=SHOWS, frames=frames, page=page)


def _pencil_page(image: Grey, printed: Sheet, code: int | None, name: str) -> PencilPage:
    """Read the pencil strokes of one picture of a page."""
    require_contrast(image, name)
    scale = min(measures.PAGE_PX_PER_MM, (measures.MAX_PAGE_PX / (printed.width * printed.height)) ** 0.5)
    light = print_picture(printed, scale)
    straight, registered = _straighten_either_way(shrink(image, measures.MAX_PAGE_PX), printed, light, scale, code,
                                                  name)
    pencil, up_to_print = pencil_ink(straight, printed, light, scale)
    ridges = find_ridges(pencil, registered.warp.fineness())
    return PencilPage(pencil, up_to_print, ridges, registered.error, registered.warp)


def _straighten_either_way(image: Grey, printed: Sheet, light: Light, scale: float, code: int | None, name: str
              ) -> tuple[Light, RegisteredWarp]:
    """The picture laid over the sheet, as it is or mirrored, as a sheet is that was scanned from its back."""
    try:
        return straighten(image, printed, light, scale, code, name)
    except Refused as refused:
        with suppress(Refused):
            straight, registered = straighten(np.ascontiguousarray(image[:, ::-1]), printed, light, scale, code, name)
            mirror = np.array([[-1, 0, image.shape[1] - 1], [0, 1, 0], [0, 0, 1]], float)
            return straight, replace(registered, warp=replace(registered.warp, plane=mirror @ registered.warp.plane))
        raise refused


@dataclass(frozen=True)
class PencilPage:
    """The pencil on a page, the same `up_to_print`, its crests, how unsure their places are, as a standard deviation in
    mm, and how the picture shows the sheet."""

    ink: PencilInk
    up_to_print: PencilInk
    ridges: Ridges
    error: float
    warp: Warp

    @cached_property
    def traces(self) -> tuple[Trace, ...]:
        """Everything that is found without knowing what is expected, but what may be parts of letters."""
        alone = [dot for dot in self._darker_dots(measures.SURE_DOT_RATIOS)
                 if (dot in self._wide_dots and self._is_on_stroke(dot)) or self._stands_alone(dot)]
        # a hand that marks points by dots rings none
        dotted = 2 * sum(map(self._has_stroke_through, self._rings)) < len(alone)
        ringed = [dot for dot, ring in zip(self._ring_points, self._rings, strict=True) if not dotted
                  and self._is_no_letter(ring)]
        return tuple(self._with_page_error(trace) for trace in (*self.strokes, *ringed, *alone))

    def visible_share(self, kind: str, spots: Sequence[Spot], within: float) -> float | None:
        """The share of some spots, of those that print leaves open, that have a crest, or a dot, so near; None where
        it leaves hardly any."""
        far = self._distances[kind == POINT][self.ink.cells(np.array(spots))]
        open_distances = far[far >= 0]
        return (float((open_distances < within).mean())
                if len(open_distances) > (1 - measures.MAX_HIDDEN_SHARE) * len(far) else None)

    def find_line(self, one: Spot, two: Spot, within: float, angle: float = 4.0) -> Trace | None:
        """The line with most crests, no further than `within` mm from the middle of an expected one, and turned by no
        more than this angle, in degrees."""
        ends = np.array([one, two], float)
        long = math.dist(one, two)
        direction = (ends[1] - ends[0]) / long
        normal, middle = np.array([-direction[1], direction[0]]), ends.mean(axis=0)
        out = self.ridges.spots - middle
        along, off = out @ direction, out @ normal
        steep = math.tan(math.radians(angle))
        near = np.flatnonzero((np.abs(along) < long / 2 + measures.BEYOND_ENDS_MM)
                              & (np.abs(off) < within + np.abs(along) * steep)
                              & (np.abs(self.ridges.normals @ normal)
                                 > math.cos(math.radians(measures.CREST_TURN_DEGREES + angle))))
        lying = _align(along[near], off[near], self.ridges.strength[near], within, steep)
        if lying is None:
            return None
        slope, level, which = lying
        turned = math.atan(slope)
        aside = normal * math.cos(turned) - direction * math.sin(turned)
        crests = pencil_pixels.crest_row(self.ridges, middle + level * normal, aside, near[which])
        stretch = _whole_stretch(crests, self.ink, long / 2)
        return None if stretch is None else self._with_page_error(pencil_pixels.line_trace(crests, stretch))

    def find_arc(self, centre: Spot, radius: float, spots: Sequence[Spot], within: float) -> Trace | None:
        """The rim with most crests, near spots of an expected one, no further than `within` mm from it."""
        middle, at = np.array(centre), np.asarray(spots, float)
        aim = math.atan2(*(at.mean(axis=0) - middle)[::-1])
        out = self.ridges.spots - middle
        far = np.maximum(np.hypot(out[:, 0], out[:, 1]), MIN_DIVISOR)
        along = pencil_pixels.angles_from(out, aim) * radius
        reach = np.abs(pencil_pixels.angles_from(at - middle, aim)).max() * radius + measures.BEYOND_ENDS_MM
        square = (np.abs((out * self.ridges.normals).sum(axis=1)) > math.cos(math.radians(measures.CREST_TURN_DEGREES))
                  * far)
        near = np.flatnonzero((np.abs(far - radius) < within) & (np.abs(along) < reach) & square)
        steep = within / max(reach, within)
        lying = _align(along[near], far[near] - radius, self.ridges.strength[near], within, steep)
        if lying is None:
            return None
        slope, level, which = lying
        rim_crests = near[which]
        if np.ptp(along[rim_crests]) > math.radians(measures.MIN_CENTRE_DEGREES) * radius:
            rim = pencil_pixels.grow_rim(self.ridges, near, rim_crests, self.ink)
        else:
            rim = _short_arc(self, middle, radius, aim, along[rim_crests], far[rim_crests] - radius, slope, level)
        return None if rim is None or rim.stretch.long < measures.MIN_ARC_MM else self._with_page_error(rim.trace())

    def find_dot(self, spot: Spot, within: float) -> Trace | None:
        """The dot nearest to where one is expected; beside print rather a dot there that is wider than print."""
        off = np.abs(self._possible_dot_spots - complex(*spot))
        nearest = self.possible_dots[int(off.argmin())] if off.min(initial=math.inf) < within else None
        return self._dot_at_print(spot) or nearest

    def _dot_at_print(self, spot: Spot) -> Trace | None:
        """The dot at a spot that print hides, in part or whole: it is darker all around than print is beside itself."""
        if not self._picture_about(self.ink.hidden, spot, measures.HALF_DOT_MM).any():
            return None
        dark, middle = dot_width_darkness(self.up_to_print, spot)
        if dark < measures.DOT_AT_PRINT_RATIO * self._clear_darkness:
            return None
        return self._with_page_error(Trace(POINT, (middle,), blur=measures.DOT_ERROR_MM))

    @cached_property
    def _distances(self) -> list[Light]:
        """Distance in mm of each pixel from the next strong crest, and from the next dot; -1 if print hides it, or half
        of the dot."""
        maps, at_dots = [], self._possible_dot_spots.view(float).reshape(-1, 2)
        for spots, half in ((self.ridges.spots[self.ridges.strength > measures.CLEAR_SIGMAS], 0.0),
                            (at_dots, measures.HALF_DOT_MM)):
            bare = np.ones(self.ink.dark.shape, np.uint8)
            bare[self.ink.cells(spots)] = 0
            far = np.asarray(cv2.distanceTransform(bare, cv2.DIST_L2, 3), np.float32) / np.float32(self.ink.scale)
            maps.append(np.where(self.ink.hidden_within(half), np.float32(-1.0), far))
        return maps

    @cached_property
    def strokes(self) -> list[Trace]:
        """The lines and rims; beyond the panels long ones alone, as others are words."""
        return [trace for trace in pencil_pixels.find_strokes(self.clear_ridges, self.ink)
                if trace.figure.length > measures.MIN_LONG_STROKE_MM or self.ink.is_on_plan(trace.spots)]

    @cached_property
    def _blurred_pencil(self) -> Light:
        """The pencil blurred by half a dot."""
        return np.asarray(cv2.GaussianBlur(self.ink.dark, (0, 0), measures.HALF_DOT_MM * self.ink.scale), np.float32)

    @cached_property
    def _stroke_darkness(self) -> list[float]:
        """Darkness of each blurred stroke along its crest, without parts under print."""
        darknesses, window = [], 2 * round(measures.DARKNESS_REACH_MM * self.ink.scale) + 1
        crests = cv2.dilate(self._blurred_pencil, np.ones((window, window), np.uint8))
        for trace in self.strokes:
            ends = np.array(trace.spots)
            along = np.linspace(*measures.DARKNESS_SHARES, measures.DARKNESS_PLACES)[:, None]
            at = ends[0] + along * (ends[1] - ends[0]) if trace.kind == LINE else ends
            rows, columns = self.ink.cells(at)
            dark = crests[rows, columns][~self.ink.hidden[rows, columns]]
            darknesses.append(max(measures.MIN_DOT_DARKNESS, float(np.median(dark))) if len(dark)
                              else self._clear_darkness)
        return darknesses

    @property
    def _usual_darkness(self) -> float:
        """Median darkness of the blurred strokes."""
        return float(np.median(self._stroke_darkness)) if self.strokes else 1.0

    @cached_property
    def _pieces_beside_strokes(self) -> tuple[NDArray[np.int32], Sizes]:
        """Pieces beside all long strokes, and their sizes in mm; mostly letters."""
        dark = np.asarray(self._blurred_pencil > self._usual_darkness / 2, np.uint8)
        for line in self._long_strokes.geometries:
            spots = np.rint(self.ink.pixels(np.array(line.coords))).astype(np.int32)
            cv2.polylines(dark, [spots], False, 0, max(1, round(measures.STROKE_WIDTH_MM * self.ink.scale)))
        _, which, sizes, _ = cv2.connectedComponentsWithStats(dark, connectivity=measures.PIXEL_NEIGHBOURS)
        large = sizes[:, [cv2.CC_STAT_WIDTH, cv2.CC_STAT_HEIGHT]].max(axis=1) / self.ink.scale
        large[0] = 0.0
        return np.asarray(which, np.int32), np.asarray(large, np.float64)

    def _piece_size(self, spot: Spot, reach: float) -> float:
        """Size of the largest piece near a spot, in mm."""
        which, large = self._pieces_beside_strokes
        return float(large[self._picture_about(which, spot, reach)].max())

    def _darkness(self, spot: Spot) -> float:
        """Darkness near a spot."""
        return float(self._picture_about(self._blurred_pencil, spot, measures.DOT_SEARCH_MM).max())

    def _darker_dots(self, least: Sequence[float]) -> list[Trace]:
        """The dots that are so much darker than their strokes, or wider."""
        darker = dots_beyond_strokes(self._dark_dots, self.strokes, self._stroke_darkness, self._usual_darkness,
                                     self._darkness, least)
        return list(dict.fromkeys((*darker, *self._wide_dots)))

    def _stands_alone(self, dot: Trace) -> bool:
        """Whether a dot is no part of a letter, and no rest of print."""
        return (not self._picture_about(self.ink.hidden, dot.spots[0], measures.DOT_CLEAR_MM).any()
                and self._piece_size(dot.spots[0], measures.DOT_SEARCH_MM) < measures.MAX_DOT_MM)

    def _is_on_stroke(self, dot: Trace) -> bool:
        """Whether a dot lies on a long stroke, as no part of a letter does."""
        return bool(len(self._long_strokes.query(points(dot.spots[0]), "dwithin", measures.DOT_STROKE_MM)))

    @cached_property
    def _wide_dots(self) -> list[Trace]:
        """The dots that are dark all around their middles, as lines are not, nor where lines cross."""
        return [dot for dot in self._dark_dots
                if dot_width_darkness(self.ink, dot.spots[0])[0] > measures.WIDE_DOT_SHARE * self._clear_darkness]

    def _picture_about(self, picture: NDArray[Any], spot: Spot, reach: float) -> NDArray[Any]:
        """The piece of a picture about a spot, so many mm to each side."""
        (row,), (column,) = self.ink.cells(np.array([spot]))
        far = math.ceil(reach * self.ink.scale)
        return picture[max(0, row - far) : row + far + 1, max(0, column - far) : column + far + 1]

    @cached_property
    def _possible_dot_spots(self) -> NDArray[np.complex128]:
        return first_spots(self.possible_dots)

    @cached_property
    def possible_dots(self) -> list[Trace]:
        """The dots that may be points."""
        return [self._with_page_error(dot)
                for dot in (*self._ring_points, *self._darker_dots(measures.FAINT_DOT_RATIOS))]

    @cached_property
    def _ring_points(self) -> list[Trace]:
        """The points that are ringed."""
        return [ring_point(ring, self.strokes) for ring in self._rings]

    @cached_property
    def _rings(self) -> list[Ring]:
        return [ring for ring in find_rings(self.clear_ridges, self.ink, self._clear_darkness)
                if self.ink.is_on_plan([tuple(ring.middle.tolist())]) or self._has_stroke_through(ring)]

    @cached_property
    def _clear_darkness(self) -> float:
        """Darkness of the pencil at clear crests."""
        dark = self.ink.dark[self.ink.cells(self.clear_ridges.spots)]
        return float(np.median(dark)) if len(dark) else 1.0

    @cached_property
    def clear_ridges(self) -> Ridges:
        return clear_ridges(self.ridges, self.ink)

    def _is_no_letter(self, ring: Ring) -> bool:
        """Whether a ring is no part of a letter: a stroke runs through it, or else it stands alone where others mark
        points by rings."""
        return self._has_stroke_through(ring) or (self._marks_points_by_rings and self._piece_size(
            (float(ring.middle[0]), float(ring.middle[1])),
            ring.radius + measures.HALF_RIM_MM) < 2 * ring.radius + measures.LETTER_EXCESS_MM)

    @cached_property
    def _marks_points_by_rings(self) -> bool:
        """Whether strokes run through most rings, as they do where a hand marks points by rings."""
        return 2 * sum(map(self._has_stroke_through, self._rings)) > len(self._rings)

    def _has_stroke_through(self, ring: Ring) -> bool:
        """Whether a long stroke runs through the middle of a ring."""
        return bool(len(self._long_strokes.query(points(ring.middle), "dwithin", ring.radius / 2)))

    @cached_property
    def _long_strokes(self) -> STRtree:
        """The strokes that are too long for a letter's."""
        lines = (LineString(trace.spots) for trace in self.strokes)
        return STRtree([line for line in lines if line.length > measures.MIN_LONG_STROKE_MM])

    @cached_property
    def _dark_dots(self) -> list[Trace]:
        """Dark dots outside rings; beyond the panels on strokes alone."""
        return [dot for dot in find_dots(self.ink, self._blurred_pencil, self._usual_darkness) if all(
            math.dist(dot.spots[0], ring.middle) > ring.radius + measures.HALF_DOT_MM for ring in self._rings)
            and (self.ink.is_on_plan(dot.spots) or self._is_on_stroke(dot))]

    def _with_page_error(self, trace: Trace) -> Trace:
        """Add the uncertainty of the page's own place to that of a trace."""
        return replace(trace, blur=math.hypot(trace.blur, self.error))


def _align(along: Sizes, off: Sizes, strength: Sizes, within: float,
           steep: float) -> tuple[float, float, Places] | None:
    """The slope and the level, at most so steep and so far off, that most crests share, and which do."""
    if len(along) < measures.MIN_CRESTS:
        return None
    reach = max(float(np.abs(along).max()), 1.0)
    slopes = np.linspace(-steep, steep, 2 * math.ceil(steep * reach / measures.FAINT_CELL_MM) + 1)
    count = math.ceil(within / measures.FAINT_CELL_MM)
    cells = np.rint((off - np.outer(slopes, along)) / measures.FAINT_CELL_MM).astype(int) + count
    inside = (cells >= 0) & (cells <= 2 * count)
    flat = (np.arange(len(slopes))[:, None] * (2 * count + 1) + cells)[inside]
    weight = np.broadcast_to(np.minimum(strength, measures.MAX_CREST_STRENGTH), cells.shape)[inside]
    counted = np.bincount(flat, weight, len(slopes) * (2 * count + 1)).reshape(len(slopes), -1)
    votes = np.asarray(counted, np.float64)
    votes[:, 1:-1] += (votes[:, :-2] + votes[:, 2:]) / 2
    best, cell = divmod(int(votes.argmax()), votes.shape[1])
    slope, level = float(slopes[best]), (cell - count) * measures.FAINT_CELL_MM
    which = np.flatnonzero(np.abs(off - slope * along - level) < measures.FAINT_REACH_MM)
    for _ in range(2):
        if len(which) < measures.MIN_CRESTS or np.ptp(along[which]) < 1.0:
            return None
        slope, level = (float(value) for value in np.polyfit(along[which], off[which], 1))
        which = np.flatnonzero(np.abs(off - slope * along - level) < measures.FAINT_REACH_MM)
    return slope, level, which


def _whole_stretch(crests: pencil_pixels.CrestRow, ink: PencilInk, half: float) -> pencil_pixels.CrestStretch | None:
    """All the stretches of a row between the expected ends as one, where enough of it is seen."""
    parts_seen = [stretch for stretch in crests.drawn_stretches(ink)
                  if stretch.seen_share >= measures.MIN_FAINT_SHARE and stretch.long >= 1.0 and stretch.start < half
                  and stretch.end > -half]
    if sum(stretch.long for stretch in parts_seen) < measures.MIN_FAINT_MM:
        return None
    return pencil_pixels.CrestStretch(parts_seen[0].start, parts_seen[-1].end, measures.MIN_FAINT_SHARE)


def _short_arc(page: PencilPage, centre: Sizes, radius: float, aim: float, along: Sizes, off: Sizes, slope: float,
               level: float) -> pencil_pixels.Rim | None:
    """A short arc: it is as far off the expected one, and as askew, as its crests are."""
    turned = math.atan(slope)
    side = np.array([math.cos(aim), math.sin(aim)])
    across = np.array([-side[1], side[0]])
    moved_centre = centre + across * radius * math.sin(turned) + side * radius * (1 - math.cos(turned))

    def are_hidden(at: Sizes) -> Flags:
        return page.ink.are_hidden_or_dark(pencil_pixels.rim_spots(centre, radius + level, aim, at))

    stretches = pencil_pixels.crest_stretches(along, are_hidden)
    clear_stretches = [stretch for stretch in stretches if stretch.seen_share >= measures.MIN_FAINT_SHARE]
    if not clear_stretches:
        return None
    stretch = max(clear_stretches, key=lambda stretch: stretch.long)
    rough = float(np.std(off - slope * along - level))
    return pencil_pixels.Rim(moved_centre, radius + level, aim, stretch, np.arange(len(along)), rough)
