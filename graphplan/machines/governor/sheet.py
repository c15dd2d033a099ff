"""The sheet of a governor: its characteristic C over r with the rays of its positions and of the spindle's speed;
beside it what is given and found, the construction in words, and all of it as numbers.

Source: Ozols 1974, 15-5 with figs. 15-14 to 15-16.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from graphplan.machines.governor.governor import (
    GOVERNOR,
    GovernorDrawing,
    GovernorResult,
    GovernorStates,
    draw_governor,
)
from graphplan.output.tables import TableColumn, column_csv, plain_unit, quantity_table
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.diagrams import CURVES, FOOT, HEADED, LEFT, ON, Diagram, DrawnCurve, QuantityAxis
from graphplan.sheet.panels import PanelFigure, PanelPage, PanelSheet, Words, check_words, column
from graphplan.sheet.plates.plate import plate_of_values
from graphplan.sheet.plates.view import View
from graphplan.sheet.words.facts import machine_facts, topic_texts

# ---- numbers --------------------------------------------------------------------------------------------------------


def columns(result: GovernorResult, states: GovernorStates) -> list[TableColumn]:
    """Travel, r, C and omega in some positions: degrees (or lengths), lengths of the scene, N and rad/s."""
    motion, length = result.reduction.motion, result.scene.units.length
    travel = ("phi", "°") if motion.turns else ("s", length)
    return [TableColumn("travel", *travel, motion.in_scene_units(states.travel)),
            TableColumn("r", "r", length, states.r / motion.metres), TableColumn("C", "C", "N", states.C),
            TableColumn("omega", "omega", "rad/s", states.omega)]


def friction_columns(result: GovernorResult) -> list[TableColumn]:
    """The speeds at which the drawn positions are left outwards and inwards, and the degree of insensitivity."""
    if not result.friction:
        return []
    outwards, inwards = result.band_speeds(result.drawn_states, result.drawn_band)
    return [TableColumn("omega_out", "omega''", "rad/s", outwards), TableColumn("omega_in", "omega'", "rad/s", inwards),
            TableColumn("insensitivity", "nu", "", result.insensitivity)]


def table(result: GovernorResult) -> str:
    """The positions as comma-separated text."""
    return column_csv([*columns(result, result.drawn_states), *friction_columns(result)])


def numbers(drawing: GovernorDrawing, check: Mapping[str, float]) -> dict[str, Any]:
    """All of it, plain data for JSON: the positions from the inmost outwards, and what follows."""
    result = drawing.result
    rows, stretches = [*columns(result, result.drawn_states), *friction_columns(result)], result.unstable_stretches
    return {
        "title": result.scene.title, "units": {row.name: plain_unit(row.unit) for row in rows}, "mass": result.mass,
        **{row.name: list(map(float, row.values)) for row in rows},
        "stable": not stretches and not result.is_isochronous, "isochronous": result.is_isochronous,
        "unstable": [[float(result.reduction.motion.in_scene_units(end)) for end in ends] for ends in stretches],
        "speeds": dict(zip(("min", "max"), result.extremes, strict=True)) | {"mean": result.mean},
        "irregularity": result.irregularity, "speed": result.spindle_speed,
        "equilibria": [{**{row.name: float(row.values[0]) for row in columns(result, states)}, "stable": stable}
                       for states, stable in result.equilibria],
        **_friction_numbers(result),
        "drawn": {"omega": drawing.omega.tolist(), "r": (drawing.r / result.reduction.motion.metres).tolist(),
                  **_drawn_friction(drawing)},
        "check": dict(check)}


def _friction_numbers(result: GovernorResult) -> dict[str, Any]:
    """Return the results of friction: C in both senses, the irregularity, and the stretches in which it holds."""
    if not result.friction:
        return {}
    outwards, inwards = result.drawn_band
    return {"C_out": outwards.tolist(), "C_in": inwards.tolist(),
            "irregularity_with_friction": result.irregularity_with_friction,
            "held": [[{row.name: float(row.values[0]) for row in columns(result, states)} for states in ends]
                     for ends in result.held_stretches]}


def _drawn_friction(drawing: GovernorDrawing) -> dict[str, Any]:
    """Return the drawn results of friction."""
    if not drawing.result.friction:
        return {}
    return {"position": drawing.result.drawn_middle + 1, "omega_out_in": drawing.band.tolist(),
            "held": (drawing.held_between / drawing.result.reduction.motion.metres).tolist()}


# ---- the sheet ------------------------------------------------------------------------------------------------------

LETTERS = ("omega", "psi", "delta", "nu", "epsilon", "omega''", "omega'", "omega_max", "omega_min", "k_r", "k_C", "phi")


def governor_sheet(paper: str, result: GovernorResult, check: Mapping[str, float]) -> PanelSheet:
    """The sheet of a governor: the diagram as large as it has room between its numbers, r in lengths of the scene."""
    page, metre = PanelPage(paper, result.scene, column((1.0, GOVERNOR))), result.reduction.motion.metres
    rect = page.room(GOVERNOR)
    inner = rect.inset(LEFT, 2 * FOOT, 2 * ON, HEADED)
    drawing = draw_governor(result, inner.width, inner.height)
    window = View(rect, 1.0, (inner.left, inner.bottom))
    frame = drawing.frame.seen_through(window)
    r, bands = result.curve.r / metre, result.curve_band if result.friction else ()
    curves = [DrawnCurve(r, result.curve.C, CURVES[1]), *(DrawnCurve(r, C, CURVES[3]) for C in bands)]
    diagram = Diagram(frame._replace(x=frame.x.in_units(metre)), QuantityAxis("r", result.scene.units.length),
                      QuantityAxis("C", "N"), curves)
    plate = plate_of_values(drawing.values, GOVERNOR, window, result.scene, page.letters,
                            pens={drawing.values.drawing.roles["speed"][1]: CURVES[2]})
    words = GovernorWords(drawing)
    return PanelSheet(
        page, said("Governor sheet"), said("The characteristic of a governor in {0} positions.", result.positions),
        drawing.values, said("as stated"), {GOVERNOR: PanelFigure(rect, [diagram], plate)},
        given=[*words.given_words()], found=[*words.found_words(check)], names=LETTERS)


@dataclass(frozen=True)
class GovernorWords:
    """The words of one sheet."""

    drawing: GovernorDrawing

    def given_words(self) -> Iterator[Words]:
        """The balls, the axis, the spindle's speed, masses and loads."""
        result = self.drawing.result
        governor = result.governor
        yield said("Balls: m = {0} kg on the links {1}, about the axis {2}", digits(result.mass),
                   ", ".join(governor.balls), "".join(governor.axis))
        if governor.speed is not None:
            yield said("Speed of the spindle: {0} {1}", digits(result.spindle_speed), unit("rad/s"))
        yield from topic_texts(machine_facts(result.scene))
        yield said("C in each position by Zhukovsky's lever: its power and those of all loads sum up to zero")

    def found_words(self, check: Mapping[str, float]) -> Iterator[Words]:
        """Speeds, irregularity, stability, the positions of equilibrium and a table of all positions."""
        result, rate = self.drawing.result, unit("rad/s")
        speed = digits(result.spindle_speed)
        yield arrange("omega_min = {0} {2}, omega_max = {1} {2}", *map(digits, result.extremes), rate)
        yield said("Mean speed: {0} {1}", digits(result.mean), rate)
        yield said("Degree of irregularity: delta = {0}", digits(result.irregularity))
        if result.is_isochronous:
            yield said("Isochronous: one speed holds all positions")
        elif not result.unstable_stretches:
            yield said("Stable: C/r grows with r over the whole range")
        for ends in result.unstable_stretches:
            yield said("Unstable from {0} to {1}: C/r does not grow with r", *map(self._travel, ends))
        if not (result.equilibria or result.is_isochronous):
            yield said("At {0} {1} it stands in no position of its range", speed, rate)
        for states, stable in result.equilibria:
            yield said("At {0} {1} it stands at r = {2}: {3}", speed, rate, self._length(states.r[0]),
                       said("stable") if stable else said("unstable"))
        for r in self.drawing.r:
            yield said("Drawn: r = {0}", self._length(r))
        if result.friction:
            yield from self._friction_words()
        yield check_words(check)
        drawn = TableColumn("drawn", said("drawn"), "", self.drawing.omega)
        yield quantity_table([*columns(result, result.drawn_states), drawn], 1)
        if result.friction:
            yield quantity_table(friction_columns(result), 1)

    def _friction_words(self) -> Iterator[Words]:
        """The degree of insensitivity, the irregularity with it, and where friction holds the governor."""
        result, rate = self.drawing.result, unit("rad/s")
        nu, middle = result.insensitivity, result.drawn_middle
        yield said("Degree of insensitivity: nu = {0} to {1}", *map(digits, (float(nu.min()), float(nu.max()))))
        yield said("Degree of irregularity with friction: epsilon = {0}", digits(result.irregularity_with_friction))
        for start, end in result.held_stretches:
            yield said("At {0} {1} friction holds it from r = {2} to {3}", digits(result.spindle_speed), rate,
                       self._length(start.r[0]), self._length(end.r[0]))
        outwards, inwards = map(float, self.drawing.band)
        nu_drawn = (outwards - inwards) / float(self.drawing.omega[middle])
        yield said("Drawn in position {0}: nu = {1}", middle + 1, digits(nu_drawn))

    def _length(self, metres: float) -> Said:
        """A length with its unit."""
        result = self.drawing.result
        return join((digits(float(metres) / result.reduction.motion.metres), unit(result.scene.units.length)), " ")

    def _travel(self, travel: float) -> Said:
        """A travel with its unit, degrees without a gap."""
        motion, length = self.drawing.result.reduction.motion, self.drawing.result.scene.units.length
        told = digits(float(motion.in_scene_units(travel)))
        return join((told, unit("°")), "") if motion.turns else join((told, unit(length)), " ")
