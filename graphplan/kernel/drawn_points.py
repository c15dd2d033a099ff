"""The points that are drawn, by plan and by the lines that they lie on: looked up, not sought among all steps."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import repeat
from typing import Any

from graphplan.kernel.kinds import POINT
from graphplan.kernel.panel import EVERYWHERE, Window
from graphplan.kernel.program import Step


@dataclass
class DrawnPoints:
    """The points among some steps by their places, in drawing order; steps and values may grow and be taken back."""

    steps: Sequence[Step]
    values: Sequence[Any]
    windows: Mapping[str, Window]
    _known: int = field(default=0, init=False)  # how many of the steps are looked at
    _groups: dict[tuple[str, bool] | int, list[int]] = field(default_factory=dict, init=False)  # by plan, by line
    _entries: list[tuple[int, list[int]]] = field(default_factory=list, init=False)

    def on_plan(self, plan: str, on_sheet: bool) -> Sequence[int]:
        """The points of a plan that lie on its sheet, or off it."""
        self._look_on()
        return self._groups.get((plan, on_sheet), ())

    def on_curve(self, curve: int) -> Sequence[int]:
        """The points that were marked on a line or a circle, by its place."""
        self._look_on()
        return self._groups.get(curve, ())

    def furthest(self, here: tuple[float, float], places: Sequence[int]) -> int:
        """That of some points which lies furthest from a place; of equals the first."""
        ways = [*map(math.dist, repeat(here), map(self.values.__getitem__, places))]
        return places[ways.index(max(ways))]

    def rewind(self, length: int) -> None:
        """Forget all steps after the first `length`."""
        if length < self._known:
            self._known = length
            while self._entries and self._entries[-1][0] >= length:
                self._entries.pop()[1].pop()

    def _look_on(self) -> None:
        """Look at the steps that are new."""
        for step in self.steps[self._known:]:
            if step.op.gives == POINT:
                on_sheet = self.windows.get(step.panel, EVERYWHERE).holds(self.values[step.index])
                for key in ((step.panel, on_sheet), *{step.args[place] for place in step.op.claim_operands("on")}):
                    group = self._groups.setdefault(key, [])
                    group.append(step.index)
                    self._entries.append((step.index, group))
        self._known = len(self.steps)
