"""What the steps of a recorded program draw on their panels: dots, lines from mark to mark, arcs, vectors, letters.

A line runs from its first mark to its last and a little beyond, an arc is struck about the marks that lie on it; what
leaves the panel is cut off at its edge.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphplan.kernel.drawing import Values
from graphplan.kernel.incidence import incident
from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.program import Panel, Step
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.lettering import LetterSizes, name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.view import View, clip_item

DOT = 0.35  # mm: radius of marks
BEYOND, STUB, STRIKE = 1.5, 3.0, 3.0  # mm: of lines beyond their marks, of a line with one mark, of an arc to each side
HEAD = 3.0  # mm: of a vector's head
STROKES = Movement.LAID_OFF, Movement.LAID_BY_COMPONENTS, Movement.TURNED, Movement.MEASURED
TINTED = "paper"  # the layer of tints, on which letters may stand
ALONG = 0.97, 0.03, 0.85, 0.15, 0.5  # where along a line its letter may stand


@dataclass(frozen=True)
class StepInk:
    """A program on its panels, through windows that take the lengths of each plan to mm of paper.

    By their steps: `pens` of lines, strokes and arcs that are not drawn thin; circles that are drawn `whole`; how many
    mm lines go `beyond` their outermost marks; `vectors`, the pens of arrows that end in points; what is `hidden`.
    """

    values: Values
    views: Mapping[Panel, View]
    letters: LetterSizes
    pens: Mapping[int, Pen] = field(default_factory=dict)
    whole: Mapping[int, Pen] = field(default_factory=dict)
    beyond: Mapping[int, float] = field(default_factory=dict)
    vectors: Mapping[int, Pen] = field(default_factory=dict)
    hidden: Collection[int] = ()

    @property
    def program_steps(self) -> Sequence[Step]:
        """All steps of the program."""
        return self.values.drawing.program.steps

    @cached_property
    def spot_of_mark(self) -> list[Any]:
        """The places of all points on paper; of other marks, and of points that no window shows, nothing."""
        return [self.views[step.panel](value[:2]) if step.op.gives == POINT and step.panel in self.views else None
                for step, value in zip(self.program_steps, self.values.numbers, strict=True)]

    @cached_property
    def marks(self) -> dict[int, list[int]]:
        """The points on each line and circle, by construction, that lie on its plan."""
        found: dict[int, list[int]] = defaultdict(list)
        steps = self.program_steps
        for step in steps:
            if step.op.gives == LINE:
                found[step.index] += [step.args[place] for place in incident(step.op)]
            elif step.op.gives == POINT:
                for arg in step.args:
                    if steps[arg].op.gives in (LINE, CIRCLE):
                        found[arg].append(step.index)
        return {curve: [mark for mark in marks if steps[mark].panel == steps[curve].panel]
                for curve, marks in found.items()}

    def steps(self, panel: Panel) -> list[Step]:
        """The steps that draw on a panel."""
        return [step for step in self.program_steps if step.panel == panel and step.index not in self.hidden]

    def items(self, panel: Panel) -> Iterator[Item]:
        """The ink of a panel, step by step."""
        rect = self.views[panel].rect
        for step in self.steps(panel):
            for item in self._step(step, self.views[panel]):
                yield from clip_item(item, rect)

    def items_with_letters(self, panel: Panel, others: Collection[Item] = (), wishes: Iterable[Wish] = (),
                 named: Callable[[Step], bool] = lambda step: True) -> list[Item]:
        """The ink of a panel with letters that avoid it and each other, and what else is drawn there, letters or not.

        Other letters may be wished for; of the steps those have letters that are to be `named`.
        """
        ink, rect = [*self.items(panel), *others], self.views[panel].rect
        taken = [Polygon(item.pen, item.layer, None, item.box.corners) for item in others if isinstance(item, Text)]
        off = [item for item in ink if item.layer != TINTED]
        marks = [self.spot_of_mark[step.index] for step in self.steps(panel)
                 if step.op.gives == POINT and rect.holds(self.spot_of_mark[step.index])]
        wanted = [*self.wishes(panel, named), *wishes]
        return [*ink, *place_letters(wanted, [*off, *taken], marks, rect, self.letters)]

    def wishes(self, panel: Panel, named: Callable[[Step], bool] = lambda step: True) -> Iterator[Wish]:
        """The letters of the points of a panel, and of its lines that have some."""
        rect = self.views[panel].rect
        for step in self.steps(panel):
            if not step.name or not named(step):
                continue
            if step.op.gives == POINT and rect.holds(self.spot_of_mark[step.index]):
                spot = self.spot_of_mark[step.index]
                yield Wish(name_runs(step.name), (spot,), DOT + 0.3, step=step.index, label=step.name)
            elif step.op.gives == LINE and (ends := self._ends(step)):
                (x, y), (u, v) = ends
                spots = tuple(at for t in ALONG if rect.holds(at := (x + t * (u - x), y + t * (v - y))))
                if spots:
                    yield Wish(name_runs(step.name), spots, 0.5, step=step.index, label=step.name, free=True)

    # ---- what a step draws -----------------------------------------------------------------------------------------

    def _step(self, step: Step, view: View) -> Iterator[Item]:
        if step.op.gives == POINT:
            yield from self._point(step)
        elif step.op.gives == LINE:
            if ends := self._ends(step):
                pen = pens.PRODUCED if step.op.movement is Movement.RULED else pens.THIN
                yield Polyline(self.pens.get(step.index, pen), "plates", step.index, ends)
        elif step.op.gives == CIRCLE:
            yield from self._circle(step, view)

    def _point(self, step: Step) -> Iterator[Item]:
        """A dot; and the stroke along which it is laid off, or the vector that ends in it."""
        spot, root = self.spot_of_mark[step.index], self.spot_of_mark[step.root] if step.root is not None else None
        if step.index in self.vectors and root is not None and step.root is not None:
            head = min(HEAD, 0.6 * math.dist(root, spot))
            yield Arrow(self.vectors[step.index], "plates", step.index, root, spot, head, step.name)
            return
        if step.op.movement in STROKES and root is not None and self.program_steps[step.root or 0].panel == step.panel:
            yield Polyline(self.pens.get(step.index, pens.THIN), "plates", step.index, (root, spot))
        yield Circle(pens.DOT, "plates", step.index, spot, DOT)

    def _ends(self, step: Step) -> tuple[Spot, Spot] | None:
        """From a line's first mark to its last and a little beyond; a stub where it has one alone."""
        a, b, _ = self.values[step.index]
        size = math.hypot(a, b)
        ux, uy = b / size, -a / size
        found = sorted((self.spot_of_mark[mark] for mark in self.marks.get(step.index, ())),
                       key=lambda at: at[0] * ux + at[1] * uy)
        if not found:
            return None
        first, last = found[0], found[-1]
        low, high = (0.0, STUB) if math.dist(first, last) < DOT else (BEYOND, BEYOND)
        if step.index in self.beyond:
            low = high = self.beyond[step.index]
        return (first[0] - low * ux, first[1] - low * uy), (last[0] + high * ux, last[1] + high * uy)

    def _circle(self, step: Step, view: View) -> Iterator[Item]:
        """The whole of it, or arcs about its marks."""
        x, y, square = self.values[step.index]
        centre, radius = view((x, y)), math.sqrt(square) * view.scale
        if step.index in self.whole:
            yield Circle(self.whole[step.index], "plates", step.index, centre, radius)
            return
        for mark in self.marks.get(step.index, ()):
            spot = self.spot_of_mark[mark]
            at, wide = math.degrees(math.atan2(spot[1] - centre[1], spot[0] - centre[0])), math.degrees(STRIKE / radius)
            yield Arc(self.pens.get(step.index, pens.ARC), "plates", step.index, centre, radius, at - wide, at + wide)
