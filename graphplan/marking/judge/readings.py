"""What a drawing is meant as: the construction that it follows, on what sheet, and how its marks are to be taken."""

from __future__ import annotations

from dataclasses import dataclass

from graphplan.marking.traces import Submission
from graphplan.methods.construction import Construction
from graphplan.phrases import Said
from graphplan.sheet.layout.composition import Composition


@dataclass(frozen=True)
class Reading:
    """One way to read a drawing: the `submission` as its traces are taken, the construction and the sheet that it is
    judged by; `told` says what differs from the task, `prior` how unlikely that is, in natural logarithms of odds."""

    drawing: Construction
    composition: Composition
    submission: Submission
    told: tuple[Said, ...] = ()
    prior: float = 0.0
