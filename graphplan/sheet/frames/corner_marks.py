"""Coded marks in the corners of a handout: they say where the sheet lies in a scan, and whose sheet it is.

The marks are those of ArUco's original dictionary (S. Garrido-Jurado et al., Pattern Recognition 47, 2014), so that
every reader of such marks finds them: five rows of five cells in a black border, two bits of the number to a row. Two
bits of a number say which corner it is, eight are a quarter of the sheet's code. Marks lie diagonally beyond the
frame's corners, as large as its border permits but not so far out that an office printer would cut them off.
"""

from __future__ import annotations

from collections.abc import Iterator
from zlib import crc32

from graphplan.sheet.plates.display import Item, Polygon, Rect
from graphplan.sheet.plates.pens import INK, PAPER, Pen

MARKS = "corner marks"  # the layer
WORDS = "10000", "10111", "01001", "01110"  # how a row says two bits
CELLS = 7  # of a mark's side, its black border among them
LARGEST, CLEAR, EDGE = 4.5, 0.75, 1.0  # mm: a mark's side; white beside it, towards the frame and the paper's edge
BLACK, WHITE = Pen(0.0, INK, fill=INK), Pen(0.0, PAPER, fill=PAPER)


def sheet_code(text: str) -> int:
    """A number of 32 bits for what makes a sheet this one: its scene, and all that fixes its composition."""
    return crc32(text.encode())


def page_code(code: int, page: int) -> int:
    """The code of a page of a task whose first page has this one."""
    return code if page == 1 else sheet_code(f"{code}, page {page}")


def numbers(code: int) -> tuple[int, int, int, int]:
    """The numbers of a sheet's marks, from the lower left corner, counter-clockwise: which corner, and a quarter of
    the code, never 255: the mark 1023 is the only one that looks the same upside down."""
    first, second, third, fourth = (corner << 8 | (code >> 8 * corner & 255) % 255 for corner in range(4))
    return first, second, third, fourth


def places(width: float, height: float, frame: Rect) -> tuple[Rect, Rect, Rect, Rect]:
    """Where the marks of a sheet lie, from the lower left corner, counter-clockwise."""
    border = min(frame.left, frame.bottom, width - frame.right, height - frame.top)
    side, near = min(LARGEST, border - CLEAR - EDGE), CLEAR
    left, right = frame.left - near - side, frame.right + near
    low, high = frame.bottom - near - side, frame.top + near
    corners = (left, low), (right, low), (right, high), (left, high)
    first, second, third, fourth = (Rect(x, y, x + side, y + side) for x, y in corners)
    return first, second, third, fourth


def corner_marks(width: float, height: float, frame: Rect, code: int) -> list[Item]:
    """The marks of a sheet with this code, each on white of its own, over whatever the border has there."""
    return [item for rect, number in zip(places(width, height, frame), numbers(code), strict=True)
            for item in _mark(rect, number)]


def cells(number: int) -> tuple[str, ...]:
    """A mark without its border, row by row from above: 1 is white."""
    return tuple(WORDS[number >> shift & 3] for shift in (8, 6, 4, 2, 0))


def _mark(rect: Rect, number: int) -> Iterator[Item]:
    """White about it, black all over, and its white cells: as strips, so that no seam shows between neighbours."""
    cell = rect.width / CELLS
    yield _block(WHITE, rect.inset(-CLEAR, -CLEAR, -CLEAR, -CLEAR))
    yield _block(BLACK, rect)
    for row, bits in enumerate(cells(number), 1):
        top = rect.top - row * cell
        for start, end in _runs(bits):
            yield _block(WHITE, Rect(rect.left + (start + 1) * cell, top - cell, rect.left + (end + 1) * cell, top))


def _runs(bits: str) -> Iterator[tuple[int, int]]:
    """Where the ones of a row begin and end."""
    edges = [i for i, (one, two) in enumerate(zip("0" + bits, bits + "0", strict=True)) if one != two]
    return zip(edges[::2], edges[1::2], strict=True)


def _block(pen: Pen, rect: Rect) -> Polygon:
    return Polygon(pen, MARKS, None, rect.corners)
