"""Draw the construction sheet, as SVG.

examples:
  graphplan draw alt-eight-link -o sheet.svg
  graphplan draw scene.toml --plan polar > sheet.svg
  graphplan draw scene.toml --prefer accurate --pencil point=0.2 > sheet.svg
"""

from __future__ import annotations

import argparse

from graphplan.commands.choices import add_choices, add_preference, chosen, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="SHEET.svg", help="the file to write; without it standard output")
    command.add_argument("--paper", choices=("A4", "A3", "A2", "A1"),
                         help="the sheet; without it the smallest that will do")
    add_choices(command)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    from graphplan import sheet
    from graphplan.check.report import report
    from graphplan.drafting.drafted import drafted
    from graphplan.drafting.pencil import pencil
    from graphplan.mechanism.scene import load

    scene, hand = load(options.scene), pencil(options.pencil)
    method, told = chosen(options, scene, paper=options.paper)
    found = report(scene, method=method, plan=options.plan, inertia=options.inertia)
    found.drawing.notes.extend(told)
    composition = drafted(found.drawing, hand, options.paper, found.check).composition
    write(sheet.svg(found.drawing, composition=composition), options.output)
    return 0
