"""Paper: where the plans, the text columns and the title block lie on a sheet.

The smallest sheet is taken on which the whole step list stands in legible lettering and the plans keep a good size.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from graphplan.errors import Refused
from graphplan.mechanism.presentation import SIZES
from graphplan.sheet.frames.frame import Frame
from graphplan.sheet.frames.title import TitleBlock
from graphplan.sheet.layout.divisions import divisions
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.words.rows import TextRow, fill

GUTTER, COLUMN = 5.0, 96.0
SLACK = 1e-6  # mm by which edges that should be one may differ
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
    rows: tuple[TextRow, ...]


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
    paper: str, needs: Mapping[str, float], rows: Measure[Sequence[TextRow]], frame: Frame, title: TitleBlock
) -> Iterator[Arrangement]:
    """The ways to divide one sheet that hold all the text; `needs` says how much room plans want beside each other."""
    wide, high = sheet_size(paper)
    space = frame.space(wide, high)
    for plans, columns, block in (*_beside(space, rows, title), *_below(space, rows, title)):
        for division in divisions(plans, needs):
            yield Arrangement(paper, wide, high, space, division, columns, block, tuple(rows(columns[0].width)))


Division = tuple[Rect, tuple[Rect, ...], Rect]


def _beside(space: Rect, rows: Measure[Sequence[TextRow]], title: TitleBlock) -> Iterator[Division]:
    """Text in as few columns as hold it, to the right of the plans, which end above a title block that is wider."""
    text = rows(COLUMN)
    pitch = COLUMN + GUTTER
    block = lower_right(space, pitch, title)
    for count in range(1, int(space.width // pitch) + 1):
        left = space.right - count * pitch
        columns = _columns(Rect(left, space.bottom, space.right, space.top), count, block)
        if fill(text, columns) is not None:
            foot = block.top if block.left < left else space.bottom
            yield Rect(space.left, foot, left, space.top), columns, block
            return


def _below(space: Rect, rows: Measure[Sequence[TextRow]], title: TitleBlock) -> Iterator[Division]:
    """Text in a strip under the plans, as low as it can be."""
    count = int((space.width + GUTTER) // (COLUMN + GUTTER))
    pitch = space.width / count
    text, block = rows(pitch - GUTTER), lower_right(space, pitch, title)
    strip, needed = max(block.height, 20.0), sum(row.height for row in text)
    covered = math.ceil(block.width / pitch - SLACK) * block.height
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


def _columns(region: Rect, count: int, block: Rect) -> tuple[Rect, ...]:
    """Equal columns; those over the title block end above it."""
    pitch = region.width / count
    lefts = [region.left + i * pitch for i in range(count)]
    feet = [block.top if left + pitch > block.left + SLACK else region.bottom for left in lefts]
    slots = [Rect(left, foot, left + pitch, region.top) for left, foot in zip(lefts, feet, strict=True)]
    return tuple(slot.inset(GUTTER / 2, 2.0, GUTTER / 2, 2.0) for slot in slots)
