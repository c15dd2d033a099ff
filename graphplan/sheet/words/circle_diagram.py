"""The circle diagram of the poles as a figure among the words: links on a circle, a side for each pole that is known.

Sides of the outset are thick, those that are found bear the number in whose order they are (Ozols 1974, 5-2).
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from graphplan.mechanism.model import FRAME
from graphplan.methods.motion.circle_diagram import DrawnCircle, Sides
from graphplan.sheet.lettering.lettering import CAPS, SIZE, name_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Spot, Text
from graphplan.sheet.plates.pens import Pen

LEAST, MORE = 10.0, 2.2  # mm: the circle's radius, and how much larger it is with each link beyond four
LINK, AIR = 2.6, 1.5  # mm: the radius about a link's name, and what is left free around the figure
SMALL = 0.8 * SIZE  # mm: the letters of numbers
NUMBER = 0.38  # of a side: where its number stands, off the middle, in which many sides cross
BARE = Pen(0.0, pens.PAPER, fill=pens.PAPER)


def tall(circle: DrawnCircle) -> float:
    """How high and wide the figure is, in mm."""
    return 2 * (_radius(circle) + LINK + AIR)


def figure(circle: DrawnCircle) -> Iterator[Item]:
    """The figure, from its lower left corner."""
    spots = {link: _spot(circle, place) for place, link in enumerate(circle.links)}
    for side in circle.sides:
        pen = pens.PRODUCED if side.number else pens.NORMAL
        yield Polyline(pen, "text", None, tuple(spots[link] for link in side.links))
    for side in circle.sides:
        if side.number:
            name, spot = str(side.number), _number(spots, side.links)
            room = 0.7 * max(width(name_runs(name), SMALL), SMALL)
            yield from _lettered(name, SMALL, Circle(BARE, "text", None, spot, room))
    for link, spot in spots.items():
        yield from _lettered("0" if link == FRAME else link, SIZE, Circle(pens.BALLOON, "text", None, spot, LINK))


def _lettered(name: str, size: float, ground: Circle) -> Iterator[Item]:
    """A name in the middle of its ground."""
    x, y = ground.centre
    yield ground
    yield Text(pens.LETTERS, "text", None, (x, y - CAPS * size / 2), name_runs(name), size, "middle")


def _radius(circle: DrawnCircle) -> float:
    return LEAST + MORE * max(0, len(circle.links) - 4)


def _spot(circle: DrawnCircle, place: int) -> Spot:
    """Where a link stands: the first at the upper left, the others the way of the clock."""
    angle, radius = math.pi * (0.75 - 2 * place / len(circle.links)), _radius(circle)
    middle = radius + LINK + AIR
    return middle + radius * math.cos(angle), middle + radius * math.sin(angle)


def _number(spots: dict[str, Spot], sides: Sides) -> Spot:
    (x, y), (u, v) = (spots[link] for link in sides)
    return x + NUMBER * (u - x), y + NUMBER * (v - y)
