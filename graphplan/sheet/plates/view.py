"""From plan units to millimetres: each plan's own window onto its panel, and strokes cut off at the panel's edge."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain, pairwise
from typing import Any

import numpy as np

from graphplan.mechanism.model import Number
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.plans import Extent, extend_box
from graphplan.sheet.tolerances import ZERO_SCALE

COARSER, MUCH_COARSER = 2.05, 4.1  # how much smaller the mechanism, and any other plan, may be for auxiliary marks


@dataclass(frozen=True)
class View:
    """One plan on its panel: `scale` in mm per unit, and where the plan's origin falls."""

    rect: Rect
    scale: float
    origin: Spot

    def __call__(self, spot: Spot) -> Spot:
        return self.origin[0] + self.scale * spot[0], self.origin[1] + self.scale * spot[1]

    def spot(self, z: complex) -> Spot:
        """The spot of a place in the complex plane."""
        return self((float(z.real), float(z.imag)))

    def to_plan(self, spot: Spot) -> Spot:
        """The place on the plan of a spot on paper."""
        return (spot[0] - self.origin[0]) / self.scale, (spot[1] - self.origin[1]) / self.scale


def fit_scale(box: Rect, room: Rect) -> float:
    """Units per mm that make a box just fit."""
    return max(box.width / room.width, box.height / room.height)


def _box(extent: Extent, room: Rect, most: float, nice: bool = False) -> Rect:
    """The core's box, made larger mark by mark as long as it does not need more than `most` units per mm."""
    box = extent.core
    for spot in (*extent.extra, *(extent.nice if nice else ())):
        larger = extend_box(box, spot)
        if fit_scale(larger, room) <= most:
            box = larger
    return box


def wanted_box(extent: Extent, coarser: float) -> Rect:
    """The box of what a plan shows if its shape is not told: auxiliary marks that make it not too much larger."""
    most = coarser * max(extent.core.width, extent.core.height) or math.inf
    return _box(extent, Rect(0.0, 0.0, 1.0, 1.0), most)


def whole_plan_scale(extent: Extent, room: Rect) -> float:
    """The mm per unit at which all the marks of a plan just fit."""
    return 1 / (fit_scale(_box(extent, room, math.inf), room) or ZERO_SCALE)


def plan_scale(extent: Extent, room: Rect, coarser: float, lengths: Sequence[Number] = (1,)) -> Fraction:
    """The lengths per mm of a plan in this room, `coarser` for its auxiliary marks at most; round are the scales of the
    quantities that are so many `lengths` long."""
    core = round_up(fit_scale(extent.core, room), lengths)
    box = _box(extent, room, float(core) * coarser if extent.core.width or extent.core.height else math.inf)
    return round_up(fit_scale(box, room), lengths)


def plan_box(extent: Extent, room: Rect, units_per_mm: float) -> Rect:
    """Part of a plan on paper at a scale."""
    return _box(extent, room, units_per_mm, nice=True)


def view(box: Rect, room: Rect, units_per_mm: float) -> View:
    """A window with the box in the middle of its room."""
    (x, y), (cx, cy) = room.centre, box.centre
    scale = 1 / units_per_mm
    return View(room, scale, (x - cx * scale, y - cy * scale))


TURN_DEG = 360.0
MAX_DOT_MM = 3.0  # the radius of a symbol's circle at most: a larger one is a curve
CHORD_TOL_MM = 0.02  # mm that the chords of an arc may be off
ARC_STEP_MM = 0.3  # along an arc that breaks off at letters
LETTER_MARGIN_MM = 0.6  # mm that a line keeps off letters at which it breaks off


def clip_segment(rect: Rect, start: Spot, end: Spot) -> tuple[float, float] | None:
    """The part of a segment inside a rectangle, as two fractions of its length (Liang and Barsky); None if it is
    outside."""
    low, high = 0.0, 1.0
    dx, dy = end[0] - start[0], end[1] - start[1]
    (x, y), steps = start, (-dx, dx, -dy, dy)
    for step, room in zip(steps, (x - rect.left, rect.right - x, y - rect.bottom, rect.top - y), strict=True):
        if step == 0:
            if room < 0:
                return None
        elif step < 0:
            low = max(low, room / step)
        else:
            high = min(high, room / step)
    return (low, high) if low < high else None


def interpolate(start: Spot, end: Spot, t: float) -> Spot:
    """The spot a fraction of the way."""
    return start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])


def clip_item(item: Item, rect: Rect) -> Iterator[Item]:
    """The item as far as it lies in the rectangle: strokes are cut; vectors, figures and letters are left whole.

    The circle of a dot is left out with its middle, a larger one is cut. An arc without a radius, as of the curvature
    at a cusp, is no stroke.
    """
    if isinstance(item, Circle):
        if item.radius > MAX_DOT_MM:
            item = item if rect.inset(*[item.radius] * 4).holds(item.centre) else Arc(
                item.pen, item.layer, item.step, item.centre, item.radius, 0.0, TURN_DEG)
        elif not rect.holds(item.centre):
            return
    if isinstance(item, Arc):
        if not item.radius:
            return
        reach, middle = math.dist(rect.corners[0], rect.corners[2]) / 2, interpolate(*rect.corners[::2], 0.5)
        if item.radius > 2 * reach:
            yield from (run for part in _parts_near(item, middle, reach) for run in _cut(part, rect))
            return
        spots = item.spots(_chord_angle(item))
        if all(map(rect.holds, spots)):
            yield item
            return
        item = Polyline(item.pen, item.layer, item.step, spots)
    if isinstance(item, Polyline | Polygon) and not all(map(rect.holds, item.spots)):
        yield from _cut(item, rect)
    else:
        yield item


def _parts_near(arc: Arc, spot: Spot, reach: float) -> Iterator[Polyline]:
    """The parts of an arc, of a circle larger than that, that may come so near to a spot."""
    far = math.dist(arc.centre, spot)
    if abs(far - arc.radius) > reach:
        return
    towards = math.degrees(math.atan2(spot[1] - arc.centre[1], spot[0] - arc.centre[0]))
    half = math.degrees(math.asin(reach / far))
    first = towards - half + 360.0 * math.ceil((arc.start - towards - half) / 360.0)
    for low in (first, first + 360.0):
        part = replace(arc, start=max(arc.start, low), end=min(arc.end, low + 2 * half))
        if part.start < part.end:
            yield Polyline(arc.pen, arc.layer, arc.step, part.spots(_chord_angle(arc)))


def _chord_angle(arc: Arc) -> float:
    """The degrees between spots of an arc whose chords are as good as the arc."""
    return min(4.0, math.degrees(math.sqrt(8 * CHORD_TOL_MM / arc.radius)))


def _cut(item: Polyline | Polygon, rect: Rect) -> Iterator[Item]:
    """The runs of a chain that lie inside."""
    import shapely  # where nothing is drawn, as for a list of steps, it is not needed

    spots = item.spots if isinstance(item, Polyline) else (*item.spots, item.spots[0])
    inside = shapely.clip_by_rect(shapely.LineString(spots), rect.left, rect.bottom, rect.right, rect.top)
    for run in shapely.get_parts(inside):
        yield Polyline(item.pen.with_fill("none"), item.layer, item.step, tuple(run.coords))


class LetterGaps:
    """Gaps at letters for items in a rectangle, with a margin about the letters."""

    def __init__(self, letters: Iterable[Item], rect: Rect):
        margins = [-LETTER_MARGIN_MM] * 4
        boxes = [letter.box.inset(*margins) for letter in letters if isinstance(letter, Text)]
        self.sides = np.reshape([(box.left, box.bottom, box.right, box.top) for box in boxes], (-1, 4))
        self.rect = rect

    def clip(self, item: Item) -> Iterator[Item]:
        """Clip a line or an arc to the rectangle and off letters, a tint to the rectangle. A shaft breaks off, and so
        does the circle of a ring."""
        import shapely

        if isinstance(item, Polygon):
            parts = shapely.get_parts(shapely.Polygon(item.spots).intersection(self._window))
            yield from (replace(item, spots=tuple(part.exterior.coords[:-1])) for part in parts if part.area)
        elif isinstance(item, Circle):
            arcs = [*self._arcs(Arc(item.pen, item.layer, item.step, item.centre, item.radius, 0.0, TURN_DEG))]
            yield from [item] if any(arc.end - arc.start == TURN_DEG for arc in arcs) else arcs
        elif isinstance(item, Arc):
            yield from self._arcs(item)
        elif isinstance(item, Arrow):
            shares = (clip_segment(box, item.start, item.end) for box in self._about(item.start, item.end))
            yield replace(item, gaps=tuple(filter(None, shares)))
        elif isinstance(item, Polyline):
            inside = shapely.LineString(item.spots).intersection(self._window)
            runs = shapely.get_parts(inside.difference(self._letter_area))
            yield from (replace(item, spots=tuple(run.coords)) for run in runs if run.length)

    def _arcs(self, arc: Arc) -> Iterator[Arc]:
        """The arcs that are left of an arc."""
        count = max(1, math.ceil(math.radians(arc.end - arc.start) * arc.radius / ARC_STEP_MM))
        angles = arc.start + (arc.end - arc.start) * np.arange(count + 1) / count
        turns = np.radians(angles)
        is_held = self._hold(np.add(arc.centre, arc.radius * np.stack([np.cos(turns), np.sin(turns)], axis=1)))
        edges = [0, *(np.flatnonzero(np.diff(is_held)) + 1).tolist(), count + 1]
        for first, end in pairwise(edges):
            if not is_held[first] and end - first > 1:
                yield replace(arc, start=float(angles[first]), end=float(angles[end - 1]))

    @cached_property
    def _window(self) -> Any:
        """The rectangle, as a figure of shapely."""
        import shapely

        return shapely.box(self.rect.left, self.rect.bottom, self.rect.right, self.rect.top)

    @cached_property
    def _letter_area(self) -> Any:
        """Area of the letters with their margins, as a figure of shapely."""
        import shapely

        return shapely.union_all(shapely.box(*self.sides.T))

    def _about(self, start: Spot, end: Spot) -> Iterator[Rect]:
        """Yield the letters about a segment."""
        low, high = np.minimum(start, end), np.maximum(start, end)
        for sides in self.sides[((self.sides[:, :2] <= high) & (self.sides[:, 2:] >= low)).all(axis=1)].tolist():
            yield Rect(*sides)

    def _hold(self, spots: Any) -> Any:
        """Whether each of some spots lies in any letter."""
        inside = (spots[:, None] >= self.sides[:, :2]) & (spots[:, None] <= self.sides[:, 2:])
        return inside.all(axis=2).any(axis=1)


def clip_off_letters(items: Iterable[Item], rect: Rect, letters: Iterable[Item]) -> Iterator[Item]:
    """Clip lines and arcs to a rectangle and off letters, and tints to the rectangle. Shafts break off. Shafts break
    off."""
    yield from chain.from_iterable(map(LetterGaps(letters, rect).clip, items))
