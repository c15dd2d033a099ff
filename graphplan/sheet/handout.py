"""Handouts: the sheet that a student draws on, with or without the steps, in the frame and windows of the solution.

A student's drawing lies exactly over the solution, so both have one composition.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import product
from typing import Any

import numpy as np
import shapely

from graphplan.mechanism.model import FRAME
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said
from graphplan.sheet.frames.frame import corner_marks, frame_of, page_code, sheet_code
from graphplan.sheet.frames.title import GUIDED, SOLUTION, TASK
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.facts_block import FOUND
from graphplan.sheet.layout.layout import captions, frame_items, pages, sheet, with_numbers, words_pages
from graphplan.sheet.layout.paper import enlarge_words, paginate_tightly, words_page
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import Runs, list_runs, name_runs, sentence_runs
from graphplan.sheet.lettering.letters import mechanism_wishes, place_letters
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.annotations import GivenArrows, covered
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import GREY, ORIGIN, Pen
from graphplan.sheet.plates.plate import LAYER, Plate
from graphplan.sheet.plates.symbols import DRIVE_RADIUS, offset, unit_vector
from graphplan.sheet.plates.traced_motion import LAYER as MOTION
from graphplan.sheet.plates.view import interpolate
from graphplan.sheet.words.facts import SaidFact, drive_angles, link_lengths
from graphplan.sheet.words.rows import fill
from graphplan.sheet.words.task import TaskWords
from graphplan.words.tongue import Tongue

RULING = "ruling"
RULING_PEN, RULING_PITCH, CROSS_ARM = Pen(0.13, GREY), 10.0, 0.5  # a cross every 10 mm, half so long
ENLARGEMENT = 1.4  # times: the words of one page that has room for it
CLEARANCE_MM = 4.0  # mm about a beginning without crosses


def solution(composition: Composition) -> list[Sheet]:
    """The solved sheet of a handout, every mark with the number of its step, and pages of words if they stand apart."""
    return pages(with_numbers(composition), SOLUTION)


def code(composition: Composition) -> int:
    """Checksum of a handout's scene and of where its plans lie, by which a scan is recognized."""
    windows = (f"{panel}: {view.scale:.6g} mm, {view.origin[0]:.2f} {view.origin[1]:.2f}"
               for panel, view in composition.views.items())
    return sheet_code("\n".join((composition.plans.drawing.scene.text, composition.arrangement.paper, *windows)))


def task(composition: Composition) -> list[Sheet]:
    """The task: the mechanism, what is given and asked, empty plans, and a table to fill."""
    return _pages(composition, TASK)


def guided_task(composition: Composition) -> list[Sheet]:
    """The task with the steps in words, each with a box to tick; the student draws them."""
    return _pages(composition, GUIDED)


def _pages(composition: Composition, document: Said) -> list[Sheet]:
    """The sheet with its plans, and pages of words where there is no room for them beside the plans."""
    composition = _with_task_words(composition, document == GUIDED)
    items = [*frame_items(composition), *captions(composition), *_beginnings(composition)]
    first = sheet(composition, items, document)
    pages, first_code = [first, *words_pages(first, composition, document)], code(composition)
    return [with_corner_marks(page, page_code(first_code, number)) for number, page in enumerate(pages, 1)]


def _beginnings(composition: Composition) -> list[Item]:
    """Items of the plans before their first steps: the same for the task and its guided version, except for measuring
    crosses that would stand in the given facts."""
    drawn, facts = composition.plans.drawn, composition.arrangement.fact_items
    windows = starting_items, *composition.views.values(), composition.arrangement.letters, facts
    if windows not in drawn:
        drawn[windows] = [item for plate in composition.plates for item in starting_items(plate, facts)]
    boxes = [fact.box for fact in facts if isinstance(fact, Text)]
    return [item for item in drawn[windows] if not (item.layer == RULING and isinstance(item, Polyline) and any(
        box.holds(spot, CLEARANCE_MM) for box in boxes for spot in item.spots))]


def with_corner_marks(page: Sheet, code: int) -> Sheet:
    """A page with the marks of a code in its corners."""
    return replace(page, items=(*page.items, *corner_marks(page.width, page.height, page.frame, code)))


def _with_task_words(composition: Composition, guided: bool) -> Composition:
    """The composition with other words instead of the protocol, on pages of A4 where they are apart."""
    arrangement, scene = composition.arrangement, composition.plans.drawing.scene
    arrangement = replace(arrangement, fact_items=tuple(i for i in arrangement.fact_items if i.layer != FOUND))
    composition = replace(composition, arrangement=arrangement)
    words, frame = partial(TaskWords(composition.plans, composition=composition).lines, guided=guided), frame_of(scene)
    rows = arrangement.set(words) if arrangement.columns else ()
    if rows and fill(rows, arrangement.columns) is not None:
        return replace(composition, arrangement=replace(arrangement, rows=rows), protocol=())
    page = words_page(frame.paper("A4"), frame, frame.block(scene, composition.plans.tongue))
    filled = paginate_tightly(enlarge_words(words, ENLARGEMENT)(page.further_columns[0].width), page)
    if len(filled) > 1:
        filled = paginate_tightly(page.set(words), page)
    apart = tuple((page, placed_rows) for placed_rows in filled)
    return replace(composition, arrangement=replace(arrangement, rows=()), protocol=apart)


def starting_items(plate: Plate, facts: Sequence[Item] = ()) -> Iterator[Item]:
    """Items of a plan before its first step: the mechanism with its drives and loads, or measuring crosses; and the
    plan's origin. Dimensions stand clear of the `facts` on the page."""
    rect, begins = plate.view.rect, plate.beginnings
    spots = [mark.spot for mark in begins]
    items: list[Item] = [Circle(ORIGIN, LAYER, mark.index, mark.spot, plate.dot_radius(mark)) for mark in begins]
    wishes = [Wish(list_runs([mark.name]), (mark.spot,), step=mark.index, label=mark.name)
              for mark in begins if mark.name]
    if plate.panel == MECHANISM:
        scene = plate.plates.scene
        mechanism = _standing(plate) if scene.assembly else DrawnMechanism(scene, plate.view)
        arrows = [] if scene.assembly else list(GivenArrows(mechanism, plate.plans.tongue))
        items += mechanism.items() if scene.assembly else (item for item in plate.mechanism if item.layer != MOTION)
        items += (item for arrow, _ in arrows for item in arrow)
        wishes += [*mechanism_wishes(mechanism), *(value for _, value in arrows)]
        spots += mechanism.visible_points.values()
    else:
        yield from _ruling(rect, spots)
    yield from items
    letters = list(place_letters(wishes, items, spots, rect, plate.plates.letters))
    if plate.panel == MECHANISM and not plate.plates.scene.assembly:
        letters += task_dimensions(mechanism, [*items, *letters, *facts], plate.plans.tongue)
    yield from letters
    if not plate.plates.scene.assembly:
        yield from plate.machine(letters)


def _standing(plate: Plate) -> DrawnMechanism:
    """The points that stand still, of a mechanism whose pose is to be constructed."""
    scene = plate.plates.scene
    return DrawnMechanism(scene, plate.view, (), scene.links.get(FRAME, ()))


def _ruling(rect: Rect, spots: Sequence[Spot]) -> Iterator[Item]:
    """Crosses a centimetre apart, from where the plan begins."""
    x0, y0 = spots[0] if spots else rect.centre
    for y in _marks(y0, rect.bottom, rect.top):
        for x in _marks(x0, rect.left, rect.right):
            if not any(abs(x - u) < CLEARANCE_MM and abs(y - v) < CLEARANCE_MM for u, v in spots):
                yield Polyline(RULING_PEN, RULING, None, ((x - CROSS_ARM, y), (x + CROSS_ARM, y)))
                yield Polyline(RULING_PEN, RULING, None, ((x, y - CROSS_ARM), (x, y + CROSS_ARM)))


def _marks(start: float, low: float, high: float) -> Iterator[float]:
    """Places a centimetre apart, `start` among them, between two ends."""
    first = int((low + CROSS_ARM - start) // RULING_PITCH) + 1
    last = int((high - CROSS_ARM - start) // RULING_PITCH)
    yield from (start + RULING_PITCH * i for i in range(first, last + 1))


# ---- dimensions on a task's figure: where they stand clear, else their numbers alone; the facts say all ------------


DIMENSIONS = "dimensions"
HEAD_MM, NUMBER_MM, PAST_MM, CLEAR_MM = 2.4, 2.5, 1.5, 0.8  # heads and numbers, lines past them, and what stays clear
FOOT_MM = 3.0  # from a point to the line that leads from it
MIN_LENGTH_MM = 12.0  # of a line that bears two heads
LEVELS_MM = 7.0, 10.0, 13.0, 17.0, 21.0  # from a link to its line
MAX_SHORT_LEVEL_MM = 13.0  # of a line that short lines lead to: further away it would float
ALONG = 0.5, 0.35, 0.65  # where along a line its number may stand
BESIDE_LINK_MM = 1.5, 3.0, 5.0, 8.0  # from a link to a number without a line
RADII_MM = tuple(DRIVE_RADIUS + further for further in (4.0, 8.0, 12.0, 17.0))  # of arcs: outside the sense of turning
MIN_ANGLE = 12.0  # degrees: a smaller one has no room for an arc


def task_dimensions(mechanism: DrawnMechanism, drawn: Iterable[Item], tongue: Tongue) -> Iterator[Item]:
    """The angles of the drives, then the lengths of the links, the shortest nearest to its link."""
    obstacles, scene, spots = Obstacles(_shapes(drawn)), mechanism.scene, mechanism.spots
    rect = mechanism.view.rect
    inside = shapely.box(rect.left, rect.bottom, rect.right, rect.top).buffer(-CLEAR_MM)
    lengths = sorted(link_lengths(scene), key=lambda one: math.dist(spots[one[0]], spots[one[1]]))
    places = [*(_angle_places(mechanism, pin, end, _number(fact, tongue)) for pin, end, fact in drive_angles(scene)),
              *(_length_places(spots[start], spots[end], _number(fact, tongue)) for start, end, fact in lengths)]
    for tried in places:
        chosen = next((items for items in tried if obstacles.leave_clear(items, inside)), [])
        obstacles = Obstacles([*obstacles.shapes, *_shapes(chosen)])
        yield from chosen


def _number(fact: SaidFact, tongue: Tongue) -> Runs:
    """A symbol with its value."""
    symbol, value = tongue(fact.quantity).split(" ", 1)
    return (*name_runs(symbol), *sentence_runs(f" {value}"))


def _length_places(start: Spot, end: Spot, number: Runs) -> Iterator[list[Item]]:
    """A line beside a link, its two leading lines, and its number on the far side, nearer places first; then the number
    alone beside the link."""
    along = unit_vector(start, end)
    levels = LEVELS_MM if math.dist(start, end) >= MIN_LENGTH_MM else ()
    for level, side, foot in product(levels, (1, -1), (FOOT_MM, None)):
        if foot is None and level > MAX_SHORT_LEVEL_MM:
            continue
        tips = tuple(offset(spot, along, 0.0, side * level) for spot in (start, end))
        middle, away = interpolate(tips[0], tips[1], 0.5), (-side * along[1], side * along[0])
        lines: list[Item] = [Arrow(pens.DIMENSION, DIMENSIONS, None, middle, tip, HEAD_MM) for tip in tips]
        from_line = PAST_MM if foot is None else level - foot  # a short one passes the letter of its point
        lines += [Polyline(pens.DIMENSION, DIMENSIONS, None,
                           (offset(tip, away, -from_line), offset(tip, away, PAST_MM))) for tip in tips]
        for part in ALONG:
            yield [*lines, _text_beside(interpolate(tips[0], tips[1], part), away, number)]
    for far, part, side in product(BESIDE_LINK_MM, ALONG, (1, -1)):
        away = (-side * along[1], side * along[0])
        yield [_text_beside(offset(interpolate(start, end, part), away, far), away, number)]


def _angle_places(mechanism: DrawnMechanism, pin: str, end: str, number: Runs) -> Iterator[list[Item]]:
    """An arc from the x-axis to a crank, a line along the axis, and the angle beside the arc."""
    at, far = mechanism.spots[pin], mechanism.spots[end]
    angle = math.degrees(math.atan2(far[1] - at[1], far[0] - at[0])) % 360
    if angle < MIN_ANGLE:
        return
    for radius in RADII_MM:
        arc = Arc(pens.DIMENSION, DIMENSIONS, None, at, radius, 0.0, angle)
        axis = Polyline(pens.DIMENSION, DIMENSIONS, None, (offset(at, (1.0, 0.0), FOOT_MM),
                                                           offset(at, (1.0, 0.0), radius + PAST_MM)))
        back = arc.spot_at(angle - math.degrees(HEAD_MM / radius))
        tip = Arrow(pens.DIMENSION, DIMENSIONS, None, back, arc.spot_at(angle), HEAD_MM)
        head = Polygon(pens.SOLID, DIMENSIONS, None, tip.barbs)
        for spot in arc.spots(9.0)[1:-1]:
            yield [arc, axis, head, _text_beside(spot, unit_vector(at, spot), number)]


def _text_beside(spot: Spot, away: Spot, number: Runs) -> Text:
    """A number upright, its box clear of the line through a spot that is perpendicular to a direction."""
    text = Text(pens.LETTERS, DIMENSIONS, None, (0.0, 0.0), number, NUMBER_MM, "middle")
    box = text.box
    reach = CLEAR_MM + abs(away[0]) * (box.right - box.left) / 2 + abs(away[1]) * (box.top - box.bottom) / 2
    middle = offset(spot, away, reach)
    return Text(pens.LETTERS, DIMENSIONS, None, (middle[0], middle[1] - (box.top + box.bottom) / 2), number, NUMBER_MM,
                "middle")


def _shapes(items: Iterable[Item]) -> list[tuple[Item, Any]]:
    """The items that are in the way, with what they cover."""
    return [(item, shape) for item in items if (shape := covered(item)) is not None]


@dataclass(frozen=True)
class Obstacles:
    """Items on a figure with their shapes."""

    shapes: Sequence[tuple[Item, Any]]

    @property
    def _are_letters(self) -> Any:
        return np.array([isinstance(item, Text) for item, _ in self.shapes], bool)

    @cached_property
    def _tree(self) -> shapely.STRtree:
        return shapely.STRtree([shape for _, shape in self.shapes])

    def leave_clear(self, items: Sequence[Item], inside: Any) -> bool:
        """Whether all items stand in the panel, the number clear of all, and no line on letters or along other
        lines."""
        shapes = _shapes(items)
        return all(inside.contains(shape) for _, shape in shapes) and not any(self._is_near(*one) for one in shapes)

    def _is_near(self, item: Item, shape: Any) -> bool:
        """Whether something stands too near to an item, which covers a shape."""
        near = self._tree.query(shape, "dwithin", CLEAR_MM)
        distances = shapely.distance(shape, self._tree.geometries[near])
        return bool((distances < _distances(item, self._are_letters[near])).any())


def _distances(item: Item, lettered: Any) -> Any:
    """Distances that an item keeps from letters and from other items: letters from all, lines from letters, and lines
    with heads, which could cross other lines or nearly run along them, half as far from these."""
    return np.where(lettered | isinstance(item, Text), CLEAR_MM, CLEAR_MM / 2 if isinstance(item, Arrow) else 0.0)
