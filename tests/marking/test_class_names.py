"""Lists of names, as schools and spreadsheets write them."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphplan.errors import Refused
from graphplan.marking.classroom.register import read_class_list

LISTS = {
    "a column of names": ("name,group\nStudent 1,A\nStudent 2,B\n", ["Student 1", "Student 2"]),
    "in another place, other case": ("No;Student\n1;Student 1\n2;Student 2\n", ["Student 1", "Student 2"]),
    "no head": ("Student 1\nStudent 2", ["Student 1", "Student 2"]),
    "first and last names": ("ID\tSurname\tFirst name\n1\tOne\tStudent\n", ["Student One"]),
    "commas in quotes": ('name\n"One, Student"\n', ["One, Student"]),
    "blanks and empty lines": ("\nname \n\n  Student   1 \n;\n", ["Student 1"]),
    "a byte order mark": ("\ufeffname\nStudent 1\n", ["Student 1"]),
    "lines of old": ("name\r\nStudent 1\r\n", ["Student 1"]),
    "what no terminal should obey": ("name\nStudent\x1b[31m\n", ["Student\\x1b[31m"]),
}


@pytest.mark.parametrize("case", LISTS)
def test_names_are_found(tmp_path: Path, case: str) -> None:
    """The names are those of the column that is called so, else of the first."""
    text, names = LISTS[case]
    path = tmp_path / "class.csv"
    path.write_bytes(text.encode())
    found = read_class_list(path)
    assert list(found.students) == names
    assert found.remarks == ()


def test_equal_names_are_told_apart(tmp_path: Path) -> None:
    """Each sheet has a name of its own, also where a number is taken; that is told."""
    path = tmp_path / "class.csv"
    path.write_text("name\nStudent\nStudent (2)\nStudent\nStudent\n")
    found = read_class_list(path)
    assert found.students == ("Student", "Student (2)", "Student (3)", "Student (4)")
    assert found.remarks == (f"{path}: Student is named 3 times; the others are Student (2) ...",)


def test_other_encodings_are_told(tmp_path: Path) -> None:
    """A list that is no UTF-8 is read as spreadsheets of old write it, with a word."""
    path = tmp_path / "class.csv"
    path.write_bytes("name\nSchüler 1\n".encode("cp1252"))
    found = read_class_list(path)
    assert found.students == ("Schüler 1",)
    assert "this is no UTF-8" in found.remarks[0]


@pytest.mark.parametrize("data", [b"", b"\n\n", b"name\n", b"\x89PNG\0\0"], ids=["empty", "blank", "head", "binary"])
def test_what_has_no_names_is_refused(tmp_path: Path, data: bytes) -> None:
    """A file without names is one line."""
    path = tmp_path / "class.csv"
    path.write_bytes(data)
    with pytest.raises(Refused, match=r"class\.csv: (it contains no name|not a list of names); "):
        read_class_list(path)


def test_no_file_is_refused(tmp_path: Path) -> None:
    """A list that is not there is one line."""
    with pytest.raises(Refused, match="cannot be read"):
        read_class_list(tmp_path / "class.csv")


def test_groups_stand_beside_the_names(tmp_path: Path) -> None:
    """A column that is called so says the group of each; without it nobody has one."""
    path = tmp_path / "class.csv"
    path.write_text("Gruppe;Vorname;Nachname\nA;Student;1\n;Student;2\n", encoding="utf-8")
    found = read_class_list(path)
    assert (found.students, found.groups) == (("Student 1", "Student 2"), ("A", ""))
    path.write_text("name\nStudent 1\n", encoding="utf-8")
    assert read_class_list(path).groups == ("",)
