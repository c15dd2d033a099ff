"""The files of a class: a text for each variant, a booklet of tasks, the key, and the register."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from graphplan.app.drafting import Options
from graphplan.app.files import new_folder, write_folder
from graphplan.errors import Refused
from graphplan.mechanism.written_scene import with_value_in_text
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.marking.classroom.booklet import Exercise, PrintedExercise
    from graphplan.marking.classroom.variants import ClassVariant, SeriesDesign
    from graphplan.methods.executors import SharedOut
    from graphplan.sheet.plates.display import Sheet

Listener = Callable[[str], None]
MAX_VARIANTS, MIN_SHARED_VARIANTS = 1000, 4  # variants of a class; of so few more hands save no time
COPIED_SCENE = "scene.toml"
REGISTERED_OPTIONS = ("method", "plan", "inertia", "rounds", "paper", "language")  # options that the register keeps


def ignore(line: str) -> None:
    """Where nobody listens."""


@dataclass(frozen=True)
class ClassRequest:
    """A class: how many tasks (or the CSV of its `names`), by which `seed` their numbers are drawn, how many `spare`
    tasks have no name, and how many processes work; `remark` is told what is worth knowing, `progress` how far it is.
    """

    count: int | None = None
    names: str | None = None
    seed: int = 1
    spare: int = 0
    jobs: int | None = None
    remark: Listener = ignore
    progress: Listener = ignore


@dataclass(frozen=True)
class ClassWork:
    """What the variants of a class are, and how they are printed: their `design`, an exercise on paper (for any
    process), the first pages of the key, of a line each; under which `title`. Of tasks that name a scene's file by its
    whole path, `scene_key` says where, and `scene_file` which: they get a copy beside them and name that."""

    design: Callable[[SharedOut], SeriesDesign]
    print_exercise: Callable[[Exercise], PrintedExercise]
    key_pages: Callable[[Sequence[str]], Sequence[Sheet]]
    title: str
    scene_key: str = ""
    scene_file: str = ""

    def movable_files(self, texts: Mapping[str, str]) -> dict[str, str]:
        """The texts by their files, and the scene that they name, so that their folder can be moved."""
        if not self.scene_file:
            return {**texts}
        return {name: with_value_in_text(text, self.scene_key, COPIED_SCENE, name) for name, text in texts.items()} | {
            COPIED_SCENE: Path(self.scene_file).read_text(encoding="utf-8")}


def write_class(work: Callable[[], ClassWork], folder: str, options: Options, request: ClassRequest) -> None:
    """Make the tasks of a class in a new folder; fails with `Refused` where hardly any that is drawn is good."""
    from graphplan.methods.executors import cores, worker_pool

    new_folder(folder)
    students = _students(request)
    class_work = work()
    workers = request.jobs or (cores() if len(students) > MIN_SHARED_VARIANTS else 1)
    with worker_pool(workers) as shared_out:
        design = class_work.design(shared_out)
        series = design.series(len(students), request.seed,
                               lambda done, of: request.progress(f"variants: {done}/{of}"))
        files = _files(class_work, options, request, series.variants, students, shared_out)
        request.progress("")
    write_folder(files, folder)
    for line in series.lines:
        request.remark(f"{design.source.name}: {line}")


def _students(request: ClassRequest) -> list[tuple[str, str]]:
    """Whose each task is, and the student's group; the spare ones are nobody's."""
    students: list[tuple[str, str]] = []
    if class_file := request.names:
        from graphplan.marking.classroom.register import read_class_list
        from graphplan.output.typeface import lacking

        class_list = read_class_list(Path(class_file))
        students = list(zip(class_list.students, class_list.groups, strict=True))
        for student in students:
            if missing := lacking(" ".join(student)):
                raise Refused(f"{class_file}: {student[0]}", f"the font of the sheets has no {' '.join(missing)}",
                              "the name in other letters")
        for line in class_list.remarks:
            request.remark(line)
    elif not request.count:
        raise Refused("-n", "the number of tasks is missing", "-n 30, or --names CLASS.csv")
    count_wanted = request.count or len(students)
    if count_wanted < len(students):
        raise Refused(f"-n {count_wanted}", f"there are {len(students)} names in {class_file}",
                      f"-n {len(students)}, or no -n")
    return [*students, *[("", "")] * (count_wanted - len(students) + request.spare)]


def _files(class_work: ClassWork, options: Options, request: ClassRequest, variants: Sequence[ClassVariant],
           students: Sequence[tuple[str, str]], shared_out: SharedOut) -> dict[str, str | bytes]:
    """All that is written, by name."""
    from graphplan.marking.classroom.booklet import KEY_COLUMNS, Exercise, PrintedExercise
    from graphplan.marking.classroom.register import REGISTER_FILE, ClassRegister, TaskSheet
    from graphplan.marking.classroom.spreadsheet import csv_text

    digits = len(str(len(variants)))
    exercises = [Exercise(variant, *student, f"variant-{variant.number:0{max(2, digits)}}.toml")
                 for variant, student in zip(variants, students, strict=True)]
    printouts, sheets = list[PrintedExercise](), list[TaskSheet]()
    for exercise, printout in zip(exercises, shared_out(class_work.print_exercise, exercises), strict=True):
        page = 1 + sum(len(printout.task) for printout in printouts)
        sheets.append(TaskSheet(printout.code, exercise.variant.number, exercise.student, exercise.file, page,
                                exercise.group))
        printouts.append(printout)
        request.progress(f"sheets: {len(printouts)}/{len(exercises)}")
    registered = {name: str(getattr(options, name) or "") for name in REGISTERED_OPTIONS}
    register = ClassRegister(class_work.title, request.seed, registered, tuple(sheets))
    if twice := register.equal_codes:
        raise Refused(f"--seed {request.seed}", f"the corner marks of variants {twice[0]} and {twice[1]} are the same",
                      "another seed")
    pdf = back_end("pdf")
    request.progress("booklet.pdf, key.pdf")
    return {
        **class_work.movable_files({exercise.file: exercise.variant.text for exercise in exercises}),
        "booklet.pdf": pdf([sheet for printout in printouts for sheet in printout.task],
                           title=class_work.title),
        "key.pdf": pdf([*class_work.key_pages([printout.line for printout in printouts]),
                        *(sheet for printout in printouts for sheet in printout.solution)],
                       title=class_work.title),
        "key.csv": csv_text([KEY_COLUMNS, *(row for printout in printouts for row in printout.rows)]),
        REGISTER_FILE: register.text,
    }
