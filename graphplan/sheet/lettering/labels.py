"""Where letters go: beside their mark, off every line if they can be, never on each other.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark. Letters take their cheapest places one by one, the most constrained first;
those that cannot be read get many more places, and second thoughts. All of it is deterministic.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.sheet.lettering.label_candidates import FINE_RINGS, OUTWARDS, Array, LabelCandidates, Wish, candidates
from graphplan.sheet.lettering.lettering import SMALL_SHEET, LetterSizes
from graphplan.sheet.lettering.prices import CLASH, FAULT, Lines, Marks, Prices, Surfaces
from graphplan.sheet.lettering.relabelling import Relabelling
from graphplan.sheet.lettering.standing import overlap
from graphplan.sheet.plates.display import Item, Rect, Spot

FINE_DIRECTIONS = 24  # from a mark to the places for second thoughts
LED, ON_LINES, HIDDEN = "led", "lines", "hidden"
POOR_PRICE = 2.0  # the price of what a letter covers, from which on it can hardly be read


def place_letters(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
                  letters: LetterSizes = SMALL_SHEET) -> list[Item]:
    """Place letters; those far from their marks get leaders."""
    return lettering(wishes, items, marks, rect, letters).items


@dataclass(frozen=True)
class PlacedLetters:
    """Letters in places that were found quickly, how many of them stand badly there, and where they stand in the end:
    off what is `taken` by others."""

    wishes: Sequence[Wish] = ()
    rect: Rect | None = None
    prices: Any = None
    choice: Any = ()
    taken: tuple[Rect, ...] = ()
    in_haste: bool = False  # whether second thoughts leave other letters where they are

    @property
    def poor(self) -> int:
        """How many letters find no good place: they could hardly be read there, or need a leader."""
        if not self.wishes:
            return 0
        return int((self.prices.found.led[self.choice] | (self.prices.faults(self.choice) > POOR_PRICE)).sum())

    @property
    def first_items(self) -> list[Item]:
        """The letters in the places that were found quickly."""
        if self.prices is None or self.choice is None:
            return []
        return [item for wish, place in zip(self.wishes, self.choice, strict=True)
                for item in wish.items(self.prices.found[place])]

    @property
    def items(self) -> list[Item]:
        """The letters in their last places."""
        return [item for wish, place in self.places for item in wish.items(place)]

    @cached_property
    def places(self) -> list[tuple[Wish, LabelCandidates]]:
        """The last place of each letter; where it is nearer to another mark a leader tells whose it is."""
        if not self.wishes:
            return []
        prices, choice = self._final_choice
        places = prices.found[choice]
        ink = places.boxes - OUTWARDS * [wish.slack for wish in self.wishes]
        places = replace(places, led=places.led | prices.marks.mistaken(replace(places, boxes=ink)))
        return [(wish, places[letter]) for letter, wish in enumerate(self.wishes)]

    @property
    def hidden(self) -> int:
        """How many letters can hardly be read in their last places."""
        return len(self._hidden)

    @cached_property
    def _hidden(self) -> list[int]:
        """Those letters."""
        return Relabelling(*self._final_choice).faulty if self.wishes else []

    @property
    def hidden_items(self) -> list[Item]:
        """Those letters in their last places."""
        return [item for letter in self._hidden for item in self.places[letter][0].items(self.places[letter][1])]

    def doubts(self, fixed: Sequence[Item]) -> Iterator[tuple[Spot, str]]:
        """Which letters are in doubt, by the spots of their marks: those that are `led`, that stand on `lines`, or
        `hidden`, as lines do that are not `fixed` break off at letters."""
        if not self.wishes:
            return
        prices, choice = self._final_choice
        hidden, led = self._hidden, prices.found.led[choice]
        faults = np.zeros(len(hidden))
        for part in (Lines(fixed), prices.marks, prices.surfaces) if hidden else ():
            faults += part.price(prices.found[choice[hidden]])
        kinds = {letter: HIDDEN if fault >= FAULT else ON_LINES for letter, fault in zip(hidden, faults, strict=True)}
        for letter in range(len(self.wishes)):
            if kind := kinds.get(letter, LED if led[letter] else ""):
                x, y = prices.found.spots[choice[letter]].tolist()
                yield (x, y), kind

    @cached_property
    def _final_choice(self) -> tuple[Prices, Array]:
        """What places cost and which are taken, after second thoughts about letters that cannot be read."""
        prices, choice = self.prices.away_from(self.taken), self.choice
        if self.rect and (faulty := sorted(Relabelling(prices, choice).faulty)):
            more = candidates([self.wishes[letter] for letter in faulty], self.rect, FINE_RINGS,
                              FINE_DIRECTIONS).for_letters(faulty)
            prices, new_index = prices.with_more_places(more[~more.meeting(self.taken)])
            choice = Relabelling(prices, new_index[choice]).relabel(makes_room=not self.in_haste)
        return prices, choice


def lettering(wishes: Sequence[Wish], items: Sequence[Item], marks: Sequence[Spot], rect: Rect,
              letters: LetterSizes = SMALL_SHEET) -> PlacedLetters:
    """Place letters, and judge how well they stand."""
    if not wishes:
        return PlacedLetters()
    wishes = [replace(wish, letters=letters) for wish in wishes]
    prices = Prices(candidates(wishes, rect), Lines(items), Marks(marks), Surfaces(items))
    return PlacedLetters(wishes, rect, prices, _choose_places(prices, len(wishes)))


def _choose_places(prices: Prices, count: int) -> Array:
    """One place for every letter: greedily, the fewest good places first."""
    spans = prices.spans(count)
    choices, least = prices.choices(np.array([span.start for span in spans]))
    choice = np.full(count, -1)
    taken = np.full((count, 4), np.nan)  # the boxes of the letters that stand; nothing meets nan
    for letter in np.lexsort((-least, choices)):
        choice[letter] = _free_place(prices, spans[letter], taken)
        taken[letter] = prices.found.boxes[choice[letter]]
    return choice


def _free_place(prices: Prices, letter: slice, taken: Array) -> int:
    """The cheapest place of a letter beside those placed already; the cheapest of all, if it meets none of them."""
    boxes, best = prices.found.boxes, prices.cheapest(letter)
    if not overlap(boxes[best : best + 1], taken).any():
        return best
    return prices.cheapest(letter, CLASH * overlap(boxes[letter], taken))
