"""Write handouts: the task for students, the guided construction, the solution; or a page that shows the steps.

A PDF has the task sheet, its guided version and the solution, in true size and in the same frame, so that a drawing
can be laid over the solution. A .html is the live page, for a browser without a network, with the steps in front: step
by step, in any pose of the mechanism.

examples:
  graphplan handout four-bar -o four-bar.pdf
  graphplan handout scene.toml --only task --paper A3 -o task.pdf
  graphplan handout scene.toml -o steps.html
  graphplan handout guidance-22-8 --language de -o plane.pdf     a task of graphplan synthesize
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import add_choices, add_offer, add_sheet, add_travel, load_source
from graphplan.app.files import PARTS, handout_ending
from graphplan.app.pages import save_handout


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the file to write: .pdf or .html")
    command.add_argument("--only", choices=PARTS, help="this part of a .pdf alone")
    add_sheet(command)
    add_choices(command, method=False)
    add_travel(command)
    add_offer(command)


def run(options: argparse.Namespace) -> int:
    handout_ending(options.output, options.only)
    save_handout(load_source(options, "plan", "at"), options.output, options.only, options.choices)
    return 0
