"""Paper: sheet sizes, the frame, and where the plans, the text columns and the title block lie.

The smallest sheet is taken on which the whole step list stands in legible lettering and the plans keep a good size.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from graphplan.errors import Refused
from graphplan.sheet.display import Rect
from graphplan.sheet.divisions import divisions
from graphplan.sheet.rows import Row, fill

SIZES = {"A4": (297.0, 210.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0), "A0": (1189.0, 841.0)}
BINDING, EDGE, GUTTER, COLUMN = 20.0, 10.0, 5.0, 96.0
CAPTION, MARGIN = 11.0, 9.0  # a panel's caption strip, and what is kept free for letters around its figure

T = TypeVar("T")
Measure = Callable[[float], T]  # what something becomes for a width


@dataclass(frozen=True)
class Arrangement:
    """One way to divide a sheet: its panels by name, its text columns with their filling, and its title block."""

    paper: str
    width: float
    height: float
    frame: Rect
    panels: dict[str, Rect]
    columns: tuple[Rect, ...]
    title: Rect
    rows: tuple[Row, ...]


def room(panel: Rect) -> Rect:
    """Where a panel's figure may lie: below the caption."""
    return panel.inset(0.5, 0.5, 0.5, CAPTION)


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


def arrangements(
    paper: str, needs: Mapping[str, float], rows: Measure[Sequence[Row]], title: Measure[float]
) -> Iterator[Arrangement]:
    """The ways to divide one sheet that hold all the text.

    `needs` says how much room each plan wants beside the others; `title` gives the title block's height for its width.
    """
    wide, high = sheet_size(paper)
    frame = Rect(BINDING, EDGE, wide - EDGE, high - EDGE)
    for plans, columns, block in (*_beside(frame, rows, title), *_below(frame, rows, title)):
        for division in divisions(plans, needs):
            yield Arrangement(paper, wide, high, frame, division, columns, block, tuple(rows(columns[0].width)))


Division = tuple[Rect, tuple[Rect, ...], Rect]


def _beside(frame: Rect, rows: Measure[Sequence[Row]], title: Measure[float]) -> Iterator[Division]:
    """Text in as few columns as hold it, to the right of the plans."""
    text = rows(COLUMN)
    pitch = COLUMN + GUTTER
    for count in range(1, int(frame.width // pitch) + 1):
        left = frame.right - count * pitch
        block = Rect(left + (count - 1) * pitch, frame.bottom, frame.right, frame.bottom + title(pitch))
        columns = _columns(Rect(left, frame.bottom, frame.right, frame.top), count, block)
        if fill(text, columns) is not None:
            yield Rect(frame.left, frame.bottom, left, frame.top), columns, block
            return


def _below(frame: Rect, rows: Measure[Sequence[Row]], title: Measure[float]) -> Iterator[Division]:
    """Text in a strip under the plans, as low as it can be."""
    count = int((frame.width + GUTTER) // (COLUMN + GUTTER))
    pitch = frame.width / count
    text, high = rows(pitch - GUTTER), title(pitch)
    block = Rect(frame.right - pitch, frame.bottom, frame.right, frame.bottom + high)
    strip, needed = max(high, 20.0), sum(row.height for row in text)
    while count * strip - high < needed:  # whatever the columns, they cannot hold it
        strip += 4.0
    while strip < 0.75 * frame.height:
        top = frame.bottom + strip
        columns = _columns(Rect(frame.left, frame.bottom, frame.right, top), count, block)
        if fill(text, columns) is not None:
            yield Rect(frame.left, top, frame.right, frame.top), columns, block
            return
        strip += 4.0


def _columns(region: Rect, count: int, block: Rect) -> tuple[Rect, ...]:
    """Equal columns; the last one ends above the title block."""
    pitch = region.width / count
    lefts, feet = [region.left + i * pitch for i in range(count)], [region.bottom] * (count - 1) + [block.top]
    slots = [Rect(left, foot, left + pitch, region.top) for left, foot in zip(lefts, feet, strict=True)]
    return tuple(slot.inset(GUTTER / 2, 2.0, GUTTER / 2, 2.0) for slot in slots)
