"""A class's variants of a task of synthesis: which make good tasks, and what is printed of each.

A variant is good where its mechanism exists, without a defect that the task's own has not, where its lines cross as
well, and where what is asked for and drawn is long enough on its paper.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

from graphplan.errors import GraphplanError
from graphplan.kernel.coincidence import crossing
from graphplan.kernel.kinds import Movement
from graphplan.marking.classroom import quality
from graphplan.marking.classroom.booklet import KEY_TITLE, Exercise, KeyRow, PrintedExercise, six_digits
from graphplan.marking.classroom.quality import DrawnSize, Flaw
from graphplan.marking.classroom.variants import SeriesDesign, Values, Wording
from graphplan.methods.executors import SharedOut
from graphplan.output.subjects.synthesis_handout import SynthesisHandout
from graphplan.phrases import Said, arrange, digits, join
from graphplan.sheet.plates.display import Sheet
from graphplan.synthesis.exports import asked_lengths
from graphplan.synthesis.sketch import Synthesis
from graphplan.synthesis.task import SynthesisTask, parse
from graphplan.words.tongue import tongue

SPANNED = "runs", "halfway", "span"  # claims of what is drawn by two points
DrawTask = Callable[[SynthesisTask], SynthesisHandout]  # a task on its sheets, as the options say


@dataclass(frozen=True)
class TaskQuality:
    """What is measured of a task's sheet: the sizes of what is asked for and of what is drawn by two points, by name;
    the flattest crossing in degrees; the defects of the mechanism."""

    sizes: Mapping[str, DrawnSize]
    flattest: float
    defects: tuple[str, ...]

    @classmethod
    def of_handout(cls, handout: SynthesisHandout) -> TaskQuality:
        """The quality of the sheet of the solution, which is composed for it."""
        synthesis, values, k_s = handout.synthesis, handout.synthesis.values, handout.sheet.k_s
        program = values.drawing.program
        sizes = {name: DrawnSize(abs(size) / k_s, quality.MIN_ASKED_MM)
                 for name, size in asked_lengths(synthesis).items()}
        for step in program.steps:
            for kind, *ends in step.op.claims:
                if kind in SPANNED and len(ends) == 2:
                    start, end = (step.args[operand] for operand in ends)
                    sizes.setdefault(f"{program.text(start)} {program.text(end)}", DrawnSize(
                        math.dist(values[start][:2], values[end][:2]) / k_s, quality.MIN_DRAWN_MM))
        sines = [crossing(step, values.numbers) for step in program.steps if step.op.movement is Movement.MET]
        defects = [defect for linkage in synthesis.linkages[synthesis.chosen:synthesis.chosen + 1]
                   for defect in linkage.defects]
        return cls(sizes, math.degrees(math.asin(min(sines, default=1.0))),
                   (*defects, *synthesis.results.get("defects", ())))

    @property
    def short(self) -> dict[str, DrawnSize]:
        """What is smaller than it should be, by name."""
        return {name: size for name, size in self.sizes.items() if size.mm < size.least}

    def find_flaw(self, own: TaskQuality) -> Flaw | None:
        """What makes it worse than a class's sheet may be; `own` is the quality of the task's own sheet."""
        if defects := [defect for defect in self.defects if defect not in own.defects]:
            return Flaw("its mechanism has a defect", f"it has a defect: {', '.join(defects)}")
        if self.flattest < min(quality.MIN_CROSSING_DEGREES, own.flattest / quality.MAX_WORSE_RATIO):
            return Flaw("it is nearly singular", f"lines cross at {self.flattest:.0f}°")
        for name, size in self.short.items():
            if name not in own.short or size.mm < own.short[name].mm / quality.MAX_WORSE_RATIO:
                return Flaw("lengths are too short", f"{name} has {size.mm:.2f} mm, less than {size.least:g}")
        return None


def assess_task(text: str, name: str, draw: DrawTask, own: TaskQuality) -> Flaw | None:
    """Why a task is none for the class whose own task has a sheet of this quality."""
    try:
        return TaskQuality.of_handout(draw(parse(text, name))).find_flaw(own)
    except GraphplanError as error:
        return Flaw("nothing is found", f"{error}".removeprefix(f"{name}: ").partition(";")[0])


@dataclass(frozen=True)
class TaskDesign(SeriesDesign):
    """The task of a class on its own sheets, and how variants of it are drawn."""

    handout: SynthesisHandout
    draw: DrawTask
    shared_out: SharedOut

    @property
    def source(self) -> SynthesisTask:
        return self.handout.synthesis.task

    @cached_property
    def own_quality(self) -> TaskQuality:
        return TaskQuality.of_handout(self.handout)

    @property
    def short(self) -> Mapping[str, DrawnSize]:
        return self.own_quality.short

    def common_wording(self, pilots: Sequence[Values]) -> Wording:
        """All are on the task's own paper."""
        task, keys = self.source, {"paper": self.handout.sheet.paper, "language": self.source.sheet.language}
        say = tongue(task.sheet.language)
        return Wording(task.text, say.title(task.title), {key: json.dumps(value) for key, value in keys.items()}, say)

    def assess(self, texts: Iterable[str]) -> Iterable[Flaw | None]:
        return self.shared_out(partial(assess_task, name=self.source.name, draw=self.draw, own=self.own_quality), texts)


# ---- what is printed ------------------------------------------------------------------------------------------------


def print_task(exercise: Exercise, draw: DrawTask, folder: str) -> PrintedExercise:
    """An exercise on paper; the scene that it may name lies in the `folder` of the class's task."""
    task = parse(exercise.variant.text, folder + exercise.file)
    sheet = replace(task.sheet, student=exercise.student, group=exercise.group, variant=str(exercise.variant.number))
    handout = draw(replace(task, sheet=sheet))
    who = f"{exercise.student} ({exercise.group})" if exercise.group else exercise.student
    answers = handout.sheet.tongue(join(_answers(handout.synthesis)))
    rows = [(exercise.variant.number, exercise.student, *row) for row in key_rows(handout.synthesis)]
    return PrintedExercise(handout.sheet.code, tuple(handout.part("task")), tuple(handout.part("solution")), rows,
                           ": ".join(filter(None, (who, exercise.variant.numbers_text, answers))))


def _answers(synthesis: Synthesis) -> Iterator[Said]:
    """What is asked for, each as it stands in the key."""
    for name, size in asked_lengths(synthesis).items():
        yield arrange("{0} = {1}", name.replace(" ", ""), digits(size, 5))


def key_rows(synthesis: Synthesis) -> Iterator[KeyRow]:
    """The lengths and points of the mechanism, and the least transmission angle."""
    lengths, unit = asked_lengths(synthesis), synthesis.task.units.length
    largest = max(map(abs, lengths.values()), default=0.0)
    for name, size in lengths.items():
        yield KeyRow("length", name, "", "", six_digits(size, largest), unit)
    if synthesis.linkages:
        for name, at in synthesis.linkage.points.items():
            yield KeyRow("point", name, six_digits(at.real, largest), six_digits(at.imag, largest), "", unit)
        yield KeyRow("transmission angle", "", "", "", six_digits(synthesis.linkage.transmission[0], 1.0), "deg")


def key_pages(handout: SynthesisHandout, lines: Sequence[str]) -> list[Sheet]:
    """The first pages of the key: the line of each variant, counted from 1."""
    sheet = replace(handout.sheet, document=KEY_TITLE)
    return sheet.pages_of_words([row for number, line in enumerate(lines, 1)
                                 for row in sheet.words_rows(arrange("{0}", line), str(number))])
