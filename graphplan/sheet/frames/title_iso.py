"""The title block after ISO 7200: the title over its cells, in the lower right corner.

The standard's block is 180 mm wide, as the frame of an upright A4; on larger sheets it is no wider than the column of
words above it. The projection symbol is left out: a plan has none.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.phrases import joined, said, unit
from graphplan.sheet.frames.title import CONSTRUCTION, DOCUMENTS, HEADING, TITLE, Page, TitleCell, stroke, values
from graphplan.sheet.lettering.lettering import SIZE, Runs, sentence_runs, width, wrap
from graphplan.sheet.plates.display import Item, Rect, Text
from graphplan.sheet.plates.pens import FAINT, LETTERS
from graphplan.words.tongue import Tongue

WIDEST, LEADING = 180.0, 1.45
PAD, CELL = 2.0, 1.2  # mm beside the title, and beside the lettering of a cell
HIGH = 9.0  # mm: of a cell with one line
FOOT, HEAD = 1.9, 2.8  # mm: the lowest base line of a cell above its edge, that of its heading below
MOST = 3  # lines of a title in large letters; twice as many in small ones
RATIO, PER_LENGTH = "1 : 0000", "mu_s = 0.000"  # the longest, as a rule
ANY_PAGE = Page(CONSTRUCTION, "A0", RATIO)
OPTIONAL = (  # which stand where the scene says them
    TitleCell(said("Legal owner"), "sheet.owner"), TitleCell(said("Number"), "sheet.number"),
    TitleCell(said("Date of issue"), "sheet.date"), TitleCell(said("Approved by"), "sheet.approved_by"),
)  # fmt: skip
ALWAYS = (
    TitleCell(said("Document"), "document"), TitleCell(said("Drawn by"), "sheet.drawn_by"),
    TitleCell(said("Scale"), "sheet.k_s"), TitleCell(said("Format"), "format"), TitleCell(said("Sheet"), "page"),
    TitleCell(said("Language"), "language"),
)  # fmt: skip


class _Filled(NamedTuple):
    """What a cell tells. It is as wide as its text or, where that differs from page to page, as the `longest` is."""

    heading: str
    text: str
    longest: str

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
    """The title block of a scene after ISO 7200."""

    scene: Scene
    tongue: Tongue

    def width(self, frame: Rect, pitch: float) -> float:
        """The whole frame where the block has room for no more, else the pitch of the columns."""
        return frame.width if frame.width <= WIDEST else min(pitch, WIDEST)

    def height(self, wide: float) -> float:
        """The same for every page."""
        rows = sum(_high(row, wide) for row in self._rows(wide))
        return rows + 2 * PAD + sum(LEADING * size for _, size, _ in self._title(wide))

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

    def _rows(self, wide: float, page: Page = ANY_PAGE) -> Iterator[list[_Filled]]:
        """The cells in rows: first those that a scene fills or not, then those of every sheet."""
        found, longest = values(self.scene, self.tongue, page), self._longest()
        for cells in ([cell for cell in OPTIONAL if found[cell.field]], ALWAYS):
            row: list[_Filled] = []
            for cell in cells:
                made = _Filled(self.tongue(cell.words), found[cell.field], longest.get(cell.field, ""))
                if row and sum(other.natural for other in (*row, made)) > wide:
                    yield row
                    row = []
                row.append(made)
            if row:
                yield row

    def _longest(self) -> dict[str, str]:
        """The longest that fields have, as a rule, where they are not the same on every page."""
        ratio, per_length = RATIO, joined((PER_LENGTH, unit(f"mm/{self.scene.units.length}")), " ")
        if self.scene.sheet.convention == "drawn":
            ratio = self.tongue(joined((RATIO, per_length), "; "))
        document = max(map(self.tongue, DOCUMENTS), key=_long)
        return {"document": document, "sheet.k_s": ratio, "format": "A0", "page": "00/00"}


def _long(text: str, size: float = SIZE) -> float:
    """How long a text is."""
    return width(sentence_runs(text), size)


def _high(row: list[_Filled], wide: float) -> float:
    """The height of a row: cells that stand alone may have more than one line."""
    return HIGH + LEADING * SIZE * (max(len(cell.lines(wide)) for cell in row) - 1)


def _cells(row: list[_Filled], rect: Rect) -> Iterator[Item]:
    """A row of cells, which share the width that they do not need."""
    spare = max(rect.width - sum(cell.natural for cell in row), 0.0) / len(row)
    x = rect.left
    for i, cell in enumerate(row):
        if i:
            yield stroke((x, rect.bottom), (x, rect.top))
        yield Text(FAINT, "text", None, (x + CELL, rect.top - HEAD), sentence_runs(cell.heading), HEADING)
        lines = cell.lines(rect.width)
        for k, runs in enumerate(reversed(lines)):
            at = x + CELL, rect.bottom + FOOT + k * LEADING * SIZE
            yield Text(LETTERS, "text", None, at, runs, cell.size)
        x += cell.natural + spare
