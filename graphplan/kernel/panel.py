"""Panels: the plans that steps are drawn on, by their public names.

The plan is a part of a mark's kind: points, lines and circles are joined on one plan alone. From another plan an
operation takes vectors, openings and directions, of which it does not matter where they lie. What would join two plans
cannot be recorded: on paper they stand apart, each at its own scale.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import NamedTuple, Self

from graphplan.kernel.kinds import Primitive
from graphplan.kernel.tolerances import MAX_DRAWN, MIN_DRAWN
from graphplan.phrases import Said, arrange, said


class Panel(str):
    """A plan that steps are drawn on: its public name, which knows how it is spoken of and what stands over it.

    `whole` is the plan that it is a part of: itself but where a plan is begun at several places. What it is made of is
    kept beside the name; nobody reads it out of the name.
    """

    words: Said
    heading: Said
    whole: Panel

    def __new__(cls, name: str = "", words: Said | None = None, heading: Said | None = None) -> Self:
        self = super().__new__(cls, name)
        self.words = words or arrange("{0}", name)
        self.heading, self.whole = heading or arrange("{0:capital}", self.words), self
        return self

    @property
    def twin(self) -> Panel:
        """The plan at whose scale it is drawn, too, if there are such."""
        return self

    def caption(self, kinds: Collection[str]) -> Said:
        """What stands over it; `kinds` are the kinds of vector drawn on it."""
        return self.heading

    def numbered_part(self, number: int) -> Panel:
        """The part of it that is begun as this one."""
        if number == 1:
            return self
        part = Panel(f"{self}, part {number}", said("{0}, part {1}", self.words, number))
        part.whole = self
        return part


class PlansApart(TypeError):
    """An operation was given points, lines or circles of several plans."""


def require_one_plan(op: Primitive, panels: Sequence[str], names: Sequence[str]) -> None:
    """Refuse operands, by their plans and how they are called, that an operation does not take together: what it draws
    with lies on one plan, and so do both ends of each vector that it takes from another."""
    if any(panels[place] != panels[group[0]] for group in (op.same_plan_operands, *op.afar) for place in group):
        marks = ", ".join(f"{name} on {panel or 'no plan'}" for name, panel in zip(names, panels, strict=True))
        raise PlansApart(f"{op.name} was given marks of several plans ({marks}); it takes points, lines and circles of "
                         "one plan, from another a vector, an opening or a direction")


class Window(NamedTuple):
    """What counts as on the sheet of a panel: a circle, in plan units, and how wide the marks are apart there."""

    centre: tuple[float, float]
    radius: float
    width: float = math.inf

    def holds(self, point: tuple[float, float]) -> bool:
        return math.dist(point, self.centre) <= self.radius

    def shows(self, length: float) -> bool:
        """Whether a length is neither longer than the plan is wide nor too short for a pencil."""
        return math.isinf(self.width) or MIN_DRAWN <= length / self.width <= MAX_DRAWN


EVERYWHERE = Window((0.0, 0.0), math.inf)
