"""How a drawing is read: by which construction, on what sheet, and how its marks are to be taken."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from graphplan.marking.judge.student_sheet import Fit
from graphplan.marking.traces import Submission
from graphplan.methods.construction import Construction
from graphplan.phrases import Said
from graphplan.sheet.layout.composition import Composition, compose


@dataclass(frozen=True)
class Reading:
    """One way to read a drawing: the `submission` as its traces are taken, and the construction that it is judged by.

    `fits` are the frames of plans that its marks tell; `told` says what differs from the task, `scaled` the plan whose
    k_v is told with that; `prior` is how unlikely it is, in natural logarithms of odds. `task` is the task's sheet.
    """

    drawing: Construction
    task: Composition
    submission: Submission
    told: tuple[Said, ...] = ()
    scaled: str = ""
    prior: float = 0.0
    fits: Mapping[str, Fit] = field(default_factory=dict)

    @cached_property
    def on_task(self) -> Composition | None:
        """The sheet of the task with this construction on it; None where that has other plans."""
        if self.drawing is self.task.plans.drawing:
            return self.task
        plans = replace(self.task.plans, drawing=self.drawing)
        if plans.panels != self.task.plans.panels:
            return None
        return replace(self.task, plans=plans, scales=replace(self.task.scales, kappa=self.drawing.kappa))

    @cached_property
    def composition(self) -> Composition:
        """Its sheet: that of the task, if it has the same plans."""
        return self.on_task or compose(self.drawing, tongue=self.task.plans.tongue)
