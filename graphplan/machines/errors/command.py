"""Find the position errors caused by dimensional tolerances, by transformed mechanisms.

SCENE has a table [tolerances]. The drives are held, and each dimension is replaced by a pair that changes it; the
velocities of this mechanism are the partial errors. JSON has the coefficient and the error of each dimension, their sum
and the probable error, for the slides and links that [find] asks for, else for the last link. The sheet has a plan for
each dimension, and the table.

examples:
  graphplan errors press.toml
  graphplan errors press.toml -o sheet.svg
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import Messages, add_language, add_settings, load_scene
from graphplan.app.files import kind
from graphplan.machines.errors.subject import ERROR_ENDINGS, find_errors


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", help="the sheets: .svg, .pdf, .png, .tex or .dxf; the "
                         "numbers: .json; without it JSON on standard output")
    add_settings(command)
    add_language(command)


def run(options: argparse.Namespace) -> int:
    kind(options.output, ERROR_ENDINGS, "errors")
    errors = find_errors(load_scene(options))
    Messages(options.quiet).progress("")
    errors.save(options.output)
    return 0
