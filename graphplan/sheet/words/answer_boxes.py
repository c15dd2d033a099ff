"""Blanks: rows of a column with boxes to fill in by hand, or to tick."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from graphplan.sheet.lettering.lettering import CAPS, SIZE, width
from graphplan.sheet.plates.display import Item, Polygon, Rect
from graphplan.sheet.plates.pens import BORDER
from graphplan.sheet.words.rows import LEADING, Cell, Placed, Row, lettered
from graphplan.sheet.words.tables import APART, Table

TALL, TIGHT = 6.5, 5.2  # mm: a box has room for a number by hand, also where space is short
NARROW = 11.0  # mm: the least that a number by hand needs
TOGETHER = 15  # rows of a table stand in one column
TICK, TICKED = 2.2, 12.0  # mm: the box of a step, and where its sentence begins


@dataclass(frozen=True)
class Blank(Row):
    """A row with empty boxes: `boxes` are measured from the lower left corner of the row, which is so `tall`."""

    boxes: tuple[Rect, ...] = ()
    tall: float = SIZE * LEADING

    @property
    def height(self) -> float:
        return self.tall

    @property
    def right(self) -> float:
        """How far the row reaches."""
        return max([super().right, *(box.right for box in self.boxes)])


def blanks(table: Table, wide: float) -> Iterator[Row]:
    """A table to fill in: its head and names as they are, and an empty box for every number."""
    names = max(width(row[0], SIZE) for row in table) + APART
    pitch = min((wide - names) / (len(table[0]) - 1), 2.4 * NARROW)
    lefts = [names + i * pitch for i in range(len(table[0]) - 1)]
    heads = [Cell(left + pitch / 2, runs, "middle") for left, runs in zip(lefts, table[0][1:], strict=True)]
    yield Row((Cell(0.0, table[0][0]), *heads), gap=1.5, keep=min(TOGETHER, len(table) - 1))
    for row in table[1:]:
        boxes = [Rect(left, 0.0, left + pitch, TALL) for left, runs in zip(lefts, row[1:], strict=True) if runs]
        yield Blank((Cell(0.0, row[0]),), boxes=tuple(boxes), tall=TALL)


def fits(table: Table, wide: float) -> bool:
    """Whether all the boxes of a table have room for a number by hand."""
    return max(width(row[0], SIZE) for row in table) + APART + (len(table[0]) - 1) * NARROW <= wide


def ticked(row: Row) -> Blank:
    """A row with a box to tick before it."""
    low = (SIZE * LEADING - TICK) / 2
    box = Rect(0.0, low, TICK, low + TICK)
    return Blank(row.cells, gap=row.gap, step=row.step, keep=row.keep, boxes=(box,))


def tightened(row: Row) -> Row:
    """The row where space is short: nearer to the one above, its boxes for numbers lower."""
    if isinstance(row, Blank) and row.tall > TIGHT:
        boxes = tuple(replace(box, top=TIGHT) for box in row.boxes)
        return replace(row, gap=row.gap / 2, tall=TIGHT, boxes=boxes)
    return replace(row, gap=row.gap / 2)


def written(placed: Sequence[Placed]) -> Iterator[Item]:
    """Rows as items, the boxes of blanks among them, whose lettering stands half-way up."""
    for row, x, y in placed:
        if not isinstance(row, Blank):
            yield from lettered([(row, x, y)])
            continue
        foot = y - row.size * (LEADING - 1)
        for box in row.boxes:
            moved = Rect(x + box.left, foot + box.bottom, x + box.right, foot + box.top)
            yield Polygon(BORDER, "blanks", row.step, moved.corners)
        yield from lettered([(replace(row, boxes=()), x, foot + (row.tall - CAPS * row.size) / 2)])

