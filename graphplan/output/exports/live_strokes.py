"""What is drawn of a figure, told by its marks: how much of each line and arc, and where its letters stand.

A target that keeps the construction alive cannot take strokes from the sheet as they lie; here each of them hangs on
marks, so that it moves with them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, pairwise

from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.methods.panels import VELOCITY_PLAN
from graphplan.output.exports.figure import SYMBOLS, Arrow, Figure, Link, Object, Plan
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import placed
from graphplan.sheet.lettering.lettering import Runs, listed, name_runs, width
from graphplan.sheet.lettering.letters import ALONG, MIDDLE, NEAR
from graphplan.sheet.plates import clip, pens
from graphplan.sheet.plates.display import Arc, Item, Polyline, Spot, Text
from graphplan.sheet.plates.drawn_step import LAYER
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import corner
from graphplan.sheet.plates.plate import NOTHING, SHORT
from graphplan.sheet.plates.symbols import RADIUS

HAIR = 0.1  # mm: a stroke that passes a link's points no farther off lies along it
REACH = 20.0  # mm: how far apart the two ends of a line stand that no two marks give


@dataclass(frozen=True)
class Stroke:
    """A straight stroke: from `low` to `high`, in parts of the way from one mark to another.

    Where a line has but one mark the way goes from there as the line heads (see :func:`heading`).
    """

    made: Object
    start: Object
    end: Object | None
    low: float
    high: float
    pen: Pen


@dataclass(frozen=True)
class Swing:
    """An arc of a circle: so many degrees before and after the ray from its centre to a mark on it."""

    made: Object
    mark: Object
    before: float
    after: float

    @property
    def half(self) -> bool:
        """Whether it is the half circle over a diameter."""
        return self.before == 0.0 or self.after == 0.0


@dataclass(frozen=True)
class Letter:
    """Lettering that stands off a mark: the middle of its base line so many mm from it, right and up; it may be led."""

    mark: Object
    off: Spot
    text: Text
    leader: Spot | None


def at_home(object: Object) -> bool:
    """Whether a mark is drawn on its own plan from what lies there, but for openings, directions and whole vectors.

    What is not is reckoned by its formula: on the draughtsman's paper the plans lie on each other, here they do not.
    """
    plan, args = object.plan, object.args
    match object.step.op.name:
        case "parallel" | "perpendicular":
            return args[1].plan is plan
        case "circle":
            return args[0].plan is plan
        case "transfer" | "quarter" | "step_off" | "step_across":
            return args[0].plan is args[1].plan and args[2].plan is plan
    return all(arg.plan is plan for arg in args)


def heading(line: Object) -> Spot:
    """How far, in mm, the two ends of a line stand apart: its own two points', or as the line that it follows."""
    match line.step.op.name if at_home(line) else "":
        case "line":
            return _vector(line.args[0].at, line.args[1].at)
        case "parallel":
            return heading(line.args[0])
        case "perpendicular":
            return _turned(heading(line.args[0]))
        case "bisector":
            return _turned(_vector(line.args[0].at, line.args[1].at))
    a, b, _ = line.line
    size = math.hypot(a, b)
    return REACH * b / size, -REACH * a / size


@dataclass(frozen=True)
class Traced:
    """One plan of a figure."""

    figure: Figure
    plan: Plan

    @property
    def first(self) -> bool:
        """Whether it is the mechanism's."""
        return self.plan is self.figure.plans[0]

    @cached_property
    def objects(self) -> list[Object]:
        """What is drawn on it, in order."""
        return [object for object in self.figure.objects if object.plan is self.plan]

    @cached_property
    def arrows(self) -> list[Arrow]:
        """The vectors on it that are long enough to be drawn."""
        return [a for a in self.figure.arrows if a.end.plan is self.plan and math.dist(a.start.at, a.end.at) >= SHORT]

    @cached_property
    def sides(self) -> list[tuple[Object, Object]]:
        """The sides of the links, on the mechanism's plan."""
        return list(chain.from_iterable(map(_sides, self.figure.links if self.first else ())))

    # ---- strokes ---------------------------------------------------------------------------------------------------

    @cached_property
    def strokes(self) -> list[Stroke]:
        """The lines of the plan and the strokes along which points are laid off, inside its window."""
        made = (self._line(o) if o.kind == LINE else self._laid_off(o) for o in self.objects)
        inside = (cut for stroke in made if stroke and (cut := self._clipped(stroke)))
        return [bare for stroke in inside for bare in self._bare(stroke) if math.dist(*self.ends(bare)) > NOTHING]

    def ends(self, stroke: Stroke) -> tuple[Spot, Spot]:
        """Where a stroke begins and ends on paper."""
        start, end = self._way(stroke)
        return clip.between(start, end, stroke.low), clip.between(start, end, stroke.high)

    def _way(self, stroke: Stroke) -> tuple[Spot, Spot]:
        """The way of which a stroke is a part."""
        start = stroke.start.at
        return start, stroke.end.at if stroke.end is not None else _sum(start, heading(stroke.made))

    def _line(self, line: Object) -> Stroke | None:
        """From the first mark on a line to the last and a little beyond."""
        found = self.figure.stretch(line)
        if found is None:
            return None
        start, end, beyond = found
        produced = line.step.op.name in ("line", "guide") and len(self.figure.marks[line]) > 2
        pen, long = pens.PRODUCED if produced else line.pen, math.dist(start.at, end.at)
        if long < NEAR:
            part = beyond / math.hypot(*heading(line))
            return Stroke(line, start, None, -part, part, pen)
        return Stroke(line, start, end, -beyond / long, 1.0 + beyond / long, pen)

    def _laid_off(self, point: Object) -> Stroke | None:
        """The stroke to a point from the mark that it is laid off from, where no vector takes its place."""
        root = _root(point)
        if root is None or root.plan is not self.plan or math.dist(root.at, point.at) < SHORT:
            return None
        if any({a.start, a.end} == {root, point} for a in self.arrows) or point in self.given:
            return None
        brought = point.step.op.movement is not Movement.MEASURED and point.args[0].plan is not self.plan
        return Stroke(point, root, point, 0.0, 1.0, pens.NORMAL if brought else pens.THIN)

    @cached_property
    def given(self) -> dict[Object, Object]:
        """The ends of given vectors, each with its beginning."""
        roots = {point: _root(point) for point in self.objects if point.name and point.step.op.scaled}
        return {point: root for point, root in roots.items() if root is not None and root.free}

    def _clipped(self, stroke: Stroke) -> Stroke | None:
        """What of a stroke lies in the plan's window."""
        start, end = self.ends(stroke)
        inside = clip.segment(self.plan.rect, start, end) if math.dist(start, end) > 0 else None
        if inside is None:
            return None
        long = stroke.high - stroke.low
        return replace(stroke, low=stroke.low + inside[0] * long, high=stroke.low + inside[1] * long)

    def _bare(self, stroke: Stroke) -> Iterator[Stroke]:
        """What of a stroke no link lies on: there the link is the line."""
        low = stroke.low
        for first, last in sorted(self._covered(*self._way(stroke))):
            if low < first:
                yield replace(stroke, low=low, high=min(first, stroke.high))
            low = max(low, last)
        if low < stroke.high:
            yield replace(stroke, low=low)

    def _covered(self, start: Spot, end: Spot) -> Iterator[tuple[float, float]]:
        """The parts of a way, in its lengths, along which links lie."""
        along, long = _vector(start, end), math.dist(start, end)
        for pair in self.sides:
            off = [_vector(start, mark.at) for mark in pair]
            if all(abs(_cross(along, spot)) < HAIR * long for spot in off):
                one, other = ((spot[0] * along[0] + spot[1] * along[1]) / long**2 for spot in off)
                yield min(one, other), max(one, other)

    # ---- arcs ------------------------------------------------------------------------------------------------------

    @cached_property
    def swings(self) -> list[Swing]:
        """The arcs of the plan: about each crossing, or over the diameter that a circle is struck on."""
        return list(chain.from_iterable(self._swings(o) for o in self.objects if o.kind == CIRCLE))

    def _swings(self, circle: Object) -> Iterator[Swing]:
        crossings = [mark for mark in self.figure.marks[circle] if self.plan.rect.holds(mark.at)]
        end = self._diameter(circle)
        if end is not None and crossings:
            left = _cross(_vector(circle.at, end.at), _vector(circle.at, crossings[0].at)) >= 0
            half = Swing(circle, end, 0.0, 180.0) if left else Swing(circle, end, 180.0, 0.0)
            if all(map(self.plan.rect.holds, self.arc(half).spots())):
                yield half
                return
        for mark in crossings if circle.radius > 0 else ():
            yield Swing(circle, mark, circle.struck, circle.struck)

    def _diameter(self, circle: Object) -> Object | None:
        """One end of a half circle's diameter: of a circle about the middle of two points through one of them."""
        centre, opening = circle.args
        if centre.step.op.name == "midpoint" and opening.step.op.name == "opening" and centre in opening.args:
            return next((arg for arg in opening.args if arg in centre.args), None)
        return None

    def arc(self, swing: Swing) -> Arc:
        """An arc as it lies on paper."""
        dx, dy = _vector(swing.made.at, swing.mark.at)
        middle = math.degrees(math.atan2(dy, dx))
        return Arc(swing.made.pen, LAYER, swing.made.index, swing.made.at, swing.made.radius,
                   middle - swing.before, middle + swing.after)  # fmt: skip

    # ---- marks and letters -----------------------------------------------------------------------------------------

    @cached_property
    def letters(self) -> list[Letter]:
        """The letters of the plan, each off the mark that it hangs on."""
        hung = list(self._wishes())
        marks = [object.at for object in self._shown]
        found = placed([wish for wish, _ in hung], list(self._items()), marks, self.plan.rect)
        leader: Spot | None = None
        letters, anchors = [], iter(hung)
        for item in found:
            if isinstance(item, Polyline):
                leader = item.spots[1]
            elif isinstance(item, Text):
                mark = next(anchors)[1]
                middle = item.at[0] + width(item.runs, item.size, item.bold) / 2, item.at[1]
                letters.append(Letter(mark, _vector(mark.at, middle), item, leader and _vector(mark.at, leader)))
                leader = None
        return letters

    @property
    def quantity(self) -> str:
        """What kind the given vectors of the plan are of."""
        return "velocity" if self.first or self.plan.name == VELOCITY_PLAN else "acceleration"

    @cached_property
    def dots(self) -> list[Object]:
        """The points in the window, but for the corners of force polygons and the heads of forces."""
        heads = {arrow.end for arrow in self.arrows if arrow.kind in pens.FORCES}
        return [o for o in self.objects if o.kind == POINT and self.plan.rect.holds(o.at)
                and not corner(o.step) and o not in heads]  # fmt: skip

    @property
    def _shown(self) -> list[Object]:
        """The points in the window that bear letters, and the pose's."""
        return [o for o in self.objects if o.kind == POINT and o.name and self.plan.rect.holds(o.at)]

    def _wishes(self) -> Iterator[tuple[Wish, Object]]:
        places: dict[Spot, list[Object]] = {}
        for point in self._shown:
            places.setdefault(next((s for s in places if math.dist(s, point.at) < NEAR), point.at), []).append(point)
        for spot, points in places.items():
            clear, bold = RADIUS + 0.4 if points[0].number == 0 else 0.6, all(corner(p.step) for p in points)
            yield Wish(listed([point.name for point in points]), (spot,), clear, bold=bold), points[0]
        for stroke in self.strokes:
            if stroke.made.kind == LINE and stroke.made.name:
                last = self.figure.marks[stroke.made][-1]
                yield self._free(name_runs(stroke.made.name), self.ends(stroke), ALONG), last
        for arrow in self.arrows:
            if arrow.label and arrow.label != arrow.end.name:
                yield self._free(name_runs(arrow.label), (arrow.start.at, arrow.end.at), MIDDLE), arrow.end

    def _free(self, runs: Runs, ends: tuple[Spot, Spot], parts: tuple[float, ...]) -> Wish:
        return Wish(runs, tuple(clip.between(*ends, part) for part in parts), 0.5, free=True)

    def _items(self) -> Iterator[Item]:
        """What letters should not stand on."""
        for stroke in self.strokes:
            yield Polyline(stroke.pen, LAYER, None, self.ends(stroke))
        for arrow in self.arrows:
            yield Polyline(pens.VECTORS[arrow.kind], "vectors", None, (arrow.start.at, arrow.end.at))
        for end, start in self.given.items():
            yield Polyline(pens.GIVEN["velocity"], "vectors", None, (start.at, end.at))
        for swing in self.swings:
            yield self.arc(swing)
        for symbol in self.figure.drawn_symbols(self.plan, *SYMBOLS):
            yield Polyline(symbol.pen, symbol.layer, None, symbol.spots)
        for one, other in self.sides:
            yield Polyline(pens.BAR, "links", None, (one.at, other.at))


def _root(point: Object) -> Object | None:
    """The mark that a point is laid off from, if it is."""
    return None if point.step.op.root is None else point.args[point.step.op.root]


def _sides(link: Link) -> list[tuple[Object, Object]]:
    """The sides of a link's polygon, or its one length."""
    return list(pairwise([*link.points, link.points[0]] if len(link.points) > 2 else link.points))


def _vector(one: Spot, other: Spot) -> Spot:
    return other[0] - one[0], other[1] - one[1]


def _sum(one: Spot, other: Spot) -> Spot:
    return one[0] + other[0], one[1] + other[1]


def _turned(vector: Spot) -> Spot:
    return -vector[1], vector[0]


def _cross(one: Spot, other: Spot) -> float:
    return one[0] * other[1] - one[1] * other[0]
