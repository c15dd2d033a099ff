"""The sheet of a scene as files: SVG, PDF, PNG or DXF, whole or in part, with its pages of words and of stages.

And its handouts: pages to print, or the live page of a leaf.
"""

from __future__ import annotations

import os
from collections.abc import Collection
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

from graphplan import leaves
from graphplan.app import drafting, files
from graphplan.app.drafting import Keywords, with_sheet
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.app.subjects import FoundMechanism
    from graphplan.kernel.program import Program
    from graphplan.phrases import Said
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet

ENDINGS = (".svg", ".pdf", ".png", ".dxf")
WHOLE = {"pdf", "dxf"}  # formats that have all pages in one file
STAGES = "-stages"  # what the names of pages of stages add to that of the sheet
STAGED = "stages"


class SheetFiles(NamedTuple):
    """The files of a sheet, each with its path, and what is not drawn as the pose is singular in part."""

    contents: list[tuple[str | None, Any]]
    missing: tuple[Said, ...]


def save_sheet(scene: Scene, path: str | None, *, dpi: int | None = None, **excerpt: Any) -> tuple[Said, ...]:
    """Write the sheet of a scene, or an excerpt as `sheet_files` has it, by the ending of a path, further pages beside
    it; without one, or where it is `-`, SVG on standard output. Return what is not drawn as the pose is singular in
    part."""
    sheet = sheet_files(scene, path, sheet_format(path, dpi), dpi=dpi, **excerpt)
    files.write_all(sheet.contents)
    return sheet.missing


def sheet_files(scene: Scene, path: str | None, name: str, *, steps: str = "", strip: str = "", by: str = "",
                numbers: bool = False, dpi: int | None = None) -> SheetFiles:
    """Return the files of the sheet of a scene in a format; without a path the first page alone.

    Of it are drawn: `steps` such as 6-12 over earlier ones in grey; a `strip` of pictures, one a mark or one a step;
    `by` stages on pages of their own, or the sheet alone, strict ones by stages if it is not said; with the `numbers`
    of steps at all marks; a .png in `dpi`.
    """
    from graphplan.sheet import strip as pictures
    from graphplan.sheet.layout.layout import pages, with_numbers

    report = drafting.drawable(scene)
    drafted = drafting.on_paper(scene, report)
    composition = with_numbers(drafted.composition) if numbers else drafted.composition
    names, text = files.page_names(path, 2), drafting.as_drawn(report.scene, drafted)
    more: list[Sheet] = []
    staged = by == STAGED or (report.drawing.strict and not (by or steps))
    if strip:
        sheets = pictures.strip(composition, cut=strip)
    elif staged and (name in WHOLE or len(names) > 1):
        sheets, more = pictures.by_stages(composition)
    else:
        sheets = [_requested_steps(sheet, report.drawing.drawn, steps) for sheet in pages(composition)]
    sheets, more = ([replace(sheet, scene=text) for sheet in some] for some in (sheets, more))
    write_out, look = back_end(name), {"dpi": dpi or files.DEFAULT_DPI} if name == "png" else {}
    if name in WHOLE:
        content = write_out(sheets + more, *([composition.plates] if name == "dxf" else []))
        return SheetFiles([(path, content)], report.drawing.missing)
    names = files.page_names(path, len(sheets), "" if strip else files.PROTOCOL)
    names += files.page_names(path, 1 + len(more), STAGES)[1:]
    contents = [(path, write_out(sheet, **look)) for path, sheet in zip(names, sheets + more, strict=False)]
    return SheetFiles(contents, report.drawing.missing)


def sheet_format(path: str | None, dpi: int | None = None) -> str:
    """The format of a sheet by the ending of its path; fails with `Refused` if the file cannot be written."""
    name = files.kind(path, ENDINGS, "sheet").removeprefix(".")
    if dpi and name != "png":
        raise Refused(f"--dpi {dpi}", "only a .png has a resolution", "leave it out, or -o SHEET.png")
    return name


def _requested_steps(sheet: Sheet, drawn: Program, steps: str) -> Sheet:
    """The part of the sheet that is asked for."""
    if not steps:
        return sheet
    from graphplan.sheet.layout.layout import sheet_at_step, step_range

    first, last = step_range(drawn, steps)
    return sheet_at_step(sheet, last, first if first > drawn.givens else 0)  # what is given is earlier than no step


def handout(scene: Scene | FoundMechanism, path: str | os.PathLike[str], *, only: str | None = None,
            choices: Collection[str] | str | None = None, **options: Unpack[Keywords]) -> None:
    """Write a handout, as `graphplan handout` does: a .pdf with the task, its guided version and the solution in true
    size, or `only` one of them; or a .html, the live page with the steps in front. Instead of a scene it takes
    what `synthesize` finds.

    Further keywords say how it is drawn and what the sheet looks like, as for `construct` and `drawing.save`.
    Fails as they do.
    """
    save_handout(with_sheet(scene, options), os.fspath(path), only, drafting.choices_of(choices))


def save_handout(scene: Scene | FoundMechanism, path: str, only: str | None = None,
                 offered: Collection[str] | None = None) -> None:
    """Write a handout, with what the page offers."""
    if not isinstance(scene, Scene):
        return scene.save_handout(path, only, offered)
    if files.handout_ending(path, only) == ".html":
        if scene.assembly is not None:
            raise Refused("--at", "a page for a browser moves to any pose", "leave it out, or -o FILE.pdf")
        files.write(_live_page(scene, offered), path)
    else:
        files.write(back_end("pdf")(_pages(drafting.on_paper(scene).composition, only)), path)


def _live_page(scene: Scene, offered: Collection[str] | None) -> str:
    """The page for a browser of a scene, with its steps in front."""
    page = next(leaf.pages[".html"] for leaf in leaves.leaves().values() if ".html" in leaf.pages)
    return str(leaves.module(page).live_page(scene, offered))


def _pages(composition: Composition, only: str | None) -> list[Sheet]:
    """The pages of the parts that are wanted."""
    from graphplan.sheet.handout import guided_task, solution, task

    pages = {"task": task, "guided": guided_task, "solution": solution}
    return [sheet for part in files.PARTS if only in (None, part) for sheet in pages[part](composition)]
