"""Marks where nobody would put them: whatever coincides, is in a row or in one spot, a judgement comes out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hands import draw, frames, points

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.errors import Refused
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.verdict import WRONG
from graphplan.marking.traces import Spot, Trace
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import Composition, compose

SCENES = ("four-bar", "slotted-link", "slider-crank", "jaanimets-11", "triad")
Moved = Callable[[np.random.Generator, list[Trace], Trace], Spot]


@cache
def composed(name: str) -> tuple[Construction, Composition]:
    drawing = gp.construct(gp.load(name))
    return drawing, compose(drawing)


def _plan(traces: list[Trace], panel: str) -> list[Trace]:
    return [trace for trace in traces if trace.panel == panel] or traces


MOVED: dict[str, Moved] = {
    "all in one spot": lambda rng, traces, trace: (50.0, 50.0),
    "anywhere": lambda rng, traces, trace: (rng.uniform(0, 200), rng.uniform(0, 200)),
    "in a row": lambda rng, traces, trace: (trace.spots[0][0], 10.0),
    "a plan in one spot": lambda rng, traces, trace: (
        _plan(traces, "N-plan")[0] if trace.panel == "N-plan" else trace).spots[0],
    "some on each other": lambda rng, traces, trace: (
        trace if rng.random() < 0.7 else traces[rng.integers(len(traces))]).spots[0],
    "vectors of no length": lambda rng, traces, trace: (
        trace if rng.random() < 0.7 else _plan(traces, trace.panel)[0]).spots[0],
}


@pytest.mark.parametrize("name", SCENES)
@pytest.mark.parametrize("way", MOVED)
def test_no_place_of_a_mark_stops_the_judge(name: str, way: str) -> None:
    """A judgement with a verdict for every step, or a refusal in one line."""
    drawing, sheet = composed(name)
    rng = np.random.default_rng(list(MOVED).index(way))
    traces = list(points(draw(drawing, frames(drawing, sheet, 1), Pencil(), 1)).traces)
    moved = [replace(trace, spots=(MOVED[way](rng, traces, trace),)) for trace in traces]
    submission = replace(points(draw(drawing, frames(drawing, sheet, 1), Pencil(), 1)), traces=tuple(moved))
    try:
        assert len(judge(drawing, sheet, submission, Pencil()).verdicts) == len(drawing.drawn.steps)
    except Refused as refused:
        assert "fewer than two of its points" in str(refused)


@pytest.mark.parametrize(("name", "mark", "begin", "told"), [
    ("four-bar", "b", "a", "the normal acceleration of A about B omitted"),
    ("slotted-link", "n_A3P", "pi", "the normal acceleration of A3 about P omitted"),
    ("slotted-link", "k_A3A", "a'", "the Coriolis acceleration of A3 relative to A omitted"),
])
def test_a_vector_of_no_length_is_told_as_omitted(name: str, mark: str, begin: str, told: str) -> None:
    """Its end stands where it begins."""
    drawing, sheet = composed(name)
    names = {step.name: step for step in drawing.drawn.steps if step.name}
    submission = points(draw(drawing, frames(drawing, sheet), Pencil(), 1))
    plan = names[mark].panel
    spots = {trace.label: trace.spots for trace in submission.traces if trace.panel == plan}
    traces = [replace(trace, spots=spots[begin]) if (trace.label, trace.panel) == (mark, plan) else trace
              for trace in submission.traces]
    found = judge(drawing, sheet, replace(submission, traces=tuple(traces)), Pencil())
    assert found.first_wrong
    assert (found.first_wrong.step, str(found.first_wrong.mistake)) == (names[mark].index, told)
    assert found.first_wrong.state == WRONG
