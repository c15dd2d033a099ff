"""Draw the construction sheet, as SVG, PDF, PNG or DXF.

The suffix of the output says which. A PDF has the sheet in true size, a DXF has each drawing step as a group; for DXF
install graphplan[dxf].

examples:
  graphplan draw alt-eight-link -o sheet.svg
  graphplan draw four-bar -o sheet.png --dpi 300
  graphplan draw scene.toml --plan polar > sheet.svg
  graphplan draw scene.toml --frame gost --language ru -o sheet.pdf
  graphplan draw four-bar --steps 6-12 -o sheet.svg    the sheet after step 12, what was there before step 6 in grey
  graphplan draw four-bar --strip -o strip.pdf         picture by picture how the construction grows
  graphplan draw scene.toml --prefer accurate --pencil point=0.2 -o sheet.pdf
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_choices, add_preference, add_sheet, chosen, presented
from graphplan.commands.output import kind, write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.kernel.program import Program
    from graphplan.methods.construction import Construction
    from graphplan.sheet.plates.display import Sheet

ENDINGS = (".svg", ".pdf", ".png", ".dxf")
DOTS, COARSEST, FINEST = 150, 20, 600  # per inch


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="SHEET.svg",
                         help="the file to write: .svg, .pdf, .png or .dxf; without it SVG on standard output")
    command.add_argument("--dpi", type=int, metavar="N", help=f"dots per inch of a .png ({DOTS})")
    add_sheet(command)
    shown = command.add_mutually_exclusive_group()
    shown.add_argument("--until", metavar="N", help="the sheet as it stands after step N")
    shown.add_argument("--steps", metavar="A-B", help="steps A to B in ink over what was drawn before them, in grey")
    shown.add_argument("--strip", nargs="?", const="mark", choices=("mark", "step"),
                       help="a film strip: a picture for every lettered mark, or for every step")
    command.add_argument("--numbers", action="store_true",
                         help="the number of its step at every mark, at those with letters too")
    add_choices(command, strict=True)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.accuracy.drafted import drafted
    from graphplan.accuracy.pencil import pencil
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load
    from graphplan.sheet.layout.layout import layout
    from graphplan.words.tongue import tongue

    ending, dpi = asked(options)
    scene, hand = presented(options, load(options.scene)), pencil(options.pencil)
    method, told = chosen(options, scene, strict=options.strict)
    found = report(scene, method=method, plan=options.plan, inertia=options.inertia, strict=options.strict)
    found.drawing.notes.extend(told)
    if options.strip:
        write(_pages(_strip(found.drawing, options), ending, dpi), options.output)
        return 0
    say = tongue(scene.sheet.language or "en")
    composition = drafted(found.drawing, hand, check=found.check, tongue=say).composition
    if options.numbers:
        from graphplan.sheet.plates.selection import with_numbers

        composition = with_numbers(composition)
    sheet = _shown(layout(found.drawing, composition=composition), found.drawing.drawn, options)
    write(_drawn(sheet, ending, dpi), options.output)
    return 0


def _strip(drawing: Construction, options: argparse.Namespace) -> list[Sheet]:
    """The pages of the film strip."""
    from graphplan.sheet.strip import strip

    return strip(drawing, single=options.strip == "step")


def _shown(sheet: Sheet, drawn: Program, options: argparse.Namespace) -> Sheet:
    """What of the sheet is asked for."""
    if not (options.until or options.steps):
        return sheet
    from graphplan.sheet.plates.selection import numbered, selected

    first, last = numbered(drawn, options.steps or options.until)
    return selected(sheet, last, first if options.steps else 0)


def asked(options: argparse.Namespace) -> tuple[str, int]:
    """What kind of file is asked for, and how many dots per inch a picture has."""
    ending, dpi = kind(options.output, ENDINGS, "sheet"), options.dpi
    if dpi is None:
        return ending, DOTS
    if ending != ".png":
        raise Refused(f"--dpi {dpi}", "only a .png has dots", "leave it out, or -o SHEET.png")
    if not COARSEST <= dpi <= FINEST:
        raise Refused(f"--dpi {dpi}", "nobody could read or keep that", f"{COARSEST} to {FINEST} dots per inch")
    return ending, dpi


def _pages(sheets: list[Sheet], ending: str, dpi: int) -> str | bytes:
    """Sheets as one file of this kind: only a PDF has pages."""
    if ending == ".pdf":
        from graphplan.output.pdf_png import pdf

        return pdf(sheets)
    if len(sheets) > 1:
        raise Refused("--strip", f"it has {len(sheets)} pages", "-o STRIP.pdf, or a larger --paper")
    return _drawn(sheets[0], ending, dpi)


def _drawn(sheet: Sheet, ending: str, dpi: int) -> str | bytes:
    """The sheet as a file of this kind."""
    match ending:
        case ".pdf":
            from graphplan.output.pdf_png import pdf

            return pdf([sheet])
        case ".png":
            from graphplan.output.pdf_png import png

            return png(sheet, dpi)
        case ".dxf":
            return _modelled(sheet)
    from graphplan.output.svg import svg

    return svg(sheet)


def _modelled(sheet: Sheet) -> bytes:
    """The sheet for CAD programs, where the package is installed that writes for them."""
    try:
        from graphplan.output.dxf import dxf
    except ModuleNotFoundError:
        raise Refused("DXF", "ezdxf is not installed", "pip install 'graphplan[dxf]', or draw it as SVG") from None
    return dxf(sheet)
