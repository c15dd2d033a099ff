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

DIRECTIONS = np.array([(math.cos(i * math.pi / 8), math.sin(i * math.pi / 8)) for i in range(16)])
TASTE = 0.02 * ((np.arange(16) - 2) % 16)  # among equals up and to the right, then on counter-clockwise
RINGS = np.array([(0.7, 0.0), (1.6, 0.8), (2.8, 2.0), (4.5, 4.0), (7.0, 7.0), (10.0, 11.0), (14.0, 16.0), (20.0, 24.0)])
LED = 3.4  # mm from which a thin leader ties a letter to its mark
CLASH, AIR, TOUCH = 400.0, 0.3, 0.15
NEXT = 1.5  # a place dearer by no more than this is a choice as well
BLOCK = 128  # places looked at together
THICK = 0.6  # mm: a wider line is a surface
SWEEPS = 8
BALLOON = 2.1

Array = np.ndarray[Any, Any]
OUTWARDS = np.array([-1.0, -1.0, 1.0, 1.0])  # each side of a box


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
class Places:
    """Candidates of one letter: boxes, the spots they stand for, what their distance costs, and which need a leader.

    Boxes are rows of left, bottom, right, top.
    """

    boxes: Array
    spots: Array
    cost: Array
    led: Array

    def __getitem__(self, chosen: Any) -> Places:
        return Places(self.boxes[chosen], self.spots[chosen], self.cost[chosen], self.led[chosen])


def places(wish: Wish, rect: Rect) -> Places:
    """All the places for a letter inside the panel: spot by spot, from the nearest ring outwards."""
    rings, extent = RINGS[: 3 if wish.free else len(RINGS)], np.array(wish.extent)
    gaps, costs = rings[:, 0, None, None], rings[:, 1, None]
    spots = np.array(wish.spots)[:, None, None, :]
    sides = DIRECTIONS / abs(DIRECTIONS).max(axis=1, keepdims=True)  # to the edge of a square
    centres = spots + (wish.clear + gaps) * DIRECTIONS + sides * extent / 2
    number = np.arange(len(wish.spots))[:, None, None]
    cost = costs + (TASTE + (0.05 * number if wish.free else 0.0 * number))
    led = np.broadcast_to((gaps[..., 0] > LED) & (not wish.free), cost.shape)
    boxes = np.concatenate([centres - extent / 2, centres + extent / 2], axis=-1).reshape(-1, 4)
    inside = ((boxes[:, :2] >= (rect.left, rect.bottom)) & (boxes[:, 2:] <= (rect.right, rect.top))).all(axis=1)
    found = Places(boxes, np.broadcast_to(spots, centres.shape).reshape(-1, 2), cost.ravel(), led.ravel())[inside]
    return found if inside.any() else _pushed_in(wish, rect)


def _pushed_in(wish: Wish, rect: Rect) -> Places:
    """The place of a letter whose mark is at the edge: as near as the panel allows."""
    (wide, high), (x, y) = wish.extent, wish.spots[0]
    left = min(max(x, rect.left), rect.right - wide)
    low = min(max(y, rect.bottom), rect.top - high)
    box = left, low, left + wide, low + high
    return Places(np.array([box]), np.array([wish.spots[0]]), np.array([5.0]), np.array([False]))


def strokes(items: Iterable[Item]) -> Iterator[tuple[Sequence[Spot], float]]:
    """The thin lines that letters should not cover, each a chain of spots, with its price per mm."""
    for item in items:
        price = 1.0 + 5.0 * item.pen.width
        if isinstance(item, Polyline) and item.pen.width <= THICK:
            yield item.spots, price
        elif isinstance(item, Arc):
            yield item.spots(), price
        elif isinstance(item, Arrow):
            yield (item.start, item.end), price


def surfaces(items: Iterable[Item]) -> Iterator[tuple[Any, float]]:
    """The thick lines and figures that letters should not cover, each with its price per mm^2."""
    for item in items:
        if isinstance(item, Polyline) and item.pen.width > THICK:
            yield shapely.LineString(item.spots).buffer(item.pen.width / 2, 2), 5.0
        elif isinstance(item, Arrow):
            yield shapely.Polygon(item.barbs), 4.0
        elif isinstance(item, Circle):
            yield shapely.Point(item.centre).buffer(item.radius + 0.2, 8), 5.0
        elif isinstance(item, Polygon) and item.layer != "plates":
            yield shapely.Polygon(item.spots), 3.0


def _crossed(cells: Array, chains: Sequence[tuple[Sequence[Spot], float]]) -> Array:
    """The price of the strokes that each cell covers: for every stroke its length in the cell, and for touching it."""
    total = np.zeros(len(cells))
    if not chains:
        return total
    start = np.array([spot for chain, _ in chains for spot in chain[:-1]])
    end = np.array([spot for chain, _ in chains for spot in chain[1:]])
    stroke = np.repeat(np.arange(len(chains)), [len(chain) - 1 for chain, _ in chains])
    prices = np.array([price for _, price in chains])
    who, what = _near(cells, np.concatenate([np.minimum(start, end), np.maximum(start, end)], axis=1))
    share = _share(cells[who], start[what], end[what])
    who, what, share = who[share >= 0], what[share >= 0], share[share >= 0]
    length = np.hypot(*(end - start).T)[what] * share
    np.add.at(total, who, length * prices[stroke[what]])
    touched, what = np.divmod(np.unique(who * len(chains) + stroke[what]), len(chains))
    np.add.at(total, touched, TOUCH * prices[what])
    return total


def _near(cells: Array, bounds: Array) -> tuple[Array, Array]:
    """The pairs of cells and things whose bounds meet.

    Cells come letter by letter, so those of a block lie together, and most things are far from all of them.
    """
    pairs = [np.empty((2, 0), dtype=int)]
    for first in range(0, len(cells), BLOCK):
        block = cells[first : first + BLOCK]
        things = np.flatnonzero(_meet(_around(block), bounds))
        who, what = np.nonzero(_meet(block[:, None], bounds[things]))
        pairs.append(np.array([who + first, things[what]]))
    who, what = np.concatenate(pairs, axis=1)
    return who, what


def _around(boxes: Array) -> Array:
    """The bounds of all the boxes."""
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])


def _meet(one: Array, other: Array) -> Array:
    """Whether rectangles meet, be it at an edge."""
    return np.asarray((one[..., 0] <= other[..., 2]) & (other[..., 0] <= one[..., 2])
                      & (one[..., 1] <= other[..., 3]) & (other[..., 1] <= one[..., 3]))  # fmt: skip


def _share(cells: Array, start: Array, end: Array) -> Array:
    """How much of each segment lies in its cell, beside its length (Liang and Barsky); negative where it passes by.

    A segment along an axis is never cut off by the sides that it runs along, as its bounds meet the cell's.
    """
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        cuts = np.sort([(cells[:, :2] - start) / way, (cells[:, 2:] - start) / way], axis=0)
    enter = np.where(way == 0, 0.0, cuts[0]).max(axis=1)
    leave = np.where(way == 0, 1.0, cuts[1]).min(axis=1)
    return np.asarray(np.minimum(leave, 1.0) - np.maximum(enter, 0.0))


class Prices:
    """What the places of all letters cost.

    A place is at first priced without the surfaces that it covers, so no dearer than it is. Their areas take long to
    find, and are found only for places that would win without them.
    """

    def __init__(self, cost: Array, cells: Array, surfaces: Sequence[tuple[Any, float]]):
        self.cost, self.cells = cost, cells
        self.shapes = np.array([shape for shape, _ in surfaces], dtype=object)
        self.rates = np.array([price for _, price in surfaces])
        self.tree = shapely.STRtree(self.shapes)
        self.sure = np.ones(len(cells), dtype=bool)
        self.sure[_near(cells, shapely.bounds(self.shapes).reshape(-1, 4))[0]] = False

    def cheapest(self, letter: slice, more: Array | float = 0.0) -> int:
        """The cheapest place of a letter, where its places cost so much more."""
        while True:
            price = self.cost[letter] + more
            best = int(price.argmin())
            if self.sure[letter][best]:
                return int(letter.start) + best
            self._make_sure(letter, ~(price > price[best] + NEXT))

    def good(self, letter: slice) -> int:
        """How many places are almost as good as the cheapest."""
        limit = self.cost[self.cheapest(letter)] + NEXT
        self._make_sure(letter, self.cost[letter] < limit)
        return int((self.cost[letter] < limit).sum())

    def _make_sure(self, letter: slice, which: Array) -> None:
        """Add to some of a letter's places the price of the surfaces that they cover."""
        places = letter.start + np.flatnonzero(which & ~self.sure[letter])
        boxes = shapely.box(*self.cells[places].T)
        who, what = self.tree.query(boxes, predicate="intersects")
        area = shapely.area(shapely.intersection(boxes[who], self.shapes[what]))
        np.add.at(self.cost, places[who], (area + TOUCH) * self.rates[what])
        self.sure[places] = True


def _strangers(found: Places, marks: Array) -> Array:
    """The price of standing nearer to another mark than to one's own; marks out of reach of all places do not count."""
    boxes, spots = found.boxes, found.spots

    def gap(points: Array) -> Array:
        dx = np.maximum(np.maximum(boxes[:, None, 0] - points[..., 0], points[..., 0] - boxes[:, None, 2]), 0)
        dy = np.maximum(np.maximum(boxes[:, None, 1] - points[..., 1], points[..., 1] - boxes[:, None, 3]), 0)
        return np.asarray(np.hypot(dx, dy))

    own = gap(spots[:, None, :])
    reach = _around(boxes) + (own.max() + 0.3) * OUTWARDS
    marks = marks[_meet(reach, np.concatenate([marks, marks], axis=1))]
    foreign = np.hypot(marks[None, :, 0] - spots[:, None, 0], marks[None, :, 1] - spots[:, None, 1]) > 0.3
    return np.asarray((3.0 * (foreign & (gap(marks[None, :, :]) < own + 0.3))).sum(axis=1))


def placed(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect) -> list[Item]:
    """The letters in their places, with leaders where they had to go far."""
    if not wishes:
        return []
    found = [places(wish, rect) for wish in wishes]
    edges = np.cumsum([0, *(len(candidates.cost) for candidates in found)])
    boxes = np.concatenate([candidates.boxes for candidates in found])
    cells = boxes + AIR * OUTWARDS
    cost = np.concatenate([candidates.cost for candidates in found])
    cost += _crossed(cells, list(strokes(items)))
    if marks:
        cost += np.concatenate([_strangers(candidates, np.array(marks)) for candidates in found])
    choice = _chosen(boxes, Prices(cost, cells, list(surfaces(items))), edges)
    chosen = [candidates[index - edge] for candidates, index, edge in zip(found, choice, edges[:-1], strict=True)]
    return [item for wish, place in zip(wishes, chosen, strict=True) for item in _items(wish, place)]


def _chosen(boxes: Array, prices: Prices, edges: Array) -> list[int]:
    """One place for every letter: greedily, the fewest good places first, then sweeps of improvement."""
    count = len(edges) - 1
    spans = [slice(int(edges[i]), int(edges[i + 1])) for i in range(count)]
    choices = [prices.good(span) for span in spans]
    cheapest = [float(prices.cost[prices.cheapest(span)]) for span in spans]
    order = sorted(range(count), key=lambda i: (choices[i], -cheapest[i], i))
    choice = [-1] * count
    for _ in range(SWEEPS):
        before = list(choice)
        for i in order:
            others = boxes[[c for j, c in enumerate(choice) if j != i and c >= 0]]
            choice[i] = prices.cheapest(spans[i], CLASH * _overlap(boxes[spans[i]], others))
        if choice == before:
            break
    return choice


def _overlap(boxes: Array, others: Array) -> Array:
    """How much of the other letters each box covers: a fixed price for touching, and the area."""
    others = others[_meet(_around(boxes) + AIR * OUTWARDS, others)]
    if not len(others):
        return np.zeros(len(boxes))
    wide = np.minimum(boxes[:, None, 2], others[None, :, 2]) - np.maximum(boxes[:, None, 0], others[None, :, 0]) + AIR
    high = np.minimum(boxes[:, None, 3], others[None, :, 3]) - np.maximum(boxes[:, None, 1], others[None, :, 1]) + AIR
    touch = (wide > 0) & (high > 0)
    return np.asarray((touch * (1.0 + np.clip(wide, 0, None) * np.clip(high, 0, None))).sum(axis=1))


def _items(wish: Wish, place: Places) -> Iterator[Item]:
    """A letter at its place."""
    left, low, right, top = map(float, place.boxes)
    x, y = map(float, place.spots)
    middle = (left + right) / 2, (low + top) / 2
    if place.led:
        nearest = min(max(x, left), right), min(max(y, low), top)
        yield Polyline(pens.LEADER, "letters", wish.step, ((x, y), nearest))
    if wish.balloon:
        yield Circle(pens.BALLOON, "letters", wish.step, middle, BALLOON)
        base = middle[0], middle[1] - wish.size * CAPS / 2
        yield Text(wish.pen, "letters", wish.step, base, wish.runs, wish.size, "middle", label=wish.label)
    else:
        base = left, low + wish.size * wish.depth
        yield Text(wish.pen, "letters", wish.step, base, wish.runs, wish.size, bold=wish.bold, label=wish.label)
