"""The mistakes that a drawing shows: those that make what is seen likelier than it is without them.

Every slip of the table is tried at every step that is not clearly right. At a glance it is seen what would follow
from it; the most promising ones are gone through mark by mark, and the likeliest way is kept.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from graphplan.errors import Undrawable
from graphplan.verify.board import plain
from graphplan.verify.glance import Glance, strokes
from graphplan.verify.mistakes import Slip, slips
from graphplan.verify.strays import strays
from graphplan.verify.verdict import WRONG
from graphplan.verify.walk import Taken, Walk

TRIED = 16  # how many of the most promising mistakes are gone through
CLEAR, UNLIKELY = 2.5, -4.0  # the weight of a mark that is right, and of a mistake that is none
SQUARE = 4.0  # what a mark that is clearly right may be off beyond the expected, as a sum of squares
SPREAD = 16.0  # how much more may be won than was promised
ODDS, AGAIN = 2.0, 6.0  # what has to speak for a mistake, seven to one, and for a further one
DOUBT, FIRST = 1.0, 100.0  # what has to speak for the other of two strokes side by side, which is tried first
RARE, UNNAMED = -3.5, -14.0  # the odds, as logarithms, of a mistake at a step, and of one that no table has
Found = dict[int, int | Slip]


@dataclass(frozen=True)
class Guess:
    """What a step may have been mistaken for, how likely that is by itself, and how promising."""

    index: int
    one: int | Slip
    prior: float
    promise: float


class Search:
    """A drawing, as far as before its first step, in which mistakes are looked for."""

    def __init__(self, start: Walk):
        self.start = start

    def found(self, most: int) -> Found:
        """What up to so many steps were mistaken for; empty where nothing speaks for a mistake."""
        found: Found = {}
        for _ in range(most):
            more = self._more(found)
            if more is None:
                break
            found[more.index] = more.one
        return found

    def _more(self, found: Found) -> Guess | None:
        """One more mistake, if the way is likelier with it."""
        forks, walk = [], self.start.fork()
        for step in walk.steps:
            forks.append(walk.fork())
            walk.until(step.index + 1, found)
        mistaken = any(walk.taken[index].state == WRONG for index in found)
        best, most = None, walk.weight + (AGAIN if mistaken else ODDS)
        guesses = sorted(self._guesses(walk, found), key=lambda guess: -guess.promise)[:TRIED]
        for guess in guesses:
            if guess.promise < most - walk.weight - SPREAD:
                break
            try:
                begin = forks[min([guess.index, *strokes(walk, guess.index)])]
                weight = begin.fork().through({**found, guess.index: guess.one}).weight + guess.prior
            except Undrawable:
                continue
            if weight > most:
                best, most = guess, weight
        return best

    def _guesses(self, walk: Walk, found: Found) -> Iterator[Guess]:
        """All that may have been mistaken, with what a glance says for it."""
        glance = Glance(walk, {index: one for index, one in found.items() if isinstance(one, Slip)})
        uses = Counter(taken.place for taken in walk.taken)
        lost = {arg for taken in walk.taken if taken.weight < 0 for arg in taken.step.args}
        for taken in walk.taken:
            if taken.step.index in found:
                continue
            if taken.place is not None and (taken.step.index in lost or uses[taken.place] > 1):
                yield from self._others(walk, taken)
            right = clear(taken) and uses[taken.place] == 1
            if not right and taken.step.index not in walk.labels and taken.step.op.name not in ("given", "begin"):
                yield from self._slips(walk, glance, taken)

    def _others(self, walk: Walk, taken: Taken) -> Iterator[Guess]:
        """The traces that fit a step as well as the one beside them that was taken."""
        step, home = taken.step, walk.board.homes[taken.step.index]
        assert taken.place is not None
        for place in walk.loose.beside(taken.place, home, plain(walk.own[step.index])):
            if walk.deviation(step, taken.expected, place, walk.own).fits(walk.rules.chance):
                yield Guess(step.index, place, ODDS - DOUBT, FIRST)

    def _slips(self, walk: Walk, glance: Glance, taken: Taken) -> Iterator[Guess]:
        """The mistakes that a step may be, those of the table and others: kinds are equally likely, and so is what is
        of one kind."""
        step = taken.step
        table = list(slips(walk.board.drawing.drawn, step, walk.board.homes))
        alike = Counter(slip.kind for slip in table)
        for slip in table:
            prior = RARE - math.log(len(alike)) - math.log(alike[slip.kind])
            promise = glance.by(slip) + prior
            if promise > UNLIKELY:
                yield Guess(step.index, slip, prior, promise)
        for place, value in strays(walk, step) if taken.place is None and taken.weight < 0 else ():
            yield Guess(step.index, place, UNNAMED, glance.won(step, value) + UNNAMED)


def clear(taken: Taken) -> bool:
    """Whether a step is so clearly right that no mistake is thought of."""
    off = taken.deviation
    return off is not None and taken.weight >= CLEAR and off.square - len(off.off) < SQUARE
