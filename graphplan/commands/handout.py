"""Write handouts: the task for students, the steps as a guide, the solution; or a page that goes through the steps.

A PDF has the task sheet, its guided version and the solution, in true size and in the same frame, so that a drawing
can be laid over the solution. A .html is the live page, for a browser without a network, with the steps in front: step
by step, in any pose of the mechanism.

examples:
  graphplan handout four-bar -o four-bar.pdf
  graphplan handout scene.toml --only task --paper A3 -o task.pdf
  graphplan handout scene.toml -o steps.html
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_choices, add_preference, add_sheet, add_travel, count, on_paper
from graphplan.commands.live import add_offer, page
from graphplan.commands.output import kind, write
from graphplan.errors import Refused
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet

PARTS = "task", "guided", "solution"
ENDINGS = (".pdf", ".html")


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the file to write: .pdf or .html")
    command.add_argument("--only", choices=PARTS, help="this part of a .pdf alone")
    command.add_argument("--positions", type=count("--positions", 0), metavar="N",
                         help="of no effect: a .html moves through all poses")
    add_sheet(command, positions=False)
    add_choices(command, strict=True)
    add_travel(command)
    add_preference(command)
    add_offer(command)


def run(options: argparse.Namespace) -> int:
    suffix = _suffix(options)
    if suffix == ".pdf":
        write(back_end("pdf")(_pages(on_paper(options).composition, options.only)), options.output)
        return 0
    write(page(options, steps_first=True), options.output)
    return 0


def _suffix(options: argparse.Namespace) -> str:
    """What kind of file is asked for, with options that it has a use for."""
    suffix = kind(options.output, ENDINGS, "handout")
    if suffix == ".html" and options.only:
        raise Refused(f"--only {options.only}", "a page for a browser has no parts", "leave it out, or -o FILE.pdf")
    if suffix == ".html" and options.at is not None:
        raise Refused(f"--at {options.at}", "a page for a browser moves to any pose", "leave it out, or -o FILE.pdf")
    if suffix == ".pdf" and options.positions is not None:
        raise Refused("--positions", "a page of a .pdf shows one pose", "leave it out, or -o FILE.html")
    return suffix


def _pages(composition: Composition, only: str | None) -> list[Sheet]:
    """The pages of the parts that are wanted."""
    from graphplan.sheet.handout import guided_task, solution, task

    pages = {"task": task, "guided": guided_task, "solution": solution}
    return [sheet for kind in PARTS if only in (None, kind) for sheet in pages[kind](composition)]
