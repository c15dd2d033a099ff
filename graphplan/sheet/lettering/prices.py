"""What the places of letters cost: by themselves, and beside the letters that stand already."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from graphplan.sheet.lettering.label_candidates import AIR, Array, Candidates
from graphplan.sheet.lettering.obstacles import FAULT, Lines, Marks, Surfaces, share

CLASH = 400.0  # the price of standing on another letter, and of each mm^2 of that
NEXT = 1.5  # a place dearer by no more than this is a choice as well


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

    def total(self, places: Array, most: float = np.inf) -> Array:
        """What some places cost, in full where that is less than `most`."""
        while (behind := places[(self.known[places] < len(self.parts)) & (self.cost[places] < most)]).size:
            self._look(behind)
        return self.cost[places]

    def faults(self, places: Array) -> Array:
        """What of the cost of some places is for what they cover, and not for being far away."""
        return self.total(places) - self.found.cost[places]

    def extended(self, more: Candidates) -> tuple[Prices, Array]:
        """The prices with more places for some letters, and where each place went."""
        every = self.found.joined(more)
        order = every.letters.argsort(kind="stable")
        longer = Prices(every[order], self.parts)
        count = len(self.cost)
        moved = np.empty(len(order), dtype=int)
        moved[order] = np.arange(len(order))
        longer.cost[moved[:count]], longer.known[moved[:count]] = self.cost, self.known
        return longer, moved[:count]

    def spans(self, count: int) -> list[slice]:
        """Where the places of each letter are."""
        edges = self.found.letters.searchsorted(np.arange(count + 1))
        return [slice(int(start), int(end)) for start, end in pairwise(edges)]


class Standing:
    """The letters that stand: their boxes, and their leaders; nothing meets nan."""

    def __init__(self, count: int):
        self.boxes, self.leaders = np.full((count, 4), np.nan), np.full((count, 4), np.nan)

    def put(self, letter: int, place: Candidates | None) -> None:
        """A letter stands at a place, or nowhere."""
        self.boxes[letter] = self.leaders[letter] = np.nan
        if place is not None:
            self.boxes[letter] = place.boxes
            if place.led:
                self.leaders[letter] = *place.spots, *place.ends

    def touched(self, boxes: Array) -> Array:
        """Which letters stand in any of some boxes, or have a leader that goes through one."""
        low, high = boxes[:, None, :2] - AIR, boxes[:, None, 2:] + AIR
        there = ((self.boxes[:, :2] < high) & (self.boxes[:, 2:] > low)).all(axis=2).any(axis=0)
        return np.asarray(there | _crossings(boxes, self.leaders).any(axis=0))

    def met(self, places: Candidates) -> Array:
        """What it costs places that other letters stand there, or that a leader goes through letters."""
        crossed = np.zeros(len(places.boxes))
        led, lines = np.flatnonzero(places.led), self.leaders[~np.isnan(self.leaders[:, 0])]
        boxes = self.boxes[~np.isnan(self.boxes[:, 0])]
        crossed[led] += _crossings(boxes, np.hstack([places.spots[led], places.ends[led]])).any(axis=0)
        crossed += _crossings(places.boxes, lines).any(axis=1)
        return CLASH * overlap(places.boxes, self.boxes) + FAULT * crossed


def _crossings(boxes: Array, lines: Array) -> Array:
    """Which boxes (rows) the lines (columns) go through."""
    shape = len(boxes), len(lines)
    cells, ends = np.repeat(boxes, len(lines), axis=0), np.tile(lines, (len(boxes), 1))
    return (share(cells, ends[:, :2], ends[:, 2:]) > 0).reshape(shape)


def overlap(boxes: Array, others: Array) -> Array:
    """How much of the other letters each box covers: a fixed price for touching, and the area."""
    low, high = boxes[:, :2].min(axis=0) - AIR, boxes[:, 2:].max(axis=0) + AIR
    others = others[((others[:, :2] <= high) & (others[:, 2:] >= low)).all(axis=1)]
    if not len(others):
        return np.zeros(len(boxes))
    wide = np.minimum(boxes[:, None, 2], others[None, :, 2]) - np.maximum(boxes[:, None, 0], others[None, :, 0]) + AIR
    high = np.minimum(boxes[:, None, 3], others[None, :, 3]) - np.maximum(boxes[:, None, 1], others[None, :, 1]) + AIR
    touch = (wide > 0) & (high > 0)
    return np.asarray((touch * (1.0 + np.clip(wide, 0, None) * np.clip(high, 0, None))).sum(axis=1))
