"""The figures of a rotor: its views across and along its axis, polygons of moments and forces, and plans of trials.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from graphplan.machines.rotors.rotor import PLANES, ThreeRuns, TrialWeights
from graphplan.machines.rotors.rotor_balance import BalancedRotor, Correction, Effect, angle_of, free_radius, harmonic
from graphplan.output.graphs import CURVES, Figures, Graph, stack_graphs
from graphplan.output.tolerances import HARMONIC_TOL, MIN_WEIGHT, RANGE_TOL
from graphplan.phrases import Said, arrange, digits, said, unit
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import Runs, name_runs, sentence_runs
from graphplan.sheet.lettering.letters import place_letters
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.view import View, fit_scale, view

# ---- views ----------------------------------------------------------------------------------------------------------


MASS = Pen(0.5, pens.BROWN, fill=pens.BROWN, tip=pens.WHITE)
CORRECTIONS = Pen(0.7, pens.RED, fill=pens.RED, tip=pens.WHITE), Pen(0.7, pens.GREEN, fill=pens.GREEN, tip=pens.WHITE)
OTHER_ANSWER = Pen(0.35, pens.RED, (2.4, 1.0), fill=pens.RED, tip=pens.WHITE)
DIMENSION, PLANE = Pen(0.18), Pen(0.35, pens.INK, (4.0, 1.2))
SHAFT, DISC = 1.4, 1.3  # mm: half the shaft's thickness, the radius of a mass
CENTRE_LINE_MM = 6.0  # mm that centre lines go on beyond what is on them
DIMENSION_ROW_MM, DIMENSION_HEAD_MM = 5.0, 2.2  # mm from one dimension line to the next, and their heads
MAX_DIMENSIONS = 6  # masses whose places are dimensioned at most


@dataclass(frozen=True)
class RotorViews(Figures):
    """The views of one rotor."""

    found: BalancedRotor

    @property
    def reach(self) -> float:
        """How far from the axis the outermost thing is."""
        rotor, masses = self.found.task.rotor, self.found.masses
        own = [mass.radius or 0.0 for mass in masses]
        return max([float(free_radius(rotor, masses)), *own, *(abs(z) for _, z in self.corrections)])

    @property
    def corrections(self) -> list[tuple[Correction, complex]]:
        """The corrections of the first answer that are not nothing, and where they are put across the axis."""
        drawing = self.found.drawing
        return [(one, drawing.position(f"P_{one.letter}")) for one in self.found.corrections
                if f"P_{one.letter}" in drawing.marks]

    @property
    def places(self) -> tuple[float, float]:
        """From where to where along the axis, from plane I, something stands."""
        rotor = self.found.task.rotor
        everything = [*rotor.planes, *rotor.bearings, *(mass.at for mass in self.found.masses if mass.at is not None)]
        arms = [float(rotor.arm(place)) for place in everything]
        return (min(arms), max(arms)) if max(arms) > min(arms) else (min(arms) - self.reach, max(arms) + self.reach)

    @property
    def foot(self) -> float:
        """The mm under the views that dimensions take."""
        return 2.0 + DIMENSION_ROW_MM * len(self._spans())

    def runs(self, words: str | Said) -> Runs:
        """A name or words as they are lettered."""
        return name_runs(words) if "_" in words and "·" not in words else sentence_runs(self.tongue(words))

    # ---- along the axis --------------------------------------------------------------------------------------------

    def end_view(self, rect: Rect, k: float, level: float) -> Iterator[Item]:
        """The rotor along its axis, from plane II: radii, masses, and corrections with their angles."""
        plan = View(rect, 1 / k, (rect.centre[0], level))
        (x, y), far = plan.origin, self.reach / k + CENTRE_LINE_MM
        axes = ((x - far, y), (x + far, y)), ((x, y - far), (x, y + far))
        items: list[Item] = [Polyline(pens.PATH, "ruling", None, ends) for ends in axes]
        items.append(Circle(Pen(0.25), "pairs", None, (x, y), SHAFT))
        wishes = [self.wish("x", (axes[0][1],)), self.wish("y", (axes[1][1],))]
        for z, name, pen, step in self._radii():
            spot = plan((z.real, z.imag))
            items += [Polyline(Pen(0.25, pen.colour, pen.dash), "links", step, (plan.origin, spot)), Circle(
                Pen(0.25, pen.colour, fill=pens.PAPER if pen.dash else pen.colour), "links", step, spot, DISC)]
            wishes.append(self.wish(name, (spot,), DISC + 0.5, step))
        for one, _ in self.corrections:
            items += self._angle(plan, one, self.found.drawing.marks[f"P_{one.letter}"])
        for index, effect in enumerate(self.found.effects):
            for spot, name in self._trial_masses(plan, effect, index):
                items.append(Circle(Pen(0.25, fill=pens.PAPER), "links", None, spot, 0.8 * DISC))
                wishes.append(self.wish(name, (spot,), DISC + 0.3))
        return self.with_letters(items, wishes, rect)

    def wish(self, name: str, spots: tuple[Spot, ...], clear: float = 0.8, step: int | None = None) -> Wish:
        """A name that wants a place beside a spot, or beside a line that has several."""
        return Wish(self.runs(name), spots, clear, True, step=step, label=name, free=len(spots) > 1)

    def with_letters(self, items: Sequence[Item], wishes: Sequence[Wish], rect: Rect) -> Iterator[Item]:
        """A figure with its letters, each where it can be read."""
        yield from items
        yield from place_letters(wishes, items, [wish.spots[0] for wish in wishes if not wish.free], rect, self.letters)

    def _radii(self) -> Iterator[tuple[complex, str, Pen, int]]:
        """Masses and corrections across the axis: place, name, pen and step; of other answers dashed."""
        drawing, marks = self.found.drawing, self.found.drawing.marks
        pens_by_name = {f"P_{number}": MASS for number in range(1, len(self.found.masses) + 1)}
        pens_by_name |= {f"P_{letter}": pen for letter, pen in zip(PLANES, CORRECTIONS, strict=True)}
        for name, step in marks.items():
            if name.startswith("P_"):
                yield drawing.position(name), f"m_{name[2:]}", pens_by_name.get(name, OTHER_ANSWER), step

    def _angle(self, plan: View, one: Correction, step: int) -> Iterator[Item]:
        """The angle of a correction, from the axis of abscissas."""
        radius = (0.3 + 0.16 * one.index) * self.reach * plan.scale
        if math.radians(one.angle) * radius < 2 * DIMENSION_HEAD_MM:
            return
        arc = Arc(DIMENSION, "links", step, plan.origin, radius, 0.0, one.angle)
        yield arc
        back = one.angle - math.degrees(DIMENSION_HEAD_MM / radius)
        yield Arrow(Pen(0.18, pens.INK, fill=pens.INK), "links", step, arc.spot_at(back), arc.spot_at(one.angle),
                    DIMENSION_HEAD_MM)
        yield from self.backed_text(arc.spot_at(one.angle / 2 if one.angle < 180 else one.angle - 30),
                                    f"alpha_{one.letter}",
                                    middle=True)

    def _trial_masses(self, plan: View, effect: Effect, index: int) -> Iterator[tuple[Spot, str]]:
        """Where trial masses were put, and what they are called."""
        trial = effect.trial
        far = float(trial.radius or free_radius(self.found.task.rotor, self.found.masses))
        angles = [float(trial.angle)]
        if isinstance(trial, TrialWeights):
            angles = [angle_of(trial, k) for k in range(len(trial.weights))]
        for k, angle in enumerate(angles):
            z = cmath.rect(far, math.radians(angle))
            yield plan((z.real, z.imag)), f"p_{k}" if len(angles) > 1 else "m" + "'" * index

    # ---- across the axis -------------------------------------------------------------------------------------------

    def side_view(self, rect: Rect, k: float, k_z: float, level: float) -> Iterator[Item]:
        """The rotor across its axis: planes, masses at their heights, bearings, and distances from plane I."""
        rotor, (low, high), far = self.found.task.rotor, self.places, self.reach / k + 3.0
        start = rect.centre[0] - (low + high) / 2 / k_z
        plan = View(rect, 1 / k, (start, level))
        ends = start + low / k_z - 2 * CENTRE_LINE_MM, start + high / k_z + 2 * CENTRE_LINE_MM
        items: list[Item] = [Polyline(pens.PATH, "ruling", None, ((ends[0] - 3.0, level), (ends[1] + 3.0, level)))]
        items += [Polyline(Pen(0.35), "links", None, ((ends[0], y), (ends[1], y)))
                  for y in (level - SHAFT, level + SHAFT)]
        for plane, letter in zip(rotor.planes, PLANES, strict=False):
            x = start + float(rotor.arm(plane)) / k_z
            items.append(Polyline(PLANE, "links", None, ((x, level - far), (x, level + far))))
            items.append(self.text((x, level + far + 1.2), said("plane {0}", letter), "middle"))
        for bearing in rotor.bearings:
            x, y = start + float(rotor.arm(bearing)) / k_z, level - SHAFT
            corners = (x - 2.0, y - 3.4), (x, y), (x + 2.0, y - 3.4), (x - 2.0, y - 3.4)
            items.append(Polyline(pens.GROUND, "ground", None, corners))
        wishes = []
        for foot, top, name, pen, step in self._sticks(plan, k_z):
            items += [Polyline(Pen(0.25, pen.colour), "links", step, (foot, top)),
                      Circle(Pen(0.25, pen.colour, fill=pen.colour), "links", step, top, DISC)]
            wishes.append(self.wish(name, (top,), DISC + 0.5, step))
        spans = ((start, start + place / k_z, name) for place, name in self._spans())
        return self.with_letters([*items, *self._dimensions(spans, level - far)], wishes, rect)

    def _sticks(self, plan: View, k_z: float) -> Iterator[tuple[Spot, Spot, str, Pen, int]]:
        """Masses and corrections at their heights over the axis: foot, top, name, pen and step."""
        rotor, drawing = self.found.task.rotor, self.found.drawing
        pieces = [(mass.at, f"P_{number}", MASS) for number, mass in enumerate(self.found.masses, 1)]
        pieces += [(one.at, f"P_{one.letter}", CORRECTIONS[one.index]) for one in self.found.corrections]
        for at, name, pen in pieces:
            if name in drawing.marks and at is not None:
                foot = plan.origin[0] + float(rotor.arm(at)) / k_z, plan.origin[1]
                top = foot[0], plan((0.0, drawing.position(name).imag))[1]
                yield foot, top, f"m_{name[2:]}", pen, drawing.marks[name]

    def _spans(self) -> list[tuple[float, str]]:
        """What is dimensioned, the nearest first: the places of the masses, if they are few, and that of plane II."""
        rotor = self.found.task.rotor
        spans = [(float(rotor.arm(mass.at)), f"a_{number}") for number, mass in enumerate(self.found.masses, 1)
                 if mass.at is not None and (self.found.polygons or not self.found.effects)]
        spans = spans if len(spans) <= MAX_DIMENSIONS else []
        planes = [(float(rotor.plane_distance), "a")] if rotor.dynamic else []
        return sorted((span for span in spans + planes if span[0]), key=lambda span: abs(span[0]))

    def _dimensions(self, spans: Iterable[tuple[float, float, str]], top: float) -> Iterator[Item]:
        """Dimension lines under each other."""
        for row, (x, end, name) in enumerate(spans, 1):
            y: float = top - DIMENSION_ROW_MM * row
            middle: Spot = ((x + end) / 2, y)
            for at in (x, end):
                yield Polyline(DIMENSION, "ruling", None, ((at, y - 1.0), (at, top - 1.0)))
                yield Arrow(Pen(0.18, pens.INK, fill=pens.INK), "ruling", None, middle, (at, y), DIMENSION_HEAD_MM)
            yield from self.backed_text(middle, name, middle=True)


# ---- polygons and trials --------------------------------------------------------------------------------------------


# mm: heads of vectors; a side with letters, and one that is drawn, is longer
HEAD_MM, MIN_LETTERED_MM, MIN_SIDE_MM = 3.5, 3.0, 0.1
MARGIN_MM = 8.0  # mm about a figure, for its letters
MAX_LETTERED_CORNERS = 8  # corners of a polygon that bear letters at most
LETTER_PLACES = 0.5, 0.4, 0.6, 0.3, 0.7  # of a side: its letters stand beside one of these
Side = tuple[complex, complex, str, Pen, int | None]  # from where to where, what it is, its pen and step


@dataclass(frozen=True)
class RotorFigures(RotorViews):
    """The views of one rotor, and what balances it."""

    def window(self, rect: Rect, points: Sequence[complex]) -> View:
        """Marks in the middle of a panel, at a round scale."""
        box = bounding_box([(z.real, z.imag) for z in points])
        room = rect.inset(MARGIN_MM, MARGIN_MM, MARGIN_MM, MARGIN_MM)
        return view(box, room, float(round_up(fit_scale(box, room) or 1.0)))

    def scale_label(self, rect: Rect, words: Said) -> Item:
        """The scale of a plan, in the corner of its panel."""
        return self.text((rect.left, rect.bottom), words, names=("k_mra", "mu_mra", "k_mr", "mu_mr"))

    def sides(self, plan: View, sides: Sequence[Side], corners: Mapping[str, tuple[complex, int]],
              further: Sequence[Item] = (), named: Mapping[str, tuple[Spot, Spot]] | None = None) -> Iterator[Item]:
        """Vectors with what they are, and the letters of corners, and of `further` lines those that are `named`."""
        items, wishes = [*further], [self.wish(name, spots_along(*line)) for name, line in (named or {}).items()]
        for name, (z, step) in corners.items():
            items.append(Circle(pens.DOT, "plates", step, plan((z.real, z.imag)), 0.5))
            wishes.append(self.wish(name, (plan((z.real, z.imag)),), 0.9, step))
        for start, end, name, pen, side_step in sides:
            foot, tip = plan((start.real, start.imag)), plan((end.real, end.imag))
            long = math.dist(foot, tip)
            if long >= MIN_SIDE_MM:
                items.append(Arrow(pen, "links", side_step, foot, tip, min(HEAD_MM, 0.6 * long)))
            if name and long >= MIN_LETTERED_MM:
                wishes.append(self.wish(name, spots_along(foot, tip), 0.8, side_step))
        return self.with_letters(items, wishes, plan.rect)

    # ---- polygons --------------------------------------------------------------------------------------------------

    def polygon(self, rect: Rect, letter: str, scale: Said) -> Iterator[Item]:
        """A polygon with what each side is, and the side that closes it."""
        drawing = self.found.drawing
        names = drawing.corners(letter)
        corners = [drawing.position(name) for name in names]
        written = "m_{0}·a_{0}·r_{0}" if letter == "M" else "m_{0}·r_{0}"
        drawn = zip(pairwise(corners), names[1:], strict=True)
        sides: list[Side] = [(*ends, written.format(name[2:]), CORRECTIONS[1] if name == "F_II" else MASS,
                              drawing.marks[name]) for ends, name in drawn]
        if abs(corners[0] - corners[-1]) > RANGE_TOL * max(map(abs, corners)):
            index, closing = (1, "m_II·a·r_II") if letter == "M" else (0, "m_I·r_I")
            ends = drawing.marks[names[-1]], drawing.marks[names[0]]
            step = next((step.index for step in drawing.values.drawing.program.steps if step.args == ends), None)
            sides.append((corners[-1], corners[0], closing, CORRECTIONS[index], step))
        shown = names if len(names) <= MAX_LETTERED_CORNERS else [names[0], names[-1]]
        lettered = {name: (drawing.position(name), drawing.marks[name]) for name in shown}
        yield from self.sides(self.window(rect, corners), sides, lettered)
        yield self.scale_label(rect, scale)

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
        yield self.scale_label(rect, scale)

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
            sides.append((z["D"], z["H"], "", OTHER_ANSWER, steps["H"]))
        further += self.alpha_arc(plan, z)
        corners = {name if name != "H" else "G'": (one, steps[name]) for name, one in z.items()}
        return self.sides(plan, sides, corners, further, {"A_3": thin[1]} if thin else {})

    def _arc(self, centre: Spot, end: Spot, step: int) -> Item:
        """The stroke of the compasses through a mark."""
        radius = max(math.dist(centre, end), MIN_SIDE_MM)
        at, wide = math.degrees(math.atan2(end[1] - centre[1], end[0] - centre[0])), math.degrees(4.0 / radius)
        return Arc(pens.ARC, "plates", step, centre, radius, at - wide, at + wide)

    def alpha_arc(self, plan: View, z: dict[str, complex]) -> Iterator[Item]:
        """The angle alpha at D, from DG to DC."""
        start, end = (math.degrees(cmath.phase(z[name] - z["D"])) for name in "GC")
        way = (end - start + 180) % 360 - 180
        low, high = (start, start + way) if way >= 0 else (start + way, start)
        D, radius = plan((z["D"].real, z["D"].imag)), min(12.0, 0.4 * abs(z["G"] - z["D"]) * plan.scale)
        arc = Arc(DIMENSION, "links", None, D, radius, low, high)
        yield arc
        if radius > 2 * MIN_LETTERED_MM:
            yield from self.backed_text(arc.spot_at((low + high) / 2), "alpha", middle=True)

    def _weights(self, plan: View, z: dict[str, complex], steps: dict[str, int]) -> Iterator[Item]:
        """The polygon of the trial weights, and the permanent weight."""
        names = [name for name in z if name.startswith("W_")]
        sides: list[Side] = [(z[start], z[end], f"p_{k}", MASS, steps[end])
                             for k, (start, end) in enumerate(pairwise(names))]
        if "p" in z:
            sides += [(z["W_0"], z[names[-1]], "", OTHER_ANSWER, steps[names[-1]]),
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
        rect = stack_graphs(rect, span, [(0.0, largest)])[0].rect
        graph = Graph.fit_rect(rect, span, (0.0, largest), largest / rect.height)
        yield from self.axes(graph, "°", arrange("p, {0}", unit(self.found.task.units.mass)), turns=True)
        yield from graph.curve(turn, cosine, CURVES[1])
        yield from graph.points([*angles, start + 360.0], [*weights, weights[0]], radius=0.7)
        for size, name, over in ((mean + abs(first), "p_max", 1.0), (mean - abs(first), "p_min", -3.4)):
            y = graph.spot(0.0, size)[1]
            yield Polyline(pens.PRODUCED, "ruling", None, ((rect.left, y), (rect.right, y)))
            yield from self.backed_text((rect.right - 12.0, y + over), self.runs(name))
        if abs(first) <= HARMONIC_TOL * mean:
            return
        place = start + (math.degrees(cmath.phase(first)) - start) % 360
        yield from graph.uprights([place], pens.PRODUCED)
        yield from self.backed_text((graph.spot(place, 0.0)[0] + 0.8, rect.bottom + 1.5), f"{digits(place % 360)}°")


def spots_along(start: Spot, end: Spot) -> tuple[Spot, ...]:
    """Spots of a line beside which its letters may stand."""
    return tuple((start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1]))
                 for part in LETTER_PLACES)
