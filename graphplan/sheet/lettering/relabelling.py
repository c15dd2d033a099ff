"""Second thoughts about letters: those with a fault change places as long as it helps, and their neighbours make room.

Letters that took their places one by one may have left no good one for the last. A letter with a fault takes a place
where others stand, and these the best that is left to them, wherever that costs less in all (min-conflicts: Minton et
al., Artificial Intelligence 58, 1992). Most exchanges come to nothing. They are tried without moving a letter, and what
the places of a neighbour cost beside all letters that stay is found once for all places of the one that it makes room
for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphplan.sheet.lettering.label_candidates import Array
from graphplan.sheet.lettering.prices import (
    CLASH,
    FAULT,
    Clashes,
    Footprints,
    Prices,
    clashes,
    costs_of_all,
    letters_touched,
    overlap,
)

MAX_RELABELLINGS = 4
MAX_TRIES = 20  # places for which others are asked to move
MAX_NEIGHBOURS_MOVED = 3  # so many others at most
MIN_SAVING = 0.5  # what a move should save
MAX_PLACES = 150_000  # places on a plan: among so many no second thought puts letters right
MAX_WORK = 8e6  # places times letters: what asking others to move, which looks at all places, may take on a plan


@dataclass(frozen=True)
class OpenPlaces:
    """Places of a letter by their numbers, what it covers there, and what is wrong with them beside some others."""

    numbers: Array
    footprints: Footprints
    beside: Clashes


class Relabelling:
    """Letters that change places as long as it helps; `choice` is the place of each."""

    def __init__(self, prices: Prices, choice: Array):
        self.prices, self.choice, self.count = prices, choice.copy(), len(choice)
        self.spans, self.footprints = prices.spans(self.count), Footprints.of(prices.found)
        self.left = int(MAX_WORK // max(1, len(prices.found.boxes)))
        self.moves, self.stuck = 0, dict[int, int]()  # and after how many moves of any a letter found no better place
        self._note_standing()

    @property
    def faulty(self) -> list[int]:
        """The letters that have faults, the worst first."""
        fault = self.prices.faults(self.choice) + costs_of_all(self.standing)
        worst = np.argsort(-fault, kind="stable")
        return [int(letter) for letter in worst if fault[letter] >= FAULT]

    @property
    def misplaced_letters(self) -> list[int]:
        """The letters that have faults, the worst first, and those at the ends of long leaders."""
        faulty = self.faulty
        far = self.prices.found[self.choice].is_far.nonzero()[0].tolist()
        return [*faulty, *(letter for letter in far if letter not in faulty)]

    def relabel(self, makes_room: bool = True) -> None:
        """Move misplaced letters, with or without others making room, until no letter finds a better place."""
        self.left *= makes_room
        for _ in range(MAX_RELABELLINGS if len(self.prices.found.boxes) < MAX_PLACES else 0):
            if not sum([self._try(letter) for letter in self.misplaced_letters]):
                return

    def _try(self, letter: int) -> bool:
        """Move a letter to a better place, unless all stand as when it last found no better one; return whether it
        moved."""
        moved = self.stuck.get(letter) != self.moves and self._improve(letter)
        self.moves += moved
        if not moved:
            self.stuck[letter] = self.moves
        return moved

    def _improve(self, letter: int) -> bool:
        """Move a letter to a better place, if need be where others stand; whether it moved."""
        span, before = self.spans[letter], float(self.paid[letter])
        numbers = np.arange(span.start, span.stop)
        alone = self.prices.total(numbers, before)
        numbers, alone = numbers[alone < before - MIN_SAVING], alone[alone < before - MIN_SAVING]
        if not len(numbers):
            return False
        cost = alone + clashes(self.footprints[numbers], self._all_but(letter)).cost
        improved = bool((cost < before - MIN_SAVING).any())
        if improved:
            self._move({letter: int(numbers[cost.argmin()])})
            before = float(cost.min())
        place = self.prices.found[self.choice[letter]]
        if self.left <= 0 or (before - place.cost < FAULT and not place.is_far):
            return improved
        tempting = [k for k in alone.argsort(kind="stable")[:MAX_TRIES] if alone[k] < before - MIN_SAVING]
        return self._make_room(letter, numbers[tempting], before) or improved

    def _make_room(self, letter: int, places: Array, before: float) -> bool:
        """Give a letter the first place where others stand, if these pay less elsewhere than it saves; whether it
        moved."""
        touched = letters_touched(self.footprints[places], self.standing)
        touched[:, letter] = False
        open_places = dict[tuple[int, ...], OpenPlaces]()
        for place, row in zip(places.tolist(), touched, strict=True):
            neighbours = row.nonzero()[0].tolist()
            if not 0 < len(neighbours) <= MAX_NEIGHBOURS_MOVED or self.left <= 0:
                continue
            self.left -= 1
            if self._exchange(letter, place, neighbours, before, open_places):
                return True
        return False

    def _exchange(self, letter: int, place: int, neighbours: Sequence[int], before: float,
                  open_places: dict[tuple[int, ...], OpenPlaces]) -> bool:
        """Give a letter a place, and its neighbours the cheapest remaining ones in turn, if the total price falls;
        return whether it does. `spare` is the saving if each had the cheapest place still open: the search ends when it
        is zero."""
        most = before + sum(self.paid[neighbours].tolist()) - MIN_SAVING
        least = [float(self.prices.cost[self.spans[neighbour]].min()) for neighbour in neighbours]
        spare = first = most - float(self.prices.cost[place]) - sum(least)
        options = list[OpenPlaces]()
        for neighbour, low in zip(neighbours, least, strict=True):
            if spare <= 0:
                return False
            if (key := (neighbour, letter, *neighbours)) not in open_places:
                open_places[key] = self._open_places(neighbour, {letter, *neighbours}, first + low)
            options.append(self._places_beside(open_places[key], [place], spare + low))
            spare += low - self._least_cost(options[-1])
        moved = {letter: place}
        for neighbour, option in zip(neighbours, options, strict=True):
            low, earlier = self._least_cost(option), [*moved.values()][1:]
            clear = self._places_beside(option, earlier, spare + low) if earlier else option
            if spare <= 0 or not (cheapest := self._cheapest(clear, spare + low)):
                return False
            moved[neighbour], price = cheapest
            spare += low - price
        return self._pay_less(moved, most)

    def _pay_less(self, moved: dict[int, int], most: float) -> bool:
        """Move letters if they pay less than `most` in all; whether they do."""
        was = {letter: int(self.choice[letter]) for letter in moved}
        self._move(moved)
        if sum(self.paid[[*moved]].tolist()) < most:
            return True
        self._move(was)
        return False

    def _open_places(self, letter: int, leaving: set[int], most: float) -> OpenPlaces:
        """The places of a letter that may cost less than `most` beside letters that are not leaving."""
        span = self.spans[letter]
        numbers = span.start + (self.prices.cost[span] < most).nonzero()[0]
        nothing = np.zeros(len(numbers), dtype=bool)
        every = OpenPlaces(numbers, self.footprints[numbers], Clashes(np.zeros(len(numbers)), nothing, nothing))
        return self._narrow(every, self._all_but(*leaving), most)

    def _places_beside(self, options: OpenPlaces, moved: Sequence[int], most: float) -> OpenPlaces:
        """Places that may cost less than `most` beside letters at moved places as well."""
        return self._narrow(options, self.footprints[moved], most)

    def _narrow(self, options: OpenPlaces, others: Footprints, most: float) -> OpenPlaces:
        """Places that may cost less than `most` beside others as well."""
        cost = self.prices.cost[options.numbers] + options.beside.cost
        near = (cost < most).nonzero()[0]
        if len(near):
            covered = overlap(options.footprints.boxes[near], others.boxes)
            clear = cost[near] + CLASH * covered < most
            near, covered = near[clear], covered[clear]
        footprints = options.footprints[near]
        beside = options.beside[near] + clashes(footprints, others, covered) if len(near) else options.beside[near]
        return OpenPlaces(options.numbers[near], footprints, beside)

    def _least_cost(self, options: OpenPlaces) -> float:
        """Lower bound of the prices of some places."""
        return float((self.prices.cost[options.numbers] + options.beside.cost).min(initial=np.inf))

    def _cheapest(self, options: OpenPlaces, most: float) -> tuple[int, float] | None:
        """The cheapest of some places of a letter, and its price, if less than `most`."""
        if not len(options.numbers):
            return None
        cheapest, price = self.prices.cheapest_of(options.numbers, options.beside.cost, most)
        return (int(options.numbers[cheapest]), price) if price < most else None

    def _all_but(self, *letters: int) -> Footprints:
        """Footprints of the other letters."""
        return self.standing[np.delete(np.arange(self.count), letters)]

    def _move(self, places: dict[int, int]) -> None:
        """Put letters at places."""
        for letter, place in places.items():
            self.choice[letter] = place
        self._note_standing()

    def _note_standing(self) -> None:
        """Note where letters stand, and what each pays there."""
        self.standing = self.footprints[self.choice]
        self.paid = self.prices.total(self.choice) + costs_of_all(self.standing)
