"""Where letters go: beside their mark, off every line if they can be, never on each other.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark; lengths are summed in arrays, as shapely cuts a line off at a box in ten times
the time. Letters take their cheapest places one by one, the most constrained first, and
then move again as long as that helps. All of it is deterministic.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import shapely

from graphplan.sheet.lettering.label_candidates import AIR, OUTWARDS, Array, Candidates, Wish, candidates
from graphplan.sheet.lettering.lettering import SMALL_SHEET, LetterSizes
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot

CLASH = 400.0  # the price of standing on another letter, and of each mm^2 of that
NEXT = 1.5  # a place dearer by no more than this is a choice as well
SWEEPS = 8
POOR = 2.0  # the price of what a letter covers, from which on it can hardly be read


class Prices:
    """What the places of all letters cost.

    A place is at first priced by its distance alone, so no dearer than it is. What it covers takes long to find, and is
    found, part by part, only for places that would win without it.
    """

    def __init__(self, found: Candidates, parts: Sequence[Lines | Marks | Surfaces]):
        self.found, self.parts, self.cost = found, parts, found.cost.copy()
        self.known = np.zeros(len(found.cost), dtype=int)  # how many parts a place's price holds

    def cheapest(self, letter: slice, more: Array | float = 0.0) -> int:
        """The cheapest place of a letter, where its places cost so much more."""
        while True:
            price = self.cost[letter] + more
            best = int(price.argmin())
            if self.known[letter][best] == len(self.parts):
                return int(letter.start) + best
            self._look(letter.start + np.flatnonzero(price <= price[best] + NEXT))

    def choices(self, starts: Array) -> tuple[Array, Array]:
        """For each letter how many places are almost as good as the cheapest, and what that costs."""
        while True:
            least = np.minimum.reduceat(self.cost, starts)
            good = self.cost < (least + NEXT)[self.found.letters]
            if (self.known[good] == len(self.parts)).all():
                return np.bincount(self.found.letters[good]), least
            self._look(np.flatnonzero(good))

    def _look(self, places: Array) -> None:
        """Add the next part to the price of those of the places that are furthest behind."""
        part = int(self.known[places].min())
        behind = places[self.known[places] == part]
        self.cost[behind] += self.parts[part].price(self.found[behind])
        self.known[behind] += 1


def placed(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
           letters: LetterSizes = SMALL_SHEET) -> list[Item]:
    """The letters in their places and sizes, with leaders where they had to go far."""
    return lettering(wishes, items, marks, rect, letters).items


class Lettering(NamedTuple):
    """Letters in their places: how many wishes there are, and how many of them had to stand on a line or another mark.
    """

    items: list[Item]
    wished: int = 0
    poor: int = 0


def lettering(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
              letters: LetterSizes = SMALL_SHEET) -> Lettering:
    """The same, and how well they stand."""
    if not wishes:
        return Lettering([])
    wishes = [replace(wish, letters=letters) for wish in wishes]
    found = candidates(wishes, rect)
    prices = Prices(found, (Lines(items), Marks(marks), Surfaces(items)))
    choice = _chosen(prices, len(wishes))
    poor = int((prices.cost[choice] - found.cost[choice] > POOR).sum())
    placed = [item for wish, place in zip(wishes, choice, strict=True) for item in wish.items(found[place])]
    return Lettering(placed, len(wishes), poor)


def _chosen(prices: Prices, count: int) -> Array:
    """One place for every letter: greedily, the fewest good places first, then sweeps of improvement."""
    edges = prices.found.letters.searchsorted(np.arange(count + 1))
    spans = [slice(int(start), int(end)) for start, end in pairwise(edges)]
    choices, least = prices.choices(edges[:-1])
    choice = np.full(count, -1)
    taken = np.full((count, 4), np.nan)  # the boxes of the letters that stand; nothing meets nan
    for _ in range(SWEEPS):
        before = choice.copy()
        for letter in np.lexsort((-least, choices)):
            taken[letter] = np.nan
            choice[letter] = _free_place(prices, spans[letter], taken)
            taken[letter] = prices.found.boxes[choice[letter]]
        if (choice == before).all():
            break
    return choice


def _free_place(prices: Prices, letter: slice, taken: Array) -> int:
    """The cheapest place of a letter beside those that stand: with no thought of them, if it meets none."""
    boxes, best = prices.found.boxes, prices.cheapest(letter)
    if not _overlap(boxes[best : best + 1], taken).any():
        return best
    return prices.cheapest(letter, CLASH * _overlap(boxes[letter], taken))


def _overlap(boxes: Array, others: Array) -> Array:
    """How much of the other letters each box covers: a fixed price for touching, and the area."""
    low, high = boxes[:, :2].min(axis=0) - AIR, boxes[:, 2:].max(axis=0) + AIR
    others = others[((others[:, :2] <= high) & (others[:, 2:] >= low)).all(axis=1)]
    if not len(others):
        return np.zeros(len(boxes))
    wide = np.minimum(boxes[:, None, 2], others[None, :, 2]) - np.maximum(boxes[:, None, 0], others[None, :, 0]) + AIR
    high = np.minimum(boxes[:, None, 3], others[None, :, 3]) - np.maximum(boxes[:, None, 1], others[None, :, 1]) + AIR
    touch = (wide > 0) & (high > 0)
    return np.asarray((touch * (1.0 + np.clip(wide, 0, None) * np.clip(high, 0, None))).sum(axis=1))


# ---- obstacles -----------------------------------------------------------------------------------------------------

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
        share = _share(cells[who], self.start[what], self.end[what])
        who, what, share = who[share >= 0], what[share >= 0], share[share >= 0]
        length = np.hypot(*(self.end - self.start).T)[what] * share
        pairs = np.sort(who * count + self.stroke[what])
        touched, stroke = np.divmod(pairs[np.diff(pairs, prepend=-1) > 0], max(count, 1))
        paid = np.concatenate([length * self.prices[self.stroke[what]], TOUCH * self.prices[stroke]])
        return np.bincount(np.concatenate([who, touched]), paid, len(cells))


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
        self.tree = shapely.STRtree(shapely.points(self.spots))

    def price(self, found: Candidates) -> Array:
        """For every mark that is nearer than the place's own."""
        own = _gap(found.boxes, found.spots)
        who, what = self.tree.query(_diagonals(found.boxes + (own + BESIDE)[:, None] * OUTWARDS))
        foreign = np.hypot(*(self.spots[what] - found.spots[who]).T) > BESIDE
        nearer = foreign & (_gap(found.boxes[who], self.spots[what]) < own[who] + BESIDE)
        return STRANGER * np.bincount(who[nearer], minlength=len(own))


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
        return np.bincount(who, covered * self.rates[what], len(cells))


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
