"""Zhukovsky's levers over the cycle: the given pose large with its steps, the others small beside it.

Source: Ozols 1974, 13-6.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from graphplan.cycle.turn import Turn
from graphplan.kernel.program import Panel
from graphplan.machines.reduced.check import check_lever
from graphplan.machines.reduced.reduced_loads import UnitMotion, moving_points
from graphplan.machines.reduced.reduction import Reduction
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.output.graphs import Figures
from graphplan.phrases import Said, join, said
from graphplan.sheet.handout import starting_items
from graphplan.sheet.layout.paper import windows
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import LetterSizes
from graphplan.sheet.lettering.letters import letter_plate
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.traced_motion import PointPath, TracedMotion
from graphplan.sheet.plates.view import View, fit_scale, view
from graphplan.words.tongue import Tongue

LEVERS = Panel("levers", said("levers"), said("Orthogonal velocities in the other positions"))
RAY, IMAGE = Pen(0.18, pens.BLUE), Pen(0.25)
FIGURE_MARGIN_MM, NUMBER = 1.0, 1.4  # mm about a small figure; of the height of letters, for its number
# mm: the radius of a pole; small figures, and faint positions of the mechanism
POLE_RADIUS_MM, MAX_SMALL_FIGURES = 0.4, 36


@dataclass(frozen=True)
class LeverFigures:
    """The lever of a reduction in the given pose, and the velocities at `count` positions of its cycle."""

    reduction: Reduction
    count: int
    tongue: Tongue
    letters: LetterSizes

    @property
    def travel(self) -> Any:
        """The travels of the positions, from the given pose: shape (count,)."""
        first, last = self.reduction.ends
        return first + (last - first) * np.arange(self.count) / self.count

    @cached_property
    def turn(self) -> Turn:
        """Where everything is at the positions."""
        return self.reduction.motion.turn(self.travel)

    @cached_property
    def drawing(self) -> Construction:
        """The lever of the given pose, step by step, compared with the reduced moment."""
        return check_lever(self.reduction, float(self.travel[0]))[0]

    @cached_property
    def plans(self) -> Plans:
        """The plans of the given pose; on that of the mechanism are its other positions, and the paths of points."""
        places = {name: [(float(z.real), float(z.imag)) for z in np.atleast_1d(zs) + 0j]
                  for name, zs in self.turn.points.items()}
        positions = tuple({name: spots[k % len(spots)] for name, spots in places.items()}
                          for k in range(0, self.count, 1 + self.count // MAX_SMALL_FIGURES))
        moving = [name for name in self.reduction.motion.scene.find.velocity if name in places]
        paths = tuple(PointPath(name, (*places[name], places[name][0]), (False, False)) for name in moving)
        return Plans(self.drawing, self.tongue, motion=TracedMotion(paths, positions))

    def plates(self, rooms: Mapping[str, Rect]) -> tuple[Scales, Plates]:
        """The scales and the plans of the given pose in these rooms."""
        scales, views = windows(rooms, self.plans)
        return scales, Plates(self.plans, views, self.letters)

    def heading(self, panel: Panel, scales: Scales) -> tuple[Said, Said]:
        """What a plan of the given pose shows, and its scales."""
        shown = self.plans.kinds(panel)
        return panel.caption(shown), join(scales.scale_texts(panel, shown), ",  ")

    def picture(self, plates: Plates, panel: Panel) -> list[Item]:
        """A plan of the given pose with its letters."""
        return letter_plate(plates[panel]).items

    def given_items(self, plates: Plates, panel: Panel) -> list[Item]:
        """What of a plan is given: the mechanism with its loads in its positions, or where it begins."""
        given = list(starting_items(plates[panel]))
        return [*given, *plates[panel].positions(given)]

    # ---- the other positions ---------------------------------------------------------------------------------------

    @property
    def _points(self) -> tuple[str, ...]:
        """The points of moving links that are no fixed ones."""
        scene = self.reduction.scene
        return moving_points(scene, (name for link in scene.moving for name in scene.links[link]))

    @cached_property
    def _ends(self) -> dict[str, Any]:
        """The ends of the orthogonal velocities, by points: complex arrays of shape (count,), for a unit rate."""
        own = self.reduction.motion
        motion = UnitMotion(self.reduction.scene, own.motion, replace(own.scene.find, velocity=self._points))
        rates = motion.velocities(self.turn)
        return {name: 1j * own.sense * (rates.rate(kinds.VELOCITY, name) + np.zeros(self.count))
                for name in self._points}

    @property
    def _images(self) -> list[list[str]]:
        """The points of each link that has several of them."""
        links = self.reduction.scene.links
        found = [[name for name in links[link] if name in self._ends] for link in self.reduction.scene.moving]
        return [names for names in found if len(names) > 1]

    def small(self, rect: Rect, drawn: bool = True) -> Iterator[Item]:
        """The orthogonal velocities of the other positions, or some of them, each beside its number, at one scale; or
        where these are not `drawn` their poles alone."""
        shown = range(1, self.count, 1 + self.count // MAX_SMALL_FIGURES)
        cells, number = _grid(rect, len(shown)), NUMBER * self.letters.text
        rooms = [cell.inset(FIGURE_MARGIN_MM, FIGURE_MARGIN_MM, FIGURE_MARGIN_MM, FIGURE_MARGIN_MM + number)
                 for cell in cells]
        boxes = [bounding_box([(0.0, 0.0), *self._spots(k)]) for k in shown]
        scale = max(map(fit_scale, boxes, rooms)) or 1.0
        paper = Figures(self.letters, self.tongue)
        for k, cell, room, box in zip(shown, cells, rooms, boxes, strict=True):
            yield paper.text((cell.left + FIGURE_MARGIN_MM, cell.top - number), str(k))
            window = view(box, room, scale)
            yield from self._plan(k, window) if drawn else ()
            yield Circle(pens.ORIGIN, "links", None, window((0.0, 0.0)), POLE_RADIUS_MM)

    def _spots(self, k: int) -> list[Spot]:
        """The ends of the velocities of a position."""
        return [(float(z[k].real), float(z[k].imag)) for z in self._ends.values()]

    def _plan(self, k: int, window: View) -> Iterator[Item]:
        """The velocities of a position: rays from the pole, and the links' images."""
        ends = dict(zip(self._ends, map(window, self._spots(k)), strict=True))
        pole = window((0.0, 0.0))
        for end in ends.values():
            if math.dist(pole, end) > FIGURE_MARGIN_MM / 4:
                yield Polyline(RAY, "links", None, (pole, end))
        for names in self._images:
            yield Polyline(IMAGE, "links", None, tuple(ends[name] for name in names))


def _grid(rect: Rect, count: int) -> list[Rect]:
    """A rectangle in so many cells as square as can be, row by row from the upper left."""
    columns = max(range(1, count + 1), key=lambda n: min(rect.width / n, rect.height / math.ceil(count / n)))
    rows = math.ceil(count / columns)
    wide, high = rect.width / columns, rect.height / rows
    return [Rect(rect.left + k % columns * wide, rect.top - (k // columns + 1) * high,
                 rect.left + (k % columns + 1) * wide, rect.top - k // columns * high) for k in range(count)]
