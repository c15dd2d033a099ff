"""The booklet of a class: a task a page with coded corners, its student's name on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from graphplan.accuracy.drafted import Drafted
from graphplan.marking.classroom.flaws import Draw
from graphplan.marking.classroom.key import Row, key_rows
from graphplan.marking.classroom.variants import Variant
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.sheet.handout import code, solution, task
from graphplan.sheet.plates.display import Sheet


@dataclass(frozen=True)
class Exercise:
    """A variant for its student (none of a spare sheet), in a file of this name."""

    variant: Variant
    student: str
    file: str


@dataclass(frozen=True)
class Printed:
    """What is printed of an exercise: its code, the pages of the task and of the solution, its results."""

    code: int
    task: tuple[Sheet, ...]
    solution: tuple[Sheet, ...]
    rows: tuple[Row, ...]


def printed(exercise: Exercise, draw: Draw, further: Callable[[Scene], Iterable[Row]]) -> Printed:
    """An exercise on paper; `further` are results of its scene that no drawing of one pose has. Fails as the drawing of
    its scene does."""
    scene = parse(exercise.variant.text, exercise.file)
    sheet = replace(scene.sheet, student=exercise.student, variant=str(exercise.variant.number))
    drafted: Drafted = draw(replace(scene, sheet=sheet))
    composition = drafted.composition
    return Printed(code(composition), tuple(task(composition)), tuple(solution(composition)),
                   (*key_rows(composition.plans.drawing), *further(scene)))
