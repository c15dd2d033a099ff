"""What letters should not cover, each at its price: lines by their length, surfaces by their area, and other marks.

Lengths are summed in arrays, as shapely cuts a line off at a box in ten times the time.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import shapely

from graphplan.sheet.lettering.label_candidates import OUTWARDS, Array, Candidates
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Spot

FAULT = 40.0  # the price of a line through the letters, or of letters that seem to belong to another mark
MISTAKEN = 0.1  # mm by which letters that seem so are nearer to that than to their own
TOUCH = 0.15  # the price of touching, in mm or mm^2 of what is touched
BESIDE, STRANGER = 0.3, 3.0  # mm by which a letter should be nearer to its own mark than to another; the price of each
THICK = 0.6  # mm: a wider line is a surface


class Lines:
    """The thin lines of a plan, segment by segment, as something that letters cover at a price."""

    def __init__(self, items: Iterable[Item]):
        chains = list(strokes(items))
        ends = [pair for chain, _ in chains for pair in pairwise(chain)]
        self.start, self.end = np.array(ends, dtype=float).reshape(-1, 2, 2).swapaxes(0, 1)
        self.tree = shapely.STRtree(shapely.linestrings(np.stack([self.start, self.end], axis=1)))
        self.stroke = np.repeat(np.arange(len(chains)), [len(chain) - 1 for chain, _ in chains])
        self.prices = np.array([price for _, price in chains])

    def price(self, found: Candidates) -> Array:
        """For every stroke its length in a place and the air around it, and for touching it."""
        cells, count = found.cells, len(self.prices)
        who, what = self.tree.query(_diagonals(cells))
        part = share(cells[who], self.start[what], self.end[what])
        who, what, part = who[part >= 0], what[part >= 0], part[part >= 0]
        length = np.hypot(*(self.end - self.start).T)[what] * part
        pairs = np.sort(who * count + self.stroke[what])
        touched, stroke = np.divmod(pairs[np.diff(pairs, prepend=-1) > 0], max(count, 1))
        paid = np.concatenate([length * self.prices[self.stroke[what]], TOUCH * self.prices[stroke]])
        through = share(found.boxes[who], self.start[what], self.end[what]) > 0
        return np.bincount(np.concatenate([who, touched]), paid, len(cells)) + _faulty(who[through], len(cells))


def _faulty(places: Array, count: int) -> Array:
    """What a fault costs each of so many places that has one."""
    return FAULT * (np.bincount(places, minlength=count) > 0)


def _diagonals(boxes: Array) -> Any:
    """Boxes as lines, which are made faster and have the same bounds: a tree asks for no more."""
    return shapely.linestrings(boxes.reshape(-1, 2, 2))


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


def share(cells: Array, start: Array, end: Array) -> Array:
    """How much of each segment lies in its cell, beside its length (Liang and Barsky); negative where it passes by.

    A segment along an axis is never cut off by the sides that it runs along, as its bounds meet the cell's.
    """
    enter, leave = np.zeros(len(cells)), np.ones(len(cells))
    for axis in (0, 1):  # column by column: numpy takes far longer to compare the two of a row
        here, way = start[:, axis], end[:, axis] - start[:, axis]
        with np.errstate(divide="ignore", invalid="ignore"):
            one, other = (cells[:, axis] - here) / way, (cells[:, axis + 2] - here) / way
        still = way == 0
        enter = np.maximum(enter, np.where(still, 0.0, np.minimum(one, other)))
        leave = np.minimum(leave, np.where(still, 1.0, np.maximum(one, other)))
    return np.asarray(leave - enter)


class Marks:
    """The marks of a plan: a letter should not stand nearer to another than to its own."""

    def __init__(self, spots: Sequence[Spot]):
        self.spots = np.array(spots, dtype=float).reshape(-1, 2)
        self.tree = shapely.STRtree(shapely.points(self.spots))

    def price(self, found: Candidates) -> Array:
        """For every mark that is nearer than the place's own, or that its leader passes."""
        own = _gap(found.boxes, found.spots)
        near = np.where(found.led, 0.0, own + BESIDE)  # a leader tells whose the letters are
        who, what = self.tree.query(_diagonals(found.boxes + near[:, None] * OUTWARDS))
        foreign = np.hypot(*(self.spots[what] - found.spots[who]).T) > BESIDE
        nearer = foreign & (_gap(found.boxes[who], self.spots[what]) < near[who])
        mistaken = _gap(found.boxes[who], self.spots[what]) < near[who] - BESIDE - MISTAKEN
        return STRANGER * np.bincount(who[nearer], minlength=len(own)) + _faulty(who[mistaken], len(own)) \
            + self._passed(found)

    def _passed(self, found: Candidates) -> Array:
        """For every place whose leader passes another mark."""
        led = np.flatnonzero(found.led)
        leaders = shapely.linestrings(np.stack([found.spots[led], found.ends[led]], axis=1))
        who, what = self.tree.query(leaders, "dwithin", BESIDE) if len(led) else np.empty((2, 0), dtype=int)
        foreign = np.hypot(*(self.spots[what] - found.spots[led[who]]).T) > BESIDE
        return _faulty(led[who[foreign]], len(found.led))


def _gap(boxes: Array, spots: Array) -> Array:
    """How far each spot lies outside its box."""
    return np.asarray(np.hypot(*np.maximum(np.maximum(boxes[:, :2] - spots, spots - boxes[:, 2:]), 0.0).T))


class Surfaces:
    """The thick lines and figures of a plan."""

    def __init__(self, items: Iterable[Item]):
        figures = list(surfaces(items))
        self.figures, self.rates = np.array([f for f, _ in figures]), np.array([price for _, price in figures])
        self.tree = shapely.STRtree(self.figures)

    def price(self, found: Candidates) -> Array:
        """For the area of every surface that a place and the air around it cover, and for touching it."""
        cells = shapely.box(*found.cells.T)
        who, what = self.tree.query(cells, predicate="intersects")
        covered = shapely.area(shapely.intersection(cells[who], self.figures[what])) + TOUCH
        hidden = shapely.intersects(shapely.box(*found.boxes[who].T), self.figures[what])
        return np.bincount(who, covered * self.rates[what], len(cells)) + _faulty(who[hidden], len(cells))


def surfaces(items: Iterable[Item]) -> Iterator[tuple[Any, float]]:
    """The thick lines and figures that letters should not cover, as polygons of shapely, each with its price per mm^2.
    """
    for item in items:
        if isinstance(item, Polyline) and item.pen.width > THICK:
            for ends in pairwise(item.spots):
                yield shapely.LineString(ends).buffer(item.pen.width / 2, quad_segs=2), 5.0
        elif isinstance(item, Arrow):
            yield shapely.Polygon(item.barbs), 4.0
        elif isinstance(item, Circle):
            yield shapely.Point(item.centre).buffer(item.radius + 0.2, quad_segs=8), 5.0
        elif isinstance(item, Polygon) and item.layer != "plates":
            yield shapely.Polygon(item.spots), 3.0
