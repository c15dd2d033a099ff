"""Cutting strokes off at the edge of a panel."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace

from graphplan.sheet.plates.display import Arc, Circle, Item, Polygon, Polyline, Rect, Spot

OFF = 0.02  # mm that the chords of an arc may be off
AIR = 0.6  # mm that a line keeps off letters at which it breaks off


def segment(rect: Rect, start: Spot, end: Spot) -> tuple[float, float] | None:
    """The part of a segment inside a rectangle, as two fractions of its length (Liang and Barsky), or none."""
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


def between(start: Spot, end: Spot, t: float) -> Spot:
    """The spot a fraction of the way."""
    return start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])


def clipped(item: Item, rect: Rect) -> Iterator[Item]:
    """The item as far as it lies in the rectangle: strokes are cut; vectors, figures and letters are left whole.

    A circle is left out with its middle. An arc without a radius, as of the curvature at a cusp, is no stroke.
    """
    if isinstance(item, Circle) and not rect.holds(item.centre):
        return
    if isinstance(item, Arc):
        if not item.radius:
            return
        spots = item.spots(min(4.0, math.degrees(math.sqrt(8 * OFF / item.radius))))
        if all(map(rect.holds, spots)):
            yield item
            return
        item = Polyline(item.pen, item.layer, item.step, spots)
    if isinstance(item, Polyline | Polygon) and not all(map(rect.holds, item.spots)):
        yield from _cut(item, rect)
    else:
        yield item


def _cut(item: Polyline | Polygon, rect: Rect) -> Iterator[Item]:
    """The runs of a chain that lie inside."""
    import shapely  # where nothing is drawn, as for a list of steps, it is not needed

    spots = item.spots if isinstance(item, Polyline) else (*item.spots, item.spots[0])
    inside = shapely.clip_by_rect(shapely.LineString(spots), rect.left, rect.bottom, rect.right, rect.top)
    for run in shapely.get_parts(inside):
        yield Polyline(item.pen.filled("none"), item.layer, item.step, tuple(run.coords))


def spared(line: Polyline, rect: Rect, boxes: Iterable[Rect]) -> Iterator[Item]:
    """What of a line lies inside, and off some boxes."""
    import shapely

    inside = shapely.clip_by_rect(shapely.LineString(line.spots), rect.left, rect.bottom, rect.right, rect.top)
    covered = [shapely.box(box.left - AIR, box.bottom - AIR, box.right + AIR, box.top + AIR) for box in boxes]
    for run in shapely.get_parts(inside.difference(shapely.union_all(covered))):
        yield replace(line, spots=tuple(run.coords))
