"""The title block after GOST 2.104, form 1: 185 x 55 mm, with the widths and heights of the standard.

A sheet of construction has no material, so the source stands in that cell; what a construction has nothing to say of,
such as its mass, stays empty.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from graphplan.mechanism.model import Scene
from graphplan.phrases import said
from graphplan.sheet.frames.title import HEADING, TITLE, Page, TitleCell, filled, stroke, values
from graphplan.sheet.lettering.lettering import SIZE
from graphplan.sheet.plates.display import Item, Rect
from graphplan.words.tongue import Tongue

WIDE, HIGH, ROW = 185.0, 55.0, 5.0
CHANGES = (0.0, 7.0, 17.0, 40.0, 55.0, 65.0)  # the edges of the columns of changes; the first two make that of roles
SMALL = (SIZE, 2.2, HEADING)  # of our own words, in narrow cells
LETTER, MASS, SCALE = (135.0, 35.0, 150.0, 40.0), (150.0, 35.0, 167.0, 40.0), (167.0, 35.0, WIDE, 40.0)

HEADS = said("Rev."), said("Sheet"), said("Doc. No."), said("Sign."), said("Date")
ROLES = (said("Drawn"), "sheet.drawn_by"), (said("Checked"), ""), (said("Tech. check"), ""), ("", ""), (
    said("Std. check"), ""), (said("Approved"), "sheet.approved_by")
CELLS = (  # from left to right, by columns
    *(TitleCell(head, "", (left, 30.0, right, 35.0), SMALL, middle=True)
      for head, (left, right) in zip(HEADS, pairwise(CHANGES), strict=True)),
    *(TitleCell(role, "", (0.0, 25.0 - ROW * i, 17.0, 30.0 - ROW * i), SMALL) for i, (role, _) in enumerate(ROLES)),
    *(TitleCell("", name, (17.0, 25.0 - ROW * i, 40.0, 30.0 - ROW * i)) for i, (_, name) in enumerate(ROLES)),
    TitleCell("", "sheet.date", (55.0, 25.0, 65.0, 30.0), SMALL, middle=True),
    TitleCell("", "sheet.number", (65.0, 40.0, WIDE, HIGH), (5.0, TITLE, SIZE), middle=True),
    TitleCell("", "title", (65.0, 20.0, 135.0, 40.0), (TITLE, 3.0, SIZE), bold=True, middle=True),
    TitleCell("", "source", (65.0, 0.0, 135.0, 15.0), middle=True),
    TitleCell("", "sheet.owner", (135.0, 0.0, WIDE, 15.0), (TITLE, SIZE), middle=True),
    TitleCell("", "document", (65.0, 15.0, 135.0, 20.0), SMALL, middle=True),
    TitleCell(said("Lit."), "", LETTER, SMALL, middle=True),
    TitleCell(said("Mass"), "", MASS, SMALL, middle=True),
    TitleCell(said("Scale"), "", SCALE, SMALL, middle=True),
    TitleCell("", "sheet.k_s", (167.0, 20.0, WIDE, 35.0), SMALL, middle=True),
    TitleCell(said("Sheet"), "number", (135.0, 15.0, 155.0, 20.0), SMALL),
    TitleCell(said("Sheets"), "of", (155.0, 15.0, WIDE, 20.0), SMALL),
)
LEVEL = (  # the lines across: how high, from where to where, and whether they are wide
    *((ROW * row, 0.0, 65.0, row in (6, 7)) for row in range(1, 11)),
    (HIGH, 0.0, WIDE, True), (40.0, 65.0, WIDE, True), (15.0, 65.0, WIDE, True), (35.0, 135.0, WIDE, True),
    (20.0, 135.0, WIDE, True),
)  # fmt: skip
UPRIGHT = (  # the lines upwards: where, from how high to how high, and whether they are wide
    (0.0, 0.0, HIGH, True), (7.0, 30.0, HIGH, True), *((x, 0.0, HIGH, True) for x in CHANGES[2:]),
    (135.0, 0.0, 40.0, True), (140.0, 20.0, 35.0, False), (145.0, 20.0, 35.0, False), (150.0, 20.0, 40.0, True),
    (155.0, 15.0, 20.0, True), (167.0, 20.0, 40.0, True),
)  # fmt: skip


@dataclass(frozen=True)
class GostBlock:
    """The title block of a scene after GOST 2.104."""

    scene: Scene
    tongue: Tongue

    def width(self, frame: Rect, pitch: float) -> float:
        """The same whatever the frame."""
        return WIDE

    def height(self, wide: float) -> float:
        """The same whatever it says."""
        return HIGH

    def items(self, rect: Rect, page: Page) -> Iterator[Item]:
        """The block in its rectangle."""
        x, y, found = rect.left, rect.bottom, values(self.scene, self.tongue, page)
        for at, start, end, wide in LEVEL:
            yield stroke((x + start, y + at), (x + end, y + at), wide)
        for at, start, end, wide in UPRIGHT:
            yield stroke((x + at, y + start), (x + at, y + end), wide)
        for cell in CELLS:
            left, low, right, high = cell.place
            text = " ".join(filter(None, (self.tongue(cell.words), found.get(cell.field, ""))))
            place = Rect(x + left, y + low, x + right, y + high)
            what = cell.field or cell.words
            yield from filled(place, text, cell.sizes, what=what, bold=cell.bold, middle=cell.middle)
