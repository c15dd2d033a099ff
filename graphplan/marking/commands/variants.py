"""Make the tasks of a class: to each student other numbers, a booklet to print, and the key.

What varies stands in the scene, by the path of a number, as a range or a list:
  [vary]
  "points.A.angle" = { from = 20, to = 160, step = 5 }
  "drive.0.omega" = [8, 10, 12]
A variant is kept where it can be assembled, is far from singular, and its sheet is legible at the scales of the class;
of a task of graphplan synthesize where its mechanism exists without a new defect; else it is drawn anew.
FOLDER gets a scene for each variant, booklet.pdf, key.pdf, key.csv, and class.json, by which
`graphplan verify FOLDER SCANS` tells whose sheet is whose. The same seed gives the same files.

examples:
  graphplan variants four-bar -n 3 -o class
  graphplan variants scene.toml --names class.csv -n 32 --paper A3 -o class
  graphplan variants stroke-slider-crank -n 12 -o class     of a task of graphplan synthesize
"""

from __future__ import annotations

import argparse

from graphplan.app.choices import Messages, add_choices, add_language, add_paper, count, drawing_options, load_source
from graphplan.app.files import new_folder
from graphplan.marking.classroom.class_files import MAX_VARIANTS, ClassRequest
from graphplan.marking.classroom.class_variants import write_variants


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FOLDER", required=True, help="the folder to make; it is not there yet, or empty")
    add("-n", "--count", type=count("-n", 1, MAX_VARIANTS), metavar="N",
        help="how many tasks; more than there are names for spare ones (without it one for each name)")
    add("--seed", type=count("--seed", 0), default=1, metavar="S", help="what the numbers are drawn by (1)")
    add("--names", metavar="CLASS.csv", help="the students: a column called name or student, or else the first")
    add("--jobs", type=count("--jobs", 1), metavar="N", help="how many processes work (as many as there are cores)")
    add_paper(command, "the sheets of the class; without it that of the scene itself")
    add_language(command)
    add_choices(command, method=False)


def run(options: argparse.Namespace) -> int:
    messages = Messages(options.quiet)
    new_folder(options.output)
    request = ClassRequest(options.count, options.names, options.seed, options.jobs, messages.remark, messages.progress)
    write_variants(load_source(options, "plan"), options.output, drawing_options(options), request)
    return 0
