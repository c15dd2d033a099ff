"""How drawings by another hand are judged: right ones are right, a slip is found, and a plan that is all wrong.

Each drawing is judged as measured points and as the file of a drawing program, another one from drawing to drawing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest
from blackboard import Drawing, mistaken, right, wrong_as_a_whole
from formats import FORMATS, cause_named, results_alone
from makers import MAKERS
from mixed_forms import drawing_by_mixed_forms, mistaken_by_mixed_forms
from mixed_plans import BOTH

from graphplan.accuracy.drafted import Drafted
from graphplan.marking.classroom.results import MarkedDrawing
from graphplan.marking.judge.gathered_velocities import call_ends
from graphplan.marking.judge.score import Weights
from graphplan.mechanism.scene import load
from graphplan.methods.construct import construct
from graphplan.public.desk import Desk
from graphplan.public.drafting import Options
from graphplan.public.variants import draft_scene

SEEDS = range(3)
ALIKE = [name for name in MAKERS if name not in BOTH]  # velocities and accelerations on plans of one kind
PROGRAMS = [form for form in FORMATS if form != "csv"]
FALSE_ALARMS, COMPLETE, MISTAKEN = 0.02, 97.0, 95.0  # a share; the least and the most of 100
PLACES, CAUSES = {"csv": 0.95, "program": 0.9}, 0.85


@cache
def draft_task(text: str, options: Options, folder: Path) -> Drafted:
    """The task on its sheet, which all drawings of it are judged by."""
    (task := folder / "task.toml").write_text(text)
    return draft_scene(options, load(str(task)))


def judged(drawing: Drawing, form: str, folder: Path) -> MarkedDrawing:
    """What is said of a drawing in a form."""
    plan = drawing.task.plan if drawing.task.plan in ("polar", "polygons", "lever") else ""
    suffix, written = FORMATS[form]
    (student := folder / f"student{suffix}").write_bytes(written(drawing))
    options = Options(plan=plan)
    return Desk(draft_task(drawing.task.scene, options, folder.parent), Weights(), options).judge_file(student)


def verdicts(make: Callable[[str, int], Drawing], which: str, folder: Path,
             names: Iterable[str] = ALIKE, seeds: Iterable[int] = SEEDS) -> Iterator[tuple[Drawing, MarkedDrawing]]:
    """Drawings of every kind, as points or as the files of programs, with what is said of them."""
    for number, name in enumerate(names):
        for seed in seeds:
            try:
                drawing = make(name, seed)
            except LookupError:  # no task of this seed can be set
                continue
            form = "csv" if which == "csv" else PROGRAMS[(number + seed) % len(PROGRAMS)]
            yield drawing, judged(drawing, form, folder)


def words(marked: MarkedDrawing) -> str:
    """The marks that are named as the place of a mistake, and what is said of it."""
    first, text = marked.judgement.first_wrong, marked.judgement.drawing.drawn.text
    return "|".join(map(str, (text(first.at_fault), text(first.step), first.mistake))) if first else ""


@pytest.mark.parametrize("which", PLACES)
def test_a_right_drawing_is_right(which: str, tmp_path: Path) -> None:
    """At its own scales and places, with marks of its own: at most two of a hundred are called wrong, and one in which
    nothing is missing earns all."""
    found = [marked for _, marked in verdicts(right, which, tmp_path)]
    assert sum(bool(words(marked)) for marked in found) <= FALSE_ALARMS * len(found)
    assert all((marked.score.total or 0) >= COMPLETE for marked in found
               if not words(marked) and not marked.judgement.counts["missing"])


def test_a_right_drawing_of_mixed_forms_is_right(tmp_path: Path) -> None:
    """Of drawings with normal accelerations by the semicircle, by a right angle or computed, of which some have
    letters, at most two of a hundred are called wrong."""
    found = [marked for which in PLACES
             for _, marked in verdicts(drawing_by_mixed_forms, which, tmp_path, seeds=range(4))]
    assert found
    assert sum(bool(words(marked)) for marked in found) <= FALSE_ALARMS * len(found)


@pytest.mark.costly
def test_drawings_on_plans_of_two_kinds_are_judged(tmp_path: Path) -> None:
    """With velocities from their points and accelerations from a pole, at most two right ones of a hundred are called
    wrong, and a mistake is named as in other drawings."""
    right_ones = [marked for which in PLACES for _, marked in verdicts(right, which, tmp_path, BOTH)]
    assert sum(bool(words(marked)) for marked in right_ones) <= FALSE_ALARMS * len(right_ones)
    named = [bool(drawing.answers.search(words(marked)))
             for which in PLACES for drawing, marked in verdicts(mistaken, which, tmp_path, BOTH)]
    assert sum(named) >= PLACES["program"] * len(named)


@pytest.mark.costly
def test_a_mistake_among_mixed_forms_is_told(tmp_path: Path) -> None:
    """Its mark is named as in other drawings."""
    found = [bool(drawing.answers.search(words(marked)))
             for which in PLACES for drawing, marked in verdicts(mistaken_by_mixed_forms, which, tmp_path)]
    assert found
    assert sum(found) >= PLACES["program"] * len(found)


@pytest.mark.parametrize("which", PLACES)
def test_marks_of_results_alone_are_right(which: str, tmp_path: Path) -> None:
    """Of a drawing without the strokes and marks between at most two of a hundred are called wrong."""
    found = [marked for _, marked in verdicts(lambda *task: results_alone(right(*task)), which, tmp_path)]
    assert sum(bool(words(marked)) for marked in found) <= FALSE_ALARMS * len(found)


@pytest.mark.parametrize("which", PLACES)
def test_the_place_of_a_mistake_is_named(which: str, tmp_path: Path) -> None:
    """The mark at which it was made, or its vector, or the mark that shows it; and mostly what was done."""
    places, causes, count = 0, 0, 0
    for drawing, marked in verdicts(mistaken, which, tmp_path):
        named = bool(words(marked)) and bool(drawing.answers.search(words(marked)))
        places, count = places + named, count + 1
        causes += named and cause_named(drawing, marked.judgement.first_wrong and marked.judgement.first_wrong.mistake)
        assert not named or (marked.score.total or 0) < MISTAKEN
    assert places >= PLACES[which] * count
    assert causes >= CAUSES * count


@pytest.mark.costly
@pytest.mark.parametrize("which", PLACES)
def test_a_plan_that_is_wrong_as_a_whole_is_always_told(which: str, tmp_path: Path) -> None:
    """As a mistake, or where it is but at another scale as the reading."""
    for drawing, marked in verdicts(wrong_as_a_whole, which, tmp_path):
        reading = str(marked.judgement.reading)
        scaled = drawing.whole.endswith("scale") and ("times as large" in reading or "k_v" in reading)
        assert words(marked) or scaled, drawing.whole


def test_letters_of_two_marks_are_no_fault_of_the_file() -> None:
    """The end of a velocity is not called as another mark of the construction is."""
    drawing = construct(load("four-bar"), plan="polar")
    named = call_ends(drawing, {"A": "B", "B": "v_b"})
    assert {"a", "B", "v_b"} < {step.name for step in named.program.steps}
