"""The sheet of a governor: its characteristic C over r with the rays of its positions and of the spindle's speed;
beside it what is given and found, the construction in words, and all of it as numbers.

Source: Ozols 1974, 15-5 with figs. 15-14 to 15-16.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel
from graphplan.machines.governor.governor import (
    GOVERNOR,
    GovernorDrawing,
    GovernorResult,
    GovernorStates,
    draw_governor,
)
from graphplan.mechanism.model import Scene
from graphplan.output.graphs import CURVES, FOOT, HEADED, LEFT, ON, Figures, Graph
from graphplan.output.panelled import Panelled, Words, check_words
from graphplan.output.tables import TableColumn, column_csv, plain_unit
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.lettering.letters import items_with_names
from graphplan.sheet.plates.display import Item, Rect
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
    """What friction adds: C in both senses, the irregularity with it, and the stretches in which it holds the governor.
    """
    if not result.friction:
        return {}
    outwards, inwards = result.drawn_band
    return {"C_out": outwards.tolist(), "C_in": inwards.tolist(),
            "irregularity_with_friction": result.irregularity_with_friction,
            "held": [[{row.name: float(row.values[0]) for row in columns(result, states)} for states in ends]
                     for ends in result.held_stretches]}


def _drawn_friction(drawing: GovernorDrawing) -> dict[str, Any]:
    """What of it is drawn."""
    if not drawing.result.friction:
        return {}
    return {"position": drawing.result.drawn_middle + 1, "omega_out_in": drawing.band.tolist(),
            "held": (drawing.held_between / drawing.result.reduction.motion.metres).tolist()}


def _table_rows(of: list[TableColumn]) -> list[list[Said | str]]:
    """Columns as the rows of a table on paper, numbered."""
    head = ["", *(arrange("{0}, {1}", row.letter, unit(row.unit)) if row.unit else arrange("{0}", row.letter)
                  for row in of)]
    lines = zip(*(row.values for row in of), strict=True)
    return [head, *([str(k), *(digits(float(x)) for x in line)] for k, line in enumerate(lines, 1))]


# ---- the sheet ------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class GovernorSheet(Panelled):
    """One governor on one paper."""

    result: GovernorResult
    check: Mapping[str, float]
    letters_of = ("omega", "psi", "delta", "nu", "epsilon", "omega''", "omega'", "omega_max", "omega_min", "k_r", "k_C",
                  "phi")

    @property
    def document(self) -> Said:
        return said("Governor sheet")

    @property
    def scene(self) -> Scene:
        return self.result.scene

    @property
    def description(self) -> Said:
        return said("The characteristic of a governor in {0} positions.", self.result.positions)

    @property
    def scale(self) -> Said:
        return said("as stated")

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        """One panel with the diagram."""
        return {GOVERNOR: room}

    @property
    def diagram(self) -> Rect:
        """The room of the diagram between its numbers."""
        return self.room(GOVERNOR).inset(LEFT, 2 * FOOT, 2 * ON, HEADED)

    @cached_property
    def drawing(self) -> GovernorDrawing:
        """The diagram, as large as it has room."""
        return draw_governor(self.result, self.diagram.width, self.diagram.height)

    @property
    def values(self) -> Values:
        return self.drawing.values

    def figure(self, panel: Panel, rect: Rect) -> list[Item]:
        """The diagram, its letters off its lines."""
        window = View(rect, 1.0, (self.diagram.left, self.diagram.bottom))
        ink = plate_of_values(self.values, GOVERNOR, window, self.scene, self.letters,
                              pens={self.values.drawing.roles["speed"][1]: CURVES[2]})
        return items_with_names(ink, [*self._curve(Graph.from_frame(self.drawing.frame, window))], (),
                                lambda mark: True)

    def _curve(self, graph: Graph) -> Iterator[Item]:
        """The characteristic and its axes; r is in lengths of the scene."""
        paper, metre = Figures(self.letters, self.tongue), self.result.reduction.motion.metres
        graph = graph._replace(x=graph.x.in_units(metre))
        curve = self.result.curve
        yield from graph.curve(curve.r / metre, curve.C, CURVES[1])
        for C in self.result.curve_band if self.result.friction else ():
            yield from graph.curve(curve.r / metre, C, CURVES[3])
        yield from paper.axes(graph, "", "")
        convention = self.scene.sheet.convention
        yield paper.quantity((graph.rect.left + 2.0, graph.rect.top + HEADED / 2), "C", "N", graph.y.unit, convention)
        yield paper.quantity((graph.rect.right, graph.rect.bottom - FOOT - 1.0), "r", self.scene.units.length,
                             graph.x.unit, convention, "end")

    # ---- words -----------------------------------------------------------------------------------------------------

    def given_words(self) -> Iterator[Words]:
        """The balls, the axis, the spindle's speed, masses and loads."""
        governor = self.result.governor
        yield said("Balls: m = {0} kg on the links {1}, about the axis {2}", digits(self.result.mass),
                   ", ".join(governor.balls), "".join(governor.axis))
        if governor.speed is not None:
            yield said("Speed of the spindle: {0} {1}", digits(self.result.spindle_speed), unit("rad/s"))
        yield from topic_texts(machine_facts(self.scene))
        yield said("C in each position by Zhukovsky's lever: its power and those of all loads sum up to zero")

    def result_words(self) -> Iterator[Words]:
        """Speeds, irregularity, stability, the positions of equilibrium and a table of all positions."""
        result, rate = self.result, unit("rad/s")
        yield arrange("omega_min = {0} {2}, omega_max = {1} {2}", *map(digits, result.extremes), rate)
        yield said("Mean speed: {0} {1}", digits(result.mean), rate)
        yield said("Degree of irregularity: delta = {0}", digits(result.irregularity))
        if result.is_isochronous:
            yield said("Isochronous: one speed holds all positions")
        elif not result.unstable_stretches:
            yield said("Stable: C/r grows with r over the whole range")
        for ends in result.unstable_stretches:
            yield said("Unstable from {0} to {1}: C/r does not grow with r", *map(self.travel_words, ends))
        if not (result.equilibria or result.is_isochronous):
            yield said("At {0} {1} it stands in no position of its range", digits(result.spindle_speed), rate)
        for states, stable in result.equilibria:
            yield said("At {0} {1} it stands at r = {2}: {3}", digits(result.spindle_speed), rate,
                       self._length(states.r[0]), said("stable") if stable else said("unstable"))
        for r in self.drawing.r:
            yield said("Drawn: r = {0}", self._length(r))
        if result.friction:
            yield from self._friction_words()
        yield check_words(self.check)
        drawn = TableColumn("drawn", said("drawn"), "", self.drawing.omega)
        yield _table_rows([*columns(result, result.drawn_states), drawn])
        if result.friction:
            yield _table_rows(friction_columns(result))

    def _friction_words(self) -> Iterator[Words]:
        """The degree of insensitivity, the irregularity with it, and where friction holds the governor."""
        result, rate = self.result, unit("rad/s")
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
        return join((digits(float(metres) / self.result.reduction.motion.metres), unit(self.scene.units.length)), " ")

    def travel_words(self, travel: float) -> Said:
        """A travel with its unit, degrees without a gap."""
        motion = self.result.reduction.motion
        return join((digits(float(motion.in_scene_units(travel))), unit("°" if motion.turns else
                                                                        self.scene.units.length)),
                    "" if motion.turns else " ")
