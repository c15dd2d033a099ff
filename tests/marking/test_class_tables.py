"""`graphplan verify FOLDER TABLE`: the results of a class in one table or a folder of them, each by its own variant."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from face import ran

STUDENTS = "Student 1", "Student 2", "Student 3"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A class of three."""
    at = tmp_path_factory.mktemp("class")
    (at / "names.csv").write_text("name,group\n" + "\n".join(f"{name},{name[-1]}" for name in STUDENTS))
    done = ran("variants", "four-bar", "--names", at / "names.csv", "--paper", "A4", "-q", "--jobs", "1", "-o",
               at / "class")
    assert done.status == 0, done.err
    return at / "class"


def key(folder: Path) -> list[dict[str, str]]:
    with (folder / "key.csv").open() as file:
        return list(csv.DictReader(file))


def results(folder: Path, table: Path, *words: str) -> dict[str, Any]:
    """The lines of the results, by student or by page."""
    into = table.parent / "results"
    done = ran("verify", folder, table, "-q", "--jobs", "1", "-o", into, *words)
    assert done.status == 0, done.err
    sheets = json.loads((into / "results.json").read_text())["sheets"]
    return {sheet["student"] or sheet["page"]: sheet for sheet in sheets}


def write(path: Path, rows: Iterable[dict[str, str]]) -> Path:
    rows = list(rows)
    with path.open("w") as file:
        table = csv.DictWriter(file, list(rows[0]))
        table.writeheader()
        table.writerows(rows)
    return path


def test_each_student_is_judged_by_his_own_variant(folder: Path, tmp_path: Path) -> None:
    """The key is right for all; with another's numbers it is not; who is in no class has no task."""
    rows = key(folder)
    found = results(folder, write(tmp_path / "table.csv", rows))
    assert [found[name]["score"] for name in STUDENTS] == [100.0] * 3
    owner = {"1": "Student 2", "2": "Student 1", "3": "Nobody"}
    found = results(folder, write(tmp_path / "table.csv", [
        {"student": owner[row["variant"]], **{k: row[k] for k in ("quantity", "of", "x", "y", "value", "unit")}}
        for row in rows]))
    assert found["Student 1"]["score"] < 50 > found["Student 2"]["score"]
    assert (found["Student 3"]["status"], found["table.csv: Nobody"]["status"]) == ("not handed in", "not judged")


def test_sizes_alone_are_judged_as_far_as_they_say(folder: Path, tmp_path: Path) -> None:
    """A right size is right, whichever way the vector points; a wrong one is wrong by the difference of sizes."""
    sizes = [{"variant": row["variant"], "quantity": row["quantity"], "of": row["of"], "unit": row["unit"],
              "size": f"{math.hypot(float(row['x']), float(row['y'])) * (1.5 if row['variant'] == '2' else 1):.1f}"}
             for row in key(folder) if row["x"] and row["of"] == "B"]
    found = results(folder, write(tmp_path / "table.csv", sizes))
    verdicts = {name: {number["verdict"] for number in found[name]["judgement"]["numbers"]} for name in STUDENTS}
    assert verdicts == {"Student 1": {"right"}, "Student 2": {"wrong"}, "Student 3": {"right"}}


def test_a_folder_of_tables_is_a_class(folder: Path, tmp_path: Path) -> None:
    """Called after students or variants; a table that cannot be read costs the others nothing; a teacher's word counts
    and stands on what is handed back."""
    (tables := tmp_path / "tables").mkdir()
    for name, variant in (("Student 1", "1"), ("variant-2", "2")):
        write(tables / f"{name}.csv", [row for row in key(folder) if row["variant"] == variant])
    (tables / "Student 3.csv").write_text("quantity,of,x,y,unit\nvelocity,A,x,1,mm/s\n")
    found = results(folder, tables, "--score", "Student 2=71", "--note", "A method of your own.")
    assert [found[name]["score"] for name in STUDENTS[:2]] == [100.0, 71.0]
    assert found["Student 3"]["status"] == "not judged"
    assert found["Student 2"]["note"] == "A method of your own."
    assert (tmp_path / "results" / "corrected" / "Student 2.pdf").is_file()


def test_a_grade_book_has_a_line_a_student(folder: Path, tmp_path: Path) -> None:
    """Scores go out by student and group, also of who has handed in nothing."""
    rows = [row for row in key(folder) if row["variant"] != "3"]
    book = tmp_path / "grades.csv"
    results(folder, write(tmp_path / "table.csv", rows), "--report", str(book), "--score", "Student 2=50.5", "--note",
            "Late.")
    assert book.read_text() == (tmp_path / "results" / "results.csv").read_text()
    with book.open() as file:
        grades = [tuple(row[column] for column in ("student", "group", "status", "score", "note"))
                  for row in csv.DictReader(file)]
    assert grades == [("Student 1", "1", "judged", "100.0", ""), ("Student 2", "2", "judged", "50.5", "Late."),
                      ("Student 3", "3", "not handed in", "", "")]


def test_a_grade_book_in_xlsx_needs_its_library(folder: Path, tmp_path: Path) -> None:
    """Where openpyxl is not installed that is one line before anything is judged; where it is, numbers are numbers."""
    table, book = write(tmp_path / "table.csv", key(folder)), tmp_path / "grades.xlsx"
    done = ran("verify", folder, table, "-q", "--jobs", "1", "-o", tmp_path / "results", "--report", book)
    if find_spec("openpyxl"):
        from openpyxl import load_workbook

        head, *lines = load_workbook(book).active.values
        assert [line[head.index("score")] for line in lines] == [100] * 3
    else:
        assert done.status == 2
        assert done.err == (f"{book}: openpyxl is not installed; pip install 'graphplan[xlsx]', "
                            "or a name in .csv, which spreadsheets read\n")
        assert not (tmp_path / "results").exists()


def page_data(page: Path) -> dict[str, Any]:
    """What a page of review holds."""
    text = page.read_text()
    assert "default-src 'none'" in text
    assert " src=" not in text
    held: dict[str, Any] = json.loads(text.partition('id="class">')[2].partition("</script>")[0])
    return held


def test_what_a_teacher_decides_on_the_page_of_review_is_in_the_grade_book(folder: Path, tmp_path: Path) -> None:
    """A wrong result that is overruled counts as right; a score and a note are told; the stack need not be named again.
    """
    rows = key(folder)
    next(row for row in rows if row["student"] == "Student 2" and row["quantity"] == "velocity")["x"] = "-12345"
    found = results(folder, write(tmp_path / "table.csv", rows), "--review", str(tmp_path / "review.html"))
    held = page_data(tmp_path / "review.html")
    assert {sheet["owner"] for sheet in held["sheets"]} == set(STUDENTS)
    assert all("<svg" in sheet["picture"] for sheet in held["sheets"])
    second = next(sheet for sheet in held["sheets"] if sheet["owner"] == "Student 2")
    wrong = [row["name"] for row in second["rows"] if row["verdict"] == "wrong"]
    assert len(wrong) == 1
    assert found["Student 2"]["score"] < 100.0
    decided = {"words": {"Student 2": {"verdicts": {wrong[0]: "right"}, "accepted": True},
                         "Student 3": {"score": 70, "note": "Late."}}}
    (words := tmp_path / "decisions.json").write_text(json.dumps(decided))
    done = ran("verify", folder, "--words", words, "-q", "--jobs", "1", "-o", tmp_path / "results", "--report",
               tmp_path / "grades.csv")
    assert done.status == 0, done.err
    with (tmp_path / "grades.csv").open() as file:
        grades = {row["student"]: (float(row["score"]), row["note"]) for row in csv.DictReader(file)}
    assert grades == {"Student 1": (100.0, ""), "Student 2": (100.0, ""), "Student 3": (70.0, "Late.")}


@pytest.mark.parametrize(("text", "why"), [
    ("{}", "it does not hold decisions"), ("[1", "it does not hold decisions"),
    ('{"words": {"Nobody": {}}}', "there is no 'Nobody' in this class"),
    ('{"words": {"Student 1": {"score": 101}}}', "101 is not a score"),
    ('{"words": {"Student 1": {"verdicts": {"3": "fine"}}}}', "'fine' is not a verdict"),
])
def test_decisions_that_nobody_can_mean_are_refused(folder: Path, tmp_path: Path, text: str, why: str) -> None:
    """In one line."""
    (words := tmp_path / "decisions.json").write_text(text)
    done = ran("verify", folder, write(tmp_path / "table.csv", key(folder)), "--words", words, "-q", "-o",
               tmp_path / "results")
    assert (done.status, done.err.count("\n")) == (2, 1)
    assert why in done.err
