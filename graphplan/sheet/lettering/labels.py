"""Where letters go: beside their mark, off every line if they can be, never on each other.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark. Letters take their cheapest places one by one, the most constrained first, and
then move again as long as that helps; those that cannot be read get many more places. All of it is deterministic.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphplan.sheet.lettering.label_candidates import FINE, Array, Candidates, Wish, candidates
from graphplan.sheet.lettering.lettering import SMALL_SHEET, LetterSizes
from graphplan.sheet.lettering.obstacles import Lines, Marks, Surfaces
from graphplan.sheet.lettering.prices import CLASH, Prices, overlap
from graphplan.sheet.lettering.resettling import Resettling
from graphplan.sheet.plates.display import Item, Rect, Spot

SWEEPS = 8
WAYS = 24  # from a mark to the places for second thoughts
POOR = 2.0  # the price of what a letter covers, from which on it can hardly be read


def placed(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
           letters: LetterSizes = SMALL_SHEET) -> list[Item]:
    """The letters in their places and sizes, with leaders where they had to go far."""
    return lettering(wishes, items, marks, rect, letters).items


@dataclass(frozen=True)
class Lettering:
    """Letters in places that were found quickly, and how many of them stand badly there."""

    wishes: Sequence[Wish] = ()
    rect: Rect | None = None
    prices: Prices | None = None
    choice: Array | None = None

    @property
    def poor(self) -> int:
        """How many letters find no good place: they could hardly be read there, or need a leader."""
        if self.prices is None or self.choice is None:
            return 0
        return int((self.prices.found.led[self.choice] | (self.prices.faults(self.choice) > POOR)).sum())

    @property
    def items(self) -> list[Item]:
        """The letters in their last places."""
        return [item for wish, place in self.places for item in wish.items(place)]

    @cached_property
    def places(self) -> list[tuple[Wish, Candidates]]:
        """The last place of each letter, after second thoughts about those that cannot be read."""
        if self.prices is None or self.choice is None or self.rect is None:
            return []
        prices, choice = self.prices, self.choice
        if faulty := sorted(Resettling(prices, choice).faulty):
            more = candidates([self.wishes[letter] for letter in faulty], self.rect, FINE, WAYS).of(faulty)
            prices, moved = prices.extended(more)
            choice = Resettling(prices, moved[choice]).settled()
        return [(wish, prices.found[place]) for wish, place in zip(self.wishes, choice, strict=True)]


def lettering(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
              letters: LetterSizes = SMALL_SHEET) -> Lettering:
    """The same, and how well they stand."""
    if not wishes:
        return Lettering()
    wishes = [replace(wish, letters=letters) for wish in wishes]
    prices = Prices(candidates(wishes, rect), (Lines(items), Marks(marks), Surfaces(items)))
    return Lettering(wishes, rect, prices, _chosen(prices, len(wishes)))


def _chosen(prices: Prices, count: int) -> Array:
    """One place for every letter: greedily, the fewest good places first, then sweeps of improvement."""
    spans = prices.spans(count)
    choices, least = prices.choices(np.array([span.start for span in spans]))
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
    if not overlap(boxes[best : best + 1], taken).any():
        return best
    return prices.cheapest(letter, CLASH * overlap(boxes[letter], taken))
