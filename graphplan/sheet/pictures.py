"""A construction in pictures: which steps each of them shows, and under it their words.

Pictures follow the stages. One of the `stage` cut shows a stage, or short ones that follow each other on one plan; one
of the `mark` cut goes up to the next point that gets a letter; one of the `step` cut shows a step. What is too much for
a picture, by its movements or by letters that would stand on each other, is parted where the fewest helping marks are
used on both sides.

The window of a picture shows what its steps draw, in ink, and what they use of before, in grey, as large as there is
room, with so much of the plan that one sees where it is. What the lines reach later is in it where that costs little.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, groupby, pairwise
from typing import ClassVar

import shapely

from graphplan.kernel.kinds import CIRCLE, OPENING, POINT, Movement
from graphplan.kernel.program import Panel, Program, Step
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, arrange
from graphplan.sheet.layout.layout import back_to_front
from graphplan.sheet.lettering.label_candidates import AIR
from graphplan.sheet.lettering.letters import plate_items
from graphplan.sheet.lettering.prices import strokes
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Rect, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plans import Plans, bounding_box, extend_box
from graphplan.sheet.plates.plate import DrawnStep, Plate, Plates, Stroke
from graphplan.sheet.plates.view import clip_item, fit_scale, view
from graphplan.sheet.words.protocol import Entry, Passage, Protocol, SpokenStep

MARGIN = 7.0  # mm about the marks, for their letters
MIN_WINDOW, USUAL_WINDOW = 0.08, 0.4  # of the plan: no window shows less of it; so much if it need not be smaller
MAX_ENLARGEMENT = 1.5  # times as large a window may be for what else lies on its lines and arcs
WHOLE_MECHANISM = 1.25  # times as large a window is at most for the whole mechanism to be in it
EDGE = 1.0  # mm inside the window the mechanism ends that goes on beyond it: half a link, and the pen
MIN_HEIGHT = 0.4  # of its width: how high a window is at least
MIN_LINK_MM = 9.0  # mm: a mechanism with a shorter link is not shown where nothing is drawn on it
MIN_STROKE_MM = 0.25  # mm: no new stroke is thinner


def marks_used(program: Program, own: Collection[int]) -> frozenset[int]:
    """The earlier marks that steps read: with an opening its two points, with a line the points that name it."""
    used, waiting = set[int](), [arg for index in own for arg in program.steps[index].args]
    while waiting:
        step = program.steps[waiting.pop()]
        if step.index not in used and step.index not in own:
            used.add(step.index)
            named = step.op.movement is Movement.RULED and all(program.steps[arg].name for arg in step.args)
            waiting += step.args if named or step.op.gives == OPENING else ()
    return frozenset(used)


@dataclass(frozen=True)
class Excerpt(Plate):
    """A plate that shows some of its steps, their `own`, and those that they use."""

    whole: ClassVar[bool] = False
    own: frozenset[int]
    earlier: frozenset[int]

    @cached_property
    def steps(self) -> list[DrawnStep]:
        """Shown steps, in drawing order."""
        indices = self.own | self.earlier
        return [step for step in self.plates.steps if step.panel == self.panel and step.index in indices]

    @cached_property
    def drawn_mechanism(self) -> DrawnMechanism:
        """The whole mechanism where its links are long enough to be told apart, else what the steps use of it."""
        scene, whole = self.plates.scene, super().drawn_mechanism
        if all(math.dist(whole.spots[p], whole.spots[q]) >= MIN_LINK_MM for link in scene.moving
               for p, q in combinations(scene.links[link], 2) if scene.points[p] != scene.points[q]):
            return whole
        read = {step.name for step in self.plates.plans.drawing.drawn.steps if step.index in self.earlier and step.name}
        links = [link for link in scene.moving if len(read.intersection(scene.links[link])) > 1]
        return replace(whole, links=links, points=read.intersection(scene.points))

    @property
    def mechanism(self) -> list[Item]:
        """The links that are in the window, as far as they are, and the pairs that are wholly in it."""
        rect = self.view.rect.inset(*[EDGE] * 4)
        items = (item for item in super().mechanism
                 if not isinstance(item, Circle) or rect.holds(item.centre, -item.radius))
        return [cut for item in items for cut in clip_item(item, rect)]

    def marks(self, curve: DrawnStep) -> list[DrawnStep]:
        """The marks on a line or an arc: of what is used, those that are drawn by now; of an arc, those shown."""
        every, last = super().marks(curve), max(self.own)
        if curve.index in self.own:
            return every
        shown_marks = [mark for mark in every if mark.index in self.own or mark.index in self.earlier]
        return (shown_marks if curve.kind == CIRCLE else []) or [mark for mark in every if mark.index <= last] or every

    def strokes(self, drawn: DrawnStep) -> Iterator[Stroke]:
        """The strokes of a step; empty for an earlier point that is laid off from a hidden mark."""
        if drawn.index in self.own or drawn.root is None or self.is_on_panel(drawn.root):
            yield from super().strokes(drawn)

    def links_along(self, stroke: Stroke) -> Iterator[tuple[float, float]]:
        """None, where the line is new: it is seen on its link, too."""
        if stroke.of.index not in self.own:
            yield from super().links_along(stroke)

    def machine(self, letters: Iterable[Item]) -> Iterator[Item]:
        """None: a picture shows what a step needs."""
        yield from ()

    def breaks(self, drawn: DrawnStep) -> Iterator[tuple[Stroke, DrawnStep]]:
        """None: most lines leave the window."""
        yield from ()

    def numbers(self, drawn: DrawnStep) -> bool:
        """Whether a mark bears the number of its step: what is drawn here, and what has no letter."""
        return drawn.number > 0 and (drawn.index in self.own or not drawn.name)

    @property
    def wanted_vectors(self) -> list[Stroke]:
        """The vectors whose ends are both shown."""
        indices = {step.index for step in self.steps}
        return [vector for vector in super().wanted_vectors if {vector.start.index, vector.end.index} <= indices]

    def ink_or_grey(self, item: Item) -> Item:
        """An item in ink where it is new, else in grey: the mechanism paler, letters in one that can be read."""
        if isinstance(item, Text):
            return item if item.step in self.own else replace(item, pen=pens.FAINT)
        if item.step in self.own:
            return replace(item, pen=pens.firm(item.pen, MIN_STROKE_MM))
        once = pens.pale(item.pen)
        return replace(item, pen=once if item.step is not None else pens.pale(once))


def excerpt(plans: Plans, own: Collection[int], wide: float, high: float) -> Excerpt:
    """The picture of some steps of one plan, so many mm wide and as high as they need, but no higher than that."""
    program, new = plans.drawing.drawn, frozenset(own)
    panel, before = plans.plan_of_step[max(new)], marks_used(program, new)
    box = _box(plans, panel, new, before)
    inner = wide - 2 * MARGIN
    rect = Rect(0.0, 0.0, wide, min(inner * max(box.height / box.width, MIN_HEIGHT) + 2 * MARGIN, high))
    window = view(box, rect, fit_scale(box, rect.inset(MARGIN, MARGIN, MARGIN, MARGIN)))
    return Excerpt(Plates(plans, dict.fromkeys(plans.panels, window)), panel, new, before)


def _box(plans: Plans, panel: Panel, own: Collection[int], before: Collection[int]) -> Rect:
    """The part of a plan that a picture shows, in units of the plan."""
    halves = [spot for index, spot in plans.apexes(panel).items() if index in own]
    core = bounding_box([*_spots(plans, panel, {*own, *before}), *halves] or [plans.extents[panel].core.centre])
    whole = plans.extents[panel].core
    size = max(whole.width, whole.height)
    box = _at_least(core, MIN_WINDOW * size or 1.0)
    most = max(MAX_ENLARGEMENT * box.width, MAX_ENLARGEMENT * box.height, USUAL_WINDOW * size)
    more = {mark for index in own for mark in plans.marks_on.get(index, ())}
    more |= {mark for index in before for mark in plans.marks_on.get(index, ()) if mark <= max(own)}
    x, y = core.centre
    for spot in sorted(_spots(plans, panel, more), key=lambda spot: math.dist(spot, (x, y))):
        larger = extend_box(box, spot)
        box = larger if max(larger.width, larger.height) <= most else box
    if panel == MECHANISM:
        entire = extend_box(extend_box(box, whole.corners[0]), whole.corners[2])
        box = entire if max(entire.width, entire.height) <= WHOLE_MECHANISM * max(box.width, box.height) else box
    return box


def _spots(plans: Plans, panel: Panel, marks: Collection[int]) -> list[Spot]:
    """Places of the marks that are points of a plan."""
    steps = plans.drawing.drawn.steps
    spots = [plans.spot(i) for i in sorted(marks) if steps[i].op.gives == POINT and plans.plan_of_step[i] == panel]
    return [spot for spot in spots if all(map(math.isfinite, spot))]


def _at_least(box: Rect, size: float) -> Rect:
    """A box made larger about its middle: one side is no smaller than `size`, and neither much smaller than the other.
    """
    (x, y), large = box.centre, max(box.width, box.height, size)
    wide, high = max(box.width, MIN_HEIGHT * large), max(box.height, MIN_HEIGHT * large)
    wide = wide if max(wide, high) == large else large
    return Rect(x - wide / 2, y - high / 2, x + wide / 2, y + high / 2)


MARK, STEP, STAGE = CUTS = "mark", "step", "stage"
MAX_MOVEMENTS = {MARK: 12, STEP: 1, STAGE: 14}  # movements in a picture
MIN_MOVEMENTS = 3  # movements up to a mark, where more follow in their stage
SHORT_STAGE = 6  # movements of stages that stand together
PRICE_OF_PICTURE = 2.0  # the price of a further picture, in helping marks that are used in both


@dataclass(frozen=True)
class Part:
    """Steps of one passage of the protocol that follow each other on one plan."""

    passage: Passage
    steps: tuple[Step, ...]

    @property
    def begins(self) -> bool:
        """Whether the passage begins here."""
        return self.steps[0].index == self.passage.entries[0].movements[0].index

    @property
    def title(self) -> Said:
        """Title of the part."""
        return replace(self.passage, again=self.passage.again or not self.begins).title or self.passage.plan.words

    @property
    def entries(self) -> Iterator[tuple[Entry, list[SpokenStep]]]:
        """The entries of its steps, each with those of its movements that are among these."""
        indices = {step.index for step in self.steps}
        for entry in self.passage.entries:
            if movements := [movement for movement in entry.movements if movement.index in indices]:
                yield entry, movements

    def cut(self, runs: Iterable[Sequence[Step]]) -> Iterator[Part]:
        """Yield the parts of the runs."""
        for run in runs:
            yield Part(self.passage, tuple(run))


@dataclass(frozen=True, eq=False)
class Picture:
    """Some steps of one plan, part by part, in a window no larger than its `room`, width and height in mm."""

    protocol: Protocol
    parts: tuple[Part, ...]
    room: tuple[float, float]

    @property
    def steps(self) -> list[Step]:
        return [step for part in self.parts for step in part.steps]

    @cached_property
    def excerpt(self) -> Excerpt:
        """The excerpt that it shows, from its lower left corner."""
        return excerpt(self.protocol.plans, [step.index for step in self.steps], *self.room)

    @cached_property
    def items(self) -> list[Item]:
        """Items and letters of the picture, from back to front."""
        return back_to_front(map(self.excerpt.ink_or_grey, plate_items(self.excerpt)))

    @property
    def heading(self) -> Said:
        """Heading of the picture: its stage, or for several stages the plan."""
        one, *more = self.parts
        return arrange("{0:capital}", self.excerpt.panel.words) if more else one.title

    @property
    def letters_crowded(self) -> bool:
        """Whether its letters cannot all be read."""
        return letters_crowded(self.items)

    def halves(self) -> Iterator[Picture]:
        """Split it into two pictures, or a few more."""
        if len(self.parts) > 1:
            at = len(self.parts) // 2
            halves: Iterable[tuple[Part, ...]] = self.parts[:at], self.parts[at:]
        else:
            (part,) = self.parts
            most = (len(part.steps) + 1) // 2 + len(part.steps) // 6
            halves = ((one,) for one in part.cut(cut_into_runs(self.protocol.plans.drawing.drawn, part.steps, most)))
        for parts in halves:
            yield replace(self, parts=parts)


def pictures(protocol: Protocol, cut: str, room: tuple[float, float],
             fits: Callable[[Picture], bool]) -> list[Picture]:
    """The pictures of a construction, each no larger than its room, width and height in mm, and so that it `fits`."""
    cuts = {MARK: _by_marks, STEP: _by_steps, STAGE: _by_stages}
    return [picture for parts in cuts[cut](protocol)
            for picture in _split_until_it_fits(Picture(protocol, tuple(parts), room), fits)]


def _split_until_it_fits(one: Picture, fits: Callable[[Picture], bool]) -> Iterator[Picture]:
    """Split a picture until each part fits, with its letters apart."""
    if len(one.steps) > 1 and not (fits(one) and not one.letters_crowded):
        for half in one.halves():
            yield from _split_until_it_fits(half, fits)
    else:
        yield one


def _passage_parts(protocol: Protocol) -> Iterator[Part]:
    """The passages plan by plan."""
    plan_of_step = protocol.plans.plan_of_step
    for passage in protocol.passages:
        steps = [movement.step for entry in passage.entries for movement in entry.movements]
        for _, run in groupby(steps, lambda step: plan_of_step[step.index]):
            yield Part(passage, tuple(run))


def _by_steps(protocol: Protocol) -> Iterator[list[Part]]:
    """A picture for each step."""
    for part in _passage_parts(protocol):
        yield from ([step_part] for step_part in part.cut([step] for step in part.steps))


def _by_marks(protocol: Protocol) -> Iterator[list[Part]]:
    """A picture up to each entry that gives a point with a letter; what leaves no line stands with what follows."""
    begun, plan_of_step = list[Part](), protocol.plans.plan_of_step
    for part in _passage_parts(protocol):
        if begun and plan_of_step[begun[-1].steps[0].index] != plan_of_step[part.steps[0].index]:
            yield begun
            begun = []
        if all(step.op.free or step.op.gives == OPENING for step in part.steps):
            begun.append(part)
            continue
        group, runs = list[Step](), list[list[Step]]()
        for _, movements in part.entries:
            steps = [movement.step for movement in movements]
            group += steps
            marked = steps[-1].name and steps[-1].op.gives == POINT and len(group) >= MIN_MOVEMENTS
            if marked or len(group) >= MAX_MOVEMENTS[MARK]:
                runs, group = [*runs, group], []
        for movement in part.cut([*runs, *([group] if group else [])]):
            yield [*begun, movement]
            begun = []
    if begun:
        yield begun


def _by_stages(protocol: Protocol) -> Iterator[list[Part]]:
    """A picture for each stage, or for short ones that follow each other on a plan; long ones have several."""
    plans, short = protocol.plans, list[Part]()
    for part in _passage_parts(protocol):
        home = plans.plan_of_step[part.steps[0].index]
        count = sum(len(short_part.steps) for short_part in short)
        if short and (count + len(part.steps) > SHORT_STAGE or plans.plan_of_step[short[-1].steps[0].index] != home):
            yield short
            short = []
        if len(part.steps) > SHORT_STAGE:
            yield from ([short_part]
                        for short_part in part.cut(cut_into_runs(plans.drawing.drawn, part.steps,
                                                                 MAX_MOVEMENTS[STAGE])))
        else:
            short.append(part)
    if short:
        yield short


def cut_into_runs(program: Program, steps: Sequence[Step], most: int) -> list[Sequence[Step]]:
    """Steps that follow each other in runs of at most so many, cut where the fewest marks are used on both sides."""
    last = {arg: step.index for step in steps for arg in step.args}
    alive = [sum(last.get(step.index, -1) >= at.index for step in steps if step.index < at.index) for at in steps]
    cost, came = [0.0], [0]
    for end in range(1, len(steps) + 1):
        price = alive[end] + PRICE_OF_PICTURE if end < len(steps) else 0.0
        came.append(min(range(max(0, end - most), end), key=lambda start: (cost[start], -start)))
        cost.append(cost[came[end]] + price)
    ends = [len(steps)]
    while came[ends[-1]]:
        ends.append(came[ends[-1]])
    ends = [0, *reversed(ends)]
    return [steps[a:b] for a, b in pairwise(ends)]


def letters_crowded(items: Iterable[Item]) -> bool:
    """Whether letters stand on each other, or a thin line of another step goes through them."""
    all_items = list(items)
    letters = [item for item in all_items if isinstance(item, Text)]
    if any(letter.box.meets(neighbour.box) for letter, neighbour in combinations(letters, 2)):
        return True
    lines = [(item.step, shapely.linestrings(chain)) for item in all_items for chain, _ in strokes([item])]
    tree = shapely.STRtree([line for _, line in lines])
    boxes = [(letter.step, letter.box.inset(AIR, AIR, AIR, AIR)) for letter in letters]
    return any(lines[k][0] != step for step, box in boxes if box.width > 0 < box.height for k in tree.query(
        shapely.box(box.left, box.bottom, box.right, box.top), predicate="intersects"))
