"""Mechanisms found from what they are to do: numbers and sheets, and handouts of the task."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from graphplan.errors import Refused
from graphplan.output import back_end, load_writer
from graphplan.public.drafting import Options, options_of, with_presentation
from graphplan.public.files import PARTS, handout_ending, write
from graphplan.public.subjects import Subject

if TYPE_CHECKING:
    from graphplan.output.subjects.synthesis_handout import HandoutSheet
    from graphplan.synthesis.sketch import Synthesis
    from graphplan.synthesis.task import SynthesisTask

SYNTHESIS_ENDINGS = (".json", ".svg", ".pdf", ".png", ".tex", ".dxf", ".toml")


@dataclass(frozen=True, repr=False)
class SynthesisResults(Subject):
    """What is found for a task, compared with the independent check: numbers, sheets, scene, handout."""

    synthesis: Synthesis = field(kw_only=True)
    check: Mapping[str, float] = field(kw_only=True)

    def handout(self, path: str | os.PathLike[str], *, only: str | None = None, **options: Any) -> None:
        """Write a handout, as `graphplan handout` does: a .pdf with the task, its guided version and the solution in
        true size, or `only` one of them; keywords say what the sheets look like. Fails with `Refused` where that cannot
        be."""
        self.save_handout(os.fspath(path), options_of(options), only)

    def save_handout(self, path: str, options: Options, only: str | None = None) -> None:
        """The same with options in one record."""
        from graphplan.output.subjects.synthesis_handout import SynthesisHandout

        if handout_ending(path, only) == ".html":
            raise Refused(path, "the handout of a task is printed", "-o FILE.pdf")
        shown = replace(self.synthesis, task=with_presentation(self.synthesis.task, options))
        handout = SynthesisHandout(shown, self.check, self.papers)
        write(back_end("pdf")([sheet for part in PARTS if only in (None, part) for sheet in handout.part(part)]), path)


def synthesize(task: str | os.PathLike[str], *, solution: int = 1, unsolved: bool = False,
               **options: Any) -> SynthesisResults:
    """The mechanism that a task asks for: guidance, function, stroke, path, dwell, Geneva wheel, profile, or gears.

    Reads a task file or a packaged name, and which `solution` sheet and scene show, counted from 1; `unsolved` the
    sheet has what is given alone, and boxes to fill in. Saved as .toml it is a scene, as .dxf the sheet, of gears the
    wheels in true size.
    Fails with `SceneError` where the task is faulty, and with `NoMechanism` where the construction does not exist.
    """
    from graphplan.synthesis.task import load

    return find_subject(load(os.fspath(task)), options_of(options), solution, unsolved)


def find_subject(task: SynthesisTask, options: Options, solution: int = 1, unsolved: bool = False) -> SynthesisResults:
    """What is found for a task that is read."""
    from graphplan.check.synthesis import check_synthesis
    from graphplan.synthesis.exports import numbers, scene_text
    from graphplan.synthesis.find import find_mechanism

    synthesis = find_mechanism(with_presentation(task, options), solution)
    check = check_synthesis(synthesis)

    def sheet(paper: str) -> HandoutSheet:
        from graphplan.output.subjects.synthesis_handout import DOCUMENTS, HandoutSheet

        return HandoutSheet(paper, synthesis, check, *((True, DOCUMENTS["task"]) if unsolved else ()))

    files: dict[str, Any] = {".toml": lambda: scene_text(synthesis)}
    if task.kind == "gear":
        files[".dxf"] = lambda: load_writer("dxf", "cad.full_size").wheels_dxf(synthesis)
    return SynthesisResults(sheet, lambda: numbers(synthesis, check), synthesis.task.sheet.paper, files=files,
                            rows=False, name="synthesis", endings=SYNTHESIS_ENDINGS, synthesis=synthesis, check=check)

