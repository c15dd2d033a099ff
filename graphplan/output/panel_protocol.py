"""The steps of a sheet of panels as data, in the form of `graphplan steps --json`: to be executed on paper.

`paper` is in mm from the origin of the step's own plan, x to the right and y down: where a plan lies on its panel is
the panel's affair.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from graphplan.kernel.kinds import LINE, OPENING, POINT
from graphplan.kernel.program import Step
from graphplan.output.executable import OnPaper
from graphplan.output.panelled import Panelled
from graphplan.phrases import arrange


def protocol(sheet: Panelled) -> dict[str, Any]:
    """The paper of a sheet and the steps of its construction, those that are given first."""
    program, say = sheet.values.drawing.program, sheet.tongue
    on_paper = OnPaper(sheet.values.numbers, lambda index: program.steps[index].panel, sheet.scales.lengths_per_mm)
    stages = {step.index: number for number, (_, steps) in enumerate(program.stages) for step in steps}
    entries = []
    for step in program.steps:
        number = max(0, program.number(step.index))
        entries.append({
            "number": number, "makes": say(program.text(step.index)), "kind": step.op.gives,
            "operation": step.op.name, "instrument": step.op.instrument,
            "reads": [say(program.text(arg)) for arg in step.args], "plan": step.panel,
            "sentence": say(sheet.sentence_with_lengths(step) if number else program.sentence_with_reason(step.index)),
            "lengths": [{"mm": measure.mm, "marks": list(measure.marks)} for length in _lengths(sheet, step) if number
                        for measure in length.measures],
            "stage": stages.get(step.index), "why": say(step.why), **on_paper.step_data(step),
            "value": list(map(float, sheet.values[step.index])),
            "paper": place(step, sheet.values[step.index], on_paper.per(step.index)),
        })  # fmt: skip
    titles = [{"title": say(stage.title), "law": say(stage.law)} for stage, _ in program.stages]
    return {"paper": sheet.paper, "stages": titles, "steps": entries}


def protocol_text(sheet: Panelled) -> str:
    """The construction in words, stage by stage."""
    program, say, lines = sheet.values.drawing.program, sheet.tongue, []
    for stage, steps in program.stages:
        lines += ["", say(stage.title), say(arrange("{0:capital}.", stage.law))]
        lines += [f"{program.number(step.index):4}. {say(sheet.sentence_with_lengths(step))}" for step in steps]
    return "\n".join([sheet.scene.title, *lines]) + "\n"


def _lengths(sheet: Panelled, step: Step) -> Sequence[Any]:
    return sheet.measure(step.panel).for_step(step)


def place(step: Step, value: Sequence[Any], per_mm: float) -> list[float]:
    """Where a mark lies, in mm from the origin of its plan, y down."""
    numbers = [float(number) for number in value]
    if step.op.gives == POINT:
        return [numbers[0] / per_mm, -numbers[1] / per_mm + 0.0]
    if step.op.gives == LINE:
        a, b, c = numbers
        normal_length = math.hypot(a, b)
        return [-a / normal_length + 0.0, b / normal_length + 0.0, -c / normal_length / per_mm + 0.0]
    radius = math.sqrt(max(numbers[-1], 0.0)) / per_mm
    return [radius] if step.op.gives == OPENING else [numbers[0] / per_mm, -numbers[1] / per_mm + 0.0, radius]
