"""Handouts of a task of synthesis, and the desk where drawings of it are judged."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.marking.desk import Desk
from graphplan.phrases import Said
from graphplan.sheet.frames.frame import page_code
from graphplan.sheet.frames.title import GUIDED, SOLUTION, TASK
from graphplan.sheet.handout import with_corner_marks
from graphplan.sheet.layout.paper import sheet_size
from graphplan.sheet.panels import pages
from graphplan.sheet.plates.display import Sheet
from graphplan.synthesis.sheet import SynthesisOnPaper
from graphplan.synthesis.sketch import Synthesis

if TYPE_CHECKING:
    from graphplan.marking.judge.verdict import Judgement
    from graphplan.marking.traces import Submission

DOCUMENTS = {"task": TASK, "guided": GUIDED, "solution": SOLUTION}


@dataclass(frozen=True)
class SynthesisHandout:
    """The parts of a handout, on the paper that is named, or on the smallest of `papers` that the solution fits."""

    synthesis: Synthesis
    check: dict[str, float]
    papers: Sequence[str]

    def _on_paper(self, paper: str, document: Said) -> SynthesisOnPaper:
        return SynthesisOnPaper(paper, self.synthesis, self.check, document)

    def _pages(self, document: Said, paper: str, papers: Sequence[str] = ()) -> list[Sheet]:
        return pages(lambda name: self._on_paper(name, document).sheet, paper, papers)

    @cached_property
    def solution(self) -> list[Sheet]:
        """The solved sheet, and pages of words where these stand apart."""
        return self._pages(SOLUTION, self.synthesis.task.sheet.paper, self.papers)

    @cached_property
    def on_paper(self) -> SynthesisOnPaper:
        """The solution on its paper."""
        named, size = self.synthesis.task.sheet.paper, (self.solution[0].width, self.solution[0].height)
        return self._on_paper(named or next(name for name in self.papers if sheet_size(name) == size), SOLUTION)

    def pages_of(self, name: str) -> list[Sheet]:
        """The pages of a part: task, guided or solution; those that students draw on with coded corners."""
        document = DOCUMENTS[name]
        if document == SOLUTION:
            return self.solution
        sheets = self._pages(document, self.on_paper.paper)
        return [with_corner_marks(page, page_code(self.on_paper.code, number)) for number, page in enumerate(sheets, 1)]


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
        return self.handout.on_paper.code

    def _judge(self, submission: Submission) -> Judgement:
        """Judge a drawing by the right one that is nearest to it."""
        from graphplan.marking.judge.judge import RightDrawing, judge_any_drawing
        from graphplan.synthesis.find import MIRRORED_KINDS, asked_marks, right_drawings

        on_paper, on_sheet = self.handout.on_paper, self.on_sheet
        own, kind = self.handout.synthesis.values, self.handout.synthesis.task.kind

        def drawings(letters: Iterable[str], places: Mapping[str, complex]) -> Iterator[RightDrawing]:
            for values in right_drawings(self.handout.synthesis, letters, places):
                drawing = on_sheet.drawing if values is own else on_paper.construction(values)
                yield RightDrawing(drawing, frozenset(asked_marks(values)), kind in MIRRORED_KINDS)

        return judge_any_drawing(drawings, on_sheet.composition, submission, on_sheet.pencil)
