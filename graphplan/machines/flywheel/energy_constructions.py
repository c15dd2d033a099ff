"""The flywheel by the moment's diagram and energies alone: by Gutjahr's two curves, or by the vectors of areas.

Gutjahr draws E - (I - I') omega^2/2 twice, with the largest speed and with the least: the highest point of the one and
the lowest of the other are delta omega^2 (I_s + I') apart. The vectors of areas take the inertia as constant: areas
between the nodes of the moment, laid off one after the other, have their outermost levels delta omega^2 I_s apart.

Source: Ozols 1974, 15-2, figs. 15-4 and 15-5, (15.17) to (15.20).
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import accumulate

import numpy as np

from graphplan.kernel.numbers.arrays import Reals
from graphplan.kernel.program import Mark
from graphplan.machines.flywheel.diagram_layout import DiagramSizes, FlywheelLayout, lay_out_energies
from graphplan.machines.flywheel.drawing import FlywheelDrawing, FlywheelRecorder
from graphplan.machines.flywheel.result import FlywheelResult, areas
from graphplan.machines.flywheel.steady_cycle import Tangency
from graphplan.phrases import Said, said

GUTJAHR, AREAS = "gutjahr", "areas"
MAX_STEP_MM = 12.0  # mm from one vector of an area to the next


class GutjahrRecorder(FlywheelRecorder):
    """Draws one flywheel by Gutjahr's curves."""

    def _layout(self, room: DiagramSizes) -> FlywheelLayout:
        self.least = float(self.plans.inertias.min())
        curves = [self.heights(touch) for touch in (self.wheel.upper, self.wheel.lower)]
        return lay_out_energies(self.cycle, self.plans, np.array([*self.plans.energies, *curves[0], *curves[1]]),
                                self.least, room)

    def heights(self, touch: Tangency) -> Reals:
        """E - (I - I') omega^2/2 at the plans, in J."""
        return self.plans.energies - (self.plans.inertias - self.least) * touch.slope

    def draw_given(self) -> None:
        self._draw_moments()

    def _stages(self) -> list[tuple[Said, Said, Callable[[], None]]]:
        return [
            *super()._stages()[:2],
            (said("Gutjahr's curves"), said("Phi = E − (I − I')·omega²/2, with the largest speed and with the least"),
             self._curves),
            (said("Levels"), said("the highest level of the one curve and the lowest of the other are "
                                  "delta·omega²·(I_s + I') apart"), self._levels)]

    def _curves(self) -> None:
        """The points of both curves under those of the energy."""
        board, unit = self.board, self.frames["energy"].y.unit
        self.curves: dict[str, list[Mark]] = {}
        for role, letter, touch, why in (
                ("fast", "F", self.wheel.upper, said("the energy at the largest speed is left out")),
                ("slow", "S", self.wheel.lower, said("the energy at the least speed is left out"))):
            drops = (self.plans.inertias - self.least) * touch.slope / unit
            self.curves[role] = [board.lay_off(E, dx=0, dy=-float(drop), name=f"{letter}_{k}", why=why) if drop else E
                                 for k, E, drop in zip(self.numbers, self.energies, drops, strict=True)]
        self.marks |= self.curves

    def _levels(self) -> None:
        """The highest level of the one, the lowest of the other, and where they cut the axis."""
        self.axis = self.upright
        self.marks["axis"] = [self.axis]
        for role, line, letter, touch in (("fast", "upper", "m", self.wheel.upper),
                                          ("slow", "lower", "n", self.wheel.lower)):
            cut, apex = self._extreme(self.curves[role], touch, letter)
            self.marks |= {line: [self.board.parallel(self.level, cut)], letter: [cut], f"{line} apex": [apex]}

    def _extreme(self, curve: list[Mark], touch: Tangency, letter: str) -> tuple[Mark, Mark]:
        """Intersection of the level of a curve's vertex with the axis, and the vertex of a parabola through three
        neighbours."""
        k, three = self._neighbours(touch.slope, above=letter == "m")
        if len(three) == 1:
            return self.board.meet(self.axis, self.board.parallel(self.level, curve[k]), name=letter), curve[k]
        A, B, C = (curve[j] if j < len(curve) else self.board.transfer(
            self.energies[0], self.energies[-1], curve[j - len(curve) + 1],
            why=said("the cycle goes on as it began")) for j in three)
        first, middle, last = self.plans.travels_around(self.told, three)
        return self._vertex(A, B, C, float((middle - first) / (last - first)), letter)


class AreasRecorder(FlywheelRecorder):
    """Draws one flywheel by the vectors of areas."""

    strip_error = 0.0  # areas are taken with the planimeter

    def _layout(self, room: DiagramSizes) -> FlywheelLayout:
        self.works = [area.work for area in areas(self.cycle)]
        levels = np.array([0.0, *accumulate(self.works), *(() if self.works else (1.0,))])
        return lay_out_energies(self.cycle, self.plans, levels, 0.0, room)

    def draw_given(self) -> None:
        self._draw_moments()

    def _stages(self) -> list[tuple[Said, Said, Callable[[], None]]]:
        return [super()._stages()[0],
                (said("Vectors of areas"), said("upwards where energy is stored, each from the level of the last"),
                 self._vectors)]

    def _vectors(self) -> None:
        """The areas one after the other, and the outermost of their levels."""
        board, frame = self.board, self.frames["energy"]
        self.marks["ray origin"] = self.marks["mean"]  # nothing is integrated: no pole is drawn
        step = min(MAX_STEP_MM, frame.level[1] / (len(self.works) + 1))
        ends = [board.lay_off(self.rates.origin, dx=0, dy=frame.origin[1], name="W_0")]
        starts: list[Mark] = []
        for k, work in enumerate(self.works, 1):
            starts.append(board.lay_off(ends[-1], dx=step, dy=0))
            ends.append(board.lay_off(starts[-1], dx=0, dy=work / frame.y.unit, name=f"W_{k}",
                                      why=said("the area between two nodes, as the planimeter has it")))
        levels = [0.0, *accumulate(self.works)]
        self.marks |= {"starts": starts, "ends": ends, "axis": [self.upright]}
        for line, letter, k in (("upper", "m", int(np.argmax(levels))), ("lower", "n", int(np.argmin(levels)))):
            level = board.parallel(self.level, ends[k])
            self.marks |= {line: [level], letter: [board.meet(self.upright, level, name=letter)],
                           f"{line} apex": [ends[k]]}


RECORDERS: dict[str, type[FlywheelRecorder]] = {GUTJAHR: GutjahrRecorder, AREAS: AreasRecorder}


def draw_by(construction: str, result: FlywheelResult, room: DiagramSizes | None = None) -> FlywheelDrawing:
    """The drawing of a flywheel by one of these constructions."""
    recorder = RECORDERS[construction](result.cycle, result.wheel, result.positions, room or DiagramSizes())
    return recorder.drawing
