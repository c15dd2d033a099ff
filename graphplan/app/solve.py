"""Print the velocities, accelerations and forces, as JSON.

examples:
  graphplan solve alt-eight-link
  graphplan solve scene.toml --exact
  graphplan solve kinytskyi --digits 30
  graphplan solve scene.toml --bounds
  graphplan solve four-bar --at 60                 in the pose 60 degrees on
  graphplan solve - --method trial < scene.toml
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import add_choices, add_pencil, add_preference, add_travel, load_scene
from graphplan.app.files import write
from graphplan.app.results import find_results


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--exact", action="store_true", help='fractions, every number a string "p/q"')
    command.add_argument("--digits", type=int, metavar="N",
                         help="N proven digits of every number, as decimal strings, and the bounds that prove them")
    command.add_argument("--bounds", action="store_true",
                         help="a proven error bound of every number, relative to it and to the terms that cancel in it")
    add_choices(command, inertia=True)
    add_travel(command)
    add_preference(command)
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    results = find_results(load_scene(options), exact=options.exact, digits=options.digits, bounds=options.bounds,
                           errors=bool(options.pencil))
    write(results.text)
    return 0
