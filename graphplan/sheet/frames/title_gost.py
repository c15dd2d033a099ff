"""The title block after GOST 2.104, form 1: 185 x 55 mm, with the widths and heights of the standard.

A sheet of construction has no material, so the source stands in that cell; what a construction has nothing to say of,
such as its mass, stays empty.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

from graphplan.mechanism.model import Scene
from graphplan.phrases import joined, said
from graphplan.sheet.frames.title import HEADING, TITLE, Page, filled, stroke
from graphplan.sheet.lettering.lettering import SIZE
from graphplan.sheet.plates.display import Item, Rect
from graphplan.words.tongue import Tongue

WIDE, HIGH, ROW = 185.0, 55.0, 5.0
CHANGES = (0.0, 7.0, 17.0, 40.0, 55.0, 65.0)  # the edges of the columns of changes; the first two make that of roles
ROLES = 30.0  # the height of the rows of those who sign; the heads of the columns are over it
MIDDLE, RIGHT = 65.0, 135.0  # where title and material begin, and where they end
LOW, TOP = 15.0, 40.0  # the height of material and organisation, and the foot of the designation
VALUES = (135.0, 150.0, 167.0, WIDE)  # the edges of letter, mass and scale
PAGES = 155.0  # the edge between the sheet's number and that of all sheets
SMALL = (SIZE, 2.2, HEADING)  # of our own words, in narrow cells


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
        x, y = rect.left, rect.bottom
        for (left, low), (right, high), wide in _lines():
            yield stroke((x + left, y + low), (x + right, y + high), wide)
        place = _Place(x, y)
        yield from self._signatures(place)
        yield from self._told(place)
        yield from self._page(place, page)

    def _signatures(self, place: _Place) -> Iterator[Item]:
        """The heads of the columns of changes, and those who sign, one a row from the top."""
        heads = said("Rev."), said("Sheet"), said("Doc. No."), said("Sign."), said("Date")
        for told, (left, right) in zip(heads, pairwise(CHANGES), strict=True):
            yield from self._small(told, place(left, ROLES, right, ROLES + ROW))
        sheet = self.scene.sheet
        signed = ((said("Drawn"), sheet.drawn_by, "drawn_by"), (said("Checked"), "", ""),
                  (said("Tech. check"), "", ""), None, (said("Std. check"), "", ""),
                  (said("Approved"), sheet.approved_by, "approved_by"))  # fmt: skip
        for i, row in enumerate(signed, 1):
            if row is not None:
                low = ROLES - i * ROW
                yield from self._small(row[0], place(0.0, low, CHANGES[2], low + ROW), middle=False)
                name = place(CHANGES[2], low, CHANGES[3], low + ROW)
                yield from filled(name, row[1], what=f"sheet.{row[2]}", middle=False)
        if sheet.date:
            yield from filled(place(CHANGES[4], ROLES - ROW, CHANGES[5], ROLES), sheet.date, SMALL, what="sheet.date")

    def _told(self, place: _Place) -> Iterator[Item]:
        """Designation, title, source and organisation."""
        sheet = self.scene.sheet
        yield from filled(place(MIDDLE, TOP, WIDE, HIGH), sheet.number, (5.0, TITLE, SIZE), what="sheet.number")
        yield from filled(place(MIDDLE, LOW + ROW, RIGHT, TOP), self.scene.title, (TITLE, 3.0, SIZE), what="title",
                          bold=True)  # fmt: skip
        yield from filled(place(MIDDLE, 0.0, RIGHT, LOW), self.scene.source, what="source")
        yield from filled(place(RIGHT, 0.0, WIDE, LOW), sheet.owner, (TITLE, SIZE), what="sheet.owner")

    def _page(self, place: _Place, page: Page) -> Iterator[Item]:
        """The kind of document, its scale, and which sheet of how many it is."""
        yield from self._small(page.document, place(MIDDLE, LOW, RIGHT, LOW + ROW))
        for told, (left, right) in zip((said("Lit."), said("Mass"), said("Scale")), pairwise(VALUES), strict=True):
            yield from self._small(told, place(left, TOP - ROW, right, TOP))
        scale = place(VALUES[2], LOW + ROW, WIDE, TOP - ROW)
        yield from filled(scale, self.tongue(page.scale), SMALL, what="sheet.k_s")
        for told, number, left, right in ((said("Sheet"), page.number, RIGHT, PAGES),
                                          (said("Sheets"), page.of, PAGES, WIDE)):  # fmt: skip
            yield from self._small(joined((told, number), " "), place(left, LOW, right, LOW + ROW), middle=False)

    def _small(self, told: str, cell: Rect, middle: bool = True) -> Iterator[Item]:
        """Words of our own in a cell."""
        yield from filled(cell, self.tongue(told), SMALL, what=told, middle=middle)


@dataclass(frozen=True)
class _Place:
    """The lower left corner of the block, from which its cells are measured."""

    x: float
    y: float

    def __call__(self, left: float, bottom: float, right: float, top: float) -> Rect:
        return Rect(self.x + left, self.y + bottom, self.x + right, self.y + top)


Line = tuple[tuple[float, float], tuple[float, float], bool]


def _lines() -> Iterator[Line]:
    """All the lines of the form, measured from its lower left corner; those about parts are wide."""
    yield (0.0, 0.0), (0.0, HIGH), True
    yield (0.0, HIGH), (WIDE, HIGH), True
    for row in range(1, 11):
        yield (0.0, row * ROW), (MIDDLE, row * ROW), row * ROW in (ROLES, ROLES + ROW)
    yield (CHANGES[1], ROLES), (CHANGES[1], HIGH), True
    for x in CHANGES[2:]:
        yield (x, 0.0), (x, HIGH), True
    for y in (LOW, TOP):
        yield (MIDDLE, y), (WIDE, y), True
    yield (RIGHT, 0.0), (RIGHT, TOP), True
    for y in (LOW + ROW, TOP - ROW):
        yield (RIGHT, y), (WIDE, y), True
    for x in VALUES[1:3]:
        yield (x, LOW + ROW), (x, TOP), True
    for x in (VALUES[0] + ROW, VALUES[0] + 2 * ROW):
        yield (x, LOW + ROW), (x, TOP - ROW), False
    yield (PAGES, LOW), (PAGES, LOW + ROW), True
