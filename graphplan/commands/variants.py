"""Make the tasks of a class: to each student other numbers, a booklet to print, and the key.

What varies stands in the scene, by the path of a number, as a range or a list:
  [vary]
  "points.A.angle" = { from = 20, to = 160, step = 5 }
  "drive.0.omega" = [8, 10, 12]
A variant is kept where it can be assembled, is far from singular, and its sheet is legible at the scales of the class;
else it is drawn anew. FOLDER gets a scene for each variant, booklet.pdf, key.pdf, key.csv, and class.json, by which
`graphplan verify FOLDER SCANS` tells whose sheet is whose. The same seed gives the same files.

examples:
  graphplan variants four-bar -n 3 -o class
  graphplan variants scene.toml --names class.csv --spare 2 --paper A3 -o class
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.commands.choices import (
    add_choices,
    add_language,
    add_paper,
    add_pencil,
    count,
    load_scene,
    load_sheet_scene,
    make_report,
    on_paper,
)
from graphplan.commands.output import Messages, new_folder, write_folder
from graphplan.errors import Refused
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.marking.classroom.variants import ClassVariant
    from graphplan.mechanism.model import Scene
    from graphplan.methods.executors import SharedOut
    from graphplan.sheet.layout.composition import Composition

MAX_VARIANTS, MIN_SHARED_VARIANTS = 1000, 4  # variants of a class; of so few more hands save no time
REGISTERED_OPTIONS = ("method", "plan", "inertia", "rounds", "paper", "language")  # options that the register keeps


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("-o", "--output", metavar="FOLDER", required=True, help="the folder to make; it is not there yet, or empty")
    add("-n", "--count", type=count("-n", 1, MAX_VARIANTS), metavar="N",
        help="how many tasks (without it one for each name)")
    add("--seed", type=count("--seed", 0), default=1, metavar="S", help="what the numbers are drawn by (1)")
    add("--names", metavar="CLASS.csv", help="the students: a column called name or student, or else the first")
    add("--spare", type=count("--spare", 0, MAX_VARIANTS), default=0, metavar="K",
        help="so many more tasks without a name")
    add("--jobs", type=count("--jobs", 1), metavar="N", help="how many processes work (as many as there are cores)")
    add_paper(command, "the sheets of the class; without it that of the scene itself")
    add_language(command)
    add_choices(command)
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.marking.classroom.variants import Design
    from graphplan.methods.executors import cores, crew

    messages = Messages(options.quiet)
    new_folder(options.output)
    students = _students(options, messages)
    scene = load_scene(options)
    if not scene.vary:
        raise Refused(f"{options.scene}: vary", "the scene does not say what varies",
                      'a table [vary], such as "drive.0.omega" = [8, 10, 12]')
    draw = partial(draft_scene, options)
    own_sheet = draw(scene)
    jobs = options.jobs or (cores() if len(students) > MIN_SHARED_VARIANTS else 1)
    with crew(jobs) as shared_out:
        series = Design(own_sheet, draw, shared_out).series(
            len(students), options.seed, lambda done, of: messages.progress(f"variants: {done}/{of}"))
        files = _files(options, own_sheet.composition, series.variants, students, shared_out, messages)
        messages.progress("")
    write_folder(files, options.output)
    for line in series.lines:
        messages.remark(f"{options.scene}: {line}")
    return 0


def draft_scene(options: argparse.Namespace, scene: Scene) -> Drafted:
    """A scene on its sheet, as the options say; fails as `graphplan draw` does."""
    return on_paper(options, make_report(options, load_sheet_scene(options, scene)))


def _students(options: argparse.Namespace, messages: Messages) -> list[str]:
    """Whose each task is; the spare ones are nobody's."""
    names: tuple[str, ...] = ()
    if options.names:
        from graphplan.marking.classroom.register import read_class_list
        from graphplan.output.pdf_png import lacking

        class_list = read_class_list(Path(options.names))
        names = class_list.students
        for name in names:
            if missing := lacking(name):
                raise Refused(f"{options.names}: {name}", f"the font of the sheets has no {' '.join(missing)}",
                              "the name in other letters")
        for line in class_list.remarks:
            messages.remark(line)
    elif not options.count:
        raise Refused("-n", "the number of tasks is missing", "-n 30, or --names CLASS.csv")
    count_wanted = options.count or len(names)
    if count_wanted < len(names):
        raise Refused(f"-n {count_wanted}", f"there are {len(names)} names in {options.names}",
                      f"-n {len(names)}, or no -n")
    return [*names, *[""] * (count_wanted - len(names) + options.spare)]


def _files(options: argparse.Namespace, own: Composition, variants: Sequence[ClassVariant], students: Sequence[str],
           shared_out: SharedOut, messages: Messages) -> dict[str, str | bytes]:
    """All that is written, by name."""
    from graphplan.commands.cycle_results import key_rows
    from graphplan.marking.classroom.booklet import Exercise, PrintedExercise, key_table, overview, print_exercise
    from graphplan.marking.classroom.register import REGISTER_FILE, ClassRegister, TaskSheet

    digits = len(str(len(variants)))
    exercises = [Exercise(variant, student, f"variant-{variant.number:0{max(2, digits)}}.toml")
                 for variant, student in zip(variants, students, strict=True)]
    pages, sheets = list[PrintedExercise](), list[TaskSheet]()
    work = partial(print_exercise, draw=partial(draft_scene, options), further=key_rows)
    for exercise, exercise_sheets in zip(exercises, shared_out(work, exercises), strict=True):
        page = 1 + sum(len(printed_exercise.task) for printed_exercise in pages)
        sheets.append(TaskSheet(exercise_sheets.code, exercise.variant.number, exercise.student, exercise.file, page))
        pages.append(exercise_sheets)
        messages.progress(f"sheets: {len(pages)}/{len(exercises)}")
    title = own.plans.drawing.scene.title
    overview_rows = [(printed_exercise.variant.number, printed_exercise.student, printed_exercise.variant.numbers_text)
                     for printed_exercise in exercises]
    register = ClassRegister(title, options.seed, _register_options(options), tuple(sheets))
    if twice := register.equal_codes:
        raise Refused(f"--seed {options.seed}", f"the corner marks of variants {twice[0]} and {twice[1]} are the same",
                      "another seed")
    pdf = back_end("pdf")
    messages.progress("booklet.pdf, key.pdf")
    return {
        **{exercise.file: exercise.variant.text for exercise in exercises},
        "booklet.pdf": pdf([sheet for printed_exercise in pages for sheet in printed_exercise.task], title=title),
        "key.pdf": pdf([*overview(own, overview_rows),
                        *(sheet for printed_exercise in pages for sheet in printed_exercise.solution)], title=title),
        "key.csv": key_table((sheet.variant, sheet.student, exercise_sheets.rows)
                             for sheet, exercise_sheets in zip(sheets, pages, strict=True)),
        REGISTER_FILE: register.text,
    }


def _register_options(options: argparse.Namespace) -> dict[str, str]:
    """The options by which the sheets of the class can be composed again."""
    return {name: str(getattr(options, name) or "") for name in REGISTERED_OPTIONS}
