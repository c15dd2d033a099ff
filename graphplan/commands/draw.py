"""Draw the construction sheet, as SVG, PDF, PNG or DXF.

The suffix of the output says which. A PDF has the sheet in true size; a DXF has the mechanism 1:1 with its dimensions,
the sheet on layouts, and each drawing step on a layer; for DXF install graphplan[dxf]. The plans come first; words for
which there is no room beside them stand on pages of their own: further pages of a PDF, layouts of a DXF, else files
such as SHEET-protocol.svg. Standard output has the first page alone.

examples:
  graphplan draw alt-eight-link -o sheet.svg
  graphplan draw four-bar -o sheet.png --dpi 300
  graphplan draw scene.toml --plan polar > sheet.svg
  graphplan draw triad --at 60 -o pose.svg             the pose 60 degrees on, constructed too
  graphplan draw scene.toml --frame gost --language ru -o sheet.pdf
  graphplan draw four-bar --steps 6-12 -o sheet.svg    the sheet after step 12, what was there before step 6 in grey
  graphplan draw triad --paper A2 --protocol aside -o sheet.svg    all on one page
  graphplan draw four-bar --strip -o strip.pdf         picture by picture how the construction grows
  graphplan draw four-bar --by stages -o stages.pdf    after the sheet, stage by stage on pages of their own
  graphplan draw four-bar --strict -o strict.pdf       the same with compasses and straightedge alone
  graphplan draw scene.toml --prefer accurate --pencil point=0.2 -o sheet.pdf
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_choices, add_preference, add_sheet, add_travel, count, drawable, on_paper
from graphplan.commands.output import kind, page_names, write, write_all
from graphplan.errors import Refused
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.kernel.program import Program
    from graphplan.sheet.plates.display import Sheet

ENDINGS = (".svg", ".pdf", ".png", ".dxf")
WHOLE = {"pdf", "dxf"}  # formats that have all pages in one file
DOTS = 150  # per inch
PROTOCOL, STAGES = "-protocol", "-stages"  # what the names of pages of words, and of stages, add to that of the sheet
STAGED = "stages"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="SHEET.svg",
                         help="the file to write: .svg, .pdf, .png or .dxf; without it SVG on standard output")
    command.add_argument("--dpi", type=count("--dpi", 20, 600), metavar="N", help=f"dots per inch of a .png ({DOTS})")
    add_sheet(command)
    group = command.add_mutually_exclusive_group()
    group.add_argument("--until", metavar="N", help="the sheet as it stands after step N")
    group.add_argument("--steps", metavar="A-B", help="steps A to B in ink over what was drawn before them, in grey")
    group.add_argument("--strip", nargs="?", const="mark", choices=("mark", "step"),
                       help="a film strip: a picture for every lettered mark, or for every step")
    group.add_argument("--by", choices=("sheet", STAGED),
                       help="the sheet alone, or after it its stages on pages of their own, enlarged, with "
                       "equation and law; --strict draws by stages unless the sheet is asked for")
    command.add_argument("--numbers", action="store_true",
                         help="the number of its step at every mark, at those with letters too")
    add_choices(command, strict=True)
    add_travel(command)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.sheet.layout.layout import pages, with_numbers
    from graphplan.sheet.strip import by_stages, strip

    name = requested_format(options)
    report = drawable(options)
    composition = on_paper(options, report).composition
    composition = with_numbers(composition) if options.numbers else composition
    names = page_names(options.output, 2)
    more: list[Sheet] = []
    if options.strip:
        sheets = strip(composition, cut=options.strip)
    elif _wants_stages(options) and (name in WHOLE or len(names) > 1):
        sheets, more = by_stages(composition)
    else:
        sheets = [_requested_steps(sheet, report.drawing.drawn, options) for sheet in pages(composition)]
    write_out, look = back_end(name), {"dpi": options.dpi or DOTS} if name == "png" else {}
    if name in WHOLE:
        write(write_out(sheets + more, *([composition.plates] if name == "dxf" else [])), options.output)
    else:
        names = page_names(options.output, len(sheets), "" if options.strip else PROTOCOL)
        names += page_names(options.output, 1 + len(more), STAGES)[1:]
        write_all([(path, write_out(sheet, **look)) for path, sheet in zip(names, sheets + more, strict=False)])
    return 0


def _wants_stages(options: argparse.Namespace) -> bool:
    """Whether stages are drawn: on request, and by default without set squares."""
    return options.by == STAGED or (options.strict and not (options.by or options.until or options.steps))


def _requested_steps(sheet: Sheet, drawn: Program, options: argparse.Namespace) -> Sheet:
    """What of the sheet is asked for."""
    if not (options.until or options.steps):
        return sheet
    from graphplan.sheet.layout.layout import sheet_at_step, step_range

    first, last = step_range(drawn, options.steps or options.until)
    return sheet_at_step(sheet, last, first if options.steps else 0)


def requested_format(options: argparse.Namespace) -> str:
    """The format that is asked for."""
    name = kind(options.output, ENDINGS, "sheet").removeprefix(".")
    if options.dpi and name != "png":
        raise Refused(f"--dpi {options.dpi}", "only a .png has a resolution", "leave it out, or -o SHEET.png")
    return name
