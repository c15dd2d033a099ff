"""One way through a construction beside a student's drawing: every step finds its trace, and is judged by it.

Two drawings are kept: the student's own, which goes on from every mark as it was drawn, and the mended one, which
goes on from where a wrong mark should have been. A later mark is right if it follows from either; so one slip is
held against one step.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.errors import Undrawable
from graphplan.handed.traces import Trace
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Step
from graphplan.verify.board import Board, Deviation, plain, sampled
from graphplan.verify.labels import sure
from graphplan.verify.mistakes import Slip, slips
from graphplan.verify.sought import Sought
from graphplan.verify.verdict import FOLLOWS, MISSING, RIGHT, UNSEEN, WRONG

NEAREST, SUSPECTS = 6, 8  # how many loose traces are tried as what a step should make, and as what it was mistaken for
REACH = 15.0  # standard deviations of a point within which a picture is searched
TWIN = 0.5  # mm: a stroke that is found twice lies so near to itself
AHEAD = 30  # how many steps are looked ahead
ASIDE = 3.0  # mm that a line may end before a point that it goes through
ASTRAY, NEAR, CLOSE = 60.0, 8.0, 1.0  # mm: no mark is sought further off, no slip's, and none that would follow


class Loose:
    """The unlabelled traces of a sheet, on every plan: where they are near to something expected."""

    def __init__(self, board: Board, traces: Sequence[Trace], places: Sequence[int], seen: int):
        self.traces, self._places = traces, {kind: [i for i in places if traces[i].kind == kind]
                                             for kind in (POINT, LINE, CIRCLE)}
        self._spots: dict[tuple[str, str], Any] = {}
        self._board, self._seen, self._twins = board, seen, dict[int, set[int]]()

    def twins(self, place: int) -> set[int]:
        """The loose traces that are the same stroke as a trace that was found by seeking it."""
        trace = self.traces[place]
        if place < self._seen or trace.kind == POINT:
            return set()
        if place not in self._twins:
            self._twins[place] = {other for other in self._places[trace.kind] if _same(trace, self.traces[other])}
        return self._twins[place]

    def near(self, kind: str, panel: str, value: Sequence[float]) -> tuple[list[int], Any]:
        """The traces of a kind that may lie on a plan, and how far each is from a value in mm at most."""
        places = self._places.get(kind, [])
        if not places:
            return [], np.zeros(0)
        spots = self._on(kind, panel)
        if kind == POINT:
            off = np.abs(spots[:, 0] - complex(value[0], value[1]))
        elif kind == LINE:
            a, b, c = value
            off = np.max(np.abs(a * spots.real + b * spots.imag + c), axis=1) / math.hypot(a, b)
        else:
            off = np.max(np.abs(np.abs(spots - complex(value[0], value[1])) - math.sqrt(max(value[2], 0.0))), axis=1)
        return places, off * self._board.mm(panel)

    def _on(self, kind: str, panel: str) -> Any:
        """The spots of all traces of a kind in the units of a plan; nowhere where they are said to be on another."""
        if (kind, panel) not in self._spots:
            frame = self._board.fits[panel].frame
            rows = [[frame.back(complex(*spot)) if self.traces[i].panel in ("", panel) else complex(math.inf)
                     for spot in sampled(self.traces[i])] for i in self._places[kind]]
            self._spots[kind, panel] = np.array(rows)
        return self._spots[kind, panel]


@dataclass(frozen=True)
class Rules:
    """By what is judged: how seldom a faultless mark may be called wrong, and what the drawing could show."""

    chance: float
    shows: frozenset[str]


@dataclass(frozen=True)
class Taken:
    """What a step was taken for: its state, where it should have been, and the trace, or the slip that it must have
    been, with how far off that is."""

    step: Step
    state: str
    expected: Any
    place: int | None = None
    deviation: Deviation | None = None
    slip: Slip | None = None


class Walk:
    """The drawing as far as it has been gone through."""

    def __init__(self, board: Board, rules: Rules, traces: list[Trace], labels: Mapping[int, int], loose: Loose,
                 sought: Sought | None = None):
        self.board, self.rules, self.traces, self.labels, self.loose = board, rules, traces, labels, loose
        self.sought = sought  # what is found by seeking it is added to the traces
        self.own: list[Any] = []
        self.mended: list[Any] = []
        self.taken: list[Taken] = []
        self.used: set[int] = set()
        self.erred = False

    def fork(self) -> Walk:
        """Another one that goes on from here."""
        return self.moved(self)

    def moved(self, other: Walk) -> Walk:
        """Another one that goes on from here in the frames of the other, which differ only in plans to come."""
        moved = Walk(other.board, self.rules, self.traces, self.labels, other.loose, other.sought)
        moved.own, moved.mended = list(self.own), list(self.mended)
        moved.taken, moved.used, moved.erred = list(self.taken), set(self.used), self.erred
        return moved

    @property
    def steps(self) -> Sequence[Step]:
        return self.board.drawing.drawn.steps

    @property
    def next(self) -> Step:
        return self.steps[len(self.own)]

    def through(self, found: Mapping[int, int | Slip] | None = None) -> Walk:
        """Go to the end, taking every trace that fits, what steps were found to be mistaken for, and no others."""
        return self.until(len(self.steps), found)

    def until(self, end: int, found: Mapping[int, int | Slip] | None = None) -> Walk:
        """Go on so before the step of this place."""
        while len(self.own) < end:
            self.go((found or {}).get(len(self.own)))
        return self

    def before(self, end: int) -> set[int]:
        """The traces that were taken before the step of this place."""
        places = [taken.place for taken in self.taken[:end] if taken.place is not None]
        return {*places, *(twin for place in places for twin in self.loose.twins(place))}

    def go(self, found: int | Slip | None) -> Walk:
        """Take the next step for what it was found to be, else for what fits it."""
        if isinstance(found, Slip):
            return self.assume(found)
        return self.take(self.find() if found is None else found)

    # ---- one step --------------------------------------------------------------------------------------------------

    def find(self) -> int | None:
        """The trace of the next step: the one that bears its label, else a loose one that fits."""
        step = self.next
        lettered = self.labels.get(step.index)
        if lettered is not None and (sure(self.traces[lettered]) or self._fits(step, lettered)):
            return lettered
        if step.op.name == "begin":
            return None
        for expected, drawn in self._asked(step):
            best = self._fitting(step, expected, drawn)
            if best is None and self.sought:
                best = self._seeking(step, expected, drawn, self.sought)
            if best is not None:
                return best
        return lettered

    def _fits(self, step: Step, place: int) -> bool:
        """Whether a trace is as a step should have made it."""
        return any(self.deviation(step, expected, place, drawn).fits(self.rules.chance)
                   for expected, drawn in self._asked(step))

    def hidden(self, step: Step) -> bool:
        """Whether what a step should make could not be seen: a line that is printed already."""
        asked = next(self._asked(step), None)
        return bool(self.sought and asked and self.sought.hidden(step, *asked))

    def _seeking(self, step: Step, expected: Any, drawn: Sequence[Any], sought: Sought) -> int | None:
        """What a picture shows about an expected value, if it fits it."""
        if step.op.name == "given" or step.op.gives == OPENING:
            return None
        trace = sought.trace(step, expected, drawn, REACH * self.board.pencil.point)
        if trace is None or not self.board.deviation(
                step, expected, self.board.spots(step.index, trace), drawn).fits(self.rules.chance):
            return None
        return self._entered(trace)

    def _fitting(self, step: Step, expected: Any, drawn: Sequence[Any]) -> int | None:
        """The loose trace that fits an expected value best, if any does."""
        places, off = self.loose.near(step.op.gives, self.board.homes[step.index], plain(expected))
        best: tuple[bool, bool, float, int] | None = None
        for k in np.argsort(off)[:NEAREST] if len(places) else ():
            if not off[k] < ASTRAY:
                break
            deviation = self.deviation(step, expected, places[k], drawn)
            if deviation.fits(self.rules.chance):  # rather one that is free yet, and that reaches its marks
                found = places[k] in self.used, not self.reaches(step, places[k]), deviation.square, places[k]
                best = min(best, found) if best else found
        return best[3] if best else None

    def reaches(self, step: Step, place: int) -> bool:
        """Whether a line was drawn as far as to the points that it goes through."""
        if step.op.gives != LINE:
            return True
        board, frame = self.board, self.board.fits[self.board.homes[step.index]].frame
        start, end = (frame.back(complex(*spot)) for spot in self.traces[place].spots[:2])
        way, spare = (end - start) / (abs(end - start) or 1.0), ASIDE / board.mm(board.homes[step.index])
        on = [step.args[claim[1]] for claim in step.op.claims if claim[0] == "on"]
        along = [((complex(*plain(self.own[arg])[:2]) - start) * way.conjugate()).real for arg in on]
        return all(-spare <= far <= abs(end - start) + spare for far in along)

    def _asked(self, step: Step) -> Iterator[tuple[Any, Sequence[Any]]]:
        """What a step should make of the student's own marks, and once they erred, of the mended ones."""
        for drawn in (self.own, self.mended) if self.erred else (self.own,):
            try:
                yield self.board.expected(step, drawn), drawn
            except Undrawable:
                continue

    def deviation(self, step: Step, expected: Any, place: int, drawn: Sequence[Any]) -> Deviation:
        """How far a trace is from what is expected."""
        return self.board.deviation(step, expected, self.board.spots(step.index, self.traces[place]), drawn)

    def take(self, place: int | None) -> Walk:
        """Take a trace, or none, for what the next step made, and judge it."""
        step = self.next
        asked = list(self._asked(step)) or [(self.board.drawing.values[step.index], self.board.drawing.values)]
        own, mended = asked[0][0], asked[-1][0]
        if place is None:
            shown = step.op.gives in self.rules.shows and step.op.name not in ("given", "begin")
            return self._go_on(Taken(step, MISSING if shown else UNSEEN, own), own, mended)
        self.used |= {place} | self.loose.twins(place)
        spots = self.board.spots(step.index, self.traces[place])
        found = [self.board.deviation(step, value, spots, drawn) for value, drawn in asked]
        fits = [step.op.name == "begin" or deviation.fits(self.rules.chance) for deviation in found]
        state = WRONG if not any(fits) else FOLLOWS if not fits[-1] else RIGHT
        by = fits.index(True) if any(fits) else 0
        seen = self.board.seen(step, own, spots, steady=state == WRONG or not self.traces[place].blur)
        return self._go_on(Taken(step, state, asked[by][0], place, found[by]), seen, seen if fits[-1] else mended)

    def assume(self, slip: Slip) -> Walk:
        """Take a slip for what was done at the next step, which is not to be seen itself."""
        step = self.next
        asked = next(self._asked(step), None)
        own = self.board.hand.slipped(step, slip.value(self.board.domain, self.own), self.board.errors(step.index))
        mended = asked[0] if asked else own
        return self._go_on(Taken(step, WRONG, mended, slip=slip), own, mended)

    def _go_on(self, taken: Taken, own: Any, mended: Any) -> Walk:
        self.taken.append(taken)
        self.own.append(own)
        self.mended.append(mended)
        self.erred = self.erred or taken.state == WRONG
        return self

    # ---- what a step may have been mistaken for --------------------------------------------------------------------

    def suspects(self, loose: set[int], half_right: bool) -> list[int]:
        """The traces, of those that fit nothing else, that the next step may have made by a mistake.

        With `half_right` also those that keep some of its claims, by whatever mistake. In a picture arcs and dots are
        also sought where a mistake would have made them.
        """
        step, board = self.next, self.board
        panel, kind = board.homes[step.index], step.op.gives
        found: dict[int, float] = {}
        floats = [plain(value) for value in self.own]
        for slip in slips(board.drawing.drawn, step, board.homes):
            value = _value(slip, floats)
            places, off = self.loose.near(kind, panel, value) if value else ([], np.zeros(0))
            for k in np.argsort(off)[:2] if len(places) else ():
                if places[k] in loose and off[k] < NEAR and self._is(step, slip, places[k]):
                    found[places[k]] = min(off[k], found.get(places[k], math.inf))
            few = kind == POINT and slip.step.args == step.args  # too few to be met by chance
            if value and self.sought and (few or (half_right and kind == CIRCLE)):
                place = self._sought_at(step, slip, value, self.sought)
                if place is not None:
                    found.setdefault(place, NEAR)
        for place in (loose - found.keys() if half_right else ()):
            if self.traces[place].kind == kind and self._half_right(step, place):
                found[place] = ASTRAY + 1
        return sorted(found, key=found.__getitem__)[:SUSPECTS]

    def _sought_at(self, step: Step, slip: Slip, value: Any, sought: Sought) -> int | None:
        """What a picture shows where a slip would have made it."""
        trace = sought.trace(step, value, self.own, REACH * self.board.pencil.point)
        if trace is None:
            return None
        place = self._entered(trace)
        return place if place not in self.used and self._is(step, slip, place) else None

    def _entered(self, trace: Trace) -> int:
        """The place of a trace that was sought, which is then one of the traces."""
        if trace not in self.traces:
            self.traces.append(trace)
        return self.traces.index(trace)

    def assumptions(self, loose: set[int]) -> list[Slip]:
        """The slips at the next step, a point that is not there, from which some of these traces would follow."""
        step, board = self.next, self.board
        if step.op.gives != POINT:
            return []
        floats = [plain(value) for value in self.own]
        found: list[tuple[int, int, Slip]] = []
        for slip in slips(board.drawing.drawn, step, board.homes):
            value = _value(slip, floats)
            count = self._following(step, {**dict(enumerate(floats)), step.index: value}, loose) if value else 0
            if count:
                found.append((-count, len(found), slip))
        return [slip for _, _, slip in sorted(found, key=lambda one: one[:2])[:SUSPECTS]]

    def _following(self, step: Step, values: dict[int, Any], loose: set[int]) -> int:
        """How many of some traces are what would follow from a mark and those before it in the next few steps."""
        count, follows = 0, {step.index}
        for after in self.steps[step.index + 1:step.index + AHEAD]:
            if follows.isdisjoint(after.args) or not all(arg in values for arg in after.args):
                continue
            try:
                values[after.index] = after.op.rule(Floats(), *[values[arg] for arg in after.args], **after.params)
            except Undrawable:
                continue
            follows.add(after.index)
            places, off = self.loose.near(after.op.gives, self.board.homes[after.index], values[after.index])
            count += any(far < CLOSE and place in loose for place, far in zip(places, off, strict=True))
        return count

    def _is(self, step: Step, slip: Slip, place: int) -> bool:
        """Whether a trace is what a slip makes of the student's own marks."""
        try:
            made = slip.value(self.board.domain, self.own)
        except Undrawable:
            return False
        expected = self.board.hand.slipped(step, made, self.board.errors(step.index))
        return self.deviation(step, expected, place, self.own).fits(self.rules.chance)

    def _half_right(self, step: Step, place: int) -> bool:
        """Whether a trace keeps one of the claims of its step: a line through its point, a point on its line."""
        board, on = self.board, [step.args[claim[1]] for claim in step.op.claims if claim[0] == "on"]
        spots = [complex(*plain(spot)) for spot in board.spots(step.index, self.traces[place])]
        mm = board.mm(board.homes[step.index])
        for arg in on:
            if step.op.gives == LINE:
                off = _off([spots[0], spots[1]], complex(*plain(self.own[arg])[:2]))
            elif board.drawing.drawn.steps[arg].op.gives == LINE:
                a, b, c = plain(self.own[arg])
                off = (a * spots[0].real + b * spots[0].imag + c) / math.hypot(a, b)
            else:
                continue
            if abs(off) * mm < 4 * max(board.pencil.point, board.pencil.edge) and self._near(step, spots, mm):
                return self._clearly_off(step, place)
        return False

    def _clearly_off(self, step: Step, place: int) -> bool:
        """Whether a trace is off by twice as much as it may be: what is hardly off is hardly read."""
        asked = next(self._asked(step), None)
        deviation = self.deviation(step, asked[0], place, asked[1]) if asked else None
        return deviation is None or deviation.size > 2 * deviation.tolerance(self.rules.chance)

    def _near(self, step: Step, spots: Sequence[complex], mm: float) -> bool:
        """Whether a point is not far from where it should be; a line through its point always is near."""
        if step.op.gives != POINT:
            return True
        return any(abs(spots[0] - complex(*plain(expected)[:2])) * mm < ASTRAY for expected, _ in self._asked(step))


def _same(one: Trace, other: Trace) -> bool:
    """Whether a line, or a rim, lies upon another of its kind, and beside no more than half of it."""
    lying = [min(math.dist(spot, near) for near in _chain(one)) < TWIN for spot in _chain(other)]
    return sum(lying) > len(lying) / 2


def _chain(trace: Trace) -> list[tuple[float, float]]:
    """Spots of a trace, half a millimetre apart if it is a line."""
    if trace.kind != LINE:
        return list(trace.spots)
    start, end = (complex(*spot) for spot in trace.spots[:2])
    count = max(1, int(abs(end - start) / TWIN))
    return [((start + (end - start) * k / count).real, (start + (end - start) * k / count).imag)
            for k in range(count + 1)]


def _value(slip: Slip, values: Sequence[Any]) -> Any:
    """What a slip makes, without errors; None where it cannot be made."""
    try:
        value = slip.value(Floats(), values)
    except Undrawable:
        return None
    return value if all(map(math.isfinite, value)) and (len(value) < 3 or value[0] or value[1] or value[2]) else None


def _off(line: Sequence[complex], X: complex) -> float:
    """How far a point lies off the line through two others."""
    way = line[1] - line[0]
    return float(((X - line[0]) * way.conjugate()).imag / (abs(way) or 1.0))
