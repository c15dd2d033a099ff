"""Verify a drawing made by hand: the first wrong step, its error, and the tolerance of a pencil.

DRAWING is a table of measured points or results (.csv, .toml), a file of a CAD or geometry program (.svg, .dxf, .ggb),
a scan or a photo (.png, .jpg, .pdf), or a folder of these. Give --plan, --method, --paper and --at as for the handout;
an .svg, .dxf or .ggb that graphplan drew needs none of them.

verify FOLDER STACK judges a stack of scans, a PDF or a folder, each sheet by the scene that the code in its corners
names, and writes results and each student's corrected sheet; a second run judges only new sheets. verify FOLDER
TABLE.csv judges a table of the class with a column student or variant, or a folder of tables that are named after
students or variants.

Measured points are a table with a line for each mark, in mm on the student's sheet; panel, x2 and y2 of a line, r of a
circle and precision may be left out:
  mark,x,y,panel
  A,32.1,46.0,mechanism
Results are a table with x and y, or size and angle, or size alone, or value:
  quantity,of,x,y,value,unit
  velocity,A,-1100,200,,mm/s
  omega,2,,,-5.2,rad/s
Of a task with [rotor] the quantities are correction and angle of I and II, static unbalance, and moment.

examples:
  graphplan verify four-bar drawings/ --report class.html
  graphplan verify class/ scans.pdf --score "Student 3=85" --note "A method of your own, and right."
  graphplan verify class/ scans.pdf --review review.html
  graphplan verify class/ --words decisions.json --report grades.xlsx
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from graphplan.app.choices import (
    Messages,
    add_choices,
    add_pencil,
    add_sheet,
    add_travel,
    count,
    error,
    load_source,
    sheet_keys,
    text_of_scene,
)
from graphplan.app.drafting import with_sheet
from graphplan.app.files import STANDARD, write
from graphplan.errors import Refused
from graphplan.marking.verifying import (
    Findings,
    Listeners,
    desk_for,
    judge_file,
    judge_folder,
    judge_rotor,
    report_kind,
    words_on_files,
)

MAX_JOBS = 256


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("drawing", metavar="DRAWING", nargs="?", help="the submitted file, or a folder of them; of a class with "
        "--words or --review by default the last submission")
    add("--report", metavar="FILE",
        help="the report: .html, .json, of one drawing .svg or .pdf; of a class a grade book, .csv or .xlsx")
    add("--weights", default="", metavar="WEIGHTS", help="points of a step by its verdict (right=1), steps "
        "that a result counts for (numbers=2), cost of the first mistake of a kind (reversed=30); an unknown name "
        "lists all")
    add("--json", action="store_true", help="as data")
    add("-o", "--output", metavar="FOLDER", help="where a stack's results are written (FOLDER/results)")
    add("--assign", action="append", metavar="PAGE=STUDENT", help="the student of a page without a code; - sets "
        "the page aside; or a table of page and student, or variant")
    add("--score", action="append", metavar="[NAME=]SCORE", help="the teacher's own score of 100, for a student "
        "or a file in a folder; kept with the results of a class, and printed on them; - removes it")
    add("--note", action="append", metavar="[NAME=]TEXT", help="the teacher's note, likewise")
    add("--review", metavar="PAGE.html", help="of a class: a page on which the teacher accepts or overrules the "
        "verdicts on each sheet, with the recognized marks laid over it")
    add("--words", metavar="FILE", help="of a class: the decisions saved from that page; kept with the results")
    add("--jobs", type=count("--jobs", 1, MAX_JOBS), metavar="N", help="number of processes (all cores)")
    add_sheet(command)
    add_choices(command)
    add_travel(command)
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.marking.classroom.class_files import is_class

    if is_class(Path(options.scene)):
        from graphplan.marking.commands import verify_stack, verify_tables

        if options.drawing is None and (options.words or options.review):
            options.drawing = verify_stack.last_handed_in(options)
        _require_drawing(options)
        tables = verify_tables.find_tables(Path(options.drawing))
        return verify_tables.run(options, tables) if tables else verify_stack.run(options)
    _require_drawing(options)
    _refuse_stack_options(options)
    findings = _findings(options)
    if options.report:
        findings.save(options.report)
    write(findings.text if options.json else "".join(f"{line}\n" for line in findings.lines))
    return 0 if findings.judged else 2


def _findings(options: argparse.Namespace) -> Findings:
    """Findings of a drawing, of a folder, or of the answers to a rotor's task."""
    from graphplan.machines.rotors import rotor
    from graphplan.marking.judge.score import parse_weights
    from graphplan.mechanism.scene import tables_of

    path, messages = Path(options.drawing), Messages(options.quiet)
    if options.scene != STANDARD:
        text = text_of_scene(options, options.scene)
        if "rotor" in tables_of(text, options.scene):
            for name in ("report", "score", "note", "at"):
                if getattr(options, name):
                    raise Refused(f"--{name}", "it does not apply to answers", "--json alone")
            return judge_rotor(with_sheet(rotor.parse(text, options.scene), sheet_keys(options)), path)
    weighed = parse_weights(options.weights)
    report_kind(options.report, path, options.scene)
    words = words_on_files(path, options.score or (), options.note or (), options.report)
    desk = desk_for(load_source(options, "plan", "method", "inertia", "at"), weighed, sheet_keys(options), words)
    judge = judge_folder if os.path.isdir(path) else judge_file
    return judge(desk, path, Listeners(messages.progress, error, options.report))


def _require_drawing(options: argparse.Namespace) -> None:
    """Refuse to judge what was not named."""
    if options.drawing is None:
        raise Refused("DRAWING", "it is missing", "the file that was handed in, or a folder of them")


def _refuse_stack_options(options: argparse.Namespace) -> None:
    """Refuse options that only a stack of a class has."""
    for name, value in (("--assign", options.assign), ("--jobs", options.jobs), ("--output", options.output),
                        ("--review", options.review), ("--words", options.words)):
        if value:
            raise Refused(name, "it applies only to a class's stack of scans",
                          "verify FOLDER STACK, with the folder that graphplan variants wrote")
