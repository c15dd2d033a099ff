"""What is given and what was found, as it stands on a sheet: in rows, and where these have a part of the page.

A plate says problem and answer on its first page: in the room that plans leave free (see free_room.py), else above the
title block or to the left of it. What is found is set in the heaviest letters of the page, in columns whose width does
not hang on the drawing errors, so that a sheet is composed once.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

from graphplan.phrases import Said, said
from graphplan.sheet.layout.measures import (
    BLOCK_COLUMNS,
    BLOCK_WIDTHS_MM,
    FACT_COLUMN_MM,
    FACT_GAP_MM,
    MIN_ROWS_TOGETHER,
    PADDING_MM,
    ROW_STEP_MM,
)
from graphplan.sheet.lettering.lettering import SIZE, Runs, sentence_runs, tie_short_words, tie_words, width
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.tolerances import EDGE_TOL
from graphplan.sheet.words.facts import SaidFact, topic_texts
from graphplan.sheet.words.rows import Cell, TextRow, fill, paragraph_rows
from graphplan.words.tongue import Tongue

FACTS = GIVEN, FOUND = "given", "found"  # layers, and in an SVG public groups by these names
LONGEST_ERROR = " ± >99 %"  # for which there is room behind each result


@dataclass(frozen=True, eq=False)
class FactRows:
    """The facts of a sheet in a tongue, set for columns of any width, each width once, in letters so many `times` as
    large as on A4; `remarks` on the pose follow what is given. `names` are those of points, which may be Greek."""

    say: Tongue
    given: Sequence[SaidFact]
    found: Sequence[SaidFact]
    remarks: Sequence[Said] = ()
    names: tuple[str, ...] = ()
    times: float = 1.0
    _sizes: dict[float, FactRows] = field(default_factory=dict)  # the same facts in other letters
    _set: dict[float, list[TextRow]] = field(default_factory=dict)

    def __bool__(self) -> bool:
        return bool(self.given or self.found)

    def __call__(self, wide: float) -> list[TextRow]:
        """All rows for columns so wide."""
        wide = round(wide, 9)  # columns of one width differ by rounding
        if wide not in self._set:
            inner = wide / self.times
            self._set[wide] = [row.enlarge(self.times)
                               for row in (*self._given_rows(inner), *self._found_rows(inner))]
        return self._set[wide]

    def enlarge(self, times: float) -> FactRows:
        """The facts in other letters, each size set once."""
        if times not in self._sizes:
            self._sizes[times] = replace(self, times=times, _set={})
        return self._sizes[times]

    @property
    def least_width(self) -> float:
        """The narrowest column in which each result has a line."""
        return self.times * self._cells[1]

    @property
    def block_sizes(self) -> list[tuple[float, float]]:
        """Least heights of a block of all facts, for some widths."""
        just = (count * (self.least_width + FACT_GAP_MM) - FACT_GAP_MM for count in BLOCK_COLUMNS)
        widths = [wide for wide in (*just, *(self.times * wide for wide in BLOCK_WIDTHS_MM))
                  if wide >= self.least_width]
        highs = (sum([row.gap + row.height for row in self(wide)]) for wide in widths)
        return [(wide + 2 * PADDING_MM, high + 2 * PADDING_MM) for wide, high in zip(widths, highs, strict=True)]

    def place(self, block: Rect) -> FactPlace | None:
        """All facts in a block; None if they do not fit."""
        column = block.inset(PADDING_MM, PADDING_MM, PADDING_MM, PADDING_MM)
        return FactPlace(FACTS, (column,)) if fill(self(column.width), (column,)) is not None else None

    @cached_property
    def _paragraphs(self) -> list[Runs]:
        texts = [tie_words(self.say(text)) for text in topic_texts(self.given)]
        texts += [tie_short_words(self.say(remark)) for remark in self.remarks]
        return [sentence_runs(text, self.names) for text in texts]

    @cached_property
    def _cells(self) -> tuple[list[Runs], float]:
        """The results, and the width in which each has room whatever its error."""
        room = width(sentence_runs(LONGEST_ERROR), SIZE, bold=True)
        longest = max((width(self._runs(fact.quantity), SIZE, bold=True) for fact in self.found), default=0.0)
        return [self._runs(fact.text) for fact in self.found], longest + room

    def _given_rows(self, wide: float) -> Iterator[TextRow]:
        """Yield the rows of given facts, a paragraph a topic."""
        if self._paragraphs:
            yield self._heading(said("Given"), GIVEN)
        for runs in self._paragraphs:
            yield from paragraph_rows(runs, wide, 0.0, layer=GIVEN)

    def _found_rows(self, wide: float) -> Iterator[TextRow]:
        """The results in as many columns as there is room for, down the columns."""
        results, cell = self._cells
        if not results:
            return
        columns = max(1, int((wide + FACT_GAP_MM + EDGE_TOL) // (cell + FACT_GAP_MM)))
        high, pitch = -(-len(results) // columns), (wide + FACT_GAP_MM) / columns
        tail = high - MIN_ROWS_TOGETHER if high >= 2 * MIN_ROWS_TOGETHER else high
        yield self._heading(said("Found"), FOUND, min(MIN_ROWS_TOGETHER, high))
        for line in range(high):
            cells = tuple(Cell(pitch * column, runs, bold=True) for column, runs in enumerate(results[line::high]))
            yield TextRow(cells, layer=FOUND, keep=high - 1 - line if line >= tail else 0)

    def _heading(self, text: Said, layer: str, keep: int = 1) -> TextRow:
        return TextRow((Cell(0.0, sentence_runs(self.say(text)), bold=True),), gap=1.5, keep=keep, layer=layer)

    def _runs(self, text: Said) -> Runs:
        return sentence_runs(self.say(text), self.names)


class FactPlace(NamedTuple):
    """Place of the facts of some layers: columns of one width, and the enlargement of their letters."""

    layers: tuple[str, ...]
    columns: tuple[Rect, ...]
    larger: float = 1.0

    def rows(self, facts: FactRows) -> list[TextRow]:
        """The rows that stand there."""
        return [row for row in facts(self.columns[0].width) if row.layer in self.layers]


class Corner(NamedTuple):
    """The lower right corner of a first page: all of it, the title block, and the facts."""

    rect: Rect
    title: Rect
    facts: tuple[FactPlace, ...] = ()


def corners(space: Rect, title: Rect, facts: FactRows | None) -> list[Corner]:
    """The ways in which facts and title block share the corner: the smallest, the lowest, and facts above the block."""
    if not facts:
        return [Corner(title, title)]
    room = title.left - space.left
    steps = range(1, int(room // FACT_COLUMN_MM))
    lefts = dict.fromkeys([title.left, *(title.left - k * FACT_COLUMN_MM for k in steps), space.left])
    shared = [_lowest_corner(space, left, title, facts) for left in lefts]
    shared.sort(key=lambda corner: corner.rect.area)
    return [*dict.fromkeys((shared[0], min(shared, key=lambda corner: corner.rect.height),
                            min(shared, key=lambda corner: corner.rect.width)))]


def facts_above(space: Rect, title: Rect, facts: FactRows | None) -> Corner:
    """The facts above the title block; the title block alone if there are no facts, or the page is too low."""
    return _lowest_corner(space, title.left, title, facts) if facts else Corner(title, title)


def _lowest_corner(space: Rect, left: float, title: Rect, facts: FactRows) -> Corner:
    """The lowest corner from `left` on that holds the facts in columns; the title block alone if no corner does."""
    corner = Rect(left, title.bottom, title.right, title.top)
    count = int(corner.width // max(FACT_COLUMN_MM, facts.least_width + 2 * PADDING_MM))
    rows = facts(corner.width / count - 2 * PADDING_MM) if count else []
    spare = sum([row.height for row in rows]) / max(1, count) - corner.height  # lower columns cannot hold them
    corner = corner._replace(top=corner.top + ROW_STEP_MM * max(0, math.ceil(spare / ROW_STEP_MM - EDGE_TOL)))
    while rows and corner.top <= space.top:
        columns = divide_into_columns(corner, count, title, PADDING_MM)
        if fill(rows, columns) is not None:
            return Corner(corner, title, (FactPlace(FACTS, columns),))
        corner = corner._replace(top=corner.top + ROW_STEP_MM)
    return Corner(title, title)


def divide_into_columns(region: Rect, count: int, block: Rect, margin: float) -> tuple[Rect, ...]:
    """Columns that share a region equally; those over a block in its corner end above it."""
    pitch = region.width / count
    lefts = [region.left + i * pitch for i in range(count)]
    feet = [block.top if left + pitch > block.left + EDGE_TOL else region.bottom for left in lefts]
    return tuple(Rect(left, foot, left + pitch, region.top).inset(margin, PADDING_MM, margin, PADDING_MM)
                 for left, foot in zip(lefts, feet, strict=True))
