"""The diagrams of a flywheel on their panel: what the drawing's steps draw, the true curves over it, axes and letters.

They lie as on the drawing board: the moment over the energy with common abscissae, the inertia turned over the
energy-mass diagram, which has its energies from beside it. Gutjahr's curves and the vectors of areas have the moment
over the energies alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.cycle.diagrams import Frame
from graphplan.kernel.kinds import LINE
from graphplan.kernel.passes import Values
from graphplan.machines.flywheel.diagram_layout import MAX_POLE_MM, ROW_GAP_MM, DiagramSizes, lay_out, plans_of
from graphplan.machines.flywheel.drawing import FLYWHEEL, FlywheelDrawing
from graphplan.machines.flywheel.numbers import columns
from graphplan.machines.flywheel.result import FlywheelResult
from graphplan.machines.integrals import Piecewise
from graphplan.output.graphs import AXIS, HEADED, Figures, Graph
from graphplan.output.tolerances import TRAVEL_TOL
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import CAPS, name_runs, sentence_runs
from graphplan.sheet.lettering.letters import items_with_names
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Item, Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import DrawnStep, Plate, plate_of_values
from graphplan.sheet.plates.view import View, clip_item, view

FINE, CHORD, LEVEL = Pen(0.13, "#8a8a8a"), Pen(0.25, pens.VIOLET), Pen(0.25, pens.GREEN, (5.0, 1.0))
TANGENTS = {"upper": Pen(0.35, pens.RED), "lower": Pen(0.35, pens.BLUE)}
MOMENT, ENERGY, INERTIA, MASS = Pen(0.5), Pen(0.5, pens.BLUE), Pen(0.5, pens.RED), Pen(0.5, pens.VIOLET)
SIDE, RIGHT, OVER = 4.0, 14.0, 9.0  # mm beside the pole, right of the diagrams for numbers, and over and under them
PARTS, LOW = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9), (0.15, 0.2, 0.25, 0.3, 0.4)  # of the room that are tried for a diagram
NUMBERED, SAMPLES = 36, 360  # plans that have numbers; places of a curve
PIECES, BEYOND, FREE = 6, 10.0, 4.0  # strokes of a piece of a curve; mm by which tangents go on; under curves


def sizes_in(rect: Rect, result: FlywheelResult, figures: Figures) -> DiagramSizes:
    """The room at which the diagrams, in round scales, are as large as they can be in a panel."""
    plans, true, margin = plans_of(result.cycle, result.positions), spans(result), _margin(figures)
    wide, high = rect.width - SIDE - RIGHT, rect.height - 2 * margin

    def diagram_size(room: DiagramSizes) -> float:
        """How large the diagrams are; nothing where they have no room."""
        layout = lay_out(result.cycle, result.wheel, plans, room)
        box = extent(layout.frames, layout.pole, true)
        if box.width > wide or box.height > high:
            return 0.0
        return math.prod(end - start for frame in (layout.frames[name] for name in ("moment", "energy-mass"))
                         for start, end in (frame.level, frame.upright))

    found = DiagramSizes(0.5 * wide, 0.2 * high, 0.4 * high, 0.2 * wide, 0.25 * high)
    across = [replace(found, travel=x * wide, inertia=(1 - x) * y * wide) for x in PARTS for y in PARTS]
    found = max((found, *across), key=diagram_size)
    return max((found, *(replace(found, moment=x * high, turned=x * high, energy=(1 - x) * y * high)
                         for x in LOW for y in PARTS)), key=diagram_size)


Span = tuple[float, float]


def spans(result: FlywheelResult) -> dict[str, tuple[Span, Span]]:
    """How far the true curves go along both axes of each diagram: between plans farther than at these."""
    cycle, travel = result.cycle, np.linspace(*result.cycle.ends, SAMPLES + 1)
    told, I, M, E = ((float(values.min()), float(values.max())) for values in (
        result.in_degrees(travel), cycle.inertia.at(travel), cycle.moment.at(travel), cycle.energy.at(travel)))
    return {"moment": (told, M), "energy": (told, E), "inertia": (I, told), "energy-mass": (I, E)}


def extent(frames: Mapping[str, Frame], pole: float, true: Mapping[str, tuple[Span, Span]]) -> Rect:
    """The room of all diagrams with their curves, in mm."""
    spots = [(-pole, 0.0)]
    for name, (xs, ys) in true.items():
        frame = frames[name]
        (left, right), (low, top) = frame.position(np.array(xs), np.array(ys))
        x, y = frame.origin
        spots += [(left, low), (right, top), (x + frame.level[0], y + frame.upright[0]),
                  (x + frame.level[1], y + frame.upright[1])]
    return bounding_box([(float(x), float(y)) for x, y in spots])


def _margin(figures: Figures) -> float:
    """What is free over and under the diagrams for scales and numbers."""
    return OVER * figures.letters.times


@dataclass(frozen=True)
class FlywheelFigure:
    """The diagrams of a result in their panel; `places` are those of the drawing's steps among the steps of the sheet.
    """

    result: FlywheelResult
    drawing: FlywheelDrawing
    values: Values
    places: list[int]
    paper: Figures
    rect: Rect

    @cached_property
    def window(self) -> View:
        """From the drawing's mm to those of the sheet: in the middle of the panel, and as large."""
        box = extent(self.drawing.frames, self.drawing.pole, spans(self.result))
        return view(replace(box, left=box.left - SIDE, right=box.right + RIGHT), self.rect, 1.0)

    @cached_property
    def graphs(self) -> dict[str, Graph]:
        """The diagrams by name."""
        found = {name: Graph.from_frame(frame, self.window) for name, frame in self.drawing.frames.items()}
        energy, spots = found["energy"], self.drawing.values.values_of_role("energies")
        low = self.window(min(spots, key=lambda spot: spot[1]))[1] - FREE  # m and n may lie far below
        bottom = max(low - energy.origin[1], energy.upright[0])
        return found | {"energy": energy._replace(upright=(bottom, energy.upright[1]))}

    def given_items(self) -> list[Item]:
        """What is given of it: the axes with their scales."""
        return list(self._axes())

    def items(self) -> list[Item]:
        """All of it, its letters off its lines."""
        drawn = [*self._areas(), *self._curves(), *self._level(), *self._tangents(), *self._origin(), *self._axes()]
        return items_with_names(self.ink, drawn, self._wishes(), self.has_letter)

    # ---- steps -----------------------------------------------------------------------------------------------------

    def _steps(self, role: str) -> list[int]:
        """The steps of a role, by their places on the sheet."""
        return [self.places[index] for index in self.drawing.values.drawing.roles[role]]

    @property
    def ink(self) -> Plate:
        """What the steps draw: fine lines, chords by themselves; tangents are drawn as far as they touch."""
        steps = self.values.drawing.program.steps
        lines = {place: FINE for place in self.places if steps[place].op.gives == LINE}
        chords = {steps[Q].args[1]: CHORD for Q in self._steps("energies")[1:]}
        axis = dict.fromkeys(self._steps("axis"), AXIS)
        hidden = {*self._steps("upper"), *self._steps("lower"), *self._steps("closed")}
        return plate_of_values(self.values, FLYWHEEL, self.window, self.result.scene, self.paper.letters,
                               {**lines, **chords, **axis}, beyond=dict.fromkeys(chords, 0.0), hidden=hidden)

    def _level(self) -> Iterator[Item]:
        """The level from which the closed moment counts, from the pole through the whole diagram."""
        (place,), pole = self._steps("closed"), self.window(self.drawing.values.values_of_role("ray origin")[0])
        yield Polyline(LEVEL, "plates", place, (pole, (self.graphs["moment"].rect.right + BEYOND / 2, pole[1])))

    def _tangents(self) -> Iterator[Item]:
        """Both tangents from the axis on which they are cut to beyond where they touch."""
        graph = self.graphs["energy-mass"]
        for which, letter in (("upper", "m"), ("lower", "n")):
            (place,), pen = self._steps(which), TANGENTS[which]
            cut, touch = self.window(self.drawing.values.values_of_role(letter)[0]), getattr(self.result.wheel, which)
            slope, far = touch.slope * graph.x.unit / graph.y.unit, graph.rect.right + BEYOND - cut[0]
            line = Polyline(pen, "plates", place, (cut, (cut[0] + far, cut[1] + far * slope)))
            rect = self.rect
            yield from clip_item(line, Rect(rect.left, rect.bottom, rect.right, graph.rect.top + ROW_GAP_MM / 4))

    def _origin(self) -> Iterator[Item]:
        """The origin in which the tangents meet, if it lies on the panel: so far left of the axis is the flywheel."""
        wheel = self.result.wheel
        O = self.graphs["energy-mass"].spot(-wheel.inertia, wheel.origin)
        if self.rect.holds(O):
            for which, letter in (("upper", "m"), ("lower", "n")):
                (place,), cut = self._steps(which), self.window(self.drawing.values.values_of_role(letter)[0])
                yield Polyline(TANGENTS[which], "plates", place, (O, cut))
            yield from self.paper.draw_point(O, "O", (-1.2, 0.8))

    # ---- curves ----------------------------------------------------------------------------------------------------

    def sample_curve(self, curve: Piecewise) -> Iterator[tuple[Any, Any]]:
        """Travels as they are told, and values, stretch by stretch between jumps."""
        for low, high in pairwise(map(float, curve.edges)):
            travel = np.linspace(low, high, PIECES + 1)
            yield self.result.in_degrees(travel), np.append(curve.at(travel[:-1]), curve.at(high, -1))

    def _areas(self) -> Iterator[Item]:
        """What lies between the moment and its mean."""
        graph = self.graphs["moment"]
        level = graph.spot(0.0, self.drawing.mean)[1]
        parts = [graph.spots(*part) for part in self.sample_curve(self.result.cycle.moment)]
        spots = [spot for part in parts for spot in part]
        corners = ((spots[0][0], level), *spots, (spots[-1][0], level))
        yield Polygon(Pen(0.0, fill=pens.TINT), "paper", None, corners)

    def _curves(self) -> Iterator[Item]:
        """The true curves of moment, energy, inertia, and of energy by inertia."""
        cycle, curve = self.result.cycle, partial(Polyline, layer="links", step=None)
        for name, values, pen in (("moment", cycle.moment, MOMENT), ("energy", cycle.energy, ENERGY)):
            spots = [spot for part in self.sample_curve(values) for spot in self.graphs[name].spots(*part)]
            yield curve(pen, spots=tuple(spots))
        inertia = self.graphs["inertia"]
        turned = [spot for travel, I in self.sample_curve(cycle.inertia) for spot in inertia.spots(I, travel)]
        yield curve(INERTIA, spots=tuple(turned))
        travel = np.linspace(*cycle.ends, SAMPLES + 1)
        spots = self.graphs["energy-mass"].spots(cycle.inertia.at(travel), cycle.energy.at(travel))
        yield curve(MASS, spots=tuple(spots))

    # ---- axes and letters ------------------------------------------------------------------------------------------

    def scale_label(self, what: str, k: float, at: Spot, anchor: str = "start") -> Item:
        """Letter, unit and scale of a quantity."""
        units = {column.letter: column.unit for column in columns(self.result).values()}
        return self.paper.quantity(at, what, units[what], k, self.result.scene.sheet.convention, anchor)

    def _axes(self) -> Iterator[Item]:
        """Axes, round divisions with numbers, and scales."""
        paper, graphs = self.paper, self.graphs
        moment, energy, inertia, mass = (graphs[name] for name in ("moment", "energy", "inertia", "energy-mass"))
        for graph in (moment, energy):
            yield from paper.ordinate(graph, head=True)
            yield from paper.abscissa(graph)
        for graph in (inertia, mass):
            yield from paper.ordinate(graph, head=graph is inertia)
        yield from paper.abscissa(inertia, level=inertia.y.datum)
        yield from paper.abscissa(mass)
        for graph, what in ((moment, "M"), (energy, "E")):
            yield self.scale_label(what, graph.y.unit, (graph.rect.left, graph.rect.top + HEADED / 2))
            yield from paper.numbered_y(graph, right=True)
        yield self.scale_label("I", inertia.x.unit, (inertia.rect.left, inertia.rect.bottom - HEADED))
        yield from paper.numbered_x(energy, turns=True)
        yield from paper.numbered_x(mass)
        yield from paper.numbered_y(inertia, right=True, turns=True, level=inertia.y.datum)
        corner = inertia.rect.right + RIGHT, inertia.rect.top + HEADED / 2
        yield self.scale_label("phi", inertia.y.unit, corner, "end")
        low = energy.rect.bottom - (2.4 + CAPS) * paper.letters.text
        yield self.scale_label("phi", energy.x.unit, (energy.rect.right, low), "end")

    def has_letter(self, mark: DrawnStep) -> bool:
        """Whether the name of a mark stands on the sheet: divisions have their numbers at the curve alone."""
        return not mark.name.rpartition("_")[2].isdigit()

    def _wishes(self) -> Iterator[Wish]:
        """The numbers of the plans along the energy-mass curve and over the abscissa, and the letters of angles."""
        told = self.result.travels_in_degrees
        every = 1 + self.result.positions // NUMBERED
        for spot, travel in zip(self.drawing.values.values_of_role("points"), self.drawing.travels, strict=False):
            k = int(np.argmin(abs(told - travel)))
            if k % every == 0 and abs(told[k] - travel) < TRAVEL_TOL * np.ptp(told):  # others are corners of the loads
                yield Wish(sentence_runs(str(k)), (self.window(spot),), 0.5, minor=True, pen=pens.FAINT, label=f"P {k}")
        graph, bounds = self.graphs["energy-mass"], self.rect
        for which, name in (("upper", "psi_max"), ("lower", "psi_min")):
            touch = getattr(self.result.wheel, which)
            cut = self.window(self.drawing.values.values_of_role("m" if which == "upper" else "n")[0])
            end = graph.spot(touch.inertia, touch.energy)
            spots = tuple(spot for t in (0.25, 0.4, 0.15, 0.6, 0.8)
                          if bounds.holds(spot := (cut[0] + t * (end[0] - cut[0]), cut[1] + t * (end[1] - cut[1]))))
            if spots:
                yield Wish(name_runs(name), spots, 0.6, pen=Pen(0.0, TANGENTS[which].colour,
                           fill=TANGENTS[which].colour), label=name, free=True)


# ---- by Gutjahr's curves or by the vectors of areas: the moment over the energies ------------------------------------

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

    @property
    def graphs(self) -> dict[str, Graph]:
        return {name: Graph.from_frame(frame, self.window) for name, frame in self.drawing.frames.items()}

    @property
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
