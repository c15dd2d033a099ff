"""Room for letters: about how many of a sheet's letters would find no good place, before they are placed.

A letter needs room near its mark that no line crosses, and no nearer to another mark. Letters take such room one by
one, those with the fewest places first. To place all letters with what every place costs (lettering/prices.py) would
take most of the time where forms of a construction are weighed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from graphplan.sheet.lettering.label_candidates import LED, RINGS, Array, LabelCandidates, candidates
from graphplan.sheet.lettering.letters import POOR_PRICE, marks_on, wishes_inside, wishes_on
from graphplan.sheet.lettering.prices import MIN_SURFACE_MM, Marks, strokes
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.plate import Plate, Plates

LETTER_CELL_MM = 0.4  # of the raster
HEAD_MM = 1.2  # about the point of an arrow, where no letter should stand
MAX_DISC_MM = 3.0  # the radius of a circle that is filled, or within which no letter stands
CROWDED_TIMES = 1.1  # as many letters find no good place once all prices count [0.95 to 1.2 in packaged scenes]


def share_without_room(plates: Plates) -> float:
    """The part of the letters of some plans that can hardly be read, about."""
    without, count = map(sum, zip(*map(_without_room, plates), strict=True))
    return CROWDED_TIMES * without / max(1, count)


def _without_room(plate: Plate) -> tuple[int, int]:
    """Number of letters of a plan without a good place, and of all its letters."""
    rect = plate.view.rect
    wishes = [wish._replace(letters=plate.plates.letters) for wish in wishes_inside(wishes_on(plate), rect)]
    if not wishes:
        return 0, 0
    near = candidates(wishes, rect, RINGS[RINGS[:, 0] <= LED])
    near = near[~_hold_ink(near.boxes, rect, [*plate.items(), *plate.mechanism])]
    clear = near[Marks(marks_on(plate)).price(near) <= POOR_PRICE]
    return _without_place(clear, len(wishes)), len(wishes)


def _without_place(clear: LabelCandidates, count: int) -> int:
    """Number of letters without a clear place, or without one that others leave free."""
    choices = np.bincount(clear.letters, minlength=count)
    starts, standing, poor = choices.cumsum() - choices, np.empty((0, 4)), 0
    for letter in choices.argsort(kind="stable"):
        boxes = clear.boxes[starts[letter]:starts[letter] + choices[letter]]
        overlaps = (boxes[:, None, :2] < standing[:, 2:]) & (boxes[:, None, 2:] > standing[:, :2])
        free = boxes[~np.any(np.all(overlaps, axis=2), axis=1)]
        poor += not len(free)
        standing = np.concatenate([standing, free[:1]])
    return poor


def _hold_ink(boxes: Array, rect: Rect, items: Sequence[Item]) -> Array:
    """Whether each box holds ink, or lies near a mark."""
    corner = np.array((rect.left, rect.bottom))
    size = _cells(np.array((rect.width, rect.height))) + 2
    sums = np.zeros(size + 1, dtype=np.int32)
    ink, cells = sums[1:, 1:], _cells(_samples(items) - corner)
    ink[tuple(cells[((cells >= 0) & (cells < size)).all(axis=1)].T)] = 1
    discs = np.array([(x - radius, y - radius, x + radius, y + radius) for (x, y), radius in _discs(items)])
    sides = np.maximum(_cells(discs.reshape(-1, 2, 2) - corner) + np.array([[0], [1]]), 0)
    for (left, low), (right, high) in sides.tolist():
        ink[left:right, low:high] = 1
    for axis in (1, 0):
        sums.cumsum(axis=axis, out=sums)
    (left, low), (right, high) = (np.clip(_cells(corners - corner) + end, 0, size).T
                                  for corners, end in ((boxes[:, :2], 0), (boxes[:, 2:], 1)))
    return np.asarray(sums[right, high] - sums[left, high] - sums[right, low] + sums[left, low] > 0)


def _cells(spots: Array) -> Array:
    """The cells of the raster in which spots lie, which are told from its corner."""
    return np.asarray(np.floor(spots / LETTER_CELL_MM), dtype=int) + 1


def _samples(items: Sequence[Item]) -> Array:
    """Spots along all lines and about all figures, one in each cell at least."""
    ends = np.array([pair for chain in _chains(items) for pair in pairwise(chain)], dtype=float).reshape(-1, 2, 2)
    counts = np.ceil(np.abs(ends[:, 1] - ends[:, 0]).max(axis=1, initial=0.0) / LETTER_CELL_MM).astype(int) + 2
    line = np.repeat(np.arange(len(counts)), counts)
    place = np.arange(len(line)) - (counts.cumsum() - counts)[line]
    share = (place / (counts - 1)[line])[:, None]
    return np.asarray(ends[line, 0] * (1 - share) + ends[line, 1] * share)


def _chains(items: Sequence[Item]) -> Iterator[Sequence[Spot]]:
    """Lines, thin and thick, and the outlines of figures."""
    yield from (chain for chain, _ in strokes(items))
    for item in items:
        if isinstance(item, Polyline) and item.pen.width > MIN_SURFACE_MM:
            yield item.spots
        elif isinstance(item, Polygon) and item.layer != "plates":
            yield (*item.spots, item.spots[0])


def _discs(items: Iterable[Item]) -> Iterator[tuple[Spot, float]]:
    """Dots, pins and points of arrows, each with the radius about it where no letter should stand."""
    for item in items:
        if isinstance(item, Arrow):
            yield item.end, HEAD_MM
        elif isinstance(item, Circle) and item.radius <= MAX_DISC_MM:
            yield item.centre, item.radius
