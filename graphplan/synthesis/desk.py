"""Where drawings of a task of synthesis are judged, by that of the right ones which each is meant as."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.marking.desk import Desk

if TYPE_CHECKING:
    from graphplan.marking.judge.verdict import Judgement
    from graphplan.marking.traces import Submission
    from graphplan.sheet.plates.display import Sheet
    from graphplan.synthesis.handout import SynthesisHandout


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
        from graphplan.marking.judge.readings import RightDrawing
        from graphplan.marking.judge.right_drawings import judge_any_drawing
        from graphplan.synthesis.choices import MIRRORED_KINDS, asked_marks, right_drawings

        sheet, on_sheet = self.handout.sheet, self.on_sheet
        own, kind = self.handout.synthesis.values, self.handout.synthesis.task.kind

        def drawings(letters: Iterable[str], places: Mapping[str, complex]) -> Iterator[RightDrawing]:
            for values in right_drawings(self.handout.synthesis, letters, places):
                drawing = on_sheet.drawing if values is own else sheet.construction(values)
                yield RightDrawing(drawing, frozenset(asked_marks(values)), kind in MIRRORED_KINDS)

        return judge_any_drawing(drawings, on_sheet.composition, submission, on_sheet.pencil)
