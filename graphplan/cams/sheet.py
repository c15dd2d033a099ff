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
from graphplan.cams.tolerances import JUMP_TOL, LENGTH_TOL, OFFSET_TOL, STILL_RATE
from graphplan.kernel.kinds import POINT
from graphplan.kernel.program import Panel
from graphplan.mechanism.scene import parse
from graphplan.phrases import Said, arrange, digits, join, phrase, said, unit
from graphplan.sheet.diagrams import (
    AXIS,
    CURVES,
    DIVISION,
    Diagram,
    DrawnCurve,
    Frame,
    Label,
    QuantityAxis,
)
from graphplan.sheet.layout.scales import Scales, ratio, scale_words
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import CAPS, SIZE, name_runs, sentence_runs
from graphplan.sheet.panels import (
    SAME_AT_DIVISIONS,
    PanelFigure,
    PanelPage,
    PanelSheet,
    check_words,
    column,
    fit_view,
    row,
)
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Arrow, Circle, Item, Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plate, plate_of_values
from graphplan.sheet.plates.view import View, interpolate

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
WORDS_BESIDE_MM = 25.0  # mm beside the curve x(s) for the words on its tangents
PLAN_MARGIN_MM = 9.0  # mm about the plan
PLAN_WIDE, PLAN_HIGH = 0.6, 0.64  # of the room beside the words: the plan; above the curve x(s)
CURVE_WIDE = 0.55  # of the room under the plan: the curve x(s), where the spring's line stands beside it
MOVED = {"uniform": said("uniform"), "parabolic": said("parabolic"), "harmonic": said("harmonic"), "sine": said("sine"),
         "trapezoid": said("trapezoid"), "3-4-5": said("polynomial 3-4-5"), "table": said("by a table")}
MOVES = {"translating": said("translating"), "oscillating": said("oscillating")}
CONTACTS = {"point": said("point"), "roller": said("roller"), "flat": said("flat face")}


def cam_sheet(paper: str, drawing: CamDrawing, check: dict[str, float]) -> PanelSheet:
    """The sheet of a cam: the plan, under it the curve x(s) if there is one, and beside them the diagrams."""
    cam, task = drawing.cam, drawing.cam.task
    law = 1 - PLAN_WIDE, LAW_PLAN
    centre = CENTRE_PLAN if isinstance(cam.pair, Rolled) else CURVATURE_PLAN
    curves: dict[Panel, Callable[[CamFigures], PanelFigure]] = {centre: CamFigures.centre} \
        if not isinstance(cam.pair, FlatOscillating) else {}
    if curves and task.load:
        curves[SPRING_PLAN] = CamFigures.spring
    shares = (CURVE_WIDE, 1 - CURVE_WIDE) if len(curves) > 1 else (1.0,)
    plans = (PLAN_HIGH, CAM_PLAN), (1 - PLAN_HIGH, row(*zip(shares, curves, strict=True)))
    # the cam as it stands at first, with the title and the sheet of the task
    scene = replace(parse(scene_text(cam, 0.0), task.name), title=task.title, sheet=task.sheet)
    page = PanelPage(paper, scene, row((PLAN_WIDE, column(*plans) if curves else CAM_PLAN), law))
    window = fit_view(extent(drawing), page.room(CAM_PLAN), PLAN_MARGIN_MM)
    figures = CamFigures(cam, page)
    program, words = drawing.values.drawing.program, CamWords(cam)
    return PanelSheet(
        page, said("Cam sheet"), said("Cam by inversion in {0} steps.", len(program) - program.givens), drawing.values,
        ratio(1 / window.scale, task.units.length),
        {CAM_PLAN: CamPlan(drawing, window, page).figure, LAW_PLAN: figures.law(),
         **{panel: draw(figures) for panel, draw in curves.items()}},
        Scales(1 / window.scale, 1.0, task.units.length, {}, convention=task.sheet.convention),
        given=[*words.given_words()], found=[*words.found_words(check)], repetition_note=SAME_AT_DIVISIONS)


# ---- diagrams over the turn -----------------------------------------------------------------------------------------

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

    rates = [rate(order) for order in range(4)]
    if isinstance(cam.pair, Rolled):
        rates.append(TurnDiagram("theta", "°", CURVES[4],
                                 lambda angles, one: np.degrees(cam.contact_on(one, angles).pressure), 1.0))
    else:
        most = MAX_RADIUS_RATIO * cam.pair.base
        rates.append(TurnDiagram("rho", length, CURVES[4],
                                 lambda angles, one: np.minimum(cam.contact_on(one, angles).radius, most),
                                 cam.pair.base))
    if cam.task.load:
        loaded = LoadedCam(cam)
        rates += [TurnDiagram(letter, measure, CURVES[k], partial(loaded.force_named, name),
                              abs(loaded.largest(name)[1]) or 1.0)
                  for k, (name, letter, measure) in enumerate((("contact", "N", "N"), ("moment", "M_1", "N·m")))]
    return rates


def lift(cam: Cam) -> float:
    """The largest lift, as the task gives it."""
    return cam.law.largest(0) / cam.law.times


@dataclass(frozen=True)
class CamFigures:
    """The figures of a cam beside its plan."""

    cam: Cam
    page: PanelPage

    # ---- over the turn ---------------------------------------------------------------------------------------------

    def law(self) -> PanelFigure:
        """The diagrams one under the other, over one abscissa: the bounds of the law's stages are numbered."""
        rect, shown = self.page.room(LAW_PLAN), diagrams(self.cam)
        letters = self.page.letters.text / SIZE  # of large sheets are larger, and the numbers beside the diagrams wider
        room = rect.inset(LEFT, FOOT, RIGHT * letters, 0.0)
        high, stack, shocks = room.height / len(shown), list[Diagram](), list[Item]()
        for k, quantity in enumerate(shown):
            top = room.top - k * high
            stack.append(self._diagram(quantity, Rect(room.left, top - high + 2.0, room.right, top - BETWEEN)))
            if quantity.order == SOFT:
                shocks += self._shocks(stack[-1].frame)
        bounds = [float(bound) for bound in self.cam.law.bounds]
        first, last = stack[0].frame.rect, stack[-1]
        stack[0] = replace(stack[0], uprights=bounds, uprights_down=first.bottom - last.frame.rect.bottom)
        stack[-1] = replace(stack[-1], x=QuantityAxis(
            "φ", label=arrange("φ, °"), values=[bounds[0], bounds[-1], *bounds[1:-1]],
            shift=(RIGHT * letters, 2.4 * self.page.letters.text - 1.6)))
        return PanelFigure(rect, stack, strokes=shocks)

    def _diagram(self, quantity: TurnDiagram, rect: Rect) -> Diagram:
        """One quantity: its curve piece by piece with its jumps, and its extremes beside it."""
        law = self.cam.law
        samples = [(angles, np.asarray(quantity.values(angles, piece), float)) for piece in law.stretches
                 for angles in [piece.divide(SAMPLES)]]
        (top, most), (foot, depth) = (law.extremum(values) for values in (
            quantity.values, lambda a, piece: -quantity.values(a, piece)))
        low, high = min(0.0, -depth), max(0.0, most)
        still = high - low <= JUMP_TOL * quantity.size
        if still or (quantity.order == SOFT and self._hard):
            high = max(high, -low, quantity.size if still else 0.0)
            low = -high
        frame, least = Frame.fit_rect(rect, (0.0, 360.0), (low, high)), JUMP_TOL * (high - low)
        curves = [DrawnCurve(*piece, quantity.pen) for piece in samples]
        curves += [DrawnCurve((angles[-1],) * 2, (before[-1], after[0]), JUMP) for (angles, before), (_, after) in
                   pairwise([*samples, samples[0]]) if abs(after[0] - before[-1]) > least]
        size, above, labels = self.page.letters.text, math.inf, list[Label]()
        for angle, value in ((top, most), (foot, -depth)):
            if abs(value) > least:
                curves.append(DrawnCurve((angle, 360.0), (value, value), DIVISION))
                y = value / frame.y.unit  # mm over the axis
                beside = y if abs(y) > size else math.copysign(size, value)  # clear of the axis
                beside = above = min(beside, above - size)
                labels.append(Label(360.0, value, digits(value), (1.2, beside - y - CAPS * size / 2)))
        label = arrange("{0} = 0", quantity.letter) if still else None
        return Diagram(frame, QuantityAxis(numbers=False),
                       QuantityAxis(quantity.letter, quantity.measure, numbers=False, head=False, label=label), curves,
                       labels)

    @property
    def _hard(self) -> bool:
        """Return True if there are hard shocks."""
        return any(jump.order == HARD for jump in self.cam.law.jumps)

    def _shocks(self, frame: Frame) -> Iterator[Item]:
        """Hard shocks: the acceleration is infinite there."""
        high = frame.y.span(frame.upright)[1]
        for jump in self.cam.law.jumps:
            if jump.order == HARD:
                angle = float(jump.angle)
                tip = frame.spot(angle, math.copysign(high, jump.after - jump.before))
                yield Arrow(pens.VECTORS["acceleration"], "ruling", None, frame.spot(angle, 0.0), tip, 2.4)
                yield self.page.text.text((tip[0] + 0.8, tip[1] - 1.0), "∞")

    # ---- the spring --------------------------------------------------------------------------------------------------

    def spring(self) -> PanelFigure:
        """The force needed over the lift, as the follower rises and returns, and that of the spring: its line
        touches the curve where contact is nearest to being lost, or crosses it where that is lost."""
        loaded, rect = LoadedCam(self.cam), self.page.room(SPRING_PLAN)
        c, preload, _, at = loaded.spring
        pieces = [(stretch.value_at(angles), loaded.lack(angles, stretch)) for stretch in self.cam.law.stretches
                  for angles in [stretch.divide(SAMPLES)]]
        top, bounds = lift(self.cam), [float(bound) for _, lack in pieces for bound in (lack.min(), lack.max())]
        ends = preload, preload + c * top
        frame = Frame.fit_rect(rect.inset(LEFT + RIGHT / 2, FOOT, RIGHT, BETWEEN), (0.0, top),
                               (min(0.0, *bounds), max(*ends, *bounds)))
        curves = [DrawnCurve(s, lack, RISE if s[-1] >= s[0] else BACK) for s, lack in pieces]
        if any(ends):
            touched = float(self.cam.law.value_at([at])[0])
            curves += [DrawnCurve((0.0, top), ends, TANGENT),
                       DrawnCurve((touched,), (preload + c * touched,), pens.ORIGIN, dots=0.5)]
        heading = arrange("−Q − m·a; T = T_0 + c·s, {0};  {1}", unit("N"),
                       scale_words("T", frame.y.unit, "N", self.page.scene.sheet.convention))
        return PanelFigure(rect, [Diagram(
            frame, QuantityAxis("s", label=join(("s", unit(self.cam.task.units.length)))),
            QuantityAxis("T_0", scale="T", label=heading, head=False), curves,
            [Label(top, ends[1], "T", (1.2, 0.0))] if any(ends) else ())])

    # ---- where the centre lies -------------------------------------------------------------------------------------

    def centre(self) -> PanelFigure:
        """The curve x(s) of a point or roller, or z(s) of a flat face on a straight path."""
        return self._curve_x() if isinstance(self.cam.pair, Rolled) else self._curve_z()

    @property
    def laid_off_ends(self) -> list[tuple[LawPiece, Any, Any]]:
        """Of each piece of the law the follower's points A, and the ends of x laid off from them."""
        words = []
        for one in self.cam.law.stretches:
            pair: Any = self.cam.pair
            A, A1, *_ = pair.path(lifts_of(self.cam.law, one, one.divide(SAMPLES)))
            words.append((one, A, A + 1j * pair.sense * A1))
        return words

    def _window(self, spots: Sequence[complex], beside: float = 0.0) -> View:
        """A view that holds these places, at a round scale, with so much room beside them at least."""
        rect = self.page.room(CENTRE_PLAN)
        margin = MARGIN_SHARE * min(rect.width, rect.height)
        return fit_view(bounding_box([(z.real, z.imag) for z in spots]), rect, margin, max(beside, margin))

    def _figure(self, window: View, items: list[Item], points: dict[str, complex], touched: Sequence[tuple[Spot, Said]]
                ) -> PanelFigure:
        """Strokes, points by their letters, and where tangents touch, with their angles; the scale in the corner."""
        rect, spots = window.rect, {name: window.spot(z) for name, z in points.items()}
        items += [Circle(pens.DOT, "plates", None, spot, 0.6) for spot in spots.values()]
        items += [Circle(pens.ORIGIN, "plates", None, tip, 0.5) for tip, _ in touched]
        wishes = [Wish(name_runs(name), (spot,), 0.8, label=name) for name, spot in spots.items()]
        wishes += [Wish(sentence_runs(self.page.tongue(words)), (tip,), 0.8, True, label=words)
                   for tip, words in touched]
        scale = scale_words("s", 1 / window.scale, self.cam.task.units.length, self.page.scene.sheet.convention)
        items.append(self.page.text.text((rect.left + 2.0, rect.bottom + 2.0), scale))
        return PanelFigure(rect, strokes=items, wishes=wishes)

    def _curve_x(self) -> PanelFigure:
        """The follower's path with x laid off, the curve of its ends, the tangents, and the centre."""
        pieces = self.laid_off_ends
        window = self._window([0j, *(complex(z) for _, A, E in pieces for z in (*A, *E))], WORDS_BESIDE_MM)
        at = window.spot
        items: list[Item] = [Polyline(AXIS, "ruling", None, tuple(at(z) for _, A, _ in pieces for z in A))]
        for stretch, A, E in pieces:
            moving = stretch.value_at((float(stretch.start) + float(stretch.end)) / 2, 1)
            if abs(moving) > STILL_RATE * lift(self.cam):
                items += [Polyline(pens.THIN, "plates", None, (at(A[k]), at(E[k]))) for k in range(0, SAMPLES + 1, 10)]
                items.append(Polyline(RISE if moving > 0 else BACK, "links", None, tuple(map(at, E))))
        points = {"A_0": complex(pieces[0][1][0]), "O": 0j}
        items.append(Polyline(pens.THIN, "plates", None, (at(0j), at(points["A_0"]))))
        touched = [*(self._limits(points) if self.has_limits else self._tangents())]
        items += [Polyline(TANGENT, "plates", None, (at(start), at(end + LINE_BEYOND_MM / window.scale * direction)))
                  for start, end, direction, _, _ in touched]
        return self._figure(window, items, points, [(at(tip), words) for *_, tip, words in touched])

    @property
    def has_limits(self) -> bool:
        """Return True if the tangents have given angles."""
        return isinstance(self.cam.pair, Translating) and self.cam.task.cam.limits is not None

    def _limits(self, points: dict[str, complex]) -> Iterator[tuple[complex, complex, complex, complex, Said]]:
        """The tangents at the largest pressure angles, behind which the centre lies: start, end, direction beyond it,
        where they touch, and their angles. Where both meet is one of the `points`."""
        pair, limits = self.cam.pair, self.cam.task.cam.limits
        assert isinstance(pair, Translating)
        assert limits is not None
        where = region(self.cam.law, limits)

        def place(x: float, s: float) -> complex:
            """A place by x, laid off from the path, and by its height over A0."""
            return complex(pair.sense * (pair.offset - x), pair.depth + s)

        for limit, sense, words in ((where.rise, 1, RISING), (where.back, -1, RETURNING)):
            if limit is not None:
                foot, top, tip = (place(sense * (limit.intercept + limit.slope * s), s) for s in (
                    -1.3 * pair.depth, float(max(self.cam.law.lifts)), float(self.cam.law.value_at([limit.angle])[0])))
                yield foot, top, 0j, tip, words(digits(math.degrees(math.atan(limit.slope))))
        if where.back is not None and abs(where.corner[0] - pair.offset) > OFFSET_TOL * pair.base:
            points["O_m"] = place(where.corner[0], -where.corner[1])

    def _tangents(self) -> Iterator[tuple[complex, complex, complex, complex, Said]]:
        """The lines from the centre that touch the curve, where the pressure angle is largest."""
        pair: Any = self.cam.pair
        for sense, words in ((1, RISING), (-1, RETURNING)):
            angle, size = self.cam.steepest[sense]
            piece = next((stretch for stretch in self.cam.law.stretches if sense * stretch.value_at(angle, 1) > 0
                          and stretch.start <= angle <= stretch.end), None)
            if piece is not None and size > 0:
                A, A1, *_ = pair.path(lifts_of(self.cam.law, piece, angle))
                tip = complex(A + 1j * pair.sense * A1)
                yield 0j, tip, tip / (abs(tip) or 1.0), tip, words(digits(size))

    def _curve_z(self) -> PanelFigure:
        """The curve of s over z = s'', and its tangent of 45 degrees, which cuts the path in the least centre."""
        pieces = [(stretch, stretch.value_at(angles, 2) + 1j * stretch.value_at(angles))
                  for stretch in self.cam.law.stretches for angles in [stretch.divide(SAMPLES)]]
        base, curve = self.cam.pair.base, np.concatenate([ends for _, ends in pieces])
        lowest = float((-(curve.imag + curve.real)).max())
        points = {"A_0": 0j, "O": -1j * base}
        window = self._window([*curve, *points.values()])
        at, reach = window.spot, -float(curve.real.min())
        items: list[Item] = [
            Polyline(BACK if stretch.value_at((float(stretch.start) + float(stretch.end)) / 2, 1) < 0 else RISE,
                     "links", None, tuple(map(at, ends))) for stretch, ends in pieces]
        limit, end = at(-1j * lowest), at(complex(-reach, reach - lowest))
        items += [Polyline(AXIS, "ruling", None, (at(points["O"]), at(1j * float(curve.imag.max())))),
                  Polyline(TANGENT, "plates", None, (limit, end)),
                  self.page.text.text(((limit[0] + end[0]) / 2 - 2.0, (limit[1] + end[1]) / 2 - 2.0), "45°", "end")]
        if abs(base - lowest) > LENGTH_TOL * base:
            points["O'"] = -1j * lowest
        return self._figure(window, items, points, ())


# ---- the plan -------------------------------------------------------------------------------------------------------

CIRCLES = "base", "offsets", "pivots"  # roles of circles about the cam's centre
LETTERED = {"A": (1.2, 1.0), "K": (1.0, -3.4), "P": (0.8, 1.0), "T": (0.8, 1.0), "B": (2.0, 1.4),
            "S": (2.0, 0.0)}  # marks of a division that bear letters, and mm from a mark to its letter
MIN_LETTER_MM = 12.0  # mm from the cam's centre: a letter there would be on others
FACE_BEYOND_MM = 7.0  # mm of a flat face beyond its marks
NUMBER_GAP_MM = 4.0  # mm from the follower to the number of its division
STEM, HALF, ROD = 14.0, 4.4, 0.8  # mm: of the follower beyond what touches, half its guide, half the guide's width
PROFILE, PITCH, ROLLER = Pen(0.7), pens.PATH, Pen(0.13, pens.GREY)
FIRST, BASE = Pen(0.5), Pen(0.25, pens.INK, (5.0, 1.0))
DOWN = 0.0, -1.0


@dataclass(frozen=True)
class CamPlan:
    """The plan in its window."""

    drawing: CamDrawing
    window: View
    page: PanelPage

    @property
    def figure(self) -> PanelFigure:
        """All of it, with the numbers of the divisions outside, and the letters of one division."""
        O = self.window.spot(0j)
        return PanelFigure(self.window.rect, plate=self.plate,
                           strokes=[*self._cam(O), *self._follower(), *self._numbers(), *self._letters(O)],
                           is_named=lambda mark: False)

    @cached_property
    def plate(self) -> Plate:
        """The strokes of the steps: the circles that are rolled on are drawn whole, faces go beyond their marks."""
        roles = self.drawing.values.drawing.roles
        whole = {step: BASE for name in CIRCLES for step in roles.get(name, ())}
        whole |= dict.fromkeys(roles.get("roller", ()), ROLLER)
        faces = dict.fromkeys(roles.get("face", ()), FACE_BEYOND_MM)
        return plate_of_values(self.drawing.values, CAM_PLAN, self.window, self.page.scene, self.page.letters,
                               whole=whole, beyond=faces)

    def _cam(self, O: Spot) -> Iterator[Item]:
        """The path of the roller's centre, the profile, the cam's pin, and the way that it turns."""
        cam = self.drawing.cam
        if cam.roller:
            yield Polygon(PITCH, "motion", None, tuple(map(self.window.spot, cam.pitch_curve)))
        yield Polygon(PROFILE, "links", None, tuple(map(self.window.spot, cam.outline)))
        yield from (*symbols.pivot(O, DOWN), symbols.revolute(O))
        yield from symbols.drive(O, (-DOWN[1], 0.0), cam.pair.sense, DOWN)

    def _follower(self) -> Iterator[Item]:
        """The follower where it is lowest, and what holds it."""
        drawing, cam, scale = self.drawing, self.drawing.cam, self.window.scale
        follower = cam.task.follower
        A, K = (self.window.spot(drawing.positions(name)[0]) for name in "AK")
        if cam.roller:
            yield Circle(FIRST, "blocks", None, A, cam.roller * scale)
        if follower.oscillates:
            B, tip, beyond = self.window.spot(drawing.positions("B")[0]), *((K, 1.25) if follower.flat else (A, 1.0))
            yield Polyline(FIRST, "blocks", None, (B, interpolate(B, tip, beyond)))
            yield from (*symbols.pivot(B, DOWN), symbols.revolute(B))
            return
        highest = max(float(cam.law.value_at(angle)) for angle in drawing.angles) + cam.roller
        x, top = A[0], A[1] + STEM + highest * scale
        yield Polyline(FIRST, "blocks", None, (A, (x, top)))
        for side in (-ROD, ROD):
            yield from symbols.ground_line((x + side, top - STEM / 3 - HALF), (x + side, top - STEM / 3 + HALF), -side)
        if follower.flat:
            low, high = (end * scale for end in cam.reach)
            yield Polyline(FIRST, "blocks", None, ((x - high - 2, A[1]), (x - low + 2, A[1])))
        else:
            yield symbols.tracer(A)

    def _numbers(self) -> Iterator[Item]:
        """The numbers of the divisions outside; where the follower stands there is none."""
        cam = self.drawing.cam
        for k, z in enumerate(self.drawing.positions("A")):
            if k or cam.task.follower.oscillates:
                outwards = 1 + cam.roller / (abs(z) or 1.0) + NUMBER_GAP_MM / ((abs(z) or 1.0) * self.window.scale)
                yield from self.page.text.backed_text(self.window.spot(outwards * z), str(k), middle=True)

    def _letters(self, O: Spot) -> Iterator[Item]:
        """The letters of the division at which the follower rises fastest, and of the centre: lines break off at them,
        as there is no free place among so many."""
        text, size = self.page.text, self.page.letters.mark
        fastest = str(int(np.argmax(self.drawing.cam.law.value_at(self.drawing.angles, 1))))
        yield from text.backed_text((O[0] - 5.5, O[1] + 1.4), "O", size)
        for mark in self.plate.steps:
            letter, _, division = mark.name.partition("_")
            if letter in LETTERED and division == fastest and math.dist(mark.spot, O) > MIN_LETTER_MM:
                dx, dy = LETTERED[letter]
                yield from text.backed_text((mark.spot[0] + dx, mark.spot[1] + dy), mark.name, size)


def extent(drawing: CamDrawing) -> Rect:
    """Return the box of the plan, in lengths, from its marks, circles and curves."""
    cam = drawing.cam
    spots = [(z.real, z.imag) for curve in (cam.outline, cam.pitch_curve) for z in curve]
    spots += [drawing.values[step.index] for step in drawing.values.drawing.program.steps if step.op.gives == POINT]
    for name in CIRCLES:
        for x, y, square in drawing.values.values_of_role(name) if name in drawing.values.drawing.roles else ():
            r = math.sqrt(square)
            spots += [(x - r, y - r), (x + r, y + r)]
    box = bounding_box(spots)
    return box.inset(-cam.roller, -cam.roller, -cam.roller, -cam.roller)


# ---- words ----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class CamWords:
    """The words of one sheet."""

    cam: Cam

    def given_words(self) -> Iterator[Said]:
        """The law, stage by stage, the follower, and how the cam turns."""
        cam = self.cam
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

    def found_words(self, check: dict[str, float]) -> Iterator[Said]:
        """Base circle, pressure angles, curvature, what is told of the law, and the checks."""
        cam = self.cam
        length = unit(cam.task.units.length)
        yield said("Base circle: radius {0} {1}", digits(cam.pair.base, 6), length)
        if isinstance(cam.pair, Translating) and cam.pair.offset:
            yield said("Offset: {0} {1}", digits(cam.pair.offset, 6), length)
        if isinstance(cam.pair, Rolled):
            names = {1: said("rise"), -1: said("return")}
            for sense, (angle, size) in cam.steepest.items():
                yield said("Largest pressure angle of the {0}: {1}° at {2}°", names[sense], digits(size), digits(angle))
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
        yield check_words(check)

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
