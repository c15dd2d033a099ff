"""What stands in the text columns: rows of lettering and of boxes, tables, and how rows run down column after column.

Tables have names to the left and numbers in columns; two stand side by side where there is room.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from typing import Any, NamedTuple

from graphplan.phrases import Said, Unknown, arrange, digits, figures, in_any_case, unit
from graphplan.sheet.lettering.lettering import (
    ANCHORS,
    CAPS,
    HEADING,
    SIZE,
    Runs,
    name_runs,
    sentence_runs,
    width,
    wrap,
)
from graphplan.sheet.plates.display import Item, Polygon, Polyline, Rect, Text, move_item
from graphplan.sheet.plates.pens import BORDER, LETTERS, THIN
from graphplan.sheet.tolerances import EDGE_TOL, ZERO_TOL
from graphplan.sheet.words.lengths import magnitude
from graphplan.words.tongue import Tongue

LEADING = 1.42  # of the letter size, base line to base line
RULE_DROP, RULE_PITCH = 0.36, 0.16  # of the letter size: rules under the base line


class Cell(NamedTuple):
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

    def enlarge(self, times: float) -> TextRow:
        """The row in letters so many times as large; those of headings are no larger than headings should be."""
        if times == 1.0:
            return self
        cells = tuple([Cell(times * cell.x, cell.runs, cell.anchor, cell.bold, cell.rules) for cell in self.cells])
        boxes = tuple([box.times(times) for box in self.boxes])
        figure = tuple([move_item(item, 0.0, 0.0, times) for item in self.figure])
        size = max(min(times * self.size, HEADING), self.size)
        gap, tall = times * self.gap, times * self.tall
        return TextRow(cells, size, gap, self.step, self.keep, self.layer, tall, boxes, figure)

    @property
    def height(self) -> float:
        return self.tall or self.size * LEADING

    @property
    def right(self) -> float:
        """The right end of the row."""
        ends = (cell.x + width(cell.runs, self.size, cell.bold) * (1.0 - ANCHORS[cell.anchor]) for cell in self.cells)
        return max((*ends, *(box.right for box in self.boxes), self.tall if self.figure else 0.0), default=0.0)


def paragraph_rows(runs: Runs, wide: float, indent: float, number: str = "", step: int | None = None,
                   layer: str = "text") -> Iterator[TextRow]:
    """A paragraph in a column of a width: as it is, or with a number from which its lines hang, so far indented."""
    hangs = indent if number else 0.0
    lines = wrap(runs, SIZE, wide - hangs)
    for i, line in enumerate(lines):
        label = (Cell(hangs - 1.6, sentence_runs(number), "end"),) if number and i == 0 else ()
        yield TextRow((*label, Cell(hangs, line)), step=step, keep=min(3, len(lines) - 1 - i), layer=layer)


Placed = tuple[TextRow, float, float]


def fill(rows: Sequence[TextRow], columns: Sequence[Rect]) -> list[Placed] | None:
    """Place rows down the columns, each with its left edge and base line; None if the columns cannot hold them."""
    if sum([row.height for row in rows]) > sum(column.height for column in columns) + EDGE_TOL:
        return None
    placed_rows = fill_up(rows, columns)
    return placed_rows if len(placed_rows) == len(rows) else None


def fill_up(rows: Sequence[TextRow], columns: Sequence[Rect]) -> list[Placed]:
    """Place rows down the columns as far as these hold them."""
    placed_rows: list[Placed] = []
    places = iter(columns)
    column = next(places, None)
    y, kept = column.top if column else 0.0, 0
    for i, row in enumerate(rows):
        if i >= kept:
            kept = _block_end(rows, i) if row.keep else i + 1
            block = row.height + sum([follower.gap + follower.height for follower in rows[i + 1 : kept]])
            while column is not None and y - (row.gap if y < column.top else 0.0) - block < column.bottom:
                column = next(places, None)
                y = column.top if column else 0.0
        if column is None:
            break
        y -= (row.gap if y < column.top else 0.0) + row.height  # no gap at the head of a column
        placed_rows.append((row, column.left, y + row.size * (LEADING - 1)))
    return placed_rows


def _block_end(rows: Sequence[TextRow], first: int) -> int:
    """The end of the block of rows that must stand in one column with a row."""
    end = i = first
    while i <= end and i < len(rows):
        end, i = max(end, i + rows[i].keep), i + 1
    return end + 1


def row_items(placed: Sequence[Placed]) -> Iterator[Item]:
    """The rows as items; the lettering of a tall one stands half-way up."""
    for row, x, y in placed:
        foot = y - row.size * (LEADING - 1)
        yield from (move_item(item, x, foot) for item in row.figure)
        for box in row.boxes:
            rect = Rect(x + box.left, foot + box.bottom, x + box.right, foot + box.top)
            yield Polygon(BORDER, "blanks", row.step, rect.corners)
        base = foot + (row.tall - CAPS * row.size) / 2 if row.tall else y
        for cell in row.cells:
            yield Text(LETTERS, row.layer, row.step, (x + cell.x, base), cell.runs, row.size, cell.anchor, cell.bold)
            for before, through, times in cell.rules:
                left, right = (x + cell.x + width(runs, row.size, cell.bold) for runs in (before, through))
                for k in range(times):
                    low = base - (RULE_DROP + k * RULE_PITCH) * row.size
                    yield Polyline(THIN, row.layer, row.step, ((left, low), (right, low)))


class Deviation(NamedTuple):
    """Error of a drawn result: in its own unit, and in mm of paper if it is one drawn vector; infinite if no pencil
    follows the drawing."""

    value: float
    mm: float | None = None

    @property
    def text(self) -> Said:
        """The deviation in figures; a dash where it is unbounded."""
        if math.isinf(self.value):
            return figures("–")
        return figures(digits(self.value, 2) + (f" ({digits(self.mm, 2)})" if self.mm is not None else ""))


@dataclass(frozen=True)
class Deviations:
    """The deviation of every result by kind and name, what is said of the drawing model and the worst step, and a
    remark on the pose where that makes all results poor."""

    results: Mapping[str, Mapping[str, Deviation]] = field(default_factory=dict)
    text: str = ""
    remark: Said | None = None

    def of_kinds(self, *kinds: str) -> dict[str, Deviation]:
        """The deviations of some kinds, by name."""
        return {name: deviation for kind in kinds for name, deviation in self.results.get(kind, {}).items()}


COLUMN_GAP = 3.0  # mm between two columns
MAX_ROWS_TOGETHER = 15  # rows of a table stand in one column
Table = list[list[Runs]]
Off = Mapping[str, Deviation]  # how far off results are drawn, by name; empty where that is not told


def vector_table(say: Tongue, what: str, letter: str, unit: str, values: Mapping[str, Any], order: Iterable[str],
                 off: Off,
                 beside: Mapping[str, Any], spoken: Callable[[str], str]) -> Table:
    """Components, magnitudes and deviations, each row with its name first; empty without values.

    The head has the object, the letter and the unit; names may be `spoken` in another way.
    """
    head = [sentence_runs(text) for text in (what, f"{letter}_x", f"{letter}_y", f"|{letter}| {unit}")]
    components = {name: (*values[name], magnitude(*values[name])) for name in order if name in values}
    return _table(say, head, components, _larger(largest_size(values), largest_size(beside)), off, spoken)


def coordinate_table(say: Tongue, head: Sequence[str], values: Mapping[str, Any], off: Off,
                     spoken: Callable[[str], str]) -> Table:
    """Coordinates with their deviations, or components of headings; empty without values."""
    return _table(say, [*map(sentence_runs, head)], values, largest_size(values), off, spoken)


def scalar_table(say: Tongue, what: str, name: str, unit: str, values: Mapping[str, Any], order: Iterable[str],
                 off: Off) -> Table:
    """Single numbers with their deviations, each row with its name first; empty without values."""
    head = [sentence_runs(what), (*name_runs(name), *sentence_runs(f" {unit}"))]
    numbers = {name: (values[name],) for name in order if name in values}
    return _table(say, head, numbers, reduce(_larger, map(abs, values.values()), 0.0), off)


def zero_rounding(values: Mapping[str, Mapping[str, Any]], reach: float, kappa: float) -> dict[str, dict[str, Any]]:
    """The results, with rates set to zero that are rounding errors beside others of their kind, or as they are drawn.

    What is unknown is not weighed.
    """
    results = {kind: {**named} for kind, named in values.items()}
    for order, rate in enumerate(("velocity", "acceleration"), 1):
        for vectors in (results.get(kind, {}) for kind in (rate, f"slide {rate}")):
            for name, vector in vectors.items():
                size = magnitude(*vector)
                if not isinstance(size, Unknown) and size <= ZERO_TOL * reach / kappa**order:
                    vectors[name] = (0.0, 0.0)
    fastest = reduce(_larger, map(abs, values.get("omega", {}).values()), 1 / kappa)
    for turning, kind, scale in (("omega", "velocity", fastest), ("alpha", "acceleration", fastest * fastest)):
        least = ZERO_TOL * _larger(largest_size(values.get(kind, {})) / reach, scale)
        results |= {turning: {name: rate if isinstance(least, Unknown) or isinstance(rate, Unknown) or abs(rate) > least
                              else 0.0 for name, rate in values[turning].items()}} if turning in values else {}
    return results


def _table(say: Tongue, head: list[Runs], values: Mapping[str, tuple[float, ...]], largest: float, off: Off,
           spoken: Callable[[str], str] = str) -> Table:
    """A table of numbers under their head; `largest` is the largest number of their kind."""
    rows = [[name_runs(spoken(name)), *(number_runs(say, x, largest) for x in numbers)]
            for name, numbers in values.items()]
    return with_deviations(say, [head, *rows], list(values), off) if rows else []


def with_deviations(say: Tongue, table: Table, names: Sequence[str], off: Off) -> Table:
    """A table with a last column for the deviations of its rows, where they are told."""
    deviations = [off.get(name) for name in names]
    if not any(deviations):
        return table
    on_paper = any(deviation is not None and deviation.mm is not None for deviation in deviations)
    head = say(arrange("± ({0})", unit("mm"))) if on_paper else "±"
    column = [head, *("" if deviation is None else say(deviation.text) for deviation in deviations)]
    return [[*row, sentence_runs(cell)] for row, cell in zip(table, column, strict=True)]


def largest_size(values: Mapping[Any, Any]) -> float:
    """The size of the largest vector."""
    return reduce(_larger, (magnitude(*value) for value in values.values()), 0.0)


def _larger(a: float, b: float) -> float:
    """The larger of two numbers, by arithmetic alone, as they may be unknown."""
    return (a + b + abs(a - b)) / 2


def number_runs(say: Tongue, value: float, largest: float) -> Runs:
    """A number of a table; what is only rounding beside its largest is zero."""
    return sentence_runs(say(in_any_case(lambda: digits(value if abs(value) > ZERO_TOL * largest else 0.0))))


def join_tables(one: Table, two: Table, fits: Callable[[Table], bool]) -> list[Table]:
    """Two tables as one where the names are the same and it fits, else those of the two that say anything."""
    if one and two and [row[0] for row in one] == [row[0] for row in two]:
        joined = [[*left, *right[1:]] for left, right in zip(one, two, strict=True)]
        if fits(joined):
            return [joined]
    return [table for table in (one, two) if table]


def is_narrow(table: Table, wide: float) -> bool:
    """Whether a table is no wider than this."""
    return sum(_widths(table)) <= wide


def _widths(table: Table) -> list[float]:
    return [max(width(row[i], SIZE) for row in table) + COLUMN_GAP for i in range(len(table[0]))]


def table_rows(table: Table) -> Iterator[TextRow]:
    """Names to the left, numbers to the right of their columns."""
    edges = [0.0]
    for wide in _widths(table) if table else ():
        edges.append(edges[-1] + wide)
    for i, row in enumerate(table):
        numbers = [Cell(edge - COLUMN_GAP / 2, runs, "end") for edge, runs in zip(edges[2:], row[1:], strict=True)]
        gap, keep = (1.0, min(MAX_ROWS_TOGETHER, len(table) - 1)) if i == 0 else (0.0, 0)
        yield TextRow((Cell(0.0, row[0]), *numbers), gap=gap, keep=keep)


BOX_HEIGHT, TIGHT_BOX_HEIGHT = 6.5, 5.2  # mm: a box has room for a number by hand, also where space is short
MIN_BOX_WIDTH = 11.0  # mm: the least that a number by hand needs
TICK_SIZE, TICKED_INDENT = 2.2, 12.0  # mm: the box of a step, and where its sentence begins


# ---- answer boxes: to fill in by hand, or to tick -------------------------------------------------------------------


def answer_rows(table: Table, wide: float) -> Iterator[TextRow]:
    """A table to fill in: its head and names as they are, and an empty box for every number."""
    names = max(width(row[0], SIZE) for row in table) + COLUMN_GAP
    pitch = min((wide - names) / (len(table[0]) - 1), 2.4 * MIN_BOX_WIDTH)
    lefts = [names + i * pitch for i in range(len(table[0]) - 1)]
    heads = [Cell(left + pitch / 2, runs, "middle") for left, runs in zip(lefts, table[0][1:], strict=True)]
    yield TextRow((Cell(0.0, table[0][0]), *heads), gap=1.5, keep=min(MAX_ROWS_TOGETHER, len(table) - 1))
    for row in table[1:]:
        boxes = [Rect(left, 0.0, left + pitch, BOX_HEIGHT) for left, runs in zip(lefts, row[1:], strict=True) if runs]
        yield TextRow((Cell(0.0, row[0]),), tall=BOX_HEIGHT, boxes=tuple(boxes))


def boxes_fit(table: Table, wide: float) -> bool:
    """Whether all the boxes of a table have room for a number by hand."""
    return max(width(row[0], SIZE) for row in table) + COLUMN_GAP + (len(table[0]) - 1) * MIN_BOX_WIDTH <= wide


def with_tick_box(row: TextRow) -> TextRow:
    """A row with a box to tick before it."""
    low = (row.height - TICK_SIZE) / 2
    return replace(row, gap=0.5, tall=row.height, boxes=(Rect(0.0, low, TICK_SIZE, low + TICK_SIZE),))


def tighten(row: TextRow) -> TextRow:
    """The row where space is short: nearer to the one above, its boxes for numbers lower."""
    if row.boxes and row.tall > TIGHT_BOX_HEIGHT:
        row = replace(row, tall=TIGHT_BOX_HEIGHT, boxes=tuple(box._replace(top=TIGHT_BOX_HEIGHT) for box in row.boxes))
    return replace(row, gap=row.gap / 2)
