"""How much of a plan is on its sheet."""

from __future__ import annotations

import math
from typing import NamedTuple


class Window(NamedTuple):
    """What counts as on the sheet of a panel: a circle, in plan units."""

    centre: tuple[float, float]
    radius: float

    def holds(self, point: tuple[float, float]) -> bool:
        return math.dist(point, self.centre) <= self.radius


EVERYWHERE = Window((0.0, 0.0), math.inf)
