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

from graphplan.app.choices import Messages, add_subject, count, load_driven, run_subject
from graphplan.app.files import SHEETS
from graphplan.app.subjects import Subject
from graphplan.machines.subjects import ENDINGS, POSITIONS, find_motion


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
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "motion", ENDINGS, _motion)


def _motion(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The motion of the scene that is named."""
    scene = load_driven(options)
    messages.progress("motion")
    return find_motion(scene, options.speed, options.travel, options.positions, options.steady)
