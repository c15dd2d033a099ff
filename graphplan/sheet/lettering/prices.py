"""Prices of places for letters: what a letter covers or crosses there, and where it can stand.

Letters should not cover lines, by their length, surfaces, by their area, and other marks. Lengths and areas are summed
in arrays, as shapely cuts a line off at a box in ten times the time, and a figure in seven times.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import shapely

from graphplan.sheet.lettering.label_candidates import AIR, OUTWARDS, Array, LabelCandidates
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.view import MAX_DOT_MM
from graphplan.sheet.tolerances import EDGE_TOL, LEVEL_TOL

TOUCHING = AIR + EDGE_TOL  # mm: boxes further apart do not touch


@dataclass(frozen=True)
class Footprints:
    """Areas that letters cover in some places: their boxes, and their leaders from end to end, nan for a letter without
    a leader; nan meets no other area."""

    boxes: Array
    leaders: Array

    @classmethod
    def of(cls, places: LabelCandidates) -> Footprints:
        """Footprints of some places."""
        leaders = np.hstack([places.spots, places.ends])
        leaders[~places.led] = np.nan
        return cls(places.boxes, leaders)

    def __getitem__(self, chosen: Any) -> Footprints:
        return Footprints(self.boxes.take(chosen, axis=0), self.leaders.take(chosen, axis=0))


@dataclass(frozen=True)
class Clashes:
    """Faults of places beside placed letters: the area of these that each covers, whether its leader crosses any of
    them, and whether a leader of theirs crosses it."""

    covered: Array
    leads_through: Array
    is_led_through: Array

    @property
    def cost(self) -> Array:
        """The price of that."""
        return np.asarray(CLASH * self.covered + FAULT * (self.leads_through + 1.0 * self.is_led_through))

    def __add__(self, more: Clashes) -> Clashes:
        """Sum of the faults beside further letters."""
        return Clashes(self.covered + more.covered, self.leads_through | more.leads_through,
                       self.is_led_through | more.is_led_through)

    def __getitem__(self, chosen: Any) -> Clashes:
        return Clashes(self.covered.take(chosen), self.leads_through.take(chosen), self.is_led_through.take(chosen))


def clashes(places: Footprints, others: Footprints, covered: Array | None = None) -> Clashes:
    """Faults of places beside other letters; the covered areas may be given."""
    leads_through, led_through = _crossings(others.boxes, places.leaders), _crossings(places.boxes, others.leaders)
    return Clashes(overlap(places.boxes, others.boxes) if covered is None else covered,
                   np.any(leads_through, axis=0), np.any(led_through, axis=1))


def costs_of_all(standing: Footprints) -> Array:
    """Price of each of some letters beside all the others."""
    box, other, overlaps = _overlaps(standing.boxes, standing.boxes)
    covered = np.bincount(box, overlaps * (box != other), len(standing.boxes))
    crossings = _crossings(standing.boxes, standing.leaders)
    np.fill_diagonal(crossings, False)
    return Clashes(covered, np.any(crossings, axis=0), np.any(crossings, axis=1)).cost


def letters_touched(places: Footprints, standing: Footprints) -> Array:
    """Whether each letter (columns) stands in each place (rows), or has a leader through it."""
    low, high = places.boxes[:, None, :2] - AIR, places.boxes[:, None, 2:] + AIR
    stands_inside = ((standing.boxes[:, :2] < high) & (standing.boxes[:, 2:] > low)).all(axis=2)
    return np.asarray(stands_inside | _crossings(places.boxes, standing.leaders))


def _crossings(boxes: Array, lines: Array) -> Array:
    """Whether each line (columns) goes through each box (rows)."""
    crossed = np.zeros((len(boxes), len(lines)), dtype=bool)
    columns = (lines[:, 0] == lines[:, 0]).nonzero()[0]  # nan is no line
    if len(columns) and len(boxes):
        start, end = lines[columns, :2], lines[columns, 2:]
        near, column = _meeting(boxes, np.minimum(start, end), np.maximum(start, end))
        line = columns[column]
        crossed[near, line] = share(boxes[near], start[column], end[column]) > 0
    return crossed


def overlap(boxes: Array, others: Array) -> Array:
    """Area of other letters that each box covers: a fixed price for touching, and the area."""
    box, _, covered = _overlaps(boxes, others)
    return np.bincount(box, covered, len(boxes))


def touches(box: Array, others: Array) -> bool:
    """Whether a box covers any of some other letters, or touches it."""
    sides = np.minimum(box[2:], others[:, 2:]) - np.maximum(box[:2], others[:, :2]) + AIR
    return bool((sides > 0).all(axis=1).any())


def _overlaps(boxes: Array, others: Array) -> tuple[Array, Array, Array]:
    """Pairs of boxes and others that they cover, with the covered areas."""
    box, other = _meeting(boxes, others[:, :2] - TOUCHING, others[:, 2:] + TOUCHING)
    one, two = boxes.take(box, axis=0), others.take(other, axis=0)
    sides = np.minimum(one[:, 2:], two[:, 2:]) - np.maximum(one[:, :2], two[:, :2]) + AIR
    return box, other, np.where((sides > 0).all(axis=1), 1.0 + sides[:, 0] * sides[:, 1], 0.0)


def _meeting(boxes: Array, low: Array, high: Array) -> Any:
    """Pairs of boxes that meet boxes from low to high corners, by number; column by column, which numpy compares in
    half of the time."""
    (lefts, lows), (rights, tops) = np.ascontiguousarray(boxes.T).reshape(2, 2, -1, 1)
    (left, bottom), (right, top) = low.T, high.T
    meets = lefts <= right
    meets &= rights >= left
    meets &= lows <= top
    meets &= tops >= bottom
    return np.divmod(meets.ravel().nonzero()[0], max(1, len(low)))


FAULT = 40.0  # the price of a line through the letters, or of letters that seem to belong to another mark
MISTAKEN_TIMES = 1.5  # as bad as a line, which may break off, are letters nearer to another mark than to their own
TOUCH = 0.15  # the price of touching, in mm or mm^2 of what is touched
BESIDE, STRANGER = 0.3, 3.0  # mm by which a letter should be nearer to its own mark than to another; the price of each
MIN_SURFACE_MM = 0.6  # mm: a wider line is a surface
INK_RATE, ARROW_RATE, AREA_RATE = 5.0, 4.0, 3.0  # prices of a mm^2: of thick lines and circles, heads, figures


class Lines:
    """The thin lines of a plan, segment by segment, as something that letters cover at a price."""

    def __init__(self, items: Iterable[Item]):
        chains = list(strokes(items))
        ends = [pair for chain, _ in chains for pair in pairwise(chain)]
        self.start, self.end = np.array(ends, dtype=float).reshape(-1, 2, 2).swapaxes(0, 1)
        self.tree = shapely.STRtree(shapely.linestrings(np.stack([self.start, self.end], axis=1)))
        self.stroke = np.repeat(np.arange(len(chains)), [len(chain) - 1 for chain, _ in chains])
        self.prices = np.array([price for _, price in chains])
        self.lengths = np.hypot(*(self.end - self.start).T)

    def price(self, found: LabelCandidates) -> Array:
        """The price of each place for the strokes in it and the air around it: by length, and for touching."""
        cells, count = found.cells, len(self.prices)
        places, segments = self.tree.query(_diagonals(cells))
        shares = share(cells[places], self.start[segments], self.end[segments])
        crossing = (shares >= 0).nonzero()[0]
        places, segments, shares = places[crossing], segments[crossing], shares[crossing]
        stroke = self.stroke[segments]
        pairs = np.zeros(len(cells) * count, dtype=bool)
        pairs[places * count + stroke] = True
        touched, touching = np.divmod(pairs.nonzero()[0], max(count, 1))
        paid = np.concatenate([self.lengths[segments] * shares * self.prices[stroke], TOUCH * self.prices[touching]])
        through = share(found.boxes[places], self.start[segments], self.end[segments]) > 0
        return np.bincount(np.concatenate([places, touched]), paid, len(cells)) + _faulty(places[through], len(cells))


def _faulty(places: Array, count: int) -> Array:
    """The price of a fault for each of `count` places that is among `places`."""
    return FAULT * (np.bincount(places, minlength=count) > 0)


def _diagonals(boxes: Array) -> Any:
    """The diagonals of boxes: a tree compares bounds alone, and lines are made faster than boxes."""
    return shapely.linestrings(boxes.reshape(-1, 2, 2))


def strokes(items: Iterable[Item]) -> Iterator[tuple[Sequence[Spot], float]]:
    """The thin lines that letters should not cover, each a chain of spots, with its price per mm."""
    for item in items:
        price = 1.0 + 5.0 * item.pen.width
        if isinstance(item, Polyline) and item.pen.width <= MIN_SURFACE_MM:
            yield item.spots, price
        elif isinstance(item, Arc):
            yield item.spots(), price
        elif isinstance(item, Arrow):
            yield (item.start, item.end), price


def share(cells: Array, start: Array, end: Array) -> Array:
    """Share of each segment in its cell (Liang and Barsky); negative if it passes by.

    A segment along an axis is never cut off by the sides that it runs along, as its bounds meet the cell's.
    """
    enter, leave = np.zeros(len(cells)), np.ones(len(cells))
    with np.errstate(divide="ignore", invalid="ignore"):
        for axis in (0, 1):  # column by column: numpy takes far longer to compare the two of a row
            origin = start[:, axis]
            run = end[:, axis] - origin
            entry, exit = (cells[:, axis] - origin) / run, (cells[:, axis + 2] - origin) / run
            along = run == 0
            np.putmask(entry, along, 0.0)
            np.putmask(exit, along, 1.0)
            np.maximum(enter, np.minimum(entry, exit), out=enter)
            np.minimum(leave, np.maximum(entry, exit), out=leave)
    return np.subtract(leave, enter, out=leave)


class Marks:
    """The marks of a plan: a letter should not stand nearer to another than to its own."""

    def __init__(self, spots: Sequence[Spot]):
        self.spots = np.array(spots, dtype=float).reshape(-1, 2)
        self.tree = shapely.STRtree(shapely.points(self.spots))

    def price(self, found: LabelCandidates) -> Array:
        """The price of each place for marks that are nearer than its own, or that its leader passes."""
        places, marks, near, gaps = self._around(found)
        foreign = np.hypot(*(self.spots[marks] - found.spots[places]).T) > BESIDE
        nearer = foreign & (gaps < near[places])
        return STRANGER * np.bincount(places[nearer], minlength=len(near)) \
            + MISTAKEN_TIMES * FAULT * _are_mistaken(places, near, gaps) + self._leader_faults(found)

    def mistaken(self, found: LabelCandidates) -> Array:
        """Whether each place is nearer to another mark than to its own, without a leader to it."""
        places, _, near, gaps = self._around(found)
        return _are_mistaken(places, near, gaps)

    def _around(self, found: LabelCandidates) -> tuple[Array, Array, Array, Array]:
        """Marks about places: the places, the marks, the least distance for each place, and the actual distance."""
        near = np.where(found.led, 0.0, _gap(found.boxes, found.spots) + BESIDE)  # a leader tells whose the letters are
        places, marks = self.tree.query(_diagonals(found.boxes + near[:, None] * OUTWARDS))
        return places, marks, near, _gap(found.boxes[places], self.spots[marks])

    def _leader_faults(self, found: LabelCandidates) -> Array:
        """The price of each place whose leader passes another mark."""
        led = found.led.nonzero()[0]
        leaders = shapely.linestrings(np.stack([found.spots[led], found.ends[led]], axis=1))
        leads, marks = self.tree.query(leaders, "dwithin", BESIDE) if len(led) else np.empty((2, 0), dtype=int)
        foreign = np.hypot(*(self.spots[marks] - found.spots[led[leads]]).T) > BESIDE
        return _faulty(led[leads[foreign]], len(found.led))


def _are_mistaken(places: Array, near: Array, gaps: Array) -> Array:
    """Whether each place has a mark nearer than any should be."""
    return np.bincount(places[gaps < near[places] - BESIDE], minlength=len(near)) > 0


def _gap(boxes: Array, spots: Array) -> Array:
    """Distance of each spot from its box."""
    return np.asarray(np.hypot(*np.maximum(np.maximum(boxes[:, :2] - spots, spots - boxes[:, 2:]), 0.0).T))


class FigureEdges:
    """The edges of polygons of shapely, those of outlines counter-clockwise, those of holes clockwise."""

    def __init__(self, figures: Array):
        rings, figure = shapely.get_rings(figures, return_index=True)
        spots, ring = shapely.get_coordinates(rings, return_index=True)
        inside = ring[1:] == ring[:-1]
        (x, y), (u, v) = spots[:-1][inside].T, spots[1:][inside].T
        ring = ring[:-1][inside]
        doubled = np.bincount(ring, x * v - u * y, len(rings))
        is_hole = np.concatenate([[False], figure[1:] == figure[:-1]])[: len(rings)]
        self.sign = np.where((doubled > 0) != is_hole, 1.0, -1.0)[ring]
        self.x, self.y, self.end = x, y, u
        run = u - x
        self.slope = np.divide(v - y, run, out=np.zeros(len(run)), where=run != 0)
        self.counts = np.bincount(figure[ring], minlength=len(figures))
        self.first = self.counts.cumsum() - self.counts

    def areas(self, boxes: Array, figures: Array) -> Array:
        """The area of each of some figures, told by their numbers, in the box beside it."""
        counts = self.counts[figures]
        pair = np.repeat(np.arange(len(figures)), counts)
        edge = np.arange(len(pair)) + np.repeat(self.first[figures] - (counts.cumsum() - counts), counts)
        lefts, lows, rights, tops = boxes.T[:, pair]
        x, slope = self.x[edge], self.slope[edge]
        start, end = np.clip(x, lefts, rights), np.clip(self.end[edge], lefts, rights)
        foot = self.y[edge] - lows
        under = _mean_between(foot + (start - x) * slope, foot + (end - x) * slope, tops - lows)
        return np.bincount(pair, self.sign[edge] * (start - end) * under, len(figures))


def _mean_between(start: Array, end: Array, most: Array) -> Array:
    """The mean height of what rises evenly from one height to another, where it counts as 0 below 0 and as no more than
    `most` above."""
    from_, to = np.clip(start, 0.0, most), np.clip(end, 0.0, most)
    rise = end - start
    level = np.abs(rise) < LEVEL_TOL
    whole = (to - from_) * (from_ + to) / 2 + to * (end - to) - from_ * (start - from_)
    return np.asarray(np.where(level, (from_ + to) / 2, whole / np.where(level, 1.0, rise)))


class Surfaces:
    """The thick lines and figures of a plan."""

    def __init__(self, items: Sequence[Item]):
        self.figures, self.rates = surfaces(items)
        self.tree, self.edges = shapely.STRtree(self.figures), FigureEdges(self.figures)

    def price(self, found: LabelCandidates) -> Array:
        """The price of each place for the surfaces that it and the air around it cover: by area, and for touching."""
        cells = shapely.box(*found.cells.T)
        places, surfaces = self.tree.query(cells, predicate="intersects")
        covered = self.edges.areas(found.cells[places], surfaces) + TOUCH
        hidden = shapely.intersects(shapely.box(*found.boxes[places].T), self.figures[surfaces])
        return np.bincount(places, covered * self.rates[surfaces], len(cells)) + _faulty(places[hidden], len(cells))


def surfaces(items: Sequence[Item]) -> tuple[Array, Array]:
    """The thick lines and figures that letters should not cover, as polygons of shapely in the order of the items, and
    the price of each per mm^2. Those of a kind are made at once: one by one takes several times as long."""
    thick, circles, areas = (list[tuple[int, Any, float]]() for _ in range(3))
    for place, item in enumerate(items):
        if isinstance(item, Polyline) and item.pen.width > MIN_SURFACE_MM:
            thick += [(place, ends, item.pen.width / 2) for ends in pairwise(item.spots)]
        elif isinstance(item, Circle):
            circles.append((place, item.centre, item.radius))
        elif isinstance(item, Arrow):
            areas.append((place, item.barbs, ARROW_RATE))
        elif isinstance(item, Polygon) and item.layer != "plates":
            areas.append((place, item.spots, AREA_RATE))
    ends, halves, centres, radii = (np.array([row[k] for row in rows], dtype=float)
                                    for rows in (thick, circles) for k in (1, 2))
    strips = shapely.buffer(shapely.linestrings(ends.reshape(-1, 2, 2)), halves, quad_segs=2)
    discs = shapely.buffer(shapely.points(centres.reshape(-1, 2)), radii + 0.2, quad_segs=8)
    rings = radii > MAX_DOT_MM  # within a larger circle letters may stand
    discs[rings] = shapely.buffer(shapely.get_exterior_ring(discs[rings]), 0.2, quad_segs=2)
    order = np.argsort([place for place, *_ in (*thick, *circles, *areas)], kind="stable")
    rates = np.array([*[INK_RATE] * (len(strips) + len(discs)), *(rate for *_, rate in areas)])
    figures = np.array([*strips, *discs, *(shapely.Polygon(spots) for _, spots, _ in areas)], dtype=object)
    return figures[order], rates[order]


CLASH = 400.0  # the price of standing on another letter, and of each mm^2 of that
AHEAD = 8.0  # of places dearer by no more than this it is found together what they cover: they may be asked for next
CHOICE_MARGIN = 1.5  # a place dearer by no more than this is a choice as well


class Prices:
    """Prices of the places of all letters.

    A place is at first priced by its distance alone, so no dearer than it is. What it covers takes long to find, and is
    found, part by part, only for places that would win without it.
    """

    def __init__(self, found: LabelCandidates, lines: Lines, marks: Marks, surfaces: Surfaces):
        self.lines, self.marks, self.surfaces = lines, marks, surfaces
        self.found, self.parts, self.cost = found, (lines, marks, surfaces), found.cost.copy()
        self.known = np.zeros(len(found.cost), dtype=int)  # how many parts a place's price holds

    def cheapest(self, letter: slice, more: Array | float = 0.0) -> int:
        """The cheapest place of a letter, where its places cost `more` in addition."""
        return int(letter.start) + self.cheapest_of(np.arange(letter.start, letter.stop), more)[0]

    def cheapest_of(self, places: Array, more: Array | float = 0.0, most: float = np.inf) -> tuple[int, float]:
        """The number and the price of the cheapest of some places, which cost `more` in addition; that is known in full
        where it is less than `most`."""
        while True:
            price = self.cost[places] + more
            best = int(price.argmin())
            if price[best] >= most or self.known[places[best]] == len(self.parts):
                return best, float(price[best])
            self._look(places[price <= price[best] + AHEAD])

    def choices(self, starts: Array) -> tuple[Array, Array]:
        """For each letter how many places are almost as good as the cheapest, and what that costs."""
        while True:
            least = np.minimum.reduceat(self.cost, starts)
            good = self.cost < (least + CHOICE_MARGIN)[self.found.letters]
            if (self.known[good] == len(self.parts)).all():
                return np.bincount(self.found.letters[good]), least
            self._look(np.flatnonzero(good))

    def away_from(self, taken: Sequence[Rect]) -> Prices:
        """The prices where places in some rectangles cost as much as those on other letters."""
        dearer = Prices(self.found, *self.parts)
        dearer.cost, dearer.known = self.cost + CLASH * self.found.meeting(taken), self.known.copy()
        return dearer

    def _look(self, places: Array) -> None:
        """Add the next part to the price of those of the places that are furthest behind."""
        known_parts = int(self.known[places].min())
        behind = places[self.known[places] == known_parts]
        self.cost[behind] += self.parts[known_parts].price(self.found[behind])
        self.known[behind] += 1

    def total(self, places: Array, most: float = np.inf) -> Array:
        """Prices of some places, complete if below `most`."""
        while (behind := places[(self.known[places] < len(self.parts)) & (self.cost[places] < most)]).size:
            self._look(behind)
        return self.cost[places]

    def faults(self, places: Array) -> Array:
        """The part of some places' cost that is for what they cover, not for distance."""
        return self.total(places) - self.found.cost[places]

    def with_more_places(self, more: LabelCandidates) -> tuple[Prices, Array]:
        """The prices with more places for some letters, and where each place went."""
        every = self.found.append(more)
        order = every.letters.argsort(kind="stable")
        longer = Prices(every[order], *self.parts)
        count = len(self.cost)
        new_index = np.empty(len(order), dtype=int)
        new_index[order] = np.arange(len(order))
        longer.cost[new_index[:count]], longer.known[new_index[:count]] = self.cost, self.known
        return longer, new_index[:count]

    def spans(self, count: int) -> list[slice]:
        """Slices of each letter's places."""
        edges = self.found.letters.searchsorted(np.arange(count + 1))
        return [slice(int(start), int(end)) for start, end in pairwise(edges)]
