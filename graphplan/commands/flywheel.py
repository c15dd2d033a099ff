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
from typing import TYPE_CHECKING

from graphplan.commands.choices import (
    add_diagrams,
    add_pencil,
    add_steps,
    count,
    on_sheet,
    pencil,
    question,
    refuse_steps,
    with_steps,
)
from graphplan.commands.output import SHEETS, Messages, as_json, kind, write, write_sheets
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.accuracy.hand import Pencil
    from graphplan.machine.flywheel.result import FlywheelResult
    from graphplan.mechanism.model import Scene
    from graphplan.output.subjects.flywheel_sheet import FlywheelSheet

ENDINGS = (".json", ".csv", *SHEETS)
FEWEST, MOST = 12, 360
AMOUNTS = {"speed": "the mean speed of the first drive, in rad/s", "inertia": "of a flywheel that is "
           "given, in mass * m2", "unevenness": "(omega_max - omega_min) / mean"}


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FILE", help="the numbers: .json or a table, .csv; the sheet: "
        f"{', '.join(SHEETS)}; without it JSON on standard output")
    for name, told in AMOUNTS.items():
        add(f"--{name}", metavar="X", help=f"{told}; without it the scene's")
    add("--closes", choices=("drive", "load"), help="what closes the cycle; without it the scene has a say")
    add("--positions", type=count("--positions", FEWEST, MOST), metavar="N",
        help="in how many plans of the cycle it is drawn and tabled (24 of each turn)")
    add_pencil(command)
    add("--task", action="store_true", help="the sheet with what is given alone, and tables to fill in")
    add_diagrams(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.motion import check_flywheel
    from graphplan.machine.flywheel.result import flywheel
    from graphplan.mechanism.scene import parse, source_text
    from graphplan.output.subjects.flywheel_numbers import numbers, table

    ending, messages = kind(options.output, ENDINGS, "flywheel"), Messages(options.quiet)
    refuse_steps(options, ending)
    text = source_text(options.scene, options.scene)
    scene = on_sheet(options, _asked(parse(text, options.scene, by_drive=True), options))
    question(options, scene)
    messages.progress("reduction and energy")
    found = flywheel(scene, options.positions)
    messages.progress("second opinion")
    result = replace(found, check=check_flywheel(found))
    messages.progress("")
    for note in result.notes:
        messages.remark(f"{scene.name}: {note}")
    if ending in SHEETS:
        from graphplan.output.subjects.flywheel_sheet import sheets

        pages = sheets(result, scene.sheet.paper or None, options.task)
        write_sheets(pages, options.output, ending[1:], options.dpi)
    else:
        error, _ = pencil_errors(result, pencil(options))
        if ending == ".csv":
            write(table(result), options.output)
        else:
            write(as_json(with_steps(options, numbers(result, error), lambda: _sheet(result)), rows=True),
                  options.output)
    return 0


def _sheet(result: FlywheelResult) -> FlywheelSheet:
    """The sheet on the scene's paper, or on A2."""
    from graphplan.output.subjects.flywheel_sheet import PAPERS, FlywheelSheet

    return FlywheelSheet(result.scene.sheet.paper or PAPERS[0], result)


def _asked(scene: Scene, options: argparse.Namespace) -> Scene:
    """The scene with its table as the options have it."""
    from graphplan.mechanism.model import Flywheel

    said = {name: _amount(name, text) for name in AMOUNTS if (text := getattr(options, name)) is not None}
    if "inertia" in said and "unevenness" in said:
        raise Refused("--inertia and --unevenness", "each follows from the other", "one of them")
    if scene.flywheel is None and not ("speed" in said and len(said) > 1):
        return scene
    wish = scene.flywheel or Flywheel(said["speed"])
    if "inertia" in said or "unevenness" in said:
        wish = replace(wish, inertia=None, unevenness=None)
    wish = replace(wish, **said, closes=options.closes or wish.closes)
    return replace(scene, flywheel=wish)


def _amount(name: str, text: str) -> Fraction:
    """The number of an option, above nothing."""
    try:
        found = Fraction(text)
    except (ValueError, ZeroDivisionError):
        raise Refused(f"--{name} {text}", "not a number", "such as 0.02") from None
    most = 2 if name == "unevenness" else None
    if found < 0 or (found == 0 and name != "inertia") or (most and found >= most):
        raise Refused(f"--{name} {text}", "out of range", "more than 0 and less than 2" if most else "more than 0")
    return found


def pencil_errors(result: FlywheelResult, pencil: Pencil) -> tuple[float, float]:
    """The standard deviations by the pencil of the drawn flywheel, or unevenness, and of the mean moment."""
    from graphplan.accuracy.first_order import deviation
    from graphplan.accuracy.hand import program_hand

    drawing = result.drawing
    hand = program_hand(drawing.program, drawing.values, lambda step: 1.0, pencil)
    (m,), (n,), (mean,) = (drawing.marks[role] for role in ("m", "n", "mean"))
    off = deviation(hand, lambda values: values[m][1] - values[n][1]) * drawing.frames["energy"].y.unit
    return (off * drawing.change(result.given),
            deviation(hand, lambda values: values[mean][1]) * drawing.frames["moment"].y.unit)
