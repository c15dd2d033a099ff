"""Title blocks: what they say of a sheet, and how lettering stands in their cells, after ISO 7200 and GOST 2.104.

ISO: the title over its cells, in the lower right corner. The standard's block is 180 mm wide, as the frame of an
upright A4; on larger sheets it is no wider than the column of words above it. The projection symbol is left out: a plan
has none. GOST, form 1: 185 x 55 mm, with the widths and heights of the standard. A sheet of construction has no
material, so the source stands in that cell; what a construction has nothing to say of, such as its mass, stays empty.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import NamedTuple

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.phrases import Said, join, said, unit
from graphplan.sheet.lettering.lettering import (
    CAPS,
    HEADING,
    SIZE,
    Runs,
    letter_sizes,
    sentence_runs,
    tie_short_words,
    width,
    wrap,
)
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot, Text, move_item
from graphplan.sheet.plates.pens import BORDER, FAINT, FRAME, LETTERS
from graphplan.words.tongue import Tongue

CONSTRUCTION, SOLUTION, STRIP = said("Construction sheet"), said("Solution"), said("Film strip")
TASK, GUIDED = said("Task"), said("Guided construction")
DOCUMENTS = (CONSTRUCTION, SOLUTION, TASK, GUIDED, STRIP)
TITLE_SIZE, LEADING = 3.5, 1.35
CELL_PADDING_MM = 1.0  # mm that lettering keeps from the edges of its cell


@dataclass(frozen=True)
class Page:
    """Fields of one page's title block: the kind of document, the page and the number of pages, paper and scale."""

    document: Said
    paper: str
    scale: str
    number: int = 1
    of: int = 1

    @property
    def filled_by_hand(self) -> bool:
        """Whether a student writes on the page, and so who drew it."""
        return self.document in (TASK, GUIDED)

    @property
    def brief(self) -> Said:
        """Document, scale, paper and page number on one line."""
        return join((self.document, self.scale, self.paper.partition(" ")[0], f"{self.number}/{self.of}"), " · ")


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
    """Values of a page's fields, by name."""
    sheet = scene.sheet
    return {
        "title": scene.title, "source": scene.source, "language": tongue.code, "document": tongue(page.document),
        "sheet.k_s": tongue(page.scale), "format": page.paper.partition(" ")[0], "page": f"{page.number}/{page.of}",
        "number": str(page.number), "of": str(page.of),
        **{f"sheet.{name}": getattr(sheet, name)
           for name in ("owner", "number", "date", "drawn_by", "approved_by", "student", "group", "variant")},
    }  # fmt: skip


def stroke(start: Spot, end: Spot, wide: bool = False) -> Polyline:
    """A line of a title block."""
    return Polyline(FRAME if wide else BORDER, "paper", None, (start, end))


def fit_text(rect: Rect, text: str, sizes: Sequence[float], *, what: str, bold: bool,
             middle: bool) -> Iterator[Text]:
    """Lettering that fills a rectangle, half-way up, in the first of some sizes in which all its lines have room.

    Fails with `Refused` where they have not.
    """
    for size in sizes:
        lines = wrap(sentence_runs(text), size, rect.width - 2 * CELL_PADDING_MM, bold)
        if len(lines) == 1 or LEADING * size * len(lines) <= rect.height:
            break
    else:
        raise Refused(what, "it is too long for its place in the title block", "fewer words")
    x, anchor = (rect.centre[0], "middle") if middle else (rect.left + CELL_PADDING_MM, "start")
    top = rect.centre[1] + (len(lines) - 1) * LEADING * size / 2 - CAPS * size / 2
    for i, runs in enumerate(lines):
        yield Text(LETTERS, "text", None, (x, top - i * LEADING * size), runs, size, anchor, bold)


# ---- ISO 7200 ------------------------------------------------------------------------------------------------------

MAX_BLOCK_WIDTH, PITCH = 180.0, 1.45
PAD, CELL = 2.0, 1.2  # mm beside the title, and beside the lettering of a cell
CELL_HIGH = 9.0  # mm: of a cell with one line
FOOT, HEAD = 1.6, 3.2  # mm: the lowest base line of a cell above its edge, that of its heading below
MAX_TITLE_LINES = 3  # lines of a title in large letters; twice as many in small ones
LONGEST_RATIO, LONGEST_PER_LENGTH = "1 : 0000", "mu_s = 0.000"  # the longest, as a rule
OPTIONAL_CELLS = (  # which stand where the scene says them
    TitleCell(said("Legal owner"), "sheet.owner"), TitleCell(said("Number"), "sheet.number"),
    TitleCell(said("Date of issue"), "sheet.date"), TitleCell(said("Approved by"), "sheet.approved_by"),
)  # fmt: skip
STANDING_CELLS = (
    TitleCell(said("Document"), "document"), TitleCell(said("Drawn by"), "sheet.drawn_by"),
    TitleCell(said("Scale"), "sheet.k_s"), TitleCell(said("Format"), "format"), TitleCell(said("Sheet"), "page"),
    TitleCell(said("Language"), "language"),
)  # fmt: skip
CELLS_BY_HAND = (  # each with mm to write in, where the scene does not say it
    (TitleCell(said("Name"), "sheet.student"), 38.0), (TitleCell(said("Group"), "sheet.group"), 18.0),
    (TitleCell(said("Date")), 18.0), (TitleCell(said("Variant"), "sheet.variant"), 14.0),
)  # fmt: skip


class _FilledCell(NamedTuple):
    """Text of a cell. It is as wide as its text, or where that differs from page to page as the `longest` is, or where
    it is `least` mm wide, as that."""

    heading: str
    text: str
    longest: str = ""
    least: float = 0.0

    @property
    def natural(self) -> float:
        """The width that the heading and the text need on one line each."""
        return max(_long(self.heading) + 2 * CELL, self.least or _long(self.longest or self.text) + 2 * CELL)

    @property
    def letter_size(self) -> float:
        """The size of the lettering, smaller only where the text is longer than what should be the longest."""
        room = self.least - 2 * CELL if self.least else _long(self.longest)
        return SIZE * min(1.0, room / _long(self.text)) if room and self.text else SIZE

    def lines(self, wide: float) -> list[Runs]:
        """The lettering on lines."""
        runs = sentence_runs(self.text)
        return [runs] if self.longest or self.least else wrap(runs, SIZE, wide - 2 * CELL)


@dataclass(frozen=True)
class IsoBlock:
    """The title block of a scene after ISO 7200."""

    scene: Scene
    tongue: Tongue
    times: float = 1.0

    def on_paper(self, paper: str) -> IsoBlock:
        """The block in the letters of a sheet."""
        return replace(self, times=letter_sizes(paper).times)

    def width(self, frame: Rect, pitch: float) -> float:
        """The whole frame where the block has room for no more, else the pitch of the columns."""
        return frame.width if frame.width <= MAX_BLOCK_WIDTH else min(pitch, MAX_BLOCK_WIDTH)

    def height(self, wide: float) -> float:
        """The height of the block, the same for every page."""
        return self.times * self._height(wide / self.times)

    def items(self, rect: Rect, page: Page) -> Iterator[Item]:
        """The block in its rectangle."""
        whole = Rect(0.0, 0.0, rect.width / self.times, rect.height / self.times)
        return (move_item(item, rect.left, rect.bottom, self.times) for item in self._items(whole, page))

    def _height(self, wide: float) -> float:
        """The height of a block so wide in the letters in which it is set, whatever its page."""
        longest = self._longest()["sheet.k_s"]
        return max(self._page_height(wide, Page(document, "A0", longest, 10, 10))
                   for document in (CONSTRUCTION, GUIDED))

    def _page_height(self, wide: float, page: Page) -> float:
        rows = sum(_high(row, wide) for row in self._rows(wide, page))
        return rows + 2 * PAD + sum(PITCH * size for _, size, _ in self._title(wide, page))

    def _items(self, rect: Rect, page: Page) -> Iterator[Item]:
        """The block in the letters in which it is set."""
        yield stroke((rect.left, rect.bottom), (rect.left, rect.top), wide=True)
        yield stroke((rect.left, rect.top), (rect.right, rect.top), wide=True)
        y = rect.top - PAD
        for runs, size, bold in self._title(rect.width, page):
            y -= PITCH * size
            yield Text(LETTERS, "text", None, (rect.left + PAD, y + 0.45 * size), runs, size, "start", bold)
        y = rect.bottom
        for row in reversed([*self._rows(rect.width, page)]):
            high = _high(row, rect.width)
            yield from _cells(row, Rect(rect.left, y, rect.right, y + high))
            y += high
            yield stroke((rect.left, y), (rect.right, y))

    def _title(self, wide: float, page: Page) -> list[tuple[Runs, float, bool]]:
        """The wrapped title and source with their sizes; a long title is smaller. Refused where it is much too long.

        On a page that is filled in by hand the rest of the cells stand instead of the source.
        """
        room = wide - 2 * PAD
        sizes = HEADING / self.times, TITLE_SIZE, SIZE
        *large_lines, small = (wrap(sentence_runs(self.scene.title), size, room, bold=True) for size in sizes)
        subtitle = self.tongue(page.brief) if page.filled_by_hand else self.scene.source
        source = wrap(sentence_runs(tie_short_words(subtitle)), SIZE, room)
        for name, lines in (("title", small), ("source", source)):
            if len(lines) > 2 * MAX_TITLE_LINES:
                raise Refused(name, f"it is too long for a title block {wide:g} mm wide", "fewer words")
        fitting = (pair for pair, most in zip(zip(large_lines, sizes, strict=False), (1, MAX_TITLE_LINES), strict=True)
                   if len(pair[0]) <= most)
        lines, size = next(fitting, (small, SIZE))
        return [*((runs, size, True) for runs in lines), *((runs, SIZE, False) for runs in source)]

    # ---- cells -----------------------------------------------------------------------------------------------------

    def _rows(self, wide: float, page: Page) -> Iterator[list[_FilledCell]]:
        """The cells in rows: first those that a scene fills or not, then those of every sheet."""
        texts, longest = values(self.scene, self.tongue, page), self._longest()
        optional, always = ([_FilledCell(self.tongue(cell.words), texts[cell.field], longest.get(cell.field, ""))
                             for cell in cells] for cells in (OPTIONAL_CELLS, STANDING_CELLS))
        by_hand = [_FilledCell(self.tongue(cell.words), texts.get(cell.field, ""), least=least)
                   for cell, least in CELLS_BY_HAND]
        for cells in ([cell for cell in optional if cell.text], by_hand if page.filled_by_hand else always):
            row: list[_FilledCell] = []
            for cell_text in cells:
                if row and sum(neighbour.natural for neighbour in (*row, cell_text)) > wide:
                    yield row
                    row = []
                row.append(cell_text)
            if row:
                yield row

    def _longest(self) -> dict[str, str]:
        """The longest that fields have, as a rule, where they are not the same on every page."""
        ratio, per_length = LONGEST_RATIO, join((LONGEST_PER_LENGTH, unit(f"mm/{self.scene.units.length}")), " ")
        if self.scene.sheet.convention == "drawn":
            ratio = self.tongue(join((LONGEST_RATIO, per_length), "; "))
        document = max(map(self.tongue, DOCUMENTS), key=_long)
        return {"document": document, "sheet.k_s": ratio, "format": "A0", "page": "00/00"}


def _long(text: str, size: float = SIZE) -> float:
    """Length of a text."""
    return width(sentence_runs(text), size)


def _high(row: list[_FilledCell], wide: float) -> float:
    """The height of a row: cells that stand alone may have more than one line."""
    return CELL_HIGH + PITCH * SIZE * (max(len(cell.lines(wide)) for cell in row) - 1)


def _cells(row: list[_FilledCell], rect: Rect) -> Iterator[Item]:
    """A row of cells, which share the width that they do not need."""
    spare = max(rect.width - sum(cell.natural for cell in row), 0.0) / len(row)
    x = rect.left
    for i, cell in enumerate(row):
        if i:
            yield stroke((x, rect.bottom), (x, rect.top))
        yield Text(FAINT, "text", None, (x + CELL, rect.top - HEAD), sentence_runs(cell.heading), SIZE)
        lines = cell.lines(rect.width)
        for k, runs in enumerate(reversed(lines)):
            at = x + CELL, rect.bottom + FOOT + k * PITCH * SIZE
            yield Text(LETTERS, "text", None, at, runs, cell.letter_size)
        x += cell.natural + spare


# ---- GOST 2.104 ----------------------------------------------------------------------------------------------------

GOST_WIDTH, GOST_HEIGHT, GOST_ROW = 185.0, 55.0, 5.0
CHANGES = (0.0, 7.0, 17.0, 40.0, 55.0, 65.0)  # the edges of the columns of changes; the first two make that of roles
SMALL_SIZES = (SIZE, 2.2, 1.8)  # of our own words, in narrow cells
LIT, MASS, SCALE = (135.0, 35.0, 150.0, 40.0), (150.0, 35.0, 167.0, 40.0), (167.0, 35.0, GOST_WIDTH, 40.0)

HEADS = said("Rev."), said("Sheet"), said("Doc. No."), said("Sign."), said("Date")
ROLES = (said("Drawn"), "sheet.drawn_by"), (said("Checked"), ""), (said("Tech. check"), ""), ("", ""), (
    said("Std. check"), ""), (said("Approved"), "sheet.approved_by")
ROLES_BY_HAND = (said("Name"), "sheet.student"), (said("Checked"), ""), (said("Group"), "sheet.group"), (
    said("Variant"), "sheet.variant"), *ROLES[4:]
CELLS = (  # from left to right, by columns; those of the roles stand before them
    *(TitleCell(head, "", (left, 30.0, right, 35.0), SMALL_SIZES, middle=True)
      for head, (left, right) in zip(HEADS, pairwise(CHANGES), strict=True)),
    TitleCell("", "sheet.date", (55.0, 25.0, 65.0, 30.0), SMALL_SIZES, middle=True),
    TitleCell("", "sheet.number", (65.0, 40.0, GOST_WIDTH, GOST_HEIGHT), (5.0, TITLE_SIZE, SIZE), middle=True),
    TitleCell("", "title", (65.0, 20.0, 135.0, 40.0), (TITLE_SIZE, 3.0, SIZE), bold=True, middle=True),
    TitleCell("", "source", (65.0, 0.0, 135.0, 15.0), middle=True),
    TitleCell("", "sheet.owner", (135.0, 0.0, GOST_WIDTH, 15.0), (TITLE_SIZE, SIZE), middle=True),
    TitleCell("", "document", (65.0, 15.0, 135.0, 20.0), SMALL_SIZES, middle=True),
    TitleCell(said("Lit."), "", LIT, SMALL_SIZES, middle=True),
    TitleCell(said("Mass"), "", MASS, SMALL_SIZES, middle=True),
    TitleCell(said("Scale"), "", SCALE, SMALL_SIZES, middle=True),
    TitleCell("", "sheet.k_s", (167.0, 20.0, GOST_WIDTH, 35.0), SMALL_SIZES, middle=True),
    TitleCell(said("Sheet"), "number", (135.0, 15.0, 155.0, 20.0), SMALL_SIZES),
    TitleCell(said("Sheets"), "of", (155.0, 15.0, GOST_WIDTH, 20.0), SMALL_SIZES),
)
HORIZONTAL_LINES = (  # the lines across: how high, from where to where, and whether they are wide
    *((GOST_ROW * row, 0.0, 65.0, row in (6, 7)) for row in range(1, 11)),
    (GOST_HEIGHT, 0.0, GOST_WIDTH, True), (40.0, 65.0, GOST_WIDTH, True), (15.0, 65.0, GOST_WIDTH, True),
    (35.0, 135.0, GOST_WIDTH, True),
    (20.0, 135.0, GOST_WIDTH, True),
)  # fmt: skip
VERTICAL_LINES = (  # the lines upwards: where, from how high to how high, and whether they are wide
    (0.0, 0.0, GOST_HEIGHT, True), (7.0, 30.0, GOST_HEIGHT, True), *((x, 0.0, GOST_HEIGHT, True) for x in CHANGES[2:]),
    (135.0, 0.0, 40.0, True), (140.0, 20.0, 35.0, False), (145.0, 20.0, 35.0, False), (150.0, 20.0, 40.0, True),
    (155.0, 15.0, 20.0, True), (167.0, 20.0, 40.0, True),
)  # fmt: skip


@dataclass(frozen=True)
class GostBlock:
    """The title block of a scene after GOST 2.104."""

    scene: Scene
    tongue: Tongue

    def on_paper(self, paper: str) -> GostBlock:
        """Return the block; it is the same on every sheet."""
        return self

    def width(self, frame: Rect, pitch: float) -> float:
        """The width of the block, whatever the frame."""
        return GOST_WIDTH

    def height(self, wide: float) -> float:
        """The height of the block, whatever its texts."""
        return GOST_HEIGHT

    def items(self, rect: Rect, page: Page) -> Iterator[Item]:
        """The block in its rectangle."""
        x, y, texts = rect.left, rect.bottom, values(self.scene, self.tongue, page)
        for at, start, end, wide in HORIZONTAL_LINES:
            yield stroke((x + start, y + at), (x + end, y + at), wide)
        for at, start, end, wide in VERTICAL_LINES:
            yield stroke((x + at, y + start), (x + at, y + end), wide)
        for cell in (*_roles(ROLES_BY_HAND if page.filled_by_hand else ROLES), *CELLS):
            left, low, right, high = cell.place
            text = " ".join(filter(None, (self.tongue(cell.words), texts.get(cell.field, ""))))
            place = Rect(x + left, y + low, x + right, y + high)
            name = cell.field or cell.words
            yield from fit_text(place, text, cell.sizes, what=name, bold=cell.bold, middle=cell.middle)


def _roles(roles: Sequence[tuple[Said | str, str]]) -> Iterator[TitleCell]:
    """The cells of those who have a part in the sheet, each role with its name."""
    for i, (role, name) in enumerate(roles):
        low, high = 25.0 - GOST_ROW * i, 30.0 - GOST_ROW * i
        yield TitleCell(role, "", (0.0, low, 17.0, high), SMALL_SIZES)
        yield TitleCell("", name, (17.0, low, 40.0, high), (*SMALL_SIZES, 1.2))


TitleBlock = IsoBlock | GostBlock  # its width follows from the frame and the pitch of columns, its height from that
