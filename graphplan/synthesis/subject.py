"""Mechanisms found from what they are to do: numbers and sheets, handouts of the task, and variants for a class."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from graphplan.app.drafting import languages_of, pencil, with_sheet
from graphplan.app.files import PARTS, handout_ending, write
from graphplan.app.subjects import Subject
from graphplan.errors import Refused
from graphplan.marking.classroom.class_files import ClassRequest, ClassWork, write_class
from graphplan.output import back_end, load_writer
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.marking.classroom.stack import TeacherWord
    from graphplan.marking.judge.score import Weights
    from graphplan.sheet.panels import PanelSheet
    from graphplan.synthesis.handout import SynthesisHandout, TaskDesk
    from graphplan.synthesis.sketch import Synthesis
    from graphplan.synthesis.task import SynthesisTask

SYNTHESIS_ENDINGS = (".json", ".svg", ".pdf", ".png", ".tex", ".dxf", ".toml")


@dataclass(frozen=True, repr=False)
class SynthesisResults(Subject):
    """Results of a task, compared with the independent check: numbers, sheets, scene, handout."""

    drawn: SynthesisHandout = field(kw_only=True)

    @property
    def synthesis(self) -> Synthesis:
        """The result and its drawing."""
        return self.drawn.synthesis

    def with_sheet(self, keys: Mapping[str, Any]) -> SynthesisResults:
        """Return the mechanism with other keys of [sheet]."""
        task = with_sheet(self.synthesis.task, keys)
        return replace(self, drawn=replace(self.drawn, synthesis=replace(self.synthesis, task=task)))

    def on_paper(self) -> Drafted:
        """The construction on its sheet, as a scene's is drafted."""
        from graphplan.accuracy.drafted import Drafted

        composition = self.drawn.on_paper.composition
        return Drafted(composition.plans.drawing, pencil(self.synthesis.task), (), False, composition)

    def handout(self, path: str, only: str | None = None, **options: Any) -> None:
        """Write a handout, as `gp.handout` does: a .pdf with the task, its guided version and the solution in true
        size, or `only` one of them; or a .html, the live page with the steps in front."""
        self.with_sheet(options).save_handout(os.fspath(path), only)

    def save_handout(self, path: str, only: str | None = None, offered: Collection[str] | None = None) -> None:
        """Write a handout, with what the page offers."""
        if handout_ending(path, only) == ".html":
            write(self.live_page(offered), path)
            return
        sheets = [sheet for part in PARTS if only in (None, part) for sheet in self.drawn.pages_of(part)]
        write(back_end("pdf")(sheets), path)

    def live(self, path: str, **options: Any) -> None:
        """Write the live page of the task, as `gp.live` does: what is given is dragged or typed, and the linkage, its
        construction, its numbers and its defects follow."""
        write(self.with_sheet(options).live_page(), os.fspath(path))

    def live_page(self, offered: Collection[str] | None = None) -> str:
        """The page, opened at the first step."""
        from graphplan.synthesis.live_page import TaskLivePage

        languages = languages_of(self.synthesis.task.sheet.language, offered, LANGUAGES)
        return TaskLivePage(self.synthesis, languages).html()

    def desk(self, weights: Weights, keys: Mapping[str, Any], words: Mapping[str, TeacherWord]) -> TaskDesk:
        """The desk on which drawings of the task are judged."""
        from graphplan.synthesis.handout import TaskDesk

        return TaskDesk(self.on_paper(), weights, keys, words, handout=self.drawn)

    def variants(self, folder: str, n: int, seed: int = 1, **options: Any) -> None:
        """Make so many tasks of a class in a new folder, as `gp.variants` does, by the table [vary] of the task."""
        self.write_variants(os.fspath(folder), ClassRequest(n, seed=seed, keys=options))

    def write_variants(self, folder: str, request: ClassRequest) -> None:
        """Write the variants of a class, as is asked for."""
        if not self.synthesis.task.vary:
            raise Refused(f"{self.synthesis.task.name}: vary", "the task does not say what varies",
                          'a table [vary], such as "stroke.ratio" = [1.1, 1.2, 1.3]')
        write_class(lambda: _class_of_task(self, request.keys), folder, request)


def _class_of_task(results: SynthesisResults, keys: Mapping[str, Any]) -> ClassWork:
    """The variants of a task; a scene that it names by a file they name by its whole path until they are written."""
    from graphplan.mechanism.written_scene import with_value_in_text
    from graphplan.synthesis.class_work import TaskDesign, key_pages, print_task
    from graphplan.synthesis.paths import scene_of

    task = results.synthesis.task
    scene_key = scene_file = ""
    if task.kind in ("cognates", "dwell") and os.path.exists(scene := scene_of(task)):
        scene_key, scene_file = f"{task.kind}.scene", os.path.abspath(scene)
        task = replace(task, text=with_value_in_text(task.text, scene_key, scene_file, task.name))
    draw = partial(draw_handout, keys, results.synthesis.chosen + 1)
    handout = draw(task)
    return ClassWork(partial(TaskDesign, handout, draw), partial(print_task, draw=draw),
                     partial(key_pages, handout), handout.on_paper.page.scene.title, scene_key, scene_file)


def draw_handout(keys: Mapping[str, Any], solution: int, task: SynthesisTask) -> SynthesisHandout:
    """A task with what is found for it on its sheets, with these keys of [sheet]; fails as `synthesize` does."""
    from graphplan.synthesis.check import check_synthesis
    from graphplan.synthesis.find import find_mechanism
    from graphplan.synthesis.handout import SynthesisHandout

    synthesis = find_mechanism(with_sheet(task, keys), solution)
    return SynthesisHandout(synthesis, check_synthesis(synthesis), Subject.papers)


def synthesize(task: str | os.PathLike[str], *, solution: int = 1, unsolved: bool = False,
               **options: Any) -> SynthesisResults:
    """The mechanism that a task asks for: guidance, function, stroke, path, dwell, Geneva wheel, profile, or gears.

    Reads a task file or a packaged name, and which `solution` sheet and scene show, counted from 1; `unsolved` the
    sheet has what is given alone, and boxes to fill in. Saved as .toml it is a scene, as .dxf the sheet, of gears the
    wheels in true size.
    Fails with `SceneError` where the task is faulty, and with `NoMechanism` where the construction does not exist.
    """
    from graphplan.synthesis.task import load

    return find_subject(with_sheet(load(os.fspath(task)), options), solution, unsolved)


def find(text: str, name: str) -> SynthesisResults:
    """The mechanism found for the text of a task; fails as `synthesize` does."""
    from graphplan.synthesis.task import parse

    return find_subject(parse(text, name))


def find_subject(task: SynthesisTask, solution: int = 1, unsolved: bool = False) -> SynthesisResults:
    """Solve a task that is read."""
    from graphplan.synthesis.exports import numbers, scene_text

    handout = draw_handout({}, solution, task)
    synthesis, check = handout.synthesis, handout.check

    def sheet(paper: str) -> PanelSheet:
        from graphplan.synthesis.handout import DOCUMENTS
        from graphplan.synthesis.sheet import SynthesisOnPaper

        return SynthesisOnPaper(paper, synthesis, check, *([DOCUMENTS["task"]] if unsolved else ())).sheet

    files: dict[str, Any] = {".toml": lambda: scene_text(synthesis)}
    if task.kind == "gear":
        files[".dxf"] = lambda: load_writer("graphplan.synthesis.full_size", "dxf").wheels_dxf(synthesis)
    return SynthesisResults(sheet, lambda: numbers(synthesis, check), synthesis.task.sheet.paper, files=files,
                            rows=False, name="synthesis", endings=SYNTHESIS_ENDINGS, drawn=handout)
