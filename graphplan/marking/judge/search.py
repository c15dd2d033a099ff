"""The mistakes that a drawing shows: those that make what is seen likelier than it is without them.

Every mistake of the table is tried at every step that is not clearly right, and every trace that no step needs. At a
glance it is seen what would follow from it; the most promising ones are gone through mark by mark, and the likeliest
way is kept."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge.matching import ASTRAY, UNMARKED, Match, Matching
from graphplan.marking.judge.mistakes import Mistake, mistakes
from graphplan.marking.judge.quick_score import ROUGH, QuickScore
from graphplan.marking.judge.student_sheet import FILED, THERE, apart, plain
from graphplan.marking.judge.verdict import WRONG

TRIED = 16  # how many whole ways are gone through, to try the most promising mistakes
CLEAR, UNLIKELY = 2.5, -4.0  # the weight of a mark that is right, and of a mistake that is none
SQUARE = 4.0  # what a mark that is clearly right may be off beyond the expected, as a sum of squares
SPREAD = 16.0  # how much more may be won than was promised
ODDS, AGAIN = 1.0, 6.0  # what has to speak for a mistake, three to one, and for a further one
DOUBT, FIRST = 1.0, 100.0  # what has to speak for the other of two strokes side by side, which is tried first
RARE, UNNAMED = -3.5, -14.0  # the odds, as logarithms, of a mistake at a step, and of one that no table has
Found = dict[int, int | Mistake]


@dataclass(frozen=True)
class Guess:
    """What a step may have been mistaken for, how likely that is by itself, and how promising."""

    index: int
    one: int | Mistake
    prior: float
    promise: float


class Search:
    """A drawing, as far as before its first step, in which mistakes are looked for."""

    def __init__(self, start: Matching):
        self.start, self._most = start, THERE if start.image else FILED
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
        forks, matching = [], self.start.fork()
        for step in matching.steps:
            forks.append(matching.fork())
            matching.until(step.index + 1, found)
        mistaken = any(matching.matches[index].state == WRONG for index in found)
        best, most = None, matching.weight + (AGAIN if mistaken else ODDS)
        before, enough = self.gone, TRIED * len(matching.steps)
        for guess in sorted(self._guesses(matching, found), key=lambda guess: -guess.promise):
            if guess.promise < ROUGH * (most - matching.weight) - SPREAD or self.gone - before > enough:
                break
            weight = self._weight(matching, forks, found, guess, most)
            if weight > most:
                best, most = guess, weight
        return best

    def _weight(self, matching: Matching, forks: Sequence[Matching], found: Found, guess: Guess, least: float) -> float:
        """The weight of a way with one more mistake; less than everything as soon as it cannot come to the least."""
        touched = self._touched(guess.index)
        other = forks[min(touched)].fork()
        other.found = {**found, guess.index: guess.one}
        hope = guess.prior + sum(self._hope(match, touched) for match in matching.matches[len(other.own):])
        for match in matching.matches[len(other.own):]:
            index = match.step.index
            hope -= self._hope(match, touched)
            try:
                if index in touched or index in other.found or not other.repeat(matching):
                    other.go(other.found.get(index))
                    self.gone += 1
            except Undrawable:
                return -math.inf
            if match.place is not None and index in other.dead:  # what is there, though poor, was drawn by somebody
                other.weight += min(match.weight, 0.0)
            if other.weight + hope < least:
                return -math.inf
        return other.weight + hope

    def _touched(self, index: int) -> set[int]:
        """The steps that a mistake may change: what follows from it, and the strokes to the marks that do."""
        moved = {index}
        for step in self.start.steps[index + 1:]:
            if not moved.isdisjoint(step.args):
                moved.add(step.index)
        return moved | {stroke for stroke, marks in self.start.sheet.marks_on.items() if not moved.isdisjoint(marks)}

    def _hope(self, match: Match, touched: set[int]) -> float:
        """What a step may speak for a way at most."""
        settled = match.step.index not in touched and match.place is not None
        return match.weight if settled else max(match.weight, self._most.get(match.step.op.gives, 0.0))

    def _guesses(self, matching: Matching, found: Found) -> Iterator[Guess]:
        """All that may have been mistaken, with what a glance says for it."""
        quick = QuickScore(matching, {index: one for index, one in found.items() if isinstance(one, Mistake)})
        uses = Counter(match.place for match in matching.matches)
        lost = {arg for match in matching.matches if match.weight < 0 for arg in match.step.args}
        for match in matching.matches:
            if match.step.index in found:
                continue
            if match.place is not None and (match.step.index in lost or uses[match.place] > 1):
                yield from self._others(matching, match)
            right = clear(match) and uses[match.place] == 1
            if not right and match.step.index not in matching.labels and not match.step.op.free:
                yield from self._slips(matching, quick, match)

    def _others(self, matching: Matching, match: Match) -> Iterator[Guess]:
        """The traces that fit a step as well as the one beside them that was taken; or that none of them is its."""
        step, home = match.step, matching.sheet.plan_of_step[match.step.index]
        assert match.place is not None
        for place in matching.unlabelled.beside(match.place, home, plain(matching.own[step.index])):
            if matching.residual(step, match.expected, place, matching.own).fits(matching.rules.chance):
                yield Guess(step.index, place, ODDS - DOUBT, FIRST)
        if step.op.gives == POINT:
            yield Guess(step.index, UNMARKED, ODDS - DOUBT, FIRST)

    def _slips(self, matching: Matching, quick: QuickScore, match: Match) -> Iterator[Guess]:
        """The mistakes that a step may be, those of the table and others: kinds are equally likely, and so is what is
        of one kind."""
        step = match.step
        table = list(mistakes(matching.sheet.drawing.drawn, step, matching.sheet.plan_of_step))
        alike = Counter(mistake.kind for mistake in table)
        for mistake in table:
            prior = RARE - math.log(len(alike)) - math.log(alike[mistake.kind])
            promise = quick.by(mistake) + prior
            if promise > UNLIKELY:
                yield Guess(step.index, mistake, prior, promise)
        for place, value in unmatched(matching, step) if match.place is None and match.weight < 0 else ():
            yield Guess(step.index, place, UNNAMED, quick.gain(step, value) + UNNAMED)


def clear(match: Match) -> bool:
    """Whether a step is so clearly right that no mistake is thought of."""
    off = match.residual
    return off is not None and match.weight >= CLEAR and off.square - len(off.off) < SQUARE


KEPT = 4.0  # standard deviations within which a claim is kept


def unmatched(matching: Matching, step: Step) -> Iterator[tuple[int, tuple[float, ...]]]:
    """The traces that no step needs, a line through one of the points that a step names, or a point on one of its
    lines, anywhere if it names none; with what the step would have made. `walk` has gone through."""
    sheet, kind = matching.sheet, step.op.gives
    mm = sheet.mm(sheet.plan_of_step[step.index])
    on = [plain(matching.own[step.args[claim[1]]]) for claim in step.op.claims if claim[0] == "on"]
    for place in matching.unlabelled.of(kind) if kind in (POINT, LINE) else ():
        if place in matching.used or matching.traces[place].panel not in ("", sheet.plan_of_step[step.index]):
            continue
        spots = sheet.spots(step.index, matching.traces[place])
        value = plain(sheet.seen(step, matching.own[step.index], spots, steady=True))
        off = min((_off(kind, value, thing) for thing in on), default=0.0 if kind == POINT else ASTRAY) * mm
        far = apart(POINT, value, [complex(*plain(matching.own[step.index]))]) * mm if kind == POINT else 0.0
        if off < KEPT * max(sheet.pencil.point, sheet.pencil.edge) and far < ASTRAY:
            yield place, value


def _off(kind: str, value: Sequence[float], thing: Sequence[float]) -> float:
    """How far a point and a line, one of which is a step's, are from each other."""
    line, point = (value, thing) if kind == LINE else (thing, value)
    return apart(LINE, line, [complex(*point[:2])])
