"""A task as it lies on its sheet: the steps of the true construction, and where the handout has their plans."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

from graphplan.accuracy.drafted import Drafted
from graphplan.commands import parser, steps
from graphplan.commands.choices import on_paper
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Step
from graphplan.sheet.layout.composition import Composition

Value = tuple[float, ...]
FLOATS = Floats()


@dataclass(frozen=True)
class Task:
    """A scene with the options of its sheet."""

    scene: str
    options: tuple[str, ...]
    on_sheet: Drafted
    told: dict[str, Any]

    @property
    def composition(self) -> Composition:
        return self.on_sheet.composition

    @property
    def steps(self) -> tuple[Step, ...]:
        """The drawn steps, those of the pose first."""
        return self.composition.plans.drawing.drawn.steps

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the paper, mm."""
        return self.composition.arrangement.width, self.composition.arrangement.height

    @cached_property
    def truth(self) -> list[Value]:
        """The value of every step, in units of its plan."""
        return [tuple(map(float, value)) for value in self.composition.plans.drawing.values]

    @cached_property
    def places(self) -> list[str]:
        """The plan of every step."""
        return [one["plan"] for one in self.told["steps"]]

    def number(self, index: int) -> int:
        """The printed number of a step; 0 of what is given."""
        return int(self.told["steps"][index]["number"])

    def text(self, index: int) -> str:
        """How a mark is spoken of."""
        return str(self.told["steps"][index]["makes"])

    def letter(self, index: int) -> str:
        """The letter of a mark, empty where it has none."""
        return self.steps[index].name

    def scale(self, index: int) -> float:
        """Millimetres of paper for a unit of the plan."""
        return float(self.composition.views[self.places[index]].scale)

    def stage(self, index: int) -> str:
        """The title of the stage that a step belongs to."""
        at = self.told["steps"][index]["stage"]
        return "" if at is None else str(self.told["stages"][at]["title"])

    def plan(self, index: int) -> str:
        return self.places[index]

    @cached_property
    def asked(self) -> list[int]:
        """The marks at which the vectors that are asked for end, by index."""
        return sorted({end for one in self.told["readings"] for length in one["lengths"] for end in length["marks"]})

    def paper(self, index: int, value: Value) -> Value:
        """Where a value lies on the handout, in mm, y upward: a point; a point and a direction; a centre and a
        radius."""
        view = self.composition.views[self.places[index]]
        kind = self.steps[index].op.gives
        if kind == POINT:
            return tuple(map(float, view((value[0], value[1]))))
        if kind == LINE:
            a, b, c = value
            n = math.hypot(a, b)
            foot = view((-a * c / n**2, -b * c / n**2))
            return float(foot[0]), float(foot[1]), b / n, -a / n
        if kind == CIRCLE:
            x, y = view((value[0], value[1]))
            return float(x), float(y), math.sqrt(value[2]) * view.scale
        return (math.sqrt(value[0]) * view.scale,)

    def dependents(self, index: int) -> Iterator[int]:
        """Steps that read this one."""
        return (step.index for step in self.steps if index in step.args)

    def holds(self, curve: int) -> list[int]:
        """Points of the same plan that a line or an arc is drawn through or that are marked on it."""
        step = self.steps[curve]
        on = [arg for arg in step.args if self.steps[arg].op.gives == POINT and step.op.gives == LINE
              and step.op.name in {"line", "parallel", "perpendicular", "guide"}]
        on += [at for at in self.dependents(curve) if self.steps[at].op.gives == POINT
               and self.steps[at].op.name in {"meet", "foot", "line_meets_circle", "circles_meet", "lay_along", "pick"}]
        return [at for at in on if self.places[at] == self.places[curve]]


@lru_cache(maxsize=64)
def task(scene: str, options: tuple[str, ...] = ()) -> Task:
    """The task that these options of the command line draw."""
    on_sheet = on_paper(parser(("steps",)).parse_args(["steps", scene, *options]))
    return Task(scene, options, on_sheet, json.loads(json.dumps(steps.data(on_sheet))))
