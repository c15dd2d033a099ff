"""From drawing steps to pencil strokes: how much of each line and arc is drawn, on one panel.

A line runs a little beyond the marks that lie on it; an arc is struck only about the crossings it serves; what leaves
the panel breaks off at its edge and says where it goes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.kernel.program import Step
from graphplan.methods.panels import MECHANISM, VELOCITY_PLAN
from graphplan.sheet.plates import clip, laid_off, pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Spot
from graphplan.sheet.plates.plans import Plans, Vector, corner
from graphplan.sheet.plates.view import View

LAYER = "construction"
BEYOND, LOCUS_BEYOND, ALONE = 2.5, 6.0, 7.0  # mm past the outermost mark; each way where there is only one mark
NOTHING = 0.3  # mm: what is left of a stroke is not drawn if it is shorter
SHORT, HIDDEN = 0.5, 3.0  # mm: a vector shorter than this is not drawn; nor is a load that its joint would hide
STRIKE, FLATTEST, WIDEST = 4.5, 5.0, 18.0  # half an arc: mm, and between these angles


@dataclass(frozen=True)
class Stretch:
    """The part of a line that is drawn, and the marks outside the panel that its ends point to."""

    start: Spot
    end: Spot
    to_start: int | None
    to_end: int | None

    @property
    def breaks(self) -> list[tuple[Spot, Spot, int]]:
        """The ends that break off: each with the other end and the mark that lies beyond."""
        ends = (self.start, self.end, self.to_start), (self.end, self.start, self.to_end)
        return [(tip, tail, mark) for tip, tail, mark in ends if mark is not None]


@dataclass(frozen=True)
class Strokes:
    """One plan on its panel, stroke by stroke."""

    plans: Plans
    panel: str
    view: View

    @cached_property
    def steps(self) -> list[Step]:
        plan_of_step = self.plans.plan_of_step
        return [step for step in self.plans.drawing.drawn.steps if plan_of_step[step.index] == self.panel]

    @cached_property
    def spots(self) -> dict[int, Spot]:
        """Where the points of this plan lie on paper."""
        return {i: self.view(self.plans.spot(i)) for i in self.plans.points(self.panel)}

    def shown(self, index: int) -> bool:
        """Whether a point lies on the panel."""
        return index in self.spots and self.view.rect.holds(self.spots[index])

    def items(self) -> Iterator[Item]:
        """Every stroke of the plan, cut off at the panel's edge, in drawing order."""
        for step in self.steps:
            for item in self._drawn(step):
                yield from clip.clipped(item, self.view.rect)
        yield from map(self._arrow, self.vectors)

    def _drawn(self, step: Step) -> Iterator[Item]:
        if step.op.gives == LINE:
            yield from self._line(step)
        elif step.op.gives == CIRCLE:
            yield from self.arcs(step)
        elif step.op.gives == POINT and step.op.name != "given":
            yield from self._point(step)

    # ---- points and vectors ----------------------------------------------------------------------------------------

    def _point(self, step: Step) -> Iterator[Item]:
        """A dot, unless forces meet there, and the stroke along which it was laid off."""
        here = self.spots[step.index]
        root = laid_off.root(step)
        if root in self.spots and not self._vector_between(self.spots[root], here):
            yield from self._laid_off(step, self.spots[root], here)
        if self.shown(step.index) and not corner(step) and step.index not in self._force_heads:
            pen = pens.ORIGIN if step.op.name == "begin" else pens.DOT
            yield Circle(pen, LAYER, step.index, here, 0.5 if step.name else 0.4)

    def _laid_off(self, step: Step, root: Spot, here: Spot) -> Iterator[Item]:
        """A vector that is given has a head; one brought from another plan is a firm stroke; all else is thin."""
        if laid_off.given(self.plans.drawing.drawn.steps, step) and math.dist(root, here) > SHORT:
            kind = "velocity" if self.panel in (MECHANISM, VELOCITY_PLAN) else "acceleration"
            yield Arrow(pens.GIVEN[kind], "vectors", step.index, root, here, min(3.0, 0.6 * math.dist(root, here)))
            return
        brought = step.op.name not in laid_off.MEASURED and self.plans.plan_of_step[step.args[0]] != self.panel
        for piece in _bare(root, here, self._forces_along(step, root, here)):
            yield Polyline(pens.NORMAL if brought else pens.THIN, LAYER, step.index, piece)

    def _vector_between(self, one: Spot, other: Spot) -> bool:
        """Whether a vector takes the place of a stroke."""
        ends = ((self.spots[v.start], self.spots[v.end]) for v in self.plans.vectors(self.panel))
        return any(sorted(map(math.dist, (one, other), pair))[-1] < 0.05
                   for start, end in ends for pair in ((start, end), (end, start)))  # fmt: skip

    @cached_property
    def _force_heads(self) -> set[int]:
        return {vector.end for vector in self.plans.vectors(self.panel) if vector.kind in pens.FORCES}

    @cached_property
    def vectors(self) -> list[Vector]:
        """The vectors that are long enough to be drawn."""
        least = dict.fromkeys(pens.FORCES, HIDDEN if self.panel == MECHANISM else SHORT)
        return [v for v in self.plans.vectors(self.panel) if self.length(v) >= least.get(v.kind, SHORT)]

    def length(self, vector: Vector) -> float:
        """How long a vector is on paper."""
        return math.dist(self.spots[vector.start], self.spots[vector.end])

    def _arrow(self, vector: Vector) -> Item:
        """A vector with its head."""
        start, end = self.spots[vector.start], self.spots[vector.end]
        head = min(pens.HEADS[vector.kind], 0.6 * self.length(vector))
        label = f"{vector.kind} {vector.point}"
        step = max(vector.start, vector.end)  # it is there when both its ends are
        return Arrow(pens.VECTORS[vector.kind], "vectors", step, start, end, head, label)

    # ---- lines -----------------------------------------------------------------------------------------------------

    def _direction(self, step: Step) -> Spot:
        a, b = (float(part) for part in self.plans.drawing.values[step.index][:2])
        size = math.hypot(a, b) or 1.0
        return b / size, -a / size

    def _line(self, step: Step) -> Iterator[Item]:
        stretch = self.stretches.get(step.index)
        if stretch is None:
            return
        pen = pens.LOCUS if step.name else pens.PRODUCED if step.op.name in ("line", "guide") else pens.THIN
        if self.directs(step):
            pen = pens.THIN
        start, end = stretch.start, stretch.end
        links = self._links_along(start, end) if self.panel == MECHANISM else ()
        for piece in _bare(start, end, [*links, *self._forces_along(step, start, end)]):
            yield Polyline(pen, LAYER, step.index, piece)
        for tip, tail, _ in stretch.breaks:
            yield Arrow(pens.THIN.filled(pens.GREY), LAYER, step.index, towards(tip, tail, 4.0), tip, 2.0)

    def _links_along(self, start: Spot, end: Spot) -> Iterator[tuple[float, float]]:
        """Where links lie along a segment, as fractions of its length: there the link is the line."""
        scene = self.plans.drawing.scene
        for link in scene.moving:
            spots = [self.view(self.plans.place(name)) for name in scene.links[link]]
            hit = _along(start, end, spots)
            if len(hit) > 1 and (len(hit) == len(spots) or len(spots) == 3):
                yield min(hit), max(hit)

    def _forces_along(self, step: Step, start: Spot, end: Spot) -> Iterator[tuple[float, float]]:
        """Where forces that are drawn before a step lie along its stroke: it does not cross their arrows out."""
        for vector in self.vectors if math.dist(start, end) > NOTHING else ():
            if vector.kind in pens.FORCES and vector.end < step.index:
                hit = _along(start, end, (self.spots[vector.start], self.spots[vector.end]))
                if len(hit) == 2 and max(hit) > 0 and min(hit) < 1:
                    yield max(min(hit), 0.0), min(max(hit), 1.0)

    def _on(self, step: Step) -> list[int]:
        """The marks of this plan on a line or an arc."""
        return [mark for mark in self.plans.marks_on.get(step.index, ()) if mark in self.spots]

    @cached_property
    def stretches(self) -> dict[int, Stretch]:
        found = {step.index: self._stretch(step) for step in self.steps if step.op.gives == LINE}
        return {index: stretch for index, stretch in found.items() if stretch is not None}

    def _stretch(self, step: Step) -> Stretch | None:
        """What of a line is drawn: from mark to mark and a little beyond, as far as the panel goes."""
        marks = self._on(step)
        if not marks:
            return None
        (ux, uy), root = self._direction(step), self.spots[marks[0]]
        along = sorted(((self.spots[m][0] - root[0]) * ux + (self.spots[m][1] - root[1]) * uy, m) for m in marks)
        (first, low), (last, high) = along[0], along[-1]
        beyond = self._beyond(step, last - first)
        start = root[0] + (first - beyond) * ux, root[1] + (first - beyond) * uy
        end = root[0] + (last + beyond) * ux, root[1] + (last + beyond) * uy
        inside = clip.segment(self.view.rect, start, end) if math.dist(start, end) > 0 else None
        if inside is None:
            return None
        return Stretch(clip.between(start, end, inside[0]), clip.between(start, end, inside[1]),
                       None if self.shown(low) else low, None if self.shown(high) else high)  # fmt: skip

    def directs(self, step: Step) -> bool:
        """Whether a line only serves as a direction: from one mark to another."""
        return step.op.name == "line" and len(self._on(step)) == 2

    def _beyond(self, step: Step, long: float) -> float:
        """How far past its outermost marks a line goes; one that only serves as a direction ends at them."""
        if self.directs(step):
            return 0.0
        if long < 1.0:
            return ALONE
        return LOCUS_BEYOND if step.name else BEYOND

    # ---- arcs ------------------------------------------------------------------------------------------------------

    def arcs(self, step: Step) -> Iterator[Arc]:
        """What of an arc is struck: about its crossings, or a half circle over its diameter."""
        x, y, r2 = (float(part) for part in self.plans.drawing.values[step.index])
        centre, radius = self.view((x, y)), math.sqrt(max(r2, 0.0)) * self.view.scale
        if radius < 1e-6:
            return
        crossings = [self.spots[mark] for mark in self._on(step)]
        diameter = self.plans.diameter(step)
        if diameter in self.spots and crossings:
            half = _half(step, centre, radius, self.spots[diameter], crossings[0])
            if all(map(self.view.rect.holds, half.spots())):
                yield half
                return
        wide = min(WIDEST, max(FLATTEST, math.degrees(STRIKE / radius)))
        for crossing in crossings:
            middle = _angle(centre, crossing)
            yield Arc(pens.ARC, LAYER, step.index, centre, radius, middle - wide, middle + wide)


def _along(start: Spot, end: Spot, spots: Sequence[Spot]) -> list[float]:
    """How far along a segment, in its lengths, those of the spots are that lie on its line."""
    (ux, uy), long = _unit(start, end), math.dist(start, end)
    off = [(x - start[0]) * uy - (y - start[1]) * ux for x, y in spots]
    along = [((x - start[0]) * ux + (y - start[1]) * uy) / long for x, y in spots]
    return [t for t, gap in zip(along, off, strict=True) if abs(gap) < 0.1]


def _bare(start: Spot, end: Spot, cuts: Iterable[tuple[float, float]]) -> list[tuple[Spot, Spot]]:
    """What is left of a segment without some parts of its length."""
    long, done, pieces = math.dist(start, end), 0.0, []
    for low, high in (*sorted(cuts), (1.0, 1.0)):
        if (low - done) * long > NOTHING:
            pieces.append((clip.between(start, end, done), clip.between(start, end, low)))
        done = max(done, high)
    return pieces


def _unit(start: Spot, end: Spot) -> Spot:
    long = math.dist(start, end)
    return (end[0] - start[0]) / long, (end[1] - start[1]) / long


def _half(step: Step, centre: Spot, radius: float, end: Spot, crossing: Spot) -> Arc:
    """The half circle over a diameter, on the side of the crossing."""
    start = _angle(centre, end)
    left = math.sin(math.radians(_angle(centre, crossing) - start)) >= 0
    first = start if left else start - 180.0
    return Arc(pens.ARC, LAYER, step.index, centre, radius, first, first + 180.0)


def _angle(centre: Spot, spot: Spot) -> float:
    return math.degrees(math.atan2(spot[1] - centre[1], spot[0] - centre[0]))


def towards(spot: Spot, other: Spot, far: float) -> Spot:
    """A spot so many mm on the way to another."""
    return clip.between(spot, other, far / (math.dist(spot, other) or 1.0))
