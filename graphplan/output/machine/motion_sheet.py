"""The sheet of a motion: moments, energy, energy-mass diagram, speed, its reciprocal and time on one panel; beside them
what is given and found, and the construction in words.

Source: Ozols 1974, 13-6 with figs. 13-9 and 13-10.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from graphplan.errors import Refused
from graphplan.kernel.drawing import Drawing, PlanScale, Values
from graphplan.kernel.program import Panel
from graphplan.machine.motion.drawing import MOTION, MotionDrawing, drawn
from graphplan.machine.motion.runs import Run
from graphplan.mechanism.model import Scene
from graphplan.output.graphs import Figures
from graphplan.output.machine.given_words import masses_and_loads
from graphplan.output.machine.motion_figure import MotionFigure, room_in
from graphplan.output.machine.motion_numbers import units
from graphplan.output.panelled import Panelled, Words, pages
from graphplan.phrases import Said, arranged, digits, said, unit
from graphplan.sheet.plates.display import Item, Rect, Sheet

PAPERS = "A3", "A2"


def sheets(found: Run, strips: int, paper: str | None = None) -> list[Sheet]:
    """The sheet of a motion on the paper named, or on the smallest on which its words have room."""
    return pages(lambda name: MotionSheet(name, found, strips), paper, PAPERS)


@dataclass(frozen=True)
class MotionSheet(Panelled):
    """One motion on one paper."""

    found_run: Run
    strips: int
    letters_of = "phi", "omega", "epsilon", "psi", "k_E", "k_I", "k_ω"

    @property
    def document(self) -> Said:
        return said("Motion sheet")

    @property
    def scene(self) -> Scene:
        return self.found_run.scene

    @property
    def told(self) -> Said:
        return said("The true motion of a machine in {0} strips.", self.strips)

    @property
    def scale(self) -> Said:
        return said("as told")

    def divided(self, room: Rect) -> dict[Panel, Rect]:
        """One panel with all diagrams."""
        return {MOTION: room}

    @cached_property
    def drawing(self) -> MotionDrawing:
        """The diagrams, as large as they have room."""
        found = drawn(self.found_run.motion, self.strips, room_in(self.room(MOTION)))
        if found is None:
            raise Refused("the sheet", "the machine stops within the first strips",
                          "a shorter travel (--travel), or more strips (--positions)")
        return found

    @property
    def values(self) -> Values:
        return Values(Drawing(self.drawing.program, plans={MOTION: PlanScale(on_paper=True)}), self.drawing.values)

    def figure(self, panel: Panel, rect: Rect) -> list[Item]:
        """The diagrams."""
        return MotionFigure(self.found_run, self.drawing, Figures(self.letters, self.tongue), rect).items()

    # ---- words -----------------------------------------------------------------------------------------------------

    def given(self) -> Iterator[Words]:
        """The speed at the beginning, the flywheel and what closes the cycle, masses and loads."""
        run, measures = self.found_run, units(self.found_run)
        first = float(run.motion.at([run.motion.start]).omega[0]) / run.machine.pace
        yield said("At the beginning: {0} {1}", digits(first), unit(measures["omega"]))
        if run.machine.wheel:
            yield said("Flywheel: {0} {1}", digits(run.machine.wheel), self._unit("inertia"))
        if run.machine.closing:
            yield said("Closing moment: {0} {1}", digits(run.machine.closing), self._unit("moment"))
        yield from masses_and_loads(self.scene)

    def _unit(self, what: str) -> Said:
        return unit(units(self.found_run)[what].replace("*", " ").replace("^2", "²").replace("deg", "°"))

    def found(self) -> Iterator[Words]:
        """Where it stops, its speeds and their means, the run-up, and the divisions as a table."""
        run, motion, machine = self.found_run, self.found_run.motion, self.found_run.machine
        rate = self._unit("omega")
        if motion.stop is not None:
            at = digits(motion.stop.travel / machine.degree), self._unit("travel")
            known = math.isfinite(motion.stop.time)
            yield (said("It stops at {0} {1}, after {2} s", *at, digits(motion.stop.time)) if known
                   else said("It comes to rest at {0} {1}, for ever nearing it", *at))
        for words, place in zip((said("Least speed"), said("Largest speed")), motion.extremes, strict=True):
            yield said("{0}: {1} {2} at {3} {4}", words, digits(place.omega / machine.pace), rate,
                       digits(place.travel / machine.degree), self._unit("travel"))
        if run.nominal is not None:
            yield said("Nominal speed: {0} {1}", digits(run.nominal / machine.pace), rate)
        if run.run_up is not None:
            yield said("Run up in {0} turns, {1} s", digits(run.run_up.turns), digits(run.run_up.place.time))
        errors = self.drawing.errors
        yield said("The drawing is off by {0} % in the speed, {1} % in the time",
                   *(digits(round(100 * errors[what], 4)) for what in ("omega", "time")))
        yield self._table()

    def _table(self) -> list[list[Said | str]]:
        """A row for each division: true values, and what is drawn."""
        drawing, machine, motion = self.drawing, self.found_run.machine, self.found_run.motion
        true = motion.at(drawing.travel)
        columns = (drawing.travel / machine.degree, true.omega / machine.pace, drawing.read("omega") / machine.pace,
                   true.time, drawing.read("time"), true.acceleration / machine.pace)
        slides = self.scene.drives[0].slides
        letters, names = ("s", "v", "a") if slides else ("phi", "omega", "epsilon"), ("travel", "omega", "acceleration")
        travel, rate, change = (arranged("{0}, {1}", letter, self._unit(what))
                                for letter, what in zip(letters, names, strict=True))
        head = ["", travel, rate, said("drawn"), arranged("{0}, {1}", "t", unit("s")), said("drawn"), change]
        return [head, *([str(k), *("" if math.isnan(x) else digits(float(x)) for x in row)]
                        for k, row in enumerate(zip(*columns, strict=True)))]
