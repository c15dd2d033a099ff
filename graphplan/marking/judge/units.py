"""The unit in which a drawing program drew: by how large the mechanism is beside its task's sheet.

Programs of geometry know no units, and what CAD files state is not always meant. The mechanism's points tell how many
units of the file one unit of the scene is; as what unit the scale of the paper is that of the task, or at least a round
one, that is meant. Where none is, the drawing is taken to be as large as the task's.
"""

from __future__ import annotations

import math
from dataclasses import replace

from graphplan.accuracy.hand import Pencil
from graphplan.marking.judge import measures
from graphplan.marking.judge.lettering import Letters
from graphplan.marking.traces import Spot, Submission
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, digits, said, unit
from graphplan.sheet.layout.composition import Composition


def in_mm(drawing: Construction, composition: Composition, submission: Submission, pencil: Pencil
          ) -> tuple[Submission, tuple[Said, ...]]:
    """A drawing in mm of paper, and how its unit is told if it is another."""
    if submission.frames or math.isinf(submission.millimetres) or MECHANISM not in composition.views:
        return submission, ()
    spots = [spot for trace in submission.traces for spot in trace.spots]
    size = max((max(part) - min(part) for part in zip(*spots, strict=True)), default=0.0)
    sheet = max(composition.arrangement.width, composition.arrangement.height)
    # as marks and letters are seen
    rough = 1.0 if not size or sheet / measures.SIZE_RATIO < size < sheet * measures.SIZE_RATIO else sheet / size
    frame = Letters(drawing, composition, scaled(submission, rough), pencil,
                    rough * size / measures.FRAME_TOL_PARTS).mechanism if (
        size) else None
    if frame is None:
        return submission, ()
    task, scale = composition.views[MECHANISM].scale, abs(frame.unit) / rough
    against = {name: against + measures.RESIZED_COST * abs(math.log(scale * mm / task))
               + (0.0 if _round(scale * mm, task) else measures.ODD_SCALE_COST)
               + (submission.millimetres if name != "mm" else 0.0)
               for name, (mm, against) in measures.DRAWING_UNITS.items()}
    best = min(against, key=against.__getitem__)
    if against[best] > measures.OWN_UNIT_COST + submission.millimetres:
        mm = task / scale
        return scaled(submission, mm), (said("drawn in a unit of its own (1 unit = {0} mm)", digits(mm, 3)),)
    if best == "mm":
        return submission, ()
    mm = measures.DRAWING_UNITS[best][0]
    return scaled(submission, mm), (said("drawn in {0} (1 unit = {1} mm)", unit(best), digits(mm, 3)),)


def _round(scale: float, task: float) -> bool:
    """Whether a scale, in mm for a unit of the scene, is the task's or a round one."""
    mantissa = scale / 10.0 ** math.floor(math.log10(scale))
    return any(abs(part - 1) < measures.ROUND_SCALE_TOL
               for part in (scale / task, *(mantissa / number for number in measures.ROUND_SCALES)))


def scaled(submission: Submission, mm: float) -> Submission:
    """A drawing with every length so many times as large."""
    def at(spot: Spot) -> Spot:
        return spot[0] * mm, spot[1] * mm

    traces = tuple(replace(trace, spots=tuple(map(at, trace.spots)), blur=trace.blur * mm)
                   for trace in submission.traces)
    letters = tuple(replace(word, at=at(word.at), size=word.size * mm, long=word.long * mm,
                            leads=at(word.leads) if word.leads else None) for word in submission.letters)
    return replace(submission, traces=traces, letters=letters, tips=tuple(map(at, submission.tips)))
