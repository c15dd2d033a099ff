"""The mistakes that a drawing shows: those that make what is seen likelier than it is without them.

Every slip of the table is tried at every step that is not clearly right. At a glance it is seen what would follow
from it; the most promising ones are gone through mark by mark, and the likeliest way is kept.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.evidence import FILED, THERE
from graphplan.marking.judge.matching import UNMARKED, Taken, Walk
from graphplan.marking.judge.mistakes import Slip, slips
from graphplan.marking.judge.quick_score import ROUGH, Glance
from graphplan.marking.judge.student_sheet import plain
from graphplan.marking.judge.unmatched import strays
from graphplan.marking.judge.verdict import WRONG

TRIED = 16  # how many whole ways are gone through, to try the most promising mistakes
CLEAR, UNLIKELY = 2.5, -4.0  # the weight of a mark that is right, and of a mistake that is none
SQUARE = 4.0  # what a mark that is clearly right may be off beyond the expected, as a sum of squares
SPREAD = 16.0  # how much more may be won than was promised
ODDS, AGAIN = 1.0, 6.0  # what has to speak for a mistake, three to one, and for a further one
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
        self.start, self._most = start, THERE if start.sought else FILED
        self.gone = 0  # how many steps were gone through

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
        before, enough = self.gone, TRIED * len(walk.steps)
        for guess in sorted(self._guesses(walk, found), key=lambda guess: -guess.promise):
            if guess.promise < ROUGH * (most - walk.weight) - SPREAD or self.gone - before > enough:
                break
            weight = self._weight(walk, forks, found, guess, most)
            if weight > most:
                best, most = guess, weight
        return best

    def _weight(self, walk: Walk, forks: Sequence[Walk], found: Found, guess: Guess, least: float) -> float:
        """The weight of a way with one more mistake; less than everything as soon as it cannot come to the least."""
        touched = self._touched(guess.index)
        other = forks[min(touched)].fork()
        other.found = {**found, guess.index: guess.one}
        hope = guess.prior + sum(self._hope(taken, touched) for taken in walk.taken[len(other.own):])
        for taken in walk.taken[len(other.own):]:
            index = taken.step.index
            hope -= self._hope(taken, touched)
            try:
                if index in touched or index in other.found or not other.repeat(walk):
                    other.go(other.found.get(index))
                    self.gone += 1
            except Undrawable:
                return -math.inf
            if taken.place is not None and index in other.dead:  # what is there, though poor, was drawn by somebody
                other.weight += min(taken.weight, 0.0)
            if other.weight + hope < least:
                return -math.inf
        return other.weight + hope

    def _touched(self, index: int) -> set[int]:
        """The steps that a mistake may change: what follows from it, and the strokes to the marks that do."""
        moved = {index}
        for step in self.start.steps[index + 1:]:
            if not moved.isdisjoint(step.args):
                moved.add(step.index)
        return moved | {stroke for stroke, marks in self.start.board.marks_on.items() if not moved.isdisjoint(marks)}

    def _hope(self, taken: Taken, touched: set[int]) -> float:
        """What a step may speak for a way at most."""
        settled = taken.step.index not in touched and taken.place is not None
        return taken.weight if settled else max(taken.weight, self._most.get(taken.step.op.gives, 0.0))

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
        """The traces that fit a step as well as the one beside them that was taken; or that none of them is its."""
        step, home = taken.step, walk.board.plan_of_step[taken.step.index]
        assert taken.place is not None
        for place in walk.loose.beside(taken.place, home, plain(walk.own[step.index])):
            if walk.deviation(step, taken.expected, place, walk.own).fits(walk.rules.chance):
                yield Guess(step.index, place, ODDS - DOUBT, FIRST)
        if step.op.gives == POINT:
            yield Guess(step.index, UNMARKED, ODDS - DOUBT, FIRST)

    def _slips(self, walk: Walk, glance: Glance, taken: Taken) -> Iterator[Guess]:
        """The mistakes that a step may be, those of the table and others: kinds are equally likely, and so is what is
        of one kind."""
        step = taken.step
        table = list(slips(walk.board.drawing.drawn, step, walk.board.plan_of_step))
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
