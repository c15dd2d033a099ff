"""Find the flywheel with which a machine runs as evenly as is asked: Wittenbauer's diagram, drawn and in numbers.

SCENE has masses, loads, and a table [flywheel] with the mean speed and the unevenness; options say otherwise. Over the
cycle of the first drive all is reduced to it, a constant moment or a factor of the loads closes the cycle, and the
tangents of the energy-mass diagram give the flywheel. Other methods are tabled beside it with what they neglect. JSON
has kg m2, N m and J, travel in degrees in the sense of motion, from the
given pose. With --inertia the flywheel is given, and the unevenness found.

examples:
  graphplan flywheel ozols-13-6 -o sheet.svg
  graphplan flywheel ozols-13-6 --unevenness 0.02 --positions 36 -o flywheel.json
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
AMOUNTS = {"inertia": "of a flywheel that is given, in mass * m2", "unevenness": "(omega_max - omega_min) / mean"}


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FILE", help="the numbers: .json or a table, .csv; the sheet: "
        f"{', '.join(SHEETS)}; without it JSON on standard output")
    for name, text in AMOUNTS.items():
        add(f"--{name}", metavar="X", help=f"{text}; without it the scene's")
    add("--positions", type=count("--positions", MIN_POSITIONS, MAX_POSITIONS), metavar="N",
        help="in how many plans of the cycle it is drawn and tabled (24 of each turn)")
    add("--by", choices=CONSTRUCTIONS, default=CONSTRUCTIONS[0],
        help="the construction that the sheet draws (wittenbauer); areas take the inertia as constant")
    add("--task", action="store_true", help="the sheet with what is given alone, and tables to fill in")
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "flywheel", ENDINGS, _flywheel)


def _flywheel(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The flywheel of the scene that is named."""
    wish = {name: _amount(name, text) for name in AMOUNTS if (text := getattr(options, name)) is not None}
    scene = load_driven(options)
    messages.progress("reduction and energy")
    return find_flywheel(scene, wish, positions=options.positions,
                         task=options.task and ending in SHEETS, by=options.by)


def _amount(name: str, text: str) -> Fraction:
    """The number of an option."""
    try:
        return Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise Refused(f"--{name} {text}", "not a number", "such as 0.02") from None
