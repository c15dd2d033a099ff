"""Find the true motion of a machine: its speed over travel and time, from its reduced inertia and its loads.

The table [run] of the scene has the speed at the beginning (0: from rest; without it that of the first drive) and the
travel (one turn without it). With a table [flywheel] and no [run] the motion is the steady cycle, with the flywheel and
the moment that closes the cycle. The motion ends where the machine stops. Travel counts from 0 upwards in the sense in
which the drive moves, in degrees (lengths of a drive that slides).

examples:
  graphplan motion ozols-13-6 -o yoke.json                  the steady cycle with its flywheel
  graphplan motion ozols-13-6 --set run.speed=8 --set run.travel=720    two turns from 8 rad/s
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
    add("--positions", type=count("--positions", 4, 7200), metavar="N",
        help=f"number of equal parts of the travel ({POSITIONS})")
    add("--steady", action="store_true", help="the steady cycle, which repeats itself; run.speed is its mean speed")
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "motion", ENDINGS, _motion)


def _motion(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The motion of the scene that is named."""
    scene = load_driven(options)
    messages.progress("motion")
    return find_motion(scene, None, None, options.positions, options.steady)
