"""Title blocks: what they say of a sheet, and how lettering stands in their cells."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.phrases import Said, said
from graphplan.sheet.lettering.lettering import CAPS, SIZE, sentence_runs, wrap
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import BORDER, FRAME, LETTERS
from graphplan.words.tongue import Tongue

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


@dataclass(frozen=True)
class TitleCell:
    """A cell of a title block: words of its own, and the value of a field of the scene or the page (see
    :func:`values`); where it lies is said in mm from the lower left corner of the block, if it lies anywhere by itself.
    """

    words: Said | str
    field: str = ""
    place: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    sizes: tuple[float, ...] = (SIZE,)
    bold: bool = False
    middle: bool = False


def values(scene: Scene, tongue: Tongue, page: Page) -> dict[str, str]:
    """What can be said of a page, by the name of the field that it comes from."""
    sheet = scene.sheet
    return {
        "title": scene.title, "source": scene.source, "language": tongue.code, "document": tongue(page.document),
        "sheet.k_s": tongue(page.scale), "format": page.paper.partition(" ")[0], "page": f"{page.number}/{page.of}",
        "number": str(page.number), "of": str(page.of),
        **{f"sheet.{name}": getattr(sheet, name) for name in ("owner", "number", "date", "drawn_by", "approved_by")},
    }  # fmt: skip


class TitleBlock(Protocol):
    """A title block of one scene; its width follows from the frame and the columns of words, its height from that."""

    def width(self, frame: Rect, pitch: float) -> float: ...
    def height(self, wide: float) -> float: ...
    def items(self, rect: Rect, page: Page) -> Iterator[Item]: ...


def stroke(start: Spot, end: Spot, wide: bool = False) -> Polyline:
    """A line of a title block."""
    return Polyline(FRAME if wide else BORDER, "paper", None, (start, end))


def filled(rect: Rect, text: str, sizes: Sequence[float] = (SIZE,), *, what: str, bold: bool = False,
           middle: bool = True) -> Iterator[Text]:
    """Lettering that fills a rectangle, half-way up, in the first of some sizes in which all its lines have room.

    Fails with `Refused` where they have not.
    """
    for size in sizes:
        lines = wrap(sentence_runs(text), size, rect.width - 2 * SIDE, bold)
        if len(lines) == 1 or LEADING * size * len(lines) <= rect.height:
            break
    else:
        raise Refused(what, "it is too long for its place in the title block", "fewer words")
    x, anchor = (rect.centre[0], "middle") if middle else (rect.left + SIDE, "start")
    top = rect.centre[1] + (len(lines) - 1) * LEADING * size / 2 - CAPS * size / 2
    for i, runs in enumerate(lines):
        yield Text(LETTERS, "text", None, (x, top - i * LEADING * size), runs, size, anchor, bold)
