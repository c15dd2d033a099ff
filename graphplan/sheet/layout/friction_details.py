"""Friction circles on a sheet: where they lie, or enlarged where a pin would cover them: beside the mechanism, or
wherever there is room on the page.

A detail shows the journal's centre, its friction circle and the force that touches it, as the last round has it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from graphplan.kernel.kinds import Sizing
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.enlargements import room_on_page
from graphplan.sheet.lettering.lettering import name_runs, sentence_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Rect, Spot, Text
from graphplan.sheet.plates.plate import DrawnStep
from graphplan.sheet.plates.symbols import RADIUS

DETAILS = "details"
ENLARGEMENTS = 2, 5, 10, 20, 50, 100, 200, 500, 1000
LEAST_RADIUS, HIGH, HALF_FORCE = 4.0, 26.0, 9.0  # mm: of an enlarged circle; of a detail; of a force, each way
GAP, PADDING = 1.5, 2.0  # mm between a mark and its letter, and about a caption


def friction_circles(composition: Composition, items: Sequence[Item]) -> Iterator[Item]:
    """The friction circles of a sheet on which these items lie, those without room for their detail left out."""
    touching = {mark.args[0]: mark for mark in composition.plates.steps if mark.step.op.sizing is Sizing.FRICTION}
    rooms = [room_on_page(composition, space, items) for space in (
        composition.arrangement.panels[MECHANISM], composition.arrangement.frame)] if touching else []
    for centre, mark in touching.items():
        radius = math.dist(centre.spot, mark.spot)
        if radius >= RADIUS:
            yield Circle(pens.ARC, DETAILS, None, centre.spot, radius)
        times = next((times for times in ENLARGEMENTS if times * radius >= LEAST_RADIUS), 0)
        if radius < RADIUS and times:
            text = sentence_runs(composition.plans.tongue(said("friction circle at {0}, {1} times as large",
                                                               centre.name, times)), (centre.name,))
            size = composition.arrangement.letters.text
            windows = (room.window(width(text, size) + 2 * PADDING, HIGH, is_first=True) for room in rooms)
            if window := next(filter(None, windows), None):
                for room in rooms:
                    room.take(window)
                yield Text(pens.LETTERS, DETAILS, None, (window.left + PADDING, window.bottom + PADDING), text, size)
                yield from _detail(centre, mark, times * radius, window, size)


def _detail(centre: DrawnStep, mark: DrawnStep, radius: float, window: Rect, size: float) -> Iterator[Item]:
    """A friction circle in its window, with the force that touches it."""
    middle = window.centre[0], window.centre[1] + size
    way = math.dist(centre.spot, mark.spot)
    ux, uy = ((end - start) / way for start, end in zip(centre.spot, mark.spot, strict=True))
    (x, y), (u, v) = mark.args[3].spot, mark.args[4].spot
    side = math.copysign(HALF_FORCE, (v - y) * ux - (u - x) * uy)
    touch = middle[0] + radius * ux, middle[1] + radius * uy
    start, end = ((touch[0] - k * side * uy, touch[1] + k * side * ux) for k in (-1, 1))
    yield Circle(pens.NORMAL, DETAILS, None, middle, radius)
    yield Arrow(pens.VECTORS["reaction"], DETAILS, None, start, end, pens.HEADS["reaction"])
    for named, at, aside in ((centre, middle, -1), (mark, touch, 1)):
        yield Circle(pens.DOT, DETAILS, None, at, 0.5)
        yield Text(pens.LETTERS, DETAILS, None, _base_line_start(at, (aside * ux, aside * uy), size),
                   name_runs(named.name), size, "middle")


def _base_line_start(spot: Spot, way: Spot, size: float) -> Spot:
    """Where the base line of a letter begins that stands beside a mark on this side of it."""
    return spot[0] + (GAP + size / 2) * way[0], spot[1] + (GAP + size / 2) * way[1] - size / 3
