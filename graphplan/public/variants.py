"""The tasks of a class: to each student other numbers, a booklet to print, and the key."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from graphplan.errors import Refused
from graphplan.output import back_end
from graphplan.public.drafting import Keywords, Options, make_report, on_paper, on_sheet, options_of, with_rounds
from graphplan.public.files import new_folder, write_folder

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.marking.classroom.variants import ClassVariant
    from graphplan.mechanism.model import Scene
    from graphplan.methods.executors import SharedOut
    from graphplan.sheet.layout.composition import Composition

Listener = Callable[[str], None]
MAX_VARIANTS, MIN_SHARED_VARIANTS = 1000, 4  # variants of a class; of so few more hands save no time
REGISTERED_OPTIONS = ("method", "plan", "inertia", "rounds", "paper", "language")  # options that the register keeps


def ignore(line: str) -> None:
    """Where nobody listens."""


def variants(scene: Scene, folder: str | os.PathLike[str], n: int | None = None, *,
             names: str | os.PathLike[str] | None = None, seed: int = 1, spare: int = 0, jobs: int | None = None,
             **options: Unpack[Keywords]) -> None:
    """Make the tasks of a class in a new folder, as `graphplan variants` does.

    Reads a scene with a table [vary], how many tasks (or the CSV of the students' `names`), by which `seed` numbers are
    drawn, how many `spare` tasks have no name, and how many processes work; further keywords say how it is drawn and
    what the sheets look like. The folder gets a scene for each variant, booklet.pdf, key.pdf, key.csv and class.json.
    Fails with `Refused` where nothing varies, or the folder is there and not empty.
    """
    write_variants(scene, os.fspath(folder), options_of(options), n, None if names is None else os.fspath(names), seed,
                   spare, jobs)


def write_variants(scene: Scene, folder: str, options: Options, n: int | None, names: str | None, seed: int, spare: int,
                   jobs: int | None, remark: Listener = ignore, progress: Listener = ignore) -> None:
    """The same with options in one record; `remark` is told what is worth knowing, `progress` how far it is."""
    from graphplan.marking.classroom.variants import Design
    from graphplan.methods.executors import cores, crew

    new_folder(folder)
    students = _students(names, n, spare, remark)
    if not scene.vary:
        raise Refused(f"{scene.name}: vary", "the scene does not say what varies",
                      'a table [vary], such as "drive.0.omega" = [8, 10, 12]')
    draw = partial(draft_scene, options)
    own_sheet = draw(scene)
    with crew(jobs or (cores() if len(students) > MIN_SHARED_VARIANTS else 1)) as shared_out:
        series = Design(own_sheet, draw, shared_out).series(
            len(students), seed, lambda done, of: progress(f"variants: {done}/{of}"))
        files = _files(options, seed, own_sheet.composition, series.variants, students, shared_out, progress)
        progress("")
    write_folder(files, folder)
    for line in series.lines:
        remark(f"{scene.name}: {line}")


def draft_scene(options: Options, scene: Scene) -> Drafted:
    """A scene on its sheet, as the options say; fails as `graphplan draw` does."""
    scene = on_sheet(with_rounds(scene, options), options)
    return on_paper(scene, options, make_report(scene, options))


def _students(class_file: str | None, n: int | None, spare: int, remark: Listener) -> list[tuple[str, str]]:
    """Whose each task is, and the student's group; the spare ones are nobody's."""
    students: list[tuple[str, str]] = []
    if class_file:
        from graphplan.marking.classroom.register import read_class_list
        from graphplan.output.pdf_png import lacking

        class_list = read_class_list(Path(class_file))
        students = list(zip(class_list.students, class_list.groups, strict=True))
        for student in students:
            if missing := lacking(" ".join(student)):
                raise Refused(f"{class_file}: {student[0]}", f"the font of the sheets has no {' '.join(missing)}",
                              "the name in other letters")
        for line in class_list.remarks:
            remark(line)
    elif not n:
        raise Refused("-n", "the number of tasks is missing", "-n 30, or --names CLASS.csv")
    count_wanted = n or len(students)
    if count_wanted < len(students):
        raise Refused(f"-n {count_wanted}", f"there are {len(students)} names in {class_file}",
                      f"-n {len(students)}, or no -n")
    return [*students, *[("", "")] * (count_wanted - len(students) + spare)]


def _files(options: Options, seed: int, own: Composition, variants: Sequence[ClassVariant],
           students: Sequence[tuple[str, str]], shared_out: SharedOut, progress: Listener) -> dict[str, str | bytes]:
    """All that is written, by name."""
    from graphplan.marking.classroom.booklet import KEY_COLUMNS, Exercise, PrintedExercise, overview, print_exercise
    from graphplan.marking.classroom.register import REGISTER_FILE, ClassRegister, TaskSheet
    from graphplan.marking.classroom.spreadsheet import csv_text
    from graphplan.public.desk import key_rows

    digits = len(str(len(variants)))
    exercises = [Exercise(variant, *student, f"variant-{variant.number:0{max(2, digits)}}.toml")
                 for variant, student in zip(variants, students, strict=True)]
    pages, sheets = list[PrintedExercise](), list[TaskSheet]()
    work = partial(print_exercise, draw=partial(draft_scene, options), further=key_rows)
    for exercise, exercise_sheets in zip(exercises, shared_out(work, exercises), strict=True):
        page = 1 + sum(len(printed_exercise.task) for printed_exercise in pages)
        sheets.append(TaskSheet(exercise_sheets.code, exercise.variant.number, exercise.student, exercise.file, page,
                                exercise.group))
        pages.append(exercise_sheets)
        progress(f"sheets: {len(pages)}/{len(exercises)}")
    title = own.plans.drawing.scene.title
    registered = {name: str(getattr(options, name) or "") for name in REGISTERED_OPTIONS}
    register = ClassRegister(title, seed, registered, tuple(sheets))
    if twice := register.equal_codes:
        raise Refused(f"--seed {seed}", f"the corner marks of variants {twice[0]} and {twice[1]} are the same",
                      "another seed")
    pdf = back_end("pdf")
    progress("booklet.pdf, key.pdf")
    return {
        **{exercise.file: exercise.variant.text for exercise in exercises},
        "booklet.pdf": pdf([sheet for printed_exercise in pages for sheet in printed_exercise.task], title=title),
        "key.pdf": pdf([*overview(own, [printed_exercise.line for printed_exercise in pages]),
                        *(sheet for printed_exercise in pages for sheet in printed_exercise.solution)], title=title),
        "key.csv": csv_text([KEY_COLUMNS, *(row for printed_exercise in pages for row in printed_exercise.rows)]),
        REGISTER_FILE: register.text,
    }
