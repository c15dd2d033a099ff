"""The pages that `graphplan handout` prints, as SVG: task, guided version and solution."""

from __future__ import annotations

from functools import cache

from inked_sheet import InkedSheet

import graphplan as gp
from graphplan.app import drafting
from graphplan.output import back_end
from graphplan.sheet.handout import guided_task, solution, task


@cache
def handed_out(name: str, *changes: tuple[str, object]) -> tuple[list[InkedSheet], ...]:
    """The pages of the task of a scene with some changes, of its guided version and of its solution."""
    scene = gp.load(name)
    for path, value in changes:
        scene = scene.replace(path, value)
    composition = drafting.on_paper(scene).composition
    return tuple([InkedSheet.of(back_end("svg")(page)) for page in part(composition)]
                 for part in (task, guided_task, solution))
