"""One way through a construction beside a student's drawing: every step finds its trace, and is judged by it.

Two drawings are kept: the student's own, which goes on from every mark as it was drawn, and the mended one, which
goes on from where a wrong mark should have been. A later mark is right if it follows from either; so one mistake
is held against one step.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import LINE, OPENING, POINT, Movement
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.evidence import Evidence, KnownMarks
from graphplan.marking.judge.lettering import is_sure
from graphplan.marking.judge.mistakes import Mistake, lays_off_vector
from graphplan.marking.judge.student_sheet import Residual, StudentSheet, plain_value, weigh_mark
from graphplan.marking.judge.verdict import FOLLOWS, MISSING, RIGHT, UNSEEN, WRONG
from graphplan.marking.traces import Trace

UNMARKED = -1  # the place of a mark that is not to be seen, whatever else is there


@dataclass(frozen=True)
class Match:
    """Match of a step: its state, its expected value, and the trace, or the mistake that explains it, with its
    distance; and its weight."""

    step: Step
    state: str
    expected: Any
    place: int | None = None
    residual: Residual | None = None
    mistake: Mistake | None = None
    weight: float = 0.0

    @property
    def sharp_weight(self) -> float:
        """Weight reduced for a mark that might as well be elsewhere: if nearly every place fits, the mark is no
        evidence."""
        vague = self.residual.vague(measures.BESIDE_MM) if self.residual and self.state != WRONG else 0.0
        return max(self.weight - vague, min(self.weight, 0.0))


class Matching:
    """The drawing as far as it has been gone through."""

    def __init__(self, evidence: Evidence, labels: Mapping[int, int], chance: float):
        self.evidence, self.labels = evidence, labels
        self.chance = chance  # how seldom a faultless mark may be called wrong
        self.traces = evidence.traces  # what is found by seeking it is added to them
        self.own: list[Any] = []
        self.mended: list[Any] = []
        self.matches: list[Match] = []
        self.used: set[int] = set()
        self.over: set[int] = set()  # what is drawn over print
        self.erred = False
        self.taken: Mapping[int, int | Mistake] = {}  # what some steps are taken for
        self.dead: set[int] = set()  # the steps that nobody could draw from what is there
        self.weight = 0.0  # what speaks for this way
        self.odds: Mapping[int, float] = {}  # what speaks for the mistakes that were found
        self._now: list[tuple[Any, Sequence[Any]]] | None = None  # what the next step should make
        self._off: dict[tuple[int, int], Residual] = {}  # how far traces are from that, as long as it lasts

    def fork(self, other: Matching | None = None) -> Matching:
        """Another one that goes on from here, in the frames of the other, which differ only in plans to come."""
        fork, other = copy(self), other or self
        fork.evidence, fork._now, fork._off = other.evidence, None, {}
        fork.own, fork.mended, fork.matches = [*self.own], [*self.mended], [*self.matches]
        fork.used, fork.over, fork.dead = {*self.used}, {*self.over}, {*self.dead}
        return fork

    @property
    def sheet(self) -> StudentSheet:
        return self.evidence.sheet

    @property
    def steps(self) -> Sequence[Step]:
        return self.sheet.drawing.drawn.steps

    @property
    def next_step(self) -> Step:
        return self.steps[len(self.own)]

    def match_until(self, end: int, found: Mapping[int, int | Mistake] | None = None) -> Matching:
        """Go on before the step of this place, taking what steps were found to be mistaken for, and what else fits."""
        self.taken = found or {}
        while len(self.own) < end:
            self.match_next(self.taken.get(len(self.own)))
        return self

    def match_next(self, found: int | Mistake | None) -> Matching:
        """Take the next step for what it was found to be, else for what fits it."""
        if isinstance(found, Mistake):
            return self.take_mistake(found)
        place = self.find_place() if found is None else found
        return self.take(None if place == UNMARKED else place)

    def try_repeat(self, other: Matching) -> bool:
        """Take the next step as another matching did, if its operands are equal and its trace is free."""
        step, match = self.next_step, other.matches[len(self.own)]
        if any(mine[arg] is not its[arg] for arg in step.args
               for mine, its in ((self.own, other.own), (self.mended, other.mended))):
            return False
        if match.place is not None and (match.weight == measures.SHARED_ODDS or not self.used.isdisjoint(
                {match.place, *self.evidence.twins(match.place)})):
            return False
        self.dead |= other.dead & {step.index}
        self._append(match, other.own[step.index], other.mended[step.index])
        return True

    # ---- one step --------------------------------------------------------------------------------------------------

    def find_place(self) -> int | None:
        """The trace of the next step: the one that bears its label, else an unlabelled one that fits."""
        step = self.next_step
        lettered = self.labels.get(step.index)
        if lettered is not None and is_sure(self.traces[lettered]):
            return lettered
        if step.op.movement is Movement.BEGUN and self.evidence.picture:
            return None  # it is printed
        for expected, basis in self._expected_values(step):
            begun = step.op.movement is Movement.BEGUN
            best = self._find_origin(step, expected, basis) if begun else self._find_drawn(step, expected, basis)
            if best is not None:
                return best
        return None if lettered is None or self._may_cross_by_chance(step, lettered) else lettered

    def _may_cross_by_chance(self, step: Step, place: int) -> bool:
        """Whether strokes that cross beside a letter, not far from its mark, need not be that mark."""
        return self.traces[place].crossed and any(
            self.residual(step, expected, place, basis).distance < measures.CHANCE_CROSSING_MM
            for expected, basis in self._expected_values(step))

    def _find_origin(self, step: Step, expected: Any, drawn: Sequence[Any]) -> int | None:
        """The dot, or else the end of a stroke, where the frame of a plan has its beginning: it is free, so that no
        slip of the hand makes it wrong."""
        places, off = self.evidence.nearby_traces(POINT, self.sheet.plan_of_step[step.index], plain_value(expected))
        within = measures.AGREED_SIGMAS * self.sheet.pencil.point
        if off.min(initial=math.inf) < within:
            return int(places[off.argmin()])
        trace = self.evidence.search(step, expected, self._known_marks(drawn), within)
        return self._add_trace(trace) if trace else None

    def _add_trace(self, trace: Trace) -> int:
        """The place of a trace that was found by seeking it."""
        if trace not in self.traces:
            self.traces.append(trace)
        return self.traces.index(trace)

    def _find_drawn(self, step: Step, expected: Any, drawn: Sequence[Any]) -> int | None:
        """Drawn trace at an expected value that fits it."""
        best = self._find_fitting(step, expected, drawn)
        if best is None and step.op.gives != OPENING:
            best = self._search(step, expected, drawn)
        if best is None or not self.evidence.picture:
            return best
        if self.evidence.visible_share(step, expected, self._known_marks(drawn)) is not None:
            return best
        off = self.residual(step, expected, best, drawn)  # where most is printed already, pieces tell little
        if step.op.gives != LINE and off.square < len(off.off) + 1:
            return best
        self.over.add(best)
        return None

    def _search(self, step: Step, expected: Any, drawn: Sequence[Any]) -> int | None:
        """Ink of a picture at an expected value, or the end of a file's stroke, if it fits it."""
        if step.op.movement is Movement.GIVEN:
            return None
        trace = self.evidence.search(step, expected, self._known_marks(drawn),
                                     measures.SEARCH_SIGMAS * self.sheet.pencil.point)
        if trace is None or not self.sheet.residual(
                step, expected, self.sheet.spots(step.index, trace), drawn).fits(self.chance):
            return None
        return self._add_trace(trace)

    def _known_marks(self, drawn: Sequence[Any]) -> KnownMarks:
        """Known marks and mistakes to come."""
        return KnownMarks(drawn, {step: taken for step, taken in self.taken.items() if isinstance(taken, Mistake)})

    def _find_fitting(self, step: Step, expected: Any, drawn: Sequence[Any]) -> int | None:
        """The unlabelled trace that fits an expected value best, if any does."""
        places, off = self.evidence.nearby_traces(step.op.gives, self.sheet.plan_of_step[step.index],
                                                  plain_value(expected))
        best: tuple[bool, float, int] | None = None
        for k in np.argsort(off)[:measures.CANDIDATES] if len(places) else ():
            if not off[k] < measures.MAX_ASTRAY_MM:
                break
            residual = self.residual(step, expected, places[k], drawn)
            if residual.fits(self.chance):  # rather one that is free yet, and is nearest
                far = off[k] if step.op.movement is Movement.PICKED else residual.square
                candidate = places[k] in self.used, float(far), places[k]
                best = min(best, candidate) if best else candidate
            elif step.op.gives == POINT and off[k] > measures.MAX_TOLERANCES_OFF * residual.tolerance(self.chance):
                break
        return best[2] if best else None

    def _expected_values(self, step: Step) -> Sequence[tuple[Any, Sequence[Any]]]:
        """Expected values of the next step from the student's own marks, and after an error from the mended ones."""
        if self._now is None:
            self._now = []
            for basis in (self.own, self.mended) if self.erred else (self.own,):
                with suppress(Undrawable):
                    self._now.append((self.sheet.expected_value(step, basis), basis))
        return self._now

    def residual(self, step: Step, expected: Any, place: int, drawn: Sequence[Any]) -> Residual:
        """Residual of a trace from its expected value."""
        key = int(place), id(expected)
        if key not in self._off:
            spots = self.sheet.spots(step.index, self.traces[place])
            self._off[key] = self.sheet.residual(step, expected, spots, drawn)
        return self._off[key]

    def take(self, place: int | None) -> Matching:
        """Take a trace, or None, for the next step, and judge it."""
        step = self.next_step
        candidates = (list(self._expected_values(step))
                      or [(self.sheet.drawing.values[step.index], self.sheet.drawing.values)])
        own_value, mended_value = candidates[0][0], candidates[-1][0]
        if place is None:
            is_shown = step.op.gives in self.evidence.shows and not (step.op.free or step.index in self.sheet.hidden)
            return self._append(Match(step, MISSING if is_shown else UNSEEN, own_value,
                                      weight=self._missed_weight(own_value)), own_value, mended_value)
        spots = self.sheet.spots(step.index, self.traces[place])
        residuals = [self.residual(step, value, place, basis) for value, basis in candidates]
        begun, sure = step.op.movement is Movement.BEGUN, is_sure(self.traces[place])
        fits = [not sure or off.distance < measures.DRIFT_MM if begun else off.fits(self.chance) for off in residuals]
        if not any(fits) and (equivalent := self._protocol_value(step)):
            candidates.append(equivalent)
            residuals.append(self.sheet.residual(step, equivalent[0], spots, equivalent[1]))
            fits.append(residuals[-1].fits(self.chance))
        state = WRONG if not any(fits) else FOLLOWS if not fits[-1] else RIGHT
        by = fits.index(True) if any(fits) else 0
        seen_value = self.sheet.value_of_trace(step, own_value, spots,
                                               steady=state == WRONG or not self.traces[place].blur)
        named = self.labels.get(step.index) == place
        weight = self._weigh_trace(place, residuals[by] if any(fits) else None, seen_value)
        if any(fits) and not named and weight < measures.CLEAR_ODDS:  # such ink hardly says where this step's lies
            seen_value = candidates[by][0]
        return self._append(Match(step, state, candidates[by][0], place, residuals[by], weight=weight),
                            seen_value, seen_value if fits[-1] else mended_value)

    def _protocol_value(self, step: Step) -> tuple[Any, Sequence[Any]] | None:
        """Place to which the length leads that the protocol tells for a step, laid off from the student's own mark."""
        if step.op.gives != POINT or step.op.root is None:
            return None
        root, basis = step.args[step.op.root], list(self.sheet.drawing.values)
        basis[root] = self.own[root]
        try:
            return self.sheet.expected_value(step, basis), basis
        except Undrawable:
            return None

    def take_mistake(self, mistake: Mistake) -> Matching:
        """Take a mistake for what was done at the next step: what is drawn where it leads, or a mark that is not to be
        seen, but from which others follow."""
        step, candidates = self.next_step, self._expected_values(self.next_step)
        mistaken_value = self.sheet.hand.add_slips(step, mistake.value(self.sheet.domain, self.own),
                                                   self.sheet.errors(step.index))
        mended_value = candidates[0][0] if candidates else mistaken_value
        place = self._find_drawn(step, mistaken_value, self.own)
        if place is None or self._is_spread_of_strokes(step, place):
            return self._take_unseen_mistake(mistake, mistaken_value, mended_value)
        spots = self.sheet.spots(step.index, self.traces[place])
        off = self.sheet.residual(step, mended_value, spots, self.own)
        seen_value = self.sheet.value_of_trace(step, mistaken_value, spots, steady=not self.traces[place].blur)
        weight = self._weigh_trace(place, self.sheet.residual(step, mistaken_value, spots, self.own), seen_value)
        if not weight:  # the ink of another step
            weight = -math.inf if self.evidence.picture else measures.UNSEEN_MISTAKE_ODDS
        if off.fits(self.chance):
            weight = -math.inf
        return self._append(Match(step, WRONG, mended_value, place, off, mistake, weight), seen_value, mended_value)

    def _take_unseen_mistake(self, mistake: Mistake, mistaken_value: Any, mended_value: Any) -> Matching:
        """Take a mistake whose mark is not to be seen for what was done at the next step."""
        step, is_picture = self.next_step, self.evidence.picture
        missed = self._missed_weight(mistaken_value)
        if is_picture and not step.name:  # nobody dots what has no letters, wherever it is
            missed = measures.ABSENT_ODDS.get(step.op.gives, 0.0)
        unclear = step.op.gives == POINT and self.sheet.residual(
            step, mended_value, [mistaken_value], self.own).fits(self.chance)
        lost = is_picture and not lays_off_vector(step.op)  # strokes are seen, dots may be lost in them
        is_idle = unclear or lost or not self.dead.isdisjoint(step.args)
        weight = -math.inf if is_idle else missed + measures.UNSEEN_MISTAKE_ODDS
        return self._append(Match(step, WRONG, mended_value, mistake=mistake, weight=weight), mistaken_value,
                            mended_value)

    def is_at_beginning(self, step: Step, spot: Sequence[float]) -> bool:
        """Whether a spot is so near to where the plan of a step begins that no vector ends there."""
        home = self.sheet.plan_of_step[step.index]
        return any(math.dist(spot, plain_value(begun.expected)) * self.sheet.mm(home) < measures.MIN_VECTOR_MM
                   for begun in self.matches if begun.step.op.movement is Movement.BEGUN
                   and self.sheet.plan_of_step[begun.step.index] == home)

    def _is_spread_of_strokes(self, step: Step, place: int) -> bool:
        """Whether what looks like a dot of a picture is where strokes spread from the beginning of their plan."""
        if not self.evidence.picture or step.op.gives != POINT:
            return False
        spot, = self.sheet.spots(step.index, self.traces[place])
        return self.is_at_beginning(step, plain_value(spot))

    def _weigh_trace(self, place: int, residual: Residual | None, seen: Any) -> float:
        """Weight of a trace for this matching; a wrong one by its distance."""
        kind = self.traces[place].kind
        is_free = self._claimed_places.isdisjoint({place, *self.evidence.twins(place)})
        if not (is_free or self.is_one_mark(place, self.next_step.index)):
            return measures.SHARED_ODDS
        needs_share = self.evidence.picture and kind != POINT
        share = self.evidence.visible_share(self.next_step, seen, self._known_marks(self.own)) if needs_share else None
        return weigh_mark(self.evidence.weight(place), measures.ABSENT_ODDS[kind], residual,
                          1.0 if share is None else share)

    @property
    def _claimed_places(self) -> set[int]:
        """Traces that the next step cannot have for itself: of a picture's dots those of lettered marks, as only these
        are dotted, and others may be there by chance."""
        step = self.next_step
        if not (self.evidence.picture and step.op.gives == POINT and step.name):
            return self.used
        return {match.place for match in self.matches if match.place is not None and match.step.name}

    def is_one_mark(self, place: int, index: int) -> bool:
        """Whether a dot of a file is the mark of a step before another that has its mark there too."""
        shared = self.evidence.shared_marks
        return not self.evidence.picture and any(match.place == place and shared.are_one(match.step.index, index)
                                                 for match in self.matches[:index])

    def _missed_weight(self, expected: Any) -> float:
        """Weight of a missing trace for this matching."""
        step = self.next_step
        candidates = self._expected_values(step)
        if not candidates or candidates[0][1] is not self.own or not self.dead.isdisjoint(step.args):
            self.dead.add(step.index)
            return 0.0
        printed = self.evidence.picture or step.op.movement is Movement.GIVEN
        if step.op.gives == OPENING or (step.op.free and printed):
            return 0.0
        if self.evidence.is_beyond_panel(step, expected):
            self.dead.add(step.index)
        share = self.evidence.visible_share(step, expected, self._known_marks(self.own))
        return 0.0 if share is None else measures.ABSENT_ODDS[step.op.gives]

    def _append(self, match: Match, own: Any, mended: Any) -> Matching:
        self.matches.append(match)
        self.own.append(own)
        self.mended.append(mended)
        self.erred = self.erred or match.state == WRONG
        if match.place is not None:
            self.used |= {match.place} | self.evidence.twins(match.place)
            if match.step.op.gives == LINE and match.state != WRONG and not self.evidence.picture:
                home = self.sheet.plan_of_step[match.step.index]
                self.used |= self.evidence.strokes_upon(LINE, home, plain_value(own))  # no other line's
        self.weight, self._now, self._off = self.weight + match.sharp_weight, None, {}
        return self


# ---- what a whole way says ------------------------------------------------------------------------------------------


def matches_on(matching: Matching, panel: str) -> Iterator[Match]:
    """Matches of a plan's steps."""
    return (match for match in matching.matches if matching.sheet.plan_of_step[match.step.index] == panel)


def count_wrong(matches: Iterable[Match]) -> int:
    """Number of wrong matches."""
    return sum(match.state == WRONG for match in matches)
