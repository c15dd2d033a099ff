"""Paper: where the plans, the text columns and the title block lie on a sheet.

Words stand on pages of their own or, where that is asked for, in columns beside or under the plans. How plans share
their part of the page is division.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import TypeVar

from graphplan.errors import Refused
from graphplan.mechanism.units import SIZES
from graphplan.sheet.frames.frame import SheetFrame
from graphplan.sheet.frames.title import TitleBlock
from graphplan.sheet.layout.division import CAPTION, FACTS, MARGIN, PANEL_EDGE
from graphplan.sheet.layout.facts_block import Corner, FactPlace, FactRows, corners, divide_into_columns, facts_above
from graphplan.sheet.lettering.lettering import LetterSizes, letter_sizes
from graphplan.sheet.plates.display import Item, Rect
from graphplan.sheet.tolerances import EDGE_TOL
from graphplan.sheet.words.rows import Placed, TextRow, fill, fill_up, need_same_room, row_items, tighten

CAPTION_SIDE = 2.5  # mm of a panel on each side of its caption
GUTTER, COLUMN = 5.0, 96.0

T = TypeVar("T")
Measure = Callable[[float], T]  # what something becomes for a width


@dataclass(frozen=True)
class Arrangement:
    """A division of a sheet: its panels by name, its text columns with their rows, its title block, and what is given
    and found beside that.

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
    facts: tuple[FactPlace, ...] = ()
    fact_items: tuple[Item, ...] = ()

    @property
    def further_columns(self) -> tuple[Rect, ...]:
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
        return enlarge_words(words, self.letters.times)(self.further_columns[0].width)

    def with_facts(self, facts: FactRows) -> Arrangement:
        """The arrangement with these facts where they stand, in its letters."""
        placed_rows = (fill(rows, place.columns) or []
                       for rows, place in zip(self._fact_rows(facts), self.facts, strict=True))
        return replace(self, fact_items=tuple([item for rows in placed_rows for item in row_items(rows)]))

    def have_same_room(self, facts: FactRows, others: FactRows) -> bool:
        """Whether some facts need the room that others do, where facts stand."""
        return all(map(need_same_room, self._fact_rows(facts), self._fact_rows(others)))

    def _fact_rows(self, facts: FactRows) -> list[list[TextRow]]:
        """The rows of facts in each of their places."""
        return [place.rows(facts.enlarge(place.larger * self.letters.times)) for place in self.facts]

    @property
    def share(self) -> float:
        """The part of the page that plans take."""
        return sum(panel.area for panel in self.panels.values()) / (self.width * self.height)


@lru_cache(maxsize=8)
def enlarge_words(words: Measure[Sequence[TextRow]], times: float) -> Measure[tuple[TextRow, ...]]:
    """Words in letters so many times as large, those of a width once: they are tried on several papers."""
    return cache(lambda wide: tuple([row.enlarge(times) for row in words(wide / times)]))


def room(panel: Rect) -> Rect:
    """Where a panel's figure may lie: below the caption."""
    return panel.inset(PANEL_EDGE, PANEL_EDGE, PANEL_EDGE, CAPTION)


def room_for_marks(room: Rect) -> Rect:
    """Where the figure's own marks may lie: there is room for letters around them."""
    return room.inset(MARGIN, MARGIN, MARGIN, MARGIN)


def sheet_size(paper: str) -> tuple[float, float]:
    """Width and height of a sheet such as `A3` or `A4 portrait`."""
    name, _, orientation = paper.partition(" ")
    if name.capitalize() not in SIZES or orientation not in ("", "landscape", "portrait"):
        raise Refused(f"paper {paper!r}", "unknown sheet", f"choose one of {', '.join(SIZES)}, or 'A4 portrait'")
    wide, high = SIZES[name.capitalize()]
    return (high, wide) if orientation == "portrait" else (wide, high)


MIN_PLANS_SHARE = 0.6  # what plans take of a page on which facts have a part of their own


def arrangements(paper: str, divide: Divide, rows: Measure[Sequence[TextRow]] | None, frame: SheetFrame,
                 title: TitleBlock, facts: FactRows | None) -> Iterator[Arrangement]:
    """The ways to divide one sheet: with columns that hold all the words, or without any where there are no `rows`.

    `divide` gives the panels in a region, of which the title block and the facts may take a corner; without `facts`
    the block alone does.
    """
    wide, high = sheet_size(paper)
    space, title, times = frame.space(wide, high), title.on_paper(paper), letter_sizes(paper).times
    words, facts = rows and enlarge_words(rows, times), facts and facts.enlarge(times)
    divisions = (*_words_beside(space, words, title, times * COLUMN, facts),
                 *_words_below(space, words, title, times * COLUMN, facts)) if words \
        else _plans_alone(space, title, times * COLUMN, facts)
    for plans, columns, corner in divisions:
        if panels := divide(plans, None if columns else corner.rect):
            yield Arrangement(paper, wide, high, space, panels, columns, corner.title,
                              words(columns[0].width) if words else (), corner.facts)
    if facts and not words:
        yield from _with_facts_apart(paper, divide, space, lower_right(space, times * COLUMN + GUTTER, title), facts)


def _with_facts_apart(paper: str, divide: Divide, space: Rect, title: Rect, facts: FactRows) -> Iterator[Arrangement]:
    """The division with facts in a part of the sheet that is theirs, wherever it fits best among the plans; none where
    plans have too little of the page then."""
    panels = divide(space, title, facts.block_sizes) or {}
    block = panels.pop(FACTS, None)
    if block and (place := facts.place(block)):
        apart = Arrangement(paper, *sheet_size(paper), space, panels, (), title, facts=(place,))
        yield from [apart] if apart.share >= MIN_PLANS_SHARE else ()


def words_page(paper: str, frame: SheetFrame, title: TitleBlock) -> Arrangement:
    """A page of words alone."""
    wide, high = sheet_size(paper)
    space, column = frame.space(wide, high), letter_sizes(paper).times * COLUMN
    page = Arrangement(paper, wide, high, space, {}, (), lower_right(space, column + GUTTER, title.on_paper(paper)))
    return replace(page, columns=page.further_columns)


Division = tuple[Rect, tuple[Rect, ...], Corner]
Divide = Callable[..., dict[str, Rect] | None]


def _plans_alone(space: Rect, title: TitleBlock, column: float, facts: FactRows | None
                 ) -> Iterator[Division]:
    """Plans alone, with a title block as wide as a column, or as wide as it can be."""
    for block in dict.fromkeys(lower_right(space, pitch, title) for pitch in (column + GUTTER, space.width)):
        yield from ((space, (), corner) for corner in corners(space, block, facts))


def _words_beside(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock,
                  column: float, facts: FactRows | None) -> Iterator[Division]:
    """Text in as few columns as hold it, to the right of the plans, which end above a title block that is wider."""
    text = rows(column)
    pitch = column + GUTTER
    corner = facts_above(space, lower_right(space, pitch, title), facts)
    block = corner.rect
    for count in range(1, int(space.width // pitch) + 1):
        left = space.right - count * pitch
        columns = _columns(Rect(left, space.bottom, space.right, space.top), count, block)
        if fill(text, columns) is not None:
            foot = block.top if block.left < left else space.bottom
            yield Rect(space.left, foot, left, space.top), columns, corner
            return


def _words_below(space: Rect, rows: Measure[tuple[TextRow, ...]], title: TitleBlock,
                 column: float, facts: FactRows | None) -> Iterator[Division]:
    """Text in a strip under the plans, as low as it can be."""
    count = int((space.width + GUTTER) // (column + GUTTER))
    pitch = space.width / count
    text, corner = rows(pitch - GUTTER), facts_above(space, lower_right(space, pitch, title), facts)
    block = corner.rect
    strip, needed = max(block.height, 20.0), sum(row.height for row in text)
    covered = math.ceil(block.width / pitch - EDGE_TOL) * block.height
    while count * strip - covered < needed:  # whatever the columns, they cannot hold it
        strip += 4.0
    while strip < 0.75 * space.height:
        top = space.bottom + strip
        columns = _columns(Rect(space.left, space.bottom, space.right, top), count, block)
        if fill(text, columns) is not None:
            yield Rect(space.left, top, space.right, space.top), columns, corner
            return
        strip += 4.0


def lower_right(space: Rect, pitch: float, title: TitleBlock) -> Rect:
    """Where the title block lies: in the lower right corner."""
    wide = title.width(space, pitch)
    return Rect(space.right - wide, space.bottom, space.right, space.bottom + title.height(wide))


def _columns(region: Rect, count: int, block: Rect, wide: float | None = None) -> tuple[Rect, ...]:
    """Columns that share a region equally, `wide` where that is told; those over the title block end above it."""
    spare = region.width / count - GUTTER - wide if wide else 0.0
    return tuple(column.inset(0.0, 0.0, spare, 0.0)
                 for column in divide_into_columns(region, count, block, GUTTER / 2))


# ---- words that run from one page to the next -----------------------------------------------------------------------


def paginate(rows: Sequence[TextRow], arrangement: Arrangement) -> Iterator[list[Placed]]:
    """The rows page by page: the columns of the arrangement, if it has any, then as many pages of columns as it takes.

    Fails with `Refused` where what must stand together is higher than a page.
    """
    columns, further = arrangement.columns, arrangement.further_columns
    while rows:
        placed_rows = fill_up(rows, columns)
        count = _unparted_rows(rows, len(placed_rows))
        if not count and columns is further:
            raise Refused(f"paper {arrangement.paper}", "a table does not fit on a page of it", "a larger sheet")
        yield placed_rows[:count]
        rows, columns = rows[count:], further


def paginate_tightly(rows: Sequence[TextRow], arrangement: Arrangement) -> list[list[Placed]]:
    """The rows page by page, closer to each other where that saves a page; fails as :func:`paginate` does."""
    loose, tight = (list(paginate(kind, arrangement)) for kind in (rows, [tighten(row) for row in rows]))
    return tight if len(tight) < len(loose) else loose


def _unparted_rows(rows: Sequence[TextRow], count: int) -> int:
    """How many of the first rows, no more than so many, do not part where rows keep together."""
    whole, last_kept = 0, 0
    for i, row in enumerate(rows[:count]):
        last_kept = min(max(last_kept, i + row.keep), len(rows) - 1)
        whole = i + 1 if last_kept == i else whole
    return whole


def protocol_pages(paper: str, rows: Measure[Sequence[TextRow]], frame: SheetFrame,
                   title: TitleBlock) -> tuple[tuple[Arrangement, list[Placed]], ...]:
    """The words, on pages of their own: one of the smallest paper that holds them all, else several like the sheet's.
    """
    for name in frame.papers:
        page, is_last = words_page(name, frame, title), math.prod(sheet_size(name)) >= math.prod(sheet_size(paper))
        if is_last or _fit_on_page(page.set(rows), page.columns):
            break
    return tuple((page, placed_rows) for placed_rows in paginate_tightly(page.set(rows), page))


def _fit_on_page(rows: Sequence[TextRow], columns: Sequence[Rect]) -> bool:
    """Whether columns hold all the rows, if need be closer to each other."""
    return fill(rows, columns) is not None or fill([tighten(row) for row in rows], columns) is not None
