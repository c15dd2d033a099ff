"""Some steps of a plan in a window of their own: what they draw in ink, what they use of before in grey.

The window shows what the steps draw and use, as large as there is room, with so much of the plan that one sees where it
is. What the lines reach later on is in it where that costs little.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

from graphplan.kernel.kinds import CIRCLE, OPENING, POINT, Movement
from graphplan.kernel.program import Panel, Program
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Rect, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke
from graphplan.sheet.plates.plans import Plans, around, grown
from graphplan.sheet.plates.plate import Plate, Plates
from graphplan.sheet.plates.view import least, view

MARGIN = 7.0  # mm about the marks, for their letters
CONTEXT, ROUND = 0.08, 0.4  # of the plan: no window shows less of it; so much if it need not be smaller
MORE = 1.5  # times as large a window may be for what else lies on its lines and arcs
FLAT = 0.4  # of its width: how high a window is at least
OPEN = 9.0  # mm: a mechanism with a shorter link is not shown where nothing is drawn on it
FIRM = 0.25  # mm: no new stroke is thinner


def used(program: Program, own: Collection[int]) -> frozenset[int]:
    """The marks of before that steps read: with an opening its two points, with a line those that it is named by."""
    found, waiting = set[int](), [arg for index in own for arg in program.steps[index].args]
    while waiting:
        step = program.steps[waiting.pop()]
        if step.index not in found and step.index not in own:
            found.add(step.index)
            named = step.op.movement is Movement.RULED and all(program.steps[arg].name for arg in step.args)
            waiting += step.args if named or step.op.gives == OPENING else ()
    return frozenset(found)


@dataclass(frozen=True)
class Excerpt(Plate):
    """A plate that shows some of its steps, their `own`, and those that they use."""

    own: frozenset[int]
    used: frozenset[int]

    @cached_property
    def steps(self) -> list[DrawnStep]:
        """What is shown, in drawing order."""
        shown = self.own | self.used
        return [drawn for drawn in self.plates.steps if drawn.panel == self.panel and drawn.index in shown]

    @cached_property
    def drawn_mechanism(self) -> DrawnMechanism:
        """All the mechanism where its links are long enough to be no heap, else what the steps use of it."""
        scene, whole = self.plates.scene, super().drawn_mechanism
        if all(math.dist(whole.spots[p], whole.spots[q]) >= OPEN for link in scene.moving
               for p, q in combinations(scene.links[link], 2) if scene.points[p] != scene.points[q]):
            return whole
        read = {step.name for step in self.plates.plans.drawing.drawn.steps if step.index in self.used and step.name}
        links = [link for link in scene.moving if len(read.intersection(scene.links[link])) > 1]
        return replace(whole, links=links, points=read.intersection(scene.points))

    @cached_property
    def mechanism(self) -> list[Item]:
        """The links that are in the window, as far as they are, and the pairs that are wholly in it."""
        rect = self.view.rect
        return [item for item in super().mechanism
                if not isinstance(item, Circle) or rect.holds(item.centre, -item.radius)]

    def marks(self, curve: DrawnStep) -> list[DrawnStep]:
        """The marks on a line or an arc: of what is used, those that are drawn by now; of an arc, those shown."""
        every, last = super().marks(curve), max(self.own)
        if curve.index in self.own:
            return every
        shown = [mark for mark in every if mark.index in self.own or mark.index in self.used]
        return (shown if curve.kind == CIRCLE else []) or [mark for mark in every if mark.index <= last] or every

    def strokes(self, drawn: DrawnStep) -> Iterator[Stroke]:
        """What of a line is drawn; of a point of before that is laid off from elsewhere nothing."""
        if drawn.index in self.own or drawn.root is None or self.shown(drawn.root):
            yield from super().strokes(drawn)

    def breaks(self, stretch: Stroke) -> Iterator[tuple[Stroke, DrawnStep]]:
        """None: most lines leave the window."""
        yield from ()

    def numbers(self, drawn: DrawnStep) -> bool:
        """Whether a mark bears the number of its step: what is drawn here, and what has no letter."""
        return drawn.number > 0 and (drawn.index in self.own or not drawn.name)

    @cached_property
    def asked(self) -> list[Stroke]:
        """The vectors whose ends are both shown."""
        shown = {drawn.index for drawn in self.steps}
        return [one for one in super().asked if {one.start.index, one.end.index} <= shown]

    def inked(self, item: Item) -> Item:
        """An item in ink where it is new, else in grey: the mechanism paler, letters in one that can be read."""
        if isinstance(item, Text):
            return item if item.step in self.own else replace(item, pen=pens.FAINT)
        if item.step in self.own:
            return replace(item, pen=pens.firm(item.pen, FIRM))
        once = pens.pale(item.pen)
        return replace(item, pen=once if item.step is not None else pens.pale(once))


def excerpt(plans: Plans, own: Collection[int], wide: float, high: float) -> Excerpt:
    """The picture of some steps of one plan, so many mm wide and as high as they need, but no higher than that."""
    program, shown = plans.drawing.drawn, frozenset(own)
    panel, before = plans.plan_of_step[max(shown)], used(program, shown)
    box = _box(plans, panel, shown, before)
    inner = wide - 2 * MARGIN
    rect = Rect(0.0, 0.0, wide, min(inner * max(box.height / box.width, FLAT) + 2 * MARGIN, high))
    window = view(box, rect, least(box, rect.inset(MARGIN, MARGIN, MARGIN, MARGIN)))
    return Excerpt(Plates(plans, dict.fromkeys(plans.panels, window)), panel, shown, before)


def _box(plans: Plans, panel: Panel, own: Collection[int], before: Collection[int]) -> Rect:
    """What of a plan a picture shows, in units of the plan."""
    halves = [spot for index, spot in plans.apexes(panel).items() if index in own]
    core = around([*_spots(plans, panel, {*own, *before}), *halves] or [plans.extent(panel).core.centre])
    whole = plans.extent(panel).core
    size = max(whole.width, whole.height)
    box = _at_least(core, CONTEXT * size or 1.0)
    most = max(MORE * box.width, MORE * box.height, ROUND * size)
    more = {mark for index in own for mark in plans.marks_on.get(index, ())}
    more |= {mark for index in before for mark in plans.marks_on.get(index, ()) if mark <= max(own)}
    x, y = core.centre
    for spot in sorted(_spots(plans, panel, more), key=lambda spot: math.dist(spot, (x, y))):
        larger = grown(box, spot)
        box = larger if max(larger.width, larger.height) <= most else box
    return box


def _spots(plans: Plans, panel: Panel, marks: Collection[int]) -> list[Spot]:
    """Where those of the marks are that are points of a plan."""
    steps = plans.drawing.drawn.steps
    found = [plans.spot(i) for i in sorted(marks) if steps[i].op.gives == POINT and plans.plan_of_step[i] == panel]
    return [spot for spot in found if all(map(math.isfinite, spot))]


def _at_least(box: Rect, size: float) -> Rect:
    """A box made larger about its middle: one side is no smaller than `size`, and neither much smaller than the other.
    """
    (x, y), large = box.centre, max(box.width, box.height, size)
    wide, high = max(box.width, FLAT * large), max(box.height, FLAT * large)
    wide = wide if max(wide, high) == large else large
    return Rect(x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)
