"""What a drawing would show if a step were drawn by mistake, seen at a glance: without errors, and mark by mark as
far as it stays likely."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge.image_search import NEAR, KnownMarks
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.mistakes import Mistake, value_of
from graphplan.marking.judge.student_sheet import FILED, GONE, THERE, plain, weighed

ROUGH = 0.6  # what is seen at a glance weighs as much less
DRIFT, OTHER = 3.0, 0.2  # mm: how far a point, which others follow, may have drifted; what is so far off is another
HOPELESS = -4.0  # the weight of what follows from a slip below which it is given up
Value = tuple[float, ...]


class QuickScore:
    """A way through a drawing, and what it would win by another mistake."""

    def __init__(self, matching: Matching, mistakes: Mapping[int, Mistake]):
        self.matching, self.mistakes = matching, mistakes
        self.own = [plain(value) for value in matching.own]

    def by(self, mistake: Mistake) -> float:
        """What is won if a slip was made; less than everything where it could not be."""
        wrong = value_of(mistake.step, self.own, mistake)
        return -math.inf if wrong is None else self.gain(mistake.step, wrong)

    def gain(self, slipped: Step, wrong: Value) -> float:
        """What is won if a step made this; less than everything where it is not there, or nothing follows from it."""
        matching, at = self.matching, slipped.index
        values, moved, dead = list(self.own), set[int](), set[int]()
        gain = seen = 0.0
        for arg in _strokes(matching, at):
            weight, _ = self._seen(matching.steps[arg], self.own[arg], KnownMarks(self.own[:arg], {at: wrong}))
            gain, seen = gain + weight - ROUGH * matching.matches[arg].weight, seen + weight
        for step in matching.steps[at:]:
            if dead.isdisjoint(step.args) and (step.index == at or not moved.isdisjoint(step.args)):
                made = wrong if step.index == at else value_of(step, values, self.mistakes.get(step.index))
                if made is None:
                    dead.add(step.index)
                    continue
                if not self._differs(step, made):
                    continue
                moved.add(step.index)
                weight, values[step.index] = self._seen(step, made, KnownMarks(values[:step.index], self.mistakes))
                gain, seen = gain + weight - matching.matches[step.index].weight, seen + weight
                if matching.image and matching.image.beyond(step, made):
                    dead.add(step.index)
                if seen < HOPELESS or (step.index == at and not self._possible(step, weight)):
                    return -math.inf
            elif not dead.isdisjoint(step.args):
                dead.add(step.index)
        return gain - sum(matching.matches[index].weight for index in dead)

    def _possible(self, step: Step, weight: float) -> bool:
        """Whether a step may be drawn so, by what is seen of it: lines are seen, and nobody draws those printed."""
        return step.op.gives != LINE or weight > (0.0 if self._printed(step) else -1.0)

    def _printed(self, step: Step) -> bool:
        """Whether what a step makes is on the sheet already."""
        image, way = self.matching.image, KnownMarks(self.own, self.mistakes)
        return image is not None and image.share(step, self.own[step.index], way) is None

    def _differs(self, step: Step, made: Value) -> bool:
        """Whether a value is another to the eye than what the step was taken for."""
        own, home = self.own[step.index], self.matching.sheet.plan_of_step[step.index]
        if step.op.gives == LINE:
            off = max(abs(_off(own, z) - _off(made, z)) for z in self._about[home])
        elif step.op.gives == OPENING:
            return True
        else:
            off = math.dist(own[:2], made[:2]) + abs(math.sqrt(max(own[2], 0)) - math.sqrt(max(made[2], 0))
                                                     if step.op.gives == CIRCLE else 0.0)
        return off * self.matching.sheet.mm(home) > OTHER

    @cached_property
    def _about(self) -> dict[str, list[complex]]:
        """The corners of what is drawn on each plan."""
        found: dict[str, list[complex]] = {}
        for step, home, value in zip(self.matching.steps, self.matching.sheet.plan_of_step, self.own, strict=True):
            if step.op.gives == POINT:
                found.setdefault(home, []).append(complex(*value))
        return {home: [complex(pick(z.real for z in spots), also(z.imag for z in spots))
                       for pick in (min, max) for also in (min, max)] for home, spots in found.items()}

    def _seen(self, step: Step, value: Value, way: KnownMarks) -> tuple[float, Value]:
        """What speaks for a value, and the value as it is seen to be drawn: a point may have drifted."""
        kind, matching, home = step.op.gives, self.matching, self.matching.sheet.plan_of_step[step.index]
        if kind == OPENING:
            return 0.0, value
        if image := matching.image:
            share = image.share(step, value, way)
            if share is None:
                return 0.0, value
            if kind != POINT:
                return ROUGH * weighed(THERE[kind], GONE[kind], None, share), value
            trace = image.trace(step, value, way, DRIFT)
        else:
            places, off = matching.unlabelled.near(kind, home, value)
            if kind != POINT:
                return self._weight(step, bool(off.min(initial=math.inf) < NEAR)), value
            trace = matching.traces[places[off.argmin()]] if off.min(initial=math.inf) < DRIFT else None
        spot = matching.sheet.fits[home].frame.back(complex(*trace.spots[0])) if trace else None
        return self._weight(step, there=bool(spot is not None)), (spot.real, spot.imag) if spot is not None else value

    def _weight(self, step: Step, there: bool) -> float:
        """What a mark weighs, or its lack."""
        if self.matching.image:
            return ROUGH * (THERE if there else GONE)[step.op.gives]
        return ROUGH * (FILED if there else GONE)[step.op.gives] if step.op.gives in self.matching.rules.shows else 0.0


def _strokes(matching: Matching, index: int) -> list[int]:
    """The lines and arcs on which the mark of a step lies: they are drawn as far as where it is thought to be."""
    step = matching.steps[index]
    return [arg for arg in step.args if step.op.gives == POINT and matching.steps[arg].op.gives in (LINE, CIRCLE)]


def _off(line: Sequence[float], z: complex) -> float:
    """How far a point lies off a line, to its left."""
    a, b, c = line
    return (a * z.real + b * z.imag + c) / math.hypot(a, b)
