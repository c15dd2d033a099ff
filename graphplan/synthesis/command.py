"""Synthesize a mechanism: guidance, function, stroke, path, dwell, Geneva wheel, conjugate profile, gears.

TASK is a TOML file with one of the tables guidance, function, stroke, cognates, dwell, geneva, conjugate and gear;
`graphplan schema synthesize` prints its JSON Schema. The construction is drawn in ordered steps and compared with an
independent check; each linkage is followed through its positions, and branch, circuit and order defects are reported.
A .toml is the mechanism as a scene for draw, solve, cycle and live; JSON has the numbers of all solutions; a .dxf of
gears has both wheels in true size. If the construction does not exist the exit status is 3, with the reason and a
remedy.

examples:
  graphplan synthesize guidance-22-8 -o plane.svg   a packaged task, as `graphplan list tasks` has them
  graphplan synthesize plane.toml -o plane.svg
  graphplan synthesize plane.toml --task -o task.pdf    what is given alone, for students
  graphplan synthesize plane.toml                   the numbers, as JSON
  graphplan synthesize plane.toml --solution 2 -o found.toml && graphplan cycle found.toml --positions 36

a task:
  title = "A plane through three positions"
  [guidance]
  positions = [[0, 0, 90], [5.6, 6.4, 0], [13.45, 7.6, -60]]   # origin and axis
  moving = [[1, 0.5], [4, -2]]                                 # A and B in the plane
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import Messages, add_subject, count, read_task, run_subject
from graphplan.app.subjects import Subject
from graphplan.synthesis.subject import SYNTHESIS_ENDINGS, find_subject

DRAWN = (".svg", ".pdf", ".png", ".tex", ".dxf")  # the sheet


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("task", metavar="TASK", help="a task file, a packaged task, or - for standard input")
    add("-o", "--output", metavar="FILE", help="the file to write: .svg, .pdf, .png, .tex or .dxf, the sheet (a "
        ".dxf of gears: the wheels); .json, the numbers; .toml, a scene; without it the numbers on standard output")
    add("--solution", type=count("--solution", 1), metavar="N", help="the solution on the sheet or in the scene (1)")
    add("--task", dest="unsolved", action="store_true", help="the sheet with what is given alone, and boxes to fill in")
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "synthesis", SYNTHESIS_ENDINGS, _synthesis, paper=DRAWN)


def _synthesis(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """Solve the named task."""
    from graphplan.synthesis.task import load, parse

    task = read_task(options, load, parse)
    messages.progress("construction")
    return find_subject(task, options.solution or 1, options.unsolved)
