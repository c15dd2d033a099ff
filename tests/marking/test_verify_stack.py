"""`graphplan verify FOLDER STACK`: the scans of a class in one document, judged, told and handed back."""

from __future__ import annotations

import csv
import json
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")
pdfium = pytest.importorskip("pypdfium2")

from hands import draw, frames, slipped, strokes  # noqa: E402
from raster import printed, scan  # noqa: E402

from graphplan.accuracy.drafted import Drafted  # noqa: E402
from graphplan.accuracy.hand import Pencil  # noqa: E402
from graphplan.commands import main, parser  # noqa: E402
from graphplan.commands.choices import drawing_options  # noqa: E402
from graphplan.commands.schema import result_schema as printed_schema  # noqa: E402
from graphplan.marking.classroom.register import ClassRegister, TaskSheet  # noqa: E402
from graphplan.marking.judge.findings import judgement_record  # noqa: E402
from graphplan.marking.judge.score import parse_weights  # noqa: E402
from graphplan.marking.scans.image import Grey, page_picture  # noqa: E402
from graphplan.marking.scans.printed_ink import is_blank, marks_of_sheet  # noqa: E402
from graphplan.marking.scans.straighten import whole_photograph  # noqa: E402
from graphplan.mechanism.scene import load  # noqa: E402
from graphplan.output.pdf import pdf  # noqa: E402
from graphplan.public.desk import Desk  # noqa: E402
from graphplan.public.drafting import Options  # noqa: E402
from graphplan.public.variants import draft_scene  # noqa: E402
from graphplan.sheet.frames.frame import corner_marks, corner_numbers, sheet_code  # noqa: E402
from graphplan.sheet.handout import code, task  # noqa: E402
from graphplan.sheet.layout.scales import Scales  # noqa: E402
from graphplan.sheet.plates.display import Rect, Sheet  # noqa: E402

SCENE = (Path(__file__).parents[2] / "graphplan" / "scenes" / "four-bar.toml").read_text()
STUDENTS = "Student 1", "Student 2", "Student: 3/4", "Student 5"
WRONG = "perpendicular to AB instead of BC"


def chosen(scene: Path, *words: str) -> Options:
    """The options of a command line."""
    return drawing_options(parser(("verify",)).parse_args(["verify", str(scene), "-", "--paper", "A4", *words]))


@dataclass(frozen=True)
class Class:
    """A class in a folder: its sheets as they are printed."""

    folder: Path
    sheets: tuple[Drafted, ...]

    def drawn(self, variant: int, *, wrong: bool = False) -> Grey:
        """A scan of the sheet of a variant, drawn by a hand."""
        sheet = self.sheets[variant - 1]
        drawing, composition = sheet.drawing, sheet.composition
        beta = next(step.index for step in drawing.drawn.steps if step.name == "beta")
        mistake = next(mistake for mistake in slipped(drawing, beta) if mistake.text == WRONG)
        drawn = draw(drawing, frames(drawing, composition), Pencil(), 30 + variant, {beta: mistake} if wrong else None)
        paper = printed(task(composition)[0])
        return scan(paper, strokes(drawn, composition, variant), variant, dpi=150).image

    def stacked(self, *images: Grey) -> Path:
        """Scans as one document."""
        path = self.folder / "scans.pdf"
        path.write_bytes(pdf([_page(image) for image in images]))
        return path


def _page(image: Grey) -> Sheet:
    """A picture as a page."""
    shown = whole_photograph(np.ascontiguousarray(image))
    return Sheet(shown.rect.width, shown.rect.height, shown.rect, {}, (shown,), "", "", (), Scales(1.0, 1.0, "mm", {}))


def a_class(folder: Path) -> Class:
    """Four variants and their register."""
    sheets = []
    for number in range(1, 5):
        scene = folder / f"variant-{number}.toml"
        scene.write_text(f"# variant {number}\n{SCENE}")
        named = replace((own := load(str(scene))).sheet, student=STUDENTS[number - 1], variant=str(number))
        sheets.append(draft_scene(chosen(scene), replace(own, sheet=named)))
    register = ClassRegister("Four bars", 1, {"paper": "A4"}, tuple(
        TaskSheet(code(sheet.composition), number, student, f"variant-{number}.toml", number)
        for number, (student, sheet) in enumerate(zip(STUDENTS, sheets, strict=True), 1)))
    (folder / "class.json").write_text(register.text, encoding="utf-8")
    return Class(folder, tuple(sheets))


def without_marks(image: Grey) -> Grey:
    """A scan whose corners are dirty: nobody can read the marks."""
    image, (high, wide) = image.copy(), image.shape
    for rows in (slice(0, high // 27), slice(-high // 27, None)):
        for columns in (slice(0, wide // 17), slice(-wide // 42, None)):
            image[rows, columns] = 200
    return image


def foreign() -> Grey:
    """A sheet of another class."""
    page = Sheet(297.0, 210.0, Rect(20.0, 10.0, 287.0, 200.0), {}, (), "", "", (), Scales(1.0, 1.0, "mm", {}))
    marked = replace(page, items=tuple(corner_marks(page.width, page.height, page.frame, sheet_code("another"))))
    return scan(printed(marked), [], 3).image


@dataclass(frozen=True)
class Judged:
    """What a run has left."""

    made: Class
    stack: Path
    status: int
    words: str

    @property
    def into(self) -> Path:
        return self.made.folder / "results"

    @property
    def rows(self) -> list[dict[str, str]]:
        """The lines of results.csv."""
        with (self.into / "results.csv").open(newline="") as file:
            return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Class:
    """The class."""
    return a_class(tmp_path_factory.mktemp("class"))


@pytest.fixture(scope="module")
def judged(made: Class) -> Judged:
    """A stack in disorder, judged: upside down, blank, torn, twice, mirrored, of another class."""
    wrong, torn = made.drawn(1, wrong=True), without_marks(made.drawn(2))
    paper = np.clip(np.random.default_rng(1).normal(245, 3, (1650, 2330)), 0, 255).astype(np.uint8)
    stack = made.stacked(made.drawn(3)[:, ::-1], paper, wrong[::-1, ::-1], torn, wrong[::-1, ::-1], foreign())
    status, words = told(made, stack)
    return Judged(made, stack, status, words)


def told(made: Class, stack: Path, *words: str) -> tuple[int, str]:
    """Run it; its exit status and standard output."""
    import contextlib
    import io

    with contextlib.redirect_stdout(io.StringIO()) as out:
        status = main(["verify", str(made.folder), str(stack), "--jobs", "1", *words])
    return status, out.getvalue()


def test_each_page_is_as_told(judged: Judged) -> None:
    """Each sheet is its student's, a second scan is told, what has no code is nobody's, who has no page is named."""
    assert judged.status == 0
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
    assert "Blank pages: 1." in judged.words
    assert "Not handed in: Student 2, Student 5." in judged.words


@pytest.mark.costly
def test_one_verdict(judged: Judged) -> None:
    """A sheet of a stack is judged as a drawing of its scene is alone."""
    image = page_picture(judged.stack, 3)
    sheet = judged.made.sheets[0]
    desk = Desk(sheet, parse_weights(""), chosen(judged.made.folder / "variant-1.toml"))
    from graphplan.marking.scans.scan import read_picture

    alone = desk.judge_submission(read_picture(image, "scans.pdf#3", task(sheet.composition)[0], desk.frames,
                                               code(sheet.composition)))
    found = json.loads((judged.into / "results.json").read_text())["sheets"][0]
    assert found["judgement"] == json.loads(json.dumps(judgement_record(alone.judgement, alone.score)))
    assert found["score"] == alone.score.total


def test_what_is_kept_is_not_judged_again(judged: Judged) -> None:
    """The same stack is the same results, of what is kept; a page that the teacher names is all that is judged."""
    names = "results.csv", "results.html", "results.json", "corrected/Student 1.pdf"
    before = [(judged.into / name).read_bytes() for name in names]
    kept = {path.name: path.stat().st_mtime_ns for path in (judged.into / "kept").iterdir() if len(path.stem) > 20}
    assert told(judged.made, judged.stack) == (0, judged.words)
    assert [(judged.into / name).read_bytes() for name in names] == before
    assert {path.name: path.stat().st_mtime_ns for path in (judged.into / "kept").iterdir()
            if len(path.stem) > 20} == kept  # fmt: skip
    assert {path.name for path in judged.made.folder.iterdir()} == {
        "class.json", "scans.pdf", "results", *(f"variant-{number}.toml" for number in range(1, 5))}


def test_what_is_handed_back(judged: Judged) -> None:
    """Each student whose sheet counts has it back under a name that any system takes: the scan, then the true
    drawing."""
    files = sorted(path.name for path in (judged.into / "corrected").iterdir())
    assert files == ["Student 1.pdf", "Student_ 3_4.pdf"]
    with pdfium.PdfDocument(judged.into / "corrected" / files[0]) as document:
        pages = [page.get_textpage().get_text_bounded() for page in document]
        first = document[0].render(scale=2).to_numpy()
    assert "First wrong is" in pages[0]
    verdict, said = (re.sub(r"[_\s]", "", text) for text in (judged.rows[0]["verdict"], pages[0]))  # B_1 is lettered
    assert verdict in said
    assert "Legend" in " ".join(pages[1:])
    red = (first[..., 0].astype(int) - first[..., 2] > 100) | (first[..., 2].astype(int) - first[..., 0] > 100)
    assert red.sum() > 200  # corrections in colour on a grey scan


def test_the_page_shows_what_is_left_to_the_teacher(judged: Judged) -> None:
    """Pages without a name and the most frequent mistake are pictures of the page itself, which fetches nothing."""
    page = (judged.into / "results.html").read_text()
    assert re.findall(r'<img [^>]*alt="([^"]*)"', page) == ["scans.pdf#4", "scans.pdf#6"]
    assert "its code is that of no sheet of this class" in page
    assert page.count("<image ") == 1
    assert not re.search(r'(src|href)="(?!data:|corrected/)', page)


@pytest.mark.costly
def test_a_named_page_is_judged(judged: Judged) -> None:
    """The page without a code is judged as whose the teacher says, laid by its frame."""
    status, words = told(judged.made, judged.stack, "--assign", "4=Student 2", "--assign", "6=-")
    assert status == 0
    row = next(row for row in judged.rows if row["student"] == "Student 2")
    assert (row["page"], row["status"]) == ("scans.pdf#4", "judged")
    assert row["look"].startswith("named by the teacher")
    assert "Left to be named" not in words
    assert (judged.into / "corrected" / "Student 2.pdf").exists()
    told(judged.made, judged.stack)
    assert not (judged.into / "corrected" / "Student 2.pdf").exists()


def test_nothing_to_be_judged(judged: Judged, capsys: pytest.CaptureFixture[str]) -> None:
    """A stack of which nothing is judged is exit 2; one that cannot be is refused with a word, and nothing written."""
    folder = judged.made.folder
    into = folder.parent / "elsewhere"
    (folder.parent / "notes.txt").write_text("none")
    for stack, word, status in [(folder.parent / "notes.txt", "No scans: notes.txt", 2), (folder, "class.json", 2),
                                (folder.parent / "none.pdf", "No scans: none.pdf", 2)]:
        assert main(["verify", str(folder), str(stack), "-o", str(into), "--jobs", "1"]) == status
        captured = capsys.readouterr()
        assert word in captured.out + captured.err
    assert main(["verify", str(folder), str(judged.stack), "--paper", "A2"]) == 2
    assert "leave it out" in capsys.readouterr().err


@pytest.mark.parametrize("quarters", range(4))
def test_marks_are_read_any_way_up(made: Class, quarters: int) -> None:
    """Marks tell the sheet whichever way it lies, by two of them too; a page without ink is blank, a sheet is not."""
    sheet = made.sheets[0].composition
    image = scan(printed(task(sheet)[0]), [], 7, dpi=150, quarters=quarters).image
    assert marks_of_sheet(image) == dict(enumerate(corner_numbers(code(sheet))))
    high, wide = image.shape
    half = image[: high // 2] if quarters % 2 else image[:, : wide // 2]
    assert len(marks_of_sheet(half)) == 2
    assert not is_blank(image)


def test_data_is_after_its_schema(judged: Judged) -> None:
    """results.json is what the schema of `graphplan verify` says."""
    validator = pytest.importorskip("jsonschema")
    validator.validate(json.loads((judged.into / "results.json").read_text()), printed_schema("verify"))


@pytest.mark.costly
def test_an_empty_sheet_is_said_to_be_blank(made: Class, tmp_path: Path) -> None:
    """A sheet on which its student drew nothing is the student's, scores nothing, and is handed back."""
    sheet = made.sheets[3].composition
    stack = tmp_path / "empty.png"
    cv2.imwrite(str(stack), scan(printed(task(sheet)[0]), [], 5, dpi=150).image)
    status, words = told(made, stack, "-o", str(tmp_path / "results"))
    assert status == 0
    rows = Judged(replace(made, folder=tmp_path), stack, status, words).rows
    assert [(row["student"], row["status"], row["score"]) for row in rows if row["page"]] == [
        ("Student 5", "judged", "0.0")]
    assert (tmp_path / "results" / "corrected" / "Student 5.pdf").exists()


def test_the_teacher_has_the_last_word(judged: Judged) -> None:
    """A score and a note are kept, stand on what is handed back and in the results, hold in the next run, and go again.
    """
    first = next(row for row in judged.rows if row["student"] == "Student 1")
    status, _ = told(judged.made, judged.stack, "--score", "Student 1=85", "--note", "A method of your own.")
    assert status == 0
    for _ in range(2):  # the second time by what is kept
        row = next(row for row in judged.rows if row["student"] == "Student 1")
        assert (row["score"], row["note"]) == ("85.0", "A method of your own.")
        words = "".join(page.get_textpage().get_text_bounded() for page in pdfium.PdfDocument(
            str(judged.into / "corrected" / "Student 1.pdf")))
        assert "The teacher's score: 85 of 100." in " ".join(words.split())
        told(judged.made, judged.stack)
    told(judged.made, judged.stack, "--score", "Student 1=-", "--note", "Student 1=-")
    assert next(row for row in judged.rows if row["student"] == "Student 1") == first


@pytest.mark.parametrize("words", [("--score", "Student 77=50"), ("--score", "Student 1=101"), ("--score", "Student 1"),
                                   ("--note", "Student 77=x")])
def test_a_word_on_nobody_is_refused(judged: Judged, words: tuple[str, str], capsys: pytest.CaptureFixture[str]
                                     ) -> None:
    """One line, and nothing kept."""
    assert main(["verify", str(judged.made.folder), str(judged.stack), *words, "-q"]) == 2
    assert capsys.readouterr().err.startswith(words[0])
