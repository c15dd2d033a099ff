"""Draw the construction sheet, as SVG, PDF, PNG or DXF.

A PDF has the sheet in true size. A DXF has the mechanism 1:1, the sheet on layouts, and each step on a layer; it needs
pip install 'graphplan[dxf]'. Words that do not fit beside the plans stand on further pages, or in files such as
SHEET-protocol.svg; standard output has the first page alone.

examples:
  graphplan draw alt-eight-link -o sheet.svg
  graphplan draw triad --at 60 -o pose.svg             the pose 60 degrees on, constructed too
  graphplan draw scene.toml --set sheet.frame=gost --language ru -o sheet.pdf
  graphplan draw four-bar --steps 6-12 -o sheet.svg    the sheet after step 12, steps before 6 in grey
  graphplan draw triad --paper A2 --set sheet.protocol=aside -o sheet.svg    all on one page
  graphplan draw four-bar --strip -o strip.pdf         picture by picture how the construction grows
  graphplan draw class-four --design                   the chosen design, and the cost of others
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import (
    Messages,
    add_choices,
    add_pencil,
    add_preference,
    add_sheet,
    add_travel,
    count,
    load_scene,
)
from graphplan.app.files import DEFAULT_DPI, STANDARD, write
from graphplan.app.pages import STAGED, save_sheet, sheet_format


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE",
                         help="the file to write: .svg, .pdf, .png or .dxf; without it SVG on standard output")
    command.add_argument("--dpi", type=count("--dpi", 20, 600), metavar="N",
                         help=f"dots per inch of a .png ({DEFAULT_DPI})")
    add_sheet(command)
    group = command.add_mutually_exclusive_group()
    group.add_argument("--steps", metavar="A-B", help="steps A to B in ink over earlier ones in grey")
    group.add_argument("--strip", nargs="?", const="mark", choices=("mark", "step"),
                       help="a film strip: one picture for each lettered mark, or for each step")
    group.add_argument("--by", choices=("sheet", STAGED),
                       help="the sheet alone, or followed by a page for each stage (the default with --strict)")
    group.add_argument("--design", action="store_true",
                       help="print the chosen design, as keys of [sheet] that fix it, and the cost of each that was "
                       "compared")
    command.add_argument("--numbers", action="store_true",
                         help="step numbers at all marks, lettered ones too")
    add_choices(command, strict=True, inertia=True)
    add_travel(command)
    add_preference(command)
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    if options.design:
        from graphplan.app.designs import design_text

        write(design_text(load_scene(options)), options.output or STANDARD)
        return 0
    sheet_format(options.output, options.dpi)  # before any work is done
    excerpt = {name: getattr(options, name) for name in ("steps", "strip", "by", "numbers", "dpi")}
    for line in save_sheet(load_scene(options), options.output, **excerpt):
        Messages(options.quiet).remark(f"{options.scene}: {line}")
    return 0
