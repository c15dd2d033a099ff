"""What letters should not cover, and the price of covering it: thin lines, the marks of others, surfaces.

Each kind of obstacle prices any number of places at once.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from graphplan.sheet.lettering.label_candidates import OUTWARDS, Array, Places
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Spot

TOUCH = 0.15  # the price of touching, in mm or mm^2 of what is touched
BESIDE, STRANGER = 0.3, 3.0  # mm by which a letter should be nearer to its own mark than to another; the price of each
THICK = 0.6  # mm: a wider line is a surface
ROUNDING = 1e-12  # of a place's area: less than this is not covered
BLOCK = 128  # places looked at together

Ring = Sequence[Spot]  # a closed chain: it ends where it begins


class Lines:
    """The thin lines of a plan, segment by segment, as something that letters cover at a price."""

    def __init__(self, items: Iterable[Item]):
        chains = list(strokes(items))
        ends = [pair for chain, _ in chains for pair in pairwise(chain)]
        self.start, self.end = np.array(ends, dtype=float).reshape(-1, 2, 2).swapaxes(0, 1)
        self.bounds = np.concatenate([np.minimum(self.start, self.end), np.maximum(self.start, self.end)], axis=1)
        self.stroke = np.repeat(np.arange(len(chains)), [len(chain) - 1 for chain, _ in chains])
        self.prices = np.array([price for _, price in chains])

    def price(self, found: Places) -> Array:
        """For every stroke its length in a place and the air around it, and for touching it."""
        cells = found.cells
        who, what = near(cells, self.bounds)
        share = _share(cells[who], self.start[what], self.end[what])
        who, what, share = who[share >= 0], what[share >= 0], share[share >= 0]
        stroke = self.stroke[what]
        first = np.diff(who * len(self.prices) + stroke, prepend=-1) > 0  # of the segments of a stroke in a place
        length = np.hypot(*(self.end - self.start).T)[what] * share
        paid = np.concatenate([length * self.prices[stroke], TOUCH * self.prices[stroke[first]]])
        return np.bincount(np.concatenate([who, who[first]]), paid, len(cells))


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


def _share(cells: Array, start: Array, end: Array) -> Array:
    """How much of each segment lies in its cell, beside its length (Liang and Barsky); negative where it passes by.

    A segment along an axis is never cut off by the sides that it runs along, as its bounds meet the cell's.
    """
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (cells[:, :2] - start) / way, (cells[:, 2:] - start) / way
    enter = np.where(way == 0, 0.0, np.minimum(one, other)).max(axis=1)
    leave = np.where(way == 0, 1.0, np.maximum(one, other)).min(axis=1)
    return np.asarray(np.minimum(leave, 1.0) - np.maximum(enter, 0.0))


class Marks:
    """The marks of a plan: a letter should not stand nearer to another than to its own."""

    def __init__(self, spots: Sequence[Spot]):
        self.spots = np.array(spots, dtype=float).reshape(-1, 2)

    def price(self, found: Places) -> Array:
        """For every mark that is nearer than the place's own; marks out of reach do not count."""
        own = _gap(found.boxes, found.spots)
        reach = found.boxes + (own + BESIDE)[:, None] * OUTWARDS
        who, what = near(reach, np.concatenate([self.spots, self.spots], axis=1))
        foreign = np.hypot(*(self.spots[what] - found.spots[who]).T) > BESIDE
        nearer = foreign & (_gap(found.boxes[who], self.spots[what]) < own[who] + BESIDE)
        return STRANGER * np.bincount(who[nearer], minlength=len(own))


def _gap(boxes: Array, spots: Array) -> Array:
    """How far each spot lies outside its box."""
    return np.asarray(np.hypot(*np.maximum(np.maximum(boxes[:, :2] - spots, spots - boxes[:, 2:]), 0.0).T))


class Surfaces:
    """The thick lines and figures of a plan, edge by edge."""

    def __init__(self, items: Iterable[Item]):
        figures = list(surfaces(items))
        ends = np.array([pair for ring, _ in figures for pair in pairwise(ring)], dtype=float).reshape(-1, 2, 2)
        self.start, self.end = ends.swapaxes(0, 1)
        self.edges = np.array([len(ring) - 1 for ring, _ in figures], dtype=int)
        self.first = np.cumsum(self.edges) - self.edges
        self.rates = np.array([price for _, price in figures])
        boxes = [(min(xs), min(ys), max(xs), max(ys)) for xs, ys in (zip(*ring, strict=True) for ring, _ in figures)]
        self.bounds = np.array(boxes, dtype=float).reshape(-1, 4)

    def price(self, found: Places) -> Array:
        """For the area of every surface that a place and the air around it cover, and for touching it."""
        cells = found.cells
        who, what = near(cells, self.bounds)
        edges = self.edges[what]
        pair = np.repeat(np.arange(len(who)), edges)
        edge = np.arange(len(pair)) - np.repeat(np.cumsum(edges) - edges - self.first[what], edges)
        area = abs(np.bincount(pair, _under(cells[who[pair]], self.start[edge], self.end[edge]), len(who)))
        covered = area > ROUNDING * (cells[who, 2:] - cells[who, :2]).prod(axis=1)
        return np.bincount(who[covered], ((area + TOUCH) * self.rates[what])[covered], len(cells))


def surfaces(items: Iterable[Item]) -> Iterator[tuple[Ring, float]]:
    """The thick lines and figures that letters should not cover, each with its price per mm^2."""
    for item in items:
        if isinstance(item, Polyline) and item.pen.width > THICK:
            yield from ((_thick(item, start, end), 5.0) for start, end in pairwise(item.spots))
        elif isinstance(item, Arrow):
            yield _closed(item.barbs), 4.0
        elif isinstance(item, Circle):
            yield _arc(item, item.centre, item.radius + 0.2, 0.0, 360.0).spots(11.25), 5.0
        elif isinstance(item, Polygon) and item.layer != "plates":
            yield _closed(item.spots), 3.0


def _closed(spots: Sequence[Spot]) -> Ring:
    return *spots, spots[0]


def _thick(line: Polyline, start: Spot, end: Spot) -> Ring:
    """The outline of a thick stroke, rounded at its ends."""
    along, radius = math.degrees(math.atan2(end[1] - start[1], end[0] - start[0])), line.pen.width / 2
    head = _arc(line, end, radius, along - 90.0, along + 90.0)
    tail = _arc(line, start, radius, along + 90.0, along + 270.0)
    return _closed((*head.spots(45.0), *tail.spots(45.0)))


def _arc(item: Item, centre: Spot, radius: float, start: float, end: float) -> Arc:
    return Arc(item.pen, item.layer, item.step, centre, radius, start, end)


def _under(cells: Array, start: Array, end: Array) -> Array:
    """The area of each cell under its edge, with the sign of the way that the edge runs: those of a ring add up to what
    the ring covers."""
    (left, bottom, right, top), way = cells.T, end - start
    from_, to = np.clip(start[:, 0], left, right), np.clip(end[:, 0], left, right)
    with np.errstate(divide="ignore", invalid="ignore"):
        slope = np.where(way[:, 0] == 0, 0.0, way[:, 1] / way[:, 0])
        ys = start[:, 1] + slope * ([from_, to] - start[:, 0])
        low, high = ys.min(axis=0), ys.max(axis=0)
        above, below = (np.nan_to_num(np.clip(part / (high - low), 0.0, 1.0)) for part in (high - top, bottom - low))
    between = (np.clip(low, bottom, top) + np.clip(high, bottom, top)) / 2 - bottom
    return np.asarray((to - from_) * (above * (top - bottom) + (1.0 - above - below) * between))


def near(cells: Array, bounds: Array) -> tuple[Array, Array]:
    """The pairs of cells and things whose bounds meet.

    Cells come letter by letter, so those of a block lie together, and most things are far from all of them.
    """
    pairs = [np.empty((2, 0), dtype=int)]
    for first in range(0, len(cells), BLOCK):
        block = cells[first : first + BLOCK]
        things = np.flatnonzero(meet(around(block), bounds))
        who, what = np.nonzero(meet(block[:, None], bounds[things]))
        pairs.append(np.array([who + first, things[what]]))
    who, what = np.concatenate(pairs, axis=1)
    return who, what


def around(boxes: Array) -> Array:
    """The bounds of all the boxes."""
    return np.concatenate([boxes[:, :2].min(axis=0), boxes[:, 2:].max(axis=0)])


def meet(one: Array, other: Array) -> Array:
    """Whether rectangles meet, be it at an edge."""
    return np.asarray((one[..., 0] <= other[..., 2]) & (other[..., 0] <= one[..., 2])
                      & (one[..., 1] <= other[..., 3]) & (other[..., 1] <= one[..., 3]))  # fmt: skip
