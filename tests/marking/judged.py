"""Judgements made by hand: a construction as a student drew it, some marks moved, each verdict known beforehand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

from hands import extent

import graphplan as gp
from graphplan.kernel.kinds import OPENING, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge.verdict import FOLLOWS, RIGHT, UNSEEN, WRONG, Ellipse, Judgement, Verdict
from graphplan.marking.traces import PlanFrame, Trace
from graphplan.methods.construction import Construction
from graphplan.phrases import Said
from graphplan.sheet.layout.composition import Composition, compose

TURNED = complex(0.9, 0.3)  # the student's sheet beside ours: turned, and a little smaller
TOLERANCE = 0.5


@cache
def composed(name: str) -> Composition:
    return compose(gp.construct(gp.load(name)))


def judgement(name: str, wrong: Mapping[int, complex] | None = None, mistake: Said | None = None, kind: str = "",
              file: str = "student.csv") -> Judgement:
    """A drawing of which some steps, by index, are so many mm off; what rests on them follows."""
    composition = composed(name)
    drawing = composition.plans.drawing
    frames = {panel: PlanFrame(complex(40, 30), view.scale * TURNED) for panel, view in composition.views.items()}
    made = Maker(drawing, composition, frames, wrong or {}, mistake, kind)
    return Judgement(file, drawing, composition, frames, tuple(made.verdicts()))


class Maker:
    """Makes the verdicts, step by step."""

    def __init__(self, drawing: Construction, composition: Composition, frames: Mapping[str, PlanFrame],
                 wrong: Mapping[int, complex], mistake: Said | None, kind: str):
        self.drawing, self.plans, self.frames = drawing, composition.plans, frames
        self.wrong, self.mistake, self.kind = wrong, mistake, kind

    def verdicts(self) -> Iterator[Verdict]:
        after = set(self.wrong)
        for step in self.drawing.drawn.steps:
            value = tuple(map(float, self.drawing.values[step.index]))
            if step.op.gives == OPENING:
                yield Verdict(step.index, UNSEEN, expected=value)
                continue
            off = self.wrong.get(step.index, 0j)
            state = WRONG if off else FOLLOWS if after & set(step.args) else RIGHT
            if state == FOLLOWS:
                after.add(step.index)
            ellipse = Ellipse(TOLERANCE, TOLERANCE / 2, 30.0) if step.op.gives == POINT else None
            yield Verdict(step.index, state, abs(off), TOLERANCE, abs(off), self.trace(step, value, off), value,
                          ellipse, self.mistake if off else None, self.kind if off else "")

    def trace(self, step: Step, value: tuple[float, ...], off: complex) -> Trace:
        """A true mark on the student's sheet, moved by so many mm."""
        frame = self.frames[self.plans.plan_of_step[step.index]]
        on = [complex(*self.plans.spot(mark)) for mark in self.plans.marks_on.get(step.index, ())]
        found = [frame.to_sheet(spot) + off for spot in extent(step, value, on, 3.0)]
        label = self.drawing.drawn.text(step.index)
        return Trace(step.op.gives, tuple((spot.real, spot.imag) for spot in found), label)
