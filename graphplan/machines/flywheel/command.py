"""Size a flywheel for a given speed fluctuation: Wittenbauer's diagram, as a sheet and in numbers.

SCENE has masses, loads, and a table [flywheel] with the mean speed and the unevenness, which is the coefficient of
fluctuation (omega_max - omega_min) / mean. Masses and loads are reduced to the first drive over its cycle; a constant
moment, or a factor of the loads, closes the cycle; the tangents of the energy-mass diagram give the flywheel. A table
compares other methods, with their simplifications. JSON is in kg m2, N m and J; travel is in degrees from the given
pose, in the sense of motion.

examples:
  graphplan flywheel ozols-13-6 -o sheet.svg
  graphplan flywheel ozols-13-6 --set flywheel.unevenness=0.02 --positions 36 -o flywheel.json
  graphplan flywheel ozols-13-6 --inertia 20 -o table.csv
  graphplan flywheel ozols-13-6 --by gutjahr -o sheet.svg
"""

from __future__ import annotations

import argparse
from fractions import Fraction

from graphplan.app.choices import Messages, add_subject, count, load_driven, run_subject
from graphplan.app.files import SHEETS
from graphplan.app.subjects import Subject
from graphplan.errors import Refused
from graphplan.machines.subjects import CONSTRUCTIONS, ENDINGS, find_flywheel

MIN_POSITIONS, MAX_POSITIONS = 12, 360


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FILE", help="the numbers: .json or a table, .csv; the sheet: "
        f"{', '.join(SHEETS)}; without it JSON on standard output")
    add("--inertia", metavar="X", help="find the unevenness with a flywheel of this inertia, in mass * m2")
    add("--positions", type=count("--positions", MIN_POSITIONS, MAX_POSITIONS), metavar="N",
        help="number of plans of the cycle, drawn and tabulated (24 for each turn)")
    add("--by", choices=CONSTRUCTIONS, default=CONSTRUCTIONS[0],
        help="the construction on the sheet (wittenbauer); areas take the inertia as constant")
    add("--task", action="store_true", help="the sheet with the given data alone, and tables to fill in")
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "flywheel", ENDINGS, _flywheel)


def _flywheel(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The flywheel of the scene that is named."""
    wish = {} if options.inertia is None else {"inertia": _inertia(options.inertia)}
    scene = load_driven(options)
    messages.progress("reduction and energy")
    return find_flywheel(scene, wish, positions=options.positions,
                         task=options.task and ending in SHEETS, by=options.by)


def _inertia(text: str) -> Fraction:
    """The inertia of the flywheel, in mass * m2."""
    try:
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise Refused(f"--inertia {text}", "not a number", "such as 20") from None
