"""What balances a rotor, as it is drawn: the polygons of moments and forces, and the plans of trials."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from graphplan.machine.rotors.trial import ThreeRuns, TrialWeights
from graphplan.machine.rotors.trial_runs import Effect, angle_of, harmonic
from graphplan.output.graphs import CURVES, Graph, stacked
from graphplan.output.machine.rotor_views import CORRECTIONS, DIMENSION, MASS, OTHER, RotorViews
from graphplan.output.tolerances import HARMONIC_TOL, MIN_WEIGHT, RANGE_TOL
from graphplan.phrases import Said, arranged, digits, unit
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.view import View, fit_scale, view

HEAD, LETTERED, SEEN = 3.5, 3.0, 0.1  # mm: heads of vectors; a side with letters, and one that is drawn, is longer
AROUND = 8.0  # mm about a figure, for its letters
MANY = 8  # corners of a polygon that bear letters at most
ALONG = 0.5, 0.4, 0.6, 0.3, 0.7  # of a side: its letters stand beside one of these
Side = tuple[complex, complex, str, Pen, int | None]  # from where to where, what it is, its pen and step


@dataclass(frozen=True)
class RotorFigures(RotorViews):
    """The views of one rotor, and what balances it."""

    def window(self, rect: Rect, points: Sequence[complex]) -> View:
        """Marks in the middle of a panel, at a round scale."""
        box = bounding_box([(z.real, z.imag) for z in points])
        room = rect.inset(AROUND, AROUND, AROUND, AROUND)
        return view(box, room, float(round_up(fit_scale(box, room) or 1.0)))

    def scaled(self, rect: Rect, words: Said) -> Item:
        """The scale of a plan, in the corner of its panel."""
        return self.text((rect.left, rect.bottom), words, names=("k_mra", "mu_mra", "k_mr", "mu_mr"))

    def sides(self, plan: View, sides: Sequence[Side], corners: Mapping[str, tuple[complex, int]],
              further: Sequence[Item] = (), named: Mapping[str, tuple[Spot, Spot]] | None = None) -> Iterator[Item]:
        """Vectors with what they are, and the letters of corners, and of `further` lines those that are `named`."""
        items, wishes = [*further], [self.wish(name, _along(*line)) for name, line in (named or {}).items()]
        for name, (z, step) in corners.items():
            items.append(Circle(pens.DOT, "plates", step, plan((z.real, z.imag)), 0.5))
            wishes.append(self.wish(name, (plan((z.real, z.imag)),), 0.9, step))
        for start, end, name, pen, side_step in sides:
            foot, tip = plan((start.real, start.imag)), plan((end.real, end.imag))
            long = math.dist(foot, tip)
            if long >= SEEN:
                items.append(Arrow(pen, "links", side_step, foot, tip, min(HEAD, 0.6 * long)))
            if name and long >= LETTERED:
                wishes.append(self.wish(name, _along(foot, tip), 0.8, side_step))
        return self.lettered(items, wishes, plan.rect)

    # ---- polygons --------------------------------------------------------------------------------------------------

    def polygon(self, rect: Rect, letter: str, scale: Said) -> Iterator[Item]:
        """A polygon with what each side is, and the side that closes it."""
        drawing = self.found.drawing
        names = drawing.corners(letter)
        corners = [drawing.at(name) for name in names]
        written = "m_{0}·a_{0}·r_{0}" if letter == "M" else "m_{0}·r_{0}"
        drawn = zip(pairwise(corners), names[1:], strict=True)
        sides: list[Side] = [(*ends, written.format(name[2:]), CORRECTIONS[1] if name == "F_II" else MASS,
                              drawing.marks[name]) for ends, name in drawn]
        if abs(corners[0] - corners[-1]) > RANGE_TOL * max(map(abs, corners)):
            index, closing = (1, "m_II·a·r_II") if letter == "M" else (0, "m_I·r_I")
            ends = drawing.marks[names[-1]], drawing.marks[names[0]]
            step = next((step.index for step in drawing.program.steps if step.args == ends), None)
            sides.append((corners[-1], corners[0], closing, CORRECTIONS[index], step))
        shown = names if len(names) <= MANY else [names[0], names[-1]]
        lettered = {name: (drawing.at(name), drawing.marks[name]) for name in shown}
        yield from self.sides(self.window(rect, corners), sides, lettered)
        yield self.scaled(rect, scale)

    # ---- trials ----------------------------------------------------------------------------------------------------

    def trial_marks(self, index: int) -> dict[str, int]:
        """The steps of the marks of a trial, by their names in the first."""
        return {name.removeprefix(f"{index}:"): step for name, step in self.found.drawing.marks.items()
                if name.startswith(f"{index}:")}

    def trial(self, rect: Rect, index: int, scale: Said) -> Iterator[Item]:
        """The plan of a trial."""
        steps, effect = self.trial_marks(index), self.found.effects[index]
        z = {name: complex(*self.found.drawing.values[step]) for name, step in steps.items()}
        plan = self.window(rect, [*z.values()])
        if isinstance(effect.trial, TrialWeights):
            yield from self._weights(plan, z, steps)
        elif "D" in z and "G" in z:
            yield from self._triangle(plan, effect, z, steps)
        yield self.scaled(rect, scale)

    def _triangle(self, plan: View, effect: Effect, z: dict[str, complex], steps: dict[str, int]) -> Iterator[Item]:
        """Vibrations and their difference; of three runs the arcs and both answers."""
        spot = {name: plan((one.real, one.imag)) for name, one in z.items()}
        sides: list[Side] = [(z["C"], z["D"], "A_1", MASS, steps["D"]), (z["C"], z["G"], "A_2", MASS, steps["G"]),
                             (z["D"], z["G"], "A", CORRECTIONS[0], steps["G"])]
        thin = [(spot["D"], spot["E"]), (spot["E"], spot["G"])] if isinstance(effect.trial, ThreeRuns) else []
        further: list[Item] = [Polyline(pens.THIN, "links", steps["G"], line) for line in thin]
        for centre, end in (("C", "G"), ("C", "H"), ("E", "G"), ("E", "H")):
            if thin and end in z:
                further.append(self._arc(spot[centre], spot[end], steps[end]))
        if "H" in z and len(effect.turns) > 1:
            sides.append((z["D"], z["H"], "", OTHER, steps["H"]))
        further += self._turned(plan, z)
        corners = {name if name != "H" else "G'": (one, steps[name]) for name, one in z.items()}
        return self.sides(plan, sides, corners, further, {"A_3": thin[1]} if thin else {})

    def _arc(self, centre: Spot, end: Spot, step: int) -> Item:
        """The stroke of the compasses through a mark."""
        radius = max(math.dist(centre, end), SEEN)
        at, wide = math.degrees(math.atan2(end[1] - centre[1], end[0] - centre[0])), math.degrees(4.0 / radius)
        return Arc(pens.ARC, "plates", step, centre, radius, at - wide, at + wide)

    def _turned(self, plan: View, z: dict[str, complex]) -> Iterator[Item]:
        """The angle alpha at D, from DG to DC."""
        start, end = (math.degrees(cmath.phase(z[name] - z["D"])) for name in "GC")
        way = (end - start + 180) % 360 - 180
        low, high = (start, start + way) if way >= 0 else (start + way, start)
        D, radius = plan((z["D"].real, z["D"].imag)), min(12.0, 0.4 * abs(z["G"] - z["D"]) * plan.scale)
        arc = Arc(DIMENSION, "links", None, D, radius, low, high)
        yield arc
        if radius > 2 * LETTERED:
            yield from self.backed(arc.spot_at((low + high) / 2), "alpha", middle=True)

    def _weights(self, plan: View, z: dict[str, complex], steps: dict[str, int]) -> Iterator[Item]:
        """The polygon of the trial weights, and the permanent weight."""
        names = [name for name in z if name.startswith("W_")]
        sides: list[Side] = [(z[start], z[end], f"p_{k}", MASS, steps[end])
                             for k, (start, end) in enumerate(pairwise(names))]
        if "p" in z:
            sides += [(z["W_0"], z[names[-1]], "", OTHER, steps[names[-1]]),
                      (z["W_0"], z["p"], "p", CORRECTIONS[0], steps["p"])]
        corners = {name: (z[name], steps[name]) for name in (names[0], names[-1])}
        return self.sides(plan, sides, corners)

    def curve(self, rect: Rect, trial: TrialWeights) -> Iterator[Item]:
        """The weights over the turn, with the cosine that runs through them."""
        first, mean = harmonic(trial), float(sum(trial.weights)) / len(trial.weights)
        angles = [angle_of(trial, k) for k in range(len(trial.weights))]
        start, turn = angles[0], [angles[0] + 3.0 * k for k in range(121)]
        cosine = [mean + (first * cmath.rect(1.0, -math.radians(angle))).real for angle in turn]
        weights = [*map(float, trial.weights)]
        span, largest = (start, start + 360.0), 1.15 * max(*weights, *cosine, MIN_WEIGHT)
        rect = stacked(rect, span, [(0.0, largest)])[0].rect
        graph = Graph.fitted(rect, span, (0.0, largest), largest / rect.height)
        yield from self.axes(graph, "°", arranged("p, {0}", unit(self.found.task.units.mass)), turns=True)
        yield from graph.curve(turn, cosine, CURVES[1])
        yield from graph.points([*angles, start + 360.0], [*weights, weights[0]], radius=0.7)
        for size, name, over in ((mean + abs(first), "p_max", 1.0), (mean - abs(first), "p_min", -3.4)):
            y = graph.at(0.0, size)[1]
            yield Polyline(pens.PRODUCED, "ruling", None, ((rect.left, y), (rect.right, y)))
            yield from self.backed((rect.right - 12.0, y + over), self.runs(name))
        if abs(first) <= HARMONIC_TOL * mean:
            return
        place = start + (math.degrees(cmath.phase(first)) - start) % 360
        yield from graph.uprights([place], pens.PRODUCED)
        yield from self.backed((graph.at(place, 0.0)[0] + 0.8, rect.bottom + 1.5), f"{digits(place % 360)}°")


def _along(start: Spot, end: Spot) -> tuple[Spot, ...]:
    """Spots of a line beside which its letters may stand."""
    return tuple((start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])) for part in ALONG)
