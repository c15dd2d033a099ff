"""Drawings verified at the command line: the verdict, reports of every kind, a class, and what is refused."""

from __future__ import annotations

import json
import os
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from jsonschema import Draft202012Validator

import graphplan as gp
from graphplan.commands import main
from graphplan.commands.schema import result_schema as schema_of
from graphplan.kernel.kinds import POINT
from graphplan.marking.judge import judge as judging
from graphplan.marking.judge.verdict import Judgement
from graphplan.marking.traces import Submission
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.plans import Plans

SCALE = 0.4  # mm of the student's sheet for a unit of the scene
LAST = 37  # the last step of the four-bar's construction, where lines 35 and 36 meet


@cache
def points(off: float = 0.0) -> str:
    """The measured points of a four-bar, the last one so many mm off."""
    drawing = gp.construct(gp.load("four-bar"))
    plans, drawn = Plans(drawing), drawing.drawn
    rows = ["mark,x,y,panel"]
    for step in drawn.steps:
        if step.op.gives == POINT:
            x, y = (SCALE * part for part in plans.spot(step.index))
            x += off if drawn.number(step.index) == LAST else 0.0
            rows.append(f"{step.name or drawn.number(step.index)},{x:.3f},{y:.3f},{plans.plan_of_step[step.index]}")
    return "\n".join(rows) + "\n"


@pytest.fixture
def good(tmp_path: Path) -> Path:
    path = tmp_path / "good.csv"
    path.write_text(points())
    return path


@pytest.fixture
def wrong(tmp_path: Path) -> Path:
    path = tmp_path / "wrong.csv"
    path.write_text(points(6.0))
    return path


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A class: two drawings, a file that is none, and one that is hidden."""
    path = tmp_path / "class"
    path.mkdir()
    (path / "a.csv").write_text(points())
    (path / "b.csv").write_text(points(6.0))
    (path / "c.txt").write_text("none")
    (path / ".d").write_text("hidden")
    return path


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> Any:
    """The JSON that is printed, valid after its schema."""
    assert main(["verify", "four-bar", *arguments, "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert [error.message for error in Draft202012Validator(schema_of("verify")).iter_errors(data)] == []
    return data


def test_a_faultless_drawing_is_called_right(good: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The verdict is a few lines, and the status is 0."""
    assert main(["verify", "four-bar", str(good)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "No step is wrong." in lines
    assert lines[-1] == "Score: 100 of 100 (velocity 100, acceleration 100, results 100)."


def test_the_first_wrong_step_is_named(wrong: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is told with its distance and what is allowed; the status is 0, as the drawing could be judged."""
    assert main(["verify", "four-bar", str(wrong)]) == 0
    lines = capsys.readouterr().out.splitlines()
    lines = lines[lines[0].startswith("Read as"):]  # the N-plan is not as large as the task's
    assert lines[0].startswith(f"First wrong is m (step {LAST}): ")
    assert "6 mm off" in lines[0]
    assert f"Step {LAST}: Mark m where line 35 meets line 36." in lines


def test_data_is_after_its_schema(good: Path, wrong: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """--json has the first wrong step, or null, and the verdict of every step."""
    assert printed(capsys, str(good))["first_wrong"] is None
    data = printed(capsys, str(wrong))
    assert data["first_wrong"]["step"] == LAST
    assert data["first_wrong"]["off_mm"] == pytest.approx(6.0, abs=0.5)
    assert data["counts"]["wrong"] == [step["verdict"] for step in data["steps"]].count("wrong") == 1


@pytest.mark.parametrize(("suffix", "begins"), [(".html", b"<!DOCTYPE html>"), (".svg", b"<?xml"), (".pdf", b"%PDF"),
                                                (".json", b"{")])
def test_a_report_is_written(suffix: str, begins: bytes, wrong: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its name says of what kind it is; the verdict is printed all the same."""
    path = wrong.parent / f"report{suffix}"
    assert main(["verify", "four-bar", str(wrong), "--report", str(path)]) == 0
    assert path.read_bytes().startswith(begins)
    assert "First wrong is" in capsys.readouterr().out


def test_the_teacher_has_the_last_word_on_a_drawing(wrong: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A score and a note are in the data beside the judge's, in words and in the report."""
    judged = printed(capsys, str(wrong))["score"]["total"]
    data = printed(capsys, str(wrong), "--score", "85", "--note", "k = 2 was allowed.")
    assert (data["score"]["total"], data["judged_score"], data["note"]) == (85.0, judged, "k = 2 was allowed.")
    page = wrong.parent / "report.html"
    assert main(["verify", "four-bar", str(wrong), "--score", "wrong=85", "--report", str(page)]) == 0
    assert "The teacher's score: 85 of 100." in capsys.readouterr().out
    assert "The teacher&#x27;s score: 85 of 100." in page.read_text()


def test_words_on_the_drawings_of_a_folder(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """They are by the file's name; a word on nobody, or on all, is refused in one line."""
    rows = printed(capsys, str(folder), "--score", "b=71", "--note", "A method of your own.")["drawings"]
    assert [(row["score"], row["note"]) for row in rows] == [(100.0, ""), (71.0, "A method of your own.")]
    for word, why in (("d=71", "there is no 'd' among what is judged"), ("71", "it does not say whose it is")):
        assert main(["verify", "four-bar", str(folder), "--score", word]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert why in line
    assert gp.verify("four-bar", folder, score=["a.csv=50"]).json()["drawings"][0]["score"] == 50.0


def test_weights_and_pencil_are_taken_from_the_command_line(wrong: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A wrong step may earn its share all the same, and its mistake cost nothing; with a blunt enough pencil there is
    none."""
    assert printed(capsys, str(wrong), "--weights", "wrong=1,other=0")["score"]["total"] == 100.0
    assert printed(capsys, str(wrong), "--pencil", "point=3,edge=3")["first_wrong"] is None


def test_a_fault_of_the_program_is_one_line_and_stops_nothing(
        folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever fails inside a drawing, that is told with its name, and the others are judged."""
    whole = judging.judge_any_method

    def broken(drawing: Construction, composition: Composition, submission: Submission, *more: Any) -> Judgement:
        if submission.name == "b.csv":
            raise ZeroDivisionError("float division by zero")
        return whole(drawing, composition, submission, *more)

    monkeypatch.setattr(judging, "judge_any_method", broken)
    assert main(["verify", "four-bar", str(folder)]) == 0
    told = capsys.readouterr()
    assert "b.csv: could not be judged: ZeroDivisionError" in told.err
    assert "Traceback" not in told.err
    assert told.out.splitlines()[0] == "a.csv: 100 of 100; no wrong step"
    assert main(["verify", "four-bar", str(folder / "b.csv")]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_one_bad_file_does_not_stop_a_class(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It is told in one line; the other drawings are judged, and the status is 0."""
    assert main(["verify", "four-bar", str(folder)]) == 0
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert "c.txt: files of this kind (.txt) are not read" in told.err
    assert told.out.splitlines()[0] == "a.csv: 100 of 100; no wrong step"
    assert told.out.splitlines()[1].startswith("b.csv: ")
    assert "Not judged: 1." in told.out


def test_the_data_of_a_class_is_after_its_schema(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """--json has a row for each drawing, and its report is not taken for a drawing the next time."""
    path = folder / "report.json"
    for _ in range(2):
        data = printed(capsys, str(folder), "--report", str(path))
        assert json.loads(path.read_text()) == data
    assert [row["first_wrong"] for row in data["drawings"]] == [None, LAST]
    assert [one["file"] for one in data["not_judged"]] == ["c.txt"]


def test_a_class_has_a_page(folder: Path, tmp_path: Path) -> None:
    """--report in .html has a row for each drawing."""
    path = tmp_path / "class.html"
    assert main(["verify", "four-bar", str(folder), "--report", str(path), "-q"]) == 0
    assert all(name in path.read_text() for name in ("a.csv", "b.csv", "c.txt"))


def test_a_class_of_which_nothing_can_be_read_is_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder without a drawing, or with bad files alone, ends with status 2."""
    assert main(["verify", "four-bar", str(tmp_path)]) == 2
    assert "it contains no drawing" in capsys.readouterr().err
    (tmp_path / "a.txt").write_text("none")
    assert main(["verify", "four-bar", str(tmp_path)]) == 2


@pytest.mark.parametrize(("arguments", "why"), [
    (["--report", "report.txt"], "no report is written as .txt"),
    (["--weights", "wright=1"], "nothing of this name is weighed"),
    (["--pencil", "point=-1"], "not a size of an error"),
])
def test_what_makes_no_sense_is_refused(arguments: list[str], why: str, good: Path, monkeypatch: pytest.MonkeyPatch,
                                        capsys: pytest.CaptureFixture[str]) -> None:
    """One line says what is wrong; nothing is judged, and nothing written."""
    monkeypatch.chdir(good.parent)
    assert main(["verify", "four-bar", str(good), *arguments]) == 2
    told = capsys.readouterr()
    assert why in told.err
    assert told.out == ""
    assert list(good.parent.iterdir()) == [good]


def test_a_report_is_never_written_over_what_it_is_of(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Neither the student's file nor the scene is overwritten, by whatever path it is named."""
    drawing, scene, link = tmp_path / "drawing.svg", tmp_path / "scene.json", tmp_path / "link.svg"
    drawing.write_text("drawn")
    scene.write_text("[points]")
    link.symlink_to(drawing)
    for report in (drawing, link, scene):
        assert main(["verify", str(scene), str(drawing), "--report", str(report)]) == 2
        assert "itself would be overwritten" in capsys.readouterr().err
    assert (drawing.read_text(), scene.read_text()) == ("drawn", "[points]")
    assert link.is_symlink()


@pytest.mark.parametrize("name", ["a" * 300 + ".csv", "a" * 300])
def test_a_name_that_no_file_can_have_is_bad_input(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """One line, status 2."""
    assert main(["verify", "four-bar", name]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_folder_that_may_not_be_read_is_bad_input(folder: Path, monkeypatch: pytest.MonkeyPatch,
                                                    capsys: pytest.CaptureFixture[str]) -> None:
    """One line, status 2."""
    def denied(_: Path) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "iterdir", denied)
    assert main(["verify", "four-bar", str(folder)]) == 2
    assert capsys.readouterr().err == f"{folder}: it cannot be read (Permission denied); a readable folder\n"


def test_what_in_a_class_is_no_file_is_told(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A folder within the folder and a link that leads nowhere are not passed over in silence."""
    (folder / "later").mkdir()
    (folder / "lost.csv").symlink_to(folder / "gone.csv")
    told = {one["file"]: one["why"] for one in printed(capsys, str(folder))["not_judged"]}
    assert list(told) == ["c.txt", "later", "lost.csv"]
    assert told["later"].startswith("this is a folder within the folder")
    assert told["lost.csv"].startswith("the target of this link does not exist")


@pytest.mark.parametrize("seen", [True, False])
def test_who_waits_at_a_terminal_is_told_what_is_judged(seen: bool, good: Path, monkeypatch: pytest.MonkeyPatch,
                                                        capsys: pytest.CaptureFixture[str]) -> None:
    """The name stands there while its drawing is judged, and is wiped out after; a file is not written to."""
    monkeypatch.setattr("sys.stderr.isatty", lambda: seen)
    assert main(["verify", "four-bar", str(good)]) == 0
    lines = [line.strip() for line in capsys.readouterr().err.split("\r")]
    assert lines == (["", "good.csv", "", "", ""] if seen else [""])


def test_a_folder_has_no_single_sheet(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The overlay of a class is refused before anything is judged."""
    assert main(["verify", "four-bar", str(folder), "--report", str(folder / "class.svg")]) == 2
    assert "no report of a folder is written as .svg" in capsys.readouterr().err


def test_names_that_are_no_text_are_told_all_the_same(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file may be called by any bytes: what would move the cursor, or is no text, is replaced."""
    (folder / "a.csv").rename(folder / os.fsdecode(b"\xff\x1b[2J.csv"))
    assert [row["file"] for row in printed(capsys, str(folder))["drawings"]] == ["b.csv", "\ufffd\ufffd[2J.csv"]
    path = folder.parent / "sheet.svg"
    assert main(["verify", "four-bar", str(folder / os.fsdecode(b"\xff\x1b[2J.csv")), "--report", str(path)]) == 0
    ElementTree.parse(path)


def test_a_drawing_that_is_not_there_is_bad_input(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One line, status 2."""
    assert main(["verify", "four-bar", str(tmp_path / "none.csv")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
