"""Handouts: the sheet that a student draws on, with or without the steps, in the frame and windows of the solution.

A student's drawing lies exactly over the solution, so both have one composition.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

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
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.lettering import list_runs
from graphplan.sheet.lettering.letters import mechanism_wishes
from graphplan.sheet.plates.annotations import GivenArrows
from graphplan.sheet.plates.display import Circle, Item, Polyline, Rect, Sheet, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.drawn_step import LAYER
from graphplan.sheet.plates.pens import GREY, ORIGIN, Pen
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.traced_motion import LAYER as MOTION
from graphplan.sheet.task_dimensions import task_dimensions
from graphplan.sheet.words.rows import fill
from graphplan.sheet.words.task import TaskWords

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
    """What the plans have before their first steps: the task and its guided version have the same, but for crosses to
    measure by that would stand in what is given."""
    drawn = composition.plans.drawn
    windows = starting_items, *composition.views.values(), composition.arrangement.letters
    if windows not in drawn:
        drawn[windows] = [item for plate in composition.plates for item in starting_items(plate)]
    facts = [fact.box for fact in composition.arrangement.fact_items if isinstance(fact, Text)]
    return [item for item in drawn[windows] if not (item.layer == RULING and isinstance(item, Polyline) and any(
        box.holds(spot, CLEARANCE_MM) for box in facts for spot in item.spots))]


def with_corner_marks(page: Sheet, code: int) -> Sheet:
    """A page with the marks of a code in its corners."""
    return replace(page, items=(*page.items, *corner_marks(page.width, page.height, page.frame, code)))


def _with_task_words(composition: Composition, guided: bool) -> Composition:
    """The composition with other words in the place of the protocol, on pages of A4 where they are apart."""
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


def starting_items(plate: Plate) -> Iterator[Item]:
    """What a plan has before its first step: the mechanism with what drives and loads it, or crosses to measure by; and
    where it begins."""
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
        letters += task_dimensions(mechanism, [*items, *letters], plate.plans.tongue)
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
