"""The pencil that a drawing shows: its hand and the reading of its marks, told apart, whatever mistakes it has."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hands import draw, frames, points

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import POINT
from graphplan.marking.judge.findings import summary_lines
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.verdict import Judgement
from graphplan.marking.traces import Submission
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import Composition, compose

PENCIL = Pencil()
SCENES = ("four-bar", "slider-crank", "ozols-5-3")


@cache
def composed(name: str) -> tuple[Construction, Composition]:
    drawing = gp.construct(gp.load(name))
    return drawing, compose(drawing)


def measured(name: str, seed: int, hand: float, reading: float, stated: bool = False) -> Submission:
    """Points drawn by a hand so many times as unsteady as usual, and read so many mm off, written to 0.1 mm."""
    drawing, sheet = composed(name)
    rng = np.random.default_rng(seed)
    drawn = points(draw(drawing, frames(drawing, sheet, seed), PENCIL.times(hand), seed), digits=None)
    traces = [replace(trace, blur=reading if stated else 0.1 / 12**0.5, spots=tuple(
        (round(x + rng.normal(0, reading), 1), round(y + rng.normal(0, reading), 1)) for x, y in trace.spots))
        for trace in drawn.traces]
    return Submission("points.csv", tuple(traces), shows=frozenset({POINT}), measured=True, stated=stated)


def judged(name: str, submission: Submission) -> Judgement:
    return judge(*composed(name), submission, PENCIL)


@pytest.mark.parametrize(("hand", "reading"), [(0.5, 0.05), (1.0, 0.2), (2.0, 0.1), (2.0, 0.3)])
def test_a_faultless_drawing_is_faultless_however_coarse(hand: float, reading: float) -> None:
    """Without a stated precision, and with one."""
    for name in SCENES:
        for seed, stated in ((2, False), (3, True)):
            found = judged(name, measured(name, seed, hand, reading, stated))
            assert found.first_wrong is None
            assert found.pencil is not None
            assert found.pencil.reading == 0.0 if stated else found.pencil.reading < 2 * max(reading, 0.1)


def test_the_hand_and_the_reading_are_told_apart() -> None:
    """On the average of some drawings: that of a steady hand, badly read, and of an unsteady one, well read."""
    told = []
    for hand, reading in ((0.7, 0.3), (2.5, 0.05)):
        found = [judged("ozols-5-3", measured("ozols-5-3", seed, hand, reading)).pencil for seed in range(6)]
        told.append(np.mean([(one.scale, one.reading) for one in found if one], axis=0))
    (steady, badly), (unsteady, well) = told
    assert steady < unsteady
    assert badly == pytest.approx(0.3, rel=0.3)
    assert well < badly / 2


def test_who_states_the_bounds_of_his_reading_is_judged_by_less() -> None:
    """On the average of some drawings; who states its standard deviation is judged by nearly that."""
    told = []
    for stated in (0.2, 0.4):
        parts = []
        for seed in range(8):
            submission = measured("ozols-5-3", seed, 1.0, 0.2, stated=True)
            traces = tuple(replace(trace, blur=stated) for trace in submission.traces)
            found = judged("ozols-5-3", replace(submission, traces=traces))
            assert found.first_wrong is None
            assert found.pencil is not None
            parts.append(found.pencil.share_shown)
        told.append(np.mean(parts))
    assert told[0] > 0.8
    assert told[1] < 0.7


def test_a_mistake_makes_no_coarser_pencil() -> None:
    """Nor do a few."""
    submission = measured("four-bar", 3, 1.0, 0.1)
    clean = judged("four-bar", submission).pencil
    moved = [replace(trace, spots=((trace.spots[0][0] + 20.0, trace.spots[0][1] + 9.0),))
             if trace.label in ("v_b", "b", "B_1") else trace for trace in submission.traces]
    found = judged("four-bar", replace(submission, traces=tuple(moved)))
    assert clean is not None
    assert found.pencil is not None
    assert found.pencil.scale == pytest.approx(clean.scale, rel=0.3)
    assert found.first_wrong is not None


def test_few_marks_are_judged_by_the_stated_pencil() -> None:
    """A drawing of the given points alone shows none; of some marks more it is said which."""
    submission = measured("four-bar", 4, 1.0, 0.1)
    few = replace(submission, traces=submission.traces[:2])
    assert judged("four-bar", few).pencil is None
    told = " ".join(summary_lines(judged("four-bar", submission)))
    assert "Pencil read off the drawing: " in told
    assert "marks measured to" in told
