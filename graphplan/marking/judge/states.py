"""What is said of each step that was gone through, and how sure that is: by how much likelier its mark is there than
not, and by the right marks that rest on it.

Matching weighs every mark in logarithms of odds. A faint mark is sure all the same where others go on rightly from it,
and one that is not to be seen at all is implied there; what is rather not there than there cannot be told.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import cached_property

from graphplan.kernel.kinds import OPENING
from graphplan.marking.judge import measures
from graphplan.marking.judge.asked import shown_by
from graphplan.marking.judge.evidence import KnownMarks, unexplained
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.student_sheet import bound, plain
from graphplan.marking.judge.verdict import EARNED, IMPLIED, MISSING, UNSEEN, UNSURE, WRONG, NumberVerdict
from graphplan.marking.traces import Trace


class States:
    """The states of the steps of a drawing; a number that is right shows its result as a drawn mark does."""

    def __init__(self, matching: Matching, numbers: Iterable[NumberVerdict] = ()):
        self.matching = matching
        right = {(one.number.kind, one.number.of) for one in numbers if one.state in EARNED}
        self.told, self.asked = set[int](), set[int]()  # the marks of results with such a number, and of others
        for reading in matching.sheet.drawing.readings:
            if reading.given is None:
                shown = shown_by(matching.sheet.drawing, reading)
                (self.told if (reading.kind, reading.of) in right else self.asked).update(shown)

    def of(self, match: Match) -> tuple[str, float]:
        """The state of a step, and how sure that is, from 0 to 1."""
        odds = self.odds[match.step.index]
        if match.state == WRONG:
            return WRONG, sureness(self._against(match))
        if match.step.op.free or (odds == -math.inf and self._untold(match)):
            return match.state, sureness(-match.weight if match.place is None else odds)
        if odds > -math.inf:
            state = match.state if match.place is not None else IMPLIED
            elsewhere = match.weight < 0.0 and self.beside(match)  # it could be seen, and something else is there
            return UNSURE if odds < 0.0 or elsewhere else state, sureness(odds)
        if self.drawn[match.step.index] and match.step.index not in self.lost:
            return UNSEEN, sureness(-match.weight)
        return UNSURE if self._hidden(match) or self.beside(match) else MISSING, sureness(-match.weight)

    def _untold(self, match: Match) -> bool:
        """Whether nobody asks for a step's mark: it is too small to draw, or there are but numbers."""
        return match.step.index in self.matching.sheet.hidden or not self.matching.traces

    def _hidden(self, match: Match) -> bool:
        """Whether print hides where a step's mark should be in a picture."""
        known = KnownMarks(self.matching.own, {})
        return self.matching.evidence.picture and match.step.op.gives != OPENING and (
            match.step.index not in self.matching.dead
            and self.matching.evidence.share(match.step, match.expected, known) is None)

    def beside(self, match: Match) -> Trace | None:
        """The nearest ink of its kind that no step explains, beside where a step's mark should be."""
        if match.place is not None or match.step.op.gives == OPENING:
            return None
        home = self.matching.sheet.plan_of_step[match.step.index]
        places, off = self.matching.evidence.near(match.step.op.gives, home, plain(match.expected))
        near = [place for far, place in sorted(zip(off, places, strict=True)) if far < measures.MISSING_NEAR_MM]
        free = [self.matching.traces[place] for place in near if place not in self.matching.used]
        return next(iter(unexplained(free, self._explained)), None)

    @cached_property
    def _explained(self) -> list[Trace]:
        """The traces that steps are taken for."""
        return [self.matching.traces[place] for place in self.matching.used]

    # ---- what speaks for it ----------------------------------------------------------------------------------------

    @cached_property
    def odds(self) -> list[float]:
        """For each step what speaks for its having been drawn as it should be: its own mark, or the surest of those
        that rest on it, themselves or through others that are not to be seen; less than everything where none is."""
        found = [self._own(match) for match in self.matching.matches]
        for match in reversed(self.matching.matches):
            index, seen = match.step.index, match.place is not None or match.state == WRONG
            if index in self.lost:
                found[index] = -math.inf
            for arg in match.step.args if match.state in EARNED or not seen else ():
                found[arg] = max(found[arg], found[index])
        return found

    def _own(self, match: Match) -> float:
        """What a step's own mark speaks for it; or a number, or the strokes that cross there."""
        if match.place is not None:
            return match.weight if match.state in EARNED else -math.inf
        if match.step.index in self.told:
            return measures.MAX_SURE_ODDS
        strokes = [self.matching.matches[arg] for arg in match.step.args]
        seen = [stroke.weight for stroke in strokes if stroke.place is not None and stroke.state in EARNED]
        crossed = match.step.op.crossing and match.state != WRONG and seen and (
            len(seen) == len(strokes) or self._hidden(match))
        return min(seen) if crossed else -math.inf

    @cached_property
    def lost(self) -> set[int]:
        """The marks of results that are asked for, and cannot be read off where they are not marked: they are missing,
        whatever rests on them. Those need no mark that lie on strokes, and in a picture, where dots are lost, none."""
        if self.matching.evidence.picture:
            return set()
        sheet, matches = self.matching.sheet, self.matching.matches
        strokes = [match.step.index for match in matches if match.place is not None and match.state in EARNED]
        legible = {mark for stroke in strokes for mark in sheet.marks_on.get(stroke, ())}
        seen = {match.step.index for match in matches if match.place is not None}
        return self.asked - self.told - legible - seen - set(sheet.hidden)

    @cached_property
    def drawn(self) -> list[bool]:
        """For each step whether it is seen, or a mark that rests on it is: then it was drawn somehow."""
        found = [match.place is not None for match in self.matching.matches]
        for step in reversed(self.matching.steps):
            for arg in step.args if found[step.index] else ():
                found[arg] = True
        return found

    def _against(self, match: Match) -> float:
        """What speaks for a wrong mark's being wrong: the odds of the way with its mistake, or else how far off it is
        beyond what a pencil may be, if it is its mark at all."""
        if match.step.index in self.matching.odds:
            return self.matching.odds[match.step.index]
        if match.residual is None or match.place is None:
            return match.weight
        beyond = (match.residual.square - bound(len(match.residual.off), self.matching.chance)) / 2
        return min(beyond, self.matching.evidence.weight(match.place))


def sureness(odds: float) -> float:
    """A logarithm of odds as a probability."""
    return 1 / (1 + math.exp(-min(max(odds, -measures.MAX_SURE_ODDS), measures.MAX_SURE_ODDS)))
