"""The diagrams of a motion on their panel: what the drawing's steps draw, the true curves over it, axes and scales.

They lie as on the drawing board: under each other over one axis of travel, the energy-mass diagram beside the energies
that are carried across, under the inertias that are carried down.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.kernel.drawing import Drawing, Values
from graphplan.kernel.kinds import CIRCLE, LINE
from graphplan.kernel.program import Step
from graphplan.machine.motion.drawing import MOTION, MotionDrawing
from graphplan.machine.motion.room import POLE, Room
from graphplan.machine.motion.runs import Run
from graphplan.output.graphs import AXIS, FOOT, HEADED, Figures, Graph
from graphplan.output.step_ink import StepInk
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.view import View, clip_item

FINE, CHORD = Pen(0.13, "#a8a8a8"), Pen(0.25, pens.VIOLET)
CURVES = {"moment": Pen(0.5), "energy": Pen(0.5, pens.BLUE), "inertia": Pen(0.5, pens.RED),
          "energy-mass": Pen(0.5, pens.VIOLET), "omega": Pen(0.5, pens.GREEN), "slowness": Pen(0.35, pens.GREEN),
          "time": Pen(0.5, pens.RED)}
PLACES = 240  # at which a curve is known
TOLD = 10  # divisions at most whose numbers stand at a curve
OVER, RIGHT = 7.0, 4.0  # mm over the diagrams for a scale, and right of them


def room_in(rect: Rect) -> Room:
    """How large the diagrams may be in a panel."""
    return Room(rect.width - RIGHT, rect.height - OVER - FOOT - HEADED)


@dataclass(frozen=True)
class MotionFigure:
    """The diagrams of a run in their panel."""

    found: Run
    drawing: MotionDrawing
    paper: Figures
    rect: Rect

    @cached_property
    def window(self) -> View:
        """From the drawing's mm to those of the sheet, as large, the pole at the left and the moments at the top."""
        return View(self.rect, 1.0, (self.rect.left + POLE, self.rect.top - OVER))

    @cached_property
    def graphs(self) -> dict[str, Graph]:
        """The diagrams by name; travel is in degrees, or in lengths."""
        machine, found = self.found.machine, dict[str, Graph]()
        for name, frame in self.drawing.frames.items():
            graph = Graph.framed(frame, self.window)
            across = 1.0 if name in ("inertia", "energy-mass") else machine.degree
            up = {"inertia": machine.degree, "omega": machine.pace, "slowness": 1 / machine.pace}.get(name, 1.0)
            found[name] = replace(graph, k_x=graph.k_x / across, k_y=graph.k_y / up)
        return found

    def items(self) -> list[Item]:
        """All of it, its letters off its lines."""
        return self.ink.lettered(MOTION, [*self._curves(), *self._axes()], self._wishes(), self._named)

    @cached_property
    def ink(self) -> StepInk:
        """What the steps draw: fine lines, chords by themselves."""
        drawing, steps = self.drawing, self.drawing.program.steps
        fine = {step.index: FINE for step in steps if step.op.gives in (LINE, CIRCLE)}
        chords = {steps[Q].args[1]: CHORD for name in ("energy", "time") for Q in drawing.marks[name]
                  if len(steps[Q].args) == 2}
        return StepInk(Values(Drawing(drawing.program), drawing.values), {MOTION: self.window}, self.paper.letters,
                       pens={**fine, **chords}, beyond=dict.fromkeys(chords, 0.0))

    def _curves(self) -> Iterator[Item]:
        """The true curves."""
        motion, machine = self.found.motion, self.found.machine
        travel = np.linspace(motion.start, motion.last, PLACES + 1)
        state, told = motion.at(travel), (travel - motion.start) / machine.degree
        with np.errstate(divide="ignore"):
            slowness = machine.pace / state.omega
        rows = {"energy": state.energy, "omega": state.omega / machine.pace, "slowness": slowness, "time": state.time,
                "moment": machine.moment(travel, state.omega)}
        for name, values in rows.items():
            yield from self._curve(name, told, values)
        inertia = machine.inertia(travel)
        yield from self._curve("inertia", inertia, told)
        yield from self._curve("energy-mass", inertia, state.energy)

    def _curve(self, name: str, xs: Any, ys: Any) -> Iterator[Item]:
        graph = self.graphs[name]
        known = np.isfinite(xs) & np.isfinite(ys)
        line = Polyline(CURVES[name], "links", None, tuple(graph.spots(xs[known], ys[known])))
        yield from clip_item(line, Rect(graph.rect.left, graph.rect.bottom, graph.rect.right, graph.rect.top + 2.0))

    # ---- axes and letters ------------------------------------------------------------------------------------------

    @property
    def _measures(self) -> dict[str, tuple[str, str]]:
        """Letters and units of what the diagrams show: of a drive that slides it is forces and masses."""
        if not self.found.scene.drives[0].slides:
            return {"moment": ("M", "N m"), "energy": ("E", "J"), "inertia": ("I", "kg m²"), "time": ("t", "s"),
                    "omega": ("omega", "rad/s"), "slowness": ("1/omega", "s/rad"), "travel": ("phi", "°")}
        length = self.found.scene.units.length
        return {"moment": ("F", "N"), "energy": ("E", "J"), "inertia": ("m", "kg"), "omega": ("v", f"{length}/s"),
                "slowness": ("1/v", f"s/{length}"), "time": ("t", "s"), "travel": ("s", length)}

    def _told(self, what: str, k: float, at: Spot, anchor: str = "start") -> Item:
        """Letter, unit and scale of a quantity."""
        letter, measure = self._measures[what]
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
            yield self._told(name, graph.k_y, (graph.rect.left + 2.0, graph.rect.top + HEADED / 2))
        low = graphs["time"]
        yield from paper.numbered_x(low, turns=turns)
        yield self._told("travel", low.k_x, (low.rect.right, low.rect.bottom - FOOT - 1.0), "end")
        mass, inertia = graphs["energy-mass"], graphs["inertia"]
        yield from paper.ordinate(mass, head=True)
        yield from paper.abscissa(mass)
        yield from paper.numbered_x(mass)
        corner = inertia.rect.left, inertia.rect.top
        for end in ((inertia.rect.right, corner[1]), (corner[0], inertia.rect.bottom)):
            yield Polyline(AXIS, "ruling", None, (corner, end))
        yield self._told("inertia", inertia.k_x, (inertia.rect.left, inertia.rect.top + HEADED / 2))

    def _named(self, step: Step) -> bool:
        """Whether a step's letter stands on the sheet: those of the divisions stand as numbers at the curve alone."""
        return "_" not in step.name

    def _wishes(self) -> Iterator[Wish]:
        """The numbers of some divisions along the energy-mass curve and the curve of speeds."""
        marks, count = self.drawing.marks, len(self.drawing.travel)
        for what in ("energy-mass", "omega"):
            first, every = count - len(marks[what]), -(-count // TOLD)
            for k, step in enumerate(marks[what], first):
                if k % every:
                    continue
                spot = self.window(self.drawing.values[step])
                yield Wish(sentence_runs(str(k)), (spot,), 0.5, minor=True, pen=pens.FAINT, label=f"{what} {k}")
