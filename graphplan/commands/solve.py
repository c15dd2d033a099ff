"""Print the velocities, accelerations and forces, as JSON.

examples:
  graphplan solve alt-eight-link
  graphplan solve scene.toml --exact
  graphplan solve kinytskyi --digits 30
  graphplan solve scene.toml --bounds
  graphplan solve - --method trial < scene.toml
"""

from __future__ import annotations

import argparse
import json
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from graphplan.commands.choices import add_choices, add_preference, chosen, rounded
from graphplan.commands.output import write
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.check.report import Report
    from graphplan.mechanism.model import Scene


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--exact", action="store_true", help='fractions, every number a string "p/q"')
    command.add_argument("--digits", type=int, metavar="N",
                         help="N proven digits of every number, as decimal strings, and the bounds that prove them")
    command.add_argument("--bounds", action="store_true",
                         help="a proven bound for every number, relative to itself and to what cancels in it")
    add_choices(command)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.json_results import data
    from graphplan.check.report import report
    from graphplan.mechanism.scene import load

    scene = rounded(options, load(options.scene))
    how = {"method": chosen(options, scene)[0], "plan": options.plan, "inertia": options.inertia}
    if options.digits is not None:
        return _certified(options, scene, how)
    found = report(scene, exact=options.exact, alone=not options.pencil, **how)
    return _printed(data(found, each=options.bounds) | _errors(options, found), True)


def _errors(options: argparse.Namespace, found: Report) -> dict[str, Any]:
    """How far off each result is drawn, where a pencil is given."""
    if not options.pencil:
        return {}
    from graphplan.accuracy.drafted import drafted
    from graphplan.accuracy.pencil import pencil

    return {"pencil": drafted(found.drawing, pencil(options.pencil), check=found.check).data}


def _certified(options: argparse.Namespace, scene: Scene, how: dict[str, str]) -> int:
    """The same between proven bounds."""
    if options.exact:
        raise Refused("--digits", "with --exact every digit is there", "leave out one of the two")
    if find_spec("flint") is None:
        raise Refused("--digits", "proven digits need python-flint", "install graphplan[certified]")
    from graphplan.check.certified import certified

    found = certified(scene, options.digits, **how)
    return _printed(found.data, found.agrees)


def _printed(table: dict[str, Any], agrees: bool) -> int:
    """The results on standard output, and the exit status."""
    write(json.dumps(table, indent=2, ensure_ascii=False) + "\n")
    return 0 if agrees else 1
