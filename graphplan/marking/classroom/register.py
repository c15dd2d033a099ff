"""Who is in a class: the register, which sheet is whose, told by the code of its corner marks; and the list of names
that it is made from, as schools and spreadsheets write it.

The register stands in `class.json` beside the scenes of the tasks. What it says of how they are drawn is by the names
of the command line, so that each sheet can be composed again as it was printed.
"""

from __future__ import annotations

import csv
import json
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from graphplan.errors import Refused, printable
from graphplan.marking.classroom import measures
from graphplan.sheet.frames.frame import corner_numbers

REGISTER_FILE = "class.json"
REMEDY = "the class.json that graphplan variants wrote"


@dataclass(frozen=True)
class TaskSheet:
    """A printed task: the code of its corner marks, its variant, its student (none of a spare sheet), the file of its
    scene in the folder, its page in the booklet, counted from 1, and the student's group, if there are groups."""

    code: int
    variant: int
    student: str
    scene: str
    page: int
    group: str = ""

    @property
    def owner(self) -> str:
        """The student, or of a sheet that has none the variant."""
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
        """The same as data."""
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
    """The register in a folder. Fails with `Refused` where there is none, or it is not what graphplan writes."""
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


# ---- names: a CSV file in whatever dialect --------------------------------------------------------------------------


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
    """The cells of each row that name a student, and last the group; a first row that says what columns are is none.
    """
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
