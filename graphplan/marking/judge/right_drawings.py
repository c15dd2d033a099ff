"""A drawing of a task of which several are right, judged by that which it is likeliest meant as."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from graphplan.accuracy.hand import Pencil
from graphplan.errors import Refused
from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.judge import Judge
from graphplan.marking.judge.readings import RightDrawing, SheetReading, mirror_submission, to_mm
from graphplan.marking.judge.seen_pencil import assumed_pencil
from graphplan.marking.judge.verdict import Judgement
from graphplan.marking.traces import Submission, bare_name
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.layout.composition import Composition


def judge_any_drawing(drawings: Callable[[Iterable[str], Mapping[str, complex]], Iterable[RightDrawing]],
                      composition: Composition, submission: Submission, pencil: Pencil) -> Judgement:
    """What is said of a drawing by that of the right ones which it is likeliest meant as; they may hang on the letters
    of the student's marks, and where these lie, in the lengths of the task. Fails as :func:`judge` does.
    """
    best: Judge | None = None
    refusal, places = None, dict[str, complex]()
    names = [*(trace.label for trace in submission.traces), *(word.text for word in submission.letters)]
    for right in drawings(map(bare_name, names), places):
        for side in (submission, mirror_submission(submission))[:1 + (right.mirrored and not submission.page)]:
            try:
                sheet, remarks = to_mm(right.drawing, composition, side, pencil)
                reading = SheetReading(right.drawing, composition, sheet, remarks, asked=right.asked)
                rival = Judge(reading, assumed_pencil(pencil, sheet)).with_seen_pencil
            except Refused as fault:
                refusal = refusal or fault
                continue
            if best is None or rival.weight > best.weight:
                best = rival
                places.update(_lettered_places(best))
            if not best.has_faults:
                return best.judgement
    if best is None:
        assert refusal is not None
        raise refusal
    return best.judgement


def _lettered_places(judge: Judge) -> dict[str, complex]:
    """Where the points with letters lie on the mechanism's plan, by bare letters."""
    steps, frame = judge.drawing.drawn.steps, judge.fits[MECHANISM].frame
    return {bare_name(steps[step].name): frame.to_plan(complex(*judge.traces[place].spots[0]))
            for step, place in judge.labels.items() if steps[step].op.gives == POINT}
