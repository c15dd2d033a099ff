"""The sheet of a cam, with the diagrams of its law.

On the plan stands what each step of the inversion draws, the profile over it, and the follower where it is lowest.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

import numpy as np

from graphplan.cams.base import FlatOscillating, Rolled, Translating, lifts_of, region
from graphplan.cams.construction import CAM_PLAN, CamDrawing
from graphplan.cams.exports import scene_text
from graphplan.cams.law import DWELL, HARD, SOFT, LawPiece
from graphplan.cams.profile import Cam, LoadedCam
from graphplan.kernel.kinds import POINT
from graphplan.kernel.passes import Values
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.output.graphs import AXIS, CURVES, DIVISION, Figures, Graph, scale_words
from graphplan.output.panelled import Panelled, check_words, divide_across, divide_down
from graphplan.output.tolerances import BASE_TOL, OFFSET_TOL, RANGE_TOL, STILL_RATE
from graphplan.phrases import Said, arrange, digits, phrase, said, unit
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.lettering import CAPS, SIZE, LetterSizes, TextRun, sentence_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plate, plate_of_values
from graphplan.sheet.plates.view import View, clip_item, fit_scale, view
from graphplan.words.tongue import ENGLISH

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

    @property
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


CIRCLES = "base", "offsets", "pivots"  # roles of circles about the cam's centre
PIN = 1.3  # mm: radius of fixed pins
MIN_LETTER_MM = 12.0  # mm from the cam's centre: a letter there would be on others
FACE_BEYOND_MM = 7.0  # mm of a flat face beyond its marks
NUMBER_GAP_MM = 4.0  # mm from the follower to the number of its division
STEM, HALF, TEETH = 14.0, 2.2, 6  # mm: of the follower beyond what touches, of its guide; strokes of hatching
PROFILE, PITCH, ROLLER = Pen(0.7), pens.PATH, Pen(0.13, pens.GREY)
FIRST, BASE = Pen(0.5), Pen(0.25, pens.INK, (5.0, 1.0))


@dataclass(frozen=True)
class CamPlan:
    """The plan in its panel: `view` takes lengths to mm of paper."""

    drawing: CamDrawing
    view: View
    scene: Scene
    letters: LetterSizes

    @cached_property
    def ink(self) -> Plate:
        """What the steps draw: the circles that are rolled on are drawn whole, faces go beyond their marks."""
        roles = self.drawing.values.drawing.roles
        whole = {step: BASE for name in CIRCLES for step in roles.get(name, ())}
        whole |= dict.fromkeys(roles.get("roller", ()), ROLLER)
        faces = dict.fromkeys(roles.get("face", ()), FACE_BEYOND_MM)
        return plate_of_values(self.drawing.values, CAM_PLAN, self.view, self.scene, self.letters, whole=whole,
                               beyond=faces)

    def items(self) -> Iterator[Item]:
        """All of it."""
        yield from self.ink.items()
        yield from self.cam_items()
        yield from self._follower()
        yield from self.letter_items()

    # ---- what is made ----------------------------------------------------------------------------------------------

    def _spot(self, z: complex) -> Spot:
        return self.view((z.real, z.imag))

    def cam_items(self) -> Iterator[Item]:
        """The path of the roller's centre, the profile, the cam's pin, and the way that it turns."""
        cam = self.drawing.cam
        if cam.roller:
            yield Polygon(PITCH, "motion", None, tuple(map(self._spot, cam.pitch_curve)))
        yield Polygon(PROFILE, "links", None, tuple(map(self._spot, cam.outline)))
        O = self._spot(0j)
        yield Circle(pens.PAIR, "pairs", None, O, PIN)
        yield from self.frame_hatching(O, (0.0, -1.0), PIN)
        radius, sense = 8.0, cam.pair.sense
        low, high = (200.0, 320.0) if sense > 0 else (220.0, 340.0)
        turn = Arc(pens.DRIVE, "drive", None, O, radius, low, high)
        yield turn
        tip, back = (turn.spot_at(high), turn.spot_at(high - 20)) if sense > 0 else (turn.spot_at(low),
                                                                                     turn.spot_at(low + 20))
        yield Arrow(pens.DRIVE, "drive", None, back, tip, 3.0)

    def frame_hatching(self, at: Spot, down: Spot, off: float) -> Iterator[Item]:
        """The frame at a spot: a line with strokes behind it, so far off."""
        ux, uy = -down[1], down[0]
        x, y = at[0] + down[0] * (off + 1.2), at[1] + down[1] * (off + 1.2)
        half = 2 * HALF
        yield Polyline(pens.GROUND, "ground", None, ((x - half * ux, y - half * uy), (x + half * ux, y + half * uy)))
        for k in range(TEETH):
            t = -half + 2 * half * (k + 0.5) / TEETH
            start = x + t * ux, y + t * uy
            yield Polyline(pens.HATCH, "ground", None,
                           (start, (start[0] + 1.4 * (down[0] - 0.6 * ux), start[1] + 1.4 * (down[1] - 0.6 * uy))))

    def _follower(self) -> Iterator[Item]:
        """The follower where it is lowest, and what holds it."""
        drawing, cam = self.drawing, self.drawing.cam
        A = self._spot(drawing.positions("A")[0])
        K = self._spot(drawing.positions("K")[0])
        if cam.roller:
            yield Circle(FIRST, "blocks", None, A, cam.roller * self.view.scale)
        if cam.task.follower.oscillates:
            B = self._spot(drawing.positions("B")[0])
            tip = K if cam.task.follower.flat else A
            beyond = 1.25 if cam.task.follower.flat else 1.0
            end = B[0] + beyond * (tip[0] - B[0]), B[1] + beyond * (tip[1] - B[1])
            yield Polyline(FIRST, "blocks", None, (B, end))
            yield Circle(pens.PAIR, "pairs", None, B, PIN)
            yield from self.frame_hatching(B, (0.0, -1.0), PIN)
            return
        highest = max(float(cam.law.value_at(angle)) for angle in drawing.angles) + cam.roller
        top = A[0], A[1] + STEM + highest * self.view.scale
        yield Polyline(FIRST, "blocks", None, (A, top))
        if cam.task.follower.flat:
            low, high = (part * self.view.scale for part in cam.reach)
            yield Polyline(FIRST, "blocks", None, ((A[0] - high - 2, A[1]), (A[0] - low + 2, A[1])))
        middle = top[0], top[1] - STEM / 3
        for side in (-1.0, 1.0):
            yield from self.frame_hatching(middle, (side, 0.0), -0.4)
        if not cam.task.follower.flat:
            yield Circle(pens.PAIR, "pairs", None, A, 0.7)

    # ---- names -----------------------------------------------------------------------------------------------------

    def letter_items(self) -> Iterator[Item]:
        """The numbers of the divisions outside, and the letters of one division and of what is drawn once."""
        drawing, cam, O = self.drawing, self.drawing.cam, self._spot(0j)
        paper = Figures(self.letters, ENGLISH)  # letters and numbers are the same in all tongues
        spots = [self._spot(z) for z in drawing.positions("A")]
        far = drawing.cam.roller * self.view.scale
        for k, (x, y) in enumerate(spots):
            if not k and not cam.task.follower.oscillates:
                continue  # there the follower stands
            long = math.dist((x, y), O) or 1.0
            part = 1 + (far + NUMBER_GAP_MM) / long
            yield from paper.backed_text((O[0] + part * (x - O[0]), O[1] + part * (y - O[1])), str(k), middle=True)
        yield from paper.backed_text((O[0] - 5.5, O[1] + 1.4), "O", self.letters.mark)
        shown = self.lettered_division
        for name, (dx, dy) in {"A": (1.2, 1.0), "K": (1.0, -3.4), "P": (0.8, 1.0), "T": (0.8, 1.0),
                               "B": (2.0, 1.4), "S": (2.0, 0.0)}.items():
            step = next((step for step in drawing.values.drawing.program.steps if step.name == f"{name}_{shown}"), None)
            if step is not None:
                x, y = self.ink.plates.steps[step.index].spot
                if math.dist((x, y), O) > MIN_LETTER_MM:
                    yield from paper.backed_text((x + dx, y + dy), step.name, self.letters.mark)

    @property
    def lettered_division(self) -> int:
        """The division of which the letters stand: where the follower rises fastest."""
        rates = self.drawing.cam.law.value_at(self.drawing.angles, 1)
        return max(range(len(rates)), key=lambda k: float(rates[k]))


def extent(drawing: CamDrawing) -> Rect:
    """What the plan takes up, in lengths, from its marks, circles and curves."""
    cam = drawing.cam
    spots = [(z.real, z.imag) for curve in (cam.outline, cam.pitch_curve) for z in curve]
    spots += [drawing.values[step.index] for step in drawing.values.drawing.program.steps if step.op.gives == POINT]
    for name in CIRCLES:
        for x, y, square in drawing.values.values_of_role(name) if name in drawing.values.drawing.roles else ():
            r = math.sqrt(square)
            spots += [(x - r, y - r), (x + r, y + r)]
    box = bounding_box(spots)
    return box.inset(-cam.roller, -cam.roller, -cam.roller, -cam.roller)


DOCUMENT = said("Cam sheet")
MOVED = {"uniform": said("uniform"), "parabolic": said("parabolic"), "harmonic": said("harmonic"), "sine": said("sine"),
         "trapezoid": said("trapezoid"), "3-4-5": said("polynomial 3-4-5"), "table": said("by a table")}
MOVES = {"translating": said("translating"), "oscillating": said("oscillating")}
CONTACTS = {"point": said("point"), "roller": said("roller"), "flat": said("flat face")}
PLAN_MARGIN_MM = 9.0  # mm about the plan
PLAN_WIDE, PLAN_HIGH = 0.6, 0.64  # of the room beside the words: the plan; above the curve x(s)
CURVE_WIDE = 0.55  # of the room under the plan: the curve x(s), where the spring's line stands beside it


@dataclass(frozen=True)
class CamSheet(Panelled):
    """One cam on one paper."""

    drawing: CamDrawing
    check: dict[str, float]
    document = DOCUMENT
    repetition_note = phrase("Steps {0} to {1}: the same at the other divisions.")

    @cached_property
    def scene(self) -> Scene:
        """The cam as it stands at first, with the title and the sheet of the task."""
        task = self.drawing.cam.task
        return replace(parse(scene_text(self.drawing.cam, 0.0), task.name), title=task.title, sheet=task.sheet)

    @property
    def description(self) -> Said:
        program = self.drawing.values.drawing.program
        return said("Cam by inversion in {0} steps.", len(program) - program.givens)

    @property
    def values(self) -> Values:
        return self.drawing.values

    @property
    def scales(self) -> Scales:
        task = self.drawing.cam.task
        return Scales(self.k_s, 1.0, task.units.length, {}, convention=task.sheet.convention)

    @property
    def scale(self) -> Said:
        return ratio(self.k_s, self.drawing.cam.task.units.length)

    @cached_property
    def k_s(self) -> float:
        """Lengths for a mm of the plan, in a round scale."""
        return float(round_up(fit_scale(extent(self.drawing), self.room(CAM_PLAN).inset(*(PLAN_MARGIN_MM,) * 4))))

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        """The plan, under it the curve x(s) if there is one, and beside them the diagrams."""
        left, law = divide_across(room, PLAN_WIDE, 1 - PLAN_WIDE)
        if isinstance(self.drawing.cam.pair, FlatOscillating):
            return {CAM_PLAN: left, LAW_PLAN: law}
        plan, centre = divide_down(left, PLAN_HIGH, 1 - PLAN_HIGH)
        spring = {}
        if self.drawing.cam.task.load:
            centre, spring[SPRING_PLAN] = divide_across(centre, CURVE_WIDE, 1 - CURVE_WIDE)
        return {CAM_PLAN: plan, **spring, LAW_PLAN: law,
                CENTRE_PLAN if isinstance(self.drawing.cam.pair, Rolled) else CURVATURE_PLAN: centre}

    def figure(self, panel: Panel, rect: Rect) -> Iterator[Item]:
        """The plan, the diagrams over the turn, or the curve."""
        if panel == CAM_PLAN:
            return CamPlan(self.drawing, view(extent(self.drawing), rect, self.k_s), self.scene, self.letters).items()
        figures = CamFigures(self.letters, self.tongue, self.drawing.cam)
        return {LAW_PLAN: figures.law, SPRING_PLAN: figures.spring}.get(panel, figures.centre)(rect)

    def given_words(self) -> Iterator[Said]:
        """The law, stage by stage, the follower, and how the cam turns."""
        cam = self.drawing.cam
        task, length = cam.task, unit(cam.task.units.length)
        for low, high, stage in zip(cam.law.bounds, cam.law.bounds[1:], task.stages, strict=False):
            ends = digits(float(low)), digits(float(high))
            if stage.motion == DWELL:
                yield said("{0}° to {1}°: dwell", *ends)
            else:
                stroke = arrange("{0}°" if task.follower.oscillates else "{0} {1}", digits(float(stage.stroke)), length)
                yield said("{0}° to {1}°: {2}, {3}", *ends, MOVED[stage.motion], stroke)
        yield said("Follower: {0}, {1}", MOVES[task.follower.moves], CONTACTS[task.follower.contact])
        for words, value in ((said("radius of the roller"), task.follower.radius), (said("arm"), task.follower.arm),
                             (said("centre distance"), task.follower.distance)):
            if value:
                yield arrange("{0:capital}: {1} {2}", words, digits(float(value)), length)
        if task.load:
            yield said("Follower: Q = {0} N, m = {1} kg; its guide: overhang {2} {5}, bearings {3} {5} apart, mu = {4}",
                       *map(digits, map(float, task.load[:5])), length)
        turns = said("counter-clockwise") if task.cam.sense > 0 else said("clockwise")
        yield said("The cam turns {0}, {1} {2}", turns, digits(task.cam.omega), unit("rad/s"))

    def result_words(self) -> Iterator[Said]:
        """Base circle, pressure angles, curvature, what is told of the law, and the checks."""
        cam = self.drawing.cam
        length = unit(cam.task.units.length)
        yield said("Base circle: radius {0} {1}", digits(cam.pair.base, 6), length)
        if isinstance(cam.pair, Translating) and cam.pair.offset:
            yield said("Offset: {0} {1}", digits(cam.pair.offset, 6), length)
        if isinstance(cam.pair, Rolled):
            names = {1: said("rise"), -1: said("return")}
            for way, (angle, size) in cam.steepest.items():
                yield said("Largest pressure angle of the {0}: {1}° at {2}°", names[way], digits(size), digits(angle))
        angle, size = cam.narrowest
        where = said("path of the roller's centre") if cam.roller else said("profile")
        yield said("Smallest radius of curvature of the {0}: {1} {2} at {3}°", where, digits(size), length,
                   digits(angle))
        if cam.task.follower.flat:
            low, high = cam.reach
            yield said("The contact wanders from {0} to {1} {2} along the face", digits(low), digits(high), length)
        if cam.task.load:
            yield from self._load_words(LoadedCam(cam))
        for note in cam.notes:
            yield arrange("{0:capital}", note)
        yield check_words(self.check)

    def _load_words(self, loaded: LoadedCam) -> Iterator[Said]:
        """The spring, the largest forces, what friction takes, and from which pressure angle on the follower jams."""
        c, preload, least, nearest = loaded.spring
        yield said("Spring: c = {0} N/{4}, T_0 = {1} N; at least {2} N for contact, most needed at {3}°",
                   *map(digits, (c, preload, max(least, 0.0), nearest)), unit(loaded.cam.task.units.length))
        if not loaded.keeps_contact:
            yield said("The follower leaves the cam.")
        yield said("Largest contact force: {1} N at {0}°", *map(digits, loaded.largest("contact")))
        yield said("Largest moment on the cam: {1} N·m at {0}°", *map(digits, loaded.largest("moment")))
        if loaded.coefficient:
            yield said("Friction in the guide takes {0} J in a turn.", digits(loaded.work_lost))
            at, _ = loaded.law.extremum(loaded.jamming)
            if not loaded.cam.task.follower.flat:
                yield said("At {0}° the follower would jam from a pressure angle of {1}° on.", digits(at),
                           digits(loaded.jamming_angle(at)))
