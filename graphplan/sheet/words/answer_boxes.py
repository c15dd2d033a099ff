"""Answer boxes: rows of a column with boxes to fill in by hand, or to tick."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from graphplan.sheet.lettering.lettering import SIZE, width
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.words.rows import Cell, TextRow
from graphplan.sheet.words.tables import APART, TOGETHER, Table

TALL, TIGHT = 6.5, 5.2  # mm: a box has room for a number by hand, also where space is short
NARROW = 11.0  # mm: the least that a number by hand needs
TICK, TICKED = 2.2, 12.0  # mm: the box of a step, and where its sentence begins


def answer_rows(table: Table, wide: float) -> Iterator[TextRow]:
    """A table to fill in: its head and names as they are, and an empty box for every number."""
    names = max(width(row[0], SIZE) for row in table) + APART
    pitch = min((wide - names) / (len(table[0]) - 1), 2.4 * NARROW)
    lefts = [names + i * pitch for i in range(len(table[0]) - 1)]
    heads = [Cell(left + pitch / 2, runs, "middle") for left, runs in zip(lefts, table[0][1:], strict=True)]
    yield TextRow((Cell(0.0, table[0][0]), *heads), gap=1.5, keep=min(TOGETHER, len(table) - 1))
    for row in table[1:]:
        boxes = [Rect(left, 0.0, left + pitch, TALL) for left, runs in zip(lefts, row[1:], strict=True) if runs]
        yield TextRow((Cell(0.0, row[0]),), tall=TALL, boxes=tuple(boxes))


def fits(table: Table, wide: float) -> bool:
    """Whether all the boxes of a table have room for a number by hand."""
    return max(width(row[0], SIZE) for row in table) + APART + (len(table[0]) - 1) * NARROW <= wide


def ticked(row: TextRow) -> TextRow:
    """A row with a box to tick before it."""
    low = (row.height - TICK) / 2
    return replace(row, gap=0.5, tall=row.height, boxes=(Rect(0.0, low, TICK, low + TICK),))


def tightened(row: TextRow) -> TextRow:
    """The row where space is short: nearer to the one above, its boxes for numbers lower."""
    if row.tall > TIGHT:
        row = replace(row, tall=TIGHT, boxes=tuple(replace(box, top=TIGHT) for box in row.boxes))
    return replace(row, gap=row.gap / 2)
