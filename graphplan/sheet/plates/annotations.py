"""What is written at a mechanism: the dimensions of its links, and what drives and loads it.

Dimensions stand beside the mechanism, off its links, letters and one another. What drives and loads it is drawn at its
points as a task shows it: arrows that are all alike, each with its letter and its value, as nothing is to scale before
it is constructed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

from graphplan.mechanism.model import FRAME, Drive, Loads, Pair, Scene
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.phrases import digits, join, unit
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import Runs, name_runs, sentence_runs
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.symbols import (
    NEAR,
    Vector,
    are_collinear,
    distinct_spots,
    farthest_pair,
    hull,
    offset,
    unit_vector,
)
from graphplan.sheet.plates.view import interpolate
from graphplan.words.tongue import Tongue

FIRST_LEVEL_MM, LEVEL_PITCH_MM, MAX_LEVELS = 9.0, 6.0, 7  # from the points to the nearest dimension line, to the next
NUMBER_HEIGHT = 2.5  # mm: the height of its number
NUMBER_LENGTH = 9.0  # mm: about as long is its number
CROSSING_PRICE, OVERLAP_PRICE_PER_MM = 4.0, 0.5  # of what it crosses, and of each mm along it; a level costs 1


@dataclass(frozen=True)
class LinkDimension:
    """The distance of two points of the mechanism, by name, and how far to the left of the way its line stands, mm."""

    start: str
    end: str
    aside: float


def dimensions(scene: Scene, spots: Mapping[str, Spot], obstacles: Iterable[Item]) -> list[LinkDimension]:
    """The dimensions of all links, the frame's among them; each distance once, the shortest nearest to its link.

    Reads where points are in mm, and what else is drawn.
    """
    import shapely  # where nothing is drawn, as for a list of steps, it is not needed

    bodies = [[spots[name] for name in names] for names in scene.links.values()]
    obstacle_shapes = [*filter(None, map(covered, obstacles)),
                       *(shapely.LineString(ends) for body in bodies for ends in _sides(body))]
    placed: list[LinkDimension] = []
    for p, q in sorted(_measured_pairs(scene, spots),
                       key=lambda pair: (math.dist(spots[pair[0]], spots[pair[1]]), pair)):
        aside, figure = min((_price_place(spots[p], spots[q], level, side, obstacle_shapes)
                             for level in range(MAX_LEVELS)
                             for side in (1, -1)), key=lambda tried: tried[0])[1:]
        placed.append(LinkDimension(p, q, aside))
        obstacle_shapes.append(figure)
    return placed


def covered(item: Item) -> Any:
    """Area that an item covers, if it is in the way: the whole of a circle, and of an arc its chain of spots."""
    import shapely

    match item:
        case Text():
            return shapely.box(item.box.left, item.box.bottom, item.box.right, item.box.top)
        case Circle():
            return shapely.Point(item.centre).buffer(item.radius)
        case Arc():
            return shapely.LineString(item.spots())
        case Arrow():
            return shapely.LineString((item.start, item.end))
        case Polyline() | Polygon():
            return shapely.LineString(item.spots)
    return None


def _measured_pairs(scene: Scene, spots: Mapping[str, Spot]) -> Iterator[tuple[str, str]]:
    """The pairs of points of each link that are measured, no two of them at the same two places."""
    measured = set[frozenset[Spot]]()
    named: dict[Spot, str] = {}
    for names in scene.links.values():
        for name in names:
            named.setdefault(_place(spots[name], named), name)
    for names in scene.links.values():
        for p, q in _sides([spots[name] for name in names]):
            ends = _place(p, named), _place(q, named)
            if frozenset(ends) not in measured:
                measured.add(frozenset(ends))
                yield named[ends[0]], named[ends[1]]


def _place(spot: Spot, known: Iterable[Spot]) -> Spot:
    """The known place where a spot is, if it is at one."""
    return next((place for place in known if math.dist(place, spot) < NEAR), spot)


def _sides(spots: Sequence[Spot]) -> Iterator[tuple[Spot, Spot]]:
    """From point to point of a straight link; the sides of a plate, and from its two nearest corners to an inner point.
    """
    apart = distinct_spots(spots)
    if len(apart) < 2:
        return
    if are_collinear(apart):
        end, _ = farthest_pair(apart)
        yield from pairwise(sorted(apart, key=lambda spot: math.dist(end, spot)))
        return
    corners = hull(apart)
    corners = tuple(min(apart, key=lambda spot: math.dist(spot, corner)) for corner in corners)
    yield from pairwise((*corners, corners[0]))
    for inner in apart:
        if inner not in corners:
            yield from ((corner, inner) for corner in sorted(corners, key=lambda spot: math.dist(spot, inner))[:2])


def _price_place(p: Spot, q: Spot, level: int, side: int, drawn: Sequence[Any]) -> tuple[float, float, Any]:
    """Price of a dimension's place, its distance aside, and its area: the line with its number, and the two lines that
    lead to it."""
    import shapely

    along, aside = unit_vector(p, q), side * (FIRST_LEVEL_MM + LEVEL_PITCH_MM * level)
    start, end = offset(p, along, 0.0, aside), offset(q, along, 0.0, aside)
    middle = offset(((start[0] + end[0]) / 2, (start[1] + end[1]) / 2), along, 0.0, NUMBER_HEIGHT)
    number = shapely.LineString([offset(middle, along, -NUMBER_LENGTH / 2),
                                 offset(middle, along, NUMBER_LENGTH / 2)]).buffer(NUMBER_HEIGHT / 2)
    line = shapely.union_all([shapely.LineString([start, end]).buffer(1.0), number])
    leading = shapely.MultiLineString([(offset(foot, along, 0.0, side * 1.0), top)
                                       for foot, top in ((p, start), (q, end))])
    cost = float(level)
    for obstacle in drawn:
        if line.intersects(obstacle):
            cost += CROSSING_PRICE + OVERLAP_PRICE_PER_MM * shapely.intersection(line, obstacle).length
        if leading.intersects(obstacle):
            cost += CROSSING_PRICE / 2
    return cost, aside, shapely.union_all([line, leading])


# ---- what drives and loads it --------------------------------------------------------------------------------------

LAYER = "drive"
ARROW_LENGTHS = 15.0, 12.0, 9.0  # mm: of an arrow, the longest that stays on the panel
DRIVE_ARROW_OFFSET = 4.0  # mm from a block to the arrow of its drive
VALUE_FRACTIONS = 1.0, 0.85, 0.7, 0.5  # where along an arrow its value may stand

Marked = tuple[list[Item], Wish]  # an arrow, and its value beside it


@dataclass(frozen=True)
class GivenArrows:
    """The arrows of a mechanism in its window."""

    mechanism: DrawnMechanism
    tongue: Tongue

    @property
    def rect(self) -> Rect:
        return self.mechanism.view.rect

    def __iter__(self) -> Iterator[Marked]:
        """Every arrow with its value: drives, given motions, forces, moments."""
        scene, length = self.mechanism.scene, self.mechanism.scene.units.length
        yield from map(self._drive, filter(_moves, scene.drives))
        for name, motion in scene.motions.items():
            for letter, value, pen, of in (("v", motion.velocity, pens.GIVEN["velocity"], f"{length}/s"),
                                           ("a", motion.acceleration, pens.GIVEN["acceleration"], f"{length}/s²")):
                if any(value):
                    yield self._arrow(name, value, pen, self._value(f"{letter}_{name}", math.hypot(*value), of))
        if scene.loads:
            yield from self._loads(scene.loads)

    def _loads(self, loads: Loads) -> Iterator[Marked]:
        units, load = self.mechanism.scene.units, pens.VECTORS["load"]
        for letter, force in named_forces(loads).items():
            if any(force.value):
                value = self._value(letter, math.hypot(*force.value), units.force)
                yield self._arrow(force.at, force.value, load, value)
        for letter, moment in named_moments(loads).items():
            if moment.value:
                value = self._value(letter, abs(float(moment.value)), f"{units.force}·m")
                yield self._turn(self.mechanism.middle(moment.on), math.copysign(1.0, moment.value), value)

    def _value(self, letter: str, value: float, of: str) -> Runs:
        """A letter with its value."""
        value_text = join(("=", digits(float(value)), unit(of)), " ")
        return (*name_runs(letter), *sentence_runs(f" {self.tongue(value_text)}"))

    def _arrow(self, name: str, value: Pair, pen: Pen, told: Runs) -> Marked:
        """A vector from the point where it acts, or to it where only that way it stays on the panel."""
        along, at = unit_vector((0.0, 0.0), (float(value[0]), float(value[1]))), self.mechanism.spots[name]
        ends = [(offset(at, along, -long * back), offset(at, along, long * (1 - back)))
                for back in (0, 1) for long in ARROW_LENGTHS]
        start, end = next((pair for pair in ends if all(map(self.rect.holds, pair))), ends[0])
        return self._straight(start, end, pen, told)

    def _straight(self, start: Spot, end: Spot, pen: Pen, told: Runs) -> Marked:
        arrow = Arrow(pen, LAYER, None, start, end, pens.HEADS["velocity"])
        spots = tuple(interpolate(start, end, t) for t in VALUE_FRACTIONS)
        return [arrow], Wish(told, spots, 0.8, pen=replace(pen, width=0.0), label=f"given {start}", free=True)

    def _turn(self, at: Spot, sign: float, told: Runs) -> Marked:
        """An arc about a spot."""
        return self._turning_mark(list(symbols.drive(at, (0.0, 1.0), sign)), told)

    def _turning_mark(self, items: list[Item], told: Runs) -> Marked:
        """Items of a turning, with its value along the arc."""
        items = [replace(item, layer=LAYER) for item in items]
        arcs = [item for item in items if isinstance(item, Arc)]
        spots = tuple(spot for arc in arcs for spot in arc.spots(9.0))
        return items, Wish(told, spots, 0.8, label=f"given {spots[0]}", free=True)

    def _drive(self, drive: Drive) -> Marked:
        """The sense of turning, which the mechanism itself shows, or an arrow beside the sliding block."""
        scene, length = self.mechanism.scene, self.mechanism.scene.units.length
        if not drive.slides:
            value = self._value(rate_letters(drive)[0], abs(float(drive.rate)), "rad/s")
            symbol = list(self.mechanism.drive_symbol(drive))
            if not symbol:
                return self._turn(self.mechanism.middle(drive.link), math.copysign(1.0, drive.rate), value)
            _, wish = self._turning_mark(symbol, value)
            return [], wish
        value = self._value(rate_letters(drive)[0], abs(float(drive.rate)), f"{length}/s")
        slide = next(slide for slide in scene.slides if (slide.link, slide.along) == drive.links)
        at, (x, y) = self.mechanism.seat(slide), self.mechanism.direction(slide)
        direction: Vector = (x, y) if drive.rate > 0 else (-x, -y)
        start, end = offset(at, direction, -ARROW_LENGTHS[0] / 2,
                            DRIVE_ARROW_OFFSET), offset(at, direction, ARROW_LENGTHS[0] / 2, DRIVE_ARROW_OFFSET)
        return self._straight(start, end, pens.GIVEN["velocity"], value)


def _moves(drive: Drive) -> bool:
    return bool(drive.rate)


def rate_letters(drive: Drive) -> tuple[str, str]:
    """The letters of the velocity and the acceleration that a drive prescribes."""
    index = drive.link if drive.on == FRAME else f"{drive.link}{drive.on}"
    return ("v", "a") if drive.slides else (f"omega_{index}", f"alpha_{index}")
