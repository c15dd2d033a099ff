"""The arms of the forces on Zhukovsky's lever: from the pole perpendicular to each line of action, with its letter."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot
from graphplan.sheet.plates.plate import Stroke
from graphplan.sheet.plates.symbols import offset, turn, unit_vector

LAYER = "arms"
MIN_ARM_MM = 6.0  # mm: a shorter arm is not drawn
MIN_MOMENT_SHARE = 0.05  # of the largest moment about the pole: the arm of a smaller one is told in words alone
PAST_MM = 1.5  # mm that a line of action goes on beyond the foot


class LeverArm(NamedTuple):
    """An arm on paper: its letter, its ends, and what is drawn of it and of the line of action that it is perpendicular
    to."""

    letter: str
    ends: tuple[Spot, Spot]
    items: tuple[Item, ...]


def lever_arms(pole: Spot, forces: Iterable[Stroke], rect: Rect) -> Iterator[LeverArm]:
    """The arms about a pole of those forces that count, whose lines of action come nearest to it inside the panel.

    The two forces of a couple bear one letter: the arm of the second has a prime.
    """
    letters, strokes = set[str](), [*forces]
    moments: dict[str, float] = {}
    for force in strokes:
        moments[force.letter] = max(moments.get(force.letter, 0.0), abs(turn(pole, *force.ends)))
    for force in strokes:
        start, end = force.ends
        along = unit_vector(start, end)
        reach = (pole[0] - start[0]) * along[0] + (pole[1] - start[1]) * along[1]
        foot = offset(start, along, reach)
        counts = moments[force.letter] >= MIN_MOMENT_SHARE * max(moments.values())
        if not counts or math.dist(pole, foot) < MIN_ARM_MM or not rect.holds(foot):
            continue
        items: list[Item] = [Polyline(pens.VECTORS["arm"], LAYER, None, (pole, foot))]
        beyond = max(reach - force.length, -reach)
        if beyond > 0:
            near = end if reach > force.length else start
            past = offset(foot, along, math.copysign(PAST_MM, reach))
            items.append(Polyline(pens.PRODUCED, LAYER, None, (near, past if rect.holds(past) else foot)))
        letter = f"h_{force.letter.replace('_', '')}"
        while letter in letters:
            letter += "′"
        letters.add(letter)
        yield LeverArm(letter, (pole, foot), tuple(items))
