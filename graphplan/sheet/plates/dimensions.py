"""Where the dimensions of links stand: beside the mechanism, off its links, letters and one another."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from graphplan.mechanism.model import Scene
from graphplan.sheet.plates.display import Arc, Circle, Item, Polygon, Polyline, Spot, Text
from graphplan.sheet.plates.symbols import NEAR, hull, off, places, straight, unit

FIRST, APART, LEVELS = 9.0, 6.0, 7  # mm: from the points to the nearest dimension line, to the next, and how many
LETTERS = 2.5  # mm: the height of its number
FIGURES = 9.0  # mm: about as long is its number
ACROSS, ALONG = 4.0, 0.5  # what is paid for what it crosses, and for each mm along it; a level costs 1


@dataclass(frozen=True)
class Dimension:
    """The distance of two points of the mechanism, by name, and how far to the left of the way its line stands, mm."""

    start: str
    end: str
    aside: float


def dimensions(scene: Scene, spots: Mapping[str, Spot], obstacles: Iterable[Item]) -> list[Dimension]:
    """The dimensions of all links, the frame's among them; each distance once, the shortest nearest to its link.

    Reads where points are in mm, and what else is drawn.
    """
    import shapely  # where nothing is drawn, as for a list of steps, it is not needed

    bodies = [[spots[name] for name in names] for names in scene.links.values()]
    drawn = [*filter(None, map(_figure, obstacles)),
             *(shapely.LineString(ends) for body in bodies for ends in _sides(body))]
    found: list[Dimension] = []
    for p, q in sorted(_measured(scene, spots), key=lambda pair: (math.dist(spots[pair[0]], spots[pair[1]]), pair)):
        aside, figure = min((_tried(spots[p], spots[q], level, side, drawn) for level in range(LEVELS)
                             for side in (1, -1)), key=lambda tried: tried[0])[1:]
        found.append(Dimension(p, q, aside))
        drawn.append(figure)
    return found


def _figure(item: Item) -> Any:
    """What an item covers, if it is in the way."""
    import shapely

    match item:
        case Text():
            return shapely.box(item.box.left, item.box.bottom, item.box.right, item.box.top)
        case Circle() | Arc():
            return shapely.Point(item.centre).buffer(item.radius)
        case Polyline() | Polygon():
            return shapely.LineString(item.spots)
    return None


def _measured(scene: Scene, spots: Mapping[str, Spot]) -> Iterator[tuple[str, str]]:
    """The pairs of points of each link that are measured, no two of them at the same two places."""
    known = set[frozenset[Spot]]()
    named: dict[Spot, str] = {}
    for names in scene.links.values():
        for name in names:
            named.setdefault(_place(spots[name], named), name)
    for names in scene.links.values():
        for p, q in _sides([spots[name] for name in names]):
            ends = _place(p, named), _place(q, named)
            if frozenset(ends) not in known:
                known.add(frozenset(ends))
                yield named[ends[0]], named[ends[1]]


def _place(spot: Spot, known: Iterable[Spot]) -> Spot:
    """The known place where a spot is, if it is at one."""
    return next((other for other in known if math.dist(other, spot) < NEAR), spot)


def _sides(spots: Sequence[Spot]) -> Iterator[tuple[Spot, Spot]]:
    """From point to point of a straight link; the sides of a plate, and from its two nearest corners to an inner point.
    """
    apart = places(spots)
    if len(apart) < 2:
        return
    if straight(apart):
        end, _ = max(((p, q) for p in apart for q in apart), key=lambda ends: math.dist(*ends))
        yield from pairwise(sorted(apart, key=lambda spot: math.dist(end, spot)))
        return
    corners = hull(apart)
    corners = tuple(min(apart, key=lambda spot: math.dist(spot, corner)) for corner in corners)
    yield from pairwise((*corners, corners[0]))
    for inner in apart:
        if inner not in corners:
            yield from ((corner, inner) for corner in sorted(corners, key=lambda spot: math.dist(spot, inner))[:2])


def _tried(p: Spot, q: Spot, level: int, side: int, drawn: Sequence[Any]) -> tuple[float, float, Any]:
    """What a place costs, how far aside it is, and what stands there: the line with its number, and the two lines that
    lead to it."""
    import shapely

    way, aside = unit(p, q), side * (FIRST + APART * level)
    start, end = off(p, way, 0.0, aside), off(q, way, 0.0, aside)
    middle = off(((start[0] + end[0]) / 2, (start[1] + end[1]) / 2), way, 0.0, LETTERS)
    number = shapely.LineString([off(middle, way, -FIGURES / 2), off(middle, way, FIGURES / 2)]).buffer(LETTERS / 2)
    line = shapely.union_all([shapely.LineString([start, end]).buffer(1.0), number])
    leading = shapely.MultiLineString([(off(foot, way, 0.0, side * 1.0), top) for foot, top in ((p, start), (q, end))])
    cost = float(level)
    for other in drawn:
        if line.intersects(other):
            cost += ACROSS + ALONG * shapely.intersection(line, other).length
        if leading.intersects(other):
            cost += ACROSS / 2
    return cost, aside, shapely.union_all([line, leading])
