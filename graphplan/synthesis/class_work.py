"""A class's variants of a task of synthesis: which make good tasks, and what is printed of each.

A variant is good where its mechanism exists, without a defect that the task's own has not, where its lines cross as
well, and where what is asked for and drawn is long enough on its paper.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphplan.errors import GraphplanError
from graphplan.kernel.drawn import crossing
from graphplan.kernel.kinds import Movement
from graphplan.marking.classroom import measures
from graphplan.marking.classroom.booklet import (
    KEY_TITLE,
    Exercise,
    KeyLine,
    KeyRow,
    PrintedExercise,
    key_rows_of_lines,
    six_digits,
)
from graphplan.marking.classroom.variants import (
    DrawnSize,
    FitVariant,
    Flaw,
    Quality,
    SeriesDesign,
    Values,
    Wording,
    drawn_sizes,
)
from graphplan.methods.executors import SharedOut
from graphplan.phrases import digits, unit
from graphplan.sheet.layout.measures import COLUMN_MM
from graphplan.sheet.plates.display import Sheet
from graphplan.synthesis.exports import asked_lengths
from graphplan.synthesis.handout import SynthesisHandout
from graphplan.synthesis.sheet import length_letters
from graphplan.synthesis.sketch import Synthesis
from graphplan.synthesis.task import SynthesisTask, parse
from graphplan.words.tongue import tongue

DrawTask = Callable[[SynthesisTask], SynthesisHandout]  # a task on its sheets, as the options say
KEY_DIGITS = 5  # count: of a length in the key


def quality_of_handout(handout: SynthesisHandout) -> Quality:
    """The quality of the sheet of the solution: the sizes of what is asked for and drawn, crossings, and defects."""
    synthesis, values, on_paper = handout.synthesis, handout.synthesis.values, handout.on_paper
    sizes = dict(drawn_sizes(on_paper.composition)) | {
        name: DrawnSize(size / on_paper.scales.k_s, measures.MIN_ASKED_MM)
        for name, size in asked_lengths(synthesis).items()}
    sines = [crossing(step, values.numbers) for step in values.drawing.program.steps
             if step.op.movement is Movement.MET]
    defects = synthesis.linkage.defects if synthesis.linkages else (*synthesis.results.get("defects", ()),)
    return Quality(sizes, (), 0.0, True, math.degrees(math.asin(min(sines, default=1.0))), defects=defects)


def assess_task(text: str, name: str, draw: DrawTask, own: Quality) -> Flaw | FitVariant:
    """Reason why a task is unsuitable for a class whose own task has a sheet of this quality, or that it fits."""
    try:
        return quality_of_handout(draw(parse(text, name))).find_flaw(own) or FitVariant()
    except GraphplanError as error:
        return Flaw("nothing is found", f"{error}".removeprefix(f"{name}: ").partition(";")[0])


@dataclass(frozen=True)
class TaskDesign(SeriesDesign):
    """The task of a class on its own sheets, and how variants of it are drawn."""

    handout: SynthesisHandout
    draw: DrawTask
    shared_out: SharedOut
    find_flaw = staticmethod(assess_task)

    @property
    def source(self) -> SynthesisTask:
        return self.handout.synthesis.task

    @cached_property
    def own_quality(self) -> Quality:
        return quality_of_handout(self.handout)

    def common_wording(self, pilots: Sequence[Values], number: int) -> tuple[Wording, Sequence[Any]]:
        """All are on the task's own paper."""
        task, keys = self.source, {"paper": self.handout.on_paper.paper, "language": self.source.sheet.language}
        say, keys = tongue(task.sheet.language), {key: json.dumps(value) for key, value in keys.items()}
        return Wording(task.text, say.title(task.title), keys, say), ()


# ---- what is printed ------------------------------------------------------------------------------------------------


def print_task(exercise: Exercise, draw: DrawTask) -> PrintedExercise:
    """An exercise on paper."""
    task = parse(exercise.variant.text, exercise.file)
    sheet = replace(task.sheet, student=exercise.student, group=exercise.group, variant=str(exercise.variant.number))
    handout = draw(replace(task, sheet=sheet))
    say = handout.on_paper.page.tongue
    answers = {f"{length_letters(name)}, {say(unit(task.units.length))}": say(digits(size, KEY_DIGITS))
               for name, size in asked_lengths(handout.synthesis).items()}
    return exercise.put_on_paper(handout.on_paper.code, handout.pages_of("task"), handout.pages_of("solution"),
                                 key_rows(handout.synthesis), answers, say)


def key_rows(synthesis: Synthesis) -> Iterator[KeyRow]:
    """The lengths and points of the mechanism."""
    lengths, unit = asked_lengths(synthesis), synthesis.task.units.length
    largest = max(map(abs, lengths.values()), default=0.0)
    for name, size in lengths.items():
        yield KeyRow("length", name, "", "", six_digits(size, largest), unit)
    if synthesis.linkages:
        for name, at in synthesis.linkage.points.items():
            yield KeyRow("point", name, six_digits(at.real, largest), six_digits(at.imag, largest), "", unit)


def key_pages(handout: SynthesisHandout, lines: Sequence[KeyLine]) -> list[Sheet]:
    """The first pages of the key: the line of each variant."""
    sheet = replace(handout.on_paper, document=KEY_TITLE).sheet
    return sheet.pages_of_words(key_rows_of_lines(lines, COLUMN_MM, sheet.tongue))
