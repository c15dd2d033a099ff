"""How a drawing is read: by which construction, on what sheet, how its marks are to be taken, and in which unit it was
drawn.

Programs of geometry know no units, and what CAD files state is not always meant. The mechanism's points tell how many
units of the file one unit of the scene is; as what unit the scale of the paper is that of the task, or at least a round
one, that is meant. Where none is, the drawing is taken to be as large as the task's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

from graphplan.accuracy.hand import Pencil
from graphplan.marking.judge import measures
from graphplan.marking.judge.lettering import Letters
from graphplan.marking.traces import Spot, Submission
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, digits, said, unit
from graphplan.sheet.layout.composition import Composition, compose


@dataclass(frozen=True)
class SheetReading:
    """One way to read a drawing: the `submission` as its traces are taken, and the construction that it is judged by.

    `remarks` say what differs from the task, `scaled` the plan whose k_v is told with that; `prior` is how unlikely it
    is, in natural logarithms of odds. `task` is the task's sheet; `asked` are the steps whose marks a drawing is to
    have, if not all; `exchanged` two traces, by their places, that had each other's letters, which are put right;
    `numbered` are those whose numbers are left out: each point is to be a mark of the construction.
    """

    drawing: Construction
    task: Composition
    submission: Submission
    remarks: tuple[Said, ...] = ()
    scaled: str = ""
    prior: float = 0.0
    asked: frozenset[int] | None = None
    exchanged: tuple[int, ...] = ()
    numbered: frozenset[int] = frozenset()

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


class RightDrawing(NamedTuple):
    """A drawing that is right: the steps whose marks are `asked` for, and whether it is right `mirrored` too."""

    drawing: Construction
    asked: frozenset[int]
    mirrored: bool = False


# ---- units ----------------------------------------------------------------------------------------------------------


def to_mm(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil
          ) -> tuple[Submission, tuple[Said, ...]]:
    """A drawing in mm of paper, and how its unit is told if it is another."""
    if submission.frames or math.isinf(submission.millimetres) or MECHANISM not in composition.views:
        return submission, ()
    spots = [spot for trace in submission.traces for spot in trace.spots]
    extent = max((max(coordinates) - min(coordinates) for coordinates in zip(*spots, strict=True)), default=0.0)
    sheet = max(composition.arrangement.width, composition.arrangement.height)
    # as marks and letters are seen
    rough = 1.0 if not extent or sheet / measures.SIZE_RATIO < extent < sheet * measures.SIZE_RATIO else sheet / extent
    frame = Letters(drawing, composition, scale_submission(submission, rough), pencil,
                    rough * extent / measures.FRAME_TOL_PARTS).mechanism if (
        extent) else None
    if frame is None:
        return submission, ()
    task, scale = composition.views[MECHANISM].scale, abs(frame.unit) / rough
    against = {name: against + measures.RESIZED_COST * abs(math.log(scale * mm / task))
               + (0.0 if _is_round_scale(scale * mm, task) else measures.ODD_SCALE_COST)
               + (submission.millimetres if name != "mm" else 0.0)
               for name, (mm, against) in measures.DRAWING_UNITS.items()}
    best = min(against, key=against.__getitem__)
    chance_cost = measures.ODD_SCALE_COST if _is_round_scale(scale * measures.DRAWING_UNITS[best][0], task) else 0.0
    if against[best] > measures.OWN_UNIT_COST + submission.millimetres + chance_cost:  # a round scale is no chance
        mm = task / scale
        return scale_submission(submission, mm), (said("drawn in a unit of its own (1 unit = {0} mm)", digits(mm, 3)),)
    if best == "mm":
        return submission, ()
    mm = measures.DRAWING_UNITS[best][0]
    return scale_submission(submission, mm), (said("drawn in {0} (1 unit = {1} mm)", unit(best), digits(mm, 3)),)


def _is_round_scale(scale: float, task: float) -> bool:
    """Whether a scale, in mm for a unit of the scene, is the task's or a round one."""
    mantissa = scale / 10.0 ** math.floor(math.log10(scale))
    return any(abs(ratio - 1) < measures.ROUND_SCALE_TOL
               for ratio in (scale / task, *(mantissa / number for number in measures.ROUND_SCALES)))


def mirror_submission(submission: Submission) -> Submission:
    """A drawing seen from the other side of the paper."""
    def at(spot: Spot) -> Spot:
        return spot[0], -spot[1]

    traces = tuple(replace(trace, spots=tuple(map(at, trace.spots))) for trace in submission.traces)
    letters = tuple(replace(word, at=(word.at[0], -word.at[1] - word.size),
                            leads=at(word.leads) if word.leads else None) for word in submission.letters)
    return replace(submission, traces=traces, letters=letters, frames={}, tips=tuple(map(at, submission.tips)))


def scale_submission(submission: Submission, mm: float) -> Submission:
    """A drawing with every length so many times as large."""
    def at(spot: Spot) -> Spot:
        return spot[0] * mm, spot[1] * mm

    traces = tuple(replace(trace, spots=tuple(map(at, trace.spots)), blur=trace.blur * mm)
                   for trace in submission.traces)
    letters = tuple(replace(word, at=at(word.at), size=word.size * mm, long=word.long * mm,
                            leads=at(word.leads) if word.leads else None) for word in submission.letters)
    return replace(submission, traces=traces, letters=letters, tips=tuple(map(at, submission.tips)))
