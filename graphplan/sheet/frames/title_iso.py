"""The title block after ISO 7200: the title over its cells, in the lower right corner.

The standard's block is 180 mm wide, as the frame of an upright A4; on larger sheets it is no wider than the column of
words above it. The projection symbol is left out: a plan has none.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.phrases import joined, said, unit
from graphplan.sheet.frames.title import DOCUMENTS, HEADING, TITLE, Page, heading, stroke
from graphplan.sheet.lettering.lettering import SIZE, Runs, sentence_runs, width, wrap
from graphplan.sheet.plates.display import Item, Rect, Text
from graphplan.sheet.plates.pens import LETTERS
from graphplan.words.tongue import Tongue

WIDEST, LEADING = 180.0, 1.45
PAD, CELL = 2.0, 1.2  # mm beside the title, and beside the lettering of a cell
HIGH = 9.0  # mm: of a cell with one line
FOOT, HEAD = 1.9, 2.8  # mm: the lowest base line of a cell above its edge, that of its heading below
MOST = 3  # lines of a title in large letters; twice as many in small ones
RATIO, PER_LENGTH, PAPER, NUMBERED = "1 : 0000", "mu_s = 0.000", "A0", "00/00"  # the longest, as a rule


@dataclass(frozen=True)
class Cell:
    """What a cell tells. It is as wide as its text or, where that differs from page to page, as the `longest` is."""

    heading: str
    text: str
    longest: str = ""

    @property
    def natural(self) -> float:
        """The width in which all stands on one line."""
        return max(_long(self.heading, HEADING), _long(self.longest or self.text)) + 2 * CELL

    @property
    def size(self) -> float:
        """The size of the lettering, smaller only where the text is longer than what should be the longest."""
        return SIZE * min(1.0, _long(self.longest) / _long(self.text)) if self.longest and self.text else SIZE

    def lines(self, wide: float) -> list[Runs]:
        """The lettering on lines."""
        runs = sentence_runs(self.text)
        return [runs] if self.longest else wrap(runs, SIZE, wide - 2 * CELL)


@dataclass(frozen=True)
class IsoBlock:
    """The title block of a scene after ISO 7200; its height is worked out once for a width."""

    scene: Scene
    tongue: Tongue
    _heights: dict[float, float] = field(default_factory=dict)

    def width(self, frame: Rect, pitch: float) -> float:
        """The whole frame where the block has room for no more, else the pitch of the columns."""
        return frame.width if frame.width <= WIDEST else min(pitch, WIDEST)

    def height(self, wide: float) -> float:
        """The same for every page."""
        if wide not in self._heights:
            rows = sum(_high(row, wide) for row in self._rows(wide, None))
            self._heights[wide] = rows + 2 * PAD + sum(LEADING * size for _, size, _ in self._title(wide))
        return self._heights[wide]

    def items(self, rect: Rect, page: Page) -> Iterator[Item]:
        """The block in its rectangle."""
        yield stroke((rect.left, rect.bottom), (rect.left, rect.top), wide=True)
        yield stroke((rect.left, rect.top), (rect.right, rect.top), wide=True)
        y = rect.top - PAD
        for runs, size, bold in self._title(rect.width):
            y -= LEADING * size
            yield Text(LETTERS, "text", None, (rect.left + PAD, y + 0.45 * size), runs, size, "start", bold)
        y -= PAD
        for row in self._rows(rect.width, page):
            high = _high(row, rect.width)
            yield stroke((rect.left, y), (rect.right, y))
            yield from _cells(row, Rect(rect.left, y - high, rect.right, y))
            y -= high

    def _title(self, wide: float) -> list[tuple[Runs, float, bool]]:
        """The wrapped title and source with their sizes; a long title is smaller. Refused where it is much too long."""
        room = wide - 2 * PAD
        large, small = (wrap(sentence_runs(self.scene.title), size, room, bold=True) for size in (TITLE, SIZE))
        source = wrap(sentence_runs(self.scene.source), SIZE, room)
        for name, lines in (("title", small), ("source", source)):
            if len(lines) > 2 * MOST:
                raise Refused(name, f"it is too long for a title block {wide:g} mm wide", "fewer words")
        lines, size = (large, TITLE) if len(large) <= MOST else (small, SIZE)
        return [*((runs, size, True) for runs in lines), *((runs, SIZE, False) for runs in source)]

    # ---- cells -----------------------------------------------------------------------------------------------------

    def _rows(self, wide: float, page: Page | None) -> Iterator[list[Cell]]:
        """The cells in rows: first those that a scene fills or not, then those of every sheet."""
        for cells in (self._optional(), self._always(page)):
            row: list[Cell] = []
            for cell in cells:
                if row and sum(other.natural for other in (*row, cell)) > wide:
                    yield row
                    row = []
                row.append(cell)
            if row:
                yield row

    def _optional(self) -> Iterator[Cell]:
        sheet = self.scene.sheet
        fields = ((said("Legal owner"), sheet.owner), (said("Number"), sheet.number),
                  (said("Date of issue"), sheet.date), (said("Approved by"), sheet.approved_by))  # fmt: skip
        yield from (Cell(self.tongue(told), text) for told, text in fields if text)

    def _always(self, page: Page | None) -> Iterator[Cell]:
        say = self.tongue
        kinds = [say(document) for document in DOCUMENTS]
        yield Cell(say(said("Document")), say(page.document) if page else "", max(kinds, key=_long))
        yield Cell(say(said("Drawn by")), self.scene.sheet.drawn_by)
        yield Cell(say(said("Scale")), say(page.scale) if page else "", self._ratio)
        yield Cell(say(said("Format")), page.size if page else "", PAPER)
        yield Cell(say(said("Sheet")), page.numbered if page else "", NUMBERED)
        yield Cell(say(said("Language")), say.code)


    @property
    def _ratio(self) -> str:
        """The longest scale, as a rule."""
        if self.scene.sheet.convention != "drawn":
            return RATIO
        return self.tongue(joined((RATIO, joined((PER_LENGTH, unit(f"mm/{self.scene.units.length}")), " ")), "; "))


def _long(text: str, size: float = SIZE) -> float:
    """How long a text is."""
    return width(sentence_runs(text), size)


def _high(row: list[Cell], wide: float) -> float:
    """The height of a row: cells that stand alone may have more than one line."""
    return HIGH + LEADING * SIZE * (max(len(cell.lines(wide)) for cell in row) - 1)


def _cells(row: list[Cell], rect: Rect) -> Iterator[Item]:
    """A row of cells, which share the width that they do not need."""
    spare = max(rect.width - sum(cell.natural for cell in row), 0.0) / len(row)
    x = rect.left
    for i, cell in enumerate(row):
        if i:
            yield stroke((x, rect.bottom), (x, rect.top))
        yield heading((x + CELL, rect.top - HEAD), cell.heading)
        lines = cell.lines(rect.width)
        for k, runs in enumerate(reversed(lines)):
            at = x + CELL, rect.bottom + FOOT + k * LEADING * SIZE
            yield Text(LETTERS, "text", None, at, runs, cell.size)
        x += cell.natural + spare
