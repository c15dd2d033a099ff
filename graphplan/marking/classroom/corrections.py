"""A student's own sheet, to hand back: its scan laid straight, and over it what is right, what is wrong and where it
should be, the first wrong step in words, and the score."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphplan.kernel.kinds import POINT
from graphplan.marking.classroom import measures
from graphplan.marking.judge.findings import look_at_lines, opinion
from graphplan.marking.judge.overlay import (
    CALLOUT_PEN,
    HALF_SIZES_MM,
    LAYER,
    PENS,
    StudentMark,
    StudentStrokes,
    boxed_words,
    overlay,
    plan_remarks,
)
from graphplan.marking.judge.score import Score
from graphplan.marking.judge.verdict import EARNED, UNCLEAR, WRONG, Judgement, Verdict
from graphplan.marking.traces import Trace
from graphplan.phrases import join
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.display import Circle, Item, Photograph, Rect, Sheet, Spot, move_item
from graphplan.sheet.plates.view import View, clip_item


@dataclass(frozen=True)
class ScanStrokes(StudentStrokes):
    """A judged drawing as it lies on its own sheet, which was `printed` as a task."""

    printed: Composition

    @cached_property
    def marks(self) -> list[StudentMark]:
        """The marks where they were drawn; where they should be as the student's own plan has it, unless it is turned.
        """
        marks = []
        for verdict, step in zip(self.judgement.verdicts, self.judgement.composition.plates.steps, strict=True):
            frame = self.judgement.frames.get(step.panel)
            if verdict.trace is None or frame is None:
                continue
            view = View(self.rect(step.panel), abs(frame.unit), (frame.origin.real, frame.origin.imag))
            expected_value = (verdict.expected if abs(cmath.phase(frame.unit)) < measures.MAX_TURN_RAD
                              else (math.nan,) * len(verdict.expected))
            marks.append(StudentMark(verdict, verdict.trace, verdict.trace.spots,
                                     replace(step, view=view, value=expected_value), 1.0))
        return marks

    def spots(self, trace: Trace, panel: str) -> tuple[Spot, ...]:
        """A trace where it was drawn."""
        return trace.spots

    def rect(self, panel: str) -> Rect:
        """Place of a printed plan; the whole frame of the sheet for any other."""
        views = self.printed.views
        return views[panel].rect if panel in views else self.printed.arrangement.frame

    def doubtful(self, verdict: Verdict) -> Spot | None:
        """Place of an unclear step that is not visible."""
        panel = self.judgement.composition.plates.steps[verdict.step].panel
        if panel not in self.judgement.frames:
            return None
        spot = self.judgement.composition.views[panel].to_plan(self.expected_spot(verdict))
        at = self.judgement.frames[panel].to_sheet(complex(*spot))
        return at.real, at.imag

    def corrections(self) -> Iterator[Item]:
        """Yield the corrections over the scan, without words: rings about right points, faults of whole plans."""
        for mark in sorted(self.marks, key=lambda mark: mark.verdict.state == WRONG):
            state, rect = mark.verdict.state, mark.expected_step.view.rect
            items = [*mark.items(), *mark.tolerance()]
            if state in EARNED:
                ring = Circle(PENS.get(state, CALLOUT_PEN), LAYER, mark.verdict.step, mark.spots[0],
                              measures.RIGHT_RING_MM)
                items = [ring] if mark.trace.kind == POINT else []
            for item in items:
                yield from clip_item(item, rect)
        for verdict in self.judgement.verdicts:
            if verdict.state == UNCLEAR and verdict.trace is None and (spot := self.doubtful(verdict)):
                yield Circle(PENS[UNCLEAR], LAYER, verdict.step, spot, HALF_SIZES_MM[UNCLEAR])


@dataclass(frozen=True)
class Corrections:
    """A judged scan: the judgement, its score, how it was printed, and its picture, laid straight."""

    judgement: Judgement
    score: Score
    printed: Composition
    scan: Photograph

    @cached_property
    def true(self) -> list[Sheet]:
        """The drawing over the true one, with all remarks."""
        return overlay(self.judgement, self.score)

    @cached_property
    def student(self) -> ScanStrokes:
        """The drawing on its own sheet."""
        return ScanStrokes(self.judgement, self.printed)

    def pages(self, further: Sequence[Photograph] = ()) -> list[Sheet]:
        """The scan with the corrections on it, further pages as they are, then the drawing over the true one."""
        first_page = self._page(self.scan, *self._marks())
        return [first_page, *(self._page(photograph) for photograph in further), *self.true]

    def detail(self, cut: Callable[[Rect], Photograph]) -> Sheet | None:
        """The place of the first wrong step alone, as far as it can be seen; `cut` gives a piece of the scan, at the
        origin."""
        mark = next((mark for mark in self.student.marks if mark.verdict is self.judgement.first_wrong), None)
        if mark is None:
            return None
        (x, y), whole = mark.label_spot, self.scan.rect
        across, up = measures.DETAIL_HALF_MM
        left, low = (min(max(at - half, 0.0), most - 2 * half)
                     for at, half, most in ((x, across, whole.width), (y, up, whole.height)))
        rect = Rect(left, low, left + 2 * across, low + 2 * up)
        ring = Circle(CALLOUT_PEN.with_fill("none"), LAYER, None, (x, y), measures.DETAIL_RING_MM)
        items = [piece for item in (*mark.items(), ring) for piece in clip_item(item, rect)]
        return self._page(cut(rect), *(move_item(item, -rect.left, -rect.bottom) for item in items))

    def _page(self, scan: Photograph, *items: Item) -> Sheet:
        return replace(self.true[0], items=(scan, *items), panels={}, width=scan.rect.width, height=scan.rect.height)

    def _marks(self) -> list[Item]:
        """Items over the scan; words cover as little as they can of it and of the true drawing."""
        student, composition = self.student, self.judgement.composition
        true, over = self.true[0].items, list(student.corrections())
        for panel in self.judgement.frames:
            over += plan_remarks(student, panel, student.rect(panel), [*true, *over])
        words = composition.plans.tongue(
            join((self.score.text, opinion(self.judgement), *look_at_lines(self.judgement)), " "))
        names = tuple(step.name for step in self.judgement.drawing.drawn.steps if step.name)
        rect = student.rect(next(iter(self.printed.views)))
        return [*over, *boxed_words(words, names, (rect.left, rect.top), [*true, *over], rect, CALLOUT_PEN)[1]]
