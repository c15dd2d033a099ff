"""Title blocks: what they say of a sheet, and how lettering stands in their cells."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from graphplan.errors import Refused
from graphplan.phrases import Said, said
from graphplan.sheet.lettering.lettering import CAPS, SIZE, sentence_runs, wrap
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import BORDER, FAINT, FRAME, LETTERS

CONSTRUCTION, SOLUTION, STRIP = said("Construction sheet"), said("Solution"), said("Film strip")
TASK, GUIDED = said("Task"), said("Guided construction")
DOCUMENTS = (CONSTRUCTION, SOLUTION, TASK, GUIDED, STRIP)
TITLE, HEADING, LEADING = 3.5, 1.8, 1.35
SIDE = 1.0  # mm that lettering keeps from the edges of its cell


@dataclass(frozen=True)
class Page:
    """What a title block says of one page: the kind of document, the page and how many there are, paper and scale."""

    document: Said
    paper: str
    scale: str
    number: int = 1
    of: int = 1

    @property
    def numbered(self) -> str:
        """Such as 2/3."""
        return f"{self.number}/{self.of}"

    @property
    def size(self) -> str:
        """The paper without the way in which it lies."""
        return self.paper.partition(" ")[0]


class TitleBlock(Protocol):
    """A title block of one scene; its width follows from the frame and the columns of words, its height from that."""

    def width(self, frame: Rect, pitch: float) -> float: ...
    def height(self, wide: float) -> float: ...
    def items(self, rect: Rect, page: Page) -> Iterator[Item]: ...


def stroke(start: Spot, end: Spot, wide: bool = False) -> Polyline:
    """A line of a title block."""
    return Polyline(FRAME if wide else BORDER, "paper", None, (start, end))


def heading(at: Spot, text: str, size: float = HEADING) -> Text:
    """What a cell tells, in small letters."""
    return Text(FAINT, "text", None, at, sentence_runs(text), size)


def filled(cell: Rect, text: str, sizes: Sequence[float] = (SIZE,), *, what: str, bold: bool = False,
           middle: bool = True) -> Iterator[Text]:
    """Lettering that fills a cell, half-way up, in the first of some sizes in which all its lines have room.

    Fails with `Refused` where they have not.
    """
    for size in sizes:
        lines = wrap(sentence_runs(text), size, cell.width - 2 * SIDE, bold)
        if len(lines) == 1 or LEADING * size * len(lines) <= cell.height:
            break
    else:
        raise Refused(what, "it is too long for its place in the title block", "fewer words")
    x, anchor = (cell.centre[0], "middle") if middle else (cell.left + SIDE, "start")
    top = cell.centre[1] + (len(lines) - 1) * LEADING * size / 2 - CAPS * size / 2
    for i, runs in enumerate(lines):
        yield Text(LETTERS, "text", None, (x, top - i * LEADING * size), runs, size, anchor, bold)
