"""Handouts of a task of synthesis, and the desk where drawings of it are judged."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.kernel.passes import Drawing, Values
from graphplan.marking.desk import Desk
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.output.panelled import GAP_MM, pages
from graphplan.phrases import Said
from graphplan.sheet.frames.frame import page_code, sheet_code
from graphplan.sheet.frames.title import GUIDED, SOLUTION, TASK
from graphplan.sheet.handout import with_corner_marks
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.paper import Arrangement, sheet_size
from graphplan.sheet.plates.display import Rect, Sheet
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.rows import TICKED_INDENT, TextRow, with_tick_box
from graphplan.synthesis.sheet import SynthesisSheet
from graphplan.synthesis.sketch import PLAN, Synthesis

if TYPE_CHECKING:
    from graphplan.marking.judge.verdict import Judgement
    from graphplan.marking.traces import Submission

DOCUMENTS = {"task": TASK, "guided": GUIDED, "solution": SOLUTION}


@dataclass(frozen=True)
class HandoutSheet(SynthesisSheet):
    """One part of a handout: but for the solution a task, guided one with the steps in words and boxes to tick."""

    indent = TICKED_INDENT

    @property
    def step_rows(self) -> list[TextRow]:
        """The construction in words; a task has none."""
        if self.document != GUIDED:
            return super().step_rows
        rows = super(SynthesisSheet, self).step_rows
        return [with_tick_box(row) if len(row.cells) > 1 else row for row in rows]

    @cached_property
    def composition(self) -> Composition:
        """The construction where it lies on this sheet, as drawings by hand are laid on it."""
        wide, high = sheet_size(self.paper)
        rect = self.panels[PLAN]
        column = Rect(rect.right + GAP_MM, self.title.top + GAP_MM, self.space.right - GAP_MM, self.space.top - GAP_MM)
        arrangement = Arrangement(self.paper, wide, high, self.space, {MECHANISM: rect}, (column,), self.title)
        return Composition(arrangement, self.scales, {MECHANISM: self.window},
                           Plans(self.construction(self.values), self.tongue))

    def construction(self, values: Values) -> Construction:
        """A drawing of the task as that of a mechanism's plan."""
        steps = tuple(step.but(panel=MECHANISM) for step in values.drawing.program.steps)
        program = replace(values.drawing.program, steps=steps)
        return Plans.of_values(Values(Drawing(program), values.numbers), self.scene).drawing

    @property
    def code(self) -> int:
        """Checksum of the task and of where its figure lies, by which a scan is recognized."""
        return sheet_code(f"{self.synthesis.task.text}\n{self.paper}, {self.scene.sheet.frame}, {self.k_s:.6g}")


@dataclass(frozen=True)
class SynthesisHandout:
    """The parts of a handout, on the paper that is named, or on the smallest of `papers` that the solution fits."""

    synthesis: Synthesis
    check: dict[str, float]
    papers: Sequence[str]

    def _sheets_of(self, document: Said) -> Callable[[str], HandoutSheet]:
        return partial(HandoutSheet, synthesis=self.synthesis, check=self.check, document=document)

    @cached_property
    def solution(self) -> list[Sheet]:
        """The solved sheet, and pages of words where these stand apart."""
        return pages(self._sheets_of(SOLUTION), self.synthesis.task.sheet.paper, self.papers)

    @cached_property
    def sheet(self) -> HandoutSheet:
        """The sheet of the solution."""
        named, size = self.synthesis.task.sheet.paper, (self.solution[0].width, self.solution[0].height)
        return self._sheets_of(SOLUTION)(named or next(name for name in self.papers if sheet_size(name) == size))

    def pages_of(self, name: str) -> list[Sheet]:
        """The pages of a part: task, guided or solution; those that students draw on with coded corners."""
        document = DOCUMENTS[name]
        if document == SOLUTION:
            return self.solution
        sheets = pages(self._sheets_of(document), self.sheet.paper)
        return [with_corner_marks(page, page_code(self.sheet.code, number)) for number, page in enumerate(sheets, 1)]


@dataclass(frozen=True)
class TaskDesk(Desk):
    """The desk of a task of synthesis, whose sheet is that of its `handout`."""

    handout: SynthesisHandout = field(kw_only=True)

    def _desk_for_own_sheet(self, path: Path) -> Desk:
        return self

    def _drawn_pose(self, judgement: Judgement) -> str:
        return ""  # a task of synthesis has no pose

    def _print_task(self) -> Sheet:
        return self.handout.pages_of("task")[0]

    @property
    def _code(self) -> int:
        return self.handout.sheet.code

    def _judge(self, submission: Submission) -> Judgement:
        """What is said of a drawing by that of the right ones which it is meant as."""
        from graphplan.marking.judge.judge import RightDrawing, judge_any_drawing
        from graphplan.synthesis.find import MIRRORED_KINDS, asked_marks, right_drawings

        sheet, on_sheet = self.handout.sheet, self.on_sheet
        own, kind = self.handout.synthesis.values, self.handout.synthesis.task.kind

        def drawings(letters: Iterable[str], places: Mapping[str, complex]) -> Iterator[RightDrawing]:
            for values in right_drawings(self.handout.synthesis, letters, places):
                drawing = on_sheet.drawing if values is own else sheet.construction(values)
                yield RightDrawing(drawing, frozenset(asked_marks(values)), kind in MIRRORED_KINDS)

        return judge_any_drawing(drawings, on_sheet.composition, submission, on_sheet.pencil)
