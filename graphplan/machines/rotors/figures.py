"""The figures of a rotor: its views across and along its axis, polygons of moments and forces, and plans of trials.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from graphplan.kernel.program import Panel
from graphplan.machines.rotors.rotor import PLANES, ThreeRuns, TrialWeights
from graphplan.machines.rotors.rotor_balance import (
    END_VIEW,
    FORCES,
    MOMENTS,
    TRIAL_PLANS,
    BalancedRotor,
    Correction,
    Effect,
    angle_of,
    free_radius,
    harmonic,
)
from graphplan.machines.tolerances import HARMONIC_TOL, MIN_WEIGHT, ZERO_TOL
from graphplan.phrases import Said, digits, said, unit
from graphplan.sheet.diagrams import CURVES, Diagram, DrawnCurve, Frame, Label, QuantityAxis, stack_frames
from graphplan.sheet.layout.scales import Scales, ratio, round_up, scale_words
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import Runs, name_runs, sentence_runs
from graphplan.sheet.panels import Division, PanelFigure, PanelPage, column, fit_view, row
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.view import View, interpolate

SIDE_VIEW = Panel("side view", said("side view"))
CURVE = Panel("trial weights", said("trial weights"), said("Trial weights over the turn"))
MASS = Pen(0.5, pens.BROWN, fill=pens.BROWN, tip=pens.WHITE)
CORRECTIONS = Pen(0.7, pens.RED, fill=pens.RED, tip=pens.WHITE), Pen(0.7, pens.GREEN, fill=pens.GREEN, tip=pens.WHITE)
OTHER_ANSWER = Pen(0.35, pens.RED, (2.4, 1.0), fill=pens.RED, tip=pens.WHITE)
DIMENSION, PLANE = Pen(0.18), Pen(0.35, pens.INK, (4.0, 1.2))
SHAFT, DISC = 1.4, 1.3  # mm: half the shaft's thickness, the radius of a mass
CENTRE_LINE_MM = 6.0  # mm that centre lines go on beyond what is on them
DIMENSION_ROW_MM, DIMENSION_HEAD_MM = 5.0, 2.2  # mm from one dimension line to the next, and their heads
MAX_DIMENSIONS = 6  # masses whose places are dimensioned at most
MAX_COARSER = 1.3  # times as coarse as the scale along the axis may be to be that across it
# mm: heads of vectors; a side with letters, and one that is drawn, is longer
HEAD_MM, MIN_LETTERED_MM, MIN_SIDE_MM = 3.5, 3.0, 0.1
MARGIN_MM = 8.0  # mm about a figure, for its letters
MAX_LETTERED_CORNERS = 8  # corners of a polygon that bear letters at most
LETTER_PLACES = 0.5, 0.4, 0.6, 0.3, 0.7  # of a side: its letters stand beside one of these
Side = tuple[complex, complex, str, Pen, int | None]  # from where to where, what it is, its pen and step


def panels(found: BalancedRotor) -> Division:
    """The views above, under them the plans of trials if there are such, and the polygons."""
    trials = [*TRIAL_PLANS[:len(found.effects)]]
    trials += [CURVE] if any(isinstance(one.trial, TrialWeights) for one in found.effects) else []
    polygons = [*([MOMENTS] if found.task.rotor.dynamic else []), FORCES] if found.polygons else []
    views = row((1.35, SIDE_VIEW), (1.0, END_VIEW))
    bands = [row(*((1.0, panel) for panel in band)) for band in (trials, polygons) if band]
    return column((0.85, views), *((1.0, band) for band in bands))


@dataclass(frozen=True)
class RotorFigures:
    """The views of one rotor on its page, and what balances it."""

    found: BalancedRotor
    page: PanelPage

    @property
    def figures(self) -> dict[Panel, PanelFigure]:
        """All of them."""
        return {panel: self.side_view() if panel == SIDE_VIEW else self.end_view() if panel == END_VIEW else
                self.weights_curve() if panel == CURVE else self.polygon(panel) if panel in (MOMENTS, FORCES) else
                self.trial(panel) for panel in self.page.panels}

    # ---- scales ----------------------------------------------------------------------------------------------------

    @cached_property
    def scales(self) -> Scales:
        """The scales of the views, and of the plans as multiples of that."""
        task, k = self.found.task, self.k_r
        multiples = {str(panel): round_up(k) / round_up(1 / self.window(panel).scale) for panel in self.page.panels
                     if panel not in (SIDE_VIEW, END_VIEW, CURVE)}
        return Scales(k, 1.0, task.units.length, multiples, unit=task.units.mass, convention=task.sheet.convention)

    @property
    def k_r(self) -> float:
        """Lengths for a mm across the axis: round, for both views."""
        across, along = self._k_across, self._k_along
        return max(across, along) if along <= MAX_COARSER * across else across

    @property
    def k_z(self) -> float:
        """Lengths for a mm along the axis: those across it, unless the rotor is too long for them."""
        return self.k_r if self._k_along <= MAX_COARSER * self._k_across else self._k_along

    @property
    def _k_across(self) -> float:
        """The lengths for a mm that the height of the views asks for, and the width of the end view."""
        side, end = (self.page.room(panel) for panel in (SIDE_VIEW, END_VIEW))
        return float(round_up(2 * self.reach / min(side.height - 2 * MARGIN_MM - self.foot, end.width - 2 * MARGIN_MM)))

    @property
    def _k_along(self) -> float:
        """The lengths for a mm that the width of the side view asks for."""
        low, high = self.places
        return float(round_up((high - low) / (self.page.room(SIDE_VIEW).width - 4 * MARGIN_MM)))

    def window(self, panel: Panel) -> View:
        """The plan of a polygon or of a trial: its marks in the middle, at a round scale."""
        drawing = self.found.drawing
        points = [drawing.position(name) for name in drawing.corners("M" if panel == MOMENTS else "F")] \
            if panel in (MOMENTS, FORCES) else [complex(*drawing.values[step]) for step in self._marks(panel).values()]
        return fit_view(bounding_box([(z.real, z.imag) for z in points]), self.page.room(panel), MARGIN_MM)

    def _scale_label(self, panel: Panel) -> Item:
        """The scale of a polygon or of a trial's plan, in the corner of its panel."""
        units = self.found.task.units
        letter, measure = {MOMENTS: ("mra", f"{units.mass}·{units.length}²"),
                           FORCES: ("mr", f"{units.mass}·{units.length}")}.get(
            panel, ("p", units.mass) if CURVE in self.page.panels else ("A", ""))
        told = scale_words(letter, 1 / self.window(panel).scale, measure, self.page.scene.sheet.convention)
        return self._corner_text(panel, told, f"k_{letter}", f"mu_{letter}")

    def _corner_text(self, panel: Panel, words: Said, *names: str) -> Item:
        rect = self.page.room(panel)
        return self.page.text.text((rect.left, rect.bottom), words, names=names)

    # ---- what is seen ----------------------------------------------------------------------------------------------

    @cached_property
    def reach(self) -> float:
        """The largest radius on the sheet."""
        rotor, masses = self.found.task.rotor, self.found.masses
        own = [mass.radius or 0.0 for mass in masses]
        return max([float(free_radius(rotor, masses)), *own, *(abs(z) for _, z in self.corrections)])

    @property
    def corrections(self) -> list[tuple[Correction, complex]]:
        """The corrections of the first answer that are not zero, and where they are put across the axis."""
        drawing = self.found.drawing
        return [(one, drawing.position(f"P_{one.letter}")) for one in self.found.corrections
                if f"P_{one.letter}" in drawing.marks]

    @cached_property
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

    def _level(self, rect: Rect) -> float:
        """The height of the axis in the views."""
        return (rect.bottom + self.foot + rect.top) / 2

    def wish(self, name: str, spots: tuple[Spot, ...], clear: float = 0.8, step: int | None = None) -> Wish:
        """A name that wants a place beside a spot, or beside a line that has several."""
        runs: Runs = name_runs(name) if "_" in name and "·" not in name else sentence_runs(self.page.tongue(name))
        return Wish(runs, spots, clear, True, step=step, label=name, free=len(spots) > 1)

    # ---- along the axis --------------------------------------------------------------------------------------------

    def end_view(self) -> PanelFigure:
        """The rotor along its axis, from plane II: radii, masses, and corrections with their angles."""
        rect = self.page.room(END_VIEW)
        x, y = rect.centre[0], self._level(rect)
        plan, far = View(rect, 1 / self.k_r, (x, y)), self.reach / self.k_r + CENTRE_LINE_MM
        axes = ((x - far, y), (x + far, y)), ((x, y - far), (x, y + far))
        items: list[Item] = [Polyline(pens.PATH, "ruling", None, ends) for ends in axes]
        items.append(Circle(Pen(0.25), "pairs", None, (x, y), SHAFT))
        wishes = [self.wish(name, (ends[1],)) for name, ends in zip("xy", axes, strict=True)]
        for z, name, pen, step in self._radii():
            spot, fill = plan.spot(z), pens.PAPER if pen.dash else pen.colour
            items += [Polyline(Pen(0.25, pen.colour, pen.dash), "links", step, (plan.origin, spot)),
                      Circle(Pen(0.25, pen.colour, fill=fill), "links", step, spot, DISC)]
            wishes.append(self.wish(name, (spot,), DISC + 0.5, step))
        for one, _ in self.corrections:
            items += self._angle(plan, one, self.found.drawing.marks[f"P_{one.letter}"])
        for index, effect in enumerate(self.found.effects):
            for spot, name in self._trial_masses(plan, effect, index):
                items.append(Circle(Pen(0.25, fill=pens.PAPER), "links", None, spot, 0.8 * DISC))
                wishes.append(self.wish(name, (spot,), DISC + 0.3))
        return PanelFigure(rect, strokes=items, wishes=wishes)

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
        yield Arrow(pens.DIMENSION, "links", step, arc.spot_at(back), arc.spot_at(one.angle), DIMENSION_HEAD_MM)
        middle = arc.spot_at(one.angle / 2 if one.angle < 180 else one.angle - 30)
        yield from self.page.text.backed_text(middle, f"alpha_{one.letter}", middle=True)

    def _trial_masses(self, plan: View, effect: Effect, index: int) -> Iterator[tuple[Spot, str]]:
        """The spots of trial masses, with their names."""
        trial = effect.trial
        far, count = float(trial.radius or free_radius(self.found.task.rotor, self.found.masses)), 1
        angles = [float(trial.angle)]
        if isinstance(trial, TrialWeights):
            count = len(trial.weights)
            angles = [angle_of(trial, k) for k in range(count)]
        for k, angle in enumerate(angles):
            yield plan.spot(cmath.rect(far, math.radians(angle))), f"p_{k}" if count > 1 else "m" + "'" * index

    # ---- across the axis -------------------------------------------------------------------------------------------

    def side_view(self) -> PanelFigure:
        """The rotor across its axis: planes, masses at their heights, bearings, and distances from plane I."""
        rotor, (low, high), k_z, rect = self.found.task.rotor, self.places, self.k_z, self.page.room(SIDE_VIEW)
        level, far, start = self._level(rect), self.reach / self.k_r + 3.0, rect.centre[0] - (low + high) / 2 / k_z
        ends = start + low / k_z - 2 * CENTRE_LINE_MM, start + high / k_z + 2 * CENTRE_LINE_MM
        items: list[Item] = [Polyline(pens.PATH, "ruling", None, ((ends[0] - 3.0, level), (ends[1] + 3.0, level)))]
        items += [Polyline(Pen(0.35), "links", None, ((ends[0], y), (ends[1], y)))
                  for y in (level - SHAFT, level + SHAFT)]
        for plane, letter in zip(rotor.planes, PLANES, strict=False):
            x = start + float(rotor.arm(plane)) / k_z
            items.append(Polyline(PLANE, "links", None, ((x, level - far), (x, level + far))))
            items.append(self.page.text.text((x, level + far + 1.2), said("plane {0}", letter), "middle"))
        for bearing in rotor.bearings:
            x, y = start + float(rotor.arm(bearing)) / k_z, level - SHAFT
            corners = (x - 2.0, y - 3.4), (x, y), (x + 2.0, y - 3.4), (x - 2.0, y - 3.4)
            items.append(Polyline(pens.GROUND, "ground", None, corners))
        wishes = []
        for arm, height, name, pen, step in self._sticks():
            foot = start + arm / k_z, level
            top = foot[0], level + height / self.k_r
            items += [Polyline(Pen(0.25, pen.colour), "links", step, (foot, top)),
                      Circle(Pen(0.25, pen.colour, fill=pen.colour), "links", step, top, DISC)]
            wishes.append(self.wish(name, (top,), DISC + 0.5, step))
        for line, (place, name) in enumerate(self._spans(), 1):
            items += self._dimension(start, start + place / k_z, level - far - DIMENSION_ROW_MM * line, level - far,
                                     name)
        if k_z != self.k_r:
            items.append(self._corner_text(SIDE_VIEW, said(
                "along the axis {0}", ratio(k_z, self.found.task.units.length))))
        return PanelFigure(rect, strokes=items, wishes=wishes)

    def _sticks(self) -> Iterator[tuple[float, float, str, Pen, int]]:
        """Masses and corrections: arm along the axis and height over it, name, pen and step."""
        rotor, drawing = self.found.task.rotor, self.found.drawing
        pieces = [(mass.at, f"P_{number}", MASS) for number, mass in enumerate(self.found.masses, 1)]
        pieces += [(one.at, f"P_{one.letter}", CORRECTIONS[one.index]) for one in self.found.corrections]
        for at, name, pen in pieces:
            if name in drawing.marks and at is not None:
                yield (float(rotor.arm(at)), drawing.position(name).imag, f"m_{name[2:]}", pen, drawing.marks[name])

    def _spans(self) -> list[tuple[float, str]]:
        """The dimensioned distances, the nearest first: the places of few masses, and that of plane II."""
        rotor = self.found.task.rotor
        spans = [(float(rotor.arm(mass.at)), f"a_{number}") for number, mass in enumerate(self.found.masses, 1)
                 if mass.at is not None and (self.found.polygons or not self.found.effects)]
        spans = spans if len(spans) <= MAX_DIMENSIONS else []
        planes = [(float(rotor.plane_distance), "a")] if rotor.dynamic else []
        return sorted((span for span in spans + planes if span[0]), key=lambda span: abs(span[0]))

    def _dimension(self, start: float, end: float, y: float, top: float, name: str) -> Iterator[Item]:
        """A dimension line under what it measures."""
        middle: Spot = ((start + end) / 2, y)
        for at in (start, end):
            yield Polyline(DIMENSION, "ruling", None, ((at, y - 1.0), (at, top - 1.0)))
            yield Arrow(pens.DIMENSION, "ruling", None, middle, (at, y), DIMENSION_HEAD_MM)
        yield from self.page.text.backed_text(middle, name, middle=True)

    # ---- polygons --------------------------------------------------------------------------------------------------

    def polygon(self, panel: Panel) -> PanelFigure:
        """A polygon with what each side is, and the side that closes it."""
        drawing, letter = self.found.drawing, "M" if panel == MOMENTS else "F"
        names = drawing.corners(letter)
        corners = [drawing.position(name) for name in names]
        written = "m_{0}·a_{0}·r_{0}" if letter == "M" else "m_{0}·r_{0}"
        sides: list[Side] = [(*ends, written.format(name[2:]), CORRECTIONS[1] if name == "F_II" else MASS,
                              drawing.marks[name]) for ends, name in zip(pairwise(corners), names[1:], strict=True)]
        if abs(corners[0] - corners[-1]) > ZERO_TOL * max(map(abs, corners)):
            index, closing = (1, "m_II·a·r_II") if letter == "M" else (0, "m_I·r_I")
            ends = drawing.marks[names[-1]], drawing.marks[names[0]]
            step = next((step.index for step in drawing.values.drawing.program.steps if step.args == ends), None)
            sides.append((corners[-1], corners[0], closing, CORRECTIONS[index], step))
        shown = names if len(names) <= MAX_LETTERED_CORNERS else [names[0], names[-1]]
        return self.sides(panel, sides, {name: (drawing.position(name), drawing.marks[name]) for name in shown})

    def sides(self, panel: Panel, sides: Sequence[Side], corners: Mapping[str, tuple[complex, int]],
              further: Sequence[Item] = (), named: Mapping[str, tuple[Spot, Spot]] | None = None) -> PanelFigure:
        """Vectors with what they are, and the letters of corners, and of `further` lines those that are `named`."""
        plan = self.window(panel)
        items, wishes = [*further], [self.wish(name, spots_along(*line)) for name, line in (named or {}).items()]
        for name, (z, step) in corners.items():
            items.append(Circle(pens.DOT, "plates", step, plan.spot(z), 0.5))
            wishes.append(self.wish(name, (plan.spot(z),), 0.9, step))
        for start, end, name, pen, side_step in sides:
            foot, tip = plan.spot(start), plan.spot(end)
            long = math.dist(foot, tip)
            if long >= MIN_SIDE_MM:
                items.append(Arrow(pen, "links", side_step, foot, tip, min(HEAD_MM, 0.6 * long)))
            if name and long >= MIN_LETTERED_MM:
                wishes.append(self.wish(name, spots_along(foot, tip), 0.8, side_step))
        return PanelFigure(plan.rect, strokes=[*items, self._scale_label(panel)], wishes=wishes)

    # ---- trials ----------------------------------------------------------------------------------------------------

    def _marks(self, panel: Panel) -> dict[str, int]:
        """The steps of the marks of a trial, by their names in the first."""
        index = f"{TRIAL_PLANS.index(panel)}:"
        return {name.removeprefix(index): step for name, step in self.found.drawing.marks.items()
                if name.startswith(index)}

    def trial(self, panel: Panel) -> PanelFigure:
        """The plan of a trial."""
        steps, effect = self._marks(panel), self.found.effects[TRIAL_PLANS.index(panel)]
        z = {name: complex(*self.found.drawing.values[step]) for name, step in steps.items()}
        if isinstance(effect.trial, TrialWeights):
            return self._weights(panel, z, steps)
        if "D" in z and "G" in z:
            return self._triangle(panel, effect, z, steps)
        return PanelFigure(self.page.room(panel), strokes=[self._scale_label(panel)])

    def _triangle(self, panel: Panel, effect: Effect, z: dict[str, complex], steps: dict[str, int]) -> PanelFigure:
        """Vibrations and their difference; of three runs the arcs and both answers."""
        plan = self.window(panel)
        spot = {name: plan.spot(one) for name, one in z.items()}
        sides: list[Side] = [(z["C"], z["D"], "A_1", MASS, steps["D"]), (z["C"], z["G"], "A_2", MASS, steps["G"]),
                             (z["D"], z["G"], "A", CORRECTIONS[0], steps["G"])]
        thin = [(spot["D"], spot["E"]), (spot["E"], spot["G"])] if isinstance(effect.trial, ThreeRuns) else []
        further: list[Item] = [Polyline(pens.THIN, "links", steps["G"], line) for line in thin]
        further += [stroke_of_compasses(spot[centre], spot[end], steps[end]) for centre in "CE" for end in "GH"
                    if thin and end in z]
        if "H" in z and len(effect.turns) > 1:
            sides.append((z["D"], z["H"], "", OTHER_ANSWER, steps["H"]))
        further += self._alpha_arc(plan, z)
        corners = {name if name != "H" else "G'": (one, steps[name]) for name, one in z.items()}
        return self.sides(panel, sides, corners, further, {"A_3": thin[1]} if thin else {})

    def _alpha_arc(self, plan: View, z: dict[str, complex]) -> Iterator[Item]:
        """The angle alpha at D, from DG to DC."""
        start, end = (math.degrees(cmath.phase(z[name] - z["D"])) for name in "GC")
        low, high = sorted((start, start + (end - start + 180) % 360 - 180))
        arc = Arc(DIMENSION, "links", None, plan.spot(z["D"]), min(12.0, 0.4 * abs(z["G"] - z["D"]) * plan.scale), low,
                  high)
        yield arc
        if arc.radius > 2 * MIN_LETTERED_MM:
            yield from self.page.text.backed_text(arc.spot_at((low + high) / 2), "alpha", middle=True)

    def _weights(self, panel: Panel, z: dict[str, complex], steps: dict[str, int]) -> PanelFigure:
        """The polygon of the trial weights, and the permanent weight."""
        names = [name for name in z if name.startswith("W_")]
        sides: list[Side] = [(z[start], z[end], f"p_{k}", MASS, steps[end])
                             for k, (start, end) in enumerate(pairwise(names))]
        if "p" in z:
            sides += [(z["W_0"], z[names[-1]], "", OTHER_ANSWER, steps[names[-1]]),
                      (z["W_0"], z["p"], "p", CORRECTIONS[0], steps["p"])]
        return self.sides(panel, sides, {name: (z[name], steps[name]) for name in (names[0], names[-1])})

    def weights_curve(self) -> PanelFigure:
        """The weights over the turn, with the cosine that runs through them."""
        trial, room = self.found.effects[0].trial, self.page.room(CURVE)
        assert isinstance(trial, TrialWeights)
        first, mean = harmonic(trial), float(sum(trial.weights)) / len(trial.weights)
        angles = [angle_of(trial, k) for k in range(len(trial.weights))]
        start, turn = angles[0], [angles[0] + 3.0 * k for k in range(121)]
        cosine = [mean + (first * cmath.rect(1.0, -math.radians(angle))).real for angle in turn]
        weights = [*map(float, trial.weights)]
        span, largest = (start, start + 360.0), 1.15 * max(*weights, *cosine, MIN_WEIGHT)
        rect = stack_frames(room, span, [(0.0, largest)])[0].rect
        ends = {"p_max": mean + abs(first), "p_min": mean - abs(first)}
        labels = [Label(span[1], size, name_runs(name), (-12.0, over), backed=True)
                  for (name, size), over in zip(ends.items(), (1.0, -3.4), strict=True)]
        phase = [start + (math.degrees(cmath.phase(first)) - start) % 360] if abs(first) > HARMONIC_TOL * mean else []
        labels += [Label(place, 0.0, f"{digits(place % 360)}°", (0.8, 1.5), backed=True) for place in phase]
        return PanelFigure(room, [Diagram(
            Frame.fit_rect(rect, span, (0.0, largest), largest / rect.height),
            QuantityAxis("°", label=unit("°"), turns=True, scaled=False),
            QuantityAxis("p", self.found.task.units.mass, scaled=False),
            [DrawnCurve(turn, cosine, CURVES[1]),
             DrawnCurve([*angles, span[1]], [*weights, weights[0]], pens.DOT, dots=0.7)],
            labels, uprights=phase, levels=[*ends.values()], pen=pens.PRODUCED)])


def stroke_of_compasses(centre: Spot, end: Spot, step: int) -> Item:
    """The stroke of the compasses through a mark."""
    radius = max(math.dist(centre, end), MIN_SIDE_MM)
    at, wide = math.degrees(math.atan2(end[1] - centre[1], end[0] - centre[0])), math.degrees(4.0 / radius)
    return Arc(pens.ARC, "plates", step, centre, radius, at - wide, at + wide)


def spots_along(start: Spot, end: Spot) -> tuple[Spot, ...]:
    """Spots of a line beside which its letters may stand."""
    return tuple(interpolate(start, end, part) for part in LETTER_PLACES)
