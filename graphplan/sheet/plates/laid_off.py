"""Points that are laid off from another, and what the stroke between the two stands for."""

from __future__ import annotations

from collections.abc import Sequence

from graphplan.kernel.program import Step

# Which mark a point is laid off from, by the operation that makes it.
ROOTS = {
    "foot": 1, "transfer": 2, "step_off": 2, "step_across": 2, "quarter": 2, "lay_along": 1, "lay_off": 0,
    "balance": 5, "couple": 2, "inertia_pair": 4, "touch": 0, "resultant": 0,
}  # fmt: skip
MEASURED = ("balance", "couple", "inertia_pair")  # by its size, not carried over from another plan
GIVEN = ("lay_off", "lay_along", "step_off", "step_across")


def root(step: Step) -> int | None:
    """The mark that a point is laid off from, if it is."""
    return step.args[ROOTS[step.op.name]] if step.op.name in ROOTS else None


def given(steps: Sequence[Step], step: Step) -> bool:
    """Whether a point is the end of a given vector: laid off by its components, and lettered."""
    start = root(step)
    begins = start is not None and steps[start].op.name in ("given", "begin")
    return begins and step.op.name in GIVEN and bool(step.name)
