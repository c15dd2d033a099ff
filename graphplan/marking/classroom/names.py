"""The names of a class, from a list as schools and spreadsheets write it: a CSV file in whatever dialect."""

from __future__ import annotations

import csv
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from graphplan.errors import Refused, printable

WHOLE = {"name", "student", "full name", "student name", "nimi", "vārds", "имя", "фио", "студент", "ім'я", "піб"}
FIRST = {"first name", "firstname", "given name", "vorname", "eesnimi", "vārds", "имя", "ім'я"}
LAST = {"last name", "lastname", "surname", "family name", "nachname", "perenimi", "uzvārds", "фамилия", "прізвище"}
SEPARATORS = ";\t,"
LARGEST, MOST = 10_000_000, 10_000  # bytes of a list, and names in it


@dataclass(frozen=True)
class Names:
    """The students of a class, each once, and what is to be told of their list."""

    students: tuple[str, ...]
    remarks: tuple[str, ...] = ()


def read(path: Path) -> Names:
    """The names in a list: of the column that is called so, of those of first and last names, or of the first.

    Equal names get a number, so that each is one sheet's. Fails with `Refused` where there is no list, or none in it.
    """
    text, remarks = _text(path)
    rows = [[" ".join(printable(cell).split()) for cell in row] for row in _rows(text)]
    rows = [row for row in rows if any(row)]
    names = [name for row in _named(rows) if (name := " ".join(filter(None, row)))]
    if not names:
        raise Refused(f"{path}", "it contains no name", "a line for each student, such as: name")
    if len(names) > MOST:
        raise Refused(f"{path}", f"it contains {len(names)} names", f"at most {MOST}")
    students = _told_apart(names)
    remarks += [f"{path}: {name} is named {count} times; the others are {name} (2) ..."
                for name, count in Counter(names).items() if count > 1]
    return Names(tuple(students), tuple(remarks))


def _text(path: Path) -> tuple[str, list[str]]:
    """The text of a file and what is to be told of it."""
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except OSError as error:
        raise Refused(f"{path}", f"it cannot be read ({error.strerror})", "a list of names, a .csv") from None
    if len(data) > LARGEST or b"\0" in data.removeprefix(b"\xff\xfe"):
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


def _named(rows: Sequence[Sequence[str]]) -> list[tuple[str, ...]]:
    """The cells of each row that name a student; a first row that says what columns are is none."""
    heads = [cell.casefold() for cell in rows[0]] if rows else []
    whole = next((place for place, head in enumerate(heads) if head in WHOLE), None)
    first, last = (next((place for place, head in enumerate(heads) if head in known), None) for known in (FIRST, LAST))
    if first is not None and last is not None:
        columns = [first, last]
    elif whole is not None:
        columns = [whole]
    else:
        return [tuple(row[:1]) for row in rows]
    return [tuple(row[column] for column in columns if column < len(row)) for row in rows[1:]]


def _told_apart(names: Sequence[str]) -> list[str]:
    """The names, equal ones with a number that no other name has."""
    found: dict[str, None] = {}
    taken = set(names)
    for name in names:
        own, number = name, 1
        while own in found or (number > 1 and own in taken):
            number += 1
            own = f"{name} ({number})"
        found[own] = None
    return list(found)
