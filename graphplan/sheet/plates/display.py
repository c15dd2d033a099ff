"""The display list: what lies on the sheet, in millimetres, x to the right and y up from its lower left corner.

Plain frozen data. A back end draws these eight things and needs to know nothing of mechanics; `step` is the drawing
step that an item belongs to, so that a page can show or light up one movement at a time.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import NamedTuple

from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import ANCHORS, CAPS, TextRun, depth, width
from graphplan.sheet.plates.pens import FILLED, OPEN, PAPER, WHITE, Pen

Spot = tuple[float, float]
SLIM = {FILLED: 6.0, WHITE: 4.5, OPEN: 4.5}  # how many times as long as half its width a head is
BARB, WALL = 1.2, 0.25  # mm: of an open head along the vector, and about the middle of a white one
ENLARGED = "enlarged"  # the layer of details: what of plans is drawn once more, larger
EDGE_SLACK_MM = 0.01  # mm by which what is on an edge may be beyond it


class Rect(NamedTuple):
    """An upright rectangle on paper."""

    left: float
    bottom: float
    right: float
    top: float

    @property
    def width(self) -> float:
        return self.right - self.left

    @property
    def height(self) -> float:
        return self.top - self.bottom

    @property
    def area(self) -> float:
        return self.width * self.height

    @property
    def centre(self) -> Spot:
        return (self.left + self.right) / 2, (self.bottom + self.top) / 2

    @property
    def corners(self) -> tuple[Spot, Spot, Spot, Spot]:
        """The corners from the lower left, counter-clockwise."""
        return (self.left, self.bottom), (self.right, self.bottom), (self.right, self.top), (self.left, self.top)

    def inset(self, left: float, bottom: float, right: float, top: float) -> Rect:
        """The rectangle inside these margins."""
        return Rect(self.left + left, self.bottom + bottom, self.right - right, self.top - top)

    def times(self, times: float) -> Rect:
        """The rectangle so many times as large and as far from the origin."""
        return Rect(times * self.left, times * self.bottom, times * self.right, times * self.top)

    def holds(self, spot: Spot, slack: float = 0.0) -> bool:
        """Whether a spot lies inside, or outside by no more than `slack`."""
        x, y = spot
        return self.left - slack <= x <= self.right + slack and self.bottom - slack <= y <= self.top + slack

    def meets(self, other: Rect) -> bool:
        """Whether the two share more than an edge."""
        return (self.left < other.right and other.left < self.right
                and self.bottom < other.top and other.bottom < self.top)  # fmt: skip


@dataclass(frozen=True)
class Item:
    """Common fields of all items: the pen, the layer, and the drawing step if they belong to one."""

    pen: Pen
    layer: str
    step: int | None


@dataclass(frozen=True)
class Polyline(Item):
    """A line through spots."""

    spots: tuple[Spot, ...]


@dataclass(frozen=True)
class Polygon(Item):
    """An area whose corners are spots."""

    spots: tuple[Spot, ...]


@dataclass(frozen=True)
class Outline(Polygon):
    """The upright outline of the frame, or of the panel of a `plan`."""

    plan: str = ""


@dataclass(frozen=True)
class Circle(Item):
    """A whole circle; its radius in mm of paper."""

    centre: Spot
    radius: float


@dataclass(frozen=True)
class Arc(Item):
    """Counter-clockwise from `start` to `end`, in degrees."""

    centre: Spot
    radius: float
    start: float
    end: float

    def spot_at(self, angle: float) -> Spot:
        """The spot of the arc's circle at an angle."""
        turn = math.radians(angle)
        return self.centre[0] + self.radius * math.cos(turn), self.centre[1] + self.radius * math.sin(turn)

    def spots(self, apart: float = 4.0) -> tuple[Spot, ...]:
        """The arc as a chain of spots, `apart` degrees or less."""
        count = max(1, math.ceil((self.end - self.start) / apart))
        return tuple(self.spot_at(self.start + (self.end - self.start) * i / count) for i in range(count + 1))


@dataclass(frozen=True)
class Arrow(Item):
    """A vector; its head is `head` long, never longer than the vector, and ends exactly at `end`.

    `label` says what it is, such as `velocity A`, where it is a result; `gaps` are the parts of its length, as
    fractions from and to which, where its shaft breaks off.
    """

    start: Spot
    end: Spot
    head: float
    label: str = ""
    gaps: tuple[tuple[float, float], ...] = ()

    @property
    def direction(self) -> Spot:
        """Direction as a vector 1 mm long."""
        dx, dy = self.end[0] - self.start[0], self.end[1] - self.start[1]
        length = math.hypot(dx, dy) or 1.0
        return dx / length, dy / length

    @property
    def barbs(self) -> tuple[Spot, Spot, Spot]:
        """The slim triangle of the head: its tip and its two rear corners."""
        half = self.head / SLIM[self.pen.tip]
        return self.end, self._spot(self.head, half), self._spot(self.head, -half)

    def _spot(self, back: float, aside: float = 0.0) -> Spot:
        """The spot so many mm back from the tip and to the left of the vector."""
        ux, uy = self.direction
        return self.end[0] - back * ux - aside * uy, self.end[1] - back * uy + aside * ux

    @property
    def figures(self) -> Iterator[tuple[tuple[Spot, ...], str]]:
        """The outlines of its head, the first from its tip, each with its filling."""
        half, barb = self.head / SLIM[self.pen.tip], min(BARB, self.head / 2)
        if self.pen.tip == OPEN:
            for side in (half, -half):
                yield (self.end, self._spot(self.head - barb, side), self._spot(self.head, side), self._spot(barb)), \
                    self.pen.colour
            return
        yield self.barbs, self.pen.colour
        radius = half * self.head / (half + math.hypot(half, self.head))  # of the circle inside
        hollow = 1 - WALL / radius if self.pen.tip == WHITE else 0.0
        if hollow > 0:
            middle = self._spot(self.head - radius)
            yield tuple((x + hollow * (u - x), y + hollow * (v - y)) for u, v in self.barbs
                        for x, y in (middle,)), PAPER

    @property
    def shaft(self) -> tuple[tuple[Spot, Spot], ...]:
        """The strokes that end in the head, so that the tip is sharp; empty if the vector is all head."""
        length = math.dist(self.start, self.end)
        neck = min(BARB, self.head / 2) if self.pen.tip == OPEN else self.head
        if length <= neck + 0.01:
            return ()
        gaps = sorted(self.gaps)
        starts = accumulate((0.0, *(end for _, end in gaps)), max)
        ends = *(start for start, _ in gaps), 1 - neck / length
        return tuple((self._spot((1 - start) * length), self._spot((1 - end) * length))
                     for start, end in zip(starts, ends, strict=True) if start < end)


@dataclass(frozen=True)
class Text(Item):
    """Lettering on its base line; `anchor` is start, middle or end; `label` names the marks it stands for, if any."""

    at: Spot
    runs: tuple[TextRun, ...]
    size: float
    anchor: str = "start"
    bold: bool = False
    label: str = ""

    @property
    def box(self) -> Rect:
        """Box of the letters, from below the base line to the top of the capitals."""
        long = width(self.runs, self.size, self.bold)
        left = self.at[0] - long * ANCHORS[self.anchor]
        return Rect(left, self.at[1] - depth(self.runs) * self.size, left + long, self.at[1] + CAPS * self.size)


@dataclass(frozen=True)
class Photograph(Item):
    """A grey picture that fills a rectangle: a JPEG, and how many pixels it is wide and high."""

    rect: Rect
    jpeg: bytes
    pixels: tuple[int, int]


def move_item(item: Item, dx: float, dy: float, times: float = 1.0) -> Item:
    """The item elsewhere on the paper, and so many times as large, but for pens and heads of vectors."""

    def move_spot(spot: Spot) -> Spot:
        return times * spot[0] + dx, times * spot[1] + dy

    match item:
        case Polyline() | Polygon():
            return replace(item, spots=tuple(map(move_spot, item.spots)))
        case Circle() | Arc():
            return replace(item, centre=move_spot(item.centre), radius=times * item.radius)
        case Arrow():
            return replace(item, start=move_spot(item.start), end=move_spot(item.end))
        case Text():
            return replace(item, at=move_spot(item.at), size=times * item.size)
    raise TypeError(f"no {type(item).__name__} can be moved")


def lies_in(item: Item, rects: Iterable[Rect]) -> bool:
    """Whether an item lies in one of the rectangles: its corners or ends, its middle, or where its lettering begins."""
    match item:
        case Polyline() | Polygon():
            spots = item.spots
        case Circle() | Arc():
            spots = (item.centre,)
        case Arrow():
            spots = item.start, item.end
        case Text():
            spots = (item.at,)
    return any(all(rect.holds(spot, EDGE_SLACK_MM) for spot in spots) for rect in rects)


@dataclass(frozen=True)
class Sheet:
    """A finished sheet: its size in mm, its items from back to front, the sentence of every step, the scene's text.

    The first `givens` steps only mark the points of the pose.
    """

    width: float
    height: float
    frame: Rect
    panels: dict[str, Rect]
    items: tuple[Item, ...]
    title: str
    description: str
    sentences: tuple[str, ...]
    scales: Scales
    language: str = "en"
    scene: str = ""
    givens: int = 0
