"""The true motion of a machine: its speed over travel and time, from its reduced inertia and the loads of the scene.

Without [flywheel] and [run] it starts with the speed of the first drive (omega = 0: from rest) and goes one turn under
the scene's loads alone; with [flywheel] it is the steady cycle, with the wheel and with what closes the cycle. Options
say otherwise. Where the energy is used up the machine stops, and nothing is known beyond. Travel counts from 0 upwards
in the sense in which the drive moves, in degrees (lengths of a drive that slides).

examples:
  graphplan motion ozols-13-6 -o yoke.json                  the steady cycle with its flywheel
  graphplan motion ozols-13-6 --speed 0 --travel 720        two turns from rest
  graphplan motion ozols-13-7 -o loader.svg                 its diagrams, drawn step by step
  graphplan motion scene.toml --steady --positions 72 -o cycle.csv
"""

from __future__ import annotations

import argparse
import math

from graphplan.commands.choices import add_diagrams, add_steps, count, on_sheet, question, refuse_steps, with_steps
from graphplan.commands.output import SHEETS, Messages, as_json, kind, write, write_sheets
from graphplan.errors import Refused

ENDINGS = (".json", ".csv", *SHEETS)
POSITIONS, MOST = 24, 96  # without a word, and that can be drawn


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FILE", help=".json, the numbers, or .csv, a table of them; "
        f"{', '.join(SHEETS)}, the sheet; without it JSON on standard output")
    add("--speed", type=float, metavar="W0", help="the first drive's speed at the beginning, in rad/s (length/s); 0: "
        "from rest; with --steady its mean")
    add("--travel", type=float, metavar="DEGREES", help="how far the motion is followed, in degrees (lengths of a "
        "drive that slides); without it one turn")
    add("--positions", type=count("--positions", 4, 7200), metavar="N",
        help=f"in how many equal parts of the travel ({POSITIONS})")
    add("--steady", action="store_true", help="the cycle that repeats itself")
    add_diagrams(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.motion import check_motion
    from graphplan.machine.motion.drawing import drawn
    from graphplan.machine.motion.runs import run as motion_of
    from graphplan.mechanism.scene import parse, source_text
    from graphplan.output.subjects import motion_numbers

    ending = kind(options.output, ENDINGS, "motion")
    refuse_steps(options, ending)
    for name in ("speed", "travel"):
        if (value := getattr(options, name)) is not None and not math.isfinite(value):
            raise Refused(f"--{name}", f"{value:g}", "give a number")
    messages, positions = Messages(options.quiet), options.positions or POSITIONS
    scene = on_sheet(options, parse(source_text(options.scene, options.scene), options.scene, by_drive=True))
    question(options, scene)
    found = motion_of(scene, options.speed, options.travel, options.steady)
    drawing = drawn(found.motion, min(positions, MOST))
    check = check_motion(found, drawing)
    if (stop := found.motion.stop) is not None:
        when = f"after {stop.time:.6g} s" if math.isfinite(stop.time) else "and nears it for ever"
        messages.remark(f"{scene.name}: the machine stops at {found.machine.told(stop.travel)}, {when}")
    if found.reduction.friction is not None:
        messages.remark(f"{scene.name}: friction is taken as it is at the speed of the drive in the scene")
    if ending in SHEETS:
        from graphplan.output.subjects.motion_sheet import sheets

        pages = sheets(found, min(positions, MOST), scene.sheet.paper or None)
        write_sheets(pages, options.output, ending[1:], options.dpi)
    elif ending == ".csv":
        write(motion_numbers.text(found, positions), options.output)
    else:
        from graphplan.output.subjects.motion_sheet import PAPERS, MotionSheet

        data = with_steps(options, motion_numbers.numbers(found, drawing, check, positions), lambda: MotionSheet(
            scene.sheet.paper or PAPERS[0], found, min(positions, MOST)))
        write(as_json(data), options.output)
    return 0
