"""The sheet of a cam: its plan, the curve x(s), the diagrams, and in a column what is given, found and drawn."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from graphplan.cams.construction import CAM_PLAN, CamDrawing
from graphplan.cams.follower import FlatOscillating, Rolled, Translating
from graphplan.cams.motions import DWELL
from graphplan.cams.pose import scene_text
from graphplan.kernel.drawing import Drawing, Values
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.output.cams.diagrams import CENTRE_PLAN, CURVATURE_PLAN, LAW_PLAN, Paper
from graphplan.output.cams.plan import CamPlan, extent
from graphplan.output.panelled import Panelled, beside, pages, under
from graphplan.phrases import Said, arranged, digits, joined, said, unit
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.plates.display import Item, Rect, Sheet
from graphplan.sheet.plates.view import fit_scale, view

DOCUMENT = said("Cam sheet")
MOVED = {"uniform": said("uniform"), "parabolic": said("parabolic"), "harmonic": said("harmonic"), "sine": said("sine"),
         "trapezoid": said("trapezoid"), "3-4-5": said("polynomial 3-4-5"), "table": said("by a table")}
MOVES = {"translating": said("translating"), "oscillating": said("oscillating")}
CONTACTS = {"point": said("point"), "roller": said("roller"), "flat": said("flat face")}
OPINIONS = {"points": said("points"), "motion": said("motion"), "curvature": said("curvature"), "law": said("law")}
OUTSIDE = 9.0  # mm about the plan
PLAN_WIDE, PLAN_HIGH = 0.6, 0.64  # of the room beside the words: the plan; above the curve x(s)


def sheets(drawing: CamDrawing, check: dict[str, float], paper: str | None = None) -> list[Sheet]:
    """The sheet of a cam on the paper named, or on the smallest on which its words have room; see :func:`pages`."""
    return pages(lambda name: CamSheet(name, drawing, check), paper)


@dataclass(frozen=True)
class CamSheet(Panelled):
    """One cam on one paper."""

    drawing: CamDrawing
    check: dict[str, float]
    document = DOCUMENT

    @cached_property
    def scene(self) -> Scene:
        """The cam as it stands at first, with the title and the sheet of the task."""
        task = self.drawing.cam.task
        return replace(parse(scene_text(self.drawing.cam, 0.0), task.name), title=task.title, sheet=task.sheet)

    @property
    def told(self) -> Said:
        program = self.drawing.program
        return said("Cam by inversion in {0} steps.", len(program) - program.givens)

    @property
    def values(self) -> Values:
        return Values(Drawing(self.drawing.program), self.drawing.values)

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
        return float(round_up(fit_scale(extent(self.drawing), self.room(CAM_PLAN).inset(*(OUTSIDE,) * 4))))

    def divided(self, room: Rect) -> dict[Panel, Rect]:
        """The plan, under it the curve x(s) if there is one, and beside them the diagrams."""
        left, law = beside(room, PLAN_WIDE, 1 - PLAN_WIDE)
        if isinstance(self.drawing.cam.pair, FlatOscillating):
            return {CAM_PLAN: left, LAW_PLAN: law}
        plan, centre = under(left, PLAN_HIGH, 1 - PLAN_HIGH)
        return {CAM_PLAN: plan, LAW_PLAN: law,
                CENTRE_PLAN if isinstance(self.drawing.cam.pair, Rolled) else CURVATURE_PLAN: centre}

    def figure(self, panel: Panel, rect: Rect) -> Iterator[Item]:
        """The plan, the diagrams over the turn, or the curve."""
        if panel == CAM_PLAN:
            return CamPlan(self.drawing, view(extent(self.drawing), rect, self.k_s), self.letters).items()
        figures = Paper(self.letters, self.tongue, self.drawing.cam)
        return figures.law(rect) if panel == LAW_PLAN else figures.centre(rect)

    def given(self) -> Iterator[Said]:
        """The law, stage by stage, the follower, and how the cam turns."""
        cam = self.drawing.cam
        task, length = cam.task, unit(cam.task.units.length)
        lifted = unit("°") if task.follower.oscillates else length
        for low, high, stage in zip(cam.law.bounds, cam.law.bounds[1:], task.stages, strict=False):
            ends = digits(float(low)), digits(float(high))
            if stage.motion == DWELL:
                yield said("{0}° to {1}°: dwell", *ends)
            else:
                stroke = digits(float(stage.stroke))
                yield said("{0}° to {1}°: {2}, {3} {4}", *ends, MOVED[stage.motion], stroke, lifted)
        yield said("Follower: {0}, {1}", MOVES[task.follower.moves], CONTACTS[task.follower.contact])
        for words, value in ((said("radius of the roller"), task.follower.radius), (said("arm"), task.follower.arm),
                             (said("centre distance"), task.follower.distance)):
            if value:
                yield arranged("{0:capital}: {1} {2}", words, digits(float(value)), length)
        turns = said("counter-clockwise") if task.cam.sense > 0 else said("clockwise")
        yield said("The cam turns {0}, {1} {2}", turns, digits(task.cam.omega), unit("rad/s"))

    def found(self) -> Iterator[Said]:
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
        for note in cam.notes:
            yield arranged("{0:capital}", note)
        parts = [joined((OPINIONS[name], digits(size, 2)), " ") for name, size in self.check.items()]
        yield said("Second opinions differ by: {0}", joined(parts))
