"""The sheet of a flywheel: the mechanism in its positions, Zhukovsky's levers, and the diagrams one under another.

The diagrams are those of the second sheet of a course project: reduced moment with the moment that closes the cycle,
energy by graphical integration, reduced inertia, turned, and Wittenbauer's curve between its two tangents. They stand
on one panel, so that abscissae are shared and points carried across, as on a drawing board.

Source: Ozols 1974, 13-6 and 15-2 with figs. 13-9, 15-2 and 15-3.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

from graphplan.kernel.passes import Drawing, Values, put_together
from graphplan.kernel.program import Panel
from graphplan.machines.flywheel.drawing import FLYWHEEL, FlywheelDrawing, draw_flywheel
from graphplan.machines.flywheel.energy_constructions import AREAS, GUTJAHR, draw_by
from graphplan.machines.flywheel.figure import EnergyFigure, FlywheelFigure, sizes_for_energies, sizes_in
from graphplan.machines.flywheel.lever_figures import LEVERS, LeverFigures
from graphplan.machines.flywheel.numbers import INERTIA, MOMENT, RATE, columns
from graphplan.machines.flywheel.result import NEGLECTS_NOTHING, FlywheelResult
from graphplan.mechanism.model import Scene
from graphplan.output.graphs import Figures
from graphplan.output.panelled import Blank, Panelled, Words, divide_across, divide_down
from graphplan.output.tolerances import RANGE_TOL
from graphplan.phrases import Said, arrange, digits, join, phrase, said, unit
from graphplan.sheet.frames.title import TASK
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.display import Item, Rect
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.words.facts import machine_facts, topic_texts
from graphplan.sheet.words.rows import TextRow

DOCUMENT = said("Flywheel sheet")
UPPER, SHARES = 0.36, (0.4, 0.3, 0.3)  # of the height: the plans; of the width: mechanism, lever, the other levers
WITTENBAUER = "wittenbauer"
DESCRIPTIONS = {WITTENBAUER: phrase("Flywheel by Wittenbauer's diagram from {0} plans."),
                GUTJAHR: phrase("Flywheel by Gutjahr's curves from {0} plans."),
                AREAS: phrase("Flywheel by the vectors of areas; {0} plans.")}
HEADINGS = {GUTJAHR: said("Moment, energy and Gutjahr's curves"), AREAS: said("Moment and vectors of areas")}
NAMES = {"gutjahr": said("Gutjahr"), "area vectors": said("area vectors"), "power": said("power"),
         "characteristic": said("characteristic")}


@dataclass(frozen=True)
class FlywheelSheet(Panelled):
    """One flywheel on one paper."""

    result: FlywheelResult
    task: bool = False
    by: str = WITTENBAUER
    told_scales = steps_apart = True
    letters_of = "phi", "psi", "delta", "omega", "omega_max", "omega_min", "k_phi", "k_M", "k_E", "k_I"

    @property
    def document(self) -> Said:
        return TASK if self.task else DOCUMENT

    @property
    def scene(self) -> Scene:
        return self.result.scene

    @property
    def description(self) -> Said:
        return DESCRIPTIONS[self.by](self.result.positions)

    @property
    def scale(self) -> Said:
        return self._windows[0].ratio

    # ---- panels ----------------------------------------------------------------------------------------------------

    @property
    def _plans(self) -> tuple[Panel, ...]:
        """The plans of the given pose."""
        return tuple(self.levers.plans.panels)

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        """The plans of the given pose and the other levers beside each other, under them the diagrams."""
        upper, lower = divide_down(room, UPPER, 1 - UPPER)
        count = len(self._plans)
        rects = divide_across(upper, *SHARES[:2], *(SHARES[1] for _ in range(count - 2)), SHARES[2])
        return dict(zip((*self._plans, LEVERS), rects, strict=True)) | {FLYWHEEL: lower}

    @cached_property
    def levers(self) -> LeverFigures:
        """The levers of the cycle."""
        return LeverFigures(self.result.reduction, self.result.positions, self.tongue, self.letters)

    @cached_property
    def _windows(self) -> tuple[Scales, Plates]:
        """The scales and windows of the plans of the given pose."""
        return self.levers.plates({panel: self.room(panel) for panel in self._plans})

    @cached_property
    def drawing(self) -> FlywheelDrawing:
        """The diagrams, as large as they have room."""
        if self.by != WITTENBAUER:
            return draw_by(self.by, self.result, sizes_for_energies(self.room(FLYWHEEL), self._figures))
        room = sizes_in(self.room(FLYWHEEL), self.result, self._figures)
        return draw_flywheel(self.result.cycle, self.result.wheel, self.result.positions, room)

    @cached_property
    def combined_drawing(self) -> tuple[Values, list[list[int]]]:
        """The lever and the diagrams as one construction, and where the steps of both are in it."""
        lever, diagrams = self.levers.drawing, self.drawing.values
        program, places = put_together([lever.drawn, diagrams.drawing.program])
        values = dict(zip(places[0], lever.values, strict=True)) | dict(zip(places[1], diagrams.numbers, strict=True))
        drawing = Drawing(program, plans=diagrams.drawing.plans)
        return Values(drawing, [values[index] for index in range(len(program))]), places

    @property
    def values(self) -> Values:
        return self.combined_drawing[0]

    @property
    def scales(self) -> Scales:
        scales = self._windows[0]
        return replace(scales, multiples={**scales.multiples, FLYWHEEL: Fraction(scales.k_s)})  # drawn in mm

    @property
    def _figures(self) -> Figures:
        return Figures(self.letters, self.tongue)

    def heading(self, panel: Panel) -> tuple[Said, Said | None]:
        """What a panel shows, and the scales of plans."""
        if panel in self._plans:
            return self.levers.heading(panel, self._windows[0])
        return HEADINGS.get(self.by, panel.heading) if panel == FLYWHEEL else panel.heading, None

    @property
    def results_heading(self) -> Said:
        return said("To find") if self.task else super().results_heading

    def repeats(self, panel: Panel) -> bool:
        """The lever is told step by step, of the diagrams each kind of step once."""
        return panel == FLYWHEEL

    def figure(self, panel: Panel, rect: Rect) -> Iterable[Item]:
        """The plans, the other levers, or the diagrams."""
        if panel == LEVERS:
            return self.levers.small(rect, drawn=not self.task)
        if panel == FLYWHEEL:
            values, places = self.combined_drawing
            kind = FlywheelFigure if self.by == WITTENBAUER else EnergyFigure
            figure = kind(self.result, self.drawing, values, places[1], self._figures, rect)
            return figure.given_items() if self.task else figure.items()
        drawn = self.levers.given_items if self.task else self.levers.picture
        return [self.with_sheet_step(item) for item in drawn(self._windows[1], panel)]

    def with_sheet_step(self, item: Item) -> Item:
        """An item of the lever, its step that of the sheet."""
        return item if item.step is None else replace(item, step=self.combined_drawing[1][0][item.step])

    # ---- words -----------------------------------------------------------------------------------------------------

    def given_words(self) -> Iterator[Words]:
        """The speed and how even it is to be, the masses and the loads."""
        result = self.result
        yield arrange("omega = {0} {1}", digits(result.cycle.speed), unit(RATE))
        if result.given:
            yield arrange("I_s = {0} {1}", digits(result.wheel.inertia), unit(INERTIA))
        else:
            yield arrange("delta = {0}", digits(result.unevenness))
        yield from topic_texts(machine_facts(self.scene))

    def result_words(self) -> Iterator[Words]:
        """What closes the cycle, the flywheel, the speeds, and what other methods find; of a task boxes for these."""
        result = self.result
        if self.task:
            yield Blank([["", ""], *([join((name, unit(measure))), "?"] for name, measure in (
                (said("Closing moment"), MOMENT), ("mn", "mm"), (said("Flywheel"), INERTIA), ("omega_max", RATE),
                ("omega_min", RATE)))])
            return
        cycle, wheel = result.cycle, result.wheel
        if cycle.closing:
            yield said("Closing moment: {0} {1}", digits(cycle.closing), unit(MOMENT))
        if result.given:
            yield arrange("delta = {0}", digits(result.unevenness))
            if wheel.inertia + self.drawing.axis > 0:  # else m and n are one point
                yield arrange("k_E·mn/((I_s + {0} {1})·ω²) = {2}", digits(self.drawing.axis), unit(INERTIA),
                              digits(self.drawing.unevenness))
        else:
            yield said("Flywheel: {0} {1}; drawn {2} {1}", digits(wheel.inertia), unit(INERTIA),
                       digits(self.drawing.inertia))
        neglecting = next((one for one in result.methods if self.by == AREAS and one.name == "area vectors"), None)
        yield arrange("mn = {0} {1}, {2} {3}", digits(self._intercept), unit("mm"),
                      digits(neglecting.stored if neglecting else wheel.intercept(self.drawing.axis)), unit("J"))
        if neglecting:
            yield said("As drawn it {0}", neglecting.neglects)
        for name, speed, touch in (("omega_max", wheel.omega_max, wheel.upper), ("omega_min", wheel.omega_min,
                                                                                 wheel.lower)):
            at = join((digits(float(result.in_degrees(touch.travel))), unit("°")), "")
            yield said("{0} = {1} {2} at {3}", name, digits(speed), unit(RATE), at)
        for note in result.notes:
            yield arrange("{0:capital}", note)
        if result.reduction.friction:
            losses = result.reduction.losses
            yield said("Friction takes {0} {1} of the {2} {1} given in a cycle: mean efficiency {3}",
                       digits(losses.lost), unit("J"), digits(losses.given), digits(losses.efficiency))
            yield join(arrange("{0}: {1} {2}", name, digits(lost), unit("J")) for name, lost in losses.pairs.items())
        yield from self._methods()

    @property
    def _intercept(self) -> float:
        """How far apart m and n are on paper, in mm."""
        ((_, m),), ((_, n),) = map(self.drawing.values.values_of_role, "mn")
        return float(m - n)

    def _methods(self) -> Iterator[Words]:
        """What each method finds, and what it neglects."""
        rows = [(said("Wittenbauer"), self.result.wheel.inertia, NEGLECTS_NOTHING),
                *((NAMES[one.name], one.inertia, one.neglects) for one in self.result.methods)]
        for name, inertia, neglects in rows if self.result.methods else ():
            yield arrange("{0:capital}: {1} {2}; {3}", name, digits(inertia), unit(INERTIA), neglects)

    def tables(self) -> Iterator[Words]:
        """A row for each plan."""
        shown = [column for name, column in columns(self.result).items() if name != "whole"]
        size = [float(abs(column.values).max()) or 1.0 for column in shown]
        head = ["", *(arrange("{0}, {1}", column.letter, unit(column.unit)) for column in shown)]
        rows = [[str(k), *(digits(float(x) if abs(x) > RANGE_TOL * most else 0.0)
                           for x, most in zip(row, size, strict=True))]
                for k, row in enumerate(zip(*(column.values for column in shown), strict=True))]
        if self.task:  # the travels are given
            yield Blank([join(filter(None, (one, two)), ": "), *rest] for one, two, *rest in (head, *rows))
        else:
            yield [head, *rows]

    @property
    def step_rows(self) -> list[TextRow]:
        """The construction in words; a task has none."""
        return [] if self.task else super().step_rows
