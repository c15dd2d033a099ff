"""Numbers for a program: one walk over the steps, whatever the number domain."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel.kinds import FAILURES, Movement
from graphplan.kernel.numbers import Domain
from graphplan.kernel.program import Program, Step


def evaluate(
    program: Program,
    domain: Domain,
    given: Mapping[Any, Mapping[str, Any]] | None = None,
    after: Callable[[Step], None] | None = None,
) -> list[Any]:
    """The value of every step, in order.

    Reads a program, a number domain and, by name or index of a step, other parameters than were recorded (where a
    point is given, how a guide runs); calls `after` after each step.
    Fails with :class:`ConstructionError` naming the step, where the domain raises; arrays give nan instead.
    """
    values: list[Any] = []
    given = given or {}
    for step in program.steps:
        other = given.get(step.name) or given.get(step.index)
        params = {**step.params, **other} if other else step.params
        try:
            values.append(domain.whole(step.op.rule(domain, *[values[arg] for arg in step.args], **params)))
        except Undrawable as fault:
            raise error_at(program, step, fault) from None
        if after is not None:
            after(step)
    return values


def error_at(program: Program, step: Step, fault: Undrawable) -> ConstructionError:
    """The rule's fault with its step attached, in the letters of the sheet."""
    names = [program.described(arg) for arg in step.args]
    drawing = f"{program.text(step.index)} = {step.op.name}({', '.join(names)})"
    if step.op.movement is Movement.MET:
        drawing = f"{program.text(step.index)}, where {names[0]} should meet {names[1]}"
    what_to_do = FAILURES[fault.code][1]
    return ConstructionError(fault.code, program.number(step.index), drawing, fault.why, what_to_do, step.links)
