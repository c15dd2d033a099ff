"""Programs drawn with their plans apart: each is begun wherever there is room, and moves as a whole.

A step that joined marks of two plans would move with neither.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from graphplan.kernel import CIRCLE, LINE, OPENING, Program
from graphplan.kernel.kinds import Movement
from graphplan.kernel.numbers import Domain
from graphplan.kernel.program import Step, evaluate


def strays(program: Program, domain: Domain, size: Any, near: float = 0.0) -> list[str]:
    """The steps whose marks do not move with their plans where these are scattered by about a size; `near` is what a
    mark may be off for its rounding, beside its coordinates and that size."""
    before, after = evaluate(program, domain), list[Any]()
    begun = {step.panel: shift(step.index, size) for step in program.steps if step.op.movement is Movement.BEGUN}
    for step in program.steps:
        if step.op.movement is Movement.BEGUN:
            after.append(tuple(map(domain.lift, begun[step.panel])))
        else:
            after.append(domain.mask_refused(step.op.rule(domain, *[after[arg] for arg in step.args], **step.params)))
    return [f"{program.sentence(step.index)} ({step.panel})" for step in program.steps
            if any(off > near for off in gaps(step, before[step.index], after[step.index],
                                              begun.get(step.panel, (0, 0)), size))]


def shift(index: int, size: Any) -> tuple[Any, Any]:
    """Where a plan is begun, another place for each."""
    return size * Fraction(4 + index, 7), -size * Fraction(7 + 2 * index, 11)


def gaps(step: Step, before: Any, after: Any, along: tuple[Any, Any], size: Any) -> Iterator[Any]:
    """By how much a mark is elsewhere than it was, moved along with its plan, beside its coordinates and a size."""
    dx, dy = along
    if step.op.gives == LINE:
        (a, b, c), (u, v, w) = before, after
        c = c - a * dx - b * dy
        whole = (abs(a) + abs(b)) * (abs(u) + abs(v))
        yield from (abs(a * v - b * u) / whole, abs(c * u - a * w) / whole / size, abs(c * v - b * w) / whole / size)
        return
    moved = before if step.op.gives == OPENING else (before[0] + dx, before[1] + dy, *before[2:])
    far = size * size if step.op.gives in (OPENING, CIRCLE) else size
    yield from (abs(one - two) / (far + abs(one)) for one, two in zip(moved, after, strict=True))
