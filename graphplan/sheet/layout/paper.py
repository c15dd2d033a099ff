"""Paper: where the plans, the text columns and the title block lie on a sheet.

Words stand in columns beside or under the plans where plans keep most of the page, else on pages of their own.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

from graphplan.errors import Refused
from graphplan.mechanism.presentation import SIZES
from graphplan.sheet.frames.frame import Frame
from graphplan.sheet.frames.title import TitleBlock
from graphplan.sheet.layout.divisions import CAPTION, EDGE, MARGIN
from graphplan.sheet.lettering.lettering import LetterSizes, letter_sizes
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.tolerances import EDGE_TOL
from graphplan.sheet.words.rows import Placed, TextRow, fill
from graphplan.sheet.words.tables import tightened

GUTTER, COLUMN = 5.0, 96.0

T = TypeVar("T")
Measure = Callable[[float], T]  # what something becomes for a width


@dataclass(frozen=True)
class Arrangement:
    """One way to divide a sheet: its panels by name, its text columns with their filling, and its title block.

    Where the words are on pages of their own it has no columns.
    """

    paper: str
    width: float
    height: float
    frame: Rect
    panels: dict[str, Rect]
    columns: tuple[Rect, ...]
    title: Rect
    rows: tuple[TextRow, ...] = ()

    @property
    def further(self) -> tuple[Rect, ...]:
        """The columns of a page of words, those over the title block ending above it: as wide as on the first page."""
        wide = self.columns[0].width if self.columns else self.letters.times * COLUMN
        count = max(1, int((self.frame.width + EDGE_TOL) // (wide + GUTTER)))
        return _columns(self.frame, count, self.title, wide if self.columns else None)

    @property
    def letters(self) -> LetterSizes:
        """How large its letters are."""
        return letter_sizes(self.paper)

    def set(self, words: Measure[Sequence[TextRow]]) -> tuple[TextRow, ...]:
        """Words set for its columns, in its letters."""
        return enlarged(words, self.letters.times)(self.further[0].width)

    @property
    def share(self) -> float:
        """The part of the page that plans take."""
        return sum(panel.area for panel in self.panels.values()) / (self.width * self.height)


def enlarged(words: Measure[Sequence[TextRow]], times: float) -> Measure[tuple[TextRow, ...]]:
    """Words in letters so many times as large."""
    return lambda wide: tuple(row.enlarged(times) for row in words(wide / times))


def room(panel: Rect) -> Rect:
    """Where a panel's figure may lie: below the caption."""
    return panel.inset(EDGE, EDGE, EDGE, CAPTION)


def inside(room: Rect) -> Rect:
    """Where the figure's own marks may lie: there is room for letters around them."""
    return room.inset(MARGIN, MARGIN, MARGIN, MARGIN)


def sheet_size(paper: str) -> tuple[float, float]:
    """Width and height of a sheet such as `A3` or `A4 portrait`."""
    name, _, way = paper.partition(" ")
    if name.upper() not in SIZES or way not in ("", "landscape", "portrait"):
        raise Refused(f"paper {paper!r}", "there is no such sheet", f"one of {', '.join(SIZES)}, or 'A4 portrait'")
    wide, high = SIZES[name.upper()]
    return (high, wide) if way == "portrait" else (wide, high)


MOST_OF_PAGE = 0.6  # what plans take of a page on which words stand


def arrangements(paper: str, divide: Divide, rows: Measure[Sequence[TextRow]] | None, frame: Frame,
                 title: TitleBlock) -> Iterator[Arrangement]:
    """The ways to divide one sheet: with columns that hold all the words, or without any where there are no `rows`.

    `divide` gives the panels in a region, of which the title block may take a corner.
    """
    wide, high = sheet_size(paper)
    space, title, times = frame.space(wide, high), title.on(paper), letter_sizes(paper).times
    words = rows and enlarged(rows, times)
    found = (*_beside(space, words, title, times * COLUMN), *_below(space, words, title, times * COLUMN)) if words \
        else _alone(space, title, times * COLUMN)
    for plans, columns, block in found:
        if panels := divide(plans, None if columns else block):
            filled = words(columns[0].width) if words else ()
            yield Arrangement(paper, wide, high, space, panels, columns, block, filled)


def words_page(paper: str, frame: Frame, title: TitleBlock) -> Arrangement:
    """A page of words alone."""
    wide, high = sheet_size(paper)
    space, column = frame.space(wide, high), letter_sizes(paper).times * COLUMN
    page = Arrangement(paper, wide, high, space, {}, (), lower_right(space, column + GUTTER, title.on(paper)))
    return replace(page, columns=page.further)


Division = tuple[Rect, tuple[Rect, ...], Rect]
Divide = Callable[[Rect, Rect | None], dict[str, Rect] | None]


def _alone(space: Rect, title: TitleBlock, column: float) -> Iterator[Division]:
    """Plans alone, with a title block as wide as a column, or as wide as it can be."""
    for block in dict.fromkeys(lower_right(space, pitch, title) for pitch in (column + GUTTER, space.width)):
        yield space, (), block


def _beside(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock, column: float) -> Iterator[Division]:
    """Text in as few columns as hold it, to the right of the plans, which end above a title block that is wider."""
    text = rows(column)
    pitch = column + GUTTER
    block = lower_right(space, pitch, title)
    for count in range(1, int(space.width // pitch) + 1):
        left = space.right - count * pitch
        columns = _columns(Rect(left, space.bottom, space.right, space.top), count, block)
        if fill(text, columns) is not None:
            foot = block.top if block.left < left else space.bottom
            yield Rect(space.left, foot, left, space.top), columns, block
            return


def _below(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock, column: float) -> Iterator[Division]:
    """Text in a strip under the plans, as low as it can be."""
    count = int((space.width + GUTTER) // (column + GUTTER))
    pitch = space.width / count
    text, block = rows(pitch - GUTTER), lower_right(space, pitch, title)
    strip, needed = max(block.height, 20.0), sum(row.height for row in text)
    covered = math.ceil(block.width / pitch - EDGE_TOL) * block.height
    while count * strip - covered < needed:  # whatever the columns, they cannot hold it
        strip += 4.0
    while strip < 0.75 * space.height:
        top = space.bottom + strip
        columns = _columns(Rect(space.left, space.bottom, space.right, top), count, block)
        if fill(text, columns) is not None:
            yield Rect(space.left, top, space.right, space.top), columns, block
            return
        strip += 4.0


def lower_right(space: Rect, pitch: float, title: TitleBlock) -> Rect:
    """Where the title block lies: in the lower right corner."""
    wide = title.width(space, pitch)
    return Rect(space.right - wide, space.bottom, space.right, space.bottom + title.height(wide))


def _columns(region: Rect, count: int, block: Rect, wide: float | None = None) -> tuple[Rect, ...]:
    """Columns that share a region equally, `wide` where that is told; those over the title block end above it."""
    pitch = region.width / count
    lefts = [region.left + i * pitch for i in range(count)]
    feet = [block.top if left + pitch > block.left + EDGE_TOL else region.bottom for left in lefts]
    slots = [Rect(left, foot, left + pitch, region.top) for left, foot in zip(lefts, feet, strict=True)]
    spare = pitch - GUTTER - wide if wide else 0.0
    return tuple(slot.inset(GUTTER / 2, 2.0, GUTTER / 2 + spare, 2.0) for slot in slots)


# ---- words that run from one page to the next -----------------------------------------------------------------------


def paged(rows: Sequence[TextRow], arrangement: Arrangement) -> Iterator[list[Placed]]:
    """The rows page by page: the columns of the arrangement, if it has any, then as many pages of columns as it takes.

    Fails with `Refused` where what must stand together is higher than a page.
    """
    columns, further = arrangement.columns, arrangement.further
    while rows:
        count = _fitting(rows, columns)
        if not count and columns is further:
            raise Refused(f"paper {arrangement.paper}", "a table does not fit on a page of it", "a larger sheet")
        yield fill(rows[:count], columns) or []
        rows, columns = rows[count:], further


def packed(rows: Sequence[TextRow], arrangement: Arrangement) -> list[list[Placed]]:
    """The rows page by page, closer to each other where that saves a page; fails as :func:`paged` does."""
    loose, tight = (list(paged(kind, arrangement)) for kind in (rows, [tightened(row) for row in rows]))
    return tight if len(tight) < len(loose) else loose


def _fitting(rows: Sequence[TextRow], columns: Sequence[Rect]) -> int:
    """How many of the rows the columns hold, not parted where rows keep together."""
    breaks, held = [0], 0
    for i, row in enumerate(rows):
        held = min(max(held, i + row.keep), len(rows) - 1)
        if held == i:
            breaks.append(i + 1)
    full = bisect_right(breaks, False, key=lambda count: fill(rows[:count], columns) is None)
    return breaks[full - 1]
