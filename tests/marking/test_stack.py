"""Stacks of scans: whose each page is, what is judged, and what is left to the teacher."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphplan.errors import Refused
from graphplan.marking.classroom.class_files import ClassRegister, TaskSheet
from graphplan.marking.classroom.stack import (
    Assignment,
    PageSight,
    SeenPage,
    StackPage,
    assignments,
    decode_page,
    place_pages,
    replace_failed,
)
from graphplan.sheet.frames.frame import corner_numbers, page_code, sheet_code

CODES = [sheet_code(f"variant {number}") for number in range(1, 5)]
STUDENTS = "Student 1", "Student 2", "Student 3", ""
REGISTER = ClassRegister("Class", 1, {}, tuple(
    TaskSheet(code, number, student, f"variant-{number}.toml", number)
    for number, (code, student) in enumerate(zip(CODES, STUDENTS, strict=True), 1)))


def marks(code: int, *corners: int) -> tuple[int, ...]:
    """Some marks of a code, or all four."""
    return tuple(corner_numbers(code)[corner] for corner in corners or range(4))


def seen(name: str, upright: tuple[int, ...] = (), mirrored: tuple[int, ...] = (), *, blank: bool = False) -> SeenPage:
    """A page with these marks."""
    return SeenPage(StackPage(Path(name), 1, name), PageSight(name, upright, mirrored, blank, ""))


def fates(*pages: SeenPage, assigned: dict[str, Assignment] | None = None) -> list[tuple[str, str, str]]:
    """What becomes of pages: each by its name, whose it is, and its fate."""
    found = place_pages(pages, REGISTER, assigned or {})
    return [(one.seen_page.page.name, one.owner or (str(one.sheet.variant) if one.sheet else ""), one.fate)
            for one in found]


@pytest.mark.parametrize(("upright", "mirrored", "student"), [
    (marks(CODES[0]), (), "Student 1"),
    (marks(CODES[1], 0, 2), (), "Student 2"),  # two marks are lost
    (marks(CODES[1], 3), (), None),  # three are
    ((*marks(CODES[0], 0, 1, 2), marks(CODES[1], 3)[0]), (), "Student 1"),  # one is misread
    ((*marks(CODES[0], 0, 1), *marks(CODES[1], 2, 3)), (), None),  # two sheets in one picture
    (marks(sheet_code("a task of others")), (), None),
    ((801, 3), marks(CODES[2]), "Student 3"),  # mirrored
    ((), (), None),
])
def test_a_sheet_is_known_by_its_marks_or_not_at_all(
        upright: tuple[int, ...], mirrored: tuple[int, ...], student: str | None) -> None:
    """Two marks of a sheet tell it, a third against a misread one; what does not fit one sheet alone is nobody's."""
    found = decode_page(seen("page", upright, mirrored).sight, REGISTER)
    assert (found.sheet.student if found.sheet else None) == student
    assert (found.why is None) == (student is not None)
    assert found.mirrored == bool(mirrored)


def test_marks_that_fit_two_sheets_tell_neither() -> None:
    """A page whose marks are those of two sheets is left to the teacher, who is told of both."""
    twins = ClassRegister("Class", 1, {},
                          (*REGISTER.sheets[:1], TaskSheet(CODES[0], 9, "Student 9", "variant-9.toml", 9)))
    found = decode_page(seen("page", marks(CODES[0])).sight, twins)
    assert found.sheet is None
    assert str(found.why) == "its corner marks fit several sheets: Student 1, Student 9"


def test_what_becomes_of_pages() -> None:
    """The first scan of a sheet counts, its words are joined to it, blank pages are none, unknown ones are nobody's."""
    assert fates(
        seen("again-1", marks(CODES[1])), seen("words", marks(page_code(CODES[0], 2))), seen("plans", marks(CODES[0])),
        seen("again-2", marks(CODES[1])), seen("back", blank=True), seen("torn"), seen("spare", marks(CODES[3])),
    ) == [("again-1", "Student 2", "judged"), ("words", "Student 1", "joined"), ("plans", "Student 1", "judged"),
          ("again-2", "Student 2", "again"), ("back", "", "blank"), ("torn", "", "unassigned"),
          ("spare", "4", "judged")]  # fmt: skip


@pytest.mark.parametrize(("word", "fate"), [
    (Assignment("Student 3"), ("torn", "Student 3", "judged")),  # who has handed in nothing else
    (Assignment("Student 1"), ("torn", "Student 1", "joined")),  # whose sheet is there
    (Assignment(variant=2), ("torn", "Student 2", "judged")),
    (Assignment(), ("torn", "", "set aside")),
])
def test_the_teacher_names_pages(word: Assignment, fate: tuple[str, str, str]) -> None:
    """A page without a code is judged as the sheet of whom the teacher says, or is joined to it, or set aside."""
    assert fates(seen("torn"), seen("plans", marks(CODES[0])), assigned={"torn": word})[0] == fate


def test_a_name_does_not_change_the_task() -> None:
    """A sheet that another student drew on is judged by its own code, under the name that the teacher says."""
    (found,) = place_pages([seen("page", marks(CODES[3]))], REGISTER, {"page": Assignment("Student 2")})
    assert found.sheet == REGISTER.sheets[3]
    assert found.owner == "Student 2"


def test_a_scan_that_cannot_be_judged_gives_way() -> None:
    """Where the first scan of a sheet cannot be judged, the second counts, and that is told."""
    found = place_pages([seen("one", marks(CODES[0])), seen("two", marks(CODES[0]))], REGISTER, {})
    assert [(one.fate, *map(str, one.notes)) for one in replace_failed(found, {"one"})] == [
        ("again",), ("judged", "page one cannot be judged")]
    assert list(replace_failed(found, {"one", "two"})) == found


def test_words_of_the_teacher(tmp_path: Path) -> None:
    """A page is named by PAGE=STUDENT, by its number in a single file, or by tables, with a comma or a semicolon."""
    pages = [StackPage(Path("s.pdf"), number, f"s.pdf#{number}") for number in (1, 2, 3)]
    (tmp_path / "a.csv").write_text("page;variant\n2;4\n3;\n")
    assert assignments(["1=Student 2", str(tmp_path / "a.csv"), "s.pdf#3=-"], pages, REGISTER) == {
        "s.pdf#1": Assignment("Student 2"), "s.pdf#2": Assignment(variant=4), "s.pdf#3": Assignment()}
    for told, why in [("9=Student 1", "there is no page 9"), (str(tmp_path / "b.csv"), "no such file"),
                      (str(tmp_path / "c.csv"), "no columns"), (str(tmp_path / "d.csv"), "there is no variant 77")]:
        (tmp_path / "c.csv").write_text("leaf,who\n1,Student 1\n")
        (tmp_path / "d.csv").write_text("page,variant\n1,77\n")
        with pytest.raises(Refused, match=why):
            assignments([told], pages, REGISTER)
    with pytest.raises(Refused, match="perhaps Student 3"):
        place_pages([seen("torn")], REGISTER, {"torn": Assignment("student 3")})
