"""Pencil on a straightened sheet: its pixels, and the lines in them, the one with the most crests first.

Crests after C. Steger, "An unbiased detector of curvilinear structures" (1998): where the second derivative across a
line is most negative, the first one vanishes at its middle. Dots fall off to every side and are darker than lines that
cross. A ring is what many crests point at the middle of from all around (the vote of D. H. Ballard, 1981). A hand draws
it beside its middle; where lines run into it they tell its middle better.

Each crest votes for the lines through it in about its own direction (P. Hough); crests in a row are fitted by least
squares, with gaps no wider than a pencil leaves. Crests that bend are carried on as a circle's rim; what is neither
straight nor round, such as letters, is left.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely import LineString, Point, STRtree, box, points

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Flags, Light, Places, Sizes, Spots, median_deviation
from graphplan.marking.scans.printed_ink import print_words
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.marking.traces import Spot, Trace
from graphplan.sheet.plates.display import Rect, Sheet


@dataclass(frozen=True)
class PencilInk:
    """Darkness 0..1 of the pencil, where it is `hidden` by print, `scale` pixels per mm, the sheet's height, and its
    plans' panels, beside which students write."""

    dark: Light
    hidden: Flags
    scale: float
    height: float
    panels: tuple[Rect, ...]

    def is_on_plan(self, spots: Sequence[Spot]) -> bool:
        """Whether something with these spots lies in a panel, in part or whole."""
        figure = LineString(spots) if len(spots) > 1 else Point(spots[0])
        return any(figure.intersects(box(panel.left, panel.bottom, panel.right, panel.top)) for panel in self.panels)

    def pixels(self, spots: Spots) -> Spots:
        """Pixels of spots in mm, as columns and rows; whole numbers are the middles of pixels."""
        return np.column_stack([spots[:, 0], self.height - spots[:, 1]]) * self.scale - 0.5

    def spots(self, pixels: Spots) -> Spots:
        """Spots of pixels, in mm."""
        at = (pixels + 0.5) / self.scale
        return np.column_stack([at[:, 0], self.height - at[:, 1]])

    def are_hidden_or_dark(self, spots: Spots) -> Flags:
        """Whether each spot is hidden or dark: a line may continue there, under print or another line."""
        cells = self.cells(spots)
        return np.asarray(self.hidden[cells] | (self.dark[cells] > measures.MIN_INK_DARKNESS), bool)

    def hidden_within(self, far: float) -> Flags:
        """Whether something so many mm about each pixel is hidden."""
        return np.asarray(cv2.dilate(self.hidden.astype(np.uint8), _disc(far * self.scale)) > 0, bool)

    def cells(self, spots: Spots) -> tuple[Places, Places]:
        """The rows and columns of spots; beside the sheet, those of its edge."""
        high, wide = self.hidden.shape
        at = np.rint(self.pixels(spots)).astype(np.intp)
        np.minimum(np.maximum(at, 0, out=at), (wide - 1, high - 1), out=at)
        return at[:, 1], at[:, 0]


def pencil_ink(image: Light, sheet: Sheet, light: Light, scale: float) -> tuple[PencilInk, PencilInk]:
    """The pencil on the straightened picture of a sheet, whose print is `light` in the same pixels: apart from print
    and from the edge of the paper; and up to the print, where it may be print that is blurred."""
    paper = np.asarray(image / np.maximum(light, measures.MAX_PRINT_LIGHTNESS), np.float32)
    dark = darkness(paper)
    inked = ((light < measures.MAX_PRINT_LIGHTNESS) | print_words(sheet, scale)).astype(np.uint8)
    wide = cv2.morphologyEx(cv2.dilate(inked, _disc(measures.PRINT_RIM_MM * scale)), cv2.MORPH_CLOSE,
                            _disc(measures.PRINT_GAP_MM * scale / 2))
    hidden, edge = np.ones(wide.shape, bool), round(measures.PAPER_EDGE_MM * scale)
    hidden[edge:-edge, edge:-edge] = wide[edge:-edge, edge:-edge] > 0
    apart = PencilInk(np.where(hidden, np.float32(0.0), dark), hidden, scale, sheet.height,
                      tuple(sheet.panels.values()))
    return apart, replace(apart, dark=dark, hidden=inked > 0)


def _disc(radius: float) -> NDArray[np.uint8]:
    """All that is so many pixels about."""
    diameter = 2 * round(radius) + 1
    return np.asarray(cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (diameter, diameter)), np.uint8)


def darkness(paper: Light) -> Light:
    """Darkness of each spot of a sheet relative to the paper about it, 0..1."""
    return np.asarray(np.clip(1 - paper / _paper_lightness(paper), 0, 1), np.float32)


def _paper_lightness(paper: Light) -> Light:
    """Lightness of the bare paper: the lightest near by, smoothed."""
    high, wide = paper.shape
    small = cv2.resize(paper, (wide // measures.LIGHT_PX, high // measures.LIGHT_PX), interpolation=cv2.INTER_AREA)
    bare = cv2.morphologyEx(np.clip(small, 0, 255).astype(np.uint8), cv2.MORPH_CLOSE,
                            np.ones((measures.LIGHT_LINE_PX, measures.LIGHT_LINE_PX), np.uint8))
    even = cv2.GaussianBlur(cv2.medianBlur(bare, measures.LIGHT_REACH_PX), (0, 0),
                            measures.LIGHT_REACH_PX / 4).astype(np.float32)
    return np.asarray(np.maximum(cv2.resize(even, (wide, high)), 1.0), np.float32)


@dataclass(frozen=True)
class Ridges:
    """Spots on crests, in mm, the unit normals there, and how strong each is beside the paper's grain."""

    spots: Spots
    normals: Spots
    strength: Sizes

    def __len__(self) -> int:
        return len(self.spots)

    def select(self, which: Flags | Places) -> Ridges:
        """The ridges at these places."""
        return Ridges(self.spots[which], self.normals[which], self.strength[which])


def clear_ridges(found: Ridges, ink: PencilInk) -> Ridges:
    """Ridges that certainly belong to lines: strong, and with neighbours in a row; the paper's grain is not."""
    strong = found.select(found.strength > measures.CLEAR_SIGMAS)
    cells = ink.cells(strong.spots)
    marked = np.zeros(ink.dark.shape, np.uint8)
    marked[cells] = 1
    _, which, sizes, _ = cv2.connectedComponentsWithStats(marked, connectivity=measures.PIXEL_NEIGHBOURS)
    return strong.select(sizes[which[cells], cv2.CC_STAT_AREA] >= measures.MIN_CREST_ROW_MM * ink.scale)


def find_ridges(ink: PencilInk, fineness: float) -> Ridges:
    """Every crest that may be part of a pencil line, in a picture of so many pixels per mm."""
    smooth = np.asarray(cv2.GaussianBlur(ink.dark, (0, 0), measures.HALF_LINE_MM * ink.scale), np.float32)
    xx, yy, xy = (derivative / 4.0 for derivative in _derivatives(smooth, (2, 0), (0, 2), (1, 1)))
    bend = np.sqrt(((xx - yy) / 2) ** 2 + xy**2)
    strength = bend - (xx + yy) / 2  # minus the lesser eigenvalue
    strength[ink.hidden] = 0.0
    open_ = strength[~ink.hidden][::measures.GRAIN_STRIDE]
    grain = max(median_deviation(open_ - np.median(open_)), measures.MIN_PAPER_GRAIN)
    grain *= max(1.0, measures.COARSE_DPI / measures.INCH_MM / fineness) ** 2
    floor = float(np.median(open_)) + measures.FAINT_SIGMAS * grain
    row, column = np.nonzero(strength > floor)
    values = [derivative[row, column].astype(float) for derivative in (xx, yy, xy)]
    return _crests_at(ink, smooth, row, column, values,
                      (strength[row, column].astype(float) - np.median(open_)) / grain)


def _derivatives(smooth: Light, *orders: tuple[int, int]) -> Iterator[Light]:
    """The derivatives of a picture by columns and rows, of these orders, as OpenCV scales them."""
    return (np.asarray(cv2.Sobel(smooth, cv2.CV_32F, i, j, ksize=3), np.float32) for i, j in orders)


def _crests_at(ink: PencilInk, smooth: Light, row: Places, column: Places,
               second: list[Sizes], strength: Sizes) -> Ridges:
    """Of these pixels, those that the middle of a line runs through."""
    xx, yy, xy = second
    gx, gy = (derivative[row, column].astype(float) / measures.SOBEL_SUM
              for derivative in _derivatives(smooth, (1, 0), (0, 1)))
    angle = 0.5 * np.arctan2(2 * xy, xx - yy) + np.pi / 2  # of the direction in which it falls off fastest
    nx, ny = np.cos(angle), np.sin(angle)
    across = xx * nx**2 + 2 * xy * nx * ny + yy * ny**2
    off = -(gx * nx + gy * ny) / np.minimum(across, -MIN_DIVISOR)
    crest = (across < 0) & (np.abs(off * nx) < measures.CREST_OFF_PX) & (np.abs(off * ny) < measures.CREST_OFF_PX)
    pixels = np.column_stack([column + off * nx, row + off * ny])[crest]
    normals = np.column_stack([nx, -ny])[crest]
    return Ridges(ink.spots(pixels), normals, strength[crest])


def find_dots(ink: PencilInk, smooth: Light, usual: float) -> list[Trace]:
    """All dark spots of the blurred pencil, whose lines are usually so dark, at their centres of darkness."""
    window = 2 * round(2 * measures.HALF_DOT_MM * ink.scale) + 1
    top = (smooth >= cv2.dilate(smooth, np.ones((window, window), np.uint8))) & (smooth > measures.MIN_DOT_DARKNESS)
    row, column = np.nonzero(top)
    xx, yy, xy = (derivative[row, column] for derivative in _derivatives(smooth, (2, 0), (0, 2), (1, 1)))
    middle, spread = (xx + yy) / 2, np.hypot((xx - yy) / 2, xy)
    peaked = (middle + spread < 0) & (np.abs(middle + spread) > measures.MIN_DOT_ROUNDNESS * np.abs(middle - spread))
    peaked |= smooth[row, column] > measures.BLACK_DOT_RATIO * usual
    return [_dot_at(ink, int(i), int(j)) for i, j in zip(row[peaked], column[peaked], strict=True)]


def dots_beyond_strokes(found: Sequence[Trace], drawn: Sequence[Trace], own: Sequence[float], usual: float,
                        darkness: Callable[[Spot], float], least: Sequence[float]) -> Iterator[Trace]:
    """The dots that are more than the strokes on which they lie: by `darkness` at a spot they must be darker, `least`
    times for how many strokes, than the darkest of these is by its `own`, or than is `usual`."""
    lines = STRtree([LineString(trace.spots) for trace in drawn])
    at = points(np.array([dot.spots[0] for dot in found]).reshape(-1, 2))
    count, beside = np.zeros(len(found), int), np.zeros(len(found))
    for dot, line in lines.query(at, "dwithin", measures.DOT_STROKE_MM).T:
        count[dot], beside[dot] = count[dot] + 1, max(beside[dot], own[line])
    for dot, crossed, dark in zip(found, count, beside, strict=True):
        if darkness(dot.spots[0]) > least[min(crossed, len(least) - 1)] * (dark or usual):
            yield dot


def _dot_at(ink: PencilInk, row: int, column: int) -> Trace:
    """A dot about a pixel; it is as unsure as a tenth of its own width."""
    reach = round(measures.DOT_REACH_MM * ink.scale)
    rows = slice(max(0, row - reach), row + reach + 1)
    columns = slice(max(0, column - reach), column + reach + 1)
    patch = ink.dark[rows, columns].astype(float)
    y, x = np.mgrid[rows, columns][:, : patch.shape[0], : patch.shape[1]]
    weight = patch / max(patch.sum(), MIN_DIVISOR)
    at = ink.spots(np.array([[(weight * x).sum(), (weight * y).sum()]]))[0]
    wide = math.sqrt((weight * ((x - column) ** 2 + (y - row) ** 2)).sum() / 2) / ink.scale
    return Trace(POINT, ((float(at[0]), float(at[1])),), blur=wide / measures.DOT_BLUR_SHARE)


def dot_width_darkness(ink: PencilInk, spot: Spot) -> tuple[float, Spot]:
    """Least darkness all around a middle near a spot, without the lightest fifth of the sides, at a rim narrower than
    dots and wider than lines, and the middle for which it is largest; 0 if print hides it."""
    turns = np.arange(measures.RING_PLACES) * (2 * math.pi / measures.RING_PLACES)
    rim = measures.DOT_RIM_MM * np.column_stack([np.cos(turns), np.sin(turns)])
    shifts = np.arange(*measures.DOT_RIM_SHIFTS_MM)
    middles = np.array(spot) + np.stack(np.meshgrid(shifts, shifts), axis=-1).reshape(-1, 1, 2)
    dark = _darkness(ink, middles + rim)
    is_open = (dark < 0).mean(axis=1) < measures.MAX_HIDDEN_RIM_SHARE
    least = np.where(is_open, np.percentile(np.maximum(dark, 0.0), measures.DOT_RIM_PERCENTILE, axis=1), 0.0)
    best = int(least.argmax())
    x, y = middles[best, 0].tolist()
    return float(least[best]), (x, y)


RADII = np.arange(*measures.RING_RADII_MM)


@dataclass(frozen=True)
class Ring:
    """A small circle about a point: its middle and its radius in mm, and how much more of its rim is drawn than of
    what is beside it."""

    middle: Spots
    radius: float
    clear: float


def find_rings(found: Ridges, ink: PencilInk, usual: float) -> list[Ring]:
    """The rings among crests, of a pencil that is usually so dark, the clearest first."""
    looked = [_fit_ring(ink, *candidate, usual) for candidate in _ring_candidates(found)]
    kept_rings: list[Ring] = []
    for ring in sorted((ring for ring in looked if ring), key=lambda ring: -ring.clear):
        if all(np.hypot(*(ring.middle - kept_ring.middle)) > measures.SAME_RING_SHARE * (ring.radius + kept_ring.radius)
               for kept_ring in kept_rings):
            kept_rings.append(ring)
    return kept_rings


def _ring_candidates(found: Ridges) -> Iterator[tuple[Spots, float]]:
    """Middles that crests point at from most sides of all near by, with the radius at which they do."""
    if not len(found):
        return
    wide, high = ((found.spots.max(axis=0) + 2 * RADII[-1]) / measures.RING_CELL_MM).astype(int) + 2
    heard = np.array([_voting_sides(found, radius, wide, high) for radius in RADII])
    best, which = heard.max(axis=0), heard.argmax(axis=0)
    row, column = np.nonzero((best >= measures.MIN_RING_SIDES) & (best >= cv2.dilate(best, np.ones((3, 3), np.uint8))))
    for i, j in zip(column.tolist(), row.tolist(), strict=True):
        yield np.array([i, j]) * measures.RING_CELL_MM - RADII[-1], float(RADII[which[j, i]])


def _voting_sides(found: Ridges, radius: float, wide: int, high: int) -> NDArray[np.uint8]:
    """From how many sides crests so far away point at each place of a grid, the first of which is beyond the sheet."""
    turn = np.arctan2(found.normals[:, 1], found.normals[:, 0]) / (2 * math.pi)
    heard = np.zeros((measures.RING_SIDES, high, wide), bool)
    for sense, back in ((1.0, 0.0), (-1.0, 0.5)):
        side = np.floor((turn + back) * measures.RING_SIDES).astype(int) % measures.RING_SIDES
        column, row = np.floor((found.spots + sense * radius * found.normals + RADII[-1])
                               / measures.RING_CELL_MM).astype(int).T
        for i in (0, 1):
            for j in (0, 1):
                heard[side, row + j, column + i] = True
    return np.asarray(heard.sum(axis=0, dtype=np.uint8))


def _fit_ring(ink: PencilInk, middle: Spots, radius: float, usual: float) -> Ring | None:
    """A ring about a middle, moved to most of its rim; None if there is no ring."""
    turns = np.arange(measures.RING_PLACES) * (2 * math.pi / measures.RING_PLACES)
    directions = np.column_stack([np.cos(turns), np.sin(turns)])
    for _ in range(2):
        nearest, step = measures.RING_SEARCH_MM
        reach = np.arange(max(nearest, radius - 2 * measures.RING_OFF_MM),
                          radius + measures.RING_SEARCH_RIMS * measures.RING_OFF_MM, step)
        dark = _darkness(ink, middle + np.multiply.outer(reach, directions))
        rim = dark.max(axis=0) > measures.RING_PENCIL_SHARE * usual
        if rim.mean() < measures.MIN_RING_RIM_SHARE * measures.MIN_RING_OPEN_SHARE:
            return None
        design = np.column_stack([directions[rim], np.ones(int(rim.sum()))])
        u, v, radius = np.linalg.lstsq(design, reach[dark.argmax(axis=0)][rim], rcond=None)[0].tolist()
        middle = middle + np.clip([u, v], -measures.RING_CELL_MM, measures.RING_CELL_MM)
    if radius < measures.MIN_RING_RADIUS_MM:
        return None
    across = np.array([-1.0, 0.0, 1.0])
    on_rim, off_rim = radius + across * measures.RING_OFF_MM, radius + across[::2] * measures.RING_BESIDE_MM
    rim, beside = (_darkness(ink, middle + np.multiply.outer(radii, directions)).max(axis=0)
                   for radii in (on_rim, off_rim))
    is_open = rim >= 0
    is_drawn = is_open & (rim > measures.RING_PENCIL_SHARE * usual)
    crest = float((beside[is_drawn] < measures.RING_LIGHTER_RATIO * rim[is_drawn]).mean()) if is_drawn.any() else 0.0
    if (is_open.mean() < measures.MIN_RING_OPEN_SHARE or is_drawn.sum() < measures.MIN_RING_RIM_SHARE * is_open.sum()
        or crest < measures.MIN_RING_CREST_SHARE):
        return None
    return Ring(middle, radius, crest)


def _darkness(ink: PencilInk, spots: Spots) -> Light:
    """Darkness at spots; -1 if print hides it."""
    cells = ink.cells(spots.reshape(-1, 2))
    return np.where(ink.hidden[cells], np.float32(-1.0), ink.dark[cells]).reshape(spots.shape[:-1])


def ring_point(ring: Ring, drawn: Sequence[Trace]) -> Trace:
    """The point that a ring marks: its middle, drawn to the lines that run into it."""
    matrix, right = np.eye(2) / measures.RING_BLUR_MM**2, ring.middle / measures.RING_BLUR_MM**2
    for trace in drawn:
        if trace.kind == LINE:
            start, end = np.array(trace.spots[:2])
            direction = (end - start) / (np.hypot(*(end - start)) or 1.0)
            along, normal = (ring.middle - start) @ direction, np.array([-direction[1], direction[0]])
            if -ring.radius < along < np.hypot(*(end - start)) + ring.radius and abs(
                    (ring.middle - start) @ normal) < ring.radius:
                matrix = matrix + np.outer(normal, normal) / measures.RING_LINE_BLUR_MM**2
                right = right + normal * (normal @ start) / measures.RING_LINE_BLUR_MM**2
    (x, y), covariance = np.linalg.solve(matrix, right).tolist(), np.linalg.inv(matrix)
    return Trace(POINT, ((x, y),), blur=math.sqrt(float(np.trace(covariance)) / 2))


@dataclass(frozen=True)
class CrestStretch:
    """From where to where something was drawn, in mm along it, and the share of it that is seen."""

    start: float
    end: float
    seen_share: float

    @property
    def long(self) -> float:
        return self.end - self.start


def crest_stretches(along: Sizes, hidden: Callable[[Sizes], Flags]
              ) -> Iterator[CrestStretch]:
    """The stretches that crests at these places make; where print hides a line, it may well go on."""
    low = float(along.min())
    count = int((float(along.max()) - low) / measures.STROKE_CELL_MM) + 1
    is_drawn = np.zeros(count, bool)
    is_drawn[np.minimum(((along - low) / measures.STROKE_CELL_MM).astype(int), count - 1)] = True
    open_ = ~hidden(np.asarray(low + (np.arange(count) + 0.5) * measures.STROKE_CELL_MM, np.float64)) | is_drawn
    counted = np.cumsum(open_)  # so much of it could have been seen
    marked = np.flatnonzero(is_drawn)
    breaks = np.flatnonzero(np.diff(counted[marked]) > measures.MAX_GAP_MM / measures.STROKE_CELL_MM + 1)
    for first, last in zip([0, *(breaks + 1)], [*breaks, len(marked) - 1], strict=True):
        start, end = int(marked[first]), int(marked[last])
        share = (last - first + 1) / max(1, int(open_[start : end + 1].sum()))
        yield CrestStretch(low + start * measures.STROKE_CELL_MM, low + (end + 1) * measures.STROKE_CELL_MM, share)


@dataclass(frozen=True)
class CrestRow:
    """Crests in a row: a spot amid them, their direction and the normal to its left, and of each crest, how far along
    and off it is."""

    at: Spots
    direction: Spots
    normal: Spots
    which: Places
    along: Sizes
    off: Sizes

    def spots(self, along: Sizes, off: Sizes | float = 0.0) -> Spots:
        """Spots so far along the row and off it."""
        return np.asarray(self.at + np.multiply.outer(along, self.direction)
                          + np.multiply.outer(off + np.zeros(len(along)), self.normal))

    def drawn_stretches(self, ink: PencilInk) -> Iterator[CrestStretch]:
        """The stretches of it that were drawn."""
        return crest_stretches(self.along, lambda along: ink.are_hidden_or_dark(self.spots(along)))

    def in_stretch(self, stretch: CrestStretch) -> Flags:
        """Whether each of a run's crests is in the stretch."""
        return (stretch.start <= self.along) & (self.along <= stretch.end)


def crest_row(found: Ridges, at: Spots, normal: Spots, which: Places) -> CrestRow:
    """Some crests beside a line through a spot, by its normal."""
    direction, out = np.array([normal[1], -normal[0]]), found.spots[which] - at
    return CrestRow(at, direction, normal, which, out @ direction, out @ normal)


def crests_near_line(found: Ridges, left: Places, angle: float, shift: float) -> CrestRow | None:
    """The crests, of those that are left, near the line whose normal has this angle, so many mm from the origin."""
    normal = np.array([math.cos(angle), math.sin(angle)])
    at, which = normal * shift, left
    for reach in measures.ROW_REACHES_MM:
        near = np.abs((found.spots[which] - at) @ normal) < reach
        near &= np.abs(found.normals[which] @ normal) > measures.MIN_NORMAL_COSINE
        if near.sum() < measures.MIN_CRESTS:
            return None
        chosen = which[near]
        if which is left:  # a line turns by no more than a few times its width
            which = left[np.abs((found.spots[left] - at) @ normal) < 4 * reach]
        at = found.spots[chosen].mean(axis=0)
        spread = found.spots[chosen] - at
        normal = np.linalg.eigh(spread.T @ spread)[1][:, 0]
    return crest_row(found, at, normal, chosen)


def line_trace(crests: CrestRow, stretch: CrestStretch) -> Trace:
    """A run of a row as its two ends; it is as unsure as its crests are rough, the less the longer it is."""
    on = crests.in_stretch(stretch)
    slope, level = np.polyfit(crests.along[on], crests.off[on], 1)
    ends = np.array([stretch.start, stretch.end])
    (x, y), (u, v) = crests.spots(ends, slope * ends + level).tolist()
    rough = float(np.std(crests.off[on] - slope * crests.along[on] - level))
    return Trace(LINE, ((x, y), (u, v)), blur=rough / math.sqrt(max(1.0, stretch.long)))


def is_bent(crests: CrestRow, stretch: CrestStretch) -> bool:
    """Whether the crests of a run follow a bow rather than a line."""
    on = crests.in_stretch(stretch)
    along, off = crests.along[on] - crests.along[on].mean(), crests.off[on]
    bow = np.polyfit(along, off, 2)
    sag = abs(bow[0]) * (stretch.long / 2) ** 2
    straight, bent = (np.std(off - np.polyval(fit, along)) for fit in (np.polyfit(along, off, 1), bow))
    return bool(sag > measures.MIN_SAG_MM and bent < measures.BOW_RATIO * straight)


@dataclass(frozen=True)
class Rim:
    """A circle, and its run, in mm along it from the side `zero`, an angle; with its crests and how rough they are."""

    centre: Spots
    radius: float
    zero: float
    stretch: CrestStretch
    which: Places
    rough: float

    def trace(self) -> Trace:
        """The rim as spots of it, as far as it was drawn."""
        count = max(measures.MIN_RIM_SPOTS,
                    math.ceil(math.degrees(self.stretch.long / self.radius) / measures.RIM_SPOTS_DEGREES))
        spots = rim_spots(self.centre, self.radius, self.zero, np.linspace(self.stretch.start, self.stretch.end, count))
        blur = self.rough / math.sqrt(max(1.0, self.stretch.long))
        return Trace(CIRCLE, tuple((float(x), float(y)) for x, y in spots), blur=blur)


def rim_spots(centre: Spots, radius: float, zero: float, along: Sizes) -> Spots:
    """Spots of a circle, so many mm along it from the side `zero`."""
    turns = zero + along / radius
    return np.asarray(centre + radius * np.column_stack([np.cos(turns), np.sin(turns)]))


def angles_from(out: Spots, zero: float) -> Sizes:
    """Angles of spots about a centre, from the side `zero`."""
    return np.asarray((np.arctan2(out[:, 1], out[:, 0]) - zero + math.pi) % (2 * math.pi) - math.pi)


def grow_rim(found: Ridges, left: Places, seed: Places, ink: PencilInk) -> Rim | None:
    """The circle that some crests begin and others, of those that are left, continue; None if they make no circle."""
    rim, chosen = None, seed
    for _ in range(measures.RIM_ROUNDS):
        centre, radius = fit_circle(found.spots[chosen])
        if not measures.MIN_RIM_RADIUS_MM < radius < measures.MAX_RIM_RADIUS_MM:
            return None
        middle = found.spots[seed].mean(axis=0) - centre
        larger = _crests_on_circle(found, left, centre, radius, math.atan2(middle[1], middle[0]), ink)
        if larger is None or (rim is not None and len(larger.which) <= len(rim.which)):
            break
        rim, chosen = larger, larger.which
    return (rim if rim and rim.rough < measures.MAX_RIM_ROUGHNESS_MM
            and rim.stretch.seen_share > measures.MIN_STROKE_SHARE
            else None)


def fit_circle(spots: Spots) -> tuple[Spots, float]:
    """The centre and the radius of the circle of least squares (I. Kåsa, 1976)."""
    middle = spots.mean(axis=0)
    x, y = (spots - middle).T
    (u, v, w), *_ = np.linalg.lstsq(np.column_stack([2 * x, 2 * y, np.ones(len(x))]), x**2 + y**2, rcond=None)
    return middle + np.array([u, v]), math.sqrt(max(w + u**2 + v**2, 0.0))


def _crests_on_circle(found: Ridges, left: Places, centre: Spots, radius: float, zero: float,
                      ink: PencilInk) -> Rim | None:
    """The run of crests on a circle that has this side of it."""
    out = found.spots[left] - centre
    far = np.hypot(out[:, 0], out[:, 1])
    square = np.abs((out * found.normals[left]).sum(axis=1)) > measures.MIN_NORMAL_COSINE * far
    near = (np.abs(far - radius) < measures.RIM_REACH_MM) & square
    if not near.any():
        return None
    along = angles_from(out[near], zero) * radius
    stretches = crest_stretches(along, lambda at: ink.are_hidden_or_dark(rim_spots(centre, radius, zero, at)))
    central = [stretch for stretch in stretches if stretch.start <= 1.0 and stretch.end >= -1.0]
    if not central:
        return None
    stretch = max(central, key=lambda stretch: stretch.long)
    on = (stretch.start <= along) & (along <= stretch.end)
    return Rim(centre, radius, zero, stretch, left[near][on], float(np.std(far[near][on] - radius)))


class Vote:
    """Hough's accumulator: angles of normals by distances from the origin."""

    def __init__(self, found: Ridges):
        self.count = round(math.pi / measures.VOTE_TURN_RAD)
        self.reach = int(np.hypot(*np.abs(found.spots).max(axis=0, initial=1.0)) / measures.VOTE_SHIFT_MM) + 2
        angle = np.arctan2(found.normals[:, 1], found.normals[:, 0])
        unsure = np.arange(-measures.NORMAL_CELLS, measures.NORMAL_CELLS + 1)
        cells = np.rint(angle / measures.VOTE_TURN_RAD).astype(int)[:, None] + unsure
        turn = cells % self.count * measures.VOTE_TURN_RAD
        shift = found.spots[:, :1] * np.cos(turn) + found.spots[:, 1:] * np.sin(turn)
        level = np.rint(shift / measures.VOTE_SHIFT_MM).astype(int) + self.reach
        self.cells = cells % self.count * (2 * self.reach + 1) + level
        self.weight = np.minimum(found.strength, measures.MAX_CREST_VOTES)
        self.votes = self._count(np.arange(len(found)))
        self.best = 0

    def peak(self) -> tuple[float, float] | None:
        """The angle and the distance that most crests vote for; None where there are too few."""
        self.best = int(self.votes.argmax())
        if self.votes[self.best] < measures.MIN_LINE_MM * measures.VOTES_PER_MM:
            return None
        turn, level = divmod(self.best, 2 * self.reach + 1)
        return turn * measures.VOTE_TURN_RAD, (level - self.reach) * measures.VOTE_SHIFT_MM

    def remove(self, which: Places) -> None:
        """Take crests away."""
        self.votes -= self._count(which)

    def forget(self) -> None:
        """Do not look here again."""
        turn, level = divmod(self.best, 2 * self.reach + 1)
        for i in (-1, 0, 1):
            cell = (turn + i) % self.count * (2 * self.reach + 1) + level
            self.votes[max(0, cell - 1) : cell + 2] = measures.SILENCED_VOTES

    def _count(self, which: Places) -> Sizes:
        cells = self.cells[which]
        weight = np.repeat(self.weight[which], cells.shape[1])
        votes = np.bincount(cells.ravel(), weight, self.count * (2 * self.reach + 1))
        return np.asarray(votes, np.float64)


def find_strokes(found: Ridges, ink: PencilInk) -> list[Trace]:
    """The lines and rims among crests, the longest lines first; what is taken is no longer there."""
    vote, is_left, traces = Vote(found), np.ones(len(found), bool), list[Trace]()
    for _ in range(measures.MAX_LINES):
        peak = vote.peak()
        if peak is None:
            break
        crests = crests_near_line(found, np.flatnonzero(is_left), *peak)
        for stretch in crests.drawn_stretches(ink) if crests else ():
            assert crests
            crests_taken = crests.which[crests.in_stretch(stretch)]
            crests_taken = crests_taken[is_left[crests_taken]]
            if (stretch.long >= measures.MIN_LINE_MM and stretch.seen_share >= measures.MIN_STROKE_SHARE
                and len(crests_taken) >= measures.MIN_CRESTS):
                rim = grow_rim(found, np.flatnonzero(is_left), crests_taken, ink) if is_bent(crests, stretch) else None
                if rim and rim.stretch.long < measures.RIM_RATIO * stretch.long:
                    rim = None  # a hand that wobbles bends lines, too, but no further than they go
                traces.append(rim.trace() if rim else line_trace(crests, stretch))
                taken = rim.which if rim else crests_taken
                is_left[taken] = False
                vote.remove(taken)
        vote.forget()
    return traces
