"""Handouts: the sheet that a student draws on, with or without the steps, in the frame and windows of the solution.

A student's drawing lies exactly over the solution, so both have one composition; even the letters of the mechanism
stand in the same places.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said
from graphplan.sheet.frames.corner_marks import corner_marks, sheet_code
from graphplan.sheet.frames.title import GUIDED, SOLUTION, TASK
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import pages, titled
from graphplan.sheet.layout.paper import packed
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.lettering import listed
from graphplan.sheet.plates.display import Circle, Item, Polygon, Polyline, Rect, Sheet, Spot, Text, within
from graphplan.sheet.plates.drawn_step import LAYER
from graphplan.sheet.plates.pens import BORDER, GREY, ORIGIN, Pen
from graphplan.sheet.plates.selection import with_numbers
from graphplan.sheet.plates.traced_motion import LAYER as MOTION
from graphplan.sheet.words.rows import lettered
from graphplan.sheet.words.task import Task

RULING, RULED, CROSS = Pen(0.13, GREY), 10.0, 0.5  # a cross every 10 mm, half so long
FREE = 4.0  # mm about a beginning without crosses


def solution(composition: Composition) -> list[Sheet]:
    """The solved sheet of a handout, every mark with the number of its step, and pages of words if they stand apart."""
    return pages(with_numbers(composition), SOLUTION)


def code(composition: Composition) -> int:
    """What tells a handout's sheet from any other: its scene, and where its plans lie."""
    windows = (f"{panel}: {view.scale:.6g} mm, {view.origin[0]:.2f} {view.origin[1]:.2f}"
             for panel, view in composition.views.items())
    return sheet_code("\n".join((composition.plans.drawing.scene.text, composition.arrangement.paper, *windows)))


def task(solved: Sheet, composition: Composition) -> list[Sheet]:
    """The task of a solution: the mechanism, what is given and asked, empty plans, and a table to fill."""
    return list(_pages(solved, composition, TASK))


def guided(solved: Sheet, composition: Composition) -> list[Sheet]:
    """The same with the steps in words, a box to tick before each; the drawing is the student's."""
    return list(_pages(solved, composition, GUIDED))


def _pages(solved: Sheet, composition: Composition, document: Said) -> Iterator[Sheet]:
    """The sheet with its plans, and the pages of words that do not fit beside them."""
    arrangement = composition.arrangement
    words = arrangement.set(lambda wide: Task(composition.plans).lines(wide, document == GUIDED))
    apart = (*arrangement.columns, arrangement.title)
    bare = [item for item in solved.items if item.step is None and item.layer != MOTION and not within(item, apart)]
    begun = [item for panel in composition.views for item in _plan(composition, panel, bare)]
    empty = [item for item in bare if not within(item, arrangement.panels.values())]
    filled = packed(words, arrangement)
    marks = corner_marks(solved.width, solved.height, solved.frame, code(composition))
    for number, page in enumerate(filled, 1):
        block = titled(composition, document, number, len(filled))
        items = [*(bare + begun + marks if number == 1 else empty), *block, *lettered(page)]
        yield replace(solved, items=tuple(items), panels=solved.panels if number == 1 else {})


def _plan(composition: Composition, panel: str, bare: Sequence[Item]) -> Iterator[Item]:
    """What a plan has before its first step: where it begins, and crosses to measure by unless the mechanism is there.
    """
    rect = composition.views[panel].rect
    begins = [drawn for drawn in composition.plates.steps if drawn.panel == panel and drawn.free and drawn.number]
    spots = [drawn.at for drawn in begins]
    dots = [Circle(ORIGIN, LAYER, drawn.index, drawn.at, 0.5) for drawn in begins]
    wishes = [Wish(listed([drawn.name]), (drawn.at,), step=drawn.index, label=drawn.name)
              for drawn in begins if drawn.name]
    around = [_covered(item) for item in bare if within(item, (rect,))]
    if panel != MECHANISM:
        yield from _ruling(rect, spots)
    yield from dots
    yield from placed(wishes, [*dots, *around], spots, rect, composition.arrangement.letters)


def _covered(item: Item) -> Item:
    """What an item covers: lettering is as solid as a figure."""
    return Polygon(BORDER, item.layer, None, item.box.corners) if isinstance(item, Text) else item


def _ruling(rect: Rect, spots: list[Spot]) -> Iterator[Item]:
    """Crosses a centimetre apart, from where the plan begins."""
    x0, y0 = spots[0] if spots else rect.centre
    for y in _marks(y0, rect.bottom, rect.top):
        for x in _marks(x0, rect.left, rect.right):
            if not any(abs(x - u) < FREE and abs(y - v) < FREE for u, v in spots):
                yield Polyline(RULING, "ruling", None, ((x - CROSS, y), (x + CROSS, y)))
                yield Polyline(RULING, "ruling", None, ((x, y - CROSS), (x, y + CROSS)))


def _marks(start: float, low: float, high: float) -> Iterator[float]:
    """Places a centimetre apart, `start` among them, between two ends."""
    first = int((low + CROSS - start) // RULED) + 1
    last = int((high - CROSS - start) // RULED)
    yield from (start + RULED * i for i in range(first, last + 1))
