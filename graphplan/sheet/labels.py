"""Where letters go: beside their mark, off every line if they can be, never on each other.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark. Letters take their cheapest places one by one, the most constrained first, and
then move again as long as that helps. All of it is deterministic.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from graphplan.sheet import pens
from graphplan.sheet.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.lettering import CAPS, DEPTH, DROP, SIZE, Runs, width
from graphplan.sheet.pens import Pen

DIRECTIONS = tuple((math.cos(i * math.pi / 8), math.sin(i * math.pi / 8)) for i in range(16))
RINGS = ((0.7, 0.0), (1.6, 0.8), (2.8, 2.0), (4.5, 4.0), (7.0, 7.0), (10.0, 11.0), (14.0, 16.0), (20.0, 24.0))
LED = 3.4  # mm from which a thin leader ties a letter to its mark
CLASH, AIR = 400.0, 0.3
SWEEPS = 8
BALLOON = 2.1

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Wish:
    """A letter that wants a place: near one of its spots, at least `clear` away from it.

    `balloon` puts it in a circle, as link numbers are; `free` says that it may stand anywhere along a line.
    """

    runs: Runs
    spots: tuple[Spot, ...]
    clear: float = 0.6
    size: float = SIZE
    pen: Pen = pens.LETTERS
    step: int | None = None
    label: str = ""
    bold: bool = False
    balloon: bool = False
    free: bool = False

    @property
    def extent(self) -> tuple[float, float]:
        if self.balloon:
            return 2 * BALLOON, 2 * BALLOON
        return width(self.runs, self.size, self.bold), self.size * (CAPS + self.depth)

    @property
    def depth(self) -> float:
        """How far the letters reach below the base line, in ems."""
        return DROP + 0.15 if any(run.level < 0 for run in self.runs) else DEPTH


@dataclass(frozen=True)
class Place:
    """A candidate: its box, the spot it stands for, and what its distance costs."""

    box: Box
    spot: Spot
    cost: float
    led: bool


def places(wish: Wish, rect: Rect) -> list[Place]:
    """All the places for a letter inside the panel."""
    wide, high = wish.extent
    found = []
    for nth, spot in enumerate(wish.spots):
        for gap, cost in RINGS[: 3 if wish.free else len(RINGS)]:
            for i, (dx, dy) in enumerate(DIRECTIONS):
                reach, stretch = wish.clear + gap, max(abs(dx), abs(dy))
                x = spot[0] + reach * dx + dx / stretch * wide / 2
                y = spot[1] + reach * dy + dy / stretch * high / 2
                box = x - wide / 2, y - high / 2, x + wide / 2, y + high / 2
                if rect.left <= box[0] and box[2] <= rect.right and rect.bottom <= box[1] and box[3] <= rect.top:
                    taste = 0.02 * ((i - 2) % 16) + (0.05 * nth if wish.free else 0.0)
                    found.append(Place(box, spot, cost + taste, gap > LED and not wish.free))
    return found or [_pushed_in(wish, rect)]


def _pushed_in(wish: Wish, rect: Rect) -> Place:
    """The place of a letter whose mark is at the edge: as near as the panel allows."""
    (wide, high), (x, y) = wish.extent, wish.spots[0]
    left = min(max(x, rect.left), rect.right - wide)
    low = min(max(y, rect.bottom), rect.top - high)
    return Place((left, low, left + wide, low + high), wish.spots[0], 5.0, False)


def shapes(items: Iterable[Item]) -> Iterator[tuple[Any, float]]:
    """What letters should not cover, with its price per mm of stroke or per mm^2 of surface."""
    for item in items:
        price = 1.0 + 5.0 * item.pen.width
        if isinstance(item, Polyline) and item.pen.width > 0.6:
            yield shapely.LineString(item.spots).buffer(item.pen.width / 2, 2), 5.0
        elif isinstance(item, Polyline):
            yield shapely.LineString(item.spots), price
        elif isinstance(item, Arc):
            yield shapely.LineString(item.spots()), price
        elif isinstance(item, Arrow):
            yield shapely.LineString((item.start, item.end)), price
            yield shapely.Polygon(item.barbs), 4.0
        elif isinstance(item, Circle):
            yield shapely.Point(item.centre).buffer(item.radius + 0.2, 8), 5.0
        elif isinstance(item, Polygon) and item.layer != "plates":
            yield shapely.Polygon(item.spots), 3.0


def _covered(boxes: Sequence[Box], obstacles: Sequence[tuple[Any, float]]) -> np.ndarray[Any, Any]:
    """The price of the strokes and surfaces that each box covers."""
    total = np.zeros(len(boxes))
    if not obstacles or not boxes:
        return total
    geometries = np.array([shape for shape, _ in obstacles], dtype=object)
    prices = np.array([price for _, price in obstacles])
    areas = np.array([shape.area > 0 for shape, _ in obstacles])
    cells = shapely.box(*(np.array(boxes).T + np.array([[-AIR], [-AIR], [AIR], [AIR]])))
    who, what = shapely.STRtree(geometries).query(cells, predicate="intersects")
    common = shapely.intersection(cells[who], geometries[what])
    amount = np.where(areas[what], shapely.area(common), shapely.length(common))
    np.add.at(total, who, (amount + 0.15) * prices[what])
    return total


def _strangers(found: Sequence[Place], marks: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """The price of standing nearer to another mark than to one's own."""
    boxes, spots = np.array([p.box for p in found]), np.array([p.spot for p in found])

    def gap(points: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        dx = np.maximum(np.maximum(boxes[:, None, 0] - points[..., 0], points[..., 0] - boxes[:, None, 2]), 0)
        dy = np.maximum(np.maximum(boxes[:, None, 1] - points[..., 1], points[..., 1] - boxes[:, None, 3]), 0)
        return np.asarray(np.hypot(dx, dy))

    own = gap(spots[:, None, :])
    foreign = np.hypot(marks[None, :, 0] - spots[:, None, 0], marks[None, :, 1] - spots[:, None, 1]) > 0.3
    return np.asarray((3.0 * (foreign & (gap(marks[None, :, :]) < own + 0.3))).sum(axis=1))


def placed(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect) -> list[Item]:
    """The letters in their places, with leaders where they had to go far."""
    if not wishes:
        return []
    found = [places(wish, rect) for wish in wishes]
    edges = np.cumsum([0, *(len(candidates) for candidates in found)])
    everywhere = [place for candidates in found for place in candidates]
    cost = np.array([p.cost for p in everywhere]) + _covered([p.box for p in everywhere], list(shapes(items)))
    if marks:
        cost += np.concatenate([_strangers(candidates, np.array(marks)) for candidates in found])
    choice = _chosen(np.array([p.box for p in everywhere]), cost, edges)
    return [item for i, wish in enumerate(wishes) for item in _items(wish, everywhere[choice[i]])]


def _chosen(boxes: np.ndarray[Any, Any], cost: np.ndarray[Any, Any], edges: np.ndarray[Any, Any]) -> list[int]:
    """One place for every letter: greedily, the fewest good places first, then sweeps of improvement."""
    count = len(edges) - 1
    spans = [slice(int(edges[i]), int(edges[i + 1])) for i in range(count)]
    cheapest = [float(cost[span].min()) for span in spans]
    choices = [int((cost[span] < least + 1.5).sum()) for span, least in zip(spans, cheapest, strict=True)]
    order = sorted(range(count), key=lambda i: (choices[i], -cheapest[i], i))
    choice = [-1] * count
    for _ in range(SWEEPS):
        before = list(choice)
        for i in order:
            others = boxes[[c for j, c in enumerate(choice) if j != i and c >= 0]]
            price = cost[spans[i]] + CLASH * _overlap(boxes[spans[i]], others)
            choice[i] = spans[i].start + int(price.argmin())
        if choice == before:
            break
    return choice


def _overlap(boxes: np.ndarray[Any, Any], others: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """How much of the other letters each box covers: a fixed price for touching, and the area."""
    if not len(others):
        return np.zeros(len(boxes))
    wide = np.minimum(boxes[:, None, 2], others[None, :, 2]) - np.maximum(boxes[:, None, 0], others[None, :, 0]) + AIR
    high = np.minimum(boxes[:, None, 3], others[None, :, 3]) - np.maximum(boxes[:, None, 1], others[None, :, 1]) + AIR
    touch = (wide > 0) & (high > 0)
    return np.asarray((touch * (1.0 + np.clip(wide, 0, None) * np.clip(high, 0, None))).sum(axis=1))


def _items(wish: Wish, place: Place) -> Iterator[Item]:
    """A letter at its place."""
    left, low, right, top = place.box
    middle = (left + right) / 2, (low + top) / 2
    if place.led:
        nearest = min(max(place.spot[0], left), right), min(max(place.spot[1], low), top)
        yield Polyline(pens.LEADER, "letters", wish.step, (place.spot, nearest))
    if wish.balloon:
        yield Circle(pens.BALLOON, "letters", wish.step, middle, BALLOON)
        base = middle[0], middle[1] - wish.size * CAPS / 2
        yield Text(wish.pen, "letters", wish.step, base, wish.runs, wish.size, "middle", label=wish.label)
    else:
        base = left, low + wish.size * wish.depth
        yield Text(wish.pen, "letters", wish.step, base, wish.runs, wish.size, bold=wish.bold, label=wish.label)
