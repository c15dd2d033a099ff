"""Where letters stand beside points and lines: where they are clear of all lines of a figure and of each other."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from graphplan.sheet.lettering.lettering import CAPS, DEPTH, Runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Rect, Spot, Text

BESIDE_POINT, BESIDE_LINE = 1.6, 1.3  # mm from a point or a line to the letters that belong to it
CLEAR = 0.5  # mm that letters are off other lines at least, where there is such a place
ABOUT = 0, 45, -45, 90, -90, 135, -135, 180  # degrees from the wanted side of a point, in the order of trying
ALONG = 0.5, 0.4, 0.6, 0.28, 0.72, 0.15, 0.85  # parts of a line at which its letters may stand


@dataclass
class LetterPlaces:
    """The lines of a figure on paper, and where letters stand already."""

    size: float
    lines: list[tuple[Spot, Spot]] = field(default_factory=list)
    taken: list[Rect] = field(default_factory=list)

    def at_point(self, spot: Spot, away: complex, runs: Runs, off: float = BESIDE_POINT) -> Item:
        """Letters beside a point, on the wanted side if there is room."""
        wide, high = self._box(runs)
        ways = [away / (abs(away) or 1.0) * cmath.rect(1.0, math.radians(turn)) for turn in ABOUT]
        return self._placed(runs, ((spot[0] + way.real * (off + wide / 2), spot[1] + way.imag * (off + high / 2))
                                   for way in ways))

    def at_line(self, start: Spot, end: Spot, away: complex, runs: Runs) -> Item:
        """Letters beside a line, near its middle and on the wanted side if there is room."""
        wide, high = self._box(runs)
        way = complex(end[0] - start[0], end[1] - start[1])
        across = way / (abs(way) or 1.0) * 1j
        if (across * away.conjugate()).real < 0:
            across = -across
        off = BESIDE_LINE + (abs(across.real) * wide + abs(across.imag) * high) / 2
        return self._placed(runs, ((start[0] + part * way.real + side * off * across.real,
                                    start[1] + part * way.imag + side * off * across.imag)
                                   for part in ALONG for side in (1, -1)))

    def _box(self, runs: Runs) -> tuple[float, float]:
        return width(runs, self.size), CAPS * self.size

    def _placed(self, runs: Runs, centres: Iterable[Spot]) -> Item:
        """Letters with their middle in the first place that is clear, else in the clearest."""
        wide, high = self._box(runs)
        found = []
        for x, y in centres:
            rect = Rect(x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)
            clear = self._clearance(rect)
            found.append((clear, rect))
            if clear >= CLEAR:
                break
        rect = max(found, key=lambda one: one[0])[1] if found[-1][0] < CLEAR else found[-1][1]
        self.taken.append(rect.inset(-0.4, -DEPTH * self.size, -0.4, -0.4))
        return Text(pens.LETTERS, "letters", None, (rect.left, rect.bottom), runs, self.size)

    def _clearance(self, rect: Rect) -> float:
        """How far a place is from the lines; below nothing where it is on one or on other letters."""
        if any(rect.meets(other) for other in self.taken):
            return -10.0
        return min((_off(rect, line) for line in self.lines), default=math.inf)


def _off(rect: Rect, line: tuple[Spot, Spot]) -> float:
    """How far a line is from a rectangle; 0 where it crosses it."""
    (x, y), (u, v) = line
    low, high = 0.0, 1.0  # the part of the line that is inside, edge by edge (Liang and Barsky)
    for way, room in ((x - u, x - rect.left), (u - x, rect.right - x), (y - v, y - rect.bottom), (v - y, rect.top - y)):
        if way:
            low, high = (max(low, room / way), high) if way < 0 else (low, min(high, room / way))
        elif room < 0:
            low = math.inf
    if low <= high:
        return 0.0
    beyond = ((max(rect.left - a, 0.0, a - rect.right), max(rect.bottom - b, 0.0, b - rect.top)) for a, b in line)
    return min(*(math.hypot(*off) for off in beyond), *(_apart(corner, line) for corner in rect.corners))


def _apart(spot: Spot, line: tuple[Spot, Spot]) -> float:
    """How far a spot is from a stretch of a line."""
    (x, y), (u, v) = line
    dx, dy = u - x, v - y
    square = dx * dx + dy * dy
    part = 0.0 if not square else max(0.0, min(1.0, ((spot[0] - x) * dx + (spot[1] - y) * dy) / square))
    return math.hypot(spot[0] - x - part * dx, spot[1] - y - part * dy)
