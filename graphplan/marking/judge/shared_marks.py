"""Marks that several steps of a plan share, so that one dot is the mark of all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from graphplan.kernel.kinds import POINT
from graphplan.marking.judge import measures
from graphplan.marking.judge.student_sheet import plain_value
from graphplan.marking.traces import Frames, Submission
from graphplan.methods.construction import Construction


@dataclass(frozen=True)
class SharedMarks:
    """Which steps of a drawing make the same dot, on the plans that are known to lie in `frames`."""

    drawing: Construction
    plan_of_step: Sequence[str]
    frames: Frames

    @cached_property
    def spots(self) -> Sequence[complex | None]:
        """Where the mark of each step is on the sheet, in mm; None of one that makes no point, or on another plan."""
        return [frame.to_sheet(complex(*plain_value(value)[:2])) if step.op.gives == POINT and frame else None
                for step, value, frame in zip(self.drawing.drawn.steps, self.drawing.values,
                                              map(self.frames.get, self.plan_of_step), strict=True)]

    def are_one(self, step: int, other: int) -> bool:
        """Whether two steps make the same dot of one plan."""
        at, there = self.spots[step], self.spots[other]
        return (at is not None and there is not None and self.plan_of_step[step] == self.plan_of_step[other]
                and abs(at - there) < measures.DIFFERENT_MM)

    def labels_of_others(self, submission: Submission, labels: Mapping[int, int]) -> dict[int, int]:
        """The steps without labels that share the mark of a step with one, where there is a single dot for both, by the
        place of its trace."""
        dots = {complex(*trace.spots[0]) for trace in submission.traces if trace.kind == POINT}  # some of two names

        def has_single_dot(step: int, place: int) -> bool:
            at, dot = self.spots[step], complex(*submission.traces[place].spots[0])
            return (at is not None and abs(dot - at) < measures.DIFFERENT_MM
                    and sum(abs(near - dot) < measures.DIFFERENT_MM for near in dots) == 1)

        single_dots = {step: place for step, place in labels.items() if has_single_dot(step, place)}
        return {step: place for step in range(len(self.spots)) if step not in labels
                for labelled, place in single_dots.items() if self.are_one(step, labelled)}
