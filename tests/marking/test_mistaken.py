"""Mistakes found by what they make likelier: in files without labels, where nothing says which stroke is whose."""

from __future__ import annotations

import cmath
from dataclasses import replace

import numpy as np
import pytest
from hands import Drawn, draw, frames, slipped, traced

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.judge import measures
from graphplan.marking.judge.findings import remark
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.mistaken_step import Mistake
from graphplan.marking.judge.student_sheet import Residual, weigh_mark
from graphplan.marking.judge.verdict import Judgement
from graphplan.marking.traces import Submission
from graphplan.phrases import said
from graphplan.sheet.layout.composition import compose

KINDS = (POINT, LINE, CIRCLE)


def unlabelled(drawn: Drawn) -> Submission:
    """A file in which only the given points bear their letters."""
    given = drawn.drawing.scene.points
    traces = [replace(trace, label=trace.label if trace.label in given else "", panel="") for trace in traced(drawn)]
    return Submission("unlabelled.svg", tuple(traces), shows=frozenset(KINDS))


def judged(name: str, seed: int, mistakes: dict[str, str] | None = None, odd: dict[str, complex] | None = None
           ) -> tuple[Judgement, int | None]:
    """What is said of a drawing in which some steps, by their texts, were drawn by mistakes that are told so, or whose
    vectors were turned and stretched at will; and the first such step."""
    drawing = gp.construct(gp.load(name), plan="orthogonal")
    sheet = compose(drawing)
    texts = {drawing.drawn.text(step.index): step for step in drawing.drawn.steps}
    made = {texts[text].index: next(one for one in slipped(drawing, texts[text].index) if one.text == told)
            for text, told in (mistakes or {}).items()}
    made |= {texts[text].index: Mistake("odd", said("wrong"), texts[text], factor)
             for text, factor in (odd or {}).items()}
    drawn = draw(drawing, frames(drawing, sheet), Pencil(), seed, made)
    return judge(drawing, sheet, unlabelled(drawn), Pencil()), min(made, default=None)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("most", [measures.PICTURE_ODDS, measures.FAINT_ODDS, measures.FILE_ODDS])
def test_a_mark_weighs_the_less_the_farther_off_it_is(kind: str, most: dict[str, float]) -> None:
    """And never less than none at all, nor than a stroke of which nothing is seen."""
    away = [weigh_mark(most[kind], measures.ABSENT_ODDS[kind], Residual(np.array([off, 0.0]), np.eye(2)))
            for off in (0, 2, 4, 100)]
    assert away == sorted(away, reverse=True)
    assert away[0] == most[kind]
    assert away[-1] == measures.ABSENT_ODDS[kind] == weigh_mark(most[kind], measures.ABSENT_ODDS[kind], None, share=0.0)


@pytest.mark.parametrize(("name", "seed", "mistake"), [
    ("open-chain", 711, {"point 25": "the vector is 1.5 times as long as it should be"}),  # shifts all of the N-plan
    ("ozols-5-3", 710, {"line 14": "drawn through v_a instead of O"}),
    ("four-bar", 700, {"v_m": "the figure is mirrored"}),
    ("four-bar", 700, {"line 6": "the figure is mirrored"}),  # its first side is
    ("slotted-link", 710, {"line 9": "drawn through v_a3 instead of A"}),  # another line lies where it should be
])
def test_a_mistake_is_found_without_labels(name: str, seed: int, mistake: dict[str, str]) -> None:
    """The step is named, and what was done, whatever else has moved with it."""
    found, index = judged(name, seed, mistake)
    assert found.first_wrong_step == index
    assert found.first_wrong
    assert str(found.first_wrong.mistake) in mistake.values()


def test_a_mark_that_is_not_to_be_seen_is_told_by_what_follows() -> None:
    """How far off it is, and may be, is said of the mark that shows it."""
    mark, mistake = "v_b", "marked on AB instead of line 3"
    drawing = gp.construct(gp.load("four-bar"), plan="orthogonal")
    sheet = compose(drawing)
    step = next(step for step in drawing.drawn.steps if step.name == mark)
    made = {step.index: next(one for one in slipped(drawing, step.index) if one.text == mistake)}
    drawn = draw(drawing, frames(drawing, sheet), Pencil(), 711, made)
    submission = unlabelled(drawn)
    kept = [trace for trace, true in zip(submission.traces, traced(drawn), strict=True) if true.label != mark]
    found = judge(drawing, sheet, replace(submission, traces=tuple(kept)), Pencil())
    assert found.first_wrong
    assert (found.first_wrong_step, str(found.first_wrong.mistake)) == (step.index, mistake)
    assert found.first_wrong.trace
    assert found.first_wrong.step > step.index
    assert found.first_wrong.off > found.first_wrong.tolerance > 0.1
    assert "seen at" in str(remark(found, found.first_wrong))


@pytest.mark.costly
@pytest.mark.parametrize(("name", "seed"), [("ozols-10-1", 710), ("ozols-10-1", 711), ("ozols-10-2", 710)])
def test_strokes_side_by_side_are_told_apart(name: str, seed: int) -> None:
    """Two lines that lie within a pencil's width are taken for each other only if nothing else says which is which."""
    found, _ = judged(name, seed)
    assert found.first_wrong is None


def test_a_mistake_that_no_table_has_is_found_by_what_follows_from_it() -> None:
    """Its step is named; what was done is not known."""
    found, index = judged("four-bar", 5, odd={"A_1": cmath.rect(1.3, 0.4)})
    assert found.first_wrong
    assert (found.first_wrong.step, found.first_wrong.mistake) == (index, None)
