"""The tasks of a class: to each student other numbers, a booklet to print, the key, and the register of who has which.

The register stands in `class.json` beside the scenes of the tasks. How they are drawn is said by the names
of the command line, so that each sheet can be composed again as it was printed.
"""

from __future__ import annotations

import csv
import json
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from graphplan.app.files import new_folder, write_folder
from graphplan.errors import Refused, printable
from graphplan.marking.classroom import measures
from graphplan.mechanism.written_scene import with_value_in_text
from graphplan.output import back_end
from graphplan.sheet.frames.frame import corner_numbers

if TYPE_CHECKING:
    from graphplan.marking.classroom.booklet import Exercise, KeyLine, PrintedExercise
    from graphplan.marking.classroom.variants import ClassVariant, SeriesDesign
    from graphplan.methods.executors import SharedOut
    from graphplan.sheet.plates.display import Sheet

REGISTER_FILE = "class.json"
REMEDY = "the class.json that graphplan variants wrote"


@dataclass(frozen=True)
class TaskSheet:
    """A printed task: the code of its corner marks, its variant, its student (empty for a spare sheet), the file of its
    scene in the folder, its page in the booklet, counted from 1, and the student's group, if there are groups."""

    code: int
    variant: int
    student: str
    scene: str
    page: int
    group: str = ""

    @property
    def owner(self) -> str:
        """Name of the student, or for a sheet without one that of the variant."""
        return self.student or str(self.variant)


@dataclass(frozen=True)
class ClassRegister:
    """The sheets of a class, the seed that their numbers were drawn by, and the options by which they are drawn."""

    title: str
    seed: int
    options: Mapping[str, str]
    sheets: tuple[TaskSheet, ...]

    def sheet_of(self, student: str) -> TaskSheet | None:
        """The sheet of a student; None where there is no such student."""
        return next((sheet for sheet in self.sheets if student and sheet.student == student), None)

    @property
    def equal_codes(self) -> tuple[int, int] | None:
        """The first two variants whose sheets have the same corner marks; None where all differ."""
        variants: dict[tuple[int, ...], int] = {}
        for sheet in self.sheets:
            variant = variants.setdefault(corner_numbers(sheet.code), sheet.variant)
            if variant != sheet.variant:
                return variant, sheet.variant
        return None

    @property
    def data(self) -> dict[str, Any]:
        """The register as data."""
        return {"title": self.title, "seed": self.seed, "options": dict(self.options),
                "sheets": [asdict(sheet) for sheet in self.sheets]}

    @property
    def text(self) -> str:
        """The file."""
        return json.dumps(self.data, indent=1, ensure_ascii=False) + "\n"


def is_class(folder: Path) -> bool:
    """Whether a folder has a register."""
    return (folder / REGISTER_FILE).is_file()


def load_register(folder: Path) -> ClassRegister:
    """Load the register in a folder. Fails with `Refused` if it is missing, or not written by graphplan."""
    path = folder / REGISTER_FILE
    try:
        read = json.loads(path.read_text(encoding="utf-8"))
        return _parse_register(read)
    except OSError as error:
        raise Refused(f"{path}", f"it cannot be read ({error.strerror})", "a folder that graphplan variants wrote"
                      ) from None
    except (ValueError, RecursionError):  # no UTF-8, or no JSON
        raise Refused(f"{path}", "not JSON", REMEDY) from None
    except (KeyError, TypeError):
        raise Refused(f"{path}", "not a register of a class", REMEDY) from None


FIELD_TYPES = {"code": int, "variant": int, "student": str, "scene": str, "page": int, "group": str}


def _parse_register(read: Any) -> ClassRegister:
    """The register of a file; fails with `KeyError` or `TypeError` where something is missing or of another kind."""
    sheets = tuple(TaskSheet(**{key: _require_type(row[key], kind) for key, kind in FIELD_TYPES.items()})
                   for row in ({"group": "", **row} for row in read["sheets"]))
    options = {_require_type(key, str): _require_type(value, str) for key, value in dict(read["options"]).items()}
    if any(Path(sheet.scene).name != sheet.scene for sheet in sheets):  # a scene lies in the folder itself
        raise KeyError("scene")
    return ClassRegister(_require_type(read["title"], str), _require_type(read["seed"], int), options, sheets)


def _require_type(value: Any, kind: type) -> Any:
    if type(value) is not kind:
        raise TypeError
    return value


FULL_NAME_COLUMNS = {"name", "student", "full name", "student name", "nimi", "vārds", "имя", "фио", "студент", "ім'я",
                     "піб"}
FIRST_NAME_COLUMNS = {"first name", "firstname", "given name", "vorname", "eesnimi", "vārds", "имя", "ім'я"}
LAST_NAME_COLUMNS = {"last name", "lastname", "surname", "family name", "nachname", "perenimi", "uzvārds", "фамилия",
                     "прізвище"}
GROUP_COLUMNS = {"group", "class", "gruppe", "klasse", "rühm", "grupa", "группа", "група"}
SEPARATORS = ";\t,"


@dataclass(frozen=True)
class ClassList:
    """The students of a class, each once, what is to be told of their list, and the group of each, if it has groups."""

    students: tuple[str, ...]
    remarks: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()


def read_class_list(path: Path) -> ClassList:
    """The names in a list: of the column that is called so, of those of first and last names, or of the first.

    Equal names get a number, so that each is one sheet's. Fails with `Refused` where there is no list, or none in it.
    """
    text, remarks = _read_text(path)
    rows = [[" ".join(printable(cell).split()) for cell in row] for row in _rows(text)]
    rows = [row for row in rows if any(row)]
    grouped = [(name, group) for *row, group in _student_cells(rows) if (name := " ".join(filter(None, row)))]
    names = [name for name, _ in grouped]
    if not names:
        raise Refused(f"{path}", "it contains no name", "a line for each student, such as: name")
    if len(names) > measures.MAX_NAMES:
        raise Refused(f"{path}", f"it contains {len(names)} names", f"at most {measures.MAX_NAMES}")
    students = _numbered_names(names)
    remarks += [f"{path}: {name} is named {count} times; the others are {name} (2) ..."
                for name, count in Counter(names).items() if count > 1]
    return ClassList(tuple(students), tuple(remarks), tuple(group for _, group in grouped))


def _read_text(path: Path) -> tuple[str, list[str]]:
    """The text of a file and what is to be told of it."""
    try:
        with path.open("rb") as file:
            data = file.read(measures.MAX_LIST_BYTES + 1)
    except OSError as error:
        raise Refused(f"{path}", f"it cannot be read ({error.strerror})", "a list of names, a .csv") from None
    if len(data) > measures.MAX_LIST_BYTES or b"\0" in data.removeprefix(b"\xff\xfe"):
        raise Refused(f"{path}", "not a list of names", "a .csv, saved as UTF-8")
    try:
        return data.decode("utf-8-sig"), []
    except UnicodeDecodeError:
        return data.decode("cp1252", "replace"), [f"{path}: this is no UTF-8, and read as Windows-1252; see the names"]


def _rows(text: str) -> list[list[str]]:
    """The cells, parted by what parts the most of them in the first line."""
    first = next((line for line in text.splitlines() if line.strip()), "")
    parted = max(SEPARATORS, key=first.count)
    try:
        return list(csv.reader(text.splitlines(), delimiter=parted, skipinitialspace=True))
    except csv.Error:  # such as a cell beyond all bounds
        return []


def _student_cells(rows: Sequence[Sequence[str]]) -> list[tuple[str, ...]]:
    """Cells of each row that name a student, and last the group; a first row of headings is left out."""
    heads = [cell.casefold() for cell in rows[0]] if rows else []
    whole, first, last, group = (
        next((place for place, head in enumerate(heads) if head in column_names), None)
        for column_names in (FULL_NAME_COLUMNS, FIRST_NAME_COLUMNS, LAST_NAME_COLUMNS, GROUP_COLUMNS))
    if first is not None and last is not None:
        columns = [first, last]
    elif whole is not None:
        columns = [whole]
    else:
        return [(*row[:1], "") for row in rows]
    return [(*(row[column] for column in columns if column < len(row)),
             row[group] if group is not None and group < len(row) else "") for row in rows[1:]]


def _numbered_names(names: Sequence[str]) -> list[str]:
    """The names, equal ones with a number that no other name has."""
    numbered: dict[str, None] = {}
    taken = set(names)
    for name in names:
        unique, number = name, 1
        while unique in numbered or (number > 1 and unique in taken):
            number += 1
            unique = f"{name} ({number})"
        numbered[unique] = None
    return list(numbered)


Listener = Callable[[str], None]
MAX_VARIANTS, MIN_SHARED_VARIANTS = 1000, 4  # variants of a class; of so few more hands save no time
COPIED_SCENE = "scene.toml"
REGISTERED_OPTIONS = ("method", "plan", "inertia", "rounds", "paper", "language")  # options that the register keeps


def ignore(line: str) -> None:
    """Ignore a line of progress."""


@dataclass(frozen=True)
class ClassRequest:
    """A class: how many tasks, or the CSV of its `names` (more tasks than names are spare ones); by which `seed` their
    numbers are drawn; how many processes work; the `keys` of [sheet] beside the scene; listeners for a `remark` and for
    `progress`."""

    count: int | None = None
    names: str | None = None
    seed: int = 1
    jobs: int | None = None
    keys: Mapping[str, Any] = field(default_factory=dict)
    remark: Listener = ignore
    progress: Listener = ignore


@dataclass(frozen=True)
class ClassWork:
    """Variants of a class and their printing: their `design`, an exercise on paper (for any process), the first pages
    of the key, of a line each; under which `title`. Of tasks that name a scene's file by its whole path, `scene_key`
    says where, and `scene_file` which: they get a copy beside them and name that."""

    design: Callable[[SharedOut], SeriesDesign]
    print_exercise: Callable[[Exercise], PrintedExercise]
    key_pages: Callable[[Sequence[KeyLine]], Sequence[Sheet]]
    title: str
    scene_key: str = ""
    scene_file: str = ""

    def movable_files(self, texts: Mapping[str, str]) -> dict[str, str]:
        """The texts by their files, and the scene that they name, so that their folder can be moved."""
        if not self.scene_file:
            return {**texts}
        return {name: with_value_in_text(text, self.scene_key, COPIED_SCENE, name) for name, text in texts.items()} | {
            COPIED_SCENE: Path(self.scene_file).read_text(encoding="utf-8")}


def write_class(work: Callable[[], ClassWork], folder: str, request: ClassRequest) -> None:
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
        files = _files(class_work, request, series.variants, students, shared_out)
        request.progress("")
    write_folder(files, folder)
    for line in series.lines:
        request.remark(f"{design.source.name}: {line}")


def _students(request: ClassRequest) -> list[tuple[str, str]]:
    """Student and group of each task; both empty for spare ones."""
    students: list[tuple[str, str]] = []
    if class_file := request.names:
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
    return [*students, *[("", "")] * (count_wanted - len(students))]


def _files(class_work: ClassWork, request: ClassRequest, variants: Sequence[ClassVariant],
           students: Sequence[tuple[str, str]], shared_out: SharedOut) -> dict[str, str | bytes]:
    """All that is written, by name."""
    from graphplan.marking.classroom.booklet import KEY_COLUMNS, Exercise, PrintedExercise
    from graphplan.marking.classroom.results import csv_text

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
    registered = {name: str(request.keys.get(name) or "") for name in REGISTERED_OPTIONS}
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
