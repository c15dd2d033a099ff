"""The sheet of a cam: its plan, the curve x(s), the diagrams, and in a column what is given, found and drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphplan.cams.construction import CAM_PLAN, CamDrawing
from graphplan.cams.follower import FlatOscillating, Rolled, Translating
from graphplan.cams.motions import DWELL
from graphplan.cams.pose import scene_text
from graphplan.errors import Refused
from graphplan.kernel.program import Panel, Step
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.output.cams.diagrams import CENTRE_PLAN, CURVATURE_PLAN, LAW_PLAN, Paper
from graphplan.output.cams.plan import CamPlan, extent
from graphplan.phrases import Said, arranged, digits, joined, said, unit
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.frames.title import Page
from graphplan.sheet.layout.layout import stacked
from graphplan.sheet.layout.paper import Arrangement, lower_right, packed, sheet_size, words_page
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.lettering import HEADING, SIZE, LetterSizes, letter_sizes, sentence_runs
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Item, Outline, Rect, Sheet, Text
from graphplan.sheet.plates.view import least, view
from graphplan.sheet.words.lengths import Lengths
from graphplan.sheet.words.rows import Cell, Placed, TextRow, fill, hung, lettered
from graphplan.words.tongue import Tongue, tongue

DOCUMENT = said("Cam sheet")
MOVED = {"uniform": said("uniform"), "parabolic": said("parabolic"), "harmonic": said("harmonic"), "sine": said("sine"),
         "trapezoid": said("trapezoid"), "3-4-5": said("polynomial 3-4-5"), "table": said("by a table")}
MOVES = {"translating": said("translating"), "oscillating": said("oscillating")}
CONTACTS = {"point": said("point"), "roller": said("roller"), "flat": said("flat face")}
OPINIONS = {"points": said("points"), "motion": said("motion"), "curvature": said("curvature"), "law": said("law")}
PAPERS = ("A3", "A2", "A1")
COLUMN, GAP, CAPTION, AROUND, OUTSIDE = 96.0, 4.0, 7.0, 3.0, 9.0  # mm: see _Sheet
PLAN_WIDE, PLAN_HIGH = 0.6, 0.64  # of the room beside the words: the plan; above the curve x(s)
FEW = 2  # steps that are told rather than counted
INDENT, LEAD = 8.0, 3.0  # mm: of what hangs from a step's number, and over a heading


def sheets(drawing: CamDrawing, check: dict[str, float], paper: str | None = None) -> list[Sheet]:
    """The sheet of a cam on the paper named, or on the smallest on which its words have room.

    On the paper named the steps stand on pages of their own where they have none. Fails with `Refused` where what is
    given and found has none.
    """
    for name in [paper] if paper else PAPERS:
        found = _Sheet(drawing, check, name)
        if found.placed(found.rows) is not None:
            return [found.page(found.rows)]
    if found.placed(found.brief) is None:
        raise Refused(f"paper {name}", "what is given and found does not fit on it", "a larger one, or no name")
    return [found.page(found.brief), *found.further]


@dataclass(frozen=True)
class _Sheet:
    """One cam on one paper."""

    drawing: CamDrawing
    check: dict[str, float]
    paper: str

    @cached_property
    def scene(self) -> Scene:
        """The cam as it stands at first, with the title and the sheet of the task."""
        task = self.drawing.cam.task
        return replace(parse(scene_text(self.drawing.cam, 0.0), task.name), title=task.title, sheet=task.sheet)

    @property
    def tongue(self) -> Tongue:
        return tongue(self.drawing.cam.task.sheet.language)

    @property
    def letters(self) -> LetterSizes:
        return letter_sizes(self.paper)

    @cached_property
    def space(self) -> Rect:
        return frame_of(self.scene).space(*sheet_size(self.paper))

    @cached_property
    def title(self) -> Rect:
        """Where the title block stands: under the words."""
        block = frame_of(self.scene).block(self.scene, self.tongue).on(self.paper)
        return lower_right(self.space, self.letters.times * COLUMN + 2 * GAP, block)

    @cached_property
    def panels(self) -> dict[Panel, Rect]:
        """The plan, under it the curve x(s) if there is one, beside them the diagrams, and last the words."""
        words = self.letters.times * COLUMN + 2 * GAP
        room = replace(self.space, right=self.space.right - words)
        middle = room.left + PLAN_WIDE * room.width
        foot = self.title.top if self.title.left < room.right - 0.1 else self.space.bottom
        room = replace(room, bottom=foot)
        level = room.top - PLAN_HIGH * room.height
        law = Rect(middle, room.bottom, room.right, room.top)
        if isinstance(self.drawing.cam.pair, FlatOscillating):
            return {CAM_PLAN: Rect(room.left, room.bottom, middle, room.top), LAW_PLAN: law}
        centre = CENTRE_PLAN if isinstance(self.drawing.cam.pair, Rolled) else CURVATURE_PLAN
        return {CAM_PLAN: Rect(room.left, level, middle, room.top), LAW_PLAN: law,
                centre: Rect(room.left, room.bottom, middle, level)}

    @cached_property
    def k_s(self) -> float:
        """Lengths for a mm of the plan, in a round scale."""
        return float(round_up(least(extent(self.drawing), self._inside(CAM_PLAN).inset(*(OUTSIDE,) * 4))))

    def _inside(self, panel: Panel) -> Rect:
        """The room of a panel under its caption."""
        times = self.letters.times
        return self.panels[panel].inset(AROUND, AROUND, AROUND, AROUND + times * CAPTION)

    def placed(self, rows: Sequence[TextRow]) -> list[Placed] | None:
        """Words in their column; nothing where they do not fit."""
        right, times = self.space.right - GAP, self.letters.times
        column = Rect(right - times * COLUMN, self.title.top + GAP, right, self.space.top - GAP)
        return fill([row.enlarged(times) for row in rows], [column])

    @cached_property
    def brief(self) -> list[TextRow]:
        """What is given and found."""
        return [*self._rows()]

    @cached_property
    def steps(self) -> list[TextRow]:
        """The construction in words."""
        return [self._heading(said("Construction")), *self._steps()]

    @property
    def rows(self) -> list[TextRow]:
        """All words."""
        return [*self.brief, *self.steps]

    @cached_property
    def _apart(self) -> tuple[Arrangement, list[list[Placed]]]:
        """A page of words alone, and the steps page by page."""
        frame = frame_of(self.scene)
        page = words_page(self.paper, frame, frame.block(self.scene, self.tongue))
        return page, packed([row.enlarged(self.letters.times) for row in self.steps], page)

    @property
    def further(self) -> Iterator[Sheet]:
        """The pages of steps that follow the first."""
        arrangement, pages = self._apart
        for number, placed in enumerate(pages, 2):
            items = [*self._framed(arrangement.title, {}, number, 1 + len(pages)), *lettered(placed)]
            yield replace(self.page(()), panels={}, items=tuple(stacked(items)))

    def page(self, rows: Sequence[TextRow]) -> Sheet:
        """The first page with these words, as one display list."""
        program, cam = self.drawing.program, self.drawing.cam
        wide, high = sheet_size(self.paper)
        rect = self._inside(CAM_PLAN)
        plan = CamPlan(self.drawing, view(extent(self.drawing), rect, self.k_s), self.letters)
        figures = Paper(cam, self.letters, self.tongue)
        count = 1 if len(rows) > len(self.brief) else 1 + len(self._apart[1])
        items = [*self._framed(self.title, self.panels, 1, count), *plan.items(), *figures.law(self._inside(LAW_PLAN)),
                 *lettered(self.placed(rows) or [])]
        for panel in self.panels:
            if panel in (CENTRE_PLAN, CURVATURE_PLAN):
                items += figures.centre(self._inside(panel))
        sentences = tuple(self.tongue(program.told(step.index)) for step in program.steps)
        told = self.tongue(said("Cam by inversion in {0} steps.", len(program) - program.givens))
        return Sheet(wide, high, self.space, {str(panel): rect for panel, rect in self.panels.items()},
                     tuple(stacked(items)), cam.task.title, told, sentences, self._scales, self.tongue.code,
                     self.scene.text, program.givens)

    def _framed(self, title: Rect, panels: Mapping[Panel, Rect], number: int, of: int) -> Iterator[Item]:
        """Frame, panels with their captions, and the title block, of one page of so many."""
        frame = frame_of(self.scene)
        yield from frame.items(self.paper, self.space, self.tongue)
        for panel, rect in panels.items():
            yield Outline(pens.BORDER, "paper", None, rect.corners, str(panel))
            runs = sentence_runs(self.tongue(panel.heading))
            size = self.letters.mark
            yield Text(pens.LETTERS, "text", None, (rect.left + 2.5, rect.top - 1.6 * size), runs, size, bold=True)
        page = Page(DOCUMENT, self.paper, ratio(self.k_s, self.drawing.cam.task.units.length), number, of)
        yield from frame.block(self.scene, self.tongue).on(self.paper).items(title, page)

    # ---- words -----------------------------------------------------------------------------------------------------

    def _rows(self) -> Iterator[TextRow]:
        yield self._heading(said("Given"))
        for words in self._given():
            yield from self._paragraph(words)
        yield self._heading(said("Found"))
        for words in self._found():
            yield from self._paragraph(words)

    def _heading(self, words: Said, size: float = HEADING) -> TextRow:
        return TextRow((Cell(0.0, sentence_runs(self.tongue(words)), bold=True),), size=size, gap=LEAD, keep=2)

    def _paragraph(self, words: str, number: str = "", step: int | None = None) -> Iterator[TextRow]:
        """Words in lines, hanging from a number."""
        return hung(sentence_runs(self.tongue(words), self._names), COLUMN, INDENT, number, step)

    @cached_property
    def _names(self) -> tuple[str, ...]:
        """The names that words are set with."""
        return tuple(step.name for step in self.drawing.program.steps if step.name)

    def _given(self) -> Iterator[Said]:
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

    def _found(self) -> Iterator[Said]:
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

    def _steps(self) -> Iterator[TextRow]:
        """Stage by stage the sentences of the divisions 0 and 1, and which steps draw the others."""
        program = self.drawing.program
        for stage, steps in program.stages:
            yield replace(self._heading(stage.title, SIZE), gap=LEAD / 2)
            yield from self._paragraph(arranged("{0:capital}.", stage.law))
            shown, left = _first_figure(steps)
            for step in shown:
                yield from self._paragraph(self._spoken(step), str(program.number(step.index)), step.index)
            if left:
                numbers = program.number(left[0].index), program.number(left[-1].index)
                yield from self._paragraph(said("Steps {0} to {1}: the same at the other divisions.", *numbers))

    def _spoken(self, step: Step) -> Said:
        """A step in words, with its length on paper."""
        told = self.drawing.program.told(step.index)
        lengths = Lengths(self.drawing.program, self.drawing.values, lambda index: CAM_PLAN, self._scales).of(step)
        return joined((told, *(arranged("{0}.", length.told) for length in lengths)), " ")

    @property
    def _scales(self) -> Scales:
        return Scales(self.k_s, 1.0, self.drawing.cam.task.units.length, {},
                      convention=self.drawing.cam.task.sheet.convention)


def _first_figure(steps: Sequence[Step]) -> tuple[Sequence[Step], Sequence[Step]]:
    """The first steps of a stage, until all that is done in it has been done once, and the others."""
    kinds = [(step.op, getattr(step.why, "key", "")) for step in steps]
    again = next((kind for k, kind in enumerate(kinds) if kind in kinds[:k]), None)
    end = max(kinds.index(kind) for kind in kinds) + 1
    while again is not None and end < len(kinds) and kinds[end] != again:
        end += 1
    return (steps[:end], steps[end:]) if len(steps) - end > FEW else (steps, ())
