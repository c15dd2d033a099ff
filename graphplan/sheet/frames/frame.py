"""Frames: the space for drawing on a sheet, what stands in its border, and the title block that belongs to them.

After ISO 5457 the border is 20 mm wide on the left, for filing, and 10 mm elsewhere. Fields of 50 mm, counted from the
middles of the sides, are named along it by letters downwards and by numbers to the right, on A4 only at the top and
on the right. The form of centring marks is free; here they end at the frame, as marks that reach into the drawing, by
10 mm as the standard recommends, would strike out words and lines. Trimming marks are left out. After GOST 2.301 the
border is 20 mm wide on the left and 5 mm elsewhere, and empty but for the format; A4 stands upright.

Handouts have coded marks in the corners, which say where the sheet lies in a scan, and whose sheet it is. The marks are
those of ArUco's original dictionary (S. Garrido-Jurado et al., Pattern Recognition 47, 2014), so that every reader of
such marks finds them: five rows of five cells in a black border, two bits of the number to a row. Two bits of a number
say which corner it is, eight are a quarter of the sheet's code. Marks lie diagonally beyond the frame's corners, as
large as its border permits but not so far out that an office printer would cut them off.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from zlib import crc32

from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import ISO_SIZES, iso_size
from graphplan.phrases import join, said
from graphplan.sheet.frames.title import GostBlock, IsoBlock, TitleBlock
from graphplan.sheet.lettering.lettering import CAPS, SIZE, sentence_runs
from graphplan.sheet.plates.display import Item, Outline, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import FRAME, INK, LETTERS, PAPER, Pen
from graphplan.words.tongue import Tongue

BORDER = "border"  # the layer of what stands outside the frame
BINDING, EDGE = 20.0, 10.0
FIELD, STRIP, CAPITALS, DIVISION = 50.0, 5.0, 3.5, Pen(0.35)
FIELD_LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"  # without I and O, which are read as figures


@dataclass(frozen=True)
class SheetFrame:
    """A kind of frame: the border beside the binding, how A4 lies, its title block, and what fills its border."""

    edge: float
    a4: tuple[str, ...]
    block: Callable[[Scene, Tongue], TitleBlock]
    border: Callable[[str, Rect, Tongue], Iterator[Item]]

    @property
    def papers(self) -> list[str]:
        """The sheets from the smallest."""
        return [*self.a4, *(name for name in ISO_SIZES if name != "A4")]

    def paper(self, name: str) -> str:
        """A sheet as it lies, if its name does not say."""
        size, _, orientation = name.partition(" ")
        name = size.capitalize()
        return self.a4[0] if name == "A4" and not orientation else f"{name} {orientation}".strip()

    def space(self, wide: float, high: float) -> Rect:
        """The space for drawing on a sheet of this size."""
        return Rect(BINDING, self.edge, wide - self.edge, high - self.edge)

    def items(self, paper: str, space: Rect, tongue: Tongue) -> Iterator[Item]:
        """The frame, and its border."""
        yield Outline(FRAME, "paper", None, space.corners)
        yield from self.border(paper, space, tongue)


def frame_of(scene: Scene) -> SheetFrame:
    """The frame chosen in a scene."""
    return FRAMES[scene.sheet.frame]


# ---- ISO 5457 ----------------------------------------------------------------------------------------------------


def _fields(paper: str, space: Rect, tongue: Tongue) -> Iterator[Item]:
    """The grid reference system and the centring marks."""
    outer = space.inset(-STRIP, -STRIP, -STRIP, -STRIP)
    x, y = (outer.left - BINDING + outer.right + EDGE) / 2, outer.centre[1]
    small = iso_size(paper) == "A4"
    _, lower_right, upper_right, upper_left = outer.corners
    yield Polyline(DIVISION, BORDER, None, (upper_left, upper_right, lower_right))
    if not small:
        yield Polyline(DIVISION, BORDER, None, (upper_left, outer.corners[0], lower_right))
    across, upwards = _ends(space.left, space.right, x), _ends(space.bottom, space.top, y)
    for low in (space.top,) if small else (space.bottom - STRIP, space.top):
        yield from (_division((end, low), (end, low + STRIP)) for end in across[1:-1])
        yield from (_name(str(i), (middle, low + STRIP / 2)) for i, middle in enumerate(_middles(across), 1))
    for left in (space.right,) if small else (space.left - STRIP, space.right):
        yield from (_division((left, end), (left + STRIP, end)) for end in upwards[1:-1])
        names = zip(FIELD_LETTERS, reversed(_middles(upwards)), strict=False)
        yield from (_name(name, (left + STRIP / 2, middle)) for name, middle in names)
    for start, end in (((outer.left, y), (space.left, y)), ((outer.right, y), (space.right, y)),
                       ((x, outer.bottom), (x, space.bottom)), ((x, outer.top), (x, space.top))):  # fmt: skip
        yield Polyline(FRAME, BORDER, None, (start, end))


def _ends(low: float, high: float, middle: float) -> list[float]:
    """The ends of the fields along a side: 50 mm each from its middle, those in the corners with what is left."""
    count = round((high + EDGE - middle) / FIELD)
    return [low, *(middle + i * FIELD for i in range(1 - count, count)), high]


def _middles(ends: list[float]) -> list[float]:
    return [(low + high) / 2 for low, high in pairwise(ends)]


def _division(start: Spot, end: Spot) -> Item:
    return Polyline(DIVISION, BORDER, None, (start, end))


def _name(name: str, middle: Spot) -> Item:
    """A field's name, in capitals of 3.5 mm."""
    at = middle[0], middle[1] - CAPITALS / 2
    return Text(LETTERS, BORDER, None, at, sentence_runs(name), CAPITALS / CAPS, "middle")


# ---- GOST 2.301 --------------------------------------------------------------------------------------------------


def _format(paper: str, space: Rect, tongue: Tongue) -> Iterator[Item]:
    """The format, under the title block."""
    text = tongue(join((said("Format"), paper.partition(" ")[0]), " "))
    at = space.right - 2.0, space.bottom - 3.6
    yield Text(LETTERS, BORDER, None, at, sentence_runs(text), SIZE, "end")


FRAMES = {
    "iso": SheetFrame(EDGE, ("A4", "A4 portrait"), IsoBlock, _fields),
    "gost": SheetFrame(5.0, ("A4 portrait",), GostBlock, _format),
}


# ---- corner marks ----------------------------------------------------------------------------------------------------

MARKS = "corner marks"  # the layer
ROW_BITS = "10000", "10111", "01001", "01110"  # how a row says two bits
CELLS = 7  # of a mark's side, its black border among them
MAX_MARK_MM, MARK_MARGIN_MM, EDGE_MARGIN_MM = 4.5, 0.75, 1.0  # a mark's side; white towards the frame, towards the edge
BLACK, WHITE = Pen(0.0, INK, fill=INK), Pen(0.0, PAPER, fill=PAPER)


def sheet_code(text: str) -> int:
    """Checksum of 32 bits of a text: of a scene and all that fixes the composition of its sheet."""
    return crc32(text.encode())


def page_code(code: int, page: int) -> int:
    """The code of a page of a task whose first page has this one."""
    return code if page == 1 else sheet_code(f"{code}, page {page}")


def corner_numbers(code: int) -> tuple[int, int, int, int]:
    """The numbers of a sheet's marks, from the lower left corner, counter-clockwise: which corner, and a quarter of
    the code, never 255: the mark 1023 is the only one that looks the same upside down."""
    first, second, third, fourth = (corner << 8 | (code >> 8 * corner & 255) % 255 for corner in range(4))
    return first, second, third, fourth


def corner_rects(width: float, height: float, frame: Rect) -> tuple[Rect, Rect, Rect, Rect]:
    """Rectangles of a sheet's corner marks, from the lower left corner, counter-clockwise."""
    border = min(frame.left, frame.bottom, width - frame.right, height - frame.top)
    side, near = min(MAX_MARK_MM, border - MARK_MARGIN_MM - EDGE_MARGIN_MM), MARK_MARGIN_MM
    left, right = frame.left - near - side, frame.right + near
    low, high = frame.bottom - near - side, frame.top + near
    corners = (left, low), (right, low), (right, high), (left, high)
    first, second, third, fourth = (Rect(x, y, x + side, y + side) for x, y in corners)
    return first, second, third, fourth


def corner_marks(width: float, height: float, frame: Rect, code: int) -> list[Item]:
    """The marks of a sheet with this code, each on white of its own, over whatever the border has there."""
    return [item for rect, number in zip(corner_rects(width, height, frame), corner_numbers(code), strict=True)
            for item in _mark(rect, number)]


def mark_cells(number: int) -> tuple[str, ...]:
    """A mark without its border, row by row from above: 1 is white."""
    return tuple(ROW_BITS[number >> shift & 3] for shift in (8, 6, 4, 2, 0))


def _mark(rect: Rect, number: int) -> Iterator[Item]:
    """White about it, black all over, and its white cells: as strips, so that no seam shows between neighbours."""
    cell = rect.width / CELLS
    yield _block(WHITE, rect.inset(-MARK_MARGIN_MM, -MARK_MARGIN_MM, -MARK_MARGIN_MM, -MARK_MARGIN_MM))
    yield _block(BLACK, rect)
    for row, bits in enumerate(mark_cells(number), 1):
        top = rect.top - row * cell
        for start, end in _runs(bits):
            yield _block(WHITE, Rect(rect.left + (start + 1) * cell, top - cell, rect.left + (end + 1) * cell, top))


def _runs(bits: str) -> Iterator[tuple[int, int]]:
    """Yield the start and end of each run of ones in a row."""
    edges = [i for i, (one, two) in enumerate(zip("0" + bits, bits + "0", strict=True)) if one != two]
    return zip(edges[::2], edges[1::2], strict=True)


def _block(pen: Pen, rect: Rect) -> Polygon:
    return Polygon(pen, MARKS, None, rect.corners)
