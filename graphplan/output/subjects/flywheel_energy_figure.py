"""The diagrams of a flywheel by Gutjahr's curves or by the vectors of areas: the moment over the energies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property, partial

from graphplan.kernel.kinds import LINE
from graphplan.machine.flywheel.diagram_layout import MAX_POLE_MM, ROW_GAP_MM, DiagramSizes
from graphplan.machine.flywheel.drawing import FLYWHEEL
from graphplan.output.graphs import AXIS, HEADED, Figures, Graph
from graphplan.output.subjects.flywheel_figure import (
    BEYOND,
    CHORD,
    ENERGY,
    FINE,
    MOMENT,
    OVER,
    RIGHT,
    SIDE,
    TANGENTS,
    FlywheelFigure,
)
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import CAPS, name_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Item, Polyline, Rect
from graphplan.sheet.plates.drawn_step import DrawnStep
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.styled_plate import plate_of_values
from graphplan.sheet.plates.view import View, view

MOMENT_SHARE, HEAD_MM = 0.4, 3.0  # of the height that is for both diagrams; of the head of an area's vector
LINES = {"fast": "upper", "slow": "lower"}  # each curve with the level that touches it
SPEEDS = {"fast": "omega_max", "slow": "omega_min"}


def sizes_for_energies(rect: Rect, figures: Figures) -> DiagramSizes:
    """The room of the two diagrams in a panel."""
    high = rect.height - 2 * OVER * figures.letters.times - ROW_GAP_MM
    return DiagramSizes(travel=rect.width - MAX_POLE_MM - SIDE - RIGHT - BEYOND, moment=MOMENT_SHARE * high,
                        energy=(1 - MOMENT_SHARE) * high)


class EnergyFigure(FlywheelFigure):
    """The moment over the energies, with the curves or vectors and their two outermost levels."""

    @cached_property
    def window(self) -> View:
        left, bottom, right, top = self.drawing.extent
        return view(Rect(left - SIDE, bottom, right + RIGHT, top), self.rect, 1.0)

    @cached_property
    def graphs(self) -> dict[str, Graph]:
        return {name: Graph.from_frame(frame, self.window) for name, frame in self.drawing.frames.items()}

    @cached_property
    def ink(self) -> Plate:
        steps, roles = self.values.drawing.program.steps, self.drawing.values.drawing.roles
        lines = {place: FINE for place in self.places if steps[place].op.gives == LINE}
        chords = {steps[Q].args[1]: CHORD for Q in (self._steps("energies")[1:] if "energies" in roles else ())}
        hidden = {*self._steps("upper"), *self._steps("lower"), *self._steps("closed")}
        return plate_of_values(self.values, FLYWHEEL, self.window, self.result.scene, self.paper.letters,
                               {**lines, **chords, **dict.fromkeys(self._steps("axis"), AXIS)},
                               beyond=dict.fromkeys(chords, 0.0), hidden=hidden)

    def _tangents(self) -> Iterator[Item]:
        """The two levels, from the axis on which they are cut through the diagram."""
        right = self.graphs["energy"].rect.right + BEYOND / 2
        for line, letter in (("upper", "m"), ("lower", "n")):
            (place,), cut = self._steps(line), self.window(self.drawing.values.values_of_role(letter)[0])
            yield Polyline(TANGENTS[line], "plates", place, (cut, (right, cut[1])))

    def _origin(self) -> Iterator[Item]:
        """No origin is drawn."""
        return iter(())

    def _curves(self) -> Iterator[Item]:
        """The true curves of the moment, the energy and the two beneath it; or the vectors of the areas."""
        cycle, curve, drawing = self.result.cycle, partial(Polyline, layer="links", step=None), self.drawing
        curves = [("moment", cycle.moment, MOMENT)]
        if "fast" in drawing.values.drawing.roles:
            curves.append(("energy", cycle.energy, ENERGY))
            curves += [("energy", cycle.energy + (cycle.inertia + -drawing.axis) * -touch.slope,
                        replace(TANGENTS[line], width=ENERGY.width))
                       for line, touch in (("upper", self.result.wheel.upper), ("lower", self.result.wheel.lower))]
        for name, values, pen in curves:
            spots = [spot for part in self.sample_curve(values) for spot in self.graphs[name].spots(*part)]
            yield curve(pen, spots=tuple(spots))
        if "ends" in drawing.values.drawing.roles:
            starts, (_, *ends) = (map(self.window, drawing.values.values_of_role(role)) for role in ("starts", "ends"))
            for place, start, end in zip(self._steps("ends")[1:], starts, ends, strict=True):
                pen = Pen(0.6, pens.RED if end[1] > start[1] else pens.BLUE)
                yield Arrow(pen, "plates", place, start, end, HEAD_MM)

    def _axes(self) -> Iterator[Item]:
        """Axes, round divisions with numbers, and scales."""
        paper = self.paper
        for graph, what in ((self.graphs["moment"], "M"), (self.graphs["energy"], "E")):
            yield from paper.ordinate(graph, head=True)
            yield from paper.abscissa(graph)
            yield self.scale_label(what, graph.y.unit, (graph.rect.left, graph.rect.top + HEADED / 2))
            yield from paper.numbered_y(graph, right=True)
        graph = self.graphs["energy" if "fast" in self.drawing.values.drawing.roles else "moment"]
        yield from paper.numbered_x(graph, turns=True)
        low = graph.rect.bottom - (2.4 + CAPS) * paper.letters.text
        yield self.scale_label("phi", graph.x.unit, (graph.rect.right, low), "end")

    def has_letter(self, mark: DrawnStep) -> bool:
        return super().has_letter(mark) or mark.name.startswith("W_")

    def _wishes(self) -> Iterator[Wish]:
        """The speed with which each curve is drawn."""
        for role, line in LINES.items() if "fast" in self.drawing.values.drawing.roles else ():
            spots = tuple(map(self.window, self.drawing.values.values_of_role(role)))
            pen = TANGENTS[line]
            yield Wish(name_runs(SPEEDS[role]), spots[::4], 1.0, pen=Pen(0.0, pen.colour, fill=pen.colour),
                       label=SPEEDS[role], free=True)
