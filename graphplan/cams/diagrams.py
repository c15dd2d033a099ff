"""Diagrams of a cam: lift, velocity, acceleration and jerk over the turn, what limits the base circle, and the curve
x(s) with the tangents behind which the cam's centre lies.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.cams.base import Rolled, Translating, lifts_of, region
from graphplan.cams.forces import LoadedCam
from graphplan.cams.law import HARD, SOFT, LawPiece
from graphplan.cams.profile import Cam
from graphplan.kernel.program import Panel
from graphplan.output.graphs import AXIS, CURVES, DIVISION, Figures, Graph, scale_words
from graphplan.output.tolerances import BASE_TOL, OFFSET_TOL, RANGE_TOL, STILL_RATE
from graphplan.phrases import Said, arrange, digits, phrase, said, unit
from graphplan.sheet.layout.scales import round_up
from graphplan.sheet.lettering.lettering import CAPS, SIZE, TextRun, sentence_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.view import View, clip_item, fit_scale, view

LAW_PLAN = Panel("law", said("law"), said("Law of the follower over the turn of the cam"))
CENTRE_PLAN = Panel("centre", said("cam centre"), said("Curve x(s): where the cam's centre lies"))
SPRING_PLAN = Panel("spring", said("spring"), said("Spring: what it must push, and its line"))
CURVATURE_PLAN = Panel("centre", said("cam centre"), said("Curve z(s): the smallest base circle of a flat face"))

RISING, RETURNING = phrase("{0}° of the rise"), phrase("{0}° of the return")
JUMP = Pen(0.18, pens.GREY, (1.2, 0.8))
RISE, BACK, TANGENT = Pen(0.35), Pen(0.35, pens.INK, (2.0, 1.0)), Pen(0.25, pens.GREEN, (5.0, 1.0))
BETWEEN, LEFT, RIGHT, FOOT = 5.5, 5.0, 16.0, 7.0  # mm: over a diagram, beside it, and under the last
SAMPLES = 60  # of a curve on a piece of the law
MAX_RADIUS_RATIO = 5.0  # base circles: what is less curved is cut off its diagram
LINE_BEYOND_MM = 12.0  # mm that a line goes on beyond what it joins
MARGIN_SHARE = 0.09  # of the curve's size, left free about it
LABEL_OFF = 1.8  # mm beside the point where a tangent touches, to its words


@dataclass(frozen=True)
class TurnDiagram:
    """A quantity over the turn: its letter, unit and pen, its values at angles on a piece of the law, and of which size
    these are."""

    letter: str
    measure: str
    pen: Pen
    values: Callable[[Any, LawPiece], Any]
    size: float
    order: int = 0


def diagrams(cam: Cam) -> list[TurnDiagram]:
    """The law's four diagrams, and that of the pressure angle, or of the radius of curvature under a flat face."""
    omega, length = cam.task.cam.omega, cam.task.units.length
    turns = cam.task.follower.oscillates
    whole = "rad" if turns else length
    units = "°" if turns else length, *(f"{whole}/s{power}" for power in ("", "²", "³"))
    letters = ("psi", "omega", "epsilon", "j") if turns else ("s", "v", "a", "j")

    def rate(order: int) -> TurnDiagram:
        factor = 1.0 if order == 0 else cam.law.times * omega**order
        return TurnDiagram(letters[order], units[order], CURVES[order], lambda angles,
                           one: factor * one.value_at(angles, order),
                           abs(factor) * lift(cam), order)

    found = [rate(order) for order in range(4)]
    if isinstance(cam.pair, Rolled):
        found.append(TurnDiagram("theta", "°", CURVES[4],
                                 lambda angles, one: np.degrees(cam.contact_on(one, angles).pressure), 1.0))
    else:
        most = MAX_RADIUS_RATIO * cam.pair.base
        found.append(TurnDiagram("rho", length, CURVES[4],
                                 lambda angles, one: np.minimum(cam.contact_on(one, angles).radius, most),
                                 cam.pair.base))
    if cam.task.load:
        loaded = LoadedCam(cam)
        found += [TurnDiagram(letter, measure, CURVES[k], partial(loaded.force_named, name),
                              abs(loaded.largest(name)[1]) or 1.0)
                  for k, (name, letter, measure) in enumerate((("contact", "N", "N"), ("moment", "M_1", "N·m")))]
    return found


def lift(cam: Cam) -> float:
    """The largest lift, as the task gives it."""
    return cam.law.largest(0) / cam.law.times


@dataclass(frozen=True)
class CamFigures(Figures):
    """The figures of a cam."""

    cam: Cam

    # ---- over the turn ---------------------------------------------------------------------------------------------

    def law(self, rect: Rect) -> Iterator[Item]:
        """The diagrams one under the other, over one abscissa."""
        shown = diagrams(self.cam)
        letters = self.letters.text / SIZE  # of large sheets are larger, and the numbers beside the diagrams wider
        room = rect.inset(LEFT, FOOT, RIGHT * letters, 0.0)
        high = room.height / len(shown)
        for k, one in enumerate(shown):
            top = room.top - k * high
            yield from self._diagram(one, Rect(room.left, top - high + 2.0, room.right, top - BETWEEN))
        first, *between, last = (float(bound) for bound in self.cam.law.bounds)
        numbers = list[Text]()
        for bound in (first, last, *between):
            x = room.left + bound / 360 * room.width
            yield Polyline(DIVISION, "ruling", None, ((x, room.bottom + 1.0), (x, room.top - BETWEEN)))
            number = self.text((x, room.bottom - 3.0), digits(bound), "middle")
            if not any(number.box.inset(-0.5, 0.0, -0.5, 0.0).meets(other.box) for other in numbers):
                numbers.append(number)
        yield from numbers
        yield self.text((room.right + 4.0 * letters, room.bottom - 3.0), "φ, °")

    def _diagram(self, one: TurnDiagram, rect: Rect) -> Iterator[Item]:
        """One quantity: axes, its curve piece by piece, its extremes beside it."""
        law = self.cam.law
        parts = [(angles, np.asarray(one.values(angles, piece), float)) for piece in law.stretches
                 for angles in [piece.divide(SAMPLES)]]
        (top, most), (foot, depth) = law.extremum(one.values), law.extremum(lambda a, piece: -one.values(a, piece))
        low, high = min(0.0, -depth), max(0.0, most)
        still = high - low <= RANGE_TOL * one.size
        hard = one.order == SOFT and any(jump.order == HARD for jump in law.jumps)
        if still or hard:
            high = max(high, -low, one.size if still else 0.0)
            low = -high
        graph = Graph.fit_rect(rect, (0.0, 360.0), (low, high))
        at = graph.spot
        yield from self.abscissa(graph)
        yield Polyline(AXIS, "ruling", None, (at(0, low), at(0, high)))
        for angles, part in parts:
            yield Polyline(one.pen, "links", None, tuple(graph.spots(angles, part)))
        for (angles, before), (_, after) in pairwise([*parts, parts[0]]):
            if abs(after[0] - before[-1]) > RANGE_TOL * (high - low):
                x = float(angles[-1])
                yield Polyline(JUMP, "ruling", None, (at(x, float(before[-1])), at(x, float(after[0]))))
        if hard:
            yield from self.shock_arrows(at, high)
        told = "{0} = 0" if still else "{0}, {1}   ({2})"
        scale = scale_words(one.letter, graph.y.unit, one.measure)
        yield self.heading(graph, arrange(told, one.letter, unit(one.measure), scale), (one.letter, f"k_{one.letter}"))
        axis, size, above = at(0.0, 0.0)[1], self.letters.text, math.inf
        for angle, value in ((top, most), (foot, -depth)):
            if abs(value) > RANGE_TOL * (high - low):
                x, y = at(angle, value)
                yield Polyline(DIVISION, "ruling", None, ((x, y), (rect.right + 0.8, y)))
                beside = y if abs(y - axis) > size else axis + math.copysign(size, value)  # clear of the axis
                beside = above = min(beside, above - size)
                yield self.text((rect.right + 1.2, beside - CAPS * size / 2), digits(value))

    def shock_arrows(self, at: Callable[[float, float], Spot], high: float) -> Iterator[Item]:
        """Hard shocks: the acceleration is infinite there."""
        for jump in self.cam.law.jumps:
            if jump.order == HARD:
                angle = float(jump.angle)
                tip = at(angle, math.copysign(high, jump.after - jump.before))
                yield Arrow(pens.VECTORS["acceleration"], "ruling", None, at(angle, 0.0), tip, 2.4)
                yield self.text((tip[0] + 0.8, tip[1] - 1.0), (TextRun("∞"),))

    # ---- the spring --------------------------------------------------------------------------------------------------

    def spring(self, rect: Rect) -> Iterator[Item]:
        """What the spring must push over the lift, as the follower rises and returns, and what it pushes: its line
        touches the curve where contact is nearest to being lost, or crosses it where that is lost."""
        loaded = LoadedCam(self.cam)
        c, preload, _, at = loaded.spring
        pieces = [(one.value_at(angles), loaded.lack(angles, one)) for one in self.cam.law.stretches
                  for angles in [one.divide(SAMPLES)]]
        top, bounds = lift(self.cam), [float(bound) for _, lack in pieces for bound in (lack.min(), lack.max())]
        ends = preload, preload + c * top
        span = min(0.0, *bounds), max(*ends, *bounds)
        graph = Graph.fit_rect(rect.inset(LEFT + RIGHT / 2, FOOT, RIGHT, BETWEEN), (0.0, top), span)
        yield from self.ordinate(graph)
        yield from self.abscissa(graph, "s")
        yield from self.numbered_x(graph)
        yield from self.numbered_y(graph)
        for s, lack in pieces:
            yield from graph.curve(s, lack, RISE if s[-1] >= s[0] else BACK)
        if any(ends):
            yield from graph.curve((0.0, top), ends, TANGENT)
            touched = float(self.cam.law.value_at([at])[0])
            yield from graph.points((touched,), (preload + c * touched,), pens.ORIGIN)
            x, y = graph.spot(top, ends[1])
            yield self.text((x + 1.2, y), "T")
        scale = scale_words("T", graph.y.unit, "N")
        yield self.heading(graph, arrange("−Q − m·a; T = T_0 + c·s, {0}   ({1})", unit("N"), scale), ("T_0", "k_T"))

    # ---- where the centre lies -------------------------------------------------------------------------------------

    def centre(self, rect: Rect) -> Iterator[Item]:
        """The curve x(s) of a point or roller, or z(s) of a flat face on a straight path."""
        yield from self._curve_x(rect) if isinstance(self.cam.pair, Rolled) else self._curve_z(rect)

    @cached_property
    def laid_off_ends(self) -> list[tuple[LawPiece, Any, Any]]:
        """Of each piece of the law the follower's points A, and the ends of x laid off from them."""
        found = []
        for one in self.cam.law.stretches:
            pair: Any = self.cam.pair
            A, A1, *_ = pair.path(lifts_of(self.cam.law, one, one.divide(SAMPLES)))
            found.append((one, A, A + 1j * pair.sense * A1))
        return found

    def _window(self, spots: Sequence[complex], rect: Rect, beside: float = 0.0) -> View:
        """A view that holds these places, at a round scale, with so much room beside them at least."""
        box = bounding_box([(z.real, z.imag) for z in spots])
        margin = MARGIN_SHARE * min(rect.width, rect.height)
        beside = max(beside, margin)
        room = rect.inset(beside, margin, beside, margin)
        return view(box, room, float(round_up(fit_scale(box, room))))

    def _curve_x(self, rect: Rect) -> Iterator[Item]:
        """The follower's path with x laid off, the curve of its ends, the tangents, and the centre."""
        pieces = self.laid_off_ends
        spots = [complex(z) for _, A, E in pieces for z in (*A, *E)] + [0j]
        labels = (sentence_runs(self.tongue(words("88.88"))) for words in (RISING, RETURNING))
        window = self._window(spots, rect, LABEL_OFF + max(width(runs, self.letters.text) for runs in labels))
        yield self._scale_label(window, rect)

        def at(z: complex) -> Spot:
            return window((z.real, z.imag))

        yield Polyline(AXIS, "ruling", None, tuple(at(complex(z)) for _, A, _ in pieces for z in A))
        for one, A, E in pieces:
            moving = one.value_at((float(one.start) + float(one.end)) / 2, 1)
            if abs(moving) <= STILL_RATE * lift(self.cam):
                continue
            pen = RISE if moving > 0 else BACK
            for k in range(0, SAMPLES + 1, 10):
                yield Polyline(pens.THIN, "plates", None, (at(complex(A[k])), at(complex(E[k]))))
            yield Polyline(pen, "links", None, tuple(at(complex(z)) for z in E))
        A0 = at(complex(pieces[0][1][0]))
        yield Polyline(pens.THIN, "plates", None, (at(0j), A0))
        yield from self.limit_tangents(at, rect) if self.has_limits else self.touching_lines(at, rect)
        yield from self.draw_point(A0, "A_0", (1.4, -3.0))
        yield from self.draw_point(at(0j), "O", (-1.4, -3.0))

    @property
    def has_limits(self) -> bool:
        """Whether there are tangents at angles that are given."""
        return isinstance(self.cam.pair, Translating) and self.cam.task.cam.limits is not None

    def limit_tangents(self, at: Callable[[complex], Spot], rect: Rect) -> Iterator[Item]:
        """The tangents at the largest pressure angles, behind which the centre lies, and where both meet."""
        pair, limits = self.cam.pair, self.cam.task.cam.limits
        assert isinstance(pair, Translating)
        assert limits is not None
        where = region(self.cam.law, limits)

        def spot(x: float, s: float) -> Spot:
            """A place by x, laid off from the path, and by its height over A0."""
            return at(complex(pair.sense * (pair.offset - x), pair.depth + s))

        for one, way, words in ((where.rise, 1, RISING), (where.back, -1, RETURNING)):
            if one is not None:
                top, foot = (spot(way * (one.intercept + one.slope * s), s) for s in (
                    float(max(self.cam.law.lifts)), -1.3 * pair.depth))
                yield from clip_item(Polyline(TANGENT, "plates", None, (top, foot)), rect)
                high = float(self.cam.law.value_at([one.angle])[0])
                tip = spot(way * (one.intercept + one.slope * high), high)
                yield from self.touch_label(tip, words(digits(math.degrees(math.atan(one.slope)))), spot(0.0, high)[0])
        if where.back is not None and abs(where.corner[0] - pair.offset) > OFFSET_TOL * pair.base:
            yield from self.draw_point(spot(where.corner[0], -where.corner[1]), "O_m", (1.6, 0.6))

    def touch_label(self, tip: Spot, words: Said, axis: float) -> Iterator[Item]:
        """Where a tangent touches the curve, with its angle, away from the path."""
        side = 1 if tip[0] >= axis else -1
        yield Circle(pens.ORIGIN, "plates", None, tip, 0.5)
        yield self.text((tip[0] + LABEL_OFF * side, tip[1] - 3.2), words, "start" if side > 0 else "end")

    def touching_lines(self, at: Callable[[complex], Spot], rect: Rect) -> Iterator[Item]:
        """The lines from the centre that touch the curve, where the pressure angle is largest."""
        pair: Any = self.cam.pair
        for way, words in ((1, RISING), (-1, RETURNING)):
            angle, size = self.cam.steepest[way]
            piece = next((one for one in self.cam.law.stretches if way * one.value_at(angle, 1) > 0
                          and one.start <= angle <= one.end), None)
            if piece is None or size <= 0:
                continue
            A, A1, *_ = pair.path(lifts_of(self.cam.law, piece, angle))
            start, tip = at(0j), at(complex(A + 1j * pair.sense * A1))
            length = math.dist(start, tip) or 1.0
            dx, dy = (LINE_BEYOND_MM * (there - here) / length for here, there in zip(start, tip, strict=True))
            far = tip[0] + dx, tip[1] + dy
            yield from clip_item(Polyline(TANGENT, "plates", None, (start, far)), rect)
            yield from self.touch_label(tip, words(digits(size)), at(complex(A))[0])

    def _curve_z(self, rect: Rect) -> Iterator[Item]:
        """The curve of s over z = s'', and its tangent of 45 degrees, which cuts the path in the least centre."""
        pieces = [(one, one.value_at(angles), one.value_at(angles, 2)) for one in self.cam.law.stretches
                  for angles in [one.divide(SAMPLES)]]
        base = self.cam.pair.base
        lowest = max(float((-(s + z)).max()) for _, s, z in pieces)
        spots = [complex(x, y) for _, s, z in pieces for x, y in zip(z, s, strict=True)] + [complex(0, -base), 0j]
        window = self._window(spots, rect)
        yield self._scale_label(window, rect)
        for one, s, z in pieces:
            pen = BACK if one.value_at((float(one.start) + float(one.end)) / 2, 1) < 0 else RISE
            pairs = zip(map(float, z), map(float, s), strict=True)
            yield Polyline(pen, "links", None, tuple(map(window, pairs)))
        O, A0, limit = window((0.0, -base)), window((0.0, 0.0)), window((0.0, -lowest))
        yield Polyline(AXIS, "ruling", None, (O, window((0.0, max(float(s.max()) for _, s, _ in pieces)))))
        reach = max(-float(z.min()) for _, s, z in pieces)
        end = window((-reach, reach - lowest))
        yield from clip_item(Polyline(TANGENT, "plates", None, (limit, end)), rect)
        yield self.text(((limit[0] + end[0]) / 2 - 2.0, (limit[1] + end[1]) / 2 - 2.0), "45°", "end")
        yield from self.draw_point(A0, "A_0")
        yield from self.draw_point(O, "O", (1.4, -2.8))
        if abs(base - lowest) > BASE_TOL * base:
            yield from self.draw_point(limit, "O'", (1.4, -1.0))

    def _scale_label(self, window: View, rect: Rect) -> Item:
        """The scale of a figure, in its corner."""
        told = scale_words("s", 1 / window.scale, self.cam.task.units.length)
        return self.text((rect.left + 2.0, rect.bottom + 2.0), told)
