"""How panels have room in a region that is cut across, in their order: as the leaves of a slicing tree.

Of each run of neighbours the shapes in which it just has room are kept that are smaller than others one way or the
other (L. Stockmeyer, Information and Control 57, 1983). A division is tried at many scales and in many orders, in which
most runs are the same, so each is packed once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Sequence
from typing import NamedTuple

from graphplan.sheet.plates.display import Rect

MAX_SHAPES = 8  # shapes of a run that are kept

Size = tuple[float, float]  # how wide and high


class Shape(NamedTuple):
    """How wide and high a run of panels is at least, and its two parts, side by side or one under the other."""

    wide: float
    high: float
    parts: tuple[Shape, Shape] | None = None
    beside: bool = False
    name: str = ""


Join = tuple[float, float, int, int, int, bool]  # how wide and high; where parted, which shapes of its parts, how


class Packing:
    """The smallest shapes of runs of parts in a region; parts are numbered, each by what it is and at which scale."""

    def __init__(self, region: Rect):
        self.region = region
        self.areas: list[float] = []  # of each part, at least
        self._names: list[str] = []
        self._numbers: dict[Hashable, int] = {}
        self._runs: dict[tuple[int, ...], list[Join]] = {}

    def number(self, part: tuple[str, Hashable], sizes: Callable[[], Sequence[Size]]) -> int:
        """The number of a part by its name and scale, which may have any of some sizes."""
        if part not in self._numbers:
            number, leaf = len(self.areas), sizes()
            self._numbers[part] = number
            self._names.append(part[0])
            self.areas.append(min(wide * high for wide, high in leaf))
            self._runs[number,] = _undercut([(wide, high, 0, 0, 0, False) for wide, high in sorted(leaf)])
        return self._numbers[part]

    def best(self, run: tuple[int, ...]) -> Shape | None:
        """The shape of parts in this order that leaves most of the region over; none where they have no room."""
        wide, high = self.region.width, self.region.height
        whole = [shape for shape in self._joins(run) if shape[0] <= wide and shape[1] <= high]
        best = max(whole, key=lambda shape: min(wide / shape[0], high / shape[1]), default=None)
        return best and self._shape(run, best)

    def _shape(self, run: tuple[int, ...], join: Join) -> Shape:
        """A shape of a run with its parts."""
        wide, high, middle, i, j, under = join
        if not middle:
            return Shape(wide, high, name=self._names[run[0]])
        pairs = (run[:middle], i), (run[middle:], j)
        first, second = (self._shape(half, self._runs[half][k]) for half, k in pairs)
        return Shape(wide, high, (first, second), not under)

    def _joins(self, run: tuple[int, ...]) -> list[Join]:
        """The smallest shapes of a run that are no larger than the region, the narrowest first; at most `MAX_SHAPES` of
        them, and of equals the first."""
        if (packed := self._runs.get(run)) is not None:
            return packed
        joined = list[Join]()
        for middle in range(1, len(run)):
            if (ones := self._joins(run[:middle])) and (twos := self._joins(run[middle:])):
                _join_beside(joined, ones, twos, middle, self.region.width)
                _join_under(joined, ones, twos, middle, self.region.height)
        joined.sort()
        minimal = _undercut(joined)
        last = len(minimal) - 1
        if last >= MAX_SHAPES:
            minimal = [minimal[round(i * last / (MAX_SHAPES - 1))] for i in range(MAX_SHAPES)]
        self._runs[run] = minimal
        return minimal


def _join_beside(joined: list[Join], ones: Sequence[Join], twos: Sequence[Join], middle: int, widest: float) -> None:
    """Add the smallest shapes of two runs side by side: from the narrowest on, as long as they have room, and the
    higher of both can be lower."""
    i, j = 0, 0
    while i < len(ones) and j < len(twos):
        left, right = ones[i], twos[j]
        wide, spare = left[0] + right[0], left[1] - right[1]
        if wide > widest:
            return
        joined.append((wide, left[1] if spare > 0 else right[1], middle, i, j, False))
        i, j = i + (spare >= 0), j + (spare <= 0)


def _join_under(joined: list[Join], ones: Sequence[Join], twos: Sequence[Join], middle: int, highest: float) -> None:
    """Add the smallest shapes of two runs one under the other: from the lowest on, as long as they have room, and the
    wider of both can be narrower."""
    i, j = len(ones) - 1, len(twos) - 1
    while i >= 0 and j >= 0:
        upper, lower = ones[i], twos[j]
        high, spare = upper[1] + lower[1], upper[0] - lower[0]
        if high > highest:
            return
        joined.append((upper[0] if spare > 0 else lower[0], high, middle, i, j, True))
        i, j = i - (spare >= 0), j - (spare <= 0)


def _undercut(shapes: Sequence[Join]) -> list[Join]:
    """Of shapes in order, the narrowest first, those that no other undercuts in both width and height."""
    minimal, lowest = list[Join](), math.inf
    for shape in shapes:
        if shape[1] < lowest:
            minimal.append(shape)
            lowest = shape[1]
    return minimal


def places(shape: Shape, rect: Rect) -> dict[str, Rect]:
    """Place the panels of a run in a rectangle; they share spare room by their sizes, the title block takes none."""
    if shape.parts is None:
        return {shape.name: rect} if shape.name else {}
    first, two = shape.parts
    last = two.parts is None and not two.name
    if shape.beside:
        share = 1.0 if last else first.wide / (first.wide + two.wide)
        edge = rect.left + first.wide + share * (rect.width - first.wide - two.wide)
        return places(first, Rect(rect.left, rect.bottom, edge, rect.top)) | places(
            two, Rect(edge, rect.bottom, rect.right, rect.top))
    share = 1.0 if last else first.high / (first.high + two.high)
    edge = rect.top - first.high - share * (rect.height - first.high - two.high)
    return places(first, Rect(rect.left, edge, rect.right, rect.top)) | places(
        two, Rect(rect.left, rect.bottom, rect.right, edge))
