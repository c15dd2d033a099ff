"""The sheet of a flywheel: the mechanism in its positions, Zhukovsky's levers, and the diagrams one under another.

The diagrams are those of the second sheet of a course project: reduced moment with the moment that closes the cycle,
energy by graphical integration, reduced inertia, turned, and Wittenbauer's curve between its two tangents. They stand
on one panel, so that abscissae are shared and points carried across, as on a drawing board. Gutjahr's curves and the
vectors of areas have the moment over the energies alone.

Source: Ozols 1974, 13-6 and 15-2 with figs. 13-9, 15-2 to 15-5.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.kernel.kinds import LINE
from graphplan.kernel.passes import Drawing, Values, put_together
from graphplan.kernel.program import Panel
from graphplan.machines.flywheel.diagram_layout import MAX_POLE_MM, ROW_GAP_MM, DiagramSizes, lay_out, plans_of
from graphplan.machines.flywheel.drawing import FLYWHEEL, FlywheelDrawing, draw_flywheel
from graphplan.machines.flywheel.energy_constructions import AREAS, GUTJAHR, draw_by
from graphplan.machines.flywheel.numbers import INERTIA, MOMENT, RATE, columns
from graphplan.machines.flywheel.result import NEGLECTS_NOTHING, FlywheelResult
from graphplan.machines.integrals import Piecewise
from graphplan.machines.reduced.check import check_lever
from graphplan.machines.reduced.reduced_loads import UnitMotion, moving_points
from graphplan.machines.tolerances import ORDINATE_TOL
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.output.tables import TableColumn, quantity_table
from graphplan.phrases import Said, arrange, digits, join, phrase, said, unit
from graphplan.sheet.diagrams import AXIS, Diagram, DrawnCurve, Frame, QuantityAxis, SheetText, Span
from graphplan.sheet.frames.title import TASK
from graphplan.sheet.handout import starting_items
from graphplan.sheet.layout.paper import windows
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import name_runs, sentence_runs
from graphplan.sheet.lettering.letters import letter_plate
from graphplan.sheet.panels import Blank, PanelFigure, PanelPage, PanelSheet, Words, column, row
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.plate import DrawnStep, Plate, Plates, plate_of_values
from graphplan.sheet.plates.traced_motion import PointPath, TracedMotion
from graphplan.sheet.plates.view import View, clip_item, fit_scale, view
from graphplan.sheet.words.facts import machine_facts, topic_texts
from graphplan.words.tongue import Tongue, tongue

DOCUMENT = said("Flywheel sheet")
WITTENBAUER = "wittenbauer"
DESCRIPTIONS = {WITTENBAUER: phrase("Flywheel by Wittenbauer's diagram from {0} plans."),
                GUTJAHR: phrase("Flywheel by Gutjahr's curves from {0} plans."),
                AREAS: phrase("Flywheel by the vectors of areas; {0} plans.")}
HEADINGS = {GUTJAHR: said("Moment, energy and Gutjahr's curves"), AREAS: said("Moment and vectors of areas")}
NAMES = {"gutjahr": said("Gutjahr"), "area vectors": said("area vectors"), "power": said("power"),
         "characteristic": said("characteristic")}
LETTERS = "phi", "psi", "delta", "omega", "omega_max", "omega_min", "k_phi", "k_M", "k_E", "k_I"


def flywheel_sheet(paper: str, result: FlywheelResult, task: bool = False, by: str = WITTENBAUER) -> PanelSheet:
    """The sheet of a flywheel by one construction; as a task what is given, with boxes to fill in."""
    scene, levers = result.scene, CycleLevers(result)
    plans = levers.plans(tongue(scene.sheet.language))
    given_pose = tuple((0.3 if place else 0.4, panel) for place, panel in enumerate(plans.panels))
    page = PanelPage(paper, scene, column((0.36, row(*given_pose, (0.3, LEVERS))), (0.64, FLYWHEEL)), True)
    scales, views = windows({panel: page.room(panel) for panel in plans.panels}, plans)
    diagrams = FlywheelDiagrams(result, by, page)
    values, (lever_places, places) = both_drawings(levers.drawing, diagrams.drawing.values)
    figures = {LEVERS: PanelFigure(page.room(LEVERS), strokes=[*levers.small(page.room(LEVERS), page.text, not task)]),
               FLYWHEEL: diagrams.figure(values, places, task)}
    plates = Plates(plans, views, page.letters)
    for panel in plans.panels:
        items = given_items(plates[panel]) if task else letter_plate(plates[panel]).items
        shown = plans.kinds(panel)
        figures[panel] = PanelFigure(
            page.room(panel), heading=panel.caption(shown), scales=join(scales.scale_texts(panel, shown), ",  "),
            strokes=[item if item.step is None else replace(item, step=lever_places[item.step]) for item in items])
    words = FlywheelWords(result, diagrams.drawing, by)
    return PanelSheet(
        page, TASK if task else DOCUMENT, DESCRIPTIONS[by](result.positions), values, scales.ratio, figures,
        replace(scales, multiples={**scales.multiples, FLYWHEEL: Fraction(scales.k_s)}),  # drawn in mm
        given=[*words.given_words()], found=[asked_boxes()] if task else [*words.found_words()],
        tables=[table_to_fill_in(result) if task else plan_table(result)], names=LETTERS, told_once=(FLYWHEEL,),
        found_heading=said("To find") if task else said("Found"), steps="" if task else "told", steps_apart=True)


def both_drawings(lever: Construction, diagrams: Values) -> tuple[Values, list[list[int]]]:
    """The lever and the diagrams as one construction, and where the steps of both are in it."""
    program, places = put_together([lever.drawn, diagrams.drawing.program])
    values = dict(zip(places[0], lever.values, strict=True)) | dict(zip(places[1], diagrams.numbers, strict=True))
    drawing = Drawing(program, plans=diagrams.drawing.plans)
    return Values(drawing, [values[index] for index in range(len(program))]), places


# ---- words ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FlywheelWords:
    """The words of one sheet."""

    result: FlywheelResult
    drawing: FlywheelDrawing
    by: str

    def given_words(self) -> Iterator[Words]:
        """The speed and how even it is to be, the masses and the loads."""
        result = self.result
        yield arrange("omega = {0} {1}", digits(result.cycle.speed), unit(RATE))
        if result.given:
            yield arrange("I_s = {0} {1}", digits(result.wheel.inertia), unit(INERTIA))
        else:
            yield arrange("delta = {0}", digits(result.unevenness))
        yield from topic_texts(machine_facts(result.scene))

    def found_words(self) -> Iterator[Words]:
        """The closing moment, the flywheel, the speeds, and the results of other methods."""
        result, drawing = self.result, self.drawing
        cycle, wheel = result.cycle, result.wheel
        if cycle.closing:
            yield said("Closing moment: {0} {1}", digits(cycle.closing), unit(MOMENT))
        if result.given:
            yield arrange("delta = {0}", digits(result.unevenness))
            if wheel.inertia + drawing.axis > 0:  # else m and n are one point
                yield arrange("k_E·mn/((I_s + {0} {1})·ω²) = {2}", digits(drawing.axis), unit(INERTIA),
                              digits(drawing.unevenness))
        else:
            yield said("Flywheel: {0} {1}; drawn {2} {1}", digits(wheel.inertia), unit(INERTIA),
                       digits(drawing.inertia))
        neglecting = next((one for one in result.methods if self.by == AREAS and one.name == "area vectors"), None)
        ((_, m),), ((_, n),) = map(drawing.values.values_of_role, "mn")
        yield arrange("mn = {0} {1}, {2} {3}", digits(float(m - n)), unit("mm"),
                      digits(neglecting.stored if neglecting else wheel.intercept(drawing.axis)), unit("J"))
        if neglecting:
            yield said("As drawn it {0}", neglecting.neglects)
        for name, speed, touch in (("omega_max", wheel.omega_max, wheel.upper),
                                   ("omega_min", wheel.omega_min, wheel.lower)):
            at = join((digits(float(result.in_degrees(touch.travel))), unit("°")), "")
            yield said("{0} = {1} {2} at {3}", name, digits(speed), unit(RATE), at)
        for note in result.notes:
            yield arrange("{0:capital}", note)
        if result.reduction.friction:
            losses = result.reduction.losses
            yield said("Friction takes {0} {1} of the {2} {1} given in a cycle: mean efficiency {3}",
                       digits(losses.lost), unit("J"), digits(losses.given), digits(losses.efficiency))
            yield join(arrange("{0}: {1} {2}", name, digits(lost), unit("J")) for name, lost in losses.pairs.items())
        rows = [(said("Wittenbauer"), wheel.inertia, NEGLECTS_NOTHING),
                *((NAMES[one.name], one.inertia, one.neglects) for one in result.methods)]
        for method, inertia, neglects in rows if result.methods else ():
            yield arrange("{0:capital}: {1} {2}; {3}", method, digits(inertia), unit(INERTIA), neglects)


def asked_boxes() -> Blank:
    """Boxes for what a task asks for."""
    return Blank([["", ""], *([join((name, unit(measure))), "?"] for name, measure in (
        (said("Closing moment"), MOMENT), ("mn", "mm"), (said("Flywheel"), INERTIA), ("omega_max", RATE),
        ("omega_min", RATE)))])


def plan_columns(result: FlywheelResult) -> list[TableColumn]:
    """The columns that the sheet shows: what is only rounding beside the largest of a column is zero."""
    shown = (column for name, column in columns(result).items() if name != "whole")
    return [column._replace(values=np.where(abs(column.values) > ORDINATE_TOL * abs(column.values).max(), column.values,
                                            0.0)) for column in shown]


def plan_table(result: FlywheelResult) -> list[list[Said | str]]:
    """A row for each plan."""
    return quantity_table(plan_columns(result))


def table_to_fill_in(result: FlywheelResult) -> Blank:
    """The table of plans with boxes to fill in; the travels are given."""
    return Blank([join(filter(None, (one, two)), ": "), *rest] for one, two, *rest in plan_table(result))


# ---- diagrams -------------------------------------------------------------------------------------------------------

FINE, CHORD, LEVEL = Pen(0.13, "#8a8a8a"), Pen(0.25, pens.VIOLET), Pen(0.25, pens.GREEN, (5.0, 1.0))
TANGENTS = {"upper": Pen(0.35, pens.RED), "lower": Pen(0.35, pens.BLUE)}
CURVE_PENS = {"M": Pen(0.5), "E": Pen(0.5, pens.BLUE), "I": Pen(0.5, pens.RED), "W": Pen(0.5, pens.VIOLET)}
SIDE, RIGHT, OVER = 4.0, 14.0, 9.0  # mm beside the pole, right of the diagrams for numbers, and over and under them
PARTS, LOW = (0.4, 0.5, 0.6, 0.7, 0.8, 0.9), (0.15, 0.2, 0.25, 0.3, 0.4)  # of the room that are tried for a diagram
NUMBERED, SAMPLES = 36, 360  # plans that have numbers; places of a curve
PIECES, BEYOND, FREE = 6, 10.0, 4.0  # strokes of a piece of a curve; mm by which tangents go on; under curves
CURVE_BEYOND_MM = 50.0  # mm by which a true curve may be beyond the plans' extremes
MOMENT_SHARE, HEAD_MM = 0.4, 3.0  # of the height that is for both diagrams; of the head of an area's vector
SPEEDS = {"fast": ("omega_max", "upper"), "slow": ("omega_min", "lower")}  # of curves, and the level that touches each


@dataclass(frozen=True)
class FlywheelDiagrams:
    """The diagrams of a result on its page, by one of the constructions: the moment over the energies, and beside them
    by Wittenbauer's the turned inertia over the energy-mass diagram."""

    result: FlywheelResult
    by: str
    page: PanelPage

    @property
    def rect(self) -> Rect:
        return self.page.room(FLYWHEEL)

    @cached_property
    def drawing(self) -> FlywheelDrawing:
        """The construction, as large as it has room."""
        high = self.rect.height - 2 * OVER * self.page.letters.times
        if self.by == WITTENBAUER:
            sizes = largest_sizes(self.result, self.rect.width - SIDE - RIGHT, high)
            return draw_flywheel(self.result.cycle, self.result.wheel, self.result.positions, sizes)
        high -= ROW_GAP_MM
        return draw_by(self.by, self.result, DiagramSizes(
            travel=self.rect.width - MAX_POLE_MM - SIDE - RIGHT - BEYOND, moment=MOMENT_SHARE * high,
            energy=(1 - MOMENT_SHARE) * high))

    @cached_property
    def window(self) -> View:
        """From the drawing's mm to those of the sheet: in the middle of the panel, and as large."""
        true = spans(self.result) if self.by == WITTENBAUER else {}
        box = extent(self.drawing.frames, self.drawing.pole, true)
        return view(box._replace(left=box.left - SIDE, right=box.right + RIGHT), self.rect, 1.0)

    @cached_property
    def frames(self) -> dict[str, Frame]:
        """The windows of the diagrams by name; by Wittenbauer that of the energies goes down to the least of them, as m
        and n may lie far below."""
        found = {name: frame.seen_through(self.window) for name, frame in self.drawing.frames.items()}
        if self.by == WITTENBAUER:
            energy = found["energy"]
            least = min(y for _, y in map(self.window, self.drawing.values.values_of_role("energies")))
            bottom = max(least - FREE - energy.origin[1], energy.upright[0])
            found["energy"] = energy._replace(upright=(bottom, energy.upright[1]))
        return found

    def figure(self, values: Values, places: list[int], task: bool) -> PanelFigure:
        """The diagrams; `places` are those of the drawing's steps among the steps of the sheet. A task has axes alone.
        """
        heading = HEADINGS.get(self.by, FLYWHEEL.heading)
        if task:
            blank = [replace(diagram, curves=(), areas=()) for diagram in self.diagrams]
            return PanelFigure(self.rect, blank, heading=heading)
        roles = {role: [places[index] for index in steps] for role, steps in self.drawing.values.drawing.roles.items()}
        strokes, wishes = (self._tangent_lines(roles), self._wishes()) if self.by == WITTENBAUER else (
            self._levels(roles), self._speeds())
        (place,), pole = roles["closed"], self.window(self.drawing.values.values_of_role("ray origin")[0])
        far = self.frames["moment"].rect.right + BEYOND / 2
        level = Polyline(LEVEL, "plates", place, (pole, (far, pole[1])))  # from it the closed moment counts
        return PanelFigure(self.rect, self.diagrams, self._plate(values, places, roles), [level, *strokes], [*wishes],
                           has_letter, heading)

    def _plate(self, values: Values, places: list[int], roles: Mapping[str, list[int]]) -> Plate:
        """The strokes of the steps: fine lines, chords by themselves; tangents are drawn as far as they touch."""
        steps = values.drawing.program.steps
        lines = {place: FINE for place in places if steps[place].op.gives == LINE}
        chords = {steps[Q].args[1]: CHORD for Q in roles.get("energies", ())[1:]}
        hidden = {*roles["upper"], *roles["lower"], *roles["closed"]}
        return plate_of_values(values, FLYWHEEL, self.window, self.result.scene, self.page.letters,
                               {**lines, **chords, **dict.fromkeys(roles["axis"], AXIS)},
                               beyond=dict.fromkeys(chords, 0.0), hidden=hidden)

    # ---- axes and curves -------------------------------------------------------------------------------------------

    @property
    def diagrams(self) -> list[Diagram]:
        """Axes and true curves."""
        cycle, frames, no_words = self.result.cycle, self.frames, QuantityAxis(numbers=False)
        units = {column.letter: column.unit for column in columns(self.result).values()}
        M, E = (QuantityAxis(letter, units[letter], far=True) for letter in "ME")
        phi = QuantityAxis("phi", "°", turns=True)
        curve, energy = (self._sample(curve, CURVE_PENS[letter]) for curve, letter in (
            (cycle.moment, "M"), (cycle.energy, "E")))
        moment = Diagram(frames["moment"], phi if self.by == AREAS else no_words, M, [curve],
                         areas=[(curve.xs, curve.ys, self.drawing.mean)], over=CURVE_BEYOND_MM)
        if self.by == AREAS:
            return [moment, Diagram(frames["energy"], no_words, E)]
        if self.by == GUTJAHR:
            wheel, axis = self.result.wheel, self.drawing.axis
            curves = [self._sample(cycle.energy + (cycle.inertia + -axis) * -touch.slope,
                                    replace(TANGENTS[line], width=0.5))
                      for line, touch in (("upper", wheel.upper), ("lower", wheel.lower))]
            return [moment, Diagram(frames["energy"], phi, E, [energy, *curves], over=CURVE_BEYOND_MM)]
        inertia, mass = frames["inertia"], frames["energy-mass"]
        travel = np.linspace(*cycle.ends, SAMPLES + 1)
        turned, whole = self._sample(cycle.inertia, CURVE_PENS["I"]), DrawnCurve(
            cycle.inertia.at(travel), cycle.energy.at(travel), CURVE_PENS["W"])
        return [
            moment, Diagram(frames["energy"], phi, E, [energy], over=CURVE_BEYOND_MM),
            Diagram(inertia, QuantityAxis("I", units["I"], numbers=False, anchor="start", shift=(0.0, 2.3)),
                    phi._replace(far=True, anchor="end", shift=(RIGHT, 0.0)),
                    [turned._replace(xs=turned.ys, ys=turned.xs)], over=CURVE_BEYOND_MM, crossing=inertia.y.datum),
            Diagram(mass, QuantityAxis(), QuantityAxis(numbers=False, head=False), [whole], over=CURVE_BEYOND_MM)]

    def _sample(self, curve: Piecewise, pen: Pen) -> DrawnCurve:
        """A curve over the travel as it is told, stretch by stretch between jumps."""
        parts = [(travel, np.append(curve.at(travel[:-1]), curve.at(travel[-1], -1))) for ends in pairwise(curve.edges)
                 for travel in [np.linspace(*ends, PIECES + 1)]]
        travels, values = map(np.concatenate, zip(*parts, strict=True))
        return DrawnCurve(self.result.in_degrees(travels), values, pen)

    # ---- by Wittenbauer --------------------------------------------------------------------------------------------

    def _tangent_lines(self, roles: Mapping[str, list[int]]) -> Iterator[Item]:
        """The tangents, each from the axis to beyond its point of contact, and to the origin in which they meet, if it
        lies on the panel: so far left of the axis is the flywheel."""
        frame, wheel, rect = self.frames["energy-mass"], self.result.wheel, self.rect
        O, shown = frame.spot(-wheel.inertia, wheel.origin), rect._replace(top=frame.rect.top + ROW_GAP_MM / 4)
        for which, cut, touch in self._cuts():
            (place,), pen = roles[which], TANGENTS[which]
            slope, far = touch.slope * frame.x.unit / frame.y.unit, frame.rect.right + BEYOND - cut[0]
            yield from clip_item(Polyline(pen, "plates", place, (cut, (cut[0] + far, cut[1] + far * slope))), shown)
            if rect.holds(O):
                yield Polyline(pen, "plates", place, (O, cut))
        if rect.holds(O):
            yield from self.page.text.draw_point(O, "O", (-1.2, 0.8))

    def _cuts(self) -> Iterator[tuple[str, Spot, Any]]:
        """The cuts of the tangents, or levels, with the axis, and the points in which they touch."""
        for which, letter in (("upper", "m"), ("lower", "n")):
            (cut,) = self.drawing.values.values_of_role(letter)
            yield which, self.window(cut), getattr(self.result.wheel, which)

    def _wishes(self) -> Iterator[Wish]:
        """The numbers of the plans along the energy-mass curve, and the letters of the tangents' angles."""
        told = self.result.travels_in_degrees
        every = 1 + self.result.positions // NUMBERED
        for spot, travel in zip(self.drawing.values.values_of_role("points"), self.drawing.travels, strict=False):
            k = int(np.argmin(abs(told - travel)))
            if k % every == 0 and abs(told[k] - travel) < ORDINATE_TOL * np.ptp(told):  # else a corner
                yield Wish(sentence_runs(str(k)), (self.window(spot),), 0.5, minor=True, pen=pens.FAINT, label=f"P {k}")
        for (which, cut, touch), name in zip(self._cuts(), ("psi_max", "psi_min"), strict=True):
            end = self.frames["energy-mass"].spot(touch.inertia, touch.energy)
            places = ((cut[0] + t * (end[0] - cut[0]), cut[1] + t * (end[1] - cut[1]))
                      for t in (0.25, 0.4, 0.15, 0.6, 0.8))
            if spots := tuple(filter(self.rect.holds, places)):
                yield coloured_wish(name, spots, 0.6, TANGENTS[which])

    # ---- by Gutjahr's curves or by areas ---------------------------------------------------------------------------

    def _levels(self, roles: Mapping[str, list[int]]) -> Iterator[Item]:
        """The two levels, from the axis on which they are cut through the diagram, and the vectors of areas."""
        right, found = self.frames["energy"].rect.right + BEYOND / 2, self.drawing.values
        for which, cut, _ in self._cuts():
            yield Polyline(TANGENTS[which], "plates", roles[which][0], (cut, (right, cut[1])))
        if "ends" in roles:
            starts, (_, *ends) = (map(self.window, found.values_of_role(role)) for role in ("starts", "ends"))
            for place, start, end in zip(roles["ends"][1:], starts, ends, strict=True):
                yield Arrow(Pen(0.6, pens.RED if end[1] > start[1] else pens.BLUE), "plates", place, start, end,
                            HEAD_MM)

    def _speeds(self) -> Iterator[Wish]:
        """The speed with which each curve is drawn."""
        for role, (name, line) in SPEEDS.items() if self.by == GUTJAHR else ():
            spots = tuple(map(self.window, self.drawing.values.values_of_role(role)))
            yield coloured_wish(name, spots[::4], 1.0, TANGENTS[line])


def coloured_wish(name: str, spots: tuple[Spot, ...], clear: float, pen: Pen) -> Wish:
    """A name beside a line, in its colour."""
    return Wish(name_runs(name), spots, clear, pen=Pen(0.0, pen.colour, fill=pen.colour), label=name, free=True)


def has_letter(mark: DrawnStep) -> bool:
    """Return True for marks with a letter; divisions have their numbers at the curve alone."""
    return mark.name.startswith("W_") or not mark.name.rpartition("_")[2].isdigit()


def spans(result: FlywheelResult) -> dict[str, tuple[Span, Span]]:
    """Return the ranges of the true curves along both axes of each diagram; between plans they may go farther."""
    cycle, travel = result.cycle, np.linspace(*result.cycle.ends, SAMPLES + 1)
    told, I, M, E = ((float(values.min()), float(values.max())) for values in (
        result.in_degrees(travel), cycle.inertia.at(travel), cycle.moment.at(travel), cycle.energy.at(travel)))
    return {"moment": (told, M), "energy": (told, E), "inertia": (I, told), "energy-mass": (I, E)}


def extent(frames: Mapping[str, Frame], pole: float, true: Mapping[str, tuple[Span, Span]]) -> Rect:
    """The room of all diagrams with their curves, in mm."""
    spots = [(-pole, 0.0)]
    for name, frame in frames.items():
        spots += [(frame.rect.left, frame.rect.bottom), (frame.rect.right, frame.rect.top)]
        spots += frame.spots(*true[name]) if name in true else ()
    return bounding_box(spots)


def largest_sizes(result: FlywheelResult, wide: float, high: float) -> DiagramSizes:
    """The sizes at which the diagrams, in round scales, are as large as they can be in a room."""
    plans, true = plans_of(result.cycle, result.positions), spans(result)

    def diagram_size(room: DiagramSizes) -> float:
        """Return the area of the diagrams; 0 if they have no room."""
        layout = lay_out(result.cycle, result.wheel, plans, room)
        box = extent(layout.frames, layout.pole, true)
        if box.width > wide or box.height > high:
            return 0.0
        return math.prod(side for name in ("moment", "energy-mass")
                         for side in (layout.frames[name].rect.width, layout.frames[name].rect.height))

    found = DiagramSizes(0.5 * wide, 0.2 * high, 0.4 * high, 0.2 * wide, 0.25 * high)
    tried = [replace(found, travel=x * wide, inertia=(1 - x) * y * wide) for x in PARTS for y in PARTS]
    found = max((found, *tried), key=diagram_size)
    return max((found, *(replace(found, moment=x * high, turned=x * high, energy=(1 - x) * y * high)
                         for x in LOW for y in PARTS)), key=diagram_size)


# ---- Zhukovsky's levers over the cycle (Ozols 1974, 13-6) -----------------------------------------------------------

LEVERS = Panel("levers", said("levers"), said("Orthogonal velocities in the other positions"))
RAY, IMAGE = Pen(0.18, pens.BLUE), Pen(0.25)
FIGURE_MARGIN_MM, NUMBER = 1.0, 1.4  # mm about a small figure; of the height of letters, for its number
# mm: the radius of a pole; small figures, and faint positions of the mechanism
POLE_RADIUS_MM, MAX_SMALL_FIGURES = 0.4, 36


@dataclass(frozen=True)
class CycleLevers:
    """The lever of a result in the given pose, and the velocities at the positions of its cycle."""

    result: FlywheelResult

    @cached_property
    def travel(self) -> Any:
        """The travels of the positions, from the given pose: shape (count,)."""
        return np.linspace(*self.result.reduction.ends, self.result.positions, endpoint=False)

    @cached_property
    def drawing(self) -> Construction:
        """The lever of the given pose, step by step, compared with the reduced moment."""
        return check_lever(self.result.reduction, float(self.travel[0]))[0]

    def plans(self, tongue: Tongue) -> Plans:
        """The plans of the given pose; on that of the mechanism are its other positions, and the paths of points."""
        motion, count = self.result.reduction.motion, self.result.positions
        places = {name: [(float(z.real), float(z.imag)) for z in np.atleast_1d(zs) + 0j]
                  for name, zs in motion.turn(self.travel).points.items()}
        positions = tuple({name: spots[k % len(spots)] for name, spots in places.items()}
                          for k in range(0, count, 1 + count // MAX_SMALL_FIGURES))
        paths = tuple(PointPath(name, (*places[name], places[name][0]), (False, False))
                      for name in motion.scene.find.velocity if name in places)
        return Plans(self.drawing, tongue, motion=TracedMotion(paths, positions))

    @cached_property
    def _ends(self) -> dict[str, Any]:
        """The ends of the orthogonal velocities of moving points, by name: complex arrays of shape (count,), for a unit
        rate."""
        scene, own = self.result.reduction.scene, self.result.reduction.motion
        points = moving_points(scene, (name for link in scene.moving for name in scene.links[link]))
        motion = UnitMotion(scene, own.motion, replace(own.scene.find, velocity=points))
        rates = motion.velocities(own.turn(self.travel))
        return {name: 1j * own.sense * (rates.rate(kinds.VELOCITY, name) + np.zeros(self.result.positions))
                for name in points}

    def small(self, rect: Rect, text: SheetText, drawn: bool = True) -> Iterator[Item]:
        """The orthogonal velocities of the other positions, or some of them, each beside its number, at one scale: rays
        from the pole, and the links' images; or where these are not `drawn` their poles alone."""
        shown = range(1, self.result.positions, 1 + self.result.positions // MAX_SMALL_FIGURES)
        cells, number, margin = _grid(rect, len(shown)), NUMBER * text.letters.text, FIGURE_MARGIN_MM
        rooms = [cell.inset(margin, margin, margin, margin + number) for cell in cells]
        ends = [{name: (float(z[k].real), float(z[k].imag)) for name, z in self._ends.items()} for k in shown]
        boxes = [bounding_box([(0.0, 0.0), *spots.values()]) for spots in ends]
        scale, scene = max(map(fit_scale, boxes, rooms)) or 1.0, self.result.reduction.scene
        links = [[name for name in scene.links[link] if name in self._ends] for link in scene.moving]
        for k, cell, room, box, places in zip(shown, cells, rooms, boxes, ends, strict=True):
            yield text.text((cell.left + margin, cell.top - number), str(k))
            window = view(box, room, scale)
            spots, pole = {name: window(place) for name, place in places.items()}, window((0.0, 0.0))
            if drawn:
                yield from (Polyline(RAY, "links", None, (pole, end)) for end in spots.values()
                            if math.dist(pole, end) > margin / 4)
                yield from (Polyline(IMAGE, "links", None, tuple(spots[name] for name in names)) for names in links
                            if len(names) > 1)
            yield Circle(pens.ORIGIN, "links", None, pole, POLE_RADIUS_MM)


def given_items(plate: Plate) -> list[Item]:
    """The given part of a plan: the mechanism with its loads in its positions, or where it begins."""
    given = list(starting_items(plate))
    return [*given, *plate.positions(given)]


def _grid(rect: Rect, count: int) -> list[Rect]:
    """A rectangle in so many cells as square as can be, row by row from the upper left."""
    columns = max(range(1, count + 1), key=lambda n: min(rect.width / n, rect.height / math.ceil(count / n)))
    wide, high = rect.width / columns, rect.height / math.ceil(count / columns)
    return [Rect(rect.left + x * wide, rect.top - (y + 1) * high, rect.left + (x + 1) * wide, rect.top - y * high)
            for y, x in (divmod(k, columns) for k in range(count))]
