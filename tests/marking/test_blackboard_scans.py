"""How scans of drawings by another hand are judged, which have no strokes but those of the textbook's vectors."""

from __future__ import annotations

import cmath
import random
from pathlib import Path
from typing import Any

import pytest

cv2 = pytest.importorskip("cv2")

from blackboard import MAKERS, Board, Places, Task, task_of  # noqa: E402
from raster import Stroke, printed, scan  # noqa: E402
from shared.tiers import sample  # noqa: E402

import graphplan as gp  # noqa: E402
from graphplan.accuracy.hand import Pencil  # noqa: E402
from graphplan.marking.judge.judge import judge_any_method  # noqa: E402
from graphplan.marking.judge.verdict import Judgement  # noqa: E402
from graphplan.marking.submission import read_submission  # noqa: E402
from graphplan.marking.traces import PlanFrame  # noqa: E402
from graphplan.sheet.handout import code  # noqa: E402
from graphplan.sheet.handout import task as handout  # noqa: E402
from graphplan.sheet.layout.composition import Composition, compose  # noqa: E402

SEEDS, NAMES = sample(range(1), range(7)), sample(["four-bar, polar", "inverted slider-crank"], list(MAKERS))
FALSE_ALARMS, BEYOND_MM = 0.05, 3.0


def given_places(task: Task, sheet: Composition) -> Places:
    """Where the task's paper has the plans, and at which scales."""
    drawing, plan_of_step = sheet.plans.drawing, sheet.plans.plan_of_step

    names = {step.name for step in drawing.drawn.steps}

    def at(name: str, panel: str) -> complex:
        step = next(step for step in drawing.drawn.steps if step.name == name and plan_of_step[step.index] == panel)
        view = sheet.views[panel]
        return complex(*view.origin) + view.scale * complex(*map(float, drawing.values[step.index][:2]))

    mechanism, crank = sheet.views["mechanism"], abs(task.points["A"])
    if task.plan == "polar":
        p, pi = at("p", "velocity plan"), at("pi", "acceleration plan")
        k_v, k_a = abs(at("a", "velocity plan") - p), abs(at("a'", "acceleration plan") - pi)
        return Places(complex(*mechanism.origin), p, pi, float(mechanism.scale), k_v / abs(task.omega) / crank,
                      k_a / task.omega**2 / crank)
    a = at("a", "N-plan")
    v_a = abs(at("v_a" if "v_a" in names else "O", "mechanism") - at("A", "mechanism"))  # v_A may end in O
    times = abs(at("A_1", "N-plan") - a) * crank * float(mechanism.scale) / v_a**2
    return Places(complex(*mechanism.origin), 0j, a, float(mechanism.scale), v_a / abs(task.omega) / crank, times)


def pencil_strokes(board: Board) -> list[Stroke]:
    """What a pencil leaves of a drawing: strokes beyond their ends, and dots."""
    lines = [(one, other + BEYOND_MM * (other - one) / abs(other - one)) for one, other in board.strokes
             if other != one]
    dots = [[z + cmath.rect(0.25, 1.5 * k) for k in range(5)] for z in board.marks.values()]
    return [*(([(z.real, z.imag) for z in line], 0.3, 0.7) for line in lines),
            *(([(z.real, z.imag) for z in dot], 0.5, 0.9) for dot in dots)]


def judged(name: str, seed: int, folder: Path) -> Judgement:
    """A right drawing on the task's paper, before a scanner, and what is said of it."""
    task = task_of(name, seed)
    (scene := folder / "task.toml").write_text(task.scene)
    sheet = compose(gp.construct(gp.load(str(scene)), plan=task.plan))
    board, page = Board(random.Random(seed)), handout(sheet)[0]
    task.draw(task, board, given_places(task, sheet))
    cv2.imwrite(str(path := folder / "scan.png"), scan(printed(page), pencil_strokes(board), seed).image)
    frames: Any = {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in sheet.views.items()}
    submission = read_submission(path, list(sheet.views), frames, lambda: page, code(sheet))
    return judge_any_method(sheet.plans.drawing, sheet, submission, Pencil(), plan=task.plan)


def test_a_right_drawing_is_right_in_a_scan(tmp_path: Path) -> None:
    """Steps that left no ink are never wrong: at most five of a hundred drawings are called so."""
    alarms = []
    for name in NAMES:
        for seed in SEEDS:
            try:
                alarms.append(judged(name, seed, tmp_path).first_wrong is not None)
            except LookupError:  # no task of this seed can be set
                continue
    assert sum(alarms) <= FALSE_ALARMS * len(alarms)
