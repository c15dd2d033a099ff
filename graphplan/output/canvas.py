"""A canvas in mm of paper for pictures of numbers: lines, marks and letters that lie wherever they are wanted."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from graphplan.output.svg import svg
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import SIZE, Runs
from graphplan.sheet.plates.display import Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.pens import LETTERS, Pen
from graphplan.sheet.plates.view import clip_item

TITLE, LINE, MARGIN = 5.0, 4.2, 10.0  # mm: the letters of a title, from line to line, and around the sheet
LAYER = "chart"
CIRCLE, CROSSED = "circle", "crossed"
MARKS = {  # how many corners, the direction of the first in degrees, and how far in the corners between them are
    "square": (4, 45, 1.0), "up": (3, 90, 1.0), "left": (3, 180, 1.0), "down": (3, 270, 1.0), "right": (3, 0, 1.0),
    "diamond": (4, 90, 1.0), "plus": (4, 90, 0.4), "cross": (4, 45, 0.4), "star": (5, 90, 0.4),
}  # fmt: skip


@dataclass(frozen=True)
class Canvas:
    """What is drawn, from back to front."""

    items: list[Item] = field(default_factory=list)

    def line(self, spots: Iterable[Spot], pen: Pen, edge: Rect | None = None) -> None:
        """A line through spots, cut off at an edge."""
        line = Polyline(pen, LAYER, None, tuple(spots))
        self.items.extend([line] if edge is None else clip_item(line, edge))

    def mark(self, mark: str, spot: Spot, size: float, pen: Pen) -> None:
        """A mark of this size."""
        if mark == CIRCLE:
            self.items.append(Circle(pen, LAYER, None, spot, size / 2))
        elif mark == CROSSED:
            for up in (size / 2, -size / 2):
                self.line([(spot[0] - size / 2, spot[1] - up), (spot[0] + size / 2, spot[1] + up)], pen)
        else:
            corners, first, inner = MARKS[mark]
            turns = [math.radians(first + 180 * k / corners) for k in range(2 * corners) if inner < 1 or k % 2 == 0]
            reach = [size / 2 ** 0.5 * (inner if inner < 1 and k % 2 else 1.0) for k in range(len(turns))]
            self.fill([(spot[0] + r * math.cos(turn), spot[1] + r * math.sin(turn))
                       for r, turn in zip(reach, turns, strict=True)], pen)

    def fill(self, corners: Iterable[Spot], pen: Pen) -> None:
        """A figure, filled as the pen says."""
        self.items.append(Polygon(pen, LAYER, None, tuple(corners)))

    def text(self, at: Spot, runs: Runs, size: float = SIZE, anchor: str = "start", pen: Pen = LETTERS) -> None:
        """Lettering on its base line."""
        self.items.append(Text(pen, LAYER, None, at, runs, size, anchor))

    def svg(self, width: float, height: float, title: str, description: str = "") -> str:
        """The sheet as SVG text."""
        whole, items = Rect(0.0, 0.0, width, height), tuple(self.items)
        return svg(Sheet(width, height, whole, {}, items, title, description, (), Scales(1.0, 1.0, "mm", {})))
