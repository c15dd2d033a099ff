"""The sheet of a linkage's balancing: the mass centre by principal vectors, its path, and what shakes the frame.

The mechanism with principal points and vectors in the given pose, the path of the mass centre before and after, the
shaking force as a polar diagram (its hodograph), force and moment over the travel; of an engine the first two orders.

Source: Ozols 1974, 16-2 to 16-4 with figs. 16-4 to 16-12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.kernel.drawing import Values
from graphplan.kernel.program import Panel
from graphplan.machines.linkages.check import Balancing, MassMotion
from graphplan.machines.linkages.numbers import BalanceWords, clear_rounding
from graphplan.mechanism.model import Scene
from graphplan.methods.panels import MECHANISM
from graphplan.output.graphs import (
    CURVES,
    Figures,
    Graph,
    PolarGraph,
    Span,
    lines_through,
    scale_words,
    smooth_line,
    stack_graphs,
)
from graphplan.output.panelled import Panelled, Words, divide_across, divide_down
from graphplan.phrases import Said, join, said
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.letters import items_with_names, mechanism_wishes
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polyline, Rect, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.styled_plate import plate_of_values
from graphplan.sheet.plates.view import View, clip_item, fit_scale, view

FORCE = Panel("shaking force", said("shaking force"), said("Shaking force: its polar diagram"))
CYCLE = Panel("cycle", said("cycle"), said("Shaking force and moment over the travel"))
VECTOR, PATH = Pen(0.5, pens.BLUE, fill=pens.BLUE), Pen(0.35)
BEFORE, AFTER, FIRST, SECOND = CURVES[0], CURVES[2], CURVES[1], CURVES[4]
WEIGHT, ARM = Pen(0.35, pens.RED, fill="#e8c4c6"), Pen(0.35, pens.RED, (2.4, 1.0))
MECHANISM_MARGIN_MM = 6.0  # mm about the mechanism
HEAD_MM = 3.0  # of a principal vector
MAX_FORCE_RATIO = 8.0  # the middle size of a force: between limits what is larger may lie off its diagram
MIN_NUMBER_GAP_MM = 1.5  # mm: positions that lie nearer to each other have one number
SHARES = 0.7, 0.85, 1.0, 1.2, 1.4, 1.7, 2.0, 2.4  # of the height that forces may have, moments having 1
# numbered positions at most; mm that the radius of a drawn counterweight is at most
MAX_NUMBERED, MAX_WEIGHT_RADIUS_MM = 12, 5


@dataclass(frozen=True)
class BalanceSheet(Panelled):
    """One linkage on one paper."""

    balancing: Balancing
    document = said("Balancing of a linkage")
    told_scales = True

    @property
    def given_motion(self) -> MassMotion:
        """The linkage as it is given."""
        return self.balancing.before

    @property
    def scene(self) -> Scene:
        return self.given_motion.centre.scene

    @property
    def description(self) -> Said:
        program = self.given_motion.centre.drawing.program
        return said("Mass centre by principal vectors in {0} steps, and the shaking force over the cycle.",
                    len(program) - program.givens)

    @property
    def values(self) -> Values:
        return self.given_motion.centre.values

    @property
    def scales(self) -> Scales:
        return Scales(self.k_s, 1.0, self.scene.units.length, {}, convention=self.scene.sheet.convention)

    @property
    def scale(self) -> Said:
        return ratio(self.k_s, self.scene.units.length)

    @cached_property
    def figures(self) -> Figures:
        return Figures(self.letters, self.tongue)

    def repeats(self, panel: Panel) -> bool:
        """Each link has its own vector: all steps are told."""
        return False

    # ---- panels ----------------------------------------------------------------------------------------------------

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        """The mechanism above; under it the polar diagram, and beside that what changes over the travel."""
        upper, lower = divide_down(room, 1.3, 1.0)
        left, right = divide_across(lower, 1.0, 1.25)
        return {MECHANISM: upper, FORCE: left, CYCLE: right}

    def heading(self, panel: Panel) -> tuple[Said, Said | None]:
        """What a panel shows, and its scale."""
        if panel == MECHANISM:
            scale = Scales(self.k_s, 1.0, self.scene.units.length, {}, convention=self.scene.sheet.convention)
            return said("Mass centre by principal vectors"), join(scale.scale_texts(MECHANISM, set()), ",  ")
        if panel == FORCE:
            return panel.heading, scale_words("J", self.polar(self.room(panel)).k, "N", self.scene.sheet.convention)
        return panel.heading, None

    def figure(self, panel: Panel, rect: Rect) -> Iterator[Item]:
        """The mechanism, or a diagram."""
        if panel == MECHANISM:
            return self._mechanism(rect)
        return self._polar(rect) if panel == FORCE else self._cycle(rect)

    @cached_property
    def motions(self) -> list[tuple[MassMotion, Pen]]:
        """The linkage before and after it is balanced, each with its pen."""
        after = self.balancing.after
        return [(self.given_motion, BEFORE), *([(after, AFTER)] if after else [])]

    # ---- the mechanism ---------------------------------------------------------------------------------------------

    @cached_property
    def _box(self) -> Rect:
        """What the plan of the mechanism must hold: its points, the paths of the mass centre, and counterweights."""
        paths = [complex(z) for motion, _ in self.motions for z in motion.path[np.isfinite(motion.path)]]
        weights = [weight.place(self.scene) for weight in self.balancing.weights if weight.radius <= self.scene.extent]
        values = self.given_motion.centre.values
        ends = [point[:2] for role in values.drawing.roles for point in values.values_of_role(role)]
        places = [*((z.real, z.imag) for z in (*paths, *weights)), *ends]
        return bounding_box([*places, *((float(x), float(y)) for x, y in self.scene.points.values())])

    @cached_property
    def k_s(self) -> float:
        """Lengths for a mm of the mechanism, in a round scale."""
        return float(round_up(fit_scale(self._box, self.room(MECHANISM).inset(*(MECHANISM_MARGIN_MM,) * 4))))

    def _mechanism(self, rect: Rect) -> Iterator[Item]:
        """The links with their counterweights, the paths of the mass centre, and the steps."""
        window = view(self._box, rect, self.k_s)
        drawn = DrawnMechanism(self.scene, window)
        ink = plate_of_values(self.values, MECHANISM, window, self.scene, self.letters)
        others = [*self._weights(window), *self._paths(window), *drawn.items(), *self._vectors(ink)]
        path = [window((float(z.real), float(z.imag))) for z in self.given_motion.path[self.places]]
        wishes = [*mechanism_wishes(drawn), *self._numbers(path, window.rect)]
        yield from items_with_names(ink, others, wishes, lambda mark: bool(mark.number))

    def _vectors(self, ink: Plate) -> Iterator[Item]:
        """The principal vectors head to tail."""
        program, base = self.values.drawing.program, self.given_motion.centre.base
        first = next(step.index for step in program.steps if step.name == base)
        for start, end in pairwise([first, *self.values.drawing.roles["ends"]]):
            tail, tip = (ink.plates.steps[mark].spot for mark in (start, end))
            yield Arrow(VECTOR, "plates", end, tail, tip, min(HEAD_MM, 0.6 * math.dist(tail, tip)))

    def _paths(self, window: View) -> Iterator[Item]:
        """The paths of the mass centre; one that stands still is a spot."""
        for motion, pen in self.motions:
            spots = [window((float(z.real), float(z.imag))) for z in motion.path]
            yield from clip_item(Polyline(pen, "links", None, tuple(self._smooth(motion, spots))), window.rect)
            yield from (Circle(pen.with_fill(pen.colour), "links", None, spots[k], 0.5) for k in self.places)

    def _weights(self, window: View) -> Iterator[Item]:
        """The counterweights where they stand, their areas as their masses, on arms from their pivots."""
        heaviest = max((weight.mass for weight in self.balancing.weights), default=1.0)
        for weight in self.balancing.weights:
            at, pivot = weight.place(self.scene), complex(*map(float, self.scene.points[weight.pivot]))
            spot, root = (window((z.real, z.imag)) for z in (at, pivot))
            yield from clip_item(Polyline(ARM, "links", None, (root, spot)), window.rect)
            if window.rect.holds(spot):
                yield Circle(WEIGHT, "links", None, spot,
                             max(1.0, MAX_WEIGHT_RADIUS_MM * (weight.mass / heaviest) ** 0.5))

    def _numbers(self, spots: Sequence[Spot], rect: Rect) -> Iterator[Wish]:
        """The numbers of positions at their spots; of such as lie on each other the first alone."""
        shown = list[Spot]()
        for number, spot in enumerate(spots):
            if rect.holds(spot) and all(math.dist(spot, other) > MIN_NUMBER_GAP_MM for other in shown):
                shown.append(spot)
                yield Wish(self._runs(str(number)), (spot,), 0.8, True, pens.FAINT)

    def _runs(self, text: str) -> Any:
        return self.figures.text((0.0, 0.0), text).runs

    @cached_property
    def places(self) -> list[int]:
        """The positions that are numbered, by their places among all."""
        count = len(self.given_motion.links.travel)
        each = next(step for step in range(1, count + 1) if count % step == 0 and count / step <= MAX_NUMBERED)
        return [k for k in range(0, count, each) if np.isfinite(self.given_motion.path[k])]

    def _smooth(self, motion: MassMotion, spots: list[Spot]) -> list[Spot]:
        """A smooth line through spots, back to its beginning where the motion closes."""
        known = [spot for spot, z in zip(spots, motion.path, strict=True) if np.isfinite(z)]
        if not motion.links.closes or len(known) < len(spots):
            return smooth_line(known)
        count = len(spots)
        whole = smooth_line([known[-1], *known, known[0], known[1]])
        pieces = (len(whole) - 1) // (count + 2)
        return whole[pieces:-pieces]

    # ---- diagrams --------------------------------------------------------------------------------------------------

    def polar(self, rect: Rect) -> PolarGraph:
        """The polar diagram of the shaking force, before and after."""
        forces = np.concatenate([self.usual_values(self._force(motion)) for motion, _ in self.motions])
        return PolarGraph.fit_vectors(rect.inset(4.0, 4.0, 4.0, 8.0), forces.real.tolist(), forces.imag.tolist())

    def _polar(self, rect: Rect) -> Iterator[Item]:
        """The curves of the ends of the shaking force, with numbered positions."""
        polar = self.polar(rect)
        ink, ends = [*self.figures.rings(polar, "N")], list[Spot]()
        ink += self._legend(rect, [("J", BEFORE), *([("J'", AFTER)] if self.balancing.after else [])])
        for motion, pen in self.motions:
            spots = [polar.end_of(float(z.real), float(z.imag)) for z in self._force(motion)]
            ink += clip_item(Polyline(pen, "links", None, tuple(self._smooth(motion, spots))), polar.rect)
            shown = [spots[k] for k in self.places if polar.rect.holds(spots[k])]
            ink += [Circle(pen.with_fill(pen.colour), "links", None, spot, 0.5) for spot in shown]
            ends += shown
        spots = [polar.end_of(float(z.real), float(z.imag)) for z in self._force(self.given_motion)[self.places]]
        yield from (*ink, *place_letters([*self._numbers(spots, polar.rect)], ink, ends, polar.rect, self.letters))

    def _force(self, motion: MassMotion) -> Any:
        """The shaking force, zero where it is rounding alone."""
        return clear_rounding(motion.shaking.force, self.words.sizes[0])

    def usual_values(self, values: Any) -> Any:
        """The values for which a diagram must have room: all of a motion that closes; between limits, where forces grow
        beyond all bounds, those that are not many times as large as most."""
        known = values[np.isfinite(values)]
        most = MAX_FORCE_RATIO * np.median(np.abs(known))
        return known if self.given_motion.links.closes or not most else known[np.abs(known) <= most]

    def _legend(self, rect: Rect, curves: list[tuple[str, Pen]]) -> Iterator[Item]:
        """Which curve is which, in the upper left corner."""
        words = {"J": said("before"), "J'": said("balanced"), "J_1": said("first order"), "J_2": said("second order")}
        x, size = rect.left + 2.0, self.letters.text
        for name, pen in curves:
            yield Polyline(pen, "letters", None, ((x, rect.top - 2.0), (x + 6.0, rect.top - 2.0)))
            told = self.figures.text((x + 7.5, rect.top - 2.0 - 0.35 * size), words[name])
            yield told
            x = told.box.right + 6.0

    def _cycle(self, rect: Rect) -> Iterator[Item]:
        """The size of the shaking force, of an engine its parts along the guide, and the moment, over the travel."""
        force, moment = self.words.sizes
        forces = [(clear_rounding(values, force), pen) for values, pen in self._forces]
        moments = [(clear_rounding(motion.shaking.moment, moment), pen) for motion, pen in self.motions]
        slides = self.scene.drives[0].slides
        travel = self.given_motion.links.travel if slides else np.degrees(self.given_motion.links.travel)
        ends = (0.0, 360.0 * max(1, round(travel[-1] / 360))) if self.is_whole_turns else (travel[0], travel[-1])
        spans = [_span([self.usual_values(values) for values, _ in curves]) for curves in (forces, moments)]
        upper, lower = stack_diagrams(rect.inset(2.0, 2.0, 4.0, 5.0), ends, spans)
        unit_x = self.scene.units.length if slides else "°"
        yield from lines_through([upper, lower], self._uprights(travel))
        words = "s" if slides else "φ"
        convention = self.scene.sheet.convention
        yield from self.figures.axes(upper, "", scale_words("J", upper.y.unit, "N", convention), numbers=False)
        yield from self.figures.axes(lower, f"{words}, {unit_x}", scale_words("M", lower.y.unit, "N m", convention),
                                     turns=not slides)
        for graph, curves in ((upper, forces), (lower, moments)):
            for values, pen in curves:
                yield from self._curve(graph, travel, values, pen)
        named = [("J", BEFORE), *([("J'", AFTER)] if self.balancing.after else [])]
        yield from self._legend(rect, [*named, *([("J_1", FIRST), ("J_2", SECOND)] if self.balancing.engine else [])])

    @cached_property
    def is_whole_turns(self) -> bool:
        """Whether the travel is that of whole turns."""
        return self.given_motion.links.closes and not self.scene.drives[0].slides

    def _uprights(self, travel: Any) -> list[float]:
        """The travels of the numbered positions."""
        return [float(travel[k]) for k in self.places]

    def _curve(self, graph: Graph, travel: Any, values: Any, pen: Pen) -> Iterator[Item]:
        """A smooth curve over the travel, to the end of its period."""
        if self.is_whole_turns:
            travel, values = np.append(travel, graph.x.span(graph.level)[1]), np.append(values, values[0])
        yield from graph.smooth(travel, values, pen)

    @cached_property
    def _forces(self) -> list[tuple[Any, Pen]]:
        """What of the shaking force is drawn over the travel: of an engine along its guide, with its orders."""
        engine = self.balancing.engine
        if engine is None:
            return [(np.abs(motion.shaking.force), pen) for motion, pen in self.motions]
        crank = self.given_motion.points[engine.pin(self.scene)] - self.given_motion.points[engine.hinge]
        angle = np.angle(crank / engine.ahead)
        parts = [(np.real(motion.shaking.force / engine.ahead), pen) for motion, pen in self.motions]
        first = np.real(engine.force(angle, (1,)))
        return [*parts, (first, FIRST), (np.real(engine.order(2) * np.exp(-2j * angle)), SECOND)]

    # ---- words -----------------------------------------------------------------------------------------------------

    @cached_property
    def words(self) -> BalanceWords:
        """What the sheet says."""
        return BalanceWords(self.balancing)

    def given_words(self) -> Iterator[Words]:
        return self.words.given_data()

    def result_words(self) -> Iterator[Words]:
        return self.words.results()


def stack_diagrams(room: Rect, x: Span, spans: Sequence[Span]) -> list[Graph]:
    """Two diagrams, each as high as its ordinates are at its round scale, in the shares in which they take most room.
    """
    tried = [stack_graphs(room, x, spans, (share, 1.0)) for share in SHARES]
    fitted = [[graph._replace(upright=(graph.upright[0], high / graph.y.unit))
               for graph, (_, high) in zip(graphs, spans, strict=True)] for graphs in tried]
    return max(fitted, key=lambda graphs: math.prod(graph.rect.height for graph in graphs))


def _span(curves: list[Any]) -> tuple[float, float]:
    """From the least of some values to the largest, and a little more; zero among them."""
    low, high = (float(end([end([0.0, *values]) for values in curves])) for end in (min, max))
    return (1.05 * low, 1.05 * high) if high > low else (-1.0, 1.0)
