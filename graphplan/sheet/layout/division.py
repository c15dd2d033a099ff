"""Divisions of a sheet: how plans and blocks share it, packed row by row.

Of each run of neighbours the shapes in which it just has room are kept that are smaller than others one way or the
other (L. Stockmeyer, Information and Control 57, 1983). A division is tried at many scales and in many orders, in which
most runs are the same, so each is packed once.

The panels stand in drawing order from the left and from above; the title block may be the last. Scales are round, so
plans are drawn at the largest common size that has room (packing.py), then one by one at the next round scale, the most
crowded first, and at last one finer at the cost of others, where fewer marks lie near each other then. Where neighbours
have no room in drawing order they change places.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from itertools import combinations_with_replacement
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from graphplan.mechanism.model import Number
from graphplan.sheet.layout.measures import (
    CAPTION_MM,
    COARSER_STEP,
    FINER_STEPS,
    MARGIN_MM,
    MAX_COARSER,
    MAX_EXCHANGES,
    MAX_FILL,
    MAX_REORDERED,
    MAX_SHAPES,
    MAX_TRIES,
    MIN_RELIEF,
    PANEL_EDGE_MM,
    SIZE_STEP,
)
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.tolerances import EDGE_TOL

Size = tuple[float, float]  # how wide and high


class Shape(NamedTuple):
    """Least width and height of a run of panels, and its two parts, side by side or one under the other."""

    wide: float
    high: float
    parts: tuple[Shape, Shape] | None = None
    beside: bool = False
    name: str = ""


Join = tuple[float, float, int, int, int, bool]  # how wide and high; where parted, which shapes of its parts, how


class Packing:
    """The smallest shapes of runs of parts in a region, for all its divisions; parts are numbered, each by its name and
    its scale or its room."""

    def __init__(self, region: Rect):
        self.region = region
        self.areas: list[float] = []  # of each part, at least
        self._names: list[str] = []
        self._numbers: dict[Hashable, int] = {}
        self._runs: dict[tuple[int, ...], list[Join]] = {}

    def number(self, part: tuple[str, Hashable], sizes: Callable[[], Sequence[Size]]) -> int:
        """The number of a part by its name and scale or room, which may have any of some sizes."""
        if part not in self._numbers:
            number, leaf = len(self.areas), sizes()
            self._numbers[part] = number
            self._names.append(part[0])
            self.areas.append(min(wide * high for wide, high in leaf))
            self._runs[number,] = _undercut([(wide, high, 0, 0, 0, False) for wide, high in sorted(leaf)])
        return self._numbers[part]

    def best(self, run: tuple[int, ...]) -> Shape | None:
        """The shape of parts in this order that leaves most of the region free; None if they do not fit."""
        wide, high = self.region.width, self.region.height
        whole = [shape for shape in self._joins(run) if shape[0] <= wide and shape[1] <= high]
        best = max(whole, key=lambda shape: min(wide / shape[0], high / shape[1]), default=None)
        return best and self._shape(run, best)

    def _shape(self, run: tuple[int, ...], join: Join) -> Shape:
        """A shape of a run with its parts."""
        wide, high, middle, i, j, under = join
        if not middle:
            return Shape(wide, high, name=self._names[run[0]])
        pairs = (run[:middle], i), (run[middle:], j)
        first, second = (self._shape(half, self._runs[half][k]) for half, k in pairs)
        return Shape(wide, high, (first, second), not under)

    def _joins(self, run: tuple[int, ...]) -> list[Join]:
        """The smallest shapes of a run that are no larger than the region, the narrowest first; at most `MAX_SHAPES` of
        them, and of equals the first."""
        if (packed := self._runs.get(run)) is not None:
            return packed
        joined = list[Join]()
        for middle in range(1, len(run)):
            if (ones := self._joins(run[:middle])) and (twos := self._joins(run[middle:])):
                _join_beside(joined, ones, twos, middle, self.region.width)
                _join_under(joined, ones, twos, middle, self.region.height)
        joined.sort()
        minimal = _undercut(joined)
        last = len(minimal) - 1
        if last >= MAX_SHAPES:
            minimal = [minimal[round(i * last / (MAX_SHAPES - 1))] for i in range(MAX_SHAPES)]
        self._runs[run] = minimal
        return minimal


def _join_beside(joined: list[Join], ones: Sequence[Join], twos: Sequence[Join], middle: int, widest: float) -> None:
    """Add the smallest shapes of two runs side by side: from the narrowest on, as long as they have room, and the
    higher of both can be lower."""
    i, j = 0, 0
    while i < len(ones) and j < len(twos):
        left, right = ones[i], twos[j]
        wide, spare = left[0] + right[0], left[1] - right[1]
        if wide > widest:
            return
        joined.append((wide, left[1] if spare > 0 else right[1], middle, i, j, False))
        i, j = i + (spare >= 0), j + (spare <= 0)


def _join_under(joined: list[Join], ones: Sequence[Join], twos: Sequence[Join], middle: int, highest: float) -> None:
    """Add the smallest shapes of two runs one under the other: from the lowest on, as long as they have room, and the
    wider of both can be narrower."""
    i, j = len(ones) - 1, len(twos) - 1
    while i >= 0 and j >= 0:
        upper, lower = ones[i], twos[j]
        high, spare = upper[1] + lower[1], upper[0] - lower[0]
        if high > highest:
            return
        joined.append((upper[0] if spare > 0 else lower[0], high, middle, i, j, True))
        i, j = i - (spare >= 0), j - (spare <= 0)


def _undercut(shapes: Sequence[Join]) -> list[Join]:
    """Of shapes in order, the narrowest first, those that no other undercuts in both width and height."""
    minimal, lowest = list[Join](), math.inf
    for shape in shapes:
        if shape[1] < lowest:
            minimal.append(shape)
            lowest = shape[1]
    return minimal


def places(shape: Shape, rect: Rect) -> dict[str, Rect]:
    """Place the panels of a run in a rectangle; they share spare room by their sizes, except for the title block."""
    if shape.parts is None:
        return {shape.name: rect} if shape.name else {}
    first, two = shape.parts
    last = two.parts is None and not two.name
    if shape.beside:
        share = 1.0 if last else first.wide / (first.wide + two.wide)
        edge = rect.left + first.wide + share * (rect.width - first.wide - two.wide)
        return places(first, Rect(rect.left, rect.bottom, edge, rect.top)) | places(
            two, Rect(edge, rect.bottom, rect.right, rect.top))
    share = 1.0 if last else first.high / (first.high + two.high)
    edge = rect.top - first.high - share * (rect.height - first.high - two.high)
    return places(first, Rect(rect.left, edge, rect.right, rect.top)) | places(
        two, Rect(rect.left, rect.bottom, rect.right, edge))


FACTS, CORNER = "facts", ""  # what the parts of a region are called that are no plans


Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Demand:
    """Room that a plan needs: width and height of its figure, in lengths, its number of marks, a scale that is round
    for quantities of so many `lengths`, unless it is `given`; and the width of its `caption` in mm."""

    width: float
    height: float
    marks: int
    lengths: Sequence[Number]
    caption: float
    given: float | None = None

    @property
    def area(self) -> float:
        """The area of its figure; a slim figure counts as one half as wide as it is long."""
        return max(self.width * self.height, (self.width**2 + self.height**2) / 4)

    def scale(self, size: float) -> Fraction:
        """The scale, in lengths per mm, at which its figure has about so many mm^2 for a mark."""
        least = math.sqrt(self.area / (size * self.marks))
        return Fraction(self.given) if self.given else round_up(least, self.lengths)

    def crowding(self, scale: Fraction) -> float:
        """The mm^2 of its figure per mark; infinite for a figure without area."""
        return self.area / float(scale) ** 2 / self.marks or math.inf

    def finer(self, scale: Fraction) -> Fraction | None:
        """The next larger scale; None if it is given."""
        scales = (round_up(float(scale) / times, self.lengths) for times in FINER_STEPS)
        return None if self.given or not self.area else next((finer for finer in scales if finer < scale), None)

    def coarser(self, scale: Fraction) -> Fraction | None:
        """The next smaller scale; None if it is given."""
        return None if self.given or not self.area else round_up(float(scale) * COARSER_STEP, self.lengths)

    def panel(self, scale: Fraction) -> tuple[float, float]:
        """Least width and height of the panel."""
        wide, high = (side / float(scale) + 2 * (PANEL_EDGE_MM + MARGIN_MM) for side in (self.width, self.height))
        return max(wide, self.caption), high - PANEL_EDGE_MM + CAPTION_MM


def divide_among_plans(packing: Packing, block: Rect | None, demands: Mapping[str, Demand],
                       twins: Mapping[str, str], facts: Sequence[Size] = ()) -> dict[str, Rect] | None:
    """The panels of plans in the region of a packing, with the title block in its lower right corner where one is
    given, and with a part of its own for `facts` that need so much room, wide and high, in one of some ways; none where
    they have no room however small they are drawn. Twins have one scale."""
    region, rooms = packing.region, {FACTS: tuple(facts)}
    if block:
        rooms[CORNER] = ((min(block.width + EDGE_TOL, region.width), block.height + EDGE_TOL),)
    order = (*demands, *([FACTS] if facts else ()))
    groups: dict[str, list[str]] = {}
    for panel in demands:
        groups.setdefault(twins[panel], []).append(panel)
    size = region.area / sum(demand.marks for demand in demands.values())
    for _ in range(MAX_TRIES):
        scales = {group: max(demands[panel].scale(size) for panel in panels) for group, panels in groups.items()}
        division = _Division(packing, demands, twins, groups, rooms, scales, order)
        if (fitting := division.fitting()) and (shape := fitting.refine().exchange_scales().shape):
            return places(shape, region)
        size *= SIZE_STEP
    return None


@dataclass(frozen=True)
class _Division:
    """A division of a region among plans in groups of one scale, in some order, beside what has a corner."""

    packing: Packing
    demands: Mapping[str, Demand]
    twins: Mapping[str, str]
    groups: Mapping[str, Sequence[str]]
    rooms: Mapping[str, tuple[Size, ...]]  # that facts may have, and that the corner has
    scales: Mapping[str, Fraction]  # of each group
    order: tuple[str, ...]

    @cached_property
    def parts(self) -> tuple[int, ...]:
        """The parts of the region in order, by their numbers."""
        names = (*self.order, *([CORNER] if CORNER in self.rooms else ()))
        return tuple([self._number(name) for name in names])

    def _number(self, name: str) -> int:
        """The number of a part: a panel at its scale is so wide and high in one way."""
        if name in self.rooms:
            return self.packing.number((name, self.rooms[name]), lambda: self.rooms[name])
        scale = self.scales[self.twins[name]]
        return self.packing.number((name, scale), lambda: [self.demands[name].panel(scale)])

    @property
    def fill(self) -> float:
        """The area of all its parts, of the region's."""
        return sum(self.packing.areas[part] for part in self.parts) / self.packing.region.area

    @cached_property
    def shape(self) -> Shape | None:
        """The shape of all panels that leaves most of the region free; None if they do not fit."""
        return self.packing.best(self.parts) if self.fill <= 1.0 else None

    @property
    def crowding(self) -> dict[str, float]:
        """The mm^2 per mark of the most crowded plan of each group."""
        return {group: min(self.demands[panel].crowding(self.scales[group]) for panel in panels)
                for group, panels in self.groups.items()}

    @cached_property
    def crampedness(self) -> float:
        """Number of marks whose letters are too close to another mark, relative to all marks."""
        return sum(demand.marks / demand.crowding(self.scales[self.twins[panel]])
                   for panel, demand in self.demands.items())

    def finer(self, group: str) -> Fraction | None:
        """The next larger scale of a group; None if it is given."""
        finer = (self.demands[panel].finer(self.scales[group]) for panel in self.groups[group])
        return max(filter(None, finer), default=None)

    def coarser(self, group: str, scale: Fraction) -> Fraction | None:
        """The next smaller scale of a group; None if it is given."""
        coarser = (self.demands[panel].coarser(scale) for panel in self.groups[group])
        return max(filter(None, coarser), default=None)

    def at(self, group: str, scale: Fraction) -> _Division:
        """The division with another scale of a group."""
        return replace(self, scales={**self.scales, group: scale})

    def fitting(self) -> _Division | None:
        """The division if it fits, in this order or in another that is near to it; None if it does not fit."""
        orders = dict.fromkeys((self.order, *self._other_orders())) if self.fill <= 1.0 else ()
        return next((division for division in (replace(self, order=order) for order in orders) if division.shape), None)

    def _other_orders(self) -> Iterator[tuple[str, ...]]:
        """The orders with the facts elsewhere, and with two neighbours exchanged; the first plan stays first."""
        order, places = self.order, range(1, len(self.order))
        if FACTS in order:
            plans = tuple(part for part in order if part != FACTS)
            yield from ((*plans[:k], FACTS, *plans[k:]) for k in places)
        if len(order) <= MAX_REORDERED:
            yield from ((*order[:k], order[k + 1], order[k], *order[k + 2:]) for k in places[:-1])

    def refine(self) -> _Division:
        """The division with finer scales one by one, the most crowded plan first, as long as there is room."""
        division, waiting = self, set(self.groups)
        while waiting:
            group = min(sorted(waiting), key=division.crowding.__getitem__)
            finer = division.finer(group)
            if finer and (larger := division.at(group, finer).fitting()):
                division = larger
            else:
                waiting.discard(group)
        return division

    def exchange_scales(self) -> _Division:
        """The division with finer scales at the cost of less crowded plans, as long as marks are less cramped then."""
        division = self
        while better := next(division._exchanges(), None):
            division = better.refine()
        return division

    def _exchanges(self) -> Iterator[_Division]:
        """The divisions with one scale finer and others coarser for it, the least cramped first."""
        ladders = {group: self._ladder(group) for group in self.groups}
        steps, area = _steps_down(len(ladders) - 1), self.fill * self.packing.region.area
        most, largest = self.crampedness * (1 - MIN_RELIEF), MAX_FILL * self.packing.region.area
        exchanges = list[tuple[float, dict[str, Fraction]]]()
        for group, finer in ((group, self.finer(group)) for group in self.groups):
            if finer:
                coarser = {name: ladder for name, ladder in ladders.items() if name != group}
                changes = _changes(self._rung(group, finer), ladders[group][0], [*coarser.values()], steps)
                cramped = self.crampedness + changes[:, 0]
                good = np.flatnonzero((cramped < most) & (area + changes[:, 1] <= largest))
                for way in good[cramped[good].argsort(kind="stable")][:MAX_EXCHANGES].tolist():
                    scales = {name: ladder[step].scale for (name, ladder), step in zip(
                        coarser.items(), steps[way].tolist(), strict=True)}
                    exchanges.append((float(cramped[way]), {**scales, group: finer}))
        for _, scales in sorted(exchanges, key=itemgetter(0))[:MAX_EXCHANGES]:
            if division := replace(self, scales=scales).fitting():
                yield division

    def _ladder(self, group: str) -> list[_Rung]:
        """A group at its scale, and at the next coarser ones."""
        scales = [self.scales[group]]
        while len(scales) <= MAX_COARSER and (coarser := self.coarser(group, scales[-1])):
            scales.append(coarser)
        return [self._rung(group, scale) for scale in scales]

    def _rung(self, group: str, scale: Fraction) -> _Rung:
        """A group at a scale."""
        demands = [self.demands[panel] for panel in self.groups[group]]
        cramped = sum(demand.marks / demand.crowding(scale) for demand in demands)
        return _Rung(scale, cramped, sum(math.prod(demand.panel(scale)) for demand in demands))


class _Rung(NamedTuple):
    """A group of plans at a scale: how cramped its marks are, and the area of its panels."""

    scale: Fraction
    cramped: float
    area: float


@lru_cache
def _steps_down(count: int) -> Array:
    """All ways to go down a few rungs together on so many ladders, a row each."""
    rows = [np.bincount(names, minlength=count) for steps in range(1, MAX_COARSER + 1)
            for names in combinations_with_replacement(range(count), steps)]
    return np.array(rows, dtype=int).reshape(len(rows), count)


def _changes(finer: _Rung, was: _Rung, ladders: Sequence[Sequence[_Rung]], steps: Array) -> Array:
    """By how much marks are more cramped and panels larger with one group finer and others down their ladders, a row
    for each way; infinite where a ladder has not so many rungs."""
    total = np.tile(np.subtract(finer[1:], was[1:]), (len(steps), 1))
    for ladder, step in zip(ladders, steps.T, strict=True):
        changes = np.full((MAX_COARSER + 1, 2), np.inf)
        changes[:len(ladder)] = np.subtract([rung[1:] for rung in ladder], ladder[0][1:])
        total += changes[step]
    return total
