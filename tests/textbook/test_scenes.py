"""Every packaged scene: constructed, checked, and fit to be drawn."""

from __future__ import annotations

import math
from functools import cache
from itertools import combinations

import numpy as np
import pytest

import graphplan as gp
from graphplan.check.shortcuts import shortcuts
from graphplan.check.trusted import report
from graphplan.kernel.kinds import LINE
from graphplan.mechanism.scene import packaged_names
from graphplan.mechanism.structure import structure
from graphplan.methods.construction import Construction

CHOICES: list[dict[str, str]] = [{}, *({"method": m} for m in ("trial", "auxiliary", "poles")), {"plan": "polar"}]
FLATTEST = 15  # degrees

packaged_scenes = pytest.mark.parametrize("name", packaged_names())


@cache
def drawing_of(name: str) -> Construction:
    """A packaged scene in the forms that its pose chooses."""
    return report(gp.load(name)).drawing


@packaged_scenes
@pytest.mark.parametrize("choices", CHOICES, ids=str)
def test_construction_and_solver_agree(name: str, choices: dict[str, str]) -> None:
    """In every form and plan: to the last digit in fractions, and to 1e-12 in floats."""
    scene = gp.load(name)
    assert max(report(scene, **choices).check.values()) <= 1e-12
    if not scene.irrational:
        assert not any(report(scene, exact=True, **choices).check.values())


@packaged_scenes
def test_lines_cross_well(name: str) -> None:
    """No two lines that fix a mark on the sheet cross below 15 degrees."""
    drawing = drawing_of(name)
    for step in drawing.drawn.steps:
        if step.op.name == "meet":
            (a, b, _), (c, d, _) = (drawing.values[arg] for arg in step.args)
            sine = abs(a * d - b * c) / math.hypot(a, b) / math.hypot(c, d)
            assert math.degrees(math.asin(min(1.0, sine))) >= FLATTEST, drawing.drawn.sentence(step.index)


@packaged_scenes
def test_auxiliary_points_are_on_the_sheet(name: str) -> None:
    """Where an auxiliary point or a pole is drawn, it lies near the mechanism."""
    drawing = drawing_of(name)
    own = [complex(float(x), float(y)) for x, y in drawing.scene.points.values()]
    extent = max(abs(p - q) for p in own for q in own)
    for step, value in zip(drawing.drawn.steps, drawing.values, strict=True):
        if step.panel == "mechanism" and step.op.gives != LINE and step.name[:1] in ("Q", "R", "S") and len(value) == 2:
            assert min(abs(complex(*value) - p) for p in own) <= extent


@packaged_scenes
def test_groups_are_named(name: str) -> None:
    """Every moving link is a driving link or belongs to a group with class and order."""
    scene = gp.load(name)
    parts = structure(scene).parts
    assert sorted(link for part in parts for link in part.links) == sorted(scene.moving)


@packaged_scenes
def test_sources_are_given(name: str) -> None:
    """Every packaged scene has a title, and says where it comes from."""
    scene = gp.load(name)
    assert scene.title
    assert scene.source


def test_the_shortcuts_of_paper_16_miss() -> None:
    """Bisector and dropped normal acceleration are near the exact construction, but not on it."""
    (found,) = shortcuts(report(gp.load("stephenson")).drawing)
    assert found.middle == "A"
    assert 0 < found.angle < 1
    assert 1e-6 < found.bisector < 0.05
    assert found.dropped > 1e-6


def test_parallel_bars_need_a_trial_figure() -> None:
    """Where KA and LB are parallel the trial figure stands in for Q, which is nowhere."""
    drawing = report(gp.load("parallel-links")).drawing
    assert any("trial figure" in way for way in drawing.method["velocity"])
    with pytest.raises(gp.ConstructionError):
        _meet_of_bars()


def _meet_of_bars() -> None:
    """Q by force: the meeting of two parallel bars."""
    from graphplan.kernel.numbers import Floats
    from graphplan.kernel.passes import freeze
    from graphplan.kernel.program import Board, evaluate

    points, board = gp.load("parallel-links").points, Board()
    K, A, L, B = (board.given(x=points[name][0], y=points[name][1], name=name) for name in "KALB")
    evaluate(freeze(board, [board.meet(board.line(K, A), board.line(L, B))]), Floats())


def _crank_angles(name: str) -> int:
    """How many of 72 steps of a turn the crank makes while all other links, with revolutes only, keep their lengths."""
    scene = gp.load(name)
    links = scene.links
    points = {p: np.array([float(x), float(y)]) for p, (x, y) in scene.points.items()}
    O, turning = points[links["1"][0]], links["1"][1:]
    free = [p for p in points if p not in (*links["frame"], *links["1"])]
    bars = [(p, q) for link in scene.moving if link != "1" for p, q in combinations(links[link], 2)]
    lengths = {bar: np.linalg.norm(points[bar[0]] - points[bar[1]]) for bar in bars}
    cos, sin = math.cos(math.tau / 72), math.sin(math.tau / 72)
    turn = np.array([[cos, -sin], [sin, cos]])
    for step in range(72):
        points |= {p: O + turn @ (points[p] - O) for p in turning}
        for _ in range(8):
            gaps = {bar: points[bar[0]] - points[bar[1]] for bar in bars}
            slopes = np.zeros((len(bars), len(free), 2))
            for row, (p, q) in enumerate(bars):
                for end, gap in ((p, gaps[p, q]), (q, -gaps[p, q])):
                    if end in free:
                        slopes[row, free.index(end)] = gap / np.linalg.norm(gap)
            misses = [lengths[bar] - np.linalg.norm(gaps[bar]) for bar in bars]
            moves = np.linalg.solve(slopes.reshape(len(bars), -1), misses).reshape(-1, 2)
            points |= {p: points[p] + move for p, move in zip(free, moves, strict=True)}
        if max(map(abs, misses)) > 1e-9 or np.abs(moves).max() > 1e-6:
            return step
    return 72


@pytest.mark.parametrize("name", ["alt-eight-link-2", "alt-ten-link-2", "four-bar", "double-butterfly"])
def test_the_crank_turns_all_the_way(name: str) -> None:
    """One rotation into oscillations: these linkages close in every position of their crank."""
    assert _crank_angles(name) == 72
