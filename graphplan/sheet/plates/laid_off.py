"""Points that are laid off from another."""

from __future__ import annotations

from graphplan.kernel.program import Step


def root(step: Step) -> int | None:
    """The mark that a point is laid off from, if it is."""
    return step.root
