"""What stands in the text columns: rows of lettering and of boxes, and how they run down one column after the other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from graphplan.sheet.lettering.lettering import ANCHORS, CAPS, HEADING, SIZE, Runs, sentence_runs, width, wrap
from graphplan.sheet.plates.display import Item, Polygon, Polyline, Rect, Text, moved
from graphplan.sheet.plates.pens import BORDER, LETTERS, THIN

LEADING = 1.42  # of the letter size, base line to base line
BELOW, BETWEEN = 0.36, 0.16  # of the letter size: rules under the base line


@dataclass(frozen=True)
class Cell:
    """A piece of a row: `x` is its distance from the column's left edge; `rules` are lines below it: after which and
    to the end of which of its letters, and how many."""

    x: float
    runs: Runs
    anchor: str = "start"
    bold: bool = False
    rules: tuple[tuple[Runs, Runs, int], ...] = ()


@dataclass(frozen=True)
class TextRow:
    """One line of a column; `gap` is left free above it, and `keep` more rows must stand in the same column.

    A row belongs to a drawing step, or to the results that are read when all is drawn, or is always there. One to be
    filled in is so `tall`, and has empty boxes, measured from its lower left corner; so is one with a `figure`, which
    is as wide as that.
    """

    cells: tuple[Cell, ...]
    size: float = SIZE
    gap: float = 0.0
    step: int | None = None
    keep: int = 0
    layer: str = "text"
    tall: float = 0.0
    boxes: tuple[Rect, ...] = ()
    figure: tuple[Item, ...] = ()

    def enlarged(self, times: float) -> TextRow:
        """The row in letters so many times as large; those of headings are no larger than headings should be."""
        if times == 1.0:
            return self
        cells = tuple(replace(cell, x=times * cell.x) for cell in self.cells)
        boxes = tuple(box.times(times) for box in self.boxes)
        size = max(min(times * self.size, HEADING), self.size)
        figure = tuple(moved(item, 0.0, 0.0, times) for item in self.figure)
        return replace(self, cells=cells, size=size, gap=times * self.gap, tall=times * self.tall, boxes=boxes,
                       figure=figure)

    @property
    def height(self) -> float:
        return self.tall or self.size * LEADING

    @property
    def right(self) -> float:
        """How far the row reaches."""
        ends = (cell.x + width(cell.runs, self.size, cell.bold) * (1.0 - ANCHORS[cell.anchor]) for cell in self.cells)
        return max((*ends, *(box.right for box in self.boxes), self.tall if self.figure else 0.0), default=0.0)


def hung(runs: Runs, wide: float, indent: float, number: str = "", step: int | None = None) -> Iterator[TextRow]:
    """A paragraph in a column of a width: as it is, or with a number from which its lines hang, so far indented."""
    hangs = indent if number else 0.0
    lines = wrap(runs, SIZE, wide - hangs)
    for i, line in enumerate(lines):
        label = (Cell(hangs - 1.6, sentence_runs(number), "end"),) if number and i == 0 else ()
        yield TextRow((*label, Cell(hangs, line)), step=step, keep=min(3, len(lines) - 1 - i))


Placed = tuple[TextRow, float, float]


def fill(rows: Sequence[TextRow], columns: Sequence[Rect]) -> list[Placed] | None:
    """Every row with its left edge and base line, running down the columns; none if they do not hold them."""
    placed: list[Placed] = []
    places = iter(columns)
    column = next(places, None)
    y = column.top if column else 0.0
    for i, row in enumerate(rows):
        block = row.height + sum(follower.gap + follower.height for follower in rows[i + 1 : _kept(rows, i)])
        while column is not None and y - _gap(row, y, column) - block < column.bottom:
            column = next(places, None)
            y = column.top if column else 0.0
        if column is None:
            return None
        y -= _gap(row, y, column) + row.height
        placed.append((row, column.left, y + row.size * (LEADING - 1)))
    return placed


def _kept(rows: Sequence[TextRow], first: int) -> int:
    """Where the rows end that must stand in one column with a row, as they or others of them say."""
    end = i = first
    while i <= end and i < len(rows):
        end, i = max(end, i + rows[i].keep), i + 1
    return end + 1


def _gap(row: TextRow, y: float, column: Rect) -> float:
    """No gap at the head of a column."""
    return row.gap if y < column.top else 0.0


def lettered(placed: Sequence[Placed]) -> Iterator[Item]:
    """The rows as items; the lettering of a tall one stands half-way up."""
    for row, x, y in placed:
        foot = y - row.size * (LEADING - 1)
        yield from (moved(item, x, foot) for item in row.figure)
        for box in row.boxes:
            there = Rect(x + box.left, foot + box.bottom, x + box.right, foot + box.top)
            yield Polygon(BORDER, "blanks", row.step, there.corners)
        base = foot + (row.tall - CAPS * row.size) / 2 if row.tall else y
        for cell in row.cells:
            yield Text(LETTERS, row.layer, row.step, (x + cell.x, base), cell.runs, row.size, cell.anchor, cell.bold)
            for before, through, times in cell.rules:
                left, right = (x + cell.x + width(runs, row.size, cell.bold) for runs in (before, through))
                for k in range(times):
                    low = base - (BELOW + k * BETWEEN) * row.size
                    yield Polyline(THIN, row.layer, row.step, ((left, low), (right, low)))
