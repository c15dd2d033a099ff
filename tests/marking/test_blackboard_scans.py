"""How scans of drawings by another hand are judged, which have no strokes but those of the textbook's vectors."""

from __future__ import annotations

import cmath
import random
from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

import pytest

cv2 = pytest.importorskip("cv2")

from blackboard import Board, Drawing, Fault, Places, Task, Unfit, mistaken, task_of  # noqa: E402
from makers import MAKERS  # noqa: E402
from raster import Picture, Stroke, photo, printed, scan  # noqa: E402

import graphplan as gp  # noqa: E402
from graphplan.accuracy.hand import Pencil  # noqa: E402
from graphplan.marking.judge.findings import wrong_mark  # noqa: E402
from graphplan.marking.judge.judge import judge_any_method  # noqa: E402
from graphplan.marking.judge.score import score  # noqa: E402
from graphplan.marking.judge.verdict import Judgement  # noqa: E402
from graphplan.marking.submission import read_submission  # noqa: E402
from graphplan.marking.traces import PlanFrame  # noqa: E402
from graphplan.mechanism.scene import parse  # noqa: E402
from graphplan.sheet.handout import code  # noqa: E402
from graphplan.sheet.handout import task as handout  # noqa: E402
from graphplan.sheet.layout.composition import Composition, compose  # noqa: E402

DRAWN = [name for name, (_, plan) in MAKERS.items() if plan in ("polar", "orthogonal")]
SEEDS = range(1, 3)
FALSE_ALARMS, MISTAKEN, PLACES, BEYOND_MM = 0.05, 95.0, 0.75, 3.0
Pictured = Callable[..., Picture]


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


def begin_at_print(board: Board, sheet: Composition) -> None:
    """Move the plan of accelerations to where it is printed to begin: a student goes on from that mark, not from a."""
    drawing, plan_of_step = sheet.plans.drawing, sheet.plans.plan_of_step
    for step in drawing.drawn.steps:
        at = board.marks.get(("second", step.name))
        if step.op.name == "begin" and plan_of_step[step.index] == "N-plan" and at is not None:
            view = sheet.views["N-plan"]
            off = complex(*view.origin) + view.scale * complex(*map(float, drawing.values[step.index][:2])) - at
            moved = {z: z + off for (plan, _), z in board.marks.items() if plan == "second"}
            board.marks |= {key: moved[z] for key, z in board.marks.items() if key[0] == "second"}
            board.strokes = [(moved.get(one, one), moved.get(other, other)) for one, other in board.strokes]


def pencil_strokes(board: Board) -> list[Stroke]:
    """What a pencil leaves of a drawing: strokes beyond their ends, and dots."""
    lines = [(one, other + BEYOND_MM * (other - one) / abs(other - one)) for one, other in board.strokes
             if other != one]
    dots = [[z + cmath.rect(0.25, 1.5 * k) for k in range(5)] for z in board.marks.values()]
    return [*(([(z.real, z.imag) for z in line], 0.3, 0.7) for line in lines),
            *(([(z.real, z.imag) for z in dot], 0.5, 0.9) for dot in dots)]


@cache
def set_task(name: str, seed: int) -> tuple[Task, Composition]:
    """A task on its sheet."""
    task = task_of(name, seed)
    scene = parse(task.scene, "task.toml")
    return task, compose(gp.construct(scene, plan=task.plan if task.plan == "polar" else ""))


def judged(name: str, seed: int, folder: Path, fault: Fault | None = None, pictured: Pictured = scan
           ) -> tuple[Drawing, Judgement]:
    """A drawing on the task's paper, right or with a mistake, before a scanner or a phone, and what is said of it."""
    task, sheet = set_task(name, seed)
    board, page = Board(random.Random(seed), fault), handout(sheet)[0]
    task.draw(task, board, given_places(task, sheet))
    begin_at_print(board, sheet)
    if not all(0 < z.real < page.width and 0 < z.imag < page.height for z in board.marks.values()):
        raise Unfit("off the paper")
    cv2.imwrite(str(path := folder / "scan.png"), pictured(printed(page), pencil_strokes(board), seed).image)
    frames: Any = {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in sheet.views.items()}
    submission = read_submission(path, list(sheet.views), frames, lambda: page, code(sheet))
    judgement = judge_any_method(sheet.plans.drawing, sheet, submission, Pencil(), plan=task.plan)
    return Drawing(task, board, fault), judgement


def pictures(faulty: bool, folder: Path, pictured: Pictured = scan, seeds: range = SEEDS
             ) -> Iterator[tuple[Drawing, Judgement]]:
    """Drawings of each kind; where they are faulty, with mistakes that are no matter of letters, which nobody reads."""
    for name in DRAWN:
        for seed in seeds:
            try:
                fault = mistaken(name, seed).fault if faulty else None
                if fault is None or fault.kind != "letters":
                    yield judged(name, seed, folder, fault, pictured)
            except (LookupError, Unfit):  # no task of this seed can be set, or drawn at the sheet's scales
                continue


COARSE = partial(scan, dpi=120.0)


DONE = {
    ("slider-crank, polar", 905): "perpendicular to OA instead of AB",
    ("six-bar, orthogonal", 901): "parallel to OC instead of EF",
    ("slider-crank, polar", 900): "the normal acceleration of B about A omitted",
    ("four-bar, orthogonal", 902): "laid off from A_1 instead of a",
    ("inverted slider-crank", 942): "laid off from a' instead of pi",
    ("inverted slider-crank", 827): "laid off from pi instead of a'",
    ("inverted slider-crank", 940): "the Coriolis acceleration of A3 relative to A halved",
    ("inverted slider-crank", 825): "the normal acceleration of K about C halved",
    ("slider-crank, orthogonal", 821): "the normal acceleration of A about B doubled"}
NAMED = {("slider-crank, polar", 940): "b", ("slider-crank, orthogonal", 820): "v_b", ("six-bar", 941): "n_EF"}


@pytest.mark.parametrize(("pictured", "seeds"), [
    (COARSE, SEEDS), pytest.param(photo, range(1, 5), marks=pytest.mark.costly)], ids=["scan", "photo"])
def test_a_right_drawing_is_right_in_a_picture(pictured: Pictured, seeds: range, tmp_path: Path) -> None:
    """Steps that left no ink are hardly ever wrong: at most five of a hundred drawings are called so."""
    alarms = [judgement.first_wrong is not None for _, judgement in pictures(False, tmp_path, pictured, seeds)]
    assert sum(alarms) <= FALSE_ALARMS * len(alarms)


@pytest.mark.costly
def test_what_was_done_is_told_of_scans(tmp_path: Path) -> None:
    """Of most: along which link a wrong locus was drawn, which vector was left out, from where one was laid off, though
    its start is drawn later in the task's order, or it leaves its panel, and how long one is, though the task has it by
    figures, or another mark lies where it should end."""
    told = {(name, seed): str(found.first_wrong and found.first_wrong.mistake) for name, seed in DONE
            if (found := judged(name, seed, tmp_path, mistaken(name, seed).fault)[1])}
    assert sum(told[task] == done for task, done in DONE.items()) >= PLACES * len(DONE), told


@pytest.mark.costly
def test_marks_of_wrong_results_are_named(tmp_path: Path) -> None:
    """Of most, where a wrong locus led to them, though it is not seen as it fell on the pole, or its dot is also where
    strokes of the task's figures cross, or beside its panel."""
    named = {}
    for name, seed in NAMED:
        _, found = judged(name, seed, tmp_path, mistaken(name, seed).fault)
        named[name, seed] = str(wrong_mark(found, found.first_wrong)).partition(" ")[0] if found.first_wrong else ""
    assert sum(named[task] == mark for task, mark in NAMED.items()) >= PLACES * len(NAMED), named


def test_a_mistake_in_a_scan_is_told(tmp_path: Path) -> None:
    """It costs points, and of three in four the place is named; else marks are to be looked at, or missing."""
    named, count = 0, 0
    for drawing, judgement in pictures(True, tmp_path):
        first, text = judgement.first_wrong, judgement.drawing.drawn.text
        words = "|".join(map(str, (text(first.at_fault), text(first.step), first.mistake,
                                   wrong_mark(judgement, first)))) if first else ""
        named, count = named + bool(first and drawing.answers.search(words)), count + 1
        assert first or judgement.counts["missing"] + judgement.counts["unsure"]
        assert (score(judgement).total or 0) < MISTAKEN
    assert named >= PLACES * count
