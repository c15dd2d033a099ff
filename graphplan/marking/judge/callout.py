"""A callout: a short sentence in a box, where it covers least of a plan, with a leader to its mark."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from graphplan.sheet.lettering.label_candidates import Array, Places
from graphplan.sheet.lettering.lettering import CAPS, SIZE, Runs, sentence_runs, width, wrap
from graphplan.sheet.lettering.obstacles import Lines, Marks, Surfaces
from graphplan.sheet.plates.display import Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import BORDER, LETTERS, PAPER, Pen
from graphplan.sheet.words.rows import LEADING

LAYER = "student"
WIDEST, PAD, PITCH = 62.0, 1.5, 2.0  # mm: of the lettering; about it in its box; between the places that are tried
CLEAR, FAR = 6.0, 0.25  # mm between the box and its mark; the price of every further one
RING = 2.4  # mm about the mark


def callout(sentence: str, names: tuple[str, ...], spot: Spot, items: Sequence[Item], rect: Rect,
            pen: Pen) -> Iterator[Item]:
    """The box with its leader; `items` are what it should not cover."""
    room = min(WIDEST, rect.width - 4 * PAD)
    lines = wrap(sentence_runs(sentence, names), SIZE, room)
    wide = max(width(line, SIZE) for line in lines) + 2 * PAD
    high = SIZE * (CAPS + LEADING * (len(lines) - 1)) + 2 * PAD
    box = _box(wide, high, spot, items, rect)
    nearest = min(max(spot[0], box.left), box.right), min(max(spot[1], box.bottom), box.top)
    yield Circle(pen.filled("none"), LAYER, None, spot, RING)
    yield Polyline(pen, LAYER, None, (_towards(spot, nearest), nearest))
    yield Polygon(pen.filled(PAPER), LAYER, None, box.corners)
    yield from _lettered(lines, box)


def _lettered(lines: Sequence[Runs], box: Rect) -> Iterator[Text]:
    """The lines of the sentence, from the top of the box."""
    for i, runs in enumerate(lines):
        y = box.top - PAD - SIZE * (CAPS + LEADING * i)
        yield Text(LETTERS, LAYER, None, (box.left + PAD, y), runs, SIZE)


def _towards(spot: Spot, other: Spot) -> Spot:
    """Where the leader leaves the ring about its mark."""
    way = complex(other[0] - spot[0], other[1] - spot[1])
    start = complex(*spot) + RING * way / (abs(way) or 1.0)
    return start.real, start.imag


def _box(wide: float, high: float, spot: Spot, items: Sequence[Item], rect: Rect) -> Rect:
    """The cheapest of many places on the panel: the fewer strokes and letters it covers, and the nearer, the better."""
    boxes = _grid(wide, high, rect)
    gaps = np.hypot(*np.maximum(np.maximum(boxes[:, :2] - spot, spot - boxes[:, 2:]), 0.0).T)
    if (gaps >= CLEAR).any():
        boxes, gaps = boxes[gaps >= CLEAR], gaps[gaps >= CLEAR]
    count = len(boxes)
    found = Places(np.zeros(count, dtype=int), boxes, np.tile(spot, (count, 1)), FAR * gaps, np.ones(count, dtype=bool))
    covered = [_solid(item) for item in items]
    cost = found.cost + sum(part.price(found) for part in (Lines(covered), Marks(()), Surfaces(covered)))
    left, bottom, right, top = map(float, boxes[int(np.argmin(cost))])
    return Rect(left, bottom, right, top)


def _grid(wide: float, high: float, rect: Rect) -> Array:
    """Boxes of this size all over a panel; one, at its corner, where it is hardly larger."""
    lefts = np.arange(rect.left + PAD, max(rect.right - PAD - wide, rect.left + PAD) + PITCH / 2, PITCH)
    lows = np.arange(rect.bottom + PAD, max(rect.top - PAD - high, rect.bottom + PAD) + PITCH / 2, PITCH)
    x, y = (part.ravel() for part in np.meshgrid(lefts, lows))
    return np.stack([x, y, x + wide, y + high], axis=1)


def _solid(item: Item) -> Item:
    """Lettering is as solid as a figure."""
    return Polygon(BORDER, item.layer, None, item.box.corners) if isinstance(item, Text) else item
