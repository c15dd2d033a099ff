"""Free room on a sheet: where facts, words and details can lie beside plans and letters, in cells of a grid."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from copy import copy
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphplan.sheet.layout.facts_block import FOUND, GIVEN, FactPlace, FactRows
from graphplan.sheet.layout.measures import (
    CAPTION_MM,
    CELL_MM,
    CLEARANCE_MM,
    FACT_GAP_MM,
    FREE_COLUMNS,
    FREE_WIDTHS_MM,
    PADDING_MM,
)
from graphplan.sheet.layout.paper import Arrangement
from graphplan.sheet.lettering.lettering import LARGE_SHEET
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import BORDER
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.tolerances import EDGE_TOL

Cells = NDArray[np.bool_]  # by rows from below


def places_in_free_room(space: Rect, items: Iterable[Item], facts: FactRows, title: Rect) -> tuple[FactPlace, ...]:
    """Places for given and found among the items of the plans, in letters as large as there is room for, those of the
    results first.

    Both in one block, the nearest to the title block, if that has large letters; else each in its own, given from the
    upper left and found from the lower right; empty if there is no room for both. If they would be read in the wrong
    order, the first way in the right order is taken, if there is one: from above and below, or from the left and the
    right.
    """
    room, large = FreeRoom(space, items), LARGE_SHEET.times
    layers = tuple(layer for layer, some in ((FOUND, facts.found), (GIVEN, facts.given)) if some)
    tries: tuple[list[tuple[tuple[str, ...], float]], ...] = (
        [(layers[::-1], large)], [((layer,), large) for layer in layers],
        [((layer,), large if layer == FOUND else 1.0) for layer in layers],
        [((layer,), 1.0) for layer in layers], [(layers[::-1], 1.0)])
    first = next((places for blocks in tries for places in _block_places(room, blocks, facts, title)), ())
    ordered = (places for blocks in tries for order in (blocks, blocks[::-1]) for sideways in (False, True)
               for places in _block_places(room, order, facts, title, sideways) if is_in_reading_order(places))
    return first if is_in_reading_order(first) else next(ordered, first)


def is_in_reading_order(places: Sequence[FactPlace]) -> bool:
    """Whether what was found stands to the right of what is given or below it, as it is read."""
    givens, results = ([column for place in places if layer in place.layers for column in place.columns]
                       for layer in (GIVEN, FOUND))
    if not givens or not results or givens == results:
        return True
    return (min(column.left for column in results) >= max(column.right for column in givens)
            or max(column.top for column in results) <= min(column.bottom for column in givens))


def _block_places(room: FreeRoom, blocks: Sequence[tuple[tuple[str, ...], float]], facts: FactRows, title: Rect,
                  sideways: bool = False) -> Iterator[tuple[FactPlace, ...]]:
    """Places for blocks of facts, each with how many times its letters are larger than those of words; `sideways` they
    are the first from the left and from the right."""
    if not blocks:
        yield ()
        return
    layers, larger = blocks[0]
    rows = facts.enlarge(larger * facts.times)
    for wide in _widths(layers, rows):
        if window := _window(room, layers, rows, wide, title, sideways):
            column = window.inset(PADDING_MM, PADDING_MM, PADDING_MM, PADDING_MM)
            for places in _block_places(room.without(window), blocks[1:], facts, title, sideways):
                yield (FactPlace(layers, (column,), larger), *places)


def _widths(layers: tuple[str, ...], facts: FactRows) -> list[float]:
    """The widths of blocks that are tried, the widest first: those of just so many columns of results, too."""
    just = [count * (facts.least_width + FACT_GAP_MM) - FACT_GAP_MM + 2 * PADDING_MM
            for count in FREE_COLUMNS if FOUND in layers]
    return sorted((*just, *(facts.times * wide for wide in FREE_WIDTHS_MM)), reverse=True)


def _window(room: FreeRoom, layers: tuple[str, ...], facts: FactRows, wide: float, title: Rect,
            sideways: bool) -> Rect | None:
    """Room for a block of facts of a width; none where there is none."""
    inner = wide - 2 * PADDING_MM
    if FOUND in layers and inner < facts.least_width - EDGE_TOL:
        return None
    high = sum([row.gap + row.height for row in facts(inner) if row.layer in layers]) + 2 * PADDING_MM
    if len(layers) > 1:
        return room.nearest(wide, high, title.centre)
    return room.window(wide, high, layers == (GIVEN,), sideways)


class FreeRoom:
    """A page on which some cells of a grid are taken by what is drawn, and the air about it."""

    def __init__(self, space: Rect, items: Iterable[Item]):
        self.space, self.shape = space, (int(space.height / CELL_MM), int(space.width / CELL_MM))
        left, low, right, high = self._cells(_boxes(items), CLEARANCE_MM).T
        begun = np.zeros((self.shape[0] + 1, self.shape[1] + 1), dtype=int)
        for rows, columns, step in ((low, left, 1), (high, left, -1), (low, right, -1), (high, right, 1)):
            np.add.at(begun, (rows, columns), step)
        self._note(begun.cumsum(0).cumsum(1)[:-1, :-1] > 0)

    def without(self, box: Rect) -> FreeRoom:
        """The page with a rectangle taken as well."""
        left, low, right, high = self._cells(np.array([box.corners[0] + box.corners[2]]), 0.0)[0]
        taken, other = self.taken.copy(), copy(self)
        taken[low:high, left:right] = True
        other._note(taken)
        return other

    def _note(self, taken: Cells) -> None:
        """Note which cells are taken, and how many of them lie below and to the left of each corner of cells."""
        self.taken = taken
        self.sums = np.zeros((self.shape[0] + 1, self.shape[1] + 1), dtype=int)
        taken.cumsum(0).cumsum(1, out=self.sums[1:, 1:])
        self._free: dict[tuple[int, int], Cells] = {}  # by the size of the rectangle

    def _cells(self, boxes: NDArray[np.float64], clearance: float) -> NDArray[np.int_]:
        """Of boxes, with so much air about them, the first columns and rows of cells, and those after the last ones."""
        origin = np.array((self.space.left, self.space.bottom))
        first = (boxes[:, :2] - clearance - origin) / CELL_MM
        end = (boxes[:, 2:] + clearance - origin) / CELL_MM
        return np.hstack((first.astype(int), np.ceil(end).astype(int))).clip(0, self.shape[::-1] * 2)

    def window(self, wide: float, high: float, is_first: bool, sideways: bool = False) -> Rect | None:
        """A free rectangle of a size, the first from above and then from the left or, `sideways`, the other way round;
        without `is_first` the last. None if there is no room."""
        free = self._free_cells(wide, high)[::-1]
        cells = (free.T if sideways else free).ravel()
        if not cells.any():
            return None
        place = int(cells.argmax() if is_first else len(cells) - 1 - cells[::-1].argmax())
        down, across = divmod(place, len(free))[::-1] if sideways else divmod(place, free.shape[1])
        return self._rect((len(free) - 1 - down, across), wide, high)

    def nearest(self, wide: float, high: float, spot: Spot) -> Rect | None:
        """The free rectangle of a size of which the middle is nearest to a spot; None if there is no room."""
        free = np.argwhere(self._free_cells(wide, high))
        if not len(free):
            return None
        lower = (spot[1] - high / 2 - self.space.bottom) / CELL_MM, (spot[0] - wide / 2 - self.space.left) / CELL_MM
        return self._rect(free[((free - lower) ** 2).sum(axis=1).argmin()].tolist(), wide, high)

    def _free_cells(self, wide: float, high: float) -> Cells:
        """Whether each cell is the lower left one of a free rectangle of a size."""
        rows, columns = size = math.ceil(high / CELL_MM), math.ceil(wide / CELL_MM)
        if rows > self.shape[0] or columns > self.shape[1]:
            return np.empty((0, 0), dtype=bool)
        if size not in self._free:
            sums = self.sums
            covered = sums[rows:, columns:] - sums[:-rows, columns:]
            covered -= sums[rows:, :-columns]
            covered += sums[:-rows, :-columns]
            self._free[size] = covered == 0
        return self._free[size]

    def _rect(self, cell: Sequence[int], wide: float, high: float) -> Rect:
        """The rectangle of a size of which the lower left cell has this row and column."""
        left, bottom = self.space.left + CELL_MM * cell[1], self.space.bottom + CELL_MM * cell[0]
        return Rect(left, bottom, left + wide, bottom + high)


def _boxes(items: Iterable[Item]) -> NDArray[np.float64]:
    """The left, lower, right and upper sides of small boxes that hold items together: those of letters, of figures, of
    the pieces of lines."""
    whole, lines, circles = list[Rect](), list[Sequence[Spot]](), dict[int, list[tuple[float, float, float]]]()
    for item in items:
        match item:
            case Text():
                whole.append(item.box)
            case Polygon():
                whole.append(bounding_box(item.spots))
            case Polyline():
                lines.append(item.spots)
            case Arc():
                lines.append(item.spots())
            case Arrow():
                lines.append((item.start, item.end))
            case Circle():
                circles.setdefault(max(8, int(item.radius)), []).append((*item.centre, item.radius))
    for count, some in circles.items():
        x, y, r = np.array(some).T[..., None]
        angles = np.linspace(0.0, 2 * math.pi, count)
        lines += np.stack((x + r * np.cos(angles), y + r * np.sin(angles)), axis=2).tolist()
    return np.vstack((np.reshape([(box.left, box.bottom, box.right, box.top) for box in whole], (-1, 4)),
                      _pieces(lines)))


def _pieces(lines: Iterable[Sequence[Spot]]) -> NDArray[np.float64]:
    """Boxes of the pieces of lines, each at most two cells long."""
    ends = np.reshape([pair for line in lines for pair in pairwise(line)], (-1, 2, 2))
    along = ends[:, 1] - ends[:, 0]
    counts = np.ceil(np.hypot(*along.T) / (2 * CELL_MM)).astype(int).clip(1)
    start, along, count = (np.repeat(a, counts, axis=0) for a in (ends[:, 0], along, counts[:, None]))
    k = (np.arange(len(count)) - np.repeat(counts.cumsum() - counts, counts))[:, None]
    begin, end = start + along * k / count, start + along * (k + 1) / count
    return np.hstack((np.minimum(begin, end), np.maximum(begin, end)))


def free_places(facts: FactRows, arrangement: Arrangement, drawn: Iterable[Item]) -> tuple[FactPlace, ...]:
    """Places for facts among the items of the plans; empty if there is no room."""
    items = list(drawn)
    for panel in arrangement.panels.values():
        caption = panel._replace(bottom=panel.top - CAPTION_MM)
        items += [Polygon(BORDER, "paper", None, caption.corners),
                  Polyline(BORDER, "paper", None, (*panel.corners, panel.corners[0]))]
    items += [Polygon(BORDER, "paper", None, rect.corners) for rect in (arrangement.title, *arrangement.columns)]
    return places_in_free_room(arrangement.frame, items, facts.enlarge(arrangement.letters.times), arrangement.title)
