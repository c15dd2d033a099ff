"""Plates of any drawing in pens chosen by step: diagrams, polygons and profiles, drawn as constructions are."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from graphplan.kernel.drawing import Values
from graphplan.kernel.kinds import CIRCLE, POINT
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Scene
from graphplan.sheet.lettering.lettering import LetterSizes
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke, StruckArc
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plate, Plates
from graphplan.sheet.plates.view import View, clip_item
from graphplan.sheet.tolerances import RADIUS_TOL

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
    """One plan of a drawing on its panel: nothing breaks off with an arrow, and given marks have dots as others."""

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
