"""How the plans share their part of a page: by cuts across it, so that every panel has the shape of its plan.

The panels are the leaves of a slicing tree, in drawing order from the left and from above; the title block may be the
last. Of each run of neighbours the shapes in which it just has room are kept that are smaller than others one way or
the other (L. Stockmeyer, Information and Control 57, 1983). Scales are round, so plans are drawn at the largest common
size that has room, and then one by one at the next round scale, the most crowded first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import NamedTuple

from graphplan.mechanism.model import Number
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.tolerances import EDGE_TOL

CAPTION, MARGIN = 11.0, 9.0  # mm: a panel's caption strip, and what is kept free for letters around its figure
EDGE, SIDE = 0.5, 2.5  # mm of a panel on each side of its room, and of its caption
MOST = 8  # shapes of a run that are kept
FINER = 1.25, 1.6, 2.0, 2.5, 4.0, 5.0, 10.0  # how much finer a scale may be than the next coarser one
SMALLER = 0.7  # by which the common size falls from try to try
TRIES = 24


@dataclass(frozen=True)
class Demand:
    """What a plan wants of its panel: room for a figure so wide and high, in lengths, with so many marks, at a scale
    that is round for quantities so many `lengths` long, if none is `given`; and in mm for its `caption`."""

    width: float
    height: float
    marks: int
    lengths: Sequence[Number]
    caption: float
    given: float | None = None

    @property
    def area(self) -> float:
        """What counts as the area of its figure: one that is slim counts as much as one half as wide as it is long."""
        return max(self.width * self.height, (self.width**2 + self.height**2) / 4)

    def scale(self, size: float) -> Fraction:
        """The scale, in lengths per mm, at which its figure has about so many mm^2 for a mark."""
        least = math.sqrt(self.area / (size * self.marks))
        return Fraction(self.given) if self.given else round_up(least, self.lengths)

    def crowding(self, scale: Fraction) -> float:
        """How many mm^2 its figure has for a mark; what needs no room has enough."""
        return self.area / float(scale) ** 2 / self.marks or math.inf

    def finer(self, scale: Fraction) -> Fraction | None:
        """The next larger scale; none where it is given."""
        found = (round_up(float(scale) / times, self.lengths) for times in FINER)
        return None if self.given or not self.area else next((finer for finer in found if finer < scale), None)

    def panel(self, scale: Fraction) -> tuple[float, float]:
        """How wide and high its panel is at least."""
        margins = 2 * (EDGE + MARGIN)
        wide, high = self.width / float(scale) + margins, self.height / float(scale) + margins - EDGE + CAPTION
        return max(wide, self.caption), high


class Shape(NamedTuple):
    """How wide and high a run of panels is at least, and its two parts, side by side or one under the other."""

    wide: float
    high: float
    parts: tuple[Shape, Shape] | None = None
    beside: bool = False
    name: str = ""


def divided(region: Rect, block: Rect | None, demands: Mapping[str, Demand],
            twins: Mapping[str, str]) -> dict[str, Rect] | None:
    """The panels of plans in a region, with the title block in its lower right corner where one is given; none where
    they have no room however small they are drawn. Twins have one scale."""
    corner = (Shape(min(block.width + EDGE_TOL, region.width), block.height + EDGE_TOL),) if block else ()
    groups: dict[str, list[str]] = {}
    for panel in demands:
        groups.setdefault(twins[panel], []).append(panel)
    size = region.area / sum(demand.marks for demand in demands.values())
    for _ in range(TRIES):
        scales = {group: max(demands[panel].scale(size) for panel in panels) for group, panels in groups.items()}
        if best := _best(region, demands, twins, scales, corner):
            break
        size *= SMALLER
    else:
        return None
    waiting = set(groups)
    while waiting:
        group = min(sorted(waiting), key=lambda group: min(demands[panel].crowding(scales[group])
                                                           for panel in groups[group]))
        finer = max((finer for panel in groups[group] if (finer := demands[panel].finer(scales[group]))), default=None)
        larger = finer and _best(region, demands, twins, {**scales, group: finer}, corner)
        if finer and larger:
            best, scales = larger, {**scales, group: finer}
        else:
            waiting.discard(group)
    return _places(best, region)


def _best(region: Rect, demands: Mapping[str, Demand], twins: Mapping[str, str], scales: Mapping[str, Fraction],
          corner: tuple[Shape, ...]) -> Shape | None:
    """The shape of all panels at some scales that leaves most of the region over; none where they have no room."""
    leaves = [*(Shape(*demand.panel(scales[twins[panel]]), name=panel) for panel, demand in demands.items()), *corner]
    if sum(leaf.wide * leaf.high for leaf in leaves) > region.area:
        return None
    runs = {(i, i + 1): [leaf] for i, leaf in enumerate(leaves)}
    for count in range(2, len(leaves) + 1):
        for start in range(len(leaves) - count + 1):
            end = start + count
            found = [shape for middle in range(start + 1, end)
                     for one, two in product(runs[start, middle], runs[middle, end]) for shape in _joined(one, two)
                     if shape.wide <= region.width and shape.high <= region.height]
            runs[start, end] = _least(found)
    whole = [shape for shape in runs[0, len(leaves)] if shape.wide <= region.width and shape.high <= region.height]
    return max(whole, key=lambda shape: min(region.width / shape.wide, region.height / shape.high), default=None)


def _joined(one: Shape, two: Shape) -> tuple[Shape, Shape]:
    """Two runs side by side, and one under the other."""
    return (Shape(one.wide + two.wide, max(one.high, two.high), (one, two), True),
            Shape(max(one.wide, two.wide), one.high + two.high, (one, two)))


def _least(shapes: Sequence[Shape]) -> list[Shape]:
    """The shapes than which none other is smaller both ways, or of very many some."""
    found: list[Shape] = []
    for shape in sorted(shapes, key=lambda shape: (shape.wide, shape.high)):
        if not found or shape.high < found[-1].high:
            found.append(shape)
    return [found[round(i * (len(found) - 1) / (MOST - 1))] for i in range(MOST)] if len(found) > MOST else found


def _places(shape: Shape, rect: Rect) -> dict[str, Rect]:
    """The panels of a run in its place: what is left over they share by their sizes, the title block takes none."""
    if shape.parts is None:
        return {shape.name: rect} if shape.name else {}
    one, two = shape.parts
    last = two.parts is None and not two.name
    if shape.beside:
        share = 1.0 if last else one.wide / (one.wide + two.wide)
        edge = rect.left + one.wide + share * (rect.width - one.wide - two.wide)
        return _places(one, Rect(rect.left, rect.bottom, edge, rect.top)) | _places(
            two, Rect(edge, rect.bottom, rect.right, rect.top))
    share = 1.0 if last else one.high / (one.high + two.high)
    edge = rect.top - one.high - share * (rect.height - one.high - two.high)
    return _places(one, Rect(rect.left, edge, rect.right, rect.top)) | _places(
        two, Rect(rect.left, rect.bottom, rect.right, edge))
