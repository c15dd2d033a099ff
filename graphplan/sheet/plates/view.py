"""From plan units to millimetres: each plan's own window onto its panel."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from graphplan.sheet.layout.scales import multiple_below, round_up
from graphplan.sheet.plates.display import Rect, Spot
from graphplan.sheet.plates.plans import Figure, grown

COARSER, MUCH_COARSER = 2.05, 4.1  # how much smaller the mechanism, and any other plan, may be for auxiliary marks


@dataclass(frozen=True)
class View:
    """One plan on its panel: `scale` in mm per unit, and where the plan's origin falls."""

    rect: Rect
    scale: float
    origin: Spot

    def __call__(self, spot: Spot) -> Spot:
        return self.origin[0] + self.scale * spot[0], self.origin[1] + self.scale * spot[1]


def least(box: Rect, room: Rect) -> float:
    """Units per mm that make a box just fit."""
    return max(box.width / room.width, box.height / room.height)


def _box(figure: Figure, room: Rect, most: float, nice: bool = False) -> Rect:
    """The core's box, made larger mark by mark as long as it does not need more than `most` units per mm."""
    box = figure.core
    for spot in (*figure.extra, *(figure.nice if nice else ())):
        larger = grown(box, spot)
        if least(larger, room) <= most:
            box = larger
    return box


def whole(figure: Figure, room: Rect) -> float:
    """The mm per unit at which all the marks of a plan just fit."""
    box = figure.core
    for spot in figure.extra:
        box = grown(box, spot)
    return 1 / (least(box, room) or 1e-9)


def plan_scale(figure: Figure, room: Rect) -> tuple[float, Rect]:
    """The round k_s of the mechanism plan in this room, and the box that is then on paper."""
    core = round_up(least(figure.core, room))
    box = _box(figure, room, core * COARSER if figure.core.width or figure.core.height else math.inf)
    k_s = round_up(least(box, room))
    return k_s, plan_box(figure, room, k_s)


def plan_multiple(figure: Figure, room: Rect, k_s: float) -> Fraction:
    """The round multiple of the mechanism plan's scale for another plan."""
    fits = least(figure.core, room)
    core = multiple_below(k_s / fits) if fits else Fraction(1)
    box = _box(figure, room, float(k_s / core) * MUCH_COARSER)
    wide = least(box, room)
    return multiple_below(k_s / wide) if wide else Fraction(1)


def plan_box(figure: Figure, room: Rect, units_per_mm: float) -> Rect:
    """What of a plan is on paper at a scale."""
    return _box(figure, room, units_per_mm, nice=True)


def view(box: Rect, room: Rect, units_per_mm: float) -> View:
    """A window with the box in the middle of its room."""
    (x, y), (cx, cy) = room.centre, box.centre
    scale = 1 / units_per_mm
    return View(room, scale, (x - cx * scale, y - cy * scale))
