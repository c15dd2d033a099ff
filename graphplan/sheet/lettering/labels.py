"""Where letters go: beside their mark, off every line if they can be, never on each other.

Each letter may stand in any of many places around its mark. A place costs what it covers: strokes by length and width,
other marks, distance from its own mark. Letters take their cheapest places one by one, the most constrained first, and
then move again as long as that helps; those that cannot be read get many more places, and their neighbours make room
for them. All of it is deterministic.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.sheet.lettering.label_candidates import (
    FINE_RINGS,
    OUTWARDS,
    Array,
    LabelCandidates,
    Wish,
    candidates,
)
from graphplan.sheet.lettering.lettering import SMALL_SHEET, LetterSizes
from graphplan.sheet.lettering.prices import CLASH, FAULT, Lines, Marks, Prices, Standing, Surfaces, overlap
from graphplan.sheet.plates.display import Item, Rect, Spot

MAX_RELABELLINGS = 4
MAX_TRIES = 20  # places for which others are asked to move
MAX_NEIGHBOURS_MOVED = 3  # so many others at most
MIN_SAVING = 0.5  # what a move should save
MAX_PLACES = 150_000  # places on a plan: among so many no second thought puts letters right
MAX_WORK = 8e6  # places times letters: what asking others to move, which looks at all places, may take on a plan


class Relabelling:
    """Letters that change places as long as it helps; `choice` is the place of each.

    Letters that took their places one by one may have left no good one for the last. A letter with a fault takes a
    place where others stand, and these the best that is left to them, wherever that costs less in all (min-conflicts:
    Minton et al., Artificial Intelligence 58, 1992).
    """

    def __init__(self, prices: Prices, choice: Array):
        self.prices, self.choice, self.count = prices, choice.copy(), len(choice)
        self.spans, self.standing = prices.spans(self.count), Standing(self.count)
        self.left = int(MAX_WORK // max(1, len(prices.found.boxes)))
        self.moves, self.stuck = 0, dict[int, int]()  # and after how many moves of any a letter found no better place
        self.paid = dict[int, float]()  # what letters pay where they stand, until one of them moves
        for letter, place in enumerate(choice):
            self.standing.put(letter, prices.found[place])

    @property
    def faulty(self) -> list[int]:
        """The letters that have faults, the worst first."""
        fault = self.prices.faults(self.choice) + self.standing.clashes()
        worst = np.argsort(-fault, kind="stable")
        return [int(letter) for letter in worst if fault[letter] >= FAULT]

    def relabel(self) -> Array:
        """Move letters with faults until none finds a better place; give the places."""
        for _ in range(MAX_RELABELLINGS if len(self.prices.found.boxes) < MAX_PLACES else 0):
            if not sum([self._try(letter) for letter in self.faulty]):
                break
        return self.choice

    def _try(self, letter: int) -> bool:
        """Move a letter to a better place, unless all stand as they did when it found none; whether it moved."""
        moved = self.stuck.get(letter) != self.moves and self._improve(letter)
        self.moves += moved
        if not moved:
            self.stuck[letter] = self.moves
        return moved

    def _improve(self, letter: int) -> bool:
        """Move a letter to a better place, if need be where others stand; whether it moved."""
        span, candidates, before = self.spans[letter], self.prices.found, self._cost(letter)
        places = np.arange(span.start, span.stop)
        alone = self.prices.total(places, before)
        places, alone = places[alone < before - MIN_SAVING], alone[alone < before - MIN_SAVING]
        if not len(places):
            return False
        self.standing.put(letter, None)
        cost = alone + self.standing.clash_costs(candidates[places])
        self.standing.put(letter, candidates[self.choice[letter]])
        improved = bool((cost < before - MIN_SAVING).any())
        if improved:
            self._move(letter, int(places[cost.argmin()]))
            self.paid.clear()
            before = float(cost.min())
        if before - candidates.cost[self.choice[letter]] < FAULT:
            return improved
        tempting = [int(places[k]) for k in alone.argsort(kind="stable")[:MAX_TRIES] if alone[k] < before - MIN_SAVING]
        return any(self._make_room(letter, place, before) for place in tempting) or improved

    def _make_room(self, letter: int, place: int, before: float) -> bool:
        """Give a letter a place where others stand, if these pay less elsewhere than it saves; whether it moved."""
        neighbours = [neighbour for neighbour in self._in_the_way(place) if neighbour != letter]
        if not 0 < len(neighbours) <= MAX_NEIGHBOURS_MOVED or self.left <= 0:
            return False
        self.left -= 1
        was = {moved: int(self.choice[moved]) for moved in (letter, *neighbours)}
        if self._exchange(letter, place, neighbours, before + self._total(neighbours) - MIN_SAVING):
            self.paid.clear()
            return True
        for moved, old in was.items():
            self._move(moved, old)
        return False

    def _exchange(self, letter: int, place: int, neighbours: Sequence[int], most: float) -> bool:
        """Give a letter a place, and its neighbours the cheapest that are left one by one; whether all then pay less
        than `most`. Letters that are placed later make none cheaper, so it ends as soon as that is out of reach."""
        candidates, cost = self.prices.found, self.prices.cost
        spans = [self.spans[neighbour] for neighbour in neighbours]
        budget = most - float(cost[place]) - sum(float(cost[span].min()) for span in spans)
        for neighbour in neighbours:
            self.standing.put(neighbour, None)
        self._move(letter, place)
        for neighbour, span in zip(neighbours, spans, strict=True):
            budget += float(cost[span].min())
            places = span.start + np.flatnonzero(cost[span] < budget)
            if not len(places):
                return False
            clash = self.standing.clash_costs(candidates[places])
            cheapest, price = self.prices.cheapest_of(places, clash, budget)
            self._move(neighbour, int(places[cheapest]))
            budget -= price
            if budget <= 0:
                return False
        return sum(map(self._paid_now, (letter, *neighbours))) < most

    def _total(self, letters: Iterable[int]) -> float:
        """What some letters pay where they stand."""
        return sum(self._cost(letter) for letter in letters)

    def _in_the_way(self, place: int) -> Iterator[int]:
        """The letters on which a place lies."""
        boxes = self.prices.found.boxes[place : place + 1]
        yield from (int(neighbour) for neighbour in np.flatnonzero(self.standing.letters_touching(boxes)))

    def _cost(self, letter: int) -> float:
        """What a letter pays where it stands, looked up once until letters move."""
        if letter not in self.paid:
            self.paid[letter] = self._paid_now(letter)
        return self.paid[letter]

    def _paid_now(self, letter: int) -> float:
        """The same, looked up."""
        place = int(self.choice[letter])
        self.standing.put(letter, None)
        clash = self.standing.clash_costs(self.prices.found[place : place + 1])
        self.standing.put(letter, self.prices.found[place])
        return float(self.prices.total(np.array([place]))[0] + clash[0])

    def _move(self, letter: int, place: int) -> None:
        self.choice[letter] = place
        self.standing.put(letter, self.prices.found[place])


MAX_SWEEPS = 8
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

    @property
    def poor(self) -> int:
        """How many letters find no good place: they could hardly be read there, or need a leader."""
        if not self.wishes:
            return 0
        return int((self.prices.found.led[self.choice] | (self.prices.faults(self.choice) > POOR_PRICE)).sum())

    @property
    def first_items(self) -> list[Item]:
        """The letters in the places that were found quickly."""
        return [item for wish, place in self.first_places for item in wish.items(place)]

    @property
    def first_places(self) -> list[tuple[Wish, LabelCandidates]]:
        """The place of each letter that was found quickly."""
        if self.prices is None or self.choice is None:
            return []
        return [(wish, self.prices.found[place]) for wish, place in zip(self.wishes, self.choice, strict=True)]

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
            choice = Relabelling(prices, new_index[choice]).relabel()
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
    """One place for every letter: greedily, the fewest good places first, then sweeps of improvement."""
    spans = prices.spans(count)
    choices, least = prices.choices(np.array([span.start for span in spans]))
    choice = np.full(count, -1)
    taken = np.full((count, 4), np.nan)  # the boxes of the letters that stand; nothing meets nan
    for _ in range(MAX_SWEEPS):
        before = choice.copy()
        for letter in np.lexsort((-least, choices)):
            taken[letter] = np.nan
            choice[letter] = _free_place(prices, spans[letter], taken)
            taken[letter] = prices.found.boxes[choice[letter]]
        if (choice == before).all():
            break
    return choice


def _free_place(prices: Prices, letter: slice, taken: Array) -> int:
    """The cheapest place of a letter beside those placed already; the cheapest of all, if it meets none of them."""
    boxes, best = prices.found.boxes, prices.cheapest(letter)
    if not overlap(boxes[best : best + 1], taken).any():
        return best
    return prices.cheapest(letter, CLASH * overlap(boxes[letter], taken))
