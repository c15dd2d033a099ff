"""What is needed to execute a step on paper beside its operation: operands, numbers, the factor between plans.

All of it is in mm of paper, with x to the right and y down as `paper` has it. A pure number stays what it is.

The steps of a sheet of panels as data, in the form of `graphplan steps --json`: to be executed on paper.

`paper` is in mm from the origin of the step's own plan, x to the right and y down: where a plan lies on its panel is
the panel's affair.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from graphplan.kernel.kinds import LINE, OPENING, POINT, Movement, Sizing
from graphplan.kernel.program import Panel, Step
from graphplan.phrases import arrange
from graphplan.sheet.panels import PanelSheet
from graphplan.sheet.words.lengths import carry_overs

Parameters = dict[str, Any]


def operands(step: Step) -> tuple[int, ...]:
    """The operands that a step is drawn by, by their places: of a point chosen on a line that line and what it is told
    from, not what its distance is in proportion to."""
    return step.args[:2] if step.op.movement is Movement.PICKED else step.args


@dataclass(frozen=True)
class OnPaper:
    """The steps of a program by their plans: `plan` of a step by its index, `per_mm` lengths on a plan."""

    values: Sequence[Any]
    plan: Callable[[int], Panel]
    per_mm: Callable[[Panel], float]

    def step_data(self, step: Step) -> dict[str, Any]:
        """The operands by their places among the steps, the parameters, and the factor from another plan."""
        return {"operands": list(operands(step)), "parameters": self.parameters(step), "factor": self.factor(step)}

    def per(self, index: int) -> float:
        """Lengths for a mm where a step is drawn."""
        return self.per_mm(self.plan(index))

    def factor(self, step: Step) -> float | None:
        """Factor from a length on another plan to the drawn one; None if all is on one plan."""
        if step.op.sizing is Sizing.QUOTIENT:
            return self.per(step.args[2]) ** 2 / self.per(step.args[0]) / self.per(step.index)
        return next((self.per(source) / self.per(target) for source, target in carry_overs(step)
                     if self.plan(source) != self.plan(target)), None)

    def parameters(self, step: Step) -> Parameters:
        """Parameters of the operation, without places that are free to choose."""
        params, per_mm = step.params, self.per(step.index)
        match step.op.movement, step.op.sizing:
            case (Movement.GIVEN | Movement.BEGUN), _:
                return {}
            case Movement.GUIDED, _:
                dx, dy = float(params["dx"]), float(params["dy"])
                return {"direction": [dx / math.hypot(dx, dy), -dy / math.hypot(dx, dy) + 0.0]}
            case Movement.LAID_BY_COMPONENTS, _:
                return {"vector": [float(params["dx"]) / per_mm, -float(params["dy"]) / per_mm + 0.0]}
            case Movement.INCLINED, _:
                return {"angle": math.degrees(math.atan2(float(params["angle"].y), float(params["angle"].x)))}
            case _ if "ux" in params:  # a vector by what it runs along a line, and to the left of it
                vector = complex(params["dx"], params["dy"]) / complex(params["ux"], params["uy"])
                size = abs(complex(params["ux"], params["uy"])) / per_mm
                return {"along": vector.real * size, "across": vector.imag * size}
            case _ if step.op.gives == OPENING and "dx" in params:  # of a link
                return {"length": math.hypot(float(params["dx"]), float(params["dy"])) / per_mm}
            case Movement.PICKED, _:
                return {"ahead": self._advance(step) / per_mm}
            case _, Sizing.COUPLE:
                return {"moment": float(params["moment"]) / per_mm / self.per(step.args[0])}
            case _, Sizing.INERTIA:
                link, motion = self.per(step.args[0]), self.per(step.args[2])
                return {"ratio": float(params["ratio"]) * motion / link**2 / per_mm}
        return {name: float(value) / per_mm if name in ("length", "radius") else _plain(value)
                for name, value in params.items()}

    def _advance(self, step: Step) -> float:
        """Distance along its line at which a point is chosen, from the foot of another."""
        (a, b, _), (x, y), (u, v) = (map(float, self.values[index][:3]) for index in (step.args[0], step.args[1],
                                                                                      step.index))
        return (b * (u - x) - a * (v - y)) / math.hypot(a, b)


def _plain(value: Any) -> Any:
    """A number, or the word for a choice."""
    return str(value) if isinstance(value, str) else float(value) if not isinstance(value, (list, tuple)) else value


def protocol(sheet: PanelSheet) -> dict[str, Any]:
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
            "reads": [say(program.text(arg)) for arg in operands(step)], "plan": step.panel,
            "sentence": say(sheet.sentence_with_lengths(step) if number else program.sentence_with_reason(step.index)),
            "lengths": [{"mm": measure.mm, "marks": list(measure.marks)} for length in _lengths(sheet, step) if number
                        for measure in length.measures],
            "stage": stages.get(step.index), "why": say(step.why), **on_paper.step_data(step),
            "value": list(map(float, sheet.values[step.index])),
            "paper": place(step, sheet.values[step.index], on_paper.per(step.index)),
        })  # fmt: skip
    titles = [{"title": say(stage.title), "law": say(stage.law)} for stage, _ in program.stages]
    return {"paper": sheet.page.paper, "stages": titles, "steps": entries}


def protocol_text(sheet: PanelSheet) -> str:
    """The construction in words, stage by stage."""
    program, say, lines = sheet.values.drawing.program, sheet.tongue, []
    for stage, steps in program.stages:
        lines += ["", say(stage.title), say(arrange("{0:capital}.", stage.law))]
        lines += [f"{program.number(step.index):4}. {say(sheet.sentence_with_lengths(step))}" for step in steps]
    return "\n".join([sheet.scene.title, *lines]) + "\n"


def _lengths(sheet: PanelSheet, step: Step) -> Sequence[Any]:
    return sheet.measure(step.panel).for_step(step)


def place(step: Step, value: Sequence[Any], per_mm: float) -> list[float]:
    """Place of a mark, in mm from the origin of its plan, y down."""
    numbers = [float(number) for number in value]
    if step.op.gives == POINT:
        return [numbers[0] / per_mm, -numbers[1] / per_mm + 0.0]
    if step.op.gives == LINE:
        a, b, c = numbers
        normal_length = math.hypot(a, b)
        return [-a / normal_length + 0.0, b / normal_length + 0.0, -c / normal_length / per_mm + 0.0]
    radius = math.sqrt(max(numbers[-1], 0.0)) / per_mm
    return [radius] if step.op.gives == OPENING else [numbers[0] / per_mm, -numbers[1] / per_mm + 0.0, radius]
