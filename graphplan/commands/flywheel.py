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
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_diagrams, add_language, add_pencil, count, pencil
from graphplan.commands.output import SHEETS, Messages
from graphplan.commands.subjects import Subject, add_steps, load_driven, run_subject
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.accuracy.hand import Pencil
    from graphplan.machine.flywheel.result import FlywheelResult
    from graphplan.mechanism.model import Scene
    from graphplan.output.subjects.flywheel_sheet import FlywheelSheet

MIN_POSITIONS, MAX_POSITIONS = 12, 360
AMOUNTS = {"speed": "the mean speed of the first drive, in rad/s", "inertia": "of a flywheel that is "
           "given, in mass * m2", "unevenness": "(omega_max - omega_min) / mean"}


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FILE", help="the numbers: .json or a table, .csv; the sheet: "
        f"{', '.join(SHEETS)}; without it JSON on standard output")
    for name, text in AMOUNTS.items():
        add(f"--{name}", metavar="X", help=f"{text}; without it the scene's")
    add("--closes", choices=("drive", "load"), help="what closes the cycle; without it the scene has a say")
    add("--positions", type=count("--positions", MIN_POSITIONS, MAX_POSITIONS), metavar="N",
        help="in how many plans of the cycle it is drawn and tabled (24 of each turn)")
    add_pencil(command)
    add("--task", action="store_true", help="the sheet with what is given alone, and tables to fill in")
    add_diagrams(command)
    add_language(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "flywheel", (".json", ".csv", *SHEETS), find_flywheel)


def find_flywheel(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The flywheel of the scene that is named."""
    from graphplan.check.motion import check_flywheel
    from graphplan.machine.flywheel.result import flywheel
    from graphplan.output.subjects.flywheel_numbers import numbers, table

    scene = load_driven(options, partial(_with_wish, options=options))
    messages.progress("reduction and energy")
    result = flywheel(scene, options.positions)
    messages.progress("second opinion")
    result = replace(result, check=check_flywheel(result))

    def sheet(paper: str) -> FlywheelSheet:
        from graphplan.output.subjects.flywheel_sheet import FlywheelSheet

        return FlywheelSheet(paper, result, options.task and ending in SHEETS)

    return Subject(sheet, lambda: numbers(result, pencil_errors(result, pencil(options))[0]), scene.sheet.paper,
                   ("A2", "A1"), {".csv": partial(table, result)}, [f"{scene.name}: {note}" for note in result.notes])


def _with_wish(scene: Scene, options: argparse.Namespace) -> Scene:
    """The scene with its table as the options have it."""
    from graphplan.mechanism.model import Flywheel

    amounts = {name: _amount(name, text) for name in AMOUNTS if (text := getattr(options, name)) is not None}
    if "inertia" in amounts and "unevenness" in amounts:
        raise Refused("--inertia and --unevenness", "each follows from the other", "one of them")
    if scene.flywheel is None and not ("speed" in amounts and len(amounts) > 1):
        return scene
    wish = scene.flywheel or Flywheel(amounts["speed"])
    if "inertia" in amounts or "unevenness" in amounts:
        wish = replace(wish, inertia=None, unevenness=None)
    wish = replace(wish, **amounts, closes=options.closes or wish.closes)
    return replace(scene, flywheel=wish)


def _amount(name: str, text: str) -> Fraction:
    """The number of an option, above 0; of an inertia at least 0."""
    try:
        amount = Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise Refused(f"--{name} {text}", "not a number", "such as 0.02") from None
    limit = 2 if name == "unevenness" else None
    if amount < 0 or (amount == 0 and name != "inertia") or (limit and amount >= limit):
        raise Refused(f"--{name} {text}", "out of range", "more than 0 and less than 2" if limit else "more than 0")
    return amount


def pencil_errors(result: FlywheelResult, pencil: Pencil) -> tuple[float, float]:
    """The standard deviations by the pencil of the drawn flywheel, or unevenness, and of the mean moment."""
    from graphplan.accuracy.first_order import deviation
    from graphplan.accuracy.hand import program_hand

    drawing, values = result.drawing, result.drawing.values
    hand = program_hand(values.drawing.program, values.numbers, lambda step: 1.0, pencil)
    (m,), (n,), (mean,) = (values.drawing.roles[role] for role in ("m", "n", "mean"))
    intercept = deviation(hand, lambda values: values[m][1] - values[n][1]) * drawing.frames["energy"].y.unit
    return (intercept * drawing.change(result.given),
            deviation(hand, lambda values: values[mean][1]) * drawing.frames["moment"].y.unit)
