"""Write handouts: the task for students, the steps as a guide, the solution; or a page that goes through the steps.

A PDF has the task sheet, its guided version and the solution, in true size and in the same frame, so that a drawing
can be laid over the solution. A .html is one page for a browser, without a network: step by step, and where the
mechanism can be followed around its cycle, pose by pose.

examples:
  graphplan handout four-bar -o four-bar.pdf
  graphplan handout scene.toml --only task --paper A3 -o task.pdf
  graphplan handout scene.toml --positions 72 -o steps.html
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_choices, add_preference, add_sheet, count, on_paper
from graphplan.commands.output import kind, write
from graphplan.errors import Refused
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction
    from graphplan.sheet.cycle_frames import CycleFrames
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet

PARTS, POSITIONS = ("task", "guided", "solution"), 36
ENDINGS = (".pdf", ".html")
SHOWN = 2**18  # bytes for a pose that is drawn, as measured


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the file to write: .pdf or .html")
    command.add_argument("--only", choices=PARTS, help="this part of a .pdf alone")
    command.add_argument("--positions", type=count("--positions", 0), metavar="N",
                         help=f"how many poses of the cycle a .html shows ({POSITIONS}); 0 for the given one alone")
    add_sheet(command, positions=False)
    add_choices(command, strict=True)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    suffix = _suffix(options)
    if suffix == ".pdf":
        write(back_end("pdf")(_pages(on_paper(options).composition, options.only)), options.output)
        return 0
    from graphplan.cycle.travel import afford
    from graphplan.output.stepper import stepper

    positions = POSITIONS if options.positions is None else options.positions
    afford("--positions", positions, "drawn positions", SHOWN)
    options.protocol = "none"  # the page itself has the words
    on_sheet = on_paper(options)
    write(stepper(_round(on_sheet.drawing, on_sheet.composition, positions)), options.output)
    return 0


def _suffix(options: argparse.Namespace) -> str:
    """What kind of file is asked for, with options that it has a use for."""
    suffix = kind(options.output, ENDINGS, "handout")
    if suffix == ".html" and options.only:
        raise Refused(f"--only {options.only}", "a page for a browser has no parts", "leave it out, or -o FILE.pdf")
    if suffix == ".pdf" and options.positions is not None:
        raise Refused("--positions", "a page of a .pdf shows one pose", "leave it out, or -o FILE.html")
    return suffix


def _pages(composition: Composition, only: str | None) -> list[Sheet]:
    """The pages of the parts that are wanted."""
    from graphplan.sheet.handout import guided, solution, task

    pages = {"task": task, "guided": guided, "solution": solution}
    return [sheet for part in PARTS if only in (None, part) for sheet in pages[part](composition)]


def _round(drawing: Construction, composition: Composition, positions: int) -> CycleFrames:
    """The construction around its cycle, or where there is none, or none is wanted, in its own pose."""
    from math import degrees

    from graphplan.sheet.cycle_frames import standing, turning

    if not positions:
        return standing(drawing, composition)
    from graphplan.check.poses import checked
    from graphplan.cycle import follow

    try:
        turn = follow(drawing.scene, positions)
    except Refused as refused:
        return standing(drawing, composition, refused.why)
    points = checked(drawing, turn.points, turn.guides)
    return turning(drawing, composition, [degrees(travel) for travel in turn.travel], points, turn.guides)
