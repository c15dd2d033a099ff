"""Letters that stand, and what places cost beside them: for lying on letters, and for leaders through letters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.sheet.lettering.label_candidates import AIR, Array, LabelCandidates
from graphplan.sheet.lettering.prices import CLASH, FAULT, share
from graphplan.sheet.tolerances import EDGE_TOL

TOUCHING = AIR + EDGE_TOL  # mm: boxes further apart do not touch


@dataclass(frozen=True)
class Footprints:
    """What letters cover in some places: their boxes, and their leaders from end to end, which are nan where there is
    none; nothing meets nan."""

    boxes: Array
    leaders: Array

    @classmethod
    def of(cls, places: LabelCandidates) -> Footprints:
        """Those of some places."""
        leaders = np.hstack([places.spots, places.ends])
        leaders[~places.led] = np.nan
        return cls(places.boxes, leaders)

    def __getitem__(self, chosen: Any) -> Footprints:
        return Footprints(self.boxes.take(chosen, axis=0), self.leaders.take(chosen, axis=0))


@dataclass(frozen=True)
class Clashes:
    """What is wrong with places beside letters that stand: how much of these each covers, whether its own leader goes
    through any of them, and whether a leader of theirs goes through it."""

    covered: Array
    leads_through: Array
    is_led_through: Array

    @property
    def cost(self) -> Array:
        """The price of that."""
        return np.asarray(CLASH * self.covered + FAULT * (self.leads_through + 1.0 * self.is_led_through))

    def __add__(self, more: Clashes) -> Clashes:
        """The same beside further letters."""
        return Clashes(self.covered + more.covered, self.leads_through | more.leads_through,
                       self.is_led_through | more.is_led_through)

    def __getitem__(self, chosen: Any) -> Clashes:
        return Clashes(self.covered.take(chosen), self.leads_through.take(chosen), self.is_led_through.take(chosen))


def clashes(places: Footprints, others: Footprints, covered: Array | None = None) -> Clashes:
    """What is wrong with places beside other letters, of which each covers so much if that is told."""
    leads_through, led_through = _crossings(others.boxes, places.leaders), _crossings(places.boxes, others.leaders)
    return Clashes(overlap(places.boxes, others.boxes) if covered is None else covered,
                   np.any(leads_through, axis=0), np.any(led_through, axis=1))


def costs_of_all(standing: Footprints) -> Array:
    """What each of some letters pays for all the others."""
    box, other, overlaps = _overlaps(standing.boxes, standing.boxes)
    covered = np.bincount(box, overlaps * (box != other), len(standing.boxes))
    crossings = _crossings(standing.boxes, standing.leaders)
    np.fill_diagonal(crossings, False)
    return Clashes(covered, np.any(crossings, axis=0), np.any(crossings, axis=1)).cost


def letters_touched(places: Footprints, standing: Footprints) -> Array:
    """Which letters (columns) stand in places (rows), or have a leader that goes through them."""
    low, high = places.boxes[:, None, :2] - AIR, places.boxes[:, None, 2:] + AIR
    stands_inside = ((standing.boxes[:, :2] < high) & (standing.boxes[:, 2:] > low)).all(axis=2)
    return np.asarray(stands_inside | _crossings(places.boxes, standing.leaders))


def _crossings(boxes: Array, lines: Array) -> Array:
    """Which boxes (rows) the lines (columns) go through."""
    crossed = np.zeros((len(boxes), len(lines)), dtype=bool)
    columns = (lines[:, 0] == lines[:, 0]).nonzero()[0]  # nan is no line
    if len(columns) and len(boxes):
        start, end = lines[columns, :2], lines[columns, 2:]
        near, column = _meeting(boxes, np.minimum(start, end), np.maximum(start, end))
        line = columns[column]
        crossed[near, line] = share(boxes[near], start[column], end[column]) > 0
    return crossed


def overlap(boxes: Array, others: Array) -> Array:
    """How much of the other letters each box covers: a fixed price for touching, and the area."""
    box, _, covered = _overlaps(boxes, others)
    return np.bincount(box, covered, len(boxes))


def _overlaps(boxes: Array, others: Array) -> tuple[Array, Array, Array]:
    """Which boxes cover which of the others, and how much of them: few do, so that is asked first."""
    box, other = _meeting(boxes, others[:, :2] - TOUCHING, others[:, 2:] + TOUCHING)
    one, two = boxes.take(box, axis=0), others.take(other, axis=0)
    sides = np.minimum(one[:, 2:], two[:, 2:]) - np.maximum(one[:, :2], two[:, :2]) + AIR
    return box, other, np.where((sides > 0).all(axis=1), 1.0 + sides[:, 0] * sides[:, 1], 0.0)


def _meeting(boxes: Array, low: Array, high: Array) -> Any:
    """Which boxes meet which of those from low to high corners, by both numbers: in columns, which numpy compares in
    half of the time."""
    (lefts, lows), (rights, tops) = np.ascontiguousarray(boxes.T).reshape(2, 2, -1, 1)
    (left, bottom), (right, top) = low.T, high.T
    meets = lefts <= right
    meets &= rights >= left
    meets &= lows <= top
    meets &= tops >= bottom
    return np.divmod(meets.ravel().nonzero()[0], max(1, len(low)))
