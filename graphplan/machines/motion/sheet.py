"""The sheet of a true motion, and its numbers as JSON and as a table.

The diagrams lie as on the drawing board: under each other over one axis of travel, the energy-mass diagram beside the
energies that are carried across, under the inertias that are carried down.

Source: Ozols 1974, 13-6 with figs. 13-9 and 13-10.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel
from graphplan.machines.motion.drawing import (
    MOTION,
    POLE_ROOM_MM,
    MotionDrawing,
    PanelSize,
    baranov,
    by_energy,
    draw_motion,
    moment_curve,
    times,
)
from graphplan.machines.motion.runs import MachineMotion, Place
from graphplan.mechanism.model import Scene
from graphplan.output.graphs import AXIS, FOOT, HEADED, Figures, Graph
from graphplan.output.panelled import Panelled, Words
from graphplan.output.tables import TableColumn, column_csv, plain_unit
from graphplan.phrases import Said, arrange, digits, join, phrase, said, unit
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.lettering.letters import items_with_names
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import DrawnStep, Plate, plate_of_values
from graphplan.sheet.plates.view import View, clip_item
from graphplan.sheet.words.facts import machine_facts, topic_texts


def numbers(found: MachineMotion, drawing: MotionDrawing | None, check: dict[str, float], positions: int) -> dict[str,
                                                                                                                  Any]:
    """All of it, plain data for JSON: travel in degrees and rates in rad/s, of a drive that slides in scene lengths;
    moments in N m (forces in N), energies in J; null where the machine does not get."""
    motion, machine = found.motion, found.machine
    rows, measures = columns(found, positions), quantities(found)
    data: dict[str, Any] = {"title": found.scene.title, "units": {name: plain_unit(measures[name][1]) for name in rows}}
    data |= {name: json_numbers(values) for name, values in rows.items()}
    data |= {"stop": None if motion.stop is None else place_numbers(found, motion.stop), "speeds": speed_numbers(found)}
    data["steady"] = found.steady is motion
    if machine.wheel:
        data["flywheel"] = {"inertia": machine.wheel}
    if machine.closing:
        data["closing_moment"] = machine.closing
    if found.nominal is not None:
        data["nominal_omega"] = found.nominal / machine.pace
    if found.run_up is not None:
        data["run_up"] = {**place_numbers(found, found.run_up.place), "turns": found.run_up.turns}
    data["drawn"] = None if drawing is None else drawn_numbers(found, drawing)
    data["strips"] = strip_numbers(found, positions)
    return data | {"check": check}


def quantities(found: MachineMotion) -> dict[str, tuple[str, str]]:
    """Letters and units of what changes over the motion: of a drive that slides it is forces and masses."""
    slides, length = found.scene.drives[0].slides, found.scene.units.length
    s, v, a, F, m = ("s", "v", "a", "F", "m") if slides else ("phi", "omega", "epsilon", "M", "I")
    travel, angle, moment, inertia = (length, length, "N", "kg") if slides else ("°", "rad", "N m", "kg m²")
    return {"travel": (s, travel), "omega": (v, f"{angle}/s"), "time": ("t", "s"), "acceleration": (a, f"{angle}/s²"),
            "energy": ("E", "J"), "moment": (F, moment), "inertia": (m, inertia), "slowness": (f"1/{v}", f"s/{angle}")}


def columns(found: MachineMotion, positions: int) -> dict[str, Any]:
    """Travel, speed, time, acceleration, energy, moment of all loads and inertia at the ends of so many parts."""
    motion, machine = found.motion, found.machine
    travel = np.linspace(motion.start, motion.end, positions + 1)
    state = motion.state_at(travel)
    lost = np.where(np.isnan(state.omega), np.nan, 0.0)
    return {"travel": travel / machine.degree, "omega": state.omega / machine.pace, "time": state.time,
            "acceleration": state.acceleration / machine.pace, "energy": state.energy,
            "moment": machine.moment(travel, state.omega) + lost, "inertia": machine.inertia(travel) + lost}


def table(found: MachineMotion, positions: int) -> str:
    """The same as comma-separated text: a heading, then a line for each position."""
    measures = quantities(found)
    return column_csv(TableColumn(name, *measures[name], values) for name, values in columns(found, positions).items())


def drawn_numbers(found: MachineMotion, drawing: MotionDrawing) -> dict[str, Any]:
    """What the drawing says at its divisions, and how far it is off at most, as parts of the largest value."""
    machine = found.machine
    return {"travel": json_numbers(drawing.travel / machine.degree), "energy": json_numbers(drawing.read("energy")),
            "omega": json_numbers(drawing.read("omega") / machine.pace), "time": json_numbers(drawing.read("time")),
            "error": drawing.errors}


def strip_numbers(found: MachineMotion, positions: int) -> dict[str, Any]:
    """What other forms come to at the end of as many strips, beside the true motion there."""
    motion, machine = found.motion, found.machine
    travel = np.linspace(motion.start, motion.last_travel, positions + 1)[:None if motion.stop is None else -1]
    exact = motion.state_at(travel)
    forms = {"true": exact.omega}
    if len(travel) > 3:
        forms |= {"euler": by_energy(machine, travel, float(exact.omega[0])),
                  "baranov": baranov(machine, travel, float(exact.omega[0]))}
    data = {name: {"omega": json_number(omega[-1] / machine.pace), "time": json_number(times(travel, omega)[-1])}
            for name, omega in forms.items() if name != "true"}
    return {"travel": float(travel[-1] / machine.degree),
            "true": {"omega": json_number(exact.omega[-1] / machine.pace), "time": json_number(exact.time[-1])}, **data}


def speed_numbers(found: MachineMotion) -> dict[str, Any]:
    """The largest and the least speed, where they are, and the means."""
    motion, pace = found.motion, found.machine.pace
    least, most = motion.extremes
    means = motion.means
    return {"max": place_numbers(found, most), "min": place_numbers(found, least),
            "arithmetic_mean": means.arithmetic / pace,
            "mean_over_travel": means.planimetric / pace, "mean_over_time": json_number(means.true / pace),
            "unevenness": means.unevenness}


def place_numbers(found: MachineMotion, place: Place) -> dict[str, float | None]:
    """A travel with the speed and the time there."""
    return {"travel": float(place.travel / found.machine.degree), "omega": float(place.omega / found.machine.pace),
            "time": json_number(place.time)}


def json_numbers(values: Any) -> list[float | None]:
    return [json_number(value) for value in values]


def json_number(value: float) -> float | None:
    return float(value) + 0.0 if math.isfinite(value) else None


FINE, CHORD = Pen(0.13, "#a8a8a8"), Pen(0.25, pens.VIOLET)
CURVES = {"moment": Pen(0.5), "energy": Pen(0.5, pens.BLUE), "inertia": Pen(0.5, pens.RED),
          "energy-mass": Pen(0.5, pens.VIOLET), "omega": Pen(0.5, pens.GREEN), "slowness": Pen(0.35, pens.GREEN),
          "time": Pen(0.5, pens.RED)}
CURVE_SAMPLES = 240  # at which a curve is known
MAX_NUMBERED = 10  # divisions at most whose numbers stand at a curve
OVER, RIGHT = 7.0, 4.0  # mm over the diagrams for a scale, and right of them


def room_in(rect: Rect) -> PanelSize:
    """How large the diagrams may be in a panel."""
    return PanelSize(rect.width - RIGHT, rect.height - OVER - FOOT - HEADED)


@dataclass(frozen=True)
class MotionFigure:
    """The diagrams of a run in their panel."""

    found: MachineMotion
    drawing: MotionDrawing
    paper: Figures
    rect: Rect

    @property
    def window(self) -> View:
        """From the drawing's mm to those of the sheet, as large, the pole at the left and the moments at the top."""
        return View(self.rect, 1.0, (self.rect.left + POLE_ROOM_MM, self.rect.top - OVER))

    @property
    def graphs(self) -> dict[str, Graph]:
        """The diagrams by name; travel is in degrees, or in lengths."""
        machine, found = self.found.machine, dict[str, Graph]()
        for name, frame in self.drawing.frames.items():
            graph = Graph.from_frame(frame, self.window)
            across = 1.0 if name in ("inertia", "energy-mass") else machine.degree
            up = {"inertia": machine.degree, "omega": machine.pace, "slowness": 1 / machine.pace}.get(name, 1.0)
            found[name] = graph._replace(x=graph.x.in_units(across), y=graph.y.in_units(up))
        return found

    def items(self) -> list[Item]:
        """All of it, its letters off its lines."""
        return items_with_names(self.ink, [*self._curves(), *self._axes()], self._wishes(), self.has_letter)

    @property
    def ink(self) -> Plate:
        """What the steps draw: fine lines, chords by themselves."""
        values = self.drawing.values
        steps, roles = values.drawing.program.steps, values.drawing.roles
        fine = {step.index: FINE for step in steps if step.op.gives in (LINE, CIRCLE)}
        chords = {steps[Q].args[1]: CHORD for name in ("energy", "time") for Q in roles[name]
                  if len(steps[Q].args) == 2}
        return plate_of_values(values, MOTION, self.window, self.found.scene,
                               self.paper.letters, pens={**fine, **chords}, beyond=dict.fromkeys(chords, 0.0))

    def _curves(self) -> Iterator[Item]:
        """The true curves."""
        motion, machine = self.found.motion, self.found.machine
        travel = np.linspace(motion.start, motion.last_travel, CURVE_SAMPLES + 1)
        state, told = motion.state_at(travel), (travel - motion.start) / machine.degree
        with np.errstate(divide="ignore"):
            slowness = machine.pace / state.omega
        rows = {"energy": state.energy, "omega": state.omega / machine.pace, "slowness": slowness, "time": state.time}
        for name, values in rows.items():
            yield from self._curve(name, told, values)
        travels, moments = moment_curve(motion)
        yield from self._curve("moment", (travels - motion.start) / machine.degree, moments)
        inertia = machine.inertia(travel)
        yield from self._curve("inertia", inertia, told)
        yield from self._curve("energy-mass", inertia, state.energy)

    def _curve(self, name: str, xs: Any, ys: Any) -> Iterator[Item]:
        graph = self.graphs[name]
        known = np.isfinite(xs) & np.isfinite(ys)
        line = Polyline(CURVES[name], "links", None, tuple(graph.spots(xs[known], ys[known])))
        yield from clip_item(line, Rect(graph.rect.left, graph.rect.bottom, graph.rect.right, graph.rect.top + 2.0))

    # ---- axes and letters ------------------------------------------------------------------------------------------

    def scale_label(self, what: str, k: float, at: Spot, anchor: str = "start") -> Item:
        """Letter, unit and scale of a quantity."""
        letter, measure = quantities(self.found)[what]
        scale, convention = {"1/omega": "u", "1/v": "u"}.get(letter, letter), self.found.scene.sheet.convention
        return self.paper.quantity(at, letter, measure, k, convention, anchor, scale)

    def _axes(self) -> Iterator[Item]:
        """Axes, round divisions with numbers, and scales."""
        paper, graphs, turns = self.paper, self.graphs, not self.found.scene.drives[0].slides
        for name in ("moment", "energy", "omega", "slowness", "time"):
            graph = graphs[name]
            yield from paper.ordinate(graph, head=True)
            yield from paper.abscissa(graph)
            yield from paper.numbered_y(graph)
            yield self.scale_label(name, graph.y.unit, (graph.rect.left + 2.0, graph.rect.top + HEADED / 2))
        low = graphs["time"]
        yield from paper.numbered_x(low, turns=turns)
        yield self.scale_label("travel", low.x.unit, (low.rect.right, low.rect.bottom - FOOT - 1.0), "end")
        mass, inertia = graphs["energy-mass"], graphs["inertia"]
        yield from paper.ordinate(mass, head=True)
        yield from paper.abscissa(mass)
        yield from paper.numbered_x(mass)
        corner = inertia.rect.left, inertia.rect.top
        for end in ((inertia.rect.right, corner[1]), (corner[0], inertia.rect.bottom)):
            yield Polyline(AXIS, "ruling", None, (corner, end))
        yield self.scale_label("inertia", inertia.x.unit, (inertia.rect.left, inertia.rect.top + HEADED / 2))

    def has_letter(self, mark: DrawnStep) -> bool:
        """Whether the name of a mark stands on the sheet: divisions have their numbers at the curve alone."""
        return "_" not in mark.name

    def _wishes(self) -> Iterator[Wish]:
        """The numbers of some divisions along the energy-mass curve and the curve of speeds."""
        marks, count = self.drawing.values.drawing.roles, len(self.drawing.travel)
        for what in ("energy-mass", "omega"):
            first, every = count - len(marks[what]), -(-count // MAX_NUMBERED)
            for k, step in enumerate(marks[what], first):
                if k % every:
                    continue
                spot = self.window(self.drawing.values[step])
                yield Wish(sentence_runs(str(k)), (spot,), 0.5, minor=True, pen=pens.FAINT, label=f"{what} {k}")


@dataclass(frozen=True)
class MotionSheet(Panelled):
    """One motion on one paper."""

    found_run: MachineMotion
    strips: int
    repetition_note = phrase("Steps {0} to {1}: the same at the other divisions.")
    letters_of = "phi", "omega", "epsilon", "psi", "k_E", "k_I", "k_ω"

    @property
    def document(self) -> Said:
        return said("Motion sheet")

    @property
    def scene(self) -> Scene:
        return self.found_run.scene

    @property
    def description(self) -> Said:
        return said("The true motion of a machine in {0} strips.", self.strips)

    @property
    def scale(self) -> Said:
        return said("as stated")

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        """One panel with all diagrams."""
        return {MOTION: room}

    @cached_property
    def drawing(self) -> MotionDrawing:
        """The diagrams, as large as they have room."""
        found = draw_motion(self.found_run.motion, self.strips, room_in(self.room(MOTION)))
        if found is None:
            raise Refused("the sheet", "the machine stops within the first strips",
                          "a shorter travel (--travel), or more strips (--positions)")
        return found

    @property
    def values(self) -> Values:
        return self.drawing.values

    def figure(self, panel: Panel, rect: Rect) -> list[Item]:
        """The diagrams."""
        return MotionFigure(self.found_run, self.drawing, Figures(self.letters, self.tongue), rect).items()

    # ---- words -----------------------------------------------------------------------------------------------------

    def given_words(self) -> Iterator[Words]:
        """The speed at the beginning, the flywheel and what closes the cycle, masses and loads."""
        run = self.found_run
        first = float(run.motion.state_at([run.motion.start]).omega[0]) / run.machine.pace
        yield said("At the beginning: {0} {1}", digits(first), self._unit("omega"))
        if run.machine.wheel:
            yield said("Flywheel: {0} {1}", digits(run.machine.wheel), self._unit("inertia"))
        if run.machine.closing:
            yield said("Closing moment: {0} {1}", digits(run.machine.closing), self._unit("moment"))
        yield from topic_texts(machine_facts(self.scene))

    def _unit(self, what: str) -> Said:
        return unit(quantities(self.found_run)[what][1])

    def result_words(self) -> Iterator[Words]:
        """Where it stops, its speeds and their means, the run-up, and the divisions as a table."""
        run, motion, machine = self.found_run, self.found_run.motion, self.found_run.machine
        rate = self._unit("omega")
        if motion.stop is not None:
            at, known = self.travel_words(motion.stop.travel), math.isfinite(motion.stop.time)
            yield (said("It stops at {0}, after {1} s", at, digits(motion.stop.time)) if known
                   else said("It comes to rest at {0}, for ever nearing it", at))
        for words, place in zip((said("Least speed"), said("Largest speed")), motion.extremes, strict=True):
            yield said("{0}: {1} {2} at {3}", words, digits(place.omega / machine.pace), rate,
                       self.travel_words(place.travel))
        if run.nominal is not None:
            yield said("Nominal speed: {0} {1}", digits(run.nominal / machine.pace), rate)
        if run.run_up is not None:
            yield said("Run up in {0} turns, {1} s", digits(run.run_up.turns), digits(run.run_up.place.time))
        errors = self.drawing.errors
        yield said("The drawing is off by {0} % in the speed, {1} % in the time",
                   *(digits(round(100 * errors[what], 4)) for what in ("omega", "time")))
        yield self._table()

    def travel_words(self, travel: float) -> Said:
        """A travel with its unit, degrees without a gap."""
        machine = self.found_run.machine
        gap = " " if self.scene.drives[0].slides else ""
        return join((digits(travel / machine.degree), self._unit("travel")), gap)

    def _table(self) -> list[list[Said | str]]:
        """A row for each division: true values, and what is drawn."""
        drawing, machine, motion = self.drawing, self.found_run.machine, self.found_run.motion
        true = motion.state_at(drawing.travel)
        columns = (drawing.travel / machine.degree, true.omega / machine.pace, drawing.read("omega") / machine.pace,
                   true.time, drawing.read("time"), true.acceleration / machine.pace)
        measures = quantities(self.found_run)
        travel, rate, change = (arrange("{0}, {1}", letter, unit(measure))
                                for letter, measure in map(measures.__getitem__, ("travel", "omega", "acceleration")))
        head = ["", travel, rate, said("drawn"), arrange("{0}, {1}", "t", unit("s")), said("drawn"), change]
        return [head, *([str(k), *("" if math.isnan(x) else digits(float(x)) for x in row)]
                        for k, row in enumerate(zip(*columns, strict=True)))]
