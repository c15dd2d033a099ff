"""Frames of diagrams: where one lies in mm of paper, and what a mm of its axes stands for."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np


class AxisScale(NamedTuple):
    """What one mm of an axis stands for, and the value in its origin."""

    unit: float
    datum: float = 0.0

    def mm(self, value: Any) -> Any:
        """Where values stand, in mm from the origin."""
        return (np.asarray(value, dtype=float) - self.datum) / self.unit

    def value(self, mm: Any) -> Any:
        """What stands at so many mm."""
        return self.datum + np.asarray(mm, dtype=float) * self.unit


class Frame(NamedTuple):
    """One diagram: its origin, the scales of what lies level and of what stands upright, and how far both go from the
    origin, to the left and right and down and up, in mm."""

    origin: tuple[float, float]
    x: AxisScale
    y: AxisScale
    level: tuple[float, float]
    upright: tuple[float, float]

    def position(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Where values of both axes stand, in mm of the drawing."""
        return self.origin[0] + self.x.mm(x), self.origin[1] + self.y.mm(y)
