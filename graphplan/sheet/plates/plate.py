"""A plate: what is drawn of each step of a plan, in which pen.

Strokes and arcs are told by their marks. So the sheet knows where they lie, in mm of the page with x to the right and y
up, and what keeps a construction alive can move them with the marks.

A line runs a little beyond the marks that lie on it; an arc is struck only about the crossings it serves; what leaves
the panel breaks off at its edge and says where it goes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import combinations, pairwise
from typing import Any, ClassVar

import numpy as np

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement, made_by
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel, Step
from graphplan.mechanism.model import Scene
from graphplan.methods.construction import DrawnVector
from graphplan.methods.panels import MECHANISM, VELOCITY_PLAN
from graphplan.phrases import digits
from graphplan.sheet.lettering.lettering import SMALL_SHEET, LetterSizes
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.machine import machine_items
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans, bounding_box, corner
from graphplan.sheet.plates.symbols import turn
from graphplan.sheet.plates.view import View, clip_item, clip_off_letters, clip_segment
from graphplan.sheet.tolerances import RADIUS_TOL, SHORT_STROKE

LAYER = "construction"
ON_LINE_MM = 0.1  # off a stroke, up to which a mark lies along it


@dataclass(frozen=True, eq=False)
class DrawnStep:
    """A drawn step, or a point of the pose that no step reads: what it makes, from which others, on which plan.

    `number` is 0 for the pose, `index` negative where no step reads it; `value` has the shape of its kind
    (kernel/kinds.py), in the units of its plan; all else is in mm of the page.
    """

    step: Step
    number: int
    panel: Panel
    view: View
    args: tuple[DrawnStep, ...] = field(repr=False)
    value: tuple[float, ...]
    say: Callable[[], str] = field(repr=False)

    @property
    def sentence(self) -> str:
        """The step's sentence; formed when first read."""
        return self.say()

    @property
    def index(self) -> int:
        return self.step.index

    @property
    def name(self) -> str:
        """The letter as in the program, or an empty text."""
        return self.step.name

    @property
    def kind(self) -> str:
        """The kind of mark."""
        return self.step.op.gives

    @cached_property
    def spot(self) -> Spot:
        """Place of a point, or of a circle's centre."""
        return self.view((self.value[0], self.value[1]))

    @property
    def radius(self) -> float:
        """The radius of a circle or an opening, mm."""
        return math.sqrt(max(self.value[-1], 0.0)) * self.view.scale

    @property
    def line(self) -> tuple[float, float, float]:
        """A line by its equation a x + b y + c = 0, running along (b, -a)."""
        a, b, c = self.value
        return a, b, c * self.view.scale - a * self.view.origin[0] - b * self.view.origin[1]

    @property
    def direction(self) -> Spot:
        """The direction of a line, as a vector 1 mm long."""
        a, b, _ = self.value
        length = math.hypot(a, b) or 1.0
        return b / length, -a / length

    def paper(self, height: float) -> tuple[float, ...]:
        """Place in mm of a page of this height, from the upper left corner, y down: a point x, y; a line a, b, c with a
        x + b y + c = 0, (a, b) one mm long; an opening its length; a circle x, y of its centre and its radius."""
        if self.kind == OPENING:
            return (self.radius,)
        if self.kind == LINE:
            (a, b, c), (u, v) = self.line, self.direction
            return v + 0.0, u + 0.0, -(c + b * height) / math.hypot(a, b)  # and no -0
        x, y = self.spot
        return (x, height - y) if self.kind == POINT else (x, height - y, self.radius)

    @property
    def free(self) -> bool:
        """Whether it is chosen freely: a point of the pose, or the beginning of a plan."""
        return self.step.op.free

    @property
    def root(self) -> DrawnStep | None:
        """The mark that a point is laid off from, if it is: a stroke joins the two."""
        return None if self.step.op.root is None else self.args[self.step.op.root]

    def factor(self, other: DrawnStep) -> float:
        """Factor from lengths in mm on the plan of another step to those here."""
        return self.view.scale / other.view.scale


@dataclass(frozen=True)
class Stroke:
    """A straight stroke, or a vector where it has a head, from `low` to `high` on the way from one mark to another.

    They are parts of that way; where the marks do not tell it they are mm the way that the line runs, `in_mm`.
    """

    of: DrawnStep
    start: DrawnStep
    end: DrawnStep
    low: float = 0.0
    high: float = 1.0
    pen: Pen = pens.THIN
    in_mm: bool = False
    head: float = 0.0
    layer: str = LAYER
    vector: DrawnVector | None = None

    @cached_property
    def ends(self) -> tuple[Spot, Spot]:
        """Start and end of the stroke."""
        (x, y), (u, v) = self.start.spot, self.end.spot
        dx, dy = self.of.direction if self.in_mm else (u - x, v - y)
        return (x + self.low * dx, y + self.low * dy), (x + self.high * dx, y + self.high * dy)

    def fractions_along(self, spots: Iterable[Spot]) -> list[float]:
        """Positions along the stroke, as fractions of its length, of those spots that lie on its line."""
        (start, end), long = self.ends, self.length
        ux, uy = (end[0] - start[0]) / long, (end[1] - start[1]) / long
        arms = [(x - start[0], y - start[1]) for x, y in spots]
        return [(x * ux + y * uy) / long for x, y in arms if abs(x * uy - y * ux) < ON_LINE_MM]

    @property
    def kind(self) -> str:
        """The kind of vector, if it is one that is asked for."""
        return self.vector.kind if self.vector else ""

    @property
    def letter(self) -> str:
        """The letter of a vector, if it has one that its end does not bear: v_A of the mechanism plan ends in v_a."""
        label = self.vector.label if self.vector else ""
        return "" if label.lower() == self.end.name.lower() else label

    @property
    def name(self) -> str:
        """The name of a vector that is asked for, such as `velocity A`."""
        return f"{self.kind} {self.vector.point}" if self.vector else ""

    @property
    def length(self) -> float:
        return math.dist(*self.ends)

    def sub_stroke(self, low: float, high: float) -> Stroke:
        """A part of it, by fractions of its length."""
        long = self.high - self.low
        return replace(self, low=self.low + low * long, high=self.low + high * long)

    @property
    def item(self) -> Item:
        """The stroke as it lies."""
        if not self.head:
            return Polyline(self.pen, self.layer, self.of.index, self.ends)
        return Arrow(self.pen, self.layer, self.of.index, *self.ends, self.head, self.name)


@dataclass(frozen=True)
class StruckArc:
    """An arc of a circle: so many degrees before and after the ray from its centre to a mark on it."""

    of: DrawnStep
    mark: DrawnStep
    before: float
    after: float
    pen: Pen = pens.ARC

    @property
    def half(self) -> bool:
        """Whether it is the half circle over a diameter."""
        return self.before == 0.0 or self.after == 0.0

    @property
    def item(self) -> Arc:
        """The arc as it lies."""
        (x, y), (u, v) = self.of.spot, self.mark.spot
        middle = math.degrees(math.atan2(v - y, u - x))
        return Arc(self.pen, LAYER, self.of.index, self.of.spot, self.of.radius, middle - self.before,
                   middle + self.after)  # fmt: skip


LINE_OVERRUN, LOCUS_OVERRUN, ALONE = 2.5, 6.0, 7.0  # mm past the outermost mark; each way where there is only one mark
CLOSE, SAME_ENDS_MM = 1.0, 0.05  # mm: marks closer together do not tell the way of a line; are one end
SHORT, MIN_LOAD_MM = 0.5, 3.0  # mm: a vector shorter than this is not drawn; nor is a load that its joint would hide
STRIKE, FLATTEST, WIDEST = 4.5, 5.0, 18.0  # half an arc: mm, and between these angles
GIVEN_HEAD, BREAK_HEAD, BREAK = 3.0, 2.0, 4.0  # mm: heads of given vectors and of ends that break off; their length


@dataclass(frozen=True)
class Plates:
    """A construction as it is drawn, each plan in its window on the page."""

    plans: Plans
    views: Mapping[str, View]
    letters: LetterSizes = SMALL_SHEET

    @property
    def scene(self) -> Scene:
        return self.plans.drawing.mechanism

    @cached_property
    def steps(self) -> list[DrawnStep]:
        """The drawn program, by index: those that are given, and the steps."""
        drawing = self.plans.drawing
        marks: list[DrawnStep] = []
        for step, value, panel in zip(drawing.drawn.steps, drawing.values, self.plans.plan_of_step, strict=True):
            args, number = tuple(marks[arg] for arg in step.args), max(0, drawing.drawn.number(step.index))
            marks.append(DrawnStep(step, number, panel, self.views[panel], args, tuple(map(float, value)),
                                   partial(self.plans.sentence, step.index)))
        return marks

    @cached_property
    def pose(self) -> dict[str, DrawnStep]:
        """Every point of the scene, those that no step reads or that are constructed among them."""
        points = {mark.name: mark for mark in self.steps if not mark.number or mark.name in self.scene.points}
        for name in self.scene.points:
            if name not in points:
                (x, y), index = self.plans.place(name), min((0, *(mark.index for mark in points.values()))) - 1
                step = Step(index, name, made_by(Movement.GIVEN), (), {"x": x, "y": y}, MECHANISM)
                sentence = step.op.sentence_of((), out=name, x=digits(x, 6), y=digits(y, 6))
                points[name] = DrawnStep(step, 0, MECHANISM, self.views[MECHANISM], (), (x, y),
                                         partial(self.plans.tongue, sentence))
        return points

    @property
    def all_marks(self) -> list[DrawnStep]:
        """All marks, each after those that it depends on: the pose, then the steps."""
        pose = (mark for mark in self.pose.values() if not mark.number)
        return [*pose, *(mark for mark in self.steps if mark.number)]

    @property
    def firsts(self) -> dict[DrawnStep, Plate]:
        """The first step that is drawn on each plan, with the plan."""
        firsts = {mark.panel: mark for mark in reversed(self.steps) if mark.number}
        return {mark: self[panel] for panel, mark in firsts.items()}

    @property
    def box(self) -> Rect:
        """The paper that the plans take up."""
        return bounding_box([spot for view in self.views.values() for spot in view.rect.corners])

    def __iter__(self) -> Iterator[Plate]:
        """The plans in drawing order, the mechanism's first."""
        return iter(self._plates.values())

    def __getitem__(self, panel: Panel) -> Plate:
        return self._plates[panel]

    @cached_property
    def _plates(self) -> dict[Panel, Plate]:
        return {panel: Plate(self, panel) for panel in self.plans.panels}


@dataclass(frozen=True)
class Plate:
    """One plan on its panel; arms of forces are drawn where it is `whole`."""

    whole: ClassVar[bool] = True
    plates: Plates
    panel: Panel

    @property
    def plans(self) -> Plans:
        return self.plates.plans

    @property
    def view(self) -> View:
        return self.plates.views[self.panel]

    @property
    def caption(self) -> str:
        """The title of the plan."""
        return self.plans.tongue(self.panel.caption(self.plans.kinds(self.panel)))

    @cached_property
    def steps(self) -> list[DrawnStep]:
        """The steps that are drawn here, in order, after what is given here."""
        return [mark for mark in self.plates.steps if mark.panel == self.panel]

    @property
    def beginnings(self) -> list[DrawnStep]:
        """The marks where the plan begins, which are chosen freely."""
        return [mark for mark in self.steps if mark.free and mark.number]

    def is_on_panel(self, mark: DrawnStep) -> bool:
        """Whether a point lies on the panel."""
        return mark.kind == POINT and mark.panel == self.panel and self.view.rect.holds(mark.spot)

    def marks(self, curve: DrawnStep) -> list[DrawnStep]:
        """The marks of this plan that lie on a line or an arc."""
        on = (self.plates.steps[mark] for mark in self.plans.marks_on.get(curve.index, ()))
        return [mark for mark in on if mark.panel == self.panel]

    @cached_property
    def drawn_mechanism(self) -> DrawnMechanism:
        """The mechanism, or what of it is shown."""
        return DrawnMechanism(self.plates.scene, self.view)

    @property
    def mechanism(self) -> list[Item]:
        """The links, pairs and ground, on the plan of the mechanism, and the paths of points."""
        if self.panel != MECHANISM:
            return []
        motion = self.plans.motion
        items = [*(motion.items(self.view, self.plates.scene) if motion else ()), *self.drawn_mechanism.items()]
        return [cut for item in items for cut in clip_item(item, self.view.rect)]

    def positions(self, letters: Iterable[Item]) -> Iterator[Item]:
        """Other positions of the mechanism in faint lines, which break off at letters."""
        motion = self.plans.motion if self.panel == MECHANISM else None
        return clip_off_letters(motion.faint(self.plates.scene, self.view) if motion else (), self.view.rect, letters)

    def machine(self, letters: Iterable[Item]) -> Iterator[Item]:
        """The machine that the mechanism is of, faint; its lines break off at letters."""
        items = machine_items(self.drawn_mechanism) if self.panel == MECHANISM else ()
        return clip_off_letters(items, self.view.rect, letters)

    def items(self) -> Iterator[Item]:
        """Every stroke of the plan as it lies, cut off at the panel's edge, in drawing order."""
        for mark in self.steps:
            yield from (stroke.item for stroke in self.strokes(mark))
            for arc in self.arcs(mark):
                yield from clip_item(arc.item, self.view.rect)
            if pen := self.dot(mark):
                yield Circle(pen, LAYER, mark.index, mark.spot, self.dot_radius(mark))
        yield from (stroke.item for stroke in self.vectors)

    def dot(self, drawn: DrawnStep) -> Pen | None:
        """The pen of a mark's dot; None for corners of force polygons, ends of forces, and marks off the panel."""
        return self.dotting(drawn) if self.is_on_panel(drawn) else None

    def dotting(self, drawn: DrawnStep) -> Pen | None:
        """The pen of a mark's dot where it lies on the panel."""
        if drawn.kind != POINT or corner(drawn.step) or (not drawn.number and drawn.name in self.plates.scene.points):
            return None
        ends_force = any(force.end is drawn for force in self._wanted_forces)
        return None if ends_force else pens.ORIGIN if drawn.free else pens.DOT

    def numbers(self, drawn: DrawnStep) -> bool:
        """Whether a mark bears the number of its step in any case."""
        return self.plans.numbered

    def dot_radius(self, drawn: DrawnStep) -> float:
        """The radius of its dot."""
        return 0.5 if drawn.name else 0.4

    # ---- vectors ---------------------------------------------------------------------------------------------------

    @property
    def vectors(self) -> list[Stroke]:
        """The vectors that are asked for and long enough to be drawn."""
        return [stroke for stroke in self.wanted_vectors if stroke.length >= self.shortest(stroke.kind)]

    def shortest(self, kind: str) -> float:
        """The mm below which a vector of a kind is not drawn."""
        return MIN_LOAD_MM if kind in pens.FORCES and self.panel == MECHANISM else SHORT

    @property
    def hidden_marks(self) -> Iterator[DrawnStep]:
        """Yield the marks that the sheet does not show: ends of forces that are too short to be drawn, points beyond
        the panel, and lines and arcs of which only the direction is needed."""
        yield from (force.end for force in self._wanted_forces if force not in self.vectors)
        is_visible = {POINT: self.is_on_panel, CIRCLE: self._is_struck, LINE: self._is_drawn}
        yield from (mark for mark in self.steps if mark.kind in is_visible and not is_visible[mark.kind](mark))

    def _is_struck(self, circle: DrawnStep) -> bool:
        """Whether an arc of a circle lies on the panel."""
        return any(self.view.rect.holds(spot) for arc in self.arcs(circle) for spot in arc.item.spots())

    def _is_drawn(self, line: DrawnStep) -> bool:
        """Whether a line is drawn somewhere, or lies along what is."""
        return any(stroke.length > SHORT_STROKE for stroke in self.strokes(line))

    @cached_property
    def wanted_vectors(self) -> list[Stroke]:
        """All vectors that are asked for on this plan; each is there when both its ends are."""
        strokes = []
        for vector in self.plans.vectors(self.panel):
            start, end = (self.plates.steps[mark] for mark in (vector.start, vector.end))
            last = max(start, end, key=lambda mark: mark.index)
            head = min(pens.HEADS[vector.kind], 0.6 * math.dist(start.spot, end.spot))
            strokes.append(Stroke(last, start, end, 0.0, 1.0, pens.VECTORS[vector.kind], False, head, "vectors",
                                  vector))
        return strokes

    @cached_property
    def _wanted_forces(self) -> list[Stroke]:
        """The forces among them."""
        return [vector for vector in self.wanted_vectors if vector.kind in pens.FORCES]

    # ---- strokes ---------------------------------------------------------------------------------------------------

    def strokes(self, drawn: DrawnStep) -> Iterator[Stroke]:
        """Strokes of a line, or the stroke along which a point is laid off; vectors stand apart."""
        if stretch := self.stretches.get(drawn.index):
            yield from self._uncovered_parts(stretch, self.links_along(stretch))
        elif (root := drawn.root) and not self._vector_between(root, drawn):
            yield from self._laid_off(drawn, root)
        elif drawn.step.op.movement in (Movement.TRACED, Movement.TRACES_MET):
            yield from self._traced_curves(drawn)
        yield from (arrow for arrow, _ in self.breaks(drawn))
        yield from self._similar_sides(drawn)

    def _similar_sides(self, drawn: DrawnStep) -> Iterator[Stroke]:
        """The sides of the triangle that a mark makes similar to a link's, where no vector is one."""
        corners = [self.plates.steps[corner] for corner in self.plans.similar_triangles.get(drawn.index, ())]
        for ends in combinations((*corners, drawn), 2):
            side = self._clip_to_panel(Stroke(drawn, *ends, pen=pens.SIDE))
            if side and not self._vector_between(*ends):
                yield side

    def _traced_curves(self, drawn: DrawnStep) -> Iterator[Stroke]:
        """The curves that cross in a point, each through four others, two on either side."""
        points = [mark for mark in drawn.args if mark.kind == POINT]
        for k in range(0, len(points), 4):
            for ends in pairwise([*points[k:k + 2], drawn, *points[k + 2:k + 4]]):
                if inside := self._clip_to_panel(Stroke(drawn, *ends)):
                    yield inside

    def _laid_off(self, drawn: DrawnStep, root: DrawnStep) -> Iterator[Stroke]:
        """A vector that is given has a head; one brought from another plan is a firm stroke; all else is thin."""
        stroke, given_pen = Stroke(drawn, root, drawn), self.given_pen(drawn)
        if given_pen and stroke.length > SHORT:
            yield replace(stroke, pen=given_pen, head=min(GIVEN_HEAD, 0.6 * stroke.length), layer="vectors")
        elif inside := self._clip_to_panel(replace(stroke, pen=self.laid_pen(drawn))):
            yield from self._uncovered_parts(inside)

    def given_pen(self, drawn: DrawnStep) -> Pen | None:
        """The pen of a vector that is given."""
        kind = "velocity" if self.panel in (MECHANISM, VELOCITY_PLAN) else "acceleration"
        return pens.GIVEN[kind] if self.plans.drawing.drawn.given_vector(drawn.step) else None

    def laid_pen(self, drawn: DrawnStep) -> Pen:
        """The pen of a stroke along which a point is laid off."""
        brought = drawn.step.op.movement is not Movement.MEASURED and drawn.args[0].panel != self.panel
        return pens.NORMAL if brought and not self._is_along_part(drawn) else pens.THIN

    def _is_along_part(self, drawn: DrawnStep) -> bool:
        """Whether the stroke along which a point is laid off lies along a part of an acceleration."""
        spots = [mark.spot for mark in (drawn.root, drawn) if mark]
        return any(part.kind in pens.ACCELERATION_PARTS and len(part.fractions_along(spots)) == 2
                   for part in self.vectors)

    def _vector_between(self, one: DrawnStep, other: DrawnStep) -> bool:
        """Whether a vector takes the place of a stroke between two marks."""
        apart = self._ends_of_vectors - np.array((one.spot, other.spot))
        return bool((np.hypot(apart[..., 0], apart[..., 1]).max(axis=1) < SAME_ENDS_MM).any())

    @cached_property
    def _ends_of_vectors(self) -> Any:
        """Starts and ends of vectors, in both senses."""
        ends = [(stroke.start.spot, stroke.end.spot) for stroke in self.wanted_vectors]
        return np.reshape([*ends, *(pair[::-1] for pair in ends)], (-1, 2, 2))

    @cached_property
    def stretches(self) -> dict[int, Stroke]:
        """The part of each line that lies in the panel, whether links and forces lie along it or not."""
        lines = (line for line in self.steps if line.kind == LINE)
        return {line.index: stretch for line in lines if (stretch := self._stretch(line))}

    def _stretch(self, line: DrawnStep) -> Stroke | None:
        """From the first mark on a line to the last and a little beyond, as far as the panel goes."""
        ux, uy = line.direction
        marks = sorted(self.marks(line), key=lambda mark: (mark.spot[0] * ux + mark.spot[1] * uy, mark.index))
        if not marks:
            return None
        first, last = marks[0], marks[-1]
        long = math.dist(first.spot, last.spot)
        close = long < CLOSE
        beyond, pen = self.line_pen(line)
        beyond, unit = (ALONE if beyond else 0.0, 1.0) if close else (beyond, long)
        return self._clip_to_panel(Stroke(line, first, last, -beyond / unit, (long + beyond) / unit, pen, close))

    def line_pen(self, line: DrawnStep) -> tuple[float, Pen]:
        """Overrun of a line beyond its outermost marks, in mm, and its pen."""
        if self.directs(line):
            return 0.0, pens.THIN
        if line.name:
            return LOCUS_OVERRUN, pens.LOCUS
        return LINE_OVERRUN, pens.PRODUCED if line.step.op.movement in (Movement.RULED, Movement.GUIDED) else pens.THIN

    def directs(self, line: DrawnStep) -> bool:
        """Whether a line only gives a direction, from one mark to another."""
        return line.step.op.movement is Movement.RULED and len(self.marks(line)) == 2

    def _clip_to_panel(self, stroke: Stroke) -> Stroke | None:
        """The part of a stroke that lies in the panel."""
        inside = clip_segment(self.view.rect, *stroke.ends) if stroke.length > 0 else None
        return stroke.sub_stroke(*inside) if inside else None

    def breaks(self, drawn: DrawnStep) -> Iterator[tuple[Stroke, DrawnStep]]:
        """The arrows where a line, or a stroke laid off, leaves the panel, each with the mark that it points to."""
        root, stretch = drawn.root, self.stretches.get(drawn.index)
        if root and not (self.given_pen(drawn) or self._vector_between(root, drawn)):
            stretch = self._clip_to_panel(Stroke(drawn, root, drawn))
        if not stretch:
            return
        for mark, end in ((stretch.start, 0.0), (stretch.end, 1.0)):
            if not self.is_on_panel(mark):
                arrow = stretch.sub_stroke(abs(end - min(BREAK / stretch.length, 1.0)), end)
                yield replace(arrow, pen=pens.THIN.with_fill(pens.GREY), head=BREAK_HEAD), mark

    def _uncovered_parts(self, stroke: Stroke, links: Iterable[tuple[float, float]] = ()) -> Iterator[Stroke]:
        """The parts of a stroke along which no link and no force lies."""
        long, done = stroke.length, 0.0
        for low, high in (*sorted([*links, *self._forces_along(stroke)]), (1.0, 1.0)):
            if (low - done) * long > SHORT_STROKE:
                yield stroke.sub_stroke(done, low)
            done = max(done, high)

    def links_along(self, stroke: Stroke) -> Iterator[tuple[float, float]]:
        """Yield the parts of a stroke, as fractions of its length, where links lie: there the link is the line."""
        scene = self.plates.scene
        for link in scene.moving if self.panel == MECHANISM else ():
            spots = [self.plates.pose[name].spot for name in scene.links[link]]
            hit = stroke.fractions_along(spots)
            if len(hit) > 1 and (len(hit) == len(spots) or len(spots) == 3):
                yield min(hit), max(hit)

    def _forces_along(self, stroke: Stroke) -> Iterator[tuple[float, float]]:
        """Yield the parts of a stroke where forces that are drawn before the step lie: it does not cross out their
        arrows."""
        for force in self._wanted_forces if stroke.length > SHORT_STROKE else ():
            if force.end.index < stroke.of.index and force.length >= self.shortest(force.kind):
                hit = stroke.fractions_along(force.ends)
                if len(hit) == 2 and max(hit) > 0 and min(hit) < 1:
                    yield max(min(hit), 0.0), min(max(hit), 1.0)

    # ---- arcs ------------------------------------------------------------------------------------------------------

    def arcs(self, drawn: DrawnStep) -> list[StruckArc]:
        """Struck parts of an arc: about its crossings, or a half circle over its diameter; all of a wanted one."""
        if drawn.index in self.plans.drawing.drawn.wanted and drawn.kind == CIRCLE and drawn.args[1].args:
            on = drawn.args[1].args[-1]
            return [StruckArc(drawn, on, *halves, pens.NORMAL) for halves in ((180.0, 0.0), (0.0, 180.0))]
        marks = self.marks(drawn) if drawn.kind == CIRCLE and drawn.radius > RADIUS_TOL else []
        end = self.plans.diameter(drawn.step) if marks else None
        if end is not None and self.plates.steps[end].panel == self.panel:
            left = turn(drawn.spot, self.plates.steps[end].spot, marks[0].spot) >= 0
            half = StruckArc(drawn, self.plates.steps[end], *((0.0, 180.0) if left else (180.0, 0.0)))
            if all(map(self.view.rect.holds, half.item.spots())):
                return [half]
        return self.arcs_about(drawn, marks)

    def arcs_about(self, drawn: DrawnStep, marks: Sequence[DrawnStep]) -> list[StruckArc]:
        """The arcs that are struck about marks on a circle."""
        wide = min(WIDEST, max(FLATTEST, math.degrees(STRIKE / drawn.radius))) if marks else 0.0
        return [StruckArc(drawn, mark, wide, wide) for mark in marks]


DOT_RADIUS_MM = 0.35
BACK_LAYER = "plates"  # curves and results lie over what they were constructed with


@dataclass(frozen=True)
class StyledPlates(Plates):
    """The plans of a drawing in their windows.

    By their steps: `pens` of lines, strokes and arcs that are not drawn thin; circles that are drawn `whole`; how many
    mm lines go `beyond` their outermost marks; what is `hidden`.
    """

    pens: Mapping[int, Pen] = field(default_factory=dict)
    whole: Mapping[int, Pen] = field(default_factory=dict)
    beyond: Mapping[int, float] = field(default_factory=dict)
    hidden: Collection[int] = ()

    @cached_property
    def _plates(self) -> dict[Panel, Plate]:
        return {panel: StyledPlate(self, panel) for panel in self.plans.panels}


def plate_of_values(values: Values, panel: Panel, view: View, scene: Scene, letters: LetterSizes,
                    pens: Mapping[int, Pen] | None = None, whole: Mapping[int, Pen] | None = None,
                    beyond: Mapping[int, float] | None = None, hidden: Collection[int] = ()) -> Plate:
    """One plan of a drawing in its window, in these styles; other plans of the drawing are not looked at."""
    plans = Plans.of_values(values, scene)
    views: dict[str, View] = dict.fromkeys(plans.panels, view)
    return StyledPlates(plans, views, letters, pens or {}, whole or {}, beyond or {}, hidden)[panel]


@dataclass(frozen=True)
class StyledPlate(Plate):
    """One plan of a drawing on its panel: no line breaks off with an arrow, and given marks have dots as others."""

    plates: StyledPlates

    @cached_property
    def steps(self) -> list[DrawnStep]:
        return [mark for mark in super().steps if mark.index not in self.plates.hidden]

    def items(self) -> Iterator[Item]:
        for mark in self.steps:
            if pen := self.plates.whole.get(mark.index):
                circle = Circle(pen, BACK_LAYER, mark.index, mark.spot, mark.radius)
                yield from clip_item(circle, self.view.rect)
        yield from (replace(item, layer=BACK_LAYER) for item in super().items())

    def dotting(self, drawn: DrawnStep) -> Pen | None:
        return pens.DOT if drawn.kind == POINT else None

    def dot_radius(self, drawn: DrawnStep) -> float:
        return DOT_RADIUS_MM

    def given_pen(self, drawn: DrawnStep) -> None:
        return None

    def laid_pen(self, drawn: DrawnStep) -> Pen:
        return self.plates.pens.get(drawn.index, pens.THIN)

    def line_pen(self, line: DrawnStep) -> tuple[float, Pen]:
        beyond, pen = super().line_pen(line)
        return self.plates.beyond.get(line.index, beyond), self.plates.pens.get(line.index, pen)

    def breaks(self, drawn: DrawnStep) -> Iterator[tuple[Stroke, DrawnStep]]:
        yield from ()

    def arcs(self, drawn: DrawnStep) -> list[StruckArc]:
        struck = drawn.kind == CIRCLE and drawn.radius > RADIUS_TOL and drawn.index not in self.plates.whole
        marks = self.marks(drawn) if struck else []
        return [replace(arc, pen=self.plates.pens.get(drawn.index, arc.pen)) for arc in self.arcs_about(drawn, marks)]
