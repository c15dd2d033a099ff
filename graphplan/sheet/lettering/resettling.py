"""Second thoughts about letters: those that cannot be read move, and their neighbours make room for them.

Letters that took their places one by one may have left no good one for the last. A letter with a fault takes a place
where others stand, and these the best that is left to them, wherever that costs less in all (min-conflicts: Minton et
al., Artificial Intelligence 58, 1992).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graphplan.sheet.lettering.label_candidates import Array
from graphplan.sheet.lettering.obstacles import FAULT
from graphplan.sheet.lettering.prices import Prices, Standing

ROUNDS = 4
TRIES = 20  # places for which others are asked to move
MOVED = 3  # so many others at most
BETTER = 0.5  # what a move should save
HEAP = 150_000  # places on a plan: among so many no second thought puts letters right
WORK = 8e6  # places times letters: what asking others to move may take on a plan; each time looks at all of its places


class Resettling:
    """Letters at their places, that change them as long as it helps; `choice` is the place of each."""

    def __init__(self, prices: Prices, choice: Array):
        self.prices, self.choice, self.count = prices, choice.copy(), len(choice)
        self.spans, self.standing = prices.spans(self.count), Standing(self.count)
        self.left = int(WORK // max(1, len(prices.found.boxes)))
        for letter, place in enumerate(choice):
            self.standing.put(letter, prices.found[place])

    @property
    def faulty(self) -> list[int]:
        """The letters that have faults, the worst first."""
        fault = self.prices.faults(self.choice)
        fault += [self._met_at(letter, self.choice[letter]) for letter in range(self.count)]
        worst = np.argsort(-fault, kind="stable")
        return [int(letter) for letter in worst if fault[letter] >= FAULT]

    def settled(self) -> Array:
        """The places when no letter with a fault finds a better one."""
        for _ in range(ROUNDS if len(self.prices.found.boxes) < HEAP else 0):
            if not sum([self._improved(letter) for letter in self.faulty]):
                break
        return self.choice

    def _met_at(self, letter: int, place: int) -> float:
        """What a letter pays at a place for the others that stand."""
        self.standing.put(letter, None)
        met = float(self.standing.met(self.prices.found[place : place + 1])[0])
        self.standing.put(letter, self.prices.found[self.choice[letter]])
        return met

    def _improved(self, letter: int) -> bool:
        """Whether a letter found a better place, if need be where others stood."""
        span, found, before = self.spans[letter], self.prices.found, self._cost(letter)
        places = np.arange(span.start, span.stop)
        alone = self.prices.total(places, before)
        places, alone = places[alone < before - BETTER], alone[alone < before - BETTER]
        if not len(places):
            return False
        self.standing.put(letter, None)
        cost = alone + self.standing.met(found[places])
        self.standing.put(letter, found[self.choice[letter]])
        moved = bool((cost < before - BETTER).any())
        if moved:
            self._move(letter, int(places[cost.argmin()]))
            before = float(cost.min())
        if before - found.cost[self.choice[letter]] < FAULT:
            return moved
        tempting = [int(places[k]) for k in alone.argsort(kind="stable")[:TRIES] if alone[k] < before - BETTER]
        return any(self._made_room(letter, place, before) for place in tempting) or moved

    def _made_room(self, letter: int, place: int, before: float) -> bool:
        """Whether a letter takes a place because those that stand there pay less elsewhere than it saves."""
        others = [other for other in self._in_the_way(place) if other != letter]
        if not 0 < len(others) <= MOVED or self.left <= 0:
            return False
        self.left -= 1
        was = {one: int(self.choice[one]) for one in (letter, *others)}
        paid = before + sum(self._cost(other) for other in others)
        for other in others:
            self.standing.put(other, None)
        self._move(letter, place)
        for other in others:
            span = self.spans[other]
            self._move(other, self.prices.cheapest(span, self.standing.met(self.prices.found[span])))
        if sum(self._cost(one) for one in was) < paid - BETTER:
            return True
        for one, old in was.items():
            self._move(one, old)
        return False

    def _in_the_way(self, place: int) -> Iterator[int]:
        """The letters on which a place lies."""
        boxes = self.prices.found.boxes[place : place + 1]
        yield from (int(other) for other in np.flatnonzero(self.standing.touched(boxes)))

    def _cost(self, letter: int) -> float:
        """What a letter pays where it stands."""
        place = int(self.choice[letter])
        return float(self.prices.total(np.array([place]))[0]) + self._met_at(letter, place)

    def _move(self, letter: int, place: int) -> None:
        self.choice[letter] = place
        self.standing.put(letter, self.prices.found[place])
