"""Make the tasks of a class: different numbers for each student, a booklet to print, and the key.

The table [vary] of the scene has the range or the list of each varied number, by its path:
  [vary]
  "points.A.angle" = { from = 20, to = 160, step = 5 }
  "drive.0.omega" = [8, 10, 12]
A variant is kept if it can be assembled, is far from singular, and its sheet is legible at the scales of the class; for
a task of graphplan synthesize, if its mechanism exists without a new defect. Others are replaced. FOLDER gets a scene
for each variant, booklet.pdf, key.pdf, key.csv, and class.json, by which `graphplan verify FOLDER SCANS` assigns sheets
to students. The same seed gives the same files.

examples:
  graphplan variants four-bar -n 3 -o class
  graphplan variants scene.toml --names class.csv -n 32 --paper A3 -o class
  graphplan variants stroke-slider-crank -n 12 -o class     of a task of graphplan synthesize
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import Messages, add_choices, add_language, add_paper, count, load_source, sheet_keys
from graphplan.app.files import new_folder
from graphplan.marking.classroom.class_files import MAX_VARIANTS, ClassRequest
from graphplan.marking.classroom.class_variants import write_variants


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FOLDER", required=True, help="the folder to make: a new one, or an empty one")
    add("-n", "--count", type=count("-n", 1, MAX_VARIANTS), metavar="N",
        help="number of tasks (one for each name); further ones are spare")
    add("--seed", type=count("--seed", 0), default=1, metavar="S", help="seed of the random numbers (1)")
    add("--names", metavar="CLASS.csv", help="the students: a column called name or student, or else the first")
    add("--jobs", type=count("--jobs", 1), metavar="N", help="number of processes (all cores)")
    add_paper(command, "the sheets of the class (that of the scene)")
    add_language(command)
    add_choices(command, method=False)


def run(options: argparse.Namespace) -> int:
    messages = Messages(options.quiet)
    new_folder(options.output)
    request = ClassRequest(options.count, options.names, options.seed, options.jobs, sheet_keys(options),
                           messages.remark, messages.progress)
    write_variants(load_source(options, "plan"), options.output, request)
    return 0
