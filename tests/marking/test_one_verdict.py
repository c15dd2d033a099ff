"""One reading, one verdict: every report of a drawing names the same first wrong step, in the order of drawing."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from hands import Drawn, draw, frames, off_paper, points, slipped, wrong_by
from judged import composed

from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import POINT
from graphplan.marking.classroom.results import Classroom, MarkedDrawing, class_lines
from graphplan.marking.judge.findings import judgement_record, opinion, step_name, wrong_mark
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.overlay import RED, overlay
from graphplan.marking.judge.score import score
from graphplan.marking.judge.verdict import Judgement
from graphplan.output.report_page import report_page
from graphplan.sheet.plates.display import Polygon, Text

PENCIL = Pencil(0.1, 0.1, 0.05, 0.1)
SCENES = "four-bar", "slider-crank", "five-bar"
EACH = 4


def faulty(name: str, count: int) -> list[Drawn]:
    """Drawings with a mistake each, at steps that can be seen and at others, which later marks show."""
    sheet = composed(name)
    drawing, rng = sheet.plans.drawing, np.random.default_rng(len(name))
    steps = [step for step in drawing.drawn.steps if not step.op.free]
    found = list[Drawn]()
    for step in rng.permutation(np.array(steps, object)):
        for slip in slipped(drawing, step.index)[:1]:
            drawn = draw(drawing, frames(drawing, sheet), PENCIL, 7, {step.index: slip})
            if not off_paper(drawn) and (step.op.gives != POINT or wrong_by(drawn, step) > 4.0):
                found.append(drawn)
        if len(found) == count:
            break
    return found


def judged(drawn: Drawn, name: str) -> Judgement:
    return replace(judge(drawn.drawing, composed(name), points(drawn), PENCIL), name="a.csv")


def boxed(found: Judgement) -> str:
    """What stands in the box of the overlay."""
    items = overlay(found, score(found))[0].items
    (box,) = [item for item in items if isinstance(item, Polygon) and item.pen.colour == RED]
    left, low = (min(part) for part in zip(*box.spots, strict=True))
    right, high = (max(part) for part in zip(*box.spots, strict=True))
    inside = [item for item in items if isinstance(item, Text)
              and left < item.at[0] < right and low < item.at[1] < high]
    return " ".join("".join(run.text for run in item.runs) for item in sorted(inside, key=lambda item: -item.at[1]))


@pytest.mark.parametrize("name", SCENES)
def test_all_reports_name_the_same_first_wrong_step(name: str) -> None:
    """The opinion, the data, the page, the overlay, and the line, the data and the bars of a class."""
    wrong = [found for drawn in faulty(name, EACH) if (found := judged(drawn, name)).first_wrong]
    assert wrong
    for found in wrong:
        assert found.first_wrong_step is not None
        step = step_name(found.drawing.drawn, found.first_wrong_step)
        start, place = str(step.words), str(wrong_mark(found, found.first_wrong))
        one = MarkedDrawing(found, score(found))
        room = Classroom("Class", (one,))
        assert opinion(found).startswith(f"First wrong is {place}: ")
        assert judgement_record(found, one.score)["first_wrong"]["step"] == step.number
        assert judgement_record(found, one.score)["first_wrong"]["mark"] == step.mark
        page = re.sub("</?sub>", "", report_page(found, one.score, []))
        written = place.replace("_", "").replace("'", "′")
        assert f"First wrong is {written}: " in page
        assert boxed(found).lower().startswith(f"{start}:".lower())
        line = next(line for line in map(str, class_lines(room)) if line.startswith("a.csv"))
        assert f"; {start}: ".lower() in line.lower()
        assert room.data["drawings"][0]["first_wrong"] == step.number
        assert list(room.histogram) == [step]
        assert all(verdict.at_fault >= found.first_wrong_step for verdict in found.verdicts if verdict.state == "wrong")
