"""The plan is a part of a mark's kind: points, lines and circles are joined on one plan alone.

From another plan an operation takes vectors, openings and directions, of which it does not matter where they lie. What
would join two plans cannot be recorded: on paper they stand apart, each at its own scale.
"""

from __future__ import annotations

from collections.abc import Sequence

from graphplan.kernel.kinds import Primitive


class PlansApart(TypeError):
    """An operation was given points, lines or circles of several plans."""


def require_one_plan(op: Primitive, panels: Sequence[str], names: Sequence[str]) -> None:
    """Refuse operands, by their plans and how they are called, that an operation does not take together: what it draws
    with lies on one plan, and so do both ends of each vector that it takes from another."""
    if any(panels[place] != panels[group[0]] for group in (op.same_plan_operands, *op.afar) for place in group):
        marks = ", ".join(f"{name} on {panel or 'no plan'}" for name, panel in zip(names, panels, strict=True))
        raise PlansApart(f"{op.name} was given marks of several plans ({marks}); it takes points, lines and circles of "
                         "one plan, from another a vector, an opening or a direction")
