"""Mechanisms found from what they are to do."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from graphplan.output import load_writer
from graphplan.public.drafting import Options, options_of, with_presentation
from graphplan.public.subjects import Subject

if TYPE_CHECKING:
    from graphplan.output.subjects.synthesis_sheet import SynthesisSheet
    from graphplan.synthesis.task import SynthesisTask

ENDINGS = (".json", ".svg", ".pdf", ".png", ".tex", ".dxf", ".toml")


def synthesize(task: str | os.PathLike[str], *, solution: int = 1, **options: Any) -> Subject:
    """The mechanism that a task asks for: guidance, function, stroke, path, dwell, Geneva wheel, profile, or gears.

    Reads a task file or a packaged name, and which `solution` sheet and scene show, counted from 1. Saved as .toml it
    is a scene, as .dxf the sheet, of gears the wheels in true size.
    Fails with `SceneError` where the task is faulty, and with `NoMechanism` where the construction does not exist.
    """
    from graphplan.synthesis.task import load

    return find_subject(load(os.fspath(task)), options_of(options), solution)


def find_subject(task: SynthesisTask, options: Options, solution: int = 1) -> Subject:
    """What is found for a task that is read."""
    from graphplan.check.synthesis import check_synthesis
    from graphplan.synthesis.exports import numbers, scene_text
    from graphplan.synthesis.find import find_mechanism

    synthesis = find_mechanism(with_presentation(task, options), solution)
    check = check_synthesis(synthesis)

    def sheet(paper: str) -> SynthesisSheet:
        from graphplan.output.subjects.synthesis_sheet import SynthesisSheet

        return SynthesisSheet(paper, synthesis, check)

    files: dict[str, Any] = {".toml": lambda: scene_text(synthesis)}
    if task.kind == "gear":
        files[".dxf"] = lambda: load_writer("dxf", "cad.full_size").wheels_dxf(synthesis)
    return Subject(sheet, lambda: numbers(synthesis, check), synthesis.task.sheet.paper, files=files, rows=False,
                   name="synthesis", endings=ENDINGS)
