"""What is needed to execute a step on paper beside its operation: operands, numbers, the factor between plans.

All of it is in mm of paper, with x to the right and y down as `paper` has it. A pure number stays what it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from graphplan.kernel.kinds import OPENING, Movement, Sizing
from graphplan.kernel.program import Panel, Step

Parameters = dict[str, Any]
TAKEN = {Sizing.MOMENTS: 3, Sizing.SHIFT: 5}  # the operand from whose plan a size is taken that is worked out
LIKE = {Sizing.SHIFT: 1}  # and the one on whose plan it is used up, where that is not the step's own


@dataclass(frozen=True)
class OnPaper:
    """The steps of a program by their plans: `plan` of a step by its index, `per_mm` lengths on a plan."""

    values: Sequence[Any]
    plan: Callable[[int], Panel]
    per_mm: Callable[[Panel], float]

    def step_data(self, step: Step) -> dict[str, Any]:
        """The operands by their places among the steps, the parameters, and the factor from another plan."""
        return {"operands": list(step.args), "parameters": self.parameters(step), "factor": self.factor(step)}

    def per(self, index: int) -> float:
        """Lengths for a mm where a step is drawn."""
        return self.per_mm(self.plan(index))

    def factor(self, step: Step) -> float | None:
        """How many mm are drawn for one that is taken on another plan; nothing where all is taken on its own."""
        op, index = step.op, step.index
        sized = op.movement in (Movement.LAID_OFF, Movement.TURNED, Movement.STRUCK)
        source = step.args[TAKEN[op.sizing]] if op.sizing in TAKEN else step.args[op.afar[0][0]] if sized else index
        index = step.args[LIKE[op.sizing]] if op.sizing in LIKE else index
        return None if self.plan(source) == self.plan(index) else self.per(source) / self.per(index)

    def parameters(self, step: Step) -> Parameters:
        """What the operation is given, but the place of what stands where it is put."""
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
                return {"ahead": self._distance_along(step) / per_mm}
            case _, Sizing.COUPLE:
                return {"moment": float(params["moment"]) / per_mm / self.per(step.args[0])}
            case _, Sizing.INERTIA:
                link, motion = self.per(step.args[0]), self.per(step.args[2])
                return {"ratio": float(params["ratio"]) * motion / link**2 / per_mm}
        return {name: float(value) / per_mm if name in ("length", "radius") else _plain(value)
                for name, value in params.items()}

    def _distance_along(self, step: Step) -> float:
        """How far along its line a point is chosen, from the foot of another."""
        (a, b, _), (x, y), (u, v) = (map(float, self.values[index][:3]) for index in (step.args[0], step.args[1],
                                                                                      step.index))
        return (b * (u - x) - a * (v - y)) / math.hypot(a, b)


def _plain(value: Any) -> Any:
    """A number, or the word for a choice."""
    return str(value) if isinstance(value, str) else float(value) if not isinstance(value, (list, tuple)) else value
