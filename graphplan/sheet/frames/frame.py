"""Frames: the space for drawing on a sheet, what stands in its border, and the title block that belongs to them.

After ISO 5457 the border is 20 mm wide on the left, for filing, and 10 mm elsewhere. Fields of 50 mm, counted from the
middles of the sides, are named along it by letters downwards and by numbers to the right, on A4 only at the top and
on the right. The form of centring marks is free; here they end at the frame, as marks that reach into the drawing, by
10 mm as the standard recommends, would strike out words and lines. Trimming marks are left out. After GOST 2.301 the
border is 20 mm wide on the left and 5 mm elsewhere, and empty but for the format; A4 stands upright.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from graphplan.mechanism.model import Scene
from graphplan.mechanism.presentation import SIZES
from graphplan.phrases import joined, said
from graphplan.sheet.frames.title import GostBlock, IsoBlock, TitleBlock
from graphplan.sheet.lettering.lettering import CAPS, SIZE, sentence_runs
from graphplan.sheet.plates.display import Item, Outline, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import FRAME, LETTERS, Pen
from graphplan.words.tongue import Tongue

BORDER = "border"  # the layer of what stands outside the frame
BINDING, EDGE = 20.0, 10.0
FIELD, STRIP, CAPITALS, DIVISION = 50.0, 5.0, 3.5, Pen(0.35)
LETTERED = "ABCDEFGHJKLMNPQRSTUVWXYZ"  # without I and O, which are read as figures


@dataclass(frozen=True)
class Frame:
    """A kind of frame: the border beside the binding, how A4 lies, its title block, and what fills its border."""

    edge: float
    a4: tuple[str, ...]
    block: Callable[[Scene, Tongue], TitleBlock]
    border: Callable[[str, Rect, Tongue], Iterator[Item]]

    @property
    def papers(self) -> list[str]:
        """The sheets from the smallest."""
        return [*self.a4, *(name for name in SIZES if name != "A4")]

    def paper(self, name: str) -> str:
        """A sheet as it lies, if its name does not say."""
        size, _, way = name.partition(" ")
        return self.a4[0] if size.upper() == "A4" and not way else f"{size.upper()} {way}".strip()

    def space(self, wide: float, high: float) -> Rect:
        """The space for drawing on a sheet of this size."""
        return Rect(BINDING, self.edge, wide - self.edge, high - self.edge)

    def items(self, paper: str, space: Rect, tongue: Tongue) -> Iterator[Item]:
        """The frame, and its border."""
        yield Outline(FRAME, "paper", None, space.corners)
        yield from self.border(paper, space, tongue)


def frame_of(scene: Scene) -> Frame:
    """The frame that a scene wishes for its sheet."""
    return FRAMES[scene.sheet.frame]


# ---- ISO 5457 ----------------------------------------------------------------------------------------------------


def _fields(paper: str, space: Rect, tongue: Tongue) -> Iterator[Item]:
    """The grid reference system and the centring marks."""
    outer = space.inset(-STRIP, -STRIP, -STRIP, -STRIP)
    x, y = (outer.left - BINDING + outer.right + EDGE) / 2, outer.centre[1]
    small = paper.startswith("A4")
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
        names = zip(LETTERED, reversed(_middles(upwards)), strict=False)
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
    told = tongue(joined((said("Format"), paper.partition(" ")[0]), " "))
    at = space.right - 2.0, space.bottom - 3.6
    yield Text(LETTERS, BORDER, None, at, sentence_runs(told), SIZE, "end")


FRAMES = {
    "iso": Frame(EDGE, ("A4", "A4 portrait"), IsoBlock, _fields),
    "gost": Frame(5.0, ("A4 portrait",), GostBlock, _format),
}
