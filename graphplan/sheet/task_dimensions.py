"""Dimensions on a task's figure: the lengths of links along them, the angles of driving cranks as arcs.

The facts beside the plans say everything; a dimension is drawn only where it stands clear of what is there.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import product
from typing import Any

import numpy as np
import shapely

from graphplan.sheet.lettering.lettering import Runs, name_runs, sentence_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.annotations import covered
from graphplan.sheet.plates.display import Arc, Arrow, Item, Polygon, Polyline, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.symbols import DRIVE_RADIUS, offset, unit_vector
from graphplan.sheet.plates.view import interpolate
from graphplan.sheet.words.facts import SaidFact, drive_angles, link_lengths
from graphplan.words.tongue import Tongue

LAYER = "dimensions"
HEAD_MM, NUMBER_MM, PAST_MM, CLEAR_MM = 2.4, 2.5, 1.5, 0.8  # heads and numbers, lines past them, and what stays clear
FOOT_MM = 3.0  # from a point to the line that leads from it
MIN_LENGTH_MM = 12.0  # of a line that bears two heads
LEVELS_MM = 7.0, 10.0, 13.0, 17.0, 21.0  # from a link to its line
MAX_SHORT_LEVEL_MM = 13.0  # of a line that short lines lead to: further away it would float
ALONG = 0.5, 0.35, 0.65  # where along a line its number may stand
RADII_MM = tuple(DRIVE_RADIUS + further for further in (4.0, 8.0, 12.0, 17.0))  # of arcs: outside the sense of turning
MIN_ANGLE = 12.0  # degrees: a smaller one has no room for an arc


def task_dimensions(mechanism: DrawnMechanism, drawn: Iterable[Item], tongue: Tongue) -> Iterator[Item]:
    """The angles of the drives, then the lengths of the links, the shortest nearest to its link."""
    obstacles, scene, spots = _shapes(drawn), mechanism.scene, mechanism.spots
    rect = mechanism.view.rect
    inside = shapely.box(rect.left, rect.bottom, rect.right, rect.top).buffer(-CLEAR_MM)
    lengths = sorted(link_lengths(scene), key=lambda one: math.dist(spots[one[0]], spots[one[1]]))
    places = [*(_angle_places(mechanism, pin, end, _number(fact, tongue)) for pin, end, fact in drive_angles(scene)),
              *(_length_places(spots[start], spots[end], _number(fact, tongue)) for start, end, fact in lengths)]
    for tried in places:
        chosen = next((items for items in tried if _is_clear(items, obstacles, inside)), [])
        obstacles += _shapes(chosen)
        yield from chosen


def _number(fact: SaidFact, tongue: Tongue) -> Runs:
    """A symbol with its value."""
    symbol, value = tongue(fact.quantity).split(" ", 1)
    return (*name_runs(symbol), *sentence_runs(f" {value}"))


def _length_places(start: Spot, end: Spot, number: Runs) -> Iterator[list[Item]]:
    """A line beside a link, its two leading lines, and its number on the far side; nearer places first."""
    if math.dist(start, end) < MIN_LENGTH_MM:
        return
    along = unit_vector(start, end)
    for level, side, foot in product(LEVELS_MM, (1, -1), (FOOT_MM, None)):
        if foot is None and level > MAX_SHORT_LEVEL_MM:
            continue
        tips = tuple(offset(spot, along, 0.0, side * level) for spot in (start, end))
        middle, away = interpolate(tips[0], tips[1], 0.5), (-side * along[1], side * along[0])
        lines: list[Item] = [Arrow(pens.DIMENSION, LAYER, None, middle, tip, HEAD_MM) for tip in tips]
        from_line = PAST_MM if foot is None else level - foot  # a short one passes the letter of its point
        lines += [Polyline(pens.DIMENSION, LAYER, None, (offset(tip, away, -from_line), offset(tip, away, PAST_MM)))
                  for tip in tips]
        for part in ALONG:
            yield [*lines, _text_beside(interpolate(tips[0], tips[1], part), away, number)]


def _angle_places(mechanism: DrawnMechanism, pin: str, end: str, number: Runs) -> Iterator[list[Item]]:
    """An arc from the x-axis to a crank, a line along the axis, and the angle beside the arc."""
    at, far = mechanism.spots[pin], mechanism.spots[end]
    angle = math.degrees(math.atan2(far[1] - at[1], far[0] - at[0])) % 360
    if angle < MIN_ANGLE:
        return
    for radius in RADII_MM:
        arc = Arc(pens.DIMENSION, LAYER, None, at, radius, 0.0, angle)
        axis = Polyline(pens.DIMENSION, LAYER, None, (offset(at, (1.0, 0.0), FOOT_MM),
                                                      offset(at, (1.0, 0.0), radius + PAST_MM)))
        back = arc.spot_at(angle - math.degrees(HEAD_MM / radius))
        tip = Arrow(pens.DIMENSION, LAYER, None, back, arc.spot_at(angle), HEAD_MM)
        head = Polygon(pens.SOLID, LAYER, None, tip.barbs)
        for spot in arc.spots(9.0)[1:-1]:
            yield [arc, axis, head, _text_beside(spot, unit_vector(at, spot), number)]


def _text_beside(spot: Spot, away: Spot, number: Runs) -> Text:
    """A number upright, its box clear of the line through a spot that is square to a direction."""
    text = Text(pens.LETTERS, LAYER, None, (0.0, 0.0), number, NUMBER_MM, "middle")
    box = text.box
    reach = CLEAR_MM + abs(away[0]) * (box.right - box.left) / 2 + abs(away[1]) * (box.top - box.bottom) / 2
    middle = offset(spot, away, reach)
    return Text(pens.LETTERS, LAYER, None, (middle[0], middle[1] - (box.top + box.bottom) / 2), number, NUMBER_MM,
                "middle")


def _shapes(items: Iterable[Item]) -> list[tuple[Item, Any]]:
    """The items that are in the way, with what they cover."""
    return [(item, shape) for item in items if (shape := covered(item)) is not None]


def _is_clear(items: Sequence[Item], drawn: Sequence[tuple[Item, Any]], inside: Any) -> bool:
    """Whether all stands in the panel, the number on nothing, and no line on letters or along other lines."""
    shapes = _shapes(items)
    if not all(inside.contains(shape) for _, shape in shapes):
        return False
    obstacles, lettered = [shape for _, shape in drawn], np.array([isinstance(other, Text) for other, _ in drawn], bool)
    return not any((shapely.distance(shape, obstacles) < _distances(item, lettered)).any() for item, shape in shapes)


def _distances(item: Item, lettered: Any) -> Any:
    """How far an item is to stand from what is lettered, and what is not: letters from all, lines from letters, and
    those with heads, which else would cross other lines or nearly run along them, half as far from these."""
    return np.where(lettered | isinstance(item, Text), CLEAR_MM, CLEAR_MM / 2 if isinstance(item, Arrow) else 0.0)
