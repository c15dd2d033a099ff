"""From plan units to millimetres: each plan's own window onto its panel."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from graphplan.mechanism.model import Number
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.plates.display import Rect, Spot
from graphplan.sheet.plates.plans import Extent, grown
from graphplan.sheet.tolerances import ZERO_SCALE

COARSER, MUCH_COARSER = 2.05, 4.1  # how much smaller the mechanism, and any other plan, may be for auxiliary marks


@dataclass(frozen=True)
class View:
    """One plan on its panel: `scale` in mm per unit, and where the plan's origin falls."""

    rect: Rect
    scale: float
    origin: Spot

    def __call__(self, spot: Spot) -> Spot:
        return self.origin[0] + self.scale * spot[0], self.origin[1] + self.scale * spot[1]

    def back(self, spot: Spot) -> Spot:
        """The place on the plan of a spot on paper."""
        return (spot[0] - self.origin[0]) / self.scale, (spot[1] - self.origin[1]) / self.scale


def least(box: Rect, room: Rect) -> float:
    """Units per mm that make a box just fit."""
    return max(box.width / room.width, box.height / room.height)


def _box(extent: Extent, room: Rect, most: float, nice: bool = False) -> Rect:
    """The core's box, made larger mark by mark as long as it does not need more than `most` units per mm."""
    box = extent.core
    for spot in (*extent.extra, *(extent.nice if nice else ())):
        larger = grown(box, spot)
        if least(larger, room) <= most:
            box = larger
    return box


def wanted(extent: Extent, coarser: float) -> Rect:
    """The box of what a plan shows if its shape is not told: auxiliary marks that make it not too much larger."""
    most = coarser * max(extent.core.width, extent.core.height) or math.inf
    return _box(extent, Rect(0.0, 0.0, 1.0, 1.0), most)


def whole(extent: Extent, room: Rect) -> float:
    """The mm per unit at which all the marks of a plan just fit."""
    return 1 / (least(_box(extent, room, math.inf), room) or ZERO_SCALE)


def plan_scale(extent: Extent, room: Rect, coarser: float, lengths: Sequence[Number] = (1,)) -> Fraction:
    """The lengths per mm of a plan in this room, `coarser` for its auxiliary marks at most; round are the scales of the
    quantities that are so many `lengths` long."""
    core = round_up(least(extent.core, room), lengths)
    box = _box(extent, room, float(core) * coarser if extent.core.width or extent.core.height else math.inf)
    return round_up(least(box, room), lengths)


def plan_box(extent: Extent, room: Rect, units_per_mm: float) -> Rect:
    """What of a plan is on paper at a scale."""
    return _box(extent, room, units_per_mm, nice=True)


def view(box: Rect, room: Rect, units_per_mm: float) -> View:
    """A window with the box in the middle of its room."""
    (x, y), (cx, cy) = room.centre, box.centre
    scale = 1 / units_per_mm
    return View(room, scale, (x - cx * scale, y - cy * scale))
