"""Export the construction: to GeoGebra, JSXGraph, GCLC and LaTeX step by step, or as data, or its sheet.

In the step formats every mark depends on the marks that it was drawn from, so a joint can be dragged where the program
lets one drag; the plans stand where they stand on the sheet. The suffix of the output says which format, unless one is
named.
"""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.commands.choices import add_choices, add_preference, add_sheet, chosen, presented
from graphplan.commands.output import kind, write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted


class Format(NamedTuple):
    """A format: how its files end, what it is in a line, and the back end: its module, what it is called and reads.

    `extra` is what installs a library that it needs and that does not come with graphplan.
    """

    suffix: str
    told: str
    module: str
    function: str
    reads: str
    extra: str = ""


FORMATS = {
    "ggb": Format(".ggb", "GeoGebra, 4.0 and later", "exports.geogebra", "geogebra", "figure"),
    "jsxgraph": Format(".html", "a web page of JSXGraph elements", "exports.jsxgraph", "jsxgraph", "figure"),
    "gcl": Format(".gcl", "GCLC, the language of constructions", "exports.gclc", "gclc", "figure"),
    "tikz": Format(".tex", "LaTeX with TikZ", "exports.tikz", "tikz", "figure"),
    "tkz-euclide": Format(".tex", "LaTeX with tkz-euclide, by --format", "exports.tkz", "tkz_euclide", "figure"),
    "json": Format(".json", "the steps as data", "", "", "steps"),
    "svg": Format(".svg", "the sheet as SVG", "svg", "svg", "sheet"),
    "pdf": Format(".pdf", "the sheet as PDF, in true size", "pdf_png", "pdf", "sheets"),
    "png": Format(".png", "the sheet as a picture", "pdf_png", "png", "sheet"),
    "dxf": Format(".dxf", "the sheet for CAD programs", "dxf", "dxf", "sheet", "dxf"),
}
__doc__ = f"""{__doc__}
formats:
""" + "".join(f"  {name:12} {format.suffix:6} {format.told}\n" for name, format in FORMATS.items()) + """
examples:
  graphplan export rosenauer-basic -o chain.ggb
  graphplan export scene.toml -o page.html --library jsxgraphcore.js
  graphplan export scene.toml -o figure.tex --format tkz-euclide --language de
"""


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the file to write")
    command.add_argument("--format", choices=tuple(FORMATS),
                         help="the format; without it the suffix of FILE says which")
    command.add_argument("--library", metavar="FILE",
                         help="a copy of jsxgraphcore.js that goes into the page, which is then complete in itself")
    add_sheet(command)
    add_choices(command, strict=True)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.accuracy.drafted import drafted
    from graphplan.accuracy.pencil import pencil
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load
    from graphplan.words.tongue import tongue

    name = format_of(options.output, options.format)
    more = _more(name, options.library)
    write_out = back_end(name)
    scene, hand = presented(options, load(options.scene)), pencil(options.pencil)
    method, told = chosen(options, scene, strict=options.strict)
    found = report(scene, method=method, plan=options.plan, inertia=options.inertia, strict=options.strict)
    found.drawing.notes.extend(told)
    say = tongue(scene.sheet.language or "en")
    on_sheet = drafted(found.drawing, hand, check=found.check, tongue=say)
    write(write_out(READ[FORMATS[name].reads](on_sheet), **more), options.output)
    return 0


def format_of(output: str, named: str | None) -> str:
    """The format of a file: the one named, else the first of its suffix."""
    if named:
        kind(output, (FORMATS[named].suffix,), named)
        return named
    endings = tuple(dict.fromkeys(format.suffix for format in FORMATS.values()))
    if not Path(output).suffix:
        raise Refused(f"{output}: output", "a name without a suffix is no format",
                      f"a name in {', '.join(endings)}, or --format {'|'.join(FORMATS)}")
    suffix = kind(output, endings, "construction")
    return next(name for name, format in FORMATS.items() if format.suffix == suffix)


def _more(name: str, library: str | None) -> Mapping[str, str]:
    """What a back end is told beside the construction: the text of a library that is given."""
    if library is None:
        return {}
    if name != "jsxgraph":
        raise Refused(f"--library {library}", f"{name} has no place for it", "leave it out, or export a page, .html")
    try:
        return {"script": Path(library).read_text(encoding="utf-8")}
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or "this is no text"
        raise Refused(f"--library {library}", f"cannot be read ({why})", "name a copy of jsxgraphcore.js") from None


def back_end(name: str) -> Callable[..., str | bytes]:
    """The function that writes a format."""
    format = FORMATS[name]
    if not format.module:
        return _data
    try:
        module = importlib.import_module(f"graphplan.output.{format.module}")
    except ModuleNotFoundError as missing:
        if not format.extra:
            raise
        raise Refused(f"format {name}", f"{missing.name} is not installed",
                      f"pip install 'graphplan[{format.extra}]', or another format") from None
    function: Callable[..., str | bytes] = getattr(module, format.function)
    return function


def _data(data: Mapping[str, Any]) -> str:
    import json

    return json.dumps(data, indent=1, ensure_ascii=False) + "\n"


def _figure(on_sheet: Drafted) -> Any:
    from graphplan.output.exports.figure import figure

    return figure(on_sheet.drawing, on_sheet.composition, on_sheet.composition.plans.tongue)


def _sheet(on_sheet: Drafted) -> Any:
    from graphplan.sheet.layout.layout import layout

    return layout(on_sheet.drawing, composition=on_sheet.composition)


def _sheets(on_sheet: Drafted) -> Any:
    return [_sheet(on_sheet)]


def _steps(on_sheet: Drafted) -> Any:
    """The same as `graphplan steps --json` prints."""
    from graphplan.mechanism.structure import structure
    from graphplan.output.text import steps

    drawing, say = on_sheet.drawing, on_sheet.composition.plans.tongue
    return steps(drawing, structure(drawing.scene).lines(), say) | {"cost": on_sheet.cost.data, "pencil": on_sheet.data}


READ = {"figure": _figure, "sheet": _sheet, "sheets": _sheets, "steps": _steps}  # what back ends read
