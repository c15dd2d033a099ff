"""Draw the construction sheet, as SVG.

examples:
  graphplan draw alt-eight-link -o sheet.svg
  graphplan draw scene.toml --plan polar > sheet.svg
"""

from __future__ import annotations

import argparse

from graphplan.commands.choices import add_choices, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="SHEET.svg", help="the file to write; without it standard output")
    command.add_argument("--paper", choices=("A4", "A3", "A2", "A1"),
                         help="the sheet; without it the smallest that will do")
    add_choices(command)


def run(options: argparse.Namespace) -> int:
    from graphplan import sheet
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load

    found = report(load(options.scene), method=options.method, plan=options.plan, inertia=options.inertia)
    write(sheet.svg(found.drawing, paper=options.paper, check=found.check), options.output)
    return 0
