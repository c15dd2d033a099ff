"""Export the construction: to GeoGebra and LaTeX step by step, as data, as code, or its sheet.

In the step formats every mark depends on the marks that it was drawn from, so that joints can be dragged; the plans
stand as on the sheet. Code computes the results of the scene in any poses, without libraries; its first lines describe
input, output and compilation. The suffix of the output chooses the format, unless one is named.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphplan.app.choices import add_choices, add_sheet, load_source
from graphplan.app.files import STANDARD, as_json, kind, write
from graphplan.app.steps import data
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.output import back_end, formats

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted

STYLE = "graphplan.sty"
LATEX = "bare", "width"  # options that LaTeX alone has a use for
MAX_WIDTH = 2000.0  # mm: the widest picture

__doc__ = f"""{__doc__}
formats:
""" + "".join(f"  {name:12} {format.suffix:6} {format.told}\n" for name, format in formats().items()) + """
examples:
  graphplan export rosenauer-basic -o chain.ggb
  graphplan export scene.toml -o figure.tex --language de
  graphplan export scene.toml -o figure.tex --bare --width 0.8
  graphplan export four-bar -o plan.c
"""


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the file to write")
    command.add_argument("--format", choices=tuple(formats()),
                         help="the format (by the suffix of FILE)")
    command.add_argument("--bare", action="store_true", help="LaTeX: the picture alone, for \\input, with "
                         f"{STYLE}, the style of all pictures, in the same folder")
    command.add_argument("--width", type=_width, metavar="W", help="LaTeX: width of the picture in mm, or up to 1 as "
                         "a part of \\linewidth; plans and letters are placed for it (as on the sheet)")
    add_sheet(command)
    add_choices(command, method=False)


def run(options: argparse.Namespace) -> int:
    name = format_of(options.output, options.format)
    more, write_out = _extra_options(name, options), back_end(name)
    write(write_out(*READ[formats()[name].reads](_source_on_paper(name, options)), **more), options.output)
    if options.bare and options.output != STANDARD:
        from graphplan.exports.latex import package

        write(package(), str(Path(options.output).parent / STYLE))
    return 0


def _source_on_paper(name: str, options: argparse.Namespace) -> Drafted:
    """A scene on its sheet, or a task of a synthesis in one of the step formats."""
    from graphplan.app.drafting import on_paper

    source = load_source(options, "plan", "inertia")
    if isinstance(source, Scene):
        return on_paper(source)
    if formats()[name].reads not in ("plates", "composition"):
        raise Refused(f"{options.output}: output", f"a task of a synthesis is not exported as {name}",
                      "GeoGebra or LaTeX; sheets, numbers and scenes are of graphplan synthesize -o")
    return source.on_paper()


def export(name: str, on_sheet: Drafted) -> str | bytes:
    """A construction on its sheet in the format of this name; fails with `Refused` where that cannot be had."""
    content: str | bytes = back_end(name)(*READ[formats()[name].reads](on_sheet))
    return content


def format_of(output: str, named: str | None) -> str:
    """The format of a file: the one named, else the first of its suffix."""
    if named:
        kind(output, (formats()[named].suffix,), named)
        return named
    endings = tuple(dict.fromkeys(format.suffix for format in formats().values()))
    if not Path(output).suffix:
        raise Refused(f"{output}: output", "the name has no suffix that tells the format",
                      f"a name in {', '.join(endings)}, or --format {'|'.join(formats())}")
    if Path(output).suffix.lower() == ".html":
        raise Refused(f"{output}: output", "pages are written by another command", f"graphplan live SCENE -o {output}")
    suffix = kind(output, endings, "construction")
    return next(name for name, format in formats().items() if format.suffix == suffix)


def _extra_options(name: str, options: argparse.Namespace) -> Mapping[str, Any]:
    """The options of a back end; fails with `Refused` where one does not apply to it."""
    given = {option: value for option in LATEX if (value := getattr(options, option))}
    if given and formats()[name].suffix != ".tex":
        raise Refused(f"--{next(iter(given))}", f"it does not apply to {name}", "leave it out, or export LaTeX, .tex")
    return given


def _width(text: str) -> float:
    try:
        width = float(text)
    except ValueError:
        width = 0.0
    if not 0 < width <= MAX_WIDTH:
        raise Refused("--width", text, f"mm up to {MAX_WIDTH:g}, or a part of \\linewidth up to 1")
    return width


def _sheet(on_sheet: Drafted) -> Any:
    from graphplan.sheet.layout.layout import layout

    return layout(on_sheet.composition)


def _sheets(on_sheet: Drafted) -> Any:
    from graphplan.sheet.layout.layout import pages

    return pages(on_sheet.composition)


READ: dict[str, Callable[[Drafted], tuple[Any, ...]]] = {  # what back ends read
    "plates": lambda on_sheet: (on_sheet.composition.plates,),
    "composition": lambda on_sheet: (on_sheet.composition,),
    "construction": lambda on_sheet: (on_sheet.drawing,),
    "sheet": lambda on_sheet: (_sheet(on_sheet),),
    "sheets": lambda on_sheet: (_sheets(on_sheet),),
    "sheets on plates": lambda on_sheet: (_sheets(on_sheet), on_sheet.composition.plates),
    "steps": lambda on_sheet: (as_json(data(on_sheet)),),
}
