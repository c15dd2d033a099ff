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
from graphplan.marking.classroom.booklet import KEY_TITLE, Exercise, KeyRow, PrintedExercise, six_digits
from graphplan.marking.classroom.variants import DrawnSize, Flaw, Quality, SeriesDesign, Values, Wording, drawn_sizes
from graphplan.methods.executors import SharedOut
from graphplan.phrases import arrange, unit
from graphplan.sheet.plates.display import Sheet
from graphplan.synthesis.exports import asked_lengths
from graphplan.synthesis.handout import SynthesisHandout
from graphplan.synthesis.sheet import lengths_text
from graphplan.synthesis.sketch import Synthesis
from graphplan.synthesis.task import SynthesisTask, parse
from graphplan.words.tongue import tongue

DrawTask = Callable[[SynthesisTask], SynthesisHandout]  # a task on its sheets, as the options say


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


def assess_task(text: str, name: str, draw: DrawTask, own: Quality) -> Flaw | None:
    """Reason why a task is unsuitable for a class whose own task has a sheet of this quality; None if it is
    suitable."""
    try:
        return quality_of_handout(draw(parse(text, name))).find_flaw(own)
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
    lengths = asked_lengths(handout.synthesis)
    answers = handout.on_paper.page.tongue(lengths_text(lengths, unit(task.units.length), 5)) if lengths else ""
    return exercise.put_on_paper(handout.on_paper.code, handout.pages_of("task"), handout.pages_of("solution"),
                                 key_rows(handout.synthesis), answers)


def key_rows(synthesis: Synthesis) -> Iterator[KeyRow]:
    """The lengths and points of the mechanism."""
    lengths, unit = asked_lengths(synthesis), synthesis.task.units.length
    largest = max(map(abs, lengths.values()), default=0.0)
    for name, size in lengths.items():
        yield KeyRow("length", name, "", "", six_digits(size, largest), unit)
    if synthesis.linkages:
        for name, at in synthesis.linkage.points.items():
            yield KeyRow("point", name, six_digits(at.real, largest), six_digits(at.imag, largest), "", unit)


def key_pages(handout: SynthesisHandout, lines: Sequence[str]) -> list[Sheet]:
    """The first pages of the key: the line of each variant, counted from 1."""
    sheet = replace(handout.on_paper, document=KEY_TITLE).sheet
    return sheet.pages_of_words([row for number, line in enumerate(lines, 1)
                                 for row in sheet.rows_of(arrange("{0}", line), str(number))])
