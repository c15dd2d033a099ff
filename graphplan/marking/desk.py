"""Desks, on which drawings are judged by the construction on its sheet, with what a flywheel adds to it.

In the pose that is meant they fit a similar figure of the scene's points, whatever its place, direction and size. Where
that of the task does not fit them and another of the cycle does, another one was drawn.

Where drawings are judged, one after the other, by the construction on its sheet.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from graphplan.cycle.turn import follow
from graphplan.design.hand import Pencil
from graphplan.errors import GraphplanError, Refused
from graphplan.kernel.kinds import POINT
from graphplan.machines.subjects import pencil_errors
from graphplan.marking.classroom.booklet import KeyRow, single_row
from graphplan.marking.judge.numbers import ExpectedCycleNumber
from graphplan.marking.judge.verdict import Judgement
from graphplan.mechanism.model import Presentation, Scene
from graphplan.mechanism.units import KILOGRAMS, NEWTONS
from graphplan.methods.kinds import CYCLE
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.plates.plans import Plans

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.machines.flywheel.result import FlywheelResult
    from graphplan.marking.classroom.results import MarkedDrawing
    from graphplan.marking.classroom.stack import TeacherWord
    from graphplan.marking.judge.score import Weights
    from graphplan.marking.traces import Frames, Submission
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet

MIN_POINTS = 4  # two points fit any figure, and a third is where some pose has it
COARSE_POSES, FINE_POSES = 721, 41  # over the cycle, and about the best of these
FITS_MM, MISFITS_MM = 2.0, 4.0  # how far off a point may be in the pose that was drawn, and is in the task's
ROUND_TRAVELS, ROUNDING_MM = (5.0, 1.0, 0.1), 0.3  # degrees, of which the first that fits as well is meant; so well


def other_pose(judgement: Judgement) -> str:
    """The pose that was drawn instead of the task's, as `--at` takes it, if it is told by the points; else empty.
    """
    scene, spots = judgement.drawing.scene, _lettered_spots(judgement)
    if len(set(spots.values())) < MIN_POINTS:
        return ""
    if _misfit({name: np.array([complex(*map(float, scene.points[name]))]) for name in spots}, spots)[0] < MISFITS_MM:
        return ""
    given_scene = scene.assembly.given_scene if scene.assembly else scene
    misfit_at = partial(_misfit_at, given_scene, spots)
    with suppress(GraphplanError):  # it has no drive, or its drive slides, so that no turn closes its travel
        best, step = _best_travel(given_scene, spots, None), 360 / COARSE_POSES
        if np.isnan(misfit_at(best)):  # where no full turn is made, it is reached backwards
            best -= 360
        for _ in range(2):
            best, step = _best_travel(given_scene, spots, (best - step, best + step)), 2 * step / FINE_POSES
        if (least := misfit_at(best)) < FITS_MM:
            round_travels = (round(best / unit) * unit for unit in ROUND_TRAVELS)
            travel = next((near for near in round_travels if misfit_at(near) < least + ROUNDING_MM), best)
            return f"{travel:.4g}"
    return ""


def _lettered_spots(judgement: Judgement) -> dict[str, complex]:
    """Places of the scene's points on the sheet, in mm, as far as they have letters."""
    steps, plan_of_step = judgement.drawing.drawn.steps, Plans(judgement.drawing).plan_of_step
    return {step.name: complex(*verdict.trace.spots[0]) for verdict in judgement.verdicts
            if verdict.trace and verdict.trace.label and (step := steps[verdict.step]).op.gives == POINT
            and plan_of_step[step.index] == MECHANISM and step.name in judgement.drawing.scene.points}


def _best_travel(scene: Scene, spots: Mapping[str, complex], span: tuple[float, float] | None) -> float:
    """The travel, in degrees, of the pose in which the points fit best; over the whole turn or a span."""
    turn = follow(scene, FINE_POSES if span else COARSE_POSES, span)
    return float(np.degrees(turn.travel[np.argmin(np.nan_to_num(_misfit(turn.points, spots), nan=np.inf))]))


def _misfit_at(scene: Scene, spots: Mapping[str, complex], travel: float) -> float:
    """Largest distance of a point at one travel; nan if it is not reached."""
    return float(_misfit(follow(scene, 1, (travel, travel)).points, spots)[0])


def _misfit(points: Mapping[str, Any], spots: Mapping[str, complex]) -> Any:
    """Largest distance of the spots from a figure similar to the points, in mm, in each of n poses; nan if one is not
    reached."""
    sheet = np.array(list(spots.values()))
    figures = np.stack([points[name] for name in spots])  # points by poses
    sheet, figures = sheet - sheet.mean(), figures - figures.mean(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        units = (figures.conj() * sheet[:, None]).sum(axis=0) / (abs(figures) ** 2).sum(axis=0)
        return abs(sheet[:, None] - units * figures).max(axis=0)


MOMENT, INERTIA, CLOSING, FLYWHEEL = CYCLE
PLACES = {MOMENT: "moment", INERTIA: "inertia"}  # by their names among what there is at a plan


@dataclass(frozen=True)
class CycleResults:
    """The results over the cycle of a scene whose flywheel is asked for and whose first drive turns; empty for
    others."""

    scene: Scene
    pencil: Pencil

    @cached_property
    def flywheel(self) -> FlywheelResult | None:
        if self.scene.flywheel is None or self.scene.drives[0].slides:
            return None
        from graphplan.machines.flywheel.result import flywheel

        return flywheel(self.scene)

    def expected_result(self, kind: str, of: str) -> ExpectedCycleNumber | None:
        """Expected value of a number, if it is one of these: a travel in degrees is any of the cycle."""
        result = self.flywheel
        if result is None or (kind == FLYWHEEL and result.given):
            return None
        if kind in PLACES:
            try:
                travel = math.radians(float(of))
            except ValueError:
                return None
            return self._expected_at(result, kind,
                                     travel) if result.cycle.ends[0] <= travel <= result.cycle.ends[1] else None
        if of:
            return None
        one, (wheel, mean) = self._unit(kind), pencil_errors(result, self.pencil)
        if kind == CLOSING:
            closing = result.cycle.closing
            return ExpectedCycleNumber(closing / one, mean / one, abs(result.drawing.mean + closing) / one)
        return ExpectedCycleNumber(result.wheel.inertia / one, wheel / one, result.strip_error / one)

    def _expected_at(self, result: FlywheelResult, kind: str, travel: float) -> ExpectedCycleNumber:
        import numpy as np

        value = float(result.values_at(np.array([travel]))[PLACES[kind]][0])
        return ExpectedCycleNumber(value / self._unit(kind), self._read(result, kind))

    def _unit(self, kind: str) -> float:
        """The scene's unit, in kg m^2 or N m."""
        units = self.scene.units
        return float(NEWTONS[units.force] if kind in (MOMENT, CLOSING) else KILOGRAMS[units.mass])

    def _read(self, result: FlywheelResult, kind: str) -> float:
        """The standard deviation of an ordinate that is plotted and read off."""
        frame = result.drawing.frames[PLACES[kind]]
        scale = frame.y.unit if kind == MOMENT else frame.x.unit
        return math.sqrt(2) * self.pencil.point * scale / self._unit(kind)

    @property
    def rows(self) -> Iterator[KeyRow]:
        """The rows of a key: moment and inertia at each plan, the closing moment, and the flywheel."""
        result, units = self.flywheel, self.scene.units
        if result is None:
            return
        for kind, name in PLACES.items():
            values = result.plans[name] / self._unit(kind)
            for travel, value in zip(result.travels_in_degrees, values, strict=True):
                yield single_row(CYCLE[kind], f"{travel:g}", float(value), float(abs(values).max()), units)
        for kind in (CLOSING, FLYWHEEL):
            if expected := self.expected_result(kind, ""):
                yield single_row(CYCLE[kind], "", expected.value, abs(expected.value), units)


OWN_SUFFIXES, MAX_SCENE_CHARS = (".svg", ".dxf", ".ggb", ".pdf"), 200_000
FORM_KEYS = "plan", "method", "inertia"  # of [sheet], that may be asked of a drawing
SCALE_KEYS = "k_s", "k_v", "k_a", "k_F", "multiples"  # of [sheet], that a task gives, or leaves to who draws


def key_rows(scene: Scene) -> Iterator[KeyRow]:
    """The further rows of the key of a variant."""
    yield from CycleResults(scene, Pencil()).rows


@dataclass(frozen=True)
class Desk:
    """Desk where drawings are judged by the construction on its sheet; a form that is not among the `keys` of [sheet]
    that are asked for beside the scene may be another."""

    on_sheet: Drafted
    weights: Weights
    keys: Mapping[str, Any]
    words: Mapping[str, TeacherWord] = field(default_factory=dict)  # of the teacher, by the file's name
    other_pose: str = ""  # that of a sheet of a student's own, as `--at` takes it
    as_drawn: Composition | None = None  # a sheet of graphplan's own of another form than asked: its plans lie so
    drawn_otherwise: dict[str, Desk | None] = field(default_factory=dict, repr=False)  # by the scene in own files

    def judge_file(self, path: Path) -> MarkedDrawing:
        """A drawing judged; fails with `Refused` where it cannot be, whatever happens."""
        try:
            with warnings.catch_warnings():  # what libraries say is not for the reader
                warnings.simplefilter("ignore")
                desk = self._desk_for_own_sheet(path)
                return desk.judge_submission(desk._read(path), self.words.get(path.name))
        except GraphplanError:
            raise
        except MemoryError:
            raise Refused(f"{path}", "not judged: there is not enough memory", "a smaller drawing") from None
        except Exception as fault:  # one bad file never stops a class
            raise Refused(f"{path}", f"could not be judged: {type(fault).__name__}",
                          "judge it by hand, and report the fault with this file") from fault

    def _desk_for_own_sheet(self, path: Path) -> Desk:
        """The desk of the sheet that a file of graphplan's own is, as the scene in it says: of the same mechanism, but
        on other paper, with words in another language, in another pose or drawn by another form; else this desk."""
        from graphplan.marking.files.measures import MAX_PDF_BYTES
        from graphplan.marking.files.safe import contents, embedded_scene
        from graphplan.mechanism.written_scene import parse, written_pose

        if path.suffix.casefold() not in OWN_SUFFIXES:
            return self
        text = embedded_scene(path, contents(path, MAX_PDF_BYTES))
        if len(text) > MAX_SCENE_CHARS + len(self.on_sheet.drawing.scene.text):
            return self
        if text and text not in self.drawn_otherwise:
            self.drawn_otherwise[text] = None
            with suppress(GraphplanError, RecursionError):
                scene = parse(text, f"{path}/")  # no file is beside it
                self.drawn_otherwise[text] = self._redraw(scene, written_pose(text))
        return self.drawn_otherwise.get(text) or self

    def _redraw(self, scene: Scene, pose: str) -> Desk | None:
        """This desk with its sheet as a scene of the same mechanism has it, in a pose as `--at` takes it, if that is
        another one; where that is of another form than asked for, its plans lie as drawn."""
        from graphplan.app.drafting import on_paper
        from graphplan.cycle.pose import at
        from graphplan.mechanism.written_scene import GIVEN_POSE, parse_pose, pose_text

        task = self.on_sheet.drawing.scene
        in_same_pose = pose == pose_text(task)
        forms, scales = ({key: value for key in keys if (value := getattr(task.sheet, key)) and value != getattr(
            scene.sheet, key)} for keys in (filter(self.keys.get, FORM_KEYS), SCALE_KEYS))
        if ((in_same_pose and (scales or task.sheet == self._sheet_beside_design(scene)))
                or _mechanism(scene) != self._mechanism_as_written):
            return None
        posed = at(scene, parse_pose(pose)) if pose else scene
        posed = replace(posed, sheet=replace(posed.sheet, **scales))
        as_drawn = drafted = on_paper(posed)
        if in_same_pose and _mechanism(drafted.drawing.scene) != _mechanism(task):
            return None  # what is drawn may be less than is written
        if forms:
            drafted = on_paper(replace(posed, sheet=replace(posed.sheet, **forms)))
        plans = replace(drafted.composition.plans, tongue=self.on_sheet.composition.plans.tongue)
        on_sheet = replace(drafted, pencil=self.on_sheet.pencil, composition=replace(drafted.composition, plans=plans))
        other_pose = "" if in_same_pose else pose or GIVEN_POSE
        return replace(self, on_sheet=on_sheet, other_pose=other_pose, drawn_otherwise={},
                       as_drawn=as_drawn.composition if forms else None)

    def _sheet_beside_design(self, scene: Scene) -> Presentation:
        """The sheet of a scene, without the keys that say its design and its paper, as far as those are this desk's."""
        design, task = self.on_sheet.drawing.design, self.on_sheet.drawing.scene.sheet
        chosen = {"time_scale": design.kappa, "force_scale": design.phi, "ways": design.ways,
                  "force_way": design.group_way, "paper": self.on_sheet.paper}
        same = {key: getattr(task, key) for key, value in chosen.items() if getattr(scene.sheet, key) == value}
        return replace(scene.sheet, **same)

    @cached_property
    def _mechanism_as_written(self) -> Scene:
        """The mechanism of the task, with what of it has no motion in this pose and is not drawn."""
        from graphplan.mechanism.written_scene import parse

        task = self.on_sheet.drawing.scene
        return _mechanism(parse(task.text, task.name) if task.text else task)

    def _read(self, path: Path) -> Submission:
        """Read a file beside the printed sheet."""
        from graphplan.marking.submission import read_submission

        arrangement = (self.as_drawn or self.on_sheet.composition).arrangement
        return read_submission(path, self.plans, self.frames,  # task and guided version have the same plans
                               self._print_task, self._code, (arrangement.width, arrangement.height))

    def _print_task(self) -> Sheet:
        """The sheet that students draw on."""
        from graphplan.sheet.handout import task

        return task(self.on_sheet.composition)[0]

    @property
    def _code(self) -> int:
        """The code in its corners."""
        from graphplan.sheet.handout import code

        return code(self.on_sheet.composition)

    @property
    def plans(self) -> list[str]:
        """The plans that marks may name: if no plan is asked for, those of every way to draw motions."""
        from graphplan.methods.panels import ACCELERATION_PLAN, N_PLAN, VELOCITY_PLAN

        are_asked = self.keys.get("method") or self.keys.get("plan")
        motion_plans = () if are_asked else (N_PLAN, VELOCITY_PLAN, ACCELERATION_PLAN)
        return list(dict.fromkeys([*self.on_sheet.composition.views, *motion_plans]))

    @cached_property
    def _cycle(self) -> CycleResults:
        """Expected numbers over the machine's cycle."""
        return CycleResults(self.on_sheet.drawing.scene, self.on_sheet.pencil)

    @property
    def frames(self) -> Frames:
        """Frames of the plans on the printed sheet."""
        from graphplan.marking.traces import PlanFrame

        views = (self.as_drawn or self.on_sheet.composition).views
        return {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in views.items()}

    def judge_submission(self, submission: Submission, word: TeacherWord | None = None) -> MarkedDrawing:
        """A drawing judged by what was read of it, with what the teacher says of it."""
        from graphplan.marking.classroom.results import MarkedDrawing
        from graphplan.marking.judge.score import score

        judgement = replace(self._judge(submission), name=printable(submission.name))
        judgement = replace(judgement, other_pose=self.other_pose or self._drawn_pose(judgement))
        if word is None:
            return MarkedDrawing(judgement, score(judgement, self.weights))
        judgement = judgement.overrule(word.verdicts)
        judged = replace(score(judgement, self.weights), given=word.score, note=word.note)
        return MarkedDrawing(judgement, judged, word.accepted or word.score is not None)

    def _drawn_pose(self, judgement: Judgement) -> str:
        """Another pose that was drawn instead of the task's, if something is wrong and its points tell one."""
        return other_pose(judgement) if judgement.first_wrong else ""

    def _judge(self, submission: Submission) -> Judgement:
        """Judge a drawing, and numbers over the cycle."""
        from graphplan.marking.judge.judge import judge, judge_any_design
        from graphplan.marking.judge.numbers import with_cycle_numbers

        work = self.on_sheet.drawing, self.on_sheet.composition, submission, self.on_sheet.pencil
        judgement_of_pose = (judge(*work) if self.keys.get("method")
                             else judge_any_design(*work, self.keys.get("plan") or ""))
        return with_cycle_numbers(judgement_of_pose, self._cycle.expected_result)


def _mechanism(scene: Scene) -> Scene:
    """A scene without what its sheet and its title say."""
    return replace(scene, title="", source="", name="", sheet=Presentation(), vary={}, assembly=None)


def printable(name: str) -> str:
    """A name as it can be written: a file may be called by what no terminal should obey and no text can hold."""
    return "".join(char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in name)
