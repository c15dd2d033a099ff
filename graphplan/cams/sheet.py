"""The sheet of a cam: its plan, the curve x(s), the diagrams, and in a column what is given, found and drawn.

On the plan stands what each step of the inversion draws, the profile over it, and the follower where it is lowest.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from graphplan.cams.base import FlatOscillating, Rolled, Translating
from graphplan.cams.construction import CAM_PLAN, CamDrawing
from graphplan.cams.diagrams import CENTRE_PLAN, CURVATURE_PLAN, LAW_PLAN, SPRING_PLAN, CamFigures
from graphplan.cams.exports import scene_text
from graphplan.cams.forces import LoadedCam
from graphplan.cams.law import DWELL
from graphplan.kernel.drawing import Values
from graphplan.kernel.kinds import POINT
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.output.graphs import Figures
from graphplan.output.panelled import Panelled, check_words, divide_across, divide_down
from graphplan.phrases import Said, arrange, digits, phrase, said, unit
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.lettering import LetterSizes
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Rect, Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plate
from graphplan.sheet.plates.styled_plate import plate_of_values
from graphplan.sheet.plates.view import View, fit_scale, view
from graphplan.words.tongue import ENGLISH

# ---- the plan -------------------------------------------------------------------------------------------------------


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


# ---- the sheet ------------------------------------------------------------------------------------------------------


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
