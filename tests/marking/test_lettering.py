"""Letters beside marks: which names which, over the whole drawing; and the unit that it is drawn in."""

from __future__ import annotations

import math
import random
from dataclasses import replace
from functools import cache
from itertools import permutations
from pathlib import Path

import pytest
from hands import Drawn, draw, frames, traced

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import POINT
from graphplan.marking.files.drawing import drawing_submission as put
from graphplan.marking.files.drawing import word_at
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.labels import assign_labels, cheapest_columns
from graphplan.marking.judge.readings import scale_submission
from graphplan.marking.judge.verdict import IMPLIED, RIGHT, WRONG, asked_results
from graphplan.marking.traces import Lettering, Submission, Trace
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import Composition, compose

PENCIL = Pencil()
SCENES = ("four-bar", "shaper", "alt-eight-link")


@cache
def composed(name: str) -> tuple[Construction, Composition]:
    drawing = gp.construct(gp.load(name))
    return drawing, compose(drawing)


def drawn(name: str, seed: int = 1) -> Drawn:
    drawing, sheet = composed(name)
    return draw(drawing, frames(drawing, sheet), PENCIL, seed)


def written(drawn: Drawn, exchanged: tuple[str, str] = ("", ""), dots: bool = True, seed: int = 1) -> Submission:
    """A drawing with letters up to 2.5 mm off its points, anywhere about them; two may be exchanged, dots left out."""
    rng, words, traces = random.Random(seed), list[Lettering](), list[Trace]()
    others = dict(zip(exchanged, reversed(exchanged), strict=True))
    for trace in traced(drawn, 3):
        if trace.kind != POINT or dots:
            traces.append(replace(trace, label="", panel=""))
        if trace.kind == POINT and not trace.label.isdigit():
            word, way = word_at(others.get(trace.label, trace.label), (0, 0), 2.5), rng.uniform(0, math.tau)
            far = rng.uniform(1.0, 2.5)
            x, y = (part + far * turn for part, turn in zip(
                trace.spots[0], (math.cos(way), math.sin(way)), strict=True))
            words.append(replace(word, at=(x - word.long * (1 - math.cos(way)) / 2, y - 0.9 * (1 - math.sin(way)))))
    return put(Path("drawing.svg"), traces, words, {})


@pytest.mark.parametrize("name", SCENES)
def test_letters_between_marks_are_told_apart(name: str) -> None:
    """A faultless drawing with letters anywhere about its marks, many of which are close, is faultless; so it is where
    marks have no dots but where lines cross."""
    for seed in (1, 2):
        made = drawn(name, seed)
        for dots in (True, False):
            found = judge(*composed(name), written(made, dots=dots, seed=seed), PENCIL)
            assert [(dots, made.drawing.drawn.text(verdict.step)) for verdict in found.verdicts
                    if verdict.state == WRONG] == []


def test_letters_alone_hand_a_result_in() -> None:
    """Where marks have no dots, and no strokes cross, the letters that stand where a mark should be are that mark; all
    but that of v_S, beside which strokes cross a little way off."""
    for seed in (1, 2):
        found = judge(*composed("open-chain"), written(drawn("open-chain", seed), dots=False, seed=seed), PENCIL)
        assert {one.of for one in asked_results(found) if one.state not in (RIGHT, IMPLIED)} <= {"S"}


@pytest.mark.parametrize(("name", "pair"), [("four-bar", ("A_1", "B_1")), ("alt-eight-link", ("v_c", "v_e"))])
def test_exchanged_letters_are_a_mistake(name: str, pair: tuple[str, str]) -> None:
    """Letters that stand clearly at each other's marks are told so, at the first of them, and nothing else is wrong."""
    made = drawn(name)
    found = judge(*composed(name), written(made, exchanged=pair), PENCIL)
    assert [made.drawing.drawn.steps[verdict.step].name for verdict in found.verdicts if verdict.state == WRONG] == [
        pair[0]]
    assert found.first_wrong
    assert str(found.first_wrong.mistake) == f"the letters of {pair[0]} and {pair[1]} are exchanged"


@pytest.mark.parametrize(("mm", "told"), [(1.0, ""), (10.0, "drawn in cm (1 unit = 10 mm)"),
                                          (1000.0, "drawn in m (1 unit = 1000 mm)"),
                                          (25.4, "drawn in in (1 unit = 25.4 mm)"),
                                          (7.3, "drawn in a unit of its own (1 unit = 7.3 mm)")])
def test_the_unit_of_a_drawing_is_told(mm: float, told: str) -> None:
    """A drawing in cm, m, inches or a unit of its own is recognized by the size of its mechanism."""
    made = drawn("four-bar")
    found = judge(*composed("four-bar"), scale_submission(written(made), 1 / mm), PENCIL)
    assert str(found.reading) == told
    assert found.first_wrong is None


def test_the_least_sum_of_costs() -> None:
    """Rows have the columns of the least sum of all ways; crowds that share nothing are settled alone."""
    rng = random.Random(3)
    for _ in range(50):
        table = [[rng.choice((rng.random(), math.inf)) for _ in range(5)] + [2.0] * 4 for _ in range(4)]
        found = cheapest_columns(table)
        least = min(sum(map(lambda row, place: row[place], table, way)) for way in permutations(range(9), 4))
        assert len(set(found)) == 4
        assert sum(map(lambda row, place: row[place], table, found)) == pytest.approx(least)
    assert assign_labels([{1: 0.0, 2: 1.0}, {1: 0.5, 2: 3.0}, {7: 1.0}, {}], 9.0, 4.0) == [2, 1, 7, None]
