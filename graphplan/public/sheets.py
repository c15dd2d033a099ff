"""The sheet of a scene as files: SVG, PDF, PNG or DXF, whole or in part, with its pages of words and of stages."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from graphplan.errors import Refused
from graphplan.output import back_end
from graphplan.public.drafting import drawable, on_paper
from graphplan.public.files import DEFAULT_DPI, PROTOCOL, kind, page_names, write_all
from graphplan.public.options import Options

if TYPE_CHECKING:
    from graphplan.kernel.program import Program
    from graphplan.mechanism.model import Scene
    from graphplan.sheet.plates.display import Sheet

ENDINGS = (".svg", ".pdf", ".png", ".dxf")
WHOLE = {"pdf", "dxf"}  # formats that have all pages in one file
STAGES = "-stages"  # what the names of pages of stages add to that of the sheet
STAGED = "stages"


@dataclass(frozen=True)
class SheetExcerpt:
    """What of a sheet is drawn, and how: as it stands after a step (`until`); `steps` such as 6-12 over what was drawn
    before them; a `strip` of pictures, one a mark or one a step; `by` stages on pages of their own, or the sheet alone;
    with the `numbers` of steps at all marks; a .png in `dpi`."""

    until: str = ""
    steps: str = ""
    strip: str = ""
    by: str = ""
    numbers: bool = False
    dpi: int | None = None


def save_sheet(scene: Scene, path: str | None, options: Options, excerpt: SheetExcerpt) -> None:
    """Write the sheet of a scene by the ending of a path, further pages beside it; without one, or where it is `-`, SVG
    on standard output."""
    from graphplan.sheet.layout.layout import pages, with_numbers
    from graphplan.sheet.strip import by_stages, strip

    name = sheet_format(path, excerpt.dpi)
    report = drawable(scene, options)
    composition = on_paper(scene, options, report).composition
    composition = with_numbers(composition) if excerpt.numbers else composition
    names = page_names(path, 2)
    more: list[Sheet] = []
    if excerpt.strip:
        sheets = strip(composition, cut=excerpt.strip)
    elif _wants_stages(excerpt, report.drawing.strict) and (name in WHOLE or len(names) > 1):
        sheets, more = by_stages(composition)
    else:
        sheets = [_requested_steps(sheet, report.drawing.drawn, excerpt) for sheet in pages(composition)]
    write_out, look = back_end(name), {"dpi": excerpt.dpi or DEFAULT_DPI} if name == "png" else {}
    if name in WHOLE:
        write_all([(path, write_out(sheets + more, *([composition.plates] if name == "dxf" else [])))])
    else:
        names = page_names(path, len(sheets), "" if excerpt.strip else PROTOCOL)
        names += page_names(path, 1 + len(more), STAGES)[1:]
        write_all([(path, write_out(sheet, **look)) for path, sheet in zip(names, sheets + more, strict=False)])


def sheet_format(path: str | None, dpi: int | None = None) -> str:
    """The format of a sheet by the ending of its path; fails with `Refused` where nothing can be written there."""
    name = kind(path, ENDINGS, "sheet").removeprefix(".")
    if dpi and name != "png":
        raise Refused(f"--dpi {dpi}", "only a .png has a resolution", "leave it out, or -o SHEET.png")
    return name


def _wants_stages(excerpt: SheetExcerpt, strict: bool) -> bool:
    """Whether stages are drawn: on request, and by default without set squares."""
    return excerpt.by == STAGED or (strict and not (excerpt.by or excerpt.until or excerpt.steps))


def _requested_steps(sheet: Sheet, drawn: Program, excerpt: SheetExcerpt) -> Sheet:
    """What of the sheet is asked for."""
    if not (excerpt.until or excerpt.steps):
        return sheet
    from graphplan.sheet.layout.layout import sheet_at_step, step_range

    first, last = step_range(drawn, excerpt.steps or excerpt.until)
    return sheet_at_step(sheet, last, first if excerpt.steps else 0)
