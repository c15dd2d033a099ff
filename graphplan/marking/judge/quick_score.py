"""What a drawing would show if a step were drawn by mistake, seen at a glance: without errors, and mark by mark as
far as it stays likely."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cached_property

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Step
from graphplan.marking.judge.evidence import FILED, GONE, THERE, weighed
from graphplan.marking.judge.image_search import NEAR, Way
from graphplan.marking.judge.matching import Walk
from graphplan.marking.judge.mistakes import Slip
from graphplan.marking.judge.student_sheet import plain

ROUGH = 0.6  # what is seen at a glance weighs as much less
DRIFT, OTHER = 3.0, 0.2  # mm: how far a point, which others follow, may have drifted; what is so far off is another
HOPELESS = -4.0  # the weight of what follows from a slip below which it is given up
Values = Sequence[tuple[float, ...]]


class Glance:
    """A way through a drawing, and what it would win by another mistake."""

    def __init__(self, walk: Walk, slips: Mapping[int, Slip]):
        self.walk, self.slips = walk, slips
        self.own = [plain(value) for value in walk.own]

    def by(self, slip: Slip) -> float:
        """What is won if a slip was made; less than everything where it could not be."""
        try:
            made = slip.value(Floats(), self.own)
        except Undrawable:
            return -math.inf
        return self.won(slip.step, made) if all(map(math.isfinite, made)) else -math.inf

    def won(self, slipped: Step, wrong: tuple[float, ...]) -> float:
        """What is won if a step made this; less than everything where it is not there, or nothing follows from it."""
        walk, at = self.walk, slipped.index
        values, moved, dead = list(self.own), set[int](), set[int]()
        won = seen = 0.0
        for arg in _strokes(walk, at):
            weight, _ = self._seen(walk.steps[arg], self.own[arg], Way(self.own[:arg], {at: wrong}))
            won, seen = won + weight - ROUGH * walk.taken[arg].weight, seen + weight
        for step in walk.steps[at:]:
            if dead.isdisjoint(step.args) and (step.index == at or not moved.isdisjoint(step.args)):
                made = wrong if step.index == at else self._made(step, values)
                if made is None:
                    dead.add(step.index)
                    continue
                if not self._differs(step, made):
                    continue
                moved.add(step.index)
                weight, values[step.index] = self._seen(step, made, Way(values[:step.index], self.slips))
                won, seen = won + weight - walk.taken[step.index].weight, seen + weight
                if walk.sought and walk.sought.beyond(step, made):
                    dead.add(step.index)
                if seen < HOPELESS or (step.index == at and not self._possible(step, weight)):
                    return -math.inf
            elif not dead.isdisjoint(step.args):
                dead.add(step.index)
        return won - sum(walk.taken[index].weight for index in dead)

    def _possible(self, step: Step, weight: float) -> bool:
        """Whether a step may be drawn so, by what is seen of it: lines are seen, and nobody draws those printed."""
        return step.op.gives != LINE or weight > (0.0 if self._printed(step) else -1.0)

    def _printed(self, step: Step) -> bool:
        """Whether what a step makes is on the sheet already."""
        sought, way = self.walk.sought, Way(self.own, self.slips)
        return sought is not None and sought.share(step, self.own[step.index], way) is None

    def _differs(self, step: Step, made: tuple[float, ...]) -> bool:
        """Whether a value is another to the eye than what the step was taken for."""
        own, home = self.own[step.index], self.walk.board.plan_of_step[step.index]
        if step.op.gives == LINE:
            off = max(abs(_off(own, z) - _off(made, z)) for z in self._about[home])
        elif step.op.gives == OPENING:
            return True
        else:
            off = math.dist(own[:2], made[:2]) + abs(math.sqrt(max(own[2], 0)) - math.sqrt(max(made[2], 0))
                                                     if step.op.gives == CIRCLE else 0.0)
        return off * self.walk.board.mm(home) > OTHER

    @cached_property
    def _about(self) -> dict[str, list[complex]]:
        """The corners of what is drawn on each plan."""
        found: dict[str, list[complex]] = {}
        for step, home, value in zip(self.walk.steps, self.walk.board.plan_of_step, self.own, strict=True):
            if step.op.gives == POINT:
                found.setdefault(home, []).append(complex(*value))
        return {home: [complex(pick(z.real for z in spots), also(z.imag for z in spots))
                       for pick in (min, max) for also in (min, max)] for home, spots in found.items()}

    def _made(self, step: Step, values: Values) -> tuple[float, ...] | None:
        """What a step makes of these values, with the mistakes that are known; None where it cannot be drawn."""
        known = self.slips.get(step.index)
        with suppress(Undrawable):
            made: tuple[float, ...] = known.value(Floats(), values) if known else step.op.rule(
                Floats(), *map(values.__getitem__, step.args), **step.params)
            return made if all(map(math.isfinite, made)) else None
        return None

    def _seen(self, step: Step, made: tuple[float, ...], way: Way) -> tuple[float, tuple[float, ...]]:
        """What speaks for a value, and the value as it is seen to be drawn."""
        if step.op.gives == OPENING:
            return 0.0, made
        if step.op.gives == POINT:
            return self._point(step, made, way)
        walk = self.walk
        if walk.sought:
            share = walk.sought.share(step, made, way)
            kind = step.op.gives
            return 0.0 if share is None else ROUGH * weighed(THERE[kind], GONE[kind], None, share), made
        return self._weight(step, bool(walk.loose.near(step.op.gives, walk.board.plan_of_step[step.index], made)[1].min(
            initial=math.inf) < NEAR)), made

    def _point(self, step: Step, made: tuple[float, ...], way: Way) -> tuple[float, tuple[float, ...]]:
        """The same of a point, which may have drifted."""
        walk, home = self.walk, self.walk.board.plan_of_step[step.index]
        if walk.sought:
            if walk.sought.share(step, made, way) is None:
                return 0.0, made
            trace = walk.sought.trace(step, made, way, DRIFT)
        else:
            places, off = walk.loose.near(POINT, home, made)
            trace = walk.traces[places[off.argmin()]] if off.min(initial=math.inf) < DRIFT else None
        if trace is None:
            return self._weight(step, there=False), made
        spot = walk.board.fits[home].frame.back(complex(*trace.spots[0]))
        return self._weight(step, there=True), (spot.real, spot.imag)

    def _weight(self, step: Step, there: bool) -> float:
        """What a mark weighs, or its lack."""
        if self.walk.sought:
            return ROUGH * (THERE if there else GONE)[step.op.gives]
        return ROUGH * (FILED if there else GONE)[step.op.gives] if step.op.gives in self.walk.rules.shows else 0.0


def _strokes(walk: Walk, index: int) -> list[int]:
    """The lines and arcs on which the mark of a step lies: they are drawn as far as where it is thought to be."""
    step = walk.steps[index]
    return [arg for arg in step.args if walk.steps[arg].op.gives in (LINE, CIRCLE)] if step.op.gives == POINT else []


def _off(line: Sequence[float], z: complex) -> float:
    """How far a point lies off a line, to its left."""
    a, b, c = line
    return (a * z.real + b * z.imag + c) / math.hypot(a, b)
