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
from importlib.util import find_spec

from graphplan.commands.choices import add_choices, add_preference, add_travel, drawn_by, load_scene, make_report
from graphplan.commands.output import as_json, write
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.replaced import scene_beyond


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--exact", action="store_true", help='fractions, every number a string "p/q"')
    command.add_argument("--digits", type=int, metavar="N",
                         help="N proven digits of every number, as decimal strings, and the bounds that prove them")
    command.add_argument("--bounds", action="store_true",
                         help="a proven bound for every number, relative to itself and to what cancels in it")
    add_choices(command)
    add_travel(command)
    add_preference(command)


def run(options: argparse.Namespace) -> int:
    if options.digits is not None:
        return _run_certified(options)
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.json_results import result_data

    report = report_regular_part(load_scene(options), lambda scene: make_report(options, scene, exact=options.exact,
                                                                                alone=not options.pencil))
    printed = result_data(report, each=options.bounds)
    if options.pencil:
        from graphplan.accuracy.drafted import draft

        printed["pencil"] = draft(report.drawing, options.pencil, check=report.check).data
    if after := scene_beyond(report.scene):
        after_data = result_data(make_report(options, after, exact=options.exact, alone=not options.pencil))
        printed["beyond"] = {section: after_data[section] for section in ("points", "links", "slides")}
    write(as_json(printed, 2))
    return 0


def _run_certified(options: argparse.Namespace) -> int:
    """The same between proven bounds."""
    if options.exact:
        raise Refused("--digits", "--exact already gives every digit", "leave out one of the two")
    if find_spec("flint") is None:
        raise Refused("--digits", "proven digits need python-flint", "install graphplan[certified]")
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.certified import Certified, certify

    def proven(scene: Scene) -> Certified:
        how, _ = drawn_by(options, scene)
        return certify(scene, options.digits, method=how["method"], plan=options.plan, inertia=options.inertia)

    certified_report = report_regular_part(load_scene(options), proven)
    if not certified_report.agrees:
        raise certified_report.disagreement
    write(as_json(certified_report.data, 2))
    return 0
