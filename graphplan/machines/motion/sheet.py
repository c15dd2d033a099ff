"""The sheet of a true motion, and its numbers as JSON and as a table.

The diagrams lie as on the drawing board: under each other over one axis of travel, the energy-mass diagram beside the
energies that are carried across, under the inertias that are carried down.

Source: Ozols 1974, 13-6 with figs. 13-9 and 13-10.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE
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
from graphplan.output.tables import TableColumn, column_csv, plain_unit, quantity_table
from graphplan.phrases import Said, digits, join, said, unit
from graphplan.sheet.diagrams import FOOT, HEADED, Diagram, DrawnCurve, QuantityAxis
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.panels import SAME_AT_DIVISIONS, PanelFigure, PanelPage, PanelSheet, Words, column
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import plate_of_values
from graphplan.sheet.plates.view import View
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
    """Comma-separated text: a heading, then a line for each position."""
    measures = quantities(found)
    return column_csv(TableColumn(name, *measures[name], values) for name, values in columns(found, positions).items())


def drawn_numbers(found: MachineMotion, drawing: MotionDrawing) -> dict[str, Any]:
    """Drawn values at the divisions, and their largest errors, as parts of the largest value."""
    machine = found.machine
    return {"travel": json_numbers(drawing.travel / machine.degree), "energy": json_numbers(drawing.read("energy")),
            "omega": json_numbers(drawing.read("omega") / machine.pace), "time": json_numbers(drawing.read("time")),
            "error": drawing.errors}


def strip_numbers(found: MachineMotion, positions: int) -> dict[str, Any]:
    """Results of other forms at the end of as many strips, beside the true motion there."""
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
CURVES_BEYOND_MM = 2.0  # mm by which a true curve may be beyond its diagram
LETTERS = "phi", "omega", "epsilon", "psi", "k_E", "k_I", "k_ω"


def motion_sheet(paper: str, run: MachineMotion, strips: int) -> PanelSheet:
    """The sheet of a run, its diagrams as large as they have room; fails with `Refused` where it stops at once."""
    page = PanelPage(paper, run.scene, column((1.0, MOTION)))
    rect = page.room(MOTION)
    size = PanelSize(rect.width - RIGHT, rect.height - OVER - FOOT - HEADED)
    if (drawing := draw_motion(run.motion, strips, size)) is None:
        raise Refused("the sheet", "the machine stops within the first strips",
                      "a shorter travel (run.travel), or more strips (--positions)")
    return PanelSheet(
        page, said("Motion sheet"), said("The true motion of a machine in {0} strips.", strips), drawing.values,
        said("as stated"), {MOTION: diagrams_figure(run, drawing, page)}, given=[*given_words(run)],
        found=[*result_words(run, drawing)], names=LETTERS, repetition_note=SAME_AT_DIVISIONS)


def diagrams_figure(run: MachineMotion, drawing: MotionDrawing, page: PanelPage) -> PanelFigure:
    """The diagrams as large as they are drawn, the pole at the left and the moments at the top: what steps draw in fine
    lines, chords by themselves, and the true curves with their axes."""
    rect, values = page.room(MOTION), drawing.values
    window = View(rect, 1.0, (rect.left + POLE_ROOM_MM, rect.top - OVER))
    steps, roles = values.drawing.program.steps, values.drawing.roles
    fine = {step.index: FINE for step in steps if step.op.gives in (LINE, CIRCLE)}
    chords = {steps[Q].args[1]: CHORD for name in ("energy", "time") for Q in roles[name] if len(steps[Q].args) == 2}
    plate = plate_of_values(values, MOTION, window, run.scene, page.letters, {**fine, **chords},
                            beyond=dict.fromkeys(chords, 0.0))
    return PanelFigure(rect, [*diagrams(run, drawing, window)], plate, wishes=[*division_numbers(drawing, window)],
                       is_named=lambda mark: "_" not in mark.name)  # divisions have their numbers at the curve alone


def diagrams(run: MachineMotion, drawing: MotionDrawing, window: View) -> Iterator[Diagram]:
    """The diagrams with their true curves; travel is in degrees, or in lengths."""
    motion, machine, turns = run.motion, run.machine, not run.scene.drives[0].slides
    travel = np.linspace(motion.start, motion.last_travel, CURVE_SAMPLES + 1)
    state, told, inertia = motion.state_at(travel), (travel - motion.start) / machine.degree, machine.inertia(travel)
    travels, moments = moment_curve(motion)
    with np.errstate(divide="ignore"):
        slowness = machine.pace / state.omega
    curves = {"moment": ((travels - motion.start) / machine.degree, moments), "energy": (told, state.energy),
              "omega": (told, state.omega / machine.pace), "slowness": (told, slowness), "time": (told, state.time),
              "energy-mass": (inertia, state.energy), "inertia": (inertia, told)}
    measures, plain = quantities(run), QuantityAxis(numbers=False)
    units = {"inertia": machine.degree, "omega": machine.pace, "slowness": 1 / machine.pace}
    for name, (xs, ys) in curves.items():
        frame = drawing.frames[name].seen_through(window)
        across = 1.0 if name in ("inertia", "energy-mass") else machine.degree
        frame = frame._replace(x=frame.x.in_units(across), y=frame.y.in_units(units.get(name, 1.0)))
        axes = {"time": (QuantityAxis(*measures["travel"], turns=turns), QuantityAxis(*measures["time"])),
                "energy-mass": (QuantityAxis(), plain),
                "inertia": (QuantityAxis(*measures["inertia"], numbers=False, anchor="start"),
                            plain._replace(head=False))}
        scale = "u" if name == "slowness" else ""
        x, y = axes.get(name) or (plain, QuantityAxis(*measures[name], scale))
        yield Diagram(frame, x, y, [DrawnCurve(xs, ys, CURVES[name])], over=CURVES_BEYOND_MM)


def division_numbers(drawing: MotionDrawing, window: View) -> Iterator[Wish]:
    """The numbers of some divisions along the energy-mass curve and the curve of speeds."""
    roles, count = drawing.values.drawing.roles, len(drawing.travel)
    for what in ("energy-mass", "omega"):
        for k, step in enumerate(roles[what], count - len(roles[what])):
            if k % -(-count // MAX_NUMBERED) == 0:
                spot = window(drawing.values[step])
                yield Wish(sentence_runs(str(k)), (spot,), 0.5, minor=True, pen=pens.FAINT, label=f"{what} {k}")


# ---- words ----------------------------------------------------------------------------------------------------------


def given_words(run: MachineMotion) -> Iterator[Words]:
    """The speed at the beginning, the flywheel and what closes the cycle, masses and loads."""
    measures, first = quantities(run), float(run.motion.state_at([run.motion.start]).omega[0]) / run.machine.pace
    yield said("At the beginning: {0} {1}", digits(first), unit(measures["omega"][1]))
    if run.machine.wheel:
        yield said("Flywheel: {0} {1}", digits(run.machine.wheel), unit(measures["inertia"][1]))
    if run.machine.closing:
        yield said("Closing moment: {0} {1}", digits(run.machine.closing), unit(measures["moment"][1]))
    yield from topic_texts(machine_facts(run.scene))


def result_words(run: MachineMotion, drawing: MotionDrawing) -> Iterator[Words]:
    """The stop, the speeds and their means, the run-up, and the divisions as a table."""
    motion, machine, measures = run.motion, run.machine, quantities(run)
    rate, gap = unit(measures["omega"][1]), " " if run.scene.drives[0].slides else ""

    def travel_words(travel: float) -> Said:
        """A travel with its unit, degrees without a gap."""
        return join((digits(travel / machine.degree), unit(measures["travel"][1])), gap)

    if motion.stop is not None:
        at, known = travel_words(motion.stop.travel), math.isfinite(motion.stop.time)
        yield (said("It stops at {0}, after {1} s", at, digits(motion.stop.time)) if known
               else said("It approaches rest at {0} asymptotically", at))
    for words, place in zip((said("Least speed"), said("Largest speed")), motion.extremes, strict=True):
        yield said("{0}: {1} {2} at {3}", words, digits(place.omega / machine.pace), rate, travel_words(place.travel))
    if run.nominal is not None:
        yield said("Nominal speed: {0} {1}", digits(run.nominal / machine.pace), rate)
    if run.run_up is not None:
        yield said("Run up in {0} turns, {1} s", digits(run.run_up.turns), digits(run.run_up.place.time))
    errors = drawing.errors
    yield said("Error of the drawing: {0} % in speed, {1} % in time",
               *(digits(round(100 * errors[what], 4)) for what in ("omega", "time")))
    true = motion.state_at(drawing.travel)
    rows = {"travel": drawing.travel / machine.degree, "omega": true.omega / machine.pace,
            "drawn omega": drawing.read("omega") / machine.pace, "time": true.time,
            "drawn time": drawing.read("time"), "acceleration": true.acceleration / machine.pace}
    yield quantity_table([TableColumn(name, *measures.get(name, (said("drawn"), "")), values)
                          for name, values in rows.items()])
