"""Words that run from one page to the next: beside the plans first, then over whole pages of the same paper."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from graphplan.errors import Refused
from graphplan.sheet.layout.paper import GUTTER, Arrangement
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.words.answer_boxes import tightened
from graphplan.sheet.words.rows import Placed, TextRow, fill


def paged(rows: Sequence[TextRow], arrangement: Arrangement) -> Iterator[list[Placed]]:
    """The rows page by page: the columns of the arrangement, then as many pages of columns as it takes.

    Fails with `Refused` where what must stand together is higher than a page.
    """
    columns, further = arrangement.columns, _whole_page(arrangement)
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


def _whole_page(arrangement: Arrangement) -> tuple[Rect, ...]:
    """Columns of the same width over a whole page, those over the title block ending above it."""
    frame, title, wide = arrangement.frame, arrangement.title, arrangement.columns[0].width
    count = max(1, int(frame.width // (wide + GUTTER)))
    lefts = [frame.left + i * frame.width / count + GUTTER / 2 for i in range(count)]
    feet = [title.top if left + wide > title.left else frame.bottom for left in lefts]
    return tuple(Rect(left, foot + 2.0, left + wide, frame.top - 2.0) for left, foot in zip(lefts, feet, strict=True))
