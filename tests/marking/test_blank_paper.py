"""Drawings on blank or squared paper: nothing is printed; a scale bar and two labelled pins say what is what."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hands import Drawn, slipped, traced
from hands import draw as drawn_by_hand

from graphplan.accuracy.drafted import Drafted
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.classroom.results import MarkedDrawing
from graphplan.marking.files.drawing import circle_through
from graphplan.marking.judge.score import Weights
from graphplan.marking.traces import PlanFrame, Spot
from graphplan.mechanism.scene import load
from graphplan.public.desk import Desk
from graphplan.public.drafting import Options
from graphplan.public.variants import draft_scene

SQUARE_MM, MARGIN_MM, BAR_MM = 5.0, 20.0, 100.0  # a square of the paper, what is left beside; what the bar stands for
LABEL_DISTANCE_MM = 3.0  # mm from a pin to its letter
SCENES = ("four-bar", "slider-crank", "ozols-5-1", "shaper", "rosenauer-basic", "five-bar", "stephenson", "class-four")


@cache
def draft_named(name: str) -> Drafted:
    """A scene on its sheet, of which the student has none."""
    return draft_scene(Options(), load(name))


def student(name: str, seed: int, wrong: bool = False) -> Drawn:
    """A drawing at a scale of the student's own; one parallel is to the wrong line, if it is to be wrong."""
    rng, sheet = np.random.default_rng(seed), draft_named(name)
    size, shift = rng.uniform(0.8, 1.25), complex(*rng.uniform(-30, 30, 2))
    frames = {panel: PlanFrame(complex(*view.origin) * size + shift, view.scale * size)
              for panel, view in sheet.composition.views.items()}
    parallels = [step.index for step in sheet.drawing.drawn.steps if step.op.name == "parallel"]
    index = parallels[int(rng.integers(len(parallels)))]
    return drawn_by_hand(sheet.drawing, frames, Pencil(), seed,
                         {index: slipped(sheet.drawing, index)[0]} if wrong else None)


def elements(drawn: Drawn, squared: bool) -> Iterator[tuple[str, Sequence[Spot]]]:
    """What is on the paper, as elements of SVG with the spots that fill them: squares, the bar, marks, two names."""
    traces = traced(drawn)
    points = [complex(*trace.spots[0]) for trace in traces if trace.kind == POINT]
    spots = np.array([spot for trace in traces for spot in trace.spots])
    (left, low), (right, high) = spots.min(axis=0) - MARGIN_MM, spots.max(axis=0) + MARGIN_MM
    if squared:
        for x in np.arange(left, right, SQUARE_MM):
            yield '<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="#bbb"/>', [(x, low), (x, high)]
        for y in np.arange(low, high, SQUARE_MM):
            yield '<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="#bbb"/>', [(left, y), (right, y)]
    end = left + 10 + BAR_MM * abs(drawn.frames["mechanism"].unit)
    yield '<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="#000"/>', [(left + 10, high - 8), (end, high - 8)]
    yield f'<text x="{{}}" y="{{}}" font-size="4">{BAR_MM:g} mm</text>', [(end + 2, high - 9)]
    pins = [step.name for step in drawn.drawing.drawn.steps[:2]]
    for trace in traces:
        if trace.kind == POINT:
            yield '<circle cx="{}" cy="{}" r="0.6" fill="#000"/>', trace.spots
            if trace.label in pins:
                pin = complex(*trace.spots[0])
                at = max((pin + cmath.rect(LABEL_DISTANCE_MM, math.pi * k / 4) for k in range(8)),
                         key=lambda free: min(abs(free - point) for point in points if point != pin))
                yield f'<text x="{{}}" y="{{}}" font-size="4" text-anchor="middle">{trace.label}</text>', [
                    (at.real, at.imag - 1.4)]
        elif trace.kind == LINE:
            yield '<line x1="{}" y1="{}" x2="{}" y2="{}" stroke="#000"/>', trace.spots
        elif trace.kind == CIRCLE and (rim := circle_through(*trace.spots[:3])):
            yield f'<circle cx="{{}}" cy="{{}}" r="{rim[1]}" fill="none" stroke="#000"/>', [rim[0]]


def judged(drawn: Drawn, name: str, path: Path, squared: bool = True) -> MarkedDrawing:
    """The drawing as a file of a drawing program, judged."""
    put = list(elements(drawn, squared))
    spots = np.array([spot for _, filled in put for spot in filled])
    (left, low), (right, high) = spots.min(axis=0), spots.max(axis=0)
    body = "".join(element.format(*(f"{number:.3f}" for x, y in filled for number in (x - left, high - y)))
                   for element, filled in put)
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" width="{right - left:.2f}mm" height="{high - low:.2f}mm" '
                    f'viewBox="0 0 {right - left:.2f} {high - low:.2f}">{body}</svg>')
    return Desk(draft_named(name), Weights(), Options()).judge_file(path)


@pytest.mark.parametrize("squared", [True, False])
@pytest.mark.parametrize("name", SCENES)
def test_right_drawings_on_blank_paper_are_right(name: str, squared: bool, tmp_path: Path) -> None:
    """Whatever the student's scale and place, with squares or without: no step is wrong, all earns all."""
    for seed in range(2):
        marked = judged(student(name, seed), name, tmp_path / "x.svg", squared)
        assert (marked.guilty, marked.score.total) == (None, 100.0)


@pytest.mark.parametrize("name", SCENES)
def test_a_mistake_on_blank_paper_is_told(name: str, tmp_path: Path) -> None:
    """A parallel to the wrong line costs points."""
    marked = judged(student(name, 3, wrong=True), name, tmp_path / "x.svg")
    assert marked.guilty is not None
    assert (marked.score.total or 0.0) < 96.0
