"""`graphplan verify FOLDER STACK`: the scans of a class in one document, judged, told and handed back."""

from __future__ import annotations

import csv
import json
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pypdfium2
import pytest
from drawing_board import Fault
from drawing_pictures import Grey, as_document, on_printed_task, page_of, pencilled, printed, scan
from face import Ran, ran
from hand_drawings import task_of

pytestmark = pytest.mark.costly

STUDENTS = "Student 1", "Student 2", "Student: 3/4", "Student 5"
WRONG = Fault("wrong side", "b' by A", 0)
TASK = task_of("four-bar, polar", 1)


@dataclass(frozen=True)
class Class:
    """A class in a folder, with a booklet of its tasks as they are printed."""

    folder: Path

    def drawn(self, variant: int, fault: Fault | None = None) -> Grey:
        """A scan of the sheet of a variant, drawn upon."""
        text = next(self.folder.glob(f"variant-*{variant}.toml")).read_text()
        task = replace(TASK, scene=text, omega=tomllib.loads(text)["drive"][0]["omega"])
        drawing, _ = on_printed_task(task, variant, fault)
        return scan(self.page(variant), pencilled(drawing.board), variant, dpi=150)

    def page(self, variant: int) -> Any:
        """A page of the booklet."""
        sheets = json.loads((self.folder / "class.json").read_text())["sheets"]
        return page_of(self.folder / "booklet.pdf", sheets[variant - 1]["page"])

    def verified(self, stack: Path, *words: str) -> Ran:
        return ran("verify", self.folder, stack, "--jobs", "1", *words)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Class:
    """Four variants, one for each student."""
    at = tmp_path_factory.mktemp("class")
    speeds = [TASK.omega * share for share in (1, 1.02, 0.98, 0.96)]
    (at / "scene.toml").write_text(TASK.scene + f'[vary]\n"drive.0.omega" = {speeds}\n')
    (at / "names.csv").write_text("name\n" + "\n".join(STUDENTS))
    done = ran("variants", at / "scene.toml", "--names", at / "names.csv", "--plan", "polar", "--jobs", "1", "-q", "-o",
               at / "class")
    assert done.status == 0, done.err
    return Class(at / "class")


@dataclass(frozen=True)
class Judged:
    """What came of a stack."""

    made: Class
    stack: Path
    done: Ran

    @property
    def into(self) -> Path:
        return self.made.folder / "results"

    @property
    def rows(self) -> list[dict[str, str]]:
        with (self.into / "results.csv").open() as file:
            return list(csv.DictReader(file))

    def row(self, student: str) -> dict[str, str]:
        return next(row for row in self.rows if row["student"] == student)


def without_marks(image: Grey) -> Grey:
    """A scan whose corners are dirty: nobody can read the marks."""
    image, (high, wide) = image.copy(), image.shape
    for rows in (slice(0, high // 27), slice(-high // 27, None)):
        for columns in (slice(0, wide // 17), slice(-wide // 42, None)):
            image[rows, columns] = 200
    return image


@pytest.fixture(scope="module")
def judged(made: Class) -> Judged:
    """A stack in disorder: mirrored, blank, upside down, torn, twice, of another class."""
    wrong, torn = made.drawn(1, WRONG), without_marks(made.drawn(2))
    blank = np.clip(np.random.default_rng(1).normal(245, 3, (1650, 2330)), 0, 255).astype(np.uint8)
    foreign = scan(printed("slider-crank"), [], 3, dpi=150)
    stack = made.folder / "scans.pdf"
    stack.write_bytes(as_document(made.drawn(3)[:, ::-1], blank, wrong[::-1, ::-1], torn, wrong[::-1, ::-1], foreign))
    return Judged(made, stack, made.verified(stack))


def test_each_page_is_as_told(judged: Judged) -> None:
    """Each sheet is its student's, a second scan is told, what has no code is nobody's, who has no page is named; and
    all that is kept is after its schema."""
    assert judged.done.status == 0, judged.done.err
    found = [(row["page"], row["student"], row["status"], row["first_wrong_step"] != "") for row in judged.rows]
    assert found == [
        ("scans.pdf#3", "Student 1", "judged", True),
        ("scans.pdf#5", "Student 1", "again", True),
        ("", "Student 2", "not handed in", False),
        ("scans.pdf#1", "Student: 3/4", "judged", False),
        ("", "Student 5", "not handed in", False),
        ("scans.pdf#4", "", "unassigned", False),
        ("scans.pdf#6", "", "unassigned", False),
    ]
    assert judged.rows[1]["look"].startswith("handed in twice: page scans.pdf#3 counts")
    assert judged.rows[3]["look"].startswith("the page is mirrored")
    assert "Blank pages: 1." in judged.done.out
    assert "Not handed in: Student 2, Student 5." in judged.done.out
    validator = pytest.importorskip("jsonschema")
    validator.validate(json.loads((judged.into / "results.json").read_text()), ran("schema", "verify").json)


def test_a_sheet_of_a_stack_is_judged_as_one_drawing(judged: Judged, tmp_path: Path) -> None:
    """As a scan of its scene is alone."""
    cv2.imwrite(str(path := tmp_path / "scan.png"), judged.made.drawn(1, WRONG)[::-1, ::-1])
    alone = ran("verify", judged.made.folder / "variant-01.toml", path, "--plan", "polar", "--json", "-q").json
    found = json.loads((judged.into / "results.json").read_text())["sheets"][0]
    assert found["judgement"]["first_wrong"]["mark"] == alone["first_wrong"]["mark"]
    assert found["score"] == pytest.approx(alone["score"]["total"], abs=5)


def test_what_is_kept_is_not_judged_again(judged: Judged) -> None:
    """The same stack gives the same results, of what is kept."""
    names = "results.csv", "results.html", "results.json", "corrected/Student 1.pdf"
    before = [(judged.into / name).read_bytes() for name in names]
    kept = {path.name: path.stat().st_mtime_ns for path in (judged.into / "kept").iterdir() if len(path.stem) > 20}
    assert judged.made.verified(judged.stack).out == judged.done.out
    assert [(judged.into / name).read_bytes() for name in names] == before
    assert {path.name: path.stat().st_mtime_ns for path in (judged.into / "kept").iterdir()
            if len(path.stem) > 20} == kept  # fmt: skip


def words_of(path: Path) -> str:
    """All words of a document."""
    with pypdfium2.PdfDocument(path) as document:
        return " ".join(" ".join(page.get_textpage().get_text_bounded() for page in document).split())


def test_what_is_handed_back(judged: Judged) -> None:
    """Each student whose sheet counts has it back under a name that any system takes: the scan with corrections in
    colour, then the true drawing; the page of results shows what is left to the teacher and fetches nothing."""
    files = sorted(path.name for path in (judged.into / "corrected").iterdir())
    assert files == ["Student 1.pdf", "Student_ 3_4.pdf"]
    words = words_of(judged.into / "corrected" / files[0])
    assert "First wrong is" in words
    assert "Legend" in words
    with pypdfium2.PdfDocument(judged.into / "corrected" / files[0]) as document:
        first = document[0].render(scale=2).to_numpy()
    assert (np.abs(first[..., 0].astype(int) - first[..., 2]) > 100).sum() > 200
    page = (judged.into / "results.html").read_text()
    assert re.findall(r'<img [^>]*alt="([^"]*)"', page) == ["scans.pdf#4", "scans.pdf#6"]
    assert "its code is that of no sheet of this class" in page
    assert not re.search(r'(src|href)="(?!data:|corrected/)', page)


def test_a_named_page_is_judged(judged: Judged) -> None:
    """The page without a code is judged as whose the teacher says, laid by its frame, and is nobody's again without."""
    done = judged.made.verified(judged.stack, "--assign", "4=Student 2", "--assign", "6=-")
    assert done.status == 0
    assert (judged.row("Student 2")["page"], judged.row("Student 2")["status"]) == ("scans.pdf#4", "judged")
    assert judged.row("Student 2")["look"].startswith("named by the teacher")
    assert "Left to be named" not in done.out
    judged.made.verified(judged.stack)
    assert not (judged.into / "corrected" / "Student 2.pdf").exists()


def test_the_teacher_has_the_last_word(judged: Judged) -> None:
    """A score and a note are kept, stand on what is handed back and in the results, hold in the next run, and go
    again."""
    first = judged.row("Student 1")
    assert judged.made.verified(judged.stack, "--score", "Student 1=85", "--note", "A method of your own.").status == 0
    for _ in range(2):  # the second time by what is kept
        assert (judged.row("Student 1")["score"], judged.row("Student 1")["note"]) == ("85.0", "A method of your own.")
        assert "The teacher's score: 85 of 100." in words_of(judged.into / "corrected" / "Student 1.pdf")
        judged.made.verified(judged.stack)
    judged.made.verified(judged.stack, "--score", "Student 1=-", "--note", "Student 1=-")
    assert judged.row("Student 1") == first


REFUSED: dict[str, tuple[Callable[[Judged], Path], tuple[str, ...], str]] = {
    "a score of nobody": (lambda judged: judged.stack, ("--score", "Student 77=50"), "--score"),
    "a score above 100": (lambda judged: judged.stack, ("--score", "Student 1=101"), "--score"),
    "no score": (lambda judged: judged.stack, ("--score", "Student 1"), "--score"),
    "a note on nobody": (lambda judged: judged.stack, ("--note", "Student 77=x"), "--note"),
    "a page that is not there": (lambda judged: judged.stack, ("--assign", "9=Student 1"), "there is no page 9"),
    "a student who is not there": (lambda judged: judged.stack, ("--assign", "4=student 5"), "perhaps Student 5"),
    "another paper": (lambda judged: judged.stack, ("--paper", "A2"), "leave it out"),
    "no scans": (lambda judged: judged.made.folder.parent / "names.txt", (), "No scans: names.txt"),
    "no file": (lambda judged: judged.made.folder.parent / "none.pdf", (), "No scans: none.pdf"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_done_is_refused(case: str, judged: Judged) -> None:
    """Words on nobody, pages that are not there, what is no stack: exit status 2, a word, and results as they were."""
    into = judged.into if REFUSED[case][1] else judged.made.folder.parent / "elsewhere"
    (judged.made.folder.parent / "names.txt").write_text("none")
    stack, words, told = REFUSED[case]
    before = (judged.into / "results.csv").read_bytes()
    done = judged.made.verified(stack(judged), "-q", "-o", str(into), *words)
    assert done.status == 2
    assert told in done.out + done.err
    assert (judged.into / "results.csv").read_bytes() == before


def test_an_empty_sheet_is_said_to_be_blank(made: Class, tmp_path: Path) -> None:
    """A sheet on which its student drew nothing is the student's, scores nothing, and is handed back."""
    cv2.imwrite(str(stack := tmp_path / "empty.png"), scan(made.page(4), [], 5, dpi=150))
    assert made.verified(stack, "-o", str(tmp_path / "results")).status == 0
    with (tmp_path / "results" / "results.csv").open() as file:
        rows = [(row["student"], row["status"], row["score"]) for row in csv.DictReader(file) if row["page"]]
    assert rows == [("Student 5", "judged", "0.0")]
    assert (tmp_path / "results" / "corrected" / "Student 5.pdf").exists()
