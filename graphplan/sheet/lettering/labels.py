"""Where letters go: beside their mark, off every line if they can be, never on each other.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark. Letters take their cheapest places one by one, the most constrained first, and
then move again as long as that helps. All of it is deterministic.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from graphplan.sheet.lettering.label_candidates import AIR, BALLOON, SMALL, Array, Candidates, Wish, candidates
from graphplan.sheet.lettering.lettering import CAPS
from graphplan.sheet.lettering.obstacles import Lines, Marks, Surfaces
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Rect, Spot, Text

CLASH = 400.0  # the price of standing on another letter, and of each mm^2 of that
NEXT = 1.5  # a place dearer by no more than this is a choice as well
SWEEPS = 8


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


def placed(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect) -> list[Item]:
    """The letters in their places, with leaders where they had to go far."""
    if not wishes:
        return []
    found = candidates(wishes, rect)
    choice = _chosen(Prices(found, (Lines(items), Marks(marks), Surfaces(items))), len(wishes))
    return [item for wish, place in zip(wishes, choice, strict=True) for item in _items(wish, found[place])]


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


def _items(wish: Wish, place: Candidates) -> Iterator[Item]:
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
        x, y = left, low + wish.size * wish.depth
        yield Text(wish.pen, "letters", wish.step, (x, y), wish.runs, wish.size, bold=wish.bold, label=wish.label)
        if wish.raised:
            yield Text(pens.FAINT, "letters", wish.step, (x + wish.tail, y + wish.lift), wish.figures, SMALL,
                       label=f"step {wish.raised}")
